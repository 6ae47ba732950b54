//! Inertia of a flattening: the force it takes to stop the material that a growing contact meets.

use super::admissible::Inadmissible;

/// Inertia term of a law: an added mass $m_a$ that comes to rest on the wall as the contact grows.
///
/// $$ F_i = \frac{dm_a}{d\delta}\ \dot\delta^2 = \kappa \rho\ \dot\delta^2 \sqrt{R^3 (\delta - \delta_1)}, \qquad
///    m_a = \tfrac23 \kappa \rho R^3 \left(\frac{\delta - \delta_1}{R}\right)^{3/2} $$
///
/// | symbol | field | unit | meaning |
/// |---|---|---|---|
/// | $\kappa$ | `coefficient` | 1 | size of the term; 0: none |
/// | $\rho$ | `density` | kg/m3 | density of the body |
/// | $\delta_1/R$ | `start` | 1 | flattening at which the body begins to yield |
/// | $\dot\delta$ | | m/s | rate of approach |
///
/// A contact of radius $a$ with $a^2 = 2R\delta$ (full plasticity) that holds up the mass $k\rho a^3$ gives
/// $\kappa = 3\sqrt2\ k$; a flat disc in an ideal fluid has $k = 4/3$ on one side (Lamb 1932, Hydrodynamics, art. 102),
/// hence $\kappa = 5.7$.
///
/// The term acts on first loading alone ($\dot\delta > 0$ and $\delta$ the largest so far) and opposes the motion, so it
/// only takes energy. It starts from zero at the departure from Hertz's curve: an elastic contact has none.
///
/// ```
/// use impactlaw::contact::inertia::Inertia;
/// let inertia = Inertia::new(9.0, 8000.0, 0.01)?;
/// assert_eq!(inertia.force(0.01, 100.0), 0.0);
/// // 9 * 8000 kg/m3 * (10 m/s)^2 * sqrt(0.04)
/// assert!((inertia.force(0.05, 100.0) / 1.44e6 - 1.0).abs() < 1e-14);
/// assert!((inertia.mass(0.05) / (2.0 / 3.0 * 9.0 * 8000.0 * 0.008) - 1.0).abs() < 1e-14);
/// # Ok::<(), impactlaw::contact::admissible::Inadmissible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    coefficient: f64,
    density: f64,
    start: f64,
}

impl Inertia {
    /// No term: the law does not depend on the rate.
    pub const NONE: Inertia = Inertia {
        coefficient: 0.0,
        density: 0.0,
        start: 0.0,
    };

    /// Term with $\kappa$ = `coefficient`, $\rho$ = `density` (kg/m3), $\delta_1/R$ = `start`.
    ///
    /// # Errors
    /// [`Inadmissible`] unless $\kappa \ge 0$, $\rho > 0$, $\delta_1 \ge 0$, all finite.
    pub fn new(coefficient: f64, density: f64, start: f64) -> Result<Self, Inadmissible> {
        let check = |holds: bool, key: &str, x: f64, allowed| {
            Inadmissible::unless(holds && x.is_finite(), key, x, allowed)
        };
        let not_negative = "must be finite and not negative, or loading would yield energy";
        check(coefficient >= 0.0, "inertia", coefficient, not_negative)?;
        check(
            density > 0.0,
            "density",
            density,
            "must be finite and above 0",
        )?;
        check(
            start >= 0.0,
            "start",
            start,
            "must be finite and not negative",
        )?;
        Ok(Inertia {
            coefficient,
            density,
            start,
        })
    }

    /// $\kappa$.
    #[must_use]
    pub fn coefficient(&self) -> f64 {
        self.coefficient
    }

    /// Is there no term?
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.coefficient == 0.0
    }

    /// Reduced force $F_i/R^2$ (Pa) on first loading at flattening `x`, for $\dot\delta^2$ = `squared_rate` (m2/s2).
    #[must_use]
    pub fn force(&self, x: f64, squared_rate: f64) -> f64 {
        self.coefficient * self.density * squared_rate * (x - self.start).max(0.0).sqrt()
    }

    /// Added mass $m_a/R^3$ (kg/m3) at flattening `x`.
    #[must_use]
    pub fn mass(&self, x: f64) -> f64 {
        let past = (x - self.start).max(0.0);
        self.coefficient * self.density * past * past.sqrt() / 1.5
    }
}
