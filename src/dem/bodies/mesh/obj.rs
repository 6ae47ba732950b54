//! OBJ: facets of a Wavefront file, polygons cut into triangles; colours, textures and names are not used.

use super::Facets;
use parry3d::math::Vector;

/// What says nothing about the surface.
const IDLE: [&str; 15] = [
    "vn",
    "vt",
    "vp",
    "o",
    "g",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "l",
    "p",
    "lod",
    "usemap",
    "shadow_obj",
    "trace_obj",
];

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, as the end of a sentence that starts with the file's name.
pub(super) fn read(bytes: &[u8]) -> Result<Facets, String> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&0) {
        return Err("is no OBJ file, which is text; export it again".to_owned());
    }
    let text = String::from_utf8_lossy(bytes)
        .replace("\r\n", "\n")
        .replace('\r', "\n")
        .replace("\\\n", " ");
    let mut corners: Vec<Vector> = Vec::new();
    let mut facets = Facets::default();
    for (index, line) in text.lines().enumerate() {
        let line_number = index + 1;
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        match words.next() {
            None => {}
            Some("v") => {
                let mut corner = [0.0; 3];
                for value in &mut corner {
                    let word = words.next().unwrap_or("nothing");
                    *value = super::number(word).ok_or_else(|| {
                        format!("has a corner that is no number (`{word}` in line {line_number}); repair the mesh or export it again")
                    })?;
                }
                corners.push(Vector::from(corner));
            }
            Some("f") => {
                let polygon: Vec<Vector> = words
                    .map(|word| corner_of(word, &corners, line_number))
                    .collect::<Result<_, _>>()?;
                cut(&polygon, line_number, &mut facets)?;
            }
            Some(word) if IDLE.contains(&word) => {}
            Some(word) => {
                return Err(format!(
                    "has `{word}` in line {line_number}, which is no corner and no facet; export it as polygons"
                ));
            }
        }
    }
    Ok(facets)
}

/// Corner a word of a facet stands for: `7`, `7/1`, `7//2` or `-1`, the last one so far.
fn corner_of(word: &str, corners: &[Vector], line: usize) -> Result<Vector, String> {
    let index = word.split('/').next().unwrap_or_default();
    let at = match index.parse::<i64>() {
        Ok(index) if index > 0 => usize::try_from(index - 1).ok(),
        Ok(index) if index < 0 => usize::try_from(index.unsigned_abs())
            .ok()
            .and_then(|back| corners.len().checked_sub(back)),
        _ => None,
    };
    at.and_then(|at| corners.get(at)).copied().ok_or_else(|| {
        format!(
            "names corner `{word}` in line {line}, and {} corners stand before it; export it again",
            corners.len()
        )
    })
}

/// Cuts a convex polygon into triangles that share its first corner.
fn cut(polygon: &[Vector], line: usize, facets: &mut Facets) -> Result<(), String> {
    let count = polygon.len();
    if count < 3 {
        return Err(format!(
            "has a facet of {count} corners (line {line}); repair the mesh"
        ));
    }
    if count > 3 {
        let turn = |at: usize| {
            let [a, b, c] = [at, at + 1, at + 2].map(|at| polygon[at % count]);
            (b - a).cross(c - b)
        };
        let normal: Vector = (0..count)
            .map(|at| (polygon[at] - polygon[0]).cross(polygon[(at + 1) % count] - polygon[0]))
            .sum();
        if (0..count).any(|at| turn(at).dot(normal) < 0.0) {
            return Err(format!(
                "has a facet that is not convex (line {line}); export triangles"
            ));
        }
    }
    for at in 1..count - 1 {
        facets.add([polygon[0], polygon[at], polygon[at + 1]], Some(line))?;
    }
    Ok(())
}
