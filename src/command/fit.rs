//! `fit`: from the impacts of a case to its law file.

use super::{Command, Context, Verdict, check_writable, impact_folder, print_json};
use crate::case::Case;
use crate::case::pair::{Asked, Target};
use crate::curve::{Impact, Particle};
use crate::document::Document;
use crate::fit::{INERTIA_GAIN, check_pair, fit, fit_pair};
use crate::law::file::{LeftOutRow, QualityRow, plain};
use crate::law::pair::PairTable;
use crate::law::{LawFile, PairLaw};
use crate::unit::engineering;
use crate::{Error, PROGRAM, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Fit a contact law to simulated impacts, of a material or of a pair of bodies: `law.toml`.
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
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for FitArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw fit cases/thesis-4-4.toml",
        "impactlaw fit cases/thesis-4-4.toml --impacts out/thesis-4-4 --out steel.toml",
        "impactlaw fit cases/steel-ball-on-plate.toml",
    ];

    /// Run the verb: [`Verdict::Missed`] when the law is off by more than its threshold somewhere.
    ///
    /// # Errors
    /// Those of reading the case and the impacts, of the fit, and of writing the law.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let asked = Asked::read(&self.case)?;
        check_asked(&asked)?;
        let case = asked.particle();
        let folder = self
            .impacts
            .clone()
            .unwrap_or_else(|| Path::new("out").join(&case.name));
        let target = self.out.clone().unwrap_or_else(|| folder.join("law.toml"));
        check_target(&target, case, asked.pair().map(PairTable::of).as_ref())?;
        let impacts = read_impacts(&folder, case, asked.pair().map(|pair| &pair.target))?;
        let here = |folder: &&Path| !folder.as_os_str().is_empty();
        let folder = target.parent().filter(here).unwrap_or(Path::new("."));
        check_writable(folder)?;
        context.open_log(folder, "fit", &case.hash);
        let file = match &asked {
            Asked::RigidWall(case) => LawFile::of(&fit(case, &impacts)?, case, PROGRAM),
            Asked::Pair(pair) => PairLaw::of(&fit_pair(pair, &impacts)?, pair, PROGRAM).into_file(),
        };
        file.write(&target)?;
        match self.json {
            true => print_json(&file)?,
            false => context.say(&table(&file, &target))?,
        }
        Ok(verdict(&file))
    }
}

/// Says what there is to know of a law; [`Verdict::Missed`], with its reason, when it is off by more than its threshold.
pub fn verdict(file: &LawFile) -> Verdict {
    for warning in &file.warnings {
        tracing::warn!("{warning}");
    }
    if file.worst_error() <= file.threshold() {
        return Verdict::Met;
    }
    tracing::warn!(
        "the law misses a figure by {:.1} %, more than the {:.2} % of its case's tolerance",
        100.0 * file.worst_error(),
        100.0 * file.threshold()
    );
    Verdict::Missed
}

/// That a law of `case`, or of the `pair` of bodies it is of, may be written to `target`: nothing stands there, or an earlier law of the
/// same case.
///
/// # Errors
/// [`Error::Argument`] naming whose law, or that no law, stands there.
pub fn check_target(target: &Path, case: &Case, pair: Option<&PairTable>) -> Result<()> {
    if !target.exists() {
        return Ok(());
    }
    let refuse = |found: String| Error::Argument {
        argument: target.display().to_string(),
        found,
        allowed: "it is not overwritten; give another file with `--out`, or remove it".to_owned(),
    };
    let Ok(there) = Document::read(target).and_then(|document| LawFile::parse_any(&document))
    else {
        return Err(refuse("a file that is no law of this version".to_owned()));
    };
    if there.provenance.case != plain(&case.name) {
        return Err(refuse(format!(
            "the law of another case, {}",
            there.provenance.case
        )));
    }
    let differences = match (&there.pair, pair) {
        (Some(before), Some(now)) => before.differences(now),
        (None, None) => {
            let before = Particle::of(&there.material(), there.provenance.radius_m);
            before.differences(&Particle::of(&case.material, case.radius))
        }
        (Some(before), None) => vec![format!("{} instead of a rigid wall", before.bodies())],
        (None, Some(now)) => vec![format!("a rigid wall instead of {}", now.bodies())],
    };
    if !differences.is_empty() {
        tracing::warn!(
            "{} replaces a law of case {} with {}",
            target.display(),
            case.name,
            differences.join(", ")
        );
    }
    Ok(())
}

/// Checks that a normal law can be made of the impacts of what was asked.
///
/// # Errors
/// As [`check_case`]; of a pair for a flow stress of either body that depends on the size.
pub fn check_asked(asked: &Asked) -> Result<()> {
    match asked {
        Asked::RigidWall(case) => check_case(case),
        Asked::Pair(pair) => check_pair(pair),
    }
}

/// Checks that a normal law can be made of the impacts of a case.
///
/// # Errors
/// [`Error::Refused`] for what is no sphere, for an oblique impact, a wall with friction, and a flow stress that depends on the size.
pub fn check_case(case: &Case) -> Result<()> {
    case.of_a_normal_impact("a law")?;
    crate::fit::check_material(&case.material)
}

/// Impacts of the case in `folder`, slowest first: those of its speeds, of its own material and radius, on its own `target`, or on a
/// rigid wall where it has none. Folders of other speeds are left out by name, and speeds without a folder are named.
///
/// # Errors
/// [`Error::Argument`] when an impact of one of its speeds is another particle's or on another wall, or when there is none; and those of
/// each file.
pub fn read_impacts(folder: &Path, case: &Case, target: Option<&Target>) -> Result<Vec<Impact>> {
    let mut impacts = Vec::new();
    let mut missing = Vec::new();
    for &velocity in &case.velocities {
        let path = impact_folder(folder, velocity);
        if !path.join("summary.json").is_file() {
            missing.push(format!("{velocity} m/s"));
            continue;
        }
        let impact = match target {
            None => Impact::read(&path)?,
            Some(_) => Impact::read_any(&path)?,
        };
        check_owner(&impact, &path, velocity, case, target)?;
        impacts.push(impact);
    }
    if impacts.is_empty() {
        return Err(Error::Argument {
            argument: "--impacts".to_owned(),
            found: folder.display().to_string(),
            allowed: format!(
                "must hold a folder `impact_V*` of one of the case's speeds ({}); make them with `impactlaw impact {}`",
                missing.join(", "),
                case.path.display()
            ),
        });
    }
    if !missing.is_empty() {
        tracing::warn!(
            "{} has no impacts at {}; make them with `impactlaw impact {}`",
            folder.display(),
            missing.join(", "),
            case.path.display()
        );
    }
    let others = other_speeds(folder, case)?;
    if !others.is_empty() {
        tracing::warn!(
            "left out, for their speeds are not the case's: {}",
            others.join(", ")
        );
    }
    Ok(impacts)
}

/// What of the wall of an impact is not as the case has it.
fn of_another_wall(impact: &Impact, target: Option<&Target>) -> Vec<String> {
    let (found, asked) = match (&impact.summary.target, target) {
        (None, None) => return Vec::new(),
        (Some(found), Some(asked)) => (found, asked),
        (None, Some(asked)) => {
            return vec![format!("a rigid wall instead of a {}", asked.shape.name())];
        }
        (Some(found), None) => {
            return vec![format!(
                "a deformable {} instead of a rigid wall",
                found.shape
            )];
        }
    };
    let of = |material: &crate::material::Material| Particle::of(material, 1.0);
    let mut all = of(&found.material.material()).differences(&of(&asked.material));
    let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a / b - 1.0).abs() < 1e-12,
        (a, b) => a == b,
    };
    let words = |shape: &str, length: Option<f64>| match length {
        Some(length) => format!("a {shape} of {}", engineering(length, "m", 6)),
        None => format!("a {shape}"),
    };
    let shape = asked.shape;
    let (own, other) = (shape.radius(), shape.thickness());
    if found.shape != shape.name() || !same(found.radius_m, own) || !same(found.thickness_m, other)
    {
        all.push(format!(
            "{} instead of {}",
            words(&found.shape, found.radius_m.or(found.thickness_m)),
            words(shape.name(), own.or(other))
        ));
    }
    all.iter().map(|what| format!("wall: {what}")).collect()
}

/// That an impact is of the case's particle, wall and speed.
fn check_owner(
    impact: &Impact,
    path: &Path,
    velocity: f64,
    case: &Case,
    target: Option<&Target>,
) -> Result<()> {
    let refuse = |found: String| {
        Err(Error::Argument {
            argument: path.display().to_string(),
            found,
            allowed: format!(
                "is not an impact of {}; repeat it with `impactlaw impact {}`, or name the folder of its own with `--impacts`",
                case.path.display(),
                case.path.display()
            ),
        })
    };
    let summary = &impact.summary;
    let Some(particle) = &summary.particle else {
        return refuse("an impact that does not say whose it is".to_owned());
    };
    let mut differences = particle.differences(&Particle::of(&case.material, case.radius));
    differences.extend(of_another_wall(impact, target));
    if !differences.is_empty() {
        return refuse(differences.join(", "));
    }
    let asked = case.method.map(|method| method.to_string());
    let made = summary.scheme.as_ref().map(|scheme| &scheme.settings);
    if made != asked.as_ref() {
        let own = "the crate's own scheme".to_owned();
        return refuse(format!(
            "an impact by {}; the case asks for {}",
            made.unwrap_or(&own),
            asked.as_ref().unwrap_or(&own)
        ));
    }
    if (summary.velocity_m_s / velocity - 1.0).abs() > 1e-12 {
        return refuse(format!("a speed of {} m/s", summary.velocity_m_s));
    }
    Ok(())
}

/// Names of the folders `impact_V*` of `folder` that no speed of the case has.
fn other_speeds(folder: &Path, case: &Case) -> Result<Vec<String>> {
    let own: Vec<_> = case
        .velocities
        .iter()
        .map(|velocity| impact_folder(folder, *velocity))
        .collect();
    let entries = std::fs::read_dir(folder).map_err(Error::file("read", folder))?;
    let mut names = Vec::new();
    for entry in entries {
        let path = entry.map_err(Error::file("read", folder))?.path();
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
        let is_impact = name.as_ref().is_some_and(|n| n.starts_with("impact_V"));
        if is_impact && path.is_dir() && !own.contains(&path) {
            names.extend(name);
        }
    }
    names.sort();
    Ok(names)
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
        let up_to = match file.pair {
            None => format!("up to rho V^2/Y = {group:.2e} "),
            // the density that stands for both bodies is none of a material
            Some(_) => String::new(),
        };
        let line = match coefficient {
            Some(kappa) => format!("{form:12} inertia {kappa:.2}\n"),
            None => format!(
                "{form:12} no inertia: {up_to}it does not lower the largest error by {:.0} %\n",
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
