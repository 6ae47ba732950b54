//! Score: how large the errors of the atlas are over many impacts.

use serde::{Deserialize, Serialize};

/// Errors without sign of F*, delta* and e (relative; that of e below 0.2 over 0.2).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Score {
    /// Impacts.
    pub impacts: usize,
    /// Median.
    pub median: [f64; 3],
    /// Exceeded by one in twenty.
    pub twentieth: [f64; 3],
    /// Largest.
    pub worst: [f64; 3],
}

impl Score {
    /// Of the errors of impacts.
    #[must_use]
    pub fn of(errors: &[[f64; 3]]) -> Self {
        let at = |share: f64| {
            [0, 1, 2].map(|k| {
                let mut all: Vec<f64> = errors.iter().map(|e| e[k].abs()).collect();
                all.sort_by(f64::total_cmp);
                let place = (share * (all.len().max(1) - 1) as f64).round() as usize;
                all.get(place).copied().unwrap_or(f64::NAN)
            })
        };
        Score {
            impacts: errors.len(),
            median: at(0.5),
            twentieth: at(0.95),
            worst: at(1.0),
        }
    }
}
