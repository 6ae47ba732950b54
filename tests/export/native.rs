//! Models that codes ship, fitted to a law: closed forms of the models, and lines that give in the code what they predict.

use crate::codes;
use crate::program::impactlaw;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::rebound::rebound;
use impactlaw::export::check::{Check, Finding, NativeCheck};
use impactlaw::export::native::eepa::Eepa;
use impactlaw::export::native::thornton_ning::ThorntonNing;
use impactlaw::export::native::{self, Code, Model};
use impactlaw::export::source::portable::Portable;
use impactlaw::law::file::HertzTable;
use impactlaw::law::{Form, LawFile};
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::mdr::Mdr;
use std::path::{Path, PathBuf};

fn model(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("models")
        .join(name)
}

fn law() -> Portable {
    Portable::read(&model("elastic-perfectly-plastic-ey80.toml"), None).unwrap()
}

#[test]
fn eepa_dissipates_the_same_share_at_every_speed_and_is_the_linear_spring_for_n_1() {
    let law = Eepa {
        loading: 1e9,
        ratio: 4.0,
        exponent: 1.0,
    };
    let curved = Eepa {
        exponent: 1.5,
        ..law
    };
    let e = |law: &Eepa, v| rebound(law, 1e-3, 1e-5, v).restitution;
    for v in [0.1, 1.0, 10.0] {
        approx::assert_relative_eq!(e(&law, v), 0.5, max_relative = 1e-10);
        approx::assert_relative_eq!(e(&curved, v), e(&curved, 1.0), max_relative = 1e-9);
    }
}

#[test]
fn native_models_without_yield_are_hertz() {
    let modulus = 1e11 / (1.0 - 0.35 * 0.35);
    let hertz = Hertz::new(modulus);
    let ning = ThorntonNing {
        modulus,
        yield_ratio: 1.0,
    };
    let mdr = Mdr::new(1e11, 0.35, 1e13);
    for x in [1e-4, 1e-3, 1e-2] {
        let exact = hertz.force(x, &mut ());
        approx::assert_relative_eq!(ning.force(x, &mut 0.0), exact, max_relative = 1e-12);
        // an ellipse for a parabola: relative difference of the order of the depth over the height, x/4
        let other = mdr.force(x, &mut Default::default());
        approx::assert_relative_eq!(other, exact, max_relative = x);
    }
}

#[test]
fn recoverable_energy_is_the_area_under_the_unloading_branch() {
    fn held<L: NormalLaw>(law: &L, most: f64, tolerance: f64) {
        let mut history = L::History::default();
        law.force(most, &mut history);
        let panels = 200_000;
        let force = |k: u32| {
            law.force(
                most * f64::from(k) / f64::from(panels),
                &mut history.clone(),
            )
        };
        let area: f64 = (1..panels).map(force).sum::<f64>() + 0.5 * force(panels);
        let area = area * most / f64::from(panels);
        let energy = law.elastic_energy(most, &history);
        approx::assert_relative_eq!(energy, area, max_relative = tolerance);
    }
    let eepa = Eepa {
        loading: 1e9,
        ratio: 3.0,
        exponent: 1.3,
    };
    let ning = ThorntonNing {
        modulus: 1e11,
        yield_ratio: 0.05,
    };
    held(&eepa, 0.02, 1e-7);
    held(&ning, 0.02, 1e-7);
    held(&Mdr::new(1e11, 0.35, 1.25e9), 0.02, 1e-3);
}

#[test]
fn projections_give_the_middle_of_the_law_and_say_what_is_lost() {
    let law = law();
    let target = native::target(&law);
    let projections = native::project(&law, &target).unwrap();
    assert_eq!(projections.len(), 5);
    for projection in &projections {
        // a straight or constant-ratio model cannot follow e(V); none is off by a factor
        for (error, name) in projection.largest().into_iter().zip(["e", "F*", "time"]) {
            assert!(error < 0.6, "{}: {name} {error}", projection.model.name());
        }
        // the errors are those of the model at the speeds of the target
        let (v, hit) = target.impacts[2];
        let theirs = projection.model.rebound(target.radius, target.mass, v);
        let error = theirs.restitution / hit.restitution - 1.0;
        assert_eq!(error, projection.errors[2][0]);
    }
    // a fitted number moved either way costs more
    let cost = |model: &Model| -> f64 {
        let rows = target.impacts.iter().map(|(v, hit)| {
            let theirs = model.rebound(target.radius, target.mass, *v);
            let logs = [
                (theirs.restitution / hit.restitution).ln(),
                (theirs.max_force / hit.max_force).ln(),
                (theirs.contact_time / hit.contact_time).ln(),
            ];
            logs.iter().map(|log| log * log).sum::<f64>()
        });
        rows.sum()
    };
    let best = projections
        .iter()
        .find_map(|p| match p.model {
            Model::Eepa(law) => Some(law),
            _ => None,
        })
        .unwrap();
    for factor in [0.98, 1.02] {
        for moved in [
            Eepa {
                loading: best.loading * factor,
                ..best
            },
            Eepa {
                ratio: best.ratio * factor,
                ..best
            },
            Eepa {
                exponent: best.exponent * factor,
                ..best
            },
        ] {
            assert!(cost(&Model::Eepa(moved)) > cost(&Model::Eepa(best)));
        }
    }
}

#[test]
fn an_elastic_law_is_not_projected() {
    let mut law = law();
    law.form = Form::Hertz;
    let error = native::files(&law).unwrap_err().to_string();
    assert!(error.contains("needs a law that yields"), "{error}");
}

#[test]
fn everything_for_an_elastic_law_leaves_the_projections_out() {
    let text = std::fs::read_to_string(model("sac305-solder.toml")).unwrap();
    let file = LawFile {
        form: Form::Hertz,
        hertz: Some(HertzTable {
            reason: "nothing yielded".to_owned(),
            quality: Vec::new(),
        }),
        ..toml::from_str(&text).unwrap()
    };
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("law.toml"),
        toml::to_string(&file).unwrap(),
    )
    .unwrap();
    let code = |to| {
        let arguments = ["export", "law.toml", "--to", to, "-o", to];
        impactlaw(folder.path(), &arguments).status.code()
    };
    assert_eq!(code("native"), Some(2));
    assert!(!folder.path().join("native").exists());
    assert_eq!(code("all"), Some(0));
    let header = Portable::read(&folder.path().join("law.toml"), None)
        .unwrap()
        .identifier
        + ".h";
    assert!(folder.path().join("all/c").join(header).exists());
    assert!(!folder.path().join("all/native").exists());
}

#[test]
fn every_target_has_a_folder_of_its_own_and_a_check_is_of_the_targets_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let law = model("sac305-solder.toml");
    let law = law.to_str().unwrap();
    let output = impactlaw(folder.path(), &["export", law, "--to", "all", "-o", "all"]);
    assert!(output.status.success());
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("time step for a deck"), "{said}");
    for target in impactlaw::export::Target::ALL {
        assert!(
            folder.path().join("all").join(target.name()).is_dir(),
            "{target}"
        );
    }
    let loose = std::fs::read_dir(folder.path().join("all")).unwrap();
    assert!(loose.map(Result::unwrap).all(|entry| entry.path().is_dir()));
    let checked = |to: &str| {
        let output = impactlaw(
            folder.path(),
            &["export", law, "--to", to, "-o", "c", "--check"],
        );
        let text =
            String::from_utf8(output.stdout).unwrap() + &String::from_utf8_lossy(&output.stderr);
        let head = |line: &&str| !line.starts_with([' ', '/']) && line.contains(':');
        text.lines()
            .filter(head)
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let c = checked("c");
    assert!(
        c.iter()
            .any(|line| line.starts_with("C ") || line.starts_with("C:")),
        "{c:?}"
    );
    // nothing runs a table
    let table = checked("table");
    for other in ["LIGGGHTS", "LAMMPS", "YADE", "DEM-Engine", "MercuryDPM"] {
        assert!(!c.iter().any(|line| line.contains(other)), "{c:?}");
        assert!(!table.iter().any(|line| line.contains(other)), "{table:?}");
    }
}

fn lines_hold_in(code: Code) {
    let solder = Portable::read(&model("sac305-solder.toml"), Some(Form::Spline)).unwrap();
    for law in [law(), solder] {
        let folder = tempfile::tempdir().unwrap();
        match NativeCheck(code).run(&law, folder.path()).unwrap() {
            Finding::Skipped { why } => return codes::skipped(code.name(), &why),
            Finding::Ran { agreements, .. } => {
                assert!(!agreements.is_empty());
                for agreement in agreements {
                    assert!(agreement.holds(), "{}: {agreement:?}", law.name);
                }
            }
        }
    }
}

#[test]
fn lines_for_liggghts_give_the_predicted_impacts_there() {
    lines_hold_in(Code::Liggghts);
}

#[test]
fn lines_for_lammps_give_the_predicted_impacts_there() {
    lines_hold_in(Code::Lammps);
}

#[test]
fn lines_for_yade_give_the_predicted_impacts_there() {
    lines_hold_in(Code::Yade);
}
