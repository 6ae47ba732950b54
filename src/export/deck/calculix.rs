//! Input deck of CalculiX CrunchiX: axisymmetric quadrilaterals of eight nodes and reduced integration, penalty contact of faces,
//! finite strains.

use super::{Deck, TABOR_STRAIN, hardening, hold};
use crate::law::file::plain;
use crate::unit::significant;
use std::fmt::Write;

/// Slope of the pressure over the overclosure, in Young's moduli over the size of an element.
///
/// An elastic sphere is overclosed by 0.7/16 of that over it: 0.15 % of its flattening with 16 elements a contact radius.
const PENALTY: f64 = 30.0;
/// Increments of each step, at least.
const INCREMENTS: f64 = 50.0;
/// Way back over σ_y a/E*: recoveries are about half of it.
const WAY_BACK: f64 = 5.0;
/// Nearest the plane comes to the axis, in contact radii: faces that touch the axis have no normal in the code.
const HOLE: f64 = 1e-4;
/// Largest angle from the contact pole that may touch the plane, rad, and that over the contact radius.
const MAY_TOUCH: (f64, f64) = (1.4, 1.6);

/// Units of a deck: CalculiX knows none.
struct Units {
    length: (&'static str, f64),
    force: (&'static str, f64),
    mass: &'static str,
    stress: &'static str,
}

/// The units in which numbers of a body of this radius are near one.
fn units(radius: f64) -> Units {
    match radius {
        r if r < 1e-4 => Units {
            length: ("um", 1e-6),
            force: ("uN", 1e-6),
            mass: "kg",
            stress: "MPa",
        },
        r if r < 0.1 => Units {
            length: ("mm", 1e-3),
            force: ("N", 1.0),
            mass: "t",
            stress: "MPa",
        },
        _ => Units {
            length: ("m", 1.0),
            force: ("N", 1.0),
            mass: "kg",
            stress: "Pa",
        },
    }
}

impl Units {
    fn stress(&self, si: f64) -> f64 {
        si * self.length.1.powi(2) / self.force.1
    }

    fn density(&self, si: f64) -> f64 {
        si * self.length.1.powi(4) / self.force.1
    }
}

/// The whole deck.
pub(super) fn text(deck: &Deck<'_>, name: &str) -> String {
    let units = units(deck.case.radius);
    let radius = deck.case.radius / units.length.1;
    let mut out = String::new();
    head(deck, name, &units, &mut out);
    let centre = geometry(deck, radius, &mut out);
    material(deck, &units, radius, &mut out);
    flattening(deck, radius, centre, &mut out);
    out
}

/// Comments on top: what it is, how it is run and read.
fn head(deck: &Deck<'_>, name: &str, units: &Units, out: &mut String) {
    let case = deck.case;
    let m = &case.material;
    let flow = m
        .flow
        .map_or_else(|| "elastic".to_owned(), |f| f.to_string());
    let (length, force) = (units.length.0, units.force.0);
    let radius = significant(case.radius / units.length.1, 9);
    let text = format!(
        "{name}.inp: a sphere flattened slowly by a rigid frictionless plane to delta/R = {} and let go.\n\
         Case {}; {}\n\
         Run: ccx -i {name}   (OMP_NUM_THREADS=2 for two threads)\n\
         Units: {length}, {force}, s, {}, {}.\n\
         R = {} m, rho = {} kg/m3, E = {:e} Pa, nu = {}, {flow}.\n\
         Axisymmetric: r is the first coordinate, the axis of symmetry the second; first touch is the origin.\n\
         Mesh: {} elements, {} of a contact radius of {} R.\n\
         In {name}.dat, each increment: total RF of PLANE for a sector of two degrees, so F = 180 times the second number.\n\
         delta = -U2 of node CENTRE, whose displacement is the mean over the volume: that of the centre of mass.\n\
         The sphere is held as its inertia holds it in an impact, by a force in proportion to its mass (*EQUATION).\n\
         U2 on AXIS: displacement of the material centre, at the height {radius}, and of the far pole.\n\
         The penalty contact lets the surfaces pass by pressure/slope; the slope stands below *SURFACE BEHAVIOR.\n\
         For pictures add *NODE FILE with U and *EL FILE with S, PEEQ below the last *NODE PRINT.",
        significant(deck.flattening, 6),
        plain(&case.name),
        plain(deck.provenance),
        units.mass,
        units.stress,
        case.radius,
        m.density,
        m.young_modulus,
        m.poisson_ratio,
        deck.mesh.elements.len(),
        deck.cells,
        significant(deck.contact_radius, 4),
    );
    for line in text.lines() {
        wrapped(line, out);
    }
}

/// Comment lines of at most 110 characters.
fn wrapped(line: &str, out: &mut String) {
    let mut length = 200;
    for word in line.split(' ') {
        if length + word.len() > 106 {
            let start = if length == 200 { "** " } else { "\n**   " };
            out.push_str(start);
            length = 3;
        } else {
            out.push(' ');
        }
        out.push_str(word);
        length += word.len() + 1;
    }
    out.push('\n');
}

/// Nodes, elements and surfaces; the number of the node that carries the mean.
fn geometry(deck: &Deck<'_>, radius: f64, out: &mut String) -> usize {
    let mesh = &deck.mesh;
    let point = |out: &mut String, id: usize, [r, z]: [f64; 2]| {
        let _ = writeln!(out, "{id}, {:.11e}, {:.11e}", r * radius, z * radius);
    };
    out.push_str("** the sphere\n*NODE, NSET=SPHERE\n");
    for (k, node) in mesh.nodes.iter().enumerate() {
        point(out, k + 1, *node);
    }
    let first = mesh.nodes.len() + 1;
    let inner = HOLE * deck.contact_radius;
    out.push_str("** the plane: its upper face, from next to the axis\n*NODE, NSET=PLANE\n");
    for (k, [r, z]) in [[inner, -0.2], [1.2, -0.2], [1.2, 0.0], [inner, 0.0]]
        .into_iter()
        .enumerate()
    {
        point(out, first + k, [r, z]);
    }
    let centre = first + 4;
    out.push_str("** carries the mean displacement; part of no element\n*NODE, NSET=CENTRE\n");
    point(out, centre, [1.0, 1.0]);
    out.push_str("*ELEMENT, TYPE=CAX8R, ELSET=BODY\n");
    for (k, nodes) in mesh.elements.iter().enumerate() {
        let nodes = nodes.map(|node| (node + 1).to_string()).join(", ");
        let _ = writeln!(out, "{}, {nodes}", k + 1);
    }
    let rigid = mesh.elements.len() + 1;
    out.push_str("*ELEMENT, TYPE=CAX4, ELSET=RIGID\n");
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| first + k);
    let _ = writeln!(out, "{rigid}, {a}, {b}, {c}, {d}");
    out.push_str("*NSET, NSET=AXIS\n");
    for (k, _) in mesh.nodes.iter().enumerate().filter(|(_, p)| p[0] == 0.0) {
        let _ = writeln!(out, "{},", k + 1);
    }
    out.push_str("*SURFACE, NAME=CONTACT, TYPE=ELEMENT\n");
    let angle = MAY_TOUCH.0.min(MAY_TOUCH.1 * deck.contact_radius);
    for (element, side) in &mesh.surface {
        let [r, z] = mesh.points(*element)[4 + side];
        if r.atan2(1.0 - z) < angle {
            let _ = writeln!(out, "{}, S{}", element + 1, side + 1);
        }
    }
    let _ = writeln!(out, "*SURFACE, NAME=WALL, TYPE=ELEMENT\n{rigid}, S3");
    centre
}

/// Material, sections, contact and the conditions that hold all along.
fn material(deck: &Deck<'_>, units: &Units, radius: f64, out: &mut String) {
    let m = &deck.case.material;
    let modulus = units.stress(m.young_modulus);
    let _ = writeln!(
        out,
        "*MATERIAL, NAME=SOLID\n*ELASTIC\n{modulus:.10e}, {}",
        m.poisson_ratio
    );
    let _ = writeln!(out, "*DENSITY\n{:.10e}", units.density(m.density));
    if let Some((flow, strains)) = m.flow.and_then(|flow| Some((flow, hardening(flow)?))) {
        out.push_str("** flow stress, equivalent plastic strain; straight between them, constant beyond\n*PLASTIC\n");
        for strain in strains {
            let stress = units.stress(flow.at_rest(strain));
            let _ = writeln!(out, "{stress:.10e}, {strain:.6e}");
        }
    }
    out.push_str(
        "*SOLID SECTION, MATERIAL=SOLID, ELSET=BODY\n*SOLID SECTION, MATERIAL=SOLID, ELSET=RIGID\n",
    );
    let cell = deck.contact_radius / deck.cells as f64 * radius;
    let _ = writeln!(
        out,
        "*SURFACE INTERACTION, NAME=HARD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{:.10e}\n\
         *CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE\nCONTACT, WALL\n\
         *BOUNDARY\nAXIS, 1, 1\nPLANE, 1, 2",
        PENALTY * modulus / cell
    );
}

/// The steps: the mean displacement to the flattening and back.
fn flattening(deck: &Deck<'_>, radius: f64, centre: usize, out: &mut String) {
    let mut mean = hold::mean(&deck.mesh);
    // the first node of an equation is eliminated: that of the largest share
    mean.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let _ = writeln!(
        out,
        "** mean axial displacement of the sphere = that of CENTRE\n*EQUATION\n{}",
        mean.len() + 1
    );
    for (node, share) in &mean {
        let _ = writeln!(out, "{}, 2, {share:.12e}", node + 1);
    }
    let _ = writeln!(out, "{centre}, 2, -1.\n*BOUNDARY\nCENTRE, 1, 1");
    let most = deck.flattening;
    let m = &deck.case.material;
    let back = m.flow.map_or(most, |flow| {
        let stress = flow.at_rest(TABOR_STRAIN * deck.contact_radius);
        (WAY_BACK * stress / m.contact_modulus() * deck.contact_radius).min(most)
    });
    for (what, end, start) in [("press", most, 1.0), ("let go", most - back, 0.2)] {
        let longest = 1.0 / INCREMENTS;
        let _ = writeln!(
            out,
            "** {what}\n*STEP, NLGEOM, INC=10000\n*STATIC\n{:e}, 1., 1e-9, {longest:e}\n*BOUNDARY\nCENTRE, 2, 2, {:.10e}",
            start * longest,
            -end * radius
        );
        out.push_str("*NODE PRINT, NSET=PLANE, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=CENTRE\nU\n*NODE PRINT, NSET=AXIS\nU\n*END STEP\n");
    }
}
