//! Where a material stands in the atlas: its dimensionless constants, and the range of those of the impacts.

use crate::material::Material;
use crate::material::flow::{HARDENING_MODULUS, YIELD_STRENGTH};
use crate::unit::significant;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};

/// Terms of a polynomial of the material.
pub const TERMS: usize = 14;

/// What of a material its law depends on, besides the units of force and flattening.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// E/Y.
    pub young_over_yield: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// H/E.
    pub hardening_over_young: f64,
}

impl Place {
    /// Place of a material.
    ///
    /// # Errors
    /// [`Error::Refused`] for one that does not yield, or whose flow stress has other constants than Y and H.
    pub fn of(material: &Material) -> Result<Self> {
        let refuse = |found: String, allowed: &str| Error::Refused {
            what: "material".to_owned(),
            found,
            allowed: allowed.to_owned(),
        };
        let Some(flow) = material.flow else {
            let allowed = "must have one: the atlas is of materials that yield; an elastic one has the law \"hertz\"";
            return Err(refuse("no yield strength".to_owned(), allowed));
        };
        let mut hardening = 0.0;
        for (constant, value) in flow.constants() {
            match constant.key {
                key if key == YIELD_STRENGTH.key => {}
                key if key == HARDENING_MODULUS.key => hardening = value,
                key => {
                    let allowed = "must be left out: the atlas knows yield strength and linear hardening; `impactlaw run` makes the law of any flow stress";
                    return Err(refuse(format!("`{key}`"), allowed));
                }
            }
        }
        Ok(Place {
            young_over_yield: material.young_modulus / flow.yield_strength(),
            poisson_ratio: material.poisson_ratio,
            hardening_over_young: hardening / material.young_modulus,
        })
    }

    /// $a = \ln(E^\ast/Y/250)/2.5$, $n = (\nu - 0.33)/0.15$, $h = \ln(1 + H/Y)/2$: of the order of 1.
    #[must_use]
    pub fn coordinates(&self) -> [f64; 3] {
        let nu = self.poisson_ratio;
        let stiff = self.young_over_yield / (1.0 - nu * nu);
        let hardening = self.hardening_over_young * self.young_over_yield;
        [
            (stiff / 250.0).ln() / 2.5,
            (nu - 0.33) / 0.15,
            hardening.ln_1p() / 2.0,
        ]
    }

    /// Terms of the polynomials: 1, a, n, h, a2, an, ah, n2, nh, h2, a3, a2h, ah2, h3.
    #[must_use]
    pub fn terms(&self) -> [f64; TERMS] {
        let [a, n, h] = self.coordinates();
        [
            1.0,
            a,
            n,
            h,
            a * a,
            a * n,
            a * h,
            n * n,
            n * h,
            h * h,
            a * a * a,
            a * a * h,
            a * h * h,
            h * h * h,
        ]
    }
}

/// Range of the impacts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// E/Y.
    pub young_over_yield: [f64; 2],
    /// nu.
    pub poisson_ratio: [f64; 2],
    /// H/E; 0 to the smallest of the hardening ones counts too.
    pub hardening_over_young: [f64; 2],
    /// $\rho V^2/Y$.
    #[serde(rename = "rho_V2_over_Y")]
    pub severity: [f64; 2],
}

/// Relative room at the ends of a range, for what text does to numbers.
const ROOM: f64 = 1e-9;

impl Range {
    /// # Errors
    /// [`Error::Refused`] naming what of a material lies outside.
    pub fn check(&self, place: &Place) -> Result<()> {
        for (what, x, [low, high]) in [
            ("E/Y", place.young_over_yield, self.young_over_yield),
            ("Poisson's ratio", place.poisson_ratio, self.poisson_ratio),
            ("H/E", place.hardening_over_young, self.hardening_over_young),
        ] {
            if !(low * (1.0 - ROOM) <= x && x <= high * (1.0 + ROOM)) {
                return Err(Error::Refused {
                    what: what.to_owned(),
                    found: significant(x, 6),
                    allowed: format!(
                        "must lie in [{}, {}], the range of the atlas; `impactlaw run` makes the law of any material from impacts of its own",
                        significant(low, 5),
                        significant(high, 5)
                    ),
                });
            }
        }
        Ok(())
    }
}
