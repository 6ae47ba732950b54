//! Adhesive: published models of a sphere on a rigid plane that attracts it. Their forces depend on w/(E R), so they are no laws of a
//! material alone: a fit, a comparison or a bed cannot be handed one.

use super::published::Evidence;
use super::thornton;
use crate::material::adhesion::{Adhesion, Dugdale, Jkr, MaugisState, maugis, maugis_pull_off};
use crate::material::{Material, YIELD_PRESSURE_RATIO};
use std::f64::consts::PI;

/// A sphere on a rigid plane that attracts it, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StickySphere {
    /// Its material.
    pub material: Material,
    /// Its radius, m.
    pub radius: f64,
    /// What it and the plane attract each other with.
    pub adhesion: Adhesion,
}

/// Force (N, negative pulls) and contact radius (m) at an approach (m), on the branch of a contact that is being pulled off; `None`
/// where there is no contact.
pub type Force = fn(&StickySphere, f64) -> Option<[f64; 2]>;

/// A published adhesive model.
#[derive(Debug, Clone, Copy)]
pub struct AdhesiveModel {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is in a few words.
    pub summary: &'static str,
    /// Keys of its papers in `references.bib`.
    pub papers: &'static [&'static str],
    /// What its constants rest on.
    pub evidence: Evidence,
    /// Whether it needs the range of the attraction.
    pub needs_range: bool,
    /// Whether it needs a yield strength.
    pub needs_yield: bool,
    /// Force; `None` of a model that gives a restitution alone.
    pub force: Option<Force>,
    /// Largest pull, N.
    pub pull_off: Option<fn(&StickySphere) -> f64>,
    /// Restitution at a speed (m/s), 0 where the sphere stays on the plane.
    pub restitution: Option<fn(&StickySphere, f64) -> f64>,
}

/// Every adhesive model.
pub const ADHESIVE: [AdhesiveModel; 4] = [
    AdhesiveModel {
        name: "jkr",
        summary: "elastic, attraction of short range",
        papers: &["JohnsonKendallRoberts1971", "JohnsonPollock1994"],
        evidence: Evidence::Checked,
        needs_range: false,
        needs_yield: false,
        force: Some(|sphere, approach| {
            let jkr = sphere.jkr();
            // the approach is least at a^3 = pi w R^2 / (8 E*), and grows from there
            let least = (PI * jkr.work * jkr.radius.powi(2) / (8.0 * jkr.modulus)).cbrt();
            let a = root(least, jkr.radius, |a| jkr.approach(a) - approach)?;
            Some([jkr.force(a), a])
        }),
        pull_off: Some(|sphere| sphere.jkr().pull_off()),
        restitution: Some(|sphere, velocity| {
            let ratio = sphere.sticking_speed() / velocity;
            (1.0 - ratio * ratio).max(0.0).sqrt()
        }),
    },
    AdhesiveModel {
        name: "dmt",
        summary: "elastic, attraction of long range around a contact of Hertz; loses no energy",
        papers: &["DerjaguinMullerToporov1975"],
        evidence: Evidence::Checked,
        needs_range: false,
        needs_yield: false,
        force: Some(|sphere, approach| {
            let jkr = sphere.jkr();
            let a = (jkr.radius * approach.max(0.0)).sqrt();
            let hertz = 4.0 * jkr.modulus * a.powi(3) / (3.0 * jkr.radius);
            (approach >= 0.0).then(|| [hertz - jkr.dmt_pull_off(), a])
        }),
        pull_off: Some(|sphere| sphere.jkr().dmt_pull_off()),
        restitution: Some(|_, _| 1.0),
    },
    AdhesiveModel {
        name: "maugis",
        summary: "elastic, attraction of any range, by Dugdale's traction; between jkr and dmt",
        papers: &["Maugis1992"],
        evidence: Evidence::Checked,
        needs_range: true,
        needs_yield: false,
        force: Some(|sphere, approach| {
            let jkr = sphere.jkr();
            let k = 4.0 / 3.0 * jkr.modulus;
            let lambda = sphere.maugis_number()?;
            let unit = (PI * jkr.work / k).powi(2) * jkr.radius;
            let state = |log: f64| maugis(lambda, 1.0 + log.exp());
            let wanted = approach / unit.cbrt();
            // the ring grows as the contact is pulled, up to where the approach is least
            let ends = (0..400).map(|k| -25.0 + 0.1 * f64::from(k));
            let least = ends.min_by(|a, b| state(*a).approach.total_cmp(&state(*b).approach))?;
            let log = root(-least, 40.0, |log| state(-log).approach - wanted)?;
            let MaugisState { radius, force, .. } = state(-log);
            let length = (PI * jkr.work * jkr.radius.powi(2) / k).cbrt();
            Some([force * PI * jkr.work * jkr.radius, radius * length])
        }),
        pull_off: Some(|sphere| {
            let jkr = sphere.jkr();
            let found = sphere.maugis_number().map(maugis_pull_off);
            found.map_or(f64::NAN, |found| found * PI * jkr.work * jkr.radius)
        }),
        restitution: None,
    },
    AdhesiveModel {
        name: "thornton-ning",
        summary: "elastic-perfectly plastic, pressure limited at 1.6 Y; losses to yield and adhesion added",
        papers: &["ThorntonNing1998"],
        // its constants follow from jkr and thornton; the equations were seen in one source
        evidence: Evidence::Unverified,
        needs_range: false,
        needs_yield: true,
        force: None,
        pull_off: None,
        restitution: Some(|sphere, velocity| {
            let yielding = thornton::restitution(&sphere.material, YIELD_PRESSURE_RATIO, velocity);
            let ratio = sphere.sticking_speed() / velocity;
            (yielding.unwrap_or(1.0).powi(2) - ratio * ratio)
                .max(0.0)
                .sqrt()
        }),
    },
];

impl StickySphere {
    /// The sphere in the limit of a short range.
    #[must_use]
    pub fn jkr(&self) -> Jkr {
        Jkr {
            radius: self.radius,
            modulus: self.material.contact_modulus(),
            work: self.adhesion.work,
        }
    }

    /// JKR's sticking speed, m/s.
    #[must_use]
    pub fn sticking_speed(&self) -> f64 {
        let mass = self.material.sphere_mass(self.radius);
        self.jkr().sticking_speed(mass)
    }

    /// Maugis' number; `None` where the range is not given.
    #[must_use]
    pub fn maugis_number(&self) -> Option<f64> {
        let Adhesion { work, range } = self.adhesion;
        let range = range?;
        Some(Dugdale { work, range }.maugis_number(self.radius, self.material.contact_modulus()))
    }
}

/// Where `value`, which grows from `low` to `high`, is 0; `None` where it is not within.
fn root(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> Option<f64> {
    if value(low) > 0.0 || value(high) < 0.0 {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if value(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Flow;

    fn sphere(lambda: f64) -> StickySphere {
        let (work, radius) = (0.1, 1e-6);
        let material = Material {
            density: 1000.0,
            young_modulus: 1e9,
            poisson_ratio: 0.3,
            flow: Some(Flow::perfectly_plastic(2e7)),
        };
        let range = Dugdale::range_at(lambda, work, radius, material.contact_modulus());
        StickySphere {
            material,
            radius,
            adhesion: Adhesion {
                work,
                range: Some(range),
            },
        }
    }

    fn model(name: &str) -> AdhesiveModel {
        ADHESIVE.into_iter().find(|m| m.name == name).unwrap()
    }

    #[test]
    fn maugis_is_jkr_at_a_large_number_and_pulls_as_dmt_at_a_small_one() {
        let [jkr, maugis] = ["jkr", "maugis"].map(|name| model(name).force.unwrap());
        for approach in [-5e-10, 0.0, 5e-9, 2e-8] {
            let [f, a] = jkr(&sphere(40.0), approach).unwrap();
            let [g, b] = maugis(&sphere(40.0), approach).unwrap();
            let pull = sphere(1.0).jkr().pull_off();
            assert!((f - g).abs() < 0.02 * pull, "{approach} {f} {g}");
            assert!((a / b - 1.0).abs() < 0.02, "{approach} {a} {b}");
        }
        let weak = sphere(0.01);
        let dmt = model("dmt").pull_off.unwrap()(&weak);
        assert!((model("maugis").pull_off.unwrap()(&weak) / dmt - 1.0).abs() < 0.01);
        assert_eq!(jkr(&weak, -1e-7), None, "beyond where it breaks");
    }

    #[test]
    fn restitution_vanishes_at_the_sticking_speed_and_is_thornton_s_far_above() {
        let sphere = sphere(4.0);
        let speed = sphere.sticking_speed();
        let jkr = model("jkr").restitution.unwrap();
        assert_eq!(jkr(&sphere, 0.99 * speed), 0.0);
        assert!((jkr(&sphere, 2.0 * speed) - 0.75f64.sqrt()).abs() < 1e-12);
        let both = model("thornton-ning").restitution.unwrap();
        let fast = 1e3 * speed;
        let yielding = thornton::restitution(&sphere.material, 1.6, fast).unwrap();
        assert!((both(&sphere, fast) / yielding - 1.0).abs() < 1e-3);
    }
}
