//! Files that a person writes: cases, scenes, studies, laws.

use super::{Accepted, root, same, text};
use impactlaw::bed::filling::insert;
use impactlaw::bed::scene::{Amount, Scene};
use impactlaw::bed::stages::time_step;
use impactlaw::case::Case;
use impactlaw::case::pair::{self, Asked, PairCase, TargetShape};
use impactlaw::contact::NormalLaw;
use impactlaw::contact::elastoplastic::Elastoplastic;
use impactlaw::contact::loading::Loading;
use impactlaw::dem::bodies::Body;
use impactlaw::document::Document;
use impactlaw::export::Target;
use impactlaw::export::source::portable::Portable;
use impactlaw::law::pair::PairTable;
use impactlaw::law::{FittedLaw, LawFile, PairLaw};
use impactlaw::material::{Flow, Material};
use impactlaw::plan::pair::pair_plans;
use impactlaw::plan::plans;
use impactlaw::study::{Study, group};
use std::path::Path;

/// A case that means whatever it says, of a material that hardens, obliquely.
pub(super) const UNUSUAL: &str = r#"
unusual = ["particle.radius", "material.density", "material.young_modulus", "material.poisson_ratio",
    "material.yield_strength", "material.hardening_modulus", "impact.velocities"]
[particle]
radius = "1 mm"
[material]
density = "2500 kg/m3"
young_modulus = "70 GPa"
poisson_ratio = 0.3
yield_strength = "200 MPa"
hardening_modulus = "1 GPa"
[impact]
velocities = ["1 m/s", "20 m/s"]
angle = "20 deg"
[wall]
friction = 0.3
[accuracy]
tolerance = 0.05
"#;

pub(super) fn case(bytes: &[u8], _: &Path) -> Accepted {
    let path = root().join("cases/case.toml");
    let document = Document::new(&path, text(bytes));
    let planned = match Asked::from_document(&document) {
        Ok(Asked::RigidWall(case)) => plans(&case).unwrap_or_default(),
        Ok(Asked::Pair(pair)) => {
            assert!(Case::from_document(&document).is_err());
            let plans = pair_plans(&pair).unwrap_or_default().into_iter();
            plans.map(|plan| plan.impact).collect()
        }
        Err(_) => return false,
    };
    for plan in planned {
        assert!(plan.seconds.is_finite() && plan.seconds >= 0.0);
        assert!(plan.estimate.displacement > 0.0 && plan.longest_time.is_finite());
    }
    true
}

pub(super) fn scene(bytes: &[u8], _: &Path) -> Accepted {
    let path = root().join("cases/scene.toml");
    let Ok(scene) = Scene::parse(&text(bytes), &path) else {
        return false;
    };
    let few = |amount: Amount| matches!(amount, Amount::Count(count) if count < 3000);
    let _ = time_step::check(&scene);
    let _ = impactlaw::export::scene::check(&scene);
    if scene.groups.iter().all(|group| few(group.amount))
        && let Ok((grains, _, room)) = insert(&scene, 1)
    {
        assert!(
            grains
                .spheres
                .iter()
                .all(|s| s.centre.is_finite() && s.radius > 0.0)
        );
        for body in scene.all_bodies(&room) {
            let _ = Body::corners(&body);
        }
    }
    true
}

/// Ranges, groups in place of quantities, and cases of their own.
pub(super) const MIXED_STUDY: &str = r#"
samples = [20, 10]
seed = 3
[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = { from = "1 GPa", to = "100 GPa", scale = "log" }
young_over_yield = { from = 20, to = 2560, scale = "log" }
hardening_over_young = [0, 0.01]
poisson_ratio = 0.35
[impact]
rho_V2_over_Y = { from = 0.01, to = 1 }
angle = "30 deg"
[wall]
friction = 0.2
[accuracy]
tolerance = 0.2
[[case]]
name = "one"
[[case]]
material = { yield_strength = "200 MPa", young_modulus = "10 GPa" }
impact = { V_over_Vy = [2, 20] }
"#;

pub(super) fn study(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new("study.toml".as_ref(), text(bytes));
    let Ok(study) = Study::from_document(&document) else {
        return false;
    };
    for case in study.cases.iter().take(100) {
        assert!(group(case).len() < 200);
    }
    for case in study.cases.iter().take(3) {
        let _ = plans(case);
    }
    true
}

pub(super) fn law(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new("law.toml".as_ref(), text(bytes));
    let Ok(file) = LawFile::parse(&document) else {
        return false;
    };
    let again = Document::new("again.toml".as_ref(), file.text().unwrap());
    same(&LawFile::parse(&again).unwrap(), &file);
    match file.law().unwrap() {
        FittedLaw::Hertz(_) => {}
        FittedLaw::ClosedForm(law) => yields_no_energy(&law),
        FittedLaw::Spline(law) => yields_no_energy(&law),
    }
    let portable = Portable::new(file, None, document.hash()).unwrap();
    for target in [Target::C, Target::Liggghts] {
        for artifact in target.export(&portable).unwrap() {
            let parts = Path::new(&artifact.name).components();
            let is_below = |part| matches!(part, std::path::Component::Normal(_));
            assert!(parts.into_iter().all(is_below), "{}", artifact.name);
        }
    }
    true
}

/// Laws of a ball on each shape of a second body, with the numbers that the atlas has for the sphere that stands for both.
pub(super) fn laws_of_pairs() -> Vec<Vec<u8>> {
    let metal = |density, young_modulus, strength| Material {
        density,
        young_modulus,
        poisson_ratio: 0.3,
        flow: Some(Flow::perfectly_plastic(strength)),
    };
    let (hard, soft) = (metal(7850.0, 210e9, 1.7e9), metal(2700.0, 70e9, 280e6));
    let of = |shape| {
        let pair = PairCase {
            particle: Case::of("ball", 1e-3, hard, &[1.0, 10.0], 0.05).unwrap(),
            target: pair::Target {
                shape,
                material: soft,
            },
        };
        let both = pair.effective();
        let mut file = LawFile::of_atlas("ball", &both.material, both.radius).unwrap();
        file.pair = Some(PairTable::of(&pair));
        file.text().unwrap().into_bytes()
    };
    [
        TargetShape::HalfSpace,
        TargetShape::Plate { thickness: 4e-3 },
        TargetShape::Sphere { radius: 0.5e-3 },
    ]
    .map(of)
    .to_vec()
}

pub(super) fn law_of_pair(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new("law.toml".as_ref(), text(bytes));
    let Ok(law) = PairLaw::parse(&document) else {
        return false;
    };
    // nobody who means the law of one material takes it
    assert!(LawFile::parse(&document).is_err());
    let again = Document::new("again.toml".as_ref(), law.file().text().unwrap());
    same(&PairLaw::parse(&again).unwrap(), &law);
    match law.file().law().unwrap() {
        FittedLaw::Hertz(_) => {}
        FittedLaw::ClosedForm(law) => yields_no_energy(&law),
        FittedLaw::Spline(law) => yields_no_energy(&law),
    }
    let portable = Portable::new(law.into_file(), None, document.hash()).unwrap();
    assert_eq!(Target::C.export(&portable).unwrap().len(), 1);
    assert!(Target::Liggghts.export(&portable).is_err());
    true
}

/// Unloading stays between nothing and the loading curve, and a later branch below an earlier one.
pub(super) fn yields_no_energy<L: Loading>(law: &Elastoplastic<L>) {
    let departure = law.loading().departure() * law.units().flattening;
    let deepest = 2.0f64.max(1.0001 * departure);
    let ladder = |k: f64| departure * (deepest / departure).powf(k / 12.0);
    for k in 0..12 {
        let (early, late) = (ladder(f64::from(k) + 1e-6), ladder(f64::from(k) + 1.0));
        for part in [0.999_999, 0.99, 0.7, 0.3, 0.01] {
            let at = early * part;
            let [mut a, mut b] = [law.memory(early), law.memory(late)];
            let [upper, lower] = [law.force(at, &mut a), law.force(at, &mut b)];
            let loading = law.force(at, &mut law.memory(0.0));
            let margin = 1.0 + 1e-9;
            assert!(upper >= 0.0 && lower >= 0.0, "tensile at {at:e}");
            assert!(
                upper <= loading * margin,
                "above loading at {at:e} after {early:e}"
            );
            assert!(
                lower <= upper * margin,
                "branches cross at {at:e} after {late:e}"
            );
            assert!(law.stiffness(at, &a).is_finite());
        }
        assert!(
            law.dissipated(&law.memory(late))
                >= -1e-9 * law.force(late, &mut law.memory(0.0)) * late
        );
    }
}
