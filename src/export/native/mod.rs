//! Target `native`: the models that codes ship, fitted to a law, as ready input lines with what is lost.
//!
//! A projection is fitted to restitution, largest force and contact time over the law's speeds (inertia included) and
//! reported with its error at each. Springs of codes are constants in N/m, so their lines hold for one radius.

pub mod eepa;
mod fit;
mod lines;
mod summary;
pub mod thornton_ning;

pub use fit::{Target, target};
pub use lines::{Code, Lines, input, of as lines_of};
pub use summary::files;

use crate::contact::rebound::{Rebound, rebound};
use crate::export::source::artifact::Artifact;
use crate::export::source::dialect::{Dialect, PairExport};
use crate::export::source::portable::Portable;
use crate::law::Form;
use crate::theory::luding::Luding;
use crate::theory::mdr::Mdr;
use crate::theory::walton_braun::WaltonBraun;
use crate::{Error, Result};
use eepa::Eepa;
use thornton_ning::ThorntonNing;

/// Flattening of the limit branch of Luding's model over the deepest impact: beyond the range, or it would stiffen within.
const LIMIT_DEPTH: f64 = 1.1;

/// Models that codes ship, fitted to the law.
#[derive(Debug, Clone, Copy)]
pub struct Native;

impl Dialect for Native {
    const NAME: &'static str = "native";
    const PAIR: Option<PairExport> = None;
    const OF_PAIRS: bool = false;

    fn export(law: &Portable) -> Result<Vec<Artifact>> {
        files(law)
    }
}

/// A model of a code with its numbers; stiffnesses are over R (Pa), for one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// Linear springs, unloading stiffness growing with the largest overlap.
    Luding {
        /// $k_1/R$, Pa.
        loading: f64,
        /// $\hat k_2/R$, Pa.
        limit: f64,
        /// $\phi_f$ of two equal spheres.
        depth: f64,
    },
    /// Linear springs of constant ratio.
    WaltonBraun {
        /// $k_1/R$, Pa.
        loading: f64,
        /// $k_2/R$, Pa.
        unloading: f64,
    },
    /// Edinburgh elasto-plastic model.
    Eepa(Eepa),
    /// Thornton and Ning.
    ThorntonNing(ThorntonNing),
    /// Zunker and Kamrin.
    Mdr {
        /// E, Pa.
        young_modulus: f64,
        /// $\nu$.
        poisson_ratio: f64,
        /// Y, Pa.
        yield_strength: f64,
    },
}

/// A model fitted to a law.
#[derive(Debug, Clone, PartialEq)]
pub struct Projection {
    /// The model.
    pub model: Model,
    /// Relative errors of e, F* and contact time, one row a speed of the target.
    pub errors: Vec<[f64; 3]>,
}

impl Model {
    /// Name in text.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Model::Luding { .. } => "Luding (linear, unloading stiffness grows with the overlap)",
            Model::WaltonBraun { .. } => "Walton-Braun (linear, constant ratio of stiffnesses)",
            Model::Eepa(_) => "EEPA (power law, constant ratio of stiffnesses)",
            Model::ThorntonNing(_) => "Thornton-Ning (Hertz to a yield radius, then linear)",
            Model::Mdr { .. } => "MDR (Zunker-Kamrin)",
        }
    }

    /// Bound of what a run in the model's code may miss of the prediction in e and F*, relative, at the flattening `x` over
    /// the radius. In LAMMPS the particles of MDR grow as they flatten and not in the prediction: the cap $\pi R \delta^2$
    /// spread over the sphere raises the overlap by $\delta^2/(4R)$.
    #[must_use]
    pub fn left_out(&self, x: f64) -> f64 {
        match self {
            Model::Mdr { .. } => 0.25 * x,
            _ => 0.0,
        }
    }

    /// Impact of a body of `radius` (m) and `mass` (kg) on a wall.
    #[must_use]
    pub fn rebound(&self, radius: f64, mass: f64, velocity: f64) -> Rebound {
        match *self {
            Model::Luding {
                loading,
                limit,
                depth,
            } => rebound(
                &Luding::with_depth(loading, limit, depth),
                radius,
                mass,
                velocity,
            ),
            Model::WaltonBraun { loading, unloading } => {
                let law = WaltonBraun::new(loading, unloading, 0.0);
                rebound(&law, radius, mass, velocity)
            }
            Model::Eepa(law) => rebound(&law, radius, mass, velocity),
            Model::ThorntonNing(law) => rebound(&law, radius, mass, velocity),
            Model::Mdr {
                young_modulus,
                poisson_ratio,
                yield_strength,
            } => {
                let law = Mdr::new(young_modulus, poisson_ratio, yield_strength);
                rebound(&law, radius, mass, velocity)
            }
        }
    }
}

impl Projection {
    /// The largest error of e, F* and contact time over the speeds.
    #[must_use]
    pub fn largest(&self) -> [f64; 3] {
        self.errors.iter().fold([0.0, 0.0, 0.0], |largest, row| {
            std::array::from_fn(|i| largest[i].max(row[i].abs()))
        })
    }
}

/// Every model fitted to `law`.
///
/// # Errors
/// [`Error::Refused`] for an elastic law, [`Error::Fit`] when a fit stops without a result.
pub fn project(law: &Portable, target: &Target) -> Result<Vec<Projection>> {
    let material = law.material();
    let Some(flow) = material.flow.filter(|_| law.form != Form::Hertz) else {
        return Err(Error::Refused {
            what: "--to native".to_owned(),
            found: format!("the elastic law `{}`", law.name),
            allowed: "needs a law that yields; use the Hertz model of your code".to_owned(),
        });
    };
    let (young, nu) = (material.young_modulus, material.poisson_ratio);
    let hit = target.middle();
    let stiffness = hit.max_force / (hit.max_displacement * target.radius);
    let ratio = 1.0 / hit.restitution.powi(2);
    let limit = LIMIT_DEPTH * target.deepest();
    let growth = (ratio - 1.0) * target.radius / hit.max_displacement;
    let numbers = fit::project(target, &[stiffness, growth], |n| luding_of(n, limit).1)?;
    let luding = luding_of(&numbers, limit).0;
    let springs = fit::project(target, &[stiffness, ratio], |n| {
        WaltonBraun::new(n[0], n[0] * (1.0 + n[1]), 0.0)
    })?;
    let eepa = |n: &[f64]| Eepa {
        loading: n[0],
        ratio: 1.0 + n[1],
        exponent: 1.0 + n[2],
    };
    let curved = fit::project(target, &[stiffness, ratio, 0.1], eepa)?;
    let ning = |n: &[f64]| ThorntonNing {
        modulus: n[0],
        yield_ratio: n[1],
    };
    let limited = fit::project(target, &[material.contact_modulus(), 0.05], ning)?;
    let dimension = fit::project(target, &[young, flow.yield_strength()], |n| {
        Mdr::new(n[0], nu, n[1])
    })?;
    let models = [
        luding,
        Model::WaltonBraun {
            loading: springs[0],
            unloading: springs[0] * (1.0 + springs[1]),
        },
        Model::Eepa(eepa(&curved)),
        Model::ThorntonNing(ning(&limited)),
        Model::Mdr {
            young_modulus: dimension[0],
            poisson_ratio: nu,
            yield_strength: dimension[1],
        },
    ];
    Ok(models.map(|model| judged(model, target)).to_vec())
}

/// Luding's model from $\kappa_1$ and the growth of $k_2/k_1$ with the flattening, its limit branch at flattening `limit`.
fn luding_of(numbers: &[f64], limit: f64) -> (Model, Luding) {
    let loading = numbers[0];
    let stiffest = loading * (1.0 + numbers[1] * limit);
    // limit flattening = limit/(limit - loading) times half the depth
    let depth = 2.0 * limit * (1.0 - loading / stiffest);
    let model = Model::Luding {
        loading,
        limit: stiffest,
        depth,
    };
    (model, Luding::with_depth(loading, stiffest, depth))
}

/// The model with its errors.
fn judged(model: Model, target: &Target) -> Projection {
    let figures: Vec<Rebound> = target
        .impacts
        .iter()
        .map(|(v, _)| model.rebound(target.radius, target.mass, *v))
        .collect();
    Projection {
        model,
        errors: target.errors(&figures),
    }
}
