//! Curves: a law pressed by an impact or to a displacement and let go, as points to draw, and restitution over speed.

use crate::contact::rebound::{Rebound, State, rebound, trajectory};
use crate::contact::{LawVisitor, NormalLaw};
use crate::unit::significant;
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// Points between two states of a trajectory; its states are eight a branch at least.
const BETWEEN: usize = 5;
/// Points of a branch that is pressed slowly.
const POINTS: usize = 64;
/// Relative step back from the largest flattening at which unloading is asked where it will end.
const BACK: f64 = 1e-9;

/// What the law does. Names are those of `summary.json`.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Pressed {
    /// NaN where the body is not thrown but pressed; so is the contact time.
    restitution: f64,
    #[serde(rename = "max_force_N")]
    max_force_n: f64,
    max_displacement_m: f64,
    residual_displacement_m: f64,
    contact_time_s: f64,
    /// Why it is beyond what the law rests on, if it is.
    beyond: Option<String>,
    /// Displacement, m, there and back.
    displacement_m: Vec<f64>,
    /// Force, N.
    #[serde(rename = "force_N")]
    force_n: Vec<f64>,
}

impl Pressed {
    fn of(hit: Rebound, beyond: Option<String>, curve: Curve) -> Self {
        let Rebound {
            restitution,
            max_force,
            max_displacement,
            residual_displacement,
            contact_time,
        } = hit;
        Pressed {
            restitution,
            max_force_n: max_force,
            max_displacement_m: max_displacement,
            residual_displacement_m: residual_displacement,
            contact_time_s: contact_time,
            beyond,
            displacement_m: curve.displacement,
            force_n: curve.force,
        }
    }
}

#[derive(Default)]
struct Curve {
    displacement: Vec<f64>,
    force: Vec<f64>,
}

impl Curve {
    fn push(&mut self, displacement: f64, force: f64) {
        self.displacement.push(displacement);
        self.force.push(force);
    }
}

/// An impact of a sphere on a rigid plane, inertia in first loading and all.
pub(super) struct Thrown {
    pub radius: f64,
    pub mass: f64,
    pub velocity: f64,
}

impl LawVisitor for Thrown {
    type Output = Pressed;

    fn visit<L: NormalLaw>(self, law: &L) -> Pressed {
        let Thrown {
            radius,
            mass,
            velocity,
        } = self;
        let states = trajectory(law, radius, mass, velocity);
        let hit = rebound(law, radius, mass, velocity);
        let beyond = beyond(law, hit.max_displacement / radius);
        Pressed::of(hit, beyond, path(law, radius, mass, &states))
    }
}

/// The states of an impact with points between them. Forces there are the law's own; the squared speed that inertia goes with is
/// the cubic with the values of both states and their slopes, $d(v^2)/d\delta = -2F/m$.
fn path<L: NormalLaw>(law: &L, radius: f64, mass: f64, states: &[State]) -> Curve {
    let mut curve = Curve::default();
    let deepest =
        |a: &usize, b: &usize| states[*a].displacement.total_cmp(&states[*b].displacement);
    let Some(turn) = (0..states.len()).max_by(deepest) else {
        return curve;
    };
    let mut pressed = L::History::default();
    law.force(states[turn].displacement / radius, &mut pressed);
    let inertia = law.inertia();
    for (i, pair) in states.windows(2).enumerate() {
        let (from, to) = (&pair[0], &pair[1]);
        curve.push(from.displacement, from.force);
        let length = to.displacement - from.displacement;
        for k in 1..BETWEEN {
            let s = k as f64 / BETWEEN as f64;
            let displacement = from.displacement + s * length;
            let x = displacement / radius;
            let reduced = if i < turn {
                let slope = |state: &State| -2.0 * state.force / mass * length;
                let values = [from, to].map(|state| state.velocity * state.velocity);
                let squared = cubic(s, values, [slope(from), slope(to)]).max(0.0);
                law.force(x, &mut L::History::default()) + inertia.force(x, squared)
            } else {
                law.force(x, &mut pressed.clone())
            };
            curve.push(displacement, reduced * radius * radius);
        }
    }
    if let Some(last) = states.last() {
        curve.push(last.displacement, last.force);
    }
    curve
}

/// Hermite's cubic over 0..1.
fn cubic(s: f64, [a, b]: [f64; 2], [slope_a, slope_b]: [f64; 2]) -> f64 {
    let (s2, s3) = (s * s, s * s * s);
    let rise = 3.0 * s2 - 2.0 * s3;
    a + (b - a) * rise + (s3 - 2.0 * s2 + s) * slope_a + (s3 - s2) * slope_b
}

/// A body pressed slowly to a displacement (m) and let go.
pub(super) struct PressedTo {
    pub radius: f64,
    pub displacement: f64,
}

impl LawVisitor for PressedTo {
    type Output = Pressed;

    fn visit<L: NormalLaw>(self, law: &L) -> Pressed {
        let area = self.radius * self.radius;
        let most = self.displacement / self.radius;
        let mut curve = Curve::default();
        for k in 0..POINTS {
            // dense where Hertz's force is curved most
            let x = most * (k as f64 / POINTS as f64).powi(2);
            let force = law.force(x, &mut L::History::default());
            curve.push(x * self.radius, force * area);
        }
        let mut pressed = L::History::default();
        let peak = law.force(most, &mut pressed);
        let near = most * (1.0 - BACK);
        let mut released = pressed;
        law.force(near, &mut released);
        let residual = (near - law.depth(near, &released)).max(0.0);
        for k in 0..=POINTS {
            let theta = FRAC_PI_2 * k as f64 / POINTS as f64;
            let x = most - (most - residual) * theta.sin().powi(2);
            let force = match k {
                0 => peak,
                _ => law.force(x, &mut pressed.clone()),
            };
            curve.push(x * self.radius, force * area);
        }
        let hit = Rebound {
            restitution: f64::NAN,
            max_force: peak * area,
            max_displacement: self.displacement,
            residual_displacement: residual * self.radius,
            contact_time: f64::NAN,
        };
        Pressed::of(hit, beyond(law, most), curve)
    }
}

/// Why a contact that turns at flattening `most` lies outside what its law rests on; none where it does not.
fn beyond<L: NormalLaw>(law: &L, most: f64) -> Option<String> {
    let number = |x| significant(x, 4);
    if most > law.valid_to() {
        return Some(format!(
            "δ/R = {} is beyond {}, the largest that its source supports",
            number(most),
            number(law.valid_to())
        ));
    }
    let slowest = law.slowest()?;
    (most > slowest.yields_at && most < slowest.flattening).then(|| {
        format!(
            "it has yielded and turns before δ/R = {}, that of the slowest impact the law rests on ({} m/s): nobody has seen it let go",
            number(slowest.flattening),
            number(slowest.velocity)
        )
    })
}

/// Restitution at several speeds.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Bounces {
    pub restitution: Vec<f64>,
    /// Whether the law supports it.
    pub supported: Vec<bool>,
}

/// Impacts at several speeds (m/s).
pub(super) struct ThrownAt<'a> {
    pub radius: f64,
    pub mass: f64,
    pub velocities: &'a [f64],
}

impl LawVisitor for ThrownAt<'_> {
    type Output = Bounces;

    fn visit<L: NormalLaw>(self, law: &L) -> Bounces {
        let hits = self.velocities.iter();
        let hits = hits.map(|&velocity| rebound(law, self.radius, self.mass, velocity));
        let of = |hit: Rebound| {
            let most = hit.max_displacement / self.radius;
            (hit.restitution, beyond(law, most).is_none())
        };
        let (restitution, supported) = hits.map(of).unzip();
        Bounces {
            restitution,
            supported,
        }
    }
}
