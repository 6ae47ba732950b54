//! Command `theory`: the tables it prints, and what it refuses.

use impactlaw::case::Case;
use impactlaw::command::theory::{TheoryArgs, table};
use std::path::Path;

fn case() -> Case {
    Case::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/thesis-4-4.toml")).unwrap()
}

fn args(
    model: &str,
    displacements: &[&str],
    peak: Option<&str>,
    velocities: &[&str],
) -> TheoryArgs {
    let owned = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect();
    TheoryArgs {
        list: false,
        json: false,
        model: Some(model.to_owned()),
        case: None,
        displacements: owned(displacements),
        max_displacement: peak.map(str::to_owned),
        velocities: owned(velocities),
    }
}

fn values(text: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| {
        line.split(',')
            .map(|v| v.parse().unwrap_or(f64::NAN))
            .collect()
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn forces_are_printed_on_loading_and_on_unloading() {
    let text = table(
        &args("jackson-green", &["12.5 um", "25 um"], None, &[]),
        &case(),
    )
    .unwrap();
    assert_eq!(
        text.lines().next(),
        Some("displacement_m,force_N,contact_radius_m")
    );
    let rows = values(&text);
    assert_eq!(rows.len(), 2);
    assert!((rows[0][1] / 52.188989089 - 1.0).abs() < 1e-9);
    assert!((rows[1][1] / 109.05133932 - 1.0).abs() < 1e-9);

    let back = table(
        &args("jackson-green", &["11.25 um", "0 um"], Some("12.5 um"), &[]),
        &case(),
    );
    let back = values(&back.unwrap());
    assert!((back[0][1] / 27.025198760 - 1.0).abs() < 1e-9);
    assert!(back[0][2] < rows[0][2]);
    assert_eq!(back[1][1..], [0.0, 0.0]);
}

#[test]
fn restitution_is_printed_with_the_closed_form_where_there_is_one() {
    let header = Some("velocity_m_s,restitution,restitution_closed_form");
    let thornton = table(&args("thornton", &[], None, &["10 m/s"]), &case()).unwrap();
    assert_eq!(thornton.lines().next(), header);
    let row = &values(&thornton)[0];
    assert!((row[1] / row[2] - 1.0).abs() < 1e-9 && (row[1] - 0.465).abs() < 5e-4);

    let kogut = table(&args("kogut-etsion", &[], None, &["10 m/s"]), &case()).unwrap();
    assert!(kogut.ends_with(",\n"), "{kogut}");
    let wu = table(&args("wu-li-thornton", &[], None, &["50 m/s"]), &case()).unwrap();
    assert!(wu.lines().nth(1).unwrap().starts_with("50.0,,0.41"), "{wu}");
}

#[test]
fn senseless_requests_are_refused_with_a_remedy() {
    let refusals = [
        (
            args("jackson", &["1 um"], None, &[]),
            "must be one of hertz, johnson",
        ),
        (args("hertz", &[], None, &[]), "--displacements \"1 um\""),
        (
            args("hertz", &["1"], None, &[]),
            "must be a length with its unit",
        ),
        (args("hertz", &[], None, &["0 m/s"]), "must be positive"),
        (
            args("hertz", &["1 um"], Some("-1 um"), &[]),
            "must be positive",
        ),
        (
            args("wu-li-thornton", &["1 um"], None, &[]),
            "use --velocities",
        ),
    ];
    for (args, remedy) in refusals {
        let error = table(&args, &case()).unwrap_err().to_string();
        assert!(error.contains(remedy), "{error}");
    }
    let mut elastic = case();
    elastic.material.flow = None;
    let error = table(&args("thornton", &["1 um"], None, &[]), &elastic).unwrap_err();
    assert!(
        error.to_string().contains("material.yield_strength"),
        "{error}"
    );
}
