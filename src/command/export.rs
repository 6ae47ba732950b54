//! `export`: a law file to the files of other codes, and the check that they hold the same law; a case file to input decks.

use super::{Command, Context, Verdict, export_case, output_folder, print};
use crate::export::check::{self, Finding};
use crate::export::deck::{Code, USUAL_CELLS, Wanted};
use crate::export::source::artifact::Artifact;
use crate::export::source::portable::Portable;
use crate::export::{Target, checks};
use crate::files::write_atomic;
use crate::law::Form;
use crate::unit::engineering;
use crate::{Error, Result};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

/// Name of all targets together; those that cannot express the law are left out with a warning.
const ALL: &str = "all";

/// Write a law for other codes, and check there that it is the same law; or a case for a finite-element code.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Law file; for `calculix` a case file.
    pub law: PathBuf,
    /// Targets: names of [`Target`] separated by commas, or `all`; or one of [`Code`].
    #[arg(long, num_args = 1.., value_delimiter = ',', help = to_help())]
    pub to: Vec<String>,
    /// Form of the law, overriding the file's: `closed_form`, `spline` or `hertz`.
    #[arg(long)]
    pub form: Option<String>,
    /// Law file of a second material: contacts of the two, for target `c`.
    #[arg(long)]
    pub with: Option<PathBuf>,
    /// Of a case: flattening over the radius (default: that expected of the fastest impact, at most 0.1).
    #[arg(long)]
    pub flattening: Option<f64>,
    /// Of a case: elements of a contact radius (default: 16).
    #[arg(long)]
    pub cells: Option<usize>,
    /// Output folder (default: `out/<law or case name>/export`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Compile and run the law in the codes of `--to` (without it: in all) that are installed, and print how well they agree.
    #[arg(long)]
    pub check: bool,
}

impl Command for ExportArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw export models/sac305-solder.toml --to liggghts,lammps",
        "impactlaw export models/sac305-solder.toml --to all --out deck --check",
        "impactlaw export cases/thesis-4-4.toml --to calculix --flattening 0.1",
    ];

    /// Run the verb.
    ///
    /// # Errors
    /// Those of the law file and the arguments, of a target that cannot express the law, and of writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        if let Some(code) = code(self)? {
            let wanted = Wanted {
                flattening: self.flattening,
                cells: self.cells.unwrap_or(USUAL_CELLS),
            };
            return export_case::run(&self.law, code, wanted, self.out.as_deref(), context);
        }
        let targets = targets(&self.to, self.check)?;
        let form = self.form.as_deref().map(form).transpose()?;
        let law = Portable::read_any(&self.law, form)?;
        if let (Some(bodies), Some(with)) = (law.pair(), &self.with) {
            return Err(Error::Argument {
                argument: "--with".to_owned(),
                found: with.display().to_string(),
                allowed: format!(
                    "must be left out: {} is the law of both bodies already, {}",
                    self.law.display(),
                    bodies.bodies()
                ),
            });
        }
        let other = self.with.as_deref();
        let other = other.map(|file| Portable::read(file, form)).transpose()?;
        let artifacts = match &other {
            Some(other) => with(&law, other, &targets)?,
            None => alone(&law, &targets, self.to.iter().any(|name| name == ALL))?,
        };
        if !targets.is_empty() {
            let folder = output_folder(self.out.as_deref(), &law.name)?;
            let folder = match self.out {
                Some(_) => folder.to_path_buf(),
                None => folder.join("export"),
            };
            let mut said = String::new();
            for artifact in &artifacts {
                let path = folder.join(&artifact.name);
                write_atomic(&path, artifact.text.as_bytes())?;
                let _ = writeln!(said, "{}", path.display());
            }
            let _ = writeln!(
                said,
                "time step for a deck: {} at a smallest radius of {}, in proportion to it",
                engineering(law.time_step(), "s", 3),
                engineering(law.radius(), "m", 3)
            );
            context.say(&said)?;
        }
        match (self.check, &other) {
            (true, Some(other)) => check_with(&law, other),
            (true, None) => check_targets(&law, &targets, context),
            (false, _) => Ok(Verdict::Met),
        }
    }
}

/// The code that the arguments name, if it is one that cases go to.
///
/// # Errors
/// [`Error::Argument`] where targets for laws and for cases, or options of the one and the other, are mixed.
fn code(args: &ExportArgs) -> Result<Option<Code>> {
    let named = |name: &String| Code::ALL.into_iter().find(|code| code.name() == name);
    let Some(code) = args.to.iter().find_map(named) else {
        let of_cases = [
            ("--flattening", args.flattening.is_some()),
            ("--cells", args.cells.is_some()),
        ];
        let allowed = format!(
            "must be left out: it is for a case, whose targets are {}",
            Code::ALL.map(Code::name).join(", ")
        );
        return none_of(&of_cases, &allowed).map(|()| None);
    };
    if let Some(other) = args.to.iter().find(|name| *name != code.name()) {
        return Err(Error::Argument {
            argument: "--to".to_owned(),
            found: format!("`{}` beside `{other}`", code.name()),
            allowed: format!("must be alone: {} takes a case file", code.name()),
        });
    }
    let of_laws = [
        ("--form", args.form.is_some()),
        ("--with", args.with.is_some()),
        ("--check", args.check),
    ];
    let allowed = format!(
        "must be left out: it is for a law, and {} takes a case file",
        code.name()
    );
    none_of(&of_laws, &allowed).map(|()| Some(code))
}

/// Refuses the first of the options that is given.
fn none_of(options: &[(&str, bool)], allowed: &str) -> Result<()> {
    match options.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((option, _)) => Err(Error::Argument {
            argument: (*option).to_owned(),
            found: "a value".to_owned(),
            allowed: allowed.to_owned(),
        }),
    }
}

/// Files of one material's law; where `everything` is wanted, targets that cannot express it are left out.
fn alone(law: &Portable, targets: &[Target], everything: bool) -> Result<Vec<Artifact>> {
    let mut artifacts = Vec::new();
    for target in targets {
        match target.export(law) {
            Ok(files) => artifacts.extend(files),
            Err(error) if everything => tracing::warn!("left out: {error}"),
            Err(error) => return Err(error),
        }
    }
    Ok(artifacts)
}

/// Files of the contact of two materials.
fn with(law: &Portable, other: &Portable, targets: &[Target]) -> Result<Vec<Artifact>> {
    let pair = |target: &Target| {
        target.pair().ok_or_else(|| {
            let able = Target::ALL.into_iter().filter(|able| able.pair().is_some());
            let names: Vec<_> = able.map(Target::name).collect();
            Error::Argument {
                argument: "--with".to_owned(),
                found: format!("`--to {target}`"),
                allowed: format!(
                    "is for target {}: the other targets hold one law",
                    names.join(", ")
                ),
            }
        })
    };
    let pairs = targets.iter().map(pair).collect::<Result<Vec<_>>>()?;
    let mut artifacts = Vec::new();
    for (target, pair) in targets.iter().zip(pairs) {
        let files = pair(law, other)?;
        artifacts.extend(files.into_iter().map(|file| file.within(target.name())));
    }
    Ok(artifacts)
}

/// Targets by name, once each; `all` is every one. None are needed with `--check`.
fn targets(names: &[String], check: bool) -> Result<Vec<Target>> {
    if names.is_empty() && !check {
        return Err(Error::Argument {
            argument: "--to".to_owned(),
            found: "nothing".to_owned(),
            allowed: format!(
                "name one or more of {}, or all, or give --check; or, with a case, {}",
                Target::ALL.map(Target::name).join(", "),
                Code::ALL.map(Code::name).join(", ")
            ),
        });
    }
    let mut targets = Vec::new();
    for name in names {
        match name.as_str() {
            ALL => targets.extend(Target::ALL),
            name => targets.push(target(name)?),
        }
    }
    let mut seen = std::collections::HashSet::new();
    targets.retain(|target| seen.insert(*target));
    Ok(targets)
}

fn target(name: &str) -> Result<Target> {
    let known = Target::ALL.into_iter().find(|target| target.name() == name);
    known.ok_or_else(|| {
        let cases = Code::ALL.map(Code::name);
        Error::not_one_of(
            "--to",
            name,
            Target::ALL.map(Target::name).iter().chain(&cases),
        )
    })
}

/// Help of `--to`.
fn to_help() -> String {
    let names = Target::ALL.map(|target| format!("`{target}`"));
    let codes = Code::ALL.map(|code| format!("`{}`", code.name()));
    format!(
        "Targets: {}; several separated by commas, or `{ALL}`; of a case: {}",
        names.join(", "),
        codes.join(", ")
    )
}

fn form(text: &str) -> Result<Form> {
    Form::ALL
        .into_iter()
        .find(|form| form.name() == text)
        .ok_or_else(|| Error::not_one_of("--form", text, Form::ALL.map(Form::name)))
}

fn scratch() -> Result<tempfile::TempDir> {
    let folder = std::path::Path::new("temporary folder");
    tempfile::tempdir().map_err(Error::file("create", folder))
}

/// Run the check of a contact of two materials and print the table.
fn check_with(law: &Portable, other: &Portable) -> Result<Verdict> {
    let finding = check::series::check(law, other, scratch()?.path())?;
    verdict(&[("C, two materials", finding)])
}

/// Run the checks of the targets, of all where none is named, and print the table.
fn check_targets(law: &Portable, targets: &[Target], context: &Context) -> Result<Verdict> {
    let targets = match targets {
        [] => &Target::ALL,
        targets => targets,
    };
    let holds = |target: &&Target| law.pair().is_none() || target.is_of_pairs();
    let targets = targets.iter().filter(holds);
    let checks: Vec<_> = targets.flat_map(|t| checks(*t)).collect();
    if checks.is_empty() {
        tracing::warn!("no program reads a table: there is nothing to check");
    }
    let bar = context.progress(checks.len() as u64, "check");
    let mut findings = Vec::new();
    for check in &checks {
        findings.push((check.name(), check.run(law, scratch()?.path())?));
        bar.inc(1);
    }
    bar.finish_and_clear();
    verdict(&findings)
}

/// Prints the table; a deviation that is not allowed is a missed threshold.
fn verdict(findings: &[(&'static str, Finding)]) -> Result<Verdict> {
    print(&check::table(findings))?;
    let missed = findings.iter().any(|(_, finding)| match finding {
        Finding::Ran { agreements, .. } => agreements.iter().any(|a| !a.holds()),
        Finding::Skipped { .. } => false,
    });
    Ok(match missed {
        true => Verdict::Missed,
        false => Verdict::Met,
    })
}
