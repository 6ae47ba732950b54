//! Materials of a scene: constants and the law of each, and the laws the scene is run under.

use super::at::check_name;
use crate::bed::scene::FITTED;
use crate::case::ElasticTable;
use crate::document::Document;
use crate::document::keys::{key, keys};
use crate::error::must_be_one_of;
use crate::law::{ATLAS, AnyLaw, LawFile};
use crate::material::Material;
use crate::material::flow::{FlowConstants, InText, WithFlow};
use crate::theory::Theory;
use crate::unit::{Density, Pressure, Quantity};
use crate::{Error, Result};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Name of the run in which every material has the law of its own table, where these differ.
pub const OWN: &str = "own";

/// Material as it is written; with a law file its constants may be left to that file.
pub(super) type SceneMaterialTable = WithFlow<ElasticAndLaw, InText>;

/// Its keys besides the constants of the flow stress.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ElasticAndLaw {
    density: Option<Quantity<Density>>,
    young_modulus: Option<Quantity<Pressure>>,
    poisson_ratio: Option<f64>,
    law: Option<String>,
}

keys! {
    ElasticAndLaw "Constants may be left to the law file that `law` names, all or none." {
        density: key("density", "> 0", "'2500 kg/m3'").or("of the law file"),
        young_modulus: key("Young's modulus", "> 0", "'70 GPa'").or("of the law file"),
        poisson_ratio: key("Poisson's ratio", "[0, 0.5)", "0.22").or("of the law file"),
        law: key("normal law of the material", "a law file, `\"fitted\"` (that of `--law`), `\"atlas\"` or a theory", "'hertz'").or("`laws` decides"),
    }
}

/// Law of one material.
#[derive(Debug, Clone, PartialEq)]
pub enum LawChoice {
    /// The scene's list `laws` decides.
    Listed,
    /// The law file given beside the scene.
    Given,
    /// A law file named in the scene, or the one that the atlas makes.
    File(Box<LawFile>),
    /// A theory.
    Theory(Theory),
}

/// A material of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct GrainMaterial {
    /// Name in the scene.
    pub name: String,
    /// Dotted key of its table.
    pub key: String,
    /// Constants.
    pub material: Material,
    /// Law.
    pub law: LawChoice,
}

/// Materials in the order of their names, from `[material]` or `[materials.NAME]`.
pub(super) fn check_materials(
    document: &Document,
    single: Option<SceneMaterialTable>,
    several: BTreeMap<String, SceneMaterialTable>,
) -> Result<Vec<GrainMaterial>> {
    match single {
        Some(table) if several.is_empty() => {
            let SceneMaterialTable { others, flow } = table;
            Ok(vec![others.check(&flow, document, "grains", "material")?])
        }
        Some(_) => Err(document.reject(
            "material",
            "must stand alone, or move to `[materials.NAME]` beside the others",
        )),
        None if several.is_empty() => Err(document.reject(
            "material",
            "must be there: `[material]` for one material, `[materials.NAME]` for several",
        )),
        None => several
            .into_iter()
            .map(|(name, table)| {
                let key = format!("materials.{name}");
                check_name(document, &key, &name)?;
                let SceneMaterialTable { others, flow } = table;
                others.check(&flow, document, &name, &key)
            })
            .collect(),
    }
}

impl ElasticAndLaw {
    fn check(
        self,
        flow: &FlowConstants<InText>,
        document: &Document,
        name: &str,
        key: &str,
    ) -> Result<GrainMaterial> {
        let from_atlas = self.law.as_deref() == Some(ATLAS);
        let mut law = match from_atlas {
            true => LawChoice::Listed,
            false => self.law(document, key)?,
        };
        let bare = self.density.is_none()
            && self.young_modulus.is_none()
            && self.poisson_ratio.is_none()
            && flow.is_empty();
        let material = match &law {
            LawChoice::File(file) if bare => file.material(),
            _ => {
                let missing = |constant: &str| {
                    document.reject(
                        &format!("{key}.{constant}"),
                        "must be there, or leave all constants to the law file that `law` names",
                    )
                };
                ElasticTable {
                    density: self.density.ok_or_else(|| missing("density"))?,
                    young_modulus: self.young_modulus.ok_or_else(|| missing("young_modulus"))?,
                    poisson_ratio: self.poisson_ratio.ok_or_else(|| missing("poisson_ratio"))?,
                }
                .check(flow, document, key)?
            }
        };
        if from_atlas {
            let file = from_the_atlas(document, &format!("{key}.law"), name, &material)?;
            law = LawChoice::File(Box::new(file));
        }
        let material = GrainMaterial {
            name: name.to_owned(),
            key: key.to_owned(),
            material,
            law,
        };
        material.check_law(document)?;
        Ok(material)
    }

    fn law(&self, document: &Document, key: &str) -> Result<LawChoice> {
        let Some(law) = self.law.as_deref() else {
            return Ok(LawChoice::Listed);
        };
        if law == FITTED {
            return Ok(LawChoice::Given);
        }
        if let Ok(theory) = law.parse::<Theory>() {
            return Ok(LawChoice::Theory(theory));
        }
        let key = format!("{key}.law");
        if !law.ends_with(".toml") {
            let names = Theory::ALL.map(Theory::name).join(", ");
            let allowed = format!(
                "must be a law file (\"../models/sac305-solder.toml\"), \"{FITTED}\", \"{ATLAS}\" or one of {names}"
            );
            return Err(document.reject(&key, allowed));
        }
        let file = LawFile::read(&document.resolve(law)).map_err(|error| match error {
            Error::File { path, source, .. } => document.reject(
                &key,
                format!(
                    "must name a law file that can be read: {}: {source}",
                    path.display()
                ),
            ),
            other => other,
        })?;
        Ok(LawChoice::File(Box::new(file)))
    }
}

/// Law file that the atlas makes for a material; what it refuses is said at `key`.
fn from_the_atlas(
    document: &Document,
    key: &str,
    name: &str,
    material: &Material,
) -> Result<LawFile> {
    LawFile::of_atlas(name, material, 1.0).map_err(|error| match error {
        Error::Refused {
            what,
            found,
            allowed,
        } => document.reject(
            key,
            format!("is not for this material: {what}, found {found}, {allowed}"),
        ),
        other => other,
    })
}

impl GrainMaterial {
    fn check_law(&self, document: &Document) -> Result<()> {
        let key = format!("{}.law", self.key);
        match &self.law {
            LawChoice::File(file) if file.material() != self.material => Err(document.reject(
                &key,
                "must be the law of this material; the file's constants differ: leave them to the file, or fit a law",
            )),
            LawChoice::Theory(theory) if !theory.applies_to(&self.material) => Err(document.reject(
                &key,
                format!(
                    "needs a `yield_strength` beside it; an elastic grain has the law {} only",
                    Theory::elastic('"')
                ),
            )),
            _ => Ok(()),
        }
    }

    /// Law of this material in the run called `run`; `given` is the law file beside the scene.
    ///
    /// # Errors
    /// [`Error::Refused`] where a fitted law is wanted and there is none for this material.
    pub fn law_in(&self, run: &str, given: Option<&LawFile>) -> Result<AnyLaw> {
        let theory = |theory| Ok(AnyLaw::Theory(theory, self.material));
        match (&self.law, run) {
            (LawChoice::Theory(own), OWN) => theory(*own),
            (_, FITTED | OWN) => self.fitted(given),
            (_, listed) => AnyLaw::named(listed, None, &self.material),
        }
    }

    fn fitted(&self, given: Option<&LawFile>) -> Result<AnyLaw> {
        let of_this = given.filter(|file| file.material() == self.material);
        let file = match &self.law {
            LawChoice::File(file) => Some(of_this.unwrap_or(file)),
            _ => of_this,
        };
        if let Some(file) = file {
            return Ok(AnyLaw::Fitted(file.law()?));
        }
        let found = match given {
            Some(_) => "a law of another material",
            None => "nothing",
        };
        Err(Error::Refused {
            what: "--law".to_owned(),
            found: found.to_owned(),
            allowed: format!(
                "must name a law file of `[{key}]`: the scene asks for the law \"{FITTED}\" (or name the file there as `law`)",
                key = self.key
            ),
        })
    }
}

/// Names of the runs: the list of the scene, or one run under the laws of the materials.
pub(super) fn check_laws(
    document: &Document,
    laws: Option<Vec<String>>,
    materials: &[GrainMaterial],
) -> Result<Vec<String>> {
    let Some(laws) = laws else {
        return own_laws(document, materials);
    };
    if laws.is_empty() {
        return Err(document.reject("laws", "must name at least one law, e.g. [\"hertz\"]"));
    }
    for (index, law) in laws.iter().enumerate() {
        let key = format!("laws[{index}]");
        if law != FITTED && law != ATLAS && law.parse::<Theory>().is_err() {
            let names = [FITTED, ATLAS].into_iter();
            let names = names.chain(Theory::ALL.map(Theory::name));
            return Err(document.reject(&key, must_be_one_of(names)));
        }
        if laws[..index].contains(law) {
            return Err(document.reject(&key, "must be named once"));
        }
        for own in materials.iter().filter(|_| law == ATLAS) {
            from_the_atlas(document, &key, &own.name, &own.material)?;
        }
        let applies = |material: &Material| {
            law.parse::<Theory>()
                .map_or(true, |theory| theory.applies_to(material))
        };
        if let Some(lacking) = materials.iter().find(|m| !applies(&m.material)) {
            let allowed = format!(
                "needs `{}.yield_strength`; an elastic grain has the law {} only",
                lacking.key,
                Theory::elastic('"')
            );
            return Err(document.reject(&key, allowed));
        }
    }
    Ok(laws)
}

fn own_laws(document: &Document, materials: &[GrainMaterial]) -> Result<Vec<String>> {
    let name = |material: &GrainMaterial| match &material.law {
        LawChoice::Listed => None,
        LawChoice::Given | LawChoice::File(_) => Some(FITTED),
        LawChoice::Theory(theory) => Some(theory.name()),
    };
    let names: Option<Vec<&str>> = materials.iter().map(name).collect();
    let Some(names) = names else {
        return Err(document.reject(
            "laws",
            "must name the laws to run the scene under, e.g. [\"hertz\"], or every material its own `law`",
        ));
    };
    let same = names.iter().all(|name| *name == names[0]);
    Ok(vec![if same { names[0] } else { OWN }.to_owned()])
}
