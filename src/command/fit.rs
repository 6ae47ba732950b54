//! `fit`: from the impacts of a case to its law file.

use super::{Command, Context, Verdict, check_writable, print};
use crate::case::Case;
use crate::curve::Impact;
use crate::fit::{INERTIA_GAIN, THRESHOLD, fit};
use crate::law::LawFile;
use crate::law::file::{LeftOutRow, QualityRow};
use crate::{Error, PROGRAM, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Fit a contact law to simulated impacts: `law.toml`.
#[derive(Debug, Args)]
pub struct FitArgs {
    /// Case file the impacts were made from.
    pub case: PathBuf,
    /// Folder that holds the `impact_V*` folders (default: `out/<case name>`).
    #[arg(short, long)]
    pub impacts: Option<PathBuf>,
    /// Law file to write (default: `law.toml` in that folder).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

impl Command for FitArgs {
    /// Run the verb: [`Verdict::Missed`] when the law is off by more than [`THRESHOLD`] somewhere.
    ///
    /// # Errors
    /// Those of reading the case and the impacts, of the fit, and of writing the law.
    fn run(&self, _context: &Context) -> Result<Verdict> {
        let case = Case::read(&self.case)?;
        check_normal(&case)?;
        let folder = self
            .impacts
            .clone()
            .unwrap_or_else(|| Path::new("out").join(&case.name));
        let target = self.out.clone().unwrap_or_else(|| folder.join("law.toml"));
        let impacts = read_impacts(&folder, &case)?;
        check_writable(target.parent().unwrap_or(Path::new(".")))?;
        let result = fit(&case, &impacts)?;
        for velocity in &result.skipped {
            tracing::warn!("the impact at {velocity} m/s did not rebound and is left out");
        }
        let file = LawFile::of(&result, &case, PROGRAM);
        file.write(&target)?;
        print(&table(&file, &target))?;
        if file.worst_error() <= THRESHOLD {
            return Ok(Verdict::Met);
        }
        let percent = 100.0 * file.worst_error();
        tracing::warn!(
            "the law misses a figure by {percent:.1} %, more than {:.0} %",
            100.0 * THRESHOLD
        );
        Ok(Verdict::Missed)
    }
}

/// Checks that the impacts of a case can be compared with a normal law.
///
/// # Errors
/// [`Error::Argument`] for an oblique impact or a wall with friction.
pub fn check_normal(case: &Case) -> Result<()> {
    if case.angle == 0.0 && case.friction == 0.0 {
        return Ok(());
    }
    Err(Error::Argument {
        argument: case.path.display().to_string(),
        found: "`impact.angle` or `wall.friction`".to_owned(),
        allowed: "a normal law is fitted to normal impacts on a frictionless wall; use `impact`"
            .to_owned(),
    })
}

/// Impacts in the folders `impact_V*` of `folder`, slowest first; a warning if they were made from another case file.
///
/// # Errors
/// [`Error::File`] when the folder cannot be read, [`Error::Argument`] when it holds none, and those of each file.
pub fn read_impacts(folder: &Path, case: &Case) -> Result<Vec<Impact>> {
    let entries = std::fs::read_dir(folder).map_err(Error::file("read", folder))?;
    let paths = entries
        .map(|entry| entry.map(|e| e.path()))
        .collect::<std::io::Result<Vec<PathBuf>>>()
        .map_err(Error::file("read", folder))?;
    let named = |p: &PathBuf| {
        let name = p.file_name().map(|n| n.to_string_lossy().into_owned());
        p.is_dir() && name.is_some_and(|n| n.starts_with("impact_V"))
    };
    let paths: Vec<PathBuf> = paths.into_iter().filter(named).collect();
    let mut impacts = paths
        .iter()
        .map(|p| Impact::read(p))
        .collect::<Result<Vec<_>>>()?;
    let foreign = |p: &&PathBuf| made_from_other(p, case);
    if let Some(path) = paths.iter().find(foreign) {
        tracing::warn!(
            "{} was made from another version of {} (its hash differs); if radius or material changed, repeat the impacts",
            path.display(),
            case.path.display()
        );
    }
    if impacts.is_empty() {
        return Err(Error::Argument {
            argument: "--impacts".to_owned(),
            found: folder.display().to_string(),
            allowed: "must hold folders `impact_V*`; make them with `impactlaw impact CASE`"
                .to_owned(),
        });
    }
    impacts.sort_by(|a, b| a.summary.velocity_m_s.total_cmp(&b.summary.velocity_m_s));
    Ok(impacts)
}

/// Does the provenance line of an impact's `curve.csv` name another case hash? Curves without one are taken as they are.
fn made_from_other(impact: &Path, case: &Case) -> bool {
    let text = std::fs::read_to_string(impact.join("curve.csv")).unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    let recorded = line.split_once("case sha256 ").map(|(_, rest)| rest);
    let hash = recorded.and_then(|rest| rest.split(';').next());
    hash.is_some_and(|hash| hash != case.hash)
}

/// What a person wants to see at once: errors in per cent, by form and speed.
fn table(file: &LawFile, target: &Path) -> String {
    let mut text = format!(
        "law {} -> {}\nerror, %         V m/s      F*  delta*       e     t_c | without this speed: F*  delta*       e\n",
        file.name,
        target.display()
    );
    if let Some(t) = &file.hertz {
        push_rows(&mut text, "hertz", &t.quality, &[]);
    }
    if let Some(t) = &file.closed_form {
        push_rows(&mut text, "closed form", &t.quality, &t.left_out);
    }
    if let Some(t) = &file.spline {
        push_rows(&mut text, "spline", &t.quality, &t.left_out);
    }
    push_inertia(&mut text, file);
    text
}

/// Whether the law has an inertia term, and if not, why.
fn push_inertia(text: &mut String, file: &LawFile) {
    let closed_form = file.closed_form.as_ref().map(|t| t.inertia);
    let spline = file.spline.as_ref().map(|t| t.inertia);
    let material = file.material();
    for (form, coefficient) in [("closed form", closed_form), ("spline", spline)] {
        let (Some(coefficient), Some(flow)) = (coefficient, material.flow) else {
            continue;
        };
        let group = material.density * file.valid.velocity_max_m_s.powi(2) / flow.yield_strength();
        let line = match coefficient {
            Some(kappa) => format!("{form:12} inertia {kappa:.2}\n"),
            None => format!(
                "{form:12} no inertia: up to rho V^2/Y = {group:.2e} it does not lower the largest error by {:.0} %\n",
                100.0 * INERTIA_GAIN
            ),
        };
        text.push_str(&line);
    }
}

fn push_rows(text: &mut String, form: &str, quality: &[QualityRow], left_out: &[LeftOutRow]) {
    for (i, q) in quality.iter().enumerate() {
        let figures = [
            q.max_force,
            q.max_displacement,
            q.restitution,
            q.contact_time,
        ];
        let [f, d, e, t] = figures.map(|x| 100.0 * x);
        text.push_str(&format!(
            "{form:12} {:9} {f:7.2} {d:7.2} {e:7.2} {t:7.2} |",
            q.velocity_m_s
        ));
        if let Some(l) = left_out.get(i) {
            let [f, d, e] = [l.max_force, l.max_displacement, l.restitution].map(|x| 100.0 * x);
            text.push_str(&format!(" {f:22.2} {d:7.2} {e:7.2}"));
        }
        text.push('\n');
    }
}
