//! Figures over the impact speed: measured, ours, the source's own, bounds.

use super::{command, shown};
use crate::Result;
use crate::report::chart::{Chart, Mark, Series};
use crate::report::figure::Figure as Drawing;
use crate::report::palette::Role;
use crate::report::scale::Axis;
use crate::theory::Theory;
use crate::validate::Found;
use crate::validate::measured::{Figure, Quantity};
use crate::validate::row::{Row, theories};

/// What of a case's name comes after the last comma: which variant of it this is.
fn variant(case: &str) -> &str {
    case.rsplit_once(", ").map_or("", |(_, variant)| variant)
}

/// A figure over the speed, if anything was measured or printed of it.
pub(super) fn drawn(found: &Found, figure: Figure, rows: &[&Row]) -> Result<Vec<Drawing>> {
    let (name, unit) = shown(figure);
    let known = |row: &&Row| {
        let [least, most] = row.limits;
        let said = row.value().or(row.simulation).or(row.printed);
        said.or(least).or(most).is_some()
    };
    let alone = rows.iter().all(|row| row.velocity == rows[0].velocity);
    if alone || !rows.iter().any(known) {
        return Ok(Vec::new());
    }
    let points = |of: &dyn Fn(&Row) -> Option<f64>, kind: &str| {
        let own = rows.iter().filter(|row| variant(&row.case) == kind);
        let mut all: Vec<(f64, f64)> = own
            .filter_map(|row| Some((row.velocity, of(row)?)))
            .collect();
        all.dedup();
        all
    };
    let mut kinds: Vec<&str> = rows.iter().map(|row| variant(&row.case)).collect();
    kinds.dedup();
    let mut unlike: Vec<&str> = Vec::new();
    kinds.retain(|kind| {
        !unlike.contains(kind) && {
            unlike.push(kind);
            true
        }
    });
    // variants of the same particles are told apart by their lines
    let mark = match kinds.len() {
        1 => Mark::Points,
        _ => Mark::Line,
    };
    let mut series = Vec::new();
    let mut add = |label: String, role: Role, mark: Mark, points: Vec<(f64, f64)>| {
        if !points.is_empty() {
            series.push(Series {
                label,
                role,
                mark,
                points,
                supported_to: None,
            });
        }
    };
    let of = |what: &str, kind: &str| match kind {
        "" => what.to_owned(),
        kind => format!("{what}, {kind}"),
    };
    let first = kinds.first().copied().unwrap_or("");
    let measured = points(&|row| row.value(), first);
    add(
        "measured".to_owned(),
        Role::Simulation,
        Mark::Points,
        measured,
    );
    for kind in &kinds {
        let role = match *kind == first {
            true => Role::Law,
            false => Role::Other,
        };
        add(of("ours", kind), role, mark, points(&|row| row.ours, kind));
    }
    for kind in &kinds {
        let simulated = points(&|row| row.simulation, kind);
        add(of("thesis, simulated", kind), Role::Other, mark, simulated);
        let printed = points(&|row| row.printed, kind);
        add(of("thesis, equation", kind), Role::Other, mark, printed);
    }
    for (label, k) in [("at least", 0), ("at most", 1)] {
        let limit = points(&|row| row.limits[k], first);
        add(label.to_owned(), Role::Other, Mark::Line, limit);
    }
    let hertz = Theory::Hertz;
    let place = theories().iter().position(|name| *name == hertz.name());
    let by_hertz = |row: &Row| row.theories[place?];
    let role = Role::Theory(hertz.place());
    add(
        hertz.name().to_owned(),
        role,
        mark,
        points(&by_hertz, first),
    );
    let chart = Chart {
        x: Axis {
            log_if_wide: true,
            ..Axis::new("impact speed V", "m/s")
        },
        y: Axis::new(name, unit),
        series,
    };
    let file = format!("{}_{}", found.stated.name, Quantity::Figure(figure).name());
    let caption = format!(
        "{}: {name} ({})",
        found.stated.title,
        command(found.stated.name)
    );
    Ok(vec![Drawing::chart(file, caption, chart)?])
}
