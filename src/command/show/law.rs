//! Law shown: constants with their intervals, errors at every speed, equations.

use crate::Result;
use crate::law::file::{LeftOutRow, QualityRow, UnloadingIntervals, UnloadingTable};
use crate::law::{Form, LawFile};
use crate::report::run_page::FitShow;
use crate::report::table::Table;
use crate::unit::significant;

/// What a law file has to show.
///
/// # Errors
/// As [`LawFile::text`].
pub fn fit(file: &LawFile) -> Result<FitShow> {
    let text = file.text()?;
    let comment = |line: &str| {
        line.strip_prefix('#')
            .map(|rest| rest.trim_start_matches(' ').to_owned())
    };
    let indented = |line: &str| {
        line.strip_prefix("# ")
            .map(str::to_owned)
            .or_else(|| comment(line))
    };
    let equations: Vec<String> = text.lines().map_while(indented).collect();
    Ok(FitShow {
        summary: summary(file),
        equations: equations.join("\n"),
        constants: constants(file),
        errors: errors(file),
        validity: format!(
            "Valid for δ/R up to {} and impacts from {} to {} m/s; the law file says so to whoever reads it.",
            significant(file.valid.displacement_over_radius_max, 3),
            significant(file.valid.velocity_min_m_s, 4),
            significant(file.valid.velocity_max_m_s, 4)
        ),
    })
}

fn summary(file: &LawFile) -> String {
    let form = match file.form {
        Form::Hertz => "Hertz’s law: nothing yielded",
        Form::ClosedForm => "closed form",
        Form::Spline => "spline",
    };
    let mut text = format!(
        "Form in use: {form}. Largest error of F*, δ* and e over all speeds: {} % (at most {} % asked for).",
        significant(100.0 * file.worst_error(), 2),
        significant(100.0 * file.threshold(), 2)
    );
    for warning in &file.warnings {
        text.push_str(&format!(" Warning: {warning}."));
    }
    text
}

fn constants(file: &LawFile) -> Table {
    let mut table = Table::new(
        "Constants of the closed form, with 95 % intervals.",
        &["constant", "value", "from", "to"],
    );
    if let Some(form) = &file.closed_form {
        let intervals = form.intervals.as_ref();
        let loading = [
            (
                "departure w_1",
                form.departure,
                intervals.map(|i| i.departure),
            ),
            ("breadth b", form.breadth, intervals.map(|i| i.breadth)),
            (
                "softening q",
                form.softening,
                intervals.map(|i| i.softening),
            ),
        ];
        let unloading = unloading(&form.unloading, intervals.map(|i| &i.unloading));
        let inertia = form
            .inertia
            .map(|kappa| ("inertia κ", kappa, intervals.and_then(|i| i.inertia)));
        for (name, value, interval) in loading.into_iter().chain(unloading).chain(inertia) {
            let end = |i: usize| interval.map_or("–".to_owned(), |ends| significant(ends[i], 4));
            table
                .rows
                .push(vec![name.to_owned(), significant(value, 5), end(0), end(1)]);
        }
    }
    table
}

type Constant = (&'static str, f64, Option<[f64; 2]>);

fn unloading(table: &UnloadingTable, intervals: Option<&UnloadingIntervals>) -> [Constant; 4] {
    [
        (
            "residual_scale",
            table.residual_scale,
            intervals.map(|i| i.residual_scale),
        ),
        (
            "residual_power",
            table.residual_power,
            intervals.map(|i| i.residual_power),
        ),
        (
            "exponent_residual",
            table.exponent_residual,
            intervals.map(|i| i.exponent_residual),
        ),
        (
            "exponent_strain",
            table.exponent_strain,
            intervals.map(|i| i.exponent_strain),
        ),
    ]
}

fn errors(file: &LawFile) -> Vec<Table> {
    let mut tables = Vec::new();
    if let Some(form) = &file.hertz {
        tables.push(error_table("Hertz", &form.quality, &[]));
    }
    if let Some(form) = &file.closed_form {
        tables.push(error_table("Closed form", &form.quality, &form.left_out));
    }
    if let Some(form) = &file.spline {
        tables.push(error_table("Spline", &form.quality, &form.left_out));
    }
    tables
}

fn error_table(form: &str, quality: &[QualityRow], left_out: &[LeftOutRow]) -> Table {
    let caption = format!(
        "{form}: errors against the simulated impacts, %. The last three are predictions by a law fitted without that speed."
    );
    let mut table = Table::new(
        &caption,
        &[
            "V (m/s)",
            "F*",
            "δ*",
            "e",
            "δ at rebound",
            "contact time",
            "force RMS, loading",
            "unloading",
            "F* left out",
            "δ* left out",
            "e left out",
        ],
    );
    let percent = |value: f64| format!("{:.2}", 100.0 * value).replace('-', "\u{2212}");
    for row in quality {
        let seen = [
            row.max_force,
            row.max_displacement,
            row.restitution,
            row.residual_displacement,
            row.contact_time,
            row.loading_force_rms,
            row.unloading_force_rms,
        ];
        let other = left_out
            .iter()
            .find(|other| other.velocity_m_s == row.velocity_m_s);
        let predicted: [fn(&LeftOutRow) -> f64; 3] =
            [|r| r.max_force, |r| r.max_displacement, |r| r.restitution];
        let mut cells = vec![significant(row.velocity_m_s, 4)];
        cells.extend(seen.map(percent));
        cells.extend(predicted.map(|of| other.map_or("–".to_owned(), |row| percent(of(row)))));
        table.rows.push(cells);
    }
    table
}
