//! A bed under a law outside the range of its impacts says so: below the slowest and above the fastest, by where contacts turn.

use crate::scene_run::run;
use impactlaw::bed::run::BedReport;
use impactlaw::bed::scene::Scene;
use std::path::Path;

/// Two equal solder balls that meet at twice `speed` (m/s), each as if it hit a wall at `speed`, at the true stiffness; a law that
/// rests on impacts of 5 to 30 m/s.
fn head_on(speed: f64, more: &str) -> BedReport {
    let law = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/laws/sac305-5-to-30.toml"
    );
    let folder = tempfile::tempdir().unwrap();
    let balls = format!(
        "x_m,y_m,z_m,radius_m,vx_m_s,vy_m_s,vz_m_s\n0,0,0,250e-6,{speed},0,0\n510e-6,0,0,250e-6,-{speed},0,0\n"
    );
    std::fs::write(folder.path().join("balls.csv"), balls).unwrap();
    let text = format!(
        "seed = 1\ngravity = \"0 m/s2\"\n[materials.solder]\nlaw = '{law}'\n[grains]\nmaterial = \"solder\"\n\
         file = {{ path = \"balls.csv\" }}\n{more}\
         [domain]\nlow = [\"-20 mm\", \"-20 mm\", \"-20 mm\"]\nhigh = [\"20 mm\", \"20 mm\", \"20 mm\"]\n\
         [[stage]]\nkind = \"run\"\nduration = \"{} us\"\n[output]\nrows = 8\nframes = 0\nfilm = 4\n",
        20.0 + 12.0 / speed
    );
    run(&Scene::parse(&text, &folder.path().join("range.toml")).unwrap()).0
}

fn warned(report: &BedReport, of: &str) -> bool {
    let warnings = &report.laws[0].summary.warnings;
    warnings.iter().any(|warning| warning.contains(of))
}

const BELOW: &str = "slowest impact of the law (5 m/s)";
const BEYOND: &str = "beyond the range of the law";

#[test]
fn impacts_slower_than_the_slowest_of_the_law_are_told_and_others_are_not() {
    // what decides is the flattening, found by the work of loading: the edge is at 5 m/s itself
    for (speed, below, beyond) in [
        (0.3, true, false),
        (4.9, true, false),
        (5.1, false, false),
        (20.0, false, false),
        (32.0, false, true),
    ] {
        let report = head_on(speed, "");
        let summary = &report.laws[0].summary;
        let found = (warned(&report, BELOW), warned(&report, BEYOND));
        assert_eq!(
            found,
            (below, beyond),
            "{speed} m/s: {:?}",
            summary.warnings
        );
        assert_eq!(summary.below_validity, usize::from(below), "{speed} m/s");
        let share = if below { 1.0 } else { 0.0 };
        assert_eq!(summary.below_validity_share, share, "{speed} m/s");
        assert_eq!(summary.beyond_validity, usize::from(beyond), "{speed} m/s");
    }
}

#[test]
fn an_impact_that_stays_elastic_is_within_the_range_of_every_law() {
    // first yield of the solder is at 1.24 mm/s: V_y^2 = 0.8 F_y delta_y / m, constants of the law file
    let report = head_on(0.001, "");
    assert!(
        !warned(&report, BELOW),
        "{:?}",
        report.laws[0].summary.warnings
    );
}

#[test]
fn softer_contacts_are_flattened_further_and_the_flattening_decides() {
    let soft = "[contact]\nstiffness = 0.05\n";
    // twenty times as soft, 3 m/s flatten as 3 sqrt(20) = 13 m/s do: what decides is the branch of the law they let go along
    let stiff = head_on(3.0, "");
    let softened = head_on(3.0, soft);
    assert!(warned(&stiff, BELOW));
    assert!(
        !warned(&softened, BELOW),
        "{:?}",
        softened.laws[0].summary.warnings
    );
}

#[test]
fn a_page_shows_the_warnings_of_its_run() {
    let law = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/laws/sac305-5-to-30.toml"
    );
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n[materials.solder]\nlaw = '{law}'\n[[grains]]\nmaterial = \"solder\"\ncount = 4\nradius = \"250 um\"\n\
         velocity = [\"0 m/s\", \"0 m/s\", \"-0.4 m/s\"]\n[contact]\nrestitution = 0.8\n[box]\nwidth = \"2 mm\"\ndepth = \"2 mm\"\nheight = \"6 mm\"\n\
         [[stage]]\nkind = \"run\"\nduration = \"4 ms\"\n[output]\nrows = 10\nframes = 0\nfilm = 5\n"
    );
    let (report, folder) = run(&Scene::parse(&text, Path::new("drop.toml")).unwrap());
    assert!(
        warned(&report, BELOW),
        "{:?}",
        report.laws[0].summary.warnings
    );
    let law = &report.laws[0].law;
    let page = std::fs::read_to_string(folder.path().join(format!("bed/{law}/bed.html"))).unwrap();
    assert!(page.contains("<details open><summary>1 warning</summary>"));
    assert!(page.contains(BELOW));
    let summary =
        std::fs::read_to_string(folder.path().join(format!("bed/{law}/summary.json"))).unwrap();
    assert!(
        summary.contains("\"below_validity\": ") && summary.contains("\"below_validity_share\": ")
    );
}
