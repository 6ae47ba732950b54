//! Curve of one impact: time series and summary, in memory and as the files `curve.csv` and `summary.json`.

use crate::files::{Sum, rows_text, sum_of, with_sum, write_atomic, write_rows};
use crate::material::{Flow, Material, MaterialTable};
use crate::shape::Shape;
use crate::unit::engineering;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

pub mod files;
pub mod film;
mod tables;

pub use tables::{Adhering, Cylinder, Heating, SchemeFigures, Tangential, Target};

/// One output interval of an impact. Field names are the CSV header (file contract).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    /// Time since first contact, s.
    pub time_s: f64,
    /// Approach of the centre of mass since first contact, m.
    pub displacement_m: f64,
    /// Travel of the material point at the sphere's centre, m.
    pub centre_displacement_m: f64,
    /// Depth of the dent in the second body, m: travel of its pole towards its centre of mass, of a plate towards its back; absent on
    /// a rigid wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_displacement_m: Option<f64>,
    /// Wall force: impulse over the output interval divided by its length, N.
    #[serde(rename = "force_N")]
    pub force_n: f64,
    /// Friction force in the same way, positive against the direction in which the particle came, N; absent where there is
    /// no friction.
    #[serde(rename = "tangential_force_N")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_force_n: Option<f64>,
    /// Outermost radius in contact, m.
    pub contact_radius_m: f64,
    /// Kinetic energy, J.
    #[serde(rename = "kinetic_J")]
    pub kinetic_j: f64,
    /// Elastic strain energy, J.
    #[serde(rename = "elastic_J")]
    pub elastic_j: f64,
    /// Plastic work so far, J.
    #[serde(rename = "plastic_J")]
    pub plastic_j: f64,
    /// Energy of the surfaces, J: 0 out of the range of their attraction, $-w$ a unit of area where they meet; absent where nothing
    /// adheres.
    #[serde(rename = "surface_J")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface_j: Option<f64>,
}

/// How an impact ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Rebounded; all figures are valid.
    Ok,
    /// Held by the wall's adhesion: it turned back before it came free. e is 0, all other figures are valid.
    Sticks,
    /// Still in contact when the duration ran out.
    NoRebound,
    /// Stopped early, with the reason.
    Failed(String),
}

/// Figures of one impact (file contract: keys of `summary.json`). What a failed run could not find is NaN, `null` in the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Impact speed V, m/s.
    #[serde(deserialize_with = "number_or_null")]
    pub velocity_m_s: f64,
    /// Coefficient of restitution e from the mass-averaged velocity after contact.
    #[serde(deserialize_with = "number_or_null")]
    pub restitution: f64,
    /// F*: maximum of the force averaged over 2 % of the contact time, of a flattened body also over the time in which the edge of
    /// the contact crosses a cell, N.
    #[serde(rename = "max_force_N")]
    #[serde(deserialize_with = "number_or_null")]
    pub max_force_n: f64,
    /// delta*: largest approach of the centre of mass, m.
    #[serde(deserialize_with = "number_or_null")]
    pub max_displacement_m: f64,
    /// Largest travel of the material centre, m.
    #[serde(deserialize_with = "number_or_null")]
    pub max_centre_displacement_m: f64,
    /// delta_res: approach of the centre of mass at loss of contact, m.
    #[serde(deserialize_with = "number_or_null")]
    pub residual_displacement_m: f64,
    /// First contact to last loss of contact, s.
    #[serde(deserialize_with = "number_or_null")]
    pub contact_time_s: f64,
    /// 1 - H_d/D, height averaged over the residual vibration.
    #[serde(deserialize_with = "number_or_null")]
    pub compression_ratio: f64,
    /// H_e/D at maximum compression.
    #[serde(deserialize_with = "number_or_null")]
    pub height_at_max_compression_ratio: f64,
    /// Volume mean of the accumulated equivalent plastic strain at rebound.
    #[serde(deserialize_with = "number_or_null")]
    pub equivalent_plastic_strain: f64,
    /// Plastic work over incident kinetic energy, W_p/W_i.
    #[serde(deserialize_with = "number_or_null")]
    pub plastic_work_ratio: f64,
    /// Energy lost in shocks over incident kinetic energy; 0 but in impacts that flatten the body.
    #[serde(default, deserialize_with = "number_or_null")]
    pub shock_work_ratio: f64,
    /// Largest imbalance of the energies over the incident kinetic energy, and what the surfaces that adhere have given then.
    #[serde(deserialize_with = "number_or_null")]
    pub energy_closure: f64,
    /// Share of the body that lost its strength because it was squeezed too thin to be stepped through; 0 but in impacts
    /// that flatten the body.
    #[serde(default, deserialize_with = "number_or_null")]
    pub eroded_volume_ratio: f64,
    /// Material points.
    pub points: usize,
    /// Time steps; where cells take steps of their own, the mean over all points.
    pub steps: u64,
    /// Wall time, s.
    #[serde(deserialize_with = "number_or_null")]
    pub wall_s: f64,
    /// What became of a cylinder; absent from impacts of spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<Cylinder>,
    /// What plastic work heated; absent where the flow stress knows no temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heating: Option<Heating>,
    /// What happened along the wall; absent from normal impacts on a frictionless wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Tangential>,
    /// What the wall's adhesion did; absent where nothing adheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<Adhering>,
    /// The second body of an impact of two; absent on a rigid wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<Target>,
    /// Published method that it was run by; absent where it is the crate's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scheme: Option<SchemeFigures>,
    /// Whose impact it is; absent from files of versions before 0.2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub particle: Option<Particle>,
    /// What a reader of the figures has to know; absent where there is nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// How the run ended.
    pub status: Status,
}

/// Particle that an impact belongs to (table `particle` of `summary.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Particle {
    /// R, m.
    pub radius_m: f64,
    /// Length of a cylinder, m; absent for a sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Its constants, which stand beside the radius; they are handed every other key and refuse what is none of theirs.
    #[serde(flatten)]
    pub material: MaterialTable,
}

/// Restitution below which errors of e are counted over it: e^2 is the share of the energy that comes back, here a hundredth, and
/// what a body rings with at loss of contact is nearly as large.
pub const LEAST_RESTITUTION: f64 = 0.1;

/// Error of the restitution `found` where `truth` is right, over `truth` or [`LEAST_RESTITUTION`]; so impacts that stick are
/// data too.
#[must_use]
pub fn restitution_error(found: f64, truth: f64) -> f64 {
    if truth >= LEAST_RESTITUTION {
        found / truth - 1.0
    } else {
        (found - truth) / LEAST_RESTITUTION
    }
}

/// Relative difference by which two particles may differ and be the same: what text does to numbers.
const SAME: f64 = 1e-12;

impl Particle {
    /// A sphere of `radius` (m).
    #[must_use]
    pub fn of(material: &Material, radius: f64) -> Self {
        Self::of_shape(material, radius, Shape::Sphere)
    }

    /// A particle of `radius` (m) and a shape in units of it.
    #[must_use]
    pub fn of_shape(material: &Material, radius: f64, shape: Shape) -> Self {
        Particle {
            radius_m: radius,
            length_m: match shape {
                Shape::Sphere => None,
                Shape::Cylinder { length } => Some(length * radius),
            },
            material: MaterialTable::from(material),
        }
    }

    /// What of `self` is not as in `other`, as names of figures with both values; empty when they are the same particle.
    #[must_use]
    pub fn differences(&self, other: &Particle) -> Vec<String> {
        let figures = |p: &Particle| {
            let m = &p.material;
            let own = m.flow.checked().map_or_else(Vec::new, |f| f.constants());
            let mut all = vec![
                ("radius".to_owned(), "m", Some(p.radius_m)),
                ("length".to_owned(), "m", p.length_m),
                ("density".to_owned(), "kg/m³", Some(m.density_kg_m3)),
                ("young modulus".to_owned(), "Pa", Some(m.young_modulus_pa)),
                ("poisson ratio".to_owned(), "", Some(m.poisson_ratio)),
            ];
            all.extend(Flow::all_constants().into_iter().map(|constant| {
                let found = own.iter().find(|(c, _)| *c == constant);
                let value = found.map(|(_, value)| *value);
                (constant.name(), constant.dimension.unit(), value)
            }));
            all
        };
        let text = |value: Option<f64>, unit: &str| match value {
            Some(value) => engineering(value, unit, 6).trim_end().to_owned(),
            None => "none".to_owned(),
        };
        let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()),
            (a, b) => a.is_none() && b.is_none(),
        };
        figures(self)
            .into_iter()
            .zip(figures(other))
            .filter(|((_, _, a), (_, _, b))| !same(*a, *b))
            .map(|((name, unit, a), (_, _, b))| {
                format!("{name} {} instead of {}", text(a, unit), text(b, unit))
            })
            .collect()
    }
}

/// A number; `null` is NaN.
pub(crate) fn number_or_null<'de, D: serde::Deserializer<'de>>(
    deserializer: D,
) -> std::result::Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

/// Time series of one impact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// Samples in order of time.
    pub samples: Vec<Sample>,
}

/// One impact: its curve and its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// Figures.
    pub summary: Summary,
    /// Time series.
    pub curve: Curve,
}

/// Part of the particle a row of a map belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// Material point.
    Inside,
    /// Point of the surface, from the lower to the upper pole.
    Surface,
}

/// One row of a map of the deformed particle. Field names are the CSV header.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MapPoint {
    /// Inside or surface.
    pub part: Part,
    /// Distance from the axis, m.
    pub r_m: f64,
    /// Height above the wall, m.
    pub z_m: f64,
    /// Edge length of the patch it stands for, m (0 on the surface).
    pub size_m: f64,
    /// Accumulated equivalent plastic strain.
    pub equivalent_plastic_strain: f64,
    /// Von Mises stress, Pa.
    #[serde(rename = "von_mises_Pa")]
    pub von_mises_pa: f64,
    /// Pressure, minus the mean stress, Pa (0 on the surface).
    #[serde(rename = "pressure_Pa", default)]
    pub pressure_pa: f64,
    /// Temperature, K; none of a material that knows none.
    #[serde(rename = "temperature_K", default)]
    pub temperature_k: Option<f64>,
}

/// The particle at one moment: files `particle_compressed.csv` and `particle_rebound.csv`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleMap {
    /// Rows: material points, then the surface.
    pub points: Vec<MapPoint>,
}

impl ParticleMap {
    /// Write as CSV with a `#` provenance line on top.
    ///
    /// # Errors
    /// [`Error::File`] when the file cannot be written.
    pub fn write(&self, path: &Path, provenance: &str) -> Result<()> {
        write_rows(path, provenance, &self.points)
    }

    /// Read a map.
    ///
    /// # Errors
    /// As [`Curve::read`].
    pub fn read(path: &Path) -> Result<Self> {
        Ok(ParticleMap {
            points: read_rows(path)?,
        })
    }
}

/// All rows of a CSV file, `#` lines skipped.
fn read_rows<T: serde::de::DeserializeOwned>(path: &Path) -> Result<Vec<T>> {
    let bytes = std::fs::read(path).map_err(Error::file("read", path))?;
    rows_of(&bytes, path)
}

/// The rows of the `bytes` of the CSV file `path`.
fn rows_of<T: serde::de::DeserializeOwned>(bytes: &[u8], path: &Path) -> Result<Vec<T>> {
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(bytes)
        .deserialize()
        .collect::<std::result::Result<Vec<T>, _>>()
        .map_err(|e| Error::Syntax {
            path: path.to_owned(),
            message: e.to_string(),
            place: None,
        })
}

impl Curve {
    /// Index of the largest displacement; loading is `..=i`, unloading `i..`.
    #[must_use]
    pub fn turning_point(&self) -> usize {
        let mut best = 0;
        for (i, s) in self.samples.iter().enumerate() {
            if s.displacement_m > self.samples[best].displacement_m {
                best = i;
            }
        }
        best
    }

    /// Square of the speed of the centre of mass (m2/s2) at every sample of a body of `mass` (kg) that came at
    /// `velocity` (m/s), from the work of the wall force so far (trapezoidal rule):
    ///
    /// $$ \dot\delta^2 = V^2 - \frac2m \int_0^\delta F\ d\delta $$
    #[must_use]
    pub fn squared_speeds(&self, velocity: f64, mass: f64) -> Vec<f64> {
        let (mut work, mut before) = (0.0, (0.0, 0.0));
        let speed = |s: &Sample| {
            let here = (s.displacement_m, s.force_n);
            work += 0.5 * (here.1 + before.1) * (here.0 - before.0);
            before = here;
            (velocity * velocity - 2.0 * work / mass).max(0.0)
        };
        self.samples.iter().map(speed).collect()
    }

    /// Write as CSV with a `#` provenance line on top.
    ///
    /// # Errors
    /// [`Error::File`] when the file cannot be written.
    pub fn write(&self, path: &Path, provenance: &str) -> Result<()> {
        write_rows(path, provenance, &self.samples)
    }

    /// Read a `curve.csv`.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read, [`Error::Syntax`] when a row is not as the contract says.
    pub fn read(path: &Path) -> Result<Self> {
        Ok(Curve {
            samples: read_rows(path)?,
        })
    }
}

impl Impact {
    /// Read `curve.csv` and `summary.json` from the folder of one impact. A summary without a sum is warned of.
    ///
    /// # Errors
    /// [`Error::File`] and [`Error::Syntax`] as for the two files; [`Error::File`] when they are not as they were written;
    /// [`Error::Refused`] for an impact of two deformable bodies or with adhesion, which [`Impact::read_any`] reads.
    pub fn read(folder: &Path) -> Result<Self> {
        let impact = Self::read_any(folder)?;
        let found = match &impact.summary {
            Summary {
                target: Some(target),
                ..
            } => format!("an impact on a deformable {}", target.shape),
            Summary {
                adhesion: Some(_), ..
            } => "an impact on a wall that adheres".to_owned(),
            _ => return Ok(impact),
        };
        Err(Error::Refused {
            what: folder.join("summary.json").display().to_string(),
            found,
            allowed: "must be one on a rigid wall without adhesion".to_owned(),
        })
    }

    /// Read an impact on any wall, or of two deformable bodies.
    ///
    /// # Errors
    /// As [`Impact::read`], but for the last.
    pub fn read_any(folder: &Path) -> Result<Self> {
        let path = folder.join("summary.json");
        let text = std::fs::read_to_string(&path).map_err(Error::file("read", &path))?;
        let curve = folder.join("curve.csv");
        let bytes = std::fs::read(&curve).map_err(Error::file("read", &curve))?;
        match sum_of(&text, &bytes) {
            Sum::Fits => {}
            Sum::Absent => tracing::warn!(
                "{} has no `sha256`: whether it or curve.csv was damaged or changed cannot be told",
                path.display()
            ),
            Sum::Differs => {
                let why = "it or curve.csv is damaged, or was changed since: its `sha256` does not fit; make the impact again, \
                           or remove that key if the change is meant";
                let why = std::io::Error::new(std::io::ErrorKind::InvalidData, why);
                return Err(Error::file("use", &path)(why));
            }
        }
        let summary: Summary = serde_json::from_str(&text).map_err(|e| Error::Syntax {
            path: path.clone(),
            message: e.to_string(),
            place: None,
        })?;
        let samples = rows_of(&bytes, &curve)?;
        Ok(Impact {
            summary,
            curve: Curve { samples },
        })
    }

    /// Write `curve.csv` and `summary.json`, which carries the sum of both, into `folder`.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path, provenance: &str) -> Result<()> {
        let curve = rows_text(provenance, &self.curve.samples);
        let path = folder.join("curve.csv");
        let curve = curve.map_err(|e| Error::file("write", &path)(e))?;
        write_atomic(&path, &curve)?;
        let path = folder.join("summary.json");
        let text = with_sum(&self.summary, &curve);
        let text = text.map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, text.as_bytes())
    }
}
