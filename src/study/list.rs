//! From the axes of a study file to its cases: every list with every other, and Latin hypercubes over the ranges.

use super::axis::Axis;
use super::file::{Block, HARDENING, Named, Samples, StudyFile, Variable};
use crate::case::{Case, slips};
use crate::document::Document;
use crate::material::flow::{FlowConstants, InText, YIELD_STRENGTH};
use crate::material::{Flow, Material, YIELD_PRESSURE_RATIO};
use crate::scheme::preset::Method;
use crate::shape::Shape;
use crate::{Error, Result};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Most cases of a study: more are a slip of a list, or want to be several files.
const MOST_CASES: usize = 100_000;

/// What cases are made with.
pub struct Lists<'a> {
    pub document: &'a Document,
    /// Keys whose values are meant.
    pub unusual: &'a [String],
    pub seed: u64,
    /// Cases of each hypercube.
    pub samples: &'a [usize],
    /// Published method of all cases.
    pub method: Option<Method>,
}

/// A value of an axis, and where it stands.
struct Chosen<'a> {
    variable: Variable,
    key: &'a str,
    /// Place in the list.
    index: Option<usize>,
    value: f64,
}

impl Chosen<'_> {
    fn place(&self) -> String {
        let end = self.index.map_or_else(String::new, |i| format!("[{i}]"));
        format!("{}{end}", self.key)
    }
}

/// What makes two cases of a file the same.
pub fn identity(case: &Case) -> String {
    let unnamed = Case {
        name: String::new(),
        ..case.clone()
    };
    format!("{unnamed:?}")
}

impl Lists<'_> {
    /// That the lists make a number of cases that can be held.
    ///
    /// # Errors
    /// [`Error::Value`] naming the longest list.
    pub fn check_count(&self, blocks: &[Block]) -> Result<()> {
        let drawn = |_: &Block| {
            let mut samples = self.samples.iter();
            samples.try_fold(0usize, |all, n| all.checked_add(*n))
        };
        let of_block = |block: &Block| {
            let lists = block.axes.iter().map(|named| match &named.axis {
                Axis::List(values) => values.len(),
                Axis::One(_) | Axis::Range(_) => 1,
            });
            let all = lists
                .into_iter()
                .try_fold(1usize, |all, n| all.checked_mul(n))?;
            match ranges(block).next() {
                Some(_) => all.checked_mul(drawn(block)?),
                None => Some(all),
            }
        };
        let all = blocks
            .iter()
            .try_fold(0usize, |all, block| all.checked_add(of_block(block)?));
        if all.is_some_and(|all| all <= MOST_CASES) {
            return Ok(());
        }
        let axes = blocks.iter().flat_map(|block| &block.axes);
        let longest = axes.max_by_key(|named| named.axis.written().len());
        let longest = longest.filter(|named| named.axis.written().len() > 2);
        let key = longest.map_or("samples", |named| &named.key);
        let allowed =
            format!("must be shorter: all lists together make more than {MOST_CASES} cases");
        Err(self.document.reject(key, allowed))
    }

    /// Cases of one block, checked; `number` keeps its hypercubes apart from those of others.
    ///
    /// # Errors
    /// [`Error::Value`] naming the value that no case can have.
    pub fn cases(&self, block: &Block, number: u64) -> Result<Vec<Case>> {
        let cube = self.hypercube(block, number);
        let lengths: Vec<usize> = block
            .axes
            .iter()
            .map(|named| match &named.axis {
                Axis::List(values) => values.len(),
                Axis::One(_) | Axis::Range(_) => 1,
            })
            .collect();
        let mut cases = Vec::new();
        for grid in 0..lengths.iter().product() {
            let mut places = vec![0; lengths.len()];
            let mut rest: usize = grid;
            for (place, length) in places.iter_mut().zip(&lengths).rev() {
                *place = rest % length;
                rest /= length;
            }
            for sample in &cube {
                let mut drawn = sample.iter();
                let chosen: Vec<Chosen> = block
                    .axes
                    .iter()
                    .zip(&places)
                    .map(|(named, &place)| {
                        let (index, value) = match &named.axis {
                            Axis::One(value) => (None, *value),
                            Axis::List(values) => (Some(place), values[place]),
                            Axis::Range(_) => (None, drawn.next().copied().unwrap_or(f64::NAN)),
                        };
                        Chosen {
                            variable: named.variable,
                            key: &named.key,
                            index,
                            value,
                        }
                    })
                    .collect();
                cases.push(self.case(block, &chosen)?);
            }
        }
        Ok(cases)
    }

    /// Values of the ranges of a block, one row a sample: Latin hypercubes one after the other, each value in a stretch of its
    /// own. A block without ranges has one row without values.
    ///
    /// Every hypercube and every axis has a stream of random numbers of its own: a further one changes none before it.
    fn hypercube(&self, block: &Block, number: u64) -> Vec<Vec<f64>> {
        let ranges: Vec<_> = ranges(block).collect();
        if ranges.is_empty() {
            return vec![Vec::new()];
        }
        let mut rows = Vec::new();
        for (cube, &count) in self.samples.iter().enumerate() {
            let mut columns = Vec::new();
            for (axis, ends) in ranges.iter().enumerate() {
                let stream = (u128::from(number) << 64) | ((cube as u128) << 32) | axis as u128;
                let mut random = Pcg64::new(u128::from(self.seed), stream);
                let mut stretches: Vec<usize> = (0..count).collect();
                for i in (1..count).rev() {
                    stretches.swap(i, random.random_range(0..=i));
                }
                let value = |stretch: usize| {
                    ends.at((stretch as f64 + random.random::<f64>()) / count as f64)
                };
                columns.push(stretches.into_iter().map(value).collect::<Vec<f64>>());
            }
            rows.extend((0..count).map(|i| columns.iter().map(|column| column[i]).collect()));
        }
        rows
    }

    /// The case of one value of each axis.
    fn case(&self, block: &Block, chosen: &[Chosen]) -> Result<Case> {
        let document = self.document;
        let get = |variable: Variable| {
            let found = chosen.iter().find(|c| c.variable == variable);
            found.map(|c| c.value)
        };
        let at = match block.key.is_empty() {
            true => String::new(),
            false => format!("{}.", block.key),
        };
        let required = |variable: Variable| {
            let missing = || {
                let key = format!("{at}{}", variable.slot());
                document.reject(&key, "must be given: a value, a list or a range")
            };
            get(variable).ok_or_else(missing)
        };
        let young_modulus = required(Variable::YoungModulus)?;
        let material = Material {
            density: required(Variable::Density)?,
            young_modulus,
            poisson_ratio: required(Variable::PoissonRatio)?,
            flow: self.flow(chosen, &at, young_modulus)?,
        };
        let case = Case {
            name: block.name.clone().unwrap_or_else(|| document.name()),
            path: document.path().to_owned(),
            hash: document.hash(),
            shape: Shape::Sphere,
            radius: required(Variable::Radius)?,
            material,
            velocities: vec![self.velocity(chosen, &at, &material)?],
            angle: get(Variable::Angle).unwrap_or(0.0),
            friction: get(Variable::Friction).unwrap_or(0.0),
            adhesion: None,
            tolerance: required(Variable::Tolerance)?,
            method: self.method,
            bed: None,
        };
        if let Some((key, allowed)) = case.beyond_preset(false) {
            return Err(document.reject(&format!("{at}{key}"), allowed));
        }
        if let Some((key, _, allowed)) = slips::of(&case, &case.velocities, self.unusual)
            .into_iter()
            .next()
        {
            let slot = |c: &&Chosen| {
                let slot = c.variable.slot();
                key == slot || key == format!("material.{slot}")
            };
            let place = chosen
                .iter()
                .find(slot)
                .map_or_else(|| key.clone(), Chosen::place);
            return Err(document.reject(&place, allowed));
        }
        Ok(case)
    }

    /// The flow stress: yield strength, hardening and other constants, some of them given over E.
    fn flow(&self, chosen: &[Chosen], at: &str, young_modulus: f64) -> Result<Option<Flow>> {
        let document = self.document;
        let hardening = || {
            let all = Flow::all_constants();
            all.into_iter().find(|constant| constant.key == HARDENING)
        };
        let mut values = Vec::new();
        for c in chosen {
            let (constant, value) = match c.variable {
                Variable::Flow(constant) => (Some(constant), c.value),
                Variable::YoungOverYield => (Some(YIELD_STRENGTH), young_modulus / c.value),
                Variable::HardeningOverYoung => (hardening(), young_modulus * c.value),
                _ => continue,
            };
            let Some(constant) = constant else { continue };
            if !value.is_finite() || !constant.range.holds(value, young_modulus) {
                let allowed = constant.range.rule(young_modulus);
                return Err(document.reject(&c.place(), allowed));
            }
            values.push((constant, value));
        }
        let constants = FlowConstants::<InText>::new(values);
        constants.check(document, &format!("{at}material"), young_modulus)
    }

    /// The speed, which may be given over others.
    fn velocity(&self, chosen: &[Chosen], at: &str, material: &Material) -> Result<f64> {
        let is_speed = |c: &&Chosen| c.variable.slot() == Variable::Velocity.slot();
        let Some(c) = chosen.iter().find(is_speed) else {
            let key = format!("{at}{}", Variable::Velocity.slot());
            let allowed = "must be given: a value, a list or a range; or `rho_V2_over_Y` or `V_over_Vy` in its place";
            return Err(self.document.reject(&key, allowed));
        };
        let needs_strength = || {
            let allowed = "needs a `yield_strength` or `young_over_yield` in `[material]`";
            self.document.reject(&c.place(), allowed)
        };
        let flow = || material.flow.ok_or_else(needs_strength);
        let velocity = match c.variable {
            Variable::Severity => (c.value * flow()?.yield_strength() / material.density).sqrt(),
            Variable::OverYield => {
                let first = material.yield_point(1.0, YIELD_PRESSURE_RATIO);
                c.value * first.ok_or_else(needs_strength)?.velocity
            }
            _ => c.value,
        };
        match velocity.is_finite() && velocity > 0.0 {
            true => Ok(velocity),
            false => Err(self.document.reject(
                &c.place(),
                "must make a speed that is a number; check the unit",
            )),
        }
    }
}

/// Ranges of a block.
fn ranges(block: &Block) -> impl Iterator<Item = &super::axis::Ends<f64>> {
    block
        .axes
        .iter()
        .filter_map(|named: &Named| match &named.axis {
            Axis::Range(ends) => Some(ends),
            _ => None,
        })
}

/// Samples of each hypercube; none where there are no ranges.
///
/// # Errors
/// [`Error::Value`] for ranges without samples, samples without ranges, or none.
pub fn samples(document: &Document, file: &StudyFile, blocks: &[Block]) -> Result<Vec<usize>> {
    let mut axes = blocks.iter().flat_map(|block| &block.axes);
    let range = axes.find(|named| matches!(named.axis, Axis::Range(_)));
    let refuse = |key: &str, allowed: &str| -> Result<Vec<usize>> {
        Err::<_, Error>(document.reject(key, allowed))
    };
    match (&file.samples, range) {
        (None, None) => Ok(Vec::new()),
        (None, Some(range)) => refuse(
            &range.key,
            "needs `samples` at the top of the file: how many cases the ranges make, e.g. samples = 600",
        ),
        (Some(_), None) => refuse(
            "samples",
            "must not stand in a file without ranges, e.g. poisson_ratio = { from = 0.2, to = 0.4 }",
        ),
        (Some(Samples(Axis::Range(_))), _) => {
            refuse("samples", "must be a whole number, or a list of them")
        }
        (Some(Samples(samples)), Some(_)) => {
            let written = samples.written();
            if written.is_empty() {
                return refuse("samples", "must hold at least one number");
            }
            for (end, count) in &written {
                if *count == 0 {
                    return refuse(&format!("samples{end}"), "must be at least 1");
                }
            }
            Ok(written.into_iter().map(|(_, count)| count).collect())
        }
    }
}
