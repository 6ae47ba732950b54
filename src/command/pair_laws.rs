//! Laws of a pair of bodies: that of a file, and what can be had without an impact of the pair.

use crate::case::pair::PairCase;
use crate::compare::Comparison;
use crate::contact::{LawVisitor, NormalLaw};
use crate::curve::Particle;
use crate::law::pair::PairTable;
use crate::law::series::Series;
use crate::law::{ATLAS, AnyLaw, FittedLaw, LawFile, PairLaw};
use crate::material::Material;
use crate::theory::hertz::Hertz;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Name of two flattenings in series in tables and figures.
pub const SERIES: &str = "series";
/// Name of the atlas' law of the sphere that stands for both bodies.
pub const EFFECTIVE: &str = "effective";

/// The law of the pair in a file, which must be of the bodies of the case.
///
/// # Errors
/// Those of [`PairLaw::read`]; [`Error::Argument`] for the law of other bodies, [`Error::Refused`] for the atlas.
pub fn law_of_pair(path: &Path, pair: &PairCase) -> Result<PairLaw> {
    if path == Path::new(ATLAS) {
        return Err(Error::Refused {
            what: "--law".to_owned(),
            found: format!("`{ATLAS}`"),
            allowed: "must be the law file of the pair: the atlas has laws of one material on a rigid wall, which are compared in series (`--series`)".to_owned(),
        });
    }
    let law = PairLaw::read(path)?;
    let differences = law.bodies().differences(&PairTable::of(pair));
    match differences.is_empty() {
        true => Ok(law),
        false => Err(Error::Argument {
            argument: path.display().to_string(),
            found: differences.join(", "),
            allowed: format!(
                "must be a law of the bodies of {}",
                pair.particle.path.display()
            ),
        }),
    }
}

/// Laws of a pair that take no impact of it, each with its name, or the sentence that says why it is not there.
pub struct Shortcuts(Vec<(&'static str, std::result::Result<AnyLaw, String>)>);

impl Shortcuts {
    /// Adds the laws to a comparison, and what is to be said of those that are not there.
    pub fn add_to(&self, comparison: &mut Comparison) -> Result<()> {
        for (name, law) in &self.0 {
            match law {
                Ok(law) => law.visit(Added(comparison, name))?,
                Err(why) => {
                    tracing::warn!("{why}");
                    comparison.note(why);
                }
            }
        }
        Ok(())
    }

    /// Those that are there, under their names.
    pub fn laws(&self) -> impl Iterator<Item = (&'static str, &AnyLaw)> {
        self.0
            .iter()
            .filter_map(|(name, law)| Some((*name, law.as_ref().ok()?)))
    }
}

/// Adds the visited law under a name.
struct Added<'a>(&'a mut Comparison, &'static str);

impl LawVisitor for Added<'_> {
    type Output = ();

    fn visit<L: NormalLaw>(self, law: &L) {
        self.0.add(self.1, law);
    }
}

/// Shortcuts to the law of a pair: the laws of the two materials in series, which are those of `files`, where given, else those of the
/// atlas, Hertz's of a material that does not yield; and the atlas' law of the sphere that stands for both. What is not in the atlas, where
/// nothing was named, is no error.
///
/// # Errors
/// Those of each file; [`Error::Argument`] for the law of another material; of the atlas where it was named.
pub fn shortcuts(pair: &PairCase, files: Option<&[PathBuf]>) -> Result<Shortcuts> {
    let effective = of_material(&pair.effective().material, None).map_err(|error| {
        format!("`{EFFECTIVE}` is left out: the atlas has no law of the sphere that stands for both ({error}).")
    });
    Ok(Shortcuts(vec![
        (SERIES, in_series(pair, files)?),
        (EFFECTIVE, effective.map(AnyLaw::Fitted)),
    ]))
}

fn in_series(
    pair: &PairCase,
    files: Option<&[PathBuf]>,
) -> Result<std::result::Result<AnyLaw, String>> {
    let bodies = [
        ("particle", &pair.particle.material),
        ("second body", &pair.target.material),
    ];
    let mut laws = Vec::new();
    for (i, (whose, material)) in bodies.into_iter().enumerate() {
        let named = files.map(|files| files[i].as_path());
        match of_material(material, named) {
            Ok(law) => laws.push(law),
            Err(error) if named.is_some() => return Err(error),
            Err(error) => {
                return Ok(Err(format!(
                    "`{SERIES}` is left out: the atlas has no law of the {whose} ({error}); `compare --series` takes law files."
                )));
            }
        }
    }
    let moduli = bodies.map(|(_, material)| material.contact_modulus());
    let [first, second] = [laws.remove(0), laws.remove(0)];
    let series = Series::new([first, second], moduli);
    Ok(Ok(AnyLaw::Series(Box::new(series))))
}

/// The law of a material on a rigid wall: of a file, or of the atlas.
fn of_material(material: &Material, named: Option<&Path>) -> Result<FittedLaw> {
    match named.filter(|path| *path != Path::new(ATLAS)) {
        None if material.flow.is_none() => Ok(FittedLaw::Hertz(Hertz::of(material))),
        None => LawFile::of_atlas(ATLAS, material, 1.0)?.law(),
        Some(path) => {
            let file = LawFile::read(path)?;
            let of = |material: &Material| Particle::of(material, 1.0);
            let differences = of(&file.material()).differences(&of(material));
            if !differences.is_empty() {
                return Err(Error::Argument {
                    argument: path.display().to_string(),
                    found: differences.join(", "),
                    allowed: "must be the law of the material of that body".to_owned(),
                });
            }
            file.law()
        }
    }
}
