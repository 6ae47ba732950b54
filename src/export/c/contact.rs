//! Contact as text: friction, rolling resistance and damping around the C kernel, as a bed has them, and what every file
//! built on it says of itself.

use super::kernel;
use crate::export::c;
use crate::export::source::artifact::Artifact;
use crate::export::source::portable::Portable;

const CONTACT: &str = include_str!("contact.h");

/// Steps of an impact from touch to loss of contact in the example inputs.
const STEPS_PER_IMPACT: f64 = 20_000.0;

/// The kernel and the contact around it, `folder/<identifier>.h` and `folder/<identifier>_contact.h`.
#[must_use]
pub fn headers(law: &Portable, folder: &str) -> Vec<Artifact> {
    let identifier = &law.identifier;
    vec![
        Artifact {
            name: format!("{folder}/{identifier}.h"),
            text: c::header(law),
        },
        Artifact {
            name: format!("{folder}/{identifier}_contact.h"),
            text: filled(CONTACT, law),
        },
    ]
}

/// `template` with the law's names and numbers in it.
///
/// `law_` and `LAW_` stand for the identifier as in the kernel; words between `@` for the rest.
#[must_use]
pub fn filled(template: &str, law: &Portable) -> String {
    let material = law.material();
    let impact = &law.reference.impacts[1];
    let dt = impact.figures.contact_time / STEPS_PER_IMPACT;
    let words = [
        ("@HEADER@", notice(law)),
        ("@NAME@", law.identifier.clone()),
        ("@CLASS@", class(&law.identifier)),
        ("@DENSITY@", kernel::number(material.density)),
        ("@YOUNG@", kernel::number(material.young_modulus)),
        ("@POISSON@", kernel::number(material.poisson_ratio)),
        ("@SHEAR@", kernel::number(shear(law))),
        ("@RADIUS@", kernel::number(law.radius())),
        ("@SPEED@", kernel::number(impact.velocity)),
        ("@DT@", format!("{dt:.3e}")),
        ("@STEPS@", format!("{:.0}", 1.2 * STEPS_PER_IMPACT)),
        ("@SUGGESTED@", format!("{:.3e}", law.time_step())),
    ];
    words
        .iter()
        .fold(kernel::named(template, law), |text, (word, value)| {
            text.replace(word, value)
        })
}

/// $8 G/(2 - \nu)$ of the law's material, Pa: stiffness of Mindlin's spring over the contact radius, one side.
pub(in crate::export) fn shear(law: &Portable) -> f64 {
    let material = law.material();
    8.0 * material.shear_modulus() / (2.0 - material.poisson_ratio)
}

/// The identifier as a name of a class.
pub(in crate::export) fn class(identifier: &str) -> String {
    identifier
        .split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            let first = letters.next().map(|c| c.to_ascii_uppercase());
            first.into_iter().chain(letters)
        })
        .collect()
}

/// First lines of a source file: what it is, where it is described, and the licence that binds what is built from it.
fn notice(law: &Portable) -> String {
    format!(
        "/* Contact law \"{}\", exported by {} (law file sha256 {}).\n   \
         Described in {}.h: equations, units, conventions, valid range, reference impacts.\n   \
         Licence of this file: MIT or Apache-2.0. What is built from it with headers under the GPL is under the GPL. */",
        law.name,
        crate::PROGRAM,
        law.hash,
        law.identifier
    )
}

#[cfg(test)]
mod tests {
    use super::class;

    #[test]
    fn classes_are_named_after_the_law() {
        assert_eq!(class("sac305_solder"), "Sac305Solder");
        assert_eq!(class("law_304__steel"), "Law304Steel");
    }
}
