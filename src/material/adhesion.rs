//! Adhesion of an elastic sphere to a rigid plane: work of adhesion, range of the attraction, and what the theories of Johnson,
//! Kendall and Roberts (JKR), of Derjaguin, Muller and Toporov (DMT) and of Maugis make of them.
//!
//! Any one system of units; moduli are $E^\ast = E/(1-\nu^2)$.

use std::f64::consts::PI;

/// What a case says of the adhesion of particle and wall, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    /// Work of adhesion of the two surfaces, $w = \gamma_1 + \gamma_2 - \gamma_{12}$, J/m2.
    pub work: f64,
    /// Gap up to which they attract each other, m; none: chosen by the planner, so short that it does not matter.
    pub range: Option<f64>,
}

/// Attraction of two surfaces: a constant traction $\sigma_0 = w/h_0$ across gaps up to $h_0$, none beyond.
///
/// Source: Dugdale 1960, J. Mech. Phys. Solids 8, 100; as the law between a sphere and a plane Maugis 1992, J. Colloid Interface
/// Sci. 150, 243.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dugdale {
    /// Work of adhesion $w$.
    pub work: f64,
    /// Range $h_0$.
    pub range: f64,
}

impl Dugdale {
    /// Traction $\sigma_0$.
    #[must_use]
    pub fn strength(&self) -> f64 {
        self.work / self.range
    }

    /// Width of the ring around a contact in which surfaces that part still attract each other, where it is small against the contact:
    ///
    /// $$ d = \frac{\pi}{8} \frac{K_I^2}{\sigma_0^2} = \frac{\pi}{4} \frac{E^\ast h_0^2}{w}, \qquad w = \frac{K_I^2}{2 E^\ast} $$
    ///
    /// Source: Dugdale 1960 for small zones, with the energy release rate of a crack between an elastic body of `modulus` $E^\ast$ and a
    /// rigid one.
    #[must_use]
    pub fn zone(&self, modulus: f64) -> f64 {
        0.25 * PI * modulus * self.range * self.range / self.work
    }

    /// Maugis' number of a sphere of `radius`: large is JKR's limit (short range, soft sphere), small DMT's.
    ///
    /// $$ \lambda = 2 \sigma_0 \left(\frac{R}{\pi w K^2}\right)^{1/3}, \qquad K = \tfrac43 E^\ast $$
    ///
    /// It is 1.16 times Tabor's number where the strength is that of a Lennard-Jones potential.
    /// Source: Maugis 1992.
    #[must_use]
    pub fn maugis_number(&self, radius: f64, modulus: f64) -> f64 {
        let k = 4.0 / 3.0 * modulus;
        2.0 * self.strength() * (radius / (PI * self.work * k * k)).cbrt()
    }

    /// The range at which a sphere has the Maugis number `lambda`.
    ///
    /// ```
    /// use impactlaw::material::adhesion::Dugdale;
    /// let range = Dugdale::range_at(4.0, 0.1, 1e-6, 1e10);
    /// let lambda = Dugdale { work: 0.1, range }.maugis_number(1e-6, 1e10);
    /// assert!((lambda / 4.0 - 1.0).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn range_at(lambda: f64, work: f64, radius: f64, modulus: f64) -> f64 {
        let k = 4.0 / 3.0 * modulus;
        2.0 / lambda * (work * work * radius / (PI * k * k)).cbrt()
    }
}

/// Elastic sphere on a rigid plane with a short-ranged attraction, after Johnson, Kendall and Roberts 1971, Proc. R. Soc. A 324, 301.
///
/// With the contact radius a as parameter
///
/// $$ F = \frac{4 E^\ast a^3}{3R} - \sqrt{8 \pi w E^\ast a^3}, \qquad \delta = \frac{a^2}{R} - \sqrt{\frac{2 \pi w a}{E^\ast}} . $$
///
/// ```
/// use impactlaw::material::adhesion::Jkr;
/// let sphere = Jkr { radius: 1e-6, modulus: 1e10, work: 0.1 };
/// // at rest without load, and at the largest pull
/// assert!(sphere.force(sphere.rest_radius()).abs() < 1e-12 * sphere.pull_off());
/// let most = sphere.rest_radius() / 4f64.cbrt();
/// assert!((sphere.force(most) / -sphere.pull_off() - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jkr {
    /// Radius R.
    pub radius: f64,
    /// Contact modulus $E^\ast$.
    pub modulus: f64,
    /// Work of adhesion w.
    pub work: f64,
}

impl Jkr {
    /// Force at the contact radius `a`; negative pulls.
    #[must_use]
    pub fn force(&self, a: f64) -> f64 {
        let cubed = a.powi(3);
        4.0 * self.modulus * cubed / (3.0 * self.radius)
            - (8.0 * PI * self.work * self.modulus * cubed).sqrt()
    }

    /// Approach at the contact radius `a`.
    #[must_use]
    pub fn approach(&self, a: f64) -> f64 {
        a * a / self.radius - (2.0 * PI * self.work * a / self.modulus).sqrt()
    }

    /// Contact radius without load, $a_0^3 = 9 \pi w R^2 / (2 E^\ast)$.
    #[must_use]
    pub fn rest_radius(&self) -> f64 {
        (4.5 * PI * self.work * self.radius * self.radius / self.modulus).cbrt()
    }

    /// Largest pull, $F_c = \tfrac32 \pi w R$, whatever the modulus.
    #[must_use]
    pub fn pull_off(&self) -> f64 {
        1.5 * PI * self.work * self.radius
    }

    /// Largest pull of a sphere so stiff, or an attraction so far reaching, that it is not deformed: $2 \pi w R$.
    ///
    /// Source: Derjaguin, Muller and Toporov 1975, J. Colloid Interface Sci. 53, 314; Bradley 1932.
    #[must_use]
    pub fn dmt_pull_off(&self) -> f64 {
        2.0 * PI * self.work * self.radius
    }

    /// Energy lost as the contact snaps in and breaks: the work of pulling the sphere from $\delta = 0$ to where it breaks,
    /// $7.09\ (w^5 R^4 / E^{\ast 2})^{1/3}$.
    ///
    /// Source: Johnson and Pollock 1994, J. Adhesion Sci. Technol. 8, 1323; Thornton and Ning 1998, Powder Technol. 99, 154. The
    /// number is that of the integral of the law above.
    #[must_use]
    pub fn snap_loss(&self) -> f64 {
        let ratio = self.work.powi(5) * self.radius.powi(4) / (self.modulus * self.modulus);
        7.09 * ratio.cbrt()
    }

    /// Speed below which an elastic sphere of `mass` stays on the wall: its motion is what the contact loses, $\tfrac12 m V_s^2$.
    /// Of a sphere $1.84\ (w/R)^{5/6} / (\rho^3 E^{\ast 2})^{1/6}$.
    ///
    /// ```
    /// use impactlaw::material::adhesion::Jkr;
    /// let unit = Jkr { radius: 1.0, modulus: 1.0, work: 1e-5 };
    /// let speed = unit.sticking_speed(4.0 / 3.0 * std::f64::consts::PI);
    /// assert!((speed / (1.84 * 1e-5f64.powf(5.0 / 6.0)) - 1.0).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn sticking_speed(&self, mass: f64) -> f64 {
        (2.0 * self.snap_loss() / mass).sqrt()
    }
}

/// One state of Maugis' contact in his units: a over $(\pi w R^2/K)^{1/3}$, F over $\pi w R$, $\delta$ over $(\pi^2 w^2 R/K^2)^{1/3}$ with
/// $K = \tfrac43 E^\ast$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaugisState {
    /// Contact radius.
    pub radius: f64,
    /// Force.
    pub force: f64,
    /// Approach.
    pub approach: f64,
}

/// State of a contact with the Maugis number `lambda` of which the ring of attraction reaches to `ratio` (c/a > 1) times its radius.
///
/// $$ \tfrac{\lambda a^2}{2} \left[s + (m^2-2) \theta\right] + \tfrac{4 \lambda^2 a}{3} \left[s \theta - m + 1\right] = 1 $$
/// $$ F = a^3 - \lambda a^2 \left[s + m^2 \theta\right], \qquad \delta = a^2 - \tfrac43 \lambda a s $$
///
/// with m the ratio, $s = \sqrt{m^2-1}$ and $\theta$ the angle of the tangent s.
///
/// Source: Maugis 1992, J. Colloid Interface Sci. 150, 243; equations from memory, held to both limits by a test.
#[must_use]
pub fn maugis(lambda: f64, ratio: f64) -> MaugisState {
    let side = (ratio * ratio - 1.0).sqrt();
    let angle = side.atan();
    let square = 0.5 * lambda * (side + (ratio * ratio - 2.0) * angle);
    let linear = 4.0 / 3.0 * lambda * lambda * (side * angle - ratio + 1.0);
    let a = 2.0 / (linear + (linear * linear + 4.0 * square).sqrt());
    MaugisState {
        radius: a,
        force: a.powi(3) - lambda * a * a * (side + ratio * ratio * angle),
        approach: a * a - 4.0 / 3.0 * lambda * a * side,
    }
}

/// Largest pull of a sphere over $\pi w R$ after Maugis: from 2 at $\lambda = 0$ to 1.5 at large $\lambda$.
///
/// ```
/// use impactlaw::material::adhesion::maugis_pull_off;
/// assert!((maugis_pull_off(50.0) - 1.5).abs() < 1e-3);
/// assert!((maugis_pull_off(0.01) - 2.0).abs() < 0.01);
/// ```
#[must_use]
pub fn maugis_pull_off(lambda: f64) -> f64 {
    // the ring's width over the contact's radius, in steps of 0.4 %
    let all = (0..7000).map(|k| 1.0 + 1e-6 * (0.004 * f64::from(k)).exp());
    all.map(|ratio| -maugis(lambda, ratio).force)
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maugis_contact_is_jkr_s_where_the_range_is_short() {
        // in his units JKR is F = a^3 - sqrt(6 a^3), delta = a^2 - 2/3 sqrt(6 a)
        for ratio in [1.000_02, 1.000_1, 1.000_3] {
            let MaugisState {
                radius: a,
                force,
                approach,
            } = maugis(60.0, ratio);
            let jkr = a.powi(3) - (6.0 * a.powi(3)).sqrt();
            assert!(
                (force - jkr).abs() < 0.01 * (1.0 + jkr.abs()),
                "{a} {force} {jkr}"
            );
            let jkr = a * a - 2.0 / 3.0 * (6.0 * a).sqrt();
            assert!(
                (approach - jkr).abs() < 0.01 * (1.0 + jkr.abs()),
                "{a} {approach} {jkr}"
            );
        }
    }

    #[test]
    fn jkr_loses_the_work_of_pulling_it_from_no_approach_to_where_it_breaks() {
        let sphere = Jkr {
            radius: 1.0,
            modulus: 1.0,
            work: 1.0,
        };
        // approach is 0 at a^3 = 2 pi w R^2/E*, and stationary at a^3 = pi w R^2/(8 E*)
        let (from, to) = ((2.0 * PI).cbrt(), (PI / 8.0).cbrt());
        let steps = 20_000;
        let a = |k: usize| from + (to - from) * k as f64 / steps as f64;
        let work: f64 = (0..steps)
            .map(|k| {
                let pull = 0.5 * (sphere.force(a(k)) + sphere.force(a(k + 1)));
                pull * (sphere.approach(a(k + 1)) - sphere.approach(a(k)))
            })
            .sum();
        assert!((work / sphere.snap_loss() - 1.0).abs() < 1e-3, "{work}");
    }

    #[test]
    fn the_zone_shrinks_with_the_square_of_maugis_number() {
        // d = 0.998 / lambda^2 (w R^2/E*)^(1/3)
        for lambda in [0.5, 2.0, 8.0] {
            let range = Dugdale::range_at(lambda, 1e-4, 1.0, 1.1);
            let zone = Dugdale { work: 1e-4, range }.zone(1.1);
            let unit = (1e-4f64 / 1.1).cbrt();
            assert!((zone / unit * lambda * lambda - 0.998).abs() < 1e-3);
        }
    }
}
