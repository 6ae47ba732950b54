//! Scenes whose contacts of two materials are under the law of that pair: the rebound it has, and what is refused.

use crate::scene_run::quiet;
use impactlaw::bed::run::run_scene;
use impactlaw::bed::scene::Scene;
use impactlaw::case::Case;
use impactlaw::case::pair::{PairCase, Target, TargetShape};
use impactlaw::contact::rebound::rebound;
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::law::pair::PairTable;
use impactlaw::law::series::Series;
use impactlaw::law::{FittedLaw, LawFile};
use impactlaw::material::{Flow, Material};
use std::path::Path;

const RADIUS: f64 = 1e-3;

const STEEL: Material = Material {
    density: 7850.0,
    young_modulus: 210e9,
    poisson_ratio: 0.3,
    flow: Some(Flow::perfectly_plastic(1.7e9)),
};

const ALUMINIUM: Material = Material {
    density: 2700.0,
    young_modulus: 70e9,
    poisson_ratio: 0.33,
    flow: Some(Flow::perfectly_plastic(280e6)),
};

fn bodies(shape: TargetShape) -> PairCase {
    PairCase {
        particle: Case::of("ball", RADIUS, STEEL, &[1.0, 10.0], 0.05).unwrap(),
        target: Target {
            shape,
            material: ALUMINIUM,
        },
    }
}

/// A law file of a pair with the numbers that the atlas has for the sphere that stands for both.
fn law_file(shape: TargetShape) -> LawFile {
    let pair = bodies(shape);
    let both = pair.effective();
    let mut file = LawFile::of_atlas("ball", &both.material, both.radius).unwrap();
    file.pair = Some(PairTable::of(&pair));
    file
}

/// A ball of steel thrown at 5 m/s on a block of aluminium, with this table for contacts of the two.
fn scene(pair: &str, laws: &str) -> String {
    format!(
        r#"seed = 1
gravity = "0 m/s2"
{laws}
[materials.steel]
law = "steel.toml"
[materials.aluminium]
law = "aluminium.toml"
{pair}
[[grains]]
name = "ball"
material = "steel"
count = 1
radius = "1 mm"
velocity = ["0 m/s", "0 m/s", "-5 m/s"]
region = {{ low = ["-2 mm", "-2 mm", "0.2 mm"], high = ["2 mm", "2 mm", "3.2 mm"] }}
[domain]
low = ["-20 mm", "-20 mm", "-20 mm"]
high = ["20 mm", "20 mm", "20 mm"]
[[body]]
name = "block"
material = "aluminium"
block = {{ size = ["10 mm", "10 mm", "4 mm"] }}
at = ["0 mm", "0 mm", "-2 mm"]
[[stage]]
kind = "run"
duration = "0.8 ms"
[output]
rows = 5
frames = 0
film = 0
"#
    )
}

/// Law files of both materials, and that of the pair for each shape.
fn written(folder: &Path) {
    for (name, material) in [("steel", STEEL), ("aluminium", ALUMINIUM)] {
        let file = LawFile::of_atlas(name, &material, RADIUS).unwrap();
        file.write(&folder.join(format!("{name}.toml"))).unwrap();
    }
    for (name, shape) in [
        ("flat", TargetShape::HalfSpace),
        ("plate", TargetShape::Plate { thickness: 4e-3 }),
        ("ball", TargetShape::Sphere { radius: RADIUS }),
    ] {
        law_file(shape)
            .write(&folder.join(format!("{name}.toml")))
            .unwrap();
    }
}

fn read(folder: &Path, text: &str) -> impactlaw::Result<Scene> {
    let path = folder.join("scene.toml");
    std::fs::write(&path, text).unwrap();
    Scene::read(&path)
}

/// Restitution of the ball of a scene; its rows beyond the range of the law.
fn thrown(folder: &Path, pair: &str) -> (f64, usize) {
    let scene = read(folder, &scene(pair, "")).unwrap();
    let report = run_scene(&scene, None, &quiet(&folder.join("out"))).unwrap();
    let law = &report.laws[0];
    assert!(
        law.summary.energy_closure < 0.01,
        "{}",
        law.summary.energy_closure
    );
    (
        law.grains.motions[0].velocity.z / 5.0,
        law.summary.beyond_validity,
    )
}

/// Restitution of a law in the impact of the scene.
struct Restitution;

impl LawVisitor for Restitution {
    type Output = f64;
    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        rebound(law, RADIUS, STEEL.sphere_mass(RADIUS), 5.0).restitution
    }
}

const FLAT: &str = "[[pair]]\nbetween = [\"aluminium\", \"steel\"]\nlaw = \"flat.toml\"\n";

#[test]
fn a_ball_rebounds_from_a_body_of_another_material_as_the_law_of_the_pair_says() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    written(here);
    // a bed knows no inertia
    let at_rest = |mut file: LawFile| {
        file.spline.as_mut().unwrap().inertia = None;
        file.law().unwrap()
    };
    let by_pair = at_rest(law_file(TargetShape::HalfSpace)).visit(Restitution);
    let own = [STEEL, ALUMINIUM].map(|m| at_rest(LawFile::of_atlas("one", &m, RADIUS).unwrap()));
    let own: [FittedLaw; 2] = own;
    let series = Series::new(own, [STEEL, ALUMINIUM].map(|m| m.contact_modulus()));
    let by_series = Restitution.visit(&series);
    // the two are told apart
    assert!(by_series > 1.1 * by_pair, "{by_series} {by_pair}");
    let (e, beyond) = thrown(here, FLAT);
    assert!((e / by_pair - 1.0).abs() < 0.01, "{e} {by_pair}");
    assert_eq!(beyond, 0);
    let (e, _) = thrown(here, "");
    assert!((e / by_series - 1.0).abs() < 0.01, "{e} {by_series}");
    // damping beside it takes what it takes beside the law of the sphere that stands for both, on a rigid block
    let (damped, _) = thrown(here, &format!("{FLAT}restitution = 0.8\nfriction = 0.3\n"));
    let both = bodies(TargetShape::HalfSpace).effective().material;
    let file = LawFile::of_atlas("both", &both, RADIUS).unwrap();
    file.write(&here.join("both.toml")).unwrap();
    let rigid = scene("[contact]\nrestitution = 0.8\nfriction = 0.3\n", "")
        .replace("law = \"steel.toml\"", "law = \"both.toml\"")
        .replace(
            "name = \"block\"\nmaterial = \"aluminium\"",
            "name = \"block\"",
        );
    let scene = read(here, &rigid).unwrap();
    let report = run_scene(&scene, None, &quiet(&here.join("rigid"))).unwrap();
    let alone = report.laws[0].grains.motions[0].velocity.z / 5.0;
    assert!((damped / alone - 1.0).abs() < 0.005, "{damped} {alone}");
    assert!(damped < 0.9 * by_pair, "{damped} {by_pair}");
}

#[test]
fn a_law_of_a_pair_that_a_scene_cannot_use_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    written(here);
    let with = |law: &str| FLAT.replace("flat.toml", law);
    let wall = "[[pair]]\nbetween = [\"steel\", \"steel\"]\nlaw = \"flat.toml\"\n";
    for (pair, laws, said) in [
        (with("plate.toml"), "", "how thick a body is"),
        (
            with("steel.toml"),
            "",
            "the law of one material on a rigid wall",
        ),
        (
            with("none.toml"),
            "",
            "must name a law file that can be read",
        ),
        (with("hertz"), "", "must be the law file of a pair"),
        (
            wall.to_owned(),
            "",
            "must be the law of these two materials",
        ),
        (
            FLAT.to_owned(),
            "laws = [\"hertz\"]",
            "in runs under fitted laws alone, not under hertz",
        ),
    ] {
        let error = read(here, &scene(&pair, laws)).unwrap_err().to_string();
        assert!(
            error.contains("pair[0].law") && error.contains(said),
            "{said}: {error}"
        );
    }
    // the law of the pair is no law of a material
    let text = scene("", "").replace("law = \"steel.toml\"", "law = \"flat.toml\"");
    let error = read(here, &text).unwrap_err().to_string();
    assert!(error.contains("the law of a pair"), "{error}");
    // beside a theory the law is for the fitted run alone
    assert!(read(here, &scene(FLAT, "laws = [\"fitted\", \"hertz\"]")).is_ok());
    assert!(read(here, &scene(&with("ball.toml"), "")).is_ok());
}
