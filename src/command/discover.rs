//! Discover command: from the results of a study to groups, rankings, equations and their scores.

use super::show::discover::{Finding, page, summary, undetermined, units};
use super::show::equations::{Known, file, finding_rows, rank_rows, written};
use super::{Command, Context, Verdict, output_folder};
use crate::discover::bound::Bound;
use crate::discover::file::HEADER;
use crate::discover::front::{Entry, Setting, chosen, front};
use crate::discover::identity::identities;
use crate::discover::more::Candidates;
use crate::discover::physics::Places;
use crate::discover::problem::{Inputs, Runs, Target, YIELD_SPEED, yield_speed};
use crate::discover::ranking::{Ranked, ranking};
use crate::discover::score::{Model, Score, Split};
use crate::discover::search::Effort;
use crate::discover::table::{Column, Table};
use crate::discover::thesis::equations;
use crate::files::{self, sha256, write_atomic, write_rows};
use crate::{Error, Result};
use clap::Args;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Figures an equation is looked for where nothing else is asked for.
const FIGURES: [&str; 5] = [
    "equivalent_plastic_strain",
    "compression_ratio",
    "restitution",
    "max_force_N",
    "max_displacement_m",
];

/// Find equations in the results of a study: groups by units, rankings, formulas with scores on levels left out.
#[derive(Debug, Args)]
pub struct DiscoverArgs {
    /// Results of a study: `results.csv`, or the folder it is in.
    pub results: PathBuf,
    /// Figures to find equations of, as the columns are called (default: equivalent_plastic_strain, compression_ratio,
    /// restitution, max_force_N, max_displacement_m).
    #[arg(long, num_args = 1..)]
    pub target: Vec<String>,
    /// Rows to use, e.g. `--where "rho V^2/Y <= 3.2"`; may be given more than once.
    #[arg(long = "where")]
    pub bounds: Vec<String>,
    /// Error of the data (default: the tolerance the runs were planned for; 0.02 where no column says it).
    #[arg(long)]
    pub tolerance: Option<f64>,
    /// Seed of everything that is drawn.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Run this many cases more, where the formulas found disagree most, into the store of the study, and look again.
    #[arg(long, default_value_t = 0, value_name = "RUNS")]
    pub add: usize,
    /// Largest structure that is enumerated, in nodes; the time grows about fourfold with each.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=9))]
    pub size: u8,
    /// Rounds in which the best structures are grown beyond that size.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(0..=4))]
    pub rounds: u8,
    /// Output folder; by default `discover` beside the results.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Trees and seeds of a ranking.
const RANKING: (usize, u64) = (100, 3);
/// Structures that are grown and made simpler, and starts of each fit.
const KEPT: usize = 12;
const STARTS: usize = 3;

impl Command for DiscoverArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw discover out/study-480",
        r#"impactlaw discover out/study-480/results.csv --where "rho V^2/Y <= 3.2" --target restitution"#,
    ];

    /// Look for the equations; write `equations.toml`, `discover.csv`, `ranking.csv`, `discover.md` and `report.html`.
    ///
    /// # Errors
    /// Those of reading the results and of writing; [`Error::Value`] for columns that cannot be used, before any search.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let path = match self.results.is_dir() {
            true => self.results.join("results.csv"),
            false => self.results.clone(),
        };
        if let Some(tolerance) = self.tolerance
            && !(tolerance > 0.0 && tolerance <= 0.2)
        {
            return Err(Error::Argument {
                argument: "--tolerance".to_owned(),
                found: tolerance.to_string(),
                allowed: "must lie in (0, 0.2], e.g. 0.02".to_owned(),
            });
        }
        let bytes = std::fs::read(&path).map_err(Error::file("read", &path))?;
        let mut hash = sha256([&bytes]);
        let mut text = files::text(bytes, &path)?;
        let mut study = Study::parse(&text, &path, self)?;
        let beside = path.parent().unwrap_or(Path::new("")).join("discover");
        let out = output_folder(Some(self.out.as_deref().unwrap_or(&beside)), "discover")?;
        context.open_log(&out, "discover", &hash);
        let provenance = context.provenance(&hash);
        context.say(&study.text())?;
        let mut findings = super::on_a_worker(|| Ok(study.findings(self, context)))?;
        let mut verdict = Verdict::Met;
        if self.add > 0 {
            (text, verdict) = self.more(&study, &findings, &path, &hash, context)?;
            study = Study::parse(&text, &path, self)?;
            hash = sha256([&text]);
            context.say(&study.text())?;
            findings = super::on_a_worker(|| Ok(study.findings(self, context)))?;
        }
        let mut ranks = Vec::new();
        let mut rows = Vec::new();
        for finding in &findings {
            ranks.extend(rank_rows(finding));
            rows.extend(finding_rows(finding));
        }
        write_rows(&out.join("ranking.csv"), &provenance, &ranks)?;
        write_rows(&out.join("discover.csv"), &provenance, &rows)?;
        let undetermined: Vec<String> = undetermined(&study.table, &study.inputs);
        let known = Known {
            table: &study.table,
            inputs: &study.inputs,
            runs: &study.runs,
            targets: &study.targets,
            undetermined: &undetermined,
        };
        let file = file(&known, &findings, &hash, self.seed);
        let text = toml::to_string(&file).map_err(|error| {
            Error::file("write", &out.join("equations.toml"))(std::io::Error::other(error))
        })?;
        let head: String = HEADER.lines().map(|line| format!("# {line}\n")).collect();
        write_atomic(
            &out.join("equations.toml"),
            format!("# {provenance}\n{head}\n{text}").as_bytes(),
        )?;
        let said = summary(&study.text(), &findings);
        write_atomic(
            &out.join("discover.md"),
            format!("<!-- {provenance} -->\n{said}").as_bytes(),
        )?;
        page(&study.text(), &findings, &provenance)?.write(&out)?;
        context.say(&said)?;
        context.say(&format!("-> {}\n", out.join("equations.toml").display()))?;
        Ok(verdict)
    }
}

impl DiscoverArgs {
    /// Runs cases where the formulas of a first look disagree; both tables as text.
    fn more(
        &self,
        study: &Study,
        findings: &[Finding],
        path: &Path,
        hash: &str,
        context: &Context,
    ) -> Result<(String, Verdict)> {
        let bounds = self.bounds.iter();
        let bounds = bounds.map(|bound| Bound::parse(bound, &study.table));
        let bounds: Vec<Bound> = bounds.collect::<Result<_>>()?;
        let candidates = Candidates::of(&study.table, &study.inputs, &bounds, self.seed);
        let fronts: Vec<(&Target, &[Entry])> = study
            .targets
            .iter()
            .zip(findings)
            .map(|((_, target), finding)| (target, &finding.front[..]))
            .collect();
        let tolerance = self
            .tolerance
            .or(study.table.tolerance)
            .unwrap_or(TOLERANCE);
        let chosen = candidates.chosen(&study.runs, &fronts, tolerance, self.add);
        let cases = super::discover_add::cases(&study.table, &candidates, &chosen)?;
        let count = cases.len();
        let (added, both, verdict) = super::discover_add::run(cases, path, hash, context)?;
        context.say(&format!(
            "{count} runs added where the formulas disagree -> {}\n",
            added.display()
        ))?;
        Ok((both, verdict))
    }
}

/// A study, looked at.
struct Study {
    table: Table,
    inputs: Inputs,
    runs: Runs,
    targets: Vec<(Column, Target)>,
    elastic: usize,
    outside: usize,
}

impl Study {
    /// Looks at results; everything that is wrong with them is found here.
    fn parse(text: &str, path: &Path, args: &DiscoverArgs) -> Result<Self> {
        let mut table = Table::parse(text, path)?;
        let all = table.rows();
        for bound in &args.bounds {
            let rows = Bound::parse(bound, &table)?.rows(&table);
            table = table.some(&rows);
        }
        let within = table.rows();
        if let Some(column) = yield_speed(&table) {
            let speed = table
                .input("velocity_m_s")
                .map_or(Vec::new(), |c| c.values.clone());
            // what has no speed of first yield stays, to be refused for its reason
            let elastic = |row: &usize| speed.get(*row).is_some_and(|v| *v <= column.values[*row]);
            let plastic = |row: &usize| !elastic(row);
            let rows: Vec<usize> = (0..table.rows()).filter(plastic).collect();
            table.inputs.retain(|column| column.name != YIELD_SPEED);
            table.inputs.push(column);
            table = table.some(&rows);
        }
        if table.rows() < FEWEST {
            return Err(Error::in_table(
                path,
                "rows",
                format!(
                    "{} of {all} that yield and lie within --where",
                    table.rows()
                ),
                &format!("must be at least {FEWEST}: run a study of more cases"),
            ));
        }
        let names: Vec<&str> = match args.target.is_empty() {
            true => FIGURES
                .into_iter()
                .filter(|name| table.figures.iter().any(|c| c.name == *name))
                .collect(),
            false => args.target.iter().map(String::as_str).collect(),
        };
        let figures: Vec<Column> = names
            .iter()
            .map(|name| table.figure(name).cloned())
            .collect::<Result<_>>()?;
        if figures.is_empty() {
            table.figure(FIGURES[0])?;
        }
        let of: Vec<&Column> = figures.iter().collect();
        let inputs = Inputs::of(&table, &of)?;
        let runs = Runs::of(&table, &inputs);
        let tolerance = args.tolerance.or(table.tolerance).unwrap_or(TOLERANCE);
        let targets = figures
            .into_iter()
            .map(|figure| {
                let target = runs.target(&table, &inputs, &figure, tolerance)?;
                Ok((figure, target))
            })
            .collect::<Result<_>>()?;
        let study = Study {
            elastic: within - table.rows(),
            outside: all - within,
            table,
            inputs,
            runs,
            targets,
        };
        Ok(study)
    }

    /// What units and rows say, as text.
    fn text(&self) -> String {
        let counts = [self.outside, self.elastic];
        units(&self.table, &self.inputs, &self.runs, counts)
    }

    /// Numbers of the materials: rows with equal inputs but for the speed.
    fn materials(&self) -> Vec<usize> {
        let mut numbers: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
        let columns: Vec<&Column> = self
            .table
            .inputs
            .iter()
            .filter(|c| c.name != "velocity_m_s")
            .collect();
        (0..self.table.rows())
            .map(|row| {
                let key = columns
                    .iter()
                    .map(|column| column.values[row].to_bits())
                    .collect();
                let next = numbers.len();
                *numbers.entry(key).or_insert(next)
            })
            .collect()
    }

    fn findings(&self, args: &DiscoverArgs, context: &Context) -> Vec<Finding> {
        let places = Places::of(&self.runs, &self.inputs);
        let levels = Split::levels(&self.runs);
        let materials = Split::materials(&self.runs, &self.materials());
        let setting = Setting {
            runs: &self.runs,
            places: &places,
            levels: &levels,
            materials: &materials,
            seed: args.seed,
            effort: Effort {
                size: usize::from(args.size),
                starts: STARTS,
                kept: KEPT,
                rounds: usize::from(args.rounds),
            },
        };
        let bar = context.progress(self.targets.len() as u64, "discover");
        let mut findings: Vec<Finding> = self
            .targets
            .iter()
            .map(|(figure, target)| {
                let front = front(&setting, target);
                let ranking = self.ranking(figure);
                let ranked = self.ranked();
                let finding = Finding {
                    ranked: ranking
                        .iter()
                        .map(|one| ranked[one.column].name.clone())
                        .collect(),
                    figure: figure.name.clone(),
                    scale: target.scale.text(),
                    chosen: chosen(&front),
                    formulas: front
                        .iter()
                        .map(|entry| written(&self.inputs, entry, true))
                        .collect(),
                    predicted: front
                        .iter()
                        .map(|entry| entry.found.fitted.formula.values(&self.runs.columns))
                        .collect(),
                    values: target.values.clone(),
                    front,
                    identities: identities(&self.table, &self.inputs, &self.runs, figure),
                    baselines: self.baselines(figure, target, &setting),
                    ranking,
                    notes: Vec::new(),
                };
                bar.inc(1);
                finding
            })
            .collect();
        bar.finish_and_clear();
        self.balance(&mut findings, &places);
        findings
    }

    /// Plastic strain and restitution together must not make energy: equations of the strain that do are rejected.
    fn balance(&self, findings: &mut [Finding], places: &Places) {
        let at = |name: &str| findings.iter().position(|finding| finding.figure == name);
        let (Some(strain), Some(e)) = (at("equivalent_plastic_strain"), at("restitution")) else {
            return;
        };
        let Some(restitution) = findings[e]
            .best()
            .map(|entry| entry.found.fitted.formula.clone())
        else {
            return;
        };
        let error = self.targets[strain].1.errors[0];
        let excess =
            |entry: &Entry| places.energy_excess(&entry.found.fitted.formula, &restitution);
        let finding = &mut findings[strain];
        let all: Vec<Option<f64>> = finding.front.iter().map(excess).collect();
        let kept: Vec<bool> = all.iter().map(|x| x.is_none_or(|x| x <= error)).collect();
        if kept.iter().any(|k| !k) {
            let out: Vec<String> = finding
                .front
                .iter()
                .zip(&kept)
                .filter(|(_, kept)| !**kept)
                .map(|(entry, _)| entry.found.constants.to_string())
                .collect();
            finding.notes.push(format!(
                "rejected by the balance of energies with the equation of restitution: those with {} constants",
                out.join(", ")
            ));
        }
        finding.keep(&kept);
        let worst = finding.best().and_then(excess);
        if let Some(worst) = worst {
            finding.notes.push(format!(
                "balance of energies with the equation of restitution: plastic work exceeds 1 - e^2 nowhere by more than a strain of \
                 {} (error of the data {})",
                crate::unit::significant(worst.max(0.0), 2),
                crate::unit::significant(error, 2)
            ));
        }
    }

    fn ranking(&self, figure: &Column) -> Vec<Ranked> {
        let columns: Vec<Vec<f64>> = self
            .ranked()
            .iter()
            .map(|column| column.values.clone())
            .collect();
        ranking(&columns, &figure.values, RANKING.0, RANKING.1)
    }

    /// Columns that are ranked: raw inputs that vary, and the speed at first yield.
    fn ranked(&self) -> Vec<&Column> {
        let raw = |c: &&Column| {
            self.inputs.free.contains(&c.name) || (c.name == YIELD_SPEED && !c.constant())
        };
        self.table.inputs.iter().filter(raw).collect()
    }

    fn baselines(
        &self,
        figure: &Column,
        target: &Target,
        setting: &Setting<'_>,
    ) -> Vec<(String, usize, [Score; 3])> {
        let every: Vec<usize> = (0..self.runs.columns.rows).collect();
        let scores = |model: &Model| {
            let seen = model.predict(&self.runs, target, &every, &every);
            [
                Score::of(&seen, target, &self.runs.counts),
                model.left_out(&self.runs, target, setting.levels),
                model.left_out(&self.runs, target, setting.materials),
            ]
        };
        let nu = self
            .table
            .input("poisson_ratio")
            .filter(|c| c.constant())
            .map(|c| c.values[0]);
        let mut all = Vec::new();
        for one in equations(&figure.name, &self.inputs, nu) {
            let n = one.formula.constants().len();
            all.push((
                one.name.to_owned(),
                n,
                scores(&Model::Told(one.formula.clone())),
            ));
            all.push((
                format!("{}, refitted", one.name),
                n,
                scores(&Model::Fitted(one.formula)),
            ));
        }
        all.push((
            "random forest".to_owned(),
            0,
            scores(&Model::Forest(setting.seed)),
        ));
        let logarithm = !figure.dimension.is_none();
        all.push((
            "Gaussian process".to_owned(),
            0,
            scores(&Model::Process(logarithm)),
        ));
        all
    }
}

/// Error of data that do not say theirs.
const TOLERANCE: f64 = 0.02;
/// Fewest rows with which anything is looked for.
const FEWEST: usize = 12;
