//! Attraction: the wall pulls the surface across gaps within a range, with the constant traction of Dugdale.
//!
//! Between two neighbouring surface points a and b the gap is taken as a straight line in the squared distance from the axis, s = r^2,
//! which is exact for a sphere that is not deformed up to the square of gap over radius. The energy of the surface is then a sum
//! over the pieces of its meridian,
//!
//! $$ U = \sum \pi (s_b - s_a)\ \varphi_{ab}, \qquad \varphi(g) = -w \max(1 - g/h_0, 0), $$
//!
//! with the mean $\varphi_{ab}$ of $\varphi$ over the piece in closed form, also where the range ends in it. Forces are its derivatives, so they are
//! continuous as pieces leave the range, there is no staircase of points, and the energy is exact: what is attracted can
//! be counted. Areas are those of the deformed surface as the wall sees it, which also pulls the edge of the attracted surface outwards.
//!
//! Below the wall $\varphi$ goes on as it is: within the contact the traction presses the surface on the wall, and the contact's
//! impulses carry it. A piece that has folded over, whose outer end is nearer to the axis, is left out.

use crate::material::adhesion::Dugdale;
use std::f64::consts::PI;

/// What attraction does at one moment.
#[derive(Debug, Clone, Copy, Default)]
pub struct Pull {
    /// Force towards the wall.
    pub force: f64,
    /// Energy of the surface, 0 out of range.
    pub energy: f64,
}

/// Attraction of the surface by the wall; `()` is none, and takes no memory.
pub trait Attraction: Clone {
    /// Whether there is any.
    const ON: bool;
    /// Forces (across, up), one a surface point; of none no memory.
    type Forces: Clone + Default + std::fmt::Debug + AsRef<[[f64; 2]]>;
    /// Gap from which on there is none.
    fn range(&self) -> f64;
    /// Traction over the modulus of the body: the order of the speeds at which surfaces snap together, in those of waves.
    fn strength(&self) -> f64;
    /// Forces (across, up) on surface points at these `places` (distance from the axis, gap), in order from the axis outwards, and
    /// what they sum to. Written to `forces`, one a point.
    fn pull(&self, places: impl Iterator<Item = [f64; 2]>, forces: &mut Self::Forces) -> Pull;
}

impl Attraction for () {
    const ON: bool = false;
    type Forces = [[f64; 2]; 0];

    fn range(&self) -> f64 {
        0.0
    }
    fn strength(&self) -> f64 {
        0.0
    }
    fn pull(&self, _: impl Iterator<Item = [f64; 2]>, _: &mut Self::Forces) -> Pull {
        Pull::default()
    }
}

impl Attraction for Dugdale {
    const ON: bool = true;
    type Forces = Vec<[f64; 2]>;

    fn range(&self) -> f64 {
        self.range
    }

    fn strength(&self) -> f64 {
        Dugdale::strength(self)
    }

    fn pull(&self, places: impl Iterator<Item = [f64; 2]>, forces: &mut Self::Forces) -> Pull {
        forces.clear();
        let mut pull = Pull::default();
        let mut before: Option<(f64, f64)> = None;
        for [radius, gap] in places {
            // how far within the range, 1 at the wall
            let within = 1.0 - gap / self.range;
            forces.push([0.0; 2]);
            if let Some((inner, depth)) = before {
                let ring = PI * (radius * radius - inner * inner);
                let [mean, inner_slope, outer_slope] = mean(depth, within);
                if ring > 0.0 && mean > 0.0 {
                    let k = forces.len() - 1;
                    let per_gap = self.work * ring / self.range;
                    pull.energy -= self.work * ring * mean;
                    pull.force += per_gap * (inner_slope + outer_slope);
                    forces[k - 1][1] -= per_gap * inner_slope;
                    forces[k][1] -= per_gap * outer_slope;
                    // the more area, the more energy: the edge of the range is pulled outwards
                    let per_radius = 2.0 * PI * self.work * mean;
                    forces[k - 1][0] -= per_radius * inner;
                    forces[k][0] += per_radius * radius;
                }
            }
            before = Some((radius, within));
        }
        pull
    }
}

/// Mean of max(x, 0) for x from `a` to `b` along a straight line, and its derivatives to both.
#[inline(always)]
fn mean(a: f64, b: f64) -> [f64; 3] {
    if a >= 0.0 && b >= 0.0 {
        return [0.5 * (a + b), 0.5, 0.5];
    }
    if a <= 0.0 && b <= 0.0 {
        return [0.0; 3];
    }
    let (inside, outside) = if a > b { (a, b) } else { (b, a) };
    let share = inside / (inside - outside);
    let inner = 0.5 * share * (2.0 - share);
    let outer = 0.5 * share * share;
    let value = 0.5 * inside * share;
    if a > b {
        [value, inner, outer]
    } else {
        [value, outer, inner]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: Dugdale = Dugdale {
        work: 0.3,
        range: 0.02,
    };

    fn sphere(height: f64, points: usize) -> Vec<[f64; 2]> {
        let angle = |k: usize| 0.5 * k as f64 / points as f64;
        (0..=points)
            .map(|k| {
                [
                    angle(k).sin(),
                    height + 2.0 * (0.5 * angle(k)).sin().powi(2),
                ]
            })
            .collect()
    }

    #[test]
    fn a_sphere_that_is_not_deformed_is_pulled_with_derjaguin_s_force() {
        let mut forces = Vec::new();
        let touching = LAW.pull(sphere(0.0, 60).into_iter(), &mut forces);
        // 2 pi w R, and less by the share h0/2R of the sphere that is no paraboloid
        let found = touching.force / (2.0 * PI * LAW.work);
        assert!((found - (1.0 - 0.5 * LAW.range)).abs() < 1e-4, "{found}");
        let found = touching.energy / (PI * LAW.work * LAW.range);
        assert!((found + 1.0).abs() < 0.01, "{found}");
        let up: f64 = forces.iter().map(|f| f[1]).sum();
        assert!((up + touching.force).abs() < 1e-12);
        let beyond = LAW.pull(sphere(LAW.range, 60).into_iter(), &mut forces);
        assert_eq!((beyond.force, beyond.energy), (0.0, 0.0));
    }

    #[test]
    fn forces_are_the_derivatives_of_the_energy_wherever_the_range_ends() {
        let mut scrap = Vec::new();
        let mut forces = Vec::new();
        // gaps that go out of range and come back
        let places: Vec<[f64; 2]> = (0..30)
            .map(|k| {
                let k = f64::from(k);
                [
                    0.01 * k + 0.002 * (2.0 * k).sin(),
                    0.02 + 0.03 * (0.9 * k).sin(),
                ]
            })
            .collect();
        LAW.pull(places.iter().copied(), &mut forces);
        for (k, force) in forces.iter().enumerate().skip(1) {
            for axis in 0..2 {
                let mut energy = |step: f64| {
                    let mut moved = places.clone();
                    moved[k][axis] += step;
                    LAW.pull(moved.into_iter(), &mut scrap).energy
                };
                let slope = (energy(1e-7) - energy(-1e-7)) / 2e-7;
                assert!(
                    (slope + force[axis]).abs() < 1e-6 * (1.0 + slope.abs()),
                    "{k} {axis} {slope} {force:?}"
                );
            }
        }
    }
}
