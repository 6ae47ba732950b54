//! A bed under the exported law in LIGGGHTS and LAMMPS, on one and two processors, and here: the packing of the benches.
//!
//! Two beds: solder shaken so hard that it yields, from a packing loosened until no grain touches another, so that every
//! contact begins within the run; and the settled packing of soft grains under its weight.

use crate::codes::exported::Exported;
use crate::codes::{assert_close, soft_law, solder};
use crate::packing;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::grains::Grains;
use impactlaw::export::scene::Code;
use impactlaw::export::source::portable::Portable;
use impactlaw::law::Form;
use parry3d::math::Vector;
use std::fmt::Write;
use std::path::Path;

/// Steps after which rounding has not grown yet, and at the end.
const STEPS: [usize; 2] = [50, 400];
/// Height up to which grains of the packing are taken to be shaken, m: more than three thousand.
const LOWER_THIRD: f64 = 12e-3;
/// Radius over that of the settled packing at which none of its grains touches another: its deepest contact is 0.59 %
/// of a diameter.
const LOOSE: f64 = 0.994;
/// Largest component of the velocities of shaken grains, m/s.
const SHAKE: f64 = 5.0;

/// A bed to be run.
struct Start {
    law: Portable,
    radius: f64,
    /// Height up to which grains are taken, m.
    height: f64,
    shake: f64,
    dt: f64,
}

impl Start {
    fn shaken(form: Form) -> Self {
        let law = solder(Some(form));
        let radius = LOOSE * packing::RADIUS;
        let dt = law.time_step_over_radius * radius;
        Start {
            law,
            radius,
            height: LOWER_THIRD,
            shake: SHAKE,
            dt,
        }
    }

    fn settled() -> Self {
        Start {
            law: soft_law(),
            radius: packing::RADIUS,
            // what rests on the lower ones keeps them at rest
            height: f64::INFINITY,
            shake: 0.0,
            dt: 5e-6,
        }
    }

    fn grains(&self) -> Grains {
        let mut grains = Grains::default();
        let packing = packing::packing(1);
        for place in packing
            .spheres
            .iter()
            .filter(|place| place.centre.z < self.height)
        {
            grains.add(place.centre, self.radius, self.law.material().density);
        }
        assert!(grains.len() > 3000, "{} grains", grains.len());
        for (index, motion) in grains.motions.iter_mut().enumerate() {
            let part = |salt: usize| ((index * 7919 + salt * 104_729) % 1000) as f64 / 500.0 - 1.0;
            motion.velocity = Vector::new(part(1), part(2), part(3)) * self.shake;
        }
        grains
    }

    /// The bed as a data file that LAMMPS and LIGGGHTS read.
    fn write(&self, folder: &Path) {
        let grains = self.grains();
        let mut text = format!(
            "packing\n\n{} atoms\n1 atom types\n\n0 0.046 xlo xhi\n0 0.046 ylo yhi\n0 0.12 zlo zhi\n\nAtoms\n\n",
            grains.len()
        );
        let (diameter, density) = (2.0 * self.radius, self.law.material().density);
        for (at, sphere) in grains.spheres.iter().enumerate() {
            let [x, y, z] = sphere.centre.to_array();
            let id = at + 1;
            let _ = writeln!(text, "{id} 1 {diameter:e} {density:e} {x:e} {y:e} {z:e}");
        }
        text.push_str("\nVelocities\n\n");
        for (at, motion) in grains.motions.iter().enumerate() {
            let [x, y, z] = motion.velocity.to_array();
            let _ = writeln!(text, "{} {x:e} {y:e} {z:e} 0 0 0", at + 1);
        }
        std::fs::write(folder.join("bed.data"), text).unwrap();
    }

    /// Rows of this library's bed.
    fn ours(&self) -> Vec<Row> {
        let parts = Parts {
            grains: self.grains(),
            machine: packing::walls(1),
            gravity: packing::GRAVITY,
            dt: self.dt,
            skin: 0.2 * packing::RADIUS,
        };
        let friction = Mindlin::new(&self.law.material(), 0.5);
        let effects = Law::smooth().with(Viscous::new(0.8)).with(friction);
        let mut bed = Bed::new(effects, self.law.core.visit(Both), parts);
        // velocities of this library live half a step before the positions, those given to the others do not
        bed.evaluate().unwrap();
        for grain in 0..bed.grains.len() {
            let (force, _) = bed.load(grain);
            let motion = &mut bed.grains.motions[grain];
            motion.velocity -= (force * motion.inverse_mass + bed.gravity) * (0.5 * self.dt);
        }
        let mut rows = Vec::new();
        for step in 0..=STEPS[1] {
            if STEPS.contains(&step) {
                bed.evaluate().unwrap();
                rows.push(row(&bed));
            }
            bed.step().unwrap();
        }
        rows
    }

    /// Rows of another code on one and on two processors; none where it is not installed.
    fn theirs(&self, code: Code) -> Option<[Vec<Row>; 2]> {
        let exported = Exported::of(self.law.clone(), code)?;
        self.write(&exported.folder);
        let dt = format!("{:e}", self.dt);
        Some([1, 2].map(|ranks| {
            let rows = exported.run("bed", ranks, &[("DT", &dt)], 5);
            let of = |step| rows.iter().find(|row| row[0] == step as f64).unwrap();
            let row = |step| {
                let [motion, spin, contacts, height] = of(step)[1..] else {
                    unreachable!("rows have five numbers");
                };
                Row {
                    motion,
                    spin,
                    contacts,
                    height,
                }
            };
            STEPS.map(row).to_vec()
        }))
    }
}

struct Both;

impl LawVisitor for Both {
    type Output = Normals;

    fn visit<L: NormalLaw>(self, law: &L) -> Normals {
        Normals {
            pair: Box::new(Model(Twins(law.clone()))),
            wall: Box::new(Model(Flat(law.clone()))),
        }
    }
}

/// State of a bed.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Kinetic energy of motion and of spin, J, at the time of the positions.
    motion: f64,
    spin: f64,
    /// Overlapping grains, two a pair.
    contacts: f64,
    /// Mean height of the centres, m.
    height: f64,
}

fn row(bed: &Bed<Law<(((), Viscous), Mindlin)>>) -> Row {
    let mut row = Row {
        motion: 0.0,
        spin: 0.0,
        contacts: 0.0,
        height: 0.0,
    };
    for grain in 0..bed.grains.len() {
        let (force, torque) = bed.load(grain);
        let (motion, spin) = (&bed.grains.motions[grain], &bed.grains.spins[grain]);
        let half = 0.5 * bed.dt;
        let velocity = motion.velocity + (force * motion.inverse_mass + bed.gravity) * half;
        let rate = spin.rate + torque * (spin.inverse_inertia * half);
        row.motion += 0.5 / motion.inverse_mass * velocity.length_squared();
        row.spin += 0.5 / spin.inverse_inertia * rate.length_squared();
        row.height += bed.grains.spheres[grain].centre.z / bed.grains.len() as f64;
    }
    let touching = bed.contacts.pushes.iter().filter(|push| push.touches());
    row.contacts = 2.0 * touching.count() as f64;
    row
}

/// Allowed relative deviations of the row after 50 steps and of the last one.
struct Allowed {
    energy: [f64; 2],
    contacts: [f64; 2],
    height: [f64; 2],
}

/// Rounding, and what collisions make of it.
const ROUNDING: Allowed = Allowed {
    energy: [1e-11, 1e-8],
    contacts: [0.0, 0.0],
    height: [1e-11, 1e-11],
};

fn assert_same(theirs: &[Row], ours: &[Row], allowed: &Allowed, what: &str) {
    assert_eq!([theirs.len(), ours.len()], [2, 2]);
    for (at, (a, b)) in theirs.iter().zip(ours).enumerate() {
        let what = format!("{what} after {} steps", STEPS[at]);
        for (quantity, a, b, allowed) in [
            ("energy of motion", a.motion, b.motion, allowed.energy[at]),
            ("energy of spin", a.spin, b.spin, allowed.energy[at]),
            ("contacts", a.contacts, b.contacts, allowed.contacts[at]),
            ("height", a.height, b.height, allowed.height[at]),
        ] {
            println!("{what}: {quantity} {a:.6e}, deviation {:.1e}", a / b - 1.0);
            assert_close(a, b, allowed, &format!("{what}: {quantity}"));
        }
    }
}

/// Runs the bed here and, on one and two processors, in both codes.
fn compare(start: &Start, between_processors: &Allowed, with_ours: &Allowed) {
    let ours = start.ours();
    for (code, name) in [(Code::Liggghts, "LIGGGHTS"), (Code::Lammps, "LAMMPS")] {
        let Some([one, two]) = start.theirs(code) else {
            continue;
        };
        let what = |which: &str| format!("{name} {which}");
        assert_same(&two, &one, between_processors, &what("on two processors"));
        assert_same(&one, &ours, with_ours, &what("beside this library"));
    }
    println!("{ours:?}");
}

#[test]
fn shaken_solder_in_closed_form_is_the_same_bed_everywhere() {
    let start = Start::shaken(Form::ClosedForm);
    compare(&start, &ROUNDING, &ROUNDING);
}

#[test]
fn shaken_solder_as_a_spline_is_the_same_bed_everywhere() {
    let start = Start::shaken(Form::Spline);
    compare(&start, &ROUNDING, &ROUNDING);
}

/// The packing starts in contact, and the codes do not keep what contacts learn before the first step.
#[test]
fn soft_grains_settle_alike_everywhere() {
    let on_processors = Allowed {
        energy: [1e-9, 1e-6],
        ..ROUNDING
    };
    let beside_ours = Allowed {
        energy: [1e-2, 1e-2],
        contacts: [1e-3, 1e-3],
        height: [1e-6, 1e-6],
    };
    compare(&Start::settled(), &on_processors, &beside_ours);
}
