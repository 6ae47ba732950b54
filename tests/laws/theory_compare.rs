//! Comparison against the independent finite-element impacts of `tests/data/reference` (E/Y = 80, 10 and 50 m/s).

use crate::impacts::{ELASTIC, MATERIAL, RADIUS, references, sample, summary};
use clap::CommandFactory;
use impactlaw::case::Case;
use impactlaw::cli::Cli;
use impactlaw::command::compare::CompareArgs;
use impactlaw::command::fit::FitArgs;
use impactlaw::command::{Command, Context};
use impactlaw::compare::{Comparison, Row, SIMULATION};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::rebound::{rebound, trajectory};
use impactlaw::curve::Particle;
use impactlaw::curve::{Curve, Impact, Status};
use impactlaw::material::flow::{HARDENING_MODULUS, LinearHardening};
use impactlaw::material::{Flow, Material};
use impactlaw::theory::Theory;
use impactlaw::theory::thornton::Thornton;
use std::path::Path;

/// The impact a law makes, as if it had been simulated.
fn made_by<L: NormalLaw>(law: &L, velocity: f64) -> Impact {
    let mass = MATERIAL.sphere_mass(RADIUS);
    let hit = rebound(law, RADIUS, mass, velocity);
    let path = trajectory(law, RADIUS, mass, velocity);
    Impact {
        summary: summary(
            velocity,
            [
                hit.max_force,
                hit.max_displacement,
                hit.restitution,
                hit.residual_displacement,
                hit.contact_time,
            ],
        ),
        curve: Curve {
            samples: path
                .iter()
                .map(|s| sample(s.time, s.displacement, s.force))
                .collect(),
        },
    }
}

fn row<'a>(rows: &'a [Row], law: &str, velocity: f64) -> &'a Row {
    rows.iter()
        .find(|row| row.law == law && row.velocity_m_s == velocity)
        .unwrap()
}

#[test]
fn a_law_compared_with_its_own_impact_has_no_error() {
    let law = Thornton::of(&MATERIAL, 1.6).unwrap();
    let mut comparison = Comparison::new(
        &MATERIAL,
        RADIUS,
        &[made_by(&law, 10.0), made_by(&law, 50.0)],
    );
    comparison.add("itself", &law);
    for velocity in [10.0, 50.0] {
        let row = row(comparison.rows(), "itself", velocity);
        assert!(row.errors().unwrap().rms() < 1e-12);
        assert!(row.force_rmse_rel.unwrap() < 1e-9);
    }
}

#[test]
fn a_constant_force_gap_is_its_own_misfit() {
    let law = Thornton::of(&MATERIAL, 1.6).unwrap();
    let mut impact = made_by(&law, 10.0);
    for sample in &mut impact.curve.samples {
        sample.force_n += 0.1 * impact.summary.max_force_n;
    }
    let mut comparison = Comparison::new(&MATERIAL, RADIUS, &[impact]);
    comparison.add("itself", &law);
    let row = row(comparison.rows(), "itself", 10.0);
    for misfit in [
        row.force_rmse_rel,
        row.force_rmse_loading_rel,
        row.force_rmse_unloading_rel,
    ] {
        assert!((misfit.unwrap() - 0.1).abs() < 1e-9);
    }
}

#[test]
fn theories_stand_to_the_finite_element_impacts_as_known() {
    let mut comparison = Comparison::new(&MATERIAL, RADIUS, &references());
    comparison.add_theories(true);
    let rows = comparison.rows();
    assert_eq!(rows.len(), 2 * (1 + Theory::ALL.len()));
    assert!(
        rows[..2]
            .iter()
            .all(|row| row.law == SIMULATION && row.errors().is_none())
    );
    for velocity in [10.0, 50.0] {
        let of = |law| row(rows, law, velocity);
        // one truncated pressure cannot carry full plasticity: far too little force
        assert!(of("thornton").max_force_error_rel.unwrap() < -0.3);
        // no plasticity: too much force, and e = 1
        assert!(of("hertz").max_force_error_rel.unwrap() > 0.15);
        // the finite-element fits follow the force within a tenth of F*
        assert!(of("jackson-green").force_rmse_loading_rel.unwrap() < 0.1);
        assert!(of("jackson-green").max_force_error_rel.unwrap().abs() < 0.05);
        assert!(of("hertz").force_rmse_rel > of("jackson-green").force_rmse_rel);
    }
}

#[test]
fn files_hold_every_row_and_the_table_names_what_was_left_out() {
    let mut impacts = references().to_vec();
    impacts[1].summary.status = Status::NoRebound;
    let mut comparison = Comparison::new(&MATERIAL, RADIUS, &impacts);
    comparison.add_theories(true);
    let folder = tempfile::tempdir().unwrap();
    comparison.write(folder.path(), "made by a test").unwrap();

    let text = std::fs::read_to_string(folder.path().join("compare.csv")).unwrap();
    let header = "law,velocity_m_s,max_force_N,max_displacement_m,restitution,contact_time_s,force_rmse_rel,";
    assert!(text.lines().nth(1).unwrap().starts_with(header));
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let rows: Vec<Row> = reader.deserialize().map(|row| row.unwrap()).collect();
    assert_eq!(rows, comparison.rows());

    let table = std::fs::read_to_string(folder.path().join("compare.md")).unwrap();
    assert!(table.contains("Left out (no rebound): 50 m/s."), "{table}");
    let position = |law: &str| table.find(&format!("\n| {law}")).unwrap();
    assert!(
        position("jackson-green") < position("thornton "),
        "best first\n{table}"
    );
}

#[test]
fn an_elastic_body_is_compared_with_hertz_alone() {
    let mut comparison = Comparison::new(&ELASTIC, RADIUS, &references());
    comparison.add_theories(true);
    let laws: Vec<_> = comparison
        .rows()
        .iter()
        .map(|row| row.law.as_str())
        .collect();
    assert_eq!(laws, ["mpm", "mpm", "hertz", "hertz"]);
    assert!(!comparison.markdown().contains("thornton"));
}

#[test]
fn the_command_goes_from_impact_folders_and_a_law_file_to_both_files() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/thesis-4-4.toml");
    assert_eq!(Case::read(&case).unwrap().material, MATERIAL);
    let folder = tempfile::tempdir().unwrap();
    let impacts = folder.path().to_owned();
    for mut impact in references() {
        impact.summary.particle = Some(Particle::of(&MATERIAL, RADIUS));
        let name = format!("impact_V{}", impact.summary.velocity_m_s);
        impact
            .write(&impacts.join(name), "finite elements")
            .unwrap();
    }
    let context = Context {
        command: "impactlaw compare".to_owned(),
        quiet: true,
        program: Cli::command,
        log: Default::default(),
    };
    let fit_args = FitArgs {
        case: case.clone(),
        impacts: Some(impacts.clone()),
        out: None,
        json: false,
    };
    fit_args.run(&context).unwrap();
    let args = CompareArgs {
        case,
        law: None,
        impacts: Some(impacts.clone()),
        out: None,
        json: false,
        series: None,
        unverified: false,
    };
    args.run(&context).unwrap();

    let table = std::fs::read_to_string(impacts.join("compare.md")).unwrap();
    let first = table
        .lines()
        .find(|line| line.starts_with("| fitted") || line.starts_with("| jackson"));
    assert!(
        first.unwrap().starts_with("| fitted"),
        "the fitted law is best\n{table}"
    );
    let csv = std::fs::read_to_string(impacts.join("compare.csv")).unwrap();
    // what is unverified is compared on request only
    let laws = Theory::compared(&MATERIAL).count() + 2;
    let asked = |name: &str| !csv.contains(name);
    assert!(asked("stronge") && asked("kogut-etsion-hertzian") && laws < Theory::ALL.len() + 2);
    assert_eq!(csv.lines().count(), 2 + 2 * (1 + laws), "{csv}");
}

#[test]
fn hardening_that_no_theory_knows_is_said_and_perfect_plasticity_says_nothing() {
    let law = Thornton::of(&MATERIAL, 1.6).unwrap();
    let impacts = [made_by(&law, 10.0)];
    let said = |material| {
        let mut comparison = Comparison::new(&material, RADIUS, &impacts);
        comparison.add_theories(true);
        let sentences = comparison.left_out_by_theories();
        let text = comparison.markdown();
        assert!(sentences.iter().all(|sentence| text.contains(sentence)));
        sentences
    };
    assert_eq!(said(MATERIAL), Vec::<String>::new());

    let strength = MATERIAL.flow.unwrap().yield_strength();
    let hardening = |modulus| Material {
        flow: Some(Flow::LinearHardening(LinearHardening { strength, modulus })),
        ..MATERIAL
    };
    assert_eq!(said(hardening(0.0)), Vec::<String>::new());
    let [sentence] = &said(hardening(2e9))[..] else {
        panic!("one constant is left out, in one sentence")
    };
    assert!(sentence.contains("hardening modulus (2 GPa)"), "{sentence}");
    let list = sentence.split_once("no part in ").unwrap().1;
    let named: Vec<&str> = list.split(':').next().unwrap().split(", ").collect();
    // Hertz is elastic by name: no yield strength either
    let names = |theory: &Theory| {
        let flow = theory.publication().flow;
        let knows = flow.is_empty() || flow.contains(&HARDENING_MODULUS);
        knows != named.contains(&theory.name())
    };
    assert!(Theory::ALL.iter().all(names), "{sentence}");
}
