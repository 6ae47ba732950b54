//! The exported law in LAMMPS: single impacts, and what contacts remember under several processors.

use crate::codes;
use crate::codes::assert_close;
use crate::codes::exported::Exported;
use impactlaw::export::check::lammps::LammpsCheck;
use impactlaw::export::scene::Code;

#[test]
fn impacts_in_lammps_are_those_of_rebound() {
    codes::every_law_agrees(&LammpsCheck);
}

#[test]
fn what_contacts_remember_follows_the_grains_between_processors() {
    let Some(plugin) = Exported::of(codes::solder(None), Code::Lammps) else {
        return;
    };
    let mut ends = Vec::new();
    for (drift, ranks, newton) in [
        ("0", 1, "off"),
        ("0", 2, "off"),
        ("0", 2, "on"),
        ("200", 1, "on"),
        ("200", 2, "off"),
        ("200", 2, "on"),
    ] {
        let rows = plugin.run("drift", ranks, &[("U", drift), ("newton", newton)], 5);
        ends.push(rows.last().unwrap().clone());
    }
    assert!(ends[0][3] > 100.0, "grains touch at the end: {:?}", ends[0]);
    assert!(ends[0][2] > 1e-6, "grains spin: {:?}", ends[0]);
    for end in &ends {
        assert_eq!(end[3], ends[0][3]);
        assert_close(end[1], ends[0][1], 1e-9, "energy of motion");
        assert_close(end[2], ends[0][2], 1e-9, "energy of spin");
    }
}
