//! Writing of law files: a fit as tables, with the equations on top.

use super::file::{Form, LawFile, SCHEMA};
use super::table::{
    ClosedFormIntervals, ClosedFormTable, HertzTable, MaterialTable, ProvenanceTable,
    SplineIntervals, SplineTable, UnloadingIntervals, UnloadingTable, ValidTable, YieldTable,
};
use crate::Result;
use crate::case::Case;
use crate::contact::NormalLaw;
use crate::contact::loading::{Loading, SoftenedHertz};
use crate::contact::spline::SplineLoading;
use crate::contact::unloading::Unloading;
use crate::files::write_atomic;
use crate::fit::quality::Quality;
use crate::fit::{Fit, FittedForm, Outcome, THRESHOLD};
use crate::material::flow::FlowConstants;
use crate::material::{Material, YIELD_PRESSURE_RATIO};
use std::path::Path;

/// What a person who opens a law file needs to know; the equations are those of `contact::loading`, `contact::spline`,
/// `contact::unloading` and `contact::inertia`.
const HEADER: &str = "\
Normal contact law of one body pressed by a rigid plane, fitted to simulated impacts.
Two equal spheres: F(delta/2). Two bodies: in series, delta = delta_1 + delta_2, F_1 = F_2.
With R the radius of the body: w = (delta/R) / yield_point.displacement_over_radius,
F = R^2 yield_point.force_over_radius2_Pa f(w).
Loading, closed form:  f = w^1.5 exp(-q L^3/(b^2 + L^2)),  L = max(0, ln(w/w_1)),
                       w_1 = departure, b = breadth, q = softening.
Loading, spline:       f = w^1.5 up to w_1 = hertz_to, then a cubic in sqrt(w) from knot to knot (Hermite) with knots
                       [w, f, df/dw] after the first one at hertz_to, then a straight line in w.
Unloading from the largest displacement delta_m, where the force was F_m (same w_1):
                       F = F_m ((delta - delta_r)/(delta_m - delta_r))^n, 0 below delta_r = rho delta_m,
                       rho = 1 - (1 + (w_m - w_1)/residual_scale)^(-residual_power) for w_m > w_1, else 0,
                       n = 1.5 + exponent_residual rho + exponent_strain (delta_m - delta_1)/R for w_m > w_1,
                       else 1.5; delta_1 is the displacement at w_1.
Reloading goes back up to delta_m, then along the loading curve.
Inertia, on top of first loading at the rate v (no key inertia: the impacts do not show it):
                       F_i = R^2 inertia density_kg_m3 v^2 sqrt((delta - delta_1)/R), 0 up to delta_1.
                       `law eval` and beds use the law without it.
Errors (quality, left_out) are relative: law over simulation less 1; left_out: fitted without that speed.
Intervals: 95 %, bootstrap over the impacts.
";

impl LawFile {
    /// Law file of a fit; `program` is name and version.
    #[must_use]
    pub fn of(fit: &Fit, case: &Case, program: &str) -> Self {
        let mut file = LawFile {
            schema: SCHEMA,
            name: case.name.clone(),
            form: Form::Hertz,
            material: material_table(&case.material),
            yield_point: None,
            valid: ValidTable {
                displacement_over_radius_max: fit.flattening,
                velocity_min_m_s: fit.velocities[0],
                velocity_max_m_s: fit.velocities[1],
            },
            provenance: ProvenanceTable {
                program: program.to_owned(),
                case: case.name.clone(),
                case_sha256: case.hash.clone(),
                radius_m: case.radius,
                skipped_velocities_m_s: fit.skipped.clone(),
            },
            hertz: None,
            closed_form: None,
            spline: None,
        };
        match &fit.outcome {
            Outcome::Elastic { quality, .. } => file.hertz = Some(hertz_table(quality, case)),
            Outcome::Yielding {
                closed_form,
                spline,
            } => {
                let units = closed_form.law.units();
                file.yield_point = Some(YieldTable {
                    pressure_ratio: YIELD_PRESSURE_RATIO,
                    displacement_over_radius: units.flattening,
                    force_over_radius2_pa: units.force,
                });
                file.form = preferred(worst(&closed_form.quality), worst(&spline.quality));
                file.closed_form = Some(closed_form_table(closed_form));
                file.spline = Some(spline_table(spline));
            }
        }
        file
    }

    /// The file's text: comments with the equations, then the tables.
    ///
    /// # Errors
    /// [`crate::Error::Fit`] if the tables cannot be put into TOML.
    pub fn text(&self) -> Result<String> {
        let tables = toml::to_string(self).map_err(|e| crate::Error::Fit {
            reason: format!("the law cannot be written as TOML: {e}"),
        })?;
        let comments: String = HEADER.lines().map(|line| format!("# {line}\n")).collect();
        Ok(format!("{comments}\n{tables}"))
    }

    /// Write the file.
    ///
    /// # Errors
    /// [`crate::Error::File`] when it cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        write_atomic(path, self.text()?.as_bytes())
    }

    /// Largest error of F*, delta* and e over all speeds, of the form the file names.
    #[must_use]
    pub fn worst_error(&self) -> f64 {
        let rows = match self.form {
            Form::Hertz => self.hertz.as_ref().map(|t| &t.quality),
            Form::ClosedForm => self.closed_form.as_ref().map(|t| &t.quality),
            Form::Spline => self.spline.as_ref().map(|t| &t.quality),
        };
        rows.into_iter()
            .flatten()
            .flat_map(|q| [q.max_force, q.max_displacement, q.restitution])
            .fold(
                0.0,
                |worst, e| if e.abs() <= worst { worst } else { e.abs() },
            )
    }
}

/// The closed form, which travels further, unless it misses the threshold and the spline is nearer.
fn preferred(closed_form: f64, spline: f64) -> Form {
    if closed_form <= THRESHOLD || closed_form <= spline {
        Form::ClosedForm
    } else {
        Form::Spline
    }
}

fn worst(quality: &[Quality]) -> f64 {
    quality
        .iter()
        .map(Quality::worst)
        .fold(0.0, |worst, e| if e <= worst { worst } else { e })
}

fn material_table(material: &Material) -> MaterialTable {
    MaterialTable {
        density_kg_m3: material.density,
        young_modulus_pa: material.young_modulus,
        poisson_ratio: material.poisson_ratio,
        flow: FlowConstants::of(material.flow.as_ref()),
    }
}

fn hertz_table(quality: &[Quality], case: &Case) -> HertzTable {
    let point = case.material.yield_point(case.radius, YIELD_PRESSURE_RATIO);
    HertzTable {
        reason: match point {
            None => "the material has no yield strength".to_owned(),
            Some(p) => format!(
                "no impact is faster than the yield speed, {} m/s",
                p.velocity
            ),
        },
        quality: quality.iter().map(Into::into).collect(),
    }
}

fn unloading_table(unloading: &Unloading) -> UnloadingTable {
    let [
        residual_scale,
        residual_power,
        exponent_residual,
        exponent_strain,
    ] = unloading.constants();
    UnloadingTable {
        residual_scale,
        residual_power,
        exponent_residual,
        exponent_strain,
    }
}

/// The last four intervals of a fit.
fn unloading_intervals(all: &[[f64; 2]]) -> UnloadingIntervals {
    let last = |i: usize| all[all.len() - 4 + i];
    UnloadingIntervals {
        residual_scale: last(0),
        residual_power: last(1),
        exponent_residual: last(2),
        exponent_strain: last(3),
    }
}

/// Inertia coefficient of a form, if it has one.
fn inertia<L: Loading>(form: &FittedForm<L>) -> Option<f64> {
    let coefficient = form.law.inertia().coefficient();
    (coefficient > 0.0).then_some(coefficient)
}

/// Its interval: it stands before the last four.
fn inertia_interval<L: Loading>(form: &FittedForm<L>, all: &[[f64; 2]]) -> Option<[f64; 2]> {
    inertia(form).map(|_| all[all.len() - 5])
}

fn closed_form_table(form: &FittedForm<SoftenedHertz>) -> ClosedFormTable {
    let curve = form.law.loading();
    ClosedFormTable {
        departure: curve.departure(),
        breadth: curve.breadth(),
        softening: curve.softening(),
        inertia: inertia(form),
        unloading: unloading_table(form.law.unloading()),
        intervals: form.intervals.as_ref().map(|all| ClosedFormIntervals {
            departure: all[0],
            breadth: all[1],
            softening: all[2],
            inertia: inertia_interval(form, all),
            unloading: unloading_intervals(all),
        }),
        quality: form.quality.iter().map(Into::into).collect(),
        left_out: form.left_out.iter().map(Into::into).collect(),
    }
}

fn spline_table(form: &FittedForm<SplineLoading>) -> SplineTable {
    let curve = form.law.loading();
    let knots = curve.knots().iter();
    SplineTable {
        hertz_to: curve.departure(),
        knots: knots.map(|k| [k.flattening, k.force, k.slope]).collect(),
        inertia: inertia(form),
        unloading: unloading_table(form.law.unloading()),
        intervals: form.intervals.as_ref().map(|all| SplineIntervals {
            knot_force: all[..curve.knots().len()].to_vec(),
            inertia: inertia_interval(form, all),
            unloading: unloading_intervals(all),
        }),
        quality: form.quality.iter().map(Into::into).collect(),
        left_out: form.left_out.iter().map(Into::into).collect(),
    }
}
