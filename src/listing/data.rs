//! Data files of LAMMPS: atoms of the style sphere, which LIGGGHTS calls granular too.

use super::columns::velocity_wanted;
use super::text::{count, number, short, text};
use super::{Listed, Listing, Meaning};
use std::collections::HashMap;

/// Columns of an atom, and of its velocity.
const ATOM: [&str; 7] = ["id", "type", "diameter", "density", "x", "y", "z"];
const MOTION: [&str; 7] = ["id", "vx", "vy", "vz", "omegax", "omegay", "omegaz"];
/// Sections whose lines say nothing about grains.
const IDLE: [&str; 4] = ["Masses", "Pair Coeffs", "PairIJ Coeffs", "Atom Type Labels"];

#[derive(Clone, Copy, PartialEq)]
enum Section {
    Head,
    Atoms,
    Velocities,
    Idle,
}

pub(super) fn read(bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
    let text = text(bytes)?;
    let mut listing = Listing {
        counts_from: 1,
        ..Listing::default()
    };
    let (mut section, mut announced) = (Section::Head, None);
    let mut names: HashMap<&str, usize> = HashMap::new();
    // the first line is a title, whatever it says
    for (index, whole) in text.lines().enumerate().skip(1) {
        let at = index + 1;
        let (line, comment) = whole.split_once('#').unwrap_or((whole, ""));
        let line = line.trim();
        if line.is_empty() {
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        if line.starts_with(char::is_alphabetic) && (section == Section::Head || is_heading(line)) {
            section = heading(line, comment.trim(), at)?;
            continue;
        }
        match section {
            Section::Idle => {}
            Section::Head => {
                if words.get(1) == Some(&"atoms") && words.len() == 2 {
                    announced = Some(count(words[0], "the number of atoms", at)?);
                } else if words.contains(&"xy")
                    && words[..3].iter().any(|w| *w != "0" && *w != "0.0")
                {
                    return Err(format!(
                        "line {at}: found a box that is tilted; must be a box with right angles"
                    ));
                }
            }
            Section::Atoms => {
                let grain = atom(&words, at, meaning, &mut listing)?;
                if names.insert(words[0], listing.grains.len()).is_some() {
                    return Err(format!(
                        "line {at}: found the atom {} again; must be there once",
                        short(words[0])
                    ));
                }
                listing.grains.push(grain);
            }
            Section::Velocities => {
                let Some(&grain) = names.get(words[0]) else {
                    return Err(format!(
                        "line {at}: found a velocity of {}; must be of an atom of the file, listed before",
                        short(words[0])
                    ));
                };
                set_motion(&mut listing.grains[grain], &words, at, meaning)?;
            }
        }
    }
    match announced {
        None => Err("has no line `N atoms`; name a LAMMPS data file".to_owned()),
        Some(announced) if announced != listing.grains.len() => Err(format!(
            "has {} atoms; must be the {announced} that its head announces",
            listing.grains.len()
        )),
        Some(_) => Ok(listing),
    }
}

fn is_heading(line: &str) -> bool {
    let headings = [
        "Atoms",
        "Velocities",
        "Ellipsoids",
        "Lines",
        "Triangles",
        "Bodies",
        "Bonds",
    ];
    headings.contains(&line) || IDLE.contains(&line)
}

/// The section a heading begins; the style of the atoms stands behind it.
fn heading(line: &str, comment: &str, at: usize) -> Result<Section, String> {
    match line {
        "Atoms" if ["", "sphere", "granular"].contains(&comment) => Ok(Section::Atoms),
        "Atoms" => Err(format!(
            "line {at}: found atoms of the style `{}`; must be `sphere` (`granular`)",
            short(comment)
        )),
        "Velocities" => Ok(Section::Velocities),
        _ if IDLE.contains(&line) => Ok(Section::Idle),
        _ => Err(format!(
            "line {at}: found the section `{}`; must be one of Atoms, Velocities, {}",
            short(line),
            IDLE.join(", ")
        )),
    }
}

fn width(words: &[&str], names: &[&str], more: usize, at: usize) -> Result<(), String> {
    if words.len() == names.len() || words.len() == names.len() + more {
        return Ok(());
    }
    Err(format!(
        "line {at}: found {} values; must be {}: {}",
        words.len(),
        names.len(),
        names.join(" ")
    ))
}

fn atom(
    words: &[&str],
    at: usize,
    meaning: &Meaning,
    listing: &mut Listing,
) -> Result<Listed, String> {
    // three counts of periods gone through may follow
    width(words, &ATOM, 3, at)?;
    let value = |column: usize| number(words[column], ATOM[column], at);
    let positive = |column: usize| match value(column)? {
        value if value > 0.0 => Ok(value),
        _ => Err(format!(
            "line {at}: found `{}` for `{}`; must be above 0",
            words[column], ATOM[column]
        )),
    };
    let length = meaning.length();
    let density = positive(3)?;
    let mut grain = Listed {
        at,
        radius: Some(0.5 * length * positive(2)?),
        kind: Some(listing.kind(words[1])),
        density: meaning.is_si().then_some(density),
        ..Listed::default()
    };
    for axis in 0..3 {
        grain.centre[axis] = length * value(4 + axis)?;
    }
    Ok(grain)
}

fn set_motion(
    grain: &mut Listed,
    words: &[&str],
    at: usize,
    meaning: &Meaning,
) -> Result<(), String> {
    width(words, &MOTION, 0, at)?;
    let velocity = meaning.velocity().ok_or_else(|| velocity_wanted("vx"))?;
    for axis in 0..3 {
        let value = |column: usize| number(words[column], MOTION[column], at);
        grain.velocity[axis] = velocity * value(1 + axis)?;
        grain.spin[axis] = velocity / meaning.length() * value(4 + axis)?;
    }
    Ok(())
}
