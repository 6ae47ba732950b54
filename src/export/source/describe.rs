//! Description of an exported law: the text that every dialect carries on top, so that its file explains itself.

use super::portable::Portable;
use super::reference::Impact;
use crate::law::Form;
use crate::law::file::plain;
use crate::material::Material;
use std::fmt::Write;

/// Convention of moduli and radii, history and reset; what a reader of any dialect has to know.
const CONVENTIONS: &str = "\
Units: SI (m, kg, s, N, Pa). Overlap > 0 in contact, force > 0 repels, rate > 0 approaches.
Convention: the law is that of one body on a rigid plane, F = R^2 phi(delta/R). The modulus is that of the body alone,
E* = E/(1 - nu^2), and the radius its own: no effective modulus, no mixing. A wall is rigid. Two bodies of this material:
each flattens by delta/2 like a sphere of radius 2 R1 R2/(R1 + R2) on a plane (equal bodies: F(delta/2) at R), which is
Hertz's pair for any radii while elastic.
History of each side of a contact: its largest flattening x_max = delta_max/R (what else is kept follows from it). Virgin: 0.
Loading: the curve, for delta beyond delta_max. Below it: the unloading branch of delta_max, for reloading too. No tension.
Reset: to 0 when the bodies no longer overlap. Zero force at overlap > 0 (an impression) keeps the history.
Path-exact: the force follows from flattening and x_max, never from sums over steps, so it does not depend on the time step.
Not in the law: friction, rolling resistance, viscous damping.";

/// The same of the law of a pair.
const PAIR_CONVENTIONS: &str = "\
Units: SI (m, kg, s, N, Pa). Overlap > 0 in contact, force > 0 repels, rate > 0 approaches.
Convention: the law is that of two bodies together, F = R^2 phi(delta/R), with delta the approach of their centres, that is the
overlap, and R the effective radius, 1/R = 1/R_1 + 1/R_2 (R_1 where the second is flat: radius_2 0). It holds for these two
materials, and for bodies of the proportions below; for others as far as curvature does not matter (delta/R of about 0.02).
Contacts of other materials, and of two bodies of one of these, are not in it. Nor may the two laws of one material be added to it.
History of a contact: its largest overlap x_max = delta_max/R (what else is kept follows from it). Virgin: 0.
Loading: the curve, for delta beyond delta_max. Below it: the unloading branch of delta_max, for reloading too. No tension.
Reset: to 0 when the bodies no longer overlap. Zero force at overlap > 0 (an impression) keeps the history.
Path-exact: the force follows from overlap and x_max, never from sums over steps, so it does not depend on the time step.
Not in the law: friction, rolling resistance, viscous damping. What waves took from the impacts is in it.";

/// Lines of the description.
#[must_use]
pub fn lines(law: &Portable) -> Vec<String> {
    let mut text = String::new();
    let file = &law.file;
    let material = file.material();
    let flow = material
        .flow
        .map_or_else(|| "elastic".to_owned(), |flow| flow.to_string());
    let form = match law.form {
        Form::Hertz => "elastic",
        Form::ClosedForm => "closed form",
        Form::Spline => "spline",
    };
    let (conventions, of_what, each, met, of_radius) = match law.pair() {
        None => (
            CONVENTIONS,
            "Material",
            " a body",
            "impacts on a wall",
            "radius of the smallest body",
        ),
        Some(_) => (
            PAIR_CONVENTIONS,
            "Sphere that stands for both",
            "",
            "impacts",
            "effective radius",
        ),
    };
    let _ = writeln!(
        text,
        "Normal contact law \"{}\", {form}, from simulated impacts.\n{conventions}\n",
        law.name
    );
    if let Some(pair) = law.pair() {
        let words = |m: &Material| {
            let flow = m
                .flow
                .map_or_else(|| "elastic".to_owned(), |flow| flow.to_string());
            format!(
                "density {} kg/m3, Young's modulus {:e} Pa, Poisson's ratio {}, {flow}",
                m.density, m.young_modulus, m.poisson_ratio
            )
        };
        let [first, second] = pair.materials();
        let bodies = pair.bodies().replace('µ', "u");
        let _ = writeln!(
            text,
            "Bodies: {bodies}.\nFirst: {}.\nSecond: {}.",
            words(&first),
            words(&second)
        );
    }
    let _ = writeln!(
        text,
        "{of_what}: density {} kg/m3, Young's modulus {:e} Pa, Poisson's ratio {}, {flow}.",
        material.density, material.young_modulus, material.poisson_ratio,
    );
    let _ = writeln!(
        text,
        "Valid: delta/R up to {:.4}{each}, {met} from {} to {} m/s; extrapolated beyond.",
        file.valid.displacement_over_radius_max,
        file.valid.velocity_min_m_s,
        file.valid.velocity_max_m_s
    );
    let _ = writeln!(
        text,
        "Suggested time step: {:.3e} s/m times the {of_radius} (R = {} m: {:.3e} s).",
        law.time_step_over_radius,
        law.radius(),
        law.time_step()
    );
    inertia(law, &mut text);
    let _ = writeln!(text, "{}\n", provenance(law));
    reference(law, &mut text);
    text.lines().map(str::to_owned).collect()
}

/// Where the law comes from.
#[must_use]
pub fn provenance(law: &Portable) -> String {
    let from = &law.file.provenance;
    format!(
        "Provenance: {}; fitted by {} to case {} (sha256 {}); law file sha256 {}, form {}.",
        crate::PROGRAM,
        plain(&from.program),
        plain(&from.case),
        plain(&from.case_sha256),
        law.hash,
        law.form.name(),
    )
}

fn inertia(law: &Portable, text: &mut String) {
    if law.inertia() == 0.0 {
        return;
    }
    let _ = writeln!(
        text,
        "Inertia: fast first loading carries F_i = R^2 {:.4} rho v^2 sqrt((delta - delta_1)/R) besides; the reference impacts\n\
         are without it, as beds are.",
        law.inertia()
    );
}

fn reference(law: &Portable, text: &mut String) {
    text.push_str("Reference impacts (relative speed, m/s; m; N; s):\n");
    for impact in &law.reference.impacts {
        let f = &impact.figures;
        let _ = writeln!(
            text,
            "  {}, {} m/s: e {:.9}, F* {:.9e}, delta* {:.9e}, delta_res {:.9e}, contact time {:.9e}",
            bodies(impact),
            impact.velocity,
            f.restitution,
            f.max_force,
            f.max_displacement,
            f.residual_displacement,
            f.contact_time
        );
    }
    match law.pair() {
        None => {
            let wall = &law.reference.impacts[1];
            let _ = writeln!(
                text,
                "Trajectory of a sphere on a wall at {} m/s (two equal spheres at {} m/s: twice the overlap):\n  time s, overlap m, force N",
                wall.velocity,
                2.0 * wall.velocity
            );
        }
        Some(_) => {
            let first = &law.reference.impacts[0];
            let _ = writeln!(
                text,
                "Trajectory at {} m/s:\n  time s, overlap m, force N",
                first.velocity
            );
        }
    }
    for point in &law.reference.trajectory {
        let _ = writeln!(
            text,
            "  {:.9e}, {:.9e}, {:.9e}",
            point.time, point.flattening, point.force
        );
    }
}

/// Which bodies meet.
#[must_use]
pub fn bodies(impact: &Impact) -> String {
    let [a, b] = impact.radii;
    match b {
        0.0 => format!("sphere R {a} on wall"),
        _ if a == b => format!("two spheres R {a}"),
        _ => format!("spheres R {a} and {b}"),
    }
}
