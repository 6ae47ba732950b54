//! Rebound of a body from a rigid plane: the 1-D impact $m \ddot\delta = -F$ of any normal law.
//!
//! A rate-independent law does a work that depends on the path alone, so nothing is stepped in time. With $x = \delta/R$,
//! $W = \int \varphi\ dx$ and $E_0 = \tfrac12 m V^2 / R^3$ the turning point solves $W(x_m) = E_0$. Seen from the
//! turning point, a branch of length L is run through by
//!
//! $$ x = x_m - L \sin^2\theta, \quad \frac{dE}{d\theta} = 2 L \varphi \sin\theta \cos\theta, \quad
//!    \frac{dt}{d\theta} = \sqrt{\frac{m}{2R}}\ \frac{2 L \sin\theta \cos\theta}{\sqrt{E}}, $$
//!
//! E being the kinetic energy over $R^3$. The angle takes away the square-root singularity of the time at the
//! turning point and the fractional power of Hertz at the end of contact; panels are halved around corners and
//! jumps.
//!
//! An [`Inertia`] term on first loading adds $\frac{dm_a}{d\delta}\dot\delta^2$, so that there $dE/dx = -\varphi -
//! \mu' E$ with $\mu = 2m_a/m$. The integrating factor $M = e^\mu$ makes that $d(ME)/dx = -M\varphi$: the same
//! integrals with $M\varphi$ in place of $\varphi$, exact as before.

use super::NormalLaw;
use super::inertia::Inertia;
use super::panel::{Integrand, Totals, accumulate};
use std::f64::consts::FRAC_PI_2;

/// Iterations of any search: bisection of a `f64` interval ends well before.
const MAX_SEARCH: usize = 100;
/// Flattening the search for the turning point starts from.
const FIRST_FLATTENING: f64 = 1e-3;
/// Width in the angle to which the largest force is searched: the force is flat there, so its error is of second order.
const CREST_WIDTH: f64 = 1e-6;
/// Relative mismatch of work and incident energy at the turning point that counts as rounding.
const ENERGY_ROUNDING: f64 = 4e-15;

/// Figures of a 1-D impact, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rebound {
    /// Coefficient of restitution e, rebound speed over impact speed.
    pub restitution: f64,
    /// Largest force F*, N.
    pub max_force: f64,
    /// Largest displacement delta*, m.
    pub max_displacement: f64,
    /// Displacement at which contact is lost, m.
    pub residual_displacement: f64,
    /// First touch to loss of contact, s.
    pub contact_time: f64,
}

/// State of the body at one instant of an impact, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Time since first touch, s.
    pub time: f64,
    /// Displacement delta, m.
    pub displacement: f64,
    /// Rate of approach, m/s; negative on the way back.
    pub velocity: f64,
    /// Force F, N.
    pub force: f64,
}

/// Impact of a body of `radius` (m) and `mass` (kg) on a rigid plane at speed `velocity` (m/s).
///
/// The law must be rate-independent but for its inertia, and its virgin loading a function of $x$ alone. Accurate to about 1e-11
/// relative where branches are smooth, jumps included; a turning point inside a downward jump is taken at the jump.
/// Every figure is NaN if an argument is not positive and finite, or if the law cannot stop the body.
///
/// ```
/// use impactlaw::contact::rebound::rebound;
/// use impactlaw::theory::hertz::Hertz;
/// let hit = rebound(&Hertz::new(1e11), 1e-3, 1e-5, 1.0);
/// assert!((hit.restitution - 1.0).abs() < 1e-12);
/// assert!((hit.contact_time * 1.0 / hit.max_displacement - 2.94328).abs() < 1e-5);
/// ```
#[must_use]
pub fn rebound<L: NormalLaw>(law: &L, radius: f64, mass: f64, velocity: f64) -> Rebound {
    Impact::new(law, radius, mass, velocity).map_or(Rebound::UNDEFINED, |impact| impact.run(|_| ()))
}

/// Path of the same impact from first touch to loss of contact, in order of time; empty where [`rebound`] is
/// undefined.
///
/// Points are the ends of the integration panels: at least 8 a branch, dense around corners of the law.
#[must_use]
pub fn trajectory<L: NormalLaw>(law: &L, radius: f64, mass: f64, velocity: f64) -> Vec<State> {
    let mut states = Vec::new();
    if let Some(impact) = Impact::new(law, radius, mass, velocity) {
        impact.run(|state| states.push(state));
        states.sort_by(|a, b| a.time.total_cmp(&b.time));
        let touch = states.first().map_or(0.0, |state: &State| state.time);
        states.iter_mut().for_each(|state| state.time -= touch);
    }
    states
}

impl Rebound {
    const UNDEFINED: Rebound = Rebound {
        restitution: f64::NAN,
        max_force: f64::NAN,
        max_displacement: f64::NAN,
        residual_displacement: f64::NAN,
        contact_time: f64::NAN,
    };
}

/// Reduced force on first loading: that of a virgin contact pressed to `x` at once.
fn loading<L: NormalLaw>(law: &L, x: f64) -> f64 {
    law.force(x, &mut L::History::default())
}

/// First loading of a body: the law's force with what inertia makes of it.
struct Press<'a, L> {
    law: &'a L,
    inertia: Inertia,
    /// $2R^3/m$, m3/kg: squared rate from kinetic energy over $R^3$, and $\mu$ from the reduced added mass.
    per_mass: f64,
}

impl<'a, L: NormalLaw> Press<'a, L> {
    fn new(law: &'a L, radius: f64, mass: f64) -> Self {
        Self {
            law,
            inertia: law.inertia(),
            per_mass: 2.0 * radius.powi(3) / mass,
        }
    }

    /// Integrating factor M at flattening `x`.
    fn factor(&self, x: f64) -> f64 {
        if self.inertia.is_none() {
            return 1.0;
        }
        (self.per_mass * self.inertia.mass(x)).exp()
    }

    /// $M\varphi$.
    fn weighted(&self, x: f64) -> f64 {
        self.factor(x) * loading(self.law, x)
    }

    /// Reduced force with inertia at kinetic energy `kinetic` over $R^3$.
    fn force(&self, x: f64, kinetic: f64) -> f64 {
        let squared_rate = self.per_mass * kinetic;
        loading(self.law, x) + self.inertia.force(x, squared_rate)
    }
}

/// One branch, seen from the turning point.
struct Branch<F, M> {
    /// Reduced force at a flattening, times the factor.
    force: F,
    /// Integrating factor at a flattening.
    factor: M,
    /// Flattening at the turning point.
    turn: f64,
    /// Length of the branch in flattening.
    length: f64,
}

/// Factor of a branch without inertia.
fn unity(_: f64) -> f64 {
    1.0
}

impl<F: Fn(f64) -> f64, M: Fn(f64) -> f64> Branch<F, M> {
    fn flattening(&self, theta: f64) -> f64 {
        self.turn - self.length + self.length * theta.cos().powi(2)
    }

    fn run(&self, observe: impl FnMut(f64, Totals)) -> Totals {
        self.run_to(FRAC_PI_2, observe)
    }

    /// From the turning point to an angle.
    fn run_to(&self, theta: f64, observe: impl FnMut(f64, Totals)) -> Totals {
        let work = (self.force)(self.turn) * self.length;
        let time = self.length / work.sqrt();
        accumulate(self, (0.0, theta), Totals { work, time }, observe)
    }
}

impl<F: Fn(f64) -> f64, M: Fn(f64) -> f64> Integrand for Branch<F, M> {
    fn work_rate(&self, theta: f64) -> f64 {
        (self.force)(self.flattening(theta)) * self.length * (2.0 * theta).sin()
    }

    fn time_rate(&self, theta: f64, work: f64) -> f64 {
        let kinetic = work / (self.factor)(self.flattening(theta));
        self.length * (2.0 * theta).sin() / kinetic.sqrt()
    }
}

/// Stretch of first loading between two flattenings; only its work is wanted.
struct Stretch<F>(F);

impl<F: Fn(f64) -> f64> Integrand for Stretch<F> {
    fn work_rate(&self, x: f64) -> f64 {
        (self.0)(x)
    }

    fn time_rate(&self, _: f64, _: f64) -> f64 {
        0.0
    }
}

/// An impact whose turning point is known.
struct Impact<'a, L: NormalLaw> {
    law: &'a L,
    radius: f64,
    mass: f64,
    turn: f64,
}

impl<'a, L: NormalLaw> Impact<'a, L> {
    fn new(law: &'a L, radius: f64, mass: f64, velocity: f64) -> Option<Self> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if ![radius, mass, velocity].into_iter().all(positive) {
            return None;
        }
        let energy = 0.5 * mass * velocity * velocity / radius.powi(3);
        Some(Self {
            law,
            radius,
            mass,
            turn: turning_point(&Press::new(law, radius, mass), energy)?,
        })
    }

    /// Both branches, from the turning point out; `observe` gets states whose time counts from the turning point.
    fn run(&self, mut observe: impl FnMut(State)) -> Rebound {
        let mut history = L::History::default();
        let peak = self.law.force(self.turn, &mut history);
        let release = |x: f64| self.law.force(x, &mut history.clone());
        let residual = loss_of_contact(release, self.turn);
        let body = Press::new(self.law, self.radius, self.mass);
        let press = Branch {
            force: |x| body.weighted(x),
            factor: |x| body.factor(x),
            turn: self.turn,
            length: self.turn,
        };
        let spring_back = Branch {
            force: release,
            factor: unity,
            turn: self.turn,
            length: self.turn - residual,
        };
        let mut max_force = peak;
        let before = press.run(|theta, left| {
            let x = press.flattening(theta);
            let kinetic = left.work / body.factor(x);
            let force = body.force(x, kinetic);
            max_force = max_force.max(force);
            observe(self.state(-left.time, x, kinetic, force));
        });
        if max_force > peak && !body.inertia.is_none() {
            max_force = max_force.max(crest(&press, &body));
        }
        observe(self.state(0.0, self.turn, 0.0, peak));
        let after = spring_back.run(|theta, so_far| {
            let x = spring_back.flattening(theta);
            let state = self.state(so_far.time, x, so_far.work, release(x));
            observe(State {
                velocity: -state.velocity,
                ..state
            });
        });
        Rebound {
            restitution: (after.work / before.work).sqrt(),
            max_force: max_force * self.radius * self.radius,
            max_displacement: self.turn * self.radius,
            residual_displacement: residual * self.radius,
            contact_time: (before.time + after.time) * self.time_unit(),
        }
    }

    /// Seconds in the unit of time of the branches.
    fn time_unit(&self) -> f64 {
        (self.mass / (2.0 * self.radius)).sqrt()
    }

    /// State in SI units from the reduced ones; `kinetic` is the kinetic energy over $R^3$.
    fn state(&self, time: f64, x: f64, kinetic: f64, force: f64) -> State {
        State {
            time: time * self.time_unit(),
            displacement: x * self.radius,
            velocity: kinetic.max(0.0).sqrt() * (2.0 * self.radius.powi(3) / self.mass).sqrt(),
            force: force * self.radius * self.radius,
        }
    }
}

/// Largest force of a loading whose inertia lifts it above that at the turning point: golden section over the branch.
fn crest<L: NormalLaw, F: Fn(f64) -> f64, M: Fn(f64) -> f64>(
    press: &Branch<F, M>,
    body: &Press<'_, L>,
) -> f64 {
    let force = |theta: f64| {
        let x = press.flattening(theta);
        let work = press.run_to(theta, |_, _| ()).work;
        body.force(x, work / body.factor(x))
    };
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut from, mut to) = (0.0, FRAC_PI_2);
    let mut inner = [to - golden * (to - from), from + golden * (to - from)];
    let mut value = inner.map(force);
    while to - from > CREST_WIDTH {
        if value[0] < value[1] {
            from = inner[0];
            inner = [inner[1], from + golden * (to - from)];
            value = [value[1], force(inner[1])];
        } else {
            to = inner[1];
            inner = [to - golden * (to - from), inner[0]];
            value = [force(inner[0]), value[0]];
        }
    }
    value[0].max(value[1])
}

/// Flattening at which the loading work over $R^3$ equals `energy` (Pa): Newton's method, kept in a bracket.
fn turning_point<L: NormalLaw>(body: &Press<'_, L>, energy: f64) -> Option<f64> {
    let stretch = Stretch(|x| body.weighted(x));
    let scale = Totals {
        work: energy,
        time: 1.0,
    };
    let mut x = first_guess(body.law, energy);
    let branch = Branch {
        force: |x| body.weighted(x),
        factor: |x| body.factor(x),
        turn: x,
        length: x,
    };
    let mut work = branch.run(|_, _| ()).work;
    let (mut low, mut high) = (0.0, f64::INFINITY);
    for _ in 0..MAX_SEARCH {
        if !work.is_finite() || !x.is_finite() {
            return None;
        }
        if (work - energy).abs() <= ENERGY_ROUNDING * energy {
            return Some(x);
        }
        if work < energy {
            low = x;
        } else {
            high = x;
        }
        let newton = x + (energy - work) / body.weighted(x);
        let next = if newton > low && newton < high {
            newton
        } else if high.is_finite() {
            0.5 * (low + high)
        } else {
            2.0 * x
        };
        if next == x || (high - low) <= f64::EPSILON * low {
            return Some(x);
        }
        work += accumulate(&stretch, (x, next), scale, |_, _| ()).work;
        x = next;
    }
    None
}

/// Flattening with $\tfrac25 x \varphi(x)$ near `energy`: exact for Hertz, within a few tens of per cent for
/// others.
fn first_guess<L: NormalLaw>(law: &L, energy: f64) -> f64 {
    let mut x = FIRST_FLATTENING;
    for _ in 0..MAX_SEARCH {
        let ratio = energy / (0.4 * x * loading(law, x));
        let factor = ratio.powf(0.4).clamp(1e-3, 1e3);
        x *= factor;
        if (factor - 1.0).abs() < 0.05 {
            break;
        }
    }
    x
}

/// Largest flattening below `turn` at which the unloading force has vanished, by bisection; 0 if it never does.
fn loss_of_contact(force: impl Fn(f64) -> f64, turn: f64) -> f64 {
    let (mut lost, mut held) = (0.0, turn);
    for _ in 0..MAX_SEARCH {
        let middle = 0.5 * (lost + held);
        if middle <= lost || middle >= held {
            break;
        }
        if force(middle) > 0.0 {
            held = middle;
        } else {
            lost = middle;
        }
    }
    lost
}
