//! Table `[scheme]` of case and study files: a published method in place of the crate's own.

use super::Case;
use crate::document::Document;
use crate::document::keys::{key, keys, names};
use crate::material::Flow;
use crate::material::ReferenceUnits;
use crate::material::flow::{HARDENING_MODULUS, YIELD_STRENGTH};
use crate::material::stress::Moduli;
use crate::scheme::preset::{Filling, Method, Preset, StepRule};
use crate::shape::Shape;
use crate::{Error, Result};
use serde::Deserialize;

names! {
    Preset {
        Thesis as "thesis",
        Tlmpm as "tlmpm",
        Ulmpm as "ulmpm",
        Flip as "flip",
        Pic as "pic",
        Apic as "apic",
    }
}

/// The table as it is written.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SchemeTable {
    preset: Preset,
    points: Option<u32>,
    ratio: Option<f64>,
    degree: Option<u32>,
    time_step: Option<f64>,
    dimensions: Option<u32>,
}

keys! {
    SchemeTable
    "A published method in place of the crate's own, for comparison with it: it is less accurate. Normal impacts of elastic, perfectly \
     plastic or linearly hardening spheres on a rigid, frictionless wall are run under it. `points`, `ratio`, `degree` and \
     `dimensions` are for presets on a lattice: `thesis`, `tlmpm`, `ulmpm`." {
        preset: key("`thesis`: total Lagrangian, cubic splines, FLIP, its lattice, contact of spheres of the point distance, one fixed step; `tlmpm`: total Lagrangian, linear, FLIP; `ulmpm`: updated Lagrangian, cubic, FLIP; `flip`, `pic`, `apic`: the planner's grid with this transfer of velocity", "", "'thesis'"),
        points: key("lattice points a diameter", "8 to 200", "50").or("50"),
        ratio: key("side of a cell over the distance of the points", "1 to 4", "1.05").or("1.05 of `thesis`, 2 of `tlmpm` and `ulmpm`"),
        degree: key("degree of the splines", "1 to 3", "3").or("3 of `thesis` and `ulmpm`, 1 of `tlmpm`"),
        time_step: key("a_t: of `thesis` the share of the power of ten, in seconds, below the time in which wave and body cross a cell; of `tlmpm` and `ulmpm` the share of that time; else the share of the stability limit", "(0, 1]", "0.1").or("0.5 of `pic` and `apic`, else 0.1"),
        dimensions: key("2: the axisymmetric section, 3: a quarter of the sphere; `ulmpm` is run in the section", "2 to 3", "3").or("3 of `thesis`, else 2"),
    }
}

impl SchemeTable {
    /// The method, with the preset's usual settings where the file names none.
    ///
    /// # Errors
    /// [`Error::Value`] for a setting out of its range, or one that the preset does not have.
    pub(crate) fn check(self, document: &Document) -> Result<Method> {
        let SchemeTable {
            preset,
            points,
            ratio,
            degree,
            time_step,
            dimensions,
        } = self;
        let mut method = preset.usual();
        let whole = |name: &str, value: Option<u32>| -> Result<Option<u32>> {
            let key = format!("scheme.{name}");
            value
                .map(|value| document.within(&key, f64::from(value)).map(|_| value))
                .transpose()
        };
        let (points, degree) = (whole("points", points)?, whole("degree", degree)?);
        let dimensions = whole("dimensions", dimensions)?;
        let ratio = ratio.map(|ratio| document.within("scheme.ratio", ratio));
        let ratio = ratio.transpose()?;
        let share = time_step.map(|share| document.within("scheme.time_step", share));
        if let Some(share) = share.transpose()? {
            method.step = method.step.with(share);
        }
        let Some(usual) = method.filling else {
            let given = [
                ("points", points.is_some()),
                ("ratio", ratio.is_some()),
                ("degree", degree.is_some()),
                ("dimensions", dimensions.is_some()),
            ];
            if let Some((name, _)) = given.into_iter().find(|(_, given)| *given) {
                let allowed = format!(
                    "must be left out: preset \"{}\" takes grid and points from the planner",
                    preset.name()
                );
                return Err(document.reject(&format!("scheme.{name}"), allowed));
            }
            return Ok(method);
        };
        method.filling = Some(Filling {
            points: points.unwrap_or(usual.points),
            ratio: ratio.unwrap_or(usual.ratio),
        });
        method.degree = degree.unwrap_or(method.degree);
        method.dimensions = dimensions.unwrap_or(method.dimensions);
        if preset == Preset::Ulmpm && method.dimensions == 3 {
            let allowed = "must be 2: the updated Lagrangian reference is in the section only";
            return Err(document.reject("scheme.dimensions", allowed));
        }
        Ok(method)
    }
}

impl Case {
    /// Time in which a dilatational wave and the body at `velocity` (m/s) cross a cell of `cell` R, in R/c0 (thesis, equation 3-27).
    #[must_use]
    pub fn crossing(&self, velocity: f64, cell: f64) -> f64 {
        let wave = Moduli::new(1.0, self.material.poisson_ratio).dilatational_speed(1.0);
        cell / (wave + velocity / ReferenceUnits::of(&self.material, self.radius).speed())
    }

    /// R/c0, s.
    #[must_use]
    pub fn unit_of_time(&self) -> f64 {
        ReferenceUnits::of(&self.material, self.radius).time()
    }

    /// A method as it stands for an impact at `velocity` (m/s), without seconds: a step of the order of the crossing time becomes a
    /// share of that time. The same impact in other units takes the same steps.
    #[must_use]
    pub fn without_seconds(&self, method: Method, velocity: f64) -> Method {
        let Some(filling) = method.filling else {
            return method;
        };
        let crossing = self.crossing(velocity, filling.cell());
        let share = (method.step)
            .fixed(crossing, self.unit_of_time())
            .map(|dt| dt / crossing);
        Method {
            step: share.map_or(method.step, StepRule::OfCrossing),
            ..method
        }
    }

    /// What of the case is not run under its preset: its key and what is allowed; nothing without a preset. `pair`: two deformable
    /// bodies are asked for.
    pub(crate) fn beyond_preset(&self, pair: bool) -> Option<(String, String)> {
        // whoever adds to a case says here whether presets know it
        let Case {
            name: _,
            path: _,
            hash: _,
            shape,
            radius: _,
            material,
            velocities: _,
            angle,
            friction,
            adhesion,
            tolerance: _,
            method,
            bed,
        } = self;
        let method = (*method)?;
        let refused = |key: &str, must: &str| {
            let allowed = format!(
                "{must} beside `scheme.preset`: preset \"{}\" is run for normal impacts of spheres on a rigid, frictionless wall",
                method.preset.name()
            );
            Some((key.to_owned(), allowed))
        };
        if *shape != Shape::Sphere {
            return refused("particle.shape", "must be \"sphere\"");
        }
        if pair {
            return refused("wall.material", "must be left out");
        }
        if *angle > 0.0 {
            return refused("impact.angle", "must be 0");
        }
        if *friction > 0.0 {
            return refused("wall.friction", "must be 0");
        }
        if adhesion.is_some() {
            return refused("wall.work_of_adhesion", "must be left out");
        }
        if bed.is_some() {
            return refused("bed.scene", "must be left out");
        }
        let constants = material
            .flow
            .as_ref()
            .map_or_else(Vec::new, Flow::constants);
        let mut others = constants
            .iter()
            .filter(|(constant, _)| ![YIELD_STRENGTH, HARDENING_MODULUS].contains(constant));
        let (constant, _) = others.next()?;
        let allowed = format!(
            "must be left out beside `scheme.preset`: preset \"{}\" is run for elastic, perfectly plastic and linearly hardening bodies",
            method.preset.name()
        );
        Some((format!("material.{}", constant.key), allowed))
    }

    /// That the case asks for the crate's own scheme, as `what` needs it.
    ///
    /// # Errors
    /// [`Error::Refused`] naming the preset.
    pub fn of_own_scheme(&self, what: &str) -> Result<()> {
        let Some(method) = self.method else {
            return Ok(());
        };
        Err(Error::Refused {
            what: format!("{}: `scheme.preset`", self.path.display()),
            found: format!("\"{}\"", method.preset.name()),
            allowed: format!(
                "must be left out: {what} is of the crate's own scheme; `impactlaw impact`, `run`, `fit`, `compare` and `study` take presets"
            ),
        })
    }
}
