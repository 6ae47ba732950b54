//! Curve of one impact: time series and summary, in memory and as the files `curve.csv` and `summary.json`.

use crate::files::{write_atomic, write_rows};
use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

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
    /// Wall force: impulse over the output interval divided by its length, N.
    #[serde(rename = "force_N")]
    pub force_n: f64,
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
}

/// How an impact ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Rebounded; all figures are valid.
    Ok,
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
    /// F*: maximum of the force averaged over 2 % of the contact time, N.
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
    /// Largest imbalance of the energies over the incident kinetic energy.
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
    /// What happened along the wall; absent from normal impacts on a frictionless wall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Tangential>,
    /// How the run ended.
    pub status: Status,
}

/// Figures of an impact along the wall (table `tangential` of `summary.json`).
///
/// Positive is the direction in which the particle came; a positive spin rolls that way.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tangential {
    /// Velocity along the wall before, m/s.
    pub incident_velocity_m_s: f64,
    /// Velocity of the centre of mass along the wall after, m/s.
    pub velocity_m_s: f64,
    /// Tangential restitution $e_t = -(v_t - R\omega)/V_t$ of the velocity of the contact point (Walton's beta); absent
    /// from a normal impact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Angular velocity after: angular momentum over the moment of inertia 2/5 m R^2, rad/s.
    pub angular_velocity_rad_s: f64,
    /// Impulse along the wall over the normal impulse; the friction coefficient in full sliding.
    pub impulse_ratio: f64,
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
    let file = std::fs::File::open(path).map_err(Error::file("read", path))?;
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(file)
        .deserialize()
        .collect::<std::result::Result<Vec<T>, _>>()
        .map_err(|e| Error::Syntax {
            path: path.to_owned(),
            message: e.to_string(),
            span: None,
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
    /// Read `curve.csv` and `summary.json` from the folder of one impact.
    ///
    /// # Errors
    /// [`Error::File`] and [`Error::Syntax`] as for the two files.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join("summary.json");
        let text = std::fs::read_to_string(&path).map_err(Error::file("read", &path))?;
        let summary = serde_json::from_str(&text).map_err(|e| Error::Syntax {
            path: path.clone(),
            message: e.to_string(),
            span: None,
        })?;
        Ok(Impact {
            summary,
            curve: Curve::read(&folder.join("curve.csv"))?,
        })
    }

    /// Write `curve.csv` and `summary.json` into `folder`.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path, provenance: &str) -> Result<()> {
        self.curve.write(&folder.join("curve.csv"), provenance)?;
        let path = folder.join("summary.json");
        let text = serde_json::to_string_pretty(&self.summary)
            .map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, text.as_bytes())
    }
}
