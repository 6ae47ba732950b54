//! Search: every small structure is fitted, the best are grown, and each is made simpler number by number.
//!
//! Physics rejects before anything is fitted: a structure that cannot have the limit is not looked at, and a fitted formula that
//! breaks a bound or turns where it must not is no result.

use super::enumerate::{grown, shapes};
use super::formula::{Columns, Formula, Ratio, Role, Shape, Source};
use super::solve::{Data, Fitted, fit, standard_errors};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How far a search goes; the time it takes is theirs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Largest structure that is enumerated, in nodes.
    pub size: usize,
    /// Starts from which each structure is fitted.
    pub starts: usize,
    /// Structures that are grown and made simpler, of each number of power products.
    pub kept: usize,
    /// Rounds of growth.
    pub rounds: usize,
}

/// What is looked for.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// What it is fitted to.
    pub data: Data<'a>,
    /// Rows at the limit and the value there.
    pub limit: Option<(&'a Columns, f64)>,
    /// Number of vanishing factors; a formula holds one kind of them.
    pub vanishing: usize,
    /// Whether a fitted formula is physical.
    pub physical: &'a (dyn Fn(&Formula) -> bool + Sync),
    /// Seed of the starts.
    pub seed: u64,
    /// How far to go.
    pub effort: Effort,
}

/// A formula found.
#[derive(Debug, Clone)]
pub struct Found {
    /// It, fitted.
    pub fitted: Fitted,
    /// Number of its fitted constants.
    pub constants: usize,
    /// Bits of structure and constants.
    pub bits: f64,
}

impl Found {
    /// Description length: bits of structure, constants and misfit.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.bits + misfit_bits(self.fitted.chi2)
    }
}

/// Most that two numbers may differ to be the same limit.
const SAME: f64 = 1e-9;
/// Steps of a first fit, of one while numbers are taken out, and of the last one.
const STEPS: [usize; 3] = [40, 12, 200];
/// Denominators of exponents that belong to the structure.
const UNDER: [i32; 6] = [1, 2, 3, 4, 5, 8];
/// Formulas that are made simpler side by side.
const BEAM: usize = 3;
/// Best formulas kept of each number of constants.
const KEPT: usize = 12;

/// Searches; the best formulas of each number of constants, best first. The same for any number of threads.
#[must_use]
pub fn search(task: &Task<'_>) -> Vec<Found> {
    let mut seen: BTreeMap<Shape, Option<Fitted>> = BTreeMap::new();
    let mut pool: BTreeMap<usize, Vec<Found>> = BTreeMap::new();
    let kinds: Vec<Option<usize>> = match task.vanishing {
        0 => vec![None],
        n => (0..n).map(Some).collect(),
    };
    let mut fresh: Vec<Shape> = Vec::new();
    for kind in &kinds {
        let mut leaves = vec![Shape::Leaf(*kind)];
        if kind.is_some() {
            leaves.push(Shape::Leaf(None));
        }
        fresh.extend(shapes(&leaves, task.effort.size));
    }
    fresh.sort();
    fresh.dedup();
    for round in 0..=task.effort.rounds {
        fresh.retain(|shape| !seen.contains_key(shape) && shape.leaves() > 0 && can(shape, task));
        let fits: Vec<Option<Fitted>> = fresh
            .par_iter()
            .enumerate()
            .map(|(i, shape)| first_fit(shape, task, round as u64, i as u64))
            .collect();
        let kept = best_of(&fresh, &fits, task.effort.kept);
        seen.extend(fresh.drain(..).zip(fits));
        let simpler: Vec<Vec<Found>> = kept.par_iter().map(|one| simplify(one, task)).collect();
        for found in simpler.into_iter().flatten() {
            pool.entry(found.constants).or_default().push(found);
        }
        for found in pool.values_mut() {
            tidy(found);
        }
        if round < task.effort.rounds {
            for one in &kept {
                let shape = &one.formula.shape;
                for kind in kinds.iter().copied().chain([None]) {
                    let all = grown(shape, &Shape::Leaf(kind));
                    fresh.extend(all.into_iter().filter(|new| alike(new, &kinds)));
                }
            }
            fresh.sort();
            fresh.dedup();
        }
    }
    let last = |found: Found| {
        let fitted = fit(&found.fitted.formula, &task.data, STEPS[2])?;
        (task.physical)(&fitted.formula).then(|| measured(fitted, &task.data))
    };
    let all: Vec<Found> = pool.into_values().flatten().collect();
    let all: Vec<Found> = all.into_par_iter().filter_map(last).collect();
    let mut pool: BTreeMap<usize, Vec<Found>> = BTreeMap::new();
    for found in all {
        pool.entry(found.constants).or_default().push(found);
    }
    pool.values_mut().for_each(tidy);
    pool.into_values().flatten().collect()
}

/// Whether all vanishing factors of a structure are of one kind.
fn alike(shape: &Shape, kinds: &[Option<usize>]) -> bool {
    fn collect(shape: &Shape, into: &mut Vec<usize>) {
        match shape {
            Shape::One => {}
            Shape::Leaf(kind) => into.extend(*kind),
            Shape::Sum(all) | Shape::Product(all) => all.iter().for_each(|s| collect(s, into)),
            Shape::Minus(s) | Shape::Power(s) | Shape::Exp(s) | Shape::Log(s) | Shape::Tanh(s) => {
                collect(s, into);
            }
        }
    }
    let mut found = Vec::new();
    collect(shape, &mut found);
    found.dedup();
    found.len() <= 1 && (found.is_empty() || kinds.contains(&Some(found[0])))
}

/// Best first, what has the same values once, at most [`KEPT`].
fn tidy(found: &mut Vec<Found>) {
    found.sort_by(|a, b| {
        a.length()
            .total_cmp(&b.length())
            .then(a.bits.total_cmp(&b.bits))
            .then_with(|| a.fitted.formula.shape.cmp(&b.fitted.formula.shape))
    });
    // equal to eight digits is equal: algebra that the canonical form did not see
    found.dedup_by(|b, a| (a.fitted.chi2 - b.fitted.chi2).abs() <= 1e-8 * a.fitted.chi2);
    found.truncate(KEPT);
}

fn generator(task: &Task<'_>, round: u64, number: u64) -> Pcg64 {
    Pcg64::seed_from_u64(
        task.seed
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .wrapping_add(round << 40)
            .wrapping_add(number),
    )
}

/// A normal number, by the sum of twelve uniform ones.
fn normal(random: &mut Pcg64) -> f64 {
    (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0
}

fn one_of(random: &mut Pcg64, all: &[f64]) -> f64 {
    all[random.random_range(0..all.len())]
}

/// Numbers to start from: power products of the size of one in the middle of the data.
fn start(shape: &Shape, columns: &Columns, random: &mut Pcg64) -> Vec<f64> {
    let groups = columns.logs.len();
    let roles = shape.roles(groups);
    let middle: Vec<f64> = columns
        .logs
        .iter()
        .map(|column| column.iter().sum::<f64>() / column.len().max(1) as f64)
        .collect();
    let mut numbers = Vec::with_capacity(roles.len());
    let mut i = 0;
    while i < roles.len() {
        match roles[i] {
            Role::Coefficient => {
                let exponents: Vec<f64> = (0..groups).map(|_| 0.5 * normal(random)).collect();
                let level: f64 = exponents.iter().zip(&middle).map(|(a, m)| a * m).sum();
                let sign = if random.random::<f64>() < 0.85 {
                    1.0
                } else {
                    -1.0
                };
                numbers.push(sign * (1.5 * normal(random) - level).exp());
                numbers.extend(exponents);
                i += 1 + groups;
            }
            Role::Order => {
                numbers.push(one_of(random, &[0.5, 1.0, 1.0, 2.0]));
                i += 1;
            }
            Role::Power => {
                numbers.push(one_of(
                    random,
                    &[-2.0, -1.0, -0.5, -0.25, 0.25, 0.5, 1.0, 2.0],
                ));
                i += 1;
            }
            // exponents come with their coefficient
            Role::Exponent => i += 1,
        }
    }
    numbers
}

/// Whether a structure can have the limit.
fn can(shape: &Shape, task: &Task<'_>) -> bool {
    let Some((columns, value)) = task.limit else {
        return true;
    };
    let mut random = Pcg64::seed_from_u64(1);
    (0..12).any(|_| {
        let formula = Formula::free(shape.clone(), start(shape, columns, &mut random));
        let values = formula.values(columns);
        values.iter().all(|y| (y - value).abs() < SAME)
    })
}

/// The best fit from all starts.
fn first_fit(shape: &Shape, task: &Task<'_>, round: u64, number: u64) -> Option<Fitted> {
    let mut random = generator(task, round, number);
    let mut best: Option<Fitted> = None;
    for _ in 0..task.effort.starts * shape.leaves().min(3) {
        let numbers = start(shape, task.data.columns, &mut random);
        let fitted = fit(&Formula::free(shape.clone(), numbers), &task.data, STEPS[0]);
        if let Some(fitted) = fitted
            && sane(&fitted.formula, task.data.columns.logs.len())
            && best.as_ref().is_none_or(|b| fitted.chi2 < b.chi2)
        {
            best = Some(fitted);
        }
    }
    best
}

/// Whether numbers are such that a formula means something: no exponents past all reason, and no bare number where a power
/// product was to be.
fn sane(formula: &Formula, groups: usize) -> bool {
    let roles = formula.shape.roles(groups);
    let within = |(x, role): (&f64, &Role)| match role {
        Role::Coefficient => x.is_finite(),
        Role::Exponent => x.abs() <= 6.0,
        Role::Order => *x > 0.0 && *x <= 6.0,
        Role::Power => x.abs() <= 12.0,
    };
    let fixed = |i: usize| matches!(formula.sources[i], Source::Fixed(_));
    let empty = |i: usize| {
        roles[i] == Role::Coefficient
            && fixed(i)
            && (1..=groups).all(|j| formula.sources[i + j] == Source::Fixed(Ratio::whole(0)))
            && roles.get(i + groups + 1) != Some(&Role::Order)
    };
    formula.numbers.iter().zip(&roles).all(within) && !(0..roles.len()).any(empty)
}

/// The best of each number of power products.
fn best_of(shapes: &[Shape], fits: &[Option<Fitted>], kept: usize) -> Vec<Fitted> {
    let mut by_leaves: BTreeMap<usize, Vec<&Fitted>> = BTreeMap::new();
    for (shape, fitted) in shapes.iter().zip(fits) {
        by_leaves.entry(shape.leaves()).or_default().extend(fitted);
    }
    let mut best = Vec::new();
    for all in by_leaves.values_mut() {
        all.sort_by(|a, b| a.chi2.total_cmp(&b.chi2));
        all.dedup_by(|b, a| (a.chi2 - b.chi2).abs() <= 1e-6 * a.chi2);
        best.extend(all.iter().take(kept).map(|f| (*f).clone()));
    }
    best
}

/// A fitted formula with its bits.
fn measured(fitted: Fitted, data: &Data<'_>) -> Found {
    let constants = fitted.formula.constants();
    let errors = standard_errors(&fitted, data);
    let digits = constants.iter().zip(&errors).map(|(&i, error)| {
        let size = fitted.formula.numbers[i].abs();
        // digits the data determine, and a sign
        1.0 + (1.0 + size / error.max(1e-12 * size).max(f64::MIN_POSITIVE)).log2()
    });
    let bits = fitted.formula.bits() + digits.sum::<f64>();
    Found {
        constants: constants.len(),
        bits,
        fitted,
    }
}

/// Bits of the misfit.
#[must_use]
pub fn misfit_bits(chi2: f64) -> f64 {
    0.5 * chi2 / std::f64::consts::LN_2
}

/// Takes numbers out one by one, each time those that are missed least; every physical formula on the way.
fn simplify(from: &Fitted, task: &Task<'_>) -> Vec<Found> {
    let mut beam = vec![measured(from.clone(), &task.data)];
    let mut all = Vec::new();
    while !beam.is_empty() {
        let physical = beam.iter().filter(|f| (task.physical)(&f.fitted.formula));
        all.extend(physical.cloned());
        let mut next: Vec<Found> = beam.iter().flat_map(|found| simpler(found, task)).collect();
        next.sort_by(|a, b| a.length().total_cmp(&b.length()));
        next.dedup_by(|b, a| (a.fitted.chi2 - b.fitted.chi2).abs() <= 1e-8 * a.fitted.chi2);
        next.truncate(BEAM);
        beam = next;
    }
    all
}

/// Everything that has one fitted number less.
fn simpler(found: &Found, task: &Task<'_>) -> Vec<Found> {
    let formula = &found.fitted.formula;
    let roles = formula.shape.roles(task.data.columns.logs.len());
    let errors = standard_errors(&found.fitted, &task.data);
    let constants = formula.constants();
    let mut moves: Vec<(usize, Source)> = Vec::new();
    for (k, &i) in constants.iter().enumerate() {
        let value = formula.numbers[i];
        match roles[i] {
            Role::Coefficient => {
                moves.push((
                    i,
                    Source::Fixed(Ratio::whole(if value < 0.0 { -1 } else { 1 })),
                ));
            }
            Role::Exponent | Role::Order | Role::Power => {
                moves.extend(near(value).into_iter().map(|r| (i, Source::Fixed(r))));
                if roles[i] == Role::Exponent {
                    moves.push((i, Source::Fixed(Ratio::whole(0))));
                }
                for (l, &j) in constants.iter().enumerate() {
                    let other = formula.numbers[j];
                    if i == j || matches!(roles[j], Role::Coefficient) || other == 0.0 {
                        continue;
                    }
                    let ratio = value / other;
                    let relative = (errors[k] / value).hypot(errors[l] / other);
                    let tied = near(ratio).into_iter().filter(|r| {
                        r.under <= 2
                            && (r.value() - ratio).abs() <= (3.0 * relative).min(0.3) * ratio.abs()
                    });
                    moves.extend(tied.map(|r| (i, Source::Tied(j, r))));
                }
            }
        }
    }
    // a number that others are tied to stays
    let needed = |i: usize| {
        let tied = |s: &Source| matches!(s, Source::Tied(to, _) if *to == i);
        formula.sources.iter().any(tied)
    };
    moves
        .into_iter()
        .filter(|(i, source)| !needed(*i) || matches!(source, Source::Fixed(_)))
        .filter_map(|(i, source)| {
            let mut trial = formula.clone();
            trial.sources[i] = source;
            if let Source::Fixed(ratio) = source {
                for other in &mut trial.sources {
                    if let Source::Tied(to, times) = *other
                        && to == i
                    {
                        *other = Source::Fixed(product(ratio, times)?);
                    }
                }
            }
            let fitted = fit(&trial, &task.data, STEPS[1])?;
            sane(&fitted.formula, task.data.columns.logs.len())
                .then(|| measured(fitted, &task.data))
        })
        .collect()
}

/// Product of two fractions; none if it is no small one.
fn product(a: Ratio, b: Ratio) -> Option<Ratio> {
    let (over, under) = (a.over * b.over, a.under * b.under);
    let gcd = gcd(over.unsigned_abs(), under.unsigned_abs()).max(1) as i32;
    let ratio = Ratio {
        over: over / gcd,
        under: under / gcd,
    };
    (ratio.under <= 8).then_some(ratio)
}

fn gcd(a: u32, b: u32) -> u32 {
    match b {
        0 => a,
        b => gcd(b, a % b),
    }
}

/// Simple fractions near a number, but for 0.
fn near(value: f64) -> Vec<Ratio> {
    let mut found: Vec<Ratio> = Vec::new();
    for under in UNDER {
        let over = (value * f64::from(under)).round();
        if over == 0.0 || over.abs() > 12.0 {
            continue;
        }
        let over = over as i32;
        let shared = gcd(over.unsigned_abs(), under.unsigned_abs()) as i32;
        let ratio = Ratio {
            over: over / shared,
            under: under / shared,
        };
        if !found.contains(&ratio) {
            found.push(ratio);
        }
    }
    found
}
