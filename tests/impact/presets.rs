//! Presets: what the thesis' method gives where its tables say it, and what each of the others must do.

use impactlaw::case::Case;
use impactlaw::curve::files::{FromFiles, rows};
use impactlaw::curve::{Curve, Impact, Sample, Status, Summary};
use impactlaw::impact::simulate;
use impactlaw::plan::plan;
use std::f64::consts::PI;
use std::path::Path;

fn run(text: &str) -> Impact {
    let case = Case::parse(text, Path::new("c.toml")).unwrap();
    let velocity = case.velocities[0];
    let done = simulate(&case.material, case.radius, &plan(&case, velocity));
    assert_eq!(done.impact.summary.status, Status::Ok, "{text}");
    done.impact
}

/// A ball of table 6-1.
fn ball(density: f64, modulus: f64, velocity: f64, scheme: &str) -> String {
    format!(
        "[particle]\nradius = \"12.5 mm\"\n[material]\ndensity = \"{density} kg/m3\"\nyoung_modulus = \"{modulus} MPa\"\n\
         poisson_ratio = 0.25\n[impact]\nvelocities = [\"{velocity} m/s\"]\n[accuracy]\ntolerance = 0.02\n{scheme}"
    )
}

/// A ball of density (kg/m3), modulus (MPa), velocity (m/s) that keeps this height over its diameter, as printed in tables 6-3 and 6-4.
fn rebounds_as_printed([density, modulus, velocity, height]: [f64; 4]) {
    // section 6.2: 50 points a diameter, ratio 1.05; its step of 1 ns gives the same as 100 ns to 1e-4 (the next test)
    let scheme = "[scheme]\npreset = \"thesis\"\ndimensions = 2\n";
    let s = run(&ball(density, modulus, velocity, scheme)).summary;
    assert!((0.975..0.985).contains(&s.restitution), "{}", s.restitution);
    let found = s.height_at_max_compression_ratio;
    assert!((found - height).abs() < 6e-3, "{found} {height}");
    // of the 3.5 % of the energy that are missing transfers took 1; nothing is unaccounted for
    let scheme = s.scheme.unwrap();
    assert!(
        (0.005..0.02).contains(&scheme.transfer_loss_ratio),
        "{scheme:?}"
    );
    assert!(s.energy_closure < 1e-3, "{}", s.energy_closure);
}

#[test]
fn a_ball_under_the_thesis_preset_rebounds_as_it_prints() {
    rebounds_as_printed([889.0, 2.57, 4.3, 0.89]);
}

#[test]
#[ignore = "half a minute of a core"]
fn the_other_balls_under_the_thesis_preset_rebound_as_it_prints() {
    rebounds_as_printed([894.0, 3.55, 5.41, 0.88]);
    rebounds_as_printed([1404.0, 4.9, 5.74, 0.87]);
}

#[test]
fn a_tenth_of_the_step_changes_nothing_under_the_thesis_preset() {
    let e = |step: &str| {
        let scheme = format!("[scheme]\npreset = \"thesis\"\npoints = 25\ndimensions = 2\n{step}");
        run(&ball(889.0, 2.57, 4.3, &scheme)).summary.restitution
    };
    let (long, short) = (e(""), e("time_step = 0.01\n"));
    assert!((long - short).abs() < 1e-3, "{long} {short}");
}

#[test]
fn every_preset_runs_and_loses_what_its_transfer_must_lose() {
    let with = |scheme: &str| {
        let summary = run(&ball(889.0, 2.57, 4.3, scheme)).summary;
        assert!(
            summary.energy_closure < 0.02,
            "{scheme} {}",
            summary.energy_closure
        );
        summary
    };
    let own = with("");
    assert_eq!(own.scheme, None);
    let of = |preset: &str, more: &str| with(&format!("[scheme]\npreset = \"{preset}\"\n{more}"));
    let flip = of("flip", "");
    let (pic, apic) = (of("pic", ""), of("apic", ""));
    let lost = |s: &Summary| s.scheme.as_ref().unwrap().transfer_loss_ratio;
    assert!(pic.restitution < apic.restitution && apic.restitution < own.restitution);
    assert!(lost(&pic) > lost(&apic) && lost(&apic) > 0.0);
    // FLIP may gain as well as lose, with the length of its steps
    assert!(lost(&flip).abs() < 0.06, "{}", lost(&flip));
    for preset in ["tlmpm", "ulmpm"] {
        let found = of(preset, "points = 26\n");
        assert!(found.scheme.as_ref().unwrap().files.is_none());
        // a staircase of 26 points a diameter
        let force = found.max_force_n / own.max_force_n;
        assert!((0.9..1.3).contains(&force), "{preset}: {force}");
    }
}

/// A contact of one second with a force of sin(pi t) and the displacement that it gives a mass of 1/pi at a speed of 1: the
/// velocity is cos(pi t).
fn pulse() -> (Curve, Summary) {
    let text = ball(889.0, 2.57, 4.3, "[scheme]\npreset = \"flip\"\n").replace("0.02", "0.2");
    let mut impact = run(&text);
    let count = 400;
    let sample = |k: i32| {
        let (a, b) = (
            f64::from(k) / f64::from(count),
            f64::from(k + 1) / f64::from(count),
        );
        let middle = 0.5 * (a + b);
        Sample {
            time_s: middle,
            displacement_m: (PI * middle).sin() / PI,
            force_n: ((PI * a).cos() - (PI * b).cos()) / PI / (b - a),
            ..impact.curve.samples[0]
        }
    };
    let curve = Curve {
        samples: (0..count).map(sample).collect(),
    };
    impact.summary.contact_time_s = 1.0;
    impact.summary.velocity_m_s = 1.0;
    impact.summary.restitution = 1.0;
    (curve, impact.summary)
}

#[test]
fn files_hold_means_since_the_one_before_and_count_from_the_first_with_a_force() {
    let (curve, summary) = pulse();
    let found = rows(&curve, &summary, 0.2, 0.0);
    assert_eq!(found.len(), 5);
    let place = |t: f64| if t < 0.0 { t } else { (PI * t).sin() / PI };
    let start = 0.5 * (place(0.0) + place(0.2));
    for (k, row) in found.iter().enumerate() {
        let (a, b) = (0.2 * k as f64, 0.2 * (k + 1) as f64);
        let exact = [
            a,
            ((PI * a).cos() - (PI * b).cos()) / PI / 0.2,
            0.5 * (place(a) + place(b)) - start,
        ];
        for (x, y) in row.iter().zip(exact) {
            assert!((x - y).abs() < 2e-4, "{row:?} {exact:?}");
        }
    }
    // half an interval later: the first and the last file are means over the half that is in contact
    let late = rows(&curve, &summary, 0.2, 0.5);
    assert_eq!(late.len(), 6);
    assert!((late[0][1] - (1.0 - (PI * 0.1).cos()) / PI / 0.1).abs() < 2e-4);
    assert!((late[5][1] - late[0][1]).abs() < 2e-4, "symmetric");
    let files = FromFiles::of(&curve, &summary, 0.2, 0.0);
    assert_eq!(files.count, 5);
    assert!((files.contact_time_s - 0.8).abs() < 1e-9);
    // sin(pi t) over the middle fifth
    assert!((files.max_force_n - 2.0 * (PI * 0.1).sin() / PI / 0.2).abs() < 2e-4);
}

#[test]
fn files_alone_make_the_force_of_table_4_4_low_at_10_m_s_and_not_at_50() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/thesis-4-4.toml");
    let case = Case::read(&case).unwrap();
    // 30 um to the wall in ten files (section 4.2); F* as printed
    let span = |velocity: f64, printed: f64| {
        let done = simulate(&case.material, case.radius, &plan(&case, velocity));
        let Impact { summary, curve } = done.impact;
        let read = |k: i32| {
            let files = FromFiles::of(&curve, &summary, 3e-6 / velocity, f64::from(k) / 16.0);
            files.max_force_n / summary.max_force_n
        };
        let all: Vec<f64> = (0..16).map(read).collect();
        let low = all.iter().copied().fold(f64::INFINITY, f64::min);
        let high = all.iter().copied().fold(0.0, f64::max);
        (low, high, printed / summary.max_force_n)
    };
    let (low, high, printed) = span(10.0, 10.7);
    // three or four files a contact: whatever their moments, the largest mean is 5 to 18 % below the largest force
    assert!(low > 0.80 && high < 0.96, "{low} {high}");
    // the print is lower still: files are half of the reason
    assert!(printed < low, "{printed}");
    let (low, _, printed) = span(50.0, 70.9);
    assert!(low > 0.98 && printed < 0.95, "{low} {printed}");
}
