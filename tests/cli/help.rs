//! Help: what the program says of itself is complete and can be followed.

use crate::program::{impactlaw, message};
use clap::{CommandFactory, Parser};
use impactlaw::cli::Cli;
use impactlaw::theory::{FORMULAS, Theory};
use impactlaw::unit::{self, DIMENSIONS};
use std::path::Path;

/// Every verb with its path, those that only hold others left out.
fn verbs(root: &clap::Command, path: &str, found: &mut Vec<(String, clap::Command)>) {
    for verb in root.get_subcommands() {
        let path = format!("{path} {}", verb.get_name());
        verbs(verb, &path, found);
        found.push((path, verb.clone()));
    }
}

/// Words of a command line with double quotes; what a shell redirects is cut off.
fn words(line: &str) -> Vec<String> {
    let line = line.split(['>', '|']).next().unwrap();
    let mut words: Vec<String> = Vec::new();
    for (index, part) in line.split('"').enumerate() {
        match index % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    words
}

#[test]
fn every_verb_has_examples_that_parse_and_name_files_that_exist() {
    let mut all = Vec::new();
    verbs(&Cli::command(), "impactlaw", &mut all);
    assert!(all.len() > 14, "{}", all.len());
    for (path, verb) in all {
        let end = verb.get_after_help().map(ToString::to_string);
        let end = end.unwrap_or_else(|| panic!("{path}: no examples"));
        let lines: Vec<&str> = end.lines().skip(1).map(str::trim).collect();
        assert!(!lines.is_empty(), "{path}");
        for line in lines {
            assert!(line.starts_with(&path), "{path}: {line}");
            let parsed = Cli::try_parse_from(words(line));
            assert!(parsed.is_ok(), "{line}: {}", parsed.unwrap_err());
            let shipped =
                |word: &&String| word.starts_with("cases/") || word.starts_with("models/");
            for file in words(line).iter().filter(shipped) {
                // a folder too: `validate --from`
                let there = Path::new(env!("CARGO_MANIFEST_DIR")).join(file).exists();
                assert!(there, "{line}: no {file}");
            }
        }
    }
}

fn printed(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = impactlaw(folder.path(), arguments);
    assert!(output.status.success(), "{}", message(&output));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_list_of_theories_has_every_model_with_its_papers_and_what_it_needs() {
    let text = printed(&["theory", "--list"]);
    for model in Theory::ALL.map(Theory::publication).iter().chain(&FORMULAS) {
        let begins = |line: &&str| line.split_whitespace().next() == Some(model.name);
        let line = text.lines().find(begins);
        let line = line.unwrap_or_else(|| panic!("no {}", model.name));
        assert!(
            model.papers.iter().all(|paper| line.contains(paper)),
            "{line}"
        );
        assert!(text.contains(model.summary), "{}", model.summary);
    }
    let needless = text.matches("needs no yield strength").count();
    assert_eq!(
        needless,
        Theory::ALL
            .iter()
            .filter(|theory| !theory.needs_yield())
            .count()
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 110),
        "{text}"
    );
}

#[test]
fn every_unit_that_is_listed_is_read() {
    let text = printed(&["units"]);
    assert_eq!(text.lines().count(), DIMENSIONS.len());
    for units in DIMENSIONS {
        assert!(text.contains(units.noun()) && text.contains(units.example));
    }
    // the list is the readers' own: each unit of one dimension is read by that dimension
    let pressures = DIMENSIONS
        .iter()
        .find(|units| units.name == "a pressure")
        .unwrap();
    for unit in pressures.units {
        assert!(
            unit::parse::<unit::Pressure>(&format!("1 {unit}")).is_ok(),
            "{unit}"
        );
    }
}

#[test]
fn completions_know_every_verb_in_every_shell() {
    for shell in ["bash", "zsh", "fish"] {
        let script = printed(&["completions", shell]);
        for verb in Cli::command().get_subcommands() {
            assert!(
                script.contains(verb.get_name()),
                "{shell}: {}",
                verb.get_name()
            );
        }
    }
}

#[test]
fn every_verb_has_its_manual_page_with_options_and_examples() {
    let folder = tempfile::tempdir().unwrap();
    let output = impactlaw(folder.path(), &["man", "pages/man1"]);
    assert!(output.status.success(), "{}", message(&output));
    let mut all = Vec::new();
    verbs(&Cli::command(), "impactlaw", &mut all);
    for (path, _) in all {
        let file = format!("pages/man1/{}.1", path.replace(' ', "-"));
        let page = std::fs::read_to_string(folder.path().join(&file))
            .unwrap_or_else(|_| panic!("no {file}"));
        assert!(
            page.contains(".SH SYNOPSIS") && page.contains("Examples"),
            "{file}"
        );
    }
}
