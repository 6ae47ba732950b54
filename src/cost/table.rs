//! Table: the ladders as Markdown, and the cheapest setting for an accuracy.

use super::Row;
use super::ladder::REFERENCE;
use crate::unit::{rounded, significant};
use std::fmt::Write;

/// Accuracies for which the cheapest setting is named.
pub const THRESHOLDS: [f64; 5] = [0.1, 0.05, 0.02, 0.01, 0.005];

/// What is said about the ladders of one impact.
#[derive(Debug, Clone, Copy)]
pub struct Summary<'a> {
    /// Name of the case.
    pub case: &'a str,
    /// All rows of one speed, the reference first.
    pub rows: &'a [Row],
    /// Rungs that would have taken too long, with the seconds predicted.
    pub left_out: &'a [(String, f64)],
    /// The thesis' tables beside these runs, where they are of its case.
    pub thesis: Option<&'a str>,
}

impl Summary<'_> {
    /// Markdown text.
    #[must_use]
    pub fn markdown(&self) -> String {
        let velocity = self.rows.first().map_or(f64::NAN, |r| r.velocity_m_s);
        let mut text = format!(
            "# What accuracy costs: {} at {} m/s\n\nErrors are relative to the finest run (first row), in %; MAE: mean absolute errors of F/F* and delta/delta* over 25 intervals of the contact. `*`: no \
             other setting is both faster and more accurate. Times are of one thread, one run at a time; the processor time is the wall time of a machine that does \
             nothing else.\n\n",
            self.case,
            significant(velocity, 4)
        );
        self.write_rows(&mut text);
        self.write_hertz(&mut text);
        self.write_cheapest(&mut text);
        text.push_str(self.thesis.unwrap_or_default());
        if !self.left_out.is_empty() {
            text.push_str("\n## Left out: longer than asked for\n\n");
            for (name, seconds) in self.left_out {
                let _ = writeln!(text, "- {name}: {} s predicted", significant(*seconds, 2));
            }
        }
        text
    }

    fn write_rows(&self, text: &mut String) {
        text.push_str(
            "| ladder | setting | points | steps | wall s | cpu s | 1e6 point-steps/s | MB | F* | delta* | e | time | MAE F | MAE delta | transfer \
             loss | |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n",
        );
        for r in self.rows {
            if r.status != "ok" {
                let _ = writeln!(
                    text,
                    "| {} | {} | {} | {} | {} | {} | | | {} | | | | | | | |",
                    r.ladder,
                    r.rung,
                    r.points,
                    r.steps,
                    rounded(r.wall_s, 3),
                    rounded(r.cpu_s, 3),
                    r.status
                );
                continue;
            }
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {:.1} | {:.1} | {} | {} | {} | {} | {} | {} | {} | {} |",
                r.ladder,
                r.rung,
                r.points,
                r.steps,
                rounded(r.wall_s, 3),
                rounded(r.cpu_s, 3),
                r.point_steps_per_s * 1e-6,
                r.memory_bytes as f64 / 1048576.0,
                percent(r.max_force_error_rel),
                percent(r.max_displacement_error_rel),
                percent(r.restitution_error_rel),
                percent(r.contact_time_error_rel),
                percent(r.mae_force),
                percent(r.mae_displacement),
                percent(r.transfer_loss),
                if r.on_front { "*" } else { "" }
            );
        }
    }

    /// The same runs against Hertz and Johnson; nothing where the body yields.
    fn write_hertz(&self, text: &mut String) {
        if self.rows.iter().all(|r| r.hertz_mae_force.is_none()) {
            return;
        }
        text.push_str(
            "\n## Against Hertz and Johnson\n\nThe closed form is for half-spaces; the finest run shows how far a sphere \
             departs from it.\n\n| ladder | setting | F* | delta* | time | e | MAE F | MAE delta |\n|---|---|--:|--:|--:|--:|--:|--:|\n",
        );
        let cell = |x: Option<f64>| x.map_or_else(String::new, percent);
        for r in self.rows.iter().filter(|r| r.hertz_mae_force.is_some()) {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {:.4} | {} | {} |",
                r.ladder,
                r.rung,
                cell(r.hertz_max_force_error_rel),
                cell(r.hertz_max_displacement_error_rel),
                cell(r.hertz_contact_time_error_rel),
                r.restitution,
                cell(r.hertz_mae_force),
                cell(r.hertz_mae_displacement)
            );
        }
    }

    /// Whether a setting and every finer one of its ladder are within `threshold`: one that is near by luck, between two that
    /// are not, does not count. Ladders go from coarse to fine.
    fn holds(&self, row: &Row, threshold: f64) -> bool {
        let from = self.rows.iter().position(|r| std::ptr::eq(r, row));
        let finer = self.rows.iter().skip(from.unwrap_or(0));
        finer
            .filter(|r| r.ladder == row.ladder)
            // a NaN is no error within a threshold
            .all(|r| r.error <= threshold)
    }

    /// Cheapest setting that keeps F*, delta* and e within each threshold, as every finer one of its ladder does.
    fn write_cheapest(&self, text: &mut String) {
        text.push_str("\n## Cheapest setting for an accuracy in F*, delta* and e\n\nEvery finer setting of its ladder keeps it too.\n\n| within | setting | cpu s |\n|--:|---|--:|\n");
        for threshold in THRESHOLDS {
            let cheapest = self
                .rows
                .iter()
                .filter(|r| r.ladder != REFERENCE && self.holds(r, threshold))
                .min_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
            let (setting, seconds) = cheapest.map_or_else(
                || ("none of these".to_owned(), String::new()),
                |r| (format!("{}: {}", r.ladder, r.rung), rounded(r.cpu_s, 3)),
            );
            let _ = writeln!(
                text,
                "| {} % | {setting} | {seconds} |",
                significant(threshold * 100.0, 2)
            );
        }
    }
}

fn percent(value: f64) -> String {
    format!("{:.2}", value * 100.0)
}
