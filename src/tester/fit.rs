//! Constants of the correlation from measured speeds: by the steps of Saifoori (2025, section 6.3.1.2), and all at once.
//!
//! In logarithms the correlation is linear in its constants. The thesis finds them one after the other by means of slopes; least squares
//! over all speeds gives them together, with their intervals and the scatter about them.

use super::{Constants, Particle, Tester};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// A measured speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// What was thrown.
    pub particle: Particle,
    /// Gauge pressure, Pa.
    pub pressure: f64,
    /// Speed, m/s.
    pub speed: f64,
}

/// What cannot be found from speeds, and what would have to vary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Undetermined {
    /// The constant.
    pub constant: &'static str,
    /// What varies too little.
    pub wants: &'static str,
}

/// Constants found by least squares.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The constants.
    pub constants: Constants,
    /// Half the width of the 95 % interval of each; of $\ln C_1$ in place of $C_1$.
    pub half_widths: [f64; 4],
    /// Standard deviation of the speeds about the correlation, over the speed.
    pub scatter: f64,
    /// Student's quantile of a 95 % interval.
    quantile: f64,
    /// Inverse of the triangular factor of the design: how the constants scatter together.
    inverse: DMatrix<f64>,
}

impl Fitted {
    /// Half the width of the 95 % interval of the logarithm of a speed that is measured next: it scatters as those before it did, and the
    /// constants it is reckoned with are no better than they.
    #[must_use]
    pub fn half_width(&self, tester: &Tester, particle: &Particle, pressure: f64) -> f64 {
        let place = Logs::of(
            tester,
            &Measured {
                particle: *particle,
                pressure,
                speed: 1.0,
            },
        );
        let of_constants = self.inverse.tr_mul(&DVector::from_row_slice(&place.row()));
        self.quantile * self.scatter * (1.0 + of_constants.norm_squared()).sqrt()
    }
}

/// Fewest speeds that tell four constants and how they scatter.
pub(super) const FEWEST: usize = 5;
/// Relative difference below which two settings are the same.
const SAME: f64 = 1e-6;

/// A speed as the correlation sees it: logarithms of $N_v^{1/3}$, $P/(\rho_a g h)$, S - 1 and $N_d^{1/3}$.
#[derive(Debug, Clone, Copy)]
struct Logs {
    speed: f64,
    head: f64,
    denser: f64,
    size: f64,
}

impl Logs {
    fn of(tester: &Tester, one: &Measured) -> Self {
        let number = one.speed * tester.per_speed(&one.particle);
        Logs {
            speed: number.ln(),
            head: tester.head(one.pressure).ln(),
            denser: tester.denser(&one.particle).ln(),
            size: tester.size(&one.particle).ln(),
        }
    }

    /// What the logarithm of $C_1$, $C_2$, $C_3$ and $C_4$ are multiplied by.
    fn row(&self) -> [f64; 4] {
        [1.0, self.head, -self.denser, -self.size]
    }
}

/// All four constants at once, by least squares on the logarithms; the constants of `tester` are not looked at.
///
/// # Errors
/// [`Undetermined`] where pressures, densities or sizes do not vary, or not each by itself, and where there are fewer than five speeds.
pub fn together(tester: &Tester, all: &[Measured]) -> Result<Fitted, Undetermined> {
    let logs: Vec<Logs> = all.iter().map(|one| Logs::of(tester, one)).collect();
    varies(&logs)?;
    if logs.len() < FEWEST {
        let wants = "at least five speeds";
        let constant = "C1 to C4";
        return Err(Undetermined { constant, wants });
    }
    let design = DMatrix::from_row_iterator(logs.len(), 4, logs.iter().flat_map(Logs::row));
    let speeds = DVector::from_iterator(logs.len(), logs.iter().map(|l| l.speed));
    let (q, r) = design.clone().qr().unpack();
    // columns that others make up leave nothing but rounding on the diagonal
    let largest = r.diagonal().amax();
    let Some(inverse) = r
        .clone()
        .try_inverse()
        .filter(|_| r.diagonal().iter().all(|d| d.abs() > SAME * largest))
    else {
        return Err(Undetermined {
            constant: "C1 to C4",
            wants: "pressures, densities and sizes that vary each by itself",
        });
    };
    let found = &inverse * q.tr_mul(&speeds);
    let left = (&design * &found - &speeds).norm_squared();
    let freedom = logs.len() as f64 - 4.0;
    let variance = left / freedom;
    let quantile = StudentsT::new(0.0, 1.0, freedom).map_or(f64::NAN, |t| t.inverse_cdf(0.975));
    let half = |k: usize| quantile * variance.sqrt() * inverse.row(k).norm();
    Ok(Fitted {
        constants: Constants {
            values: [found[0].exp(), found[1], found[2], found[3]],
        },
        half_widths: [0, 1, 2, 3].map(half),
        scatter: variance.sqrt(),
        quantile,
        inverse,
    })
}

/// The constants by the steps of the thesis: $C_2$ the mean slope over the pressure, one for each material and size; $C_4$ the mean slope
/// over the size, one for each material and pressure; $C_i$ the mean of each material (its equation 6-4); $C_1$ and $C_3$ from the line of
/// those over S - 1. Materials are told apart by their density. The trial and error that follows there is left out.
///
/// # Errors
/// As [`together`], but for the number of speeds.
pub fn by_steps(tester: &Tester, all: &[Measured]) -> Result<Constants, Undetermined> {
    let logs: Vec<Logs> = all.iter().map(|one| Logs::of(tester, one)).collect();
    varies(&logs)?;
    let over_pressure = slopes(&logs, |l| [l.denser, l.size], |l| [l.head, l.speed]);
    let c2 = mean(&over_pressure).ok_or(Undetermined {
        constant: "C2",
        wants: "a material and size at two pressures",
    })?;
    let rest = |l: &Logs| l.speed - c2 * l.head;
    let over_size = slopes(&logs, |l| [l.denser, l.head], |l| [l.size, rest(l)]);
    let c4 = -mean(&over_size).ok_or(Undetermined {
        constant: "C4",
        wants: "a material in two sizes at one pressure",
    })?;
    let materials: Vec<[f64; 2]> = groups(&logs, |l| [l.denser, 0.0])
        .into_iter()
        .filter_map(|group| {
            let each: Vec<f64> = group
                .iter()
                .map(|l| (rest(l) + c4 * l.size).exp())
                .collect();
            Some([group[0].denser, mean(&each)?.ln()])
        })
        .collect();
    let [c1, slope] = line(&materials).ok_or(Undetermined {
        constant: "C1, C3",
        wants: "two materials",
    })?;
    Ok(Constants {
        values: [c1.exp(), c2, -slope, c4],
    })
}

/// Determination of $N_v^{1/3}$ by a set of constants, $1 - \sum (p - e)^2 / \sum (e - \bar e)^2$ (equation 6-5).
#[must_use]
pub fn determination(tester: &Tester, all: &[Measured]) -> f64 {
    let number = |one: &Measured, speed: f64| speed * tester.per_speed(&one.particle);
    let measured: Vec<f64> = all.iter().map(|one| number(one, one.speed)).collect();
    let middle = mean(&measured).unwrap_or(f64::NAN);
    let (mut missed, mut spread) = (0.0, 0.0);
    for (one, e) in all.iter().zip(&measured) {
        let p = number(one, tester.speed(&one.particle, one.pressure));
        missed += (p - e) * (p - e);
        spread += (e - middle) * (e - middle);
    }
    1.0 - missed / spread
}

/// That pressure, density and size vary at all.
fn varies(logs: &[Logs]) -> Result<(), Undetermined> {
    let differ = |of: fn(&Logs) -> f64| {
        let first = logs.first().map(of);
        logs.iter()
            .any(|l| first.is_some_and(|first| !same(of(l), first)))
    };
    let wanted = [
        ("C2", "two pressures", differ(|l| l.head)),
        ("C3", "two densities", differ(|l| l.denser)),
        ("C4", "two sizes of one density", differ(|l| l.size)),
    ];
    match wanted.into_iter().find(|(.., varies)| !varies) {
        Some((constant, wants, _)) => Err(Undetermined { constant, wants }),
        None => Ok(()),
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME
}

/// Speeds that agree in both keys, in the order of their first ones.
fn groups(logs: &[Logs], key: impl Fn(&Logs) -> [f64; 2]) -> Vec<Vec<Logs>> {
    let mut all: Vec<Vec<Logs>> = Vec::new();
    for one in logs {
        let of = key(one);
        let alike = |group: &&mut Vec<Logs>| {
            let there = key(&group[0]);
            same(there[0], of[0]) && same(there[1], of[1])
        };
        match all.iter_mut().find(alike) {
            Some(group) => group.push(*one),
            None => all.push(vec![*one]),
        }
    }
    all
}

/// Slope of the line through each group that has one.
fn slopes(
    logs: &[Logs],
    key: impl Fn(&Logs) -> [f64; 2],
    place: impl Fn(&Logs) -> [f64; 2],
) -> Vec<f64> {
    groups(logs, key)
        .iter()
        .filter_map(|group| {
            let places: Vec<[f64; 2]> = group.iter().map(&place).collect();
            line(&places).map(|[_, slope]| slope)
        })
        .collect()
}

/// Intercept and slope of the line of least squares; none where all places are one above the other.
fn line(places: &[[f64; 2]]) -> Option<[f64; 2]> {
    let [x, y] = [0, 1].map(|k| places.iter().map(|p| p[k]).sum::<f64>() / places.len() as f64);
    let across: f64 = places.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
    let along: f64 = places.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let slope = along / across;
    (across > SAME * SAME && !places.is_empty()).then_some([y - slope * x, slope])
}

fn mean(all: &[f64]) -> Option<f64> {
    (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tester::{Air, POLYMERS_AND_GLASS, WITH_SOLDER};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    fn tester(constants: Constants) -> Tester {
        Tester {
            air: Air::USUAL,
            tube: Tester::TUBE,
            constants,
        }
    }

    /// The campaign of the thesis: three polymers in three sizes, glass in one, each thrown five times at four pressures, with
    /// speeds that scatter by `scatter`.
    fn campaign(constants: Constants, scatter: f64) -> Vec<Measured> {
        let tester = tester(constants);
        let mut random = Pcg64::seed_from_u64(1);
        let mut all = Vec::new();
        for (density, sizes) in [
            (745.0, &[500e-6, 710e-6, 1e-3][..]),
            (859.0, &[500e-6, 710e-6, 1e-3]),
            (902.0, &[500e-6, 710e-6, 1e-3]),
            (2545.0, &[1e-3]),
        ] {
            for &diameter in sizes {
                for pressure in [4e3, 8e3, 12e3, 16e3] {
                    for _ in 0..5 {
                        let particle = Particle { diameter, density };
                        let noise: f64 = (0..12).map(|_| random.random::<f64>() - 0.5).sum();
                        let speed = tester.speed(&particle, pressure) * (scatter * noise).exp();
                        all.push(Measured {
                            particle,
                            pressure,
                            speed,
                        });
                    }
                }
            }
        }
        all
    }

    #[test]
    fn both_ways_recover_known_constants_from_speeds_without_noise() {
        for known in [POLYMERS_AND_GLASS, WITH_SOLDER] {
            let all = campaign(known, 0.0);
            let one = together(&tester(WITH_SOLDER), &all).unwrap();
            let other = by_steps(&tester(WITH_SOLDER), &all).unwrap();
            for found in [one.constants, other] {
                for (found, known) in found.values.iter().zip(known.values) {
                    assert!((found / known - 1.0).abs() < 1e-8, "{found} {known}");
                }
            }
            assert!(one.scatter < 1e-12);
        }
    }

    #[test]
    fn intervals_hold_the_truth_and_the_scatter_is_found() {
        let known = POLYMERS_AND_GLASS;
        let all = campaign(known, 0.03);
        let found = together(&tester(known), &all).unwrap();
        assert!(
            (found.scatter / 0.03 - 1.0).abs() < 0.15,
            "{}",
            found.scatter
        );
        for k in 1..4 {
            let off = (found.constants.values[k] - known.values[k]).abs();
            assert!(off < 1.5 * found.half_widths[k], "{k}: {found:?}");
            assert!(found.half_widths[k] < 0.03, "{found:?}");
        }
        let right = Tester {
            constants: found.constants,
            ..tester(known)
        };
        assert!(determination(&right, &all) > 0.97);
    }

    #[test]
    fn the_interval_of_the_next_speed_holds_it_in_95_of_100_whatever_few_speeds_there_are() {
        let known = WITH_SOLDER;
        let all = campaign(known, 0.0);
        // eight speeds for four constants, and a throw beyond all of them
        let corners: Vec<Measured> = all
            .into_iter()
            .step_by(5)
            .filter(|m| [745.0, 902.0].contains(&m.particle.density))
            .filter(|m| m.particle.diameter != 710e-6)
            .filter(|m| m.pressure == 4e3 || m.pressure == 12e3)
            .collect();
        assert_eq!(corners.len(), 8);
        let next = Particle {
            diameter: 760e-6,
            density: 2545.0,
        };
        let truth = tester(known);
        let mut random = Pcg64::seed_from_u64(7);
        let mut noise = || -> f64 { (0..12).map(|_| random.random::<f64>() - 0.5).sum() };
        let (rounds, mut held) = (2000, 0);
        for _ in 0..rounds {
            let mut some = corners.clone();
            for one in &mut some {
                one.speed *= (0.03 * noise()).exp();
            }
            let found = together(&truth, &some).unwrap();
            let by = Tester {
                constants: found.constants,
                ..truth
            };
            let half = found.half_width(&by, &next, 20e3);
            let measured = truth.speed(&next, 20e3).ln() + 0.03 * noise();
            held += usize::from((by.speed(&next, 20e3).ln() - measured).abs() < half);
        }
        // 95 % within three standard deviations of the count
        let share = held as f64 / f64::from(rounds);
        assert!((share - 0.95).abs() < 0.015, "{share}");
    }

    #[test]
    fn what_does_not_vary_is_named() {
        let all = campaign(POLYMERS_AND_GLASS, 0.0);
        let keep = |of: fn(&Measured) -> bool| -> Vec<Measured> {
            all.iter().copied().filter(of).collect()
        };
        let tester = tester(WITH_SOLDER);
        for (some, constant) in [
            (keep(|m| m.pressure == 4e3), "C2"),
            (keep(|m| m.particle.density == 745.0), "C3"),
            (Vec::new(), "C2"),
        ] {
            assert_eq!(together(&tester, &some).unwrap_err().constant, constant);
            assert_eq!(by_steps(&tester, &some).unwrap_err().constant, constant);
        }
        // sizes that go with the density alone
        let tied = keep(|m| (m.particle.density == 2545.0) == (m.particle.diameter == 1e-3))
            .into_iter()
            .filter(|m| m.particle.density == 745.0 || m.particle.density == 2545.0)
            .filter(|m| m.particle.diameter != 710e-6)
            .collect::<Vec<_>>();
        assert_eq!(together(&tester, &tied).unwrap_err().constant, "C1 to C4");
        assert_eq!(by_steps(&tester, &tied).unwrap_err().constant, "C4");
    }
}
