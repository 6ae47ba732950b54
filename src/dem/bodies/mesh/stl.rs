//! STL: triangles of a file in any dialect of the format, binary or ASCII, or the reason why it cannot be read.
//!
//! The format was never standardized; what is read here is what programs write: several solids in one file, solids
//! without a name or without a triangle, keywords in any case, `end loop` in two words, any line ends, a byte-order
//! mark, normals that are no number, and binary headers that begin like ASCII files. Normals and attributes are not used.

use super::Facets;
use parry3d::math::Vector;

/// Bytes before the count of triangles of a binary file, with the count, and of each triangle.
const HEADER: usize = 84;
const FACET: usize = 50;

/// Beginnings of files of other kinds that are given out as STL, and what to do with them.
const OTHERS: [(&[u8], &str); 7] = [
    (b"PK\x03\x04", "a ZIP archive (3MF?); unpack it"),
    (b"\x1f\x8b", "compressed by gzip; unpack it"),
    (b"ISO-10303-21", "a STEP file; export it as STL"),
    (b"ply", "a PLY file; export it as STL"),
    (b"OFF", "an OFF file; export it as STL"),
    (b"glTF", "a glTF file; export it as STL"),
    (b"Kaydara FBX", "an FBX file; export it as STL"),
];

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, as the end of a sentence that starts with the file's name.
pub(super) fn read(bytes: &[u8]) -> Result<Facets, String> {
    if bytes.is_empty() {
        return Err("is empty; export the body's surface".to_owned());
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err("is UTF-16 text; save it as plain ASCII or as binary STL".to_owned());
    }
    // the length decides: text in the place of the count would mean gigabytes
    if binary_length(bytes).is_some_and(|length| length <= bytes.len()) {
        return binary(bytes);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let first = text.trim_ascii_start();
    if let Some((_, what)) = OTHERS.iter().find(|(begin, _)| first.starts_with(begin)) {
        return Err(format!("is no STL file, but {what}"));
    }
    // some programs fill the last block of a text with zero bytes
    let end = text
        .iter()
        .rposition(|byte| *byte != 0)
        .map_or(0, |last| last + 1);
    let text = &text[..end];
    let solid = first
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if solid && !text.contains(&0) {
        return ascii(text);
    }
    Err(match binary_length(bytes) {
        None if bytes.contains(&0) => format!(
            "is no STL file: it is cut off after {} bytes, before its count of triangles; export it again",
            bytes.len()
        ),
        Some(length) if bytes.contains(&0) => format!(
            "is cut off: it declares {} triangles ({length} bytes) and has {} bytes; export it again",
            (length - HEADER) / FACET,
            bytes.len()
        ),
        _ => format!(
            "is no STL file: it begins with \"{}\" and not with `solid`, and its length is not that of a binary file; export it again",
            String::from_utf8_lossy(&first[..first.len().min(20)]).escape_default()
        ),
    })
}

/// Length of the binary solid that `bytes` begin with, as its count of triangles says.
fn binary_length(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]);
    Some(HEADER + FACET * count as usize)
}

/// Binary solids, one after the other.
fn binary(mut bytes: &[u8]) -> Result<Facets, String> {
    let mut facets = Facets {
        single: true,
        ..Facets::default()
    };
    while let Some(length) = binary_length(bytes).filter(|length| *length <= bytes.len()) {
        let (solid, rest) = bytes.split_at(length);
        for facet in solid[HEADER..].chunks_exact(FACET) {
            let number = |at: usize| {
                let bytes = &facet[12 + 4 * at..16 + 4 * at];
                f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
            };
            let corner = |at: usize| Vector::new(number(at), number(at + 1), number(at + 2));
            facets.add([corner(0), corner(3), corner(6)], None)?;
        }
        if rest
            .iter()
            .all(|byte| *byte == 0 || byte.is_ascii_whitespace())
        {
            return Ok(facets);
        }
        bytes = rest;
    }
    Err(format!(
        "has {} bytes more than its count of {} triangles says; export it again",
        bytes.len(),
        facets.corners.len()
    ))
}

/// Words of an ASCII file with the number of their line, from 1.
struct Words<'a> {
    list: Vec<(usize, &'a str)>,
    at: usize,
}

impl<'a> Words<'a> {
    fn of(text: &'a str) -> Self {
        let text_lines = text
            .split('\n')
            .flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
        let mut list = Vec::new();
        for (index, line) in text_lines.enumerate() {
            let first = list.len();
            list.extend(line.split_whitespace().map(|word| (index + 1, word)));
            let is = |at: usize, word: &str| {
                list.get(first + at)
                    .is_some_and(|(_, w)| w.eq_ignore_ascii_case(word))
            };
            let named = if is(0, "solid") || is(0, "endsolid") {
                1
            } else if is(0, "end") && is(1, "solid") {
                2
            } else {
                continue;
            };
            // the rest of the line is a name, unless the whole file stands in one line
            let facet = (first + named..list.len()).find(|&at| {
                let word = |at: usize| list.get(at).map_or("", |(_, word)| *word);
                let normal = word(at + 1).eq_ignore_ascii_case("normal");
                let number = word(at + 2).parse::<f64>().is_ok();
                word(at).eq_ignore_ascii_case("facet") && normal && number
            });
            let ends = facet.unwrap_or(list.len());
            list.drain(first + named..ends);
        }
        Self { list, at: 0 }
    }

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let word = self.list.get(self.at).copied();
        self.at += usize::from(word.is_some());
        word
    }

    fn is(&self, word: &str) -> bool {
        self.list
            .get(self.at)
            .is_some_and(|(_, next)| next.eq_ignore_ascii_case(word))
    }

    /// Passes `end` `what` or `endwhat`.
    fn passes_end(&mut self, what: &str) -> bool {
        let one = self
            .list
            .get(self.at)
            .is_some_and(|(_, next)| next.eq_ignore_ascii_case(&format!("end{what}")));
        let next = self.list.get(self.at + 1);
        let two = self.is("end") && next.is_some_and(|(_, next)| next.eq_ignore_ascii_case(what));
        self.at += usize::from(one) + 2 * usize::from(two);
        one || two
    }

    /// Passes the name behind an `endsolid`, where it has not been left out yet: in a file that stands in one line.
    fn pass_name(&mut self) {
        let line = self.at.checked_sub(1).map(|before| self.list[before].0);
        let is_name =
            |next: &(usize, &str)| Some(next.0) == line && !next.1.eq_ignore_ascii_case("solid");
        while self.list.get(self.at).is_some_and(is_name) {
            self.at += 1;
        }
    }

    /// Passes `word`.
    fn passes(&mut self, word: &str) -> bool {
        let is = self.is(word);
        self.at += usize::from(is);
        is
    }

    /// That `wanted` is not what comes next.
    fn unlike(&self, wanted: &str, facets: &Facets) -> String {
        // a word that ends too early is where the file ends, too
        let begins = |found: &str| {
            wanted
                .split('`')
                .any(|word| word != found && word.starts_with(found))
        };
        let is_last = self.at + 1 == self.list.len();
        match self.list.get(self.at) {
            Some((_, found)) if is_last && begins(found) => format!(
                "is cut off after {} triangles, within `{found}`; export it again",
                facets.corners.len()
            ),
            None => format!(
                "is cut off after {} triangles: it ends where {wanted} is to come; export it again",
                facets.corners.len()
            ),
            Some((line, found)) => format!(
                "has `{found}` in line {line} where {wanted} is to come (triangle {}); export it again",
                facets.corners.len() + 1
            ),
        }
    }
}

fn ascii(bytes: &[u8]) -> Result<Facets, String> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = Words::of(&text);
    let mut facets = Facets::default();
    while words.passes("solid") {
        while !words.passes_end("solid") {
            if !words.passes("facet") {
                return Err(words.unlike("`facet` or `endsolid`", &facets));
            }
            ascii_facet(&mut words, &mut facets)?;
        }
        words.pass_name();
    }
    match words.next() {
        None => Ok(facets),
        Some((line, found)) => Err(format!(
            "has `{found}` in line {line} where `solid` or the end of the file is to come; export it again"
        )),
    }
}

/// One triangle, after the word `facet`.
fn ascii_facet(words: &mut Words, facets: &mut Facets) -> Result<(), String> {
    let (line, _) = words.list[words.at - 1];
    if words.passes("normal") {
        // three numbers or none; some programs write words for what is no number
        while !(words.is("outer") || words.is("facet") || words.at == words.list.len()) {
            words.at += 1;
        }
    }
    if !(words.passes("outer") && words.passes("loop")) {
        return Err(words.unlike("`outer loop`", facets));
    }
    let mut corners = Vec::with_capacity(3);
    while words.passes("vertex") {
        let mut corner = [0.0; 3];
        for value in &mut corner {
            let Some((at, word)) = words.next() else {
                return Err(words.unlike("a number", facets));
            };
            *value = super::number(word).ok_or_else(|| {
                format!("has a corner that is no number (`{word}` in line {at}); repair the mesh or export it again")
            })?;
        }
        corners.push(Vector::from(corner));
    }
    if !words.passes_end("loop") {
        return Err(words.unlike("`endloop`", facets));
    }
    if !words.passes_end("facet") {
        return Err(words.unlike("`endfacet`", facets));
    }
    let count = corners.len();
    let corners = <[Vector; 3]>::try_from(corners).map_err(|_| {
        format!("has a facet of {count} corners (line {line}); export triangles, of 3 corners each")
    })?;
    facets.add(corners, Some(line))
}
