//! Theories against worked numbers: R = 250 um, rho = 8000 kg/m3, E = 100 GPa, nu = 0.35, Y = 1.25 GPa (E/Y = 80).
//!
//! The force values come from an independent evaluation of the published formulas in 40-digit arithmetic, restitutions from a
//! high-order integration in time.

use crate::impacts::{MATERIAL, RADIUS};
use approx::assert_relative_eq;
use impactlaw::contact::rebound::{Rebound, rebound};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::material::{Flow, Material};
use impactlaw::theory::{FORMULAS, Theory};
use std::f64::consts::PI;

/// Force in N at delta/R, after an optional largest delta/R.
struct Force(f64, Option<f64>);

impl LawVisitor for Force {
    type Output = f64;
    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let mut history = L::History::default();
        if let Some(peak) = self.1 {
            law.force(peak, &mut history);
        }
        law.force(self.0, &mut history) * RADIUS * RADIUS
    }
}

struct ImpactOf<'a>(&'a Material, f64);

impl LawVisitor for ImpactOf<'_> {
    type Output = Rebound;
    fn visit<L: NormalLaw>(self, law: &L) -> Rebound {
        rebound(law, RADIUS, self.0.sphere_mass(RADIUS), self.1)
    }
}

struct Impact(f64);

impl LawVisitor for Impact {
    type Output = Rebound;
    fn visit<L: NormalLaw>(self, law: &L) -> Rebound {
        ImpactOf(&MATERIAL, self.0).visit(law)
    }
}

/// delta/R at which contact is lost after the largest delta/R.
struct Residual(f64);

impl LawVisitor for Residual {
    type Output = f64;
    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let mut history = L::History::default();
        law.force(self.0, &mut history);
        let (mut lost, mut held) = (0.0, self.0);
        for _ in 0..60 {
            let middle = 0.5 * (lost + held);
            if law.force(middle, &mut history) > 0.0 {
                held = middle;
            } else {
                lost = middle;
            }
        }
        held
    }
}

fn force(theory: Theory, x: f64, peak: Option<f64>) -> f64 {
    theory.visit(&MATERIAL, Force(x, peak)).unwrap()
}

fn restitution(theory: Theory, velocity: f64) -> f64 {
    let hit = theory.visit(&MATERIAL, Impact(velocity)).unwrap();
    hit.restitution
}

#[test]
fn loading_forces_equal_the_check_numbers() {
    let rows = [
        (
            1e-3,
            [
                0.30031126877,
                0.29321980323,
                0.30031126877,
                0.30505264640,
                0.30031126877,
                0.30028874442,
            ],
        ),
        (
            0.01,
            [
                9.4966761633,
                3.8275115385,
                6.3390871717,
                7.3727930843,
                7.3601323395,
                9.8531515998,
            ],
        ),
        (
            0.05,
            [
                106.17606731,
                19.535474806,
                33.828022891,
                56.289988661,
                52.188989089,
                54.651667017,
            ],
        ),
        (
            0.1,
            [
                300.31126877,
                39.170428891,
                68.189192539,
                137.44467859,
                109.05133932,
                96.638243391,
            ],
        ),
        (
            0.2,
            [
                849.40853846,
                78.440337061,
                136.91153184,
                274.88935719,
                211.28900652,
                150.42161670,
            ],
        ),
    ];
    let theories = [
        Theory::Hertz,
        Theory::Thornton,
        Theory::ThorntonHardness,
        Theory::KogutEtsion,
        Theory::JacksonGreen,
        Theory::Mdr,
    ];
    for (x, values) in rows {
        for (theory, value) in theories.into_iter().zip(values) {
            assert_relative_eq!(force(theory, x, None), value, max_relative = 1e-9);
        }
    }
}

#[test]
fn unloading_branches_equal_the_check_numbers() {
    let rows = [
        (Theory::Thornton, 0.040800433986, 6.0253125453),
        (Theory::KogutEtsion, 0.032104775576, 36.647238796),
        (Theory::KogutEtsionHertzian, 0.029727250938, 36.807643881),
        (Theory::JacksonGreen, 0.035921364895, 27.025198760),
        (Theory::Mdr, 0.038227772697, 26.011404510),
    ];
    for (theory, residual, value) in rows {
        let got = theory.visit(&MATERIAL, Residual(0.05)).unwrap();
        assert_relative_eq!(got, residual, max_relative = 1e-9);
        assert_relative_eq!(force(theory, 0.045, Some(0.05)), value, max_relative = 1e-9);
    }
}

/// A sphere of radius $R_r$ under Hertz has the force and the contact radius of the largest displacement, and loses contact at the
/// residual one.
#[test]
fn hertzian_unloading_of_kogut_and_etsion_is_hertz_of_a_flatter_sphere() {
    struct Radius(f64, f64);
    impl LawVisitor for Radius {
        type Output = f64;
        fn visit<L: NormalLaw>(self, law: &L) -> f64 {
            let mut history = L::History::default();
            law.force(self.0, &mut history);
            law.contact_radius(self.1, &history).unwrap()
        }
    }
    let theory = Theory::KogutEtsionHertzian;
    for peak in [0.002, 0.01, 0.05, 0.2] {
        let radius = |x: f64| theory.visit(&MATERIAL, Radius(peak, x)).unwrap();
        let most = force(theory, peak, None) / (RADIUS * RADIUS);
        let widest = radius(peak);
        let flatter = 4.0 * MATERIAL.contact_modulus() * widest.powi(3) / (3.0 * most);
        let residual = theory.visit(&MATERIAL, Residual(peak)).unwrap();
        for share in [0.2, 0.7, 1.0 - 1e-9] {
            let depth = share * (peak - residual);
            let hertz = 4.0 / 3.0 * MATERIAL.contact_modulus() * flatter.sqrt() * depth.powf(1.5);
            let found = force(theory, residual + depth, Some(peak)) / (RADIUS * RADIUS);
            assert_relative_eq!(found, hertz, max_relative = 1e-8);
            let expected = (flatter * depth).sqrt();
            assert_relative_eq!(radius(residual + depth), expected, max_relative = 1e-8);
        }
    }
    // just above first yield nothing is left of the flattening, and more comes back than went in
    let critical = 2.0772363842e-7 / RADIUS;
    for (w, left) in [(1.01, false), (1.58, false), (1.60, true)] {
        let residual = theory.visit(&MATERIAL, Residual(w * critical)).unwrap();
        assert_eq!(residual > 1e-6 * critical, left, "{w}: {residual}");
    }
}

#[test]
fn yield_points_equal_the_check_numbers() {
    let rows = [
        (1.6, 1.8999142685e-7, 0.19895855694, 0.2403222579),
        (2.8, 5.8184874472e-7, 1.0662935161, 0.97361917239),
        (
            2.8 * (0.454 + 0.41 * 0.35),
            2.0772363842e-7,
            0.22745238613,
            0.26867910406,
        ),
        (
            1.234 + 1.256 * 0.35,
            2.0787265998e-7,
            0.22769719255,
            0.26892006465,
        ),
        (
            1.295 * (0.736_f64 * 0.35).exp(),
            2.0834452531e-7,
            0.22847293209,
            0.26968333266,
        ),
    ];
    for (ratio, displacement, force, velocity) in rows {
        let point = MATERIAL.yield_point(RADIUS, ratio).unwrap();
        assert_relative_eq!(point.displacement, displacement, max_relative = 1e-9);
        assert_relative_eq!(point.force, force, max_relative = 1e-9);
        assert_relative_eq!(point.velocity, velocity, max_relative = 1e-9);
    }
}

#[test]
fn published_rows_meet_with_the_known_jumps() {
    let at = |w: f64, side: f64| w * 2.0772363842e-7 / RADIUS * (1.0 + side);
    let jump = |theory, x: fn(f64) -> f64| {
        force(theory, x(1e-9), None) / force(theory, x(-1e-9), None) - 1.0
    };
    for (w, expected) in [(1.0, 0.03000), (6.0, 0.01679), (110.0, 0.0418)] {
        let above = force(Theory::KogutEtsion, at(w, 1e-8), None);
        let below = force(Theory::KogutEtsion, at(w, -1e-8), None);
        assert!((above / below - 1.0 - expected).abs() < 1e-4, "w = {w}");
    }
    let switch = |side: f64| 1.9 * 2.0834452531e-7 / RADIUS * (1.0 + side);
    assert!((jump(Theory::JacksonGreen, switch) + 0.005605).abs() < 5e-5);
    let corner = |side: f64| 1.8999142685e-7 / RADIUS * (1.0 + side);
    assert!(jump(Theory::Thornton, corner).abs() < 1e-8);
}

#[test]
fn integrated_restitution_equals_the_table() {
    let velocities = [10.0, 20.0, 30.0, 40.0, 50.0];
    let rows = [
        (Theory::Thornton, [0.465, 0.392, 0.354, 0.330, 0.312]),
        (
            Theory::ThorntonHardness,
            [0.654, 0.554, 0.501, 0.467, 0.442],
        ),
        (Theory::JacksonGreen, [0.662, 0.566, 0.511, 0.473, 0.444]),
        (Theory::KogutEtsion, [0.696, 0.636, 0.603, 0.581, 0.564]),
        (Theory::Mdr, [0.716, 0.568, 0.484, 0.426, 0.382]),
    ];
    for (theory, values) in rows {
        for (velocity, value) in velocities.into_iter().zip(values) {
            let e = restitution(theory, velocity);
            assert!(
                (e - value).abs() < 6e-4,
                "{theory} at {velocity}: {e} and not {value}"
            );
        }
    }
}

#[test]
fn closed_forms_equal_the_table() {
    let rows = [
        (Theory::Johnson, [0.910, 0.765, 0.691, 0.643, 0.608]),
        (Theory::JacksonGreen, [0.665, 0.566, 0.515, 0.479, 0.450]),
    ];
    for (i, velocity) in [10.0, 20.0, 30.0, 40.0, 50.0].into_iter().enumerate() {
        for (theory, values) in rows {
            let e = theory.restitution_closed_form(&MATERIAL, velocity).unwrap();
            assert!((e - values[i]).abs() < 6e-4, "{theory} at {velocity}: {e}");
        }
        let e = FORMULAS[0].restitution.unwrap()(&MATERIAL, velocity);
        // at 10 m/s the branch of small plastic deformation holds
        let expected = [2.08 * 41.611_f64.powf(-0.25), 0.649, 0.530, 0.459, 0.410][i];
        assert!((e.unwrap() - expected).abs() < 6e-4, "{e:?} at {velocity}");
    }
}

#[test]
fn closed_forms_of_thornton_and_the_springs_equal_the_integral() {
    for theory in [
        Theory::Thornton,
        Theory::ThorntonHardness,
        Theory::WaltonBraun,
        Theory::WaltonBraunVariable,
        Theory::Luding,
        Theory::Hertz,
    ] {
        for velocity in [0.07, 0.3, 1.0, 10.0, 100.0, 1e4] {
            if let Some(closed) = theory.restitution_closed_form(&MATERIAL, velocity) {
                let e = restitution(theory, velocity);
                assert!(
                    (e / closed - 1.0).abs() < 1e-9,
                    "{theory} at {velocity}: {e} and {closed}"
                );
            }
        }
    }
}

#[test]
fn spring_laws_have_the_restitution_of_johnson_at_the_damage_number_they_are_made_for() {
    for stiffness_ratio in [20.0, 33.0, 40.0, 80.0, 200.0, 630.0, 2e3, 6e3, 2e4] {
        let strength = 100e9 / stiffness_ratio;
        let mut material = MATERIAL;
        material.flow = Some(Flow::perfectly_plastic(strength));
        let velocity = (0.01 * strength / material.density).sqrt();
        let ratio: f64 = strength / material.contact_modulus();
        let johnson = 3.8 * (2.0 * PI / 3.0 * 0.01_f64).powf(-0.125) * ratio.sqrt();
        for theory in [
            Theory::WaltonBraun,
            Theory::WaltonBraunVariable,
            Theory::Luding,
        ] {
            let hit = theory
                .visit(&material, ImpactOf(&material, velocity))
                .unwrap();
            // where his formula exceeds 1 nothing is plastic yet
            assert_relative_eq!(hit.restitution, johnson.min(1.0), max_relative = 1e-12);
        }
    }
}

#[test]
fn the_law_of_johnson_is_his_formula_but_for_its_elastic_start() {
    // e^2 = (2/5) F delta_e / (m V^2 / 2) with F = 2 pi R p_d delta. Hertz up to x_c stores pi p_d x_c^2 / 5 less than the
    // plastic line, so delta* grows; without that term the formula is Johnson's with its unrounded constant.
    let p_d = 3.0 * 1.25e9;
    let e_star = MATERIAL.contact_modulus();
    let meeting = (1.5 * PI * p_d / e_star).powi(2);
    for velocity in [20.0, 50.0, 500.0] {
        let energy = 0.5 * MATERIAL.sphere_mass(1.0) * velocity * velocity;
        let start = (1.0 + 0.2 * PI * p_d * meeting * meeting / energy).powf(0.375);
        let prefactor = (0.3 * PI.powf(1.25) * 4.0_f64.powf(0.75)).sqrt();
        let exact = prefactor * (p_d / e_star).sqrt() * (energy / p_d).powf(-0.125);
        assert_relative_eq!(
            restitution(Theory::Johnson, velocity),
            exact * start,
            max_relative = 1e-10
        );
        let printed = Theory::Johnson.restitution_closed_form(&MATERIAL, velocity);
        assert_relative_eq!(printed.unwrap(), exact * 3.8 / 3.7433, max_relative = 1e-5);
    }
}

#[test]
fn the_formula_of_jackson_green_marghitu_follows_the_integral() {
    for velocity in [0.5, 1.0, 5.0, 10.0, 50.0, 100.0] {
        let closed = Theory::JacksonGreen
            .restitution_closed_form(&MATERIAL, velocity)
            .unwrap();
        let e = restitution(Theory::JacksonGreen, velocity);
        assert!(
            (e / closed - 1.0).abs() < 0.022,
            "{velocity}: {e} and {closed}"
        );
    }
}

#[test]
fn the_jump_of_kogut_and_etsion_gives_more_than_elastic_rebound() {
    let largest = (0..200)
        .map(|i| {
            restitution(
                Theory::KogutEtsion,
                0.26867910406 * (1.0 + 1e-3 * f64::from(i)),
            )
        })
        .fold(0.0, f64::max);
    assert!((largest - 1.0149).abs() < 1e-4, "{largest}");
}
