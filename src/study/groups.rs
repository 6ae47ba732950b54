//! Groups: the dimensionless numbers that an impact depends on. They name the run a case stands for, make it, and are columns of
//! a study's results.

use crate::case::Case;
use crate::material::adhesion::Adhesion;
use crate::material::constant::{Absent, Dimension};
use crate::material::flow::YIELD_STRENGTH;
use crate::material::{Flow, Material, ReferenceUnits, YIELD_PRESSURE_RATIO};
use crate::scheme::preset::Method;
use crate::shape::Shape;
use std::path::PathBuf;

/// Units of every kept run: R = rho = E = 1.
pub const REFERENCE: ReferenceUnits = ReferenceUnits {
    length: 1.0,
    density: 1.0,
    stress: 1.0,
};

/// Dimensionless groups of a case, to nine digits. Two cases with equal groups are the same run, scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// Flow stress with its constants in reference units: Y/E, H/E and what else the kind has.
    flow: Option<Flow>,
    /// $\rho V^2/E$.
    speed: f64,
    poisson_ratio: f64,
    angle: f64,
    friction: f64,
    /// $w/(E R)$, and the range over R where the case says it.
    adhesion: Option<(f64, Option<f64>)>,
    tolerance: f64,
    /// Published method, its step without seconds.
    method: Option<Method>,
}

/// `x` to nine digits.
fn nine_digits(x: f64) -> f64 {
    format!("{x:.8e}").parse().unwrap_or(x)
}

impl Groups {
    /// Groups of a case and its first speed.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        // whoever adds to a case says here whether it makes another run
        let Case {
            name: _,
            path: _,
            hash: _,
            bed: _,
            // studies are of spheres
            shape: _,
            radius,
            material,
            velocities,
            angle,
            friction,
            adhesion,
            tolerance,
            method,
        } = case;
        let Material {
            density,
            young_modulus,
            poisson_ratio,
            flow,
        } = material;
        let units = ReferenceUnits::of(material, *radius);
        let flow = flow.map(|flow| flow.in_reference(&units).with_each(nine_digits));
        let speed = velocities
            .first()
            .map_or(0.0, |v| density * v * v / young_modulus);
        Groups {
            flow,
            speed: nine_digits(speed),
            poisson_ratio: *poisson_ratio,
            angle: nine_digits(*angle),
            friction: *friction,
            adhesion: adhesion.map(|Adhesion { work, range }| {
                let range = range.map(|range| nine_digits(range / units.length));
                (nine_digits(work / (units.stress * units.length)), range)
            }),
            tolerance: *tolerance,
            method: method.map(|method| {
                let velocity = velocities.first().copied().unwrap_or_default();
                let method = case.without_seconds(method, velocity);
                Method {
                    step: method.step.with(nine_digits(method.step.share())),
                    ..method
                }
            }),
        }
    }

    /// Name of the run: every group with its value.
    #[must_use]
    pub fn name(&self) -> String {
        let Groups {
            flow,
            speed,
            poisson_ratio,
            angle,
            friction,
            adhesion,
            tolerance,
            method,
        } = self;
        let adhesion = adhesion.map_or_else(String::new, |(work, range)| {
            let range = range.map_or_else(String::new, |range| format!("_range{range:.8e}"));
            format!("_wER{work:.8e}{range}")
        });
        let flow = flow.map_or("elastic".to_owned(), |flow| {
            let constants = flow.constants().into_iter();
            let texts =
                constants.map(|(constant, value)| format!("{}{value:.8e}", constant.symbol));
            texts.collect::<Vec<_>>().join("_")
        });
        let method = method.map_or_else(String::new, |method| {
            let Method {
                preset,
                filling,
                degree,
                step,
                dimensions,
            } = method;
            let lattice =
                filling.map_or_else(String::new, |f| format!("{}x{:e}", f.points, f.ratio));
            format!(
                "_{}{lattice}_degree{degree}_step{:.8e}_{dimensions}D",
                preset.name(),
                step.share()
            )
        });
        format!(
            "{flow}_rhoV2E{speed:.8e}_nu{poisson_ratio:e}_angle{angle:.8e}_mu{friction:e}{adhesion}_tol{tolerance:e}{method}"
        )
    }

    /// The case that is run for every one with these groups: R = rho = E = 1. It follows from the groups alone, so a kept run is
    /// the same whichever case of whichever file it was made for.
    #[must_use]
    pub fn case(&self) -> Case {
        let Groups {
            flow,
            speed,
            poisson_ratio,
            angle,
            friction,
            adhesion,
            tolerance,
            method,
        } = self;
        let name = self.name();
        Case {
            path: PathBuf::from(&name),
            name,
            hash: "0".repeat(64),
            shape: Shape::Sphere,
            radius: REFERENCE.length,
            material: Material {
                density: REFERENCE.density,
                young_modulus: REFERENCE.stress,
                poisson_ratio: *poisson_ratio,
                flow: *flow,
            },
            velocities: vec![speed.sqrt()],
            angle: *angle,
            friction: *friction,
            adhesion: adhesion.map(|(work, range)| Adhesion { work, range }),
            tolerance: *tolerance,
            method: *method,
            bed: None,
        }
    }

    /// Names of [`Groups::columns`], which are the same for every case.
    #[must_use]
    pub fn column_names() -> Vec<String> {
        let any = Groups {
            flow: None,
            speed: 1.0,
            poisson_ratio: 0.3,
            angle: 0.0,
            friction: 0.0,
            adhesion: None,
            tolerance: 0.1,
            method: None,
        };
        any.columns().into_iter().map(|(name, _)| name).collect()
    }

    /// Columns of the groups with their values: those that the inputs beside them do not say; NaN where a body has no such
    /// number.
    #[must_use]
    pub fn columns(&self) -> Vec<(String, f64)> {
        let case = self.case();
        let speed = case.velocities[0] * self.angle.cos();
        let first_yield = case.material.yield_point(case.radius, YIELD_PRESSURE_RATIO);
        let strength = self.flow.map(|flow| flow.yield_strength());
        let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let mut all = vec![
            (
                "young_over_yield".to_owned(),
                or_nan(strength.map(f64::recip)),
            ),
            ("rho_V2_over_E".to_owned(), self.speed),
            (
                "rho_V2_over_Y".to_owned(),
                or_nan(strength.map(|strength| self.speed / strength)),
            ),
            (
                "V_over_Vy".to_owned(),
                or_nan(first_yield.map(|first| speed / first.velocity)),
            ),
        ];
        let own = self.flow.map_or_else(Vec::new, |flow| flow.constants());
        for constant in Flow::all_constants() {
            let found = own.iter().find(|(own, _)| *own == constant);
            let found = found.map(|(_, value)| *value);
            let absent = self.flow.is_some() && constant.absent == Absent::Nothing;
            let (name, value) = match constant.dimension {
                _ if constant == YIELD_STRENGTH => continue,
                // as the file says them
                Dimension::Number | Dimension::Temperature => continue,
                Dimension::Stress => (
                    format!("{}_over_young", constant.key.replace("_modulus", "")),
                    found.or(absent.then_some(0.0)),
                ),
                Dimension::Rate => (
                    format!("V_over_R_{}", constant.key),
                    found.map(|rate| case.velocities[0] / rate),
                ),
                Dimension::SpecificHeat => (
                    "heat_to_melt_over_yield".to_owned(),
                    self.flow
                        .and_then(Flow::heat_to_melt)
                        .zip(strength)
                        .map(|(heat, strength)| heat / strength),
                ),
            };
            all.push((name, or_nan(value)));
        }
        all
    }
}
