//! Record of a run: what is kept at every output, and how it becomes a curve and its figures in SI units.

use crate::curve::files::FromFiles;
use crate::curve::{
    Curve, Cylinder, Heating, Impact, MapPoint, Part, Particle, ParticleMap, Sample, SchemeFigures,
    Status, Summary, Tangential,
};
use crate::impact::kernel::Warmth;
use crate::material::{Material, ReferenceUnits};
use crate::plan::Plan;
use crate::scheme::TimeStep;
use crate::shape::Shape;
use crate::tape::keep_fields;
use crate::unit::engineering;

mod adhering;

/// One output in run units (R, R/c0, E R^2, E R^3).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Frame {
    /// Time.
    pub time: f64,
    /// Approach of the centre of mass.
    pub displacement: f64,
    /// Travel of the material centre.
    pub centre_displacement: f64,
    /// Wall impulse since first contact.
    pub impulse: f64,
    /// The same along the wall, in the direction in which the particle came.
    pub tangential: f64,
    /// Contact radius.
    pub contact_radius: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy.
    pub elastic: f64,
    /// Plastic work so far.
    pub plastic: f64,
    /// Energy of the surface that the wall attracts.
    pub surface: f64,
    /// Height of the particle along the impact axis.
    pub height: f64,
}

/// A material point in the plane of a map, in run units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SectionView {
    /// Distance from the axis (along x in three dimensions), height above the wall, edge length.
    pub place: [f64; 3],
    /// Accumulated equivalent plastic strain.
    pub plastic_strain: f64,
    /// Von Mises (Cauchy) stress.
    pub von_mises: f64,
    /// Pressure, minus the mean (Cauchy) stress.
    pub pressure: f64,
    /// Temperature, K; 0 of matter that knows none.
    pub temperature: f64,
}

/// What an oblique impact, or one with friction, does along the wall; run units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sliding {
    /// Velocity along the wall before.
    pub incident: f64,
    /// Velocity of the centre of mass along the wall after.
    pub exit: f64,
    /// Angular velocity after; positive rolls in the direction of `incident`.
    pub spin: f64,
    /// Impulse along the wall over the normal impulse.
    pub impulse_ratio: f64,
}

impl Sliding {
    /// Figures in SI units; `radius` in m, `unit` is the speed sqrt(E/rho) in m/s.
    fn figures(&self, radius: f64, unit: f64) -> Tangential {
        let after = self.exit - self.spin;
        Tangential {
            incident_velocity_m_s: self.incident * unit,
            velocity_m_s: self.exit * unit,
            restitution: (self.incident > 0.0).then(|| -after / self.incident),
            angular_velocity_rad_s: self.spin * unit / radius,
            impulse_ratio: self.impulse_ratio,
        }
    }
}

/// The particle at one moment, in run units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Snapshot {
    /// Material points.
    pub points: Vec<SectionView>,
    /// Surface from the south pole upwards: distance from the axis, height above the wall.
    pub outline: Vec<(f64, f64)>,
}

impl Snapshot {
    /// Map in SI units.
    #[must_use]
    pub fn map(&self, material: &Material, radius: f64) -> ParticleMap {
        let inside = self.points.iter().map(|p| MapPoint {
            part: Part::Inside,
            r_m: p.place[0] * radius,
            z_m: p.place[1] * radius,
            size_m: p.place[2] * radius,
            equivalent_plastic_strain: p.plastic_strain,
            von_mises_pa: p.von_mises * material.young_modulus,
            pressure_pa: p.pressure * material.young_modulus,
            temperature_k: (p.temperature > 0.0).then_some(p.temperature),
        });
        let surface = self.outline.iter().map(|&(r, z)| MapPoint {
            part: Part::Surface,
            r_m: r * radius,
            z_m: z * radius,
            size_m: 0.0,
            equivalent_plastic_strain: 0.0,
            von_mises_pa: 0.0,
            pressure_pa: 0.0,
            temperature_k: None,
        });
        ParticleMap {
            points: inside.chain(surface).collect(),
        }
    }
}

keep_fields!(Frame: time, displacement, centre_displacement, impulse, tangential, contact_radius, kinetic, elastic, plastic, surface, height);
keep_fields!(SectionView: place, plastic_strain, von_mises, pressure, temperature);
keep_fields!(Snapshot: points, outline);

/// All that a finished (or stopped) run knows.
#[derive(Debug, Clone)]
pub struct Record {
    /// Outputs in order of time; the first is first contact.
    pub frames: Vec<Frame>,
    /// Time of the last loss of contact.
    pub contact_end: f64,
    /// Velocity of the centre of mass at the end, positive away from the wall.
    pub exit_speed: f64,
    /// Normal component of the impact velocity.
    pub speed: f64,
    /// Shape before the impact.
    pub shape: Shape,
    /// Motion along the wall, where there can be any.
    pub sliding: Option<Sliding>,
    /// Largest energy imbalance over the incident kinetic energy.
    pub closure: f64,
    /// Share of the body that lost its strength.
    pub eroded: f64,
    /// Work of viscous stresses in shocks over the incident kinetic energy.
    pub shock: f64,
    /// Size of cell whose points knock as the edge of the contact reaches them; 0: they do not.
    pub knocking: f64,
    /// Whether the material at both poles is still there: else nothing is left to measure the height by.
    pub has_poles: bool,
    /// Volume mean of the equivalent plastic strain.
    pub plastic_strain: f64,
    /// How warm it became; none of matter that knows no temperature.
    pub warmth: Option<Warmth>,
    /// Material points.
    pub points: usize,
    /// Steps.
    pub steps: u64,
    /// Wall time before the run was resumed from a checkpoint, s.
    pub seconds_before: f64,
    /// Memory of points and nodes, bytes.
    pub memory_bytes: usize,
    /// Energy lost in transfers between points and grid over the incident kinetic energy.
    pub transfer_loss: f64,
    /// Energy lost as surface points met the wall, over the incident kinetic energy.
    pub contact_loss: f64,
    /// How it ended.
    pub status: Status,
    /// The particle at its largest displacement.
    pub compressed: Snapshot,
    /// The particle at the end.
    pub rebound: Snapshot,
    /// Pictures on the way, each with its time, as many as were asked for.
    pub film: Vec<(f64, Snapshot)>,
}

/// Share of the contact time over which F is averaged before its maximum is taken.
const FORCE_WINDOW: f64 = 0.02;
/// The same at most, where cells are coarse: of a half sine the mean over it is 0.4 % low.
const LONGEST_FORCE_WINDOW: f64 = 0.1;

/// Largest energy imbalance over the incident kinetic energy of a run whose figures hold.
const MOST_CLOSURE: f64 = 0.01;
/// Share of the body that may lose its strength without a warning.
const MUCH_ERODED: f64 = 0.01;

impl Record {
    /// Linear interpolation of a quantity at `time`.
    fn at(&self, time: f64, value: impl Fn(&Frame) -> f64) -> f64 {
        let f = &self.frames;
        if f.len() < 2 {
            return value(&f[0]);
        }
        let k = f.partition_point(|x| x.time < time).clamp(1, f.len() - 1);
        let (a, b) = (&f[k - 1], &f[k]);
        let s = ((time - a.time) / (b.time - a.time)).clamp(0.0, 1.0);
        value(a) + s * (value(b) - value(a))
    }

    /// Largest force averaged over 2 % of the contact time (of a particle that stays on the wall: of the time in which it
    /// would bounce, six times that of half the displacement), and over no less than the time in which the edge of a flattened
    /// body crosses a cell: each surface point that it reaches gives a knock.
    fn max_force(&self) -> f64 {
        self.mean_forces()
            .fold(0.0, |most, (_, force)| f64::max(most, force))
    }

    /// The force averaged as [`Record::max_force`] says, where its mean has a kink, with the times.
    fn mean_forces(&self) -> impl Iterator<Item = (f64, f64)> {
        let most = self.largest(|f| f.displacement);
        let middle = self.frames.iter().find(|f| f.displacement >= 0.5 * most);
        let bounce = 6.0 * middle.map_or(0.0, |f| f.time);
        let whole = self.contact_end.min(bounce);
        let [least, longest] = [FORCE_WINDOW, LONGEST_FORCE_WINDOW].map(|share| share * whole);
        let half = 0.5 * self.crossing().min(longest).max(least);
        let (from, to) = (half, self.contact_end - half);
        let mean = move |t: f64| {
            let after = self.at(t + half, |f| f.impulse);
            (t, (after - self.at(t - half, |f| f.impulse)) / (2.0 * half))
        };
        // the mean is piecewise linear between the frames' times shifted by half a window
        self.frames
            .iter()
            .flat_map(move |f| [f.time - half, f.time + half])
            .filter(move |t| *t >= from && *t <= to)
            .map(mean)
    }

    /// Mean time in which the edge of the contact goes on by a cell until it is widest; 0 where it does not knock.
    fn crossing(&self) -> f64 {
        let mut widest = self.frames[0];
        for frame in &self.frames {
            if frame.contact_radius > widest.contact_radius {
                widest = *frame;
            }
        }
        if widest.contact_radius > 0.0 {
            self.knocking * widest.time / widest.contact_radius
        } else {
            0.0
        }
    }

    /// Largest value of a quantity, by the parabola through the largest frame and its neighbours.
    fn largest(&self, value: impl Fn(&Frame) -> f64) -> f64 {
        let y: Vec<f64> = self.frames.iter().map(value).collect();
        let k = (0..y.len()).fold(0, |b, i| if y[i] > y[b] { i } else { b });
        if k == 0 || k + 1 == y.len() {
            return y[k];
        }
        let (rise, bend) = (
            0.5 * (y[k + 1] - y[k - 1]),
            y[k + 1] - 2.0 * y[k] + y[k - 1],
        );
        if bend < 0.0 {
            y[k] - 0.5 * rise * rise / bend
        } else {
            y[k]
        }
    }

    /// Whether the figures are those of an impact: what no impact on a wall can do is a fault of the run.
    ///
    /// # Errors
    /// The first figure that is impossible, and its bounds. `tolerance` is that of the plan.
    pub fn verdict(&self, tolerance: f64) -> std::result::Result<(), String> {
        let restitution = self.exit_speed / self.speed;
        let displacement = self.largest(|f| f.displacement);
        let force = self.max_force();
        let closure = self.closure;
        // of a slanted impact a little of the motion along the wall may turn into rebound: what the account of energies misses
        let most = self.sliding.as_ref().map_or(1.0, |sliding| {
            let along = sliding.incident / self.speed;
            (1.0 + closure * (1.0 + along * along)).sqrt()
        });
        if !(restitution >= 0.0 && restitution <= most) {
            Err(format!(
                "restitution {restitution:e} is not from 0 to {most}"
            ))
        } else if !(displacement > 0.0 && displacement <= 0.5 * self.shape.height() + tolerance) {
            Err(format!(
                "largest displacement {displacement:e} R is not above 0 and within {} R: the centre of mass would be below the wall",
                0.5 * self.shape.height()
            ))
        } else if !(force > 0.0 && force.is_finite()) {
            Err(format!("largest force {force:e} E R^2 is not above 0"))
        } else if !(closure < MOST_CLOSURE) {
            Err(format!(
                "energy closure {closure:e} of the incident energy is not below {MOST_CLOSURE}"
            ))
        } else {
            Ok(())
        }
    }

    /// Length, largest diameter, and diameter at a fifth of the initial length above the foot, of a cylinder at the end.
    fn cylinder(&self) -> Option<[f64; 3]> {
        let Shape::Cylinder { length } = self.shape else {
            return None;
        };
        let outline = &self.rebound.outline;
        let low = outline.iter().fold(f64::INFINITY, |z, p| z.min(p.1));
        let high = outline.iter().fold(f64::NEG_INFINITY, |z, p| z.max(p.1));
        let widest = outline.iter().fold(0.0, |r: f64, p| r.max(p.0));
        let height = low + 0.2 * length;
        // the side, not the ends: the outermost crossing of that height
        let crossings = outline.windows(2).filter_map(|pair| {
            let ((r0, z0), (r1, z1)) = (pair[0], pair[1]);
            let between = (z0 - height) * (z1 - height) <= 0.0 && z0 != z1;
            between.then(|| r0 + (r1 - r0) * (height - z0) / (z1 - z0))
        });
        let there = crossings.fold(f64::NAN, f64::max);
        Some([high - low, 2.0 * widest, 2.0 * there])
    }

    /// What a reader of the figures has to know.
    fn warnings(&self, plan: &Plan) -> Vec<String> {
        let mut warnings = Vec::new();
        if plan.similarity().is_on() {
            warnings.push(format!(
                "slower than matters to an elastic particle: run at {}, figures and curve brought back by Hertz's similarity; \
                 the maps show the run",
                engineering(plan.run_velocity, "m/s", 3)
            ));
        }
        warnings.extend(plan.unseen());
        if self.eroded > MUCH_ERODED {
            let share = 100.0 * self.eroded;
            warnings.push(format!(
                "{share:.1} % of the body lost its strength (erosion of cells squeezed too thin)"
            ));
        }
        if !self.has_poles {
            warnings.push(
                "material at a pole was eroded: no height, so no compression ratio".to_owned(),
            );
        }
        warnings
    }

    /// Mean height after loss of contact, weighted by a Hann window so that part periods do not bias it.
    fn resting_height(&self) -> f64 {
        if self.plastic_strain == 0.0 && self.eroded == 0.0 {
            // a body that has not yielded rests as the sphere it was; the vibration it is left with does not average to that
            return self.shape.height();
        }
        let end = self.frames.last().map_or(0.0, |f| f.time);
        let span = end - self.contact_end;
        let (mut sum, mut weight) = (0.0, 0.0);
        for pair in self.frames.windows(2) {
            let mid = 0.5 * (pair[0].time + pair[1].time);
            if mid > self.contact_end && span > 0.0 {
                let phase = std::f64::consts::PI * (mid - self.contact_end) / span;
                let w = phase.sin().powi(2) * (pair[1].time - pair[0].time);
                sum += w * 0.5 * (pair[0].height + pair[1].height);
                weight += w;
            }
        }
        if weight > 0.0 {
            sum / weight
        } else {
            self.frames.last().map_or(f64::NAN, |f| f.height)
        }
    }

    /// Curve and figures in SI units.
    #[must_use]
    pub fn impact(&self, material: &Material, radius: f64, plan: &Plan, wall_s: f64) -> Impact {
        let units = ReferenceUnits::of(material, radius);
        let like = plan.similarity();
        let (time, force) = (units.time() * like.time(), units.force() * like.force());
        let (energy, length) = (units.energy() * like.energy(), radius * like.displacement());
        let contact_radius = radius * like.radius();
        let mut samples = Vec::with_capacity(self.frames.len());
        for pair in self.frames.windows(2) {
            if pair[0].time > self.contact_end {
                break;
            }
            let (a, b) = (&pair[0], &pair[1]);
            let middle = |f: fn(&Frame) -> f64| 0.5 * (f(a) + f(b));
            samples.push(Sample {
                time_s: middle(|f| f.time) * time,
                displacement_m: middle(|f| f.displacement) * length,
                centre_displacement_m: middle(|f| f.centre_displacement) * length,
                force_n: (b.impulse - a.impulse) / (b.time - a.time) * force,
                target_displacement_m: None,
                tangential_force_n: (self.sliding.as_ref())
                    .map(|_| (a.tangential - b.tangential) / (b.time - a.time) * force),
                contact_radius_m: b.contact_radius * contact_radius,
                kinetic_j: middle(|f| f.kinetic) * energy,
                elastic_j: middle(|f| f.elastic) * energy,
                plastic_j: middle(|f| f.plastic) * energy,
                surface_j: plan.adhesion.map(|_| middle(|f| f.surface) * energy),
            });
        }
        let incident = self.frames[0].kinetic;
        let last = &self.frames[self.frames.len() - 1];
        let whole = self.shape.height();
        let least_height = whole - self.largest(|f| whole - f.height) * like.displacement();
        let height = |found: f64| if self.has_poles { found } else { f64::NAN };
        let mut summary = Summary {
            velocity_m_s: plan.velocity,
            restitution: self.exit_speed / self.speed,
            max_force_n: self.max_force() * force,
            max_displacement_m: self.largest(|f| f.displacement) * length,
            max_centre_displacement_m: self.largest(|f| f.centre_displacement) * length,
            residual_displacement_m: self.at(self.contact_end, |f| f.displacement) * length,
            contact_time_s: self.contact_end * time,
            compression_ratio: 1.0 - height(self.resting_height()) / whole,
            height_at_max_compression_ratio: height(least_height) / whole,
            equivalent_plastic_strain: self.plastic_strain,
            plastic_work_ratio: last.plastic / incident,
            energy_closure: self.closure,
            shock_work_ratio: self.shock,
            eroded_volume_ratio: self.eroded,
            points: self.points,
            steps: self.steps,
            wall_s,
            heating: self.warmth.map(|warmth| {
                let work = last.plastic / incident;
                Heating {
                    heat_ratio: warmth.share * work,
                    stored_work_ratio: (1.0 - warmth.share) * work,
                    max_temperature_k: warmth.hottest,
                    mean_temperature_k: warmth.mean,
                }
            }),
            adhesion: self.adhesion(material, radius, plan),
            tangential: self.sliding.map(|s| s.figures(radius, units.speed())),
            target: None,
            scheme: None,
            cylinder: self.cylinder().map(|[length, foot, fifth]| Cylinder {
                final_length_m: length * radius,
                foot_diameter_m: foot * radius,
                diameter_at_fifth_m: fifth * radius,
            }),
            particle: Some(Particle::of_shape(material, radius, self.shape)),
            warnings: self.warnings(plan),
            status: self.status.clone(),
        };
        let curve = Curve { samples };
        summary.scheme = self.scheme(&curve, &summary, plan, units.time());
        Impact { summary, curve }
    }

    /// The published method of the plan; `unit`: R/c0, s.
    fn scheme(
        &self,
        curve: &Curve,
        summary: &Summary,
        plan: &Plan,
        unit: f64,
    ) -> Option<SchemeFigures> {
        let method = plan.method?;
        let interval = plan.file_interval(self.speed);
        Some(SchemeFigures {
            preset: method.preset.name().to_owned(),
            settings: method.to_string(),
            time_step_s: match plan.scheme.time_step {
                TimeStep::Fixed(dt) => Some(dt * unit),
                TimeStep::Stable => None,
            },
            transfer_loss_ratio: self.transfer_loss,
            files: interval.map(|time| FromFiles::of(curve, summary, time * unit, 0.0)),
        })
    }
}
