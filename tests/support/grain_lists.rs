//! Files that list grains: scenes that read them, and the two grains that small files hold.

use impactlaw::bed::filling::insert;
use impactlaw::bed::scene::Scene;
use impactlaw::dem::grains::Grains;
use parry3d::math::Vector;
use std::path::Path;

pub const MATERIALS: &str = r#"
[materials.glass]
density = "2500 kg/m3"
young_modulus = "20 MPa"
poisson_ratio = 0.25
law = "hertz"
[materials.steel]
density = "7800 kg/m3"
young_modulus = "50 MPa"
poisson_ratio = 0.3
law = "hertz"
"#;

pub const BOX: &str = "[box]\nwidth = \"20 mm\"\ndepth = \"20 mm\"\nheight = \"40 mm\"\n";

pub const RUN: &str = "[[stage]]\nkind = \"run\"\nduration = \"20 ms\"\n[output]\nrows = 10\nframes = 2\nfilm = 2\ndump = true\n";

/// Scene in `folder` whose grains have these keys, with `more` behind them.
pub fn scene_with(folder: &Path, grains: &str, more: &str) -> Result<Scene, impactlaw::Error> {
    let text = format!(
        "seed = 1\ngravity = \"9.81 m/s2\"\n{MATERIALS}[contact]\nfriction = 0.3\nrestitution = 0.7\n[[grains]]\nname = \"sand\"\n{grains}\n{BOX}{more}{RUN}"
    );
    Scene::parse(&text, &folder.join("scene.toml"))
}

/// Grains of a file called `name` in the order of their names, the keys of `[grains.file]` beside its path being `keys`.
pub fn read(name: &str, bytes: &[u8], group: &str, keys: &str) -> Result<Grains, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let grains = format!("{group}\nfile = {{ path = \"{name}\"{keys} }}");
    let said = |error: impactlaw::Error| error.to_string();
    let scene = scene_with(folder.path(), &grains, "").map_err(said)?;
    let (mut grains, ..) = insert(&scene, 1).map_err(said)?;
    let mut order: Vec<u32> = (0..grains.len() as u32).collect();
    order.sort_by_key(|&at| grains.ids[at as usize]);
    grains.reorder(&order);
    Ok(grains)
}

/// The two grains that all small files list: one of glass that flies and turns, one of steel at rest.
pub fn assert_the_two(grains: &Grains, what: &str) {
    assert_eq!(grains.len(), 2, "{what}");
    let near = |a: Vector, b: [f64; 3], unit: f64| {
        let way = (a - Vector::from(b)).length();
        assert!(way < 1e-6 * unit, "{what}: {a} for {b:?}");
    };
    near(grains.spheres[0].centre, [5e-3, 6e-3, 7e-3], 1e-3);
    near(grains.spheres[1].centre, [10e-3, 12.5e-3, 20e-3], 1e-3);
    for (grain, radius) in [(0, 1e-3), (1, 1.5e-3)] {
        let found = grains.spheres[grain].radius;
        assert!((found / radius - 1.0).abs() < 1e-6, "{what}: {found}");
    }
    near(grains.motions[0].velocity, [0.1, -0.2, 0.3], 1.0);
    near(grains.motions[1].velocity, [0.0; 3], 1.0);
    near(grains.spins[0].rate, [1.0, 2.0, -3.0], 1.0);
    assert_eq!([grains.material(0), grains.material(1)], [0, 1], "{what}");
    let density = |grain: usize| {
        let volume = 4.0 / 3.0 * std::f64::consts::PI * grains.spheres[grain].radius.powi(3);
        1.0 / grains.motions[grain].inverse_mass / volume
    };
    assert!((density(0) / 2500.0 - 1.0).abs() < 1e-9, "{what}");
    assert!((density(1) / 7800.0 - 1.0).abs() < 1e-9, "{what}");
}

/// Turns the lines of a text into those of old Macs and of Windows.
pub fn line_ends(text: &str) -> [String; 3] {
    [
        text.to_owned(),
        text.replace('\n', "\r"),
        text.replace('\n', "\r\n"),
    ]
}

/// A frame of a dump with these columns.
pub fn frame(step: usize, bounds: &str, columns: &str, atoms: &[&str]) -> String {
    format!(
        "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {bounds}\nITEM: ATOMS {columns}\n{}\n",
        atoms.len(),
        atoms.join("\n")
    )
}

pub const BOUNDS: &str = "ff ff ff\n0 0.02\n0 0.02\n-0.01 0.03";
pub const TYPES: &str = ", types = [\"glass\", \"steel\"]";

pub const DATA: &str = "LAMMPS data file\n\n2 atoms\n2 atom types\n\n0 0.02 xlo xhi\n0 0.02 ylo yhi\n0 0.04 zlo zhi\n\n\
    Atoms # sphere\n\n4 1 0.002 2500 0.005 0.006 0.007 0 0 0\n9 2 0.003 7800 0.01 0.0125 0.02 0 0 0\n\n\
    Velocities\n\n9 0 0 0 0 0 0\n4 0.1 -0.2 0.3 1 2 -3\n";

/// VTP in ASCII, as other programs write it.
pub const VTP: &str = r#"<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
  <PolyData>
    <Piece NumberOfPoints="2" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
      <PointData Scalars="radius">
        <DataArray type="Float32" Name="Radius" format="ascii">
          1e-3 0.0015
        </DataArray>
        <DataArray type="Float64"
                   Name="velocity" NumberOfComponents="3" format="ascii"> 0.1 -0.2 0.3 0 0 0 </DataArray>
        <DataArray type="Float64" Name="omega" NumberOfComponents="3" format="ascii">1 2 -3 0 0 0</DataArray>
        <DataArray type="Int32" Name="type" format="ascii">1 2</DataArray>
        <DataArray type="Int32" Name="colour" format="ascii">1 2</DataArray>
      </PointData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0.005 0.006 0.007   0.01 0.0125 0.02
        </DataArray>
      </Points>
    </Piece>
  </PolyData>
</VTKFile>
"#;
