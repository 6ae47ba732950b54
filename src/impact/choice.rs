//! Choice: flow stress, degree and scheme of a plan become concrete types once, before the loop.

use crate::impact::model::solid::{self, Mesh};
use crate::impact::model::{self, Model};
use crate::impact::run::record::Record;
use crate::impact::run::transfer::{Apic, Blend, Carriers, Exchange};
use crate::impact::run::{Run, incident};
use crate::impact::updated::Updated;
use crate::impact::wall::CONTACT_TOLERANCE;
use crate::impact::wall::meridian::Wall;
use crate::impact::wall::surface::{Coulomb, Frictionless, MEMORY};
use crate::material::flow::{FlowStress, FlowVisitor};
use crate::material::stress::{Constitutive, J2, Moduli};
use crate::plan::{Geometry, Plan};
use crate::scheme::{Reference, Transfer};
use crate::space::{Axisymmetric, Solid, Space};
use crate::tape::{Checkpoint, Keeper};

/// What is to be run.
pub(in crate::impact) struct Job<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Impact speed in run units.
    pub speed: f64,
    /// Where the run is kept while it is under way, and what tells it from others.
    pub checkpoint: Option<(&'a Checkpoint, String)>,
}

impl Job<'_> {
    fn keeper(&self) -> Option<Keeper<'_>> {
        let (checkpoint, description) = self.checkpoint.as_ref()?;
        Some(Keeper::new(checkpoint, description))
    }
}

/// A plastic body, once its flow stress is known.
pub(in crate::impact) struct Plastic<'a> {
    /// Moduli.
    pub moduli: Moduli,
    /// What is to be run.
    pub job: &'a Job<'a>,
}

impl FlowVisitor for Plastic<'_> {
    type Output = Vec<Record>;
    fn visit<F: FlowStress>(self, flow: F) -> Vec<Record> {
        let moduli = self.moduli;
        run_geometry(J2 { moduli, flow }, self.job)
    }
}

/// The space, and in three dimensions the friction, that the plan calls for.
pub(in crate::impact) fn run_geometry<M: Constitutive<Axisymmetric> + Constitutive<Solid>>(
    material: M,
    job: &Job,
) -> Vec<Record> {
    let &Job { plan, speed, .. } = job;
    let tolerance = CONTACT_TOLERANCE * speed * plan.angle.cos();
    let mesh = Mesh {
        grid: &plan.grid,
        layout: plan.scheme.layout,
        geometry: plan.geometry,
    };
    if plan.geometry == Geometry::Axisymmetric {
        run_section(material, job)
    } else if plan.friction > 0.0 {
        let friction = Coulomb {
            coefficient: plan.friction,
            memory: MEMORY * plan.estimate.contact_time,
        };
        let model = solid::build::<_, _, 2, 27>(mesh, material, friction, tolerance);
        Run::new(model, (), plan, speed).finish(job.keeper())
    } else {
        run_solid(mesh, material, job)
    }
}

/// Three dimensions without friction: the spline degree that the plan calls for.
fn run_solid<M: Constitutive<Solid>>(mesh: Mesh, material: M, job: &Job) -> Vec<Record> {
    let tolerance = CONTACT_TOLERANCE * job.speed * job.plan.angle.cos();
    match mesh.grid.degree {
        1 => run_transfer(
            solid::build::<_, _, 1, 8>(mesh, material, Frictionless, tolerance),
            job,
        ),
        2 => run_transfer(
            solid::build::<_, _, 2, 27>(mesh, material, Frictionless, tolerance),
            job,
        ),
        _ => run_transfer(
            solid::build::<_, _, 3, 64>(mesh, material, Frictionless, tolerance),
            job,
        ),
    }
}

/// The section: the spline degree that the plan calls for.
fn run_section<M: Constitutive<Axisymmetric>>(material: M, job: &Job) -> Vec<Record> {
    let &Job { plan, speed, .. } = job;
    let (grid, layout) = (&plan.laid(), plan.scheme.layout);
    if plan.scheme.reference == Reference::Present {
        return match grid.degree {
            1 => vec![Updated::<M, 1, 4>::new(plan, material, speed).finish()],
            2 => vec![Updated::<M, 2, 9>::new(plan, material, speed).finish()],
            _ => vec![Updated::<M, 3, 16>::new(plan, material, speed).finish()],
        };
    }
    let tolerance = CONTACT_TOLERANCE * speed;
    match grid.degree {
        1 => run_transfer(
            model::build::<M, 1, 4>(grid, layout, material, tolerance),
            job,
        ),
        2 => run_transfer(
            model::build::<M, 2, 9>(grid, layout, material, tolerance),
            job,
        ),
        _ => run_transfer(
            model::build::<M, 3, 16>(grid, layout, material, tolerance),
            job,
        ),
    }
}

/// The transfer of velocity that the plan calls for.
fn run_transfer<S, M, W, const N: usize>(model: Model<S, M, W, N>, job: &Job) -> Vec<Record>
where
    S: Space,
    M: Constitutive<S>,
    W: Wall<S>,
{
    let &Job { plan, speed, .. } = job;
    let points = model.points.unpacked();
    let carriers = || {
        let start = incident::<S>(plan, speed);
        Carriers::new(points, model.points.offsets(), model.mass.len(), start)
    };
    let transfer = match plan.scheme.transfer {
        Transfer::Persistent => Exchange::Persistent,
        Transfer::Blend(flip) => Exchange::Blend(Box::new(Blend {
            carriers: carriers(),
            flip,
        })),
        Transfer::Apic => Exchange::Apic(Box::new(Apic::new(carriers(), points, &model.places))),
    };
    Run::new(model, transfer, plan, speed).finish(job.keeper())
}
