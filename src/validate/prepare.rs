//! Preparing an experiment: its files read and held to each other, and the cases with an uncertain input changed.

use super::measured::{self, Entry, Input, Quantity};
use super::row::{Outcome, Row};
use super::sample::{Sampling, interval};
use super::{Found, Stated};
use crate::case::Case;
use crate::case::pair::{Asked, PairCase, Target};
use crate::document::Document;
use crate::error::must_be_one_of;
use crate::{Error, Result};
use std::path::Path;

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
    /// What they meet; none: a rigid wall.
    pub target: Option<Target>,
    own: usize,
    varied: Vec<Varied>,
}

/// Relative difference below which a case file and a table say the same.
const SAME: f64 = 1e-9;

impl Prepared {
    /// An experiment from its study file and its table.
    ///
    /// # Errors
    /// Those of reading both, [`Error::Value`] naming the line of the table that is about no case, says another input than the case or would
    /// be shown nowhere, and [`Error::Refused`] for a case that is no normal impact at one speed on a frictionless wall.
    pub fn new(
        stated: &'static Stated,
        cases: (&str, &Path),
        measured: (&str, &Path),
    ) -> Result<Self> {
        let (cases, target) = stated.file.cases(&Document::new(cases.1, cases.0))?;
        for case in &cases {
            plain(case)?;
        }
        let entries = measured::parse(measured.0, measured.1)?;
        for entry in &entries {
            check(entry, &cases, measured.1)?;
            shown(entry, stated, &cases, measured.1)?;
        }
        let own = cases.len();
        let mut prepared = Prepared {
            stated,
            entries,
            cases,
            target,
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

    /// A case of these as what it meets has it.
    #[must_use]
    pub fn asked(&self, case: &Case) -> Asked {
        let particle = case.clone();
        match self.target {
            None => Asked::RigidWall(particle),
            Some(target) => Asked::Pair(PairCase { particle, target }),
        }
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
        namesakes(own, &self.cases[of].name)
    }
}

/// Entries about a case: of its name, or of what its name begins with up to a comma or a speed.
pub(super) fn about<'a>(entries: &'a [Entry], case: &str) -> impl Iterator<Item = &'a Entry> {
    let case = case.to_owned();
    entries.iter().filter(move |entry| is_about(entry, &case))
}

fn is_about(entry: &Entry, case: &str) -> bool {
    let rest = case.strip_prefix(&entry.case[..]);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(", ") || rest.starts_with(" at "))
}

fn namesakes(cases: &[Case], name: &str) -> usize {
    cases.iter().filter(|one| one.name == name).count()
}

/// That a case is a normal impact at one speed on a frictionless wall: nothing else is compared.
fn plain(case: &Case) -> Result<()> {
    // whoever adds to a case says here whether it is compared
    let Case {
        name: _,
        path: _,
        hash: _,
        shape: _,
        radius: _,
        material: _,
        velocities,
        angle,
        friction,
        adhesion,
        tolerance: _,
        method,
        bed: _,
    } = case;
    let found = if velocities.len() != 1 {
        format!("{} speeds", velocities.len())
    } else if *angle > 0.0 {
        "an oblique impact".to_owned()
    } else if *friction > 0.0 {
        "friction".to_owned()
    } else if adhesion.is_some() {
        "adhesion".to_owned()
    } else if let Some(method) = method {
        format!("scheme preset {method}")
    } else {
        return Ok(());
    };
    Err(Error::Refused {
        what: format!("{}: case `{}`", case.path.display(), case.name),
        found,
        allowed:
            "must be a normal impact at one speed on a frictionless wall, by the crate's own scheme"
                .to_owned(),
    })
}

/// That a figure of the table is one that is compared, of a case that is not one of several of its name.
fn shown(entry: &Entry, stated: &Stated, cases: &[Case], path: &Path) -> Result<()> {
    let Quantity::Figure(figure) = entry.quantity else {
        return Ok(());
    };
    let refuse = |column: &str, found: &str, allowed: &str| {
        let key = format!("line {}, {column}", entry.line);
        Err(Error::in_table(path, &key, format!("`{found}`"), allowed))
    };
    if !stated.figures.contains(&figure) {
        let names = stated.figures.iter();
        let names = must_be_one_of(names.map(|one| Quantity::Figure(*one).name()));
        return refuse("quantity", entry.quantity.name(), &names);
    }
    let mut about = cases.iter().filter(|case| is_about(entry, &case.name));
    if !about.any(|case| namesakes(cases, &case.name) == 1) {
        let allowed = "must be a case by itself; the case file has several of this name";
        return refuse("case", &entry.case, allowed);
    }
    Ok(())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::EXPERIMENTS;

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
        let said = refusal(
            "ball 1,measured,contact_time_ms",
            "ball 1,measured,max_force_N",
        );
        assert!(said.contains("line 11, quantity"), "{said}");
        let said = refusal("velocity_m_s,4.3,", "velocity_m_s,4.4,");
        assert!(
            said.contains("line 10, value") && said.contains("4.3"),
            "{said}"
        );
    }

    #[test]
    fn cases_that_are_not_compared_are_refused_by_name() {
        let stated = &EXPERIMENTS[0];
        for (from, to, part) in [
            (
                "velocities = \"4.3 m/s\"",
                "velocities = [\"4.3 m/s\", \"4.4 m/s\"]",
                "line 10, value",
            ),
            (
                "[particle]",
                "[impact]\nangle = \"30 deg\"\n[particle]",
                "an oblique impact",
            ),
            (
                "[particle]",
                "[wall]\nfriction = 0.2\n[particle]",
                "friction",
            ),
        ] {
            let text = stated.cases.replacen(from, to, 1);
            assert_ne!(text, stated.cases);
            let measured = (stated.measured, Path::new("balls.csv"));
            let read = Prepared::new(stated, (&text, Path::new("balls.toml")), measured);
            let said = read.unwrap_err().to_string();
            assert!(said.contains(part), "{to}: {said}");
        }
        // several strengths of a name, of one speed: no row would be the measured one
        let metals = EXPERIMENTS.iter().find(|one| one.name == "lead-nickel");
        let stated = metals.unwrap();
        let text = stated
            .cases
            .replace("\"5.9 MPa\"", "[\"5.9 MPa\", \"7 MPa\"]");
        let measured = (stated.measured, Path::new("metals.csv"));
        let read = Prepared::new(stated, (&text, Path::new("metals.toml")), measured);
        let said = read.unwrap_err().to_string();
        assert!(said.contains("several of this name"), "{said}");
    }
}
