//! VTP: points of VTK XML poly data with their values, as this program and ParaView write them, uncompressed.

use super::columns::Columns;
use super::text::short;
use super::{Listing, Meaning};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// An array of a file: name, numbers in a tuple, values.
struct Array {
    name: String,
    components: usize,
    values: Vec<f64>,
}

pub(super) fn read(bytes: &[u8], meaning: &Meaning) -> Result<Listing, String> {
    let text = super::text::text(bytes)
        .map_err(|_| "has raw bytes behind its text; save it as ASCII or as binary (base64) arrays, uncompressed".to_owned())?;
    let head = element(&text, "VTKFile")
        .ok_or("is no VTK file: it has no `<VTKFile>`")?
        .0;
    if attribute(head, "type") != Some("PolyData") {
        let kind = attribute(head, "type").unwrap_or("nothing");
        return Err(format!(
            "is VTK of the type `{}`; must be PolyData",
            short(kind)
        ));
    }
    if attribute(head, "compressor").is_some() || text.contains("<AppendedData") {
        return Err(
            "is compressed or appended VTK; save it as ASCII or as binary (base64) arrays, uncompressed"
                .to_owned(),
        );
    }
    if attribute(head, "byte_order") == Some("BigEndian") {
        return Err(
            "is big-endian VTK; save it on a little-endian machine, or as ASCII".to_owned(),
        );
    }
    let wide = attribute(head, "header_type") == Some("UInt64");
    if text.matches("<Piece").count() > 1 {
        return Err("has several pieces; save it as one".to_owned());
    }
    let section = |name: &str| element(&text, name).map_or("", |(_, inside)| inside);
    let mut all = arrays(section("Points"), wide)?;
    let Some(points) = all.first_mut() else {
        return Err("has no points".to_owned());
    };
    points.name = "points".to_owned();
    let count = points.values.len() / 3;
    if points.components != 3 {
        return Err(format!(
            "has points of {} coordinates; must be 3",
            points.components
        ));
    }
    all.extend(arrays(section("PointData"), wide)?);
    let mut names = Vec::new();
    for array in &all {
        if array.values.len() != count * array.components {
            return Err(format!(
                "has {} values in `{}`; must be {} for each of {count} points",
                array.values.len(),
                short(&array.name),
                array.components
            ));
        }
        match array.components {
            1 => names.push(array.name.clone()),
            _ => names.extend((0..array.components).map(|k| format!("{}:{k}", array.name))),
        }
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut listing = Listing::default();
    let columns = Columns::new(&names, meaning, None, &mut listing)?;
    for point in 0..count {
        // shortest digits read back bit for bit
        let words: Vec<String> = all
            .iter()
            .flat_map(|array| {
                let first = point * array.components;
                array.values[first..first + array.components].iter()
            })
            .map(|value| format!("{value:e}"))
            .collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let grain = columns
            .grain(&words, point + 1, &mut listing)
            .map_err(|wrong| wrong.replacen("line", "point", 1))?;
        listing.grains.push(grain);
    }
    Ok(listing)
}

/// Attributes and inside of the first element of a name.
fn element<'a>(text: &'a str, name: &str) -> Option<(&'a str, &'a str)> {
    let open = format!("<{name}");
    let mut from = 0;
    loop {
        let at = from + text[from..].find(&open)?;
        let rest = &text[at + open.len()..];
        // `<Points` is not `<PointsOfSomething`
        if rest.starts_with(|c: char| c.is_alphanumeric()) {
            from = at + open.len();
            continue;
        }
        let (attributes, inside) = rest.split_once('>')?;
        if attributes.ends_with('/') {
            return Some((attributes, ""));
        }
        let inside = inside
            .split(&format!("</{name}>"))
            .next()
            .unwrap_or_default();
        return Some((attributes, inside));
    }
}

/// Value of an attribute.
fn attribute<'a>(attributes: &'a str, name: &str) -> Option<&'a str> {
    let start = format!(" {name}=\"");
    let text = attributes.split_once(&start)?.1;
    text.split_once('"').map(|(value, _)| value)
}

/// Arrays of a section.
fn arrays(section: &str, wide: bool) -> Result<Vec<Array>, String> {
    let mut found = Vec::new();
    let mut rest = section;
    while let Some(at) = rest.find("<DataArray") {
        rest = &rest[at..];
        let Some((attributes, inside)) = element(rest, "DataArray") else {
            return Err("has an array that does not end; the file is cut off".to_owned());
        };
        // the space before the first attribute, whatever it was
        let attributes = format!(
            " {}",
            attributes.split_whitespace().collect::<Vec<_>>().join(" ")
        );
        let name = attribute(&attributes, "Name")
            .unwrap_or_default()
            .to_owned();
        let components = attribute(&attributes, "NumberOfComponents").unwrap_or("1");
        let components = components.parse().ok().filter(|count| *count > 0);
        let kind = attribute(&attributes, "type").unwrap_or_default();
        let values = match attribute(&attributes, "format").unwrap_or("ascii") {
            "ascii" => ascii(inside, &name)?,
            "binary" => binary(inside, kind, wide, &name)?,
            other => {
                return Err(format!(
                    "has the array `{}` in the format `{}`; must be ascii or binary",
                    short(&name),
                    short(other)
                ));
            }
        };
        found.push(Array {
            components: components
                .ok_or_else(|| format!("has no number of components for `{}`", short(&name)))?,
            name,
            values,
        });
        rest = &rest["<DataArray".len()..];
    }
    Ok(found)
}

fn ascii(inside: &str, name: &str) -> Result<Vec<f64>, String> {
    let value = |word: &str| {
        word.parse().map_err(|_| {
            format!(
                "has `{}` in the array `{}`; must be numbers",
                short(word),
                short(name)
            )
        })
    };
    inside.split_whitespace().map(value).collect()
}

fn binary(inside: &str, kind: &str, wide: bool, name: &str) -> Result<Vec<f64>, String> {
    let broken = |why: &str| format!("has the array `{}` {why}", short(name));
    let text: String = inside.split_whitespace().collect();
    let bytes = STANDARD
        .decode(text)
        .map_err(|_| broken("that is no base64; the file is damaged"))?;
    let head = if wide { 8 } else { 4 };
    let Some((length, data)) = bytes.split_at_checked(head) else {
        return Err(broken("without its length; the file is cut off"));
    };
    let mut number = [0; 8];
    number[..head].copy_from_slice(length);
    let length = u64::from_le_bytes(number);
    if length != data.len() as u64 {
        return Err(broken(&format!(
            "of {} bytes, and its head announces {length}",
            data.len()
        )));
    }
    macro_rules! numbers {
        ($kind:ty) => {
            data.chunks_exact(size_of::<$kind>())
                .map(|bytes| {
                    bytes
                        .try_into()
                        .map_or(f64::NAN, |b| <$kind>::from_le_bytes(b) as f64)
                })
                .collect()
        };
    }
    Ok(match kind {
        "Float64" => numbers!(f64),
        "Float32" => numbers!(f32),
        "Int8" => numbers!(i8),
        "UInt8" => numbers!(u8),
        "Int16" => numbers!(i16),
        "UInt16" => numbers!(u16),
        "Int32" => numbers!(i32),
        "UInt32" => numbers!(u32),
        "Int64" => numbers!(i64),
        "UInt64" => numbers!(u64),
        other => {
            return Err(broken(&format!(
                "of the type `{}`, which is not known",
                short(other)
            )));
        }
    })
}
