//! Dumps: LAMMPS' `dump custom` as text, one frame or several.

use super::columns::Columns;
use super::text::{count, number, short, text};
use super::{Listing, Meaning};
use parry3d::math::Vector;

/// Where a frame stands in the lines of the file.
struct Frame<'a> {
    /// Corners of the box: lowest, and edges.
    block: Option<[Vector; 2]>,
    /// Names of the columns.
    names: Vec<&'a str>,
    /// Index of the first grain's line.
    first: usize,
    grains: usize,
}

pub(super) fn read(bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
    let text = text(bytes)?;
    let lines: Vec<&str> = text.lines().collect();
    let frames = frames(&lines)?;
    let chosen = match meaning.frame {
        None => frames.last(),
        Some(number) => match number.checked_sub(1).and_then(|index| frames.get(index)) {
            None => {
                return Err(format!(
                    "has {} frames; `frame` must be one of 1 to {}",
                    frames.len(),
                    frames.len()
                ));
            }
            some => some,
        },
    };
    let Some(frame) = chosen else {
        return Err("has no frame: a LAMMPS dump begins with `ITEM: TIMESTEP`".to_owned());
    };
    let mut listing = Listing::default();
    let columns = Columns::new(&frame.names, meaning, frame.block, &mut listing)?;
    for (index, line) in lines
        .iter()
        .enumerate()
        .skip(frame.first)
        .take(frame.grains)
    {
        let words: Vec<&str> = line.split_whitespace().collect();
        let grain = columns.grain(&words, index + 1, &mut listing)?;
        listing.grains.push(grain);
    }
    Ok(listing)
}

/// All frames, their grains not looked at yet.
fn frames<'a>(lines: &[&'a str]) -> Result<Vec<Frame<'a>>, String> {
    let mut frames = Vec::new();
    let (mut at, mut grains, mut block) = (0, None, None);
    while let Some(line) = lines.get(at) {
        if line.trim().is_empty() {
            at += 1;
            continue;
        }
        let Some(item) = line.trim_start().strip_prefix("ITEM:") else {
            return Err(format!(
                "line {}: found `{}`; must be an `ITEM:` of a LAMMPS dump",
                at + 1,
                short(line)
            ));
        };
        let mut words = item.split_whitespace();
        let next = |more: usize| {
            lines.get(at + more).copied().ok_or_else(|| {
                format!(
                    "line {}: ends within `{}`; the file is cut off",
                    at + 1,
                    line.trim()
                )
            })
        };
        match words.next().unwrap_or_default() {
            "TIMESTEP" | "TIME" | "UNITS" => at += 2,
            "NUMBER" => {
                grains = Some(count(next(1)?.trim(), "the number of atoms", at + 2)?);
                at += 2;
            }
            "BOX" => {
                let sides = [next(1)?, next(2)?, next(3)?];
                block = Some(corners(sides, at + 2)?);
                at += 4;
            }
            "ATOMS" => {
                let Some(count) = grains.take() else {
                    return Err(format!(
                        "line {}: found `ITEM: ATOMS` before `ITEM: NUMBER OF ATOMS`",
                        at + 1
                    ));
                };
                let first = at + 1;
                let there = lines.iter().skip(first).take(count);
                let there = there.take_while(|line| !line.starts_with("ITEM:"));
                let there = there.filter(|line| !line.trim().is_empty()).count();
                if there < count {
                    return Err(format!(
                        "line {}: found {there} atoms; must be the {count} that the frame announces: the file is cut off",
                        at + 1
                    ));
                }
                frames.push(Frame {
                    block: block.take(),
                    names: words.collect(),
                    first,
                    grains: count,
                });
                at = first + count;
            }
            other => {
                return Err(format!(
                    "line {}: found `ITEM: {}`; must be TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS or ATOMS",
                    at + 1,
                    short(other)
                ));
            }
        }
    }
    Ok(frames)
}

/// Lowest corner and edges of a box from its three lines, the first of which is number `line`.
fn corners(sides: [&str; 3], line: usize) -> Result<[Vector; 2], String> {
    let (mut low, mut edges) = (Vector::ZERO, Vector::ZERO);
    for (axis, side) in sides.iter().enumerate() {
        let words: Vec<&str> = side.split_whitespace().collect();
        let at = line + axis;
        let (Some(from), Some(to)) = (words.first(), words.get(1)) else {
            return Err(format!(
                "line {at}: found `{}`; must be the two bounds of the box",
                short(side)
            ));
        };
        low[axis] = number(from, "the lower bound", at)?;
        edges[axis] = number(to, "the upper bound", at)? - low[axis];
        for tilt in words.iter().skip(2) {
            if number(tilt, "the tilt of the box", at)? != 0.0 {
                return Err(format!(
                    "line {at}: found a box that is tilted by {tilt}; must be a box with right angles"
                ));
            }
        }
    }
    Ok([low, edges])
}
