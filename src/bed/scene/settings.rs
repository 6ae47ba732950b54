//! Settings of a scene that are plain numbers: contact effects, time step, files.

use crate::Result;
use crate::dem::force::damping::Viscous;
use crate::dem::force::effects::Named;
use crate::dem::force::friction::Mindlin;
use crate::dem::force::list::effects;
use crate::dem::force::named::Constants;
use crate::dem::force::rolling::RollingSpring;
use crate::document::Document;
use crate::document::keys::{key, keys};
use crate::unit::{Quantity, Time};
use serde::Deserialize;

/// Reads the constant of the effect `E` from a table called `place`; `otherwise` says what holds without it.
fn constant<E: Named>(
    document: &Document,
    place: &str,
    key: &str,
    value: Option<f64>,
    otherwise: &str,
) -> Result<Option<f64>> {
    let must = format!("{}; leave it out for {otherwise}", E::MUST);
    let check = |value| document.check(&format!("{place}.{key}"), value, E::allows, &must);
    value.map(check).transpose()
}

/// That every effect named in the table called `place` has the one it needs.
fn check_needs(document: &Document, place: &str, constants: &Constants) -> Result<()> {
    match constants.unmet() {
        None => Ok(()),
        Some((key, needed, why)) => {
            let allowed = format!("needs `{place}.{needed}` beside it: {why}");
            Err(document.reject(&format!("{place}.{key}"), allowed))
        }
    }
}

macro_rules! tables {
    ($($(#[$what:meta])* $effect:ident: $kind:ident { key: $key:ident, column: $column:literal },)+) => {
        /// Table `[contact]` as it is written: an effect that is not named does not act.
        #[derive(Debug, Clone, Copy, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct ContactTable {
            $($key: Option<f64>,)+
            stiffness: Option<f64>,
        }

        keys! {
            ContactTable "An effect that is not named does not act, and costs nothing." {
                $($key: <$kind as Named>::LINE.or("none"),)+
                stiffness: key("contact stiffness over that of the material; reported with the results", "(0, 1]", "1e-3").or("1"),
            }
        }

        impl ContactTable {
            pub(super) fn check(self, document: &Document) -> Result<Constants> {
                if let Some(stiffness) = self.stiffness {
                    let must = "must lie in (0, 1]; leave it out for the material's own stiffness";
                    document.check("contact.stiffness", stiffness, |s| s > 0.0 && s <= 1.0, must)?;
                }
                let constants = Constants {
                    $($key: constant::<$kind>(document, "contact", stringify!($key), self.$key, <$kind as Named>::WITHOUT)?,)+
                    stiffness: self.stiffness,
                };
                check_needs(document, "contact", &constants)?;
                Ok(constants)
            }
        }

        /// Table `[[pair]]` as it is written: what is not named is as in `[contact]`.
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct PairTable {
            pub(super) between: [String; 2],
            pub(super) law: Option<String>,
            $($key: Option<f64>,)+
        }

        keys! {
            PairTable "What is not named is as in `[contact]`." {
                between: key("the two materials", "of `materials`", "['copper', 'steel']"),
                law: key("law of both together, in runs under fitted laws: a law file with `[pair]`, of two spheres or a sphere on a half-space", "a law file", "'steel-on-copper.toml'").or("the laws of both in series"),
                $($key: <$kind as Named>::LINE.or("of `[contact]`"),)+
            }
        }

        impl PairTable {
            /// Constants of the pair called `place`, `general` being those of `[contact]`.
            pub(super) fn constants(&self, document: &Document, place: &str, general: &Constants) -> Result<Constants> {
                let otherwise = "that of `[contact]`";
                let constants = Constants {
                    $($key: constant::<$kind>(document, place, stringify!($key), self.$key, otherwise)?.or(general.$key),)+
                    stiffness: general.stiffness,
                };
                check_needs(document, place, &constants)?;
                Ok(constants)
            }
        }
    };
}
effects!(tables);

/// Table `[time]` as it is written.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TimeTable {
    rayleigh_fraction: Option<f64>,
    steps_per_contact: Option<f64>,
    step: Option<Quantity<Time>>,
}

keys! {
    TimeTable "The step is the largest that both limits allow, and follows the stiffest contact." {
        rayleigh_fraction: key("largest share of the Rayleigh time", "(0, 0.5]", "0.2").or("0.2"),
        steps_per_contact: key("least steps in the half oscillation of a grain on its stiffest contact", "8 to 1e6", "40").or("20; more for a `restitution` below 0.2 (under a spring 0.5), 37 (80) for 0.05"),
        step: key("a step of your own", "> 0, within both limits", "'1 us'").or("none"),
    }
}

/// How the time step follows from the stiffest contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStep {
    /// Largest share of the Rayleigh time.
    pub rayleigh_fraction: f64,
    /// Least number of steps in the half oscillation of a grain on its stiffest contact; none: as many as the restitution asks for.
    pub steps_per_contact: Option<f64>,
    /// The scene's own time step, s: used as it is, and checked against the two limits.
    pub step: Option<f64>,
}

impl Default for TimeStep {
    /// Usual DEM practice: a fifth of the Rayleigh time, twenty steps a contact or more.
    fn default() -> Self {
        Self {
            rayleigh_fraction: 0.2,
            steps_per_contact: None,
            step: None,
        }
    }
}

impl TimeTable {
    pub(super) fn check(self, document: &Document) -> Result<TimeStep> {
        let usual = TimeStep::default();
        Ok(TimeStep {
            rayleigh_fraction: document.check(
                "time.rayleigh_fraction",
                self.rayleigh_fraction.unwrap_or(usual.rayleigh_fraction),
                |f| f > 0.0 && f <= 0.5,
                "must lie in (0, 0.5], e.g. 0.2; a larger time step is unstable in a packing",
            )?,
            steps_per_contact: self
                .steps_per_contact
                .map(|steps| {
                    document.check(
                        "time.steps_per_contact",
                        steps,
                        |n| (8.0..=1e6).contains(&n),
                        "must lie in [8, 1e6], e.g. 20; fewer steps cannot follow a contact",
                    )
                })
                .transpose()?,
            step: self
                .step
                .map(|step| document.positive("time.step", step))
                .transpose()?,
        })
    }
}

/// Table `[output]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutputTable {
    /// Rows of `bed.csv` in a stage.
    pub rows: usize,
    /// Frames of the VTP series in a stage.
    pub frames: usize,
    /// Frames of the page `bed.html` in a stage; none for no page.
    pub film: usize,
    /// Most frames of `animation.png`; none for no animation.
    pub animation: usize,
    /// Whether contacts are also written as `contacts/contacts_NNNN.csv`, one a VTP frame.
    pub contacts: bool,
    /// Whether grains are also written as `dump.lammpstrj`, with the VTP frames.
    pub dump: bool,
}

keys! {
    OutputTable {
        rows: key("rows of the CSV files in a stage", "≥ 1", "100").or("100"),
        frames: key("frames of the VTP series in a stage", "≥ 0", "8").or("4"),
        film: key("frames of `bed.html` in a stage; 0: no page", "≥ 0", "50").or("25"),
        animation: key("most frames of `animation.png`; 0: none; needs `film`", "≥ 0", "100").or("0"),
        contacts: key("contacts as CSV, one file a VTP frame", "", "true").or("false"),
        dump: key("grains as `dump.lammpstrj`, with the VTP frames", "", "true").or("false"),
    }
}

impl Default for OutputTable {
    fn default() -> Self {
        Self {
            rows: 100,
            frames: 4,
            film: 25,
            animation: 0,
            contacts: false,
            dump: false,
        }
    }
}

impl OutputTable {
    pub(super) fn check(self, document: &Document) -> Result<Self> {
        if self.rows == 0 {
            return Err(document.reject("output.rows", "must be at least 1"));
        }
        if self.animation > 0 && self.film == 0 {
            return Err(document.reject(
                "output.animation",
                "needs `output.film` above 0: it is made from that",
            ));
        }
        Ok(self)
    }
}
