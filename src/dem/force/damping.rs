//! Damping: a viscous force beside the normal law, for the vibration a particle keeps and DEM does not resolve.

use super::edge::weight;
use super::effects::{Contact, Effect, Named};
use super::losses::Losses;
use crate::document::keys::{Line, key};
use crate::material::Material;
use crate::tape::keep_fields;
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

/// Steps a contact that are enough for the `restitution` e within 1 %, wherever in a step bodies touch; `power` is p of the
/// law's first loading $F \propto \delta^p$.
///
/// The error falls with the square of the step. It grows as e falls, for then little is left of the approach, and is largest under
/// a spring, whose dashpot sets in at once: the part of the first step that is past has slowed the approach already, and the
/// overlap does not know. Measured over all parts of a step, twenty steps miss 0.05 by 3.2 % under Hertz and by 11 % under a spring,
/// 0.2 by 0.6 and 2.4 %.
#[must_use]
pub fn steps_for(restitution: f64, power: f64) -> f64 {
    let (from, steeper) = match power < 1.4 {
        true => (0.5, 0.6),
        false => (0.2, 0.45),
    };
    USUAL_STEPS * (from / restitution).powf(steeper).max(1.0)
}

/// Steps a contact of usual DEM practice.
pub const USUAL_STEPS: f64 = 20.0;

/// Share of the last step's change in what others do to the approach that is taken for true at once. All of it would halve the
/// damping a packing bears before it turns unstable.
const SHARE_OF_OTHERS: f64 = 0.25;

/// What a contact remembers of its dashpot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dashpot {
    /// What it adds to the normal force, N.
    pub force: f64,
    /// What everything else, other contacts and gravity, adds to the approach in half a step, less the share of the next
    /// step's approach in it, m/s.
    others: f64,
}
keep_fields!(Dashpot: force, others);

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
    const LINE: Line = key(
        "restitution of elastic contacts, by viscous damping: had within 1 % at every speed; a law that yields loses more",
        "(0, 1]",
        "0.8",
    );
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
    type Memory = Dashpot;
    const ACROSS: bool = false;
    const MOMENT: bool = false;

    /// The velocity is that of half a step before; the dashpot acts on that of the whole step. Its own force and the law's change
    /// it, solved for at once, and so does everything else that pushes the bodies, taken from how the approach has changed: at rest
    /// the two cancel, and the law alone carries the load.
    #[inline(always)]
    fn act(&self, contact: &mut Contact, dashpot: &mut Dashpot, losses: &mut Losses) {
        let (m, law, approach) = (contact.meeting, &contact.pressed, contact.approach);
        let before = dashpot.force;
        if m.overlap > 0.0 {
            let others = match contact.before.touches() {
                true => dashpot.others + 0.5 * SHARE_OF_OTHERS * approach,
                false => 0.0,
            };
            let law_force = contact.normal_force;
            if law_force > 0.0 {
                // per mass, so that one division serves all
                let stiffness = law.stiffness + law.force / law.depth;
                let mut rate = self.normal * (stiffness * m.inverse_mass).sqrt();
                if contact.edge <= 1.0 {
                    // F/sqrt(2 U) grows like t^p from the first touch, or falls like it to the last
                    let power = 0.5 * (law.stiffness * law.depth / law.force - 1.0);
                    rate *= weight(power, contact.edge);
                }
                let whole = law_force * m.inverse_mass + rate * (approach + others);
                let whole = whole / (m.inverse_mass * (1.0 + 0.5 * m.dt * rate));
                contact.normal_force = whole.max(0.0);
            }
            let alone = approach - m.dt * m.inverse_mass * contact.normal_force;
            *dashpot = Dashpot {
                force: contact.normal_force - law_force,
                others: (1.0 - SHARE_OF_OTHERS) * others - 0.5 * SHARE_OF_OTHERS * alone,
            };
        } else {
            *dashpot = Dashpot::default();
        }
        contact.dashpot = self.across;
        losses.damping += 0.5 * m.dt * (before + dashpot.force) * approach;
    }

    #[inline(always)]
    fn moment(_: &Dashpot) -> Vector {
        Vector::ZERO
    }

    #[inline(always)]
    fn stored(_: &Dashpot) -> f64 {
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
