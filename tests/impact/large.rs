//! Large deformation: impacts that flatten the particle run to their rebound, and do not depend on the grid.

use impactlaw::case::Case;
use impactlaw::curve::{Status, Summary};
use impactlaw::impact::simulate;
use impactlaw::plan::{Grid, plan};
use std::path::Path;

/// Impact at given E/Y and rho V^2/Y, with cells `size` times those of the plan.
fn impact(young_over_yield: f64, severity: f64, size: f64) -> Summary {
    changed(young_over_yield, severity, |grid| {
        grid.fine *= size;
        grid.coarse *= size;
    })
}

/// Impact at given E/Y and rho V^2/Y on a changed grid.
fn changed(young_over_yield: f64, severity: f64, change: impl Fn(&mut Grid)) -> Summary {
    let yield_pa = 1e9 / young_over_yield;
    let velocity = (severity * yield_pa / 1000.0).sqrt();
    let text = format!(
        "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
         poisson_ratio = 0.35\nyield_strength = \"{yield_pa} Pa\"\n[impact]\nvelocities = [\"{velocity} m/s\"]\n\
         [accuracy]\ntolerance = 0.02\n"
    );
    let case = Case::parse(&text, Path::new("large.toml")).unwrap();
    let mut plan = plan(&case, velocity);
    assert!(plan.grid.remedies.is_large());
    change(&mut plan.grid);
    let summary = simulate(&case.material, case.radius, &plan).impact.summary;
    assert_eq!(summary.status, Status::Ok);
    assert!(
        summary.energy_closure < 0.01,
        "{young_over_yield}, {severity}: {}",
        summary.energy_closure
    );
    // physical bounds: some of the height is left, the plastic work cannot exceed what came in
    assert!(summary.compression_ratio > 0.0 && summary.compression_ratio < 1.0);
    assert!(summary.plastic_work_ratio > 0.0 && summary.plastic_work_ratio < 1.0);
    summary
}

fn change(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn impacts_between_a_tenth_and_one_of_the_dynamic_pressure_over_strength_rebound() {
    let mut last = 1.0;
    for severity in [0.15, 0.3, 0.5, 1.0] {
        let s = impact(80.0, severity, 1.0);
        assert!(
            s.restitution > 0.0 && s.restitution < last,
            "{severity}: {}",
            s.restitution
        );
        last = s.restitution;
    }
}

#[test]
fn soft_and_stiff_particles_are_flattened_alike_at_equal_dynamic_pressure_over_strength() {
    let (soft, stiff) = (impact(20.0, 1.0, 1.0), impact(1280.0, 1.0, 1.0));
    assert!(change(soft.max_displacement_m, stiff.max_displacement_m) < 0.1);
    assert!(soft.restitution > 3.0 * stiff.restitution);
}

#[test]
fn a_finer_grid_changes_a_flattened_particle_by_less_than_the_tolerance() {
    let (plain, fine) = (impact(80.0, 0.5, 1.0), impact(80.0, 0.5, 0.7));
    assert!(change(plain.max_displacement_m, fine.max_displacement_m) < 0.005);
    assert!(
        change(plain.max_force_n, fine.max_force_n) < 0.02,
        "{} {}",
        plain.max_force_n,
        fine.max_force_n
    );
    assert!(
        change(plain.restitution, fine.restitution) < 0.02,
        "{} {}",
        plain.restitution,
        fine.restitution
    );
}

#[test]
fn steps_of_their_own_for_squeezed_cells_change_the_time_and_nothing_else() {
    let own = impact(320.0, 1.0, 1.0);
    let one = changed(320.0, 1.0, |grid| grid.remedies.long_step = 0.0);
    assert!(change(own.max_displacement_m, one.max_displacement_m) < 0.001);
    assert!(
        change(own.max_force_n, one.max_force_n) < 0.01,
        "{} {}",
        own.max_force_n,
        one.max_force_n
    );
    assert!((own.restitution - one.restitution).abs() < 0.002);
    assert!((own.plastic_work_ratio - one.plastic_work_ratio).abs() < 0.002);
    assert!(
        own.steps < one.steps / 3,
        "{} steps of all points for {}",
        own.steps,
        one.steps
    );
}
