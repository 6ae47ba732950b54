//! Sizes: distributions that grain radii are drawn from.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use statrs::distribution::{ContinuousCDF, Normal};
use std::sync::Arc;

/// Distribution of radii, m.
#[derive(Debug, Clone, PartialEq)]
pub enum Sizes {
    /// Evenly spread over a share of the mean, up and down; one size for a spread of 0.
    Uniform {
        /// Mean radius, m.
        mean: f64,
        /// Share of the mean.
        spread: f64,
    },
    /// Classes of a sieve, each of one radius.
    Sieve(Vec<SieveClass>),
    /// The logarithm of the radius is normal, cut off at both ends.
    LogNormal {
        /// Median radius, m.
        median: f64,
        /// Standard deviation of the logarithm.
        deviation: f64,
        /// Smallest and largest radius, m.
        limits: [f64; 2],
    },
    /// Radii of a list, each as likely, m, ascending.
    Listed(Arc<[f64]>),
}

/// Grains of one radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SieveClass {
    /// Radius, m.
    pub radius: f64,
    /// Share of all grains, by number.
    pub share: f64,
}

impl Sizes {
    /// Sieve of classes given by radius (m) and share of the mass, which need not add up to 1.
    ///
    /// ```
    /// use impactlaw::bed::scene::sizes::Sizes;
    /// // equal masses: eight grains of half the radius for each large one
    /// let Sizes::Sieve(classes) = Sizes::sieve(&[(1e-3, 0.5), (2e-3, 0.5)]) else { panic!() };
    /// assert!((classes[0].share / classes[1].share - 8.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn sieve(by_mass: &[(f64, f64)]) -> Self {
        let number = |(radius, mass): (f64, f64)| mass / radius.powi(3);
        let all: f64 = by_mass.iter().map(|&class| number(class)).sum();
        let class = |&(radius, mass): &(f64, f64)| SieveClass {
            radius,
            share: number((radius, mass)) / all,
        };
        Sizes::Sieve(by_mass.iter().map(class).collect())
    }

    /// Sizes of a list of radii (m), which must hold one.
    #[must_use]
    pub fn listed(mut radii: Vec<f64>) -> Self {
        radii.sort_unstable_by(f64::total_cmp);
        Sizes::Listed(radii.into())
    }

    /// Smallest and largest radius, m.
    #[must_use]
    pub fn limits(&self) -> [f64; 2] {
        match self {
            Sizes::Uniform { mean, spread } => [mean * (1.0 - spread), mean * (1.0 + spread)],
            Sizes::LogNormal { limits, .. } => *limits,
            Sizes::Listed(radii) => [radii[0], radii[radii.len() - 1]],
            Sizes::Sieve(classes) => classes
                .iter()
                .fold([f64::INFINITY, 0.0], |[low, high], class| {
                    [low.min(class.radius), high.max(class.radius)]
                }),
        }
    }

    /// A radius of the middle of the distribution, m: the scale of a bed.
    #[must_use]
    pub fn typical(&self) -> f64 {
        match self {
            Sizes::Uniform { mean, .. } => *mean,
            Sizes::LogNormal { median, .. } => *median,
            Sizes::Listed(radii) => radii[radii.len() / 2],
            Sizes::Sieve(classes) => classes.iter().map(|class| class.share * class.radius).sum(),
        }
    }

    /// A radius (m); every draw takes one number of `random`.
    pub fn draw(&self, random: &mut Pcg64Mcg) -> f64 {
        match self {
            Sizes::Uniform { mean, spread } => {
                mean * (1.0 + spread * random.random_range(-1.0..=1.0))
            }
            Sizes::Sieve(classes) => {
                let mut left = random.random_range(0.0..=1.0);
                let class = classes.iter().find(|class| {
                    left -= class.share;
                    left <= 0.0
                });
                class.or(classes.last()).map_or(0.0, |class| class.radius)
            }
            Sizes::Listed(radii) => radii[random.random_range(0..radii.len())],
            Sizes::LogNormal {
                median,
                deviation,
                limits,
            } => {
                let normal = Normal::standard();
                let [low, high] = limits.map(|limit| normal.cdf((limit / median).ln() / deviation));
                let share = low + (high - low) * random.random_range(0.0..=1.0);
                let radius = median * (deviation * normal.inverse_cdf(share)).exp();
                radius.clamp(limits[0], limits[1])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    fn drawn(sizes: &Sizes, count: usize) -> Vec<f64> {
        let mut random = Pcg64Mcg::seed_from_u64(5);
        (0..count).map(|_| sizes.draw(&mut random)).collect()
    }

    #[test]
    fn sieve_classes_come_in_their_shares_of_mass() {
        let radii = drawn(&Sizes::sieve(&[(1e-3, 0.25), (2e-3, 0.75)]), 40_000);
        let mass = |radius: f64| {
            let cubes = radii.iter().filter(|r| **r == radius).map(|r| r.powi(3));
            cubes.sum::<f64>()
        };
        let share = mass(1e-3) / (mass(1e-3) + mass(2e-3));
        assert!((share - 0.25).abs() < 0.01, "{share}");
    }

    #[test]
    fn lognormal_radii_keep_their_median_their_width_and_their_limits() {
        let sizes = Sizes::LogNormal {
            median: 1e-3,
            deviation: 0.3,
            limits: [0.3e-3, 3e-3],
        };
        let mut logs: Vec<f64> = drawn(&sizes, 20_000)
            .iter()
            .map(|r| (r / 1e-3).ln())
            .collect();
        assert!(
            logs.iter()
                .all(|l| l.exp() >= 0.3 - 1e-12 && l.exp() <= 3.0 + 1e-12)
        );
        logs.sort_by(f64::total_cmp);
        assert!(logs[10_000].abs() < 0.01);
        // 84.13 % lie below one standard deviation
        assert!((logs[16_827] - 0.3).abs() < 0.01, "{}", logs[16_827]);
    }

    #[test]
    fn one_size_is_drawn_exactly() {
        let sizes = Sizes::Uniform {
            mean: 1e-3,
            spread: 0.0,
        };
        assert!(drawn(&sizes, 10).iter().all(|r| *r == 1e-3));
    }
}
