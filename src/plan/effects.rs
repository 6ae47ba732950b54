//! Effects: which of them a scene calls for, why, and what those on the flow stress change.

use super::adhesion::Felt;
use super::{Effect, Geometry, LARGE_FROM, bar, geometry, severity};
use crate::case::Case;
use crate::material::flow::{Past, YIELD_STRENGTH};
use crate::material::{Flow, YIELD_PRESSURE_RATIO};
use crate::shape::Shape;
use crate::unit::{engineering, significant};

/// Which effects the scene calls for.
pub(super) fn of(case: &Case, velocity: f64) -> (Vec<Effect>, bool) {
    let material = &case.material;
    let yields_at = match case.shape {
        Shape::Sphere => material
            .yield_point(case.radius, YIELD_PRESSURE_RATIO)
            .map(|first| first.velocity),
        Shape::Cylinder { .. } => bar::yield_speed(material),
    };
    let adhesion = Felt::of(case, velocity);
    let adheres = adhesion.as_ref().is_some_and(|felt| felt.is_on(case));
    let slow = |least: f64| velocity <= least && case.shape == Shape::Sphere;
    let (plastic, why) = match yields_at {
        None => (false, "the material has no yield strength".to_owned()),
        Some(least) if slow(least) && adheres => (
            true,
            format!(
                "V <= V_y = {}, but the wall's attraction may make it yield",
                engineering(least, "m/s", 3)
            ),
        ),
        Some(least) if slow(least) => (
            false,
            format!("V <= V_y = {}", engineering(least, "m/s", 3)),
        ),
        Some(least) => (
            true,
            format!(
                "V is {} times V_y = {}",
                significant(velocity / least, 3),
                engineering(least, "m/s", 3)
            ),
        ),
    };
    let solid = geometry(case) != Geometry::Axisymmetric;
    let severity = severity(&case.material, velocity);
    let mut list = vec![
        Effect {
            name: "three dimensions",
            on: solid,
            reason: match geometry(case) {
                Geometry::Axisymmetric if case.angle > 0.0 => {
                    "without friction only the normal velocity matters".to_owned()
                }
                Geometry::Axisymmetric => "a normal impact on a plane is axisymmetric".to_owned(),
                Geometry::Quarter => {
                    "friction acts in the wall; a quarter, two planes of symmetry".to_owned()
                }
                Geometry::Half => format!(
                    "{} from the normal; a half, one plane of symmetry",
                    engineering(case.angle.to_degrees(), "deg", 3)
                ),
            },
        },
        Effect {
            name: "friction",
            on: solid,
            reason: if solid {
                format!("coefficient {}", case.friction)
            } else {
                "the wall is frictionless".to_owned()
            },
        },
        Effect {
            name: "plasticity",
            on: plastic,
            reason: why,
        },
    ];
    list.extend(flow_effects(case, velocity, plastic));
    list.extend([
        Effect {
            name: "large deformation",
            on: severity > LARGE_FROM,
            reason: format!(
                "rho V^2/Y is {}, remedies start at {LARGE_FROM}",
                significant(severity, 3)
            ),
        },
        adhesion.map_or_else(
            || Effect {
                name: "adhesion",
                on: false,
                reason: "the wall does not adhere".to_owned(),
            },
            |felt| felt.effect(case),
        ),
        Effect {
            name: "gravity",
            on: false,
            reason: "the impact is over long before gravity moves the particle".to_owned(),
        },
    ]);
    (list, plastic)
}

/// Effects on the flow stress besides yielding, of every kind there is: on where the material has their constants.
pub(super) fn flow_effects(case: &Case, velocity: f64, plastic: bool) -> Vec<Effect> {
    let flow = case.material.flow;
    let own = flow.map_or_else(Vec::new, |flow| flow.constants());
    let mut list: Vec<Effect> = Vec::new();
    for constant in Flow::all_constants() {
        let name = constant.effect;
        if name == YIELD_STRENGTH.effect || list.iter().any(|effect| effect.name == name) {
            continue;
        }
        let given: Vec<String> = own
            .iter()
            .filter(|(c, value)| c.effect == name && *value != 0.0)
            .map(|(c, value)| {
                let text = match c.dimension.unit() {
                    "Pa" => format!("{} = {}", c.symbol, engineering(*value, "Pa", 4)),
                    unit => format!("{} = {} {unit}", c.symbol, significant(*value, 4)),
                };
                text.trim_end().to_owned()
            })
            .collect();
        let size = flow
            .filter(|_| plastic)
            .and_then(|flow| size_of_effect(flow, name, case, velocity));
        list.push(Effect {
            name,
            on: plastic && !given.is_empty(),
            reason: match (given.is_empty(), size) {
                (true, _) => format!("no {} given", constant.name()),
                (false, None) => given.join(", "),
                (false, Some(size)) => format!("{}: {size}", given.join(", ")),
            },
        });
    }
    list
}

/// What leaving out the rate or the heating would change of the flow stress, in words; nothing for other effects. The rate is
/// V/R, the strain that of the whole body were it flattened by the work of its motion at that stress, and the heat that of this work.
fn size_of_effect(flow: Flow, effect: &str, case: &Case, velocity: f64) -> Option<String> {
    let [_, flattening] = case.material.flattening_limits(velocity);
    let rate = velocity / case.radius;
    let still = Past {
        strain: 0.5 * flattening.min(1.0),
        ..Past::default()
    };
    let flowing = Past { rate, ..still };
    let work = 0.5 * velocity * velocity;
    let warm = Past { work, ..flowing };
    let [(at_rest, _), (at_rate, cold), (heated, hot)] =
        [still, flowing, warm].map(|past| flow.after(past));
    match effect {
        "rate" => Some(format!(
            "at V/R = {} 1/s the flow stress is {} times that at rest",
            significant(rate, 2),
            significant(at_rate / at_rest, 3)
        )),
        "heating" => Some(format!(
            "the work of the impact warms the whole body by {} K, which leaves {} % of the flow stress",
            significant(hot? - cold?, 2),
            significant(100.0 * heated / at_rate, 3)
        )),
        _ => None,
    }
}
