//! Runs: impacts reduced to what a fit needs, as pure numbers.

use crate::contact::elastoplastic::YieldUnits;
use crate::curve::{Impact, Status};
use crate::material::{Material, YIELD_PRESSURE_RATIO};
use std::f64::consts::PI;

/// Points a curve is resampled to on each branch, evenly over its displacements.
const POINTS: usize = 40;

/// What a fit counts in: yield flattening and force of one sphere, and the time $\sqrt{m\delta_y/F_y}$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Flattening $\delta_y$, m.
    pub displacement: f64,
    /// Force $F_y$, N.
    pub force: f64,
    /// Time, s.
    pub time: f64,
    /// Sphere radius, m.
    pub radius: f64,
    /// Sphere mass, kg.
    pub mass: f64,
}

impl Scale {
    /// Scale of a sphere; `None` if its material does not yield.
    #[must_use]
    pub fn of(material: &Material, radius: f64) -> Option<Self> {
        let point = material.yield_point(radius, YIELD_PRESSURE_RATIO)?;
        let mass = material.sphere_mass(radius);
        Some(Scale {
            displacement: point.displacement,
            force: point.force,
            time: (mass * point.displacement / point.force).sqrt(),
            radius,
            mass,
        })
    }

    /// Scale of a sphere that stays elastic: R, $E^\ast R^2$ and the time that belongs to them.
    #[must_use]
    pub fn elastic(material: &Material, radius: f64) -> Self {
        let mass = material.sphere_mass(radius);
        let force = material.contact_modulus() * radius * radius;
        Scale {
            displacement: radius,
            force,
            time: (mass * radius / force).sqrt(),
            radius,
            mass,
        }
    }

    /// The same scale as laws count in.
    #[must_use]
    pub fn units(&self) -> YieldUnits {
        YieldUnits {
            flattening: self.displacement / self.radius,
            force: self.force / (self.radius * self.radius),
        }
    }

    /// Density of the sphere, kg/m3.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.mass / (4.0 / 3.0 * PI * self.radius.powi(3))
    }

    /// Incident energy $\tfrac12 m V^2$ over $F_y \delta_y$.
    #[must_use]
    pub fn energy(&self, velocity: f64) -> f64 {
        0.5 * self.mass * velocity * velocity / (self.force * self.displacement)
    }
}

/// One point of a loading curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Flattening w.
    pub flattening: f64,
    /// Force over F*.
    pub force: f64,
    /// Kinetic energy of the centre of mass over $F_y\delta_y$.
    pub energy: f64,
}

/// One impact in the units of a [`Scale`].
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Impact speed, m/s.
    pub velocity: f64,
    /// Incident energy.
    pub energy: f64,
    /// Whether the body hardly came back: contact time, residual and unloading then say nothing.
    pub sticks: bool,
    /// F*.
    pub max_force: f64,
    /// delta*.
    pub max_flattening: f64,
    /// delta_res.
    pub residual: f64,
    /// e.
    pub restitution: f64,
    /// Contact time.
    pub contact_time: f64,
    /// Loading curve.
    pub loading: Vec<Point>,
    /// `(w, F/F*)` in unloading.
    pub unloading: Vec<(f64, f64)>,
}

/// Restitution below which a body counts as sticking: a millionth of the energy comes back.
const STICKING: f64 = 1e-3;

impl Run {
    /// Reduce an impact; one that sticks (e = 0) has its loading and its restitution.
    ///
    /// # Errors
    /// Why it cannot be used: it did not end, or its curve or figures do not describe an impact.
    pub fn reduce(impact: &Impact, scale: &Scale) -> std::result::Result<Self, String> {
        let s = &impact.summary;
        let refuse = |why: &str| Err(why.to_owned());
        match &s.status {
            Status::Ok => {}
            Status::Sticks => return refuse("stays on the wall"),
            Status::NoRebound => return refuse("did not rebound in its time"),
            Status::Failed(why) => return Err(format!("failed: {why}")),
        }
        let positive = [
            s.velocity_m_s,
            s.max_force_n,
            s.max_displacement_m,
            s.contact_time_s,
        ];
        if positive.iter().any(|x| !(*x > 0.0 && x.is_finite()))
            || !s.residual_displacement_m.is_finite()
        {
            return refuse("has a figure that is not positive and finite");
        }
        if !(0.0..=1.01).contains(&s.restitution) {
            return refuse("has a restitution that is not between 0 and 1");
        }
        let sticks = s.restitution < STICKING;
        let turn = impact.curve.turning_point();
        let samples = &impact.curve.samples;
        if turn == 0 || (turn + 1 >= samples.len() && !sticks) {
            return refuse("has a curve without loading or without unloading");
        }
        let most = samples[turn].displacement_m;
        let squared_speeds = impact.curve.squared_speeds(s.velocity_m_s, scale.mass);
        let mut rows: Vec<Record> = samples
            .iter()
            .zip(squared_speeds)
            .map(|(sample, v2)| (sample.displacement_m, [sample.force_n, v2]))
            .collect();
        let by_displacement = |a: &Record, b: &Record| a.0.total_cmp(&b.0);
        let mut there = rows[..=turn].to_vec();
        let back = &mut rows[turn..];
        there.sort_by(by_displacement);
        back.sort_by(by_displacement);
        let lost = s.residual_displacement_m.clamp(0.0, most);
        let loading = resample(&there, 0.0, most).map(|(d, [f, v2])| Point {
            flattening: d / scale.displacement,
            force: f / s.max_force_n,
            energy: scale.energy(v2.sqrt()),
        });
        let unloading = resample(back, lost, most)
            .map(|(d, [f, _])| (d / scale.displacement, f / s.max_force_n));
        Ok(Run {
            velocity: s.velocity_m_s,
            energy: scale.energy(s.velocity_m_s),
            sticks,
            max_force: s.max_force_n / scale.force,
            max_flattening: s.max_displacement_m / scale.displacement,
            residual: s.residual_displacement_m / scale.displacement,
            restitution: s.restitution,
            contact_time: s.contact_time_s / scale.time,
            loading: loading.collect(),
            unloading: match sticks {
                true => Vec::new(),
                false => unloading.collect(),
            },
        })
    }
}

/// Displacement, m; force, N, and squared speed, m2/s2.
type Record = (f64, [f64; 2]);

/// Records at the middles of [`POINTS`] equal cells between `from` and `to`, linear between `records` that are sorted
/// by displacement.
fn resample(records: &[Record], from: f64, to: f64) -> impl Iterator<Item = Record> {
    (0..POINTS).map(move |i| {
        let at = from + (to - from) * (i as f64 + 0.5) / POINTS as f64;
        let above = records.partition_point(|r| r.0 < at);
        let high = &records[above.min(records.len() - 1)];
        let low = &records[above.saturating_sub(1)];
        let width = high.0 - low.0;
        let part = if width > 0.0 {
            ((at - low.0) / width).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let between = |k: usize| low.1[k] + part * (high.1[k] - low.1[k]);
        (at, [between(0), between(1)])
    })
}
