//! Answer: what is asked of the laws of a sphere, as JSON, and what they answer, as JSON.

use super::body::{Body, Sphere};
use super::curves::{Bounces, Pressed, PressedTo, Thrown, ThrownAt};
use crate::contact::LawVisitor;
use crate::export::c;
use crate::export::source::portable::Portable;
use crate::law::{AnyLaw, beyond};
use crate::material::YIELD_PRESSURE_RATIO;
use crate::theory::published::{Evidence, Publication, left_out};
use crate::theory::{FORMULAS, Theory};
use crate::unit::{Length, argument};
use crate::{Error, Result};
use serde::{Deserialize, Serialize};

/// Name of the law that is not a theory: of the atlas, or of the file that was opened.
pub const LAW: &str = "law";

/// What can be asked.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
enum Question {
    /// Force over displacement and figures of each of `laws`: thrown, or pressed to a displacement.
    Impact {
        body: Body,
        laws: Vec<String>,
        press: Option<String>,
    },
    /// Restitution of each of `laws` at speeds in m/s.
    Restitution {
        body: Body,
        laws: Vec<String>,
        velocities: Vec<f64>,
    },
    /// The law file.
    File { body: Body, name: String },
    /// The law as a C header.
    Header { body: Body, name: String },
}

/// What is answered.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Answer {
    Impact(Box<Figures>),
    Restitution { laws: Vec<OverSpeed> },
    File { name: String, text: String },
    Error { error: String },
}

/// A sphere and what its laws do.
#[derive(Debug, Serialize)]
struct Figures {
    about: About,
    laws: Vec<OfLaw>,
}

/// What holds of the sphere whatever the law. SI units; none of yield where nothing yields.
#[derive(Debug, Serialize)]
struct About {
    radius_m: f64,
    velocity_m_s: f64,
    mass_kg: f64,
    #[serde(rename = "contact_modulus_Pa")]
    contact_modulus_pa: f64,
    young_over_yield: Option<f64>,
    #[serde(rename = "rho_V2_over_Y")]
    severity: Option<f64>,
    yield_velocity_m_s: Option<f64>,
    yield_displacement_m: Option<f64>,
    #[serde(rename = "yield_force_N")]
    yield_force_n: Option<f64>,
    /// Slowest and fastest impact of the law.
    law_velocities_m_s: Option<[f64; 2]>,
    /// What a user of the law has to know.
    law_notes: Vec<String>,
    /// What of the flow stress plays no part in theories, and what looks like a slip of a unit.
    notes: Vec<String>,
}

/// A law of a list: what it does, or why it does not.
#[derive(Debug, Serialize)]
struct OfLaw {
    name: String,
    refused: Option<String>,
    pressed: Option<Pressed>,
    restitution_closed_form: Option<f64>,
}

#[derive(Debug, Serialize)]
struct OverSpeed {
    name: String,
    refused: Option<String>,
    bounces: Option<Bounces>,
    closed_form: Option<Vec<Option<f64>>>,
}

/// The answer to a question; what is wrong is answered as `{"error": "..."}`, in the program's words.
///
/// ```
/// let question = r#"{"ask": "impact", "laws": ["law", "hertz"], "press": null, "body": {"young": "128 GPa", "poisson": "0.343",
///     "density": "8960 kg/m3", "strength": "162 MPa", "hardening": "", "radius": "250 um", "velocity": "10 m/s", "law": null}}"#;
/// let answer: serde_json::Value = serde_json::from_str(&impactlaw::explore::answer(question))?;
/// let e = |i: usize| answer["laws"][i]["pressed"]["restitution"].as_f64().unwrap_or(0.0);
/// assert!(e(0) > 0.16 && e(0) < 0.18);
/// assert!((e(1) - 1.0).abs() < 1e-9);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[must_use]
pub fn answer(question: &str) -> String {
    let asked = serde_json::from_str(question);
    let answer = asked
        .map_err(|why| Error::Refused {
            what: "question".to_owned(),
            found: why.to_string(),
            allowed: "must be one of those of this version".to_owned(),
        })
        .and_then(find);
    let answer = answer.unwrap_or_else(|error| Answer::Error {
        error: error.to_string(),
    });
    serde_json::to_string(&answer).unwrap_or_else(|why| format!("{{\"error\":\"{why}\"}}"))
}

fn find(question: Question) -> Result<Answer> {
    match question {
        Question::Impact { body, laws, press } => {
            let sphere = body.sphere()?;
            let press = press.map(|text| pressed_to(&sphere, &text)).transpose()?;
            Ok(Answer::Impact(Box::new(Figures {
                about: about(&sphere, &laws)?,
                laws: laws.iter().map(|n| of_law(&sphere, n, press)).collect(),
            })))
        }
        Question::Restitution {
            body,
            laws,
            velocities,
        } => {
            let sphere = body.sphere()?;
            let of = |name: &String| over_speed(&sphere, name, &velocities);
            Ok(Answer::Restitution {
                laws: laws.iter().map(of).collect(),
            })
        }
        Question::File { body, name } => {
            let (file, document) = body.sphere()?.file(&name)?;
            Ok(Answer::File {
                name: format!("{}.toml", file.name),
                text: document.text().to_owned(),
            })
        }
        Question::Header { body, name } => {
            let (file, document) = body.sphere()?.file(&name)?;
            let law = Portable::new(file, None, document.hash())?;
            Ok(Answer::File {
                name: format!("{}.h", law.identifier),
                text: c::header(&law),
            })
        }
    }
}

/// Displacement (m) that a law has a force at.
fn pressed_to(sphere: &Sphere, text: &str) -> Result<f64> {
    let refuse = |allowed: String| Error::Refused {
        what: "displacement".to_owned(),
        found: format!("\"{text}\""),
        allowed,
    };
    let displacement = argument::<Length>("displacement", text)?;
    if !(displacement > 0.0) {
        return Err(refuse("must be positive".to_owned()));
    }
    match beyond(sphere.radius, displacement, None, "") {
        Some(allowed) => Err(refuse(allowed)),
        None => Ok(displacement),
    }
}

fn about(sphere: &Sphere, laws: &[String]) -> Result<About> {
    let material = &sphere.material;
    let strength = material.flow.map(|flow| flow.yield_strength());
    let point = material.yield_point(sphere.radius, YIELD_PRESSURE_RATIO);
    let shown = laws.iter().filter_map(|name| publication(name).ok());
    let mut notes = left_out(shown, material);
    notes.extend(sphere.slips.iter().cloned());
    // where there is no law, nothing is to be known of it
    let has_law = sphere.law().is_ok();
    Ok(About {
        radius_m: sphere.radius,
        velocity_m_s: sphere.velocity,
        mass_kg: sphere.mass,
        contact_modulus_pa: material.contact_modulus(),
        young_over_yield: strength.map(|y| material.young_modulus / y),
        severity: strength.map(|y| material.density * sphere.velocity.powi(2) / y),
        yield_velocity_m_s: point.map(|p| p.velocity),
        yield_displacement_m: point.map(|p| p.displacement),
        yield_force_n: point.map(|p| p.force),
        law_velocities_m_s: has_law.then(|| sphere.speeds()).transpose()?,
        law_notes: match has_law {
            true => sphere.to_know()?,
            false => Vec::new(),
        },
        notes,
    })
}

/// What the model of this name states.
fn publication(name: &str) -> Result<Publication> {
    match formula(name) {
        Some(formula) => Ok(formula),
        None => Ok(name.parse::<Theory>()?.publication()),
    }
}

/// Model of this name that gives a restitution and no force.
fn formula(name: &str) -> Option<Publication> {
    FORMULAS.into_iter().find(|formula| formula.name == name)
}

/// What `visitor` finds of the law called `name`; none of a model without a force.
fn visited<V: LawVisitor>(sphere: &Sphere, name: &str, visitor: V) -> Result<Option<V::Output>> {
    if formula(name).is_some() {
        return Ok(None);
    }
    let law = match name {
        LAW => sphere.law()?,
        name => AnyLaw::Theory(name.parse()?, sphere.material),
    };
    law.visit(visitor).map(Some)
}

/// Restitution in closed form at a speed (m/s), where the authors give one that holds.
fn closed_form(sphere: &Sphere, name: &str, velocity: f64) -> Option<f64> {
    let restitution = publication(name).ok()?.restitution?;
    restitution(&sphere.material, velocity)
}

fn of_law(sphere: &Sphere, name: &str, press: Option<f64>) -> OfLaw {
    let (radius, mass, velocity) = (sphere.radius, sphere.mass, sphere.velocity);
    let thrown = Thrown {
        radius,
        mass,
        velocity,
    };
    let found = match press {
        None => visited(sphere, name, thrown),
        Some(displacement) => visited(
            sphere,
            name,
            PressedTo {
                radius,
                displacement,
            },
        ),
    };
    let (pressed, refused) = told(found);
    OfLaw {
        name: name.to_owned(),
        refused,
        pressed,
        restitution_closed_form: match press {
            None => closed_form(sphere, name, velocity),
            Some(_) => None,
        },
    }
}

fn over_speed(sphere: &Sphere, name: &str, velocities: &[f64]) -> OverSpeed {
    let thrown = ThrownAt {
        radius: sphere.radius,
        mass: sphere.mass,
        velocities,
    };
    let (bounces, refused) = told(visited(sphere, name, thrown));
    let closed = |velocity: &f64| closed_form(sphere, name, *velocity);
    let closed: Vec<Option<f64>> = velocities.iter().map(closed).collect();
    OverSpeed {
        name: name.to_owned(),
        refused,
        bounces,
        closed_form: closed.iter().any(Option::is_some).then_some(closed),
    }
}

/// What was found, or the refusal in words.
fn told<T>(found: Result<Option<T>>) -> (Option<T>, Option<String>) {
    match found {
        Ok(found) => (found, None),
        Err(error) => (None, Some(error.to_string())),
    }
}

/// Models that are shown unasked are those whose constants were checked.
pub(super) fn is_checked(publication: &Publication) -> bool {
    publication.evidence == Evidence::Checked
}
