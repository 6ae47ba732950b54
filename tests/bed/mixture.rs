//! Mixtures: contacts of two materials against Hertz, their limits, and beds of several materials.

use impactlaw::contact::pair::{Alike, Flat, Pressed};
use impactlaw::contact::rebound::rebound;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::bodies::{Body, Mobility, Solid};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::by_material::Table;
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::{ContactLaw, Law};
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::mixture::{Mixture, RIGID};
use impactlaw::dem::force::named::{Effects, mixed};
use impactlaw::dem::force::normal::{Histories, Model, NormalModel, Squeeze};
use impactlaw::dem::force::paired::OfPair;
use impactlaw::dem::grains::Grains;
use impactlaw::law::AnyLaw;
use impactlaw::material::{Effective, Flow, Material, YIELD_PRESSURE_RATIO};
use impactlaw::tape::Tape;
use impactlaw::theory::Theory;
use impactlaw::theory::thornton::Thornton;
use parry3d::math::{Rotation, Vector};

const RADIUS: f64 = 1e-3;

const fn material(young_modulus: f64, poisson_ratio: f64, yield_strength: f64) -> Material {
    Material {
        density: 2500.0,
        young_modulus,
        poisson_ratio,
        flow: Some(Flow::perfectly_plastic(yield_strength)),
    }
}

const SOFT: Material = material(5e7, 0.3, 1e6);
const HARD: Material = material(2e8, 0.2, 3e6);

fn mixture(materials: &[(Theory, Material)]) -> Mixture {
    let laws: Vec<(AnyLaw, Material)> = materials
        .iter()
        .map(|&(theory, material)| (AnyLaw::Theory(theory, material), material))
        .collect();
    Mixture::new(laws.iter().map(|(law, material)| (law, material))).unwrap()
}

/// One contact between bodies of `materials`.
fn contact(model: &dyn NormalModel, materials: [u8; 2]) -> Box<dyn Histories> {
    model.chunks(&[], &[None], 1, &|_| materials).pop().unwrap()
}

fn press(contact: &mut dyn Histories, overlap: f64, radii: [f64; 2]) -> Pressed {
    let mut pressed = [Pressed::default()];
    contact.press(&[0], &[Squeeze { overlap, radii }], &mut pressed);
    pressed[0]
}

#[test]
fn elastic_grains_of_two_materials_and_sizes_are_pressed_as_hertz_says() {
    let elastic = mixture(&[(Theory::Hertz, SOFT), (Theory::Hertz, HARD)]);
    for radii in [
        [RADIUS, RADIUS],
        [RADIUS, 4.0 * RADIUS],
        [2.0 * RADIUS, f64::INFINITY],
    ] {
        let pressed = press(&mut *contact(&elastic, [0, 1]), 1e-5, radii);
        let modulus = 1.0 / (1.0 / SOFT.contact_modulus() + 1.0 / HARD.contact_modulus());
        let effective = 1.0 / (1.0 / radii[0] + 1.0 / radii[1]);
        let force = 4.0 / 3.0 * modulus * effective.sqrt() * 1e-5f64.powf(1.5);
        assert!((pressed.force / force - 1.0).abs() < 1e-12, "{radii:?}");
        assert!((pressed.stiffness * 1e-5 / (1.5 * force) - 1.0).abs() < 1e-12);
        assert!((pressed.contact_radius / (effective * 1e-5).sqrt() - 1.0).abs() < 1e-12);
        assert!((pressed.flattening.iter().sum::<f64>() / 1e-5 - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_stiff_partner_is_a_wall_and_one_material_needs_no_mixture() {
    let law = Thornton::of(&SOFT, YIELD_PRESSURE_RATIO).unwrap();
    let stiff = Material {
        young_modulus: 1e9 * SOFT.young_modulus,
        ..HARD
    };
    let model = mixture(&[(Theory::Thornton, SOFT), (Theory::Hertz, stiff)]);
    let mut almost_rigid = contact(&model, [0, 1]);
    let mut rigid = contact(&model, [0, RIGID]);
    let mut wall = contact(&Model(Flat(law)), [0, RIGID]);
    let mut alike = contact(&Model(Alike(law)), [0, 0]);
    let mut same = contact(&model, [0, 0]);
    // loading past yield, unloading, reloading
    for overlap in [1e-6, 2e-5, 6e-5, 5e-5, 4e-5, 5.5e-5, 8e-5, 7e-5] {
        let on_wall = [RADIUS, f64::INFINITY];
        let by_wall = press(&mut *wall, overlap, on_wall);
        assert_eq!(press(&mut *rigid, overlap, on_wall), by_wall);
        let by_stiff = press(&mut *almost_rigid, overlap, on_wall);
        let off = (by_stiff.force - by_wall.force).abs();
        assert!(off <= 1e-5 * by_wall.force, "{by_stiff:?} {by_wall:?}");
        let radii = [RADIUS, 2.0 * RADIUS];
        let (a, b) = (
            press(&mut *same, overlap, radii),
            press(&mut *alike, overlap, radii),
        );
        assert!((a.force - b.force).abs() <= 1e-12 * b.force);
        assert!((a.stiffness - b.stiffness).abs() <= 1e-12 * b.stiffness);
    }
}

#[test]
fn the_softer_side_yields_and_each_keeps_its_own_history() {
    let model = mixture(&[(Theory::Thornton, SOFT), (Theory::Thornton, HARD)]);
    let mut mixed = contact(&model, [0, 1]);
    let radii = [RADIUS; 2];
    let work = |mixed: &mut dyn Histories, from: f64, to: f64| {
        let steps = 4000;
        (0..steps)
            .map(|k| {
                let at = from + (to - from) * (k as f64 + 0.5) / f64::from(steps);
                press(mixed, at, radii).force * (to - from) / f64::from(steps)
            })
            .sum::<f64>()
    };
    let loading = work(&mut *mixed, 0.0, 6e-5);
    let squeeze = Squeeze {
        overlap: 6e-5,
        radii,
    };
    let held = press(&mut *mixed, 6e-5, radii);
    let elastic = mixed.elastic_energy(0, squeeze);
    assert!(held.flattening[0] > held.flattening[1]);
    assert!(elastic < 0.9 * loading, "{elastic} of {loading}");
    let returned = -work(&mut *mixed, 6e-5, 0.0);
    assert!(
        (returned / elastic - 1.0).abs() < 1e-4,
        "{returned} {elastic}"
    );
    // swapped bodies feel the same
    let mut swapped = contact(&model, [1, 0]);
    let other = press(&mut *swapped, 6e-5, radii);
    let mut again = contact(&model, [0, 1]);
    let one = press(&mut *again, 6e-5, radii);
    assert!((other.force / one.force - 1.0).abs() < 1e-12);
}

/// Twenty grains of two materials and sizes that fall into a corner of a floor.
fn bed<C: ContactLaw>(effects: C, normals: Normals, kinds: [u8; 2], steps: usize) -> Bed<C> {
    let mut grains = Grains::default();
    for index in 0..40usize {
        let place = [index % 3, index / 3 % 3, index / 9].map(|at| at as f64);
        let jitter = 0.05 * ((index * 7919) % 13) as f64 / 13.0;
        let radius = RADIUS * (0.8 + 0.2 * (index % 2) as f64);
        let centre = Vector::from(place) * (2.1 * RADIUS)
            + Vector::new(jitter, jitter * 0.5, 0.6) * RADIUS * 2.0;
        let kind = kinds[index % 2];
        let density = if kind == 0 {
            SOFT.density
        } else {
            HARD.density
        };
        grains.add_of(kind, centre, radius, density);
    }
    let edge = 40.0 * RADIUS;
    let body = Body {
        name: "floor".to_owned(),
        solid: Solid::Cuboid(Vector::splat(edge)),
        centre: Vector::new(0.0, 0.0, -edge),
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Fixed,
        material: None,
    };
    let gravity = Vector::new(0.0, 0.0, -9.81);
    let parts = Parts {
        grains,
        machine: Machine::new(vec![body], gravity, RADIUS).unwrap(),
        gravity,
        dt: 2e-6,
        skin: 0.2 * RADIUS,
    };
    let mut bed = Bed::new(effects, normals, parts);
    for _ in 0..steps {
        bed.step().unwrap();
    }
    bed
}

fn both(mixture: &Mixture) -> Normals {
    Normals {
        pair: Box::new(mixture.clone()),
        wall: Box::new(mixture.clone()),
    }
}

fn effects(of: impl Fn(usize, Option<usize>) -> f64) -> Table<Effects> {
    let materials = [SOFT, HARD];
    Table::new(2, |a, b| {
        let sides = [Some(&materials[a]), b.map(|b| &materials[b])];
        Effects {
            damping: Some(Viscous::new(0.8)),
            friction: Some(Mindlin::between(sides, of(a, b))),
            rolling: None,
        }
    })
}

#[test]
fn a_bed_of_one_material_is_the_same_as_a_mixture() {
    let thornton = Thornton::of(&SOFT, YIELD_PRESSURE_RATIO).unwrap();
    let normals = Normals {
        pair: Box::new(Model(Alike(thornton))),
        wall: Box::new(Model(Flat(thornton))),
    };
    let one = bed(
        Law::smooth()
            .with(Viscous::new(0.8))
            .with(Mindlin::new(&SOFT, 0.3)),
        normals,
        [0, 0],
        6000,
    );
    let materials = [(Theory::Thornton, SOFT), (Theory::Thornton, SOFT)];
    let law = mixed(&effects(|_, _| 0.3));
    let two = bed(law, both(&mixture(&materials)), [0, 0], 6000);
    assert!(one.losses().damping > 0.0 && one.losses().friction > 0.0);
    for (a, b) in one.grains.spheres.iter().zip(&two.grains.spheres) {
        assert!((a.centre - b.centre).length() < 1e-9 * RADIUS);
    }
}

#[test]
fn a_mixture_closes_its_energy_and_remembers_across_listings() {
    let materials = [(Theory::Thornton, SOFT), (Theory::Hertz, HARD)];
    let law = mixed(&effects(|a, b| if b == Some(a) { 0.5 } else { 0.2 }));
    let mut bed = bed(law, both(&mixture(&materials)), [0, 1], 0);
    bed.evaluate().unwrap();
    let start = bed.energies();
    for step in 0..20_000 {
        bed.step().unwrap();
        if step % 1000 == 0 {
            bed.list_again();
        }
    }
    bed.evaluate().unwrap();
    let end = bed.energies();
    assert!(end.plastic > 0.0 && end.losses.friction > 0.0, "{end:?}");
    let off = (end.balance() - start.balance()).abs();
    assert!(off < 2e-3 * end.turnover(), "{off} of {}", end.turnover());
}

/// The law of both materials together, which is that of the sphere that stands for them.
fn of_both(theory: Theory) -> AnyLaw {
    AnyLaw::Theory(theory, Effective::of(&SOFT, RADIUS, &HARD, None).material)
}

/// Laws in series, but for the two materials together.
fn paired(theory: Theory, ratio: f64) -> Mixture {
    let law = of_both(theory);
    let own = OfPair {
        between: [0, 1],
        law: &law,
        ratio,
    };
    mixture(&[(theory, SOFT), (theory, HARD)])
        .with_pairs([own])
        .unwrap()
}

#[test]
fn the_law_of_a_pair_presses_its_two_materials_and_no_other_contact() {
    // elastic: two laws in series and one of both are Hertz's, for any radii and in either order
    let (series, one) = (
        mixture(&[(Theory::Hertz, SOFT), (Theory::Hertz, HARD)]),
        paired(Theory::Hertz, 1.0),
    );
    for materials in [[0, 1], [1, 0]] {
        for radii in [[RADIUS; 2], [RADIUS, 3.0 * RADIUS], [RADIUS, f64::INFINITY]] {
            let [mut a, mut b] = [&series, &one].map(|model| contact(model, materials));
            let [a, b] = [&mut a, &mut b].map(|one| press(&mut **one, 1e-5, radii));
            for (a, b) in [
                (a.force, b.force),
                (a.stiffness, b.stiffness),
                (a.contact_radius, b.contact_radius),
                (a.flattening[0], b.flattening[0]),
                (a.flattening[1], b.flattening[1]),
                (a.depth, b.depth),
            ] {
                assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
            }
        }
    }
    // all other contacts keep their bits
    let (series, one) = (
        mixture(&[(Theory::Thornton, SOFT), (Theory::Thornton, HARD)]),
        paired(Theory::Thornton, f64::INFINITY),
    );
    for materials in [[0, 0], [1, 1], [0, RIGID], [1, RIGID]] {
        let [mut a, mut b] = [&series, &one].map(|model| contact(model, materials));
        for overlap in [2e-5, 6e-5, 5e-5, 1e-4] {
            let radii = match materials[1] {
                RIGID => [RADIUS, f64::INFINITY],
                _ => [RADIUS, 1.5 * RADIUS],
            };
            assert_eq!(
                press(&mut *a, overlap, radii),
                press(&mut *b, overlap, radii)
            );
        }
    }
    // of several laws for one pair the last is taken
    let laws = [of_both(Theory::Hertz), of_both(Theory::Thornton)];
    let several = laws.each_ref().map(|law| OfPair {
        between: [1, 0],
        law,
        ratio: 1.0,
    });
    let several = mixture(&[(Theory::Hertz, SOFT), (Theory::Hertz, HARD)])
        .with_pairs(several)
        .unwrap();
    let radii = [RADIUS, f64::INFINITY];
    let [last, expected] =
        [&several, &one].map(|model| press(&mut *contact(model, [0, 1]), 6e-5, radii));
    assert_eq!(last.force, expected.force);
}

#[test]
fn a_contact_under_the_law_of_a_pair_remembers_gives_back_and_tells_its_range() {
    let model = paired(Theory::Thornton, f64::INFINITY);
    let radii = [RADIUS, f64::INFINITY];
    let mut held = contact(&model, [0, 1]);
    let count = 4000;
    let work = |held: &mut dyn Histories, from: f64, to: f64| {
        let part = |k: i32| from + (to - from) * (f64::from(k) + 0.5) / f64::from(count);
        let force = |k: i32| press(held, part(k), radii).force * (to - from) / f64::from(count);
        (0..count).map(force).sum::<f64>()
    };
    let deepest = 6e-5;
    let loading = work(&mut *held, 0.0, deepest);
    press(&mut *held, deepest, radii);
    let squeeze = Squeeze {
        overlap: deepest,
        radii,
    };
    let (elastic, lost) = (held.elastic_energy(0, squeeze), held.dissipated(0, radii));
    assert!(lost > 0.1 * loading);
    assert!(((elastic + lost) / loading - 1.0).abs() < 1e-4);
    let back = -work(&mut *held, deepest, 0.0);
    assert!((back / elastic - 1.0).abs() < 1e-4, "{back} {elastic}");
    assert_eq!(held.largest_overlap(0, radii), Some(deepest));
    // taken to another contact of the two materials it goes on there, and a kept one comes back
    let mut tape = Tape::default();
    held.save(&mut tape);
    let mut kept = contact(&model, [RIGID; 2]);
    kept.load(&mut Tape::from_bytes(tape.as_bytes().to_vec()))
        .unwrap();
    assert!(kept.same(&*held));
    let history = held.take(0);
    assert_eq!(held.largest_overlap(0, radii), Some(0.0));
    let mut other = contact(&model, [0, 1]);
    other.put(0, &*history);
    let at = 5e-5;
    assert_eq!(press(&mut *other, at, radii), press(&mut *kept, at, radii));
    // made of a sphere on a half-space; between spheres it is told to be beyond its range once curvature matters
    let beyond = |materials: [u8; 2], radii: [f64; 2], x: f64| {
        let mut one = contact(&model, materials);
        let effective = 1.0 / (1.0 / radii[0] + 1.0 / radii[1]);
        let overlap = x * effective;
        press(&mut *one, overlap, radii);
        one.coverage(0, Squeeze { overlap, radii }).beyond
    };
    let flat = f64::INFINITY;
    assert!(!beyond([0, 1], [RADIUS, flat], 0.05));
    for (materials, radii) in [([0, 1], [RADIUS; 2]), ([1, 0], [RADIUS, flat])] {
        assert!(!beyond(materials, radii, 0.019), "{radii:?}");
        assert!(beyond(materials, radii, 0.021), "{radii:?}");
    }
}

#[test]
fn a_grain_rebounds_from_a_body_as_the_law_of_the_pair_says() {
    let law = Thornton::of(
        &Effective::of(&SOFT, RADIUS, &HARD, None).material,
        YIELD_PRESSURE_RATIO,
    )
    .unwrap();
    let velocity = 0.5;
    let mass = SOFT.sphere_mass(RADIUS);
    let expected = rebound(&law, RADIUS, mass, velocity);
    assert!(expected.restitution < 0.8, "{expected:?}");
    let mut grains = Grains::default();
    let above = Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9));
    grains.add_of(0, above, RADIUS, SOFT.density);
    grains.motions[0].velocity = Vector::new(0.0, 0.0, -velocity);
    let edge = 20.0 * RADIUS;
    let body = Body {
        name: "block".to_owned(),
        solid: Solid::Cuboid(Vector::splat(edge)),
        centre: Vector::new(0.0, 0.0, -edge),
        rotation: Rotation::IDENTITY,
        mobility: Mobility::Fixed,
        material: Some(1),
    };
    let parts = Parts {
        grains,
        machine: Machine::new(vec![body], Vector::ZERO, RADIUS).unwrap(),
        gravity: Vector::ZERO,
        dt: expected.contact_time / 400.0,
        skin: RADIUS,
    };
    let model = paired(Theory::Thornton, f64::INFINITY);
    let none = Table::new(2, |_, _| Effects::default());
    let mut bed = Bed::new(mixed(&none), both(&model), parts);
    let steps = 600;
    for _ in 0..steps {
        bed.step().unwrap();
    }
    let speed = bed.grains.motions[0].velocity.z;
    let restitution = speed / velocity;
    assert!(
        (restitution / expected.restitution - 1.0).abs() < 1e-3,
        "{restitution} {expected:?}"
    );
}
