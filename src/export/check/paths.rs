//! Random loading paths and what the law says along them.

use crate::contact::pair::{Alike, Flat, Press, Pressed, Twins};
use crate::contact::{LawVisitor, NormalLaw};
use crate::law::FittedLaw;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Overlap over that of a full path up to which the law is tried: beyond its range, where it is extrapolated.
const BEYOND: f64 = 1.2;

/// Bodies of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bodies {
    /// A body on a wall.
    Wall,
    /// Two bodies of one radius.
    Twins,
    /// Two bodies whose radii differ by this factor.
    Unequal(f64),
}

impl Bodies {
    /// Radii (m) if the first body's is `radius`; 0 for a wall.
    #[must_use]
    pub fn radii(self, radius: f64) -> [f64; 2] {
        match self {
            Bodies::Wall => [radius, 0.0],
            Bodies::Twins => [radius, radius],
            Bodies::Unequal(factor) => [radius, radius * factor],
        }
    }
}

/// `steps` overlaps (m) of loading, unloading, reloading and loss of contact, up to somewhat beyond `most`.
#[must_use]
pub fn random(most: f64, steps: usize, seed: u64) -> Vec<f64> {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut path = Vec::with_capacity(steps);
    let mut overlap = 0.0;
    while path.len() < steps {
        // contacts of very different depth, so that elastic ones are among them
        let scale = most * BEYOND * 10f64.powf(-random.random_range(0.0..4.0));
        for _ in 0..random.random_range(3..12) {
            let target = scale * random.random_range(0.0..1.0);
            let count = random.random_range(1..20);
            for k in 1..=count {
                path.push(overlap + (target - overlap) * f64::from(k) / f64::from(count));
            }
            overlap = target;
        }
        path.push(0.0);
        overlap = 0.0;
    }
    path.truncate(steps);
    path
}

/// What is compared along a random path.
pub(super) fn subject(bodies: &str, steps: usize) -> String {
    format!(
        "random paths, {bodies}, {steps} steps: force, stiffness, radius, flattening, depth, energy"
    )
}

/// What `law` says along a path, and its recoverable energy (J); the contact is forgotten where the overlap is 0.
#[must_use]
pub fn pressed(law: &FittedLaw, bodies: Bodies, radius: f64, path: &[f64]) -> Vec<(Pressed, f64)> {
    law.visit(Along {
        bodies,
        radii: bodies.radii(radius),
        path,
    })
}

/// Sum of force and stiffness along a path of a body on a wall: a loop to be timed, in which both are worked out.
#[must_use]
pub fn sum(law: &FittedLaw, radius: f64, path: &[f64]) -> f64 {
    law.visit(Sum { radius, path })
}

struct Sum<'a> {
    radius: f64,
    path: &'a [f64],
}

impl LawVisitor for Sum<'_> {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let wall = Flat(law.clone());
        let radii = [self.radius, f64::INFINITY];
        let mut history = L::History::default();
        let mut sum = 0.0;
        for &overlap in self.path {
            if overlap <= 0.0 {
                history = L::History::default();
            } else {
                let pressed = wall.press(overlap, radii, &mut history);
                sum += pressed.force + pressed.stiffness;
            }
        }
        sum
    }
}

struct Along<'a> {
    bodies: Bodies,
    radii: [f64; 2],
    path: &'a [f64],
}

impl Along<'_> {
    fn press<P: Press>(&self, press: &P) -> Vec<(Pressed, f64)> {
        let mut history = P::History::default();
        let step = |&overlap: &f64| {
            if overlap <= 0.0 {
                history = P::History::default();
                return (Pressed::default(), 0.0);
            }
            let pressed = press.press(overlap, self.radii, &mut history);
            (pressed, press.elastic_energy(overlap, self.radii, &history))
        };
        self.path.iter().map(step).collect()
    }
}

impl LawVisitor for Along<'_> {
    type Output = Vec<(Pressed, f64)>;

    fn visit<L: NormalLaw>(self, law: &L) -> Vec<(Pressed, f64)> {
        match self.bodies {
            Bodies::Wall => self.press(&Flat(law.clone())),
            Bodies::Twins => self.press(&Twins(law.clone())),
            Bodies::Unequal(_) => self.press(&Alike(law.clone())),
        }
    }
}
