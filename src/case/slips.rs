//! Slips of units: values that no particle has, so that "250 m" for "250 um" stops before the first step.
//!
//! The bounds lie beyond every solid that is known to be shot at walls, not beyond what the solver can do. What is meant all
//! the same is named in the case file: `unusual = ["particle.radius"]`.

use super::Case;
use crate::document::Document;
use crate::material::constant::{Constant, Dimension};
use crate::material::flow::YIELD_STRENGTH;
use crate::material::{Flow, Material};
use crate::unit::{engineering, significant};
use crate::{Error, Result};
use std::ops::RangeInclusive;

const RADIUS: &str = "particle.radius";
const DENSITY: &str = "material.density";
const MODULUS: &str = "material.young_modulus";
const POISSON: &str = "material.poisson_ratio";
const ADHESION: &str = "wall.work_of_adhesion";
const VELOCITIES: &str = "impact.velocities";

/// Radius, m: from some dozens of atoms to a boulder.
const RADII: RangeInclusive<f64> = 1e-8..=10.0;
/// Density, kg/m3: from light foams, and above all numbers meant in g/cm3, to osmium.
const DENSITIES: RangeInclusive<f64> = 25.0..=25e3;
/// Young's modulus, Pa: from the softest gels to twice that of diamond.
const MODULI: RangeInclusive<f64> = 1e3..=2e12;
/// Poisson's ratio up to which the solver is compared with others; a misprint beyond.
const LARGEST_POISSON: f64 = 0.49;
/// Largest Y/E: the ideal strength of solids is about a tenth of E.
const LARGEST_STRENGTH: f64 = 0.5;
/// Smallest Y/E: annealed metals of technical purity have some 1e-4, and a strength that lost a prefix 1e-5 and less.
const LEAST_STRENGTH: f64 = 1e-5;
/// Density, kg/m3, and Young's modulus, Pa: what is denser than the first (metals, heavy ceramics) is stiffer than the second.
const HEAVY: (f64, f64) = (3500.0, 0.5e9);
/// Smallest hardening or other stress over the yield strength, unless it is 0: less changes no figure of an impact.
const LEAST_STRESS: f64 = 1e-3;
/// Specific heat, J/(kg K): from half of what heavy metals have, and above all numbers meant in J/(g K), to twice that of ice, lithium and
/// paraffin.
const HEATS: RangeInclusive<f64> = 50.0..=1e4;
/// Smallest speed over $\sqrt{E/\rho}$: a flattening of 1e-8 R, some digits above the rounding of positions.
const LEAST_MACH: f64 = 1e-10;
/// Work of adhesion, J/m2: from a hundredth of what repels least in a liquid to four times that of the strongest metals. Numbers meant in mJ/m2 lie
/// above.
const WORKS: RangeInclusive<f64> = 1e-6..=20.0;
/// Largest acceleration of gravity, m/s2.
const LARGEST_GRAVITY: f64 = 5e3;
/// Largest $\rho V^2/Y$: a tenth of it flattens the body to a fiftieth of its height.
const LARGEST_SEVERITY: f64 = 150.0;

/// What is taken without a question, a row a quantity: for the guide, which a test holds to it.
#[cfg(test)]
fn accepted() -> Vec<(String, String)> {
    let stress = |x: f64| engineering(x, "Pa", 4);
    let between = |range: &RangeInclusive<f64>, unit: &str| {
        let [low, high] = [range.start(), range.end()].map(|x| engineering(*x, unit, 4));
        format!("{low} to {high}")
    };
    let (heavy, soft) = HEAVY;
    [
        ("`particle.radius`", between(&RADII, "m")),
        ("`material.density`", between(&DENSITIES, "kg/m³")),
        (
            "`material.young_modulus`",
            format!(
                "{}; from {} where the density is above {heavy} kg/m³",
                between(&MODULI, "Pa"),
                stress(soft)
            ),
        ),
        ("`material.poisson_ratio`", format!("0 to {LARGEST_POISSON}")),
        (
            "`material.yield_strength`",
            format!("E/{:e} to E/{}", (1.0 / LEAST_STRENGTH).round(), 1.0 / LARGEST_STRENGTH),
        ),
        (
            "`material.hardening_modulus` and other stresses",
            format!("0, or {LEAST_STRESS} Y to E"),
        ),
        ("`material.specific_heat`", between(&HEATS, "J/(kg K)")),
        (
            "`wall.work_of_adhesion`",
            format!("0, or {}", between(&WORKS, "J/m²")),
        ),
        (
            "`impact.velocities`",
            format!(
                "{LEAST_MACH:e} c to c, c = √(E/ρ); ρV²/Y up to {LARGEST_SEVERITY}; elastic: δ* up to R"
            ),
        ),
    ]
    .map(|(key, range)| (key.to_owned(), range))
    .to_vec()
}

/// Keys that `unusual` can name.
fn keys() -> Vec<String> {
    let flow = Flow::all_constants();
    let flow = flow.iter().map(key_of);
    [RADIUS, DENSITY, MODULUS, POISSON, ADHESION, VELOCITIES]
        .map(str::to_owned)
        .into_iter()
        .chain(flow)
        .collect()
}

/// Key of a constant of the flow stress.
fn key_of(constant: &Constant) -> String {
    format!("material.{}", constant.key)
}

/// What is wrong with a value, when it is.
pub(crate) type Slip = Option<String>;

/// That `unusual` names keys that it can.
///
/// # Errors
/// [`Error::Value`] naming the first one that is none.
pub(crate) fn check_names(document: &Document, unusual: &[String]) -> Result<()> {
    check_among(document, unusual, &keys())
}

/// That `unusual` names some of `keys`.
fn check_among(document: &Document, unusual: &[String], keys: &[String]) -> Result<()> {
    match unusual.iter().position(|key| !keys.contains(key)) {
        Some(i) => {
            let allowed = format!("must be one of {}", keys.join(", "));
            Err(document.reject(&format!("unusual[{i}]"), allowed))
        }
        None => Ok(()),
    }
}

/// Values of a case that look like a slip and are not named in `unusual`: key, index of the speed, and what to do.
pub(crate) fn of(
    case: &Case,
    velocities: &[f64],
    unusual: &[String],
) -> Vec<(String, Option<usize>, String)> {
    let told = |(key, index, why): (String, Option<usize>, String)| {
        let allowed = meant(&key, &why);
        (!unusual.contains(&key)).then_some((key, index, allowed))
    };
    reasons(case, velocities)
        .into_iter()
        .filter_map(told)
        .collect()
}

/// What to do about a value that looks like a slip.
pub(crate) fn meant(key: &str, why: &str) -> String {
    format!(
        "check the unit of {key}: {why}; if it is meant, begin the file with `unusual = [\"{key}\"]`"
    )
}

/// Radius, density and modulus of grains, under the names of their keys. Softer ones than true are usual in beds, and are no slip.
pub(crate) fn of_grains(radii: [f64; 2], material: &Material) -> [(&'static str, Slip); 3] {
    let radius = |radius: f64| outside(radius, &RADII, "m");
    [
        ("radius", radius(radii[0]).or_else(|| radius(radii[1]))),
        ("density", outside(material.density, &DENSITIES, "kg/m³")),
        (
            "young_modulus",
            outside(material.young_modulus, &MODULI, "Pa"),
        ),
    ]
}

/// Acceleration of gravity: a centrifuge has some hundreds of the earth's.
pub(crate) fn of_gravity(gravity: f64) -> Slip {
    (gravity > LARGEST_GRAVITY).then(|| {
        format!(
            "{} is above {}, more than centrifuges have",
            engineering(gravity, "m/s²", 4),
            engineering(LARGEST_GRAVITY, "m/s²", 4)
        )
    })
}

/// Values of a case that look like a slip: key, index of the speed, why.
pub(crate) fn reasons(case: &Case, velocities: &[f64]) -> Vec<(String, Option<usize>, String)> {
    let Material {
        density,
        young_modulus,
        poisson_ratio,
        flow,
    } = case.material;
    let mut found = vec![
        (RADIUS.to_owned(), None, outside(case.radius, &RADII, "m")),
        (
            DENSITY.to_owned(),
            None,
            outside(density, &DENSITIES, "kg/m³"),
        ),
        (
            MODULUS.to_owned(),
            None,
            outside(young_modulus, &MODULI, "Pa").or_else(|| soft(density, young_modulus)),
        ),
        (POISSON.to_owned(), None, poisson(poisson_ratio)),
    ];
    let strength = flow.map_or(0.0, |flow| flow.yield_strength());
    for (constant, value) in flow.map_or_else(Vec::new, |flow| flow.constants()) {
        let slip = flow_slip(&constant, value, young_modulus, strength);
        found.push((key_of(&constant), None, slip));
    }
    if let Some(adhesion) = case.adhesion {
        let slip = outside(adhesion.work, &WORKS, "J/m²");
        found.push((ADHESION.to_owned(), None, slip));
    }
    for (i, velocity) in velocities.iter().enumerate() {
        let slip = velocity_slip(&case.material, *velocity);
        found.push((VELOCITIES.to_owned(), Some(i), slip));
    }
    let slips = found.into_iter();
    slips
        .filter_map(|(key, index, slip)| Some((key, index, slip?)))
        .collect()
}

/// That no value of the case file is a slip, but for those named in `unusual`; of a `pair` the names are checked with the second body.
///
/// # Errors
/// [`Error::Value`] naming the first one, and how to keep it.
pub(super) fn check(
    case: &Case,
    velocities: &[f64],
    document: &Document,
    unusual: &[String],
    pair: bool,
) -> Result<()> {
    if !pair {
        check_names(document, unusual)?;
    }
    match of(case, velocities, unusual).into_iter().next() {
        Some((key, index, allowed)) => {
            let end = index.map_or_else(String::new, |i| format!("[{i}]"));
            Err(document.reject(&format!("{key}{end}"), allowed))
        }
        None => Ok(()),
    }
}

/// The same for the second body of a case, given as one of a particle of its material and radius; its keys stand in `[wall]`.
///
/// # Errors
/// As [`check`].
pub(super) fn check_target(
    as_particle: &Case,
    document: &Document,
    unusual: &[String],
) -> Result<()> {
    let in_wall = |key: &str| match key {
        RADIUS => "wall.radius".to_owned(),
        key => format!("wall.{key}"),
    };
    let own = keys();
    let of_wall = own
        .iter()
        .filter(|key| ![VELOCITIES, ADHESION].contains(&&key[..]));
    let of_wall = of_wall.map(|key| in_wall(key));
    let all: Vec<String> = own.iter().cloned().chain(of_wall).collect();
    check_among(document, unusual, &all)?;
    let all = reasons(as_particle, &[]).into_iter();
    let mut found = all.map(|(key, _, why)| (in_wall(&key), why));
    match found.find(|(key, _)| !unusual.contains(key)) {
        Some((key, why)) => Err(document.reject(&key, meant(&key, &why))),
        None => Ok(()),
    }
}

/// The same for a speed of the command line; one that the file's own speeds were allowed to be is allowed here.
///
/// # Errors
/// [`Error::Refused`].
pub(super) fn check_argument(case: &Case, velocity: f64, text: &str) -> Result<()> {
    let slip = |v: f64| velocity_slip(&case.material, v);
    match slip(velocity) {
        Some(why) if case.velocities.iter().all(|v| slip(*v).is_none()) => Err(Error::Refused {
            what: "--velocity".to_owned(),
            found: format!("\"{text}\""),
            allowed: format!(
                "check the unit: {why}; if it is meant, give it in the case file, beside `unusual = [\"{VELOCITIES}\"]`"
            ),
        }),
        _ => Ok(()),
    }
}

fn outside(value: f64, range: &RangeInclusive<f64>, unit: &str) -> Slip {
    let text = |x: f64| engineering(x, unit, 4);
    (!range.contains(&value)).then(|| {
        format!(
            "{} is not between {} and {}",
            text(value),
            text(*range.start()),
            text(*range.end())
        )
    })
}

fn poisson(ratio: f64) -> Slip {
    (ratio > LARGEST_POISSON).then(|| {
        format!("{ratio} is above {LARGEST_POISSON}, where a body is all but incompressible")
    })
}

/// A modulus that nothing so dense has.
fn soft(density: f64, modulus: f64) -> Slip {
    (density > HEAVY.0 && modulus < HEAVY.1).then(|| {
        format!(
            "{} is less than metals and ceramics have, and it is as dense as they are",
            engineering(modulus, "Pa", 4)
        )
    })
}

/// A yield strength that no solid has beside this modulus, another stress above the modulus or far below the strength, or a heat
/// that no solid takes.
fn flow_slip(constant: &Constant, value: f64, modulus: f64, strength: f64) -> Slip {
    let share = value / modulus;
    let said = |what: &str| Some(format!("E/Y = {} is {what}", significant(1.0 / share, 3)));
    if *constant == YIELD_STRENGTH {
        return match share {
            share if share > LARGEST_STRENGTH => said("less than any solid's"),
            share if share < LEAST_STRENGTH => said("more than any solid's"),
            _ => None,
        };
    }
    match constant.dimension {
        Dimension::Stress if share > 1.0 => Some("it is above young_modulus".to_owned()),
        Dimension::Stress if value > 0.0 && value < LEAST_STRESS * strength => {
            let ratio = significant(value / strength, 3);
            Some(format!(
                "it is {ratio} of yield_strength, which changes nothing; 0 is none"
            ))
        }
        Dimension::SpecificHeat => outside(value, &HEATS, constant.dimension.unit()),
        _ => None,
    }
}

/// A speed above that of sound, one too slow to be told from rest, or one that no body survives.
fn velocity_slip(material: &Material, velocity: f64) -> Slip {
    let sound = (material.young_modulus / material.density).sqrt();
    let severity = material.flow.map_or(0.0, |flow| {
        material.density * velocity * velocity / flow.yield_strength()
    });
    let [elastic, _] = material.flattening_limits(velocity);
    let named = engineering(velocity, "m/s", 4);
    if velocity > sound {
        let sound = engineering(sound, "m/s", 3);
        Some(format!(
            "{named} is above the speed of sound sqrt(E/rho), {sound}"
        ))
    } else if velocity < LEAST_MACH * sound {
        Some(format!(
            "{named} is rest: the flattening would be below 1e-8 R"
        ))
    } else if severity > LARGEST_SEVERITY {
        let severity = significant(severity, 3);
        Some(format!(
            "rho V^2/Y = {severity}: nothing is left of the body"
        ))
    } else if material.flow.is_none() && elastic > 1.0 {
        let ratio = significant(elastic, 3);
        Some(format!("the expected delta* is {ratio} radii"))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_guide_states_what_is_taken_without_a_question() {
        let guide = include_str!("../guide/first-case.md");
        for (key, range) in super::accepted() {
            let row = format!("| {key} | {range} |");
            assert!(guide.contains(&row), "the guide lacks\n{row}");
        }
    }
}
