//! Formats: the one list of files that grains are read from.

use super::{Listing, Meaning, data, dump, restart, table, vtp};
use crate::document::keys::names;
use serde::Deserialize;
use std::path::Path;

macro_rules! formats {
    ($($(#[$what:meta])* $format:ident as $name:literal: $module:ident, [$($ending:literal),+];)+) => {
        /// Format of a file of grains.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum Format {
            $($(#[$what])* $format,)+
        }

        names! { Format { $($format as $name,)+ } }

        impl Format {
            /// Endings of file names that tell a format.
            pub const ENDINGS: &'static [&'static str] = &[$($($ending),+),+];

            /// Format by the ending of a file's name.
            #[must_use]
            pub fn of(name: &str) -> Option<Self> {
                let ending = Path::new(name).extension()?.to_str()?.to_lowercase();
                match &ending[..] {
                    $($($ending)|+ => Some(Format::$format),)+
                    _ => None,
                }
            }

            pub(super) fn read(self, bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
                match self {
                    $(Format::$format => $module::read(bytes, meaning),)+
                }
            }
        }
    };
}

formats! {
    /// Table with a header, its values apart by commas, semicolons, tabs or blanks.
    Csv as "csv": table, ["csv", "txt", "tsv", "dat"];
    /// LAMMPS' `dump custom` as text, LIGGGHTS' too.
    LammpsDump as "lammps-dump": dump, ["lammpstrj", "dump", "lammpsdump"];
    /// LAMMPS' data file with atoms of the style sphere, LIGGGHTS' granular.
    LammpsData as "lammps-data": data, ["data", "lmp"];
    /// VTK XML poly data: points with their values.
    Vtp as "vtp": vtp, ["vtp"];
    /// What an interrupted run of a bed keeps.
    Restart as "restart": restart, ["bin"];
}
