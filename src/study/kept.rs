//! Runs of a study that are kept in its folder and shared by every file that has their group.

use crate::case::Case;
use crate::curve::{Impact, Summary};
use crate::files::{Sum, sum_of, with_sum, write_atomic};
use crate::material::ReferenceUnits;
use crate::study::scaled;
use crate::{Error, PROGRAM, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a finished run in a study's folder is: its group, the program that made it, and the units of its figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptRun {
    program: String,
    group: String,
    radius_m: f64,
    density_kg_m3: f64,
    #[serde(rename = "young_modulus_Pa")]
    young_modulus_pa: f64,
}

impl KeptRun {
    /// Its file, written last: where it stands the others are whole.
    pub const FILE: &str = "run.json";

    /// The run of `case`, which stands for its `group`.
    #[must_use]
    pub fn of(case: &Case, group: &str) -> Self {
        let units = ReferenceUnits::of(&case.material, case.radius);
        KeptRun {
            program: PROGRAM.to_owned(),
            group: group.to_owned(),
            radius_m: units.length,
            density_kg_m3: units.density,
            young_modulus_pa: units.stress,
        }
    }

    /// Write it beside the files of the impact.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join(Self::FILE);
        let text = with_sum(self, b"").map_err(|e| Error::file("write", &path)(e.into()))?;
        write_atomic(&path, text.as_bytes())
    }

    /// Figures of the finished run of `group` in `folder`, as `case` has them; none where there is nothing, or something of
    /// another program. What is damaged is said and taken for nothing.
    #[must_use]
    pub fn figures(folder: &Path, group: &str, case: &Case) -> Option<Summary> {
        let path = folder.join(Self::FILE);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return None,
            Err(error) => return begun_anew(&path, &error.to_string()),
        };
        let Ok(kept) = serde_json::from_str::<KeptRun>(&text) else {
            return begun_anew(&path, "it is damaged");
        };
        if kept.program != PROGRAM {
            return None;
        }
        if sum_of(&text, b"") != Sum::Fits || kept.group != group {
            return begun_anew(&path, "it is damaged");
        }
        match Impact::read_any(folder) {
            Ok(impact) => Some(scaled(&impact.summary, &kept.units(), case)),
            Err(error) => begun_anew(&path, &error.to_string()),
        }
    }

    fn units(&self) -> ReferenceUnits {
        ReferenceUnits {
            length: self.radius_m,
            density: self.density_kg_m3,
            stress: self.young_modulus_pa,
        }
    }
}

fn begun_anew(path: &Path, why: &str) -> Option<Summary> {
    tracing::warn!("{}: {why}; the run is begun anew", path.display());
    None
}
