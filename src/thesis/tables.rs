//! Tables of the thesis that a study is compared with.

/// Table 4-4: the largest force of a sphere of R 250 µm, rho 8000 kg/m3, E 100 GPa, E/Y 80, N: speed, Kogut-Etsion, Jackson-Green and MPM
/// of the thesis.
pub const FORCES: [(f64, f64, f64, f64); 5] = [
    (10.0, 11.8, 11.8, 10.7),
    (20.0, 26.8, 26.5, 26.2),
    (30.0, 44.4, 42.2, 43.6),
    (40.0, 64.3, 58.6, 54.9),
    (50.0, 85.1, 74.6, 70.9),
];
/// Density, Young's modulus and E/Y of table 4-4.
pub const FORCES_OF: (f64, f64, f64) = (8000.0, 100e9, 80.0);

/// Table 4-5: speed (m/s), density (kg/m3), E and Y (Pa) of the three cases that are repeated in other sizes.
pub const SIZES: [(f64, f64, f64, f64); 3] = [
    (30.0, 1000.0, 1e9, 50e6),
    (40.0, 2000.0, 10e9, 250e6),
    (50.0, 4000.0, 100e9, 5e9),
];
/// Diameters of table 4-5, m.
pub const DIAMETERS: [f64; 5] = [100e-6, 250e-6, 500e-6, 750e-6, 1e-3];

/// A metal of tables 5-3 to 5-5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metal {
    /// Name.
    pub name: &'static str,
    /// rho, kg/m3.
    pub density: f64,
    /// E, Pa.
    pub young_modulus: f64,
    /// Y, Pa.
    pub strength: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// V, m/s.
    pub velocity: f64,
    /// eps_p, MPM of the thesis and its 5-4.
    pub strain: [f64; 2],
    /// Compression ratio, MPM of the thesis and its 5-5.
    pub compression: [f64; 2],
}

/// Lead and nickel, diameter 500 µm.
pub const METALS: [Metal; 2] = [
    Metal {
        name: "lead",
        density: 11400.0,
        young_modulus: 15.8e9,
        strength: 5.9e6,
        poisson_ratio: 0.44,
        velocity: 5.0,
        strain: [0.02, 0.02],
        compression: [0.05, 0.04],
    },
    Metal {
        name: "nickel",
        density: 8900.0,
        young_modulus: 204e9,
        strength: 148e6,
        poisson_ratio: 0.31,
        velocity: 80.0,
        strain: [0.17, 0.18],
        compression: [0.17, 0.17],
    },
];
/// Radius of their spheres, m.
pub const METAL_RADIUS: f64 = 250e-6;
