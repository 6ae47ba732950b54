//! Plan of an impact: dimension, effects, grid, degree and duration, chosen from the case and its tolerance, with reasons.
//!
//! Lengths in a plan are in particle radii, times in R/c0 with $c_0 = \sqrt{E/\rho}$: for a rate-independent material
//! the whole run depends on (E/Y, rho V^2/E, nu) alone.

use crate::case::Case;
use crate::material::Material;
use crate::material::adhesion::Dugdale;
use crate::material::stress::Moduli;
use crate::scheme::Scheme;
use crate::scheme::preset::Method;
use crate::shape::Shape;
use crate::unit::significant;
use crate::{Error, Result};
use adhesion::Felt;
use std::f64::consts::PI;

mod adhesion;
mod bar;
mod effects;
mod grid;
mod method;
pub mod pair;
mod predict;
mod similar;
pub(crate) mod viscosity;

pub use grid::{Grid, Remedies, graded};
pub use predict::{with_cells, with_prediction};
pub use similar::Similarity;

/// Part of the sphere that is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Geometry {
    /// The section (r, z): normal impact, no friction.
    Axisymmetric,
    /// Three dimensions, x >= 0 and y >= 0: normal impact.
    Quarter,
    /// Three dimensions, y >= 0: oblique impact along x.
    Half,
}

/// Whether an effect is simulated, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// Name, e.g. `plasticity`.
    pub name: &'static str,
    /// On or off.
    pub on: bool,
    /// Why.
    pub reason: String,
}

/// What is expected of an impact before it is run; lengths in R, times in R/c0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Largest displacement.
    pub displacement: f64,
    /// Contact radius at largest displacement.
    pub contact_radius: f64,
    /// Contact time.
    pub contact_time: f64,
}

/// Plan of one impact.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Impact speed, m/s.
    pub velocity: f64,
    /// Speed at which it is run, m/s: of slow elastic impacts that of a faster one that is similar ([`Similarity`]).
    pub run_velocity: f64,
    /// Angle of the impact velocity from the wall's normal, rad.
    pub angle: f64,
    /// Friction coefficient of the wall.
    pub friction: f64,
    /// Attraction by the wall, where it is felt: lengths in R, tractions in E.
    pub adhesion: Option<Dugdale>,
    /// Part of the sphere that is simulated.
    pub geometry: Geometry,
    /// Expected size of the impact.
    pub estimate: Estimate,
    /// Effects, on or off, with reasons.
    pub effects: Vec<Effect>,
    /// Whether the body yields in this run.
    pub plastic: bool,
    /// Relative error asked for in F*, delta* and e.
    pub tolerance: f64,
    /// Grid.
    pub grid: Grid,
    /// Method; another than the default only to be compared.
    pub scheme: Scheme,
    /// Preset that the method comes from; none of the crate's own.
    pub method: Option<Method>,
    /// Impacts of the same particle, one after the other.
    pub impacts: usize,
    /// Pictures of the particle in a contact time; 0: none are taken.
    pub pictures: usize,
    /// Time after loss of contact over which the residual vibration is averaged, R/c0.
    pub ring_time: f64,
    /// Time at which an impact without rebound is given up, R/c0.
    pub longest_time: f64,
    /// Predicted material points.
    pub points: usize,
    /// Predicted steps.
    pub steps: u64,
    /// Predicted seconds on one core.
    pub seconds: f64,
}

impl Plan {
    /// An impact of the particle of a case at `velocity` (m/s), run as it is asked for; its points, steps and seconds are not predicted.
    fn of(case: &Case, velocity: f64, estimate: Estimate, grid: Grid) -> Self {
        let ring_time = match grid.shape {
            Shape::Sphere => 1.5 * fundamental_period(case.material.poisson_ratio),
            Shape::Cylinder { length } => bar::ring_time(length),
        };
        Plan {
            velocity,
            run_velocity: velocity,
            angle: case.angle,
            friction: case.friction,
            adhesion: None,
            geometry: geometry(case),
            estimate,
            effects: Vec::new(),
            plastic: case.material.flow.is_some(),
            tolerance: case.tolerance,
            grid,
            scheme: Scheme::default(),
            method: None,
            impacts: 1,
            pictures: 0,
            ring_time,
            longest_time: 6.0 * estimate.contact_time + 4.0 * ring_time,
            points: 0,
            steps: 0,
            seconds: 0.0,
        }
    }

    /// From what is run to what was asked for.
    #[must_use]
    pub fn similarity(&self) -> Similarity {
        Similarity::between(self.run_velocity, self.velocity)
    }

    /// The grid as it is laid: mass is scaled for the crate's own scheme only.
    #[must_use]
    pub fn laid(&self) -> Grid {
        let own = self.scheme == Scheme::default() && self.geometry == Geometry::Axisymmetric;
        Grid {
            scaled: if own { self.grid.scaled } else { 0.0 },
            ..self.grid
        }
    }
}

/// Size of an impact from the elastic (Hertz) and the fully plastic limit ([`Material::flattening_limits`]).
///
/// $$ \delta = (\delta_e^3 + \delta_p^3)^{1/3} $$
///
/// An estimate for laying a grid, within some 20 % of the simulated displacement; nothing else depends on it.
#[must_use]
pub fn estimate(material: &Material, velocity: f64) -> Estimate {
    let speed = velocity / (material.young_modulus / material.density).sqrt();
    let [elastic, plastic] = material.flattening_limits(velocity);
    let sum = elastic.powi(3) + plastic.powi(3);
    let displacement = sum.cbrt();
    let plastic_share = plastic.powi(3) / sum;
    Estimate {
        displacement,
        contact_radius: (displacement * (1.0 + plastic_share)).sqrt().min(1.0),
        contact_time: (2.94 - 0.64 * plastic_share) * displacement / speed,
    }
}

/// Least tolerance that is met in the section: with 54 cells a contact radius of a slight impact and 65 of one that flattens the
/// body, about as many as those it was compared with.
const LEAST_TOLERANCE: f64 = 1e-3;
/// The same in three dimensions, with 20 cells a contact radius.
const LEAST_SOLID_TOLERANCE: f64 = 5e-3;
/// Fastest impacts over $\sqrt{E/\rho}$ that plans were compared for.
const FASTEST_SHOWN: f64 = 0.5;
/// Most material points of a run: some 40 GB.
const MOST_POINTS: usize = 100_000_000;
/// Longest predicted run, s: a month.
const LONGEST_RUN: f64 = 2.6e6;

/// Least relative tolerance that a plan at this normal speed meets: what the largest number of cells allows, and at high speeds what
/// the smallest far cells do (15 times mach times their squared size).
#[must_use]
pub fn least_tolerance(case: &Case, velocity: f64) -> f64 {
    let m = &case.material;
    // faster ones run only where the file says that they are meant
    let mach = (velocity / (m.young_modulus / m.density).sqrt()).min(FASTEST_SHOWN);
    match geometry(case) {
        Geometry::Axisymmetric => LEAST_TOLERANCE.max(15.0 * mach * LEAST_FAR_CELL.powi(2)),
        Geometry::Quarter | Geometry::Half => LEAST_SOLID_TOLERANCE,
    }
}

/// Plans of all speeds of a case, slowest first.
///
/// # Errors
/// [`Error::Refused`] for a tolerance below the least one that is met, or a run that needs more memory or time than there is
/// sense in.
pub fn plans(case: &Case) -> Result<Vec<Plan>> {
    let refuse = |key: &str, found: String, allowed: String| {
        Err(Error::Refused {
            what: format!("{}: `{key}`", case.path.display()),
            found,
            allowed,
        })
    };
    let mut plans = Vec::with_capacity(case.velocities.len());
    for &velocity in &case.velocities {
        if let Some(allowed) = too_fine(case, velocity) {
            return refuse("accuracy.tolerance", case.tolerance.to_string(), allowed);
        }
        if let Some([found, allowed]) = method::refusal(case, velocity) {
            return refuse("scheme.preset", found, allowed);
        }
        let adhesion = Felt::of(case, velocity * case.angle.cos());
        if let Some([key, found, allowed]) =
            adhesion.and_then(|felt| felt.refusal(case, velocity * case.angle.cos()))
        {
            return refuse(&key, found, allowed);
        }
        let plan = plan(case, velocity);
        if let Some([found, allowed]) = oversize(&plan) {
            return refuse("impact.velocities", found, allowed);
        }
        plans.push(plan);
    }
    Ok(plans)
}

/// What a plan needs and what is allowed, where it needs more memory or time than there is sense in.
fn oversize(plan: &Plan) -> Option<[String; 2]> {
    let fits = plan.points <= MOST_POINTS;
    if fits && plan.seconds.is_finite() && plan.seconds <= LONGEST_RUN {
        return None;
    }
    let found = format!(
        "{} points and {} core seconds at {} m/s",
        significant(plan.points as f64, 3),
        significant(plan.seconds, 3),
        plan.velocity
    );
    let allowed = format!(
        "at most {} points and {} s, a month, are run; check the units, or ask for a larger tolerance",
        significant(MOST_POINTS as f64, 2),
        significant(LONGEST_RUN, 2)
    );
    Some([found, allowed])
}

/// What is said of the tolerance where a case asks for a smaller one at `velocity`.
fn too_fine(case: &Case, velocity: f64) -> Option<String> {
    let least = least_tolerance(case, velocity * case.angle.cos());
    (case.tolerance < least).then(|| {
        format!(
            "must be at least {} at {velocity} m/s: no smaller one is shown to be met",
            significant(least, 2)
        )
    })
}

/// Plan one impact of a case.
#[must_use]
pub fn plan(case: &Case, velocity: f64) -> Plan {
    let material = &case.material;
    let geometry = geometry(case);
    let adhesion = Felt::of(case, velocity * case.angle.cos()).filter(|felt| felt.is_on(case));
    let (mut effects, plastic) = effects::of(case, velocity * case.angle.cos());
    // what does not yield is planned as what cannot
    let elastic = Material {
        flow: None,
        ..*material
    };
    let acting = if plastic { material } else { &elastic };
    let asked = velocity;
    let shape = case.shape.over(case.radius);
    let slender = shape != Shape::Sphere;
    let as_asked = plastic || slender || adhesion.is_some() || geometry != Geometry::Axisymmetric;
    let velocity = if as_asked || case.method.is_some() {
        asked
    } else {
        let expected = estimate(acting, asked * case.angle.cos()).displacement;
        similar::run_speed(asked, expected, case.tolerance)
    };
    let normal = velocity * case.angle.cos();
    let estimate = match (shape, &adhesion) {
        (Shape::Sphere, None) => estimate(acting, normal),
        (Shape::Sphere, Some(felt)) => felt.estimate(acting, normal),
        (Shape::Cylinder { length }, _) => bar::estimate(acting, normal, length, case.radius),
    };
    let mut grid = match (shape, geometry) {
        (Shape::Cylinder { .. }, _) => bar::grid(shape, case.tolerance),
        (_, Geometry::Axisymmetric) => grid(&estimate, case, velocity),
        _ => solid_grid(&estimate, case, normal),
    };
    if let Some(felt) = &adhesion {
        grid = felt.refine(grid, &estimate);
    }
    let severity = severity(acting, normal);
    if geometry != Geometry::Axisymmetric && plastic {
        grid.remedies = Remedies::SOLID;
    } else if severity > LARGE_FROM {
        if !slender {
            let cells = cells_per_flat_radius(severity, case.tolerance);
            grid.fine = grid.fine.min(estimate.contact_radius / cells);
        }
        grid.remedies = Remedies::large(estimate.contact_radius / grid.fine);
        let waves = Moduli::new(material.young_modulus, material.poisson_ratio);
        grid.dt_share =
            viscosity::stable_share(normal / waves.dilatational_speed(material.density));
    }
    if geometry == Geometry::Axisymmetric && severity <= LARGE_FROM && !slender {
        grid = grid.scaled_mass(ADDED_MASS * case.tolerance, estimate.contact_time);
    }
    effects.push(similar::mass_scaling(&grid, &estimate));
    effects.push(similar::similar_impact(asked, velocity, &estimate));
    let plan = Plan {
        run_velocity: velocity,
        adhesion: adhesion.map(|felt| felt.law),
        effects,
        plastic,
        ..Plan::of(case, asked, estimate, grid)
    };
    let plan = match case.method {
        Some(method) => method::by(method, plan, case),
        None => plan,
    };
    with_prediction(plan, material)
}

/// Cells per contact radius for a relative tolerance on F*, delta* and e.
///
/// Over E/Y of 20 to 2560 and $\rho V^2/Y$ of 8e-4 to 0.1 the largest change of the three against 40 cells a radius was
/// 3.6 % with 7, 2.8 % with 10, 1.0 % with 14 and 0.6 % with 20 cells, the bound $2.4/n^2$; the formula asks for 5/6 of it.
///
/// What is left then is where the edge of the contact comes to rest between two surface points: of seven other impacts (E/Y 100 to
/// 8000, $\rho V^2/Y$ 1e-4 to 0.05) F* was off by up to 4.6 % with 7.6 cells, 4.0 % with 10.6 and 2.2 % with 12, against 20.
/// Halved cells change that by half as much again, hence at least ten.
fn cells_per_radius(tolerance: f64) -> f64 {
    (1.7 / tolerance.sqrt()).clamp(LEAST_CELLS, 60.0)
}

/// Least cells a contact radius.
const LEAST_CELLS: f64 = 10.0;

/// The same for impacts that flatten the body: its fast edge of contact crosses cell after cell, each with a knock that
/// stays in the mean of F over 2 % of the contact time. 14 cells at $\rho V^2/Y = 0.2$, 20 at 0.5 and 28 from 1 on keep
/// F* within 2.2 % of that of 44 (E/Y 40 to 1280), 34 at 1 within 0.2 %.
fn cells_per_flat_radius(severity: f64, tolerance: f64) -> f64 {
    28.0 * severity.min(1.0).powf(0.4) * (0.02 / tolerance).powf(0.28)
}

/// Smallest cells far from the contact, in R.
const LEAST_FAR_CELL: f64 = 0.03;

/// Size of cells far from the contact for a relative tolerance at a speed of `mach` times $\sqrt{E/\rho}$, in R: fast impacts
/// send waves through the body that come back while it is in contact.
///
/// Against 0.05 R, cells of 0.1 R change F* by 2.4 % at mach 0.16, by 0.6 % at 0.05 and 0.056, those of 0.07 R by 0.5 % at 0.16:
/// about 15 times mach times the squared size, of which the formula asks for a third of the tolerance.
fn far_cells(mach: f64, tolerance: f64) -> f64 {
    (0.02 * tolerance / mach).sqrt().clamp(LEAST_FAR_CELL, 0.1)
}

/// Grid for an expected impact.
fn grid(estimate: &Estimate, case: &Case, velocity: f64) -> Grid {
    let a = estimate.contact_radius;
    let m = &case.material;
    let mach = velocity / (m.young_modulus / m.density).sqrt();
    Grid {
        shape: Shape::Sphere,
        degree: 2,
        points_per_direction: 2,
        fine: a / cells_per_radius(case.tolerance),
        fine_width: 1.2 * a,
        fine_depth: 0.6 * a,
        growth: 1.15,
        coarse: far_cells(mach, case.tolerance),
        dt_share: 1.0,
        scaled: 0.0,
        remedies: Remedies::NONE,
    }
}

/// Share of the tolerance that mass scaling may add to the mass.
const ADDED_MASS: f64 = 0.05;

/// Three dimensions where friction acts, with as many planes of symmetry as the impact has.
fn geometry(case: &Case) -> Geometry {
    match (case.angle > 0.0, case.friction > 0.0) {
        // a frictionless wall feels nothing of the motion along it
        (_, false) => Geometry::Axisymmetric,
        (false, true) => Geometry::Quarter,
        (true, true) => Geometry::Half,
    }
}

/// Grid in three dimensions: coarser for the same tolerance, because the edge of the contact crosses cells at all angles and
/// the staircase averages out. Fine cells also cover the way that the contact rolls over the surface at the normal `velocity`.
///
/// A sphere that ends up rolling turns with $\omega R = 5/7\ V_t$, one that slides to the end with
/// $5/2\ \mu (1 + e) V_n \le 5 \mu V_n$; it gains that evenly about the middle of the contact, so it rolls half of it
/// times the contact time.
fn solid_grid(estimate: &Estimate, case: &Case, velocity: f64) -> Grid {
    let a = estimate.contact_radius;
    let m = &case.material;
    let speed = velocity / (m.young_modulus / m.density).sqrt();
    let slip = case.angle.tan().min(7.0 * case.friction);
    let rolled = 5.0 / 14.0 * slip * speed * estimate.contact_time;
    Grid {
        shape: Shape::Sphere,
        degree: 2,
        points_per_direction: 2,
        fine: a / (10.0 * (0.02 / case.tolerance).sqrt()).clamp(6.0, 20.0),
        fine_width: (1.2 * a + rolled).min(1.0),
        fine_depth: 0.6 * a,
        growth: 1.3,
        coarse: 0.15,
        dt_share: 1.0,
        scaled: 0.0,
        remedies: Remedies::NONE,
    }
}

/// $\rho V^2/Y$ from which the remedies against large deformation are on.
const LARGE_FROM: f64 = 0.1;

/// Dynamic pressure over strength, $\rho V^2/Y$; 0 for an elastic body.
#[must_use]
pub fn severity(material: &Material, velocity: f64) -> f64 {
    let pressure = material.density * velocity * velocity;
    material.flow.map_or(0.0, |f| pressure / f.yield_strength())
}

/// Period of the fundamental (oblate-prolate, l = 2) vibration of a sphere, R/c0.
///
/// $T = 2\pi R / (2.64\ c_s)$; the factor varies by 2 % over nu = 0..0.5 (Lamb 1882).
#[must_use]
pub fn fundamental_period(poisson_ratio: f64) -> f64 {
    2.0 * PI / 2.64 * (2.0 * (1.0 + poisson_ratio)).sqrt()
}
