//! Scale: one axis of a chart; its unit, range, round ticks, and the way from a value to a place.

use crate::unit::{prefixed, significant};

/// What an axis shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity, e.g. "displacement δ".
    pub label: String,
    /// SI unit; a prefix is chosen to suit the range. Empty for a pure number.
    pub unit: &'static str,
    /// Range in SI; `None`: that of the data, with zero if it is near.
    pub range: Option<(f64, f64)>,
    /// Logarithmic where the range spans more than a factor of 30 and is positive.
    pub log_if_wide: bool,
}

impl Axis {
    /// Linear axis over the range of the data.
    #[must_use]
    pub fn new(label: &str, unit: &'static str) -> Self {
        Axis {
            label: label.to_owned(),
            unit,
            range: None,
            log_if_wide: false,
        }
    }
}

/// Axis with its range settled.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    /// Label with unit.
    pub title: String,
    /// Ticks as places.
    pub ticks: Vec<f64>,
    /// First place.
    pub low: f64,
    /// Last place.
    pub high: f64,
    factor: f64,
    log: bool,
}

/// Ratio of a range from which a logarithmic axis shows more than a linear one.
const WIDE: f64 = 30.0;

impl Scale {
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = axis.range.unwrap_or_else(|| range_of(values));
        let (factor, unit) = prefixed(low.abs().max(high.abs()), axis.unit);
        let title = match (axis.label.as_str(), unit.as_str()) {
            (label, "") => label.to_owned(),
            (label, unit) => format!("{label} ({unit})"),
        };
        let (low, high) = (low * factor, high * factor);
        if axis.log_if_wide && low > 0.0 && high / low > WIDE {
            let (low, high) = (low / 1.15, high * 1.15);
            return Scale {
                title,
                ticks: log_ticks(low, high)
                    .iter()
                    .map(|tick| tick.log10())
                    .collect(),
                low: low.log10(),
                high: high.log10(),
                factor,
                log: true,
            };
        }
        let (low, high) = match axis.range {
            Some(_) => (low, high),
            None => padded(low, high),
        };
        Scale {
            title,
            ticks: linear_ticks(low, high),
            low,
            high,
            factor,
            log: false,
        }
    }

    /// Place of a value in SI; `None` where it has none.
    pub fn place(&self, value: f64) -> Option<f64> {
        let scaled = value * self.factor;
        let place = if self.log { scaled.log10() } else { scaled };
        place.is_finite().then_some(place)
    }

    /// Tick label of a place.
    pub fn label(&self, place: f64) -> String {
        let value = if self.log { 10f64.powf(place) } else { place };
        // A tick computed as 3 * 0.1 is not exactly 0.3, and zero not exactly 0.
        if value.abs() < 1e-9 * (self.high - self.low).abs() {
            return "0".to_owned();
        }
        significant(value, 6).replace('-', "\u{2212}")
    }
}

/// Smallest and largest finite value; 0..1 when there is none.
fn range_of(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
    if low > high {
        (0.0, 1.0)
    } else if low == high {
        (
            low - 0.5 * low.abs().max(1.0),
            high + 0.5 * high.abs().max(1.0),
        )
    } else {
        (low, high)
    }
}

/// Range with zero if it is near, and some air where the data would touch the frame.
fn padded(low: f64, high: f64) -> (f64, f64) {
    let low = if low > 0.0 && low < 0.4 * high {
        0.0
    } else {
        low
    };
    let air = 0.04 * (high - low);
    let low = if low == 0.0 { 0.0 } else { low - air };
    (low, high + air)
}

/// About six multiples of 1, 2 or 5 times a power of ten.
fn linear_ticks(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / 6.0;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * power)
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(10.0 * power);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    (0..=(last - first).max(0.0) as usize)
        .map(|i| (first + i as f64) * step)
        .collect()
}

/// 1, 2, 5 of each decade; powers of ten alone when there are many decades.
fn log_ticks(low: f64, high: f64) -> Vec<f64> {
    let mantissas: &[f64] = match (high / low).log10() {
        decades if decades < 3.5 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    };
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    decades
        .flat_map(|d| mantissas.iter().map(move |m| m * 10f64.powi(d)))
        .filter(|tick| (low..=high).contains(tick))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        for (low, high) in [(0.0, 1.0), (-3.0, 17.0), (0.0, 0.043), (980.0, 1020.0)] {
            let ticks = linear_ticks(low, high);
            assert!((4..=8).contains(&ticks.len()), "{low}..{high}: {ticks:?}");
            assert!(ticks.iter().all(|t| *t >= low - 1e-9 && *t <= high + 1e-9));
        }
        assert_eq!(
            log_ticks(0.9, 110.0),
            [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
        );
    }

    #[test]
    fn the_unit_suits_the_range() {
        let axis = Axis::new("displacement", "m");
        let scale = Scale::new(&axis, [0.0, 17e-6].into_iter());
        assert_eq!(scale.title, "displacement (µm)");
        assert!((scale.place(10e-6).unwrap() - 10.0).abs() < 1e-12);
        assert_eq!(scale.label(10.0), "10");
    }

    #[test]
    fn an_axis_is_logarithmic_only_when_wide() {
        let mut axis = Axis::new("V", "m/s");
        axis.log_if_wide = true;
        let narrow = Scale::new(&axis, [5.0, 30.0].into_iter());
        assert_eq!(narrow.place(10.0), Some(10.0));
        let wide = Scale::new(&axis, [0.01, 30.0].into_iter());
        assert!((wide.place(10.0).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(wide.place(-1.0), None);
    }

    #[test]
    fn no_data_still_makes_an_axis() {
        let scale = Scale::new(&Axis::new("x", ""), std::iter::empty());
        assert!(scale.low < scale.high && !scale.ticks.is_empty());
        let scale = Scale::new(&Axis::new("x", ""), std::iter::once(0.0));
        assert!(scale.low < scale.high);
    }
}
