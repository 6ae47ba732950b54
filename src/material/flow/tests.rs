//! Flow stresses that know rate and heat, at one point.

use super::{
    CowperSymonds, FlowStress, IsothermalJohnsonCook, JohnsonCook, LinearHardening, Past,
    PowerHardening, ROOT,
};
use crate::lanes::Lanes;
use crate::material::Flow;
use crate::material::stress::{Constitutive, J2, J2State, Kinematics, Moduli};
use crate::space::{AxialGradient, Axisymmetric, Space, Symmetric};

const STIFFNESS: f64 = 0.7;
/// $\rho = E = 1$: a soft metal in the units of a run.
const COPPER: JohnsonCook = JohnsonCook {
    strength: 7e-4,
    coefficient: 2.4e-3,
    exponent: 0.31,
    sensitivity: 0.025,
    rate: 1e-6,
    softening: 1.0,
    melting: 1356.0,
    room: 298.0,
    heat: 3e-5,
    share: 0.9,
};

fn cold(of: &JohnsonCook, sensitivity: f64) -> IsothermalJohnsonCook {
    IsothermalJohnsonCook {
        strength: of.strength,
        coefficient: of.coefficient,
        exponent: of.exponent,
        sensitivity,
        rate: of.rate,
    }
}

/// What is left of the condition of the return, of the size of the deviator, and what rounding leaves of it at least.
fn misfit<F: FlowStress>(
    flow: &F,
    norm: f64,
    strain: f64,
    dt: f64,
    memory: &F::Memory,
) -> [f64; 2] {
    let (norm, stiffness) = (Lanes::splat(norm), Lanes::splat(STIFFNESS));
    let strain = Lanes::splat(strain);
    let length = flow.length_of_return(norm, stiffness, strain, dt, memory);
    let increment = length * ROOT;
    let end = flow.stress(strain + increment, increment, dt, memory);
    let left = norm - stiffness * length - end * ROOT;
    let [left, norm, length] = [left, norm, stiffness * length].map(Lanes::min);
    [left / norm, 8.0 * f64::EPSILON * (1.0 + length / norm)]
}

#[test]
fn returns_at_any_rate_end_on_the_yield_surface_of_the_end_of_the_step() {
    let beyond = [1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0];
    for dt in [1e-4, 1e-2, 1.0, 1e3] {
        for strain in [0.0, 1e-9, 1e-4, 0.1, 2.0] {
            for sensitivity in [0.0, 1e-3, 0.025, 0.3] {
                for exponent in [0.1, 0.31, 1.0] {
                    let hot = JohnsonCook {
                        sensitivity,
                        exponent,
                        ..COPPER
                    };
                    let flow = cold(&hot, sensitivity);
                    let rest = flow.stress(Lanes::splat(strain), Lanes::default(), dt, &());
                    for beyond in beyond {
                        let norm = ROOT * rest.min() * (1.0 + beyond);
                        // strain is known to its rounding, and its power to that over the exponent
                        let at = |[left, least]: [f64; 2]| {
                            let within = 1e-12 + least / exponent;
                            assert!(
                                left.abs() < within,
                                "{flow:?} {dt} {strain} {beyond}: {left}"
                            );
                        };
                        at(misfit(&flow, norm, strain, dt, &()));
                        at(misfit(&hot, norm, strain, dt, &Lanes::splat(400.0)));
                        at(misfit(&hot, norm, strain, dt, &Lanes::splat(5000.0)));
                    }
                }
            }
            for exponent in [0.5, 1.0, 4.0, 10.0] {
                for rate in [1e-6, 1.0, 1e6] {
                    let flow = CowperSymonds {
                        strength: 1e-3,
                        modulus: 0.01,
                        rate,
                        exponent,
                    };
                    for beyond in beyond {
                        let norm = ROOT * (1e-3 + 0.01 * strain) * (1.0 + beyond);
                        let [left, least] = misfit(&flow, norm, strain, dt, &());
                        assert!(left.abs() < 1e-12 + least, "{flow:?} {dt} {strain}: {left}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_return_does_not_move_what_does_not_yield_or_what_is_no_number() {
    let strain = Lanes::splat(0.1);
    let flow = cold(&COPPER, 0.025);
    let inside = flow.stress(strain, Lanes::default(), 1.0, &()) * (0.999 * ROOT);
    for norm in [inside, Lanes::default(), Lanes::splat(f64::NAN)] {
        let stiffness = Lanes::splat(STIFFNESS);
        assert_eq!(
            flow.length_of_return(norm, stiffness, strain, 1.0, &()),
            Lanes::default()
        );
    }
    // nothing that knows rates flows in no time
    let beyond = inside * 3.0;
    let none = flow.length_of_return(beyond, Lanes::splat(STIFFNESS), strain, 0.0, &());
    assert_eq!(none, Lanes::default());
}

#[test]
fn without_sensitivity_or_below_the_reference_rate_it_is_power_hardening() {
    let power = PowerHardening {
        strength: COPPER.strength,
        coefficient: COPPER.coefficient,
        exponent: COPPER.exponent,
    };
    let insensitive = cold(&COPPER, 0.0);
    let slow = IsothermalJohnsonCook {
        rate: 1e3,
        ..cold(&COPPER, 0.025)
    };
    let stiffness = Lanes::splat(STIFFNESS);
    for strain in [0.0, 1e-6, 0.01, 1.0] {
        let strain = Lanes::splat(strain);
        for norm in [1e-3, 3e-3, 0.02, 0.5] {
            let norm = Lanes::splat(norm);
            let expected = power.length_of_return(norm, stiffness, strain, 0.01, &());
            for flow in [insensitive, slow] {
                let found = flow.length_of_return(norm, stiffness, strain, 0.01, &());
                let change = (found - expected).min().abs();
                assert!(
                    change <= 1e-12 * expected.min() + 1e-15,
                    "{flow:?} {change:e} of {expected:?}"
                );
            }
        }
    }
}

#[test]
fn slopes_are_the_derivatives_of_the_stresses() {
    let memory = Lanes::splat(300.0);
    let cowper = CowperSymonds {
        strength: 1e-3,
        modulus: 0.01,
        rate: 0.3,
        exponent: 4.0,
    };
    let (strain, dt) = (0.2, 0.01);
    for increment in [1e-4, 0.01] {
        let step = 1e-5 * increment;
        fn slope<F: FlowStress>(flow: &F, x: f64, step: f64, dt: f64, m: &F::Memory) -> [f64; 2] {
            let at = |x: f64| {
                let x = Lanes::splat(x);
                flow.stress(Lanes::splat(0.2) + x, x, dt, m).min()
            };
            let given = flow.slope(Lanes::splat(0.2 + x), Lanes::splat(x), dt, m);
            [(at(x + step) - at(x - step)) / (2.0 * step), given.min()]
        }
        for [found, given] in [
            slope(&COPPER, increment, step, dt, &memory),
            slope(&cold(&COPPER, 0.025), increment, step, dt, &()),
            slope(&cowper, increment, step, dt, &()),
        ] {
            assert!(
                (found / given - 1.0).abs() < 1e-5,
                "{found} {given} {strain}"
            );
        }
    }
}

/// F = diag(a, a, b) of four equal points.
fn stretch(b: f64) -> AxialGradient {
    let a = b.powf(-0.5);
    let w = |x: f64| Lanes::splat(x);
    let mut f = Axisymmetric::identity();
    Axisymmetric::add_node(&mut f, &[a - 1.0, 0.0], &[w(1.0), w(0.0), w(1.0)]);
    Axisymmetric::add_node(&mut f, &[0.0, b - 1.0], &[w(0.0), w(1.0), w(0.0)]);
    f
}

/// A point upset at a constant rate to a logarithmic strain in so many steps: stress, state, plastic work.
fn upset<F: FlowStress>(
    flow: F,
    strain: f64,
    rate: f64,
    steps: usize,
) -> (
    f64,
    J2State<<Axisymmetric as Space>::Symmetric, F::Memory>,
    f64,
) {
    let material = J2 {
        moduli: Moduli::new(1.0, 0.3),
        flow,
    };
    let mut state = Constitutive::<Axisymmetric>::virgin(&material);
    let (mut stress, mut work) = (0.0, 0.0);
    let dt = strain / rate / steps as f64;
    for k in 1..=steps {
        let f = stretch((-strain * k as f64 / steps as f64).exp());
        let j = Axisymmetric::determinant(&f);
        let kinematics = Kinematics {
            gradient: f,
            recip_j: j.recip(),
            recip_cbrt_j: j.recip_cbrt(),
        };
        let answer = Constitutive::<Axisymmetric>::update(&material, &kinematics, dt, &mut state);
        stress = (1.5 * answer.deviator.squared_norm().min()).sqrt();
        work += answer.dissipation.min();
    }
    (stress, state, work)
}

/// Closed form for m = 1 at a constant rate, factor L: $d\theta/d\varepsilon = k S(\varepsilon) L (1 - \theta)$ with $k = \beta / (\rho c
/// (T_m - T_0))$, so $1 - \theta = \exp(-k L (Y \varepsilon + B \varepsilon^{n+1}/(n+1)))$.
fn adiabatic(flow: &JohnsonCook, strain: f64, rate: f64) -> (f64, f64) {
    let factor = 1.0 + flow.sensitivity * (rate / flow.rate).ln();
    let n = flow.exponent;
    let work = flow.strength * strain + flow.coefficient * strain.powf(n + 1.0) / (n + 1.0);
    let span = flow.melting - flow.room;
    let left = (-flow.share / (flow.heat * span) * factor * work).exp();
    let rest = flow.strength + flow.coefficient * strain.powf(n);
    (rest * factor * left, flow.room + span * (1.0 - left))
}

#[test]
fn a_point_at_constant_rate_follows_the_adiabatic_closed_form_and_its_error_falls_with_the_step() {
    // heats to half of its melting temperature
    let flow = JohnsonCook {
        heat: 3e-6,
        // elastic strains far below a step
        ..COPPER
    };
    let errors = [500, 1000, 2000].map(|steps| {
        let (stress, state, work) = upset(flow, 1.0, 0.01, steps);
        let (expected, temperature) = adiabatic(&flow, state.strain.min(), 0.01);
        let rise = state.memory.min();
        let heat = flow.heat * rise;
        assert!(
            (heat / (flow.share * work) - 1.0).abs() < 1e-12,
            "{heat} {work}"
        );
        assert!(rise > 300.0, "{rise}");
        [
            stress / expected - 1.0,
            rise / (temperature - flow.room) - 1.0,
        ]
    });
    println!("{errors:?}");
    let [coarse, _, fine] = errors;
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine.abs() < 1e-3, "{fine}");
        let ratio = fine / coarse;
        assert!(
            (0.15..0.35).contains(&ratio),
            "a quarter of the step: {ratio}"
        );
    }
}

#[test]
fn rates_alone_give_the_closed_form_of_the_stress() {
    let flow = cold(&COPPER, 0.025);
    let (stress, state, _) = upset(flow, 0.5, 1e-3, 1000);
    let strain = state.strain.min();
    let expected = (flow.strength + flow.coefficient * strain.powf(flow.exponent))
        * (1.0 + 0.025 * 1e3f64.ln());
    assert!(
        (stress / expected - 1.0).abs() < 2e-4,
        "{stress} {expected}"
    );
    let flow = CowperSymonds {
        strength: 1e-3,
        modulus: 2e-3,
        rate: 1e-3,
        exponent: 4.0,
    };
    // at D the strength is twice that at rest, at 16 D three times
    for (rate, factor) in [(1e-3, 2.0), (16e-3, 3.0)] {
        let (stress, state, _) = upset(flow, 0.5, rate, 1000);
        let expected = (1e-3 + 2e-3 * state.strain.min()) * factor;
        assert!(
            (stress / expected - 1.0).abs() < 2e-3,
            "{stress} {expected}"
        );
    }
}

#[test]
fn limits_of_the_homologous_temperature_and_of_the_rate() {
    let flow = Flow::from(JohnsonCook {
        softening: 0.55,
        ..COPPER
    });
    let rest = flow.at_rest(0.3);
    assert_eq!(rest, Flow::from(cold(&COPPER, 0.0)).at_rest(0.3));
    let after = |work: f64| {
        flow.after(Past {
            strain: 0.3,
            rate: 0.0,
            work,
        })
    };
    let to_melt = flow.heat_to_melt().unwrap() / COPPER.share;
    assert_eq!(after(0.0), (rest, Some(298.0)));
    let (soft, warm) = after(0.5 * to_melt);
    assert!((soft / rest - (1.0 - 0.5f64.powf(0.55))).abs() < 1e-12);
    assert!((warm.unwrap() - 827.0).abs() < 1e-9);
    for beyond in [1.0 + 1e-12, 2.0, 1e6] {
        assert_eq!(after(beyond * to_melt).0, 0.0, "melted");
    }
    // what has no strength flows without work and is warmed no more
    let melted = JohnsonCook {
        heat: 1e-9,
        ..COPPER
    };
    let (stress, state, _) = upset(melted, 0.5, 0.01, 400);
    assert!((0.0..1e-6).contains(&stress), "{stress}");
    assert!(state.memory.min().is_finite());
    // Cowper and Symonds' law at rates far below D is linear hardening
    let still = Flow::from(CowperSymonds {
        strength: 1e-3,
        modulus: 0.1,
        rate: 1.0,
        exponent: 2.0,
    });
    let linear = Flow::from(LinearHardening {
        strength: 1e-3,
        modulus: 0.1,
    });
    assert_eq!(still.at_rest(0.2), linear.at_rest(0.2));
}
