//! Impacts of materials that know rate and heat.

use impactlaw::case::{Case, named};
use impactlaw::curve::Status;
use impactlaw::impact::simulate;
use impactlaw::material::flow::JohnsonCook;
use impactlaw::material::{Flow, Material};
use impactlaw::plan::plan;

const CASE: &str = "material = \"ofhc-copper\"\n[particle]\nradius = \"250 um\"\n[impact]\nvelocities = [\"60 m/s\"]\n\
                    [accuracy]\ntolerance = 0.05\n";

fn copper() -> Case {
    Case::parse(CASE, "copper.toml".as_ref()).unwrap()
}

#[test]
fn heat_is_booked_by_what_the_points_are_warmed_by_and_rates_make_small_bodies_harder() {
    let case = copper();
    let Some(Flow::JohnsonCook(flow)) = case.material.flow else {
        panic!("{:?}", case.material)
    };
    let run = |material: &Material, radius: f64| {
        let plan = plan(&case, 60.0);
        let summary = simulate(material, radius, &plan).impact.summary;
        assert_eq!(summary.status, Status::Ok);
        assert!(summary.energy_closure < 1e-3, "{}", summary.energy_closure);
        // what is eroded keeps its temperature and is booked no more
        assert_eq!(summary.eroded_volume_ratio, 0.0);
        summary
    };
    let own = run(&case.material, case.radius);
    let heating = own.heating.unwrap();
    // the last output, which figures of energy are of, lies some steps before the end
    let warmed = flow.heat * (heating.mean_temperature_k - flow.room) / (0.5 * 60.0f64.powi(2));
    assert!((warmed / heating.heat_ratio - 1.0).abs() < 1e-5, "{warmed}");
    let both = heating.heat_ratio + heating.stored_work_ratio;
    assert!((both / own.plastic_work_ratio - 1.0).abs() < 1e-12);
    assert!((heating.heat_ratio / own.plastic_work_ratio - 0.9).abs() < 1e-12);
    assert!(heating.max_temperature_k > heating.mean_temperature_k + 5.0);
    // a thousandth of the size: a thousand times the rate, C ln(1000) = 0.17 more strength
    let small = run(&case.material, 1e-3 * case.radius);
    let ratio = small.max_displacement_m / own.max_displacement_m * 1e3;
    assert!((0.90..0.98).contains(&ratio), "{ratio}");
    // without rates sizes do not differ
    let still = |radius: f64| {
        let flow = JohnsonCook {
            sensitivity: 0.0,
            ..flow
        };
        let material = Material {
            flow: Some(flow.into()),
            ..case.material
        };
        run(&material, radius)
    };
    let ratio = still(1e-3 * case.radius).max_displacement_m * 1e3;
    assert!((ratio / still(case.radius).max_displacement_m - 1.0).abs() < 1e-9);
}

#[test]
fn every_named_material_can_be_read_and_says_where_its_constants_are_printed() {
    for name in named::NAMES {
        let (material, source) = named::of_name(name).unwrap().unwrap();
        assert!(source.contains(char::is_alphabetic), "{name}");
        let case = Case::of(name, 1e-3, material, &[10.0], 0.05).unwrap();
        assert!(case.material.flow.is_some(), "{name}");
    }
    let files = std::fs::read_dir("models/constants").unwrap().count();
    assert_eq!(files, named::NAMES.len(), "files without a name");
    assert!(named::of_name("unobtainium").is_none());
}
