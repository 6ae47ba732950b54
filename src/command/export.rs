//! `export`: a law file to the files of other codes, and the check that they hold the same law.

use super::{Context, Verdict, output_folder, print};
use crate::cli::ExportArgs;
use crate::export::check::{self, Finding};
use crate::export::portable::Portable;
use crate::export::{Artifact, Target, series};
use crate::files::write_atomic;
use crate::law::Form;
use crate::{Error, Result};
use std::fmt::Write;

/// Name of all targets together; those that cannot express the law are left out with a warning.
const ALL: &str = "all";

/// Run the verb.
///
/// # Errors
/// Those of the law file and the arguments, of a target that cannot express the law, and of writing.
pub fn run(args: &ExportArgs, context: &Context) -> Result<Verdict> {
    let targets = targets(&args.to, args.check)?;
    let form = args.form.as_deref().map(form).transpose()?;
    let law = Portable::read(&args.law, form)?;
    let other = args.with.as_deref();
    let other = other.map(|file| Portable::read(file, form)).transpose()?;
    let artifacts = match &other {
        Some(other) => with(&law, other, &targets)?,
        None => alone(&law, &targets, args.to.iter().any(|name| name == ALL))?,
    };
    if !targets.is_empty() {
        let folder = output_folder(args.out.as_deref(), &law.name)?;
        let folder = match args.out {
            Some(_) => folder,
            None => folder.join("export"),
        };
        let mut said = String::new();
        for artifact in &artifacts {
            let path = folder.join(&artifact.name);
            write_atomic(&path, artifact.text.as_bytes())?;
            let _ = writeln!(said, "{}", path.display());
        }
        print(&said)?;
    }
    match (args.check, &other) {
        (true, Some(other)) => check_with(&law, other),
        (true, None) => check_all(&law, context),
        (false, _) => Ok(Verdict::Met),
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
    if let Some(target) = targets.iter().find(|target| **target != Target::C) {
        return Err(Error::Argument {
            argument: "--with".to_owned(),
            found: format!("`--to {target}`"),
            allowed: "is for target c: the other targets hold one law".to_owned(),
        });
    }
    match targets.is_empty() {
        true => Ok(Vec::new()),
        false => series::export(law, other),
    }
}

/// Targets by name, once each; `all` is every one. None are needed with `--check`.
fn targets(names: &[String], check: bool) -> Result<Vec<Target>> {
    if names.is_empty() && !check {
        return Err(Error::Argument {
            argument: "--to".to_owned(),
            found: "nothing".to_owned(),
            allowed: format!(
                "name one or more of {}, or all; or give --check",
                Target::ALL.map(Target::name).join(", ")
            ),
        });
    }
    let mut targets = Vec::new();
    for name in names {
        match name.as_str() {
            ALL => targets.extend(Target::ALL),
            name => targets.push(name.parse()?),
        }
    }
    let mut seen = std::collections::HashSet::new();
    targets.retain(|target| seen.insert(*target));
    Ok(targets)
}

fn form(text: &str) -> Result<Form> {
    match text {
        "closed_form" => Ok(Form::ClosedForm),
        "spline" => Ok(Form::Spline),
        "hertz" => Ok(Form::Hertz),
        _ => Err(Error::Argument {
            argument: "--form".to_owned(),
            found: format!("`{text}`"),
            allowed: "must be one of closed_form, spline, hertz".to_owned(),
        }),
    }
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

/// Run every check and print the table.
fn check_all(law: &Portable, context: &Context) -> Result<Verdict> {
    let checks = check::all();
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
