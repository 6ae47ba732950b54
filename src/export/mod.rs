//! Export: a fitted law in the languages of other discrete-element codes, and the proof that it is the same law there.
//!
//! A law file becomes a [`portable::Portable`]; [`kernel`] writes it once in C, and each dialect, one file a target, wraps
//! that text in what its code asks for. A new target is a new file with its [`dialect::Dialect`], its `mod` line and one line
//! of the list of [`Target`]. What could be executed is executed by [`check`].

pub mod c;
pub mod check;
pub mod contact;
pub mod deme;
pub mod describe;
pub mod dialect;
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
use dialect::{Dialect, PairExport};
use portable::Portable;

/// A text file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Artifact {
    /// File name, relative to the output folder.
    pub name: String,
    /// Content.
    pub text: String,
}

/// Makes [`Target`] from the list of dialects.
macro_rules! targets {
    ($($target:ident => $dialect:ty,)+) => {
        /// Where a law can go.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Target {
            $(
                #[doc = concat!("[`", stringify!($dialect), "`].")]
                $target,
            )+
        }

        impl Target {
            /// Every target, in the order of messages.
            pub const ALL: [Target; [$(Target::$target),+].len()] = [$(Target::$target),+];

            /// Name on the command line.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Target::$target => <$dialect>::NAME,)+
                }
            }

            /// What writes the contact of two materials, where the target can hold one.
            #[must_use]
            pub fn pair(self) -> Option<PairExport> {
                match self {
                    $(Target::$target => <$dialect>::PAIR,)+
                }
            }

            /// The files of this target.
            ///
            /// # Errors
            /// [`Error::Argument`] when the target cannot express the law.
            pub fn export(self, law: &Portable) -> Result<Vec<Artifact>> {
                match self {
                    $(Target::$target => <$dialect>::export(law),)+
                }
            }
        }
    };
}

targets! {
    C => c::Header,
    Liggghts => liggghts::Liggghts,
    Lammps => lammps::Lammps,
    Table => table::Table,
    Native => native::Native,
    Deme => deme::Deme,
    MercuryDpm => mercurydpm::MercuryDpm,
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
            .ok_or_else(|| Error::not_one_of("--to", text, Target::ALL.map(Target::name)))
    }
}
