//! The fit of the atlas: impacts of many materials, one set of polynomials, and its errors at materials that were left out.

use super::law::{Atlas, NUMBERS, SOFT, assemble, polynomials};
use super::place::{Place, Range, TERMS};
use super::score::Score;
use crate::case::Case;
use crate::contact::elastoplastic::Spline;
use crate::contact::loading::Loading;
use crate::contact::rebound::rebound;
use crate::curve::Impact;
use crate::fit::marquardt::{Stop, minimise};
use crate::fit::pulse::{Added, Pulse};
use crate::fit::run::{Run, Scale};
use crate::material::YIELD_PRESSURE_RATIO;
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// An impact in reference units with its case, R = rho = E = 1.
pub type Reference = (Case, Impact);

/// Constants of the atlas.
const ALL: usize = NUMBERS * TERMS;
/// Least speed over that of first yield of an impact that takes part: below it Hertz's law is known.
const LEAST_SPEED: f64 = 1.5;
/// $\rho V^2/Y$ up to which errors are counted.
const COUNTED: f64 = 1.0;
/// Restitution below which its error is counted over this.
const LEAST_RESTITUTION: f64 = 0.2;
/// Parts that materials are dealt to, of which each is left out once.
const PARTS: usize = 10;
/// Levels of E/Y, nu and H/Y of which each is left out once.
const LEVELS: usize = 4;
/// The whole fit, and one that begins at a fit to more materials.
const WHOLE: Stop = Stop {
    steps: 60,
    fall: 1e-5,
};
const AGAIN: Stop = Stop {
    steps: 12,
    fall: 1e-5,
};
/// Errors of F*, delta* and e count progressively with this factor in the second pass, so that the largest are levelled. A first
/// pass without it finds the basin.
const PASSES: [f64; 2] = [0.0, 0.3];
/// Error of F*, delta* and e that costs one.
const FIGURE: f64 = 0.01;
/// Error of what is recovered, of the contact time, and root mean square of the forces along a branch over F*, that cost one: they
/// settle what the figures leave open.
const BESIDE: f64 = 0.2;
/// Distance of a constant from where it starts that costs one: of the first term, and of all others.
const SPREAD: [f64; 2] = [2.0, 1.0];
/// Step of the difference quotients.
const DIFFERENCE: f64 = 1e-4;
/// Free numbers of the law that the fit starts from: departure at 0.4 flattenings of first yield, exponents of 1.1, inertia and
/// unloading as in [`crate::fit::form`].
const START: [f64; 2] = [-0.92, 1.0];
/// The others: logarithms of 5.66, 6.9, 0.54, 0.4, 7.5.
const START_OTHERS: [f64; 5] = [1.733, 1.932, -0.616, -0.916, 2.015];

/// An impact of a material.
#[derive(Debug, Clone)]
struct Sample {
    place: Place,
    terms: [f64; TERMS],
    scale: Scale,
    run: Run,
    severity: f64,
}

impl Sample {
    /// An impact that takes part; `None` for one that stays nearly elastic or does not come back.
    fn of((case, impact): &Reference) -> Option<Self> {
        let material = &case.material;
        let place = Place::of(material).ok()?;
        let scale = Scale::of(material, case.radius)?;
        let velocity = case.velocities[0];
        let first = material.yield_point(case.radius, YIELD_PRESSURE_RATIO)?;
        let run = Run::reduce(impact, &scale).ok()?;
        let takes_part = velocity > LEAST_SPEED * first.velocity && !run.sticks;
        takes_part.then(|| Sample {
            place,
            terms: place.terms(),
            scale,
            severity: severity(case),
            run,
        })
    }

    /// Law of its material.
    fn law(&self, free: &[f64]) -> Option<Spline> {
        assemble(free, &self.scale, f64::MAX)
    }

    /// Residuals of the law with these free numbers; figures that are off by a large part count with one plus `power` squares.
    fn residuals(&self, free: &[f64], power: f64) -> Option<Vec<f64>> {
        let law = self.law(free)?;
        let run = &self.run;
        let pulse = Pulse::of(&law, run.energy, run.max_flattening)?;
        let figure = |error: f64| error / FIGURE * (power * error / FIGURE).hypot(1.0);
        let recovered = (pulse.flattening - pulse.residual) / (run.max_flattening - run.residual);
        let mut all = vec![
            figure((pulse.force / run.max_force).ln()),
            figure((pulse.flattening / run.max_flattening).ln()),
            figure(error_of_restitution(pulse.restitution, run.restitution)),
            recovered.ln() / BESIDE,
            (pulse.time / run.contact_time).ln() / BESIDE,
        ];
        let branch = |points: usize| 1.0 / (BESIDE * (points as f64).sqrt());
        let (curve, added) = (law.loading(), Added::of(&law));
        let weight = branch(run.loading.len());
        all.extend(run.loading.iter().map(|p| {
            let force = curve.force(p.flattening) + added.force(p.flattening, p.energy);
            (force / run.max_force - p.force) * weight
        }));
        let weight = branch(run.unloading.len());
        let (rho, n) = law.branch(run.max_flattening);
        let (w_m, w_r) = (run.max_flattening, rho * run.max_flattening);
        let top = curve.force(w_m) / run.max_force;
        all.extend(run.unloading.iter().map(|(w, f)| {
            let z = ((w - w_r) / (w_m - w_r)).clamp(0.0, 1.0);
            (top * z.powf(n) - f) * weight
        }));
        all.iter().all(|r| r.is_finite()).then_some(all)
    }

    /// Errors of F*, delta* and e of the law with these constants; all of them where there is none.
    fn errors(&self, constants: &[f64]) -> [f64; 3] {
        let law = self.law(&polynomials(constants, &self.terms));
        law.map_or([1.0; 3], |law| {
            let Scale { radius, mass, .. } = self.scale;
            let hit = rebound(&law, radius, mass, self.run.velocity);
            let run = &self.run;
            [
                hit.max_force / (run.max_force * self.scale.force) - 1.0,
                hit.max_displacement / (run.max_flattening * self.scale.displacement) - 1.0,
                error_of_restitution(hit.restitution, run.restitution),
            ]
        })
    }
}

/// Error of the restitution `found` where `truth` is right, over `truth`; below 0.2 over 0.2.
#[must_use]
pub fn error_of_restitution(found: f64, truth: f64) -> f64 {
    (found - truth) / truth.max(LEAST_RESTITUTION)
}

fn severity(case: &Case) -> f64 {
    let strength = case.material.flow.map_or(f64::NAN, |f| f.yield_strength());
    case.material.density * case.velocities[0].powi(2) / strength
}

const ABOUT: &str = "Free numbers of a spline law as polynomials of the material; made by `impactlaw atlas`, read by `impactlaw law`. \
                     Free numbers in order: ln w1, seven logits of exponents over 3/2, ln kappa, ln c, ln k, ln(n1 + 1/2), ln n2. \
                     Terms: 1, a, n, h, aa, an, ah, nn, nh, hh, aaa, aah, ahh, hhh with \
                     a = ln(E*/Y/250)/2.5, n = (nu - 0.33)/0.15, h = ln(1 + H/Y)/2. Errors: F*, delta*, e.";

impl Atlas {
    /// Fit to impacts in reference units. `study` is the name of their study and its hash.
    ///
    /// Impacts below 1.5 times the speed of first yield, and those that did not end well, are left out.
    ///
    /// # Errors
    /// [`Error::Fit`] when fewer impacts are left than the atlas has constants, or when the fit finds no law.
    pub fn fit(impacts: &[Reference], study: (&str, &str), program: &str) -> Result<Self> {
        let samples: Vec<Sample> = impacts.iter().filter_map(Sample::of).collect();
        if samples.len() < ALL {
            return Err(Error::Fit {
                reason: format!(
                    "{} impacts yield and end well; the atlas has {ALL} constants and asks for as many",
                    samples.len()
                ),
            });
        }
        let everyone: Vec<&Sample> = samples.iter().collect();
        let mut constants = start();
        for power in PASSES {
            constants = solve(&everyone, &constants, power, WHOLE)?;
        }
        let materials = materials(&samples);
        let tenth = |part: usize| materials.iter().map(|m| m % PARTS == part).collect();
        let tenths: Vec<Vec<bool>> = (0..PARTS).map(tenth).collect();
        let everywhere = |_: &Sample| true;
        let soft = |sample: &Sample| sample.place.young_over_yield < SOFT;
        let left_out = left_out(&samples, &constants, &tenths)?;
        let levels = self::left_out(&samples, &constants, &levels(&samples))?;
        Ok(Atlas {
            about: ABOUT.to_owned(),
            program: program.to_owned(),
            study: study.0.to_owned(),
            study_sha256: study.1.to_owned(),
            impacts: [impacts.len(), samples.len()],
            tolerance: impacts.iter().map(|(c, _)| c.tolerance).fold(0.0, f64::max),
            range: range(impacts),
            own: score(&errors(&constants, &everyone), everywhere),
            left_out: score(&left_out, everywhere),
            left_out_soft: score(&left_out, soft),
            levels: score(&levels, everywhere),
            numbers: constants.chunks(TERMS).map(<[f64]>::to_vec).collect(),
        })
    }
}

/// The range that holds all impacts of materials that the atlas can place.
fn range(impacts: &[Reference]) -> Range {
    let over = |of: &dyn Fn(&Reference, &Place) -> f64| {
        let places = impacts
            .iter()
            .filter_map(|i| Some((i, Place::of(&i.0.material).ok()?)));
        places
            .map(|(i, place)| of(i, &place))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
    };
    Range {
        young_over_yield: over(&|_, place| place.young_over_yield),
        poisson_ratio: over(&|_, place| place.poisson_ratio),
        hardening_over_young: over(&|_, place| place.hardening_over_young),
        severity: over(&|i, _| severity(&i.0)),
    }
}

/// Errors of impacts.
type Errors<'a> = Vec<(&'a Sample, [f64; 3])>;

/// Errors of the impacts that count.
fn errors<'a>(constants: &[f64], of: &[&'a Sample]) -> Errors<'a> {
    of.par_iter()
        .filter(|sample| sample.severity < COUNTED)
        .map(|sample| (*sample, sample.errors(constants)))
        .collect()
}

/// Score of those errors whose impacts are `wanted`.
fn score(all: &Errors<'_>, wanted: impl Fn(&Sample) -> bool) -> Score {
    let errors = all.iter().filter(|(sample, _)| wanted(sample));
    Score::of(&errors.map(|(_, errors)| *errors).collect::<Vec<_>>())
}

/// Errors of each of `parts` with the law fitted to the others.
fn left_out<'a>(
    samples: &'a [Sample],
    constants: &[f64],
    parts: &[Vec<bool>],
) -> Result<Errors<'a>> {
    let mut all = Vec::new();
    for out in parts {
        let side = |wanted: bool| -> Vec<&Sample> {
            let chosen = samples.iter().zip(out).filter(|(_, out)| **out == wanted);
            chosen.map(|(sample, _)| sample).collect()
        };
        let fitted = solve(&side(false), constants, PASSES[1], AGAIN)?;
        all.extend(errors(&fitted, &side(true)));
    }
    Ok(all)
}

/// One law for all materials.
fn start() -> Vec<f64> {
    let mut constants = vec![0.0; ALL];
    for k in 0..NUMBERS {
        let others = k.checked_sub(NUMBERS - START_OTHERS.len());
        constants[k * TERMS] = others.map_or(START[k.min(1)], |i| START_OTHERS[i]);
    }
    constants
}

/// Number of the material of each sample: all impacts of one are left out together.
fn materials(samples: &[Sample]) -> Vec<usize> {
    let mut known: Vec<Place> = Vec::new();
    let number = |sample: &Sample| {
        let found = known.iter().position(|place| *place == sample.place);
        found.unwrap_or_else(|| {
            known.push(sample.place);
            known.len() - 1
        })
    };
    samples.iter().map(number).collect()
}

/// For each of the quarters of each coordinate, which samples are in it.
fn levels(samples: &[Sample]) -> Vec<Vec<bool>> {
    let mut all = Vec::new();
    for axis in 0..3 {
        let at = |s: &Sample| s.place.coordinates()[axis];
        let mut sorted: Vec<f64> = samples.iter().map(at).collect();
        sorted.sort_by(f64::total_cmp);
        let bounds = (1..LEVELS).map(|k| sorted[k * sorted.len() / LEVELS]);
        // many have no hardening: they are one level
        let mut bounds: Vec<f64> = bounds.collect();
        bounds.dedup();
        let level = |s: &Sample| bounds.iter().filter(|bound| at(s) > **bound).count();
        for wanted in 0..=bounds.len() {
            let inside: Vec<bool> = samples.iter().map(|s| level(s) == wanted).collect();
            let count = inside.iter().filter(|inside| **inside).count();
            if count > 0 && count < samples.len() {
                all.push(inside);
            }
        }
    }
    all
}

/// What an impact adds to the normal equations: of its own free numbers.
struct Normal {
    matrix: [[f64; NUMBERS]; NUMBERS],
    downhill: [f64; NUMBERS],
}

/// How far a constant may stray.
fn spread(k: usize) -> f64 {
    SPREAD[usize::from(!k.is_multiple_of(TERMS))]
}

/// Cost at `constants`; infinite where a law is not admissible.
fn cost(samples: &[&Sample], constants: &[f64], origin: &[f64], power: f64) -> f64 {
    let one = |sample: &&Sample| {
        let residuals = sample.residuals(&polynomials(constants, &sample.terms), power);
        residuals.map_or(f64::INFINITY, |r| r.iter().map(|x| x * x).sum::<f64>())
    };
    let costs: Vec<f64> = samples.par_iter().map(one).collect();
    let strayed = constants.iter().zip(origin).enumerate();
    let held = strayed.map(|(k, (c, o))| ((c - o) / spread(k)).powi(2));
    // in the order of the samples, for any number of threads
    costs.iter().sum::<f64>() + held.sum::<f64>()
}

/// Slopes by central differences; one-sided at the edge of what is admissible, and none where a number can move to neither side.
fn normal(sample: &Sample, constants: &[f64], power: f64) -> Option<Normal> {
    let free = polynomials(constants, &sample.terms);
    let here = sample.residuals(&free, power)?;
    let column = |k: usize| {
        let at = |step: f64| {
            let mut moved = free.clone();
            moved[k] += step;
            sample.residuals(&moved, power)
        };
        let [up, down] = [DIFFERENCE, -DIFFERENCE].map(at);
        let sides = f64::from(u8::from(up.is_some()) + u8::from(down.is_some())).max(1.0);
        let (up, down) = (up.unwrap_or(here.clone()), down.unwrap_or(here.clone()));
        let slopes = up
            .iter()
            .zip(&down)
            .map(|(a, b)| (a - b) / (sides * DIFFERENCE));
        slopes.collect::<Vec<f64>>()
    };
    let columns: Vec<Vec<f64>> = (0..NUMBERS).map(column).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    Some(Normal {
        matrix: std::array::from_fn(|i| std::array::from_fn(|j| dot(&columns[i], &columns[j]))),
        downhill: std::array::from_fn(|i| -dot(&columns[i], &here)),
    })
}

/// Normal equations of all constants.
fn equations(
    samples: &[&Sample],
    constants: &[f64],
    origin: &[f64],
    power: f64,
) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let each = samples.par_iter().map(|s| normal(s, constants, power));
    let each: Vec<Option<Normal>> = each.collect();
    let mut matrix = DMatrix::<f64>::zeros(ALL, ALL);
    let mut right = DVector::<f64>::zeros(ALL);
    for (sample, normal) in samples.iter().zip(each) {
        let (normal, t) = (normal?, &sample.terms);
        for i in 0..NUMBERS {
            for a in 0..TERMS {
                right[i * TERMS + a] += normal.downhill[i] * t[a];
                for j in 0..NUMBERS {
                    let part = normal.matrix[i][j] * t[a];
                    for b in 0..TERMS {
                        matrix[(i * TERMS + a, j * TERMS + b)] += part * t[b];
                    }
                }
            }
        }
    }
    for k in 0..ALL {
        let stiffness = spread(k).powi(-2);
        matrix[(k, k)] += stiffness;
        right[k] += (origin[k] - constants[k]) * stiffness;
    }
    Some((matrix, right))
}

/// Constants of least cost from `from` on.
fn solve(samples: &[&Sample], from: &[f64], power: f64, stop: Stop) -> Result<Vec<f64>> {
    let origin = start();
    let cost = |constants: &[f64]| cost(samples, constants, &origin, power);
    let equations = |constants: &[f64]| equations(samples, constants, &origin, power);
    let (constants, least) = minimise(from, stop, cost, equations);
    tracing::info!("atlas: cost {least:.4e} of {} impacts", samples.len());
    match least.is_finite() {
        true => Ok(constants),
        false => Err(Error::Fit {
            reason: "the atlas finds no admissible law for every material".to_owned(),
        }),
    }
}
