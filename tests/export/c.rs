//! The exported C law is the law: compiled without a warning and run along random paths; and what `export` refuses.

use crate::codes::{self, assert_close, models, put_input, succeed};
use crate::program;
use impactlaw::contact::rebound::{Rebound, rebound};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::export::c;
use impactlaw::export::check::driver::{FLAGS, compiler};
use impactlaw::export::check::{Check, CompilerCheck, Finding, series};
use impactlaw::export::source::portable::Portable;
use impactlaw::law::{Form, LawFile};
use std::process::Command;

/// Every form of every published law, and the elastic law of each material.
fn laws() -> Vec<Portable> {
    let mut laws = Vec::new();
    for path in models() {
        for form in [Form::ClosedForm, Form::Spline] {
            laws.push(Portable::read(&path, Some(form)).unwrap());
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let elastic = LawFile {
            hertz: Some(impactlaw::law::file::HertzTable {
                reason: "elastic".to_owned(),
                quality: Vec::new(),
            }),
            ..toml::from_str(&text).unwrap()
        };
        laws.push(Portable::new(elastic, Some(Form::Hertz), "none".to_owned()).unwrap());
    }
    laws
}

/// Deviations of the check by subject; `None` without a compiler.
fn agreements(law: &Portable) -> Option<Vec<(String, f64, bool)>> {
    let folder = tempfile::tempdir().unwrap();
    match CompilerCheck.run(law, folder.path()).unwrap() {
        Finding::Ran { agreements, .. } => Some(
            agreements
                .into_iter()
                .map(|a| (a.subject.clone(), a.deviation, a.holds()))
                .collect(),
        ),
        Finding::Skipped { why } => {
            codes::skipped("C", &why);
            None
        }
    }
}

#[test]
fn every_published_law_in_c_agrees_with_rust_to_1e_12_and_gives_its_reference_impacts() {
    for law in laws() {
        let Some(agreements) = agreements(&law) else {
            return;
        };
        assert_eq!(agreements.len(), 5);
        // the cost depends on what else the machine does
        for (subject, deviation, holds) in agreements {
            let timed = subject.starts_with("cost");
            assert!(
                holds || timed,
                "{} {:?} {subject}: {deviation:e}",
                law.name,
                law.form
            );
        }
    }
}

/// Every form of one material's law with every form of another's, either first in half of them.
#[test]
fn contacts_of_two_materials_in_c_are_those_of_a_mixed_bed_to_1e_12() {
    let laws = laws();
    for (at, first) in laws.iter().enumerate() {
        let others = laws
            .iter()
            .enumerate()
            .filter(|(_, law)| law.name != first.name);
        for (_, second) in others.filter(|(other, _)| (at < *other) == ((at + other) % 2 == 0)) {
            let folder = tempfile::tempdir().unwrap();
            match series::check(first, second, folder.path()).unwrap() {
                Finding::Skipped { why } => return codes::skipped("C", &why),
                Finding::Ran { agreements, .. } => {
                    assert_eq!(agreements.len(), 2);
                    for found in agreements {
                        let (a, b) = (first.form, second.form);
                        assert!(found.holds(), "{} {a:?}, {b:?}: {found:?}", first.name);
                    }
                }
            }
        }
    }
}

#[test]
fn the_inertia_of_the_header_is_that_of_the_law() {
    struct Impact<'a>(&'a Portable, f64);
    impl LawVisitor for Impact<'_> {
        type Output = Rebound;
        fn visit<L: NormalLaw>(self, law: &L) -> Rebound {
            let radius = self.0.radius();
            rebound(law, radius, self.0.material().sphere_mass(radius), self.1)
        }
    }
    let Ok(compiler) = compiler() else {
        return codes::skipped("C", "there is no compiler");
    };
    let mut tried = 0;
    for law in laws().iter().filter(|law| law.inertia() > 0.0) {
        let folder = tempfile::tempdir().unwrap();
        let header = &c::export(law)[0];
        std::fs::write(folder.path().join(&header.name), &header.text).unwrap();
        put_input("inertia.c", law, folder.path());
        let program = folder.path().join("inertia");
        let mut build = Command::new(&compiler);
        build.args(FLAGS);
        build.arg(folder.path().join("inertia.c")).arg("-o");
        succeed(build.arg(&program).arg("-lm"));
        let (radius, speed) = (law.radius(), law.file.valid.velocity_max_m_s);
        let mass = law.material().sphere_mass(radius);
        let figures = law.full.visit(Impact(law, speed));
        let at_rest = law.core.visit(Impact(law, speed));
        // the term is felt
        assert!(figures.max_displacement / at_rest.max_displacement < 0.99);
        let dt = figures.contact_time / 400_000.0;
        let arguments = [radius, mass, speed, dt].map(|number| format!("{number:e}"));
        let said = succeed(Command::new(&program).args(arguments));
        let found = &codes::rows(&said, 3)[0];
        println!("{} {:?}: {found:?}, {figures:?}", law.name, law.form);
        assert_close(found[0], figures.restitution, 1e-8, "restitution");
        assert_close(found[1], figures.max_force, 1e-8, "largest force");
        assert_close(
            found[2],
            figures.max_displacement,
            1e-8,
            "largest flattening",
        );
        tried += 1;
    }
    assert!(tried > 0, "a published law has inertia");
}

#[test]
fn a_wrong_constant_is_found_by_the_check() {
    let file = LawFile::read(&models()[0]).unwrap();
    let right = Portable::new(file.clone(), Some(Form::ClosedForm), String::new()).unwrap();
    let mut other = file;
    if let Some(table) = &mut other.closed_form {
        table.unloading.exponent_strain *= 1.0 + 1e-4;
    }
    let wrong = Portable {
        core: other.law_in(Form::ClosedForm).unwrap(),
        reference: right.reference.clone(),
        ..right
    };
    // the header is written from `core`, the reference from the right law: its self-test must miss, not the paths
    if let Some(agreements) = agreements(&wrong) {
        assert!(agreements[0].2);
        assert!(!agreements[3].2, "{agreements:?}");
    }
}

#[test]
fn the_header_says_what_a_user_of_it_has_to_know() {
    let law = Portable::read(&models()[0], None).unwrap();
    let text = c::header(&law);
    for words in [
        "Units: SI",
        "E* = E/(1 - nu^2)",
        "Valid: delta/R up to 0.0699",
        "from 10 to 50 m/s",
        "Suggested time step",
        "Reset: to 0 when the bodies no longer overlap",
        &law.hash,
        "Reference impacts",
        "Trajectory",
        "THESIS_4_4_SELF_TEST",
        "thesis_4_4_wall",
        "thesis_4_4_inertia",
    ] {
        assert!(text.contains(words), "{words}");
    }
    assert!(!text.contains("law_") && !text.contains("LAW_FUNCTION_"));
}

#[test]
fn bad_arguments_give_one_error_and_write_nothing() {
    let model = models()[0].display().to_string();
    let folder = tempfile::tempdir().unwrap();
    for (arguments, words) in [
        (vec!["--to", "abaqus"], "must be one of c,"),
        (vec![], "name one or more of c,"),
        (
            vec!["--to", "c", "--form", "cubic"],
            "closed_form, spline, hertz",
        ),
        (
            vec!["--to", "c", "--form", "hertz"],
            "is not in the law file, which holds closed_form, spline",
        ),
        (
            vec!["--to", "c", "--with", &model],
            "must have a name of its own",
        ),
        (
            vec!["--to", "c,lammps", "--with", &model],
            "is for target c: the other targets hold one law",
        ),
    ] {
        let mut all = vec!["export", &model, "-o", "out"];
        all.extend(arguments);
        let output = program::impactlaw(folder.path(), &all);
        assert_eq!(output.status.code(), Some(2));
        let message = program::message(&output);
        assert!(message.contains(words), "{message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

#[test]
fn the_table_gives_the_law_back() {
    let folder = tempfile::tempdir().unwrap();
    let model = models()[0].display().to_string();
    let output = program::impactlaw(folder.path(), &["export", &model, "--to", "table"]);
    assert_eq!(output.status.code(), Some(0));
    let path = folder
        .path()
        .join("out/thesis-4-4/export/table/thesis_4_4.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let law = LawFile::read(&models()[0]).unwrap().law().unwrap();
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let rows: Vec<[f64; 3]> = reader.deserialize().map(|row| row.unwrap()).collect();
    assert_eq!(rows.len(), 40 * 41);
    for branch in rows.chunks(41) {
        assert!(branch[0][2].abs() < 1e-9 * branch[40][2]);
        for [most, x, force] in branch {
            let radius = 1e-3;
            let ours = law.force(radius, x * radius, most * radius);
            approx::assert_abs_diff_eq!(
                force * radius * radius,
                ours,
                epsilon = 1e-9 * branch[40][2] * radius * radius
            );
        }
    }
}

/// The law of a ball on a plate, on a half-space and on a smaller ball, from impacts of a known law.
fn laws_of_pairs() -> Vec<Portable> {
    use impactlaw::case::Case;
    use impactlaw::case::pair::{PairCase, Target, TargetShape};
    use impactlaw::law::PairLaw;
    use impactlaw::material::{Flow, Material};
    let metal = |density, young_modulus, strength| Material {
        density,
        young_modulus,
        poisson_ratio: 0.3,
        flow: Some(Flow::perfectly_plastic(strength)),
    };
    let (steel, aluminium) = (metal(7850.0, 210e9, 1.7e9), metal(2700.0, 70e9, 280e6));
    let shapes = [
        TargetShape::HalfSpace,
        TargetShape::Plate { thickness: 4e-3 },
        TargetShape::Sphere { radius: 0.5e-3 },
    ];
    let of = |shape| {
        let pair = PairCase {
            particle: Case::of("ball", 1e-3, steel, &[1.0, 10.0], 0.05).unwrap(),
            target: Target {
                shape,
                material: aluminium,
            },
        };
        // the atlas has the law of the sphere that stands for both: a law file of the right form, whatever its numbers
        let both = pair.effective();
        let mut file = LawFile::of_atlas("ball", &both.material, both.radius).unwrap();
        file.pair = Some(impactlaw::law::pair::PairTable::of(&pair));
        let text = file.text().unwrap();
        let document = impactlaw::document::Document::new("ball.toml".as_ref(), &text[..]);
        let law = PairLaw::parse(&document).unwrap();
        Portable::new(law.into_file(), None, "none".to_owned()).unwrap()
    };
    shapes.map(of).to_vec()
}

#[test]
fn the_law_of_a_pair_in_c_is_that_of_the_bed_and_no_other_target_takes_it() {
    use impactlaw::export::Target;
    for law in laws_of_pairs() {
        for target in Target::ALL {
            match target {
                Target::C => assert_eq!(target.export(&law).unwrap().len(), 1),
                other => {
                    let error = other.export(&law).unwrap_err().to_string();
                    assert!(error.contains("the law of a pair"), "{error}");
                    assert!(error.ends_with("goes to c"), "{error}");
                }
            }
        }
        let text = &c::export(&law)[0].text;
        for said in [
            "law is that of two bodies together",
            "Second: density 2700",
            "ball_press",
        ] {
            assert!(text.contains(said), "{said}: {text}");
        }
        assert!(!text.contains("ball_pair("), "{text}");
        let Some(agreements) = agreements(&law) else {
            return;
        };
        assert_eq!(agreements.len(), 3);
        for (subject, deviation, holds) in agreements {
            assert!(holds, "{subject}: {deviation:e}");
        }
    }
}
