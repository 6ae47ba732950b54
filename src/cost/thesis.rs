//! Thesis: the settings and printed results of its sensitivity analysis, and these runs beside them.
//!
//! Source: the doctoral thesis behind this crate (University of Leeds), section 3.5: tables 3-1 (settings), 3-3 (errors
//! against its finest setting) and 3-4 (minutes an output file, one core). An elastic sphere, R = 12.5 mm, E = 4.9 MPa,
//! nu = 0.25, rho = 1404 kg/m3, hits a rigid wall at 1 m/s: `cases/thesis-3.toml`.

use super::{Pulse, Row};
use crate::case::Case;
use crate::impact::lattice_points;
use crate::plan::Geometry;
use crate::scheme::preset::Filling;
use crate::unit::rounded;
use std::fmt::Write;

/// Discretisation of the sphere (table 3-1), and what the thesis prints of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Name: material points per element and element size, in those of the first.
    pub name: &'static str,
    /// Points a diameter.
    pub count: u32,
    /// Element size over distance of the points.
    pub ratio: f64,
    /// Points of the whole sphere.
    pub points: usize,
    /// Minutes an output file at 100, 10 and 1 ns (table 3-4); `None`: printed as below one.
    pub minutes: [Option<f64>; 3],
    /// Mean absolute errors of F/F* and delta/delta* and mean squared errors of both, against 4MP/ES (table 3-3).
    pub errors: Option<[f64; 4]>,
}

impl Setting {
    /// Element size, R.
    #[must_use]
    pub fn cell(&self) -> f64 {
        self.filling().cell()
    }

    /// Lattice and cells.
    #[must_use]
    pub fn filling(&self) -> Filling {
        Filling {
            points: self.count,
            ratio: self.ratio,
        }
    }
}

/// Element to point ratio of the settings with one point an element.
pub const RATIO: f64 = 1.05;

/// Shares of the power of ten below the crossing time of the smallest element that are taken as time step.
pub const MULTIPLIERS: [f64; 3] = [0.1, 0.01, 0.001];

/// The five settings; with three time steps each they are the fifteen cases.
pub static SETTINGS: [Setting; 5] = [
    Setting {
        name: "MP/ES",
        count: 50,
        ratio: RATIO,
        points: 74_227,
        minutes: [Some(3.0), Some(28.0), Some(261.0)],
        errors: Some([13e-3, 8e-3, 2e-4, 2e-4]),
    },
    Setting {
        name: "2MP/ES",
        count: 62,
        ratio: 1.3,
        points: 137_963,
        minutes: [Some(5.0), Some(46.0), Some(449.0)],
        errors: Some([9e-3, 3e-3, 2e-4, 3e-5]),
    },
    Setting {
        name: FINEST,
        count: 80,
        ratio: 1.68,
        points: 290_245,
        minutes: [Some(10.0), Some(93.0), Some(864.0)],
        errors: None,
    },
    Setting {
        name: "MP/2ES",
        count: 25,
        ratio: RATIO,
        points: 9_357,
        minutes: [None, Some(3.0), Some(32.0)],
        errors: None,
    },
    Setting {
        name: "MP/4ES",
        count: 13,
        ratio: RATIO,
        points: 1_513,
        minutes: [None, None, Some(4.0)],
        errors: None,
    },
];

/// Setting that table 3-3 compares the others with.
pub(super) const FINEST: &str = "4MP/ES";
/// Time from one output file to the next, s (section 3.5.1).
pub const INTERVAL: f64 = 150e-6;
/// Output files of a run: "24 or 25".
const OUTPUTS: f64 = 24.5;

/// Name of the ladder of the `nth` time step in a geometry.
#[must_use]
pub fn ladder(geometry: Geometry, nth: usize) -> String {
    let place = match geometry {
        Geometry::Axisymmetric => "section",
        _ => "3-D",
    };
    format!("thesis, {place}, step {}", MULTIPLIERS[nth])
}

/// Whether a case is the one of the thesis' section 3.5.
#[must_use]
pub fn is_its_case(case: &Case, velocity: f64) -> bool {
    let material = &case.material;
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    near(case.radius, 12.5e-3)
        && near(material.density, 1404.0)
        && near(material.young_modulus, 4.9e6)
        && near(material.poisson_ratio, 0.25)
        && near(velocity, 1.0)
        && material.flow.is_none()
}

/// Runs of the fifteen cases with their pulses.
#[derive(Debug, Clone, Copy)]
pub struct Comparison<'a> {
    /// All rows of the impact.
    pub rows: &'a [Row],
    /// Their pulses.
    pub pulses: &'a [Pulse],
    /// F* and delta* by which the thesis makes its curves dimensionless (Johnson).
    pub unit: &'a Pulse,
}

impl Comparison<'_> {
    /// Row and pulse of a setting at a time step, if it was run to its end.
    fn find(&self, geometry: Geometry, nth: usize, setting: &str) -> Option<(&Row, &Pulse)> {
        let name = ladder(geometry, nth);
        let is_it = |r: &Row| {
            let begins = r.rung.split(',').next() == Some(setting);
            r.ladder == name && begins && r.status == "ok"
        };
        let k = self.rows.iter().position(is_it)?;
        Some((&self.rows[k], self.pulses.get(k)?))
    }

    /// The thesis' tables with these runs beside them, as Markdown; empty where none of the cases was run.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut times = String::new();
        let mut errors = String::new();
        for geometry in [Geometry::Quarter, Geometry::Axisymmetric] {
            for nth in 0..MULTIPLIERS.len() {
                for setting in &SETTINGS {
                    self.write_time(&mut times, geometry, nth, setting);
                    self.write_errors(&mut errors, geometry, nth, setting);
                }
            }
        }
        if times.is_empty() {
            return times;
        }
        format!(
            "\n## The thesis' fifteen cases (its tables 3-1 and 3-4)\n\nPrinted times: minutes an output file times \
             {OUTPUTS} files. Runs in three dimensions hold a quarter of the sphere. Errors are relative to the finest run, MAE to \
             Johnson.\n\n| setting | points, thesis | points of the whole sphere here | time, thesis | cpu s here | F* | delta* | e \
             | MAE F | MAE delta |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n{times}\n## The thesis' table 3-3: errors \
             against {FINEST} at the same time step\n\nThe thesis prints them for one time step that it does not name, \
             and does not say by which F*, delta* and contact time a run is made dimensionless: first Johnson's for \
             all, then each run's own.\n\n\
             | setting | MAE F | thesis | MAE delta | thesis | MSE F | thesis | MSE delta | thesis \
             |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n{errors}"
        )
    }

    fn write_time(&self, text: &mut String, geometry: Geometry, nth: usize, setting: &Setting) {
        let Some((row, _)) = self.find(geometry, nth, setting.name) else {
            return;
        };
        let printed = match setting.minutes[nth] {
            Some(minutes) => format!("{} h", rounded(minutes * OUTPUTS / 60.0, 2)),
            None => format!("< {} h", rounded(OUTPUTS / 60.0, 2)),
        };
        let (place, whole) = match geometry {
            Geometry::Axisymmetric => ("section", "(section)".to_owned()),
            _ => ("3-D", lattice_points(f64::from(setting.count)).to_string()),
        };
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        let of_hertz = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:.3}"));
        let _ = writeln!(
            text,
            "| {}, {place} | {} | {whole} | {printed} | {} | {} | {} | {} | {} | {} |",
            row.rung,
            setting.points,
            rounded(row.cpu_s, 3),
            percent(row.max_force_error_rel),
            percent(row.max_displacement_error_rel),
            percent(row.restitution_error_rel),
            of_hertz(row.hertz_mae_force),
            of_hertz(row.hertz_mae_displacement),
        );
    }

    fn write_errors(&self, text: &mut String, geometry: Geometry, nth: usize, setting: &Setting) {
        let (Some(printed), Some((row, pulse)), Some((_, finest))) = (
            setting.errors,
            self.find(geometry, nth, setting.name),
            self.find(geometry, nth, FINEST),
        ) else {
            return;
        };
        let place = match geometry {
            Geometry::Axisymmetric => "section",
            _ => "3-D",
        };
        let own = pulse.in_own_units().misfit(&finest.in_own_units());
        let common = pulse.misfit_in_units(finest, self.unit);
        for (units, m) in [("", common), (", own units", own)] {
            let ours = [
                m.mae_force,
                m.mae_displacement,
                m.mse_force,
                m.mse_displacement,
            ];
            let pairs = ours.iter().zip(printed);
            let cells: Vec<String> = pairs.map(|(a, b)| format!("{a:.1e} | {b:.1e}")).collect();
            let _ = writeln!(
                text,
                "| {}, {place}{units} | {} |",
                row.rung,
                cells.join(" | ")
            );
        }
    }
}
