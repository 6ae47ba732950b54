//! Deck: a case as input files of a finite-element code, so that an independent program can have its say on the same question.
//!
//! What is written is a sphere that a rigid frictionless plane flattens slowly and lets go; of a case with a deformable wall, the sphere
//! pressed into the wall and drawn back. A new code is a new file with its text and one line in the list of [`Code`].

mod calculix;
pub mod hold;
pub mod layer;
pub mod mesh;

use self::layer::Layer;
use self::mesh::Mesh;
use crate::case::Case;
use crate::case::pair::{PairCase, TargetShape};
use crate::export::source::artifact::Artifact;
use crate::material::{Flow, Material};
use crate::plan::estimate;
use crate::plan::pair::pair_plan;
use crate::unit::significant;
use crate::{Error, Result};

/// Flattening over the radius where nothing is asked for, at most.
pub const USUAL_FLATTENING: f64 = 0.1;
/// Least and largest flattening over the radius: below, it is lost in the size of a node's coordinates; beyond, elements that follow the
/// material are crushed at the edge of the contact.
pub const FLATTENING: [f64; 2] = [1e-6, 0.2];
/// Elements of a contact radius where nothing is asked for.
pub const USUAL_CELLS: usize = 16;
/// Least and most elements of a contact radius.
pub const CELLS: [usize; 2] = [4, 100];
/// Width of the fine part of the mesh over the contact radius.
const FINE: f64 = 1.2;
/// Equivalent plastic strain of a contact over a/R (Tabor 1951).
const TABOR_STRAIN: f64 = 0.2;

/// A finite-element code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// CalculiX CrunchiX.
    CalculiX,
}

impl Code {
    /// Every code, in the order of messages.
    pub const ALL: [Code; 1] = [Code::CalculiX];

    /// Name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Code::CalculiX => "calculix",
        }
    }

    /// How a deck is run, `NAME` standing for its name.
    #[must_use]
    pub const fn run(self) -> &'static str {
        match self {
            Code::CalculiX => "ccx -i NAME",
        }
    }
}

/// What decks are asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Flattening over the radius; none: that expected of the fastest impact, at most [`USUAL_FLATTENING`].
    pub flattening: Option<f64>,
    /// Elements of a contact radius.
    pub cells: usize,
}

/// Way back of a plane or sphere that lets go over σ_y a/E*: recoveries are about half of it.
const WAY_BACK: f64 = 5.0;
/// Where a half-space is cut off, and a plate at its rim, over the contact radius: the back that is held there takes 2/π of the reciprocal
/// off an elastic indentation.
const REACH: f64 = 200.0;
/// Nearest the wall comes to the axis, in contact radii: faces that touch the axis have no normal in CalculiX.
const HOLE: f64 = 1e-4;

/// A deformable wall.
struct Wall<'a> {
    material: &'a Material,
    /// Its mesh, in radii of the particle.
    layer: Layer,
    /// Name of its shape.
    shape: &'static str,
}

/// All that a deck says, in SI units and in radii.
struct Deck<'a> {
    case: &'a Case,
    /// What it is pressed into; none: a rigid plane.
    wall: Option<Wall<'a>>,
    /// Way back after the largest flattening, over R.
    back: f64,
    /// Largest flattening, over R.
    flattening: f64,
    /// Contact radius there, over R.
    contact_radius: f64,
    /// Elements of it.
    cells: usize,
    /// Mesh of a sphere of radius one.
    mesh: Mesh,
    /// What made it, for its head.
    provenance: &'a str,
}

/// Files of a case for a code, in a folder of its name: `flattening.inp`.
///
/// # Errors
/// [`Error::Refused`] for what is not written: another shape, an oblique impact, friction, a flow stress that knows rate or
/// temperature, flattening or fineness out of their ranges.
pub fn export(case: &Case, code: Code, wanted: Wanted, provenance: &str) -> Result<Vec<Artifact>> {
    check(case, wanted)?;
    check_material(case, "material", &case.material)?;
    let fastest = case.velocities.iter().copied().fold(0.0, f64::max);
    let expected = estimate(&case.material, fastest).displacement;
    let flattening = flattening(wanted, expected);
    let contact_radius = contact_radius(case.material.flow.is_some(), flattening);
    let modulus = case.material.contact_modulus();
    let deck = Deck {
        case,
        wall: None,
        back: way_back([case.material.flow, None], modulus, contact_radius).min(flattening),
        flattening,
        contact_radius,
        cells: wanted.cells,
        mesh: sphere(contact_radius, wanted.cells),
        provenance,
    };
    Ok(vec![written(&deck, code, "flattening")])
}

/// The same of a case with a deformable wall: `indentation.inp`.
///
/// # Errors
/// As [`export`], of both materials; [`Error::Refused`] for a second sphere in the wall's place.
pub fn export_pair(
    pair: &PairCase,
    code: Code,
    wanted: Wanted,
    provenance: &str,
) -> Result<Vec<Artifact>> {
    let (case, target) = (&pair.particle, &pair.target);
    check(case, wanted)?;
    check_material(case, "material", &case.material)?;
    check_material(case, "wall.material", &target.material)?;
    if let TargetShape::Sphere { radius } = target.shape {
        return Err(Error::Refused {
            what: format!("{}: `wall.radius`", case.path.display()),
            found: format!("{radius} m"),
            allowed: "must be left out: a deck has a plate or a half-space below the particle"
                .to_owned(),
        });
    }
    let fastest = case.velocities.iter().copied().fold(0.0, f64::max);
    let expected = pair_plan(pair, fastest).impact.estimate.displacement;
    let flattening = flattening(wanted, expected);
    let flows = [case.material.flow, target.material.flow];
    let contact_radius = contact_radius(flows.iter().any(Option::is_some), flattening);
    let [own, other] = [&case.material, &target.material].map(Material::contact_modulus);
    let reach = REACH * contact_radius;
    let thickness = target.shape.thickness();
    let depth = thickness.map_or(reach, |thickness| thickness / case.radius);
    let layer = Layer::new(
        HOLE * contact_radius,
        [reach, depth],
        contact_radius / wanted.cells as f64,
        FINE * contact_radius,
    );
    let deck = Deck {
        case,
        wall: Some(Wall {
            material: &target.material,
            layer,
            shape: target.shape.name(),
        }),
        back: way_back(flows, own * other / (own + other), contact_radius).min(flattening),
        flattening,
        contact_radius,
        cells: wanted.cells,
        mesh: sphere(contact_radius, wanted.cells),
        provenance,
    };
    Ok(vec![written(&deck, code, "indentation")])
}

fn written(deck: &Deck<'_>, code: Code, name: &str) -> Artifact {
    let text = match code {
        Code::CalculiX => calculix::text(deck, name),
    };
    let file = Artifact {
        name: format!("{name}.inp"),
        text,
    };
    file.within(code.name())
}

/// Flattening over R: what is wanted, else what is expected.
fn flattening(wanted: Wanted, expected: f64) -> f64 {
    let rounded = |x: f64| significant(x, 2).parse().unwrap_or(x);
    let usual = || rounded(expected.clamp(FLATTENING[0], USUAL_FLATTENING));
    wanted.flattening.unwrap_or_else(usual)
}

/// Mesh of the sphere.
fn sphere(contact_radius: f64, cells: usize) -> Mesh {
    let across = (FINE * cells as f64).ceil();
    Mesh::new(contact_radius / cells as f64 * across, across as usize)
}

/// Way back over R by which a contact of two bodies of these flow stresses has let go; of elastic ones more than any flattening.
fn way_back(flows: [Option<Flow>; 2], modulus: f64, contact_radius: f64) -> f64 {
    let stress = |flow: Flow| flow.at_rest(TABOR_STRAIN * contact_radius);
    let softer = flows.into_iter().flatten().map(stress);
    let softer = softer.fold(f64::INFINITY, f64::min);
    WAY_BACK * softer / modulus * contact_radius
}

/// Contact radius over R at a flattening: Hertz's, where the body yields that of a plane cut.
fn contact_radius(yields: bool, flattening: f64) -> f64 {
    match yields {
        false => flattening.sqrt(),
        true => (2.0 * flattening).sqrt(),
    }
}

fn check(case: &Case, wanted: Wanted) -> Result<()> {
    case.of_a_normal_impact("a finite-element deck")?;
    case.of_own_scheme("a finite-element deck")?;
    let refuse = |what: &str, found: String, allowed: String| {
        Err(Error::Refused {
            what: what.to_owned(),
            found,
            allowed,
        })
    };
    let [least, most] = FLATTENING;
    if let Some(x) = wanted.flattening
        && !(least..=most).contains(&x)
    {
        let allowed = format!(
            "must be from {least} to {most} radii: elements that follow the material are crushed beyond"
        );
        return refuse("--flattening", x.to_string(), allowed);
    }
    let [few, many] = CELLS;
    if !(few..=many).contains(&wanted.cells) {
        let allowed = format!("must be from {few} to {many}");
        return refuse("--cells", wanted.cells.to_string(), allowed);
    }
    Ok(())
}

/// That a deck can hold the flow stress of a material, whose table is `table` in the case file.
fn check_material(case: &Case, table: &str, material: &Material) -> Result<()> {
    let Some(flow) = material.flow.filter(|flow| hardening(*flow).is_none()) else {
        return Ok(());
    };
    let said = |effect: &str| effect != "plasticity" && effect != "hardening";
    let constants = flow.constants();
    let constant = constants.iter().find(|(c, _)| said(c.effect));
    let key = constant.map_or("yield_strength", |(constant, _)| constant.key);
    Err(Error::Refused {
        what: format!("{}: `{table}.{key}`", case.path.display()),
        found: flow.name().to_owned(),
        allowed: "must be left out: a deck holds a flow stress of the plastic strain alone"
            .to_owned(),
    })
}

/// Plastic strains of a table of a flow stress that knows nothing else; none of one that knows rate or temperature.
fn hardening(flow: Flow) -> Option<Vec<f64>> {
    match flow {
        Flow::PerfectlyPlastic(_) => Some(vec![0.0]),
        Flow::LinearHardening(_) => Some(vec![0.0, LARGEST_STRAIN]),
        // by its second derivative a straight line between two of them is off by (ln 1.18)^2/8 times n (1 - n) < 1/4 of the hardening of a
        // power, and times x^2 exp(-x) < 0.55 of the saturation, x = b strain: less than 0.2 % of either
        Flow::PowerHardening(_) | Flow::VoceHardening(_) => {
            let mut strains = vec![0.0];
            let mut strain = LEAST_STRAIN;
            while strain < LARGEST_STRAIN {
                strains.push(strain);
                strain *= 1.18;
            }
            strains.push(LARGEST_STRAIN);
            Some(strains)
        }
        Flow::IsothermalJohnsonCook(_) | Flow::JohnsonCook(_) | Flow::CowperSymonds(_) => None,
    }
}

/// First plastic strain of a table after 0.
const LEAST_STRAIN: f64 = 1e-9;
/// Last one.
const LARGEST_STRAIN: f64 = 5.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_hardening_is_off_by_less_than_two_thousandths_of_it() {
        use crate::material::flow::{PowerHardening, VoceHardening};
        let (strength, rise) = (1e8, 3e8);
        let kinds = [
            Flow::PowerHardening(PowerHardening {
                strength,
                coefficient: rise,
                exponent: 0.31,
            }),
            Flow::VoceHardening(VoceHardening {
                strength,
                saturation: rise,
                exponent: 15.0,
            }),
        ];
        for flow in kinds {
            let strains = hardening(flow).unwrap();
            for pair in strains.windows(2) {
                let middle = 0.5 * (pair[0] + pair[1]);
                let table = 0.5 * (flow.at_rest(pair[0]) + flow.at_rest(pair[1]));
                let error = (table - flow.at_rest(middle)).abs();
                // of the hardening there, or of that at a strain of 1 (power) or at saturation where it is less
                let hardening = (flow.at_rest(middle) - strength).max(rise);
                assert!(error < 2e-3 * hardening, "{pair:?}: {error}");
            }
        }
    }
}
