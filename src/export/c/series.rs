//! Series: a contact of two materials in C, the flattening laws of both bodies pressed by one force.

use super::kernel;
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::portable::Portable;
use crate::{Error, Result};
use std::fmt::Write;

const SERIES: &str = include_str!("series.h");

/// What a reader has to know beside the descriptions of both laws.
const CONVENTIONS: &str = "\
Two bodies of two materials are two flattening laws in series: one force, and flattenings that add up to the overlap. The
surface they share is curved; each side is pressed like a sphere on a plane of the radius R_e (1 + E*_i/E*_j), with
1/R_e = 1/R_1 + 1/R_2: Hertz's pair for any radii and moduli while both are elastic. E* = E/(1 - nu^2) of each alone.
Units, signs, reset: as in the headers of the laws. Contacts within one material: those headers.";

/// Header of the contact of two laws, `<first>_with_<second>.h`, to stand beside theirs.
///
/// # Errors
/// [`Error::Refused`] when both laws have one name.
pub fn export(first: &Portable, second: &Portable) -> Result<Artifact> {
    if first.identifier == second.identifier {
        return Err(Error::Refused {
            what: "--with".to_owned(),
            found: format!("a law of the same name, \"{}\"", second.name),
            allowed: "must have a name of its own: C tells laws apart by it".to_owned(),
        });
    }
    Ok(Artifact {
        name: format!("{}.h", identifier(first, second)),
        text: header(first, second),
    })
}

fn identifier(first: &Portable, second: &Portable) -> String {
    format!("{}_with_{}", first.identifier, second.identifier)
}

fn header(first: &Portable, second: &Portable) -> String {
    let mut text = format!(
        "/*\n   Normal contact of the law \"{}\" (first) with the law \"{}\" (second).\n",
        first.name, second.name
    );
    for line in CONVENTIONS.lines() {
        let _ = writeln!(text, "   {line}");
    }
    for law in [first, second] {
        let _ = writeln!(text, "   {}", describe::provenance(law));
    }
    text.push_str(
        "*/\n#ifndef LAW_H\n#define LAW_H\n\n#include \"first.h\"\n#include \"second.h\"\n\n",
    );
    text.push_str(SERIES);
    text.push_str("\n#endif\n");
    let [one, two] = [first, second].map(|law| kernel::number(law.material().contact_modulus()));
    let text = text
        .replace("@MODULUS_1@", &one)
        .replace("@MODULUS_2@", &two);
    named(&text, first, second)
}

/// `text` with the identifiers of both laws and of their contact in the place of `first`, `second` and `law` as names in C.
#[must_use]
pub fn named(text: &str, first: &Portable, second: &Portable) -> String {
    let names = [
        ("law", identifier(first, second)),
        ("first", first.identifier.clone()),
        ("second", second.identifier.clone()),
    ];
    // placeholders first, for an identifier may hold such a word itself
    let mut text = text.to_owned();
    for (word, _) in &names {
        let capital = word.to_uppercase();
        text = text
            .replace(&format!("{word}_"), &format!("@{word}@_"))
            .replace(&format!("{word}.h"), &format!("@{word}@.h"))
            .replace(&format!("{capital}_"), &format!("@{capital}@_"));
    }
    for (word, name) in &names {
        text = text
            .replace(&format!("@{word}@"), name)
            .replace(&format!("@{}@", word.to_uppercase()), &name.to_uppercase());
    }
    text
}
