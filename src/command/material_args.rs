//! Arguments that tell a material and a radius, of verbs that can do without a file of them.

use crate::case::{Case, slips};
use crate::material::constant::Constant;
use crate::material::{Flow, Material};
use crate::unit::{Density, Length, Pressure, argument};
use crate::{Error, Result};
use clap::Args;

/// Id of the argument that names a file with the material instead.
pub const FILE: &str = "material_file";

/// A material without its flow stress, and a radius.
#[derive(Debug, Args)]
pub struct MaterialArgs {
    /// Young's modulus, e.g. `128GPa`.
    #[arg(long, required_unless_present = FILE, conflicts_with = FILE)]
    pub young: Option<String>,
    /// Poisson's ratio.
    #[arg(long, required_unless_present = FILE, conflicts_with = FILE)]
    pub poisson: Option<String>,
    /// Density, e.g. `8960kg/m3`.
    #[arg(long, required_unless_present = FILE, conflicts_with = FILE)]
    pub density: Option<String>,
    /// Radius of the particle, e.g. `250um`.
    #[arg(long, required_unless_present = FILE, conflicts_with = FILE)]
    pub radius: Option<String>,
}

/// A constant of the flow stress that an argument of the verb itself tells: constant, argument, its text.
pub type Told<'a> = (Constant, &'static str, &'a Option<String>);

impl MaterialArgs {
    /// The case of this sphere at 1 m/s, with a flow stress whose constants are `told` by further arguments.
    ///
    /// # Errors
    /// [`Error::Argument`] and [`Error::Refused`] for what is no such quantity, what no case may have, or looks like a slip of its unit.
    pub fn case(
        &self,
        name: &str,
        tolerance: f64,
        flow: Option<Flow>,
        told: &[Told<'_>],
    ) -> Result<Case> {
        let text = |given: &Option<String>| given.clone().unwrap_or_default();
        let poisson = text(&self.poisson);
        let material = Material {
            density: argument::<Density>("--density", &text(&self.density))?,
            young_modulus: argument::<Pressure>("--young", &text(&self.young))?,
            poisson_ratio: poisson.parse().map_err(|_| Error::Argument {
                argument: "--poisson".to_owned(),
                found: format!("\"{poisson}\""),
                allowed: "must be a number in [0, 0.5)".to_owned(),
            })?,
            flow,
        };
        let radius = argument::<Length>("--radius", &text(&self.radius))?;
        let case = Case::of(name, radius, material, &[1.0], tolerance)?;
        // what Poisson's ratio may be the atlas says; it has no unit
        let mut slips = slips::reasons(&case, &[]).into_iter();
        let Some((key, _, why)) = slips.find(|(key, ..)| !key.ends_with("poisson_ratio")) else {
            return Ok(case);
        };
        let last = key.rsplit('.').next().unwrap_or_default();
        let (argument, given) = match last {
            "density" => ("--density", &self.density),
            "radius" => ("--radius", &self.radius),
            _ => told
                .iter()
                .find(|(constant, ..)| constant.key == last)
                .map_or(("--young", &self.young), |(_, name, given)| (*name, *given)),
        };
        Err(Error::Argument {
            argument: argument.to_owned(),
            found: format!("\"{}\"", text(given)),
            allowed: format!(
                "check the unit: {why}; if it is meant, write a case with `unusual = [\"{key}\"]`"
            ),
        })
    }
}
