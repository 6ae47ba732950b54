//! Ladders and tables of the cost command, without running anything: the thesis' fifteen cases and what it prints of them.

use impactlaw::case::Case;
use impactlaw::cost::thesis::{Comparison, SETTINGS, is_its_case, ladder};
use impactlaw::cost::{Effort, Pulse, Row, rungs};
use impactlaw::plan::Geometry;
use std::path::Path;

fn case() -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/thesis-3.toml");
    Case::read(&path).unwrap()
}

#[test]
fn the_fifteen_cases_have_the_printed_elements_and_steps_in_both_geometries() {
    let case = case();
    assert!(is_its_case(&case, 1.0) && !is_its_case(&case, 2.0));
    let all = rungs(&case, 1.0, Effort::Full);
    for geometry in [Geometry::Axisymmetric, Geometry::Quarter] {
        for (nth, step) in ["100 ns", "10 ns", "1 ns"].into_iter().enumerate() {
            let name = ladder(geometry, nth);
            let found: Vec<&str> = (all.iter())
                .filter(|r| r.ladder == name)
                .map(|r| r.name.as_str())
                .collect();
            let expected: Vec<String> = SETTINGS
                .iter()
                .map(|s| format!("{}, {step}", s.name))
                .collect();
            assert_eq!(found, expected);
        }
    }
    // element sizes of table 3-1 in mm, rounded as printed (the last is printed as 2.1)
    let sizes = SETTINGS.map(|s| s.cell() * 12.5);
    for (size, printed) in sizes.iter().zip([0.525, 0.525, 0.525, 1.05, 2.02]) {
        assert!((size - printed).abs() < 2e-3 * printed, "{size}");
    }
}

#[test]
fn the_table_puts_the_printed_figures_beside_the_runs() {
    let pulse = Pulse::hertz(&case(), 1.0);
    let row = |setting: &str| Row {
        status: "ok".to_owned(),
        points: 16_368,
        cpu_s: 123.4,
        ..Row::empty(&ladder(Geometry::Quarter, 0), &format!("{setting}, 100 ns"))
    };
    let rows = [row("MP/ES"), row("4MP/ES")];
    let pulses = [pulse.clone(), pulse.clone()];
    let comparison = Comparison {
        rows: &rows,
        pulses: &pulses,
        unit: &pulse,
    };
    let text = comparison.markdown();
    // 3 minutes an output file, 24.5 files
    assert!(
        text.contains("| MP/ES, 100 ns, 3-D | 74227 | 65472 | 1.2 h | 123 |"),
        "{text}"
    );
    // equal pulses differ by nothing; table 3-3 prints 13e-3
    assert!(
        text.contains("| MP/ES, 100 ns, 3-D | 0.0e0 | 1.3e-2 |"),
        "{text}"
    );
    let none = Comparison {
        rows: &[],
        pulses: &[],
        unit: &pulse,
    };
    assert_eq!(none.markdown(), "");
}
