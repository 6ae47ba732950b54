//! What `discover` found as text and as a page: rankings, fronts, scores beside the baselines, parity plots.

use crate::Result;
use crate::discover::front::Entry;
use crate::discover::identity::Identity;
use crate::discover::problem::{Inputs, Runs};
use crate::discover::ranking::Ranked;
use crate::discover::score::Score;
use crate::discover::search::misfit_bits;
use crate::discover::table::Table;
use crate::report::chart::{Chart, Mark, Series};
use crate::report::figure::Figure;
use crate::report::page::{Block, Page, Section};
use crate::report::palette::Role;
use crate::report::scale::Axis;
use crate::report::table::Table as Shown;
use crate::unit::significant;
use std::fmt::Write;

/// All about one figure.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Column.
    pub figure: String,
    /// What formulas are multiplied with; `1` for a pure number.
    pub scale: String,
    /// Formulas by rising number of constants.
    pub front: Vec<Entry>,
    /// As text, with numbers.
    pub formulas: Vec<String>,
    /// Their values over the runs.
    pub predicted: Vec<Vec<f64>>,
    /// Values of the runs.
    pub values: Vec<f64>,
    /// The one to use.
    pub chosen: Option<usize>,
    /// What others determine exactly.
    pub identities: Vec<Identity>,
    /// Baselines: name, constants (0: no equation), scores seen, levels and materials left out.
    pub baselines: Vec<(String, usize, [Score; 3])>,
    /// Ranking of the inputs.
    pub ranking: Vec<Ranked>,
    /// Names of the ranked columns, in the order of the ranking.
    pub ranked: Vec<String>,
    /// What else there is to say.
    pub notes: Vec<String>,
}

impl Finding {
    /// The equation to use.
    #[must_use]
    pub fn best(&self) -> Option<&Entry> {
        self.chosen.and_then(|i| self.front.get(i))
    }

    /// Keeps some of the front, and chooses anew.
    pub fn keep(&mut self, kept: &[bool]) {
        fn some<T: Clone>(all: &[T], kept: &[bool]) -> Vec<T> {
            let both = all.iter().zip(kept);
            both.filter(|(_, k)| **k)
                .map(|(one, _)| one.clone())
                .collect()
        }
        self.front = some(&self.front, kept);
        self.formulas = some(&self.formulas, kept);
        self.predicted = some(&self.predicted, kept);
        self.chosen = crate::discover::front::chosen(&self.front);
    }

    /// Left side of its equations.
    fn left(&self) -> String {
        match &self.scale[..] {
            "1" => self.figure.clone(),
            scale => format!("{} / ({scale})", self.figure),
        }
    }

    /// Table of the front and the baselines.
    fn table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let head = vec![
            "",
            "constants",
            "bits + misfit",
            "MAE",
            "R²",
            "median %",
            "90 % below %",
            "MAE, levels left out",
            "R²",
            "median %",
            "90 % below %",
            "MAE, materials left out",
            "R²",
        ];
        let number = |x: f64| significant(x, 3);
        let digits = |x: f64| format!("{x:.5}");
        let scores = |[seen, levels, materials]: [&Score; 3]| -> Vec<String> {
            vec![
                number(seen.mae),
                digits(seen.r2),
                number(100.0 * seen.median_rel),
                number(100.0 * seen.p90_rel),
                number(levels.mae),
                digits(levels.r2),
                number(100.0 * levels.median_rel),
                number(100.0 * levels.p90_rel),
                number(materials.mae),
                digits(materials.r2),
            ]
        };
        let equations =
            self.front
                .iter()
                .zip(&self.formulas)
                .enumerate()
                .map(|(i, (entry, formula))| {
                    let mark = if self.chosen == Some(i) {
                        "**chosen** "
                    } else {
                        ""
                    };
                    let bits = format!(
                        "{:.0} + {:.0}",
                        entry.found.bits,
                        misfit_bits(entry.found.fitted.chi2)
                    );
                    let first = vec![
                        format!("{mark}`{formula}`"),
                        entry.found.constants.to_string(),
                        bits,
                    ];
                    [
                        first,
                        scores([&entry.seen, &entry.levels, &entry.materials]),
                    ]
                    .concat()
                });
        let baselines = self
            .baselines
            .iter()
            .map(|(name, n, [seen, levels, materials])| {
                let n = if *n > 0 { n.to_string() } else { String::new() };
                [
                    vec![name.clone(), n, String::new()],
                    scores([seen, levels, materials]),
                ]
                .concat()
            });
        (head, equations.chain(baselines).collect())
    }

    /// The order of the inputs, with what says how sure it is.
    fn order(&self) -> String {
        let names: Vec<String> = self
            .ranked
            .iter()
            .map(|name| crate::discover::problem::symbol(name))
            .collect();
        let spearman: Vec<String> = names
            .iter()
            .zip(&self.ranking)
            .map(|(name, one)| {
                format!(
                    "{name} {} [{}, {}], place {} to {}, shuffled {}",
                    significant(one.spearman, 2),
                    significant(one.spearman_interval[0], 2),
                    significant(one.spearman_interval[1], 2),
                    one.places[0],
                    one.places[1],
                    significant(one.permutation, 2)
                )
            })
            .collect();
        format!(
            "order of the inputs: {} (Spearman {})",
            names.join(" > "),
            spearman.join("; ")
        )
    }

    /// Constants of the chosen equation with their intervals.
    fn constants(&self) -> Option<String> {
        let entry = self.best()?;
        let formula = &entry.found.fitted.formula;
        let each = formula
            .constants()
            .into_iter()
            .zip(&entry.intervals)
            .map(|(i, [low, high])| {
                format!(
                    "{} [{}, {}]",
                    significant(formula.numbers[i], 4),
                    significant(*low, 4),
                    significant(*high, 4)
                )
            });
        let each: Vec<String> = each.collect();
        (!each.is_empty()).then(|| {
            format!(
                "constants of the chosen equation, 95 %: {}",
                each.join(", ")
            )
        })
    }

    /// Sentences about it.
    fn sentences(&self) -> Vec<String> {
        let mut all = vec![self.order()];
        all.extend(self.identities.iter().map(|one| {
            let name = if one.is_energy_balance() {
                ": the balance of energies, the plastic work of a unit of volume is Y times the strain"
            } else {
                ""
            };
            format!("identity: {}, 9 of 10 runs within {} %{name}", one.text(), significant(100.0 * one.spread, 2))
        }));
        all.extend(self.constants());
        all.extend(self.notes.clone());
        if self.front.is_empty() {
            all.push("no formula was found that physics lets pass".to_owned());
        }
        all
    }
}

/// What units and rows say, as text; `outside` and `elastic`: rows outside `--where`, and those that do not yield.
#[must_use]
pub fn units(
    table: &Table,
    inputs: &Inputs,
    runs: &Runs,
    [outside, elastic]: [usize; 2],
) -> String {
    let list = |names: &[String]| match names.is_empty() {
        true => "none".to_owned(),
        false => names.join(", "),
    };
    let mut lines = vec![
        format!(
            "{} cases, {} distinct runs in {} levels ({} failed, {} outside --where, {} that do not yield are left out)",
            table.rows(),
            runs.columns.rows,
            runs.level_count,
            table.failed,
            outside,
            elastic
        ),
        format!("inputs that vary: {}", list(&inputs.free)),
    ];
    let converted = table.converted.iter();
    lines.extend(converted.map(|(file, here)| format!("{file} is read as {here}")));
    for name in &inputs.undetermined {
        lines.push(if stands(inputs, name) {
            format!("{name} never changes; it takes part in groups by its unit")
        } else if ruled_out(table, inputs, name) {
            format!("{name} never changes; by units it is in no group")
        } else {
            format!("{name} never changes: what it does is undetermined")
        });
    }
    lines.extend(
        inputs
            .dependent
            .iter()
            .map(|one| format!("not independent: {}", one.text())),
    );
    let groups: Vec<String> = inputs.groups.iter().map(|group| group.text()).collect();
    lines.push(format!("groups: {}", list(&groups)));
    lines.join("\n") + "\n"
}

/// Whether a column stands in a group.
fn stands(inputs: &Inputs, name: &str) -> bool {
    inputs.groups.iter().any(|group| group.of(name) != 0)
}

/// Whether units alone keep a column that never changes out of every group.
fn ruled_out(table: &Table, inputs: &Inputs, name: &str) -> bool {
    use crate::discover::dimension::null_space;
    let names = inputs.free.iter().map(String::as_str);
    let of = |name: &str| table.input(name).map(|column| column.dimension);
    let mut dimensions: Vec<_> = names.filter_map(of).collect();
    let before = null_space(&dimensions).len();
    dimensions.extend(of(name));
    null_space(&dimensions).len() == before
}

/// Inputs that never change, stand in no group, and that units do not rule out.
#[must_use]
pub fn undetermined(table: &Table, inputs: &Inputs) -> Vec<String> {
    let names = inputs.undetermined.iter();
    names
        .filter(|name| !stands(inputs, name) && !ruled_out(table, inputs, name))
        .cloned()
        .collect()
}

/// Everything as Markdown.
#[must_use]
pub fn summary(study: &str, findings: &[Finding]) -> String {
    let mut text = String::from("# Equations found\n\n");
    for line in study.lines() {
        let _ = writeln!(text, "- {line}");
    }
    for finding in findings {
        let _ = writeln!(text, "\n## {}\n", finding.left());
        for sentence in finding.sentences() {
            let _ = writeln!(text, "- {sentence}");
        }
        let (head, rows) = finding.table();
        let _ = writeln!(
            text,
            "\n| {} |\n|{}",
            head.join(" | "),
            "---|".repeat(head.len())
        );
        for row in rows {
            let _ = writeln!(text, "| {} |", row.join(" | "));
        }
    }
    text
}

/// Everything as a page: a front and a parity plot for each figure beside the table.
///
/// # Errors
/// [`crate::Error::Figure`] when a figure cannot be drawn.
pub fn page(study: &str, findings: &[Finding], provenance: &str) -> Result<Page> {
    let mut page = Page {
        title: "Equations found".to_owned(),
        summary: format!(
            "Equations of {} figures of a study, found from its raw columns.",
            findings.len()
        ),
        sections: Vec::new(),
        colophon: provenance.to_owned(),
    };
    let lines = study.lines().map(str::to_owned).collect();
    page = page.with(Section::new("What units and rows say").with(Block::List(lines)));
    for finding in findings {
        let (head, rows) = finding.table();
        let rows: Vec<Vec<String>> = rows
            .into_iter()
            .map(|row| row.iter().map(|cell| plain(cell)).collect())
            .collect();
        // two tables, for thirteen columns fit no screen and no paper
        let part = |caption: &str, columns: &[usize]| {
            let pick = |row: &[String]| columns.iter().map(|&i| row[i].clone()).collect();
            let head: Vec<&str> = columns.iter().map(|&i| head[i]).collect();
            let mut table = Shown::new(caption, &head);
            table.rows = rows.iter().map(|row| pick(row)).collect();
            Block::Table(table)
        };
        let section = Section::new(&finding.left())
            .with(Block::List(finding.sentences()))
            .with(part(
                "Equations and what they are compared with: errors on the runs that were fitted",
                &[0, 1, 2, 3, 4, 5, 6],
            ))
            .with(part(
                "The same, fitted anew with whole levels and whole materials left out: errors there",
                &[0, 7, 8, 9, 10, 11, 12],
            ))
            .with(Block::Figures(figures(finding)?));
        page = page.with(section);
    }
    Ok(page)
}

/// A cell without the marks of Markdown; a product sign is none.
fn plain(cell: &str) -> String {
    cell.replace("**chosen**", "chosen:")
        .replace('`', "")
        .replace(" * ", " · ")
        .replace('*', "·")
}

fn figures(finding: &Finding) -> Result<Vec<Figure>> {
    let Some(chosen) = finding.chosen else {
        return Ok(Vec::new());
    };
    let series = |label: &str, role, mark, points| Series {
        label: label.to_owned(),
        role,
        mark,
        points,
        supported_to: None,
    };
    let bits = finding
        .front
        .iter()
        .map(|entry| (entry.found.bits, misfit_bits(entry.found.fitted.chi2)))
        .collect();
    let front = Chart {
        x: Axis::new("bits of structure and constants", ""),
        y: Axis {
            log_if_wide: true,
            ..Axis::new("bits of the misfit", "")
        },
        series: vec![series("front", Role::Law, Mark::Points, bits)],
    };
    let points: Vec<(f64, f64)> = finding
        .values
        .iter()
        .copied()
        .zip(finding.predicted[chosen].iter().copied())
        .collect();
    let low = finding.values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = finding
        .values
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let logarithmic = |label: &str| Axis {
        log_if_wide: true,
        ..Axis::new(label, "")
    };
    let parity = Chart {
        x: logarithmic("simulated"),
        y: logarithmic("equation"),
        series: vec![
            series("runs", Role::Law, Mark::Points, points),
            series(
                "equal",
                Role::Simulation,
                Mark::Line,
                vec![(low, low), (high, high)],
            ),
        ],
    };
    Ok(vec![
        Figure::chart(
            format!("front_{}", finding.figure),
            "Description length: structure against misfit".to_owned(),
            front,
        )?,
        Figure::chart(
            format!("parity_{}", finding.figure),
            "Chosen equation against the runs, without unit".to_owned(),
            parity,
        )?,
    ])
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn a_product_on_the_page_is_still_a_product() {
        let cell = "**chosen** `exp(-1.9 * (E/Y)^(1/8) * (1 - (Vy/V)^0.25)^(12*0.1569))`";
        assert_eq!(
            plain(cell),
            "chosen: exp(-1.9 · (E/Y)^(1/8) · (1 - (Vy/V)^0.25)^(12·0.1569))"
        );
    }
}
