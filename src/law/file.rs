//! Law file: `law.toml`, read and checked.
//!
//! A law file that is published in `models/` needs what `impactlaw fit` writes: schema, material, constants of both
//! forms with their intervals, errors at every speed and at left-out speeds, valid range, and the case it came from.
//! The case file of that name belongs in `cases/`, so that anyone can make the law again.

use super::FittedLaw;
use super::bodies::{PairTable, refusal};
pub use super::table::*;
use crate::contact::admissible::Inadmissible;
use crate::contact::elastoplastic::{ClosedForm, Elastoplastic, Spline, YieldUnits};
use crate::contact::guarantees;
use crate::contact::loading::{Loading, SoftenedHertz};
use crate::contact::spline::{Knot, SplineLoading};
use crate::contact::unloading::Unloading;
use crate::document::Document;
use crate::document::keys::{Kind, key, keys, names, table};
use crate::material::{Material, MaterialTable, YIELD_PRESSURE_RATIO};
use crate::theory::hertz::Hertz;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Schema of law files that this version reads and writes.
pub const SCHEMA: i64 = 1;
/// Relative difference allowed between the yield point in a file and that of its material.
const YIELD_ROUNDING: f64 = 1e-9;

/// Form of a fitted law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Nothing yielded.
    Hertz,
    /// Few constants, for any code.
    ClosedForm,
    /// Knots.
    Spline,
}

names! { Form { Hertz as "hertz", ClosedForm as "closed_form", Spline as "spline", } }

impl Form {
    /// Every form, in the order of messages.
    pub const ALL: [Form; 3] = [Form::ClosedForm, Form::Spline, Form::Hertz];

    /// Name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Form::Hertz => "hertz",
            Form::ClosedForm => "closed_form",
            Form::Spline => "spline",
        }
    }
}

/// A law file. Numbers survive writing and reading bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawFile {
    /// [`SCHEMA`].
    pub schema: i64,
    /// Name of the law.
    pub name: String,
    /// Form that is used unless another is asked for.
    pub form: Form,
    /// What a user of the law has to know: speeds that were not used, a form that was not found, left-out speeds that are
    /// missed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// Material; of a pair that of the sphere on a rigid plane that stands for both bodies.
    pub material: MaterialTable,
    /// The two bodies of the law of a pair; such a file is read as [`super::PairLaw`] alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pair: Option<PairTable>,
    /// Units of the constants; absent for an elastic law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_point: Option<YieldTable>,
    /// Range of the impacts.
    pub valid: ValidTable,
    /// What counts as missed; absent from files of versions before 0.2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thresholds: Option<ThresholdTable>,
    /// Where the law comes from.
    pub provenance: ProvenanceTable,
    /// Hertz's law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hertz: Option<HertzTable>,
    /// Closed form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closed_form: Option<ClosedFormTable>,
    /// Spline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spline: Option<SplineTable>,
}

keys! {
    LawFile {
        schema: key("version of the format", "1", "1"),
        name: key("name of the law: that of the case", "", "'solder-ball'"),
        form: key("form that is used unless another is asked for; its table must be there", "`\"closed_form\"`, `\"spline\"`, `\"hertz\"`", "'closed_form'"),
        material: table("material"),
        pair: table("the two bodies, where the law is of a pair").or("none: one body on a rigid plane"),
        yield_point: table("units of the constants").or("none: elastic"),
        valid: table("range of the impacts"),
        provenance: table("where the law comes from"),
        hertz: table("Hertz's law, where nothing yielded").or("none"),
        closed_form: table("few constants, for any code").or("none"),
        spline: table("knots").or("none"),
        warnings: key("what a user of the law has to know", "", "['...']").or("none"),
        thresholds: table("what counts as missed").or("none: made before 0.2"),
    }
}

/// The schema alone, whatever else the file holds.
#[derive(Deserialize)]
struct Head {
    schema: Option<i64>,
}

/// Most characters of a name.
const LONGEST_NAME: usize = 120;

/// `text` with everything but letters, digits, blanks and `_ - . + ( )` replaced by `_`, and a letter or digit in front: fit
/// for a file's name and for a comment of any language.
#[must_use]
pub fn plain(text: &str) -> String {
    let keep = |c: char| c.is_alphanumeric() || " _-.+()".contains(c);
    let mut plain: String = text.chars().take(LONGEST_NAME).collect();
    plain = plain.replace(|c| !keep(c), "_");
    if !plain.starts_with(char::is_alphanumeric) {
        plain.insert(0, 'x');
    }
    plain
}

/// A constant that a law refuses, with its key in the file.
struct Refusal(String, Inadmissible);

impl LawFile {
    /// Read and check a law file; every form it holds must be an admissible law.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be read; otherwise as [`LawFile::parse`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Document::read(path)?)
    }

    /// Keys of a law file.
    #[must_use]
    pub fn keys() -> Kind {
        <LawFile as crate::document::keys::Value>::kind()
    }

    /// Check the text of a law file.
    ///
    /// # Errors
    /// [`Error::Value`] for another schema, a constant that is not admissible or a yield point that is not the
    /// material's; [`Error::Syntax`] for an unknown or missing key; [`Error::Refused`] for the law of a pair, which
    /// [`super::PairLaw`] reads.
    pub fn parse(document: &Document) -> Result<Self> {
        let file = Self::parse_any(document)?;
        match &file.pair {
            None => Ok(file),
            Some(bodies) => Err(refusal(document, bodies)),
        }
    }

    /// Check the text of a law file, of one body or of two.
    ///
    /// # Errors
    /// As [`LawFile::parse`], but for the last.
    pub(crate) fn parse_any(document: &Document) -> Result<Self> {
        document.read_as::<LawFile>();
        // another schema has other keys: it is looked at before them
        let head = toml::from_str::<Head>(document.text());
        if let Ok(head) = head
            && head.schema != Some(SCHEMA)
        {
            let remedy = match head.schema {
                Some(_) => "fit the law again with this version",
                None => "this is no law file: `impactlaw run CASE` makes one from a case",
            };
            let allowed = format!(
                "must be {SCHEMA}, the schema of law files of {}; {remedy}",
                crate::PROGRAM
            );
            return Err(document.reject("schema", allowed));
        }
        let file: LawFile = document.parse()?;
        file.check_texts(document)?;
        file.check_numbers(document)?;
        for form in [Form::Hertz, Form::ClosedForm, Form::Spline] {
            let absent = match form {
                Form::Hertz => file.hertz.is_none(),
                Form::ClosedForm => file.closed_form.is_none(),
                Form::Spline => file.spline.is_none(),
            };
            if absent && form == file.form {
                return Err(document.reject("form", "must be a form whose table the file holds"));
            }
            if !absent {
                file.build(form).map_err(|Refusal(key, why)| {
                    let field = why.key.rsplit('.').next().unwrap_or_default();
                    document.reject(
                        &key,
                        format!("{field} (here {}) {}", why.found, why.allowed),
                    )
                })?;
            }
        }
        Ok(file)
    }

    /// Texts are one line of plain characters: they go into file names and into the sources of other codes.
    fn check_texts(&self, document: &Document) -> Result<()> {
        let from = &self.provenance;
        for (key, text) in [
            ("name", &self.name),
            ("provenance.program", &from.program),
            ("provenance.case", &from.case),
        ] {
            if plain(text) != *text {
                let must = "must be one line of letters, digits, blanks and _ - . + ( ) that begins with a letter or digit";
                return Err(document.reject(key, must));
            }
        }
        let digits = from.case_sha256.chars().all(|c| c.is_ascii_hexdigit());
        if !digits || from.case_sha256.len() > 64 {
            return Err(document.reject("provenance.case_sha256", "must be hexadecimal digits"));
        }
        Ok(())
    }

    /// Material and range are finite and positive, and the yield point is that of the material.
    fn check_numbers(&self, document: &Document) -> Result<()> {
        self.material.check(document, "material")?;
        let v = &self.valid;
        let key = "valid.displacement_over_radius_max";
        document.within(key, v.displacement_over_radius_max)?;
        document.within("valid.velocity_min_m_s", v.velocity_min_m_s)?;
        let key = "valid.velocity_max_m_s";
        let rises = |x: f64| x >= v.velocity_min_m_s;
        document.check(key, v.velocity_max_m_s, rises, &document.must(key))?;
        document.within("provenance.radius_m", self.provenance.radius_m)?;
        if let Some(bodies) = &self.pair {
            bodies.check(&self.material(), self.provenance.radius_m, document)?;
        }
        self.check_yield_point(document)
    }

    fn check_yield_point(&self, document: &Document) -> Result<()> {
        let yields = self.closed_form.is_some() || self.spline.is_some();
        let Some(table) = &self.yield_point else {
            return match yields {
                true => {
                    Err(document.reject("yield_point", "is needed: the constants are in its units"))
                }
                false => Ok(()),
            };
        };
        let point = self.material().yield_point(1.0, table.pressure_ratio);
        let point = point.ok_or_else(|| {
            document.reject(
                "material.yield_strength_Pa",
                "is needed: the file has a yield point",
            )
        })?;
        let near = |truth: f64| move |x: f64| (x / truth - 1.0).abs() < YIELD_ROUNDING;
        let key = "yield_point.displacement_over_radius";
        let near_displacement = near(point.displacement);
        document.check(
            key,
            table.displacement_over_radius,
            near_displacement,
            &document.must(key),
        )?;
        let key = "yield_point.force_over_radius2_Pa";
        document.check(
            key,
            table.force_over_radius2_pa,
            near(point.force),
            &document.must(key),
        )?;
        Ok(())
    }

    /// Material of the law.
    #[must_use]
    pub fn material(&self) -> Material {
        self.material.material()
    }

    /// The law in the form the file names.
    ///
    /// # Errors
    /// [`Error::Refused`] when the file lacks that form or its constants are not admissible; never for a
    /// file that was read.
    pub fn law(&self) -> Result<FittedLaw> {
        self.law_in(self.form)
    }

    /// The law in the form asked for.
    ///
    /// # Errors
    /// As [`LawFile::law`].
    pub fn law_in(&self, form: Form) -> Result<FittedLaw> {
        self.build(form)
            .map_err(|Refusal(key, why)| Error::Refused {
                what: format!("{}: {key}", self.name),
                found: why.found.to_string(),
                allowed: why.allowed.to_owned(),
            })
    }

    fn build(&self, form: Form) -> std::result::Result<FittedLaw, Refusal> {
        match form {
            Form::Hertz => Ok(FittedLaw::Hertz(self.hertz_law())),
            Form::ClosedForm => self.build_closed_form().map(FittedLaw::ClosedForm),
            Form::Spline => self.build_spline().map(FittedLaw::Spline),
        }
    }

    /// Hertz's law: without limit where the material does not yield, else as far as it is known to be elastic.
    fn hertz_law(&self) -> Hertz {
        let material = self.material();
        let law = Hertz::of(&material);
        match material.yield_point(1.0, YIELD_PRESSURE_RATIO) {
            None => law,
            Some(point) => law.up_to(
                self.valid
                    .displacement_over_radius_max
                    .max(point.displacement),
            ),
        }
    }

    fn build_closed_form(&self) -> std::result::Result<ClosedForm, Refusal> {
        let table = self
            .closed_form
            .as_ref()
            .ok_or_else(|| absent("closed_form"))?;
        let at = |key: &'static str| move |e: Inadmissible| Refusal(format!("{key}.{}", e.key), e);
        let loading = SoftenedHertz::new(table.departure, table.breadth, table.softening)
            .map_err(at("closed_form"))?;
        let unloading = build_unloading(&table.unloading).map_err(at("closed_form.unloading"))?;
        let law = self.assemble(loading, unloading);
        let law = law.map_err(|e| Refusal(of_form("closed_form", "closed_form", &e), e))?;
        self.with_inertia(law, table.inertia)
            .map_err(at("closed_form"))
    }

    fn build_spline(&self) -> std::result::Result<Spline, Refusal> {
        let table = self.spline.as_ref().ok_or_else(|| absent("spline"))?;
        let knots: Vec<Knot> = table
            .knots
            .iter()
            .map(|&[flattening, force, slope]| Knot {
                flattening,
                force,
                slope,
            })
            .collect();
        let loading = SplineLoading::new(table.hertz_to, &knots).map_err(|e| {
            let key = e.key.split("].").next().unwrap_or_default();
            let bracket = if e.key.contains("].") { "]" } else { "" };
            Refusal(format!("spline.{key}{bracket}"), e)
        })?;
        let unloading = build_unloading(&table.unloading)
            .map_err(|e| Refusal(format!("spline.unloading.{}", e.key), e))?;
        let law = self.assemble(loading, unloading);
        let law = law.map_err(|e| Refusal(of_form("spline", "spline.knots", &e), e))?;
        self.with_inertia(law, table.inertia)
            .map_err(|e| Refusal(format!("spline.{}", e.key), e))
    }

    fn with_inertia<L: Loading>(
        &self,
        law: Elastoplastic<L>,
        coefficient: Option<f64>,
    ) -> std::result::Result<Elastoplastic<L>, Inadmissible> {
        match coefficient {
            None => Ok(law),
            Some(kappa) => law.with_inertia(kappa, self.material.density_kg_m3),
        }
    }

    fn assemble<L: Loading>(
        &self,
        loading: L,
        unloading: Unloading,
    ) -> std::result::Result<Elastoplastic<L>, Inadmissible> {
        let (flattening, force) = self.yield_point.as_ref().map_or((f64::NAN, f64::NAN), |y| {
            (y.displacement_over_radius, y.force_over_radius2_pa)
        });
        let units = YieldUnits { flattening, force };
        let valid_to = self.valid.displacement_over_radius_max;
        let law = Elastoplastic::new(loading, unloading, units, valid_to)?;
        guarantees::check(&law)?;
        Ok(law.from_velocity(self.valid.velocity_min_m_s, self.material.density_kg_m3))
    }
}

/// Key of what an assembled law of `form` refuses: that of the constant it names, or `whole`.
fn of_form(form: &str, whole: &str, why: &Inadmissible) -> String {
    match why.key.starts_with("unloading.") {
        true => format!("{form}.{}", why.key),
        false => whole.to_owned(),
    }
}

fn absent(key: &str) -> Refusal {
    let why = Inadmissible {
        key: key.to_owned(),
        found: f64::NAN,
        allowed: "is not in the file",
    };
    Refusal(key.to_owned(), why)
}

fn build_unloading(t: &UnloadingTable) -> std::result::Result<Unloading, Inadmissible> {
    Unloading::new(
        t.residual_scale,
        t.residual_power,
        t.exponent_residual,
        t.exponent_strain,
    )
}
