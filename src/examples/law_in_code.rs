//! A contact law from a material in code: no case file, no output folder.
//!
//! `cargo run --release --example law_in_code`

use impactlaw::prelude::*;

/// Runs the example.
///
/// # Errors
/// None with these numbers.
pub fn main() -> Result<()> {
    // SI units: kg/m3, Pa; annealed copper
    let copper = Material {
        density: 8960.0,
        young_modulus: 120e9,
        poisson_ratio: 0.34,
        flow: Some(Flow::perfectly_plastic(250e6)),
    };
    // a ball of 0.5 mm radius at three speeds (m/s), to 10 %
    let case = Case::of("copper", 0.5e-3, copper, &[2.0, 5.0, 10.0], 0.1)?;

    // the same three stages as `impactlaw run`: plan, simulate, fit
    let plans = plans(&case)?;
    let run = |plan| simulate(&case.material, case.radius, plan).impact;
    let impacts: Vec<Impact> = plans.iter().map(run).collect();
    let file = LawFile::of(&fit(&case, &impacts)?, &case, PROGRAM);
    println!("largest error {:.1} %", 100.0 * file.worst_error());
    assert!(file.worst_error() < file.threshold());

    // the law at any radius (m), displacement and largest displacement before (m): loading, then unloading
    let law = file.law()?;
    let loading = law.force(1e-3, 10e-6, 10e-6);
    let unloading = law.force(1e-3, 9e-6, 10e-6);
    println!("F(10 um) = {loading:.2} N, back at 9 um {unloading:.2} N");
    assert!(0.0 < unloading && unloading < loading);
    Ok(())
}
