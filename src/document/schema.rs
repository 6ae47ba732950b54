//! Schema: the keys of a file as JSON schema (draft 7), for editors that check TOML while it is written.

use super::keys::{Key, Kind, Table};
use crate::unit::Units;
use serde_json::{Map, Value, json};

/// JSON schema of a file whose keys are these.
#[must_use]
pub fn schema(title: &str, about: &str, root: &Table) -> Value {
    let mut quantities = Map::new();
    let mut schema = of_table(root, None, &mut quantities);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(format!("impactlaw {title} file"));
    schema["description"] = json!(about);
    schema["definitions"] = Value::Object(quantities);
    schema
}

fn of_table(
    table: &Table,
    chosen: Option<(&str, &str)>,
    quantities: &mut Map<String, Value>,
) -> Value {
    let mut properties = Map::new();
    let mut required: Vec<&str> = Vec::new();
    if let Some((tag, name)) = chosen {
        properties.insert(tag.to_owned(), json!({ "const": name }));
        required.push(tag);
    }
    for key in &table.keys {
        properties.insert(key.name.clone(), of_key(key, quantities));
        if key.line.default.is_none() {
            required.push(&key.name);
        }
    }
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

fn of_key(key: &Key, quantities: &mut Map<String, Value>) -> Value {
    let mut schema = of_kind(&key.kind, key.line.range, quantities);
    schema["description"] = json!(super::reference::sentence(key));
    schema
}

fn of_kind(kind: &Kind, range: &str, quantities: &mut Map<String, Value>) -> Value {
    match kind {
        Kind::Number => bounded("number", range),
        Kind::Whole => bounded("integer", range),
        Kind::Truth => json!({ "type": "boolean" }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Name(names) => json!({ "enum": names }),
        Kind::Quantity(units) => {
            let negative = !range.starts_with('>') && !range.starts_with('≥');
            // a part of an address, in which a blank is an error: taplo refuses the whole schema for one
            let mut name = units.noun().replace(' ', "-");
            if !negative {
                name.push_str("-not-negative");
            }
            let reference = format!("#/definitions/{name}");
            quantities
                .entry(name)
                .or_insert_with(|| of_quantity(units, negative));
            json!({ "allOf": [{ "$ref": reference }] })
        }
        Kind::List(item) => json!({ "type": "array", "items": of_kind(item, range, quantities) }),
        Kind::Array(length, item) => {
            let item = of_kind(item, range, quantities);
            json!({ "type": "array", "items": item, "minItems": length, "maxItems": length })
        }
        Kind::Table(table) => of_table(table, None, quantities),
        Kind::Named(table) => {
            json!({ "type": "object", "additionalProperties": of_table(table, None, quantities) })
        }
        Kind::OneOrMany(table) => {
            let one = of_table(table, None, quantities);
            json!({ "anyOf": [one, { "type": "array", "items": one }] })
        }
        Kind::Variants(tag, variants) => {
            let variants = variants.iter();
            let variants: Vec<Value> = variants
                .map(|(name, table)| of_table(table, Some((*tag, *name)), quantities))
                .collect();
            json!({ "type": "object", "oneOf": variants })
        }
        Kind::Either(one, other) => {
            let both = [one, other].map(|kind| of_kind(kind, range, quantities));
            json!({ "anyOf": both })
        }
    }
}

/// Text of a quantity: the units of the list, in every spelling of their powers and of micro. The reader takes more units.
fn of_quantity(units: &Units, negative: bool) -> Value {
    let spelled = |unit: &&str| {
        let mut pattern = String::new();
        for (index, c) in unit.chars().enumerate() {
            match c {
                '2' => pattern.push_str("(\\^?2|²)"),
                '3' => pattern.push_str("(\\^?3|³)"),
                'u' if index == 0 && *unit != "u" => pattern.push_str("[uµ\u{3bc}]"),
                '(' | ')' => pattern.extend(['\\', c]),
                _ => pattern.push(c),
            }
        }
        pattern
    };
    let units_pattern: Vec<String> = units.units.iter().map(spelled).collect();
    let sign = if negative { "[+-]?" } else { "\\+?" };
    let number = "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";
    json!({
        "type": "string",
        "pattern": format!("^\\s*{sign}{number}\\s*({})\\s*$", units_pattern.join("|")),
        "description": format!("{} with its unit, e.g. \"{}\" (units: {})", units.name, units.example, units.units.join(", ")),
    })
}

/// A number within the interval that a range says, if it says one.
fn bounded(kind: &str, range: &str) -> Value {
    let mut schema = json!({ "type": kind });
    for (bound, value) in bounds(range) {
        schema[bound] = match value.fract() == 0.0 {
            true => json!(value as i64),
            false => json!(value),
        };
    }
    schema
}

/// Bounds that a range says: of `[0, 0.5)`, `> 0`, `≥ 1`, `8 to 1000`; nothing of words.
#[must_use]
pub fn bounds(range: &str) -> Vec<(&'static str, f64)> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let range = range.split(", <").next().unwrap_or(range);
    if let Some(value) = range.strip_prefix('>').and_then(number) {
        return vec![("exclusiveMinimum", value)];
    }
    if let Some(value) = range.strip_prefix('≥').and_then(number) {
        return vec![("minimum", value)];
    }
    let closed = |low: &str, high: &str, open: [bool; 2]| {
        let names = [
            ["minimum", "exclusiveMinimum"],
            ["maximum", "exclusiveMaximum"],
        ];
        let values = [number(low)?, number(high)?];
        Some(
            [0, 1]
                .map(|end| (names[end][usize::from(open[end])], values[end]))
                .to_vec(),
        )
    };
    if let Some((low, high)) = range.split_once(" to ") {
        return closed(low, high, [false; 2]).unwrap_or_default();
    }
    let inner = range
        .trim_start_matches(['[', '('])
        .trim_end_matches([']', ')']);
    match inner.split_once(',') {
        Some((low, high)) if inner.len() + 2 == range.len() => {
            closed(low, high, [range.starts_with('('), range.ends_with(')')]).unwrap_or_default()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_become_bounds_and_words_none() {
        assert_eq!(
            bounds("[0, 0.5)"),
            [("minimum", 0.0), ("exclusiveMaximum", 0.5)]
        );
        assert_eq!(
            bounds("(0, 0.2]"),
            [("exclusiveMinimum", 0.0), ("maximum", 0.2)]
        );
        assert_eq!(bounds("> 0, < E"), [("exclusiveMinimum", 0.0)]);
        assert_eq!(bounds("≥ 1"), [("minimum", 1.0)]);
        assert_eq!(bounds("8 to 1000"), [("minimum", 8.0), ("maximum", 1000.0)]);
        for words in [
            "",
            "an existing file",
            "≥ the slowest",
            "of `materials`",
            "[0, 4/3)",
        ] {
            assert_eq!(bounds(words), [], "{words}");
        }
    }
}
