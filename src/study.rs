//! Study: a grid of cases, and which of them are the same run in dimensionless terms.

mod axis;
mod file;
mod groups;
mod kept;
mod list;

pub use groups::{Groups, REFERENCE};
pub use kept::KeptRun;

use self::file::StudyFile;
use self::list::{Lists, samples};
use crate::Result;
use crate::case::{Case, slips};
use crate::curve::{Adhering, Particle, Summary, Tangential};
use crate::document::Document;
use crate::document::keys::{Kind, Value as _};
use crate::material::ReferenceUnits;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::BTreeMap;
use std::path::Path;

/// Cases, each with one speed, in the order of the file: radius, density, modulus, strength and hardening, Poisson's ratio,
/// tolerance, friction, angle, speed (the last one fastest), then the samples of a hypercube; one `[[case]]` after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Name: the file's stem.
    pub name: String,
    /// SHA-256 of the file's text.
    pub hash: String,
    /// The cases.
    pub cases: Vec<Case>,
}

impl Study {
    /// Read and check a study file.
    ///
    /// # Errors
    /// As [`Case::read`], for every entry of every list.
    pub fn read(path: &Path) -> Result<Self> {
        Self::from_document(&Document::read(path)?)
    }

    /// Cases that were made from another file than a study, whose SHA-256 is `hash`.
    #[must_use]
    pub fn made_from(hash: &str, name: &str, cases: Vec<Case>) -> Self {
        Study {
            name: name.to_owned(),
            hash: hash.to_owned(),
            cases,
        }
    }

    /// Keys of a study file.
    #[must_use]
    pub fn keys() -> Kind {
        StudyFile::kind()
    }

    /// Check a study file that has been read already.
    ///
    /// ```
    /// use impactlaw::document::Document;
    /// use impactlaw::study::Study;
    /// let text = r#"
    ///     samples = 5
    ///     [particle]
    ///     radius = "250 um"
    ///     [material]
    ///     density = "8000 kg/m3"
    ///     young_modulus = "100 GPa"
    ///     young_over_yield = { from = 20, to = 2560, scale = "log" }
    ///     poisson_ratio = [0.25, 0.35]
    ///     [impact]
    ///     velocities = { from = "10 m/s", to = "50 m/s" }
    ///     [accuracy]
    ///     tolerance = 0.02
    /// "#;
    /// let study = Study::from_document(&Document::new("cube.toml".as_ref(), text))?;
    /// // both ratios with the five samples of the hypercube
    /// assert_eq!(study.cases.len(), 10);
    /// # Ok::<(), impactlaw::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn from_document(document: &Document) -> Result<Self> {
        let file: StudyFile = document.parse()?;
        slips::check_names(document, &file.unusual)?;
        let blocks = file.blocks(document)?;
        let samples = samples(document, &file, &blocks)?;
        let lists = Lists {
            document,
            unusual: &file.unusual,
            seed: file.seed.unwrap_or(0),
            samples: &samples,
            method: (file.scheme.map(|s| s.check(document))).transpose()?,
        };
        lists.check_count(&blocks)?;
        let mut cases = Vec::new();
        let mut seen: BTreeMap<String, usize> = BTreeMap::new();
        for (i, block) in blocks.iter().enumerate() {
            let own = lists.cases(block, i as u64)?;
            // lists hold each value once: only blocks can repeat each other
            for case in own.iter().filter(|_| blocks.len() > 1) {
                let Some(before) = seen.insert(list::identity(case), i).filter(|b| *b != i) else {
                    continue;
                };
                let allowed = format!(
                    "must not make a case that `{}` makes too (V = {} m/s)",
                    blocks[before].key, case.velocities[0]
                );
                return Err(document.reject(&block.key, allowed));
            }
            cases.extend(own);
        }
        Ok(Study {
            name: document.name(),
            hash: document.hash(),
            cases,
        })
    }
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

/// Name of the run a case stands for: [`Groups::name`].
#[must_use]
pub fn group(case: &Case) -> String {
    Groups::of(case).name()
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
    let adhesion = summary.adhesion.map(|a| Adhering {
        work_of_adhesion_j_m2: a.work_of_adhesion_j_m2 * force / length,
        range_m: a.range_m * length,
        sticking_velocity_m_s: a.sticking_velocity_m_s * velocity,
        pull_off_force_n: a.pull_off_force_n * force,
        ..a
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
        adhesion,
        scheme: (summary.scheme.as_ref()).map(|scheme| scheme.scaled(time, force, length)),
        particle: Some(Particle::of(&to.material, to.radius)),
        ..summary.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Flow;
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
        let many: Vec<String> = (1..=30_000).map(|i| format!("\"{i} um/s\"")).collect();
        let error = read(TEXT.replace("\"20 m/s\"", &many.join(", ")));
        assert!(
            error.contains("`impact.velocities`") && error.contains("100000 cases"),
            "{error}"
        );
    }
}
