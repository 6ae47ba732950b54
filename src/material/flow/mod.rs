//! Flow stress: the yield strength and the effects that change it; one list of all kinds, each a file beside this one.
//!
//! To add one, write its file (constants, stress, slope, and what it remembers) and name it in the list below. Case and scene
//! files, law files, plans, reports, studies and exports walk its constants and need no change.

mod cowper_symonds;
mod declare;
mod johnson_cook;
mod linear_hardening;
mod perfectly_plastic;
mod power_hardening;
mod product;
mod voce_hardening;
mod written;

pub(super) use declare::flow_stress;
use declare::flow_stresses;
pub use linear_hardening::HARDENING_MODULUS;
use power_hardening::{HARDENING_COEFFICIENT, HARDENING_EXPONENT};
pub use written::{FlowConstants, InSi, InText, Spelling, WithFlow};

use super::constant::{Absent, Constant, Dimension, Range};
use super::reference::ReferenceUnits;
use crate::lanes::Lanes;
use crate::tape::Keep;
use std::fmt;

flow_stresses! {
    perfectly_plastic::PerfectlyPlastic,
    linear_hardening::LinearHardening,
    power_hardening::PowerHardening,
    voce_hardening::VoceHardening,
    johnson_cook::IsothermalJohnsonCook,
    johnson_cook::JohnsonCook,
    cowper_symonds::CowperSymonds,
}

/// Initial yield strength Y, the constant that every flow stress has.
pub const YIELD_STRENGTH: Constant = Constant {
    key: "yield_strength",
    symbol: "Y",
    effect: "plasticity",
    dimension: Dimension::Stress,
    range: Range::BelowYoungModulus,
    absent: Absent::Other,
    meaning: "yield strength Y (von Mises)",
    example: "'97.59 MPa'",
    otherwise: "none: elastic",
};

/// Flow stress $\sigma_y(\varepsilon_p, \Delta\varepsilon_p / \Delta t, ...)$ of a material point, in reference units.
///
/// The strain passed is the accumulated equivalent plastic strain at the end of the step, the increment its growth in the
/// step, `dt` the length of the step. Where `dt` is 0, a stress that grows with the rate has an infinite slope: nothing flows
/// in no time. The stress without an increment is that at rest, from which yielding begins.
pub trait FlowStress: Constants + Send + Sync + 'static {
    /// What a point remembers besides its plastic strain (a temperature, say); `()` takes no room.
    type Memory: Copy + Default + fmt::Debug + Keep + Send + Sync;
    /// Time of an impact over that of a perfectly plastic one of as many points and steps (guide, *Measured*).
    const COST: f64 = 1.0;
    /// Newton steps of a return at most; 1 is exact where the flow stress is linear in the increment.
    const NEWTON_STEPS: usize = 1;

    /// Flow stress.
    fn stress(&self, strain: Lanes, increment: Lanes, dt: f64, memory: &Self::Memory) -> Lanes;

    /// Its whole derivative with respect to the increment, which the strain grows by.
    fn slope(&self, strain: Lanes, increment: Lanes, dt: f64, memory: &Self::Memory) -> Lanes;

    /// What a point remembers after a step that took the plastic work `work` per reference volume.
    #[inline(always)]
    fn remember(&self, _increment: Lanes, _dt: f64, _work: Lanes, _memory: &mut Self::Memory) {}

    /// Share of the plastic work that becomes heat.
    fn heat_share(&self) -> f64 {
        0.0
    }

    /// Temperature of what a point remembers, K; none of a flow stress that knows none.
    fn temperature(&self, _memory: &Self::Memory) -> Option<Lanes> {
        None
    }

    /// Heat per mass from where a body begins to where it has no strength; none of a flow stress that knows no temperature.
    fn heat_to_melt(&self) -> Option<f64> {
        None
    }

    /// A constant that another one contradicts, with what is allowed beside that one.
    fn contradiction(&self) -> Option<(Constant, String)> {
        None
    }

    /// Length $\gamma$ of the radial return of a deviator of size `norm`: the root of
    /// $|s| - k \gamma - \sqrt{2/3}\ \sigma_y(\varepsilon + \Delta, \Delta)$ with $\Delta = \sqrt{2/3}\ \gamma$ and k =
    /// `stiffness`. Newton's method from 0; a flow stress whose slope is infinite there solves for itself.
    #[inline(always)]
    fn length_of_return(
        &self,
        norm: Lanes,
        stiffness: Lanes,
        strain: Lanes,
        dt: f64,
        memory: &Self::Memory,
    ) -> Lanes {
        let mut length = Lanes::default();
        for _ in 0..Self::NEWTON_STEPS {
            let increment = length * ROOT;
            let end = strain + increment;
            let misfit = norm - stiffness * length - self.stress(end, increment, dt, memory) * ROOT;
            let slope = stiffness + self.slope(end, increment, dt, memory) * (2.0 / 3.0);
            let mut step = misfit * slope.recip();
            if Self::NEWTON_STEPS > 1 {
                // points that do not yield stay where they are, and keep no others waiting
                step = step.map(|step| step.max(0.0));
            }
            length += step;
            if !(step - length * ENOUGH).any_positive() {
                break;
            }
        }
        length
    }
}

/// Step of a return, over the length so far, after which the next changes nothing.
const ENOUGH: f64 = 1e-9;

/// $\sqrt{2/3}$: deviator norm over equivalent stress, equivalent plastic strain over length of return.
pub const ROOT: f64 = 0.816_496_580_927_726;

/// A flow stress by its constants. Implemented by `flow_stress!`.
pub trait Constants: Copy + fmt::Debug + PartialEq {
    /// Name in running text.
    const NAME: &'static str;
    /// The constants.
    const CONSTANTS: &'static [Constant];
    /// Of the value of each constant, asked for in their order.
    #[must_use]
    fn of(value: impl FnMut(&Constant) -> f64) -> Self;
    /// Values, in the order of the constants.
    #[must_use]
    fn values(&self) -> Vec<f64>;
    /// The same with its constants in reference units.
    #[must_use]
    fn in_reference(&self, units: &ReferenceUnits) -> Self {
        let scaled = |(constant, value): (&Constant, f64)| value / units.unit(constant.dimension);
        let mut values = Self::CONSTANTS.iter().zip(self.values()).map(scaled);
        Self::of(|_| values.next().unwrap_or_default())
    }
}

/// What is done with whatever flow stress a material has; its type is known inside.
pub trait FlowVisitor {
    /// What comes of it.
    type Output;
    /// Called with the flow stress.
    fn visit<F: FlowStress>(self, flow: F) -> Self::Output;
}

/// A kind of flow stress in the list.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Name in running text.
    pub name: &'static str,
    /// Its constants.
    pub constants: &'static [Constant],
    /// The flow stress of the values of its constants, in their order.
    of: fn(&[f64]) -> Flow,
}

/// What a point has gone through, SI.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Past {
    /// Equivalent plastic strain.
    pub strain: f64,
    /// Its present rate, 1/s.
    pub rate: f64,
    /// Plastic work per mass, J/kg.
    pub work: f64,
}

/// Flow stress after a past, and the temperature that goes with it.
struct After(Past);

impl FlowVisitor for After {
    type Output = (f64, Option<f64>);
    fn visit<F: FlowStress>(self, flow: F) -> Self::Output {
        let Past { strain, rate, work } = self.0;
        let mut memory = F::Memory::default();
        let still = Lanes::default();
        // of a density of one the work per volume is that per mass
        flow.remember(still, 0.0, Lanes::splat(work), &mut memory);
        let stress = flow.stress(Lanes::splat(strain), Lanes::splat(rate), 1.0, &memory);
        let temperature = flow.temperature(&memory);
        (stress.min(), temperature.map(Lanes::min))
    }
}

/// [`FlowStress::contradiction`].
struct Contradiction;

impl FlowVisitor for Contradiction {
    type Output = Option<(Constant, String)>;
    fn visit<F: FlowStress>(self, flow: F) -> Self::Output {
        flow.contradiction()
    }
}

/// [`FlowStress::COST`].
struct Cost;

impl FlowVisitor for Cost {
    type Output = f64;
    fn visit<F: FlowStress>(self, _: F) -> f64 {
        F::COST
    }
}

/// [`FlowStress::heat_to_melt`].
struct HeatToMelt;

impl FlowVisitor for HeatToMelt {
    type Output = Option<f64>;
    fn visit<F: FlowStress>(self, flow: F) -> Self::Output {
        flow.heat_to_melt()
    }
}

impl Flow {
    /// Constant flow stress of `strength`, Pa.
    #[must_use]
    pub const fn perfectly_plastic(strength: f64) -> Self {
        Flow::PerfectlyPlastic(PerfectlyPlastic { strength })
    }

    /// Flow stress of a virgin point at an equivalent plastic strain, at rest.
    #[must_use]
    pub fn at_rest(self, strain: f64) -> f64 {
        let past = Past {
            strain,
            ..Past::default()
        };
        self.after(past).0
    }

    /// Flow stress of a point after a past, Pa, and its temperature, K, where it knows one.
    #[must_use]
    pub fn after(self, past: Past) -> (f64, Option<f64>) {
        self.visit(After(past))
    }

    /// Time of an impact over that of a perfectly plastic one of as many points and steps.
    #[must_use]
    pub fn cost(self) -> f64 {
        self.visit(Cost)
    }

    /// A constant that another one contradicts, with what is allowed beside that one.
    #[must_use]
    pub fn contradiction(self) -> Option<(Constant, String)> {
        self.visit(Contradiction)
    }

    /// Heat per mass from where a body begins to where it has no strength, J/kg; none of a kind that knows no temperature.
    #[must_use]
    pub fn heat_to_melt(self) -> Option<f64> {
        self.visit(HeatToMelt)
    }

    /// Name in running text.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.parts().0
    }

    /// Its constants with their values.
    #[must_use]
    pub fn constants(&self) -> Vec<(Constant, f64)> {
        let (_, constants, values) = self.parts();
        constants.iter().copied().zip(values).collect()
    }

    /// The same kind with what `change` makes of the value of each constant.
    #[must_use]
    pub fn with_each(&self, change: impl Fn(f64) -> f64) -> Self {
        let (name, _, values) = self.parts();
        let values: Vec<f64> = values.into_iter().map(change).collect();
        let kind = Self::KINDS.iter().find(|kind| kind.name == name);
        kind.map_or(*self, |kind| (kind.of)(&values))
    }

    /// Value of a constant; `None` where it has none.
    #[must_use]
    pub fn value(&self, of: &Constant) -> Option<f64> {
        let (_, constants, values) = self.parts();
        let place = constants.iter().position(|constant| constant == of)?;
        values.get(place).copied()
    }

    /// Constants of all kinds, each once, in the order of the list.
    #[must_use]
    pub fn all_constants() -> Vec<Constant> {
        let mut all: Vec<Constant> = Vec::new();
        for constant in Self::KINDS.iter().flat_map(|kind| kind.constants) {
            if !all.contains(constant) {
                all.push(*constant);
            }
        }
        all
    }
}

/// Name and constants: "perfectly plastic, yield strength 1.25e9 Pa".
impl fmt::Display for Flow {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())?;
        for (constant, value) in self.constants() {
            let unit = constant.dimension.unit();
            let text = format!(", {} {value:e} {unit}", constant.name());
            f.write_str(text.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
