//! Validate: experiments beside theories, the thesis' equations and our impacts, each with the bounds that are stated of it.
//!
//! An experiment is a study file with a table of what was measured beside it, both in `cases/experiments/` and in the program, and a file
//! here that states itself through [`Experiment`]. The list at the end of this file makes everything else of it: a new experiment is a new
//! file, its `mod` line and one line of that list.

mod aerosol_copper;
mod balls;
mod elastic_spheres;
mod impact_tester;
mod lead_nickel;
pub mod measured;
pub mod row;
pub mod sample;
mod taylor_bar;

use crate::case::Case;
use crate::document::Document;
use crate::study::Study;
use crate::unit::significant;
use crate::{Error, Result};
use measured::{Entry, Figure, Input, Quantity};
use row::{Outcome, Row};
use sample::{Sampling, interval};
use std::path::Path;

/// What the cases of an experiment are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum File {
    /// A study file.
    Study,
    /// A case file: of a cylinder.
    Case,
}

impl File {
    /// The verb that runs it alone.
    #[must_use]
    pub fn verb(self) -> &'static str {
        match self {
            File::Study => "study",
            File::Case => "impact",
        }
    }

    /// Its cases.
    ///
    /// # Errors
    /// Those of reading it.
    fn cases(self, document: &Document) -> Result<Vec<Case>> {
        match self {
            File::Study => Ok(Study::from_document(document)?.cases),
            File::Case => Ok(vec![Case::from_document(document)?]),
        }
    }
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

/// An input that is uncertain, and the cases one standard deviation below and above, by their place in [`Prepared::cases`].
#[derive(Debug, Clone, PartialEq)]
struct Varied {
    of: usize,
    ends: [usize; 2],
}

/// An experiment whose files were read and fit each other.
#[derive(Debug, Clone)]
pub struct Prepared {
    /// What it is.
    pub stated: &'static Stated,
    /// What its table says.
    pub entries: Vec<Entry>,
    /// Its own cases, then those with an input changed.
    pub cases: Vec<Case>,
    own: usize,
    varied: Vec<Varied>,
}

/// Relative difference below which a case file and a table say the same.
const SAME: f64 = 1e-9;

impl Prepared {
    /// An experiment from its study file and its table.
    ///
    /// # Errors
    /// Those of reading both, and [`Error::Value`] naming the line of the table that is about no case, or says another input than the case.
    pub fn new(
        stated: &'static Stated,
        cases: (&str, &Path),
        measured: (&str, &Path),
    ) -> Result<Self> {
        let cases = stated.file.cases(&Document::new(cases.1, cases.0))?;
        let entries = measured::parse(measured.0, measured.1)?;
        for entry in &entries {
            check(entry, &cases, measured.1)?;
        }
        let own = cases.len();
        let mut prepared = Prepared {
            stated,
            entries,
            cases,
            own,
            varied: Vec::new(),
        };
        for of in 0..own {
            if prepared.namesakes(of) > 1 {
                continue;
            }
            let case = prepared.cases[of].clone();
            let about = about(&prepared.entries, &case.name);
            let changes: Vec<(Input, f64)> = about
                .filter_map(|entry| match entry.quantity {
                    // no part of a case: the speed that follows from it is
                    Quantity::Input(Input::GaugePressure) | Quantity::Figure(_) => None,
                    Quantity::Input(input) => Some((input, entry.uncertainty?)),
                })
                .collect();
            for (input, by) in changes {
                let ends = [-by, by].map(|by| {
                    prepared.cases.push(changed(&case, input, by));
                    prepared.cases.len() - 1
                });
                prepared.varied.push(Varied { of, ends });
            }
        }
        Ok(prepared)
    }

    /// What was found, from the outcomes of [`Prepared::cases`]; `place` keeps the draws of experiments apart.
    #[must_use]
    pub fn found(self, outcomes: Vec<Outcome>, sampling: &Sampling, place: u64) -> Found {
        let mut rows = Vec::new();
        for of in 0..self.own {
            let outcome = &outcomes[of];
            let about: Vec<&Entry> = about(&self.entries, &outcome.case.name).collect();
            if about.is_empty() || self.namesakes(of) > 1 {
                continue;
            }
            for &figure in self.stated.figures {
                let ends = self.varied.iter().filter(|varied| varied.of == of);
                let ends = ends.map(|varied| {
                    let end = |k: usize| outcomes[varied.ends[k]].figure(figure);
                    Some([end(0)?, end(1)?])
                });
                let ends: Option<Vec<[f64; 2]>> = ends.collect();
                let drawn = outcome.figure(figure).zip(ends).and_then(|(value, ends)| {
                    interval(value, &ends, sampling, place << 32 | of as u64)
                });
                rows.push(Row::of(self.stated.name, outcome, figure, &about, drawn));
            }
        }
        Found {
            stated: self.stated,
            entries: self.entries,
            own: self.own,
            outcomes,
            rows,
        }
    }

    /// Cases of the name of this one: those of a list of strengths are not what was measured.
    fn namesakes(&self, of: usize) -> usize {
        let own = &self.cases[..self.own];
        own.iter()
            .filter(|one| one.name == self.cases[of].name)
            .count()
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

/// Entries about a case: of its name, or of what its name begins with up to a comma.
fn about<'a>(entries: &'a [Entry], case: &str) -> impl Iterator<Item = &'a Entry> {
    let case = case.to_owned();
    entries.iter().filter(move |entry| is_about(entry, &case))
}

fn is_about(entry: &Entry, case: &str) -> bool {
    let rest = case.strip_prefix(&entry.case[..]);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(", "))
}

/// That an entry is about a case of the case file, and an input the same there.
fn check(entry: &Entry, cases: &[Case], path: &Path) -> Result<()> {
    let refuse = |column: &str, found: String, allowed: &str| {
        let key = format!("line {}, {column}", entry.line);
        Err(Error::in_table(path, &key, found, allowed))
    };
    let mut cases = cases
        .iter()
        .filter(|case| is_about(entry, &case.name))
        .peekable();
    if cases.peek().is_none() {
        let found = format!("`{}`", entry.case);
        let allowed =
            "must be the name of a case of the case file, or what it begins with before a comma";
        return refuse("case", found, allowed);
    }
    let (Quantity::Input(input), Some(value)) = (entry.quantity, entry.value) else {
        return Ok(());
    };
    for case in cases {
        let there = match input {
            Input::Velocity => case.velocities[0],
            Input::YoungModulus => case.material.young_modulus,
            Input::Density => case.material.density,
            Input::Diameter => 2.0 * case.radius,
            Input::GaugePressure => continue,
        };
        if (there / value - 1.0).abs() > SAME {
            let allowed = format!(
                "must be {there}, as case `{}` of the case file has it",
                case.name
            );
            return refuse("value", value.to_string(), &allowed);
        }
    }
    Ok(())
}

/// A case with an input changed by an amount.
fn changed(case: &Case, input: Input, by: f64) -> Case {
    let mut case = case.clone();
    match input {
        Input::Velocity => case.velocities[0] += by,
        Input::YoungModulus => case.material.young_modulus += by,
        Input::Density => case.material.density += by,
        Input::Diameter => case.radius += 0.5 * by,
        Input::GaugePressure => {}
    }
    case
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
    taylor_bar::TaylorBar,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prepared(stated: &'static Stated) -> Prepared {
        let of = |text: &'static str| (text, Path::new(stated.name));
        Prepared::new(stated, of(stated.cases), of(stated.measured)).unwrap()
    }

    #[test]
    fn every_experiment_reads_and_has_a_case_below_and_above_each_uncertain_input() {
        for stated in EXPERIMENTS {
            let read = prepared(stated);
            assert_eq!(read.cases.len(), read.own + 2 * read.varied.len());
            for Varied { of, ends } in &read.varied {
                let [low, high] = ends.map(|end| &read.cases[end]);
                assert_ne!(low, high);
                assert_eq!(low.name, read.cases[*of].name);
            }
        }
        assert_eq!(prepared(&EXPERIMENTS[0]).varied.len(), 6);
    }

    #[test]
    fn what_fits_no_case_is_refused_by_line() {
        let stated = &EXPERIMENTS[0];
        let refusal = |from: &str, to: &str| {
            let text = stated.measured.replacen(from, to, 1);
            assert_ne!(text, stated.measured);
            let cases = (stated.cases, Path::new("balls.toml"));
            let read = Prepared::new(stated, cases, (&text, Path::new("balls.csv")));
            read.unwrap_err().to_string()
        };
        let said = refusal("ball 1,measured", "ball 7,measured");
        assert!(said.contains("line 11, case"), "{said}");
        let said = refusal("velocity_m_s,4.3,", "velocity_m_s,4.4,");
        assert!(
            said.contains("line 10, value") && said.contains("4.3"),
            "{said}"
        );
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
