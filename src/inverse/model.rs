//! What the atlas says of the impacts of a material: the figures that are measured.

use super::measurement::{Figure, Measurement};
use crate::Result;
use crate::atlas::Atlas;
use crate::contact::elastoplastic::Spline;
use crate::fit::pulse::Pulse;
use crate::fit::run::Scale;
use crate::material::flow::LinearHardening;
use crate::material::{Flow, Material};

/// What is known of the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// rho, kg/m3.
    pub density: f64,
    /// E, Pa.
    pub young_modulus: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// Hardening modulus H that is not sought, Pa.
    pub hardening: f64,
}

/// A material that is tried: $\ln Y$ (Pa) and, where hardening is sought, $\ln(1 + H/Y)$.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// $\ln Y$.
    pub strength: f64,
    /// $\ln(1 + H/Y)$; none where H is known.
    pub hardening: Option<f64>,
}

impl Point {
    /// Y and H, Pa.
    #[must_use]
    pub fn constants(&self, known: &Known) -> [f64; 2] {
        let strength = self.strength.exp();
        let sought = self.hardening.map(|h| strength * h.exp_m1());
        [strength, sought.unwrap_or(known.hardening)]
    }
}

impl Known {
    /// The material at a point.
    #[must_use]
    pub fn material(&self, point: &Point) -> Material {
        let [strength, modulus] = point.constants(self);
        let flow = match modulus {
            0.0 => Flow::perfectly_plastic(strength),
            modulus => LinearHardening { strength, modulus }.into(),
        };
        Material {
            density: self.density,
            young_modulus: self.young_modulus,
            poisson_ratio: self.poisson_ratio,
            flow: Some(flow),
        }
    }
}

/// Logarithms of what real impacts gave over what the atlas says, at some speeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Correction {
    /// $\ln V$ and the logarithms, in the order of [`Figure::ALL`]; ascending.
    pub nodes: Vec<(f64, [f64; 3])>,
}

impl Correction {
    /// Factor of a figure at a speed: linear over $\ln V$ between the nodes, that of the nearest beyond them.
    #[must_use]
    pub fn factor(&self, figure: Figure, velocity: f64) -> f64 {
        let (at, k) = (velocity.ln(), figure as usize);
        let after = self.nodes.partition_point(|(v, _)| *v < at);
        let value = match (
            after.checked_sub(1).map(|i| &self.nodes[i]),
            self.nodes.get(after),
        ) {
            (Some((a, low)), Some((b, high))) => low[k] + (at - a) / (b - a) * (high[k] - low[k]),
            (Some((_, one)), None) | (None, Some((_, one))) => one[k],
            (None, None) => 0.0,
        };
        value.exp()
    }
}

/// The atlas with what corrects it.
#[derive(Debug, Clone, PartialEq)]
pub struct Model<'a> {
    /// The atlas.
    pub atlas: &'a Atlas,
    /// What is known of the material.
    pub known: Known,
    /// Corrections by real impacts.
    pub correction: Correction,
}

/// Impact of a body with R = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// e.
    pub restitution: f64,
    /// $\delta^\ast/R$.
    pub most: f64,
    /// $\delta_{res}/R$.
    pub left: f64,
}

/// Impacts of one material.
struct Impacts {
    law: Spline,
    scale: Scale,
    last: Option<(f64, Hit)>,
}

impl Impacts {
    fn at(&mut self, velocity: f64) -> Option<Hit> {
        if let Some((_, hit)) = self.last.filter(|(v, _)| *v == velocity) {
            return Some(hit);
        }
        let energy = self.scale.energy(velocity);
        // Hertz below first yield, a constant pressure far above
        let guess = match energy < 1.0 {
            true => (2.5 * energy).powf(0.4),
            false => (energy / 1.5).sqrt().max(1.0),
        };
        let pulse = Pulse::of(&self.law, energy, guess)?;
        let unit = self.scale.units().flattening;
        let hit = Hit {
            restitution: pulse.restitution,
            most: pulse.flattening * unit,
            left: pulse.residual * unit,
        };
        self.last = Some((velocity, hit));
        Some(hit)
    }
}

impl Model<'_> {
    /// Impacts of the material at a point; `None` for one outside the atlas.
    fn impacts(&self, point: &Point) -> Option<Impacts> {
        let material = self.known.material(point);
        Some(Impacts {
            law: self.atlas.unlimited(&material).ok()?,
            // e and shares of the radius are the same in every size
            scale: Scale::of(&material, 1.0)?,
            last: None,
        })
    }

    /// Figures of impacts at `velocities` (m/s), one for each of `rows`; `None` for a material outside the atlas.
    #[must_use]
    pub fn figures(
        &self,
        point: &Point,
        rows: &[Measurement],
        velocities: &[f64],
    ) -> Option<Vec<f64>> {
        let mut impacts = self.impacts(point)?;
        let hardening = point.constants(&self.known)[1] / point.strength.exp();
        let mut all = Vec::with_capacity(rows.len());
        for (row, &velocity) in rows.iter().zip(velocities) {
            let value = figure(row.figure, &impacts.at(velocity)?, hardening);
            all.push(value * self.correction.factor(row.figure, row.velocity));
        }
        all.iter().all(|x| x.is_finite()).then_some(all)
    }

    /// Figures of the atlas alone for impacts at `velocities`, in the order of [`Figure::ALL`].
    ///
    /// # Errors
    /// As [`Atlas::law`].
    pub fn told(&self, point: &Point, velocities: &[f64]) -> Result<Vec<[f64; 3]>> {
        let material = self.known.material(point);
        self.atlas.unlimited(&material)?;
        let hardening = point.constants(&self.known)[1] / point.strength.exp();
        let mut impacts = self.impacts(point);
        let one = |velocity: &f64| {
            let hit = impacts.as_mut().and_then(|impacts| impacts.at(*velocity));
            Figure::ALL.map(|kind| hit.map_or(f64::NAN, |hit| figure(kind, &hit, hardening)))
        };
        Ok(velocities.iter().map(one).collect())
    }

    /// Standard deviations of what the atlas is off by in the figures of `rows`, for a material it has not seen.
    #[must_use]
    pub fn errors(&self, point: &Point, rows: &[Measurement]) -> Option<Vec<f64>> {
        let mut impacts = self.impacts(point)?;
        let hardening = point.constants(&self.known)[1] / point.strength.exp();
        let soft = self.known.young_modulus < SOFT * point.strength.exp();
        let score = match soft {
            true => &self.atlas.left_out_soft,
            false => &self.atlas.left_out,
        };
        let mut all = Vec::with_capacity(rows.len());
        for row in rows {
            let hit = impacts.at(row.velocity)?;
            let value = figure(row.figure, &hit, hardening);
            let within = match row.figure {
                Figure::Restitution => score.twentieth[2] * value.max(LEAST_RESTITUTION),
                Figure::CompressionRatio => {
                    let [bare, sprung] = HEIGHT_ERROR;
                    value * (bare + sprung * (hit.most - hit.left) / hit.left)
                }
                Figure::FlatDiameter => FLAT_ERROR * value,
            };
            all.push(within / DEVIATIONS);
        }
        all.iter().all(|x| x.is_finite()).then_some(all)
    }
}

/// E/Y below which a material is judged by its like.
const SOFT: f64 = 30.0;
/// Least e that an error is relative to.
const LEAST_RESTITUTION: f64 = 0.2;
/// Deviations in an interval of 95 %.
pub(super) const DEVIATIONS: f64 = 1.959_964;
/// What 19 of 20 compression ratios by the atlas are within, of 621 impacts of its own and of 30 it has not seen: a share, and one of the springing
/// back over the residual displacement.
const HEIGHT_ERROR: [f64; 2] = [0.06, 0.12];
/// The same of flat diameters.
const FLAT_ERROR: f64 = 0.075;
/// Height lost over half the residual displacement of the centre of mass: 1, and for the curvature of the body and the springing
/// back of its height after the contact. Least absolute relative errors over the 624 impacts of `cases/atlas.toml` with V above
/// 1.5 V_y and $\rho V^2/Y$ below 1: half of them within 0.3 %, 95 % within 4.5 % (V above 10 V_y: 3.1 %).
const HEIGHT: [f64; 3] = [0.086, 0.642, 2.72];
/// $c^2 = a^2/(2 R \delta^\ast)$ of the widest contact: fully plastic, what is sprung back, hardening. The same impacts up to
/// $\rho V^2/Y$ 0.6: a within 2.1 % for half of them, within 6.9 % for 95 %; their cells are 2 % of the radius.
const FLAT: [f64; 3] = [0.218, -1.103, -0.0985];

/// A measured figure of an impact of a body with R = 1; `hardening` is H/Y.
#[must_use]
pub fn figure(figure: Figure, hit: &Hit, hardening: f64) -> f64 {
    let Hit { most, left, .. } = *hit;
    let sprung = most - left;
    match figure {
        Figure::Restitution => hit.restitution,
        Figure::CompressionRatio => {
            let [a, b, c] = HEIGHT;
            0.5 * left * (1.0 + a * left + b * left * left + c * sprung)
        }
        Figure::FlatDiameter => {
            let [a, b, c] = FLAT;
            let wide = (a + b * sprung / most).exp() * (1.0 + hardening).powf(c);
            (2.0 * most * wide).sqrt()
        }
    }
}
