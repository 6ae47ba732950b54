//! Cost command: runs the ladders of a case one after the other and shows error against time; finished runs are kept.

use super::{Command, Context, Verdict, output_folder, print, print_json, show};
use crate::case::Case;
use crate::cost::accuracy;
use crate::cost::chapter::{self, Chapter, Done};
use crate::cost::thesis::{self, Comparison, SETTINGS};
use crate::cost::{Effort, Finished, Footprint, Pulse, Row, Rung, Summary, mark_front, rungs};
use crate::curve::{Impact, Status};
use crate::files::{Sum, sha256, sum_of, with_sum, write_atomic, write_rows};
use crate::impact::simulate;
use crate::plan::{Geometry, severity};
use crate::report::chart::{Chart, Mark, Series};
use crate::report::figure::Figure;
use crate::report::page::Block;
use crate::report::palette::Role;
use crate::report::scale::Axis;
use crate::scheme::TimeStep;
use crate::unit::{self, Time, significant};
use crate::{Error, Result};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Show what accuracy costs: ladders over grid, points, time step and scheme; errors against wall time.
#[derive(Debug, Args)]
pub struct CostArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's fastest, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Coarse ladders only: less than a minute.
    #[arg(long)]
    pub quick: bool,
    /// The thesis' chapter 3 as one page, `chapter_3.html`: its fifteen cases, tables 3-1 to 3-4 and figures beside its own; on all
    /// threads, for `cases/thesis-3.toml`.
    #[arg(long, conflicts_with_all = ["quick", "ladder", "json"])]
    pub chapter_3: bool,
    /// Ladders to run beside the reference, selected by the start of their names, e.g. `--ladder cells` (default: all).
    #[arg(long)]
    pub ladder: Vec<String>,
    /// Skip runs predicted to take longer than this (default: 2 min; with `--chapter-3` none is skipped).
    #[arg(long)]
    pub longest: Option<String>,
    /// Output folder (default: `out/<case name>`); files go to `cost` in it, and finished runs are kept there.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

impl Command for CostArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw cost cases/thesis-4-4.toml --quick",
        r#"impactlaw cost cases/thesis-4-4.toml --velocity "10 m/s" --ladder cells"#,
        "impactlaw cost cases/thesis-3.toml --chapter-3",
    ];

    /// Run the ladders of every speed asked for; write `cost_V*.csv`, `cost_V*.md` and the figures.
    ///
    /// One run at a time on one thread, so that wall times mean something.
    ///
    /// # Errors
    /// Those of reading the case and writing the files; [`Error::Impact`] when the finest run does not finish.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let case = Case::read(&self.case)?.with_velocities(&self.velocity)?;
        case.of_a_normal_impact("a ladder of settings")?;
        case.of_own_scheme("a ladder of settings")?;
        let longest = (self.longest.as_deref())
            .map(|text| unit::argument::<Time>("--longest", text))
            .transpose()?;
        if self.chapter_3 {
            check_chapter(&case)?;
        }
        let claim = output_folder(self.out.as_deref(), &case.name)?;
        context.open_log(&claim, "cost", &case.hash);
        let out = claim.join("cost");
        let speeds = match self.velocity.is_empty() {
            true => &case.velocities[case.velocities.len() - 1..],
            false => &case.velocities[..],
        };
        let mut lines = Vec::new();
        for &velocity in speeds {
            let job = Job {
                case: &case,
                velocity,
                out: &out,
                provenance: context.provenance(&case.hash),
                quiet: context.quiet,
            };
            if self.chapter_3 {
                job.chapter(longest, context)?;
                continue;
            }
            let rows = job.run(self, longest.unwrap_or(LONGEST), context)?;
            lines.extend(accuracy::lines(&rows, severity(&case.material, velocity)));
        }
        if self.chapter_3 {
            return Ok(Verdict::Met);
        }
        let provenance = context.provenance(&case.hash);
        write_rows(&out.join("cost_accuracy.csv"), &provenance, &lines)?;
        let text = accuracy::markdown(&lines);
        let markdown = format!("<!-- {provenance} -->\n{text}");
        write_atomic(&out.join("cost_accuracy.md"), markdown.as_bytes())?;
        match self.json {
            true => print_json(&lines)?,
            false => context.say(&text)?,
        }
        Ok(Verdict::Met)
    }
}

/// Runs predicted to take longer than this are skipped unless the user says otherwise, s.
const LONGEST: f64 = 120.0;

/// That a case is the one of the thesis' chapter 3.
fn check_chapter(case: &Case) -> Result<()> {
    match case.velocities[..] {
        [velocity] if thesis::is_its_case(case, velocity) => Ok(()),
        _ => Err(Error::Argument {
            argument: "--chapter-3".to_owned(),
            found: case.path.display().to_string(),
            allowed:
                "is for the sphere of the thesis' section 3.5 at 1 m/s alone: cases/thesis-3.toml"
                    .to_owned(),
        }),
    }
}

/// The ladders of one speed.
struct Job<'a> {
    case: &'a Case,
    velocity: f64,
    out: &'a Path,
    provenance: String,
    quiet: bool,
}

impl Job<'_> {
    fn run(&self, args: &CostArgs, longest: f64, context: &Context) -> Result<Vec<Row>> {
        let effort = if args.quick {
            Effort::Quick
        } else {
            Effort::Full
        };
        let all = rungs(self.case, self.velocity, effort);
        let (reference, others) = all.split_first().ok_or_else(|| Error::Figure {
            what: "cost".to_owned(),
            reason: "no ladders".to_owned(),
        })?;
        let wanted: Vec<&Rung> = others
            .iter()
            .filter(|r| is_wanted(&r.ladder, &args.ladder))
            .collect();
        if wanted.is_empty() {
            return Err(unknown_ladder(&args.ladder, others));
        }
        let bar = context.progress(wanted.len() as u64 + 1, "cost");
        let finest = self.finished(reference)?;
        check(&finest.impact)?;
        let pulse = Pulse::of(&finest.impact);
        let elastic = !reference.plan.plastic;
        let hertz = elastic.then(|| Pulse::hertz(self.case, self.velocity));
        let mut rows = vec![Row::new(reference, &finest, &pulse, hertz.as_ref())];
        let mut pulses = vec![pulse.clone()];
        let mut left_out = Vec::new();
        for rung in wanted {
            bar.inc(1);
            if rung.plan.seconds > longest && !self.folder(rung).join("summary.json").is_file() {
                left_out.push((format!("{}: {}", rung.ladder, rung.name), rung.plan.seconds));
                continue;
            }
            let done = self.finished(rung)?;
            tracing::info!(
                "{}: {} in {:.1} s",
                rung.ladder,
                rung.name,
                done.impact.summary.wall_s
            );
            rows.push(Row::new(rung, &done, &pulse, hertz.as_ref()));
            pulses.push(Pulse::of(&done.impact));
        }
        bar.finish_and_clear();
        mark_front(&mut rows);
        let unit = hertz.filter(|_| thesis::is_its_case(self.case, self.velocity));
        let tables = unit.map(|unit| {
            let comparison = Comparison {
                rows: &rows,
                pulses: &pulses,
                unit: &unit,
            };
            comparison.markdown()
        });
        self.write(&rows, &left_out, tables.as_deref())?;
        Ok(rows)
    }

    /// The thesis' chapter 3: all its runs, the longest first, then table, page and plots.
    fn chapter(&self, longest: Option<f64>, context: &Context) -> Result<()> {
        let (mut wanted, skipped): (Vec<_>, Vec<_>) = chapter::wanted(self.case, self.velocity)
            .into_iter()
            .partition(|one| {
                let short = longest.is_none_or(|longest| one.rung.plan.seconds <= longest);
                short || self.folder(&one.rung).join("summary.json").is_file()
            });
        for one in &skipped {
            tracing::warn!(
                "left out, for it takes {:.0} s: {}: {}",
                one.rung.plan.seconds,
                one.rung.ladder,
                one.rung.name
            );
        }
        wanted.sort_by(|a, b| b.rung.plan.seconds.total_cmp(&a.rung.plan.seconds));
        let bar = context.progress(wanted.len() as u64, "chapter 3");
        let unit = self.case.unit_of_time();
        let runs = wanted
            .par_iter()
            .with_max_len(1)
            .map(|one| {
                let done = self.finished(&one.rung)?;
                bar.inc(1);
                tracing::info!(
                    "{}: {} in {:.1} s (predicted {:.1} s)",
                    one.rung.ladder,
                    one.rung.name,
                    done.footprint.cpu_s,
                    one.rung.plan.seconds
                );
                Ok(Done {
                    place: one.case,
                    time_step: match one.rung.plan.scheme.time_step {
                        TimeStep::Fixed(dt) => dt * unit,
                        TimeStep::Stable => f64::NAN,
                    },
                    impact: done.impact,
                    cpu_s: done.footprint.cpu_s,
                })
            })
            .collect::<Result<Vec<Done>>>();
        bar.finish_and_clear();
        let mut runs = runs?;
        // in the order of the thesis, not in that of the clock
        let order = |done: &Done| {
            done.place.map(|place| {
                let solid = place.geometry != Geometry::Quarter;
                let setting = SETTINGS.iter().position(|s| s.name == place.setting.name);
                (solid, place.nth, setting)
            })
        };
        runs.sort_by_key(order);
        if let Some(reference) = runs.iter().find(|run| run.place.is_none()) {
            check(&reference.impact)?;
        }
        let johnson = Pulse::hertz(self.case, self.velocity);
        let chapter = Chapter {
            runs: &runs,
            johnson: &johnson,
        };
        write_rows(
            &self.out.join("chapter_3.csv"),
            &self.provenance,
            &chapter.rows(),
        )?;
        let page =
            super::on_a_worker(|| show::chapter::page(self.case, &chapter, &self.provenance))?;
        for block in page.sections.iter().flat_map(|section| &section.blocks) {
            if let Block::Figures(figures) = block {
                for figure in figures {
                    figure.write(&self.out.join("plots"))?;
                }
            }
        }
        let path = self.out.join("chapter_3.html");
        write_atomic(&path, page.html().as_bytes())?;
        context.say(&format!("{}\n-> {}\n", page.summary, path.display()))
    }

    /// Folder of a run, named after all that decides its outcome.
    fn folder(&self, rung: &Rung) -> PathBuf {
        let text = format!(
            "{} {:?} {} {:?} {:?} {:?} {}",
            crate::PROGRAM,
            self.case.material,
            self.case.radius,
            rung.plan.grid,
            rung.plan.scheme,
            (rung.plan.geometry, rung.plan.estimate, rung.plan.ring_time),
            rung.plan.velocity
        );
        let hash = sha256([text]);
        self.out.join("runs").join(&hash[..16])
    }

    /// The run of a rung: read if it is there, else simulated and kept.
    fn finished(&self, rung: &Rung) -> Result<Finished> {
        let folder = self.folder(rung);
        if folder.join("summary.json").is_file() {
            return kept(&folder);
        }
        let before = processor_time();
        let done = simulate(&self.case.material, self.case.radius, &rung.plan);
        let footprint = Footprint {
            memory_bytes: done.memory_bytes,
            transfer_loss: done.transfer_loss,
            cpu_s: match (before, processor_time()) {
                (Some(before), Some(after)) => after - before,
                _ => done.impact.summary.wall_s,
            },
        };
        let path = folder.join("footprint.json");
        let text = with_sum(&footprint, b"");
        let text = text.map_err(|e| Error::file("write", &path)(e.into()))?;
        // the summary comes last: it says that all is there
        write_atomic(&path, text.as_bytes())?;
        done.impact.write(&folder, &self.provenance)?;
        // read back: JSON may change a last digit, and a second call must show the same
        kept(&folder)
    }

    fn write(&self, rows: &[Row], left_out: &[(String, f64)], thesis: Option<&str>) -> Result<()> {
        let speed = significant(self.velocity, 4);
        let name = |end: &str| self.out.join(format!("cost_V{speed}{end}"));
        write_rows(&name(".csv"), &self.provenance, rows)?;
        let summary = Summary {
            case: &self.case.name,
            rows,
            left_out,
            thesis,
        };
        let text = summary.markdown();
        let markdown = format!("<!-- {} -->\n{text}", self.provenance);
        write_atomic(&name(".md"), markdown.as_bytes())?;
        figure(rows, format!("cost_V{speed}"))?.write(self.out)?;
        match self.quiet {
            true => Ok(()),
            false => print(&text),
        }
    }
}

/// A run that was kept in `folder`.
fn kept(folder: &Path) -> Result<Finished> {
    let path = folder.join("footprint.json");
    let text = std::fs::read_to_string(&path).map_err(Error::file("read", &path))?;
    if sum_of(&text, b"") == Sum::Differs {
        let damaged = "it is damaged; remove its folder to make the run again";
        let damaged = std::io::Error::new(std::io::ErrorKind::InvalidData, damaged);
        return Err(Error::file("use", &path)(damaged));
    }
    let footprint =
        serde_json::from_str(&text).map_err(|e| Error::file("read", &path)(e.into()))?;
    Ok(Finished {
        impact: Impact::read(folder)?,
        footprint,
    })
}

/// Processor time of this thread so far, s, where the system tells.
fn processor_time() -> Option<f64> {
    // the account is brought up to date when a thread gives way, else only a few hundred times a second
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

/// Whether a ladder's name begins with one of those asked for.
fn is_wanted(ladder: &str, asked: &[String]) -> bool {
    asked.is_empty() || asked.iter().any(|a| ladder.starts_with(a.as_str()))
}

fn unknown_ladder(asked: &[String], rungs: &[Rung]) -> Error {
    let mut names: Vec<&str> = rungs.iter().map(|r| r.ladder.as_str()).collect();
    names.dedup();
    Error::Argument {
        argument: "--ladder".to_owned(),
        found: format!("\"{}\"", asked.join("\", \"")),
        allowed: format!("must begin one of: {}", names.join("; ")),
    }
}

/// Nothing can be measured against a run that did not finish.
fn check(impact: &Impact) -> Result<()> {
    let reason = match &impact.summary.status {
        Status::Ok => return Ok(()),
        Status::Sticks => "the finest run stays on the wall".to_owned(),
        Status::NoRebound => "the finest run did not rebound".to_owned(),
        Status::Failed(reason) => format!("the finest run failed: {reason}"),
    };
    Err(Error::Impact {
        velocity: impact.summary.velocity_m_s,
        step: impact.summary.steps,
        reason,
    })
}

/// Name under which a ladder's points stand in the figure: as many as there are colours to tell them apart.
fn group(ladder: &str) -> &str {
    match ladder {
        "points" | "time step" | "far cells" | "growth" => "grid details",
        _ if ladder.starts_with("lattice, 3-D") => "lattices, 3-D",
        _ if ladder.starts_with("lattice") => "lattices, section",
        _ if ladder.starts_with("thesis") => "thesis preset",
        "cells, degree 1" | "cells, degree 3" => "cells, degrees 1 and 3",
        "transfer" => "FLIP, PIC, APIC",
        "planned" => "planned for 5 to 0.5 %",
        other => other,
    }
}

/// Error against processor time, one colour a group of ladders, and the Pareto front.
fn figure(rows: &[Row], name: String) -> Result<Figure> {
    let good = |r: &&Row| r.error > 0.0 && r.cpu_s > 0.0;
    let mut front: Vec<(f64, f64)> = rows
        .iter()
        .filter(|r| r.on_front)
        .filter(good)
        .map(|r| (r.cpu_s, r.error))
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut series = vec![Series {
        label: "Pareto front".to_owned(),
        role: Role::Law,
        mark: Mark::Line,
        points: front,
        supported_to: None,
    }];
    for row in rows.iter().filter(good) {
        let point = (row.cpu_s, row.error);
        let label = group(&row.ladder);
        let role = match row.ladder.as_str() {
            "planned" => Role::Simulation,
            _ => Role::Other,
        };
        match series.iter_mut().find(|s| s.label == label) {
            Some(series) => series.points.push(point),
            None => series.push(Series {
                label: label.to_owned(),
                role,
                mark: Mark::Points,
                points: vec![point],
                supported_to: None,
            }),
        }
    }
    let axis = |label: &str, unit| Axis {
        log_if_wide: true,
        ..Axis::new(label, unit)
    };
    Figure::chart(
        name,
        "Largest relative error of F*, delta* and e against the finest run, over time on one core; the line joins \
         the settings that no other beats."
            .to_owned(),
        Chart {
            x: axis("time on one core", "s"),
            y: axis("largest error of F*, δ*, e", ""),
            series,
        },
    )
}
