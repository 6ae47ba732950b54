//! Validate: experiments beside theories, the thesis' equations and our impacts, each with the bounds that are stated of it.
//!
//! An experiment is a study file with a table of what was measured beside it, both in `cases/experiments/` and in the program, and a file
//! here that states itself through [`Experiment`]. The list at the end of this file makes everything else of it: a new experiment is a new
//! file, its `mod` line and one line of that list.

mod aerosol_copper;
mod balls;
mod elastic_spheres;
mod elastic_waves;
mod impact_tester;
mod lead_nickel;
pub mod left_out;
pub mod measured;
mod prepare;
pub mod row;
pub mod sample;
mod taylor_bar;
mod yield_pressure;

use crate::case::Case;
use crate::case::pair::{Asked, Target};
use crate::document::Document;
use crate::study::Study;
use crate::unit::significant;
use crate::{Error, Result};
use measured::{Entry, Figure, Input, Quantity};
pub use prepare::Prepared;
use prepare::about;
use row::{Outcome, Row};

/// What the cases of an experiment are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum File {
    /// A study file.
    Study,
    /// A case file: of a cylinder.
    Case,
    /// A case file with a deformable wall, a case a speed.
    Pair,
}

impl File {
    /// The verb that runs it alone.
    #[must_use]
    pub fn verb(self) -> &'static str {
        match self {
            File::Study => "study",
            File::Case | File::Pair => "impact",
        }
    }

    /// Its cases, and what they meet where it is no rigid wall.
    ///
    /// # Errors
    /// Those of reading it.
    fn cases(self, document: &Document) -> Result<(Vec<Case>, Option<Target>)> {
        match self {
            File::Study => Ok((Study::from_document(document)?.cases, None)),
            File::Case => Ok((vec![Case::from_document(document)?], None)),
            File::Pair => match Asked::from_document(document)? {
                Asked::RigidWall(case) => Err(Error::Refused {
                    what: format!("{}: `wall.material`", case.path.display()),
                    found: "nothing".to_owned(),
                    allowed: "must be there: the experiment is of a deformable wall".to_owned(),
                }),
                Asked::Pair(pair) => Ok((a_case_a_speed(&pair.particle), Some(pair.target))),
            },
        }
    }
}

/// A case of each speed, named after it.
fn a_case_a_speed(case: &Case) -> Vec<Case> {
    let of = |velocity: &f64| Case {
        name: format!("{} at {} m/s", case.name, significant(*velocity, 6)),
        velocities: vec![*velocity],
        ..case.clone()
    };
    case.velocities.iter().map(of).collect()
}

/// An experiment with measured or otherwise known answers.
pub trait Experiment {
    /// Name on the command line and of its files.
    const NAME: &'static str;
    /// What it is.
    const TITLE: &'static str;
    /// Who published it.
    const SOURCE: &'static str;
    /// What its cases are written in.
    const FILE: File;
    /// Text of that file.
    const CASES: &'static str;
    /// Text of its table.
    const MEASURED: &'static str;
    /// What is compared.
    const FIGURES: &'static [Figure];
    /// What has to be known of it, a paragraph each.
    const REMARKS: &'static [&'static str];

    /// Its stated bounds, looked at.
    fn bounds(found: &Found) -> Vec<Bound>;

    /// What else follows from its impacts, marked where it is inferred.
    fn tables(found: &Found) -> Vec<Derived>;
}

/// A stated bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Of what.
    pub of: String,
    /// What was found.
    pub found: String,
    /// What it must be.
    pub must: String,
    /// Whether it is.
    pub met: bool,
}

impl Bound {
    /// That `value` lies within `half` of `middle`; a value that is missing does not.
    #[must_use]
    pub fn within(of: String, value: Option<f64>, middle: f64, half: f64) -> Self {
        let digits = |x: f64| significant(x, 4);
        Bound {
            of,
            found: value.map_or("nothing".to_owned(), digits),
            must: format!("{} ± {}", digits(middle), significant(half, 2)),
            met: value.is_some_and(|value| (value - middle).abs() <= half),
        }
    }

    /// That `value` is at most `most`; a value that is missing is not.
    #[must_use]
    pub fn at_most(of: String, value: Option<f64>, most: f64) -> Self {
        let digits = |x: f64| significant(x, 5);
        Bound {
            of,
            found: value.map_or("nothing".to_owned(), digits),
            must: format!("at most {}", digits(most)),
            met: value.is_some_and(|value| value <= most),
        }
    }

    /// That `value` is at least `least`; a value that is missing is not.
    #[must_use]
    pub fn at_least(of: String, value: Option<f64>, least: f64) -> Self {
        let digits = |x: f64| significant(x, 5);
        Bound {
            of,
            found: value.map_or("nothing".to_owned(), digits),
            must: format!("at least {}", digits(least)),
            met: value.is_some_and(|value| value >= least),
        }
    }
}

impl Bound {
    /// That `value` lies within the uncertainty of what was measured; where there is no such reading it does not.
    #[must_use]
    pub fn inside(of: String, value: Option<f64>, reading: Option<[f64; 2]>) -> Self {
        match reading {
            Some([middle, half]) => Bound::within(of, value, middle, half),
            None => Bound {
                of,
                found: "nothing measured with an uncertainty".to_owned(),
                must: "measured, with an uncertainty".to_owned(),
                met: false,
            },
        }
    }
}

/// A table that follows from the impacts of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Derived {
    /// What it shows.
    pub title: String,
    /// What it is and how it was made.
    pub text: String,
    /// Columns.
    pub head: Vec<&'static str>,
    /// Rows of as many cells.
    pub rows: Vec<Vec<String>>,
}

/// What [`Experiment`] states, as a value.
#[derive(Debug, Clone, Copy)]
pub struct Stated {
    /// [`Experiment::NAME`].
    pub name: &'static str,
    /// [`Experiment::TITLE`].
    pub title: &'static str,
    /// [`Experiment::SOURCE`].
    pub source: &'static str,
    /// [`Experiment::FILE`].
    pub file: File,
    /// [`Experiment::CASES`].
    pub cases: &'static str,
    /// [`Experiment::MEASURED`].
    pub measured: &'static str,
    /// [`Experiment::FIGURES`].
    pub figures: &'static [Figure],
    /// [`Experiment::REMARKS`].
    pub remarks: &'static [&'static str],
    /// [`Experiment::bounds`].
    pub bounds: fn(&Found) -> Vec<Bound>,
    /// [`Experiment::tables`].
    pub tables: fn(&Found) -> Vec<Derived>,
}

impl Stated {
    /// What `E` states.
    #[must_use]
    pub const fn of<E: Experiment>() -> Self {
        Stated {
            name: E::NAME,
            title: E::TITLE,
            source: E::SOURCE,
            file: E::FILE,
            cases: E::CASES,
            measured: E::MEASURED,
            figures: E::FIGURES,
            remarks: E::REMARKS,
            bounds: E::bounds,
            tables: E::tables,
        }
    }

    /// The experiment called `name`.
    ///
    /// # Errors
    /// [`Error::Refused`] naming those there are.
    pub fn called(name: &str) -> Result<&'static Stated> {
        let of = EXPERIMENTS.iter().find(|one| one.name == name);
        let names = EXPERIMENTS.iter().map(|one| one.name);
        of.ok_or_else(|| Error::not_one_of("experiment", name, names))
    }
}

/// What the impacts of an experiment gave.
#[derive(Debug, Clone)]
pub struct Found {
    /// The experiment.
    pub stated: &'static Stated,
    /// What its table says.
    pub entries: Vec<Entry>,
    /// Rows in the order of the cases.
    pub rows: Vec<Row>,
    outcomes: Vec<Outcome>,
    own: usize,
}

impl Found {
    /// Outcomes of its own cases.
    #[must_use]
    pub fn outcomes(&self) -> &[Outcome] {
        &self.outcomes[..self.own]
    }

    /// Its own cases of a name.
    pub fn called(&self, name: &str) -> impl Iterator<Item = &Outcome> {
        self.outcomes()
            .iter()
            .filter(move |one| one.case.name == name)
    }

    /// Rows of a figure.
    pub fn of(&self, figure: Figure) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.figure == figure)
    }

    /// An input of a case as the table has it.
    #[must_use]
    pub fn input(&self, case: &str, input: Input) -> Option<f64> {
        let mut all = about(&self.entries, case);
        all.find(|entry| entry.quantity == Quantity::Input(input))?
            .value
    }

    /// The stated bounds, and that every impact ended well.
    #[must_use]
    pub fn bounds(&self) -> Vec<Bound> {
        let whole = |one: &&Outcome| one.figure(Figure::Restitution).is_some();
        let (ended, all) = (
            self.outcomes.iter().filter(whole).count(),
            self.outcomes.len(),
        );
        let mut bounds = vec![Bound {
            of: "impacts that ended well".to_owned(),
            found: ended.to_string(),
            must: format!("all {all}"),
            met: ended == all,
        }];
        bounds.extend((self.stated.bounds)(self));
        bounds
    }
}

/// Value at `x` of the parabola through three points.
fn parabola(points: &[[f64; 2]; 3], x: f64) -> f64 {
    let term = |i: usize| {
        let rest = (0..3).filter(|j| *j != i);
        let weight = rest.map(|j| (x - points[j][0]) / (points[i][0] - points[j][0]));
        points[i][1] * weight.product::<f64>()
    };
    (0..3).map(term).sum()
}

/// Strength, Pa, at which a figure that falls or grows steadily with it has the value `wanted`: a parabola in the logarithms through the
/// three nearest of `points` (strength, figure), in order of strength; none outside them.
fn strength(points: &[[f64; 2]], wanted: f64) -> Option<f64> {
    let logs: Vec<[f64; 2]> = points.iter().map(|[y, f]| [f.ln(), y.ln()]).collect();
    let x = wanted.ln();
    let between = |pair: &[[f64; 2]]| (pair[0][0] - x) * (pair[1][0] - x) <= 0.0;
    let at = logs.windows(2).position(between)?;
    let first = at.min(logs.len().checked_sub(3)?);
    let three = [logs[first], logs[first + 1], logs[first + 2]];
    Some(parabola(&three, x).exp()).filter(|y| y.is_finite())
}

/// Makes [`EXPERIMENTS`] from the list of experiments.
macro_rules! experiments {
    ($($experiment:ty,)+) => {
        /// The experiments, in the order of the page.
        pub const EXPERIMENTS: &[Stated] = &[$(Stated::of::<$experiment>()),+];
    };
}

experiments! {
    balls::Balls,
    impact_tester::ImpactTester,
    aerosol_copper::AerosolCopper,
    lead_nickel::LeadNickel,
    elastic_spheres::ElasticSpheres,
    elastic_waves::ElasticWaves,
    yield_pressure::YieldPressure,
    taylor_bar::TaylorBar,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sided_bounds_are_met_on_their_side_and_by_no_missing_value() {
        let of = || "e".to_owned();
        for (value, below, above) in [
            (Some(0.9), true, false),
            (Some(0.95), true, true),
            (Some(0.96), false, true),
            (None, false, false),
        ] {
            assert_eq!(Bound::at_most(of(), value, 0.95).met, below);
            assert_eq!(Bound::at_least(of(), value, 0.95).met, above);
        }
    }

    #[test]
    fn a_deformable_wall_has_a_case_a_speed_and_the_strength_of_the_softer_body() {
        let stated = Stated::called("yield-pressure").unwrap();
        let document = Document::new(std::path::Path::new("yield-pressure.toml"), stated.cases);
        let (cases, target) = stated.file.cases(&document).unwrap();
        let names: Vec<&str> = cases.iter().map(|case| &case.name[..]).collect();
        assert_eq!(names[0], "yield-pressure at 0.1255 m/s");
        assert!(cases.iter().all(|case| case.velocities.len() == 1));
        let flow = target.unwrap().material.flow.unwrap();
        assert!((flow.yield_strength() - 1e9).abs() < 1.0 && cases[0].material.flow.is_none());
        // one of a rigid wall is refused by the key that it lacks
        let rigid = EXPERIMENTS
            .iter()
            .find(|one| one.file == File::Case)
            .unwrap();
        let document = Document::new(std::path::Path::new("rigid.toml"), rigid.cases);
        let said = File::Pair.cases(&document).unwrap_err().to_string();
        assert!(said.contains("wall.material"), "{said}");
    }

    #[test]
    fn the_strength_of_a_power_law_is_found() {
        let points = [100.0, 200.0, 400.0, 800.0].map(|y: f64| [y, 3.0 * y.powf(-0.6)]);
        for wanted in [150.0, 350.0, 799.0f64] {
            let found = strength(&points, 3.0 * wanted.powf(-0.6)).unwrap();
            assert!((found / wanted - 1.0).abs() < 1e-9, "{found} {wanted}");
        }
        assert_eq!(strength(&points, 1.0), None);
    }
}
