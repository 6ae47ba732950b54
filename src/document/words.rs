//! Words: a parser's messages in those of the file.

/// A parser's message with what a file holds for the names of Rust's types.
pub(super) fn in_plain_words(message: &str) -> String {
    const WORDS: [(&str, &str); 12] = [
        ("expected f64", "expected a number"),
        (
            "expected usize",
            "expected a whole number that is not negative",
        ),
        (
            "expected u64",
            "expected a whole number that is not negative",
        ),
        (
            "expected u32",
            "expected a whole number that is not negative",
        ),
        ("expected u8", "expected a whole number from 0 to 255"),
        ("expected i64", "expected a whole number"),
        ("expected i32", "expected a whole number"),
        ("expected a sequence", "expected a list, [...]"),
        ("expected a boolean", "expected true or false"),
        ("expected a string", "expected a text, \"...\""),
        ("expected a map", "expected a table"),
        (
            "did not match any variant of untagged enum",
            "is of none of the kinds that",
        ),
    ];
    let mut plain = message.to_owned();
    for (of_rust, word) in WORDS {
        plain = plain.replace(of_rust, word);
    }
    // "expected struct MaterialTable", "expected internally tagged enum Shape"
    for kind in [
        "struct ",
        "internally tagged enum ",
        "adjacently tagged enum ",
        "enum ",
    ] {
        let begin = format!("expected {kind}");
        while let Some(at) = plain.find(&begin) {
            let name = plain[at + begin.len()..]
                .find(|c: char| !c.is_alphanumeric() && c != '_')
                .map_or(plain.len(), |end| at + begin.len() + end);
            plain.replace_range(at..name, "expected a table");
        }
    }
    plain
}
