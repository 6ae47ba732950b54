//! What `validate` found: the table, the page, and the list in the terminal.

mod drawn;

use self::drawn::drawn;
use crate::Result;
use crate::report::page::{Block, Page, Section};
use crate::report::table::Table;
use crate::unit::{engineering, prefixed, significant};
use crate::validate::left_out::LEFT_OUT;
use crate::validate::measured::{Figure, Flag, Quantity};
use crate::validate::row::{Row, theories};
use crate::validate::{Bound, EXPERIMENTS, Found};
use std::fmt::Write;

/// Columns of the table before those of the theories.
const COLUMNS: [&str; 21] = [
    "experiment",
    "case",
    "velocity_m_s",
    "quantity",
    "measured",
    "uncertainty",
    "flag",
    "source",
    "thesis_simulation",
    "thesis_equation_printed",
    "at_least",
    "at_most",
    "equation",
    "equation_number",
    "ours",
    "ours_low",
    "ours_high",
    "ours_by_cap",
    "inside",
    "overlaps",
    "command",
];

/// `validation.csv`.
#[must_use]
pub fn table(found: &[Found], provenance: &str) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(format!("# {provenance}\n").into_bytes());
    let names = theories().into_iter().map(|name| name.replace('-', "_"));
    let heads: Vec<String> = COLUMNS
        .map(str::to_owned)
        .into_iter()
        .chain(names)
        .collect();
    // rows go into memory, all of one length
    let _ = writer.write_record(&heads);
    for row in found.iter().flat_map(|one| &one.rows) {
        let number = |value: Option<f64>| value.map_or(String::new(), |x| x.to_string());
        let yes = |value: Option<bool>| value.map_or(String::new(), |x| x.to_string());
        let measured = row.measured.as_ref();
        let flag = measured.and_then(|one| one.flag).map_or("", Flag::name);
        let cells = [
            row.experiment.to_owned(),
            row.case.clone(),
            row.velocity.to_string(),
            Quantity::Figure(row.figure).name().to_owned(),
            number(row.value()),
            number(measured.and_then(|one| one.uncertainty)),
            flag.to_owned(),
            measured.map_or(String::new(), |one| one.source.clone()),
            number(row.simulation),
            number(row.printed),
            number(row.limits[0]),
            number(row.limits[1]),
            number(row.equation.map(|(_, value)| value)),
            row.equation.map_or("", |(number, _)| number).to_owned(),
            number(row.ours),
            number(row.interval.map(|[low, _]| low)),
            number(row.interval.map(|[_, high]| high)),
            number(row.by_cap),
            yes(row.inside()),
            yes(row.overlaps()),
            command(row.experiment),
        ];
        let theories = row.theories.iter().map(|value| number(*value));
        let _ = writer.write_record(cells.into_iter().chain(theories));
    }
    writer.into_inner().unwrap_or_default()
}

/// Command that makes the rows of an experiment.
fn command(experiment: &str) -> String {
    format!("impactlaw validate --only {experiment}")
}

/// What came out, as text.
#[must_use]
pub fn text(found: &[Found]) -> String {
    let mut text = String::new();
    for one in found {
        let bounds = one.bounds();
        let missed: Vec<&Bound> = bounds.iter().filter(|bound| !bound.met).collect();
        let _ = writeln!(
            text,
            "{:<16} {} of {} stated bounds met; {}",
            one.stated.name,
            bounds.len() - missed.len(),
            bounds.len(),
            coverage(one)
        );
        for bound in missed {
            let Bound {
                of, found, must, ..
            } = bound;
            let _ = writeln!(text, "  missed: {of}: {found}, must be {must}");
        }
    }
    text
}

/// How many rows lie within what was measured.
fn coverage(found: &Found) -> String {
    let count = |of: fn(&Row) -> Option<bool>| {
        let all: Vec<bool> = found.rows.iter().filter_map(of).collect();
        (all.iter().filter(|yes| **yes).count(), all.len())
    };
    let ((inside, all), (overlap, drawn)) = (count(Row::inside), count(Row::overlaps));
    let entries = found.entries.iter();
    let lost = entries.filter(|one| one.flag == Some(Flag::Lost)).count();
    let mut parts = Vec::new();
    if all > 0 {
        parts.push(format!(
            "{inside} of {all} measured values with an uncertainty hold ours"
        ));
    }
    if drawn > 0 {
        parts.push(format!("{overlap} of {drawn} meet our interval of 95 %"));
    }
    if lost > 0 {
        parts.push(format!("{lost} measured values are lost"));
    }
    match parts.is_empty() {
        true => "nothing measured with an uncertainty".to_owned(),
        false => parts.join(", "),
    }
}

/// How a figure is called, and its unit.
fn shown(figure: Figure) -> (&'static str, &'static str) {
    match figure {
        Figure::ContactTime => ("contact time", "s"),
        Figure::Height => ("H_e/D at the largest compression", ""),
        Figure::Restitution => ("restitution e", ""),
        Figure::Compression => ("compression ratio 1 − H_d/D", ""),
        Figure::Strain => ("equivalent plastic strain", ""),
        Figure::Force => ("largest force F*", "N"),
        Figure::MeanPressure => ("mean pressure over the yield strength", ""),
        Figure::Length => ("final length", "m"),
        Figure::Foot => ("diameter of the foot", "m"),
        Figure::Fifth => ("diameter at a fifth of the initial length", "m"),
    }
}

/// The page.
///
/// # Errors
/// [`crate::Error::Figure`] when a figure cannot be drawn.
pub fn page(found: &[Found], provenance: &str) -> Result<Page> {
    let all: Vec<Bound> = found.iter().flat_map(Found::bounds).collect();
    let met = all.iter().filter(|bound| bound.met).count();
    let mut page = Page {
        title: "Beside what was measured".to_owned(),
        summary: format!(
            "{met} of {} stated bounds are met. Ours are impacts by the material point method, on a rigid wall where nothing else is said; nothing is fitted to what was measured.",
            all.len()
        ),
        sections: Vec::new(),
        colophon: provenance.to_owned(),
    }
    .with(overview(found));
    for one in found {
        page = page.with(section(one)?);
    }
    Ok(match found.len() == EXPERIMENTS.len() {
        true => page.with(left_out()),
        false => page,
    })
}

/// Bounds and coverage of all, and how to read the rest.
fn overview(found: &[Found]) -> Section {
    let mut table = Table::new("", &["experiment", "source", "bounds met", "coverage"]);
    for one in found {
        let bounds = one.bounds();
        let met = bounds.iter().filter(|bound| bound.met).count();
        table.rows.push(vec![
            one.stated.title.to_owned(),
            one.stated.source.to_owned(),
            format!("{met} of {}", bounds.len()),
            coverage(one),
        ]);
    }
    Section::new("Overview")
        .with(Block::Table(table))
        .with(Block::Text(
            "Intervals: speed, Young’s modulus, density and diameter are drawn from normal distributions whose standard deviation is the printed uncertainty, \
             and ours follows them by impacts at the ends of each; 95 % of the draws lie within. An input without a printed uncertainty is not drawn, so an \
             interval says no more than what was printed. Inside: ours lies within the uncertainty of the measured value."
                .to_owned(),
        ))
}

/// Published impacts that are no experiment here, and why.
fn left_out() -> Section {
    let mut table = Table::new("", &["source", "of", "seen", "why it is not here"]);
    table.rows = LEFT_OUT
        .iter()
        .map(|one| {
            [one.source, one.of, one.seen, one.why]
                .map(str::to_owned)
                .into()
        })
        .collect();
    Section::new("Published, and not here")
        .with(Block::Text(
            "What was looked for and cannot be compared: numbers that could not be read, constants that are not printed, or effects that impacts here do not have."
                .to_owned(),
        ))
        .with(Block::Table(table))
}

/// An experiment.
fn section(found: &Found) -> Result<Section> {
    let stated = found.stated;
    let verb = stated.file.verb();
    let study = format!("impactlaw {verb} cases/experiments/{}.toml", stated.name);
    let mut section = Section::new(stated.title)
        .with(Block::Text(format!("Source: {}.", stated.source)))
        .with(Block::Code(format!(
            "{}    # every figure of this section\n{study}    # its impacts alone",
            command(stated.name)
        )));
    for remark in stated.remarks {
        section = section.with(Block::Text((*remark).to_owned()));
    }
    let mut bounds = Table::new("Stated bounds", &["of", "found", "must be", ""]);
    bounds.rows = found.bounds().into_iter().map(bound).collect();
    section = section.with(Block::Table(bounds));
    let mut drawings = Vec::new();
    for &figure in stated.figures {
        let rows: Vec<&Row> = found.of(figure).collect();
        section = section.with(Block::Table(compared(figure, &rows)));
        drawings.extend(drawn(found, figure, &rows)?);
    }
    let folded = stated.figures.iter().map(|&figure| {
        let rows: Vec<&Row> = found.of(figure).collect();
        by_theory(figure, &rows)
    });
    let folded: Vec<Table> = folded.filter(|table| !table.rows.is_empty()).collect();
    section = section
        .with(Block::Folded("Each theory".to_owned(), folded))
        .with(Block::Figures(drawings));
    for derived in (stated.tables)(found) {
        let mut table = Table::new(&derived.title, &derived.head);
        table.rows = derived.rows;
        section = section
            .with(Block::Table(table))
            .with(Block::Text(derived.text));
    }
    Ok(section)
}

fn bound(bound: Bound) -> Vec<String> {
    let state = match bound.met {
        true => "met",
        false => "MISSED",
    };
    vec![bound.of, bound.found, bound.must, state.to_owned()]
}

/// A figure of all cases: measured, thesis, ours.
fn compared(figure: Figure, rows: &[&Row]) -> Table {
    let (name, unit) = shown(figure);
    let digits = |x: f64| match unit {
        "" => significant(x, 4),
        unit => engineering(x, unit, 4),
    };
    let pair = |value: f64, by: f64| {
        let (factor, unit) = prefixed(value, unit);
        let [value, by] = [value, by].map(|x| significant(x * factor, 4));
        match &unit[..] {
            "" => format!("{value} ± {by}"),
            unit => format!("({value} ± {by}) {unit}"),
        }
    };
    let dash = |value: Option<f64>| value.map_or("-".to_owned(), digits);
    let measured = |row: &Row| {
        let Some(one) = &row.measured else {
            return "-".to_owned();
        };
        let flag = one
            .flag
            .map_or(String::new(), |flag| format!(" ({})", flag.name()));
        match (one.value, one.uncertainty) {
            (Some(value), Some(by)) => format!("{}{flag}", pair(value, by)),
            (Some(value), None) => format!("{}{flag}", digits(value)),
            (None, _) => "lost".to_owned(),
        }
    };
    let mut columns: Vec<(String, Vec<String>)> = vec![
        (
            "case".to_owned(),
            rows.iter().map(|row| row.case.clone()).collect(),
        ),
        (
            "V (m/s)".to_owned(),
            rows.iter()
                .map(|row| significant(row.velocity, 4))
                .collect(),
        ),
        (
            "measured".to_owned(),
            rows.iter().map(|row| measured(row)).collect(),
        ),
        (
            "thesis, simulated".to_owned(),
            rows.iter().map(|row| dash(row.simulation)).collect(),
        ),
        (
            "thesis, printed equation".to_owned(),
            rows.iter().map(|row| dash(row.printed)).collect(),
        ),
        (
            "at least".to_owned(),
            rows.iter().map(|row| dash(row.limits[0])).collect(),
        ),
        (
            "at most".to_owned(),
            rows.iter().map(|row| dash(row.limits[1])).collect(),
        ),
    ];
    let number = rows.iter().find_map(|row| row.equation);
    if let Some((number, _)) = number {
        let values = rows
            .iter()
            .map(|row| dash(row.equation.map(|(_, value)| value)));
        columns.push((format!("equation {number}"), values.collect()));
    }
    let interval = |row: &&Row| {
        row.interval.map_or("-".to_owned(), |ends| {
            let [low, high] = ends.map(digits);
            format!("{low} to {high}")
        })
    };
    columns.push((
        "ours".to_owned(),
        rows.iter().map(|row| dash(row.ours)).collect(),
    ));
    columns.push(("ours, 95 %".to_owned(), rows.iter().map(interval).collect()));
    columns.push((
        "ours by the cap".to_owned(),
        rows.iter().map(|row| dash(row.by_cap)).collect(),
    ));
    let inside = |row: &&Row| match row.inside() {
        Some(true) => "yes".to_owned(),
        Some(false) => "no".to_owned(),
        None => "-".to_owned(),
    };
    columns.push(("inside".to_owned(), rows.iter().map(inside).collect()));
    // a column that says nothing is left out
    columns.retain(|(_, cells)| cells.iter().any(|cell| cell != "-"));
    let heads: Vec<&str> = columns.iter().map(|(head, _)| &head[..]).collect();
    let mut table = Table::new(name, &heads);
    table.rows = (0..rows.len())
        .map(|row| {
            columns
                .iter()
                .map(|(_, cells)| cells[row].clone())
                .collect()
        })
        .collect();
    table
}

/// A figure of all cases by each theory that says something of it.
fn by_theory(figure: Figure, rows: &[&Row]) -> Table {
    let (name, unit) = shown(figure);
    let names = theories();
    let says: Vec<usize> = (0..names.len())
        .filter(|&k| rows.iter().any(|row| row.theories[k].is_some()))
        .collect();
    let heads: Vec<&str> = ["case"]
        .into_iter()
        .chain(says.iter().map(|&k| names[k]))
        .collect();
    let mut table = Table::new(name, &heads);
    if says.is_empty() {
        return table;
    }
    table.rows = rows
        .iter()
        .map(|row| {
            let cells = says.iter().map(|&k| {
                row.theories[k].map_or("-".to_owned(), |x| match unit {
                    "" => significant(x, 3),
                    unit => engineering(x, unit, 4),
                })
            });
            [row.case.clone()].into_iter().chain(cells).collect()
        })
        .collect();
    table
}
