//! Reference impacts of a law: figures and a trajectory that every dialect has to give again.

use crate::contact::rebound::{Rebound, State, rebound, trajectory};
use crate::contact::{LawVisitor, NormalLaw};
use crate::law::pair::PairTable;
use crate::law::{FittedLaw, LawFile};
use crate::unit::significant;

/// Points of the trajectory.
const POINTS: usize = 12;
/// Radius of the second body over that of the first in the impact of unequal bodies.
const SMALLER: f64 = 0.5;

/// Impacts of bodies under the law at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Equal spheres and a sphere on a wall at every speed, the fastest first, then spheres of unequal radii; of a pair its two bodies.
    pub impacts: Vec<Impact>,
    /// Path of the first two impacts, which flatten each body alike: equal spheres at twice the speed of a sphere on a wall.
    pub trajectory: Vec<Point>,
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Radii, m; the second 0 for a wall.
    pub radii: [f64; 2],
    /// Effective mass, kg.
    pub mass: f64,
    /// Relative speed, m/s.
    pub velocity: f64,
    /// What comes out; displacements are overlaps.
    pub figures: Rebound,
}

/// One instant of an impact, per body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Time since first touch, s.
    pub time: f64,
    /// Flattening of each body, of a pair of both together, m.
    pub flattening: f64,
    /// Force, N.
    pub force: f64,
}

/// Reference of the law at rest `law` of a file.
pub(crate) fn of(law: &FittedLaw, file: &LawFile) -> Reference {
    law.visit(Maker(file))
}

struct Maker<'a>(&'a LawFile);

impl LawVisitor for Maker<'_> {
    type Output = Reference;

    fn visit<L: NormalLaw>(self, law: &L) -> Reference {
        let file = self.0;
        let radius = file.provenance.radius_m;
        let mass = file.material().sphere_mass(radius);
        if let Some(bodies) = &file.pair {
            return of_pair(law, file, bodies);
        }
        let mut impacts = Vec::new();
        for velocity in speeds(file) {
            let figures = rebound(law, radius, mass, velocity);
            impacts.push(Impact {
                radii: [radius, radius],
                mass: 0.5 * mass,
                velocity: 2.0 * velocity,
                figures: doubled(figures),
            });
            impacts.push(Impact {
                radii: [radius, 0.0],
                mass,
                velocity,
                figures,
            });
        }
        let fastest = file.valid.velocity_max_m_s;
        impacts.push(unequal(law, file, fastest));
        Reference {
            impacts,
            trajectory: thinned(&trajectory(law, radius, mass, fastest)),
        }
    }
}

/// Reference of a pair: its own two bodies at every speed, the fastest first, whose path is the trajectory.
fn of_pair<L: NormalLaw>(law: &L, file: &LawFile, bodies: &PairTable) -> Reference {
    let radius = file.provenance.radius_m;
    let mass = file.material().sphere_mass(radius);
    let impact = |velocity: f64| Impact {
        radii: [
            bodies.particle_radius_m,
            bodies.target_radius_m.unwrap_or(0.0),
        ],
        mass,
        velocity,
        figures: rebound(law, radius, mass, velocity),
    };
    let fastest = file.valid.velocity_max_m_s;
    Reference {
        impacts: speeds(file).into_iter().map(impact).collect(),
        trajectory: thinned(&trajectory(law, radius, mass, fastest)),
    }
}

/// The fastest, the middle (on a logarithmic axis) and the slowest speed of the law's range.
fn speeds(file: &LawFile) -> Vec<f64> {
    let (slow, fast) = (file.valid.velocity_min_m_s, file.valid.velocity_max_m_s);
    let middle = (slow * fast).sqrt();
    let middle = significant(middle, 3).parse().unwrap_or(middle);
    let mut speeds = vec![fast, middle, slow];
    speeds.dedup();
    speeds
}

/// Impact of a sphere on a smaller one: each side takes half the overlap like a sphere of radius $2 R_e$ on a plane, as
/// in [`crate::contact::pair::Alike`].
fn unequal<L: NormalLaw>(law: &L, file: &LawFile, velocity: f64) -> Impact {
    let radius = file.provenance.radius_m;
    let radii = [radius, SMALLER * radius];
    let masses = radii.map(|radius| file.material().sphere_mass(radius));
    let mass = masses[0] * masses[1] / (masses[0] + masses[1]);
    let side = 2.0 * radii[0] * radii[1] / (radii[0] + radii[1]);
    Impact {
        radii,
        mass,
        velocity,
        figures: doubled(rebound(law, side, 2.0 * mass, 0.5 * velocity)),
    }
}

/// Figures of two bodies from those of one on a wall: the overlap is twice the flattening.
fn doubled(figures: Rebound) -> Rebound {
    Rebound {
        max_displacement: 2.0 * figures.max_displacement,
        residual_displacement: 2.0 * figures.residual_displacement,
        ..figures
    }
}

/// At most `POINTS` states, evenly picked, without those at rest on either end.
fn thinned(states: &[State]) -> Vec<Point> {
    let inner = states.len().saturating_sub(2);
    let count = POINTS.min(inner);
    (0..count)
        .map(|k| &states[1 + k * inner / count])
        .map(|state| Point {
            time: state.time,
            flattening: state.displacement,
            force: state.force,
        })
        .collect()
}
