//! Choice: flow stress, degree and scheme of a plan become concrete types once, before the loop.

use crate::impact::kernel::{Matter, made_of};
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
        run(J2 { moduli, flow }, self.job)
    }
}

/// The space and the reference that the plan calls for.
pub(in crate::impact) fn run<M>(material: M, job: &Job) -> Vec<Record>
where
    M: Constitutive<Axisymmetric> + Constitutive<Solid>,
{
    let present = job.plan.scheme.reference == Reference::Present;
    match (job.plan.geometry, present) {
        (Geometry::Axisymmetric, true) => {
            vec![run_present(made_of(material), job.plan, job.speed)]
        }
        (Geometry::Axisymmetric, false) => run_section(made_of(material), job),
        _ => run_solid(made_of(material), job),
    }
}

/// The deformed body as reference: the spline degree that the plan calls for.
fn run_present(matter: Box<dyn Matter<Axisymmetric>>, plan: &Plan, speed: f64) -> Record {
    match plan.laid().degree {
        1 => Updated::<1, 4>::new(plan, matter, speed).finish(),
        2 => Updated::<2, 9>::new(plan, matter, speed).finish(),
        _ => Updated::<3, 16>::new(plan, matter, speed).finish(),
    }
}

/// Three dimensions: the spline degree, or the friction, that the plan calls for.
fn run_solid(matter: Box<dyn Matter<Solid>>, job: &Job) -> Vec<Record> {
    let &Job { plan, speed, .. } = job;
    let tolerance = CONTACT_TOLERANCE * speed * plan.angle.cos();
    let mesh = Mesh {
        grid: &plan.grid,
        layout: plan.scheme.layout,
        geometry: plan.geometry,
    };
    if plan.friction > 0.0 {
        let friction = Coulomb {
            coefficient: plan.friction,
            memory: MEMORY * plan.estimate.contact_time,
        };
        let model = solid::build::<_, 2, 27>(mesh, matter, friction, tolerance);
        return Run::new(model, (), plan, speed).finish(job.keeper());
    }
    let smooth = Frictionless;
    match mesh.grid.degree {
        1 => run_transfer(
            solid::build::<_, 1, 8>(mesh, matter, smooth, tolerance),
            job,
        ),
        2 => run_transfer(
            solid::build::<_, 2, 27>(mesh, matter, smooth, tolerance),
            job,
        ),
        _ => run_transfer(
            solid::build::<_, 3, 64>(mesh, matter, smooth, tolerance),
            job,
        ),
    }
}

/// The section: the spline degree that the plan calls for.
fn run_section(matter: Box<dyn Matter<Axisymmetric>>, job: &Job) -> Vec<Record> {
    let &Job { plan, speed, .. } = job;
    let (grid, layout) = (&plan.laid(), plan.scheme.layout);
    let tolerance = CONTACT_TOLERANCE * speed;
    if let Some(law) = plan.adhesion {
        let model = model::build_attracted::<2, 9, _>(grid, layout, matter, tolerance, law);
        return Run::new(model, (), plan, speed).finish(job.keeper());
    }
    match grid.degree {
        1 => run_transfer(model::build::<1, 4>(grid, layout, matter, tolerance), job),
        2 => run_transfer(model::build::<2, 9>(grid, layout, matter, tolerance), job),
        _ => run_transfer(model::build::<3, 16>(grid, layout, matter, tolerance), job),
    }
}

/// The transfer of velocity that the plan calls for.
fn run_transfer<S, W, const N: usize>(model: Model<S, W, N>, job: &Job) -> Vec<Record>
where
    S: Space,
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
        Transfer::Blend(flip) => Exchange::Blend(Box::new(Blend::new(carriers(), points, flip))),
        Transfer::Apic => Exchange::Apic(Box::new(Apic::new(carriers(), points, &model.places))),
    };
    Run::new(model, transfer, plan, speed).finish(job.keeper())
}
