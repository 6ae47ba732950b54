//! Unloading branch of the fitted law: how much flattening stays, and how curved the way back is.

use super::admissible::Inadmissible;

/// Unloading after a largest flattening $w_m$, which is $x_m = \delta_m/R$:
///
/// $$ F = F_m \left(\frac{\delta - \delta_r}{\delta_m - \delta_r}\right)^n, \quad
///    \rho = \frac{\delta_r}{\delta_m} = 1 - \left(1 + \frac{w_m - w_1}{c}\right)^{-k}, \quad
///    n = \tfrac32 + n_1 \rho + n_2 (x_m - x_1) $$
///
/// | symbol | field | unit | meaning |
/// |---|---|---|---|
/// | $w_m$ | | 1 | largest flattening over $\delta_y$ |
/// | $w_1$, $x_1$ | | 1 | flattening at which the loading curve leaves Hertz's, over $\delta_y$ and over R |
/// | $c$ | `residual_scale` | 1 | flattening past $w_1$ on which the residual grows |
/// | $k$ | `residual_power` | 1 | how fast the recovered part $1-\rho$ falls |
/// | $n_1$ | `exponent_residual` | 1 | change of the exponent with the residual |
/// | $n_2$ | `exponent_strain` | 1 | growth of the exponent with the flattening over R |
///
/// At $w_m = w_1$ the branch is Hertz's ($\rho = 0$, $n = 3/2$). The form of $\rho$ is that of Jackson, Green and
/// Marghitu 2010 without their factor 1.02, which would leave a residual in elastic contact. The form of $n$ is seen
/// on simulated impacts: $n = F^\ast(\delta^\ast - \delta_r)/(e^2 W_i) - 1$ lies on straight lines over $\delta^\ast/R$ with slopes
/// 8 ($E/Y = 80$, $\delta^\ast/R$ 0.016 to 0.07) and 7.3 ($E/Y = 613$, 0.02 to 0.125) that start a little below 3/2.
///
/// Two branches never cross, a later one lying below an earlier one, if the initial exponent
/// $N = n/(1-\rho)$ of the branch does not fall as $w_m$ grows and is not less than the exponent of the loading
/// curve. With $n_2 \ge 0$ that holds for $n_1 \ge -\tfrac32$, because
/// $(1-\rho)^2 dN/dw_m = \rho'(n + n_1(1-\rho)) + (1-\rho) n_2 x'$ and $n + n_1(1-\rho) \ge \tfrac32 + n_1$.
/// It follows that no loading cycle, however small, yields energy. The law asks for a little more,
/// $n_1 \ge -\tfrac12$: then $n \ge 1$, and the stiffness stays finite where contact is lost.
///
/// # Example
/// ```
/// use impactlaw::contact::unloading::Unloading;
/// let u = Unloading::new(6.9, 0.54, -0.1, 8.0)?;
/// let yield_flattening = 1e-3;
/// assert_eq!(u.branch(1.0, 1.0, yield_flattening), (0.0, 1.5)); // elastic
/// let (rho, n) = u.branch(7.9, 1.0, yield_flattening); // w_m - w_1 = c
/// assert!((rho - (1.0 - 2f64.powf(-0.54))).abs() < 1e-15);
/// assert!((n - (1.5 - 0.1 * rho + 8.0 * 6.9e-3)).abs() < 1e-15);
/// # Ok::<(), impactlaw::contact::admissible::Inadmissible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unloading {
    residual_scale: f64,
    residual_power: f64,
    exponent_residual: f64,
    exponent_strain: f64,
}

/// Lower end of `exponent_residual`.
pub const EXPONENT_LIMIT: f64 = -0.5;

impl Unloading {
    /// Branches with $c, k, n_1, n_2$ in this order.
    ///
    /// # Errors
    /// [`Inadmissible`] unless $c > 0$, $k > 0$, $n_1 \ge -1/2$, $n_2 \ge 0$, all finite.
    pub fn new(
        residual_scale: f64,
        residual_power: f64,
        exponent_residual: f64,
        exponent_strain: f64,
    ) -> Result<Self, Inadmissible> {
        let check = |holds: bool, key: &str, x: f64, allowed| {
            Inadmissible::unless(holds && x.is_finite(), key, x, allowed)
        };
        let (c, k) = (residual_scale, residual_power);
        let above_zero = "must be finite and above 0";
        check(c > 0.0, "residual_scale", c, above_zero)?;
        check(k > 0.0, "residual_power", k, above_zero)?;
        check(
            exponent_residual >= EXPONENT_LIMIT,
            "exponent_residual",
            exponent_residual,
            "must be finite and at least -1/2, or the stiffness would be infinite at loss of contact",
        )?;
        check(
            exponent_strain >= 0.0,
            "exponent_strain",
            exponent_strain,
            "must be finite and not negative, or unloading branches would cross",
        )?;
        Ok(Unloading {
            residual_scale,
            residual_power,
            exponent_residual,
            exponent_strain,
        })
    }

    /// The constants $c, k, n_1, n_2$.
    #[must_use]
    pub fn constants(&self) -> [f64; 4] {
        [
            self.residual_scale,
            self.residual_power,
            self.exponent_residual,
            self.exponent_strain,
        ]
    }

    /// Residual ratio $\rho$ and exponent $n$ of the branch that leaves the loading curve at `w_m`, for a curve
    /// that departs from Hertz's at `w_1`; `yield_flattening` is $\delta_y/R$.
    #[inline]
    #[must_use]
    pub fn branch(&self, w_m: f64, w_1: f64, yield_flattening: f64) -> (f64, f64) {
        let past = (w_m - w_1).max(0.0);
        let rho = 1.0 - (1.0 + past / self.residual_scale).powf(-self.residual_power);
        let strain = past * yield_flattening;
        (
            rho,
            1.5 + self.exponent_residual * rho + self.exponent_strain * strain,
        )
    }
}
