//! Random scan: impacts drawn over the whole range run to their ends, and nothing of them is impossible.

use impactlaw::case::Case;
use impactlaw::curve::{Impact, MapPoint, Part, Status};
use impactlaw::impact::simulate;
use impactlaw::plan::{Plan, plan, with_cells};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::path::Path;

const DENSITY: f64 = 1000.0;
const MODULUS: f64 = 1e9;
const RADIUS: f64 = 1e-3;

/// Dimensionless groups of an impact.
#[derive(Debug, Clone, Copy)]
struct Drawn {
    /// E/Y, 20 to 20 000.
    ratio: f64,
    /// rho V^2/Y, 1e-7 to 50.
    severity: f64,
    poisson_ratio: f64,
    /// H/E, 0 to a tenth; none for every third.
    hardening: f64,
}

impl Drawn {
    /// V over sqrt(E/rho).
    fn mach(&self) -> f64 {
        (self.severity / self.ratio).sqrt()
    }

    fn planned(&self, tolerance: f64) -> (Case, Plan) {
        let velocity = self.mach() * (MODULUS / DENSITY).sqrt();
        let text = format!(
            "[particle]\nradius = \"{RADIUS} m\"\n[material]\ndensity = \"{DENSITY} kg/m3\"\n\
             young_modulus = \"{MODULUS} Pa\"\npoisson_ratio = {}\nyield_strength = \"{} Pa\"\n\
             hardening_modulus = \"{} Pa\"\n[impact]\nvelocities = [\"{velocity} m/s\"]\n[accuracy]\ntolerance = {tolerance}\n",
            self.poisson_ratio,
            MODULUS / self.ratio,
            self.hardening * MODULUS,
        );
        let case = Case::parse(&text, Path::new("scan.toml")).unwrap();
        let plan = plan(&case, velocity);
        (case, plan)
    }
}

/// Impacts up to half the wave speed of a bar, evenly over the logarithms of E/Y and rho V^2/Y.
fn drawn(count: usize, seed: u64) -> Vec<Drawn> {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut all = Vec::with_capacity(count);
    while all.len() < count {
        let mut share = || random.random::<f64>();
        let one = Drawn {
            ratio: 20.0 * 1e3f64.powf(share()),
            severity: 1e-7 * 5e8f64.powf(share()),
            poisson_ratio: 0.49 * share(),
            hardening: (0.1 * (1.5 * share() - 0.5)).max(0.0),
        };
        if one.mach() <= 0.5 {
            all.push(one);
        }
    }
    all
}

/// What is wrong with an impact, if anything.
fn fault(one: &Drawn, tolerance: f64) -> Option<String> {
    let (case, plan) = one.planned(tolerance);
    let done = simulate(&case.material, case.radius, &plan);
    let s = &done.impact.summary;
    let deepest = [&done.compressed, &done.rebound]
        .into_iter()
        .flat_map(|map| &map.points)
        .filter(|p: &&MapPoint| p.part == Part::Inside)
        .fold(f64::INFINITY, |least, p| least.min(p.z_m));
    let cells = -deepest / (plan.grid.fine * case.radius);
    println!(
        "{:.3e},{:.3e},{:.3},{:.4},{:.3},{:?},{:.4},{:.4},{:.4},{:.4},{:.1e},{:.3},{:.1}",
        one.ratio,
        one.severity,
        one.poisson_ratio,
        one.hardening,
        one.mach(),
        s.status,
        s.restitution,
        s.max_displacement_m / RADIUS,
        s.eroded_volume_ratio,
        s.shock_work_ratio,
        s.energy_closure,
        cells,
        s.wall_s,
    );
    if s.status != Status::Ok {
        Some(format!("{:?}", s.status))
    } else if !(s.energy_closure < 0.01) {
        Some(format!("closure {}", s.energy_closure))
    } else if !(0.0..=1.0).contains(&s.restitution) {
        Some(format!("restitution {}", s.restitution))
    } else if !(cells < 0.05) {
        Some(format!("{cells} cells below the wall"))
    } else {
        None
    }
}

/// Run all; the faulty ones with what is wrong.
fn faults(all: &[Drawn], tolerance: f64) -> Vec<(Drawn, String)> {
    println!("E/Y,rho V^2/Y,nu,H/E,V/c,status,e,delta*/R,eroded,shock,closure,cells below,seconds");
    all.par_iter()
        .with_max_len(1)
        .filter_map(|one| Some((*one, fault(one, tolerance)?)))
        .collect()
}

#[test]
fn a_dozen_impacts_drawn_over_the_whole_range_end_well() {
    let found = faults(&drawn(12, 1), 0.1);
    assert!(found.is_empty(), "{found:#?}");
}

/// `cargo test --release --test impact -- --ignored three_hundred --nocapture`
#[test]
#[ignore = "takes two and a half minutes of two cores"]
fn three_hundred_impacts_drawn_over_the_whole_range_end_well() {
    let found = faults(&drawn(300, 2026), 0.05);
    assert!(found.is_empty(), "{} of 300: {found:#?}", found.len());
}

/// Changes of F*, delta* (relative) and e with cells of half the size.
fn changes(one: &Drawn, tolerance: f64) -> [f64; 3] {
    let (case, plan) = one.planned(tolerance);
    let fine = with_cells(plan.clone(), 0.5, &case.material);
    let run = |plan: &Plan| -> Impact { simulate(&case.material, case.radius, plan).impact };
    let (a, b) = (run(&plan).summary, run(&fine).summary);
    let change = |a: f64, b: f64| (a / b - 1.0).abs();
    [
        change(a.max_force_n, b.max_force_n),
        change(a.max_displacement_m, b.max_displacement_m),
        (a.restitution - b.restitution).abs(),
    ]
}

/// Those of `all` that halved cells change by more than the tolerance, or in e by more than 0.01.
fn changed(all: &[Drawn], tolerance: f64) -> Vec<(Drawn, [f64; 3])> {
    all.par_iter()
        .with_max_len(1)
        .filter_map(|one| {
            let changes = changes(one, tolerance);
            println!("{one:?}: {changes:.4?}");
            let [force, displacement, restitution] = changes;
            let met = force <= tolerance && displacement <= tolerance && restitution <= 0.01;
            (!met).then_some((*one, changes))
        })
        .collect()
}

/// Seventeen of these twenty met it before F was averaged over the crossing of a cell and ten cells a contact radius were the least.
#[test]
#[ignore = "several minutes of a core"]
fn halved_cells_change_twenty_drawn_impacts_by_less_than_the_tolerance() {
    let off = changed(&drawn(20, 2027), 0.05);
    assert!(off.is_empty(), "{off:#?}");
}

/// Drawn after the plans were changed for those before.
#[test]
#[ignore = "several minutes of a core"]
fn halved_cells_change_twenty_others_by_less_than_the_tolerance() {
    let off = changed(&drawn(20, 31), 0.05);
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn halved_cells_change_the_three_that_missed_it_by_less_than_the_tolerance() {
    // F* by 8.8 % (knocks of the contact's edge), by 5.7 % (where it came to rest), e by 0.0101
    let all = drawn(20, 2027);
    let three: Vec<Drawn> = (all.iter().copied())
        .filter(|one| [527.0, 1847.0, 4395.0].contains(&one.ratio.round()))
        .collect();
    assert_eq!(three.len(), 3);
    let off = changed(&three, 0.05);
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn plans_of_hardening_materials_expect_the_size_that_runs_have() {
    let one = Drawn {
        ratio: 2000.0,
        severity: 0.3,
        poisson_ratio: 0.3,
        hardening: 0.1,
    };
    let (case, plan) = one.planned(0.1);
    let s = simulate(&case.material, case.radius, &plan).impact.summary;
    let expected = plan.estimate.displacement * case.radius;
    let off = expected / s.max_displacement_m - 1.0;
    // by the yield strength alone it is expected to be several times as large
    assert!(off.abs() < 0.25, "{off}");
}
