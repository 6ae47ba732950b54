//! Observation: what is kept of a run at its outputs, and what it leaves in the end.

use super::advance::Output;
use super::record::{Frame, Record, SectionView, Sliding, Snapshot};
use super::transfer::Remap;
use crate::curve::Status;
use crate::impact::kernel::PointView;
use crate::impact::run::{OUTPUTS, Run, UNSTABLE};
use crate::impact::wall::meridian::Wall;
use crate::plan::Geometry;
use crate::scheme::Scheme;
use crate::space::Space;

impl<S, W, T, const N: usize> Run<'_, S, W, T, N>
where
    S: Space,
    W: Wall<S>,
    T: Remap<S::Vector>,
{
    /// Keep a frame at time n (impulses of the step that is under way belong half to each side).
    pub(super) fn record(&mut self, output: &Output) {
        let Output {
            elastic,
            impulse,
            tangential,
        } = *output;
        let kinetic: f64 = (self.old.iter().zip(&self.v).zip(&self.model.mass))
            .map(|((a, b), m)| {
                let mut product = 0.0;
                for (a, b) in a.as_ref().iter().zip(b.as_ref()) {
                    product += a * b;
                }
                0.5 * m * product
            })
            .sum();
        let kinetic = kinetic - self.excess_kinetic();
        let incident = self.frames[0].kinetic;
        let given = incident + self.start.elastic + self.contact_work + self.transferred;
        let lost = self.plastic + self.shock + self.erosion.energy() - self.start.eroded;
        let balance = kinetic + elastic + self.surface + lost - given;
        // over what there is to lose: of a slow particle that adheres most of it comes from the surfaces
        let closure = (balance / (incident - self.surface)).abs();
        if !(closure <= UNSTABLE) {
            self.failure = Some(format!(
                "energy imbalance {closure:e} of the incident energy"
            ));
        }
        self.closure = self.closure.max(closure);
        if self.failure.is_none() {
            self.failure = self.below_the_wall();
        }
        let [south, centre, north] = &self.model.markers;
        let frame = Frame {
            time: self.time,
            displacement: self.start.height - self.mean(&self.u, S::NORMAL),
            centre_displacement: self.start.centre - self.along(centre),
            impulse: self.impulse - 0.5 * impulse,
            tangential: self.tangential - 0.5 * tangential,
            contact_radius: self.contact_radius,
            kinetic,
            elastic,
            plastic: self.plastic,
            surface: self.surface,
            height: self.height(north, south),
        };
        self.contact_radius = 0.0;
        if self.plan.pictures > 0 && self.frames.len().is_multiple_of(self.outputs_a_picture()) {
            self.film.push((self.time, self.snapshot()));
        }
        self.frames.push(frame);
        if self.compressed.is_none() && self.mean(&self.v, S::NORMAL) >= 0.0 {
            self.compressed = Some(self.snapshot());
        }
    }

    /// The particle as it comes, if there is to be a film.
    pub(super) fn take_first_picture(&mut self) {
        if self.plan.pictures > 0 {
            self.film.push((0.0, self.snapshot()));
        }
    }

    /// Outputs from picture to picture.
    fn outputs_a_picture(&self) -> usize {
        (OUTPUTS / self.plan.pictures as f64).max(1.0) as usize
    }

    /// Whether the cell that carries a marker has not been taken out.
    fn has(&self, marker: usize) -> bool {
        let node = self.model.markers[marker].first();
        node.is_some_and(|(node, _)| self.model.points.carries(*node))
    }

    /// What lies below the wall although nothing can, as a reason to stop. Only bodies that are flattened fold over or lose
    /// surface points, so only they are searched.
    fn below_the_wall(&self) -> Option<String> {
        let sunk = -0.5 * self.plan.grid.shape.height() - self.mean(&self.u, S::NORMAL);
        if sunk > self.plan.tolerance {
            return Some(format!("the centre of mass is {sunk:e} R below the wall"));
        }
        if !self.plan.grid.remedies.is_large() {
            return None;
        }
        let depth = -self.model.points.lowest(&self.u);
        let cell = self.plan.grid.fine;
        let cells = depth / cell;
        (!(depth <= cell)).then(|| format!("material {cells:.1} cells below the wall"))
    }

    /// Displacement of a marker along the normal.
    pub(super) fn along(&self, marker: &[(usize, f64)]) -> f64 {
        marker
            .iter()
            .map(|(n, w)| w * self.u[*n].as_ref()[S::NORMAL])
            .sum()
    }

    /// Distance of the poles.
    pub(super) fn height(&self, north: &[(usize, f64)], south: &[(usize, f64)]) -> f64 {
        let mut squared = 0.0;
        for axis in 0..S::Vector::default().as_ref().len() {
            let along = |marker: &[(usize, f64)]| -> f64 {
                marker
                    .iter()
                    .map(|(n, w)| w * self.u[*n].as_ref()[axis])
                    .sum()
            };
            let rest = match axis == S::NORMAL {
                true => self.plan.grid.shape.height(),
                false => 0.0,
            };
            let distance = rest + along(north) - along(south);
            squared += distance * distance;
        }
        squared.sqrt()
    }

    /// Motion along the wall so far, where there can be any.
    fn sliding(&self) -> Option<Sliding> {
        let axis = S::SLIDING.filter(|_| self.plan.geometry == Geometry::Half)?;
        Some(Sliding {
            incident: self.speed * self.plan.angle.sin(),
            exit: self.mean(&self.v, axis),
            spin: self.spin(),
            impulse_ratio: -self.tangential / self.impulse,
        })
    }

    /// The particle as it is now.
    fn snapshot(&self) -> Snapshot {
        let model = &self.model;
        let seen = |p: PointView| {
            let volume = p.volume / model.copies;
            let depth = self.plan.grid.fine;
            S::section(&p.position, &p.reference, volume, depth).map(|place| SectionView {
                place,
                plastic_strain: p.plastic_strain,
                von_mises: p.von_mises,
                pressure: p.pressure,
                temperature: p.temperature.unwrap_or_default(),
            })
        };
        Snapshot {
            points: model
                .points
                .view(&self.u)
                .into_iter()
                .filter_map(seen)
                .collect(),
            outline: self.model.contact.outline(&self.u),
        }
    }

    /// Memory of points and nodes.
    fn bytes(&self) -> usize {
        let fields = [&self.u, &self.v, &self.old, &self.force];
        let nodes: usize = fields.iter().map(|f| std::mem::size_of_val(&f[..])).sum();
        self.model.points.bytes() + nodes + self.transfer.bytes()
    }

    /// All that the impact leaves; the run keeps its body.
    pub(super) fn take_record(&mut self) -> Record {
        let memory_bytes = self.bytes();
        let exit_speed = if self.is_flat() || self.sticks() {
            0.0
        } else {
            self.mean(&self.v, S::NORMAL)
        };
        let transfer_loss = -self.transferred / self.frames[0].kinetic;
        let rebound = self.snapshot();
        let sliding = self.sliding();
        let status = match &self.failure {
            Some(reason) => Status::Failed(format!("step {}: {reason}", self.step)),
            None if self.sticks() => Status::Sticks,
            None if self.time > self.plan.longest_time => Status::NoRebound,
            None => Status::Ok,
        };
        let mut record = Record {
            contact_end: self.contact_end,
            exit_speed,
            speed: self.speed * self.plan.angle.cos(),
            shape: self.plan.grid.shape,
            sliding,
            closure: self.closure,
            eroded: self.erosion.volume() / self.mass,
            shock: self.shock / self.frames[0].kinetic,
            knocking: if self.plan.grid.remedies.is_large() {
                self.plan.grid.fine
            } else {
                0.0
            },
            has_poles: !self.erosion.is_on() || [0, 2].into_iter().all(|pole| self.has(pole)),
            plastic_strain: self.model.points.plastic_strain_volume() / self.mass,
            warmth: self.model.points.warmth(),
            points: self.model.points.count(),
            steps: (self.stepped as f64 / self.blocks as f64).round() as u64,
            seconds_before: 0.0,
            memory_bytes,
            transfer_loss,
            contact_loss: -self.contact_work / self.frames[0].kinetic,
            frames: std::mem::take(&mut self.frames),
            compressed: self.compressed.take().unwrap_or_default(),
            rebound,
            film: std::mem::take(&mut self.film),
            status,
        };
        // other schemes are run to see what they do
        if matches!(record.status, Status::Ok | Status::Sticks)
            && self.plan.scheme == Scheme::default()
            && let Err(reason) = record.verdict(self.plan.tolerance)
        {
            record.status = Status::Failed(reason);
        }
        record
    }
}
