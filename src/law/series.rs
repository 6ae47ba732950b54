//! Series: two flattening laws, one a body, as one law of the sphere that stands for both.

use super::FittedLaw;
use crate::contact::elastoplastic::Memory;
use crate::contact::pair::{Side, balance, in_series};
use crate::contact::{LawVisitor, NormalLaw};
use crate::tape::keep_fields;

/// Two flattening laws in series, in the units of the effective body ([`crate::material::Effective`]).
///
/// With $R_i'/R = 1 + E_i^\ast/E_j^\ast$ ([`crate::contact::pair`]) the radius of the pair drops out: side i has the reduced force
/// $(R_i'/R)^2 \varphi_i(x_i)$ where it takes $(R_i'/R)\ x_i$ of $x = \delta/R$. So the shortcut is a normal law like any other, and its
/// impact is that of the effective mass.
///
/// ```
/// use impactlaw::contact::NormalLaw;
/// use impactlaw::law::{FittedLaw, series::Series};
/// use impactlaw::theory::hertz::Hertz;
/// // elastic: Hertz's contact of both
/// let [hard, soft] = [2e11, 5e10];
/// let both = Series::new([hard, soft].map(|e| FittedLaw::Hertz(Hertz::new(e))), [hard, soft]);
/// let hertz = Hertz::new(1.0 / (1.0 / hard + 1.0 / soft));
/// let force = both.force(0.01, &mut Default::default());
/// assert!((force / hertz.force(0.01, &mut ()) - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    laws: [FittedLaw; 2],
    /// Radius of each side over that of the effective body.
    radii: [f64; 2],
    valid_to: f64,
}

/// What a contact of two sides remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sides {
    first: Memory,
    second: Memory,
    /// Part of the overlap that the first side took last; 0: none yet.
    share: f64,
}

keep_fields!(Sides: first, second, share);

/// Deepest flattening at which a side is asked for, over the effective radius.
const DEEPEST: f64 = 2.0;
/// Halvings of the search for the end of the range.
const HALVINGS: usize = 60;

/// Asks a law for the largest flattening its source supports.
struct ValidTo;

impl LawVisitor for ValidTo {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        law.valid_to()
    }
}

/// Reduced force of a law at `x`, remembered.
fn force(law: &FittedLaw, x: f64, memory: &mut Memory) -> f64 {
    match law {
        FittedLaw::Hertz(law) => law.force(x, &mut ()),
        FittedLaw::ClosedForm(law) => law.force(x, memory),
        FittedLaw::Spline(law) => law.force(x, memory),
    }
}

/// Answer of a law to `ask` about a side with its memory.
macro_rules! of_side {
    ($law:expr, $memory:expr, $ask:ident ( $($x:expr)? )) => {
        match $law {
            FittedLaw::Hertz(law) => law.$ask($($x,)? &()),
            FittedLaw::ClosedForm(law) => law.$ask($($x,)? $memory),
            FittedLaw::Spline(law) => law.$ask($($x,)? $memory),
        }
    };
}

impl Series {
    /// Laws of the two bodies, and their contact moduli E* (Pa).
    #[must_use]
    pub fn new(laws: [FittedLaw; 2], moduli: [f64; 2]) -> Self {
        let [a, b] = moduli;
        let mut series = Series {
            laws,
            radii: [1.0 + a / b, 1.0 + b / a],
            valid_to: f64::INFINITY,
        };
        let ends = [0, 1].map(|i| series.laws[i].visit(ValidTo));
        let inside = |x: f64| {
            let mut sides = Sides::default();
            series.force(x, &mut sides);
            let parts = series.parts(x, &sides);
            parts[0] <= ends[0] && parts[1] <= ends[1]
        };
        let (mut low, mut high) = (0.0, DEEPEST);
        if !inside(high) {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match inside(middle) {
                    true => low = middle,
                    false => high = middle,
                }
            }
            series.valid_to = low;
        }
        series
    }

    /// Flattening of each side over its radius.
    fn parts(&self, x: f64, sides: &Sides) -> [f64; 2] {
        let taken = sides.share * x;
        [taken / self.radii[0], (x - taken) / self.radii[1]]
    }

    /// Side `i` where it takes `taken` of x; nothing is remembered.
    fn trial(&self, i: usize, taken: f64, memory: &Memory) -> Side {
        let (radius, mut memory) = (self.radii[i], *memory);
        let x = taken / radius;
        Side {
            force: radius * radius * force(&self.laws[i], x, &mut memory),
            stiffness: radius * of_side!(&self.laws[i], &memory, stiffness(x)),
        }
    }

    /// Both sides at the share found last.
    fn both(&self, x: f64, sides: &Sides) -> Side {
        let taken = sides.share * x;
        in_series([
            self.trial(0, taken, &sides.first),
            self.trial(1, x - taken, &sides.second),
        ])
    }
}

impl NormalLaw for Series {
    type History = Sides;

    fn force(&self, x: f64, sides: &mut Sides) -> f64 {
        if !(x > 0.0) {
            return 0.0;
        }
        // a virgin contact begins with Hertz's share
        let share = match sides.share > 0.0 {
            true => sides.share,
            false => 1.0 / self.radii[0],
        };
        let before = *sides;
        let (taken, _) = balance(
            x,
            share * x,
            |taken| self.trial(0, taken, &before.first),
            |taken| self.trial(1, taken, &before.second),
        );
        sides.share = taken / x;
        let state = self.both(x, sides);
        let [first, second] = self.parts(x, sides);
        force(&self.laws[0], first, &mut sides.first);
        force(&self.laws[1], second, &mut sides.second);
        state.force
    }

    fn stiffness(&self, x: f64, sides: &Sides) -> f64 {
        match x > 0.0 {
            true => self.both(x, sides).stiffness,
            false => 0.0,
        }
    }

    fn depth(&self, x: f64, sides: &Sides) -> f64 {
        let [first, second] = self.parts(x, sides);
        self.radii[0] * of_side!(&self.laws[0], &sides.first, depth(first))
            + self.radii[1] * of_side!(&self.laws[1], &sides.second, depth(second))
    }

    fn elastic_energy(&self, x: f64, sides: &Sides) -> f64 {
        let [first, second] = self.parts(x, sides);
        self.radii[0].powi(3) * of_side!(&self.laws[0], &sides.first, elastic_energy(first))
            + self.radii[1].powi(3) * of_side!(&self.laws[1], &sides.second, elastic_energy(second))
    }

    fn dissipated(&self, sides: &Sides) -> f64 {
        self.radii[0].powi(3) * of_side!(&self.laws[0], &sides.first, dissipated())
            + self.radii[1].powi(3) * of_side!(&self.laws[1], &sides.second, dissipated())
    }

    fn contact_radius(&self, _: f64, _: &Sides) -> Option<f64> {
        None
    }

    fn valid_to(&self) -> f64 {
        self.valid_to
    }
}
