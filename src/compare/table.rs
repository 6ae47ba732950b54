//! Table: the comparison as Markdown that a person reads, best law first.

use super::{Comparison, Row, SIMULATION};
use crate::theory::published::{Publication, left_out};
use crate::theory::{self, FORMULAS, Theory};
use std::fmt::Write;

/// Root-mean-square figures of one law over all speeds.
struct Summary {
    law: String,
    score: f64,
    cells: String,
    extrapolated: bool,
}

impl Comparison {
    /// Markdown: a summary over all speeds, a table for every speed, restitution formulas, and the sources.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut text = String::from("# Contact laws against the simulated impacts\n\n");
        text.push_str(
            "Errors of the 1-D impact of each law (delta_res over delta*, others relative) and force RMSE along the simulated \
             displacements, over F*; all in %. `*`: the displacement lies beyond what the law's source supports.\n\n",
        );
        if let Some(said) = &self.pair {
            let _ = writeln!(text, "{said}\n");
        }
        if !self.left_out.is_empty() {
            let speeds: Vec<_> = self.left_out.iter().map(|v| format!("{v} m/s")).collect();
            let _ = writeln!(text, "Left out (no rebound): {}.\n", speeds.join(", "));
        }
        for sentence in self.left_out_by_theories() {
            let _ = writeln!(text, "{sentence}\n");
        }
        text.push_str("## All speeds (root mean square), best first\n\n");
        text.push_str(&self.summary_markdown());
        for impact in &self.impacts {
            self.write_speed(&mut text, impact.summary.velocity_m_s);
        }
        self.write_formulas(&mut text);
        self.write_sources(&mut text);
        text
    }

    /// What of the material plays no part in the theories compared.
    #[must_use]
    pub fn left_out_by_theories(&self) -> Vec<String> {
        let laws = self.laws();
        let compared = |theory: &Theory| laws.contains(&theory.name());
        let theories = Theory::ALL.into_iter().filter(compared);
        left_out(
            theories
                .map(Theory::publication)
                .chain(self.formulas_without_law()),
            &self.material,
        )
    }

    /// Models without a force law, of those that are shown.
    fn formulas_without_law(&self) -> impl Iterator<Item = Publication> {
        let of_pair = self.pair.is_some();
        let shown = move |model: &Publication| !of_pair || model.of_pairs;
        FORMULAS.into_iter().filter(shown)
    }

    /// Laws in the order they were added.
    fn laws(&self) -> Vec<&str> {
        let mut laws: Vec<&str> = Vec::new();
        for row in self.rows.iter().filter(|row| row.law != SIMULATION) {
            if !laws.contains(&row.law.as_str()) {
                laws.push(&row.law);
            }
        }
        laws
    }

    /// RMS over the speeds of every error of `law`; the score is the RMS of the five errors of its impacts.
    fn summary(&self, law: &str) -> Summary {
        let rows: Vec<&Row> = self.rows.iter().filter(|row| row.law == law).collect();
        let rms = |pick: fn(&Row) -> Option<f64>| {
            let values: Vec<f64> = rows.iter().filter_map(|row| pick(row)).collect();
            (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
        };
        let score = rms(|row| row.errors().map(|errors| errors.rms()));
        let columns: [fn(&Row) -> Option<f64>; 7] = [
            |row| row.max_force_error_rel,
            |row| row.max_displacement_error_rel,
            |row| row.residual_displacement_error_rel,
            |row| row.restitution_error_rel,
            |row| row.contact_time_error_rel,
            |row| row.force_rmse_loading_rel,
            |row| row.force_rmse_unloading_rel,
        ];
        let cells: Vec<_> = columns.into_iter().map(|pick| percent(rms(pick))).collect();
        Summary {
            law: law.to_owned(),
            score,
            cells: cells.join(" | "),
            extrapolated: rows.iter().any(|row| row.extrapolated == Some(true)),
        }
    }

    /// Summaries over all speeds, best first.
    fn summaries(&self) -> Vec<Summary> {
        let mut laws: Vec<Summary> = self
            .laws()
            .into_iter()
            .map(|law| self.summary(law))
            .collect();
        laws.sort_by(|a, b| a.score.total_cmp(&b.score));
        laws
    }

    /// Names of the laws, the one with the smallest error over all speeds first.
    #[must_use]
    pub fn ranking(&self) -> Vec<&str> {
        let mut laws = self.laws();
        let score = |law: &str| self.summary(law).score;
        laws.sort_by(|a, b| score(a).total_cmp(&score(b)));
        laws
    }

    /// Markdown table of the laws over all speeds, best first.
    #[must_use]
    pub fn summary_markdown(&self) -> String {
        let laws = self.summaries();
        let mut text = String::from(
            "| law | overall | F* | delta* | delta_res | e | contact time | RMSE loading | RMSE unloading |\n\
             |---|---|---|---|---|---|---|---|---|\n",
        );
        for law in laws {
            let star = if law.extrapolated { "*" } else { "" };
            let score = percent(law.score);
            let _ = writeln!(text, "| {}{star} | {score} | {} |", law.law, law.cells);
        }
        text.push('\n');
        text
    }

    fn write_speed(&self, text: &mut String, velocity: f64) {
        let _ = write!(
            text,
            "## {velocity} m/s\n\n\
             | law | F* N | delta* um | delta_res um | e | contact time us | F* | delta* | delta_res | e | contact time | RMSE loading | RMSE unloading |\n\
             |---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
        );
        for row in self.rows.iter().filter(|row| row.velocity_m_s == velocity) {
            let star = if row.extrapolated == Some(true) {
                "*"
            } else {
                ""
            };
            let errors = [
                row.max_force_error_rel,
                row.max_displacement_error_rel,
                row.residual_displacement_error_rel,
                row.restitution_error_rel,
                row.contact_time_error_rel,
            ];
            let misfits = [row.force_rmse_loading_rel, row.force_rmse_unloading_rel];
            let cells: Vec<_> = errors
                .into_iter()
                .map(|value| value.map_or_else(String::new, signed_percent))
                .chain(
                    misfits
                        .into_iter()
                        .map(|value| value.map_or_else(String::new, percent)),
                )
                .collect();
            let _ = writeln!(
                text,
                "| {}{star} | {:.4} | {:.4} | {:.4} | {:.4} | {:.4} | {} |",
                row.law,
                row.max_force_n,
                row.max_displacement_m * 1e6,
                row.residual_displacement_m * 1e6,
                row.restitution,
                row.contact_time_s * 1e6,
                cells.join(" | "),
            );
        }
        text.push('\n');
    }

    fn write_formulas(&self, text: &mut String) {
        if self.material.flow.is_none() {
            return;
        }
        text.push_str("## Restitution from the authors' formulas\n\n| V m/s | mpm");
        let of_pair = self.pair.is_some();
        let shown = || theory::formulas().filter(move |model| !of_pair || model.of_pairs);
        for model in shown() {
            let _ = write!(text, " | {}", model.name);
        }
        let columns = "---|".repeat(shown().count() + 2);
        let _ = writeln!(text, " |\n|{columns}");
        let cell = |e: Option<f64>| e.map_or_else(String::new, |e| format!("{e:.3}"));
        for impact in &self.impacts {
            let velocity = impact.summary.velocity_m_s;
            let _ = write!(text, "| {velocity} | {:.3}", impact.summary.restitution);
            for model in shown() {
                let formula = model.restitution;
                let e = formula.and_then(|formula| formula(&self.material, velocity));
                let _ = write!(text, " | {}", cell(e));
            }
            text.push_str(" |\n");
        }
        text.push('\n');
    }

    fn write_sources(&self, text: &mut String) {
        text.push_str("## Sources\n\n");
        let laws = self.laws();
        for theory in Theory::ALL
            .into_iter()
            .filter(|theory| laws.contains(&theory.name()))
        {
            let _ = writeln!(text, "- {theory}: {}", theory.reference());
        }
        if self.material.flow.is_some() {
            for formula in self.formulas_without_law() {
                let _ = writeln!(text, "- {}: {}", formula.name, formula.reference);
            }
        }
    }
}

fn percent(value: f64) -> String {
    format!("{:.1}", 100.0 * value)
}

fn signed_percent(value: f64) -> String {
    format!("{:+.1}", 100.0 * value)
}
