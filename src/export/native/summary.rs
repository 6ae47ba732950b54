//! Summary of the projections: every fitted model with its errors and its lines, and the runnable inputs beside it.

use super::lines::{input, of};
use crate::Result;
use crate::export::native::{Model, Projection, Target, project, target};
use crate::export::source::artifact::Artifact;
use crate::export::source::describe;
use crate::export::source::portable::Portable;
use std::fmt::Write;

/// How near to its bound an exponent counts as held by it.
const AT_BOUND: f64 = 1e-3;

/// The files: `<identifier>_native.md` with everything, and a runnable impact for each code that can be run.
///
/// # Errors
/// As [`project`].
pub fn files(law: &Portable) -> Result<Vec<Artifact>> {
    let target = target(law);
    let projections = project(law, &target)?;
    let mut artifacts = vec![Artifact {
        name: format!("{}_native.md", law.identifier),
        text: summary(law, &target, &projections),
    }];
    for projection in &projections {
        for lines in of(&projection.model, law) {
            artifacts.extend(input(&lines, law, &target));
        }
    }
    Ok(artifacts)
}

fn summary(law: &Portable, target: &Target, projections: &[Projection]) -> String {
    let mut text = format!(
        "# Law \"{}\" projected on models that codes ship\n\n",
        law.name
    );
    let _ = writeln!(text, "{}", describe::provenance(law));
    let _ = writeln!(
        text,
        "\nFitted to restitution, largest force and contact time of impacts on a wall from {} to {} m/s, inertia included.\n\
         Errors: model over law less 1. Springs in N/m hold for R = {} m alone; they grow with R (EEPA: with R^(2-n)).\n\
         Lines for LIGGGHTS, LAMMPS and YADE are proved by running them: `impactlaw export --check`. Lines marked\n\
         *not executed* follow the documentation of their code.",
        law.file.valid.velocity_min_m_s, law.file.valid.velocity_max_m_s, target.radius
    );
    for projection in projections {
        let [e, force, time] = projection.largest().map(|x| 100.0 * x);
        let _ = writeln!(
            text,
            "\n## {}\n\nLargest error: e {e:.1} %, F* {force:.1} %, contact time {time:.1} %.\n\n\
             | V (m/s) | e of the law | error of e (%) | F* of the law (N) | error of F* (%) | error of contact time (%) |\n\
             |---|---|---|---|---|---|",
            projection.model.name()
        );
        for ((velocity, hit), error) in target.impacts.iter().zip(&projection.errors) {
            let [e, force, time] = error.map(|x| 100.0 * x);
            let _ = writeln!(
                text,
                "| {velocity:.4} | {:.4} | {e:+.1} | {:.4e} | {force:+.1} | {time:+.1} |",
                hit.restitution, hit.max_force
            );
        }
        text.push_str(&beyond(&projection.model, target));
        for lines in of(&projection.model, law) {
            let proof = match lines.input {
                Some(file) => format!("runnable: `{file}`"),
                None => "*not executed*".to_owned(),
            };
            let _ = writeln!(
                text,
                "\n{}, {} ({proof}):\n\n```\n{}\n```",
                lines.code.name(),
                lines.style,
                lines.text.trim_end()
            );
        }
    }
    text
}

/// What a user of a model has to know beside its errors: what a run in its code does that the prediction leaves out, and
/// what keeps it from fitting better.
fn beyond(model: &Model, target: &Target) -> String {
    let deepest = target
        .impacts
        .iter()
        .map(|(velocity, _)| model.rebound(target.radius, target.mass, *velocity));
    let deepest = deepest.fold(0.0, |most: f64, hit| most.max(hit.max_displacement));
    match model {
        Model::Mdr { .. } => format!(
            "\nThe errors are those of the model by its equations. In LAMMPS its particles grow as they flatten: e and F* of a run there\n\
             differ from the equations by up to delta*/(4 R), {:.1} % at the fastest impact, on top of the errors above.\n",
            100.0 * model.left_out(deepest / target.radius)
        ),
        Model::Eepa(law) if law.exponent < 1.0 + AT_BOUND => {
            "\nThe exponent is at its bound of 1. Below it LIGGGHTS, which takes the largest overlap back once the force is zero by the\n\
             ratio of linear springs, would throw bodies out faster than the equations say.\n"
                .to_owned()
        }
        _ => String::new(),
    }
}
