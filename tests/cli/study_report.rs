//! `study report` through the real binary: the equations of the thesis on the 480 cases, the page, and what it refuses.

use crate::program::{impactlaw, message};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

fn cases_480() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/study-480.csv")
}

type Rows = Vec<HashMap<String, String>>;

fn rows(path: &Path) -> Rows {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn number(rows: &Rows, equation: &str, constants: &str, range: &str, column: &str) -> f64 {
    let is = |row: &&HashMap<String, String>| {
        row["equation"] == equation && row["constants"] == constants && row["range"] == range
    };
    let row = rows
        .iter()
        .find(is)
        .unwrap_or_else(|| panic!("{equation} {constants} {range}"));
    row[column].split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn the_480_cases_give_the_equations_their_scores_and_each_reading_its_proof() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::copy(cases_480(), here.join("results.csv")).unwrap();
    let output = impactlaw(here, &["study", "report", "."]);
    assert!(output.status.success(), "{}", message(&output));
    let scores = rows(&here.join("report/equations.csv"));
    // the same by numpy.linalg from the same table
    for (equation, r2, constant, fitted_r2) in [
        ("4-4", 0.997_482_68, 0.494_983, 0.999_687_26),
        ("5-4", 0.997_689_00, 0.4950, 0.999_688_77),
        ("4-5", 0.996_602_43, 0.3343, 0.997_309_39),
        ("5-5", 0.996_570_12, 0.3343, 0.997_312_82),
        ("4-6", 0.994_224_62, 2.5778, 0.997_265_70),
        ("4-8", 0.841_277_02, 0.5064, 0.977_597_03),
        ("4-9", 0.968_951_66, 3.9583, 0.990_167_87),
        ("4-13", 0.969_057_95, 2.0826, 0.971_306_77),
    ] {
        let of =
            |constants: &str, column: &str| number(&scores, equation, constants, "inside", column);
        let (printed, fitted) = (of("printed", "r2"), of("fitted", "r2"));
        assert!((printed - r2).abs() < 1e-7, "{equation}: {printed}");
        assert!((fitted - fitted_r2).abs() < 1e-7, "{equation}: {fitted}");
        let value = of("fitted", "values");
        assert!((value / constant - 1.0).abs() < 3e-4, "{equation}: {value}");
        assert_eq!(
            of("fitted", "cases"),
            if equation == "4-8" { 362.0 } else { 426.0 }
        );
    }
    let page = std::fs::read_to_string(here.join("report/report.html")).unwrap();
    assert!(
        !page.contains("does not show it clearly"),
        "a reading is not borne out"
    );
    for part in [
        "It is the balance of energies",
        "an average of two regimes",
        "locally it is",
        "At first yield e must be 1",
        "80 % of",
        "The factor 2 is a function",
        "table 4-5",
        "table 4-4",
        "vibrates in the body",
        "lead",
        "nickel",
        "50 m/s; columns",
    ] {
        assert!(page.contains(part), "no {part:?}");
    }
    // five maps; four elastic cases
    assert_eq!(page.matches("columns: ρ in kg/m³").count(), 5);
    assert_eq!(
        page.matches("<td>elastic</td>").count() + page.matches("\">elastic</td>").count(),
        4
    );
    for name in [
        "4_3", "4_4", "4_6", "4_7", "4_8", "4_9", "4_10", "4_11", "4_12", "4_13a", "4_14a", "4_15",
        "4_16", "4_17", "5_3", "5_5", "5_6",
    ] {
        let plot = here.join(format!("report/plots/figure_{name}.svg"));
        assert!(plot.is_file(), "{}", plot.display());
    }
    assert!(!page.contains("NaN") && !page.contains("inf "));
    // lead and nickel are kept; the same bytes again, on one thread
    let text = |name: &str| std::fs::read(here.join("report").join(name)).unwrap();
    let before = ["report.html", "equations.csv"].map(text);
    let again = crate::program::program(here)
        .env("RAYON_NUM_THREADS", "1")
        .args(["study", "report", "."])
        .output()
        .unwrap();
    assert!(again.status.success());
    assert!(before == ["report.html", "equations.csv"].map(text));
}

#[test]
fn a_table_that_the_thesis_says_nothing_of_is_refused_and_nothing_is_written() {
    let text = std::fs::read_to_string(cases_480()).unwrap();
    let with = |from: &str, to: &str| text.replacen(from, to, 1);
    let few: String = text
        .lines()
        .take(8)
        .map(|line| format!("{line}\n"))
        .collect();
    for (text, part) in [
        (
            with("yield_strength_Pa", "strength_Pa"),
            "`yield_strength_Pa`: found no such column",
        ),
        (
            with("restitution", "e"),
            "`restitution`: found no such column",
        ),
        (few, "must be at least 12"),
        (with("\n1000.0,", "\n-1000.0,"), "line 3"),
        (
            with("\n1000.0,", "\nlight,"),
            "no number for `density_kg_m3`",
        ),
        (with(",0.8879193,", ",NaN,"), "status ok"),
        (String::new(), "no such column"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("results.csv"), text).unwrap();
        let output = impactlaw(folder.path(), &["study", "report", "results.csv"]);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{part}: {said}");
        assert!(said.contains(part), "no {part:?} in {said}");
        assert!(!folder.path().join("report").exists(), "{part}");
    }
}
