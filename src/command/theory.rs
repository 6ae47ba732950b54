//! Command `theory`: force or restitution of a published law as CSV on standard output.

use super::{Command, Context, Verdict};
use crate::case::Case;
use crate::contact::rebound::Rebound;
use crate::contact::{LawVisitor, NormalLaw};
use crate::law::AnyLaw;
use crate::material::constant::Constant;
use crate::theory::adhesive::{ADHESIVE, AdhesiveModel, StickySphere};
use crate::theory::published::{Evidence, Publication, left_out};
use crate::theory::{FORMULAS, Theory};
use crate::unit::{self, Length, Velocity};
use crate::{Error, Result};
use clap::Args;
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Point of a force-displacement curve. Field names are the CSV header (file contract).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ForceRow {
    /// Displacement delta, m.
    pub displacement_m: f64,
    /// Force F, N.
    #[serde(rename = "force_N")]
    pub force_n: f64,
    /// Contact radius, m; empty where the law states none.
    pub contact_radius_m: Option<f64>,
}

/// Point of a restitution curve. Field names are the CSV header (file contract).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RestitutionRow {
    /// Impact speed V, m/s.
    pub velocity_m_s: f64,
    /// e from the law, integrated; empty for a theory without a force law.
    pub restitution: Option<f64>,
    /// e from the authors' formula; empty where there is none or it does not hold.
    pub restitution_closed_form: Option<f64>,
}

/// Evaluate a theory: force against displacement, or restitution against velocity, as CSV.
#[derive(Debug, Args)]
pub struct TheoryArgs {
    /// Print every model: name, papers, what it needs, what it is.
    #[arg(long, exclusive = true)]
    pub list: bool,
    /// Model name, one of `--list`, e.g. `thornton`.
    #[arg(required_unless_present = "list")]
    pub model: Option<String>,
    /// Case file: radius and material.
    #[arg(required_unless_present = "list")]
    pub case: Option<PathBuf>,
    /// Displacements with units, e.g. `"1 um"`; prints `displacement_m,force_N,contact_radius_m`. Adhesive models pull at
    /// negative ones, too: `--displacements="-1 nm"`.
    #[arg(long, num_args = 1.., value_delimiter = ',')]
    pub displacements: Vec<String>,
    /// Largest displacement reached before: the displacements lie on the unloading branch.
    #[arg(long)]
    pub max_displacement: Option<String>,
    /// Speeds with units; prints `velocity_m_s,restitution`.
    #[arg(long, num_args = 1.., value_delimiter = ',', conflicts_with = "displacements")]
    pub velocities: Vec<String>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for TheoryArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw theory --list",
        r#"impactlaw theory thornton cases/thesis-4-4.toml --velocities "1 m/s" "10 m/s""#,
        r#"impactlaw theory hertz cases/thesis-4-4.toml --displacements "1 um" --max-displacement "2 um""#,
    ];

    /// Print the table the arguments ask for.
    ///
    /// # Errors
    /// [`Error::Argument`] for an unknown theory, a quantity without unit or out of range, or nothing to evaluate; what
    /// [`Case::read`] returns.
    fn run(&self, _context: &Context) -> Result<Verdict> {
        match (&self.model, &self.case) {
            (Some(model), Some(case)) => {
                let case = Case::read(case)?;
                if let Some(model) = adhesive(model) {
                    super::print(&adhesive_table(self, &model, &case)?)?;
                    return Ok(Verdict::Met);
                }
                case.of_a_normal_impact("a theory")?;
                let publication = match formula(model) {
                    Some(formula) => formula,
                    None => model.parse::<Theory>()?.publication(),
                };
                if publication.evidence == Evidence::Unverified {
                    tracing::warn!("{}: its constants are unverified", publication.name);
                }
                for sentence in left_out([publication], &case.material) {
                    tracing::warn!("{sentence}");
                }
                super::print(&table(self, &case)?)?;
            }
            _ => super::print(&list())?,
        }
        Ok(Verdict::Met)
    }
}

/// Every model with its papers, what it needs and what it is, as text.
#[must_use]
pub fn list() -> String {
    let laws = Theory::ALL.map(|theory| (theory.publication(), "force"));
    let formulas = FORMULAS.map(|formula| (formula, "no force"));
    let mut text = String::new();
    for (model, gives) in laws.into_iter().chain(formulas) {
        let constants: Vec<String> = model.flow.iter().map(Constant::name).collect();
        let needs = match constants.is_empty() {
            true => "needs no yield strength".to_owned(),
            false => format!("needs a {}", constants.join(", a ")),
        };
        let closed = match model.restitution {
            Some(_) => ", restitution in closed form",
            None => "",
        };
        let _ = writeln!(text, "{:<22}{}", model.name, model.papers.join(", "));
        let _ = writeln!(text, "{:<22}{}", "", model.summary);
        let _ = writeln!(text, "{:<22}{needs}; gives {gives}{closed}", "");
    }
    for model in ADHESIVE {
        let needs = match (model.needs_range, model.needs_yield) {
            (true, _) => "needs a work of adhesion with its range",
            (_, true) => "needs a work of adhesion, a yield strength",
            _ => "needs a work of adhesion",
        };
        let gives = match (model.force, model.restitution) {
            (Some(_), Some(_)) => "force, restitution in closed form",
            (Some(_), None) => "force",
            (None, _) => "no force, restitution in closed form",
        };
        let _ = writeln!(text, "{:<22}{}", model.name, model.papers.join(", "));
        let _ = writeln!(text, "{:<22}{}", "", model.summary);
        let _ = writeln!(text, "{:<22}{needs}; gives {gives}", "");
    }
    text
}

/// Adhesive model of this name.
fn adhesive(name: &str) -> Option<AdhesiveModel> {
    ADHESIVE.into_iter().find(|model| model.name == name)
}

/// The CSV text of an adhesive model: of a contact that is pulled off, or of impacts.
fn adhesive_table(args: &TheoryArgs, model: &AdhesiveModel, case: &Case) -> Result<String> {
    let adhesion = case.of_a_normal_adhesive_impact(model.name)?;
    let missing = |key: &str| Error::Refused {
        what: format!("{}: `{key}`", case.path.display()),
        found: "none".to_owned(),
        allowed: format!("must be given: {} needs it", model.name),
    };
    if model.needs_range && adhesion.range.is_none() {
        return Err(missing("wall.adhesion_range"));
    }
    if model.needs_yield && case.material.flow.is_none() {
        return Err(missing("material.yield_strength"));
    }
    if model.evidence == Evidence::Unverified {
        tracing::warn!("{}: its equations are unverified", model.name);
    }
    let sphere = StickySphere {
        material: case.material,
        radius: case.radius,
        adhesion,
    };
    let refused = |argument: &str, found: &str, allowed: &str| {
        Err(Error::Argument {
            argument: argument.to_owned(),
            found: found.to_owned(),
            allowed: allowed.to_owned(),
        })
    };
    if args.max_displacement.is_some() {
        let allowed = "must be left out: an elastic contact has one branch, the one on which it is pulled off";
        return refused("--max-displacement", model.name, allowed);
    }
    if !args.displacements.is_empty() {
        let Some(force) = model.force else {
            let allowed = "this theory gives restitution only; use --velocities";
            return refused("--displacements", model.name, allowed);
        };
        let all = quantities::<Length>("--displacements", &args.displacements, false)?;
        let row = |displacement_m: f64| {
            let found = force(&sphere, displacement_m);
            ForceRow {
                displacement_m,
                force_n: found.map_or(0.0, |[force, _]| force),
                contact_radius_m: found.map(|[_, radius]| radius),
            }
        };
        let rows: Vec<ForceRow> = all.into_iter().map(row).collect();
        return rows_text(args.json, &rows);
    }
    let Some(restitution) = model.restitution else {
        let allowed = "this theory gives a force only; use --displacements";
        return refused("--velocities", model.name, allowed);
    };
    let all = quantities::<Velocity>("--velocities", &args.velocities, true)?;
    if all.is_empty() {
        let allowed = "give one, e.g. --displacements \"1 um\" or --velocities \"10 m/s\"";
        return refused(
            "theory",
            "neither --displacements nor --velocities",
            allowed,
        );
    }
    let row = |velocity_m_s: f64| RestitutionRow {
        velocity_m_s,
        restitution: None,
        restitution_closed_form: Some(restitution(&sphere, velocity_m_s)),
    };
    let rows: Vec<RestitutionRow> = all.into_iter().map(row).collect();
    rows_text(args.json, &rows)
}

/// The CSV text for a case that has been read.
///
/// # Errors
/// As [`Command::run`], the case file apart.
pub fn table(args: &TheoryArgs, case: &Case) -> Result<String> {
    match (args.displacements.is_empty(), args.velocities.is_empty()) {
        (false, _) => rows_text(args.json, &force_rows(args, case)?),
        (true, false) => rows_text(args.json, &restitution_rows(args, case)?),
        (true, true) => Err(Error::Argument {
            argument: "theory".to_owned(),
            found: "neither --displacements nor --velocities".to_owned(),
            allowed: "give one, e.g. --displacements \"1 um\" or --velocities \"10 m/s\""
                .to_owned(),
        }),
    }
}

/// Published model of this name that gives a restitution only.
fn formula(name: &str) -> Option<Publication> {
    FORMULAS.into_iter().find(|formula| formula.name == name)
}

fn force_rows(args: &TheoryArgs, case: &Case) -> Result<Vec<ForceRow>> {
    let model = args.model.as_deref().unwrap_or_default();
    if formula(model).is_some() {
        return Err(Error::Argument {
            argument: "--displacements".to_owned(),
            found: model.to_owned(),
            allowed: "this theory gives restitution only; use --velocities".to_owned(),
        });
    }
    let theory: Theory = model.parse()?;
    let displacements = quantities::<Length>("--displacements", &args.displacements, false)?;
    let peak = args
        .max_displacement
        .as_slice()
        .iter()
        .map(|text| quantity::<Length>("--max-displacement", text, true))
        .next()
        .transpose()?;
    let radius = case.radius;
    theory.visit(
        &case.material,
        Forces {
            theory,
            radius,
            displacements: &displacements,
            peak,
        },
    )
}

/// Evaluates forces at displacements, each from the same history.
struct Forces<'a> {
    theory: Theory,
    radius: f64,
    displacements: &'a [f64],
    peak: Option<f64>,
}

impl LawVisitor for Forces<'_> {
    type Output = Vec<ForceRow>;

    fn visit<L: NormalLaw>(self, law: &L) -> Vec<ForceRow> {
        let mut start = L::History::default();
        if let Some(peak) = self.peak {
            law.force(peak / self.radius, &mut start);
        }
        let largest = self
            .displacements
            .iter()
            .copied()
            .fold(self.peak.unwrap_or(0.0), f64::max);
        if largest > law.valid_to() * self.radius {
            let supported = law.valid_to() * self.radius;
            tracing::warn!(
                "{}: displacements above {supported:.3e} m are beyond what its source supports",
                self.theory
            );
        }
        let row = |&displacement: &f64| {
            let (x, mut history) = (displacement / self.radius, start);
            ForceRow {
                displacement_m: displacement,
                force_n: law.force(x, &mut history) * self.radius * self.radius,
                contact_radius_m: law.contact_radius(x, &history).map(|a| a * self.radius),
            }
        };
        self.displacements.iter().map(row).collect()
    }
}

fn restitution_rows(args: &TheoryArgs, case: &Case) -> Result<Vec<RestitutionRow>> {
    let velocities = quantities::<Velocity>("--velocities", &args.velocities, true)?;
    let material = &case.material;
    let model = args.model.as_deref().unwrap_or_default();
    if let Some(formula) = formula(model) {
        let row = |velocity_m_s| RestitutionRow {
            velocity_m_s,
            restitution: None,
            restitution_closed_form: formula
                .restitution
                .and_then(|restitution| restitution(material, velocity_m_s)),
        };
        return Ok(velocities.into_iter().map(row).collect());
    }
    let theory: Theory = model.parse()?;
    let law = AnyLaw::Theory(theory, *material);
    let mass = material.sphere_mass(case.radius);
    let integrated = law.rebounds(case.radius, mass, &velocities)?;
    let row = |(velocity_m_s, rebound): (f64, Rebound)| RestitutionRow {
        velocity_m_s,
        restitution: Some(rebound.restitution),
        restitution_closed_form: theory.restitution_closed_form(material, velocity_m_s),
    };
    Ok(velocities
        .iter()
        .copied()
        .zip(integrated)
        .map(row)
        .collect())
}

fn quantities<D: unit::Dimension>(
    name: &str,
    texts: &[String],
    positive: bool,
) -> Result<Vec<f64>> {
    texts
        .iter()
        .map(|text| quantity::<D>(name, text, positive))
        .collect()
}

fn quantity<D: unit::Dimension>(name: &str, text: &str, positive: bool) -> Result<f64> {
    let value = unit::argument::<D>(name, text)?;
    if positive && value <= 0.0 {
        return Err(Error::Argument {
            argument: name.to_owned(),
            found: format!("\"{text}\""),
            allowed: "must be positive".to_owned(),
        });
    }
    Ok(value)
}

/// Rows as CSV or, if wanted, as JSON.
pub(super) fn rows_text<R: Serialize>(json: bool, rows: &[R]) -> Result<String> {
    match json {
        true => json_text(rows),
        false => csv_text(rows),
    }
}

fn json_text<R: Serialize>(rows: &[R]) -> Result<String> {
    let text = serde_json::to_string_pretty(rows);
    let text = text.map_err(|e| Error::file("write", Path::new("standard output"))(e.into()))?;
    Ok(text + "\n")
}

fn csv_text<R: Serialize>(rows: &[R]) -> Result<String> {
    let out = Path::new("standard output");
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .map_err(|e| Error::file("write", out)(e.into()))?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|e| Error::file("write", out)(e.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
