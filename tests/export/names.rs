//! Names in law files stay names: what is written from them holds no line, comment end or path of theirs.

use crate::codes::models;
use crate::program;
use impactlaw::document::Document;
use impactlaw::export::Target;
use impactlaw::export::check::{Agreement, Check, CompilerCheck, Finding, ShimCheck};
use impactlaw::export::source::portable::Portable;
use impactlaw::law::LawFile;
use std::process::Command;

/// Texts that ended a comment, continued a line, began a directive or left the folder.
const ATTACKS: [&str; 9] = [
    "x *\\\n/\nint attacked = 1;\n/*",
    "x */ int attacked = 1; /*",
    "x\nshell touch attacked",
    "x \\",
    "x\r\n#include \"attacked.h\"",
    "x\"; system(\"attacked\"); \"",
    "../../../attacked",
    "/attacked",
    "x\u{2028}attacked\u{202e}",
];

fn law() -> LawFile {
    LawFile::read(&models()[0]).unwrap()
}

/// Ways to put a text into a law file.
type Place = fn(&mut LawFile) -> &mut String;
const PLACES: [Place; 4] = [
    |file| &mut file.name,
    |file| &mut file.provenance.case,
    |file| &mut file.provenance.program,
    |file| &mut file.provenance.case_sha256,
];

#[test]
fn a_law_file_whose_name_case_or_program_is_no_plain_line_is_refused_where_it_is_read() {
    for attack in ATTACKS {
        for place in PLACES {
            let mut file = law();
            *place(&mut file) = attack.to_owned();
            let document = Document::new("law.toml".as_ref(), file.text().unwrap());
            let error = LawFile::parse(&document).unwrap_err().to_string();
            assert!(error.contains("must be"), "{error}");
        }
    }
    let mut file = law();
    file.name = "Acier 1.4301 (µm) v2+3".to_owned();
    let document = Document::new("law.toml".as_ref(), file.text().unwrap());
    assert!(LawFile::parse(&document).is_ok());
}

#[test]
fn every_dialect_writes_such_a_name_as_a_plain_word() {
    for attack in ATTACKS {
        let mut file = law();
        for place in PLACES {
            *place(&mut file) = attack.to_owned();
        }
        let law = Portable::new(file, None, "0".repeat(64)).unwrap();
        for target in Target::ALL {
            for artifact in target.export(&law).unwrap() {
                assert!(!artifact.text.contains(attack), "{target}: {attack:?}");
                assert!(!artifact.name.contains(".."), "{}", artifact.name);
                for line in artifact.text.lines() {
                    let begins = ["int attacked", "shell", "#include \"attacked"];
                    let injected = begins
                        .iter()
                        .any(|word| line.trim_start().starts_with(word));
                    assert!(!injected && !line.contains("*/ int"), "{target}: {line}");
                }
            }
        }
    }
}

#[test]
fn c_written_from_such_a_name_compiles_to_the_same_law() {
    let mut file = law();
    for place in PLACES {
        *place(&mut file) = ATTACKS[0].to_owned();
    }
    let law = Portable::new(file, None, "0".repeat(64)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    if let Finding::Ran { agreements, .. } = CompilerCheck.run(&law, folder.path()).unwrap() {
        let wrong = |a: &&Agreement| !a.subject.starts_with("cost") && !a.holds();
        assert_eq!(agreements.iter().filter(wrong).count(), 0);
    }
}

/// A law whose name, case, program and sum are all this text.
fn attacked(attack: &str) -> Portable {
    let mut file = law();
    for place in PLACES {
        *place(&mut file) = attack.to_owned();
    }
    Portable::new(file, None, "0".repeat(64)).unwrap()
}

#[test]
fn force_models_written_from_such_names_compile_to_the_same_law() {
    for attack in [ATTACKS[0], ATTACKS[4], ATTACKS[5]] {
        for check in [ShimCheck::Deme, ShimCheck::MercuryDpm] {
            let folder = tempfile::tempdir().unwrap();
            match check.run(&attacked(attack), folder.path()).unwrap() {
                Finding::Skipped { why } => eprintln!("!! SKIPPED: {why}"),
                Finding::Ran { agreements, .. } => {
                    assert!(agreements.iter().all(Agreement::holds), "{agreements:?}");
                }
            }
        }
    }
}

#[test]
fn scripts_written_from_such_names_hold_no_command_of_theirs() {
    for attack in ATTACKS {
        for file in Target::Native.export(&attacked(attack)).unwrap() {
            if file.name.ends_with(".md") {
                continue; // for people: it may tell the law's name
            }
            let commands = file.text.lines().map(str::trim_start);
            let mut commands = commands.filter(|line| !line.starts_with('#'));
            assert!(
                !commands.any(|line| line.contains("system(")),
                "{}",
                file.name
            );
            if !file.name.ends_with(".py") {
                continue;
            }
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("attacked.py");
            std::fs::write(&path, &file.text).unwrap();
            let parse = "import ast, sys; ast.parse(open(sys.argv[1]).read())";
            let mut python = Command::new("python3");
            match python.args(["-c", parse]).arg(&path).status() {
                Ok(status) => assert!(status.success(), "{}", file.name),
                Err(why) => eprintln!("!! SKIPPED: no python3: {why}"),
            }
        }
    }
}

#[test]
fn export_stays_in_its_folder_and_folders_with_line_breaks_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("inside");
    std::fs::create_dir(&inside).unwrap();
    let text = std::fs::read_to_string(&models()[0]).unwrap();
    let name = text
        .lines()
        .find(|line| line.starts_with("name = "))
        .unwrap();
    let attack = text.replace(name, "name = \"../../attacked\"");
    std::fs::write(inside.join("attack.toml"), attack).unwrap();
    std::fs::write(inside.join("law.toml"), &text).unwrap();
    let run = |arguments: &[&str]| {
        let output = program::impactlaw(&inside, arguments);
        (output.status.code(), program::message(&output))
    };
    let (code, said) = run(&["export", "attack.toml", "--to", "c"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("`name`"), "{said}");
    let (code, said) = run(&["export", "law.toml", "--to", "c", "--out", "a\nb"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("output folder"), "{said}");
    let names = |at: &std::path::Path| std::fs::read_dir(at).unwrap().count();
    assert_eq!((names(folder.path()), names(&inside)), (1, 2));
}
