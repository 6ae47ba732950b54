//! Equations of the documentation: each survives Markdown and uses commands the page header (`src/equations.html`) can draw.

use crate::browser;
use crate::sources::sources;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const HEADER: &str = include_str!("../../src/equations.html");

/// Doc comments of a source, each as one text without its marks.
fn comments(source: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    for line in source.lines().map(str::trim_start) {
        match line.strip_prefix("///").or(line.strip_prefix("//!")) {
            Some(text) => *all.last_mut().unwrap() += &format!("{text}\n"),
            None => all.push(String::new()),
        }
    }
    all.retain(|text| !text.is_empty());
    all
}

/// Parts of a comment between dollars, code left out; `None` if a dollar has no partner.
fn equations(comment: &str) -> Option<Vec<String>> {
    let prose: String = comment.split('`').step_by(2).collect();
    let single = prose.replace("$$", "$");
    let parts: Vec<&str> = single.split('$').collect();
    (parts.len() % 2 == 1).then(|| {
        parts[1..]
            .iter()
            .step_by(2)
            .map(|&part| part.to_owned())
            .collect()
    })
}

/// Commands of an equation: `\name`, or `\` and the one character after it.
fn commands(equation: &str) -> Vec<String> {
    let tails = equation.split('\\').skip(1);
    let name = |tail: &str| {
        let letters: String = tail.chars().take_while(char::is_ascii_alphabetic).collect();
        let first = tail.chars().next().map(String::from);
        if letters.is_empty() {
            first.unwrap_or_default()
        } else {
            letters
        }
    };
    tails.map(name).collect()
}

/// Names the header mentions as keys of its tables or as words in quotes.
fn known() -> BTreeSet<String> {
    let word = |text: &str| text.chars().all(|c| c.is_ascii_alphabetic());
    let keys = HEADER
        .split([' ', '{', ',', '\n'])
        .filter_map(|text| text.strip_suffix(':'));
    let quoted = HEADER.split('"').map(|text| text.trim_start_matches('\\'));
    let names = keys
        .chain(quoted)
        .filter(|name| !name.is_empty() && word(name));
    names.map(str::to_owned).chain([" ".to_owned()]).collect()
}

/// What is wrong with an equation.
fn fault(equation: &str, known: &BTreeSet<String>) -> Option<String> {
    if let Some(name) = commands(equation)
        .into_iter()
        .find(|name| !known.contains(name))
    {
        return Some(format!("\\{name} is not drawn"));
    }
    let mut before = ' ';
    for c in equation.chars() {
        // Markdown takes a star, or an index after punctuation, for the start of emphasis
        if c == '*' || (c == '_' && before.is_ascii_punctuation()) {
            return Some(format!("Markdown may take {c} for emphasis"));
        }
        before = c;
    }
    (equation.matches('{').count() != equation.matches('}').count())
        .then(|| "braces do not pair".to_owned())
}

/// Every equation of the sources and of the guide with the path of its file.
fn all() -> Vec<(PathBuf, String)> {
    let mut all = Vec::new();
    for (path, text) in sources() {
        for comment in comments(&text) {
            let found = equations(&comment);
            let found =
                found.unwrap_or_else(|| panic!("{}: a lone $ in\n{comment}", path.display()));
            all.extend(found.into_iter().map(|equation| (path.clone(), equation)));
        }
    }
    for chapter in
        std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide")).unwrap()
    {
        let path = chapter.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "md") {
            let found = equations(&std::fs::read_to_string(&path).unwrap());
            let found = found.unwrap_or_else(|| panic!("{}: a lone $", path.display()));
            all.extend(found.into_iter().map(|equation| (path.clone(), equation)));
        }
    }
    assert!(all.len() > 300, "{}", all.len());
    all
}

#[test]
fn every_equation_survives_markdown_and_has_known_commands() {
    let known = known();
    for (path, equation) in all() {
        let fault = fault(&equation, &known);
        assert_eq!(fault, None, "{}: ${equation}$", path.display());
    }
}

#[test]
fn every_equation_is_drawn_by_a_browser() {
    let Some(browser) = browser::find() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let all = all();
    let rows: String = all
        .iter()
        .map(|(_, tex)| format!("<p>${}$</p>\n", tex.replace('<', "&lt;")))
        .collect();
    let page = format!(
        "<!doctype html><meta charset=\"utf-8\">{HEADER}<div class=\"docblock\">{rows}</div>"
    );
    let (document, said) = browser::open(&browser, &page, folder.path());
    let rows = document.split_once("class=\"docblock\"");
    let (_, rows) = rows.unwrap_or_else(|| panic!("no page: {said}"));
    let left = rows.lines().find(|line| line.contains('$'));
    assert_eq!(left, None, "not drawn");
    assert_eq!(rows.matches("<math").count(), all.len());
}

#[test]
fn what_markdown_spoils_and_what_is_not_drawn_are_seen() {
    let known = known();
    assert_eq!(
        fault(r"\tfrac12 m\ V^2 \left(\frac{a}{b}\right)^2", &known),
        None
    );
    for bad in [
        r"E^* R",
        r"F\,dw",
        r"(w)_k + x_{k}",
        r"\overline{x}",
        r"x^{2",
    ] {
        assert!(fault(bad, &known).is_some(), "{bad}");
    }
}
