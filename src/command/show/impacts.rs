//! Impacts shown: plan, force-displacement curves, restitution, and fields over the particle.

use super::{Loop, NamedLaw, Restitution, Sphere, ValidTo};
use crate::Result;
use crate::case::Case;
use crate::curve::{Impact, MapPoint, Part, ParticleMap};
use crate::impact::Simulated;
use crate::impact::pair::SimulatedPair;
use crate::plan::Plan;
use crate::report::chart::{Mark, Series};
use crate::report::field_map::FieldMap;
use crate::report::figure::Figure;
use crate::report::palette::Role;
use crate::report::raster::FieldPoint;
use crate::report::run_page::Choice;
use crate::unit::{engineering, significant};

/// Speeds at which the restitution of a law is drawn.
const SPEEDS: u32 = 60;
/// Share of the volume whose values may lie beyond the end of a colour bar.
const BEYOND: f64 = 0.01;
/// What [`BEYOND`] means for the reader.
const CAPPED: &str = "One per cent of the volume in question lies beyond the end of the colours.";

/// What was planned: each effect with the reason at every speed, said once where it is the same; the grid of each speed.
#[must_use]
pub fn choices(case: &Case, plans: &[Plan]) -> Vec<Choice> {
    let mut choices: Vec<Choice> = Vec::new();
    let effects = plans.iter().flat_map(|plan| {
        let speed = significant(plan.velocity, 4);
        plan.effects
            .iter()
            .map(move |effect| (speed.clone(), effect))
    });
    // speeds of each reason of each decision, in order
    let mut reasons: Vec<(&str, bool, &str, Vec<String>)> = Vec::new();
    for (speed, effect) in effects {
        let known = reasons.iter_mut().find(|(name, on, reason, _)| {
            *name == effect.name && *on == effect.on && *reason == effect.reason
        });
        match known {
            Some((.., speeds)) => speeds.push(speed),
            None => reasons.push((effect.name, effect.on, &effect.reason, vec![speed])),
        }
    }
    for (name, on, reason, speeds) in reasons {
        let setting = if on { "on" } else { "off" };
        let reason = match speeds.len() == plans.len() {
            true => reason.to_owned(),
            false => format!("{} m/s: {reason}", speeds.join(", ")),
        };
        let reason = reason.replace("rho V^2", "ρV²");
        let known = |other: &&mut Choice| other.what == name && other.setting == setting;
        match choices.iter_mut().find(known) {
            Some(choice) => choice.reason = format!("{}; {reason}", choice.reason),
            None => choices.push(Choice {
                what: name.to_owned(),
                setting: setting.to_owned(),
                reason,
            }),
        }
    }
    let length = |reduced: f64| engineering(reduced * case.radius, "m", 3);
    choices.extend(plans.iter().map(|plan| Choice {
        what: format!("grid at {} m/s", significant(plan.velocity, 4)),
        setting: format!(
            "degree {}, cells of {} at the pole growing to {}",
            plan.grid.degree,
            length(plan.grid.fine),
            length(plan.grid.coarse)
        ),
        reason: format!(
            "{} cells in the expected contact radius of {}; {} points, {} steps",
            significant(plan.estimate.contact_radius / plan.grid.fine, 2),
            length(plan.estimate.contact_radius),
            plan.points,
            plan.steps
        ),
    }));
    choices
}

/// Theories drawn beside simulation and fitted law: with more, curves are no longer told apart.
const DRAWN: usize = 4;

/// The fitted law and the theories that come first in `ranking`, best first.
fn drawn<'a>(laws: &'a [NamedLaw], ranking: &[&str]) -> Vec<&'a NamedLaw> {
    let ours = laws.iter().filter(|law| law.role == Role::Law);
    let theory = |name: &&str| {
        laws.iter()
            .find(|law| law.name == *name && law.role != Role::Law)
    };
    ours.chain(ranking.iter().filter_map(theory).take(DRAWN))
        .collect()
}

/// Force against displacement at each speed, and restitution against speed: of the simulation, the fitted law and the
/// first theories of `ranking`.
///
/// # Errors
/// [`crate::Error::Figure`] when one cannot be drawn, and those of [`crate::law::AnyLaw::visit`].
pub fn curves(
    case: &Case,
    impacts: &[&Impact],
    laws: &[NamedLaw],
    ranking: &[&str],
) -> Result<Vec<Figure>> {
    let laws = drawn(laws, ranking);
    let sphere = Sphere {
        radius: case.radius,
        mass: case.material.sphere_mass(case.radius),
    };
    let mut figures = Vec::new();
    for impact in impacts {
        let speed = impact.summary.velocity_m_s;
        let lines = laws
            .iter()
            .map(|law| {
                let end = law.law.visit(ValidTo)? * case.radius * (1.0 + ROUNDING);
                Ok(line(law, law.law.visit(Loop(sphere, speed))?, end))
            })
            .collect::<Result<Vec<_>>>()?;
        figures.push(Figure::force_displacement(speed, &impact.curve, &lines)?);
    }
    figures.push(restitution(sphere, impacts, &laws)?);
    Ok(figures)
}

/// What a law may reach beyond the end of its range and still be in it: the fastest impact of a fitted law is that end.
const ROUNDING: f64 = 1e-2;

/// Line of a law whose source supports it up to `end` on the horizontal axis.
fn line(law: &NamedLaw, points: Vec<(f64, f64)>, end: f64) -> Series {
    Series {
        label: law.name.clone(),
        role: law.role,
        mark: Mark::Line,
        points,
        supported_to: end.is_finite().then_some(end),
    }
}

/// From a tenth of the slowest impact, where laws part from Hertz, to a little past the fastest.
fn restitution(sphere: Sphere, impacts: &[&Impact], laws: &[&NamedLaw]) -> Result<Figure> {
    let speed = |impact: &&Impact| impact.summary.velocity_m_s;
    let low = 0.1 * impacts.iter().map(speed).fold(f64::INFINITY, f64::min);
    let high = 1.2 * impacts.iter().map(speed).fold(0.0, f64::max);
    let part = |i: u32| f64::from(i) / f64::from(SPEEDS);
    let speeds: Vec<f64> = (0..=SPEEDS)
        .map(|i| low * (high / low).powf(part(i)))
        .collect();
    let mut series = vec![Series {
        label: "MPM".to_owned(),
        role: Role::Simulation,
        mark: Mark::Points,
        points: impacts
            .iter()
            .map(|impact| (speed(impact), impact.summary.restitution))
            .collect(),
        supported_to: None,
    }];
    for law in laws {
        let end = law.law.visit(ValidTo)? * sphere.radius * (1.0 + ROUNDING);
        let bounces = law.law.visit(Restitution(sphere, &speeds))?;
        let inside = bounces.iter().filter(|bounce| bounce.displacement <= end);
        let fastest = match bounces.iter().all(|bounce| bounce.displacement <= end) {
            true => f64::INFINITY,
            false => inside.map(|bounce| bounce.velocity).fold(0.0, f64::max),
        };
        let points = bounces
            .iter()
            .map(|bounce| (bounce.velocity, bounce.restitution));
        series.push(line(law, points.collect(), fastest));
    }
    Figure::restitution(series)
}

/// The particle of an impact at two moments.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// Impact speed, m/s.
    velocity: f64,
    compressed: &'a ParticleMap,
    rebound: &'a ParticleMap,
}

impl<'a> From<&'a Simulated> for Shown<'a> {
    fn from(one: &'a Simulated) -> Self {
        Shown {
            velocity: one.impact.summary.velocity_m_s,
            compressed: &one.compressed,
            rebound: &one.rebound,
        }
    }
}

impl<'a> From<&'a SimulatedPair> for Shown<'a> {
    fn from(one: &'a SimulatedPair) -> Self {
        Shown {
            velocity: one.impact.summary.velocity_m_s,
            compressed: &one.compressed[0],
            rebound: &one.rebound[0],
        }
    }
}

/// Von Mises stress at the largest compression and plastic strain after rebound, at the slowest and the fastest speed.
///
/// # Errors
/// [`crate::Error::Figure`] when one cannot be drawn.
pub fn maps(impacts: &[Shown]) -> Result<Vec<Figure>> {
    let mut shown: Vec<&Shown> = impacts.first().into_iter().collect();
    if impacts.len() > 1 {
        shown.extend(impacts.last());
    }
    let mut figures = Vec::new();
    for one in shown {
        let speed = significant(one.velocity, 4);
        figures.push(map(
            format!("von_mises_V{speed}"),
            format!("Von Mises stress at the largest compression, {speed} m/s. {CAPPED}"),
            field("von Mises stress", "Pa", one.compressed, |p| p.von_mises_pa),
        )?);
        let strain = field("equivalent plastic strain", "", one.rebound, |p| {
            p.equivalent_plastic_strain
        });
        if strain.points.iter().any(|point| point.value > 0.0) {
            figures.push(map(
                format!("plastic_strain_V{speed}"),
                format!("Equivalent plastic strain after the rebound, {speed} m/s. {CAPPED}"),
                FieldMap {
                    window: window(&strain),
                    ..strain
                },
            )?);
        }
    }
    Ok(figures)
}

fn map(name: String, caption: String, field: FieldMap) -> Result<Figure> {
    Ok(Figure::plain(name, caption, field.svg()?))
}

/// A field of a map; heights are measured from the lowest point, which a rebounding particle carries away from the wall.
fn field(
    label: &str,
    unit: &'static str,
    map: &ParticleMap,
    value: fn(&MapPoint) -> f64,
) -> FieldMap {
    let lowest = map
        .points
        .iter()
        .map(|p| p.z_m)
        .fold(f64::INFINITY, f64::min);
    let of = |part: Part| map.points.iter().filter(move |p| p.part == part);
    FieldMap {
        label: label.to_owned(),
        unit,
        points: of(Part::Inside)
            .map(|p| FieldPoint {
                r: p.r_m,
                z: p.z_m - lowest,
                size: p.size_m,
                value: value(p),
            })
            .collect(),
        outline: of(Part::Surface).map(|p| (p.r_m, p.z_m - lowest)).collect(),
        top: Some(top(map, value)),
        window: None,
    }
}

/// Value exceeded in [`BEYOND`] of the volume where there is any: the end of the colour bar, so that a few points at the
/// edge of the contact do not take the colours from all others.
fn top(map: &ParticleMap, value: fn(&MapPoint) -> f64) -> f64 {
    let mut weighed: Vec<(f64, f64)> = map
        .points
        .iter()
        .filter(|p| p.part == Part::Inside && value(p) > 0.0)
        .map(|p| (value(p), p.r_m * p.size_m * p.size_m))
        .collect();
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all: f64 = weighed.iter().map(|(_, volume)| volume).sum();
    let mut volume = 0.0;
    for (value, share) in weighed {
        volume += share;
        if volume >= BEYOND * all {
            return value;
        }
    }
    0.0
}

/// Half width of a window around what is above a fiftieth of the largest value; none if that is most of the particle.
fn window(field: &FieldMap) -> Option<f64> {
    let largest = field.points.iter().map(|p| p.value).fold(0.0, f64::max);
    let reach = field
        .points
        .iter()
        .filter(|p| p.value > 0.02 * largest)
        .map(|p| p.r.max(0.5 * p.z))
        .fold(0.0, f64::max);
    let whole = field.points.iter().map(|p| p.r).fold(0.0, f64::max);
    let half_width = 1.4 * reach;
    (half_width < 0.7 * whole).then_some(half_width)
}
