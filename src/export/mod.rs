//! Export: a fitted law in the languages of other discrete-element codes, and the proof that it is the same law there; whole scenes
//! ([`scene`]) and cases ([`deck`]) for other programs.
//!
//! A law file becomes a [`source::portable::Portable`]; [`c::kernel`] writes it once in C, and each dialect, one file a target, wraps
//! that text in what its code asks for. A new target is a new file with its `source::dialect::Dialect`, its `mod` line and one line
//! of the list of [`Target`]. What could be executed is executed by [`check`].

pub mod source;

pub mod c;
pub mod check;
pub mod deck;
pub mod deme;
pub mod lammps;
pub mod liggghts;
pub mod mercurydpm;
pub mod native;
pub mod scene;
pub mod table;

use self::check::{Check, CompilerCheck, NativeCheck, ShimCheck};
use self::native::Code;
use self::source::artifact::Artifact;
use self::source::dialect::{Dialect, PairExport};
use self::source::portable::Portable;
use crate::law::pair::PairTable;
use crate::{Error, Result};

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

            /// Whether it holds the law of a pair of bodies.
            #[must_use]
            pub fn is_of_pairs(self) -> bool {
                match self {
                    $(Target::$target => <$dialect>::OF_PAIRS,)+
                }
            }

            /// The files of this target, in a folder of its name.
            ///
            /// # Errors
            /// [`Error::Refused`] when the target cannot express the law.
            pub fn export(self, law: &Portable) -> Result<Vec<Artifact>> {
                if let Some(bodies) = law.pair().filter(|_| !self.is_of_pairs()) {
                    return Err(not_of_pairs(self, bodies));
                }
                let files = match self {
                    $(Target::$target => <$dialect>::export(law),)+
                };
                Ok(files?.into_iter().map(|file| file.within(self.name())).collect())
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

/// Refusal of the law of a pair by a target that holds the law of one material.
fn not_of_pairs(target: Target, bodies: &PairTable) -> Error {
    let able = Target::ALL.into_iter().filter(|able| able.is_of_pairs());
    let names: Vec<_> = able.map(Target::name).collect();
    Error::Refused {
        what: format!("--to {target}"),
        found: format!("the law of a pair, {}", bodies.bodies()),
        allowed: format!(
            "holds the law of one material, which is that of all its bodies; that of a pair goes to {}",
            names.join(", ")
        ),
    }
}

/// What proves a target where its code is installed; nothing runs a table.
#[must_use]
pub fn checks(target: Target) -> Vec<Box<dyn Check>> {
    match target {
        Target::C => vec![Box::new(CompilerCheck)],
        Target::Native => vec![
            Box::new(NativeCheck(Code::Liggghts)),
            Box::new(NativeCheck(Code::Lammps)),
            Box::new(NativeCheck(Code::Yade)),
        ],
        Target::Liggghts => vec![Box::new(check::liggghts::LiggghtsCheck)],
        Target::Lammps => vec![Box::new(check::lammps::LammpsCheck)],
        Target::Deme => vec![Box::new(ShimCheck::Deme)],
        Target::MercuryDpm => vec![Box::new(ShimCheck::MercuryDpm)],
        Target::Table => Vec::new(),
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
            .ok_or_else(|| Error::not_one_of("--to", text, Target::ALL.map(Target::name)))
    }
}
