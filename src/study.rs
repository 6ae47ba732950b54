//! Study: a grid of cases, and which of them are the same run in dimensionless terms.

mod kept;

pub use kept::KeptRun;

use crate::Result;
use crate::case::Case;
use crate::curve::{Particle, Summary, Tangential};
use crate::document::Document;
use crate::document::keys::{Kind, Value as _, key, keys, table};
use crate::material::{Flow, Material, ReferenceUnits};
use crate::unit::{Density, Length, Pressure, Quantity, Velocity};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::Deserialize;
use std::path::Path;

/// Most cases of a study: more are a slip of a list, or want to be several files.
const MOST_CASES: usize = 100_000;

/// A grid of cases, each with one speed, in the order of the file: radius, density, modulus, ratio E/Y, Poisson's ratio,
/// speed (the last one fastest).
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Name: the file's stem.
    pub name: String,
    /// SHA-256 of the file's text.
    pub hash: String,
    /// The cases.
    pub cases: Vec<Case>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct StudyFile {
    particle: ParticleTable,
    material: MaterialTable,
    impact: ImpactTable,
    accuracy: AccuracyTable,
}

keys! {
    StudyFile {
        particle: table("the particles"),
        material: table("their materials"),
        impact: table("speeds"),
        accuracy: table("what the runs are planned for"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParticleTable {
    radius: Vec<Quantity<Length>>,
}

keys! {
    ParticleTable {
        radius: key("radii", "> 0", "['250 um']"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialTable {
    density: Vec<Quantity<Density>>,
    young_modulus: Vec<Quantity<Pressure>>,
    young_over_yield: Vec<f64>,
    poisson_ratio: Vec<f64>,
}

keys! {
    MaterialTable {
        density: key("densities", "> 0", "['1000 kg/m3', '8000 kg/m3']"),
        young_modulus: key("Young's moduli", "> 0", "['100 GPa']"),
        young_over_yield: key("E/Y", "> 1", "[20, 80]"),
        poisson_ratio: key("Poisson's ratios", "[0, 0.5)", "[0.35]"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ImpactTable {
    velocities: Vec<Quantity<Velocity>>,
}

keys! {
    ImpactTable {
        velocities: key("impact speeds", "> 0", "['10 m/s', '50 m/s']"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AccuracyTable {
    tolerance: f64,
}

keys! {
    AccuracyTable {
        tolerance: key("as in a case file", "(0, 0.2]", "0.02"),
    }
}

impl Study {
    /// Read and check a study file.
    ///
    /// # Errors
    /// As [`Case::read`], for every entry of every list.
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Keys of a study file.
    #[must_use]
    pub fn keys() -> Kind {
        StudyFile::kind()
    }

    /// Check a study file that has been read already.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn from_document(document: &Document) -> Result<Self> {
        let file: StudyFile = document.parse()?;
        let m = &file.material;
        let radii = positive(document, "particle.radius", &file.particle.radius)?;
        let densities = positive(document, "material.density", &m.density)?;
        let moduli = positive(document, "material.young_modulus", &m.young_modulus)?;
        let velocities = positive(document, "impact.velocities", &file.impact.velocities)?;
        let ratios = within(document, "material.young_over_yield", &m.young_over_yield)?;
        let poissons = within(document, "material.poisson_ratio", &m.poisson_ratio)?;
        let tolerance = document.within("accuracy.tolerance", file.accuracy.tolerance)?;
        let lists = [
            ("particle.radius", radii.len()),
            ("material.density", densities.len()),
            ("material.young_modulus", moduli.len()),
            ("material.young_over_yield", ratios.len()),
            ("material.poisson_ratio", poissons.len()),
            ("impact.velocities", velocities.len()),
        ];
        check_count(document, &lists)?;
        let heaviest = densities.iter().copied().fold(0.0, f64::max);
        let softest = moduli.iter().copied().fold(f64::INFINITY, f64::min);
        let weakest = softest / ratios.iter().copied().fold(1.0, f64::max);
        for (i, v) in velocities.iter().enumerate() {
            document.check(
                &format!("impact.velocities[{i}]"),
                *v,
                |v| (heaviest * v * v / weakest).is_finite() && heaviest * v * v <= softest,
                "must not be above the speed of sound sqrt(E/rho) of any of the materials; check the unit",
            )?;
        }
        let case = |radius: f64, material: Material, velocity: f64| Case {
            name: document.name(),
            path: document.path().to_owned(),
            hash: document.hash(),
            radius,
            material,
            velocities: vec![velocity],
            angle: 0.0,
            friction: 0.0,
            tolerance,
            bed: None,
        };
        let mut cases = Vec::new();
        for &radius in &radii {
            for &density in &densities {
                for &young_modulus in &moduli {
                    for &ratio in &ratios {
                        for &poisson_ratio in &poissons {
                            let flow = Some(Flow::perfectly_plastic(young_modulus / ratio));
                            let material = Material {
                                density,
                                young_modulus,
                                poisson_ratio,
                                flow,
                            };
                            cases.extend(velocities.iter().map(|v| case(radius, material, *v)));
                        }
                    }
                }
            }
        }
        Ok(Study {
            name: document.name(),
            hash: document.hash(),
            cases,
        })
    }
}

/// That the lists, each with its key, make a number of cases that can be held.
fn check_count(document: &Document, lists: &[(&str, usize)]) -> Result<()> {
    let all = lists
        .iter()
        .try_fold(1usize, |all, (_, length)| all.checked_mul(*length));
    if all.is_some_and(|all| all <= MOST_CASES) {
        return Ok(());
    }
    let longest = lists.iter().max_by_key(|(_, length)| *length);
    let key = longest.map_or("impact.velocities", |(key, _)| key);
    let allowed = format!("must be shorter: all lists together make more than {MOST_CASES} cases");
    Err(document.reject(key, allowed))
}

/// SI values of a list of quantities, as [`within`].
fn positive<D: Copy>(document: &Document, key: &str, list: &[Quantity<D>]) -> Result<Vec<f64>> {
    let values: Vec<f64> = list.iter().map(|quantity| quantity.si()).collect();
    within(document, key, &values)
}

/// All entries of a list, which must hold one, each in the range of its key.
fn within(document: &Document, key: &str, list: &[f64]) -> Result<Vec<f64>> {
    if list.is_empty() {
        return Err(document.reject(key, "must hold at least one value"));
    }
    let entry = |(i, x): (usize, &f64)| document.within(&format!("{key}[{i}]"), *x);
    list.iter().enumerate().map(entry).collect()
}

/// `count` of the `total` runs of a study, drawn so that they lie all over a sorted list of them: one from each of `count`
/// equal stretches. The same for every call.
#[must_use]
pub fn drawn(total: usize, count: usize) -> Vec<usize> {
    let mut random = Pcg64::seed_from_u64(0);
    let count = count.min(total);
    let stretch = |k: usize| k * total / count;
    (0..count)
        .map(|k| random.random_range(stretch(k)..stretch(k + 1)))
        .collect()
}

/// Name of the run a case stands for: flow stress with its constants, density times squared speed and Poisson's ratio in
/// reference units (R = rho = E = 1), angle, friction and tolerance, to nine digits.
///
/// Two cases with equal groups are the same run, scaled.
#[must_use]
pub fn group(case: &Case) -> String {
    // whoever adds to a case says here whether it makes another run
    let Case {
        name: _,
        path: _,
        hash: _,
        bed: _,
        radius,
        material,
        velocities,
        angle,
        friction,
        tolerance,
    } = case;
    let Material {
        density,
        young_modulus,
        poisson_ratio,
        flow,
    } = material;
    let units = ReferenceUnits::of(material, *radius);
    let flow = flow.map_or("elastic".to_owned(), |flow| {
        let flow = flow.in_reference(&units);
        let constants = flow.constants().into_iter();
        let texts = constants.map(|(constant, value)| format!("{}{value:.8e}", constant.symbol));
        texts.collect::<Vec<_>>().join("_")
    });
    let speed = velocities
        .first()
        .map_or(0.0, |v| density * v * v / young_modulus);
    format!(
        "{flow}_rhoV2E{speed:.8e}_nu{poisson_ratio:e}_angle{angle:.8e}_mu{friction:e}_tol{tolerance:e}"
    )
}

/// Figures of one run, made in the units `from`, seen as another case of the same group: lengths scale with R, forces with
/// E R^2, times with R/c0.
#[must_use]
pub fn scaled(summary: &Summary, from: &ReferenceUnits, to: &Case) -> Summary {
    let units = ReferenceUnits::of(&to.material, to.radius);
    let length = units.length / from.length;
    let force = units.stress / from.stress * length * length;
    let time = length * from.speed() / units.speed();
    let velocity = units.speed() / from.speed();
    let tangential = summary.tangential.map(|t| Tangential {
        incident_velocity_m_s: t.incident_velocity_m_s * velocity,
        velocity_m_s: t.velocity_m_s * velocity,
        angular_velocity_rad_s: t.angular_velocity_rad_s / time,
        ..t
    });
    Summary {
        velocity_m_s: to
            .velocities
            .first()
            .copied()
            .unwrap_or(summary.velocity_m_s),
        max_force_n: summary.max_force_n * force,
        max_displacement_m: summary.max_displacement_m * length,
        max_centre_displacement_m: summary.max_centre_displacement_m * length,
        residual_displacement_m: summary.residual_displacement_m * length,
        contact_time_s: summary.contact_time_s * time,
        tangential,
        particle: Some(Particle::of(&to.material, to.radius)),
        ..summary.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::flow::LinearHardening;

    const TEXT: &str = r#"
[particle]
radius = ["250 um"]
[material]
density = ["1000 kg/m3", "4000 kg/m3"]
young_modulus = ["1 GPa", "10 GPa"]
young_over_yield = [20, 40]
poisson_ratio = [0.35]
[impact]
velocities = ["10 m/s", "20 m/s"]
[accuracy]
tolerance = 0.02
"#;

    #[test]
    fn every_combination_is_a_case_with_the_speed_running_fastest() {
        let study = Study::from_document(&Document::new(Path::new("s.toml"), TEXT)).unwrap();
        assert_eq!(study.cases.len(), 16);
        assert_eq!(study.cases[0].velocities, [10.0]);
        assert_eq!(study.cases[1].velocities, [20.0]);
        assert_eq!(study.cases[1].material, study.cases[0].material);
    }

    #[test]
    fn drawn_runs_lie_all_over_the_range_and_are_always_the_same() {
        let picked = drawn(384, 20);
        assert_eq!(picked, drawn(384, 20));
        assert!(picked.windows(2).all(|p| p[0] < p[1]));
        assert!((0..20).all(|k| picked[k] / 19 >= k && picked[k] < (k + 1) * 384 / 20));
        assert_eq!(drawn(3, 20), [0, 1, 2]);
    }

    #[test]
    fn equal_groups_are_found_across_density_and_speed() {
        let study = Study::from_document(&Document::new(Path::new("s.toml"), TEXT)).unwrap();
        // 1000 kg/m3 at 20 m/s is 4000 kg/m3 at 10 m/s
        let (a, b) = (&study.cases[1], &study.cases[8]);
        assert_eq!((a.material.density, b.material.density), (1000.0, 4000.0));
        assert_eq!(group(a), group(b));
        assert_ne!(group(a), group(&study.cases[0]));
    }

    #[test]
    fn every_dimensionless_group_makes_another_run() {
        let study = Study::from_document(&Document::new(Path::new("s.toml"), TEXT)).unwrap();
        let case = &study.cases[0];
        let with = |change: fn(&mut Case)| {
            let mut other = case.clone();
            change(&mut other);
            group(&other)
        };
        let hardening = |case: &mut Case| {
            let strength = case.material.flow.unwrap().yield_strength();
            let modulus = 1e6;
            case.material.flow = Some(LinearHardening { strength, modulus }.into());
        };
        let all = [
            group(case),
            with(|case| case.material.flow = None),
            with(|case| case.material.flow = Some(Flow::perfectly_plastic(1e6))),
            with(hardening),
            with(|case| case.material.poisson_ratio = 0.3),
            with(|case| case.velocities = vec![11.0]),
            with(|case| case.angle = 0.1),
            with(|case| case.friction = 0.1),
            with(|case| case.tolerance = 0.05),
        ];
        for (k, group) in all.iter().enumerate() {
            assert!(!all[..k].contains(group), "{group}");
        }
        let larger = |case: &mut Case| {
            case.radius *= 4.0;
            case.material.density *= 4.0;
            case.velocities[0] /= 2.0;
        };
        assert_eq!(with(larger), all[0]);
    }

    #[test]
    fn bad_entries_are_refused_with_their_place() {
        let text = TEXT.replace("[20, 40]", "[20, 0.5]");
        let error = Study::from_document(&Document::new(Path::new("s.toml"), text)).unwrap_err();
        assert!(error.to_string().contains("young_over_yield[1]"), "{error}");
    }

    #[test]
    fn speeds_no_material_has_and_grids_without_end_are_refused_by_their_key() {
        let read = |text: String| {
            let study = Study::from_document(&Document::new(Path::new("s.toml"), text));
            study.unwrap_err().to_string()
        };
        for speed in ["1e200 m/s", "2000 m/s"] {
            let error = read(TEXT.replace("20 m/s", speed));
            assert!(error.contains("`impact.velocities[1]`"), "{error}");
        }
        let many = vec!["\"1 m/s\""; 30_000].join(", ");
        let error = read(TEXT.replace("\"20 m/s\"", &many));
        assert!(
            error.contains("`impact.velocities`") && error.contains("100000 cases"),
            "{error}"
        );
    }
}
