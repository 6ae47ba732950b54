//! Chapter: the third chapter of the thesis again, its fifteen cases beside its tables, measured as it measures.

use super::Pulse;
use super::ladder::{Effort, Ladder, REFERENCE, Rung};
use super::thesis::{FINEST, INTERVAL, MULTIPLIERS, SETTINGS, Setting, ladder};
use crate::case::Case;
use crate::curve::Impact;
use crate::curve::files::{Row, rows};
use crate::impact::lattice_points;
use crate::plan::{Geometry, plan};
use serde::Serialize;

/// A run of the chapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// What to run.
    pub rung: Rung,
    /// Its setting; none of the finest run of the crate's own scheme.
    pub case: Option<Place>,
}

/// Which of the fifteen cases a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Setting.
    pub setting: &'static Setting,
    /// Section or three dimensions.
    pub geometry: Geometry,
    /// Place of the time step in [`MULTIPLIERS`].
    pub nth: usize,
}

/// Settings that are run in three dimensions at the middle time step too, to show how far section and three dimensions agree there.
const PROOFS: [&str; 2] = ["MP/4ES", "MP/2ES"];
/// Their time step.
const PROOF_STEP: usize = 1;

/// Runs of the chapter: the finest one of the crate's own scheme; all cases in the section; in three dimensions those at the longest time
/// step, and two at the middle one.
#[must_use]
pub fn wanted(case: &Case, velocity: f64) -> Vec<Wanted> {
    let ladders = Ladder {
        case,
        base: plan(case, velocity),
        effort: Effort::Full,
    };
    let mut all = vec![Wanted {
        rung: ladders.reference(),
        case: None,
    }];
    for rung in ladders.thesis() {
        for geometry in [Geometry::Axisymmetric, Geometry::Quarter] {
            for nth in 0..MULTIPLIERS.len() {
                let setting = SETTINGS.iter().find(|s| {
                    rung.ladder == ladder(geometry, nth)
                        && rung.name.split(',').next() == Some(s.name)
                });
                let Some(setting) = setting else { continue };
                let solid = geometry != Geometry::Axisymmetric;
                let proof = nth == PROOF_STEP && PROOFS.contains(&setting.name);
                if !solid || nth == 0 || proof {
                    all.push(Wanted {
                        rung: rung.clone(),
                        case: Some(Place {
                            setting,
                            geometry,
                            nth,
                        }),
                    });
                }
            }
        }
    }
    all
}

/// A finished run of the chapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    /// Which it is; none of the finest run of the crate's own scheme.
    pub place: Option<Place>,
    /// Length of its steps, s; NaN where it is not fixed.
    pub time_step: f64,
    /// Curve and figures.
    pub impact: Impact,
    /// Processor time, s.
    pub cpu_s: f64,
}

impl Done {
    /// Its name in tables and figures.
    #[must_use]
    pub fn name(&self) -> String {
        self.place.map_or_else(
            || REFERENCE.to_owned(),
            |place| {
                let nanoseconds = crate::unit::significant(self.time_step * 1e9, 3);
                format!(
                    "{}, {nanoseconds} ns, {}",
                    place.setting.name,
                    dimensions(place.geometry)
                )
            },
        )
    }

    /// What its output files say, with the wall an exact number of intervals away.
    #[must_use]
    pub fn files(&self) -> Vec<Row> {
        self.files_at(0.0)
    }

    fn files_at(&self, phase: f64) -> Vec<Row> {
        rows(&self.impact.curve, &self.impact.summary, INTERVAL, phase)
    }
}

/// Section or 3-D.
#[must_use]
pub fn dimensions(geometry: Geometry) -> &'static str {
    match geometry {
        Geometry::Axisymmetric => "section",
        _ => "3-D",
    }
}

/// Mean absolute and mean squared errors of F/F* and delta/delta* (equations 3-28, 3-29).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// MAE F, MAE delta, MSE F, MSE delta, as table 3-3 has them.
    pub all: [f64; 4],
}

impl Errors {
    /// Of the files `a` against `b`, file by file, in units of F* and delta* of `unit`; over the files that both have.
    #[must_use]
    pub fn between(a: &[Row], b: &[Row], unit: &Pulse) -> Self {
        let count = a.len().min(b.len()) as f64;
        let mut all = [0.0; 4];
        for (a, b) in a.iter().zip(b) {
            let force = (a[1] - b[1]) / unit.force;
            let displacement = (a[2] - b[2]) / unit.displacement;
            let terms = [
                force.abs(),
                displacement.abs(),
                force * force,
                displacement * displacement,
            ];
            for (sum, term) in all.iter_mut().zip(terms) {
                *sum += term / count;
            }
        }
        Errors { all }
    }
}

/// The runs of the chapter together.
#[derive(Debug, Clone, Copy)]
pub struct Chapter<'a> {
    /// All of them.
    pub runs: &'a [Done],
    /// Johnson's impact, by whose F*, delta* and time the thesis makes its curves dimensionless.
    pub johnson: &'a Pulse,
}

/// Phases of the files that are tried: when the first comes after contact depends on where exactly the thesis puts wall and lattice.
const PHASES: usize = 8;

impl<'a> Chapter<'a> {
    /// The run of a case, if it ended well.
    #[must_use]
    pub fn of(&self, setting: &str, geometry: Geometry, nth: usize) -> Option<&'a Done> {
        self.runs.iter().find(|run| {
            run.place.is_some_and(|place| {
                place.setting.name == setting && place.geometry == geometry && place.nth == nth
            })
        })
    }

    /// The finest run of the crate's own scheme.
    #[must_use]
    pub fn reference(&self) -> Option<&'a Done> {
        self.runs.iter().find(|run| run.place.is_none())
    }

    /// Errors of a run against the finest setting at the same step and in the same dimensions, as table 3-3 has them.
    #[must_use]
    pub fn against_finest(&self, run: &Done) -> Option<Errors> {
        let finest = self.finest_beside(run)?;
        Some(Errors::between(&run.files(), &finest.files(), self.johnson))
    }

    fn finest_beside(&self, run: &Done) -> Option<&'a Done> {
        let place = run.place.filter(|place| place.setting.name != FINEST)?;
        self.of(FINEST, place.geometry, place.nth)
    }

    /// Least and largest of these errors over the moments at which the first files of both runs may come.
    #[must_use]
    pub fn range_against_finest(&self, run: &Done) -> Option<[[f64; 2]; 4]> {
        let finest = self.finest_beside(run)?;
        let phase = |k: usize| k as f64 / PHASES as f64;
        let mut range = [[f64::INFINITY, 0.0]; 4];
        for i in 0..PHASES {
            let ours = run.files_at(phase(i));
            for j in 0..PHASES {
                let errors = Errors::between(&ours, &finest.files_at(phase(j)), self.johnson);
                for (ends, x) in range.iter_mut().zip(errors.all) {
                    *ends = [ends[0].min(x), ends[1].max(x)];
                }
            }
        }
        Some(range)
    }

    /// Errors of a run against the finest setting with each in units of its own largest force and displacement, at those moments of
    /// the files of both at which the forces are nearest: the most that may be read into table 3-3.
    #[must_use]
    pub fn nearest_to_finest(&self, run: &Done) -> Option<Errors> {
        let finest = self.finest_beside(run)?;
        let phase = |k: usize| k as f64 / PHASES as f64;
        let unit = |files: &[Row]| {
            let largest = |k: usize| files.iter().map(|row| row[k]).fold(0.0, f64::max);
            [largest(1), largest(2)]
        };
        let own = |run: &Done, k: usize| -> Vec<Row> {
            let files = run.files_at(phase(k));
            let [force, displacement] = unit(&files);
            let scale = |row: &Row| {
                [
                    row[0],
                    row[1] / force * self.johnson.force,
                    row[2] / displacement * self.johnson.displacement,
                ]
            };
            files.iter().map(scale).collect()
        };
        let theirs: Vec<Vec<Row>> = (0..PHASES).map(|k| own(finest, k)).collect();
        let mut best: Option<Errors> = None;
        for i in 0..PHASES {
            let ours = own(run, i);
            for theirs in &theirs {
                let errors = Errors::between(&ours, theirs, self.johnson);
                if best.is_none_or(|best| errors.all[0] < best.all[0]) {
                    best = Some(errors);
                }
            }
        }
        best
    }

    /// Errors of a run against Johnson at the times of its files.
    #[must_use]
    pub fn against_johnson(&self, run: &Done) -> Errors {
        let files = run.files();
        let there: Vec<Row> = files
            .iter()
            .map(|row| {
                let (force, displacement) = self.johnson.at(row[0]);
                [row[0], force, displacement]
            })
            .collect();
        Errors::between(&files, &there, self.johnson)
    }

    /// Errors of a run against the finest run of the crate's own scheme, its files read in the same way.
    #[must_use]
    pub fn against_reference(&self, run: &Done) -> Option<Errors> {
        let there = self.reference()?.files();
        Some(Errors::between(&run.files(), &there, self.johnson))
    }

    /// Rows of `chapter_3.csv`.
    #[must_use]
    pub fn rows(&self) -> Vec<Line> {
        self.runs.iter().map(|run| self.line(run)).collect()
    }

    fn line(&self, run: &Done) -> Line {
        let s = &run.impact.summary;
        let files = run.files();
        let largest = |k: usize| files.iter().map(|row| row[k]).fold(f64::NAN, f64::max);
        let place = run.place;
        let finest = self.against_finest(run).map(|errors| errors.all);
        let range = self.range_against_finest(run);
        let own = self.nearest_to_finest(run).map(|errors| errors.all);
        let printed = place.and_then(|place| place.setting.errors);
        let minutes = place.and_then(|place| place.setting.minutes[place.nth]);
        let johnson = self.against_johnson(run).all;
        let converged = self.against_reference(run).map(|errors| errors.all);
        let nth = |errors: Option<[f64; 4]>, k: usize| errors.map_or(f64::NAN, |all| all[k]);
        Line {
            setting: place.map_or(REFERENCE, |place| place.setting.name),
            dimensions: match place.map(|place| place.geometry) {
                Some(Geometry::Quarter) => 3,
                _ => 2,
            },
            time_step_s: run.time_step,
            points: s.points,
            sphere_points: match place {
                Some(place) if place.geometry == Geometry::Quarter => {
                    lattice_points(f64::from(place.setting.count))
                }
                _ => 0,
            },
            sphere_points_printed: place.map_or(0, |place| place.setting.points),
            cpu_s: run.cpu_s,
            minutes_a_file_printed: minutes.unwrap_or(f64::NAN),
            files: files.len(),
            restitution: s.restitution,
            transfer_loss_ratio: (s.scheme.as_ref()).map_or(0.0, |x| x.transfer_loss_ratio),
            force_over_johnson: s.max_force_n / self.johnson.force,
            displacement_over_johnson: s.max_displacement_m / self.johnson.displacement,
            time_over_johnson: s.contact_time_s / self.johnson.contact_time,
            files_force_over_johnson: largest(1) / self.johnson.force,
            files_displacement_over_johnson: largest(2) / self.johnson.displacement,
            files_time_over_johnson: largest(0) / self.johnson.contact_time,
            mae_force_finest: nth(finest, 0),
            mae_force_finest_least: range.map_or(f64::NAN, |all| all[0][0]),
            mae_force_finest_largest: range.map_or(f64::NAN, |all| all[0][1]),
            mae_force_printed: nth(printed, 0),
            mae_displacement_finest: nth(finest, 1),
            mae_displacement_finest_least: range.map_or(f64::NAN, |all| all[1][0]),
            mae_displacement_finest_largest: range.map_or(f64::NAN, |all| all[1][1]),
            mae_displacement_printed: nth(printed, 1),
            mse_force_finest: nth(finest, 2),
            mse_force_printed: nth(printed, 2),
            mse_displacement_finest: nth(finest, 3),
            mse_displacement_printed: nth(printed, 3),
            mae_force_nearest: nth(own, 0),
            mae_displacement_nearest: nth(own, 1),
            mse_force_nearest: nth(own, 2),
            mse_displacement_nearest: nth(own, 3),
            mae_force_johnson: johnson[0],
            mae_displacement_johnson: johnson[1],
            mae_force_reference: nth(converged, 0),
            mae_displacement_reference: nth(converged, 1),
        }
    }
}

/// A run of the chapter: a row of `chapter_3.csv`. Errors are those of files, in units of Johnson's F* and delta*.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Setting of table 3-1.
    pub setting: &'static str,
    /// 2: section, 3: a quarter of the sphere.
    pub dimensions: usize,
    /// Length of the steps, s.
    pub time_step_s: f64,
    /// Points that were run.
    pub points: usize,
    /// Points of the whole sphere; 0 in the section.
    pub sphere_points: usize,
    /// The same as printed.
    pub sphere_points_printed: usize,
    /// Processor time, s.
    pub cpu_s: f64,
    /// Table 3-4.
    pub minutes_a_file_printed: f64,
    /// Files with a force.
    pub files: usize,
    /// e.
    pub restitution: f64,
    /// Energy lost in transfers over the incident energy.
    pub transfer_loss_ratio: f64,
    /// F*.
    pub force_over_johnson: f64,
    /// delta*.
    pub displacement_over_johnson: f64,
    /// Contact time.
    pub time_over_johnson: f64,
    /// F* of the files.
    pub files_force_over_johnson: f64,
    /// delta* of the files.
    pub files_displacement_over_johnson: f64,
    /// Contact time of the files.
    pub files_time_over_johnson: f64,
    /// Table 3-3: against the finest setting.
    pub mae_force_finest: f64,
    /// Least over the phases of the files.
    pub mae_force_finest_least: f64,
    /// Largest.
    pub mae_force_finest_largest: f64,
    /// As printed.
    pub mae_force_printed: f64,
    /// The same of the displacement.
    pub mae_displacement_finest: f64,
    /// Least over the phases of the files.
    pub mae_displacement_finest_least: f64,
    /// Largest.
    pub mae_displacement_finest_largest: f64,
    /// As printed.
    pub mae_displacement_printed: f64,
    /// Mean squared.
    pub mse_force_finest: f64,
    /// As printed.
    pub mse_force_printed: f64,
    /// Mean squared.
    pub mse_displacement_finest: f64,
    /// As printed.
    pub mse_displacement_printed: f64,
    /// In own units, at the moments of the files that are nearest.
    pub mae_force_nearest: f64,
    /// The same of the displacement.
    pub mae_displacement_nearest: f64,
    /// Mean squared.
    pub mse_force_nearest: f64,
    /// Mean squared.
    pub mse_displacement_nearest: f64,
    /// Against Johnson.
    pub mae_force_johnson: f64,
    /// Against Johnson.
    pub mae_displacement_johnson: f64,
    /// Against the finest run of the crate's own scheme.
    pub mae_force_reference: f64,
    /// Against the finest run of the crate's own scheme.
    pub mae_displacement_reference: f64,
}
