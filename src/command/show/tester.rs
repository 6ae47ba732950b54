//! What `tester` prints: constants and throws, as text and JSON.

use crate::unit::{engineering, significant};
use serde::Serialize;
use std::fmt::Write;

/// One speed.
#[derive(Debug, Serialize)]
pub struct Throw {
    /// Gauge pressure of the vacuum, Pa.
    #[serde(rename = "gauge_pressure_Pa")]
    pub gauge_pressure_pa: f64,
    /// Speed, m/s.
    pub velocity_m_s: f64,
    /// Its 95 % interval by the deviations that were given and the measured speeds that the constants are from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval_m_s: Option<[f64; 2]>,
    /// e by the atlas.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Height lost over the diameter, by the atlas.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compression_ratio: Option<f64>,
    /// What has to be known of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// What is printed.
#[derive(Debug, Serialize)]
pub struct Answer {
    /// C1 to C4.
    pub constants: [f64; 4],
    /// How they were found from measured speeds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<Found>,
    /// Speeds that were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub throws: Vec<Throw>,
}

/// Constants found from measured speeds.
#[derive(Debug, Serialize)]
pub struct Found {
    /// Number of measured speeds.
    pub speeds: usize,
    /// Half the width of the 95 % interval of each; of the logarithm of C1.
    pub half_widths_95: [f64; 4],
    /// Standard deviation of the speeds about the correlation, over the speed.
    pub scatter: f64,
    /// Determination R2 by these constants.
    pub determination: f64,
    /// The constants step by step.
    pub by_steps: [f64; 4],
    /// Their R2.
    pub by_steps_determination: f64,
}

impl Answer {
    /// The answer as text.
    #[must_use]
    pub fn text(&self) -> String {
        let found = self.found.as_ref();
        let found = found.map_or_else(String::new, |found| found.text(self.constants));
        found + &self.throws_text()
    }

    /// A line for each throw, under their heads; nothing where there is none.
    fn throws_text(&self) -> String {
        let mut text = String::new();
        if self.throws.is_empty() {
            return text;
        }
        let _ = writeln!(
            text,
            "{:>10} {:>9} {:>16} {:>12} {:>12}",
            "pressure", "V (m/s)", "95 % interval", "restitution", "compression"
        );
        for throw in &self.throws {
            let interval = throw.interval_m_s.map_or("-".to_owned(), |[low, high]| {
                format!("{} to {}", significant(low, 3), significant(high, 3))
            });
            let shown = |value: Option<f64>| value.map_or("-".to_owned(), |x| significant(x, 3));
            let _ = writeln!(
                text,
                "{:>10} {:>9} {interval:>16} {:>12} {:>12}{}",
                engineering(throw.gauge_pressure_pa, "Pa", 3),
                significant(throw.velocity_m_s, 4),
                shown(throw.restitution),
                shown(throw.compression_ratio),
                throw
                    .notes
                    .iter()
                    .map(|note| format!("  {note}"))
                    .collect::<Vec<_>>()
                    .join(";"),
            );
        }
        text
    }
}

impl Found {
    /// The `constants` that were found, with their intervals, beside those step by step.
    fn text(&self, constants: [f64; 4]) -> String {
        let mut text = String::new();
        let digits = |x: f64| significant(x, 4);
        let _ = writeln!(
            text,
            "{:<24} {:>10} {:>10} {:>10} {:>10} {:>8}\n{:<24} {:>10} {:>10} {:>10} {:>10} {:>8}",
            format!("from {} speeds", self.speeds),
            "C1",
            "C2",
            "C3",
            "C4",
            "R2",
            "all at once",
            digits(constants[0]),
            digits(constants[1]),
            digits(constants[2]),
            digits(constants[3]),
            digits(self.determination),
        );
        let [c1, c2, c3, c4] = self.half_widths_95;
        let _ = writeln!(
            text,
            "{:<24} {:>10} {:>10} {:>10} {:>10}",
            "95 % interval, +-",
            format!("factor {}", significant(c1.exp(), 3)),
            significant(c2, 2),
            significant(c3, 2),
            significant(c4, 2),
        );
        let [c1, c2, c3, c4] = self.by_steps.map(digits);
        let _ = writeln!(
            text,
            "{:<24} {c1:>10} {c2:>10} {c3:>10} {c4:>10} {:>8}\nspeeds scatter by {} %",
            "step by step (thesis)",
            digits(self.by_steps_determination),
            significant(100.0 * self.scatter, 2),
        );
        text
    }
}
