//! A study that is run in a second.

/// Four cases of which two are the same run: 2000 kg/m3 at 40 m/s is 8000 kg/m3 at 20 m/s.
pub const FOUR_CASES: &str = r#"
[particle]
radius = ["250 um"]
[material]
density = ["2000 kg/m3", "8000 kg/m3"]
young_modulus = ["100 GPa"]
young_over_yield = [80]
poisson_ratio = [0.35]
[impact]
velocities = ["20 m/s", "40 m/s"]
[accuracy]
tolerance = 0.2
"#;
