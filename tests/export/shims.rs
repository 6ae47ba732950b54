//! Dialects whose code cannot run here: compiled and run in a stand-in for the interface the code documents.

use impactlaw::export::check::{Check, Finding, ShimCheck};
use impactlaw::export::source::portable::Portable;
use impactlaw::export::{Target, deme};
use impactlaw::law::Form;
use std::path::Path;

fn laws() -> Vec<Portable> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let read = |(name, form)| Portable::read(&folder.join(name), Some(form)).unwrap();
    [
        ("elastic-perfectly-plastic-ey80.toml", Form::ClosedForm),
        ("sac305-solder.toml", Form::Spline),
    ]
    .map(read)
    .into()
}

fn impacts_come_out(check: ShimCheck) {
    for law in laws() {
        let folder = tempfile::tempdir().unwrap();
        match check.run(&law, folder.path()).unwrap() {
            Finding::Skipped { why } => eprintln!("SKIPPED: {why}"),
            Finding::Ran { agreements, .. } => {
                assert_eq!(agreements.len(), law.reference.impacts.len());
                for agreement in agreements {
                    assert!(agreement.holds(), "{}: {agreement:?}", law.name);
                }
            }
        }
    }
}

#[test]
fn the_force_model_of_dem_engine_gives_the_reference_impacts() {
    impacts_come_out(ShimCheck::Deme);
}

#[test]
fn the_interaction_of_mercurydpm_gives_the_reference_impacts_across_a_restart() {
    impacts_come_out(ShimCheck::MercuryDpm);
}

#[test]
fn no_placeholder_is_left_in_any_file() {
    for law in laws() {
        for target in Target::ALL {
            for file in target.export(&law).unwrap() {
                let text = file.text;
                assert!(!text.contains('@'), "{}", file.name);
                let whole = |word: &str| text.contains(&format!(" {word}"));
                assert!(!whole("law_") && !whole("LAW_"), "{}", file.name);
            }
        }
    }
}

#[test]
fn every_wildcard_of_dem_engine_is_declared_updated_and_reset() {
    let law = &laws()[0];
    let text = &deme::export(law)[1].text;
    let declared = text.split("SetPerContactWildcards({").nth(1).unwrap();
    let names: Vec<&str> = declared.split("})").next().unwrap().split(", ").collect();
    assert_eq!(names.len(), 6);
    for name in names {
        let name = name.trim_matches('"');
        assert!(text.contains(&format!("{name} = 0;")), "{name}");
        assert_eq!(text.matches(&format!(" {name} = ")).count(), 2, "{name}");
    }
}
