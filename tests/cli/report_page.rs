//! The report page from synthetic data: complete, partial, and without any network access.

use impactlaw::case::Case;
use impactlaw::curve::{Status, Summary};
use impactlaw::report::RunPage;
use impactlaw::report::run_page::Choice;

const CASE: &str = r#"
[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
[impact]
velocities = ["10 m/s", "50 m/s"]
[accuracy]
tolerance = 0.02
"#;

fn case() -> Case {
    Case::parse(CASE, "cases/steel.toml".as_ref()).unwrap()
}

fn summary(velocity_m_s: f64, status: Status) -> Summary {
    Summary {
        velocity_m_s,
        restitution: 0.6425,
        max_force_n: 14.72,
        max_displacement_m: 4.099e-6,
        max_centre_displacement_m: 4.113e-6,
        residual_displacement_m: 2.321e-6,
        contact_time_s: 1.03e-6,
        compression_ratio: 0.0047,
        height_at_max_compression_ratio: 0.99,
        equivalent_plastic_strain: 0.00017,
        plastic_work_ratio: 0.5298,
        energy_closure: 1e-5,
        shock_work_ratio: 0.0,
        eroded_volume_ratio: 0.0,
        warnings: Vec::new(),
        points: 20_000,
        steps: 123_456,
        wall_s: 2.0,
        adhesion: None,
        cylinder: None,
        target: None,
        scheme: None,
        heating: None,
        tangential: None,
        particle: None,
        status,
    }
}

fn page(case: &Case) -> RunPage<'_> {
    RunPage {
        case,
        target: None,
        case_text: CASE,
        command: "impactlaw run cases/steel.toml",
        version: "impactlaw 0.0.0",
        wall: None,
        predicted: None,
        plan: Vec::new(),
        impacts: Vec::new(),
        curves: Vec::new(),
        maps: Vec::new(),
        fit: None,
        comparison: Vec::new(),
        bed: None,
        references: Vec::new(),
        limits: Vec::new(),
    }
}

#[test]
fn a_page_without_results_still_says_what_was_asked_and_how() {
    let case = case();
    let html = page(&case).page().html();
    for text in [
        "250 µm",
        "1.25 GPa",
        "10, 50 m/s",
        "impactlaw run cases/steel.toml",
        &case.hash,
    ] {
        assert!(html.contains(text), "{text}");
    }
    for absent in [
        "id=\"bed\"",
        "id=\"fitted-law\"",
        "id=\"impacts\"",
        "id=\"plan\"",
    ] {
        assert!(!html.contains(absent), "{absent}");
    }
}

#[test]
fn the_page_shows_plan_figures_and_audit() {
    let case = case();
    let page = RunPage {
        predicted: Some(3.0),
        plan: vec![Choice {
            what: "friction".to_owned(),
            setting: "off".to_owned(),
            reason: "the impact is normal".to_owned(),
        }],
        impacts: vec![
            summary(10.0, Status::Ok),
            summary(50.0, Status::Failed("J <= 0 at step 7".to_owned())),
        ],
        ..page(&case)
    };
    let html = page.page().html();
    for text in [
        "the impact is normal",
        "F* (N)",
        "δ* (µm)",
        "4.099",
        "0.6425",
        "123456",
        "failed: J &lt;= 0 at step 7",
    ] {
        assert!(html.contains(text), "{text}");
    }
}

#[test]
fn the_page_needs_no_network_and_no_script() {
    let case = case();
    let html = page(&case).page().html();
    for forbidden in ["http://", "https://", "<script", "<link", "@import"] {
        assert!(!html.contains(forbidden), "{forbidden}");
    }
}
