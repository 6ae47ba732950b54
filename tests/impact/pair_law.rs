//! Laws of pairs from impacts that were run: their limits against impacts on a rigid wall, and what two laws in series miss.

use impactlaw::case::Case;
use impactlaw::case::pair::{PairCase, Target, TargetShape};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::loading::SoftenedHertz;
use impactlaw::contact::rebound::rebound;
use impactlaw::curve::{Impact, Status};
use impactlaw::fit::{Fit, FittedForm, Outcome, fit, fit_pair};
use impactlaw::impact::pair::simulate_pair;
use impactlaw::impact::simulate;
use impactlaw::law::series::Series;
use impactlaw::law::{LawFile, PairLaw};
use impactlaw::material::{Flow, Material};
use impactlaw::plan::pair::pair_plan;
use impactlaw::plan::plan;

const RADIUS: f64 = 1e-3;
const TOLERANCE: f64 = 0.1;

const STEEL: Material = Material {
    density: 7850.0,
    young_modulus: 210e9,
    poisson_ratio: 0.3,
    flow: Some(Flow::perfectly_plastic(1.7e9)),
};

const ALUMINIUM: Material = Material {
    density: 2700.0,
    young_modulus: 70e9,
    poisson_ratio: 0.33,
    flow: Some(Flow::perfectly_plastic(280e6)),
};

fn pair(particle: Material, material: Material, shape: TargetShape, speeds: &[f64]) -> PairCase {
    PairCase {
        particle: Case::of("pair", RADIUS, particle, speeds, TOLERANCE).unwrap(),
        target: Target { shape, material },
    }
}

fn ended(impact: Impact) -> Impact {
    assert_eq!(impact.summary.status, Status::Ok);
    impact
}

fn law_of_pair(pair: &PairCase) -> (Fit, Vec<Impact>) {
    let run = |&velocity: &f64| ended(simulate_pair(pair, &pair_plan(pair, velocity), None).impact);
    let impacts: Vec<Impact> = pair.particle.velocities.iter().map(run).collect();
    (fit_pair(pair, &impacts).unwrap(), impacts)
}

/// The law of a particle on a rigid wall, run as two bodies are: without heavier cells, at its own speed.
fn law_of_one(material: Material, speeds: &[f64]) -> Fit {
    let case = Case::of("one", RADIUS, material, speeds, TOLERANCE).unwrap();
    let run = |&velocity: &f64| {
        let mut plan = plan(&case, velocity);
        plan.grid.scaled = 0.0;
        plan.run_velocity = plan.velocity;
        ended(simulate(&material, RADIUS, &plan).impact)
    };
    let impacts: Vec<Impact> = speeds.iter().map(run).collect();
    fit(&case, &impacts).unwrap()
}

fn closed_form(fit: &Fit) -> &FittedForm<SoftenedHertz> {
    let Outcome::Yielding {
        closed_form: Some(form),
        ..
    } = &fit.outcome
    else {
        panic!("the impacts yield");
    };
    form
}

fn near(name: &str, found: f64, expected: f64, share: f64) {
    let error = found / expected - 1.0;
    assert!(
        error.abs() < share,
        "{name}: {found:e} is {expected:e} {error:+.4}"
    );
}

#[test]
fn the_law_of_equal_spheres_is_that_of_one_on_a_rigid_wall_at_half_the_speed() {
    let speeds = [4.0, 12.0, 36.0];
    let shape = TargetShape::Sphere { radius: RADIUS };
    let twins = pair(ALUMINIUM, ALUMINIUM, shape, &speeds);
    let (two, _) = law_of_pair(&twins);
    let one = law_of_one(ALUMINIUM, &speeds.map(|v| 0.5 * v));
    let (one, two) = (closed_form(&one), closed_form(&two));
    let both = twins.effective();
    let masses = [
        ALUMINIUM.sphere_mass(RADIUS),
        both.material.sphere_mass(both.radius),
    ];
    // at speeds of the fit and between them
    for speed in [4.0, 7.0, 12.0, 20.0, 36.0] {
        let wall = rebound(&one.law, RADIUS, masses[0], 0.5 * speed);
        let pair = rebound(&two.law, both.radius, masses[1], speed);
        near("F*", pair.max_force, wall.max_force, 0.01);
        near(
            "delta*",
            pair.max_displacement,
            2.0 * wall.max_displacement,
            0.01,
        );
        near("e", pair.restitution, wall.restitution, 0.015);
        near("contact time", pair.contact_time, wall.contact_time, 0.01);
    }
}

#[test]
fn on_a_target_far_stiffer_and_heavier_the_law_is_that_of_the_rigid_wall() {
    // a thousand times both: waves as fast as in the particle, and a thousand times the impedance
    let rigid = Material {
        density: 1e3 * ALUMINIUM.density,
        young_modulus: 1e3 * ALUMINIUM.young_modulus,
        flow: None,
        ..ALUMINIUM
    };
    let speeds = [3.0, 10.0, 30.0];
    let stiff = pair(ALUMINIUM, rigid, TargetShape::HalfSpace, &speeds);
    let (two, impacts) = law_of_pair(&stiff);
    let one = law_of_one(ALUMINIUM, &speeds);
    let kept = impacts
        .iter()
        .map(|i| i.summary.target.as_ref().unwrap().retained_energy_ratio);
    assert!(kept.fold(0.0, f64::max) < 1e-3);
    let (one, two) = (closed_form(&one), closed_form(&two));
    let mass = ALUMINIUM.sphere_mass(RADIUS);
    for speed in [3.0, 5.0, 10.0, 17.0, 30.0] {
        let [wall, pair] = [one, two].map(|form| rebound(&form.law, RADIUS, mass, speed));
        near("F*", pair.max_force, wall.max_force, 0.01);
        near("delta*", pair.max_displacement, wall.max_displacement, 0.01);
        near("e", pair.restitution, wall.restitution, 0.015);
        near("contact time", pair.contact_time, wall.contact_time, 0.01);
    }
}

#[test]
fn the_law_of_a_ball_on_a_softer_half_space_follows_impacts_that_two_laws_in_series_do_not() {
    let speeds = [1.0, 3.0, 10.0, 20.0];
    let bodies = pair(STEEL, ALUMINIUM, TargetShape::HalfSpace, &speeds);
    let (found, impacts) = law_of_pair(&bodies);
    let law = PairLaw::of(&found, &bodies, "test");
    assert!(
        law.file().worst_error() < law.file().threshold(),
        "{}",
        law.file().worst_error()
    );
    let own =
        [STEEL, ALUMINIUM].map(|m| LawFile::of_atlas("one", &m, RADIUS).unwrap().law().unwrap());
    let series = Series::new(own, [STEEL, ALUMINIUM].map(|m| m.contact_modulus()));
    let both = bodies.effective();
    let mass = both.material.sphere_mass(both.radius);
    // waves carry energy away that no law of a body on a rigid wall knows of: in series the ball comes back too fast
    for impact in &impacts {
        let s = &impact.summary;
        let hit = rebound(&series, both.radius, mass, s.velocity_m_s);
        assert!(
            hit.restitution > s.restitution,
            "{} {hit:?}",
            s.velocity_m_s
        );
        // the loading is less wrong
        near("F* in series", hit.max_force, s.max_force_n, 0.15);
        let kept = s.target.as_ref().unwrap().retained_energy_ratio;
        assert!(kept > 0.03, "{kept}");
    }
    assert!(series.valid_to().is_finite());
}
