//! Contact of two deformable bodies along their meridians: implicit, frictionless, by Signorini's complementarity.
//!
//! Each surface point of the first body is paired with the place of the second body's surface that faces it, at the same distance from
//! the axis, and with the normal n of that surface. With $x_1$ and $x_2$ the two material points, the gap is $g = n \cdot (x_1 - x_2)$,
//! and gap and impulse $\lambda$ satisfy at the end of the step
//!
//! $$ 0 \le \lambda_c \perp g_c / \Delta t + n_c \cdot (v_1 - v_2) + \sum_d W_{cd} \lambda_d \ge 0, \qquad
//!    W = G_1 M_1^{-1} G_1^T + G_2 M_2^{-1} G_2^T $$
//!
//! with the splines of both bodies in G. What one body gets the other gives, so the momentum of the two is kept to rounding. Pairs
//! are made anew at every refresh; in between a pair slides along its tangent, which leaves the gap as it is to second order.

use super::body::{Body, Held};
use crate::impact::wall::Touch;
use crate::impact::wall::complementarity::{Complementarity, Unknown};
use crate::tape::{Keep, Tape, keep_fields};

/// Corrections of the place on the second body that faces a point: one leaves some 1e-4 of a cell, two less than rounding.
const CORRECTIONS: usize = 2;
/// Step along the surface for its tangent, as a share of the way between two of its points.
const TANGENT: f64 = 0.1;

/// What a checkpoint keeps of a pair of points.
#[derive(Debug, Clone, Copy, Default)]
struct Pairing {
    /// Number of the first body's surface point.
    index: usize,
    /// Place on the second body.
    place: f64,
    /// Normal of the second body there, towards the first: r and z of the first body.
    normal: [f64; 2],
}

keep_fields!(Pairing: index, place, normal);

/// A pair of points that may touch.
#[derive(Debug, Clone, Copy)]
struct Pair {
    points: [Held; 2],
    /// Direction that opens the gap, in the (r, z) of each body.
    open: [[f64; 2]; 2],
}

/// Pairs of surface points and their impulses.
#[derive(Debug, Clone)]
pub(super) struct PairContact {
    /// Surface points of the first body.
    own: Vec<Held>,
    /// Places of surface points of the second body.
    facing: Vec<f64>,
    pairings: Vec<Pairing>,
    pairs: Vec<Pair>,
    problem: Complementarity,
    candidates: Vec<usize>,
    time: f64,
}

impl PairContact {
    /// Nothing touches yet; `tolerance` is the speed below which a violation counts as solved.
    pub(super) fn new([first, second]: &[Body; 2], tolerance: f64) -> Self {
        let places = first.surface().into_iter();
        let facing = second.surface().into_iter();
        PairContact {
            own: places
                .take_while(|s| *s < first.facing())
                .map(|s| first.hold(s))
                .collect(),
            facing: facing.take_while(|s| *s < second.facing()).collect(),
            pairings: Vec::new(),
            pairs: Vec::new(),
            problem: Complementarity::new(tolerance),
            candidates: Vec::new(),
            time: 0.0,
        }
    }

    /// Pair the points that could touch within `horizon` if nothing closes in faster than `speed`.
    pub(super) fn refresh(&mut self, bodies: &[Body; 2], speed: f64, horizon: f64) {
        let arc = self.arc(&bodies[1]);
        let mut pairings = Vec::new();
        let mut unknowns = Vec::new();
        for (index, point) in self.own.iter().enumerate() {
            let known = self.pairings.binary_search_by_key(&index, |p| p.index);
            let known = known.ok().map(|k| self.problem.unknowns[k]);
            let here = bodies[0].deformed(point);
            let Some((gap, place, way)) = face(&arc, here) else {
                continue;
            };
            if gap < speed * horizon || known.is_some_and(|k| k.active) {
                let (place, normal) = meet(&bodies[1], place, way, here[0]);
                pairings.push(Pairing {
                    index,
                    place,
                    normal,
                });
                unknowns.push(known.unwrap_or_default());
            }
        }
        self.pairings = pairings;
        self.couple(bodies, unknowns);
    }

    /// Deformed surface of the second body as far as it faces the first one: distance from the axis, place, depth.
    fn arc(&self, second: &Body) -> Vec<[f64; 3]> {
        let mut arc: Vec<[f64; 3]> = Vec::with_capacity(self.facing.len());
        for &place in &self.facing {
            let [r, z] = second.deformed(&second.hold(place));
            if arc.last().is_some_and(|last| r <= last[0]) {
                break;
            }
            arc.push([r, place, z]);
        }
        arc
    }

    /// Points, directions and coupling of the present pairs.
    fn couple(&mut self, bodies: &[Body; 2], unknowns: Vec<Unknown>) {
        let pair = |p: &Pairing| {
            let [across, up] = p.normal;
            Pair {
                points: [self.own[p.index], bodies[1].hold(p.place)],
                open: [[across, up], [-across, up]],
            }
        };
        self.pairs = self.pairings.iter().map(pair).collect();
        self.candidates = (0..self.pairs.len()).collect();
        self.problem.unknowns = unknowns;
        let pairs = &self.pairs;
        let entry = |c: usize, d: usize| pairs[c].coupling(&pairs[d], bodies);
        let reaches = |c: usize, d: usize| pairs[c].shares_nodes(&pairs[d], bodies);
        let mut band = 0;
        while (0..pairs.len()).any(|c| c + band + 1 < pairs.len() && reaches(c, c + band + 1)) {
            band += 1;
        }
        self.problem.couple(band, entry);
    }

    /// Solve one step of length `dt`: velocities after the forces are corrected in place.
    pub(super) fn solve(&mut self, dt: f64, bodies: &mut [Body; 2]) -> Touch {
        let ratio = if self.time > 0.0 { dt / self.time } else { 1.0 };
        self.time = dt;
        let mut any = false;
        for (pair, unknown) in self.pairs.iter().zip(&mut self.problem.unknowns) {
            let free = pair.gap(bodies) / dt + pair.rate(bodies, |body| &body.v);
            unknown.free = free;
            unknown.impulse *= ratio;
            any |= free < 0.0;
            unknown.active |= free < 0.0 && unknown.impulse == 0.0;
        }
        let mut touch = Touch::default();
        if !any {
            (0..self.pairs.len()).for_each(|c| self.problem.release(c));
            return touch;
        }
        touch.residual = self.problem.solve(&self.candidates);
        let pressed = || {
            let all = self.pairs.iter().zip(&self.problem.unknowns);
            all.filter(|(_, unknown)| unknown.impulse > 0.0)
        };
        for (pair, unknown) in pressed() {
            pair.press(unknown.impulse, bodies);
        }
        for (pair, Unknown { impulse, .. }) in pressed() {
            let [first, _] = &*bodies;
            let speeds = pair.rate(bodies, |body| &body.old) + pair.rate(bodies, |body| &body.v);
            touch.impulse += impulse * pair.open[0][1];
            touch.work += 0.5 * impulse * speeds;
            touch.radius = touch.radius.max(first.deformed(&pair.points[0])[0]);
        }
        touch
    }

    /// Largest depth by which a paired point lies inside the other body.
    #[cfg(test)]
    pub(super) fn deepest(&self, bodies: &[Body; 2]) -> f64 {
        let gaps = self.pairs.iter().map(|pair| pair.gap(bodies));
        gaps.fold(0.0, |deepest, gap| f64::max(deepest, -gap))
    }

    /// Largest depth by which a surface point, paired or not, lies inside the other body as that is now.
    #[cfg(test)]
    pub(super) fn deepest_of_all(&self, bodies: &[Body; 2]) -> f64 {
        let arc = self.arc(&bodies[1]);
        let gap = |point: &Held| {
            let [r, z] = bodies[0].deformed(point);
            let (_, place, way) = face(&arc, [r, z])?;
            let (place, [across, up]) = meet(&bodies[1], place, way, r);
            let [r2, z2] = bodies[1].deformed(&bodies[1].hold(place));
            Some(across * (r - r2) + up * (z + z2))
        };
        let gaps = self.own.iter().filter_map(gap);
        gaps.fold(0.0, |deepest, gap| f64::max(deepest, -gap))
    }

    /// Take back what [`PairContact::save`] wrote.
    pub(super) fn load(&mut self, tape: &mut Tape, bodies: &[Body; 2]) -> Option<()> {
        self.pairings.load(tape)?;
        if self.pairings.iter().any(|p| p.index >= self.own.len()) {
            return None;
        }
        let mut unknowns = vec![Unknown::default(); self.pairings.len()];
        unknowns.as_mut_slice().load(tape)?;
        self.time.load(tape)?;
        self.couple(bodies, unknowns);
        Some(())
    }

    /// Write the pairs and their impulses.
    pub(super) fn save(&self, tape: &mut Tape) {
        self.pairings.save(tape);
        self.problem.unknowns.as_slice().save(tape);
        self.time.save(tape);
    }
}

impl Pair {
    /// Distance of the two points along the normal.
    fn gap(&self, bodies: &[Body; 2]) -> f64 {
        let [[r, z], [r2, z2]] = [0, 1].map(|b| bodies[b].deformed(&self.points[b]));
        let [across, up] = self.open[0];
        across * (r - r2) + up * (z + z2)
    }

    /// Rate at which a nodal field of both bodies opens the gap.
    fn rate(&self, bodies: &[Body; 2], field: impl Fn(&Body) -> &[[f64; 2]]) -> f64 {
        let mut sum = 0.0;
        for (body, (point, open)) in bodies.iter().zip(self.points.iter().zip(&self.open)) {
            for (axis, open) in open.iter().enumerate() {
                sum += open * point.at(&body.offsets, field(body), axis);
            }
        }
        sum
    }

    /// Give an impulse to both bodies.
    fn press(&self, impulse: f64, bodies: &mut [Body; 2]) {
        for (body, (point, open)) in bodies.iter_mut().zip(self.points.iter().zip(&self.open)) {
            for (axis, open) in open.iter().enumerate() {
                let (offsets, recip_mass) = (&body.offsets, &body.recip_mass);
                point.press(offsets, open * impulse, &mut body.v, recip_mass, axis);
            }
        }
    }

    /// The gap rate that a unit impulse at another pair gives to this one.
    fn coupling(&self, other: &Pair, bodies: &[Body; 2]) -> f64 {
        let mut sum = 0.0;
        for (b, body) in bodies.iter().enumerate() {
            for axis in 0..2 {
                let along = |n: usize| body.recip_mass[n][axis];
                let share = self.points[b].coupling(&other.points[b], &body.offsets, along);
                sum += self.open[b][axis] * other.open[b][axis] * share;
            }
        }
        sum
    }

    /// Whether another pair lies on some of the same nodes.
    fn shares_nodes(&self, other: &Pair, bodies: &[Body; 2]) -> bool {
        let alike = |(b, body): (usize, &Body)| {
            self.points[b].coupling(&other.points[b], &body.offsets, |_| 1.0) > 0.0
        };
        bodies.iter().enumerate().any(alike)
    }
}

/// Of the arc that faces a point: distance along the axis, place, and the way from arc point to arc point there.
fn face(arc: &[[f64; 3]], [r, z]: [f64; 2]) -> Option<(f64, f64, f64)> {
    let next = arc.partition_point(|p| p[0] <= r);
    if next == 0 || next == arc.len() {
        return None;
    }
    let ([r0, s0, z0], [r1, s1, z1]) = (arc[next - 1], arc[next]);
    let share = (r - r0) / (r1 - r0);
    let there = z0 + share * (z1 - z0);
    Some((z + there, s0 + share * (s1 - s0), s1 - s0))
}

/// Place of the second body's surface at distance `r` from the axis near `place`, and its normal towards the first body.
fn meet(second: &Body, mut place: f64, way: f64, r: f64) -> (f64, [f64; 2]) {
    let step = TANGENT * way;
    let at = |place: f64| second.deformed(&second.hold(place));
    // on the axis the surface is level
    if r <= 0.0 || place < step {
        return (place, [0.0, 1.0]);
    }
    let tangent = |place: f64| {
        let ([r0, z0], [r1, z1]) = (at(place - step), at(place + step));
        [(r1 - r0) / (2.0 * step), (z1 - z0) / (2.0 * step)]
    };
    for _ in 0..CORRECTIONS {
        place += (r - at(place)[0]) / tangent(place)[0];
    }
    let [across, down] = tangent(place);
    let length = across.hypot(down);
    (place, [down / length, across / length])
}
