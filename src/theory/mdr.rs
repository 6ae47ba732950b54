//! Zunker and Kamrin: the method of dimensionality reduction (MDR) for an elastic-perfectly plastic sphere on one flat.

use super::published::{
    Evidence, FlowConstants, Published, PublishedLaw, Restitution, YIELD_STRENGTH_ONLY,
};
use crate::contact::NormalLaw;
use crate::material::Material;
use crate::material::stress::Moduli;
use crate::tape::keep_fields;
use std::f64::consts::PI;

/// Mean pressure of yielding over Y: $1 + c\ e^{-k \delta/R}$.
const PRESSURE: [f64; 2] = [1.75, 4.4];

/// Flattening over R up to which the published loading is taken; it peaks, and falls, at 0.95.
const SUPPORTED_TO: f64 = 0.5;

/// Elastic-perfectly plastic sphere pressed by one flat, as its contact with an elastic Winkler foundation.
///
/// $$ p_Y(\delta) = Y (1.75\ e^{-4.4 \delta/R} + 1), \qquad \frac{4 E^\ast}{3\pi}\sqrt{\delta_Y/R} = p_Y(\delta_Y), \qquad
///    a^2 = 2 R \delta - \delta^2 - R \delta_Y + \delta_Y^2 $$
/// $$ F = \tfrac14 E^\ast A B\ g(x), \qquad x = \delta_e/A, \qquad
///    g = \arccos(1 - 2x) - 2 (1 - 2x) \sqrt{x - x^2} $$
/// $$ \text{elastic:}\quad A = 4R,\ B = 2R,\ \delta_e = \delta; \qquad
///    \text{yielded:}\quad A = \frac{4 p_Y a_m}{E^\ast},\ B = 2 a_m,\ F_m = \pi a_m^2 p_Y $$
/// $$ \delta_e = \frac{\delta - \delta_m + \delta_{em} + \delta_R}{1 + \delta_R/\delta_{em}}, \quad
///    \delta_{em} = \frac{A}{2}, \quad
///    \delta_R = F_m \frac{2 a_m^2 (\nu - 1) - (2\nu - 1) z (\sqrt{a_m^2 + z^2} - z)}{2\pi G a_m^2 \sqrt{a_m^2 + z^2}}, \quad
///    z = R - \delta_m + \delta_{em} $$
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | $p_Y, \delta_Y$ | Pa, m | mean pressure of yielding, and the flattening at which Hertz' mean pressure reaches it |
/// | $A, B$ | m | size of the elastic punch of the foundation, and its width |
/// | $a_m, \delta_m$ | m | contact radius and flattening at the peak |
/// | $\delta_{em}, \delta_R$ | m | elastic part of the flattening at the peak, and what the free surface moves beside it |
///
/// Source: Zunker and Kamrin 2024, J. Mech. Phys. Solids 183, 105492 and 105493, for one flat, without adhesion and without the
/// radius that grows as others press on the body; equations seen in two copies of the code that LAMMPS ships, not in the paper.
/// At yield the force jumps by less than 0.04 % and the slope grows by a third: up to 8 % above Hertz. **Not in the source:**
/// beyond $\delta = R/2$ the force goes on along its tangent at the pressure reached there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mdr {
    contact_modulus: f64,
    shear_modulus: f64,
    poisson_ratio: f64,
    strength: f64,
    /// $\delta_Y/R$.
    yield_flattening: f64,
    /// Reduced force and its slope at [`SUPPORTED_TO`], Pa.
    end: [f64; 2],
}

/// Memory of a contact: the largest flattening, and the elastic branch that leaves it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// Largest flattening $x_m$ so far.
    flattening: f64,
    /// Reduced force there, Pa, once it has yielded.
    force: f64,
    /// A/R; 0 as long as nothing has yielded.
    size: f64,
    /// $a_m/R$.
    radius: f64,
    /// Flattening at which contact is lost.
    residual: f64,
    /// Growth of the flattening with its elastic part, $1 + \delta_R/\delta_{em}$.
    stretch: f64,
}

keep_fields!(Peak: flattening, force, size, radius, residual, stretch);

/// A branch of the foundation: what an elastic contact and an unloading one have in common.
#[derive(Debug, Clone, Copy)]
struct Branch {
    size: f64,
    width: f64,
    residual: f64,
    stretch: f64,
}

impl Branch {
    /// Share x of the punch that is pressed in at a flattening.
    fn share(&self, x: f64) -> f64 {
        ((x - self.residual) / (self.stretch * self.size)).max(0.0)
    }
}

/// $g$, whose slope is $8 \sqrt{x (1 - x)}$, and $\int_0^x g$: by their series where the closed forms lose digits.
fn foundation(x: f64) -> [f64; 2] {
    if x < 0.05 {
        let (mut term, mut sums) = (1.0, [0.0; 2]);
        for k in 0..10 {
            let power = f64::from(k) + 1.5;
            sums[0] += term / power;
            sums[1] += term / (power * (power + 1.0));
            term *= x * (f64::from(k) - 0.5) / (f64::from(k) + 1.0);
        }
        let scale = 8.0 * x * x.sqrt();
        return [scale * sums[0], scale * x * sums[1]];
    }
    let (sine, cosine) = (2.0 * (x * (1.0 - x)).sqrt(), 1.0 - 2.0 * x);
    let angle = cosine.acos();
    let integral = 0.5 * (sine - angle * cosine - sine * sine * sine / 3.0);
    [angle - sine * cosine, integral]
}

impl Mdr {
    /// Law of a material; `None` for an elastic body.
    #[must_use]
    pub fn of(material: &Material) -> Option<Self> {
        let strength = material.flow?.yield_strength();
        Some(Self::new(
            material.young_modulus,
            material.poisson_ratio,
            strength,
        ))
    }

    /// Law from Young's modulus (Pa), Poisson's ratio and yield strength (Pa).
    #[must_use]
    pub fn new(young_modulus: f64, poisson_ratio: f64, strength: f64) -> Self {
        let mut law = Self {
            contact_modulus: young_modulus / (1.0 - poisson_ratio * poisson_ratio),
            shear_modulus: Moduli::new(young_modulus, poisson_ratio).shear,
            poisson_ratio,
            strength,
            yield_flattening: 0.0,
            end: [0.0; 2],
        };
        law.yield_flattening = law.onset();
        let [pressure, fall] = law.pressure(SUPPORTED_TO);
        let area = law.area(SUPPORTED_TO);
        let growth = 2.0 - 2.0 * SUPPORTED_TO;
        law.end = [PI * pressure * area, PI * (pressure * growth + fall * area)];
        law
    }

    /// $p_Y$ (Pa) and its slope.
    fn pressure(&self, x: f64) -> [f64; 2] {
        let [share, rate] = PRESSURE;
        let rest = share * (-rate * x).exp();
        [self.strength * (rest + 1.0), -self.strength * rate * rest]
    }

    /// Flattening at which Hertz' mean pressure reaches $p_Y$: it rises, $p_Y$ falls, so there is one. Bisection to the last bit.
    fn onset(&self) -> f64 {
        let (mut below, mut above) = (0.0, 1.0);
        loop {
            let middle = 0.5 * (below + above);
            if middle <= below || middle >= above {
                return above;
            }
            let hertz = 4.0 * self.contact_modulus * f64::sqrt(middle) / (3.0 * PI);
            if hertz > self.pressure(middle)[0] {
                above = middle;
            } else {
                below = middle;
            }
        }
    }

    /// $(a/R)^2$ of first loading past yield, within the range of the source.
    fn area(&self, x: f64) -> f64 {
        let y = self.yield_flattening;
        2.0 * x - x * x - y + y * y
    }

    /// Force on first loading, and contact radius and pressure there.
    fn loading(&self, x: f64) -> [f64; 3] {
        if x <= SUPPORTED_TO {
            let [pressure, _] = self.pressure(x);
            let area = self.area(x);
            return [PI * pressure * area, area.sqrt(), pressure];
        }
        let [pressure, _] = self.pressure(SUPPORTED_TO);
        let force = self.end[0] + self.end[1] * (x - SUPPORTED_TO);
        [force, (force / (PI * pressure)).sqrt(), pressure]
    }

    /// $\int p_Y a^2$ from yield to `x` within the range of the source.
    fn work_past_yield(&self, x: f64) -> f64 {
        let [share, rate] = PRESSURE;
        let y = self.yield_flattening;
        let constant = y * y - y;
        let antiderivative = |x: f64| {
            let plain = x * x - x * x * x / 3.0 + constant * x;
            let bends = self.area(x) + (2.0 - 2.0 * x) / rate - 2.0 / (rate * rate);
            plain - share / rate * (-rate * x).exp() * bends
        };
        PI * self.strength * (antiderivative(x) - antiderivative(y))
    }

    /// Work of first loading over $R^3$, Pa.
    fn loading_work(&self, x: f64) -> f64 {
        let virgin = self.branch(&Peak::default());
        let elastic = self.energy(&virgin, x.min(self.yield_flattening));
        if x <= self.yield_flattening {
            return elastic;
        }
        let beyond = (x - SUPPORTED_TO).max(0.0);
        let tangent = beyond * (self.end[0] + 0.5 * self.end[1] * beyond);
        elastic + self.work_past_yield(x.min(SUPPORTED_TO)) + tangent
    }

    fn branch(&self, peak: &Peak) -> Branch {
        if peak.size == 0.0 {
            return Branch {
                size: 4.0,
                width: 2.0,
                residual: 0.0,
                stretch: 1.0,
            };
        }
        Branch {
            size: peak.size,
            width: 2.0 * peak.radius,
            residual: peak.residual,
            stretch: peak.stretch,
        }
    }

    /// The branch that leaves first loading at `x`, past yield.
    fn peak(&self, x: f64, [force, radius, pressure]: [f64; 3]) -> Peak {
        let size = 4.0 * pressure * radius / self.contact_modulus;
        let elastic = 0.5 * size;
        let (nu, area) = (self.poisson_ratio, radius * radius);
        let z = 1.0 - x + elastic;
        let slant = (area + z * z).sqrt();
        let moved = force * (2.0 * area * (nu - 1.0) - (2.0 * nu - 1.0) * z * (slant - z))
            / (2.0 * PI * self.shear_modulus * area * slant);
        Peak {
            flattening: x,
            force,
            size,
            radius,
            residual: x - elastic - moved,
            stretch: 1.0 + moved / elastic,
        }
    }

    /// Energy of a branch over $R^3$, Pa.
    fn energy(&self, branch: &Branch, x: f64) -> f64 {
        let [_, integral] = foundation(branch.share(x));
        0.25 * self.contact_modulus
            * branch.size
            * branch.size
            * branch.width
            * branch.stretch
            * integral
    }
}

impl Published for Mdr {
    const NAME: &'static str = "mdr";
    const SUMMARY: &'static str =
        "dimensionality reduction, one flat; elastic foundation on unloading";
    const PAPERS: &'static [&'static str] = &["ZunkerKamrin2024"];
    const REFERENCE: &'static str = "Zunker and Kamrin 2024, J. Mech. Phys. Solids 183, 105492, one flat, without adhesion (equations from the code in LAMMPS); its tangent beyond delta = R/2";
    const EVIDENCE: Evidence = Evidence::Checked;
    const OF_PAIRS: bool = false;
    const FLOW: FlowConstants = YIELD_STRENGTH_ONLY;
    const RESTITUTION: Option<Restitution> = None;
}

impl PublishedLaw for Mdr {
    type Law = Self;

    fn law(material: &Material) -> Option<Self> {
        Self::of(material)
    }
}

impl NormalLaw for Mdr {
    type History = Peak;

    fn force(&self, x: f64, peak: &mut Peak) -> f64 {
        if x > peak.flattening {
            if x > self.yield_flattening {
                let loading = self.loading(x);
                *peak = self.peak(x, loading);
                return loading[0];
            }
            peak.flattening = x;
        } else if x == peak.flattening && peak.size > 0.0 {
            return peak.force;
        }
        let branch = self.branch(peak);
        let [force, _] = foundation(branch.share(x));
        0.25 * self.contact_modulus * branch.size * branch.width * force
    }

    /// At the largest flattening itself: the slope of loading.
    fn stiffness(&self, x: f64, peak: &Peak) -> f64 {
        if x >= peak.flattening && peak.size > 0.0 {
            if x > SUPPORTED_TO {
                return self.end[1];
            }
            let [pressure, fall] = self.pressure(x);
            return PI * (pressure * (2.0 - 2.0 * x) + fall * self.area(x));
        }
        let branch = self.branch(peak);
        let share = branch.share(x);
        2.0 * self.contact_modulus * branch.width * (share * (1.0 - share)).sqrt() / branch.stretch
    }

    fn depth(&self, x: f64, peak: &Peak) -> f64 {
        if x >= peak.flattening {
            return x.max(0.0);
        }
        (x - peak.residual).max(0.0)
    }

    fn dissipated(&self, peak: &Peak) -> f64 {
        if peak.size == 0.0 {
            return 0.0;
        }
        self.loading_work(peak.flattening) - self.elastic_energy(peak.flattening, peak)
    }

    fn elastic_energy(&self, x: f64, peak: &Peak) -> f64 {
        self.energy(&self.branch(peak), x)
    }

    fn contact_radius(&self, x: f64, peak: &Peak) -> Option<f64> {
        let branch = self.branch(peak);
        let share = branch.share(x);
        Some(branch.width * (share * (1.0 - share)).sqrt())
    }

    fn largest(&self, peak: &Peak) -> Option<f64> {
        Some(peak.flattening)
    }

    fn valid_to(&self) -> f64 {
        SUPPORTED_TO
    }
}
