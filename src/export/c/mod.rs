//! Target `c`: one C99 header with the kernel, its description and a self-test.

pub mod contact;
pub mod kernel;
pub(crate) mod series;

use crate::Result;
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;
use std::fmt::Write;

const SELF_TEST: &str = include_str!("self_test.h");

/// One C99 header.
#[derive(Debug, Clone, Copy)]
pub struct Header;

impl Dialect for Header {
    const NAME: &'static str = "c";
    const PAIR: Option<PairExport> = Some(export_with);
    const OF_PAIRS: bool = true;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        Ok(export(law))
    }
}

/// The header `<identifier>.h`.
#[must_use]
pub fn export(law: &Portable) -> Vec<Artifact> {
    let name = format!("{}.h", law.identifier);
    let text = header(law);
    vec![Artifact { name, text }]
}

/// Headers of two laws and of their contact.
///
/// # Errors
/// As `series::export`.
pub fn export_with(first: &Portable, second: &Portable) -> Result<Vec<Artifact>> {
    let contact = series::export(first, second)?;
    let mut files = export(first);
    files.extend(export(second));
    files.push(contact);
    Ok(files)
}

/// Text of the header.
#[must_use]
pub fn header(law: &Portable) -> String {
    let mut text = comment(law);
    text.push_str(&kernel::named(
        "#ifndef LAW_H\n#define LAW_H\n\n#include <math.h>\n\n",
        law,
    ));
    text.push_str(&kernel::text(law));
    text.push('\n');
    text.push_str(&self_test(law));
    text.push_str("\n#endif\n");
    text
}

/// The description as a comment of C.
#[must_use]
pub fn comment(law: &Portable) -> String {
    let mut text = "/*\n".to_owned();
    for line in describe::lines(law) {
        let line = line.replace("*/", "* /").replace("/*", "/ *");
        let _ = writeln!(text, "{}", format!("   {line}").trim_end());
    }
    text.push_str("*/\n");
    text
}

/// How the self-test presses its bodies: what stands for each word of the template.
type Pressing = [(&'static str, &'static str); 4];

/// Spheres and walls of one material.
const OF_ONE: Pressing = [
    ("@SIDES@", "hit->radius_2 > 0.0 ? 2.0 : 1.0"),
    ("@SHARE@", "share = 0.0, "),
    ("@ALIKE@", "2"),
    (
        "@PRESS@",
        "        if (hit->radius_2 > 0.0)
            p = law_pair(x, hit->radius_1, hit->radius_2, &side_1, &side_2, &share);
        else
            p = law_wall(x, hit->radius_1, &side_1);",
    ),
];

/// The two bodies of a pair.
const OF_PAIR: Pressing = [
    ("@SIDES@", "1.0"),
    ("@SHARE@", ""),
    ("@ALIKE@", "1"),
    (
        "@PRESS@",
        "        p = law_press(x, hit->radius_1, hit->radius_2, &side_1);",
    ),
];

/// Reference impacts compiled in, with a `main` that runs them.
fn self_test(law: &Portable) -> String {
    let mut impacts = String::new();
    for impact in &law.reference.impacts {
        let f = &impact.figures;
        let _ = writeln!(
            impacts,
            "    {{{:e}, {:e}, {:e}, {:e}, {:e}, {:e}, {:e}, {:e}, {:e}}},",
            impact.radii[0],
            impact.radii[1],
            impact.mass,
            impact.velocity,
            f.restitution,
            f.max_force,
            f.max_displacement,
            f.residual_displacement,
            f.contact_time
        );
    }
    let mut points = String::new();
    for point in &law.reference.trajectory {
        let _ = writeln!(points, "    {{{:e}, {:e}}},", point.time, point.flattening);
    }
    let pressing = match law.pair() {
        None => OF_ONE,
        Some(_) => OF_PAIR,
    };
    let template = SELF_TEST.to_owned();
    let template = (pressing.iter()).fold(template, |text, (word, with)| text.replace(word, with));
    let filled = template
        .replace("LAW_IMPACT_ROWS\n", &impacts)
        .replace("LAW_TRAJECTORY_ROWS\n", &points);
    kernel::named(&filled, law).replace("@FILE@", &format!("{}.h", law.identifier))
}
