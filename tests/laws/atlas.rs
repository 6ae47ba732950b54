//! Laws of the atlas: every material of its range has an admissible one, and no other material has any.

use impactlaw::atlas::Atlas;
use impactlaw::contact::guarantees;
use impactlaw::contact::rebound::rebound;
use impactlaw::law::{AnyLaw, FittedLaw, LawFile};
use impactlaw::material::flow::LinearHardening;
use impactlaw::material::{Flow, Material};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn material(ratio: f64, nu: f64, hardening: f64) -> Material {
    let young_modulus = 100e9;
    let strength = young_modulus / ratio;
    let flow = match hardening {
        0.0 => Flow::perfectly_plastic(strength),
        share => LinearHardening {
            strength,
            modulus: share * young_modulus,
        }
        .into(),
    };
    Material {
        density: 8000.0,
        young_modulus,
        poisson_ratio: nu,
        flow: Some(flow),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(1), cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn every_law_of_the_range_keeps_the_guarantees(a in 0.0f64..=1.0, n in 0.0f64..=1.0, h in 0.0f64..=1.0, hard: bool, q in 0.0f64..=1.0) {
        let atlas = Atlas::built_in().unwrap();
        let between = |[low, high]: [f64; 2], u: f64| low + u * (high - low);
        let log = |[low, high]: [f64; 2], u: f64| low * (high / low).powf(u);
        let range = atlas.range;
        let share = range.hardening_over_young[1] * h * h * h;
        let material = material(
            log(range.young_over_yield, a),
            between(range.poisson_ratio, n),
            if hard { share } else { 0.0 },
        );
        let law = atlas.law(&material).unwrap();
        // monotone, never tensile, unloading below loading, no cycle yields energy
        prop_assert!(guarantees::check(&law).is_ok());
        let (radius, mass) = (1e-3, material.sphere_mass(1e-3));
        let [slow, fast] = atlas.velocities(&material);
        let velocity = log([slow, fast], q);
        let here = rebound(&law, radius, mass, velocity);
        prop_assert!((0.0..=1.0).contains(&here.restitution), "{}", here.restitution);
        let faster = rebound(&law, radius, mass, 1.1 * velocity);
        prop_assert!(faster.max_force > here.max_force && faster.max_displacement > here.max_displacement);
        // far below yield it is Hertz's
        let gentle = rebound(&law, radius, mass, 1e-3 * slow.min(material.yield_point(radius, 1.6).unwrap().velocity));
        prop_assert!((gentle.restitution - 1.0).abs() < 1e-6);
    }
}

#[test]
fn materials_beyond_the_range_are_refused_by_name() {
    let atlas = Atlas::built_in().unwrap();
    let range = atlas.range;
    for (place, x, named) in [
        (0, 1.01 * range.young_over_yield[1], "E/Y"),
        (0, 0.99 * range.young_over_yield[0], "E/Y"),
        (1, 1.01 * range.poisson_ratio[1], "Poisson"),
        (1, 0.9 * range.poisson_ratio[0], "Poisson"),
        (2, 1.01 * range.hardening_over_young[1], "H/E"),
    ] {
        let mut all = [100.0, 0.3, 0.0];
        all[place] = x;
        let error = atlas.law(&material(all[0], all[1], all[2]));
        let said = error.unwrap_err().to_string();
        let complete = said.starts_with(named) && said.contains("range of the atlas");
        assert!(complete, "{said}");
    }
    let elastic = Material {
        flow: None,
        ..material(100.0, 0.3, 0.0)
    };
    let said = atlas.law(&elastic).unwrap_err().to_string();
    assert!(said.contains("no yield strength"), "{said}");
}

#[test]
fn a_law_of_the_atlas_goes_through_its_file_and_its_name_unchanged() {
    let copper = material(800.0, 0.343, 0.001);
    let law = Atlas::built_in().unwrap().law(&copper).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("copper.toml");
    LawFile::of_atlas("copper", &copper, 25e-5)
        .unwrap()
        .write(&path)
        .unwrap();
    let read = LawFile::read(&path).unwrap().law().unwrap();
    let named = AnyLaw::named("atlas", None, &copper).unwrap();
    for law_of in [AnyLaw::Fitted(read), named] {
        assert_eq!(law_of, AnyLaw::Fitted(FittedLaw::Spline(law.clone())));
    }
}

#[test]
fn the_atlas_rests_on_600_impacts_and_holds_every_material_left_out_nearly_as_well() {
    let atlas = Atlas::built_in().unwrap();
    assert!(atlas.impacts[0] >= 600, "{:?}", atlas.impacts);
    for k in 0..3 {
        assert!(atlas.left_out.median[k] <= 0.02, "{:?}", atlas.left_out);
        assert!(atlas.left_out.median[k] <= 1.3 * atlas.own.median[k]);
    }
}
