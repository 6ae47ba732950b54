//! What every theory must keep for any material: no tension, no energy from nothing, Hertz before yield, similarity, path-exactness.

use approx::assert_relative_eq;
use impactlaw::contact::rebound::{Rebound, rebound, trajectory};
use impactlaw::contact::{LawVisitor, NormalLaw};
use impactlaw::material::{Flow, Material};
use impactlaw::theory::hertz::Hertz;
use impactlaw::theory::published::Evidence;
use impactlaw::theory::{FORMULAS, Theory};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn material(stiffness_ratio: f64, poisson_ratio: f64) -> Material {
    Material {
        density: 8000.0,
        young_modulus: 100e9,
        poisson_ratio,
        flow: Some(Flow::perfectly_plastic(100e9 / stiffness_ratio)),
    }
}

fn materials() -> impl Strategy<Value = Material> {
    (60.0..1500.0_f64, 0.1..0.45_f64).prop_map(|(ratio, nu)| material(ratio, nu))
}

/// Flattening of first yield, p = 1.6 Y.
fn yield_flattening(material: &Material) -> f64 {
    material.yield_point(1.0, 1.6).unwrap().displacement
}

/// Area under the unloading branch below `x` by the midpoint rule in the square of the distance to its end.
fn area<L: NormalLaw>(law: &L, history: &L::History, x: f64, n: u32) -> f64 {
    (0..n)
        .map(|i| {
            let s = (f64::from(i) + 0.5) / f64::from(n);
            law.force(x * s, &mut history.clone()) * x / f64::from(n)
        })
        .sum()
}

/// Checks force, area and stored energy at a share of the peak flattening.
struct ForceAndEnergy(f64, f64);

impl LawVisitor for ForceAndEnergy {
    type Output = ();
    fn visit<L: NormalLaw>(self, law: &L) {
        let ForceAndEnergy(peak, share) = self;
        let mut history = L::History::default();
        let top = law.force(peak, &mut history);
        assert!(top > 0.0 && law.contact_radius(peak, &history).unwrap() > 0.0);
        let x = peak * share;
        let force = law.force(x, &mut history.clone());
        assert!(force >= 0.0 && force <= top);
        let stored = law.elastic_energy(x, &history);
        let expected = area(law, &history, x, 20_000);
        assert!(
            (stored - expected).abs() <= 1e-4 * top * peak,
            "{stored} and {expected}"
        );
        assert_eq!(law.force(-peak, &mut history), 0.0);
    }
}

/// Checks the stiffness at the peak flattening and at a share of it.
struct Stiffness(f64, f64);

impl LawVisitor for Stiffness {
    type Output = ();
    fn visit<L: NormalLaw>(self, law: &L) {
        let Stiffness(peak, share) = self;
        let step = 1e-6 * peak;
        let slope = |x: f64, history: L::History| {
            (law.force(x + step, &mut history.clone()) - law.force(x - step, &mut history.clone()))
                / (2.0 * step)
        };
        let mut loaded = L::History::default();
        law.force(peak, &mut loaded);
        let rising = slope(peak, L::History::default());
        assert_relative_eq!(law.stiffness(peak, &loaded), rising, max_relative = 1e-6);
        let x = peak * share;
        let scale = law.stiffness(0.999 * peak, &loaded);
        let gap = law.stiffness(x, &loaded) - slope(x, loaded);
        assert!(gap.abs() <= 1e-4 * scale, "{gap} of {scale}");
    }
}

/// Checks that only the largest flattening is remembered.
struct Memory(f64, f64);

impl LawVisitor for Memory {
    type Output = ();
    fn visit<L: NormalLaw>(self, law: &L) {
        let Memory(peak, share) = self;
        let mut direct = L::History::default();
        let top = law.force(peak, &mut direct);
        let mut stepped = L::History::default();
        for i in 1..=50 {
            law.force(peak * (f64::from(i) / 50.0), &mut stepped);
            law.force(peak * (f64::from(i) / 50.0) * share, &mut stepped);
        }
        assert_eq!(direct, stepped);
        law.force(-peak, &mut stepped);
        assert_eq!(direct, stepped, "losing contact is no new peak");
        assert_relative_eq!(law.force(peak, &mut stepped), top, max_relative = 1e-14);
        let on = law.force(1.5 * peak, &mut stepped);
        assert_eq!(on, law.force(1.5 * peak, &mut L::History::default()));
    }
}

struct Impact<'a>(&'a Material, f64, f64);

impl LawVisitor for Impact<'_> {
    type Output = Rebound;
    fn visit<L: NormalLaw>(self, law: &L) -> Rebound {
        rebound(law, self.1, self.0.sphere_mass(self.1), self.2)
    }
}

struct Loading(f64);

impl LawVisitor for Loading {
    type Output = f64;
    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        law.force(self.0, &mut L::History::default())
    }
}

/// Distance of `x` from the jumps and corners of every theory, relative.
fn smooth(material: &Material, x: f64) -> bool {
    let at = |ratio: f64, w: f64| material.yield_point(1.0, ratio).unwrap().displacement * w;
    let k = 2.8 * (0.454 + 0.41 * material.poisson_ratio);
    let c = 1.295 * (0.736 * material.poisson_ratio).exp();
    let meeting = (4.5 * std::f64::consts::PI / material.contact_modulus()
        * material.flow.unwrap().yield_strength())
    .powi(2);
    // flattening of rho V^2/Y = 0.1 on the spring 5 Y
    let luding = (0.1 * 4.0 / 15.0 * std::f64::consts::PI).sqrt();
    let corners = [
        at(1.6, 1.0),
        at(2.8, 1.0),
        at(k, 1.0),
        at(k, 6.0),
        at(k, 110.0),
        at(c, 1.0),
        at(c, 1.9),
        at(1.65, 1.0),
        at(1.65, 84.0),
        meeting,
        luding,
        // where Ghaednia's formulas end
        0.5,
    ];
    corners
        .into_iter()
        .all(|corner| (x / corner - 1.0).abs() > 1e-3)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn force_is_never_tensile_and_energy_is_the_area_below_unloading(
        material in materials(), log_w in -1.0..3.0_f64, share in 0.05..0.999_f64,
    ) {
        let peak = yield_flattening(&material) * 10_f64.powf(log_w);
        for theory in Theory::ALL {
            theory.visit(&material, ForceAndEnergy(peak, share)).unwrap();
        }
    }

    #[test]
    fn stiffness_is_the_derivative_of_the_force(
        material in materials(), log_w in -1.0..3.0_f64, share in 0.05..0.999_f64,
    ) {
        let peak = yield_flattening(&material) * 10_f64.powf(log_w);
        prop_assume!(smooth(&material, peak));
        for theory in Theory::ALL {
            theory.visit(&material, Stiffness(peak, share)).unwrap();
        }
    }

    #[test]
    fn force_depends_on_the_largest_flattening_and_not_on_the_steps(
        material in materials(), log_w in -1.0..3.0_f64, share in 0.05..0.999_f64,
    ) {
        let peak = yield_flattening(&material) * 10_f64.powf(log_w);
        for theory in Theory::ALL {
            theory.visit(&material, Memory(peak, share)).unwrap();
        }
    }

    #[test]
    fn rebound_dissipates_except_at_the_published_jumps(
        material in materials(), log_v in -0.5..5.0_f64,
    ) {
        let velocity = material.yield_point(1.0, 1.6).unwrap().velocity * 10_f64.powf(log_v);
        for theory in Theory::ALL {
            let hit = theory.visit(&material, Impact(&material, 1e-3, velocity)).unwrap();
            let largest = match theory {
                // jump of 3 % above Hertz at first yield
                Theory::KogutEtsion | Theory::KogutEtsionHertzian => 1.0150,
                // of up to 3 % above Hertz at w = 1.9 (nu = 0.1)
                Theory::Ghaednia => 1.0150,
                // above Hertz from yield on
                Theory::Stronge => 1.0125,
                _ => 1.0 + 1e-12,
            };
            prop_assert!(hit.restitution > 0.0 && hit.restitution <= largest, "{theory}: {hit:?}");
            prop_assert!(hit.residual_displacement >= 0.0);
            prop_assert!(hit.residual_displacement < hit.max_displacement);
            prop_assert!(hit.contact_time.is_finite() && hit.contact_time > 0.0);
        }
    }

    #[test]
    fn spheres_of_any_size_are_similar(material in materials(), log_r in -6.0..1.0_f64) {
        let (radius, velocity) = (10_f64.powf(log_r), 5.0);
        for theory in Theory::ALL {
            let small = theory.visit(&material, Impact(&material, radius, velocity)).unwrap();
            let large = theory.visit(&material, Impact(&material, 10.0 * radius, velocity)).unwrap();
            prop_assert!((large.restitution / small.restitution - 1.0).abs() < 1e-10);
            prop_assert!((large.max_force / small.max_force / 100.0 - 1.0).abs() < 1e-10);
            prop_assert!((large.max_displacement / small.max_displacement / 10.0 - 1.0).abs() < 1e-10);
            prop_assert!((large.contact_time / small.contact_time / 10.0 - 1.0).abs() < 1e-10);
        }
    }

    #[test]
    fn loading_rises_but_for_the_known_downward_jump(
        material in materials(), log_w in -1.0..4.0_f64, factor in 1.001..3.0_f64,
    ) {
        let x = yield_flattening(&material) * 10_f64.powf(log_w);
        let jumps = [Theory::JacksonGreen, Theory::Ghaednia];
        for theory in Theory::ALL {
            let low = theory.visit(&material, Loading(x)).unwrap();
            let high = theory.visit(&material, Loading(x * factor)).unwrap();
            // Jackson and Green, and Ghaednia after them: down by up to 2.3 % (nu = 0.45) at w = 1.9, so rising over 2 % of flattening or more
            let rises = high > low || (jumps.contains(&theory) && factor < 1.03);
            prop_assert!(rises, "{theory} at {x}, {factor}");
        }
    }

    #[test]
    fn theories_with_an_elastic_range_are_hertz_in_it(material in materials(), w in 1e-6..0.99_f64) {
        let x = yield_flattening(&material) * w;
        let hertz = Hertz::of(&material).force(x, &mut ());
        for theory in [
            Theory::Johnson,
            Theory::Thornton,
            Theory::ThorntonHardness,
            Theory::JacksonGreen,
            Theory::Ghaednia,
            Theory::Stronge,
        ] {
            let force = theory.visit(&material, Loading(x)).unwrap();
            prop_assert!((force / hertz - 1.0).abs() < 1e-13);
        }
    }
}

#[test]
fn plastic_theories_need_a_yield_strength_and_names_are_checked() {
    let mut elastic = material(80.0, 0.35);
    elastic.flow = None;
    let refusal = Theory::Thornton.visit(&elastic, Loading(0.1)).unwrap_err();
    assert!(
        refusal.to_string().contains("material.yield_strength"),
        "{refusal}"
    );
    assert_eq!(Theory::of(&elastic).collect::<Vec<_>>(), [Theory::Hertz]);
    for theory in Theory::ALL {
        assert_eq!(
            theory.needs_yield(),
            theory.visit(&elastic, Loading(0.1)).is_err()
        );
        assert_eq!(theory.name().parse::<Theory>().unwrap(), theory);
        assert_eq!(
            serde_json::to_string(&theory).unwrap(),
            format!("\"{theory}\"")
        );
    }
    let refusal = "thorton".parse::<Theory>().unwrap_err().to_string();
    assert!(
        refusal.contains("thorton") && refusal.contains("kogut-etsion"),
        "{refusal}"
    );
}

#[test]
fn the_path_through_the_jumps_of_kogut_and_etsion_conserves_energy() {
    struct Path<'a>(&'a Material);
    impl LawVisitor for Path<'_> {
        type Output = ();
        fn visit<L: NormalLaw>(self, law: &L) {
            let mass = self.0.sphere_mass(1e-3);
            let path = trajectory(law, 1e-3, mass, 20.0);
            let turn = path.iter().position(|s| s.velocity <= 0.0).unwrap();
            let mut history = L::History::default();
            law.force(path[turn].displacement / 1e-3, &mut history);
            for state in &path[turn..] {
                let stored = law.elastic_energy(state.displacement / 1e-3, &history) * 1e-9;
                let all = law.elastic_energy(path[turn].displacement / 1e-3, &history) * 1e-9;
                let kinetic = 0.5 * mass * state.velocity.powi(2);
                assert_relative_eq!(kinetic + stored, all, max_relative = 1e-9);
            }
            assert!(path.windows(2).all(|pair| pair[0].time <= pair[1].time));
        }
    }
    Theory::KogutEtsion
        .visit(&material(80.0, 0.35), Path(&material(80.0, 0.35)))
        .unwrap();
}

#[test]
fn the_table_of_the_readme_is_the_list_of_theories_and_every_paper_stands_in_the_references() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |name: &str| std::fs::read_to_string(root.join(name)).unwrap();
    let (readme, references) = (read("README.md"), read("references.bib"));
    let models = Theory::ALL
        .map(Theory::publication)
        .into_iter()
        .chain(FORMULAS);
    let mut table = String::new();
    for model in models {
        let papers = model.papers.join(", ");
        table += &format!("| `{}` | {} | {papers} |\n", model.name, model.summary);
        assert!(!model.papers.is_empty(), "{}", model.name);
        let unverified = model.evidence == Evidence::Unverified;
        assert_eq!(model.summary.contains("unverified"), unverified);
        for paper in model.papers {
            assert!(references.contains(&format!("{{{paper},\n")), "{paper}");
        }
    }
    let fitted = readme.find("| `fitted` |").unwrap();
    let first = fitted + readme[fitted..].find('\n').unwrap() + 1;
    let last = first + readme[first..].find("\n\n").unwrap() + 1;
    assert_eq!(&readme[first..last], table);
}
