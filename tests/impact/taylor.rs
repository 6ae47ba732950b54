//! Cylinders: the bar wave, the Taylor bar, and what is refused.

use impactlaw::Error;
use impactlaw::case::{Case, named};
use impactlaw::curve::{Cylinder, Status, Summary};
use impactlaw::document::Document;
use impactlaw::fit;
use impactlaw::impact::simulate;
use impactlaw::plan::{plan, with_cells};
use impactlaw::study::Study;
use std::path::Path;

/// Experiment of Johnson and Holmquist 1988, mm: length, foot, diameter at a fifth of the initial length.
const EXPERIMENT: [f64; 3] = [16.2, 13.5, 10.1];

fn bar() -> Case {
    Case::read(Path::new("cases/experiments/taylor-bar.toml")).unwrap()
}

fn run(case: &Case, cells: f64) -> Summary {
    let velocity = case.velocities[0];
    let plan = with_cells(plan(case, velocity), cells, &case.material);
    let summary = simulate(&case.material, case.radius, &plan).impact.summary;
    assert_eq!(summary.status, Status::Ok);
    assert!(summary.energy_closure < 5e-3, "{}", summary.energy_closure);
    summary
}

/// Figures in mm.
fn figures(summary: &Summary) -> [f64; 3] {
    let Cylinder {
        final_length_m,
        foot_diameter_m,
        diameter_at_fifth_m,
    } = summary.cylinder.unwrap();
    [final_length_m, foot_diameter_m, diameter_at_fifth_m].map(|x| 1e3 * x)
}

fn mean_error(figures: [f64; 3]) -> f64 {
    let errors = figures
        .iter()
        .zip(EXPERIMENT)
        .map(|(f, e)| (f / e - 1.0).abs());
    errors.sum::<f64>() / 3.0
}

#[test]
fn the_shipped_taylor_bar_ends_within_one_per_cent_of_the_experiment_on_a_coarse_grid() {
    let found = figures(&run(&bar(), 2.0));
    println!("{found:?} mean error {}", mean_error(found));
    assert!(mean_error(found) < 0.01, "{found:?}");
    // that of 32 cells a radius, which the eight of this grid are within 0.6 % of
    for (found, fine) in found.into_iter().zip([16.355, 13.526, 10.142]) {
        assert!((found / fine - 1.0f64).abs() < 0.01, "{found} {fine}");
    }
}

/// The bar with the constants of another copper.
fn of(name: &str) -> Case {
    let (material, _) = named::of_name(name).unwrap().unwrap();
    Case { material, ..bar() }
}

/// The constants of Karamelo's example: 4.5 % with twice as many cells, where its own code has 3.5 %.
#[test]
fn a_taylor_bar_of_karamelo_s_copper_ends_within_six_per_cent_of_the_experiment() {
    let found = figures(&run(&of("ofhc-copper-static"), 2.0));
    println!("{found:?} mean error {}", mean_error(found));
    assert!(mean_error(found) < 0.06, "{found:?}");
}

#[test]
fn a_taylor_bar_of_johnson_and_cook_s_copper_ends_within_nine_per_cent_and_keeps_its_energy_as_heat()
 {
    let summary = run(&of("ofhc-copper"), 2.0);
    let found = figures(&summary);
    println!(
        "{found:?} mean error {} {:?}",
        mean_error(found),
        summary.heating
    );
    assert!(mean_error(found) < 0.09, "{found:?}");
    assert_eq!(summary.eroded_volume_ratio, 0.0);
    let heating = summary.heating.unwrap();
    assert!(heating.max_temperature_k > 400.0 && heating.max_temperature_k < 1356.0);
    // the last output, which figures of energy are of, lies some steps before the end
    let warmed = 383.0 * (heating.mean_temperature_k - 298.0) / (0.5 * 190.0f64.powi(2));
    assert!((warmed / heating.heat_ratio - 1.0).abs() < 1e-5, "{warmed}");
}

#[test]
#[ignore = "a minute: 32 cells a radius"]
fn the_taylor_bar_is_converged_to_half_a_per_cent() {
    let all = [1.0, 0.5].map(|cells| figures(&run(&bar(), cells)));
    println!("{all:?}");
    for (planned, fine) in all[0].iter().zip(all[1]) {
        assert!((planned / fine - 1.0).abs() < 5e-3, "{all:?}");
    }
}

/// Saifoori 2025, table 6-12.
#[test]
#[ignore = "a minute: five particles that are flattened"]
fn aerosol_copper_is_compressed_as_measured_within_seven_hundredths_with_nothing_free() {
    let study =
        Study::from_document(&Document::read(Path::new("cases/aerosol-copper.toml")).unwrap());
    let cases = study.unwrap().cases;
    let measured = [0.63, 0.69, 0.57, 0.61, 0.57];
    assert_eq!(cases.len(), measured.len());
    let errors = cases.iter().zip(measured).map(|(case, measured)| {
        let plan = plan(case, case.velocities[0]);
        let summary = simulate(&case.material, case.radius, &plan).impact.summary;
        assert_eq!(summary.status, Status::Ok);
        assert!(summary.energy_closure < 1e-3, "{}", summary.energy_closure);
        summary.compression_ratio - measured
    });
    let errors: Vec<f64> = errors.collect();
    let mean = errors.iter().map(|e| e.abs()).sum::<f64>() / 5.0;
    println!("{errors:?} {mean}");
    assert!(mean < 0.07, "{errors:?}");
}

const ELASTIC: &str = "[particle]\nshape = \"cylinder\"\nradius = \"1 mm\"\nlength = \"10 mm\"\n[material]\ndensity = \"8000 kg/m3\"\n\
    young_modulus = \"200 GPa\"\npoisson_ratio = 0\n[impact]\nvelocities = [\"10 m/s\"]\n[accuracy]\ntolerance = 0.02\n";

fn parsed(text: &str) -> Result<Case, Error> {
    Case::parse(text, Path::new("bar.toml"))
}

/// Force over E and the first section in a thin bar stretched by `l`, of the solver's material without lateral contraction at small strain
/// (neo-Hookean, kappa E/3, mu E/2): the sides are free, and give way by the square of the strain.
fn nominal_stress(l: f64) -> f64 {
    let lateral = |q: f64| {
        let j = l * q * q;
        (j * j - 1.0) / 6.0 - j.powf(-2.0 / 3.0) * (l * l - q * q) / 6.0
    };
    let (mut low, mut high) = (0.9, 1.1);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match lateral(middle) < 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    let j = l * low * low;
    0.5 * j.powf(-2.0 / 3.0) * (l * l - low * low) / l
}

/// Speeds over sqrt(E/rho) of the waves in such a bar that stops from `mach` times it: of the shock that stops it, and of the part of the
/// release that takes half of the force off the wall.
///
/// Shock (Rankine and Hugoniot): rho U^2 (1 - l) = -P(l) and V = U (1 - l). The release is a fan of waves of speed^2 = P'(l)/rho; the wall
/// is at rest, so that each takes off twice what it carries: half of the force is gone with the wave of three quarters of it.
fn waves(mach: f64) -> [f64; 2] {
    let (mut shock, mut l) = (1.0, 1.0 - mach);
    for _ in 0..50 {
        shock = (-nominal_stress(l) / (1.0 - l)).sqrt();
        l = 1.0 - mach / shock;
    }
    let (mut low, mut high) = (l, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match nominal_stress(middle) < 0.75 * nominal_stress(l) {
            true => low = middle,
            false => high = middle,
        }
    }
    let slope = (nominal_stress(low + 1e-5) - nominal_stress(low - 1e-5)) / 2e-5;
    [shock, slope.sqrt()]
}

/// Two rods that meet at V each are one on a rigid wall. Without lateral contraction a bar is one wave: a force rho c V over its section
/// for as long as the wave takes there and back. At 100 m/s it is shortened by 2 %, and its waves are 1.2 % faster.
#[test]
fn rods_stop_with_rho_c_v_for_as_long_as_their_wave_takes_by_any_degree() {
    for (velocity, degree) in [
        (10.0, 1),
        (10.0, 2),
        (10.0, 3),
        (100.0, 1),
        (100.0, 2),
        (100.0, 3),
    ] {
        let text = ELASTIC.replace("10 m/s", &format!("{velocity} m/s"));
        let case = parsed(&text).unwrap();
        let speed = (200e9f64 / 8000.0).sqrt();
        let force = 8000.0 * speed * velocity * std::f64::consts::PI * 1e-6;
        let [there, back] = waves(velocity / speed);
        let time = 10e-3 / speed * (1.0 / there + 1.0 / back);
        let mut plan = plan(&case, velocity);
        plan.grid.degree = degree;
        plan.grid.coarse = plan.grid.fine;
        let impact = simulate(&case.material, case.radius, &plan).impact;
        let summary = &impact.summary;
        assert_eq!(summary.status, Status::Ok);
        assert!(summary.energy_closure < 1e-3, "{}", summary.energy_closure);
        let samples = &impact.curve.samples;
        let plateau = samples
            .iter()
            .filter(|s| (0.1..0.9).contains(&(s.time_s / time)));
        let forces: Vec<f64> = plateau.map(|s| s.force_n).collect();
        let mean = forces.iter().sum::<f64>() / forces.len() as f64;
        // the wave is back where the force has fallen to a half
        let last = samples
            .iter()
            .rposition(|s| s.force_n > 0.5 * force)
            .unwrap();
        let fallen = samples[last].time_s;
        println!(
            "{velocity} m/s, degree {degree}: force over rho c V {:.4} (shock {there:.4}), time over that of the waves {:.4}, over 2 L/c {:.4}, e {:.4}",
            mean / force,
            fallen / time,
            fallen * speed / 20e-3,
            summary.restitution
        );
        assert!(forces.len() > 50);
        assert!((mean / force - 1.0).abs() < 0.03, "{mean} {force}");
        assert!((fallen / time - 1.0).abs() < 0.01, "{fallen} {time}");
        assert!(summary.restitution > 0.95 && summary.restitution <= 1.0);
    }
}

#[test]
fn cylinders_are_refused_by_name_where_spheres_are_meant() {
    let refused = |from: &str, to: &str, key: &str, said: &str| {
        let text = ELASTIC.replace(from, to);
        assert_ne!(text, ELASTIC);
        let message = parsed(&text).unwrap_err().to_string();
        assert!(message.contains(key) && message.contains(said), "{message}");
    };
    refused(
        "length = \"10 mm\"\n",
        "",
        "`particle.shape`",
        "needs a `length`",
    );
    refused(
        "shape = \"cylinder\"\n",
        "",
        "`particle.length`",
        "a sphere has none",
    );
    refused(
        "\"10 mm\"",
        "\"0 mm\"",
        "`particle.length`",
        "must be positive",
    );
    refused(
        "\"10 mm\"",
        "\"100 m\"",
        "`particle.length`",
        "times the radius",
    );
    refused("cylinder", "cube", "particle.shape", "cylinder");
    refused(
        "[impact]",
        "[impact]\nangle = \"10 deg\"",
        "`impact.angle`",
        "frictionless wall",
    );
    refused(
        "[impact]",
        "[wall]\nfriction = 0.2\n[impact]",
        "`wall.friction`",
        "frictionless wall",
    );
    let message = fit::fit(&parsed(ELASTIC).unwrap(), &[])
        .unwrap_err()
        .to_string();
    assert!(message.contains("cylinder"), "{message}");
}
