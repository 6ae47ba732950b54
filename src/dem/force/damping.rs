//! Damping: a viscous force beside the normal law, for the vibration a particle keeps and DEM does not resolve.

use super::effects::{Contact, Effect, Named};
use super::losses::Losses;
use crate::contact::pair::Pressed;
use crate::material::Material;
use parry3d::math::Vector;

/// Dashpot that gives an elastic contact of any law the restitution e, at every speed.
///
/// $$ F_d = 2 \zeta \sqrt{m^\ast}\ \frac{F}{\sqrt{2 U}}\ \dot\delta, \qquad \frac{F^2}{2 U} = \frac12 \left(\frac{dF}{d\delta} + \frac{F}{z}\right) $$
///
/// $$ e = \exp\left(-\frac{2 \zeta \arccos \zeta}{\sqrt{1 - \zeta^2}}\right), \qquad \zeta > 1: \quad
///    e = \exp\left(-\frac{2 \zeta\ \mathrm{arcosh}\ \zeta}{\sqrt{\zeta^2 - 1}}\right) $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e | 1 | restitution of the elastic contact |
/// | ζ | 1 | damping ratio, from e once ([`damping_ratio`]) |
/// | m* | kg | effective mass |
/// | F | N | force of the normal law |
/// | U | J | energy it has stored |
/// | z | m | flattening since the force was zero on the present branch; first loading: the overlap |
///
/// With $q = \sqrt{2U}$ and the clock $d\tau = F\ dt/(q \sqrt{m^\ast})$ an impact on any elastic law is $q'' + 2 \zeta q' + q = 0$,
/// one damped oscillator. It ends when the whole force has fallen to zero, before the overlap has: a contact never pulls, and
/// what is left of the overlap opens freely. Up to there the oscillator has a closed form, which is the e above.
///
/// U is that of the power of z that has the force and the slope of the law: exact for Hertz's law, for springs and for the
/// unloading branches of every law here. For Hertz the dashpot is Tsuji's.
///
/// **A law that yields** loses energy of its own besides. Asked for is the restitution of the dashpot alone: what the contact
/// would show within its elastic range. Where loading and unloading are powers of z, the work of loading and what unloading
/// gives back are each an oscillator that turns at rest, and the restitution is e times that of the law.
///
/// Sources: Tsuji, Tanaka, Ishida 1992 (form); Antypov, Elliott 2011 (the map onto an oscillator); Schwager, Pöschel 2007 (the
/// end without a pull).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous {
    /// $\sqrt2\ \zeta$.
    normal: f64,
    /// $2 \sqrt{5/6}\ \min(\zeta, 1)$, for springs across the normal: as stiff as Hertz's contact to within a factor near one,
    /// and damped beyond the critical they would only creep.
    across: f64,
}

/// Halvings after which an interval of `f64` does not shrink any more.
const MOST_HALVINGS: usize = 100;

/// Damping ratio ζ of an impact of `restitution` e, 0 < e <= 1, that never pulls.
#[must_use]
pub fn damping_ratio(restitution: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let asked = -restitution.ln();
    // 2 zeta arcosh(zeta)/sqrt(zeta^2 - 1) is above 2 ln zeta
    let (mut low, mut high) = (0.0, 1.0 + (0.5 * asked).exp());
    for _ in 0..MOST_HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if decrement(middle) < asked {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// $-\ln e$ of an impact with damping `ratio` ζ.
fn decrement(ratio: f64) -> f64 {
    let root = ((1.0 - ratio) * (1.0 + ratio)).abs().sqrt();
    if root == 0.0 {
        return 2.0;
    }
    // from the root, for the inverse cosines of a number near 1 lose half their digits
    let angle = if ratio < 1.0 {
        root.atan2(ratio)
    } else {
        root.asinh()
    };
    2.0 * ratio * angle / root
}

/// What the dashpot is multiplied by in the step in which the force sets in, 1 in all others; `travel` is the approach of a step
/// (m).
///
/// The force of a step stands for the time from half a step before to half a step after it. In the first, of which a part
/// $\theta$ is past, there was none before, and the dashpot grows like $t^p$, $p = \tfrac12 (d\ln F/d\ln z - 1)$: all at once under a
/// spring. Its impulse is $(\theta + \tfrac12)^{p+1}/(p+1)$ instead of $\theta^p$; left as it is, twenty steps a contact would miss
/// a restitution of 0.3 by 3 % under Hertz, and by 7 % under a spring.
#[inline(always)]
fn onset(law: &Pressed, secant: f64, travel: f64) -> f64 {
    if law.depth > travel {
        return 1.0;
    }
    let past = law.depth / travel;
    let power = 0.5 * (law.stiffness / secant + 1.0);
    (past + 0.5).powf(power) / (power * past.powf(power - 1.0))
}

impl Viscous {
    /// Dashpot of `restitution` e, 0 < e <= 1.
    #[must_use]
    pub fn new(restitution: f64) -> Self {
        let ratio = damping_ratio(restitution);
        Self {
            normal: 2f64.sqrt() * ratio,
            across: 2.0 * (5.0f64 / 6.0).sqrt() * ratio.min(1.0),
        }
    }
}

impl Named for Viscous {
    const MUST: &'static str = "must lie in (0, 1]";
    const WITHOUT: &'static str = "no damping";
    const NEEDS: Option<(&'static str, &'static str)> = None;

    fn allows(restitution: f64) -> bool {
        restitution > 0.0 && restitution <= 1.0
    }

    fn of(restitution: f64, _: &Material) -> Self {
        Self::new(restitution)
    }

    fn between(restitution: f64, _: [Option<&Material>; 2]) -> Self {
        Self::new(restitution)
    }
}

impl Effect for Viscous {
    /// What the dashpot adds to the normal force, N.
    type Memory = f64;
    const ACROSS: bool = false;
    const MOMENT: bool = false;

    /// The velocity is that of half a step before; the dashpot acts on that of the whole step, which its own force and the law's
    /// change: solved for at once, it is of second order and stable for any ratio.
    #[inline(always)]
    fn act(&self, contact: &mut Contact, dashpot: &mut f64, losses: &mut Losses) {
        let (m, law) = (contact.meeting, &contact.pressed);
        let before = *dashpot;
        *dashpot = 0.0;
        if contact.normal_force > 0.0 {
            let secant = law.force / law.depth;
            let viscous = self.normal
                * (m.mass * (law.stiffness + secant)).sqrt()
                * onset(law, secant, contact.approach * m.dt);
            let inertia = 2.0 * m.mass;
            let whole = contact.normal_force + viscous * contact.approach;
            let whole = (whole * inertia / (inertia + m.dt * viscous)).max(0.0);
            *dashpot = whole - contact.normal_force;
            contact.normal_force = whole;
        }
        contact.dashpot = self.across;
        losses.damping += 0.5 * m.dt * (before + *dashpot) * contact.approach;
    }

    #[inline(always)]
    fn moment(_: &f64) -> Vector {
        Vector::ZERO
    }

    #[inline(always)]
    fn stored(_: &f64) -> f64 {
        0.0
    }

    fn soften(&mut self, _: f64) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oscillator $q'' + 2 \zeta q' + q = 0$ up to where $q''$ is zero, by the classical Runge-Kutta method.
    fn restitution(ratio: f64) -> f64 {
        let slope = |[q, u]: [f64; 2]| [u, -(q + 2.0 * ratio * u)];
        let along = |[q, u]: [f64; 2], [a, b]: [f64; 2], h: f64| [q + h * a, u + h * b];
        let (h, mut state) = (1e-4, [0.0, 1.0]);
        loop {
            let a = slope(state);
            let b = slope(along(state, a, 0.5 * h));
            let c = slope(along(state, b, 0.5 * h));
            let d = slope(along(state, c, h));
            let mean = [0, 1].map(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0);
            state = along(state, mean, h);
            if state[1] < 0.0 && slope(state)[1] >= 0.0 {
                return -state[1];
            }
        }
    }

    #[test]
    fn the_damping_ratio_is_that_of_the_oscillator_that_never_pulls() {
        for e in [0.05, 0.1, 0.135, (-2f64).exp(), 0.3, 0.5, 0.8, 0.95, 0.99] {
            let found = restitution(damping_ratio(e));
            assert!((found / e - 1.0).abs() < 1e-6, "{e}: {found}");
        }
        assert_eq!(damping_ratio(1.0), 0.0);
        assert!((damping_ratio((-2f64).exp()) - 1.0).abs() < 1e-12);
    }
}
