//! Rooms: data go one way. Each module of `src` may use those before it in the order below, never one after it.

use crate::sources::sources;
use std::collections::BTreeSet;

/// The order; a room may use rooms of earlier lines.
const ORDER: [&[&str]; 18] = [
    &["error"],
    &["files", "unit", "lanes"],
    &["tape"],
    &["document", "scheme", "space"],
    &["material"],
    &["case", "contact", "curve"],
    &["plan", "study"],
    &["impact"],
    &["theory"],
    &["fit"],
    &["law"],
    &["compare", "cost"],
    &["bed"],
    &["export"],
    &["report"],
    &["command"],
    &["cli"],
    &["capi"],
];

const LONGEST_FILE: usize = 400;

fn rank(room: &str) -> Option<usize> {
    ORDER.iter().position(|rooms| rooms.contains(&room))
}

/// Rooms named after `crate::`, also within braces; comments and tests do not count.
fn used_rooms(text: &str) -> BTreeSet<String> {
    let code: String = text
        .split("#[cfg(test)]")
        .next()
        .unwrap()
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n");
    let mut rooms = BTreeSet::new();
    for tail in code.split("crate::").skip(1) {
        let names = match tail.strip_prefix('{') {
            Some(list) => top_level_names(list),
            None => vec![tail],
        };
        for name in names {
            let room: String = name
                .trim_start()
                .chars()
                .take_while(|c| c.is_ascii_lowercase() || *c == '_')
                .collect();
            if rank(&room).is_some() {
                rooms.insert(room);
            }
        }
    }
    rooms
}

/// Beginnings of the items of a brace list, nested lists skipped.
fn top_level_names(list: &str) -> Vec<&str> {
    let (mut depth, mut names) = (1, vec![list]);
    for (i, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => names.push(&list[i + 1..]),
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    names
}

#[test]
fn no_room_uses_one_to_its_right() {
    let mut wrong = Vec::new();
    for (path, room, text) in sources() {
        let own = rank(&room).unwrap_or_else(|| panic!("{room} has no place in the order"));
        for used in used_rooms(&text) {
            if used != room && rank(&used) >= Some(own) {
                wrong.push(format!("{} uses {used}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn uses_in_braces_are_seen() {
    let text = "use crate::{bed::{a, b}, Error, law};\nuse crate::report::X;\n// crate::fit\n";
    let rooms: Vec<String> = used_rooms(text).into_iter().collect();
    assert_eq!(rooms, ["bed", "law", "report"]);
}

#[test]
fn every_file_says_what_it_is_for_and_stays_readable() {
    for (path, _, text) in sources() {
        assert!(
            text.starts_with("//! "),
            "{} has no module doc",
            path.display()
        );
        let lines = text.lines().count();
        assert!(
            lines <= LONGEST_FILE,
            "{} has {lines} lines",
            path.display()
        );
    }
}

#[test]
fn rapier_is_named_in_the_machine_and_the_adapter_only() {
    let names = |text: &str| {
        let code = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        code.into_iter().any(|line| line.contains("rapier3d"))
    };
    for (path, _, text) in sources() {
        let allowed = ["bed/machine", "bed/adapter"].map(|place| path.starts_with(place));
        assert!(
            !names(&text) || allowed.contains(&true),
            "{} names rapier",
            path.display()
        );
    }
}
