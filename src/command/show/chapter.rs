//! The page of the thesis' third chapter: its tables beside ours, and its figures again.

use crate::Result;
use crate::case::Case;
use crate::cost::Pulse;
use crate::cost::chapter::{Chapter, Done, Line, dimensions};
use crate::cost::thesis::{INTERVAL, MULTIPLIERS, SETTINGS};
use crate::plan::Geometry;
use crate::report::chart::{Chart, Mark, Series};
use crate::report::figure::Figure;
use crate::report::page::{Block, Page, Section};
use crate::report::palette::Role;
use crate::report::scale::Axis;
use crate::report::table::Table;
use crate::unit::{rounded, significant};

/// The command of every figure of the page.
const COMMAND: &str = "impactlaw cost cases/thesis-3.toml --chapter-3";

/// ES/(c_dil + V) as table 3-2 prints it, us.
const PRINTED_CROSSING: [f64; 5] = [8.0, 8.0, 8.0, 16.0, 32.0];
/// Element sizes of table 3-1, mm.
const PRINTED_CELLS: [f64; 5] = [0.525, 0.525, 0.525, 1.05, 2.1];

/// The page.
///
/// # Errors
/// [`crate::Error::Figure`] for a figure that cannot be drawn.
pub fn page(case: &Case, chapter: &Chapter, provenance: &str) -> Result<Page> {
    let lines = chapter.rows();
    let page = Page {
        title: "Chapter 3 of the thesis again".to_owned(),
        summary: verdict(&lines),
        sections: Vec::new(),
        colophon: provenance.to_owned(),
    };
    Ok(page
        .with(settings(case, chapter))
        .with(accuracy(chapter, &lines))
        .with(runs(chapter, &lines))
        .with(cost(&lines, chapter))
        .with(agreement(chapter))
        .with(figures(chapter)?))
}

/// Whether a line is a case whose distance from the finest setting table 3-3 prints.
fn is_of_table(line: &Line) -> bool {
    line.mae_force_printed.is_finite() && line.mae_force_finest.is_finite()
}

fn span(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values
        .filter(|x| x.is_finite())
        .fold([f64::INFINITY, 0.0], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
}

/// What came out, from the numbers of these runs.
fn verdict(lines: &[Line]) -> String {
    let of_table = || lines.iter().filter(|line| is_of_table(line));
    let span_of = |value: fn(&Line) -> f64| {
        let [low, high] = span(of_table().map(value));
        format!("{} to {}", significant(low, 2), significant(high, 2))
    };
    let within = |value: fn(&Line) -> [f64; 2]| {
        let near = of_table().map(value).filter(|[found, printed]| {
            let ratio = found / printed;
            (0.5..=2.0).contains(&ratio)
        });
        near.count()
    };
    let runs = of_table().count();
    format!(
        "The thesis prints 0.013 and 0.009 for the mean difference in F/F* of its two settings from the finest, 0.008 and 0.003 in delta/delta*. Read from \
         files as it reads them, ours are {} and {} with a file at first contact, in Johnson's units. With each run in its own units, at the moments of the \
         files at which they are nearest, they are {} and {}: of {runs} runs {} are within a factor of 2 in F and {} in delta. The same runs differ from \
         Johnson by {} in F and from the converged run of this sphere by {}: that settings are near each other says nothing about their being right.",
        span_of(|line| line.mae_force_finest),
        span_of(|line| line.mae_displacement_finest),
        span_of(|line| line.mae_force_nearest),
        span_of(|line| line.mae_displacement_nearest),
        within(|line| [line.mae_force_nearest, line.mae_force_printed]),
        within(|line| [line.mae_displacement_nearest, line.mae_displacement_printed]),
        span_of(|line| line.mae_force_johnson),
        span_of(|line| line.mae_force_reference),
    )
}

/// Tables 3-1 and 3-2.
fn settings(case: &Case, chapter: &Chapter) -> Section {
    let mut table = Table::new(
        "Tables 3-1 and 3-2: discretisation and the time in which wave and body cross a cell",
        &[
            "setting",
            "points a diameter",
            "ratio",
            "points, printed",
            "points",
            "cell, printed, mm",
            "cell, mm",
            "points a cell",
            "crossing, printed, us",
            "crossing, us",
        ],
    );
    let velocity = case.velocities.first().copied().unwrap_or(f64::NAN);
    for (setting, (cell, crossing)) in
        (SETTINGS.iter()).zip(PRINTED_CELLS.into_iter().zip(PRINTED_CROSSING))
    {
        let points = crate::impact::lattice_points(f64::from(setting.count));
        let sphere = 4.0 / 3.0 * std::f64::consts::PI;
        let time = case.crossing(velocity, setting.cell()) * case.unit_of_time();
        table.rows.push(vec![
            setting.name.to_owned(),
            setting.count.to_string(),
            significant(setting.ratio, 3),
            setting.points.to_string(),
            points.to_string(),
            significant(cell, 3),
            significant(setting.cell() * case.radius * 1e3, 3),
            significant(points as f64 * setting.cell().powi(3) / sphere, 2),
            significant(crossing, 2),
            significant(time * 1e6, 3),
        ]);
    }
    let johnson = chapter.johnson;
    Section::new("What is run")
        .with(Block::Code(COMMAND.to_owned()))
        .with(Block::Text(
            "An elastic sphere of 12.5 mm, E 4.9 MPa, nu 0.25, 1404 kg/m3, meets a rigid wall at 1 m/s (section 3.5.1). Preset thesis: total Lagrangian, cubic \
             splines, lumped mass, FLIP, points that touch the wall as spheres of their distance, one fixed step. All printed numbers of points are odd, \
             so a point lies in the centre; the ball of points that fits them best is drawn to the volume of the sphere."
                .to_owned(),
        ))
        .with(Block::Table(table))
        .with(Block::Text(format!(
            "Johnson: F* {} N, delta* {} mm, {} ms. Files are 150 us apart. A file holds the mean force since the one before, positions are means of two \
             files, and the clock starts with the first file that has a force. Here a file falls on the moment of first contact; where the thesis' files fall \
             depends on where its lattice ends, so table 3-3 is given for all moments too.",
            significant(johnson.force, 4),
            significant(johnson.displacement * 1e3, 4),
            significant(johnson.contact_time * 1e3, 4)
        )))
}

/// Table 3-3, and why it says nothing about accuracy.
fn accuracy(chapter: &Chapter, lines: &[Line]) -> Section {
    let mut table = Table::new(
        "Table 3-3: mean errors against 4MP/ES at the same step, F/F* and delta/delta*",
        &[
            "case",
            "of",
            "printed",
            "Johnson's units",
            "any moments",
            "own units, nearest",
        ],
    );
    let text = |x: f64| significant(x, 2);
    let range = |low: f64, high: f64| format!("{} to {}", text(low), text(high));
    for (run, line) in chapter.runs.iter().zip(lines) {
        if !is_of_table(line) {
            continue;
        }
        let force = range(line.mae_force_finest_least, line.mae_force_finest_largest);
        let displacement = range(
            line.mae_displacement_finest_least,
            line.mae_displacement_finest_largest,
        );
        for (of, printed, first, moments, nearest) in [
            (
                "MAE F",
                line.mae_force_printed,
                line.mae_force_finest,
                force,
                line.mae_force_nearest,
            ),
            (
                "MAE delta",
                line.mae_displacement_printed,
                line.mae_displacement_finest,
                displacement,
                line.mae_displacement_nearest,
            ),
            (
                "MSE F",
                line.mse_force_printed,
                line.mse_force_finest,
                String::new(),
                line.mse_force_nearest,
            ),
            (
                "MSE delta",
                line.mse_displacement_printed,
                line.mse_displacement_finest,
                String::new(),
                line.mse_displacement_nearest,
            ),
        ] {
            table.rows.push(vec![
                run.name(),
                of.to_owned(),
                text(printed),
                text(first),
                moments,
                text(nearest),
            ]);
        }
    }
    let mut truth = Table::new(
        "The same runs against Johnson and against the converged run, all read from files",
        &[
            "case",
            "MAE F, finest setting",
            "Johnson",
            "converged",
            "MAE delta, finest setting",
            "Johnson",
            "converged",
        ],
    );
    for (run, line) in chapter.runs.iter().zip(lines) {
        let number = |x: f64| {
            if x.is_finite() {
                text(x)
            } else {
                String::new()
            }
        };
        truth.rows.push(vec![
            run.name(),
            number(line.mae_force_finest),
            number(line.mae_force_johnson),
            number(line.mae_force_reference),
            number(line.mae_displacement_finest),
            number(line.mae_displacement_johnson),
            number(line.mae_displacement_reference),
        ]);
    }
    Section::new("Table 3-3 and what it says")
        .with(Block::Text(
            "The thesis compares its settings with the finest of them. All have the same cells and touch the wall with the same kind of staircase, so they \
             share a part of their error, and in the comparison it cancels. How far each of them, the finest too, is from the converged run of this sphere \
             stands in the second table; Johnson's half-space is no measure of it, for the sphere itself departs from it."
                .to_owned(),
        ))
        .with(Block::Table(table))
        .with(Block::Table(truth))
}

/// Figures of every run.
fn runs(chapter: &Chapter, lines: &[Line]) -> Section {
    let mut table = Table::new(
        "Over Johnson: as they are, and as read from files",
        &[
            "case",
            "e",
            "lost in transfers",
            "F*",
            "from files",
            "delta*",
            "from files",
            "time",
            "from files",
            "status",
        ],
    );
    let text = |x: f64| significant(x, 3);
    for (run, line) in chapter.runs.iter().zip(lines) {
        table.rows.push(vec![
            run.name(),
            significant(line.restitution, 4),
            text(line.transfer_loss_ratio),
            text(line.force_over_johnson),
            text(line.files_force_over_johnson),
            text(line.displacement_over_johnson),
            text(line.files_displacement_over_johnson),
            text(line.time_over_johnson),
            text(line.files_time_over_johnson),
            status(run),
        ]);
    }
    Section::new("All runs").with(Block::Table(table))
}

fn status(run: &Done) -> String {
    match &run.impact.summary.status {
        crate::curve::Status::Ok => "ok".to_owned(),
        crate::curve::Status::Sticks => "sticks".to_owned(),
        crate::curve::Status::NoRebound => "no rebound".to_owned(),
        crate::curve::Status::Failed(reason) => reason.clone(),
    }
}

/// Table 3-4.
fn cost(lines: &[Line], chapter: &Chapter) -> Section {
    let mut table = Table::new(
        "Table 3-4: one core, a file of 150 us",
        &[
            "case",
            "printed, min",
            "here, s",
            "points run",
            "whole run here, s",
        ],
    );
    for (run, line) in chapter.runs.iter().zip(lines) {
        let Some(place) = run.place else { continue };
        let printed = place.setting.minutes[place.nth];
        table.rows.push(vec![
            run.name(),
            printed.map_or("< 1".to_owned(), |minutes| significant(minutes, 3)),
            rounded(
                line.cpu_s * INTERVAL / (run.impact.summary.steps as f64 * run.time_step),
                3,
            ),
            line.points.to_string(),
            rounded(line.cpu_s, 3),
        ]);
    }
    Section::new("What it costs")
        .with(Block::Text(
            "Seconds are processor time of one thread. In three dimensions a quarter of the sphere is run; the thesis runs all of it."
                .to_owned(),
        ))
        .with(Block::Table(table))
}

/// Section beside three dimensions, case by case.
fn agreement(chapter: &Chapter) -> Section {
    let mut table = Table::new(
        "Section over three dimensions",
        &["case", "F*", "delta*", "time", "e, section", "e, 3-D"],
    );
    for nth in 0..MULTIPLIERS.len() {
        for setting in &SETTINGS {
            let of = |geometry| chapter.of(setting.name, geometry, nth);
            let (Some(section), Some(solid)) = (of(Geometry::Axisymmetric), of(Geometry::Quarter))
            else {
                continue;
            };
            let (a, b) = (&section.impact.summary, &solid.impact.summary);
            let ratio = |x: f64, y: f64| significant(x / y, 3);
            table.rows.push(vec![
                solid.name(),
                ratio(a.max_force_n, b.max_force_n),
                ratio(a.max_displacement_m, b.max_displacement_m),
                ratio(a.contact_time_s, b.contact_time_s),
                significant(a.restitution, 4),
                significant(b.restitution, 4),
            ]);
        }
    }
    Section::new("Section and three dimensions")
        .with(Block::Text(
            "At 10 and 1 ns the section stands for three dimensions: rings of points in place of a cubic lattice, the same cells, steps and transfers. How well it does so at 100 ns, and at \
             10 ns for two settings, the table says."
                .to_owned(),
        ))
        .with(Block::Table(table))
}

/// Figures 3-6, 3-7 and.
fn figures(chapter: &Chapter) -> Result<Section> {
    let mut all = Vec::new();
    let settings = [
        ("a", ["MP/ES", "2MP/ES", "4MP/ES"]),
        ("b", ["MP/ES", "MP/2ES", "MP/4ES"]),
    ];
    for (nth, number) in ["3-6", "A-1", "A-2"].into_iter().enumerate() {
        for (letter, names) in settings {
            let runs: Vec<&Done> = names
                .iter()
                .filter_map(|name| nearest(chapter, name, nth))
                .collect();
            all.extend(pair(chapter, &format!("{number}{letter}"), &runs)?);
        }
    }
    for (number, name) in [
        ("3-7a", "MP/ES"),
        ("3-7b", "2MP/ES"),
        ("3-7c", "4MP/ES"),
        ("A-3a", "MP/2ES"),
        ("A-3b", "MP/4ES"),
    ] {
        let runs: Vec<&Done> = (0..MULTIPLIERS.len())
            .filter_map(|nth| chapter.of(name, Geometry::Axisymmetric, nth))
            .collect();
        all.extend(pair(chapter, number, &runs)?);
    }
    Ok(Section::new("Figures 3-6, 3-7 and A-1 to A-3")
        .with(Block::Text(
            "Discs: files. Lines: Johnson, and the converged run. Time, force and displacement are in units of Johnson's, as in the thesis."
                .to_owned(),
        ))
        .with(Block::Figures(all)))
}

/// The run of a case in three dimensions, else in the section.
fn nearest<'a>(chapter: &Chapter<'a>, setting: &str, nth: usize) -> Option<&'a Done> {
    let solid = chapter
        .of(setting, Geometry::Quarter, nth)
        .filter(|_| nth == 0);
    solid.or_else(|| chapter.of(setting, Geometry::Axisymmetric, nth))
}

/// Force and displacement over time of some runs.
fn pair(chapter: &Chapter, number: &str, runs: &[&Done]) -> Result<Vec<Figure>> {
    let johnson: &Pulse = chapter.johnson;
    let mut drawn = Vec::new();
    if runs.is_empty() {
        return Ok(drawn);
    }
    for (name, label, column, unit) in [
        ("force", "F/F*", 1, johnson.force),
        ("displacement", "δ/δ*", 2, johnson.displacement),
    ] {
        let time = johnson.contact_time;
        let curve = (0..=200).map(|k| {
            let t = time * f64::from(k) / 200.0;
            let (force, displacement) = johnson.at(t);
            (t / time, [0.0, force, displacement][column] / unit)
        });
        let mut series = vec![Series {
            label: "Johnson".to_owned(),
            role: Role::Simulation,
            mark: Mark::Line,
            points: curve.collect(),
            supported_to: None,
        }];
        if let Some(reference) = chapter.reference() {
            let samples = reference.impact.curve.samples.iter();
            let point = |s: &crate::curve::Sample| {
                (
                    s.time_s / time,
                    [0.0, s.force_n, s.displacement_m][column] / unit,
                )
            };
            series.push(Series {
                label: "converged".to_owned(),
                role: Role::Law,
                mark: Mark::Line,
                points: samples.map(point).collect(),
                supported_to: None,
            });
        }
        for run in runs {
            let files = run.files();
            series.push(Series {
                label: run.name(),
                role: Role::Other,
                mark: Mark::Points,
                points: files
                    .iter()
                    .map(|row| (row[0] / time, row[column] / unit))
                    .collect(),
                supported_to: None,
            });
        }
        let places: Vec<&str> = runs
            .iter()
            .filter_map(|run| run.place.map(|place| dimensions(place.geometry)))
            .collect();
        drawn.push(Figure::chart(
            format!(
                "chapter_3_{}_{name}",
                number.to_lowercase().replace('-', "_")
            ),
            format!(
                "Figure {number}, {label}: {}",
                places.first().unwrap_or(&"")
            ),
            Chart {
                x: Axis::new("t/t_tot", ""),
                y: Axis::new(label, ""),
                series,
            },
        )?);
    }
    Ok(drawn)
}
