//! `law eval`: the force of a law file at given displacements, as CSV.

use super::law_atlas::LawAtlasArgs;
use super::{Command, Context, Verdict, print};
use crate::Result;
use crate::law::{AnyLaw, LawFile, beyond};
use crate::unit::{Length, argument};
use crate::{Error, unit::Dimension};
use clap::{Args, Subcommand};
use serde::Serialize;
use std::path::PathBuf;

/// Make a law from the atlas, or work with a law file.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true
)]
pub struct LawArgs {
    /// What to do with a law file.
    #[command(subcommand)]
    pub verb: Option<LawVerb>,
    /// The law to make.
    #[command(flatten)]
    pub make: LawAtlasArgs,
}

/// Verbs on a law file.
#[derive(Debug, Subcommand)]
#[allow(missing_docs)] // each verb is described by the doc comment of its arguments
pub enum LawVerb {
    #[command(after_help = super::examples(&LawArgs::EXAMPLES[1..]))]
    Eval(LawEvalArgs),
}

/// Print F(delta) as CSV: the law at rest, without the inertia term of a fast first loading.
#[derive(Debug, Args)]
pub struct LawEvalArgs {
    /// Law file.
    pub law: PathBuf,
    /// Radius of the body with unit, e.g. `"250 um"`.
    #[arg(long)]
    pub body: String,
    /// Displacements with units, e.g. `"1 um"`.
    #[arg(long, num_args = 1.., value_delimiter = ',', required = true)]
    pub displacements: Vec<String>,
    /// Largest displacement reached before: the displacements lie on the unloading branch.
    #[arg(long)]
    pub max_displacement: Option<String>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for LawArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw law --young 128GPa --yield 162MPa --poisson 0.343 --density 8960kg/m3 --radius 250um --out copper.toml",
        r#"impactlaw law eval models/sac305-solder.toml --body "250 um" --displacements "1 um" "2 um""#,
    ];

    /// Run the verb.
    ///
    /// # Errors
    /// Those of the law file, and [`Error::Argument`] for quantities that are not lengths.
    fn run(&self, context: &Context) -> Result<Verdict> {
        match &self.verb {
            Some(LawVerb::Eval(args)) => eval(args),
            None => self.make.run(context),
        }
    }
}

/// A line of `law eval`. Field names are the CSV header (file contract).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct EvalRow {
    displacement_m: f64,
    #[serde(rename = "force_N")]
    force_n: f64,
}

/// Print `displacement_m,force_N` of the rate-independent core (displacements alone tell no rate); a warning where the law is used outside the range of its impacts.
fn eval(args: &LawEvalArgs) -> Result<Verdict> {
    let law = AnyLaw::Fitted(LawFile::read(&args.law)?.law()?);
    let radius = positive::<Length>("--body", &args.body)?;
    let most = match &args.max_displacement {
        Some(text) => argument::<Length>("--max-displacement", text)?,
        None => 0.0,
    };
    let displacements = args
        .displacements
        .iter()
        .map(|text| argument::<Length>("--displacements", text))
        .collect::<Result<Vec<f64>>>()?;
    for (text, displacement) in args.displacements.iter().zip(&displacements) {
        let most = args.max_displacement.as_ref().map(|_| most);
        if let Some(allowed) = beyond(radius, *displacement, most, "--max-displacement") {
            return Err(Error::Argument {
                argument: "--displacements".to_owned(),
                found: format!("\"{text}\""),
                allowed,
            });
        }
    }
    let limit = law.valid_to()? * radius;
    let outside = displacements.iter().filter(|d| d.max(most) > limit).count();
    if outside > 0 {
        tracing::warn!(
            "{outside} of the displacements lie beyond {}, the largest the law was fitted to",
            crate::unit::engineering(limit, "m", 4)
        );
    }
    let forces = law.forces(radius, most, &displacements)?;
    let row = |(displacement_m, force_n)| EvalRow {
        displacement_m,
        force_n,
    };
    let rows: Vec<EvalRow> = displacements.into_iter().zip(forces).map(row).collect();
    let text = super::theory::rows_text(args.json, &rows)?;
    print(&text)?;
    Ok(Verdict::Met)
}

fn positive<D: Dimension>(name: &str, text: &str) -> Result<f64> {
    let value = argument::<D>(name, text)?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(Error::Argument {
        argument: name.to_owned(),
        found: format!("\"{text}\""),
        allowed: "must be positive".to_owned(),
    })
}
