//! Files and measures of a bed: closed forms, sums that must agree, and files that other readers take.

use crate::scene_run;
use impactlaw::bed::measures::fabric::{Fabric, FabricRow};
use impactlaw::bed::record::dump;
use impactlaw::bed::run::BedReport;
use impactlaw::bed::scene::Scene;
use impactlaw::dem::bodies::machine::Machine;
use impactlaw::dem::dynamics::contact::{ContactRow, Other};
use impactlaw::dem::grains::Grains;
use parry3d::math::Vector;
use std::collections::BTreeMap;
use std::path::Path;
use vtkio::model::{Attribute, DataSet, Piece, Vtk};

/// Soft smooth grains, so that a test needs few steps and walls carry no shear.
const SCENE: &str = r#"
laws = ["thornton"]
seed = 7
gravity = "9.81 m/s2"
[material]
density = "2500 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
yield_strength = "100 kPa"
[grains]
count = 120
radius = "1 mm"
stir = "0.2 m/s"
[contact]
restitution = 0.5
[box]
width = "10 mm"
depth = "10 mm"
[[stage]]
kind = "settle"
stiffness = 0.1
longest = "150 ms"
rest_speed = "5 mm/s"
[[stage]]
kind = "relax"
steps = 500
[[stage]]
kind = "compress"
speed = "0.01 m/s"
seating_stress = "500 Pa"
strain = 0.03
[[stage]]
kind = "unload"
speed = "0.1 m/s"
[output]
rows = 20
frames = 2
film = 4
animation = 3
contacts = true
dump = true
"#;

fn run() -> (BedReport, tempfile::TempDir) {
    scene_run::run(&Scene::parse(SCENE, Path::new("files.toml")).unwrap())
}

/// Rows of a CSV file by column.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name]
        .parse()
        .unwrap_or_else(|_| panic!("{name}: {row:?}"))
}

fn pair(first: u32, other: u32, branch: Vector, force: Vector) -> ContactRow {
    ContactRow {
        first,
        other: Other::Grain(other),
        ends: [branch, Vector::ZERO],
        normal: branch.normalize(),
        distance: branch.length(),
        force,
        overlap: 1e-6,
        largest_overlap: None,
        plastic: 0.0,
    }
}

fn grains(count: u32) -> Grains {
    let mut grains = Grains::default();
    (0..count).for_each(|k| grains.add(Vector::X * f64::from(k), 0.5, 1.0));
    grains
}

#[test]
fn stress_and_fabric_of_a_row_of_grains_are_those_by_hand() {
    // four grains in a row along x, pressed by 3 N, each centre 1 m from the next; a fifth touches nothing
    let push = Vector::new(-3.0, 0.0, 0.0);
    let rows: Vec<ContactRow> = (0..3).map(|k| pair(k, k + 1, -Vector::X, push)).collect();
    let fabric = Fabric::of(&rows, &grains(5));
    assert_eq!(fabric.contact[(0, 0)], 9.0);
    assert_eq!(fabric.contact.norm(), 9.0);
    assert_eq!((fabric.fabric[(0, 0)], fabric.fabric.trace()), (1.0, 1.0));
    // one grain without contact, two with one: Z_m = (2*3 - 2) / (5 - 1 - 2)
    assert_eq!((fabric.rattlers, fabric.mechanical_coordination), (3, 2.0));
    assert_eq!((fabric.mean_force, fabric.largest_force), (3.0, 3.0));
    let row = FabricRow::new("s", 0.0, 3.0, &fabric);
    assert_eq!((row.xx, row.pressure, row.shear), (3.0, 1.0, 3.0));
}

#[test]
fn a_gas_of_grains_has_the_kinetic_stress_of_its_fluctuations_alone() {
    let mut grains = grains(2);
    let mass = 1.0 / grains.motions[0].inverse_mass;
    let drift = Vector::new(5.0, 1.0, 0.0);
    grains.motions[0].velocity = drift + Vector::Z * 2.0;
    grains.motions[1].velocity = drift - Vector::Z * 2.0;
    let kinetic = Fabric::of(&[], &grains).kinetic;
    assert!((kinetic[(2, 2)] - 8.0 * mass).abs() < 1e-12 * mass);
    assert!((kinetic.norm() - kinetic[(2, 2)]).abs() < 1e-12 * mass);
}

#[test]
fn stress_inside_is_what_the_walls_carry() {
    let (report, folder) = run();
    let rows = &report.laws[0].rows;
    let peak = (0..rows.len()).max_by(|&a, &b| rows[a].stress_pa.total_cmp(&rows[b].stress_pa));
    let row = &rows[peak.unwrap()];
    let stress = table(&folder.path().join("bed/thornton/stress.csv"));
    let inside = stress
        .iter()
        .find(|line| number(line, "time_s") == row.time_s && line["stage"] == "compress")
        .unwrap();
    // sum of branch times force = height times piston force + sum of m (g + acceleration) z
    let weight = row.potential_j / number(inside, "volume_m3");
    let vertical = number(inside, "stress_zz_Pa") / (row.stress_pa + weight);
    let lateral = 0.5 * (number(inside, "stress_xx_Pa") + number(inside, "stress_yy_Pa"));
    assert!((vertical - 1.0).abs() < 0.03, "{vertical}");
    let lateral = lateral / row.lateral_stress_pa;
    assert!((lateral - 1.0).abs() < 0.05, "{lateral}");
    let trace: f64 = ["xx", "yy", "zz"]
        .iter()
        .map(|c| number(inside, &format!("fabric_{c}")))
        .sum();
    assert!((trace - 1.0).abs() < 1e-12);
    assert!(number(inside, "mechanical_coordination") >= row.coordination);

    let bodies = table(&folder.path().join("bed/thornton/bodies.csv"));
    let now: Vec<_> = bodies
        .iter()
        .filter(|line| number(line, "time_s") == row.time_s && line["stage"] == "compress")
        .collect();
    let piston = now.iter().find(|line| line["body"] == "piston").unwrap();
    let carried = number(piston, "force_z_N") / (row.stress_pa * 1e-4);
    assert!((carried - 1.0).abs() < 1e-9, "{carried}");
    assert!(number(piston, "vz_m_s") < 0.0);
    let side = |name: &str| number(now.iter().find(|l| l["body"] == name).unwrap(), "force_x_N");
    assert!(side("left") < 0.0 && side("right") > 0.0);
}

#[test]
fn contacts_dump_and_frames_tell_of_the_same_grains() {
    let (report, folder) = run();
    let run = folder.path().join("bed/thornton");
    let contacts = table(&run.join("contacts/contacts_0002.csv"));
    assert!(contacts.len() > 100);
    for row in &contacts {
        assert_ne!(row["other"].is_empty(), row["body"].is_empty());
        assert!(number(row, "normal_force_N") >= 0.0);
        let (normal, across) = (
            number(row, "normal_force_N"),
            number(row, "tangential_force_N"),
        );
        assert!(
            across <= 1e-9 * normal,
            "smooth grains: {across} across {normal}"
        );
        // both follow from the positions, by two ways: equal to their rounding, here of millimetres
        assert!(number(row, "largest_overlap_m") >= number(row, "overlap_m") - 1e-15);
    }
    let dump = std::fs::read_to_string(run.join("dump.lammpstrj")).unwrap();
    assert!(dump.starts_with("ITEM: TIMESTEP\n"));
    let frames = dump.matches("ITEM: TIMESTEP").count();
    let last = dump.rsplit("ITEM: ATOMS ").next().unwrap();
    let names: Vec<&str> = last.lines().next().unwrap().split(' ').collect();
    assert_eq!(names[..6], ["id", "type", "x", "y", "z", "radius"]);
    let atoms: Vec<Vec<f64>> = last
        .lines()
        .skip(1)
        .map(|line| line.split(' ').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(atoms.len(), report.laws[0].summary.grains);
    assert!(
        atoms
            .iter()
            .zip(1..)
            .all(|(atom, id)| atom[0] == f64::from(id) && atom.len() == names.len())
    );

    let frame = |kind: &str, number: usize| {
        let path = run.join(format!("vtp/{kind}_{number:04}.vtp"));
        let vtk = Vtk::import(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let DataSet::PolyData { mut pieces, .. } = vtk.data else {
            panic!("not poly data")
        };
        let Piece::Inline(piece) = pieces.remove(0) else {
            panic!("not inline")
        };
        *piece
    };
    let grains = frame("grains", frames - 1);
    let places: Vec<f64> = grains.points.cast_into().unwrap();
    let ids = grains
        .data
        .point
        .iter()
        .find_map(|attribute| match attribute {
            Attribute::DataArray(data) if data.name == "id" => data.data.clone().cast_into::<f64>(),
            _ => None,
        });
    for (at, id) in ids.unwrap().into_iter().enumerate() {
        assert_eq!(atoms[id as usize][2..5], places[3 * at..3 * at + 3]);
    }
    let lines = frame("contacts", 2).lines.unwrap();
    assert_eq!(lines.num_cells(), contacts.len());
    for kind in ["grains", "contacts", "bodies"] {
        let series = std::fs::read_to_string(run.join(format!("vtp/{kind}.pvd"))).unwrap();
        assert_eq!(series.matches("<DataSet").count(), frames, "{kind}");
    }
    assert!(
        !run.join("film").exists(),
        "frames of the film were left behind"
    );
    let animation = std::fs::File::open(run.join("animation.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(animation))
        .read_info()
        .unwrap();
    assert_eq!(reader.info().animation_control.unwrap().num_frames, 3);
}

#[test]
fn the_box_of_a_dump_holds_every_grain() {
    let grains = grains(3);
    let machine = Machine::new(Vec::new(), Vector::ZERO, 1.0).unwrap();
    let text = dump::frame(&grains, &machine, 42);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[..4],
        ["ITEM: TIMESTEP", "42", "ITEM: NUMBER OF ATOMS", "3"]
    );
    assert_eq!(lines[4], "ITEM: BOX BOUNDS ff ff ff");
    assert_eq!(lines[5], "-5e-1 2.5e0");
}
