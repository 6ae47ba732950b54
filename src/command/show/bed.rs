//! Bed shown: facts of the scene, figures of each law, curves, picture.

use crate::Result;
use crate::bed::measures::oedometer;
use crate::bed::measures::series::Row;
use crate::bed::run::{BedReport, LawRun};
use crate::bed::scene::{FITTED, Scene};
use crate::report::chart::{Mark, Series};
use crate::report::figure::Figure;
use crate::report::palette::Role;
use crate::report::run_page::BedShow;
use crate::report::table::Table;
use crate::theory::Theory;
use crate::unit::{engineering, significant};
use std::path::Path;

/// What a bed run has to show; `picture` is a PNG file, shown if it is there.
///
/// # Errors
/// [`crate::Error::Figure`] when a curve cannot be drawn.
pub fn bed(scene: &Scene, report: &BedReport, picture: &Path) -> Result<BedShow> {
    let series = |value: fn(&Row) -> f64| {
        let each = report.laws.iter();
        each.map(|law| line(law, |row| (row.strain, value(row))))
            .collect()
    };
    let caption = "The bed at its largest strain.".to_owned();
    Ok(BedShow {
        facts: facts(scene, report),
        results: results(report),
        figures: vec![
            Figure::stress_strain(series(|row| row.stress_pa))?,
            Figure::compression(report.laws.iter().map(compression).collect())?,
            Figure::modulus(moduli(scene, report))?,
            Figure::coordination(series(|row| row.coordination))?,
            Figure::plastic_share(series(Row::plastic_share))?,
        ],
        picture: std::fs::read(picture).ok().map(|png| (png, caption)),
    })
}

fn facts(scene: &Scene, report: &BedReport) -> Vec<(String, String)> {
    let inertia = report
        .laws
        .iter()
        .map(|law| law.summary.inertial_number)
        .fold(0.0, f64::max);
    let grains = report.laws.iter().map(|law| law.summary.grains).max();
    let mut facts = vec![
        ("Scene", scene.name.clone()),
        ("Grains", grains.unwrap_or(0).to_string()),
    ];
    if let Some(packing) = report.packing.as_ref().map(|packing| &packing.summary) {
        let text = format!(
            "made with contacts {} times as stiff as true ones, energy closure {}",
            significant(packing.settling_stiffness, 2),
            significant(packing.energy_closure, 2)
        );
        facts.push(("Packing", text));
    }
    if scene.contact.softening() < 1.0 {
        let text = format!(
            "{} of the material's",
            significant(scene.contact.softening(), 2)
        );
        facts.push(("Contact stiffness", text));
    }
    facts.push((
        "Inertial number at the largest stress",
        format!("at most {}", significant(inertia, 2)),
    ));
    facts.extend(against_hertz(report).map(|text| ("Fitted law against Hertz", text)));
    if scene.output.film > 0 {
        let pages = report
            .laws
            .iter()
            .map(|run| format!("bed/{}/bed.html", run.law));
        facts.push(("In three dimensions", pages.collect::<Vec<_>>().join(", ")));
    }
    for run in &report.laws {
        let warnings = run.summary.warnings.iter();
        facts.extend(warnings.map(|warning| ("Warning", format!("{}: {warning}", run.law))));
    }
    let owned = |(name, value): (&str, String)| (name.to_owned(), value);
    facts.into_iter().map(owned).collect()
}

/// What yielding makes of an elastic bed, in one sentence; none unless the scene has both laws.
fn against_hertz(report: &BedReport) -> Option<String> {
    let named = |name: &str| report.laws.iter().find(|run| run.law == name);
    let (fitted, hertz) = (
        &named(FITTED)?.summary,
        &named(Theory::Hertz.name())?.summary,
    );
    let percent = |value: f64| significant(100.0 * value, 2).replace('-', "\u{2212}");
    Some(format!(
        "largest stress {} times that of Hertz; strain left {} % against {} %; plastic flow {} % of the losses",
        significant(fitted.max_stress_pa / hertz.max_stress_pa, 3),
        percent(fitted.residual_strain),
        percent(hertz.residual_strain),
        percent(fitted.plastic_share)
    ))
}

fn results(report: &BedReport) -> Table {
    let mut table = Table::new(
        "The same packing compressed and let go with each law.",
        &[
            "law",
            "largest stress",
            "strain left (%)",
            "contacts per grain",
            "plastic part of losses (%)",
            "overlap/diameter (%)",
            "closure",
            "lost",
            "particle-steps/s",
            "wall time",
        ],
    );
    for run in &report.laws {
        let s = &run.summary;
        let percent = |value: f64| significant(100.0 * value, 3).replace('-', "\u{2212}");
        table.rows.push(vec![
            run.law.clone(),
            engineering(s.max_stress_pa, "Pa", 3),
            percent(s.residual_strain),
            significant(s.coordination, 3),
            percent(s.plastic_share),
            percent(s.max_overlap_ratio),
            format!("{:.1e}", s.energy_closure).replace('-', "\u{2212}"),
            s.lost_grains.to_string(),
            format!("{:.1e}", s.particle_steps_per_s),
            engineering(s.wall_s, "s", 2),
        ]);
    }
    table
}

/// Void ratio over stress; where the piston comes off, the stress has no logarithm.
fn compression(run: &LawRun) -> Series {
    let voids = |row: &Row| (1.0 - row.solid_fraction) / row.solid_fraction;
    let mut series = line(run, |row| (row.stress_pa, voids(row)));
    series
        .points
        .retain(|point| point.0 > LEAST * run.summary.max_stress_pa);
    series
}

/// Tangent moduli of each law, and Walton's bound with the contacts of the stiffest.
fn moduli(scene: &Scene, report: &BedReport) -> Vec<Series> {
    let each = report.laws.iter().map(|run| Series {
        points: oedometer::tangents(&run.rows),
        ..line(run, |_| (0.0, 0.0))
    });
    let mut series: Vec<Series> = each.collect();
    let stiffest = report.laws.iter().max_by(|a, b| {
        let stress = |run: &LawRun| run.summary.max_stress_pa;
        stress(a).total_cmp(&stress(b))
    });
    series.extend(stiffest.map(|run| Series {
        label: "Walton".to_owned(),
        role: Role::Other,
        mark: Mark::Line,
        points: oedometer::walton(&run.rows, scene.material()),
        supported_to: None,
    }));
    series
}

/// Part of the largest stress below which a curve over its logarithm ends.
const LEAST: f64 = 0.01;

/// Curve of one law from the seating stress on.
fn line(run: &LawRun, point: impl Fn(&Row) -> (f64, f64)) -> Series {
    Series {
        label: run.law.clone(),
        role: match run.law.parse::<Theory>() {
            Ok(theory) => Role::Theory(theory.place()),
            Err(_) if run.law == FITTED => Role::Law,
            Err(_) => Role::Other,
        },
        mark: Mark::Line,
        points: run
            .rows
            .iter()
            .filter(|row| row.strain > 0.0)
            .map(point)
            .collect(),
        supported_to: None,
    }
}
