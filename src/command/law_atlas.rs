//! `law --young ...`: the law of a material from the atlas, in milliseconds.

use super::{Context, Verdict, check_writable};
use crate::case::{Case, slips};
use crate::law::LawFile;
use crate::material::flow::LinearHardening;
use crate::material::{Flow, Material};
use crate::study::Study;
use crate::unit::{Density, Length, Pressure, argument};
use crate::{Error, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Make the law file of a material from the atlas, without a simulation.
#[derive(Debug, Args)]
pub struct LawAtlasArgs {
    /// Young's modulus, e.g. `128GPa`.
    #[arg(long, required_unless_present = "study")]
    pub young: Option<String>,
    /// Yield strength, e.g. `162MPa`.
    #[arg(long = "yield", required_unless_present = "study")]
    pub strength: Option<String>,
    /// Poisson's ratio.
    #[arg(long, required_unless_present = "study")]
    pub poisson: Option<String>,
    /// Density, e.g. `8960kg/m3`.
    #[arg(long, required_unless_present = "study")]
    pub density: Option<String>,
    /// Hardening modulus, e.g. `1GPa`.
    #[arg(long)]
    pub hardening: Option<String>,
    /// Radius, e.g. `250um`: the law serves every size, this one is named in its file.
    #[arg(long, required_unless_present = "study")]
    pub radius: Option<String>,
    /// Name of the law; by default that of the file.
    #[arg(long)]
    pub name: Option<String>,
    /// A study file whose materials get a law each, named after their cases, in the folder `--out`.
    #[arg(
        long,
        conflicts_with_all = ["young", "strength", "poisson", "density", "hardening", "radius", "name"]
    )]
    pub study: Option<PathBuf>,
    /// Law file to write; with `--study` a folder.
    #[arg(short, long, required = true)]
    pub out: Option<PathBuf>,
}

impl LawAtlasArgs {
    /// Make the law, or those of a study's materials.
    ///
    /// # Errors
    /// [`Error::Argument`] for arguments that are no such quantities, [`Error::Refused`] for a material that no case may have
    /// or that lies outside the atlas, and those of reading and writing. Nothing is written unless every law can be.
    pub fn run(&self, context: &Context) -> Result<Verdict> {
        let out = self.out.as_deref().unwrap_or(Path::new("law.toml"));
        let cases = match &self.study {
            Some(study) => Study::read(study)?.cases,
            None => vec![self.case(out)?],
        };
        let mut laws: Vec<(PathBuf, LawFile)> = Vec::new();
        for case in &cases {
            let file = law_of(case)?;
            let path = match &self.study {
                Some(_) => out.join(format!("{}.toml", file.name)),
                None => out.to_owned(),
            };
            if laws.iter().any(|(there, _)| *there == path) {
                return Err(Error::Refused {
                    what: format!("name of a `[[case]]` in {}", case.path.display()),
                    found: format!("`{}` twice", case.name),
                    allowed: "must be given once: laws are named after it".to_owned(),
                });
            }
            super::fit::check_target(&path, case)?;
            laws.push((path, file));
        }
        let folder = match &self.study {
            Some(_) => out,
            None => out.parent().unwrap_or(Path::new("")),
        };
        check_writable(match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        })?;
        for (path, file) in &laws {
            file.write(path)?;
            context.say(&format!(
                "{}: {} -> {}\n",
                file.name,
                file.warnings.join("; "),
                path.display()
            ))?;
        }
        Ok(Verdict::Met)
    }

    /// The material of the arguments as a case.
    fn case(&self, out: &Path) -> Result<Case> {
        let text = |given: &Option<String>| given.clone().unwrap_or_default();
        let strength = argument::<Pressure>("--yield", &text(&self.strength))?;
        let flow = match &self.hardening {
            None => Flow::perfectly_plastic(strength),
            Some(text) => LinearHardening {
                strength,
                modulus: argument::<Pressure>("--hardening", text)?,
            }
            .into(),
        };
        let poisson = text(&self.poisson);
        let material = Material {
            density: argument::<Density>("--density", &text(&self.density))?,
            young_modulus: argument::<Pressure>("--young", &text(&self.young))?,
            poisson_ratio: poisson.parse().map_err(|_| Error::Argument {
                argument: "--poisson".to_owned(),
                found: format!("\"{poisson}\""),
                allowed: "must be a number in [0, 0.5)".to_owned(),
            })?,
            flow: Some(flow),
        };
        let radius = argument::<Length>("--radius", &text(&self.radius))?;
        let stem = out.file_stem().unwrap_or_default().to_string_lossy();
        let name = self.name.clone().unwrap_or_else(|| stem.into_owned());
        let case = Case::of(&name, radius, material, &[1.0], 0.02)?;
        // what Poisson's ratio may be the atlas says; it has no unit
        let mut slips = slips::reasons(&case, &[]).into_iter();
        match slips.find(|(key, ..)| !key.ends_with("poisson_ratio")) {
            None => Ok(case),
            Some((key, _, why)) => {
                let argument = match key.rsplit('.').next().unwrap_or_default() {
                    "density" => ("--density", &self.density),
                    "young_modulus" => ("--young", &self.young),
                    "radius" => ("--radius", &self.radius),
                    "hardening_modulus" => ("--hardening", &self.hardening),
                    _ => ("--yield", &self.strength),
                };
                Err(Error::Argument {
                    argument: argument.0.to_owned(),
                    found: format!("\"{}\"", text(argument.1)),
                    allowed: format!(
                        "check the unit: {why}; if it is meant, write a case and run it"
                    ),
                })
            }
        }
    }
}

/// Law of a case's material, whose name stands in what is refused.
fn law_of(case: &Case) -> Result<LawFile> {
    LawFile::of_atlas(&case.name, &case.material, case.radius).map_err(|error| match error {
        Error::Refused {
            what,
            found,
            allowed,
        } => Error::Refused {
            what: format!("{}: {what}", case.name),
            found,
            allowed,
        },
        other => other,
    })
}
