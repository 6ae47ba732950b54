//! Interior: material points that the surface does not keep from the wall, held there together with it.
//!
//! Once the surface folds over, or the cells behind it are crushed or taken out, its points say nothing about what
//! follows. Every material point is a candidate then, with the mass that it stands for, whether its cell still carries stress
//! or not. A point joins the problem in the step in which it would pass the wall though the surface is held.

use crate::impact::wall::complementarity::{Complementarity, Unknown};
use crate::impact::wall::contact_point::ContactPoint;
use crate::tape::{Keep, Tape};
use std::sync::Arc;

/// Height in which points are watched, as a share of that in which surface points are candidates: they move no faster than the
/// impact, of which those have four times the way.
const WATCHED: f64 = 0.25;
/// Speed at which a point found below the wall comes back, over the speed with which surface points are sought.
const RETURN: f64 = 0.05;
/// Depth, in cells, that a point must be about to pass to join: between the surface points, half a cell apart, the splines of
/// a surface that is held dip below the wall by less.
const DIP: f64 = 0.02;

/// The body as it was laid, for the wall.
#[derive(Debug)]
struct Body<const N: usize> {
    /// Material points, cell by cell.
    points: Vec<ContactPoint<N>>,
    /// Of each cell its first node, the end of its points, and whether some of them lie outside it.
    cells: Vec<(usize, usize, bool)>,
    /// Undeformed heights of the nodes.
    heights: Vec<f64>,
    /// Reciprocal masses of the nodes along the normal.
    recip_mass: Vec<f64>,
    /// Nodes a row.
    columns: usize,
    /// Depth that a point must be about to pass to join.
    dip: f64,
}

/// A watched point in the present step.
#[derive(Debug, Clone, Copy)]
struct Near {
    point: usize,
    /// Gap over the time step.
    gap: f64,
    /// Gap rate without impulses.
    rate: f64,
    /// The same as far as it is to be undone in this step: the right-hand side b.
    free: f64,
}

/// A place in the order of the whole problem.
#[derive(Debug, Clone, Copy)]
enum Place {
    /// Surface point.
    Surface(usize),
    /// Entry of [`Interior::held`].
    Inside(usize),
}

/// Material points near the wall and their impulses.
#[derive(Debug, Clone)]
pub struct Interior<const N: usize> {
    body: Option<Arc<Body<N>>>,
    /// Points that could reach the wall before the next refresh, in order.
    watched: Vec<usize>,
    /// Those that have joined the problem, in order.
    held: Vec<(usize, Unknown)>,
    /// The watched points in the present step.
    near: Vec<Near>,
    /// Speed at which points below the wall come back.
    recovery: f64,
    /// Present time step.
    time: f64,
    /// Surface candidates and held points by columns of nodes; empty when it has to be made anew.
    order: Vec<Place>,
    all: Complementarity,
}

impl<const N: usize> Keep for Interior<N> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            watched,
            held,
            recovery,
            body: _,
            near: _,
            time: _,
            order: _,
            all: _,
        } = self;
        watched.save(tape);
        held.save(tape);
        recovery.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            watched,
            held,
            recovery,
            order,
            body: _,
            near: _,
            time: _,
            all: _,
        } = self;
        // made anew from what is held
        order.clear();
        watched.load(tape)?;
        held.load(tape)?;
        recovery.load(tape)
    }
}

impl<const N: usize> Interior<N> {
    /// No points; `tolerance` is the speed below which a violation counts as solved.
    pub fn new(tolerance: f64) -> Self {
        Interior {
            body: None,
            watched: Vec::new(),
            held: Vec::new(),
            near: Vec::new(),
            recovery: 0.0,
            time: 0.0,
            order: Vec::new(),
            all: Complementarity::new(tolerance),
        }
    }

    /// Watch the material `points`, which come cell by cell, on nodes of these `heights` and reciprocal masses, `columns` a
    /// row; the smallest cells have the size `cell`.
    pub fn watch(
        &mut self,
        points: Vec<ContactPoint<N>>,
        heights: Vec<f64>,
        recip_mass: Vec<f64>,
        columns: usize,
        cell: f64,
    ) {
        let mut cells: Vec<(usize, usize, bool)> = Vec::new();
        for (k, point) in points.iter().enumerate() {
            let outside = point.values.iter().any(|value| *value < 0.0);
            match cells.last_mut().filter(|cell| cell.0 == point.node) {
                Some(cell) => *cell = (point.node, k + 1, cell.2 || outside),
                None => cells.push((point.node, k + 1, outside)),
            }
        }
        self.body = Some(Arc::new(Body {
            points,
            cells,
            heights,
            recip_mass,
            columns,
            dip: DIP * cell,
        }));
    }

    /// Points to watch until the next refresh, as [`crate::impact::wall::Wall::refresh`].
    pub fn refresh<V: AsRef<[f64]>>(
        &mut self,
        offsets: &[usize; N],
        (u, axis): (&[V], usize),
        (speed, horizon): (f64, f64),
        among: &dyn Fn(usize) -> bool,
    ) {
        let Some(body) = &self.body else {
            return;
        };
        let reach = WATCHED * speed * horizon;
        self.recovery = RETURN * speed;
        self.order.clear();
        self.held.retain(|(_, unknown)| unknown.active);
        self.watched.clear();
        let mut first = 0;
        for &(node, end, outside) in &body.cells {
            // points inside a cell are means of its nodes: none is lower than the lowest of them
            let low = |offset: &usize| {
                let n = node + offset;
                body.heights[n] + u[n].as_ref()[axis] < reach
            };
            let range = std::mem::replace(&mut first, end)..end;
            if !outside && !offsets.iter().any(low) {
                continue;
            }
            if !offsets.iter().any(|offset| among(node + offset)) {
                continue;
            }
            for k in range {
                let p = &body.points[k];
                if p.height + p.at(offsets, u, axis) < reach {
                    self.watched.push(k);
                }
            }
        }
        let watched = &self.watched;
        self.held.retain(|(k, _)| watched.binary_search(k).is_ok());
    }

    /// Gap rates of the watched points for free velocities `v`; impulses of the last step scaled by `ratio`.
    pub fn prepare<V: AsRef<[f64]>>(
        &mut self,
        offsets: &[usize; N],
        dt: f64,
        (u, v, axis): (&[V], &[V], usize),
        ratio: f64,
    ) {
        self.near.clear();
        self.time = dt;
        let Some(body) = &self.body else {
            return;
        };
        for &point in &self.watched {
            let p = &body.points[point];
            let gap = (p.height + p.at(offsets, u, axis)) / dt;
            let speed = p.at(offsets, v, axis);
            self.near.push(Near {
                point,
                gap,
                rate: gap + speed,
                free: gap.max(-self.recovery) + speed,
            });
        }
        for (_, unknown) in &mut self.held {
            unknown.impulse *= ratio;
        }
    }

    /// Whether points carry impulses.
    pub fn is_held(&self) -> bool {
        self.held.iter().any(|(_, unknown)| unknown.active)
    }

    /// Whether a watched point that was about to pass the wall still is, at velocities `v`.
    pub fn passes<V: AsRef<[f64]>>(&self, offsets: &[usize; N], (v, axis): (&[V], usize)) -> bool {
        let Some(body) = &self.body else {
            return false;
        };
        let least = -body.dip / self.time;
        let passing = |p: &Near| p.gap + body.points[p.point].at(offsets, v, axis) < least;
        // impulses of the surface only lift
        self.near.iter().any(|p| p.rate < least && passing(p))
    }

    /// Impulses of the surface `candidates` and of the points that are about to pass the wall, all at once. Returns the
    /// largest violation left.
    pub fn solve(
        &mut self,
        offsets: &[usize; N],
        surface: (&mut Complementarity, &[ContactPoint<N>], &[usize]),
    ) -> f64 {
        let Some(body) = self.body.clone() else {
            return 0.0;
        };
        let (surface, points, candidates) = surface;
        self.join(-body.dip / self.time);
        if self.order.is_empty() {
            self.arrange(&body, offsets, points, candidates);
        }
        for (unknown, place) in self.all.unknowns.iter_mut().zip(&self.order) {
            *unknown = match place {
                Place::Surface(c) => surface.unknowns[*c],
                Place::Inside(k) => self.held[*k].1,
            };
        }
        let everything: Vec<usize> = (0..self.order.len()).collect();
        let residual = self.all.solve(&everything);
        for (unknown, place) in self.all.unknowns.iter().zip(&self.order) {
            match place {
                Place::Surface(c) => surface.unknowns[*c] = *unknown,
                Place::Inside(k) => self.held[*k].1 = *unknown,
            }
        }
        residual
    }

    /// Let the points that would pass the wall without impulses, at a gap rate below `least`, join those held; the held ones
    /// get their gap rates.
    fn join(&mut self, least: f64) {
        let count = self.held.len();
        for near in &self.near {
            let place = self.held.binary_search_by_key(&near.point, |(k, _)| *k);
            match place {
                Ok(place) => {
                    let unknown = &mut self.held[place].1;
                    unknown.free = near.free;
                    unknown.active |= near.free < 0.0 && unknown.impulse == 0.0;
                }
                Err(place) if near.rate < least => {
                    let unknown = Unknown {
                        free: near.free,
                        impulse: 0.0,
                        active: true,
                    };
                    self.held.insert(place, (near.point, unknown));
                }
                Err(_) => {}
            }
        }
        if self.held.len() != count {
            self.order.clear();
        }
    }

    /// Order and coupling of surface candidates and held points.
    fn arrange(
        &mut self,
        body: &Body<N>,
        offsets: &[usize; N],
        surface: &[ContactPoint<N>],
        candidates: &[usize],
    ) {
        let held = &self.held;
        let point = |place: &Place| match place {
            Place::Surface(c) => &surface[*c],
            Place::Inside(k) => &body.points[held[*k].0],
        };
        let inside = (0..held.len()).map(Place::Inside);
        let mut order: Vec<Place> = candidates
            .iter()
            .map(|c| Place::Surface(*c))
            .chain(inside)
            .collect();
        order.sort_by_key(|place| {
            let node = point(place).node;
            (node % body.columns, node)
        });
        let ordered: Vec<&ContactPoint<N>> = order.iter().map(point).collect();
        let mut band = 0;
        for (c, p) in ordered.iter().enumerate() {
            let first = p.node % body.columns;
            let end = ordered.partition_point(|q| q.node % body.columns < first + side(N));
            band = band.max(end - 1 - c);
        }
        self.all.unknowns.clear();
        self.all.unknowns.resize(order.len(), Unknown::default());
        self.all.couple(band, |c, d| {
            ordered[c].coupling(ordered[d], offsets, |n| body.recip_mass[n])
        });
        self.order = order;
    }

    /// Every held point that pushes, with its impulse.
    pub fn pushing(&self) -> impl Iterator<Item = (&ContactPoint<N>, f64)> {
        let body = self.body.iter();
        body.flat_map(|body| {
            let pushes = self
                .held
                .iter()
                .filter(|(_, unknown)| unknown.impulse > 0.0);
            pushes.map(|(k, unknown)| (&body.points[*k], unknown.impulse))
        })
    }
}

/// The number of which `nodes` is the square.
fn side(nodes: usize) -> usize {
    (1..).find(|side| side * side >= nodes).unwrap_or(1)
}
