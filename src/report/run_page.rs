//! Run page: what a finished run has to show, as plain data, laid out in the order a reader asks.

use super::figure::Figure;
use super::page::{Block, Page, Section};
use super::table::Table;
use crate::Result;
use crate::case::Case;
use crate::case::pair::{Target, TargetShape};
use crate::curve::{Status, Summary};
use crate::material::Material;
use crate::unit::{engineering, prefixed, rounded, significant};
use std::path::{Path, PathBuf};

/// A setting the planner chose.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// What was decided: "friction", "grid".
    pub what: String,
    /// The decision: "off", "h = R/200 at the pole".
    pub setting: String,
    /// Why.
    pub reason: String,
}

/// What a fit has to show.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FitShow {
    /// What kind of law it is, and how good.
    pub summary: String,
    /// The law's equations as text.
    pub equations: String,
    /// Fitted constants with their intervals.
    pub constants: Table,
    /// Errors of each form of the law on the impacts, and on each speed when it was held out.
    pub errors: Vec<Table>,
    /// Where the law may be used.
    pub validity: String,
}

/// What a bed run has to show.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BedShow {
    /// Scene and figures of the run: grains, steps, closure.
    pub facts: Vec<(String, String)>,
    /// One row a law.
    pub results: Table,
    /// Curves.
    pub figures: Vec<Figure>,
    /// PNG of the bed with its caption.
    pub picture: Option<(Vec<u8>, String)>,
}

/// Everything a report can show; what is empty is left out of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPage<'a> {
    /// The case.
    pub case: &'a Case,
    /// The second deformable body; none where the wall is rigid.
    pub target: Option<&'a Target>,
    /// Text of the case file.
    pub case_text: &'a str,
    /// Command that made the run.
    pub command: &'a str,
    /// Program name and version.
    pub version: &'a str,
    /// Wall time of the whole run, s.
    pub wall: Option<f64>,
    /// Wall time the planner predicted for the impacts, s.
    pub predicted: Option<f64>,
    /// The plan.
    pub plan: Vec<Choice>,
    /// Figures of the impacts, by speed.
    pub impacts: Vec<Summary>,
    /// Force-displacement curves and restitution.
    pub curves: Vec<Figure>,
    /// Fields over the deformed particle.
    pub maps: Vec<Figure>,
    /// The fitted law.
    pub fit: Option<FitShow>,
    /// Laws against the simulated impacts.
    pub comparison: Vec<Block>,
    /// The bed.
    pub bed: Option<BedShow>,
    /// Papers of the models used.
    pub references: Vec<String>,
    /// What the results do not cover.
    pub limits: Vec<String>,
}

/// Symbols of tables and figures.
const SYMBOLS: [(&str, &str); 9] = [
    (
        "V, e",
        "impact speed; restitution: speed of the centre of mass after the impact over that before",
    ),
    (
        "V_y",
        "speed at first yield: Hertz’s largest pressure reaches 1.6 Y",
    ),
    (
        "δ",
        "displacement: approach of the centre of mass to the wall since first contact",
    ),
    (
        "F*, δ*",
        "largest force, averaged over 2 % of the contact time, of flattened bodies over the crossing of a cell; largest displacement",
    ),
    (
        "δ_res, t_c",
        "displacement at loss of contact; contact time",
    ),
    (
        "D, H_d, H_e",
        "diameter; height after the impact, averaged over the vibration; height at the largest compression",
    ),
    (
        "ε_p",
        "equivalent plastic strain, mean over the volume after the rebound",
    ),
    ("W_i, W_p", "incident kinetic energy; plastic work"),
    (
        "Y, E, ρ, ν, R",
        "yield strength, Young’s modulus, density, Poisson’s ratio, radius",
    ),
];

impl RunPage<'_> {
    /// Write `report.html` and `plots/*.svg` into `folder`; the page's path.
    ///
    /// # Errors
    /// [`crate::Error::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        self.page().write(folder)
    }

    /// The page.
    #[must_use]
    pub fn page(&self) -> Page {
        Page {
            title: format!("Contact law of {}", self.case.name),
            summary: self.summary(),
            sections: Vec::new(),
            colophon: format!("{}; case sha256 {}", self.version, self.case.hash),
        }
        .with(self.asked())
        .with(self.planned())
        .with(self.impact_section())
        .with(Section::new("Inside the particle").with(Block::Figures(self.maps.clone())))
        .with(self.law_section())
        .with(self.comparison_section())
        .with(self.bed_section())
        .with(self.audit())
        .with(Section::new("Limits").with(Block::List(self.limits.clone())))
        .with(Section::new("References").with(Block::List(self.references.clone())))
        .with(self.how_made())
    }

    fn summary(&self) -> String {
        let (Some(first), Some(last)) = (self.impacts.first(), self.impacts.last()) else {
            return "No impact was simulated.".to_owned();
        };
        let e = |summary: &Summary| significant(summary.restitution, 3);
        let unbroken = |text: String| text.replace(' ', "\u{a0}");
        let force = |summary: &Summary| unbroken(engineering(summary.max_force_n, "N", 3));
        let speed = |summary: &Summary| unbroken(engineering(summary.velocity_m_s, "m/s", 4));
        let wall = match self.target {
            None => "rigid frictionless wall".to_owned(),
            Some(target) => format!("deformable {}", target.shape.name()),
        };
        if self.impacts.len() == 1 {
            return format!(
                "One impact on a {wall} at {}: restitution {}, peak force {}.",
                speed(first),
                e(first),
                force(first)
            );
        }
        format!(
            "{} impacts on a {wall}. From {} to {} the restitution goes from {} to {}, the peak force \
             from {} to {}.",
            self.impacts.len(),
            speed(first),
            speed(last),
            e(first),
            e(last),
            force(first),
            force(last)
        )
    }

    fn asked(&self) -> Section {
        let material = &self.case.material;
        let speeds: Vec<String> = self
            .case
            .velocities
            .iter()
            .map(|v| significant(*v, 4))
            .collect();
        let mut facts = vec![("Radius R".to_owned(), engineering(self.case.radius, "m", 4))];
        facts.extend(constants(material));
        if let Some(target) = self.target {
            facts.push(("Second body".to_owned(), second_body(target.shape)));
            let whose = |(name, value): (String, String)| (format!("{name}, second body"), value);
            facts.extend(constants(&target.material).into_iter().map(whose));
            let of_both = "V is that of the two centres of mass towards each other, δ their approach; of a body that is held, those of the particle";
            facts.push(("Two bodies".to_owned(), of_both.to_owned()));
        }
        facts.push((
            "Impact speeds V".to_owned(),
            format!("{} m/s", speeds.join(", ")),
        ));
        let tolerance = format!(
            "{} % on F*, δ* and e",
            significant(100.0 * self.case.tolerance, 3)
        );
        facts.push(("Tolerance".to_owned(), tolerance));
        Section::new("Asked for").with(Block::Facts(facts))
    }

    fn planned(&self) -> Section {
        let mut table = Table::new("", &["setting", "choice", "why"]);
        for choice in &self.plan {
            table.rows.push(vec![
                choice.what.clone(),
                choice.setting.clone(),
                choice.reason.clone(),
            ]);
        }
        let time = self.predicted.map_or_else(String::new, |predicted| {
            let impacts: f64 = self.impacts.iter().map(|summary| summary.wall_s).sum();
            format!(
                "Time of the impacts, summed over the speeds: {} predicted, {} taken.",
                engineering(predicted, "s", 2),
                engineering(impacts, "s", 2)
            )
        });
        Section::new("Plan")
            .with(Block::Table(table))
            .with(Block::Text(time))
    }

    fn impact_section(&self) -> Section {
        let curves = match self.curves.is_empty() {
            true => "",
            false => {
                "Force against displacement of the centre of mass: the simulation (MPM), the fitted law, and the \
                 theories that come nearest over all speeds; the others stand in the tables of laws compared. Curves that \
                 leave the frame are cut. The simulated force climbs in small teeth: the contact grows from cell to cell of \
                 the grid, and in fast impacts waves cross the particle. Finer cells make the teeth smaller; F* is a mean \
                 over part of the contact time, so that a single tooth does not count."
            }
        };
        let symbols = match self.impacts.is_empty() {
            true => Vec::new(),
            false => SYMBOLS
                .map(|(symbol, meaning)| (symbol.to_owned(), meaning.to_owned()))
                .to_vec(),
        };
        Section::new("Impacts")
            .with(Block::Facts(symbols))
            .with(Block::Table(self.figures_table()))
            .with(Block::Text(curves.to_owned()))
            .with(Block::Figures(self.curves.clone()))
    }

    fn figures_table(&self) -> Table {
        let of = |get: fn(&Summary) -> f64| Column::new(&self.impacts, get);
        let columns = [
            of(|s| s.velocity_m_s).titled("V", "m/s"),
            of(|s| s.restitution).titled("e", ""),
            of(|s| s.max_force_n).titled("F*", "N"),
            of(|s| s.max_displacement_m).titled("δ*", "m"),
            of(|s| s.residual_displacement_m).titled("δ_res", "m"),
            of(|s| s.contact_time_s).titled("t_c", "s"),
            of(|s| s.compression_ratio).titled("1 − H_d/D", ""),
            of(|s| s.height_at_max_compression_ratio).titled("H_e/D", ""),
            of(|s| s.equivalent_plastic_strain).titled("mean ε_p", ""),
        ];
        Column::table("Figures of the simulated impacts.", &columns)
    }

    fn audit(&self) -> Section {
        let of = |get: fn(&Summary) -> f64| Column::new(&self.impacts, get);
        // what unloading could not give back, and the vibration after it
        let left = |s: &Summary| 1.0 - s.restitution * s.restitution - s.plastic_work_ratio;
        let columns = [
            of(|s| s.velocity_m_s).titled("V", "m/s"),
            of(|s| 1.0 - s.restitution * s.restitution).titled("energy lost 1 − e²", ""),
            of(|s| s.plastic_work_ratio).titled("plastic work W_p/W_i", ""),
            of(left).titled("left in residual stress and vibration", ""),
            of(|s| s.energy_closure).titled("closure error", ""),
            of(|s| s.points as f64).titled("points", ""),
            of(|s| s.steps as f64).titled("steps", ""),
            of(|s| s.wall_s).titled("wall time", "s"),
        ];
        let mut table = Column::table(
            "Energy of each impact as a share of the incident kinetic energy, and what it cost.",
            &columns,
        );
        table.head.push("status".to_owned());
        for (row, summary) in table.rows.iter_mut().zip(&self.impacts) {
            row.push(match &summary.status {
                Status::Ok => "ok".to_owned(),
                Status::Sticks => "sticks".to_owned(),
                Status::NoRebound => "no rebound".to_owned(),
                Status::Failed(reason) => format!("failed: {reason}"),
            });
        }
        let warnings = self.impacts.iter().flat_map(|summary| {
            let speed = engineering(summary.velocity_m_s, "m/s", 4);
            (summary.warnings.iter()).map(move |warning| format!("Warning, at {speed}: {warning}."))
        });
        Section::new("Energy audit")
            .with(Block::Table(table))
            .with(Block::List(warnings.collect()))
    }

    fn law_section(&self) -> Section {
        let mut section = Section::new("Fitted law");
        if let Some(fit) = &self.fit {
            section = section
                .with(Block::Text(fit.summary.clone()))
                .with(Block::Table(fit.constants.clone()));
            for table in &fit.errors {
                section = section.with(Block::Table(table.clone()));
            }
            section = section
                .with(Block::Text(fit.validity.clone()))
                .with(Block::Code(fit.equations.clone()));
        }
        section
    }

    fn comparison_section(&self) -> Section {
        self.comparison
            .iter()
            .fold(Section::new("Laws compared"), |section, block| {
                section.with(block.clone())
            })
    }

    fn bed_section(&self) -> Section {
        let mut section = Section::new("Bed");
        if let Some(bed) = &self.bed {
            section = section
                .with(Block::Facts(bed.facts.clone()))
                .with(Block::Table(bed.results.clone()))
                .with(Block::Figures(bed.figures.clone()));
            if let Some((png, caption)) = &bed.picture {
                section = section.with(Block::Picture {
                    png: png.clone(),
                    caption: caption.clone(),
                });
            }
        }
        section
    }

    fn how_made(&self) -> Section {
        let mut facts = vec![
            ("Program".to_owned(), self.version.to_owned()),
            ("Case file".to_owned(), self.case.path.display().to_string()),
        ];
        if let Some(wall) = self.wall {
            facts.push(("Wall time".to_owned(), engineering(wall, "s", 3)));
        }
        Section::new("How it was made")
            .with(Block::Code(self.command.to_owned()))
            .with(Block::Facts(facts))
            .with(Block::Code(self.case_text.trim_end().to_owned()))
    }
}

/// Constants of a material, by name.
fn constants(material: &Material) -> Vec<(String, String)> {
    let mut facts = vec![
        (
            "Density ρ".to_owned(),
            engineering(material.density, "kg/m³", 5),
        ),
        (
            "Young’s modulus E".to_owned(),
            engineering(material.young_modulus, "Pa", 4),
        ),
        (
            "Poisson’s ratio ν".to_owned(),
            significant(material.poisson_ratio, 4),
        ),
    ];
    if let Some(flow) = material.flow {
        facts.push(("Flow stress".to_owned(), flow.name().to_owned()));
        for (constant, value) in flow.constants() {
            let value = engineering(value, constant.dimension.unit(), 4);
            facts.push((constant.title(), value));
        }
    } else {
        facts.push(("Flow stress".to_owned(), "none (elastic)".to_owned()));
    }
    facts
}

/// A second body in words.
fn second_body(shape: TargetShape) -> String {
    match shape {
        TargetShape::Sphere { radius } => format!("sphere of {}", engineering(radius, "m", 4)),
        TargetShape::Plate { thickness } => {
            format!(
                "plate of {}, held at its back",
                engineering(thickness, "m", 4)
            )
        }
        TargetShape::HalfSpace => "half-space".to_owned(),
    }
}

/// A column of numbers that share one unit.
struct Column {
    title: String,
    values: Vec<f64>,
    factor: f64,
}

impl Column {
    fn new(impacts: &[Summary], get: fn(&Summary) -> f64) -> Self {
        Column {
            title: String::new(),
            values: impacts.iter().map(get).collect(),
            factor: 1.0,
        }
    }

    /// With a title; the prefix of the unit suits the largest value.
    fn titled(mut self, title: &str, unit: &str) -> Self {
        let largest = self
            .values
            .iter()
            .fold(0.0f64, |max, value| max.max(value.abs()));
        let (factor, unit) = prefixed(largest, unit);
        self.factor = factor;
        self.title = match unit.as_str() {
            "" => title.to_owned(),
            unit => format!("{title} ({unit})"),
        };
        self
    }

    fn table(caption: &str, columns: &[Column]) -> Table {
        let head: Vec<&str> = columns.iter().map(|column| column.title.as_str()).collect();
        let mut table = Table::new(caption, &head);
        let rows = columns.first().map_or(0, |column| column.values.len());
        table.rows = (0..rows)
            .map(|i| columns.iter().map(|column| column.cell(i)).collect())
            .collect();
        table
    }

    /// Counts and given speeds as they are, measured numbers to four digits.
    fn cell(&self, i: usize) -> String {
        let value = self.values[i] * self.factor;
        let text = if value.fract() == 0.0 {
            format!("{value}")
        } else {
            rounded(value, 4)
        };
        text.replace('-', "\u{2212}")
    }
}
