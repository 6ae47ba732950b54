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
use crate::material::flow::FlowStress;
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

/// Constitutive model: state of a point and its isochoric response.
pub trait Constitutive<S: Space>: Copy + Send + Sync + 'static {
    /// State of four points side by side.
    type State: Copy + Keep + Send + Sync;
    /// State of an undeformed point.
    fn virgin(&self) -> Self::State;
    /// Elastic moduli.
    fn moduli(&self) -> Moduli;
    /// Response at deformation gradient `f`, $J^{-1/3}$ = `recip_cbrt_j`, updating the state.
    #[inline(always)]
    fn update(
        &self,
        f: &S::Gradient,
        recip_j: Lanes,
        recip_cbrt_j: Lanes,
        state: &mut Self::State,
    ) -> Response<S::Symmetric> {
        let trial = self.trial(f, recip_cbrt_j, state);
        self.settle(f, recip_j, recip_cbrt_j, state, &trial)
    }
    /// What becomes of a trial response: the state moves on where it was inelastic.
    fn settle(
        &self,
        f: &S::Gradient,
        recip_j: Lanes,
        recip_cbrt_j: Lanes,
        state: &mut Self::State,
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric>;
    /// Elastic trial response with the state frozen: what stiffness estimates use.
    fn trial(
        &self,
        f: &S::Gradient,
        recip_cbrt_j: Lanes,
        state: &Self::State,
    ) -> Response<S::Symmetric>;
    /// Accumulated equivalent plastic strain.
    fn plastic_strain(state: &Self::State) -> Lanes;
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
        _: &S::Gradient,
        _: Lanes,
        _: Lanes,
        (): &mut (),
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric> {
        *trial
    }
    #[inline(always)]
    fn trial(&self, f: &S::Gradient, recip_cbrt_j: Lanes, _: &()) -> Response<S::Symmetric> {
        let b = S::push_forward(f, &S::Symmetric::identity());
        elastic_response(self.moduli.shear, &b, recip_cbrt_j)
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
pub struct J2State<T> {
    /// Inverse plastic metric $C_p^{-1}$, determinant one.
    pub metric: T,
    /// Accumulated equivalent plastic strain.
    pub strain: Lanes,
}

keep_fields!(impl [T: Keep] J2State<T>: metric, strain);

/// $\sqrt{2/3}$.
const ROOT: f64 = 0.816_496_580_927_726;

impl<S: Space, F: FlowStress> Constitutive<S> for J2<F> {
    type State = J2State<S::Symmetric>;
    fn virgin(&self) -> Self::State {
        J2State {
            metric: S::Symmetric::identity(),
            strain: Lanes::default(),
        }
    }
    fn moduli(&self) -> Moduli {
        self.moduli
    }
    #[inline(always)]
    fn settle(
        &self,
        f: &S::Gradient,
        recip_j: Lanes,
        recip_cbrt_j: Lanes,
        state: &mut Self::State,
        trial: &Response<S::Symmetric>,
    ) -> Response<S::Symmetric> {
        let radius = self.flow.stress(state.strain) * ROOT;
        let norm_squared = trial.deviator.squared_norm();
        if !(norm_squared - radius * radius).any_positive() {
            return *trial;
        }
        self.return_to_yield::<S>(f, recip_j, recip_cbrt_j, state, trial, norm_squared.sqrt())
    }
    #[inline(always)]
    fn trial(
        &self,
        f: &S::Gradient,
        recip_cbrt_j: Lanes,
        state: &Self::State,
    ) -> Response<S::Symmetric> {
        let b = S::push_forward(f, &state.metric);
        elastic_response(self.moduli.shear, &b, recip_cbrt_j)
    }
    fn plastic_strain(state: &Self::State) -> Lanes {
        state.strain
    }
}

impl<F: FlowStress> J2<F> {
    /// Radial return of the deviator, the isochoric metric that belongs to it, and the plastic work.
    ///
    /// The work is the drop of elastic energy at frozen deformation, times $2 \bar\sigma / (\sigma_{trial} +
    /// \sigma_{new})$: exact for proportional flow, where the drop alone overshoots by half a trial step.
    #[inline(always)]
    fn return_to_yield<S: Space>(
        &self,
        f: &S::Gradient,
        recip_j: Lanes,
        recip_cbrt_j: Lanes,
        state: &mut J2State<S::Symmetric>,
        trial: &Response<S::Symmetric>,
        norm: Lanes,
    ) -> Response<S::Symmetric> {
        let mu = self.moduli.shear;
        let old_radius = self.flow.stress(state.strain) * ROOT;
        let plastic = norm - old_radius;
        let stiffness = trial.mean * (2.0 * mu);
        let mut step = Lanes::default();
        for _ in 0..F::NEWTON_STEPS {
            let strain = state.strain + step * ROOT;
            let misfit = norm - stiffness * step - self.flow.stress(strain) * ROOT;
            let slope = stiffness + self.flow.slope(strain) * (2.0 / 3.0);
            step += misfit * slope.recip();
        }
        let step = step.where_positive(plastic, Lanes::default());
        // guards 0/0 in lanes that are stress-free (and elastic)
        let safe_norm = norm.map(|x| if x > 0.0 { x } else { 1.0 });
        let keep = Lanes::splat(1.0) - stiffness * step * safe_norm.recip();
        let deviator = trial.deviator.scaled(keep);
        let shape = deviator.scaled(Lanes::splat(1.0 / mu));
        let mean = isochoric_mean(&shape, trial.mean);
        let mean = mean.where_positive(plastic, trial.mean);
        let recip_isochoric = (recip_cbrt_j * recip_cbrt_j).recip();
        let b = shape.shifted(mean).scaled(recip_isochoric);
        state.metric = S::pull_back(f, recip_j, &b).where_positive(plastic, &state.metric);
        state.strain += step * ROOT;
        let new_norm = norm * keep;
        let mid = (old_radius + new_norm) * (safe_norm + new_norm).recip();
        let drop = (trial.mean - mean) * (1.5 * mu) * mid;
        Response {
            deviator,
            mean,
            dissipation: drop.where_positive(plastic, Lanes::default()),
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
mod tests {
    use super::*;
    use crate::material::flow::PerfectlyPlastic;
    use crate::space::{AxialGradient, Axisymmetric};

    /// F = diag(a, a, b) of four equal points.
    fn stretch(a: f64, b: f64) -> AxialGradient {
        let w = |x: f64| Lanes::splat(x);
        let mut f = Axisymmetric::identity();
        Axisymmetric::add_node(&mut f, &[a - 1.0, 0.0], &[w(1.0), w(0.0), w(1.0)]);
        Axisymmetric::add_node(&mut f, &[0.0, b - 1.0], &[w(0.0), w(1.0), w(0.0)]);
        f
    }

    fn j2(strength: f64) -> J2<PerfectlyPlastic> {
        J2 {
            moduli: Moduli::new(1.0, 0.3),
            flow: PerfectlyPlastic { strength },
        }
    }

    type State = J2State<<Axisymmetric as Space>::Symmetric>;

    fn update(
        m: &J2<PerfectlyPlastic>,
        f: &AxialGradient,
        state: &mut State,
    ) -> Response<<Axisymmetric as Space>::Symmetric> {
        let j = Axisymmetric::determinant(f);
        Constitutive::<Axisymmetric>::update(m, f, j.recip(), j.recip_cbrt(), state)
    }

    #[test]
    fn small_strain_response_is_hooke_s_law() {
        let m = j2(1e9);
        let strain = 1e-6;
        let mut state = Constitutive::<Axisymmetric>::virgin(&m);
        let r = update(&m, &stretch(1.0, 1.0 + strain), &mut state);
        // uniaxial strain: deviator norm is 2 mu eps sqrt(2/3)
        let expected = 2.0 * m.moduli.shear * strain * (2.0f64 / 3.0).sqrt();
        assert!((r.deviator.squared_norm().array()[0].sqrt() / expected - 1.0).abs() < 1e-5);
        let pressure = m.moduli.volumetric_stress(1.0 + strain);
        assert!((pressure / (m.moduli.bulk * strain) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn returned_stress_lies_on_the_yield_surface_and_plastic_flow_keeps_volume() {
        let m = j2(0.01);
        let mut state = Constitutive::<Axisymmetric>::virgin(&m);
        for k in 1..=60 {
            let b = 1.0 - 0.01 * f64::from(k);
            let f = stretch(b.powf(-0.5) * 1.001, b);
            let r = update(&m, &f, &mut state);
            let mises = (1.5 * r.deviator.squared_norm().array()[0]).sqrt();
            assert!(mises < 0.01 * (1.0 + 1e-12));
            assert!((state.metric.determinant().array()[0] - 1.0).abs() < 1e-12);
            if k > 3 {
                assert!((mises / 0.01 - 1.0).abs() < 1e-12, "{mises}");
            }
        }
        assert!(state.strain.array()[0] > 0.7);
    }

    #[test]
    fn plastic_work_is_flow_stress_times_plastic_strain_in_the_limit_of_small_elastic_strain() {
        let m = j2(1e-4);
        let mut state = Constitutive::<Axisymmetric>::virgin(&m);
        let mut work = 0.0;
        for k in 1..=4000 {
            let b = 1.0 - 5e-5 * f64::from(k);
            work += update(&m, &stretch(b.powf(-0.5), b), &mut state)
                .dissipation
                .array()[0];
        }
        assert!((work / (1e-4 * state.strain.array()[0]) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn energy_balances_along_a_large_plastic_stretch() {
        // work of the deviator along b(t) against stored plus dissipated energy, elastic strains of 5 %
        let m = j2(0.05);
        let mut state = Constitutive::<Axisymmetric>::virgin(&m);
        let (mut work, mut dissipated, mut stored, mut old) = (0.0, 0.0, 0.0, 0.0);
        let steps = 20_000;
        for k in 1..=steps {
            let b = 1.0 - 0.5 * f64::from(k) / f64::from(steps);
            let r = update(&m, &stretch(b.powf(-0.5), b), &mut state);
            // axial minus radial deviatoric stress times the rate of ln b
            let mises = (1.5 * r.deviator.squared_norm().array()[0]).sqrt();
            let before = 1.0 - 0.5 * f64::from(k - 1) / f64::from(steps);
            work += 0.5 * (old + mises) * (before / b).ln();
            old = mises;
            dissipated += r.dissipation.array()[0];
            stored = 1.5 * m.moduli.shear * (r.mean.array()[0] - 1.0);
        }
        assert!(
            ((stored + dissipated) / work - 1.0).abs() < 1e-4,
            "{stored} + {dissipated} against {work}"
        );
    }
}
