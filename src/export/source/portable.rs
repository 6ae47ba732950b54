//! Portable form of a law: what every dialect is written from, whatever its language.

use super::reference::{self, Reference};
use crate::contact::{LawVisitor, NormalLaw};
use crate::document::Document;
use crate::law::file::plain;
use crate::law::pair::PairTable;
use crate::law::{FittedLaw, Form, LawFile};
use crate::material::Material;
use crate::{Error, Result};
use std::f64::consts::PI;
use std::path::Path;

/// Share of the Rayleigh time of half a grain in the suggested time step, as in a bed.
const RAYLEIGH_FRACTION: f64 = 0.2;
/// Steps of the suggested time step in half an oscillation of the stiffest contact, as in a bed.
const STEPS_PER_CONTACT: f64 = 20.0;
/// Relative step back from the largest flattening at which the unloading stiffness is read.
const UNLOADING_PROBE: f64 = 1e-6;

/// A law with all that a file in another language has to say about it. SI units.
#[derive(Debug, Clone)]
pub struct Portable {
    /// Name in the law file.
    pub name: String,
    /// The name as an identifier of C and its relatives: prefix of everything a dialect defines.
    pub identifier: String,
    /// Form that is exported.
    pub form: Form,
    /// The law at rest, without inertia: what dialects hold.
    pub core: FittedLaw,
    /// The law with its inertia term, as `rebound` and the fit know it.
    pub full: FittedLaw,
    /// The file it comes from.
    pub file: LawFile,
    /// SHA-256 of that file.
    pub hash: String,
    /// Suggested time step over the radius of the smallest body, s/m.
    pub time_step_over_radius: f64,
    /// Impacts that a dialect must reproduce.
    pub reference: Reference,
}

impl Portable {
    /// Portable form of a law file, in the form it names or in `form`.
    ///
    /// # Errors
    /// Those of [`LawFile::read`]; [`Error::Refused`] when the file lacks the form.
    pub fn read(path: &Path, form: Option<Form>) -> Result<Self> {
        let document = Document::read(path)?;
        let file = LawFile::parse(&document)?;
        Self::new(file, form, document.hash())
    }

    /// Portable form of a law file, of one material or of a pair of bodies; each target says whether it holds them.
    ///
    /// # Errors
    /// As [`Portable::read`], but for a law of a pair.
    pub fn read_any(path: &Path, form: Option<Form>) -> Result<Self> {
        let document = Document::read(path)?;
        let file = LawFile::parse_any(&document)?;
        Self::new(file, form, document.hash())
    }

    /// Portable form of a law file whose text has the SHA-256 `hash`.
    ///
    /// # Errors
    /// [`Error::Refused`] when the file lacks the form.
    pub fn new(file: LawFile, form: Option<Form>, hash: String) -> Result<Self> {
        let form = held(&file, form.unwrap_or(file.form))?;
        let full = file.law_in(form)?;
        let core = at_rest(&file).law_in(form)?;
        let time_step_over_radius = suggested_time_step(&core, &file);
        let reference = reference::of(&core, &file);
        Ok(Portable {
            identifier: identifier(&file.name),
            name: plain(&file.name),
            form,
            core,
            full,
            hash,
            time_step_over_radius,
            reference,
            file,
        })
    }

    /// The two bodies of the law of a pair.
    #[must_use]
    pub fn pair(&self) -> Option<&PairTable> {
        self.file.pair.as_ref()
    }

    /// Material of the bodies; of a pair that of the sphere that stands for both.
    #[must_use]
    pub fn material(&self) -> Material {
        self.file.material()
    }

    /// Radius of the sphere whose impacts were simulated, m: that of the reference impacts; of a pair the effective one.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.file.provenance.radius_m
    }

    /// Suggested time step for bodies of that radius, s.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        self.time_step_over_radius * self.radius()
    }

    /// Coefficient of the inertia term; 0 where the law has none.
    #[must_use]
    pub fn inertia(&self) -> f64 {
        struct Coefficient;
        impl LawVisitor for Coefficient {
            type Output = f64;
            fn visit<L: NormalLaw>(self, law: &L) -> f64 {
                law.inertia().coefficient()
            }
        }
        self.full.visit(Coefficient)
    }
}

/// `form`, if the file has a table of it.
fn held(file: &LawFile, form: Form) -> Result<Form> {
    let holds = |form: &Form| match form {
        Form::Hertz => file.hertz.is_some(),
        Form::ClosedForm => file.closed_form.is_some(),
        Form::Spline => file.spline.is_some(),
    };
    if holds(&form) {
        return Ok(form);
    }
    let held = Form::ALL.into_iter().filter(holds);
    let names: Vec<&str> = held.map(Form::name).collect();
    Err(Error::Refused {
        what: "--form".to_owned(),
        found: form.name().to_owned(),
        allowed: format!("is not in the law file, which holds {}", names.join(", ")),
    })
}

/// The file with no inertia in any form.
fn at_rest(file: &LawFile) -> LawFile {
    let mut rest = file.clone();
    if let Some(table) = &mut rest.closed_form {
        table.inertia = None;
    }
    if let Some(table) = &mut rest.spline {
        table.inertia = None;
    }
    rest
}

/// `name` with everything that cannot stand in an identifier as `_`, beginning with a letter.
fn identifier(name: &str) -> String {
    let plain = |c: char| match c {
        'a'..='z' | 'A'..='Z' | '0'..='9' => c.to_ascii_lowercase(),
        _ => '_',
    };
    let text: String = name.chars().map(plain).collect();
    match text.starts_with(|c: char| c.is_ascii_lowercase()) {
        true => text,
        false => format!("law_{text}"),
    }
}

/// Time step over radius (s/m) that follows the waves through a grain and the stiffest unloading in the law's range:
/// that of a body on a wall, whose half oscillation $\pi\sqrt{m/k}$ is that of two equal bodies too.
fn suggested_time_step(law: &FittedLaw, file: &LawFile) -> f64 {
    let material = file.material();
    let stiffness = law.visit(Stiffest(file.valid.displacement_over_radius_max));
    let half_oscillation = PI * (material.sphere_mass(1.0) / stiffness).sqrt();
    let rayleigh = match &file.pair {
        None => material.rayleigh_time(1.0),
        // waves run through the bodies, not through what stands for both
        Some(pair) => {
            let [first, second] = pair.materials();
            let own = first.rayleigh_time(pair.particle_radius_m);
            let other = pair
                .target_radius_m
                .map_or(f64::INFINITY, |r| second.rayleigh_time(r));
            own.min(other) / file.provenance.radius_m
        }
    };
    let rayleigh = RAYLEIGH_FRACTION * rayleigh;
    rayleigh.min(half_oscillation / STEPS_PER_CONTACT)
}

/// Slope of the reduced force (Pa) at the beginning of unloading from a flattening.
struct Stiffest(f64);

impl LawVisitor for Stiffest {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let mut history = L::History::default();
        law.force(self.0, &mut history);
        law.stiffness(self.0 * (1.0 - UNLOADING_PROBE), &history)
    }
}

#[cfg(test)]
mod tests {
    use super::identifier;

    #[test]
    fn identifiers_are_those_of_c() {
        assert_eq!(identifier("thesis-4-4"), "thesis_4_4");
        assert_eq!(identifier("Acier 1.4301 µ"), "acier_1_4301__");
        assert_eq!(identifier("304 steel"), "law_304_steel");
        assert_eq!(identifier(""), "law_");
    }
}
