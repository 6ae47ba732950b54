//! Mesh: triangle meshes from STL and OBJ files and of simple thin-walled shapes, refused before use if they are broken.

mod obj;
mod stl;
mod weld;

use crate::dem::bodies::Solid;
use crate::unit::significant;
use parry3d::math::Vector;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Steps of single precision, in tolerances, from which a shape counts as lost: its corners are known to a fiftieth of
/// the smallest grain radius then, at the usual tolerance.
const LOST: f64 = 20.0;
/// Facets named at most in one message.
const NAMED: usize = 5;

/// Format of a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// STL, ASCII or binary.
    Stl,
    /// Wavefront OBJ.
    Obj,
}

impl Format {
    /// Format by the end of a file's name: OBJ if it says so, else STL.
    ///
    /// ```
    /// use impactlaw::dem::bodies::mesh::Format;
    /// assert_eq!(Format::of("parts/Drum.OBJ"), Format::Obj);
    /// assert_eq!(Format::of("drum.stl"), Format::Stl);
    /// ```
    #[must_use]
    pub fn of(name: &str) -> Self {
        match name.rsplit_once('.') {
            Some((_, end)) if end.eq_ignore_ascii_case("obj") => Format::Obj,
            _ => Format::Stl,
        }
    }
}

/// A mesh from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Import {
    /// The mesh, m.
    pub solid: Solid,
    /// Why its surface is not closed, if it is not.
    pub opening: Option<String>,
    /// What was left out or is doubtful, each as the end of a sentence that starts with the file's name.
    pub warnings: Vec<String>,
}

/// Facets of a file, in its unit and order.
#[derive(Debug, Clone, PartialEq, Default)]
struct Facets {
    corners: Vec<[Vector; 3]>,
    /// Line of each facet, in text files.
    lines: Vec<usize>,
    /// Coordinates are of single precision.
    single: bool,
}

impl Facets {
    /// Adds a facet; zeros lose their sign.
    fn add(&mut self, corners: [Vector; 3], line: Option<usize>) -> Result<(), String> {
        self.corners
            .push(corners.map(|corner| corner + Vector::ZERO));
        self.lines.extend(line);
        if corners.iter().all(|corner| corner.is_finite()) {
            return Ok(());
        }
        Err(format!(
            "has a corner that is no number (facet {}); repair the mesh or export it again",
            self.corners.len()
        ))
    }

    /// Name and place of a facet, in the file's unit.
    fn place(&self, number: usize) -> String {
        let [a, b, c] = self.corners[number];
        let centre = (a + b + c) / 3.0;
        let [x, y, z] = [centre.x, centre.y, centre.z].map(|x| significant(x, 4));
        let line = match self.lines.get(number) {
            Some(line) => format!(" (line {line})"),
            None => String::new(),
        };
        format!("facet {}{line} at ({x}, {y}, {z})", number + 1)
    }

    /// Step of single precision at the largest coordinate, if that is what the file holds.
    fn step(&self) -> Option<[f64; 2]> {
        let corners = self.corners.iter().flatten();
        let largest = corners.fold(0.0f64, |m, corner| m.max(corner.abs().max_element()));
        let exponent = largest.max(f64::from(f32::MIN_POSITIVE)).log2().floor();
        self.single.then(|| {
            [
                largest,
                (exponent - f64::from(f32::MANTISSA_DIGITS) + 1.0).exp2(),
            ]
        })
    }
}

/// A written number that is finite; Fortran's exponents are numbers too.
fn number(word: &str) -> Option<f64> {
    let value = word
        .parse()
        .or_else(|_| word.replace(['d', 'D'], "e").parse());
    value.ok().filter(|value: &f64| value.is_finite())
}

fn plural(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what} was"),
        _ => format!("{count} {what}s were"),
    }
}

/// Reads the bytes of a mesh file whose lengths count `unit` (m). Corners closer than `tolerance` (m) are one.
///
/// # Errors
/// What is wrong with the file, as the end of a sentence that starts with its name.
pub fn read(bytes: &[u8], format: Format, unit: f64, tolerance: f64) -> Result<Import, String> {
    let facets = match format {
        Format::Stl => stl::read(bytes)?,
        Format::Obj => obj::read(bytes)?,
    };
    if facets.corners.is_empty() {
        return Err("holds no triangle; export the body's surface".to_owned());
    }
    let tolerance = tolerance / unit;
    let mut welded = weld::weld(&facets, tolerance);
    let mut warnings = Vec::new();
    if let Some([largest, step]) = facets.step()
        && step > tolerance.max(0.0)
        && tolerance > 0.0
    {
        let what = format!(
            "reaches to {} from its origin, where single precision knows places to {} only, and the tolerance is {} (the file's unit)",
            significant(largest, 4),
            significant(step, 2),
            significant(tolerance, 2)
        );
        if step > LOST * tolerance {
            return Err(format!(
                "{what}: the shape is lost; move the part to its own origin before it is exported, or say which `tolerance` will do"
            ));
        }
        warnings.push(what);
    }
    let name = |at: usize| facets.place(welded.numbers[at]);
    let opening = opening(&welded.triangles, &name);
    welded.drop_lines(&facets);
    if welded.triangles.is_empty() {
        return Err(format!(
            "has no triangle with an area: {}; export the body's surface, and look at `scale` and `tolerance`",
            welded.warnings.join("; ")
        ));
    }
    warnings.extend(welded.warnings);
    let solid = Solid::Mesh {
        vertices: welded.vertices.into_iter().map(|v| v * unit).collect(),
        triangles: welded.triangles,
    };
    // squares of lengths overflow long before lengths do
    if !solid.extent().is_finite() || !solid.reach().is_finite() {
        return Err(
            "reaches too far to be measured; repair the mesh, and look at `scale`".to_owned(),
        );
    }
    Ok(Import {
        solid,
        opening,
        warnings,
    })
}

/// Why a surface is not closed: edges that have not two triangles, or triangles turned the wrong way round, which `name`
/// names; none if it is closed.
#[must_use]
pub fn opening(triangles: &[[u32; 3]], name: &dyn Fn(usize) -> String) -> Option<String> {
    let mut edges: HashMap<[u32; 2], Vec<(usize, bool)>> = HashMap::new();
    let around = |at: usize| {
        let [a, b, c] = triangles[at];
        [[a, b], [b, c], [c, a]].map(|[from, to]| ([from.min(to), from.max(to)], from < to))
    };
    for at in 0..triangles.len() {
        for (edge, upward) in around(at) {
            edges.entry(edge).or_default().push((at, upward));
        }
    }
    let open = edges.values().filter(|sides| sides.len() != 2).count();
    if open > 0 {
        let at_edge = |at: &usize| around(*at).iter().any(|(edge, _)| edges[edge].len() != 2);
        let first = (0..triangles.len()).find(at_edge)?;
        return Some(format!(
            "{open} edges have not exactly two triangles, the first an edge of {}",
            name(first)
        ));
    }
    if edges.values().all(|sides| sides[0].1 != sides[1].1) {
        return None;
    }
    let flipped = flipped(triangles.len(), |at| {
        around(at).map(|(edge, upward)| {
            let sides = &edges[&edge];
            let (other, upward_there) = sides[usize::from(sides[0].0 == at)];
            (other, upward == upward_there)
        })
    });
    let named: Vec<String> = flipped.iter().take(NAMED).map(|&at| name(at)).collect();
    let others = match flipped.len() {
        0 => return Some("its facets cannot all face outwards".to_owned()),
        count if count > NAMED => format!(", and {} more", count - NAMED),
        _ => String::new(),
    };
    let (verb, them) = if flipped.len() == 1 {
        ("is", "it")
    } else {
        ("are", "them")
    };
    Some(format!(
        "{}{others} {verb} flipped, with the inside out; turn {them} round",
        named.join(", ")
    ))
}

/// Triangles that run against most of those they hang together with; `neighbours` tells of each of three edges who is
/// beyond it and whether both run it in the same sense.
fn flipped(count: usize, neighbours: impl Fn(usize) -> [(usize, bool); 3]) -> Vec<usize> {
    let mut sense: Vec<Option<bool>> = vec![None; count];
    let mut flipped = Vec::new();
    for seed in 0..count {
        if sense[seed].is_some() {
            continue;
        }
        sense[seed] = Some(true);
        let mut part = vec![seed];
        let mut next = 0;
        while let Some(&at) = part.get(next) {
            next += 1;
            for (other, alike) in neighbours(at) {
                if sense[other].is_none() {
                    sense[other] = sense[at].map(|own| own != alike);
                    part.push(other);
                }
            }
        }
        let along = part.iter().filter(|&&at| sense[at] == Some(true)).count();
        let fewer = 2 * along < part.len();
        part.retain(|&at| sense[at] == Some(fewer));
        flipped.extend(part);
    }
    flipped.sort_unstable();
    flipped
}

/// Wall of a cone about z that is cut off at both ends: `bottom` and `top` radius (m) at z of -`height`/2 and
/// `height`/2. Equal radii make a tube, no height a ring.
///
/// ```
/// use impactlaw::dem::bodies::{Solid, mesh::cone};
/// let Solid::Mesh { vertices, triangles } = cone(1e-3, 2e-3, 1e-3, 12) else { panic!() };
/// assert_eq!((vertices.len(), triangles.len()), (24, 24));
/// ```
#[must_use]
pub fn cone(bottom: f64, top: f64, height: f64, sides: u32) -> Solid {
    let corner = |radius: f64, z: f64, side: u32| {
        let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
        Vector::new(radius * cos, radius * sin, z)
    };
    let rim = |radius: f64, z: f64| (0..sides).map(move |side| corner(radius, z, side));
    let vertices = rim(bottom, -0.5 * height)
        .chain(rim(top, 0.5 * height))
        .collect();
    let pairs = (0..sides).flat_map(|side| {
        let next = (side + 1) % sides;
        [
            ([side, next, sides + next], bottom),
            ([side, sides + next, sides + side], top),
        ]
    });
    // at a tip one triangle of each pair has no area
    let triangles = pairs
        .filter(|(_, radius)| *radius > 0.0)
        .map(|(triangle, _)| triangle)
        .collect();
    Solid::Mesh {
        vertices,
        triangles,
    }
}
