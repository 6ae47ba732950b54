//! The whole decks of the guide run in the codes they are for, with a law of the repository in the place of the guide's.

use crate::codes::exported::Exported;
use crate::codes::{solder, succeed};
use impactlaw::export::scene::Code;

/// The deck of the guide's first chapter whose first line is this, for the law called `name`.
fn deck(first: &str, name: &str) -> String {
    let guide = include_str!("../../src/guide/first-case.md");
    let (_, rest) = guide.split_once(&format!("```text\n{first}\n")).unwrap();
    let (deck, _) = rest.split_once("\n```").unwrap();
    assert!(deck.contains("copper"));
    deck.replace("copper", name)
}

/// Runs a deck; the kinetic energies of its table, first and last.
fn run(code: Code, first: &str) -> Option<[f64; 2]> {
    let exported = Exported::of(solder(None), code)?;
    let text = deck(first, &exported.law.identifier) + "\n";
    std::fs::write(exported.folder.join("deck.in"), text).unwrap();
    let mut command = exported.command(1);
    let said = succeed(command.args(["-in", "deck.in"]));
    let rows: Vec<Vec<f64>> = said
        .lines()
        .map(|line| {
            line.split_whitespace()
                .map_while(|word| word.parse().ok())
                .collect()
        })
        .filter(|row: &Vec<f64>| row.len() >= 3 && row[0] % 20_000.0 == 0.0)
        .collect();
    let ends = [rows.first().unwrap()[0], rows.last().unwrap()[0]];
    assert_eq!(ends, [0.0, 60_000.0], "{said}");
    assert!(
        said.contains("36 atoms") && !said.contains("WARNING: Lost"),
        "{said}"
    );
    Some([&rows[0], &rows[rows.len() - 1]].map(|row| row[energy(code)]))
}

/// Column of the kinetic energy, or of the temperature that is proportional to it.
fn energy(code: Code) -> usize {
    match code {
        Code::Lammps => 1,
        Code::Liggghts => 2,
    }
}

#[test]
fn the_deck_of_the_guide_for_liggghts_brings_the_balls_to_rest() {
    if let Some([start, end]) = run(Code::Liggghts, "# deck.in for LIGGGHTS") {
        assert!(end < 0.05 * start, "{start} to {end}");
    }
}

#[test]
fn the_deck_of_the_guide_for_lammps_brings_the_balls_to_rest() {
    if let Some([start, end]) = run(Code::Lammps, "# deck.in for LAMMPS") {
        assert!(end < 0.05 * start, "{start} to {end}");
    }
}
