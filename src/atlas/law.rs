//! Law: the atlas as it is kept, and the law it has for a material.

use super::place::{Place, Range, TERMS};
use super::score::Score;
use crate::contact::NormalLaw;
use crate::contact::elastoplastic::{Elastoplastic, Spline};
use crate::contact::rebound::rebound;
use crate::fit::form::{through, unloading};
use crate::fit::run::Scale;
use crate::material::Material;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};

/// Knots of a law, evenly over the logarithm of the flattening from the departure to [`DEEPEST`].
const KNOTS: usize = 7;
/// Flattening $\delta/R$ at the last knot.
const DEEPEST: f64 = 0.6;
/// Free numbers of a law.
pub(super) const NUMBERS: usize = KNOTS + 6;
/// Least ratio of flattenings of neighbouring knots.
const LEAST_RATIO: f64 = 1.01;
/// How often exponents are tried, each time smoother: where they fall at once from Hertz's, a cubic between knots is steeper than
/// unloading.
const SMOOTHINGS: usize = 8;
/// E/Y below which a material is judged by its like.
pub(super) const SOFT: f64 = 30.0;
/// Steepest mean exponent between knots, Hertz's.
const STEEPEST: f64 = 1.5;

/// An atlas, as it is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Atlas {
    /// What this is, for who opens the file.
    pub about: String,
    /// Program and version that made it.
    pub program: String,
    /// Study of its impacts.
    pub study: String,
    /// SHA-256 of the study's file.
    pub study_sha256: String,
    /// Impacts of the study, and those that the fit is to: beyond first yield, with a rebound.
    pub impacts: [usize; 2],
    /// Accuracy of the impacts.
    pub tolerance: f64,
    /// Range.
    pub range: Range,
    /// Errors at $\rho V^2/Y$ below 1 of the impacts themselves.
    pub own: Score,
    /// The same, each tenth of the materials left out.
    pub left_out: Score,
    /// Those of them of materials of E/Y below 30, which are off by several times as much: Hertz's law, with which the law begins,
    /// is of a half-space.
    pub left_out_soft: Score,
    /// The same, each quarter of E/Y, of nu and of H/Y left out: half of these lie beyond what is left.
    pub levels: Score,
    /// Polynomials of the free numbers: $\ln w_1$, logits of the exponents over 3/2, $\ln\kappa$, $\ln c$, $\ln k$,
    /// $\ln(n_1 + \tfrac12)$, $\ln n_2$; terms as in [`Place::terms`].
    pub numbers: Vec<Vec<f64>>,
}

/// The atlas of the program.
const BUILT_IN: &str = include_str!("../../models/atlas.json");

impl Atlas {
    /// The atlas of the program.
    ///
    /// # Errors
    /// Those of [`Atlas::parse`].
    pub fn built_in() -> Result<Self> {
        Self::parse(BUILT_IN)
    }

    /// An atlas from its text.
    ///
    /// # Errors
    /// [`Error::Refused`] for a text that is no atlas of this version.
    pub fn parse(text: &str) -> Result<Self> {
        let refuse = |found: String| Error::Refused {
            what: "atlas".to_owned(),
            found,
            allowed: "must be made by `impactlaw atlas` of this version".to_owned(),
        };
        let atlas: Atlas = serde_json::from_str(text).map_err(|why| refuse(why.to_string()))?;
        let sizes = atlas.numbers.iter().map(Vec::len);
        if atlas.numbers.len() != NUMBERS || sizes.into_iter().any(|n| n != TERMS) {
            return Err(refuse("polynomials of another size".to_owned()));
        }
        Ok(atlas)
    }

    /// Law of a material, valid to the flattening of its fastest impact.
    ///
    /// # Errors
    /// [`Error::Refused`] for a material outside the range.
    pub fn law(&self, material: &Material) -> Result<Spline> {
        let place = Place::of(material)?;
        self.range.check(&place)?;
        let free = polynomials(&self.numbers.concat(), &place.terms());
        let law = Scale::of(material, 1.0).and_then(|scale| {
            let law = assemble(&free, &scale, DEEPEST)?;
            let [slow, fast] = self.velocities(material);
            let most = rebound(&law, scale.radius, scale.mass, fast).max_displacement;
            let law = assemble(&free, &scale, most)?.from_velocity(slow, material.density);
            // the density to the last digit, as a law file has it
            let coefficient = law.inertia().coefficient();
            law.with_inertia(coefficient, material.density).ok()
        });
        law.ok_or_else(|| inadmissible(&place))
    }

    /// The same law without an end of its validity, in a quarter of the time: for those who look at many materials and keep to
    /// the speeds of the range themselves.
    ///
    /// # Errors
    /// As [`Atlas::law`].
    pub fn unlimited(&self, material: &Material) -> Result<Spline> {
        let place = Place::of(material)?;
        self.range.check(&place)?;
        let free = polynomials(&self.numbers.concat(), &place.terms());
        let law = Scale::of(material, 1.0).and_then(|scale| assemble(&free, &scale, f64::MAX));
        law.ok_or_else(|| inadmissible(&place))
    }

    /// Slowest and fastest impact of a material, m/s.
    #[must_use]
    pub fn velocities(&self, material: &Material) -> [f64; 2] {
        let strength = material.flow.map_or(0.0, |flow| flow.yield_strength());
        let of = |severity: f64| (severity * strength / material.density).sqrt();
        self.range.severity.map(of)
    }

    /// Where the law of a material comes from and how far it can be trusted, as a sentence.
    #[must_use]
    pub fn provenance(&self, material: &Material) -> String {
        let soft = material
            .flow
            .is_some_and(|flow| material.young_modulus < SOFT * flow.yield_strength());
        let (score, of) = match soft {
            true => (&self.left_out_soft, " of those with E/Y below 30"),
            false => (&self.left_out, ""),
        };
        let per_cent = |all: [f64; 3]| all.map(|x| format!("{:.1} %", 100.0 * x));
        let [force, displacement, restitution] = per_cent(score.median);
        let most = per_cent(score.twentieth).join(", ");
        format!(
            "from the atlas ({} impacts, study {}), no impact of this material was run: with the material left out the median error{of} is \
             {force} in F*, {displacement} in delta*, {restitution} in e, and 19 of 20 impacts are within {most} (e below 0.2: of 0.2)",
            self.impacts[1], self.study
        )
    }
}

/// Refusal of a place without a law.
fn inadmissible(place: &Place) -> Error {
    Error::Refused {
        what: "material".to_owned(),
        found: format!("{place:?}"),
        allowed: "the constants of the atlas make no admissible law here; `impactlaw run` makes one from impacts".to_owned(),
    }
}

/// Values of the polynomials.
pub(super) fn polynomials(constants: &[f64], terms: &[f64; TERMS]) -> Vec<f64> {
    let sum = |row: &[f64]| row.iter().zip(terms).map(|(c, t)| c * t).sum();
    constants.chunks(TERMS).map(sum).collect()
}

/// Law from its free numbers; `None` where they make no admissible one.
pub(super) fn assemble(free: &[f64], scale: &Scale, valid_to: f64) -> Option<Spline> {
    let units = scale.units();
    let hertz_to = free[0].exp();
    let ratio = (DEEPEST / units.flattening / hertz_to).powf(1.0 / KNOTS as f64);
    if !(ratio >= LEAST_RATIO) {
        return None;
    }
    let flattenings: Vec<f64> = (1..=KNOTS as i32)
        .map(|k| hertz_to * ratio.powi(k))
        .collect();
    let logistic = |t: &f64| STEEPEST / (1.0 + (-t).exp());
    let mut exponents: Vec<f64> = free[1..=KNOTS].iter().map(logistic).collect();
    let unloading = unloading(&free[KNOTS + 2..])?;
    for _ in 0..SMOOTHINGS {
        let loading = through(hertz_to, &flattenings, &exponents);
        let law = loading.and_then(|curve| {
            let law = Elastoplastic::new(curve, unloading, units, valid_to);
            law.ok()
        });
        if let Some(law) = law {
            let coefficient = free[KNOTS + 1].exp();
            return law.with_inertia(coefficient, scale.density()).ok();
        }
        exponents = smoothed(&exponents);
    }
    None
}

/// Each exponent halfway to the mean of its neighbours; before the first one stands Hertz's.
fn smoothed(exponents: &[f64]) -> Vec<f64> {
    let at = |k: usize| match k {
        0 => STEEPEST,
        k => exponents[k.min(exponents.len()) - 1],
    };
    (1..=exponents.len())
        .map(|k| 0.5 * at(k) + 0.25 * (at(k - 1) + at(k + 1)))
        .collect()
}
