//! Envelope: a loading curve and the power-law unloading branch that leaves it at the largest flattening.

use crate::contact::NormalLaw;
use crate::tape::keep_fields;

/// Branch that leaves the loading curve at a peak $(x_m, \varphi_m)$:
///
/// $$ \varphi = s\ \varphi_m \left(\frac{x - x_r}{x_m - x_r}\right)^n, \qquad
///    a^2 = a_m^2 \left(\frac{x - x_r}{x_m - x_r}\right)^q $$
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unloading {
    /// Flattening $x_r$ at which contact is lost.
    pub residual: f64,
    /// Exponent n of the force.
    pub exponent: f64,
    /// Exponent q of the contact area.
    pub area_exponent: f64,
    /// Share s of the loading force with which it starts; 1 but for models whose branches do not meet.
    pub start: f64,
}

impl Unloading {
    /// Hertzian branch (n = 3/2, area linear in the flattening) that loses contact at `residual`.
    #[must_use]
    pub fn hertzian(residual: f64) -> Self {
        Self {
            residual,
            exponent: 1.5,
            area_exponent: 1.0,
            start: 1.0,
        }
    }

    /// Linear branch of a spring law; such laws state no contact area, the sphere's geometry is kept.
    #[must_use]
    pub fn linear(residual: f64) -> Self {
        Self {
            residual,
            exponent: 1.0,
            area_exponent: 1.0,
            start: 1.0,
        }
    }
}

/// What a theory states: loading, contact radius and unloading, in reduced quantities ($x = \delta/R$, $F/R^2$ in
/// Pa).
///
/// Everything that states this is a [`NormalLaw`]: reloading retraces the unloading branch up to the largest
/// flattening and goes on along the loading curve.
pub trait Envelope: Clone + Send + Sync + 'static {
    /// Reduced force on first loading, Pa, for `x` > 0.
    fn loading(&self, x: f64) -> f64;
    /// Its slope, Pa.
    fn loading_slope(&self, x: f64) -> f64;
    /// Work of first loading over $R^3$, Pa: its integral from 0.
    fn loading_work(&self, x: f64) -> f64;
    /// Contact radius over R on first loading.
    fn loading_contact_radius(&self, x: f64) -> f64;
    /// Branch that leaves the loading curve at flattening `peak` with reduced force `force`.
    fn unloading(&self, peak: f64, force: f64) -> Unloading;
    /// Largest flattening the source supports; infinite when it states none.
    fn supported_to(&self) -> f64;
}

/// Memory of a contact: the largest flattening, and what follows from it (kept because it costs powers).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// Largest flattening $x_m$ so far.
    flattening: f64,
    /// Reduced force with which the branch starts there, Pa.
    force: f64,
    /// Flattening at which contact is lost.
    residual: f64,
    /// Exponent of the branch.
    exponent: f64,
}

keep_fields!(Peak: flattening, force, residual, exponent);

impl Peak {
    /// Position on the branch: 0 at loss of contact, 1 at the peak.
    fn position(&self, x: f64) -> f64 {
        if x > self.residual && x > 0.0 {
            (x - self.residual) / (self.flattening - self.residual)
        } else {
            0.0
        }
    }

    fn force(&self, x: f64) -> f64 {
        let y = self.position(x);
        if self.exponent == 1.5 {
            self.force * y * y.sqrt()
        } else if self.exponent == 1.0 {
            self.force * y
        } else {
            self.force * y.powf(self.exponent)
        }
    }
}

impl<E: Envelope> NormalLaw for E {
    type History = Peak;

    fn force(&self, x: f64, peak: &mut Peak) -> f64 {
        if x < peak.flattening || x <= 0.0 {
            return peak.force(x);
        }
        let force = self.loading(x);
        let branch = self.unloading(x, force);
        *peak = Peak {
            flattening: x,
            force: force * branch.start,
            residual: branch.residual,
            exponent: branch.exponent,
        };
        force
    }

    /// At the largest flattening itself: the slope of loading.
    fn stiffness(&self, x: f64, peak: &Peak) -> f64 {
        if x >= peak.flattening && x > 0.0 {
            return self.loading_slope(x);
        }
        let y = peak.position(x);
        if y > 0.0 {
            peak.exponent * peak.force(x) / (y * (peak.flattening - peak.residual))
        } else {
            0.0
        }
    }

    fn depth(&self, x: f64, peak: &Peak) -> f64 {
        if x >= peak.flattening {
            return x.max(0.0);
        }
        (x - peak.residual).max(0.0)
    }

    /// A branch that loses contact at no flattening is the loading curve itself.
    fn dissipated(&self, peak: &Peak) -> f64 {
        if peak.residual <= 0.0 {
            return 0.0;
        }
        self.loading_work(peak.flattening) - self.elastic_energy(peak.flattening, peak)
    }

    fn elastic_energy(&self, x: f64, peak: &Peak) -> f64 {
        peak.force(x) * (x - peak.residual) / (peak.exponent + 1.0)
    }

    fn contact_radius(&self, x: f64, peak: &Peak) -> Option<f64> {
        if x <= 0.0 {
            return Some(0.0);
        }
        if x >= peak.flattening {
            return Some(self.loading_contact_radius(x));
        }
        let branch = self.unloading(peak.flattening, peak.force);
        let widest = self.loading_contact_radius(peak.flattening);
        let position = peak.position(x);
        Some(if branch.area_exponent == 1.0 {
            widest * position.sqrt()
        } else {
            widest * position.powf(0.5 * branch.area_exponent)
        })
    }

    fn largest(&self, peak: &Peak) -> Option<f64> {
        Some(peak.flattening)
    }

    fn valid_to(&self) -> f64 {
        self.supported_to()
    }
}
