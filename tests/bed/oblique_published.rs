//! Oblique impacts in the bed beside published ones: benchmarks 4 and 5 of Chung and Ooi 2011 (Granular Matter 13, 643).
//!
//! The points are those that Kratos' tests of its particle code hold (KratosMultiphysics/Kratos,
//! applications/DEMApplication/test_examples/basic_benchmarks/paper_data/benchmark4_graph1.dat, benchmark5_graph1.dat and
//! benchmark5_graph2.dat): read off the figures of the paper, hence good to about one per cent of an axis. The paper itself was
//! not at hand.

use crate::collisions::{RADIUS, thrown};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::material::Material;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;

/// Incidence (degrees from the normal), tangential restitution of the centre: 5 mm aluminium oxide spheres on thick glass at
/// 3.9 m/s, e = 0.98, mu = 0.092, as measured (Kharaz, Gorham and Salman 2001, Powder Technology 120, 281).
const MEASURED: [[f64; 2]; 10] = [
    [2.24, 0.797],
    [4.22, 0.746],
    [9.84, 0.675],
    [20.22, 0.599],
    [30.36, 0.690],
    [39.54, 0.774],
    [49.60, 0.848],
    [71.07, 0.937],
    [79.23, 0.970],
    [85.17, 0.979],
];

/// The same as computed by Chung and Ooi with a discrete element code.
const COMPUTED: [[f64; 2]; 13] = [
    [5.17, 0.948],
    [10.16, 0.687],
    [14.99, 0.624],
    [20.06, 0.616],
    [25.05, 0.634],
    [30.12, 0.684],
    [35.03, 0.737],
    [40.02, 0.781],
    [50.00, 0.845],
    [59.98, 0.893],
    [69.96, 0.932],
    [80.02, 0.966],
    [85.01, 0.983],
];

/// Incidence v_s/(mu v_n) and recoil v_s'/(mu v_n') of the point of contact by finite elements: an elastic ball, nu = 0.3,
/// mu = 0.3, 5 m/s along the normal.
const FINITE_ELEMENTS: [[f64; 2]; 17] = [
    [0.006, -0.027],
    [0.272, -0.027],
    [0.586, -0.027],
    [0.876, -0.080],
    [1.190, -0.213],
    [1.553, -0.373],
    [1.915, -0.627],
    [2.314, -0.947],
    [2.785, -1.253],
    [3.317, -1.520],
    [3.970, -1.720],
    [4.755, -1.707],
    [5.758, -1.200],
    [7.124, 0.133],
    [9.118, 2.147],
    [12.356, 5.427],
    [12.961, 6.013],
];

/// Incidence and spin R w'/(mu v_n) where these slide throughout.
const SPINS: [[f64; 2]; 4] = [
    [7.029, -4.941],
    [9.040, -4.972],
    [12.335, -4.970],
    [18.803, -4.975],
];

const OXIDE: Material = Material {
    density: 4000.0,
    young_modulus: 380e9,
    poisson_ratio: 0.23,
    flow: None,
};
const STEEL: Material = Material {
    density: 7850.0,
    young_modulus: 208e9,
    poisson_ratio: 0.3,
    flow: None,
};

/// Tangential restitution of a sphere's centre at an incidence in degrees. Sizes do not matter: contact times and lengths are
/// those of Hertz in proportion to the radius.
fn oxide(degrees: f64) -> f64 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let effects = Law::smooth()
        .with(Viscous::new(0.98))
        .with(Mindlin::new(&OXIDE, 0.092));
    let velocity = Vector::new(3.9 * sin, 0.0, -3.9 * cos);
    let [after, _] = thrown(effects, Hertz::of(&OXIDE), &OXIDE, velocity, 2000.0);
    after.x / velocity.x
}

/// Recoil and spin numbers of the elastic ball.
fn steel(incidence: f64) -> [f64; 2] {
    let (mu, v_n) = (0.3, 5.0);
    let effects = Law::smooth().with(Mindlin::new(&STEEL, mu));
    let velocity = Vector::new(incidence * mu * v_n, 0.0, -v_n);
    let [after, spin] = thrown(effects, Hertz::of(&STEEL), &STEEL, velocity, 2000.0);
    let slip = after.x - RADIUS * spin.y;
    [slip / (mu * after.z), -RADIUS * spin.y / (mu * v_n)]
}

#[test]
fn rebounds_of_oxide_spheres_are_those_measured_where_they_slide() {
    println!("angle  bed    measured");
    let mut off = Vec::new();
    for [degrees, measured] in MEASURED {
        let bed = oxide(degrees);
        println!("{degrees:5.2} {bed:6.3} {measured:6.3}");
        off.push((degrees, (bed - measured).abs()));
    }
    // from 20 degrees on the contact slides for most of the time; steeper, a spring without micro-slip gives back too much
    // along the way of the centre: 0.12 at 4 degrees
    let worst = |from: f64, to: f64| {
        let within = off.iter().filter(|(at, _)| (from..to).contains(at));
        within.map(|(_, off)| *off).fold(0.0, f64::max)
    };
    assert!(worst(20.0, 90.0) < 0.03, "{off:?}");
    assert!(worst(0.0, 20.0) < 0.13, "{off:?}");
}

#[test]
fn rebounds_of_oxide_spheres_are_those_of_chung_and_ooi_but_for_the_steepest() {
    for [degrees, computed] in COMPUTED {
        let bed = oxide(degrees);
        println!("{degrees:5.2} {bed:6.3} {computed:6.3}");
        // at 5 degrees it sticks nearly throughout, and codes differ by how the spring unloads with the contact: 0.855 for
        // this one, 0.935 for one whose stretch is kept
        let allowed = if degrees < 8.0 { 0.1 } else { 0.025 };
        assert!((bed - computed).abs() < allowed, "{degrees}: {bed}");
    }
}

#[test]
fn recoils_and_spins_are_those_of_finite_elements_where_they_slide() {
    for [incidence, recoil] in FINITE_ELEMENTS {
        let [bed, _] = steel(incidence);
        println!("{incidence:6.3} {bed:6.3} {recoil:6.3}");
        // sticking, a real contact slips at its rim and gives back less than the spring does
        let allowed = if incidence > 7.0 { 0.08 } else { 0.65 };
        assert!((bed - recoil).abs() < allowed, "{incidence}: {bed}");
    }
    for [incidence, spin] in SPINS {
        let [_, bed] = steel(incidence);
        assert!((bed - spin).abs() < 0.06, "{incidence}: {bed}");
    }
}
