//! Input deck of CalculiX CrunchiX: axisymmetric quadrilaterals of eight nodes and reduced integration, penalty contact of faces,
//! finite strains.

use super::layer::Layer;
use super::mesh::Point;
use super::{Deck, HOLE, hardening, hold};
use crate::law::file::plain;
use crate::material::Material;
use crate::unit::significant;
use std::fmt::Write;

/// Slope of the pressure over the overclosure, in Young's moduli over the size of an element.
///
/// An elastic sphere is overclosed by 0.7/16 of that over it: 0.15 % of its flattening with 16 elements a contact radius.
const PENALTY: f64 = 30.0;
/// Increments of each step, at least.
const INCREMENTS: f64 = 50.0;
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
    let (what, below) = against(deck);
    let text = format!(
        "{name}.inp: a sphere {what} delta/R = {} and let go.\n\
         Case {}; {}\n\
         Run: ccx -i {name}   (OMP_NUM_THREADS=2 for two threads)\n\
         Units: {length}, {force}, s, {}, {}.\n\
         R = {} m, rho = {} kg/m3, E = {:e} Pa, nu = {}, {flow}.\n\
         {below}\
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

/// What the sphere is pressed against, in words, and a line on it.
fn against(deck: &Deck<'_>) -> (String, String) {
    match &deck.wall {
        None => (
            "flattened slowly by a rigid frictionless plane to".to_owned(),
            String::new(),
        ),
        Some(wall) => {
            let m = wall.material;
            let flow = m
                .flow
                .map_or_else(|| "elastic".to_owned(), |f| f.to_string());
            (
                format!("pressed slowly into a frictionless {} to", wall.shape),
                format!(
                    "Below it: rho = {} kg/m3, E = {:e} Pa, nu = {}, {flow}; {} elements, held at the back.\n",
                    m.density,
                    m.young_modulus,
                    m.poisson_ratio,
                    wall.layer.elements.len()
                ),
            )
        }
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
    let plane = [[inner, -0.2], [1.2, -0.2], [1.2, 0.0], [inner, 0.0]];
    let below: &[Point] = match &deck.wall {
        None => {
            out.push_str(
                "** the plane: its upper face, from next to the axis\n*NODE, NSET=PLANE\n",
            );
            &plane
        }
        Some(wall) => {
            out.push_str("** the wall, from next to the axis\n*NODE, NSET=WALL\n");
            &wall.layer.nodes
        }
    };
    for (k, place) in below.iter().enumerate() {
        point(out, first + k, *place);
    }
    let centre = first + below.len();
    out.push_str("** carries the mean displacement; part of no element\n*NODE, NSET=CENTRE\n");
    point(out, centre, [1.0, 1.0]);
    out.push_str("*ELEMENT, TYPE=CAX8R, ELSET=BODY\n");
    for (k, nodes) in mesh.elements.iter().enumerate() {
        let nodes = nodes.map(|node| (node + 1).to_string()).join(", ");
        let _ = writeln!(out, "{}, {nodes}", k + 1);
    }
    let rigid = mesh.elements.len() + 1;
    match &deck.wall {
        None => {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| first + k);
            let _ = writeln!(
                out,
                "*ELEMENT, TYPE=CAX4, ELSET=RIGID\n{rigid}, {a}, {b}, {c}, {d}"
            );
        }
        Some(wall) => layer(&wall.layer, [first, rigid], out),
    }
    out.push_str("*NSET, NSET=AXIS\n");
    for (k, _) in mesh.nodes.iter().enumerate().filter(|(_, p)| p[0] == 0.0) {
        let _ = writeln!(out, "{},", k + 1);
    }
    surfaces(deck, rigid, out);
    centre
}

/// Surfaces that may touch; the elements below the sphere are counted from `rigid`.
fn surfaces(deck: &Deck<'_>, rigid: usize, out: &mut String) {
    let mesh = &deck.mesh;
    out.push_str("*SURFACE, NAME=CONTACT, TYPE=ELEMENT\n");
    let angle = MAY_TOUCH.0.min(MAY_TOUCH.1 * deck.contact_radius);
    for (element, side) in &mesh.surface {
        let [r, z] = mesh.points(*element)[4 + side];
        if r.atan2(1.0 - z) < angle {
            let _ = writeln!(out, "{}, S{}", element + 1, side + 1);
        }
    }
    out.push_str("*SURFACE, NAME=WALL, TYPE=ELEMENT\n");
    let may_touch = |element: &&usize, layer: &Layer| {
        let corner = layer.elements[**element][3];
        layer.nodes[corner][0] < angle.sin()
    };
    match &deck.wall {
        None => {
            let _ = writeln!(out, "{rigid}, S3");
        }
        Some(wall) => {
            let top = wall.layer.top.iter();
            for element in top.filter(|element| may_touch(element, &wall.layer)) {
                let _ = writeln!(out, "{}, S3", rigid + element);
            }
        }
    }
}

/// Elements of a wall, the nodes of its back, by whose reaction the force is read, and those next to the axis.
fn layer(layer: &Layer, [node, element]: [usize; 2], out: &mut String) {
    out.push_str("*ELEMENT, TYPE=CAX8R, ELSET=LAYER\n");
    for (k, nodes) in layer.elements.iter().enumerate() {
        let nodes = nodes.map(|n| (n + node).to_string()).join(", ");
        let _ = writeln!(out, "{}, {nodes}", element + k);
    }
    for (name, nodes) in [
        ("PLANE", layer.back().collect::<Vec<_>>()),
        ("INMOST", layer.inmost().collect()),
    ] {
        let _ = writeln!(out, "*NSET, NSET={name}");
        for n in nodes {
            let _ = writeln!(out, "{},", n + node);
        }
    }
}

/// Materials, sections, contact and the conditions that hold all along.
fn material(deck: &Deck<'_>, units: &Units, radius: f64, out: &mut String) {
    let m = &deck.case.material;
    constants("SOLID", m, units, out);
    let (mut softer, mut section, mut held) = (m.young_modulus, "SOLID, ELSET=RIGID", "");
    if let Some(wall) = &deck.wall {
        constants("GROUND", wall.material, units, out);
        softer = softer.min(wall.material.young_modulus);
        (section, held) = ("GROUND, ELSET=LAYER", "\nINMOST, 1, 1");
    }
    let _ = writeln!(
        out,
        "*SOLID SECTION, MATERIAL=SOLID, ELSET=BODY\n*SOLID SECTION, MATERIAL={section}"
    );
    let cell = deck.contact_radius / deck.cells as f64 * radius;
    let _ = writeln!(
        out,
        "*SURFACE INTERACTION, NAME=HARD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{:.10e}\n\
         *CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE\nCONTACT, WALL\n\
         *BOUNDARY\nAXIS, 1, 1\nPLANE, 1, 2{held}",
        PENALTY * units.stress(softer) / cell
    );
}

/// Constants of a material.
fn constants(name: &str, m: &Material, units: &Units, out: &mut String) {
    let _ = writeln!(
        out,
        "*MATERIAL, NAME={name}\n*ELASTIC\n{:.10e}, {}",
        units.stress(m.young_modulus),
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
    for (what, end, start) in [("press", most, 1.0), ("let go", most - deck.back, 0.2)] {
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
