//! Removal of a touched body: what its contacts hold leaves the account, what they have dissipated stays.

use crate::collisions::{MATERIAL, RADIUS, Straight, bed, floor};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::dem::bodies::Mobility;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::grains::Grains;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;

/// Plastic and stored energy (J) of an oblique impact that is half over, before and after its floor is taken out and
/// the grain has gone on, with the change of the balance since.
fn half_an_impact(law: impl NormalLaw) -> [[f64; 2]; 2] {
    let mass = MATERIAL.sphere_mass(RADIUS);
    let time = rebound(&law, RADIUS, mass, 2.0).contact_time;
    let effects = Law::smooth().with(Mindlin::new(&MATERIAL, 0.3));
    let mut grains = Grains::default();
    let place = Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9));
    grains.add(place, RADIUS, MATERIAL.density);
    grains.motions[0].velocity = Vector::new(0.5, 0.0, -2.0);
    let (pair, wall) = (Twins(law.clone()), Flat(law));
    let floor = floor(Mobility::Fixed);
    let mut bed = bed(effects, pair, wall, grains, floor, time / 1000.0);
    for _ in 0..500 {
        bed.step().unwrap();
    }
    bed.evaluate().unwrap();
    let before = bed.energies();
    bed.take_out(0);
    let taken = bed.energies().balance();
    for _ in 0..500 {
        bed.step().unwrap();
    }
    bed.evaluate().unwrap();
    let after = bed.energies();
    let scale = before.turnover();
    assert!((after.balance() - taken).abs() < 1e-12 * scale);
    let free = bed.grains.motions[0].velocity;
    bed.step().unwrap();
    assert_eq!(bed.grains.motions[0].velocity, free);
    [before, after].map(|e| [e.plastic / scale, (e.elastic + e.springs) / scale])
}

#[test]
fn an_elastic_contact_leaves_no_plastic_flow_when_its_body_is_taken_out() {
    let [[_, held], [plastic, left]] = half_an_impact(Hertz::of(&MATERIAL));
    assert!(held > 0.1, "the contact held {held} of the energy");
    assert!(plastic.abs() < 1e-5, "{plastic} counts as plastic flow");
    assert_eq!(left, 0.0);
}

#[test]
fn a_yielding_contact_keeps_the_plastic_flow_it_had() {
    let law = Straight {
        loading: 1e9,
        unloading: 4e9,
    };
    let [[before, held], [after, left]] = half_an_impact(law);
    assert!(
        held > 0.01 && before > 0.1,
        "{held} held, {before} dissipated"
    );
    assert!(
        (after - before).abs() < 1e-12,
        "{before} before, {after} after"
    );
    assert_eq!(left, 0.0);
}
