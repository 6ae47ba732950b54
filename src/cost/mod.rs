//! Cost: what accuracy costs in time. Ladders of settings for one impact, the errors of each, and the Pareto front.

pub mod accuracy;
pub mod chapter;
mod ladder;
mod pulse;
mod relatives;
mod row;
mod table;
pub mod thesis;

pub use ladder::{Effort, Rung, rungs};
pub use pulse::{Misfit, Pulse};
pub use row::Row;
pub use table::{Summary, THRESHOLDS};

use crate::curve::{Impact, number_or_null};
use serde::{Deserialize, Serialize};

/// A run that has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Finished {
    /// Curve and figures.
    pub impact: Impact,
    /// What they do not hold.
    pub footprint: Footprint,
}

/// What is kept of a run beside its curve and figures.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Footprint {
    /// Memory of points and nodes, bytes.
    pub memory_bytes: usize,
    /// Energy lost in transfers between points and grid over the incident energy; NaN (`null` in the file) where the run came
    /// apart.
    #[serde(deserialize_with = "number_or_null")]
    pub transfer_loss: f64,
    /// Processor time, s: what the wall time would be on a machine with nothing else to do.
    pub cpu_s: f64,
}

/// Mark the rows that nothing beats: no other row is both faster and more accurate.
pub fn mark_front(rows: &mut [Row]) {
    let mut order: Vec<usize> = (0..rows.len())
        .filter(|&i| rows[i].ladder != ladder::REFERENCE && rows[i].error.is_finite())
        .collect();
    order.sort_by(|&a, &b| {
        let key = |i: usize| (rows[i].cpu_s, rows[i].error);
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut least = f64::INFINITY;
    for i in order {
        rows[i].on_front = rows[i].error < least;
        least = least.min(rows[i].error);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_footprint_of_a_run_that_came_apart_is_read_back() {
        let text = serde_json::to_string(&Footprint {
            memory_bytes: 1,
            transfer_loss: f64::NAN,
            cpu_s: 0.5,
        });
        let read: Footprint = serde_json::from_str(&text.unwrap()).unwrap();
        assert!(read.transfer_loss.is_nan() && read.cpu_s == 0.5);
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let row = |cpu_s: f64, error: f64| Row {
            cpu_s,
            error,
            ..Row::empty("cells", "x")
        };
        let mut rows = vec![
            row(1.0, 0.1),
            row(2.0, 0.2),
            row(3.0, 0.05),
            row(0.5, f64::NAN),
            row(4.0, 0.05),
        ];
        mark_front(&mut rows);
        let marks: Vec<bool> = rows.iter().map(|r| r.on_front).collect();
        assert_eq!(marks, [true, false, true, false, false]);
    }
}
