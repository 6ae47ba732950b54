//! A run of two bodies resumes bit for bit, keeps its momentum, and solves the conditions of contact.

use super::{Bodies, PairRun, matter, units_of_second};
use crate::case::Case;
use crate::case::pair::{PairCase, Target, TargetShape};
use crate::material::constant::Dimension;
use crate::material::{Flow, Material, ReferenceUnits};
use crate::plan::pair::{PairPlan, pair_plan};
use crate::tape::{Keep, Tape};

const SPEED: f64 = 30.0;

fn pair(shape: TargetShape) -> PairCase {
    let metal = |density, young_modulus, strength| Material {
        density,
        young_modulus,
        poisson_ratio: 0.3,
        flow: Some(Flow::perfectly_plastic(strength)),
    };
    PairCase {
        particle: Case::of("pair", 1e-3, metal(8000.0, 200e9, 1e9), &[SPEED], 0.2).unwrap(),
        target: Target {
            shape,
            material: metal(2700.0, 70e9, 300e6),
        },
    }
}

fn run<'a>(pair: &PairCase, plan: &'a PairPlan) -> PairRun<'a> {
    let (own, other) = (&pair.particle.material, &pair.target.material);
    let units = ReferenceUnits::of(own, pair.particle.radius);
    let bodies = Bodies {
        matter: [matter(own, &units), matter(other, &units)],
        density: other.density / own.density,
    };
    PairRun::new(plan, SPEED / units.speed(), bodies)
}

fn step(run: &mut PairRun, count: usize) {
    for _ in 0..count {
        run.advance();
        assert_eq!(run.failure, None);
    }
}

fn bits(run: &PairRun) -> Vec<u64> {
    let fields = run
        .bodies
        .iter()
        .flat_map(|body| body.u.iter().chain(&body.v));
    fields.flatten().map(|x| x.to_bits()).collect()
}

#[test]
fn a_pair_goes_on_with_the_same_bits() {
    let pair = pair(TargetShape::HalfSpace);
    let plan = pair_plan(&pair, SPEED);
    let mut whole = run(&pair, &plan);
    // in between two refreshes, in contact and yielding
    step(&mut whole, 133);
    assert!(whole.impulse > 0.0 && whole.bodies[1].plastic > 0.0);
    assert_ne!(whole.step, whole.next_refresh);
    let mut tape = Tape::default();
    whole.save(&mut tape);
    let mut rest = run(&pair, &plan);
    let mut kept = Tape::from_bytes(tape.as_bytes().to_vec());
    rest.load(&mut kept).expect("the tape fits");
    assert!(kept.is_at_end());
    step(&mut whole, 120);
    step(&mut rest, 120);
    assert_eq!(bits(&whole), bits(&rest));
    // a tape that is cut off is no run
    let short = tape.as_bytes()[..tape.as_bytes().len() / 2].to_vec();
    let mut other = run(&pair, &plan);
    assert!(other.load(&mut Tape::from_bytes(short)).is_none());
}

#[test]
fn two_spheres_keep_their_momentum_to_rounding() {
    let pair = pair(TargetShape::Sphere { radius: 0.7e-3 });
    let plan = pair_plan(&pair, SPEED);
    let mut run = run(&pair, &plan);
    let momenta = |run: &PairRun| run.bodies.each_ref().map(|b| b.whole * b.mean(&b.v));
    let [start, other] = momenta(&run);
    assert!((start - other).abs() < 1e-14 * start.abs());
    for _ in 0..8 {
        step(&mut run, 50);
        let [first, second] = momenta(&run);
        // each is measured along its own axis, which point at each other
        assert!(
            (first - second).abs() < 1e-12 * start.abs(),
            "{first} {second}"
        );
    }
    let [stopped, _] = momenta(&run);
    assert!(
        stopped / start < 0.9,
        "contact has acted: {stopped} {start}"
    );
}

#[test]
fn no_surface_point_ends_a_step_inside_the_other_body() {
    let pair = pair(TargetShape::Sphere { radius: 2e-3 });
    let plan = pair_plan(&pair, SPEED);
    let mut run = run(&pair, &plan);
    for _ in 0..6 {
        step(&mut run, 40);
        let deepest = run.contact.deepest(&run.bodies);
        // of what was done to the gap in the step, the regular share of the diagonal is left
        let way = run.dt * run.speed;
        assert!(deepest < 0.01 * way, "{deepest:e} of {way:e}");
        // pairs are those of the last refresh; seen afresh, and with the points that were too far away to be paired
        let all = run.contact.deepest_of_all(&run.bodies);
        let cell = plan.target.fine;
        assert!(all < 0.002 * cell, "{all:e} of a cell of {cell:e}");
    }
    assert!(run.impulse > 0.0);
}

#[test]
fn work_heats_the_second_body_by_its_own_density() {
    let pair = pair(TargetShape::HalfSpace);
    let (own, other) = (&pair.particle.material, &pair.target.material);
    let units = ReferenceUnits::of(own, 1e-3);
    let others = units_of_second(&units, other);
    assert!((others.time() / units.time() - 1.0).abs() < 1e-14);
    // 1 MJ/m3 of work heats 2700 kg/m3 of 900 J/(kg K) by 0.41152 K
    let work = 1e6 / units.unit(Dimension::Stress);
    let heat = 900.0 / others.unit(Dimension::SpecificHeat);
    assert!((work / heat / (1e6 / 2700.0 / 900.0) - 1.0).abs() < 1e-14);
    for dimension in [Dimension::Stress, Dimension::Rate] {
        let ratio = others.unit(dimension) / units.unit(dimension);
        assert!((ratio - 1.0).abs() < 1e-14);
    }
}
