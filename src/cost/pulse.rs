//! Pulse: one impact as force and displacement over time, from a run or from Hertz, and how two of them differ.

use crate::case::Case;
use crate::curve::Impact;

/// Intervals of the contact time over which two pulses are compared; the thesis has 24 or 25 outputs a run.
const INTERVALS: usize = 25;

/// Figures of one impact and its course, SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulse {
    /// F*, N.
    pub force: f64,
    /// delta*, m.
    pub displacement: f64,
    /// e.
    pub restitution: f64,
    /// Contact time, s.
    pub contact_time: f64,
    /// Impact speed, m/s.
    velocity: f64,
    /// Time (s), force (N), displacement (m).
    samples: Vec<(f64, f64, f64)>,
}

/// Differences of a pulse from a reference, relative to the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Of F*.
    pub force: f64,
    /// Of delta*.
    pub displacement: f64,
    /// Of e.
    pub restitution: f64,
    /// Of the contact time.
    pub contact_time: f64,
    /// Mean absolute error of F/F*.
    pub mae_force: f64,
    /// Mean absolute error of delta/delta*.
    pub mae_displacement: f64,
    /// Mean squared error of F/F*.
    pub mse_force: f64,
    /// Mean squared error of delta/delta*.
    pub mse_displacement: f64,
}

impl Pulse {
    /// Pulse of a simulated impact.
    #[must_use]
    pub fn of(impact: &Impact) -> Self {
        let s = &impact.summary;
        let sample = |c: &crate::curve::Sample| (c.time_s, c.force_n, c.displacement_m);
        Pulse {
            force: s.max_force_n,
            displacement: s.max_displacement_m,
            restitution: s.restitution,
            contact_time: s.contact_time_s,
            velocity: s.velocity_m_s,
            samples: impact.curve.samples.iter().map(sample).collect(),
        }
    }

    /// Impact of an elastic sphere that follows Hertz throughout (Johnson 1985, section 11.4).
    ///
    /// $$ \delta^\ast = \left(\frac{15 m V^2}{16 \sqrt R E^\ast}\right)^{2/5}, \quad F^\ast = \tfrac43 E^\ast \sqrt R\ \delta^{\ast 3/2},
    ///    \quad t = \frac{\delta^\ast}{V} \int \frac{d(\delta/\delta^\ast)}{\sqrt{1 - (\delta/\delta^\ast)^{5/2}}}, \quad e = 1 $$
    #[must_use]
    pub fn hertz(case: &Case, velocity: f64) -> Self {
        let material = &case.material;
        let mass = material.sphere_mass(case.radius);
        let root = case.radius.sqrt();
        let stiff = material.contact_modulus();
        let displacement = (15.0 * mass * velocity * velocity / (16.0 * root * stiff)).powf(0.4);
        let samples = hertz_half(displacement, velocity);
        let half = samples.last().map_or(0.0, |s| s.0);
        let back = samples
            .iter()
            .rev()
            .skip(1)
            .map(|&(t, x)| (2.0 * half - t, x));
        let force = |x: f64| 4.0 / 3.0 * stiff * root * x * x.sqrt();
        Pulse {
            force: force(displacement),
            displacement,
            restitution: 1.0,
            contact_time: 2.0 * half,
            velocity,
            samples: samples
                .iter()
                .copied()
                .chain(back)
                .map(|(t, x)| (t, force(x), x))
                .collect(),
        }
    }

    /// The same course over its own contact time, in units of its own largest force and displacement.
    #[must_use]
    pub fn in_own_units(&self) -> Pulse {
        let (f, d, t) = (self.force, self.displacement, self.contact_time);
        let scaled = |s: &(f64, f64, f64)| (s.0 / t, s.1 / f, s.2 / d);
        Pulse {
            force: 1.0,
            displacement: 1.0,
            contact_time: 1.0,
            restitution: self.restitution,
            velocity: self.velocity * t / d,
            samples: self.samples.iter().map(scaled).collect(),
        }
    }

    /// Force and displacement as the means over equal intervals of `total` (s); free flight after loss of contact.
    fn means(&self, total: f64) -> Vec<(f64, f64)> {
        const PARTS: usize = 16;
        let count = INTERVALS * PARTS;
        let fine: Vec<(f64, f64)> = (0..count)
            .map(|k| self.at(total * (k as f64 + 0.5) / count as f64))
            .collect();
        fine.chunks(PARTS)
            .map(|part| {
                let sum = part.iter().fold((0.0, 0.0), |s, x| (s.0 + x.0, s.1 + x.1));
                (sum.0 / PARTS as f64, sum.1 / PARTS as f64)
            })
            .collect()
    }

    /// Force (N) and displacement (m) at `time` (s), by linear interpolation; free flight after loss of contact.
    #[must_use]
    pub fn at(&self, time: f64) -> (f64, f64) {
        let s = &self.samples;
        let k = s.partition_point(|x| x.0 < time);
        let Some(last) = s.last() else {
            return (0.0, 0.0);
        };
        if k == s.len() {
            return (
                0.0,
                last.2 - self.restitution * self.velocity * (time - last.0),
            );
        }
        let before = if k == 0 { (0.0, 0.0, 0.0) } else { s[k - 1] };
        let share = (time - before.0) / (s[k].0 - before.0).max(f64::MIN_POSITIVE);
        let mix = |a: f64, b: f64| a + share * (b - a);
        (mix(before.1, s[k].1), mix(before.2, s[k].2))
    }

    /// How this pulse differs from `reference`.
    #[must_use]
    pub fn misfit(&self, reference: &Pulse) -> Misfit {
        self.misfit_in_units(reference, reference)
    }

    /// The same with the mean errors in units of the largest force and displacement of `unit`.
    #[must_use]
    pub fn misfit_in_units(&self, reference: &Pulse, unit: &Pulse) -> Misfit {
        let relative = |a: f64, b: f64| a / b - 1.0;
        let total = reference.contact_time;
        let (ours, theirs) = (self.means(total), reference.means(total));
        let mean = |term: &dyn Fn((f64, f64), (f64, f64)) -> f64| {
            let sum: f64 = ours.iter().zip(&theirs).map(|(a, b)| term(*a, *b)).sum();
            sum / INTERVALS as f64
        };
        let force = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0) / unit.force;
        let displacement = |a: (f64, f64), b: (f64, f64)| (a.1 - b.1) / unit.displacement;
        Misfit {
            force: relative(self.force, reference.force),
            displacement: relative(self.displacement, reference.displacement),
            restitution: relative(self.restitution, reference.restitution),
            contact_time: relative(self.contact_time, reference.contact_time),
            mae_force: mean(&|a, b| force(a, b).abs()),
            mae_displacement: mean(&|a, b| displacement(a, b).abs()),
            mse_force: mean(&|a, b| force(a, b).powi(2)),
            mse_displacement: mean(&|a, b| displacement(a, b).powi(2)),
        }
    }
}

/// Time and displacement of an elastic impact up to its turning point.
///
/// With $(\delta/\delta^\ast)^{5/2} = \sin^2\varphi$ and $\varphi = s^{5/4}$ the integral loses both its singularities:
/// $t = (\delta^\ast/V) \int_0^s (\varphi / \sin\varphi)^{1/5}\ ds$; midpoint rule.
fn hertz_half(largest: f64, velocity: f64) -> Vec<(f64, f64)> {
    const STEPS: usize = 400;
    let step = std::f64::consts::FRAC_PI_2.powf(0.8) / STEPS as f64;
    let angle = |s: f64| s.powf(1.25);
    let mut time = 0.0;
    let mut samples = vec![(0.0, 0.0)];
    for k in 0..STEPS {
        let middle = angle(step * (k as f64 + 0.5));
        time += largest / velocity * step * (middle / middle.sin()).powf(0.2);
        let end = angle(step * (k as f64 + 1.0));
        samples.push((time, largest * end.sin().powf(0.8)));
    }
    samples
}

impl Misfit {
    /// Largest of the errors in F*, delta* and e: what a case's tolerance is about.
    #[must_use]
    pub fn worst(&self) -> f64 {
        // a NaN must not hide behind a number
        [self.force, self.displacement, self.restitution]
            .into_iter()
            .fold(
                0.0,
                |worst: f64, x| {
                    if x.abs() <= worst { worst } else { x.abs() }
                },
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn hertz() -> Pulse {
        let text = "[particle]\nradius = \"12.5 mm\"\n[material]\ndensity = \"1404 kg/m3\"\nyoung_modulus = \"4.9 MPa\"\n\
            poisson_ratio = 0.25\n[impact]\nvelocities = [\"1 m/s\"]\n[accuracy]\ntolerance = 0.02\n";
        Pulse::hertz(&Case::parse(text, Path::new("c.toml")).unwrap(), 1.0)
    }

    #[test]
    fn hertz_pulse_has_johnsons_contact_time_and_its_own_peaks() {
        let pulse = hertz();
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 0.0125f64.powi(3) * 1404.0;
        let stiff: f64 = 4.9e6 / (1.0 - 0.0625);
        let total = 2.87 * (mass * mass / (0.0125 * stiff * stiff)).powf(0.2);
        assert!((pulse.contact_time / total - 1.0).abs() < 2e-3);
        let peak =
            |pick: fn(&(f64, f64, f64)) -> f64| pulse.samples.iter().map(pick).fold(0.0, f64::max);
        assert!((peak(|s| s.1) / pulse.force - 1.0).abs() < 1e-3);
        assert!((peak(|s| s.2) / pulse.displacement - 1.0).abs() < 1e-3);
    }

    #[test]
    fn errors_are_those_that_were_put_in() {
        let exact = hertz();
        let none = exact.misfit(&exact);
        assert_eq!(
            (none.worst(), none.mae_force, none.mse_displacement),
            (0.0, 0.0, 0.0)
        );
        let mut stronger = exact.clone();
        stronger.force *= 1.1;
        for sample in &mut stronger.samples {
            sample.1 *= 1.1;
        }
        let misfit = stronger.misfit(&exact);
        assert!((misfit.worst() - 0.1).abs() < 1e-12);
        // mean of F/F* over the contact: m V (1 + e) / (F* t)
        let mean = 0.1 * 2.0 * 1404.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.0125f64.powi(3)
            / (exact.force * exact.contact_time);
        assert!(
            (misfit.mae_force / mean - 1.0).abs() < 2e-3,
            "{} {mean}",
            misfit.mae_force
        );
    }

    #[test]
    fn impacts_that_differ_in_scale_only_are_one_in_their_own_units() {
        let slow = hertz();
        let mut other = slow.clone();
        for s in &mut other.samples {
            *s = (2.0 * s.0, 3.0 * s.1, 5.0 * s.2);
        }
        (other.contact_time, other.force) = (2.0 * slow.contact_time, 3.0 * slow.force);
        (other.displacement, other.velocity) = (5.0 * slow.displacement, 2.5 * slow.velocity);
        let misfit = other.in_own_units().misfit(&slow.in_own_units());
        assert!(misfit.mae_force < 1e-12 && misfit.mae_displacement < 1e-12);
    }

    #[test]
    fn a_figure_that_is_no_number_is_the_worst_error() {
        let mut broken = hertz();
        broken.restitution = f64::NAN;
        assert!(broken.misfit(&hertz()).worst().is_nan());
    }
}
