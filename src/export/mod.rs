//! Export: a fitted law in the languages of other discrete-element codes, and the proof that it is the same law there.
//!
//! A law file becomes a [`portable::Portable`]; [`kernel`] writes it once in C, and each dialect, one file a target, wraps
//! that text in what its code asks for. What could be executed is executed by [`check`].

pub mod c;
pub mod check;
pub mod contact;
pub mod deme;
pub mod describe;
pub mod kernel;
pub mod lammps;
pub mod liggghts;
pub mod mercurydpm;
pub mod native;
pub mod portable;
pub mod reference;
pub mod scene;
pub mod series;
pub mod table;

use crate::{Error, Result};
use portable::Portable;

/// A text file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// File name, relative to the output folder.
    pub name: String,
    /// Content.
    pub text: String,
}

/// Where a law can go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Target {
    /// [`c`].
    C,
    /// [`liggghts`].
    Liggghts,
    /// [`lammps`].
    Lammps,
    /// [`table`].
    Table,
    /// [`native`].
    Native,
    /// [`deme`].
    Deme,
    /// [`mercurydpm`].
    MercuryDpm,
}

impl Target {
    /// Every target, in the order of messages.
    pub const ALL: [Target; 7] = [
        Target::C,
        Target::Liggghts,
        Target::Lammps,
        Target::Table,
        Target::Native,
        Target::Deme,
        Target::MercuryDpm,
    ];

    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Target::C => "c",
            Target::Liggghts => "liggghts",
            Target::Lammps => "lammps",
            Target::Table => "table",
            Target::Native => "native",
            Target::Deme => "deme",
            Target::MercuryDpm => "mercurydpm",
        }
    }

    /// The files of this target.
    ///
    /// # Errors
    /// [`Error::Argument`] when the target cannot express the law.
    pub fn export(self, law: &Portable) -> Result<Vec<Artifact>> {
        Ok(match self {
            Target::C => c::export(law),
            Target::Liggghts => liggghts::export(law),
            Target::Lammps => lammps::export(law),
            Target::Table => table::export(law),
            Target::Native => native::files(law)?,
            Target::Deme => deme::export(law),
            Target::MercuryDpm => mercurydpm::export(law),
        })
    }
}

impl std::fmt::Display for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Target {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        Target::ALL
            .into_iter()
            .find(|target| target.name() == text)
            .ok_or_else(|| Error::Argument {
                argument: "--to".to_owned(),
                found: format!("`{text}`"),
                allowed: format!(
                    "must be one of {}",
                    Target::ALL.map(Target::name).join(", ")
                ),
            })
    }
}
