//! `law --young ...`: the law of a material from the atlas, in milliseconds.

use super::material_args::{FILE, MaterialArgs};
use super::{Context, Verdict, check_writable};
use crate::case::Case;
use crate::law::LawFile;
use crate::material::Flow;
use crate::material::flow::{HARDENING_MODULUS, LinearHardening, YIELD_STRENGTH};
use crate::study::Study;
use crate::unit::{Pressure, argument};
use crate::{Error, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Make the law file of a material from the atlas, without a simulation. The law serves every size; the radius is named in the file.
#[derive(Debug, Args)]
pub struct LawAtlasArgs {
    /// Its elastic constants, and the radius that is named in the file.
    #[command(flatten)]
    pub material: MaterialArgs,
    /// Yield strength, e.g. `162MPa`.
    #[arg(long = "yield", required_unless_present = FILE)]
    pub strength: Option<String>,
    /// Hardening modulus, e.g. `1GPa`.
    #[arg(long)]
    pub hardening: Option<String>,
    /// Name of the law; by default that of the file.
    #[arg(long)]
    pub name: Option<String>,
    /// A study file whose materials get a law each, named after their cases, in the folder `--out`.
    #[arg(long, id = FILE, value_name = "STUDY", conflicts_with_all = ["strength", "hardening", "name"])]
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
            super::fit::check_target(&path, case, None)?;
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
        let strength = self.strength.as_deref().unwrap_or_default();
        let strength = argument::<Pressure>("--yield", strength)?;
        let flow = match &self.hardening {
            None => Flow::perfectly_plastic(strength),
            Some(text) => LinearHardening {
                strength,
                modulus: argument::<Pressure>("--hardening", text)?,
            }
            .into(),
        };
        let stem = out.file_stem().unwrap_or_default().to_string_lossy();
        let name = self.name.clone().unwrap_or_else(|| stem.into_owned());
        let told = [
            (YIELD_STRENGTH, "--yield", &self.strength),
            (HARDENING_MODULUS, "--hardening", &self.hardening),
        ];
        self.material.case(&name, 0.02, Some(flow), &told)
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
