//! The exported law in LIGGGHTS: single impacts, and what contacts remember under several processors.

use crate::codes;
use crate::codes::assert_close;
use crate::codes::exported::Exported;
use impactlaw::export::check::liggghts::LiggghtsCheck;
use impactlaw::export::scene::Code;

#[test]
fn impacts_in_liggghts_are_those_of_rebound() {
    codes::every_law_agrees(&LiggghtsCheck);
}

#[test]
fn the_law_goes_with_the_tangential_and_rolling_models_of_liggghts_on_any_processors() {
    let Some(library) = Exported::of(codes::solder(None), Code::Liggghts) else {
        return;
    };
    let own = library.law.identifier.clone();
    for (tangential, rolling) in [
        ("off", "off"),
        ("no_history", "cdt"),
        ("history", "epsd"),
        ("history", "epsd3"),
        (own.as_str(), "epsd2"),
    ] {
        let mut ends = Vec::new();
        for (drift, ranks) in [("0", 1), ("0", 2), ("200", 2)] {
            let variables = [("U", drift), ("T", tangential), ("RF", rolling)];
            let rows = library.run("drift", ranks, &variables, 5);
            ends.push(rows.last().unwrap().clone());
        }
        assert!(
            ends[0][3] > 100.0,
            "{tangential} {rolling}: grains touch at the end: {:?}",
            ends[0]
        );
        for end in &ends {
            assert_eq!(end[3], ends[0][3], "{tangential} {rolling}");
            // A drift is seen by what depends on the frame only through rounding of the coordinates.
            assert_close(end[1], ends[0][1], 1e-6, "energy of motion");
        }
    }
}
