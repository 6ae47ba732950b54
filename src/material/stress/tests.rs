//! Tests of the stress update: elastic limit, return to the yield surface, energies, and what a flow stress is told.

use super::*;
use crate::material::flow::{FlowStress, PerfectlyPlastic, YIELD_STRENGTH, flow_stress};
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

type State<F> = J2State<<Axisymmetric as Space>::Symmetric, <F as FlowStress>::Memory>;

fn update<F: FlowStress>(
    m: &J2<F>,
    f: &AxialGradient,
    state: &mut State<F>,
) -> Response<<Axisymmetric as Space>::Symmetric> {
    update_in(DT, m, f, state)
}

/// [`update`] in a step of length `dt`.
fn update_in<F: FlowStress>(
    dt: f64,
    m: &J2<F>,
    f: &AxialGradient,
    state: &mut State<F>,
) -> Response<<Axisymmetric as Space>::Symmetric> {
    let j = Axisymmetric::determinant(f);
    let kinematics = Kinematics {
        gradient: *f,
        recip_j: j.recip(),
        recip_cbrt_j: j.recip_cbrt(),
    };
    Constitutive::<Axisymmetric>::update(m, &kinematics, dt, state)
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

const DT: f64 = 1e-3;
/// Viscosity of [`Viscous`].
const VISCOSITY: f64 = 1e-3;

flow_stress! {
    /// Y + eta times the strain rate, remembering its plastic work: the least that knows rate and heat.
    Viscous, "viscous" {
        strength: YIELD_STRENGTH,
    }
}

impl FlowStress for Viscous {
    type Memory = Lanes;

    fn stress(&self, _: Lanes, increment: Lanes, dt: f64, _: &Lanes) -> Lanes {
        let rate = if dt > 0.0 {
            increment * dt.recip()
        } else {
            Lanes::default()
        };
        Lanes::splat(self.strength) + rate * VISCOSITY
    }

    fn slope(&self, _: Lanes, _: Lanes, dt: f64, _: &Lanes) -> Lanes {
        Lanes::splat(VISCOSITY / dt)
    }

    fn remember(&self, _: Lanes, _: f64, work: Lanes, memory: &mut Lanes) {
        *memory += work;
    }
}

fn viscous() -> J2<Viscous> {
    J2 {
        moduli: Moduli::new(1.0, 0.3),
        flow: Viscous { strength: 1e-4 },
    }
}

#[test]
fn a_flow_stress_knows_rate_and_work_and_the_work_is_that_of_the_stress_that_flows() {
    let m = viscous();
    let mut state = Constitutive::<Axisymmetric>::virgin(&m);
    let mut booked = 0.0;
    // a tenth of a unit of strain in a unit of time: twice the strength at rest
    let steady = 1e-4 + 0.1 * VISCOSITY;
    for k in 1..=4000 {
        let b = (-0.1 * DT * f64::from(k)).exp();
        let r = update(&m, &stretch(b.powf(-0.5), b), &mut state);
        booked += r.dissipation.array()[0];
        let mises = (1.5 * r.deviator.squared_norm().array()[0]).sqrt();
        assert!(k < 100 || (mises / steady - 1.0).abs() < 1e-3, "{mises}");
    }
    let work = steady * state.strain.array()[0];
    assert!((booked / work - 1.0).abs() < 2e-3, "{booked} {work}");
    assert_eq!(state.memory.array()[0], booked);
}

#[test]
fn nothing_that_knows_rates_flows_in_no_time() {
    let m = viscous();
    let mut state = Constitutive::<Axisymmetric>::virgin(&m);
    let b = 0.99f64;
    let f = stretch(b.powf(-0.5), b);
    let r = update_in(0.0, &m, &f, &mut state);
    assert_eq!(state.strain.array(), [0.0; 4]);
    // the elastic energy is worked out anew, to rounding of numbers about one
    assert!(r.dissipation.array()[0].abs() < 2.0 * f64::EPSILON);
    let mises = (1.5 * r.deviator.squared_norm().array()[0]).sqrt();
    assert!(mises > 50.0 * m.flow.strength, "{mises}");
}
