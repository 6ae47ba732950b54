//! Ladders and tables of the cost command, without running anything: the thesis' fifteen cases and what it prints of them.

use impactlaw::case::Case;
use impactlaw::cost::chapter::{Chapter, Done, Errors, wanted};
use impactlaw::cost::thesis::{Comparison, INTERVAL, SETTINGS, is_its_case, ladder};
use impactlaw::cost::{Effort, Pulse, Row, rungs};
use impactlaw::curve::Impact;
use impactlaw::impact::simulate;
use impactlaw::plan::{Geometry, plan};
use impactlaw::scheme::{Layout, TimeStep, Transfer};
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
    let sizes = SETTINGS.each_ref().map(|s| s.cell() * 12.5);
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
        text.contains("| MP/ES, 100 ns, 3-D | 74227 | 74125 | 1.2 h | 123 |"),
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

#[test]
fn the_chapter_is_all_cases_in_the_section_the_longest_step_in_three_dimensions_and_two_as_a_proof()
{
    let all = wanted(&case(), 1.0);
    let of = |geometry, nth| {
        let places = all.iter().filter_map(|one| one.case);
        let found = places.filter(|place| place.geometry == geometry && place.nth == nth);
        found.map(|place| place.setting.name).collect::<Vec<_>>()
    };
    for nth in 0..3 {
        assert_eq!(of(Geometry::Axisymmetric, nth).len(), 5);
    }
    assert_eq!(of(Geometry::Quarter, 0).len(), 5);
    assert_eq!(of(Geometry::Quarter, 1), ["MP/2ES", "MP/4ES"]);
    assert!(of(Geometry::Quarter, 2).is_empty());
    assert_eq!(all.iter().filter(|one| one.case.is_none()).count(), 1);
    let unit = case().unit_of_time();
    for one in all.iter().filter(|one| one.case.is_some()) {
        let scheme = one.rung.plan.scheme;
        assert!(matches!(scheme.layout, Layout::Centred(_)));
        assert_eq!(scheme.transfer, Transfer::Blend(1.0));
        let TimeStep::Fixed(dt) = scheme.time_step else {
            panic!("{scheme:?}");
        };
        let step = [100e-9, 10e-9, 1e-9][one.case.unwrap().nth];
        assert!((dt * unit / step - 1.0).abs() < 1e-9);
    }
}

#[test]
fn errors_of_the_chapter_are_those_that_were_put_in_and_read_from_files() {
    let case = case();
    let done = simulate(&case.material, case.radius, &plan(&case, 1.0)).impact;
    let johnson = Pulse::hertz(&case, 1.0);
    let place = |setting: &str| {
        let all = wanted(&case, 1.0).into_iter().filter_map(|one| one.case);
        let mut found = all.filter(|place| place.setting.name == setting);
        found.find(|place| place.geometry == Geometry::Axisymmetric && place.nth == 0)
    };
    let run = |setting: &str, force: f64| {
        let mut impact: Impact = done.clone();
        for sample in &mut impact.curve.samples {
            sample.force_n += force * johnson.force;
        }
        Done {
            place: place(setting),
            time_step: 100e-9,
            impact,
            cpu_s: 1.0,
        }
    };
    let runs = [run("4MP/ES", 0.0), run("MP/ES", 0.03), run("nothing", 0.0)];
    let chapter = Chapter {
        runs: &runs,
        johnson: &johnson,
    };
    // 0.03 F* on every file, nothing on the displacement, which is taken from the same samples
    let Errors { all } = chapter.against_finest(&runs[1]).unwrap();
    for (found, exact) in all.iter().zip([0.03, 0.0, 9e-4, 0.0]) {
        assert!((found - exact).abs() < 1e-9, "{all:?}");
    }
    assert_eq!(chapter.against_finest(&runs[0]), None);
    // with the same moments the difference is that, with others more
    let range = chapter.range_against_finest(&runs[1]).unwrap();
    assert!(
        range[0][0] <= 0.03 + 1e-9 && range[0][1] > 0.04,
        "{range:?}"
    );
    // in own units, at the nearest moments: less, for a force that is higher everywhere is higher at its peak too
    let nearest = chapter.nearest_to_finest(&runs[1]).unwrap();
    assert!(
        nearest.all[0] < 0.03 && nearest.all[1] < 1e-9,
        "{nearest:?}"
    );
    // 2.2 ms of contact are 15 files of 150 us; with the ten before them the thesis has "24 or 25"
    let files = runs[0].files().len();
    let contact = done.summary.contact_time_s;
    assert_eq!(files, (contact / INTERVAL).ceil() as usize);
    assert!((24..=25).contains(&(files + 10)), "{files}");
    let line = &chapter.rows()[1];
    assert!((line.mae_force_finest - 0.03).abs() < 1e-9 && line.mae_force_printed == 13e-3);
    assert!(line.mae_force_johnson > 0.03 && line.mae_force_reference < 0.031);
}
