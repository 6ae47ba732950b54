//! Reference: the keys of a file as text, for the guide, for a terminal, and for errors.

use super::keys::{Key, Kind, Table};
use std::fmt::Write;

/// A table of a file.
#[derive(Debug, Clone)]
pub struct Section<'a> {
    /// Lines that open it: the lists it stands in, then its own heading; none for the top of the file.
    pub opening: Vec<String>,
    /// Its dotted path; empty for the top.
    pub path: String,
    /// Its keys.
    pub table: &'a Table,
    /// The key that chose it, and its name there.
    pub chosen: Option<(&'static str, &'static str)>,
}

/// Every table of a file, the top first, each before those inside it.
#[must_use]
pub fn sections(root: &Table) -> Vec<Section<'_>> {
    let top = Section {
        opening: Vec::new(),
        path: String::new(),
        table: root,
        chosen: None,
    };
    let mut all = vec![top];
    below(root, "", &[], &mut all);
    all
}

fn below<'a>(table: &'a Table, path: &str, lists: &[String], all: &mut Vec<Section<'a>>) {
    for key in &table.keys {
        let path = match path {
            "" => key.name.clone(),
            _ => format!("{path}.{}", key.name),
        };
        let path = match key.kind {
            Kind::Named(_) => format!("{path}.NAME"),
            _ => path,
        };
        let listed = matches!(key.kind, Kind::List(_));
        let header = match listed {
            true => format!("[[{path}]]"),
            false => format!("[{path}]"),
        };
        for (chosen, table) in key.kind.tables() {
            let mut opening = lists.to_vec();
            opening.push(header.clone());
            opening.extend(chosen.map(|(tag, name)| format!("{tag} = \"{name}\"")));
            all.push(Section {
                opening: opening.clone(),
                path: path.clone(),
                table,
                chosen,
            });
            let lists = if listed { &opening } else { lists };
            below(table, &path, lists, all);
        }
    }
}

/// What may stand in a place, in words: "three lengths", "list of names".
#[must_use]
pub fn kind(kind: &Kind) -> String {
    match kind {
        Kind::Number => "number".to_owned(),
        Kind::Whole => "whole number".to_owned(),
        Kind::Truth => "true or false".to_owned(),
        Kind::Text => "text".to_owned(),
        Kind::Name(_) => "name".to_owned(),
        Kind::Quantity(units) => units.noun().to_owned(),
        Kind::List(item) if item.tables().is_empty() => format!("list of {}", plural(item)),
        Kind::List(_) | Kind::Named(_) => "tables".to_owned(),
        Kind::Array(length, item) => {
            let count = ["no", "one", "two", "three", "four"].get(*length);
            let count = count.map_or_else(|| length.to_string(), |word| (*word).to_owned());
            format!("{count} {}", plural(item))
        }
        Kind::Table(_) | Kind::Variants(..) => "table".to_owned(),
        Kind::OneOrMany(_) => "table or tables".to_owned(),
        Kind::Either(one, other) => format!("{}, or {}", self::kind(one), self::kind(other)),
        Kind::Axis(item) => format!("{}, list of {}, or range", self::kind(item), plural(item)),
    }
}

fn plural(item: &Kind) -> String {
    let one = kind(item);
    match one.strip_suffix('y') {
        // velocities, densities, frequencies
        Some(stem) => format!("{stem}ies"),
        None if one.ends_with('s') => one,
        None if matches!(item, Kind::Array(..)) => format!("{one} each"),
        None => format!("{one}s"),
    }
}

/// Allowed values of a key: its names, or its range.
fn range(key: &Key) -> String {
    match (&key.kind, key.line.range) {
        (Kind::Name(names), "") => {
            let names: Vec<String> = names.iter().map(|name| format!("`\"{name}\"`")).collect();
            names.join(", ")
        }
        // brackets alone would be a link
        (_, range) if range.starts_with(['[', '(']) => format!("`{range}`"),
        (_, range) => range.to_owned(),
    }
}

/// Example of a key: its own, or the heading of its table.
fn example(key: &Key, path: &str) -> String {
    let path = match path {
        "" => key.name.clone(),
        _ => format!("{path}.{}", key.name),
    };
    match &key.kind {
        _ if !key.line.example.is_empty() => key.line.example(),
        Kind::List(_) => format!("[[{path}]]"),
        Kind::Named(_) => format!("[{path}.NAME]"),
        _ => format!("[{path}]"),
    }
}

/// A key in one sentence: "radius of the sphere; length, > 0, required, e.g. "250 um"". What repeats the name of the key, or
/// itself, is not said.
#[must_use]
pub fn sentence(key: &Key) -> String {
    let name = key.name.replace('_', " ");
    let meaning = Some(key.line.meaning).filter(|meaning| *meaning != name);
    let kind = Some(kind(&key.kind)).filter(|kind| *kind != name && Some(&kind[..]) != meaning);
    let range = Some(range(key).replace('`', "")).filter(|range| !range.is_empty());
    let default = match key.line.default {
        None => "required".to_owned(),
        Some(default) => format!("default {}", default.replace('`', "")),
    };
    let example = Some(key.line.example()).filter(|example| !example.is_empty());
    let example = example.map(|example| format!("e.g. {example}"));
    let rest: Vec<String> = [kind, range, Some(default), example]
        .into_iter()
        .flatten()
        .collect();
    match meaning {
        Some(meaning) => format!("{meaning}; {}", rest.join(", ")),
        None => rest.join(", "),
    }
}

/// The tables of a file as Markdown, headings of the third level.
#[must_use]
pub fn markdown(top: &str, root: &Table) -> String {
    let mut text = String::new();
    for section in sections(root) {
        let heading = match section.opening.is_empty() {
            true => format!("`# top of a {top}`"),
            false => {
                let lines: Vec<String> = section
                    .opening
                    .iter()
                    .map(|line| format!("`{line}`"))
                    .collect();
                lines.join(" ")
            }
        };
        let _ = write!(text, "\n### {heading}\n");
        if !section.table.about.is_empty() {
            let _ = write!(
                text,
                "\n{}\n",
                wrapped(section.table.about, 120, "").trim_end()
            );
        }
        if section.table.keys.is_empty() {
            continue;
        }
        text.push_str(
            "\n| key | type | range | default | example | meaning |\n|---|---|---|---|---|---|\n",
        );
        for key in &section.table.keys {
            let cell = |text: String| {
                if text.is_empty() {
                    " ".to_owned()
                } else {
                    format!(" {text} ")
                }
            };
            let _ = writeln!(
                text,
                "| `{}` | {} |{}| {} | `{}` | {} |",
                key.name,
                kind(&key.kind),
                cell(range(key)),
                key.line.default.unwrap_or("required"),
                example(key, &section.path),
                key.line.meaning
            );
        }
    }
    text
}

/// Columns of a terminal.
const COLUMNS: usize = 80;
/// Column at which lines about a key begin.
const INDENT: usize = 22;

/// The tables of a file for a terminal of 80 columns; only those whose headings hold `wanted`.
#[must_use]
pub fn terminal(root: &Table, wanted: &str) -> String {
    let mut text = String::new();
    for section in sections(root) {
        let heading = match section.opening.is_empty() {
            true => "# top of the file".to_owned(),
            false => section.opening.join("  "),
        };
        if !heading.contains(wanted) {
            continue;
        }
        let _ = write!(text, "\n{heading}\n");
        if !section.table.about.is_empty() {
            text.push_str(&wrapped(
                &section.table.about.replace('`', ""),
                COLUMNS,
                "  ",
            ));
        }
        for key in &section.table.keys {
            let indent = " ".repeat(INDENT);
            let lines = wrapped(&sentence(key), COLUMNS, &indent);
            let name = format!("  {:<width$}", key.name, width = INDENT - 2);
            match name.len() <= INDENT {
                true => text.push_str(&lines.replacen(&indent, &name, 1)),
                false => {
                    let _ = write!(text, "{name}\n{lines}");
                }
            }
        }
    }
    text
}

/// `text` in lines of at most `columns`, each after `indent`.
#[must_use]
pub fn wrapped(text: &str, columns: usize, indent: &str) -> String {
    let (mut all, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        let length = indent.len() + line.chars().count() + 1 + word.chars().count();
        if !line.is_empty() && length > columns {
            let _ = writeln!(all, "{indent}{line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        let _ = writeln!(all, "{indent}{line}");
    }
    all
}
