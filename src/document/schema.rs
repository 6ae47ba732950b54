//! Schema: the keys of a file as JSON schema (draft 7), for editors that check TOML while it is written.

use super::keys::{Key, Kind, Table};
use super::range::bounds;
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
    // a plain `false` is blamed on the whole table: what fails at the key underlines the key
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": { "allOf": [false] } })
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
            // what is said of properties holds for a table, what is said of items for a list
            let mut schema = of_table(table, None, quantities);
            schema["items"] = schema.clone();
            schema["type"] = json!(["object", "array"]);
            schema
        }
        Kind::Variants(tag, variants) => {
            // `oneOf` would blame the whole table for a wrong key: the name chooses which schema speaks
            let names: Vec<&str> = variants.iter().map(|(name, _)| *name).collect();
            let mut properties = Map::new();
            properties.insert((*tag).to_owned(), json!({ "enum": names }));
            let mut choices = Vec::new();
            for (name, table) in variants {
                for key in &table.keys {
                    // for an editor that completes
                    let meaning = super::reference::sentence(key);
                    properties
                        .entry(key.name.clone())
                        .or_insert_with(|| json!({ "description": meaning }));
                }
                let chosen =
                    json!({ "properties": { *tag: { "const": name } }, "required": [tag] });
                let table = of_table(table, Some((*tag, *name)), quantities);
                choices.push(json!({ "if": chosen, "then": table }));
            }
            json!({ "type": "object", "properties": properties, "required": [tag], "allOf": choices })
        }
        Kind::Either(one, other) => {
            if let (Kind::Table(table), Kind::Name(names)) = (&**one, &**other) {
                // `anyOf` would blame the whole table for a wrong key; what is said of properties holds for a table, a pattern for a name
                let mut schema = of_table(table, None, quantities);
                schema["type"] = json!(["object", "string"]);
                schema["pattern"] = json!(format!("^({})$", names.join("|")));
                return schema;
            }
            let both = [one, other].map(|kind| of_kind(kind, range, quantities));
            json!({ "anyOf": both })
        }
        Kind::Axis(item) => {
            let item = of_kind(item, range, quantities);
            let properties =
                json!({ "from": item, "to": item, "scale": { "enum": ["linear", "log"] } });
            let ends = json!({
                "type": "object", "properties": properties, "required": ["from", "to"], "additionalProperties": false,
            });
            json!({ "anyOf": [item, { "type": "array", "items": item, "minItems": 1 }, ends] })
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
