//! Sampling: from impacts at the ends of each input's uncertainty to the interval of a figure.
//!
//! Between and beyond the ends the logarithm of a figure is a parabola in each input, and inputs act by themselves. Draws are normal.

use rand::RngExt;
use rand_pcg::Pcg64;
use statrs::distribution::{ContinuousCDF, Normal};

/// How intervals are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampling {
    /// Draws.
    pub draws: usize,
    /// Seed.
    pub seed: u64,
}

/// Ends of the interval of 95 %.
const ENDS: [f64; 2] = [0.025, 0.975];

/// Interval of 95 % of a figure: its value, and for each uncertain input its values one standard deviation below and above. `stream` keeps
/// the draws of one case apart from those of others, so that a further case changes none.
#[must_use]
pub fn interval(
    value: f64,
    ends: &[[f64; 2]],
    sampling: &Sampling,
    stream: u64,
) -> Option<[f64; 2]> {
    let positive = |x: &f64| *x > 0.0 && x.is_finite();
    let whole = positive(&value) && ends.iter().flatten().all(positive);
    if ends.is_empty() || !whole {
        return None;
    }
    let parabolas: Vec<[f64; 2]> = ends
        .iter()
        .map(|end| {
            let [low, high] = end.map(|x| (x / value).ln());
            [0.5 * (high - low), 0.5 * (high + low)]
        })
        .collect();
    let normal = Normal::standard();
    let mut random = Pcg64::new(u128::from(sampling.seed), u128::from(stream));
    let mut draw = || {
        let each = parabolas.iter().map(|[slope, bend]| {
            let z = normal.inverse_cdf(random.random_range(f64::EPSILON..1.0));
            slope * z + bend * z * z
        });
        value * each.sum::<f64>().exp()
    };
    let mut all: Vec<f64> = (0..sampling.draws).map(|_| draw()).collect();
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all[((share * all.len() as f64) as usize).min(all.len() - 1)];
    Some(ENDS.map(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANY: Sampling = Sampling {
        draws: 20_000,
        seed: 1,
    };

    #[test]
    fn a_product_of_powers_has_the_interval_of_its_logarithm() {
        // y = a^2 / b, standard deviations of ln a and ln b 0.05 and 0.1
        let ends = [
            [(-0.1f64).exp(), 0.1f64.exp()],
            [0.1f64.exp(), (-0.1f64).exp()],
        ];
        let [low, high] = interval(3.0, &ends.map(|end| end.map(|x| 3.0 * x)), &MANY, 0).unwrap();
        let half = 1.959_964 * 0.02f64.sqrt();
        assert!(((low / 3.0).ln() / -half - 1.0).abs() < 0.03, "{low}");
        assert!(((high / 3.0).ln() / half - 1.0).abs() < 0.03, "{high}");
    }

    #[test]
    fn a_figure_at_its_crest_is_never_above_it() {
        let [low, high] = interval(1.0, &[[0.99, 0.99]], &MANY, 0).unwrap();
        assert!(high <= 1.0 && low < 0.97, "{low} {high}");
    }

    #[test]
    fn the_same_seed_draws_the_same_and_no_input_has_no_interval() {
        let of = |stream| interval(1.0, &[[0.9, 1.1]], &MANY, stream);
        assert_eq!(of(1), of(1));
        assert_ne!(of(1), of(2));
        assert_eq!(interval(1.0, &[], &MANY, 0), None);
        assert_eq!(interval(1.0, &[[f64::NAN, 1.1]], &MANY, 0), None);
    }
}
