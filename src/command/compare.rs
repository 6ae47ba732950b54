//! `compare`: from impacts and a law file to `compare.csv` and `compare.md`.

use super::fit::read_impacts;
use super::pair_laws::{law_of_pair, shortcuts};
use super::{Command, Context, Verdict, check_writable, print_json};
use crate::case::Case;
use crate::case::pair::{Asked, PairCase};
use crate::compare::Comparison;
use crate::contact::{LawVisitor, NormalLaw};
use crate::curve::Particle;
use crate::law::{ATLAS, Form, LawFile};
use crate::{Error, Result};
use clap::Args;
use std::path::{Path, PathBuf};

/// Compare a law and the theories with simulated impacts: `compare.csv`, table, plots.
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// Case file the impacts were made from.
    pub case: PathBuf,
    /// Law file, or `atlas` for the law of the atlas (default: `law.toml` in the impacts' folder).
    #[arg(short, long)]
    pub law: Option<PathBuf>,
    /// Folder that holds the `impact_V*` folders (default: `out/<case name>`).
    #[arg(short, long)]
    pub impacts: Option<PathBuf>,
    /// Output folder (default: the impacts' folder; `compare-NAME` in it for a law that is not the one there).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Of a pair: laws of the particle's and of the second body's material, which are compared in series: law files, or `atlas` (default:
    /// those of the atlas; Hertz's of what does not yield).
    #[arg(long, num_args = 2, value_names = ["PARTICLE", "TARGET"])]
    pub series: Option<Vec<PathBuf>>,
    /// Compare the theories too whose constants are unverified.
    #[arg(long)]
    pub unverified: bool,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for CompareArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw compare cases/thesis-4-4.toml",
        "impactlaw compare cases/thesis-4-4.toml --law atlas",
        "impactlaw compare cases/thesis-4-4.toml --law models/elastic-perfectly-plastic-ey80.toml",
        "impactlaw compare cases/steel-ball-on-plate.toml --series atlas atlas",
    ];

    /// Run the verb: write both files and print the summary over all speeds.
    ///
    /// # Errors
    /// Those of reading the case, the impacts and the law, and of writing the files.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let asked = Asked::read(&self.case)?;
        let case = asked.particle();
        case.of_a_normal_impact("a comparison with laws of spheres")?;
        let folder = self
            .impacts
            .clone()
            .unwrap_or_else(|| Path::new("out").join(&case.name));
        let law = self.law.clone().unwrap_or_else(|| folder.join("law.toml"));
        if self.law.is_none() && !law.exists() {
            return Err(Error::Refused {
                what: law.display().to_string(),
                found: "no such file".to_owned(),
                allowed: format!(
                    "must be there: `impactlaw run {}` makes it, or --law names another (`--law atlas` needs no file), or --impacts the folder of the impacts",
                    super::quoted(&self.case.to_string_lossy())
                ),
            });
        }
        match &asked {
            Asked::RigidWall(case) => self.of_one(case, &law, folder, context),
            Asked::Pair(pair) => self.of_pair(pair, &law, folder, context),
        }
    }
}

impl CompareArgs {
    /// Compare the law of one material.
    fn of_one(
        &self,
        case: &Case,
        law: &Path,
        folder: PathBuf,
        context: &Context,
    ) -> Result<Verdict> {
        if self.series.is_some() {
            return Err(Error::Argument {
                argument: "--series".to_owned(),
                found: "a case of a rigid wall".to_owned(),
                allowed: "is for two deformable bodies, a case with `[wall.material]`".to_owned(),
            });
        }
        let from_atlas = law == Path::new(ATLAS);
        let file = match from_atlas {
            true => LawFile::of_atlas(&case.name, &case.material, case.radius)?,
            false => LawFile::read(law)?,
        };
        let impacts = read_impacts(&folder, case, None)?;
        let (out, provenance) = self.place(law, folder, context.provenance(&case.hash))?;
        check_writable(&out)?;
        // a law serves bodies of every radius, but of its own material only
        let of_law = Particle::of(&file.material(), case.radius);
        let differences = of_law.differences(&Particle::of(&case.material, case.radius));
        if !differences.is_empty() {
            return Err(Error::Argument {
                argument: law.display().to_string(),
                found: differences.join(", "),
                allowed: format!("must be a law of the material of {}", case.path.display()),
            });
        }
        context.open_log(&out, "compare", &case.hash);
        let mut comparison = Comparison::new(&case.material, case.radius, &impacts);
        match from_atlas {
            true => file.law()?.visit(Added(&mut comparison, ATLAS)),
            false => add_fitted(&mut comparison, &file)?,
        }
        self.finish(comparison, &out, &provenance, context)
    }

    /// Compare the law of a pair, the series of two laws, and the theories that are stated for two bodies.
    fn of_pair(
        &self,
        pair: &PairCase,
        law: &Path,
        folder: PathBuf,
        context: &Context,
    ) -> Result<Verdict> {
        let case = &pair.particle;
        let file = law_of_pair(law, pair)?;
        let shortcuts = shortcuts(pair, self.series.as_deref())?;
        let impacts = read_impacts(&folder, case, Some(&pair.target))?;
        let (out, provenance) = self.place(law, folder, context.provenance(&case.hash))?;
        check_writable(&out)?;
        context.open_log(&out, "compare", &case.hash);
        let mut comparison = Comparison::of_pair(file.bodies(), &impacts);
        add_fitted(&mut comparison, file.file())?;
        shortcuts.add_to(&mut comparison)?;
        self.finish(comparison, &out, &provenance, context)
    }

    /// Add the theories, write both files and say what was found.
    fn finish(
        &self,
        mut comparison: Comparison,
        out: &Path,
        provenance: &str,
        context: &Context,
    ) -> Result<Verdict> {
        comparison.add_theories(self.unverified);
        write(&comparison, out, provenance)?;
        match self.json {
            true => print_json(comparison.rows())?,
            false => context.say(&comparison.summary_markdown())?,
        }
        Ok(Verdict::Met)
    }

    /// Output folder, and what stands on top of its files.
    fn place(&self, law: &Path, impacts: PathBuf, provenance: String) -> Result<(PathBuf, String)> {
        if let Some(out) = &self.out {
            return Ok((out.clone(), provenance));
        }
        if !is_another(law, &impacts.join("law.toml")) {
            return Ok((impacts, provenance));
        }
        // what was written of the case's own law, and what the report says of it, stays
        let name = law.file_stem().unwrap_or_default().to_string_lossy();
        let out = impacts.join(format!("compare-{name}"));
        let of = law.canonicalize().unwrap_or_else(|_| law.to_owned());
        let of = of.to_string_lossy();
        check_unused(&out, &of)?;
        Ok((out, format!("{provenance}{OF_LAW}{of}")))
    }
}

/// What stands before the law in the provenance of a comparison with a law from elsewhere.
const OF_LAW: &str = "; law ";

/// That the folder of a comparison holds none with another law of the same name.
fn check_unused(out: &Path, law: &str) -> Result<()> {
    let table = out.join("compare.csv");
    let text = std::fs::read_to_string(table).unwrap_or_default();
    let first = text.lines().next().unwrap_or_default();
    match first.rsplit_once(OF_LAW) {
        Some((_, there)) if there != law => Err(Error::Argument {
            argument: "--law".to_owned(),
            found: law.to_owned(),
            allowed: format!(
                "{} holds the comparison with {there}, a law of the same file name: --out names another folder",
                out.display()
            ),
        }),
        _ => Ok(()),
    }
}

/// Whether a law file is another than the one that is there.
fn is_another(law: &Path, own: &Path) -> bool {
    match (law.canonicalize(), own.canonicalize()) {
        (Ok(law), Ok(own)) => law != own,
        (_, Err(_)) => false,
        (Err(_), Ok(_)) => true,
    }
}

/// Write the comparison's files, and warn of what the theories in it leave out of the material.
///
/// # Errors
/// As [`Comparison::write`].
pub fn write(comparison: &Comparison, out: &Path, provenance: &str) -> Result<()> {
    for sentence in comparison.left_out_by_theories() {
        tracing::warn!("{sentence}");
    }
    comparison.write(out, provenance)
}

/// Add the law of a file: `fitted` in the form the file names, and `fitted-closed-form` or `fitted-spline` for the
/// other form.
///
/// # Errors
/// As [`LawFile::law`].
pub fn add_fitted(comparison: &mut Comparison, file: &LawFile) -> Result<()> {
    file.law()?.visit(Added(comparison, "fitted"));
    let others = [
        (
            Form::ClosedForm,
            "fitted-closed-form",
            file.closed_form.is_some(),
        ),
        (Form::Spline, "fitted-spline", file.spline.is_some()),
    ];
    for (form, name, present) in others {
        if present && form != file.form {
            file.law_in(form)?.visit(Added(comparison, name));
        }
    }
    Ok(())
}

/// Adds the visited law under a name.
struct Added<'a>(&'a mut Comparison, &'static str);

impl LawVisitor for Added<'_> {
    type Output = ();

    fn visit<L: NormalLaw>(self, law: &L) {
        self.0.add(self.1, law);
    }
}
