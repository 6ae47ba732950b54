//! Flow: mass that goes through a plane, its steady rate, and Beverloo's rate of a silo.

use crate::bed::scene::region::Region;
use crate::dem::grains::Grains;

/// Shares of the mass between which a discharge is steady.
const STEADY: [f64; 2] = [0.2, 0.8];

/// Number and mass (kg) of the grains whose centre is below the height `z` (m).
#[must_use]
pub fn below(grains: &Grains, z: f64) -> (usize, f64) {
    let (mut count, mut mass) = (0, 0.0);
    for (sphere, motion) in grains.spheres.iter().zip(&grains.motions) {
        if sphere.centre.z < z {
            count += 1;
            mass += 1.0 / motion.inverse_mass;
        }
    }
    (count, mass)
}

/// Mass of the grains with their centre in a region over its volume, kg/m3.
#[must_use]
pub fn bulk_density(grains: &Grains, region: &Region) -> f64 {
    let inside = grains
        .spheres
        .iter()
        .zip(&grains.motions)
        .filter(|(sphere, _)| region.holds(sphere.centre, 0.0));
    inside
        .map(|(_, motion)| 1.0 / motion.inverse_mass)
        .sum::<f64>()
        / region.volume()
}

/// Steady rate (kg/s) of a series of times (s) and masses (kg): the slope of its least-squares line between 20 % and
/// 80 % of the last mass. `None` for fewer than three points.
#[must_use]
pub fn steady_rate(series: &[[f64; 2]]) -> Option<f64> {
    let last = series.last()?[1];
    let steady: Vec<&[f64; 2]> = series
        .iter()
        .filter(|point| point[1] > STEADY[0] * last && point[1] < STEADY[1] * last)
        .collect();
    if steady.len() < 3 {
        return None;
    }
    let count = steady.len() as f64;
    let middle = |axis: usize| steady.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (time, mass) = (middle(0), middle(1));
    let (mut tt, mut tm) = (0.0, 0.0);
    for point in &steady {
        tt += (point[0] - time).powi(2);
        tm += (point[0] - time) * (point[1] - mass);
    }
    Some(tm / tt)
}

/// Rate (kg/s) at which grains leave a flat-bottomed silo through a round orifice.
///
/// $$ W = C \rho_b \sqrt{g}\ (D - k d)^{5/2} $$
///
/// | symbol | argument | unit | meaning |
/// |---|---|---|---|
/// | C | `constants[0]` | | 0.58 for smooth spheres |
/// | k | `constants[1]` | | 1.4: the layer at the rim that does not flow, in diameters |
/// | ρ_b | `bulk_density` | kg/m3 | of the filling |
/// | g | `gravity` | m/s2 | |
/// | D | `orifice` | m | diameter of the orifice |
/// | d | `diameter` | m | of the grains |
///
/// Source: Beverloo, Leniger and van de Velde 1961, Chem. Eng. Sci. 15, 260; 0 where no grain gets through.
///
/// ```
/// use impactlaw::bed::measures::flow::beverloo;
/// // 0.58 * 1500 * sqrt(9.81) * (0.020 - 1.4 * 0.002)^2.5 = 0.1057 kg/s
/// let rate = beverloo([0.58, 1.4], 1500.0, 9.81, 0.020, 0.002);
/// assert!((rate - 0.1057).abs() < 1e-4);
/// ```
#[must_use]
pub fn beverloo(
    constants: [f64; 2],
    bulk_density: f64,
    gravity: f64,
    orifice: f64,
    diameter: f64,
) -> f64 {
    let free = (orifice - constants[1] * diameter).max(0.0);
    constants[0] * bulk_density * gravity.sqrt() * free.powf(2.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use parry3d::math::Vector;
    use std::f64::consts::PI;

    #[test]
    fn what_is_below_is_counted_and_weighed() {
        let mut grains = Grains::default();
        for z in [-1.0, -0.1, 0.1, 2.0] {
            grains.add(Vector::new(0.0, 0.0, z), 0.01, 1000.0);
        }
        let (count, mass) = below(&grains, 0.0);
        assert_eq!(count, 2);
        assert!((mass / (2000.0 * 4.0 / 3.0 * PI * 1e-6) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_discharge_has_the_rate_of_its_straight_part() {
        // slow at first, then 2 kg/s, slow at the end
        let mass = |t: f64| match t {
            t if t < 1.0 => 0.1 * t,
            t if t < 6.0 => 0.1 + 2.0 * (t - 1.0),
            t => 10.1 + 0.1 * (t - 6.0),
        };
        let series: Vec<[f64; 2]> = (0..80)
            .map(|i| [0.1 * f64::from(i), mass(0.1 * f64::from(i))])
            .collect();
        assert!((steady_rate(&series).unwrap() - 2.0).abs() < 1e-9);
        assert_eq!(steady_rate(&[]), None);
    }

    #[test]
    fn bulk_density_of_a_lattice_is_its_own() {
        let mut grains = Grains::default();
        for index in 0..8000 {
            let place = [index % 20, index / 20 % 20, index / 400].map(|i| f64::from(i) + 0.5);
            grains.add(Vector::from(place) * 2e-3, 1e-3, 2500.0);
        }
        let low = Vector::splat(4e-3);
        let region = Region::Block {
            low,
            high: Vector::splat(36e-3),
        };
        let exact = 2500.0 * PI / 6.0;
        assert!((bulk_density(&grains, &region) / exact - 1.0).abs() < 1e-9);
    }
}
