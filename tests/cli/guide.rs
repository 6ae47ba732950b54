//! README and guide: shell blocks run through the real program, what they print is what the text shows, and the book is whole.

use crate::program::program;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A fenced block: what stands after the fence, and the text.
struct Block {
    kind: String,
    text: String,
}

fn blocks(markdown: &str) -> Vec<Block> {
    let (mut all, mut inside): (Vec<Block>, _) = (Vec::new(), false);
    for line in markdown.lines() {
        match line.strip_prefix("```") {
            Some(kind) if !inside => {
                inside = true;
                let (kind, text) = (kind.to_owned(), String::new());
                all.push(Block { kind, text });
            }
            Some(_) => inside = false,
            None if inside => writeln!(all.last_mut().unwrap().text, "{line}").unwrap(),
            None => {}
        }
    }
    assert!(!inside, "a block without end");
    all
}

/// File that a block is meant for: its first line is `# name.toml` or `# name.toml: what it is`.
fn file_of(block: &Block) -> Option<&str> {
    let name = block.text.lines().next()?.strip_prefix("# ")?;
    let name = name.split([':', ' ']).next()?;
    (block.kind == "toml" && name.ends_with(".toml")).then_some(name)
}

/// Why a block is not run: its first line says so and how long it takes, or what it needs.
fn reason(block: &Block) -> Option<&str> {
    let first = block.text.lines().next().unwrap_or_default();
    let reason = first.strip_prefix("# ")?;
    let says = ["takes ", "needs "]
        .iter()
        .any(|word| reason.contains(word));
    (says && reason.len() > 12).then_some(reason)
}

/// `impactlaw` and `cargo run --release --` are the program under test; cargo builds nothing here.
fn run(folder: &Path, block: &Block) -> String {
    let own = program(folder);
    let script = block.text.replace("cargo run --release -- ", "impactlaw ");
    let path = Path::new(own.get_program()).parent().unwrap();
    let all = std::env::join_paths(
        std::iter::once(path.to_owned()).chain(std::env::split_paths(
            &std::env::var_os("PATH").unwrap_or_default(),
        )),
    );
    let mut shell = std::process::Command::new("sh");
    shell.args(["-euc", &script]).current_dir(folder);
    shell.env("NO_COLOR", "1").env("PATH", all.unwrap());
    let output = shell.output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stdout) + &text(&output.stderr);
    assert!(output.status.success(), "{script}\n{said}");
    said
}

/// Runs the blocks of a document one after the other in one folder; how many were run.
fn follow(document: &Path) -> usize {
    let folder = tempfile::tempdir().unwrap();
    for name in ["cases", "models"] {
        copy(&root().join(name), &folder.path().join(name));
    }
    let (mut said, mut count) = (None, 0);
    for block in blocks(&std::fs::read_to_string(document).unwrap()) {
        let place = document.display();
        if let Some(name) = file_of(&block) {
            std::fs::write(folder.path().join(name), &block.text).unwrap();
        }
        said = match (&block.kind[..], said) {
            ("sh", _) => {
                count += 1;
                Some(run(folder.path(), &block))
            }
            // src/python/tests/test_guide.py runs them
            ("python", _) => None,
            ("sh,slow", _) => {
                assert!(
                    reason(&block).is_some(),
                    "{place}: no reason in\n{}",
                    block.text
                );
                None
            }
            ("text", Some(said)) => {
                assert_printed(&said, &block.text);
                None
            }
            ("text" | "toml" | "rust" | "c", _) => None,
            (kind, _) => panic!("{place}: a block of kind {kind:?}"),
        };
    }
    count
}

/// Every line that a text shows was printed; `...` stands for what is left out within and between lines.
fn assert_printed(said: &str, shown: &str) {
    for line in shown.lines().filter(|line| !line.trim().is_empty()) {
        let parts: Vec<&str> = line.split("...").map(str::trim_end).collect();
        let holds = |printed: &str| {
            let mut rest = printed;
            parts.iter().all(|part| match rest.find(part) {
                Some(at) => {
                    rest = &rest[at + part.len()..];
                    true
                }
                None => false,
            })
        };
        assert!(said.lines().any(holds), "{line:?} was not printed:\n{said}");
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy(&entry.path(), &target),
            false => drop(std::fs::copy(entry.path(), target).unwrap()),
        }
    }
}

fn chapters() -> Vec<PathBuf> {
    let all = std::fs::read_dir(root().join("src/guide")).unwrap();
    let all = all.map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = all
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    all.sort();
    all
}

#[test]
fn commands_of_the_readme_run() {
    assert!(follow(&root().join("README.md")) >= 1);
}

#[test]
fn commands_of_the_guide_run_and_print_what_it_shows() {
    let run: Vec<usize> = chapters().iter().map(|chapter| follow(chapter)).collect();
    assert!(run.iter().sum::<usize>() >= 6, "{run:?}");
}

#[test]
fn what_is_not_printed_is_seen() {
    assert_printed("a  1.5 s  ok\nb\n", "a ... ok\n\nb\n");
    for shown in ["a ... bad", "c"] {
        let fails = std::panic::catch_unwind(|| assert_printed("a  1.5 s  ok\nb\n", shown));
        assert!(fails.is_err(), "{shown}");
    }
}

#[test]
fn the_book_has_every_chapter_and_so_has_the_documentation() {
    let read = |name: &str| std::fs::read_to_string(root().join("src/guide").join(name)).unwrap();
    let (summary, module) = (read("SUMMARY.md"), read("mod.rs"));
    let listed: BTreeSet<&str> = summary
        .split(['(', ')'])
        .filter(|name| name.ends_with(".md"))
        .collect();
    let included: BTreeSet<&str> = module
        .split('"')
        .filter(|name| name.ends_with(".md"))
        .collect();
    let there: Vec<String> = chapters()
        .iter()
        .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
        .filter(|name| name != "SUMMARY.md")
        .collect();
    assert_eq!(listed, there.iter().map(|name| &name[..]).collect());
    assert_eq!(included, listed);
}

#[test]
fn links_of_the_guide_lead_to_files() {
    let guide = root().join("src/guide");
    let mut links = 0;
    for chapter in chapters() {
        let text = std::fs::read_to_string(&chapter).unwrap();
        let targets = text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.contains("://")) {
            let file = target.split('#').next().unwrap();
            let there = file.is_empty() || guide.join(file).is_file();
            assert!(there, "{}: {target}", chapter.display());
            links += 1;
        }
    }
    assert!(links > 20, "{links} links");
}

#[test]
fn the_gallery_shows_every_picture_that_its_script_makes() {
    let guide = root().join("src/guide");
    let text = std::fs::read_to_string(guide.join("gallery.md")).unwrap();
    let shown: BTreeSet<&str> = text
        .split(['(', ')'])
        .filter_map(|link| link.strip_prefix("gallery/"))
        .collect();
    let there: Vec<String> = std::fs::read_dir(guide.join("gallery"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(shown, there.iter().map(|name| &name[..]).collect());
    let script = std::fs::read_to_string(guide.join("gallery.sh")).unwrap();
    for name in shown {
        let stem = name.split('.').next().unwrap();
        assert!(script.contains(stem), "{name}");
    }
}

#[test]
fn the_readme_is_short() {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let lines = readme.lines().count();
    assert!(
        lines <= 90,
        "{lines} lines: what is longer belongs to the guide"
    );
}
