//! Files that list grains.

use super::Accepted;
use impactlaw::dem::grains::Grains;
use impactlaw::listing;
use impactlaw::tape::{Keep, Tape, VERSION, sealed};
use parry3d::math::Vector;

/// Grains in a table: with units, with blanks, with types.
pub(super) const TABLES: [&str; 3] = [
    "x (mm),y (mm),z (mm),radius (mm),material\n5,6,7,1,glass\n10,12.5,20,1.5,steel\n",
    "# packing\nid x y z diameter vx vy vz\n1 0.1 0.2 0.3 0.01 0 0 -1\n2 0.2 0.2 0.3 0.01 1 0 0\n",
    "type;x;y;z;r\r\n1;0;0;0;1e-3\r\n2;1;0;0;1e-3\r\n",
];

pub(super) const DUMP: &str = "ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 2
ITEM: ATOMS id type xs ys zs radius vx vy vz
1 1 0.25 0.5 0.25 0.01 0 0 -1
2 2 0.5 0.5 0.75 0.02 0 0 0
";

pub(super) const DATA: &str = "grains

2 atoms
2 atom types

0 1 xlo xhi
0 1 ylo yhi
0 2 zlo zhi

Atoms # sphere

1 1 0.02 2500 0.25 0.5 0.5
2 2 0.04 2500 0.5 0.5 1.5

Velocities

1 0 0 -1 0 0 0
2 0 0 0 0 0 0
";

pub(super) const VTP: &str = r#"<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="2" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0</DataArray></Points>
<PointData><DataArray type="Float64" Name="radius" format="ascii">0.25 0.5</DataArray></PointData>
</Piece></PolyData></VTKFile>
"#;

/// What an interrupted bed keeps first: its grains.
pub(super) fn kept_grains() -> Vec<u8> {
    let mut grains = Grains::default();
    grains.add(Vector::new(0.0, 0.0, 1.0), 0.25, 2500.0);
    grains.add(Vector::new(1.0, 0.0, 1.0), 0.5, 2500.0);
    let run = |tape: &mut Tape| {
        [0u64; 4].save(tape); // whose it is
        0f64.save(tape); // seconds so far
        grains.save(tape);
    };
    sealed(VERSION, run).as_bytes().to_vec()
}

/// Grains of a file: numbers that a bed can use.
pub(super) fn listed(bytes: &[u8], format: listing::Format) -> Accepted {
    let Ok(listing) = listing::read(bytes, format, &listing::Meaning::default()) else {
        return false;
    };
    for grain in &listing.grains {
        let vectors = [grain.centre, grain.velocity, grain.spin];
        assert!(vectors.iter().all(|vector| vector.is_finite()), "{grain:?}");
        let sizes = [grain.radius, grain.density, grain.mass];
        let sound = |size: &f64| size.is_finite() && *size > 0.0;
        assert!(sizes.iter().flatten().all(sound), "{grain:?}");
        let known = |kind: &usize| *kind < listing.kinds.len();
        assert!(grain.kind.iter().all(known), "{grain:?}");
    }
    true
}
