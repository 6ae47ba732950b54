//! Writing of law files: a fit as tables, with the equations on top.

use super::file::{Form, LawFile, SCHEMA, plain};
use super::table::{
    ClosedFormIntervals, ClosedFormTable, HertzTable, ProvenanceTable, SplineIntervals,
    SplineTable, ThresholdTable, UnloadingIntervals, UnloadingTable, ValidTable, YieldTable,
};
use crate::Result;
use crate::atlas::Atlas;
use crate::case::Case;
use crate::contact::NormalLaw;
use crate::contact::loading::{Loading, SoftenedHertz};
use crate::contact::spline::SplineLoading;
use crate::contact::unloading::Unloading;
use crate::files::{sha256, write_atomic};
use crate::fit::quality::{LeftOut, Quality};
use crate::fit::{Fit, FittedForm, Outcome, left_out_bound, threshold};
use crate::material::{Material, MaterialTable, YIELD_PRESSURE_RATIO};
use std::path::Path;

/// What a person who opens a law file needs to know; the equations are those of `contact::loading`, `contact::spline`,
/// `contact::unloading` and `contact::inertia`.
const HEADER: &str = "\
Normal contact law of one body pressed by a rigid plane, fitted to simulated impacts.
Two equal spheres: F(delta/2). Two bodies: in series, delta = delta_1 + delta_2, F_1 = F_2.
With R the radius of the body: w = (delta/R) / yield_point.displacement_over_radius,
";

/// The same of a pair, as [`crate::material::Effective`] has it.
const PAIR_HEADER: &str = "\
Normal contact law of the two bodies of [pair], fitted to simulated impacts of one on the other. It is of both together: no law of one
of them, and none of the same bodies in series.
delta is the approach of their centres of mass since first contact; of a plate or half-space, which is held, that of the particle's.
R is the effective radius, 1/R = 1/R_1 + 1/R_2 (R_1 on what is flat), and [material] the sphere of that radius that meets a rigid
plane in their place: E/(1 - poisson_ratio^2) = E* with 1/E* = 1/E*_1 + 1/E*_2, the flow stress of the body that yields first, the
density with which its mass is m, 1/m = 1/m_1 + 1/m_2 (m_1 on what is flat). m delta'' = -F.
It holds for these materials and bodies similar to these: R_2/R_1 or thickness/R_1 as here. What waves take into a flat body is in it.
w = (delta/R) / yield_point.displacement_over_radius,
";

/// What follows in both.
const EQUATIONS: &str = "\
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
Errors (quality, left_out) are relative: law over simulation less 1, that of e below 0.1 over 0.1; left_out: fitted without
that speed. Intervals: 95 %, bootstrap over five impacts or more. With one speed residual_power and exponent_strain are held at
0.54 (Jackson, Green and Marghitu 2010) and 7.5. Beyond thresholds.error `fit` ends with exit code 1.
";

impl LawFile {
    /// Law file of a fit; `program` is name and version.
    #[must_use]
    pub fn of(fit: &Fit, case: &Case, program: &str) -> Self {
        let mut file = LawFile {
            schema: SCHEMA,
            name: plain(&case.name),
            form: Form::Hertz,
            warnings: Vec::new(),
            material: MaterialTable::from(&case.material),
            pair: None,
            yield_point: None,
            valid: ValidTable {
                displacement_over_radius_max: fit.flattening,
                velocity_min_m_s: fit.velocities[0],
                velocity_max_m_s: fit.velocities[1],
            },
            thresholds: Some(ThresholdTable {
                tolerance: fit.tolerance,
                error: threshold(fit.tolerance),
                left_out: left_out_bound(fit.tolerance),
            }),
            provenance: ProvenanceTable {
                program: plain(program),
                case: plain(&case.name),
                case_sha256: case.hash.clone(),
                radius_m: case.radius,
                skipped_velocities_m_s: fit.skipped.iter().map(|s| s.velocity).collect(),
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
                let units = match (closed_form, spline) {
                    (Some(form), _) => Some(form.law.units()),
                    (None, form) => form.as_ref().map(|form| form.law.units()),
                };
                file.yield_point = units.map(|units| YieldTable {
                    pressure_ratio: YIELD_PRESSURE_RATIO,
                    displacement_over_radius: units.flattening,
                    force_over_radius2_pa: units.force,
                });
                file.form = preferred(
                    closed_form.as_ref().map(|form| worst(&form.quality)),
                    spline.as_ref().map(|form| worst(&form.quality)),
                    threshold(fit.tolerance),
                );
                file.closed_form = closed_form.as_deref().map(closed_form_table);
                file.spline = spline.as_deref().map(spline_table);
            }
        }
        file.warnings = file.what_to_know(fit);
        file.warnings.extend(case.method.map(|method| {
            format!("the impacts are those of scheme preset {method}: the law follows that method, errors of the method and all")
        }));
        file
    }

    /// Law file of a material from the atlas: no impact of its own was run. `radius` (m) is that of its reference impacts.
    ///
    /// # Errors
    /// Those of [`Atlas::built_in`] and [`Atlas::law`].
    pub fn of_atlas(name: &str, material: &Material, radius: f64) -> Result<Self> {
        let atlas = Atlas::built_in()?;
        let law = atlas.law(material)?;
        let units = law.units();
        let velocities = atlas.velocities(material);
        let coefficient = law.inertia().coefficient();
        let mut file = LawFile {
            schema: SCHEMA,
            name: plain(name),
            form: Form::Spline,
            warnings: vec![atlas.provenance(material)],
            material: MaterialTable::from(material),
            pair: None,
            yield_point: Some(YieldTable {
                pressure_ratio: YIELD_PRESSURE_RATIO,
                displacement_over_radius: units.flattening,
                force_over_radius2_pa: units.force,
            }),
            valid: ValidTable {
                displacement_over_radius_max: law.valid_to(),
                velocity_min_m_s: velocities[0],
                velocity_max_m_s: velocities[1],
            },
            thresholds: None,
            provenance: ProvenanceTable {
                program: plain(&atlas.program),
                case: plain(name),
                case_sha256: String::new(),
                radius_m: radius,
                skipped_velocities_m_s: Vec::new(),
            },
            hertz: None,
            closed_form: None,
            spline: Some(SplineTable {
                hertz_to: law.loading().departure(),
                knots: knots(law.loading()),
                inertia: (coefficient > 0.0).then_some(coefficient),
                unloading: unloading_table(law.unloading()),
                intervals: None,
                quality: Vec::new(),
                left_out: Vec::new(),
            }),
        };
        // what its tables say stands for the case that it has not
        file.provenance.case_sha256 = sha256([file.text()?]);
        Ok(file)
    }

    /// Impacts that were not used, a form that was not found, left-out speeds that the form in use misses.
    fn what_to_know(&self, fit: &Fit) -> Vec<String> {
        let mut warnings: Vec<String> = fit
            .skipped
            .iter()
            .map(|s| format!("the impact at {} m/s {} and is left out", s.velocity, s.why))
            .collect();
        warnings.extend(fit.missing.iter().map(|why| format!("no {why}")));
        let bound = left_out_bound(fit.tolerance);
        let left_out: Vec<&LeftOut> = match &fit.outcome {
            Outcome::Elastic { .. } => Vec::new(),
            Outcome::Yielding {
                closed_form,
                spline,
            } => match self.form {
                Form::Spline => spline.iter().flat_map(|form| &form.left_out).collect(),
                Form::Hertz | Form::ClosedForm => {
                    closed_form.iter().flat_map(|form| &form.left_out).collect()
                }
            },
        };
        for one in left_out {
            let worst = one.worst();
            // a NaN is beyond every bound
            if worst > bound || worst.is_nan() {
                let said = match worst.is_nan() {
                    true => "find no law for it".to_owned(),
                    false => format!("miss it by {:.0} %", 100.0 * worst),
                };
                warnings.push(format!(
                    "left out, {} m/s is not predicted: the other speeds {said} (bound {:.0} %)",
                    one.velocity,
                    100.0 * bound
                ));
            }
        }
        warnings
    }

    /// Largest error with which the law counts as good.
    #[must_use]
    pub fn threshold(&self) -> f64 {
        match &self.thresholds {
            Some(thresholds) => thresholds.error,
            // files without the table come from cases of this tolerance
            None => threshold(0.02),
        }
    }

    /// The file's text: comments with the equations, then the tables.
    ///
    /// # Errors
    /// [`crate::Error::Fit`] if the tables cannot be put into TOML.
    pub fn text(&self) -> Result<String> {
        let tables = toml::to_string(self).map_err(|e| crate::Error::Fit {
            reason: format!("the law cannot be written as TOML: {e}"),
        })?;
        let head = match self.pair {
            None => HEADER,
            Some(_) => PAIR_HEADER,
        };
        let lines = head.lines().chain(EQUATIONS.lines());
        let comments: String = lines.map(|line| format!("# {line}\n")).collect();
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

/// The closed form, which travels further, unless it misses the threshold and the spline is nearer; or the one there is. Both
/// by their largest errors.
fn preferred(closed_form: Option<f64>, spline: Option<f64>, threshold: f64) -> Form {
    match (closed_form, spline) {
        (Some(closed_form), Some(spline)) if closed_form > threshold && closed_form > spline => {
            Form::Spline
        }
        (None, Some(_)) => Form::Spline,
        (Some(_), _) | (None, None) => Form::ClosedForm,
    }
}

fn worst(quality: &[Quality]) -> f64 {
    quality
        .iter()
        .map(Quality::worst)
        .fold(0.0, |worst, e| if e <= worst { worst } else { e })
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

fn knots(curve: &SplineLoading) -> Vec<[f64; 3]> {
    let rows = curve.knots().iter();
    rows.map(|k| [k.flattening, k.force, k.slope]).collect()
}

fn spline_table(form: &FittedForm<SplineLoading>) -> SplineTable {
    let curve = form.law.loading();
    SplineTable {
        hertz_to: curve.departure(),
        knots: knots(curve),
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
