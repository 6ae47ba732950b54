//! Law files: what they look like, that they survive a round trip bit for bit, and what they refuse.

use impactlaw::contact::NormalLaw;
use impactlaw::contact::unloading::Unloading;
use impactlaw::document::Document;
use impactlaw::law::file::*;
use impactlaw::law::{AnyLaw, FittedLaw};
use impactlaw::material::flow::FlowConstants;
use impactlaw::material::{Flow, MaterialTable, YIELD_PRESSURE_RATIO};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sha2::{Digest, Sha256};

fn quality(velocity_m_s: f64) -> QualityRow {
    QualityRow {
        velocity_m_s,
        max_force: 0.004,
        max_displacement: -0.002,
        restitution: 0.006,
        residual_displacement: -0.01,
        contact_time: 0.01,
        loading_force_rms: 0.007,
        unloading_force_rms: 0.012,
    }
}

/// A law file with round numbers.
fn example() -> LawFile {
    let unloading = UnloadingTable {
        residual_scale: 9.0,
        residual_power: 0.65,
        exponent_residual: -0.2,
        exponent_strain: 7.0,
    };
    let mut file = LawFile {
        schema: SCHEMA,
        name: "example".into(),
        form: Form::ClosedForm,
        warnings: Vec::new(),
        material: MaterialTable {
            density_kg_m3: 8000.0,
            young_modulus_pa: 100e9,
            poisson_ratio: 0.35,
            flow: FlowConstants::of(Some(&Flow::perfectly_plastic(1.25e9))),
        },
        pair: None,
        yield_point: None,
        valid: ValidTable {
            displacement_over_radius_max: 0.07,
            velocity_min_m_s: 10.0,
            velocity_max_m_s: 50.0,
        },
        thresholds: Some(ThresholdTable {
            tolerance: 0.02,
            error: 0.03,
            left_out: 0.1,
        }),
        provenance: ProvenanceTable {
            program: "impactlaw 0.1.0".into(),
            case: "example".into(),
            case_sha256: "0".repeat(64),
            radius_m: 250e-6,
            skipped_velocities_m_s: vec![60.0],
        },
        hertz: None,
        closed_form: Some(ClosedFormTable {
            departure: 0.5,
            breadth: 11.0,
            softening: 1.1,
            inertia: Some(9.0),
            unloading: unloading.clone(),
            intervals: None,
            quality: vec![quality(10.0)],
            left_out: vec![LeftOutRow {
                velocity_m_s: 10.0,
                max_force: 0.01,
                max_displacement: -0.01,
                restitution: 0.02,
            }],
        }),
        spline: Some(SplineTable {
            hertz_to: 2.0,
            knots: vec![[10.0, 26.0, 3.7], [90.0, 380.0, 4.4]],
            inertia: None,
            unloading,
            intervals: None,
            quality: vec![quality(10.0)],
            left_out: Vec::new(),
        }),
    };
    let point = file
        .material()
        .yield_point(1.0, YIELD_PRESSURE_RATIO)
        .unwrap();
    file.yield_point = Some(YieldTable {
        pressure_ratio: YIELD_PRESSURE_RATIO,
        displacement_over_radius: point.displacement,
        force_over_radius2_pa: point.force,
    });
    file
}

fn parse(text: &str) -> impactlaw::Result<LawFile> {
    LawFile::parse(&Document::new("law.toml".as_ref(), text))
}

#[test]
fn a_law_file_reads_like_this() {
    insta::assert_snapshot!(example().text().unwrap());
}

#[test]
fn a_law_file_comes_back_from_disk_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("law.toml");
    example().write(&path).unwrap();
    assert_eq!(LawFile::read(&path).unwrap(), example());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn every_admissible_constant_survives_bit_by_bit(
        w_1 in 1e-3f64..1e3, b in 1e-2f64..1e2, q in 0.0f64..1.333, c in 1e-2f64..1e4, k in 1e-3f64..1.5,
        n_1 in -0.5f64..3.0, n_2 in 0.0f64..40.0, x in 0.0f64..0.2
    ) {
        let mut file = example();
        let table = file.closed_form.as_mut().unwrap();
        (table.departure, table.breadth, table.softening) = (w_1, b, q);
        table.unloading = UnloadingTable {
            residual_scale: c,
            residual_power: k,
            exponent_residual: n_1,
            exponent_strain: n_2,
        };
        prop_assert!(Unloading::new(c, k, n_1, n_2).is_ok());
        let again = parse(&file.text().unwrap()).unwrap();
        prop_assert_eq!(&again, &file);
        let force = |f: &LawFile| f.law().unwrap().force(250e-6, x * 250e-6, 0.03 * 250e-6);
        prop_assert_eq!(force(&again).to_bits(), force(&file).to_bits());
    }
}

#[test]
fn every_form_of_the_file_is_a_law() {
    let file = example();
    assert!(matches!(file.law().unwrap(), FittedLaw::ClosedForm(_)));
    assert!(matches!(
        file.law_in(Form::Spline).unwrap(),
        FittedLaw::Spline(_)
    ));
    // 2 = sqrt(4): Hertz below both departures, F = F_y w^1.5
    let point = file
        .material()
        .yield_point(1e-3, YIELD_PRESSURE_RATIO)
        .unwrap();
    for form in [Form::ClosedForm, Form::Spline, Form::Hertz] {
        let force = file
            .law_in(form)
            .unwrap()
            .force(1e-3, 0.25 * point.displacement, 0.0);
        assert!(
            (force / (0.125 * point.force) - 1.0).abs() < 1e-12,
            "{form:?}"
        );
    }
}

#[test]
fn laws_go_by_name() {
    let (file, material) = (example(), example().material());
    let fitted = AnyLaw::named("fitted", Some(&file), &material).unwrap();
    assert_eq!(fitted, AnyLaw::Fitted(file.law().unwrap()));
    assert!(AnyLaw::named("thornton", None, &material).is_ok());
    let error = AnyLaw::named("fitted", None, &material)
        .unwrap_err()
        .to_string();
    assert!(error.contains("needs a law file"), "{error}");
    let error = AnyLaw::named("newton", None, &material)
        .unwrap_err()
        .to_string();
    assert!(error.contains("thornton"), "{error}");
}

/// The example with `from` replaced by `to` is refused with a message that holds `parts`.
fn refuse(from: &str, to: &str, parts: &[&str]) {
    let text = example().text().unwrap();
    assert!(text.contains(from), "{from} is not in the file");
    let error = parse(&text.replacen(from, to, 1)).unwrap_err().to_string();
    for part in parts {
        assert!(error.contains(part), "{part:?} is not in {error:?}");
    }
}

#[test]
fn inertia_of_a_file_is_that_of_the_law_and_leaves_its_force_at_rest_alone() {
    let mut file = example();
    let FittedLaw::ClosedForm(law) = file.law().unwrap() else {
        panic!("the file names the closed form");
    };
    let start = 0.5 * file.yield_point.as_ref().unwrap().displacement_over_radius;
    // 9 * 8000 kg/m3 * (10 m/s)^2 * sqrt(0.04)
    assert!((law.inertia().force(start + 0.04, 100.0) / 1.44e6 - 1.0).abs() < 1e-12);
    let at_rest = file.law().unwrap().force(250e-6, 5e-6, 0.0);
    file.closed_form.as_mut().unwrap().inertia = None;
    let without = parse(&file.text().unwrap()).unwrap().law().unwrap();
    assert_eq!(without.force(250e-6, 5e-6, 0.0), at_rest);
    let FittedLaw::ClosedForm(without) = without else {
        panic!("the file names the closed form");
    };
    assert!(without.inertia().is_none());
}

#[test]
fn another_schema_is_refused() {
    refuse(
        "schema = 1",
        "schema = 2",
        &["law.toml", "`schema`", "found 2", "must be 1"],
    );
    refuse(
        "schema = 1\n",
        "",
        &["`schema`", "found nothing", "must be 1"],
    );
    // even if nothing else of the file is known
    let error = parse("schema = 7\nwheels = 4\n").unwrap_err().to_string();
    assert!(error.contains("found 7"), "{error}");
}

#[test]
fn unknown_and_missing_keys_are_refused() {
    refuse("breadth = 11.0", "bredth = 11.0", &["bredth", "breadth"]);
    refuse("breadth = 11.0\n", "", &["missing field `breadth`"]);
}

#[test]
fn inadmissible_constants_are_refused() {
    refuse(
        "breadth = 11.0",
        "breadth = nan",
        &["`closed_form.breadth`", "found nan", "finite"],
    );
    refuse(
        "departure = 0.5",
        "departure = -0.5",
        &["`closed_form.departure`", "found -0.5"],
    );
    refuse(
        "softening = 1.1",
        "softening = 1.4",
        &["`closed_form.softening`", "4/3"],
    );
    refuse(
        "residual_scale = 9.0",
        "residual_scale = 1e30",
        &[
            "`closed_form.unloading.residual_scale`",
            "no residual would be left",
        ],
    );
    refuse(
        "residual_power = 0.65",
        "residual_power = 40.0",
        &["residual_scale", "nothing would be left to unload"],
    );
    refuse(
        "inertia = 9.0",
        "inertia = -1.0",
        &["`closed_form.inertia`", "found -1", "not negative"],
    );
    refuse(
        "exponent_strain = 7.0",
        "exponent_strain = -1.0",
        &["`closed_form.unloading.exponent_strain`", "cross"],
    );
    refuse(
        "exponent_residual = -0.2",
        "exponent_residual = -0.6",
        &["exponent_residual`", "-1/2"],
    );
    refuse(
        "[90.0, 380.0, 4.4]",
        "[90.0, 20.0, 4.4]",
        &[
            "`spline.knots[1]`",
            "force",
            "above that of the knot before",
        ],
    );
    refuse(
        "[90.0, 380.0, 4.4]",
        "[90.0, 380.0, 40.0]",
        &["`spline.knots[1]`", "slope", "three times"],
    );
    refuse(
        "[10.0, 26.0, 3.7]",
        "[10.0, 33.0, 3.7]",
        &["`spline.knots`", "exponent"],
    );
}

#[test]
fn numbers_that_contradict_the_material_are_refused() {
    refuse(
        "poisson_ratio = 0.35",
        "poisson_ratio = 0.5",
        &["`material.poisson_ratio`", "[0, 0.5)"],
    );
    refuse(
        "pressure_ratio = 1.6",
        "pressure_ratio = 1.7",
        &["`yield_point.", "must be that of the material"],
    );
    refuse(
        "form = \"closed_form\"",
        "form = \"hertz\"",
        &["`form`", "found \"hertz\""],
    );
    refuse(
        "velocity_max_m_s = 50.0",
        "velocity_max_m_s = 5.0",
        &["velocity_max_m_s`", "found 5.0"],
    );
    refuse(
        "displacement_over_radius_max = 0.07",
        "displacement_over_radius_max = inf",
        &["found inf"],
    );
}

#[test]
fn every_published_model_names_the_case_that_is_shipped() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut models = 0;
    for entry in std::fs::read_dir(root.join("models")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|kind| kind != "toml") {
            continue;
        }
        let file = LawFile::read(&path).unwrap();
        let case = root.join(format!("cases/{}.toml", file.provenance.case));
        let sum = Sha256::digest(std::fs::read(&case).unwrap());
        let hash: String = sum.iter().map(|byte| format!("{byte:02x}")).collect();
        let path = path.display();
        assert_eq!(
            file.provenance.case_sha256,
            hash,
            "{path}: run {} again",
            case.display()
        );
        models += 1;
    }
    assert!(models >= 2);
}
