//! Fit of the elastic-plastic law to simulated impacts: all speeds of a material at once, in both forms.

pub mod confidence;
mod fitted;
pub(crate) mod form;
pub(crate) mod marquardt;
pub mod pulse;
pub mod quality;
pub(crate) mod residual;
pub mod run;
pub(crate) mod solve;

pub use fitted::{Fit, FittedForm, Outcome, Skipped, left_out_bound, threshold};

use crate::case::Case;
use crate::case::pair::PairCase;
use crate::contact::elastoplastic::Elastoplastic;
use crate::curve::Impact;
use crate::material::Material;
use crate::theory::hertz::Hertz;
use crate::{Error, Result};
use form::{ClosedFormFit, Form, SplineFit};
use quality::Quality;
use residual::Objective;
use run::{Run, Scale};

/// Fall of the largest error of F*, delta* and e, over that error, for which the inertia term is kept.
pub const INERTIA_GAIN: f64 = 0.1;

/// Checks that one law can hold for all sizes of a material.
///
/// # Errors
/// [`Error::Refused`] naming the constant of the flow stress that makes sizes differ.
pub fn check_material(material: &Material) -> Result<()> {
    let constants = material.flow.map_or_else(Vec::new, |f| f.constants());
    match constants.iter().find(|(c, _)| c.dimension.has_time()) {
        None => Ok(()),
        Some((constant, _)) => Err(Error::Refused {
            what: "material".to_owned(),
            found: format!("`{}`", constant.key),
            allowed: "must be left out: it makes impacts of other radii differ, and a law F = R^2 phi(delta/R) is one for all of them; \
                      `impactlaw impact` and `study` run this material"
                .to_owned(),
        }),
    }
}

/// Fit the law of a case's material to its impacts.
///
/// A material without yield strength, or impacts that all stay below its yield speed, give Hertz's law.
/// Otherwise both forms are fitted to F*, delta*, e, delta_res, contact time and the force curves of all
/// impacts together (`residual`), with bootstrap intervals and errors at left-out speeds ([`confidence`]). Each form is
/// fitted without and with an inertia term ([`crate::contact::inertia`]); the term is kept where it lowers the largest
/// error by [`INERTIA_GAIN`]. A single speed cannot tell inertia from hardness and gets none; nor how residual and exponent of the
/// unloading grow, which stay where they start. Impacts that stick are data; those that did not end or make no sense are left
/// out by name.
///
/// # Errors
/// What [`check_material`] returns; [`Error::Fit`] when no impact is left, or neither form finds an admissible law.
pub fn fit(case: &Case, impacts: &[Impact]) -> Result<Fit> {
    case.of_a_normal_impact("a law")?;
    check_material(&case.material)?;
    let elastic_scale = Scale::elastic(&case.material, case.radius);
    let (used, skipped) = usable(impacts, &elastic_scale);
    let speeds: Vec<f64> = used.iter().map(|i| i.summary.velocity_m_s).collect();
    let top = speeds.iter().copied().fold(0.0, f64::max);
    if used.is_empty() {
        let reasons: Vec<String> = skipped
            .iter()
            .map(|s| format!("that at {} m/s {}", s.velocity, s.why))
            .collect();
        return Err(Error::Fit {
            reason: format!("none of the impacts can be used: {}", reasons.join("; ")),
        });
    }
    let point = case
        .material
        .yield_point(case.radius, crate::material::YIELD_PRESSURE_RATIO);
    let scale = Scale::of(&case.material, case.radius);
    let yielding = scale.filter(|_| point.is_some_and(|p| top > p.velocity));
    let reduce = |scale: &Scale| {
        let mut runs: Vec<Run> = used
            .iter()
            .filter_map(|i| Run::reduce(i, scale).ok())
            .collect();
        runs.sort_by(|a, b| a.velocity.total_cmp(&b.velocity));
        runs
    };
    let (outcome, missing) = match yielding {
        None => (elastic(case, &reduce(&elastic_scale), &elastic_scale), None),
        Some(scale) => fit_both(&reduce(&scale), &scale)?,
    };
    let most = used
        .iter()
        .map(|i| i.summary.max_displacement_m)
        .fold(0.0, f64::max);
    Ok(Fit {
        outcome,
        flattening: most / case.radius,
        velocities: [speeds.iter().copied().fold(f64::INFINITY, f64::min), top],
        tolerance: case.tolerance,
        skipped,
        missing,
    })
}

/// Fit the law of a pair of bodies to its impacts: [`fit`] for the sphere on a rigid wall that stands for both
/// ([`crate::material::Effective`]). Its x is the approach of the centres over the effective radius.
///
/// # Errors
/// What [`check_material`] returns of either material, and as [`fit`].
pub fn fit_pair(pair: &PairCase, impacts: &[Impact]) -> Result<Fit> {
    check_pair(pair)?;
    fit(&pair.effective(), impacts)
}

/// Checks that one law can hold for all sizes of a pair.
///
/// # Errors
/// As [`check_material`], of either material.
pub fn check_pair(pair: &PairCase) -> Result<()> {
    check_material(&pair.particle.material)?;
    check_material(&pair.target.material)
}

/// Impacts that can be used, and those that cannot, with the reasons; whether one can does not depend on the scale.
fn usable<'a>(impacts: &'a [Impact], scale: &Scale) -> (Vec<&'a Impact>, Vec<Skipped>) {
    let (mut used, mut skipped) = (Vec::new(), Vec::new());
    for impact in impacts {
        match Run::reduce(impact, scale) {
            Ok(_) => used.push(impact),
            Err(why) => skipped.push(Skipped {
                velocity: impact.summary.velocity_m_s,
                why,
            }),
        }
    }
    (used, skipped)
}

fn elastic(case: &Case, runs: &[Run], scale: &Scale) -> Outcome {
    let law = Hertz::of(&case.material);
    let quality = runs.iter().map(|r| Quality::of(&law, r, scale)).collect();
    Outcome::Elastic { law, quality }
}

/// Both forms, or the one that is found, with the reason why the other is not.
fn fit_both(runs: &[Run], scale: &Scale) -> Result<(Outcome, Option<String>)> {
    let found = ClosedForms::of(runs, scale)?;
    let (closed_form, spline) = rayon::join(
        || choose(runs, scale, |runs, inertia| found.again(runs, inertia)),
        || choose(runs, scale, |runs, inertia| spline(&found, runs, inertia)),
    );
    let missing = match (&closed_form, &spline) {
        (Err(error), Ok(_)) => Some(format!("closed form: {error}")),
        (Ok(_), Err(error)) => Some(format!("spline: {error}")),
        (Ok(_), Ok(_)) | (Err(_), Err(_)) => None,
    };
    let (closed_form, spline) = match (closed_form, spline) {
        (Err(error), Err(_)) => return Err(error),
        (closed_form, spline) => (closed_form.ok(), spline.ok()),
    };
    let outcome = Outcome::Yielding {
        closed_form: closed_form.map(Box::new),
        spline: spline.map(Box::new),
    };
    Ok((outcome, missing))
}

/// Whether a form has the inertia term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Inertia {
    Without,
    With,
}

/// Closed forms of all impacts, without and with the inertia term: the search from afar is made once for each.
struct ClosedForms<'a> {
    runs: &'a [Run],
    scale: &'a Scale,
    without: Vec<f64>,
    with: Option<Vec<f64>>,
}

impl<'a> ClosedForms<'a> {
    fn of(runs: &'a [Run], scale: &'a Scale) -> Result<Self> {
        let search = |inertia| {
            solve::solve(&Objective {
                form: &closed_form(runs, scale, inertia),
                runs,
                weights: &vec![1.0; runs.len()],
            })
        };
        // a single speed cannot tell inertia from hardness; nor is it an error that no law has the term
        let (without, with) = rayon::join(
            || search(Inertia::Without),
            || {
                (runs.len() > 1)
                    .then(|| search(Inertia::With).ok())
                    .flatten()
            },
        );
        Ok(ClosedForms {
            runs,
            scale,
            without: without?,
            with,
        })
    }

    /// Closed form and its free numbers for `runs`: those of all impacts, or, where a speed is left out, what lies downhill of
    /// them.
    fn again(&self, runs: &[Run], inertia: Inertia) -> Result<(ClosedFormFit, Vec<f64>)> {
        let form = closed_form(runs, self.scale, inertia);
        let free = match inertia {
            Inertia::Without => &self.without,
            Inertia::With => self.with.as_ref().ok_or_else(inadmissible)?,
        };
        if runs.len() == self.runs.len() {
            return Ok((form, free.clone()));
        }
        let objective = Objective {
            form: &form,
            runs,
            weights: &vec![1.0; runs.len()],
        };
        let start = solve::admissible(&objective, free)?;
        Ok((form, solve::polish(&objective, &start, solve::LAW)?))
    }
}

fn closed_form(runs: &[Run], scale: &Scale, inertia: Inertia) -> ClosedFormFit {
    ClosedFormFit {
        units: scale.units(),
        density: (inertia == Inertia::With).then(|| scale.density()),
        runs: runs.len(),
    }
}

/// Spline and its free numbers for `runs`, started from the closed form.
fn spline(
    found: &ClosedForms<'_>,
    runs: &[Run],
    inertia: Inertia,
) -> Result<(SplineFit, Vec<f64>)> {
    let (form, free) = found.again(runs, inertia)?;
    let law = form.law(&free, f64::MAX).ok_or_else(inadmissible)?;
    let knotted = SplineFit::new(&law, &form, &free, runs);
    let objective = Objective {
        form: &knotted,
        runs,
        weights: &vec![1.0; runs.len()],
    };
    let start = solve::admissible(&objective, &knotted.start())?;
    let free = solve::polish(&objective, &start, solve::LAW)?;
    Ok((knotted, free))
}

/// The fit of a form to `runs`, with an inertia term if that is worth it; `again` makes a fit without or with it.
fn choose<F, B>(runs: &[Run], scale: &Scale, again: B) -> Result<FittedForm<F::Curve>>
where
    F: Form,
    B: Fn(&[Run], Inertia) -> Result<(F, Vec<f64>)> + Sync,
{
    let (still, free) = again(runs, Inertia::Without)?;
    if runs.len() > 1 {
        let bound = (1.0 - INERTIA_GAIN) * worst(&still, &free, runs, scale)?;
        // a form that finds no law with the term has none
        if let Ok((moving, more)) = again(runs, Inertia::With)
            && worst(&moving, &more, runs, scale).is_ok_and(|worst| worst <= bound)
        {
            return finish(&moving, &more, runs, scale, |runs| {
                again(runs, Inertia::With)
            });
        }
    }
    finish(&still, &free, runs, scale, |runs| {
        again(runs, Inertia::Without)
    })
}

/// Law of a solution, valid as far as the runs go.
fn law_of<F: Form>(
    form: &F,
    free: &[f64],
    runs: &[Run],
    scale: &Scale,
) -> Result<Elastoplastic<F::Curve>> {
    let most = runs.iter().map(|r| r.max_flattening).fold(0.0, f64::max);
    let law = form.law(free, most * scale.units().flattening);
    law.ok_or_else(inadmissible)
}

/// Largest error of a solution at any speed.
fn worst<F: Form>(form: &F, free: &[f64], runs: &[Run], scale: &Scale) -> Result<f64> {
    let law = law_of(form, free, runs, scale)?;
    let errors = runs.iter().map(|r| Quality::of(&law, r, scale).worst());
    // a NaN is worst of all
    Ok(errors.fold(0.0, |worst, e| if e <= worst { worst } else { e }))
}

/// The law of a solution with its quality, intervals and left-out errors; `again` repeats the fit on other runs.
fn finish<F: Form>(
    form: &F,
    free: &[f64],
    runs: &[Run],
    scale: &Scale,
    again: impl Fn(&[Run]) -> Result<(F, Vec<f64>)> + Sync,
) -> Result<FittedForm<F::Curve>> {
    let law = law_of(form, free, runs, scale)?;
    Ok(FittedForm {
        quality: runs.iter().map(|r| Quality::of(&law, r, scale)).collect(),
        intervals: confidence::intervals(form, runs, free),
        left_out: confidence::left_out(runs, again),
        law,
    })
}

fn inadmissible() -> Error {
    Error::Fit {
        reason: "the solution is not an admissible law".to_owned(),
    }
}
