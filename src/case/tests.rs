//! Tests of case files: what is accepted, and what an error says.

use super::*;
use crate::material::Flow;
use crate::material::flow::LinearHardening;

const GOOD: &str = r#"
[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
hardening_modulus = "2 GPa"
[impact]
velocities = ["50 m/s", "10 m/s"]
[accuracy]
tolerance = 0.02
"#;

fn error(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    Case::parse(&GOOD.replace(from, to), Path::new("c.toml"))
        .unwrap_err()
        .to_string()
}

#[test]
fn a_good_case_is_in_si_and_ascending() {
    let case = Case::parse(GOOD, Path::new("cases/c.toml")).unwrap();
    assert_eq!(case.name, "c");
    assert_eq!(case.radius, 250e-6);
    assert_eq!(case.material.young_modulus, 100e9);
    let (strength, modulus) = (1.25e9, 2e9);
    let hardening = LinearHardening { strength, modulus };
    assert_eq!(case.material.flow, Some(hardening.into()));
    assert_eq!(case.velocities, [10.0, 50.0]);
    assert_eq!(case.hash.len(), 64);
}

#[test]
fn without_yield_strength_the_body_is_elastic() {
    let elastic = GOOD.replace("yield_strength = \"1.25 GPa\"\n", "");
    let text = elastic.replace("hardening_modulus = \"2 GPa\"\n", "");
    assert_eq!(
        Case::parse(&text, Path::new("c")).unwrap().material.flow,
        None
    );
    let error = Case::parse(&elastic, Path::new("c")).unwrap_err();
    assert!(
        error.to_string().contains("needs a `yield_strength`"),
        "{error}"
    );
}

#[test]
fn values_out_of_range_name_key_found_and_allowed() {
    for (from, to, key, found) in [
        (
            "\"250 um\"",
            "\"-250 um\"",
            "particle.radius",
            "\"-250 um\"",
        ),
        (
            "\"8000 kg/m3\"",
            "\"0 kg/m3\"",
            "material.density",
            "\"0 kg/m3\"",
        ),
        (
            "\"100 GPa\"",
            "\"-1 GPa\"",
            "material.young_modulus",
            "\"-1 GPa\"",
        ),
        ("0.35", "0.5", "material.poisson_ratio", "0.5"),
        ("0.35", "-0.1", "material.poisson_ratio", "-0.1"),
        ("0.35", "nan", "material.poisson_ratio", "nan"),
        (
            "\"1.25 GPa\"",
            "\"101 GPa\"",
            "material.yield_strength",
            "\"101 GPa\"",
        ),
        (
            "\"2 GPa\"",
            "\"-2 GPa\"",
            "material.hardening_modulus",
            "\"-2 GPa\"",
        ),
        (
            "\"50 m/s\"",
            "\"0 m/s\"",
            "impact.velocities[0]",
            "\"0 m/s\"",
        ),
        (
            "\"50 m/s\"",
            "\"1000 cm/s\"",
            "impact.velocities[1]",
            "\"10 m/s\"",
        ),
        ("[\"50 m/s\", \"10 m/s\"]", "[]", "impact.velocities", "[]"),
        ("0.02", "0", "accuracy.tolerance", "0"),
        ("0.02", "0.3", "accuracy.tolerance", "0.3"),
    ] {
        let text = error(from, to);
        let start = format!("c.toml: `{key}`: found {found}; ");
        assert!(text.starts_with(&start), "{text}");
    }
}

#[test]
fn the_bed_scene_must_exist_beside_the_case() {
    let text = format!("{GOOD}[bed]\nscene = \"no-such-scene.toml\"\n");
    let error = Case::parse(&text, Path::new("cases/c.toml")).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("cases/no-such-scene.toml does not exist"),
        "{error}"
    );
}

#[test]
fn the_command_line_replaces_the_speeds() {
    let case = || Case::parse(GOOD, Path::new("c.toml")).unwrap();
    let with = |texts: &[&str]| {
        let texts: Vec<String> = texts.iter().map(|text| (*text).to_owned()).collect();
        case().with_velocities(&texts)
    };
    assert_eq!(with(&[]).unwrap().velocities, [10.0, 50.0]);
    assert_eq!(with(&["3 m/s", "1 m/s"]).unwrap().velocities, [1.0, 3.0]);
    for bad in [&["3"][..], &["0 m/s"], &["-1 m/s"], &["3 m/s", "3 m/s"]] {
        let text = with(bad).unwrap_err().to_string();
        assert!(text.starts_with("--velocity: found"), "{text}");
    }
}

#[test]
fn an_unknown_key_of_the_material_is_told_the_constants_of_every_flow_stress() {
    let text = GOOD.replace("hardening_modulus", "hardening_modulos");
    let text = Case::parse(&text, Path::new("c.toml"))
        .unwrap_err()
        .to_string();
    assert!(
        text.starts_with("c.toml: `material.hardening_modulos`: unknown field"),
        "{text}"
    );
    for key in ["density", "yield_strength", "hardening_modulus"] {
        assert!(text.contains(&format!("`{key}`")), "{text}");
    }
    let text = error("yield_strength = \"1.25 GPa\"", "yield_strength = 1.25e9");
    assert!(text.contains("`material.yield_strength`"), "{text}");
    assert!(text.contains("a pressure with its unit"), "{text}");
}

#[test]
fn a_hardening_modulus_of_zero_is_perfect_plasticity() {
    let text = GOOD.replace("\"2 GPa\"", "\"0 Pa\"");
    let case = Case::parse(&text, Path::new("c")).unwrap();
    assert_eq!(case.material.flow, Some(Flow::perfectly_plastic(1.25e9)));
}

/// Values that are slips of a unit: from, to, key, what is said.
const SLIPS: [(&str, &str, &str, &str); 13] = [
    (
        "\"250 um\"",
        "\"250 m\"",
        "particle.radius",
        "250 m is not between 10 nm and 10 m",
    ),
    (
        "\"250 um\"",
        "\"0.25 nm\"",
        "particle.radius",
        "250 pm is not between",
    ),
    (
        "\"8000 kg/m3\"",
        "\"8 kg/m3\"",
        "material.density",
        "8 kg/m³ is not between 25 kg/m³ and 25000 kg/m³",
    ),
    (
        "\"8000 kg/m3\"",
        "\"8000 g/cm3\"",
        "material.density",
        "is not between",
    ),
    (
        "\"100 GPa\"",
        "\"100 TPa\"",
        "material.young_modulus",
        "100 TPa is not between 1 kPa and 2 TPa",
    ),
    ("0.35", "0.4999", "material.poisson_ratio", "incompressible"),
    (
        "\"1.25 GPa\"",
        "\"90 GPa\"",
        "material.yield_strength",
        "E/Y = 1.11 is less than any solid's",
    ),
    (
        "\"1.25 GPa\"",
        "\"1.25 kPa\"",
        "material.yield_strength",
        "E/Y = 8e7 is more",
    ),
    (
        "\"2 GPa\"",
        "\"2 TPa\"",
        "material.hardening_modulus",
        "above young_modulus",
    ),
    (
        "\"50 m/s\"",
        "\"50 km/s\"",
        "impact.velocities",
        "50000 m/s is above the speed of sound sqrt(E/rho), 3536 m/s",
    ),
    (
        "\"10 m/s\"",
        "\"1e-200 m/s\"",
        "impact.velocities",
        "is rest",
    ),
    (
        "\"1.25 GPa\"",
        "\"125 kPa\"",
        "material.yield_strength",
        "E/Y = 800000 is more than any solid's",
    ),
    (
        "\"2 GPa\"",
        "\"2 kPa\"",
        "material.hardening_modulus",
        "of yield_strength, which changes nothing; 0 is none",
    ),
];

#[test]
fn slips_of_units_are_caught_and_what_is_meant_is_kept() {
    for (from, to, key, why) in SLIPS {
        let text = error(from, to);
        assert!(
            text.contains(&format!("check the unit of {key}: ")),
            "{text}"
        );
        assert!(text.contains(why), "{text}");
        let bad = GOOD.replacen(from, to, 1);
        assert_ne!(bad, GOOD);
        // a body so soft is also hit too hard
        let meant = format!("unusual = [\"{key}\", \"impact.velocities\"]\n{bad}");
        Case::parse(&meant, Path::new("c.toml")).unwrap();
        let other = format!(
            "unusual = [\"{}\"]\n{bad}",
            if key == "particle.radius" {
                "material.density"
            } else {
                "particle.radius"
            }
        );
        assert!(Case::parse(&other, Path::new("c.toml")).is_err(), "{other}");
    }
}

#[test]
fn polymers_gels_and_foams_are_no_slips() {
    // polyethylene, gelatine, aluminium foam, annealed pure aluminium, tungsten carbide
    for (density, modulus, strength) in [
        ("950 kg/m3", "0.8 GPa", "20 MPa"),
        ("1000 kg/m3", "10 kPa", "2 kPa"),
        ("300 kg/m3", "500 MPa", "3 MPa"),
        ("2700 kg/m3", "69 GPa", "8 MPa"),
        ("15.6 g/cm3", "650 GPa", "3 GPa"),
    ] {
        let text = GOOD
            .replace("8000 kg/m3", density)
            .replace("100 GPa", modulus)
            .replace("1.25 GPa", strength)
            .replace("hardening_modulus = \"2 GPa\"\n", "")
            .replace("\"10 m/s\"", "\"0.2 m/s\"")
            .replace("\"50 m/s\"", "\"0.5 m/s\"");
        let case = Case::parse(&text, Path::new("c.toml"));
        assert!(case.is_ok(), "{density}: {}", case.unwrap_err());
    }
}

#[test]
fn a_metal_whose_stresses_have_all_lost_a_prefix_is_a_slip() {
    let text = GOOD
        .replace("100 GPa", "100 MPa")
        .replace("1.25 GPa", "1.25 MPa")
        .replace("\"2 GPa\"", "\"2 MPa\"");
    let said = Case::parse(&text, Path::new("c.toml"))
        .unwrap_err()
        .to_string();
    let why =
        "check the unit of material.young_modulus: 100 MPa is less than metals and ceramics have";
    assert!(said.contains(why), "{said}");
}

#[test]
fn a_body_that_no_impact_leaves_anything_of_is_a_slip() {
    let text = GOOD
        .replace("1.25 GPa", "2 MPa")
        .replace("50 m/s", "300 m/s");
    let text = text.replace("hardening_modulus = \"2 GPa\"\n", "");
    let text = Case::parse(&text, Path::new("c.toml"))
        .unwrap_err()
        .to_string();
    assert!(text.contains("rho V^2/Y = 360: nothing is left"), "{text}");
}

#[test]
fn an_elastic_body_that_would_be_flattened_is_a_slip() {
    let elastic = GOOD
        .replace("yield_strength = \"1.25 GPa\"\n", "")
        .replace("hardening_modulus = \"2 GPa\"\n", "")
        .replace("50 m/s", "3000 m/s");
    let text = Case::parse(&elastic, Path::new("c.toml"))
        .unwrap_err()
        .to_string();
    assert!(text.contains("the expected delta* is 1.44 radii"), "{text}");
}

#[test]
fn only_keys_that_are_checked_can_be_named_unusual() {
    let text = format!("unusual = [\"material.densty\"]\n{GOOD}");
    let text = Case::parse(&text, Path::new("c.toml"))
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("`unusual[0]`: found \"material.densty\"; must be one of particle.radius,"),
        "{text}"
    );
}

#[test]
fn speeds_of_the_command_line_are_checked_for_slips_too() {
    let case = Case::parse(GOOD, Path::new("c.toml")).unwrap();
    let text = case
        .with_velocities(&["50 km/s".to_owned()])
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("--velocity: found \"50 km/s\"; check the unit: 50000 m/s is above"),
        "{text}"
    );
    let meant = GOOD.replace("50 m/s", "50 km/s");
    let meant = format!("unusual = [\"impact.velocities\"]\n{meant}");
    let case = Case::parse(&meant, Path::new("c.toml")).unwrap();
    assert_eq!(
        case.with_velocities(&["50 km/s".to_owned()])
            .unwrap()
            .velocities,
        [50e3]
    );
}
