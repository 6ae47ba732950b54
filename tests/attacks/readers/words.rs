//! Quantities and command lines.

use super::{Accepted, text};
use clap::Parser;
use impactlaw::cli::Cli;
use impactlaw::unit::{self, DIMENSIONS, engineering};
use std::path::Path;

pub(super) fn quantity(bytes: &[u8], _: &Path) -> Accepted {
    let text = text(bytes);
    let mut accepted = false;
    for known in DIMENSIONS {
        match (known.parse)(&text) {
            Ok(value) => {
                assert!(value.is_finite());
                accepted = true;
                let _ = (engineering(value, "m", 3), unit::significant(value, 4));
            }
            Err(error) => assert!(error.allowed.contains(known.example)),
        }
    }
    accepted
}

/// Command lines, a word a line.
pub(super) const COMMANDS: [&str; 7] = [
    "impactlaw\nrun\ncases/solder-ball.toml\n--out\no\n--no-bed\n--seed\n3",
    "impactlaw\n-v\nimpact\nc.toml\n--velocity\n10 m/s\n--checkpoint\n30 s\n--threads\n2",
    "impactlaw\nbed\ns.toml\n--law\nlaw.toml\n--seed\n18446744073709551615",
    "impactlaw\nbed\nexport\ns.toml\n--to\nlammps",
    "impactlaw\nexport\nlaw.toml\n--to\nc\n--check",
    "impactlaw\nstudy\ns.toml\n--refine\n20",
    "impactlaw\nvalidate\n--only\nballs,lead-nickel\n--draws\n500",
];

pub(super) fn command_line(bytes: &[u8], _: &Path) -> Accepted {
    let text = text(bytes);
    match Cli::try_parse_from(text.split('\n')) {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}
