//! Stress update: isochoric neo-Hookean elasticity and finite-strain J2 plasticity with an exactly isochoric return.
//!
//! Elastic energy per reference volume, with $\bar b_e = J^{-2/3} b_e$:
//!
//! $$ W = \tfrac{\mu}{2} (\mathrm{tr}\ \bar b_e - 3) + U(J), \qquad
//!    U = \tfrac{\kappa}{2} \left( \tfrac12 (J^2 - 1) - \ln J \right) $$
//!
//! Source: Simo and Hughes 1998, section 9.2 and box 9.1; unlike theirs, the returned $\bar b_e$ has determinant one
//! exactly (cubic equation for its trace), so plastic flow never changes volume. The state is the inverse plastic
//! metric $C_p^{-1}$, from which $b_e = F C_p^{-1} F^T$ follows without storing F.

use crate::lanes::Lanes;
use crate::material::flow::{CowperSymonds, FlowStress, IsothermalJohnsonCook, JohnsonCook, ROOT};
use crate::space::{Space, Symmetric};
use crate::tape::{Keep, keep_fields};

/// Elastic moduli.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    /// Shear modulus mu.
    pub shear: f64,
    /// Bulk modulus kappa.
    pub bulk: f64,
}

impl Moduli {
    /// From Young's modulus and Poisson's ratio.
    #[must_use]
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Self {
        Moduli {
            shear: young_modulus / (2.0 * (1.0 + poisson_ratio)),
            bulk: young_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)),
        }
    }

    /// Dilatational wave speed for density `rho`, $\sqrt{(\kappa + 4\mu/3)/\rho}$.
    #[must_use]
    pub fn dilatational_speed(&self, density: f64) -> f64 {
        ((self.bulk + 4.0 / 3.0 * self.shear) / density).sqrt()
    }

    /// Pressure-like derivative $U'(J) = \tfrac{\kappa}{2}(J - 1/J)$ (positive in tension).
    #[inline(always)]
    #[must_use]
    pub fn volumetric_stress(&self, j: f64) -> f64 {
        0.5 * self.bulk * (j - 1.0 / j)
    }

    /// Volumetric energy $U(J)$ per reference volume.
    #[must_use]
    pub fn volumetric_energy(&self, j: f64) -> f64 {
        0.5 * self.bulk * (0.5 * (j * j - 1.0) - j.ln())
    }
}

/// What a point answers to a deformation.
#[derive(Debug, Clone, Copy)]
pub struct Response<T> {
    /// Deviatoric Kirchhoff stress.
    pub deviator: T,
    /// Mean of the isochoric elastic left Cauchy-Green tensor, $\mathrm{tr}\ \bar b_e / 3$.
    pub mean: Lanes,
    /// Plastic work of the step per reference volume.
    pub dissipation: Lanes,
}

/// Deformation of four points.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<S: Space> {
    /// Kinematics gradient F.
    pub gradient: S::Gradient,
    /// $1/J$, J = det F.
    pub recip_j: Lanes,
    /// $J^{-1/3}$.
    pub recip_cbrt_j: Lanes,
}

/// Constitutive model: state of a point and its isochoric response.
pub trait Constitutive<S: Space>: Copy + Send + Sync + 'static {
    /// State of four points side by side.
    type State: Copy + Keep + Send + Sync;
    /// State of an undeformed point.
    fn virgin(&self) -> Self::State;
    /// Elastic moduli.
    fn moduli(&self) -> Moduli;
    /// Response to a deformation after a step, updating the state.
    #[inline(always)]
    fn update(
        &self,
        kinematics: &Kinematics<S>,
        dt: f64,
        state: &mut Self::State,
    ) -> Response<S::Symmetric> {
        let trial = self.trial(kinematics, state);
        self.settle(kinematics, dt, state, &trial)
    }
    /// What becomes of a trial response in a step of length `dt`: the state moves on where it was inelastic.
    fn settle(
        &self,
        kinematics: &Kinematics<S>,
        dt: f64,
        state: &mut Self::State,
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric>;
    /// Elastic trial response with the state frozen: what stiffness estimates use.
    fn trial(&self, kinematics: &Kinematics<S>, state: &Self::State) -> Response<S::Symmetric>;
    /// Accumulated equivalent plastic strain.
    fn plastic_strain(state: &Self::State) -> Lanes;
    /// Temperature, K; none of matter that knows none.
    fn temperature(&self, _: &Self::State) -> Option<Lanes> {
        None
    }
    /// Share of the plastic work that becomes heat.
    fn heat_share(&self) -> f64 {
        0.0
    }
}

/// Elastic body: no state, no memory, no plastic branch.
#[derive(Debug, Clone, Copy)]
pub struct Elastic {
    /// Moduli.
    pub moduli: Moduli,
}

impl<S: Space> Constitutive<S> for Elastic {
    type State = ();
    fn virgin(&self) {}
    fn moduli(&self) -> Moduli {
        self.moduli
    }
    #[inline(always)]
    fn settle(
        &self,
        _: &Kinematics<S>,
        _: f64,
        (): &mut (),
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric> {
        *trial
    }
    #[inline(always)]
    fn trial(&self, kinematics: &Kinematics<S>, _: &()) -> Response<S::Symmetric> {
        let b = S::push_forward(&kinematics.gradient, &S::Symmetric::identity());
        elastic_response(self.moduli.shear, &b, kinematics.recip_cbrt_j)
    }
    fn plastic_strain(_: &()) -> Lanes {
        Lanes::default()
    }
}

/// Isochoric neo-Hookean response to an elastic left Cauchy-Green tensor.
#[inline(always)]
fn elastic_response<T: Symmetric>(shear: f64, b: &T, recip_cbrt_j: Lanes) -> Response<T> {
    let isochoric = b.scaled(recip_cbrt_j * recip_cbrt_j);
    let mean = isochoric.trace() * (1.0 / 3.0);
    Response {
        deviator: isochoric.shifted(-mean).scaled(Lanes::splat(shear)),
        mean,
        dissipation: Lanes::default(),
    }
}

/// Elastic-plastic body with J2 yield and flow stress `F`.
#[derive(Debug, Clone, Copy)]
pub struct J2<F> {
    /// Moduli.
    pub moduli: Moduli,
    /// Flow stress.
    pub flow: F,
}

/// State of a J2 point.
#[derive(Debug, Clone, Copy)]
pub struct J2State<T, M> {
    /// Inverse plastic metric $C_p^{-1}$, determinant one.
    pub metric: T,
    /// Accumulated equivalent plastic strain.
    pub strain: Lanes,
    /// What the flow stress remembers.
    pub memory: M,
}

keep_fields!(impl [T: Keep, M: Keep] J2State<T, M>: metric, strain, memory);

// a flow stress that remembers nothing costs no memory
const _: () = assert!(size_of::<J2State<[Lanes; 4], ()>>() == size_of::<[Lanes; 5]>());
// rates take none, a temperature takes one number
const _: () = assert!(size_of::<<IsothermalJohnsonCook as FlowStress>::Memory>() == 0);
const _: () = assert!(size_of::<<CowperSymonds as FlowStress>::Memory>() == 0);
const _: () = assert!(size_of::<<JohnsonCook as FlowStress>::Memory>() == size_of::<Lanes>());

impl<S: Space, F: FlowStress> Constitutive<S> for J2<F> {
    type State = J2State<S::Symmetric, F::Memory>;
    fn virgin(&self) -> Self::State {
        J2State {
            metric: S::Symmetric::identity(),
            strain: Lanes::default(),
            memory: F::Memory::default(),
        }
    }
    fn moduli(&self) -> Moduli {
        self.moduli
    }
    #[inline(always)]
    fn settle(
        &self,
        kinematics: &Kinematics<S>,
        dt: f64,
        state: &mut Self::State,
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric> {
        let still = Lanes::default();
        let radius = self.flow.stress(state.strain, still, dt, &state.memory) * ROOT;
        let norm_squared = trial.deviator.squared_norm();
        if !(norm_squared - radius * radius).any_positive() {
            self.flow.remember(still, dt, still, &mut state.memory);
            return *trial;
        }
        let norm = norm_squared.sqrt();
        self.return_to_yield(kinematics, dt, state, trial, norm, norm - radius)
    }
    #[inline(always)]
    fn trial(&self, kinematics: &Kinematics<S>, state: &Self::State) -> Response<S::Symmetric> {
        let b = S::push_forward(&kinematics.gradient, &state.metric);
        elastic_response(self.moduli.shear, &b, kinematics.recip_cbrt_j)
    }
    fn plastic_strain(state: &Self::State) -> Lanes {
        state.strain
    }
    fn temperature(&self, state: &Self::State) -> Option<Lanes> {
        self.flow.temperature(&state.memory)
    }
    fn heat_share(&self) -> f64 {
        self.flow.heat_share()
    }
}

impl<F: FlowStress> J2<F> {
    /// Radial return of the deviator where `plastic` is positive, the isochoric metric that belongs to it, and the plastic
    /// work.
    ///
    /// The work is the drop of elastic energy at frozen deformation, times $2 \bar\sigma / (\sigma_{trial} +
    /// \sigma_{new})$: exact for proportional flow, where the drop alone overshoots by half a trial step. The mean stress of
    /// the flow $\bar\sigma$ is that from the strain at its beginning to that at its end, at the rate of this return.
    ///
    /// The strain that is accumulated is the one that this stress does the work on, $\Delta\varepsilon_p = \Delta w /
    /// \bar\sigma$, as codes with logarithmic strains have it. The length of the return times $\sqrt{2/3}$ differs from it by
    /// the elastic strain, to first order $- |s|\ \mathrm{tr}\ n^3 / (\mu\ \mathrm{tr}\ \bar b_e / 3)$: 0.93 Y/E in uniaxial
    /// compression with $\nu = 0.35$.
    #[inline(always)]
    fn return_to_yield<S: Space>(
        &self,
        kinematics: &Kinematics<S>,
        dt: f64,
        state: &mut J2State<S::Symmetric, F::Memory>,
        trial: &Response<S::Symmetric>,
        norm: Lanes,
        plastic: Lanes,
    ) -> Response<S::Symmetric> {
        let mu = self.moduli.shear;
        let stiffness = trial.mean * (2.0 * mu);
        let length = self
            .flow
            .length_of_return(norm, stiffness, state.strain, dt, &state.memory);
        let length = length.where_positive(plastic, Lanes::default());
        let increment = length * ROOT;
        let first = self.flow.stress(state.strain, increment, dt, &state.memory) * ROOT;
        // guards 0/0 in lanes that are stress-free (and elastic)
        let safe_norm = norm.map(|x| if x > 0.0 { x } else { 1.0 });
        let keep = Lanes::splat(1.0) - stiffness * length * safe_norm.recip();
        let deviator = trial.deviator.scaled(keep);
        let shape = deviator.scaled(Lanes::splat(1.0 / mu));
        let mean = isochoric_mean(&shape, trial.mean);
        let mean = mean.where_positive(plastic, trial.mean);
        let Kinematics {
            gradient,
            recip_j,
            recip_cbrt_j,
        } = kinematics;
        let recip_isochoric = (*recip_cbrt_j * *recip_cbrt_j).recip();
        let b = shape.shifted(mean).scaled(recip_isochoric);
        state.metric = S::pull_back(gradient, *recip_j, &b).where_positive(plastic, &state.metric);
        let new_norm = norm * keep;
        let recip = (safe_norm + new_norm).recip();
        let mid = (first + new_norm) * recip;
        let drop = (trial.mean - mean) * (1.5 * mu);
        let work = (drop * mid).where_positive(plastic, Lanes::default());
        // a point turned inside out has no meaningful dissipation
        let work = work.where_positive(*recip_j, Lanes::default());
        let gain = (drop * recip * (2.0 * ROOT)).where_positive(plastic, Lanes::default());
        // within rounding the drop may come out negative
        state.strain += gain.where_positive(gain, Lanes::default());
        self.flow.remember(increment, dt, work, &mut state.memory);
        Response {
            deviator,
            mean,
            dissipation: work,
        }
    }
}

/// The mean x that makes $\det(d + x 1) = 1$ for a deviator d: Newton on $x^3 - \tfrac12 (d:d) x + \det d = 1$.
#[inline(always)]
fn isochoric_mean<T: Symmetric>(deviator: &T, guess: Lanes) -> Lanes {
    let half = deviator.squared_norm() * 0.5;
    let constant = deviator.determinant() - Lanes::splat(1.0);
    let mut x = guess;
    for _ in 0..3 {
        let value = (x * x - half) * x + constant;
        let slope = x * x * 3.0 - half;
        x = x - value * slope.recip();
    }
    x
}

#[cfg(test)]
mod tests;
