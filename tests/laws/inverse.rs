//! From impacts back to the material: strength and hardening are found, and intervals hold the truth as often as they say.

use impactlaw::atlas::Atlas;
use impactlaw::contact::rebound::rebound;
use impactlaw::inverse::confidence::{Interval, Sampling, intervals};
use impactlaw::inverse::measurement::{Figure, Measurement};
use impactlaw::inverse::model::{Correction, Known, Model, Point};
use impactlaw::inverse::search::{Problem, Unknowns};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};
use std::path::Path;

const SAMPLING: Sampling = Sampling {
    draws: 200,
    seed: 1,
    young_modulus: 0.0,
    radius: 0.0,
    atlas: false,
};

fn known(young_modulus: f64) -> Known {
    Known {
        density: 8960.0,
        young_modulus,
        poisson_ratio: 0.343,
        hardening: 0.0,
    }
}

/// Rows of one figure at speeds, their values still to come.
fn rows(
    figure: Figure,
    speeds: &[f64],
    sigma: Option<f64>,
    velocity_sigma: f64,
) -> Vec<Measurement> {
    let row = |(line, velocity): (usize, &f64)| Measurement {
        line: line as u64 + 2,
        velocity: *velocity,
        velocity_sigma,
        figure,
        value: 0.0,
        sigma,
        radius_slope: 0.0,
        radius_sigma: 0.0,
    };
    speeds.iter().enumerate().map(row).collect()
}

/// Figures of a material at the speeds of the rows, each off by a factor.
fn truth(
    atlas: &Atlas,
    known: Known,
    strength: f64,
    hardening: f64,
    rows: &[Measurement],
    off: &[f64],
) -> Vec<f64> {
    let model = Model {
        atlas,
        known,
        correction: Correction::default(),
    };
    let point = Point {
        strength: strength.ln(),
        hardening: Some((hardening / strength).ln_1p()),
    };
    let speeds: Vec<f64> = rows
        .iter()
        .zip(off)
        .map(|(row, off)| row.velocity * off)
        .collect();
    model.figures(&point, rows, &speeds).unwrap()
}

fn filled(mut rows: Vec<Measurement>, values: &[f64]) -> Vec<Measurement> {
    for (row, value) in rows.iter_mut().zip(values) {
        row.value = *value;
    }
    rows
}

const EXACT: [f64; 5] = [1.0; 5];

#[test]
fn strength_and_hardening_come_back_from_figures_without_noise() {
    let atlas = Atlas::built_in().unwrap();
    let known = known(128e9);
    for strength in [5e7f64, 1.62e8, 4.5e8, 2e9, 6e9] {
        for figure in [
            Figure::Restitution,
            Figure::CompressionRatio,
            Figure::FlatDiameter,
        ] {
            // rho V^2/Y from 0.003 to 0.5
            let speeds =
                [0.003f64, 0.01, 0.03, 0.1, 0.5].map(|q| (q * strength / known.density).sqrt());
            let bare = rows(figure, &speeds, Some(0.01), 0.0);
            for hardening in [0.0, 0.3 * strength] {
                if hardening / known.young_modulus > 0.018 {
                    continue;
                }
                let told = Known { hardening, ..known };
                let values = truth(&atlas, told, strength, hardening, &bare, &EXACT);
                let rows = filled(bare.clone(), &values);
                let problem = Problem::new(&atlas, told, rows.clone(), Unknowns::Yield).unwrap();
                let [found, _] = problem.estimate().unwrap().point.constants(&told);
                assert!(
                    (found / strength - 1.0).abs() < 1e-5,
                    "{strength} {figure:?}: {found}"
                );
                if figure != Figure::FlatDiameter {
                    let problem =
                        Problem::new(&atlas, known, rows, Unknowns::YieldAndHardening).unwrap();
                    let [found, modulus] = problem.estimate().unwrap().point.constants(&known);
                    assert!(
                        (found / strength - 1.0).abs() < 2e-3,
                        "{strength} {figure:?} {hardening}: {found}"
                    );
                    assert!(
                        (modulus - hardening).abs() < 6e-3 * strength,
                        "{strength} {figure:?}: {modulus} for {hardening}"
                    );
                }
            }
        }
    }
}

/// Of `trials` noisy tables, in how many the interval holds the strength, and the hardening; and the mean width in ln Y.
struct Coverage {
    strength: usize,
    hardening: usize,
    width: f64,
}

/// A laboratory that measures: noise of the figure, of the speed and of the modulus it believes in.
struct Laboratory {
    figure: Figure,
    strength: f64,
    hardening: f64,
    speeds: Vec<f64>,
    noise: f64,
    velocity: f64,
    young: f64,
    /// Whether it tells its noise.
    told: bool,
    unknowns: Unknowns,
}

impl Laboratory {
    fn table(&self, atlas: &Atlas, trial: u64) -> Vec<Measurement> {
        let mut random = Pcg64::seed_from_u64(977 + trial);
        let normal = Normal::standard();
        let mut next = || normal.inverse_cdf(random.random_range(1e-12..1.0));
        let bare = rows(
            self.figure,
            &self.speeds,
            self.told.then_some(self.noise),
            self.velocity,
        );
        let actual = known(128e9 * (1.0 + self.young * next()));
        let off: Vec<f64> = bare.iter().map(|_| 1.0 + self.velocity * next()).collect();
        let mut values = truth(atlas, actual, self.strength, self.hardening, &bare, &off);
        values
            .iter_mut()
            .for_each(|value| *value += self.noise * next());
        filled(bare, &values)
    }

    fn interval(&self, atlas: &Atlas, trial: u64, sampling: &Sampling) -> Interval {
        let believed = known(128e9);
        let problem =
            Problem::new(atlas, believed, self.table(atlas, trial), self.unknowns).unwrap();
        let estimate = problem.estimate().unwrap();
        intervals(&problem, &estimate, sampling).unwrap()
    }

    fn coverage(&self, trials: u64) -> Coverage {
        let atlas = Atlas::built_in().unwrap();
        let sampling = Sampling {
            young_modulus: self.young,
            ..SAMPLING
        };
        let one = |trial: u64| self.interval(&atlas, trial, &sampling);
        let all: Vec<Interval> = (0..trials).into_par_iter().map(one).collect();
        let holds = |[low, high]: [f64; 2], x: f64| low <= x && x <= high;
        let coverage = Coverage {
            strength: all
                .iter()
                .filter(|i| holds(i.strength, self.strength))
                .count(),
            hardening: all
                .iter()
                .filter(|i| holds(i.hardening, self.hardening))
                .count(),
            width: all
                .iter()
                .map(|i| (i.strength[1] / i.strength[0]).ln())
                .sum::<f64>()
                / trials as f64,
        };
        println!(
            "{} {} of {trials}, width {}",
            coverage.strength, coverage.hardening, coverage.width
        );
        coverage
    }
}

fn copper() -> Laboratory {
    Laboratory {
        figure: Figure::Restitution,
        strength: 1.62e8,
        hardening: 0.0,
        speeds: vec![2.0, 3.0, 4.0, 6.0, 10.0, 15.0],
        noise: 0.01,
        velocity: 0.02,
        young: 0.03,
        told: true,
        unknowns: Unknowns::Yield,
    }
}

/// 95 of 100: of 200 tables 190, and with the chance of one in a hundred to either side 181 to 197. Intervals three times too wide would
/// hold all 200, half as wide 135.
fn is_95_per_cent(count: usize) {
    assert!((181..=197).contains(&count), "{count} of 200");
}

#[test]
fn intervals_hold_the_strength_in_95_of_100_tables_of_restitution() {
    let told = copper().coverage(200);
    is_95_per_cent(told.strength);
    // speed and modulus count: without them intervals are narrower
    let exact = Laboratory {
        velocity: 0.0,
        young: 0.0,
        ..copper()
    };
    let exact = exact.coverage(20);
    assert!(
        exact.width < 0.9 * told.width,
        "{} {}",
        exact.width,
        told.width
    );
}

#[test]
fn intervals_of_the_scatter_of_five_rows_hold_it_as_often() {
    let untold = Laboratory {
        speeds: vec![2.0, 3.0, 4.0, 6.0, 10.0],
        told: false,
        young: 0.0,
        ..copper()
    };
    is_95_per_cent(untold.coverage(200).strength);
}

#[test]
fn intervals_of_compression_ratios_hold_it_as_often() {
    let heights = Laboratory {
        figure: Figure::CompressionRatio,
        speeds: vec![10.0, 20.0, 30.0, 40.0],
        noise: 0.003,
        ..copper()
    };
    is_95_per_cent(heights.coverage(200).strength);
}

#[test]
fn strength_and_hardening_together_have_intervals_that_hold_both() {
    let both = Laboratory {
        hardening: 4e8,
        speeds: vec![2.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0, 80.0, 80.0],
        noise: 0.004,
        velocity: 0.0,
        young: 0.0,
        unknowns: Unknowns::YieldAndHardening,
        ..copper()
    };
    let coverage = both.coverage(200);
    is_95_per_cent(coverage.strength);
    is_95_per_cent(coverage.hardening);
}

#[test]
fn intervals_are_the_same_bits_on_any_number_of_threads() {
    let atlas = Atlas::built_in().unwrap();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| copper().interval(&atlas, 3, &SAMPLING))
    };
    assert_eq!(with(1), with(3));
    let other = Sampling {
        seed: 2,
        ..SAMPLING
    };
    assert_ne!(with(1), copper().interval(&atlas, 3, &other));
}

#[test]
fn rows_that_cannot_tell_what_is_sought_are_refused_with_the_reason() {
    let atlas = Atlas::built_in().unwrap();
    let copper = known(128e9);
    let refusal = |rows: Vec<Measurement>, unknowns: Unknowns| {
        let problem = Problem::new(&atlas, copper, rows, unknowns);
        let found = problem.and_then(|problem| {
            let estimate = problem.estimate()?;
            intervals(&problem, &estimate, &SAMPLING)
        });
        found.unwrap_err().to_string()
    };
    let at = |speeds: &[f64], values: &[f64], sigma: Option<f64>| {
        filled(rows(Figure::Restitution, speeds, sigma, 0.0), values)
    };
    for (rows, unknowns, part) in [
        (
            at(&[2.0, 2.0], &[0.3, 0.31], Some(0.01)),
            Unknowns::YieldAndHardening,
            "two speeds at least",
        ),
        (
            at(&[2.0], &[0.3], None),
            Unknowns::Yield,
            "more rows than unknowns",
        ),
        (
            at(&[0.02, 40.0], &[0.9, 0.1], Some(0.01)),
            Unknowns::Yield,
            "no strength has all of them",
        ),
        (
            at(&[2.0, 3.0], &[0.999, 0.998], Some(0.01)),
            Unknowns::Yield,
            "or more",
        ),
        (
            at(&[2.0, 3.0], &[0.01, 0.01], Some(0.01)),
            Unknowns::Yield,
            "or less",
        ),
        (
            at(&[2.0, 2.2], &[0.30, 0.29], Some(0.05)),
            Unknowns::YieldAndHardening,
            "do not determine it",
        ),
    ] {
        let said = refusal(rows, unknowns);
        assert!(said.contains(part), "no {part:?} in {said}");
    }
    // first yield at 15 m/s, so that 10.5 m/s says nothing
    let strength = 8e9;
    let speeds = [10.5, 100.0, 200.0];
    let bare = rows(Figure::Restitution, &speeds, Some(0.01), 0.0);
    let mut values = truth(&atlas, copper, strength, 0.0, &bare, &[1.0; 3]);
    assert!(
        (values[0] - 1.0).abs() < 1e-9 && values[1] < 0.99,
        "{values:?}"
    );
    values[0] = 0.999;
    let said = refusal(at(&speeds, &values, Some(0.01)), Unknowns::Yield);
    assert!(
        said.starts_with("line 2: found 10.5 m/s") && said.contains("first yield"),
        "{said}"
    );
    let mut mixed = at(&[2.0, 3.0, 4.0], &[0.3, 0.28, 0.26], None);
    mixed[2].figure = Figure::CompressionRatio;
    assert!(refusal(mixed.clone(), Unknowns::Yield).contains("weighs against"));
    mixed[0].sigma = Some(0.01);
    assert!(refusal(mixed, Unknowns::Yield).contains("line 3"));
}

/// Thirty real impacts of materials the atlas has not seen, one each: the interval with the error of the atlas holds the strength.
#[test]
fn the_error_of_the_atlas_in_the_interval_is_that_of_real_impacts() {
    let atlas = Atlas::built_in().unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/unseen-30.csv");
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap();
    let all: Vec<std::collections::HashMap<String, f64>> =
        reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(all.len(), 30);
    for (figure, column, median) in [
        (Figure::Restitution, "restitution", 0.04),
        (Figure::CompressionRatio, "compression_ratio", 0.06),
    ] {
        let (mut held, mut bare, mut refused, mut errors) = (0, 0, 0, Vec::new());
        for run in &all {
            let known = Known {
                density: run["density_kg_m3"],
                young_modulus: run["young_modulus_Pa"],
                poisson_ratio: run["poisson_ratio"],
                hardening: 0.0,
            };
            let value = run[column];
            let rows = filled(
                rows(figure, &[run["velocity_m_s"]], Some(1e-3 * value), 0.0),
                &[value],
            );
            let problem = Problem::new(&atlas, known, rows, Unknowns::Yield).unwrap();
            let strength = run["yield_strength_Pa"];
            // one that is as near to the end of the atlas as its error
            let Ok(estimate) = problem.estimate() else {
                refused += 1;
                continue;
            };
            let interval =
                |atlas: bool| intervals(&problem, &estimate, &Sampling { atlas, ..SAMPLING });
            let holds =
                |found: Interval| found.strength[0] <= strength && strength <= found.strength[1];
            bare += usize::from(holds(interval(false).unwrap()));
            // so near to the end of the atlas that its error leads beyond it
            match interval(true) {
                Ok(found) => held += usize::from(holds(found)),
                Err(_) => refused += 1,
            }
            errors.push((estimate.point.strength.exp() / strength - 1.0).abs());
        }
        errors.sort_by(f64::total_cmp);
        println!(
            "{figure:?}: {held} of 30 held, {refused} refused, {bare} without; errors {errors:.4?}"
        );
        // 28.5 expected; the interval of the measurements alone is far too narrow for real impacts
        assert!(
            refused <= 3 && held + refused >= 26,
            "{figure:?}: {held}, {refused}"
        );
        assert!(bare < 10, "{figure:?}: {bare}");
        assert!(errors[errors.len() / 2] < median, "{figure:?}: {errors:?}");
    }
}

/// Figures by energy are those of the integrated impact.
#[test]
fn figures_are_those_of_the_integrated_impact() {
    let atlas = Atlas::built_in().unwrap();
    let copper = known(128e9);
    let speeds = [0.05, 0.3, 1.0, 5.0, 25.0, 100.0];
    for (strength, hardening) in [(1.62e8, 0.0), (4e8, 1e9), (3e9, 0.0)] {
        let rows = rows(Figure::Restitution, &speeds, None, 0.0);
        let told = truth(
            &atlas,
            Known {
                hardening,
                ..copper
            },
            strength,
            hardening,
            &rows,
            &[1.0; 6],
        );
        let point = Point {
            strength: f64::ln(strength),
            hardening: Some((hardening / strength).ln_1p()),
        };
        let material = copper.material(&point);
        let law = atlas.unlimited(&material).unwrap();
        for (velocity, e) in speeds.iter().zip(told) {
            let hit = rebound(&law, 1.0, material.sphere_mass(1.0), *velocity);
            assert!(
                (hit.restitution - e).abs() < 1e-4 * e,
                "{velocity}: {e} {}",
                hit.restitution
            );
        }
    }
}
