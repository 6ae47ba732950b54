//! Tables of `study report`.

use crate::contact::{LawVisitor, NormalLaw};
use crate::curve::Summary;
use crate::discover::ranking::ranking;
use crate::material::{Flow, Material};
use crate::report::table::Table;
use crate::theory::Theory;
use crate::thesis::data::LARGEST;
use crate::thesis::equations::beyond;
use crate::thesis::tables::{FORCES, FORCES_OF, METAL_RADIUS, METALS, SIZES};
use crate::thesis::{Data, Equation, Refit, Row, Score};
use crate::unit::significant;
use serde::Serialize;

/// An equation with its scores.
pub struct Scored {
    /// It.
    pub equation: &'static Equation,
    /// With its printed constants, inside and outside the range of the thesis.
    pub printed: [Score; 2],
    /// Fitted inside.
    pub fitted: Refit,
    /// That outside.
    pub beyond: Score,
}

/// A row of `equations.csv`.
#[derive(Debug, Serialize)]
pub struct EquationRow {
    equation: &'static str,
    constants: &'static str,
    range: &'static str,
    cases: usize,
    values: String,
    intervals: String,
    mae: f64,
    mse: f64,
    r2: f64,
    median_relative_error: f64,
    p90_relative_error: f64,
}

impl Scored {
    /// Its rows of `equations.csv`.
    pub fn rows(&self) -> Vec<EquationRow> {
        let numbers = |all: &[f64]| {
            let texts = all.iter().map(|x| significant(*x, 6));
            texts.collect::<Vec<_>>().join(" ")
        };
        let ends = self.fitted.intervals.as_ref().map(|all| {
            let texts = all.iter().map(|[low, high]| {
                format!("{} to {}", significant(*low, 6), significant(*high, 6))
            });
            texts.collect::<Vec<_>>().join("; ")
        });
        let row = |constants: &'static str, range: &'static str, score: &Score| EquationRow {
            equation: self.equation.number,
            constants,
            range,
            cases: score.rows,
            values: match constants {
                "printed" => numbers(self.equation.constants),
                _ => numbers(&self.fitted.constants),
            },
            intervals: match constants {
                "printed" => String::new(),
                _ => ends.clone().unwrap_or_default(),
            },
            mae: score.mae,
            mse: score.mse,
            r2: score.r2,
            median_relative_error: score.median,
            p90_relative_error: score.tenth,
        };
        let mut all = vec![
            row("printed", "inside", &self.printed[0]),
            row("fitted", "inside", &self.fitted.score),
        ];
        if self.beyond.rows > 1 {
            all.push(row("printed", "outside", &self.printed[1]));
            all.push(row("fitted", "outside", &self.beyond));
        }
        all
    }
}

/// A number of a table.
fn text(x: f64) -> String {
    match x.is_finite() {
        true => significant(x, 3),
        false => "–".to_owned(),
    }
}

/// R squared, with digits where it is near 1.
fn digits(r2: f64) -> String {
    match r2.is_finite() {
        true => format!("{r2:.4}"),
        false => "–".to_owned(),
    }
}

/// How many cases there are, and what became of them.
pub fn facts(data: &Data) -> Vec<(String, String)> {
    let count = |wanted: &dyn Fn(&Row) -> bool| data.rows.iter().filter(|row| wanted(row)).count();
    let mut facts = vec![
        ("cases".to_owned(), data.rows.len().to_string()),
        ("ended well".to_owned(), count(&Row::ok).to_string()),
        (
            "elastic (V below V_y of 4-3)".to_owned(),
            count(&|row| !row.plastic()).to_string(),
        ),
        (
            "where the thesis has results".to_owned(),
            count(&Row::inside).to_string(),
        ),
        (
            format!("ρV²/Y above {LARGEST}"),
            count(&|row| row.severity() > LARGEST).to_string(),
        ),
    ];
    if data.others > 0 {
        let name = "hardening, rate or heat, oblique or with friction: not looked at";
        facts.push((name.to_owned(), data.others.to_string()));
    }
    facts
}

/// Success maps, a speed each.
pub fn success(data: &Data) -> Vec<Table> {
    let densities = data.distinct(|row| row.density);
    let moduli = data.distinct(|row| row.young_modulus);
    let ratios = data.distinct(Row::young_over_yield);
    let speeds = data.distinct(|row| row.velocity);
    // a hypercube has no two cases alike: a map of it would be empty but for one cell a row
    if densities.len() * moduli.len() * ratios.len() * speeds.len() > 4 * data.rows.len() {
        return Vec::new();
    }
    let table = |speed: &f64| {
        let pairs = densities
            .iter()
            .flat_map(|d| moduli.iter().map(move |e| (*d, *e)));
        let mut head = vec!["E/Y".to_owned()];
        head.extend(
            pairs
                .clone()
                .map(|(d, e)| format!("{}, {}", significant(d, 4), significant(e / 1e9, 4))),
        );
        let row = |ratio: &f64| {
            let cells = pairs
                .clone()
                .map(|(d, e)| cell(data.at(d, e, *ratio, *speed)));
            [vec![significant(*ratio, 4)], cells.collect()].concat()
        };
        Table {
            caption: format!(
                "{} m/s; columns: ρ in kg/m³, E in GPa",
                significant(*speed, 4)
            ),
            head,
            rows: ratios.iter().map(row).collect(),
        }
    };
    speeds.iter().map(table).collect()
}

/// What became of a case.
fn cell(row: Option<&Row>) -> String {
    match row {
        None => "–".to_owned(),
        Some(row) if !row.ok() => row.status.split(':').next().unwrap_or_default().to_owned(),
        Some(row) if !row.plastic() => "elastic".to_owned(),
        Some(row) if row.severity() > LARGEST => format!("✓ {}", significant(row.severity(), 2)),
        Some(_) => "✓".to_owned(),
    }
}

/// Constants, and errors inside and outside the range.
pub fn equations(all: &[Scored]) -> [Table; 3] {
    let mut constants = Table::new("Constants", &["", "equation", "printed", "fitted", "95 %"]);
    let head = [
        "",
        "constants",
        "cases",
        "MAE",
        "MSE",
        "R²",
        "median %",
        "90 % below %",
    ];
    let mut inside = Table::new("Errors inside the range of the thesis", &head);
    let mut outside = Table::new(
        "Errors outside it (ρV²/Y above 3.2), with the constants of the inside",
        &head,
    );
    let row = |number: &str, constants: &str, score: &Score| {
        vec![
            number.to_owned(),
            constants.to_owned(),
            score.rows.to_string(),
            text(score.mae),
            text(score.mse),
            digits(score.r2),
            text(100.0 * score.median),
            text(100.0 * score.tenth),
        ]
    };
    for one in all {
        let list = |values: &[f64]| {
            values
                .iter()
                .map(|x| significant(*x, 4))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let ends = one.fitted.intervals.as_ref().map_or_else(
            || "fewer than four levels".to_owned(),
            |all| {
                let ends = all.iter().map(|[low, high]| {
                    format!("{} to {}", significant(*low, 4), significant(*high, 4))
                });
                ends.collect::<Vec<_>>().join(", ")
            },
        );
        let number = one.equation.number;
        let unit = match one.equation.unit {
            "" => String::new(),
            unit => format!(" (errors in {unit})"),
        };
        constants.rows.push(vec![
            number.to_owned(),
            format!("{}{unit}", one.equation.text),
            list(one.equation.constants),
            list(&one.fitted.constants),
            ends,
        ]);
        inside.rows.push(row(number, "printed", &one.printed[0]));
        inside.rows.push(row(number, "fitted", &one.fitted.score));
        if one.beyond.rows > 1 {
            outside.rows.push(row(number, "printed", &one.printed[1]));
            outside.rows.push(row(number, "fitted", &one.beyond));
        }
    }
    [constants, inside, outside]
}

/// Force of a law at a displacement.
struct ForceAt<'a>(&'a Row);

impl LawVisitor for ForceAt<'_> {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let row = self.0;
        law.force(row.displacement / row.radius, &mut L::History::default()) * row.radius.powi(2)
    }
}

/// Table 4-4 beside the study.
pub fn forces(data: &Data) -> Table {
    let head = [
        "V, m/s",
        "F*, N: thesis MPM",
        "this study",
        "thesis KE",
        "KE at δ* here",
        "thesis JG",
        "JG at δ* here",
        "δ* here, µm",
    ];
    let mut table = Table::new("Table 4-4: ρ 8000 kg/m³, E 100 GPa, E/Y 80", &head);
    let (density, young, ratio) = FORCES_OF;
    for (velocity, ke, jg, mpm) in FORCES {
        let Some(row) = data
            .at(density, young, ratio, velocity)
            .filter(|row| row.ok())
        else {
            continue;
        };
        let of = |name: &str| {
            let theory = name.parse::<Theory>();
            theory
                .and_then(|theory| theory.visit(&row.material(), ForceAt(row)))
                .unwrap_or(f64::NAN)
        };
        let number = |x: f64| format!("{x:.1}");
        table.rows.push(vec![
            significant(velocity, 4),
            number(mpm),
            number(row.force),
            number(ke),
            number(of("kogut-etsion")),
            number(jg),
            number(of("jackson-green")),
            format!("{:.2}", 1e6 * row.displacement),
        ]);
    }
    table
}

/// Table 4-5 beside the study.
pub fn sizes(data: &Data) -> Table {
    let head = [
        "case",
        "V, m/s",
        "ρ, kg/m³",
        "E, GPa",
        "Y, MPa",
        "ρV²/Y",
        "E/Y",
        "F*/(πR²(YρV²)^½)",
        "4-13",
    ];
    let mut table = Table::new(
        "Table 4-5: cases that are repeated in other sizes; F* goes with R² exactly, equal groups are the same run",
        &head,
    );
    for (k, (velocity, density, young, strength)) in SIZES.into_iter().enumerate() {
        let Some(row) = data
            .at(density, young, young / strength, velocity)
            .filter(|row| row.ok())
        else {
            continue;
        };
        let numbers = [
            velocity,
            density,
            young / 1e9,
            strength / 1e6,
            row.severity(),
            row.young_over_yield(),
            row.force / row.force_scale(),
            2.0,
        ];
        table
            .rows
            .push([vec![(k + 1).to_string()], numbers.map(text).to_vec()].concat());
    }
    table
}

/// Trees and seeds of a ranking.
const RANKING: (usize, u64) = (60, 3);

/// Rankings of the inputs for the plastic strain, or with the groups for the compression ratio.
pub fn ranked(data: &Data, compression: bool) -> Table {
    type Column = (&'static str, fn(&Row) -> f64);
    let raw: [Column; 5] = [
        ("V", |row| row.velocity),
        ("ρ", |row| row.density),
        ("E", |row| row.young_modulus),
        ("Y", |row| row.strength),
        ("V_y", Row::first_yield),
    ];
    let groups: [Column; 3] = [
        ("E/Y", Row::young_over_yield),
        ("ρV²/Y", Row::severity),
        ("ρ(V² − V_y²)/Y", beyond),
    ];
    let (of, columns): (fn(&Row) -> f64, Vec<Column>) = match compression {
        false => (|row| row.strain, raw.to_vec()),
        true => (|row| row.compression, [&raw[..], &groups].concat()),
    };
    let rows = data.usable(Row::inside);
    let values: Vec<Vec<f64>> = columns
        .iter()
        .map(|(_, column)| rows.iter().map(|row| column(row)).collect())
        .collect();
    let targets: Vec<f64> = rows.iter().map(|row| of(row)).collect();
    let caption = match compression {
        false => "5-2: plastic strain (the thesis: Y > V > ρ > V_y > E)",
        true => {
            "5-4: compression ratio (the thesis: both groups with ρV²/Y > V_y > V > Y > E > E/Y > ρ)"
        }
    };
    let mut table = Table::new(
        caption,
        &[
            "input",
            "place",
            "over the seeds",
            "Spearman",
            "rise of the error when shuffled",
        ],
    );
    for one in ranking(&values, &targets, RANKING.0, RANKING.1) {
        table.rows.push(vec![
            columns[one.column].0.to_owned(),
            text(one.place),
            format!("{} to {}", one.places[0], one.places[1]),
            format!("{:.2}", one.spearman),
            text(one.permutation),
        ]);
    }
    table
}

/// Material of a metal of table 5-3.
pub fn metal(k: usize) -> Material {
    let metal = METALS[k];
    Material {
        density: metal.density,
        young_modulus: metal.young_modulus,
        poisson_ratio: metal.poisson_ratio,
        flow: Some(Flow::perfectly_plastic(metal.strength)),
    }
}

/// Lead and nickel.
pub fn metals<'a>(
    runs: &[Summary],
    scored: impl Fn(&str) -> Option<(&'static Equation, &'a [f64])>,
) -> Table {
    let head = [
        "",
        "figure",
        "this program",
        "thesis MPM",
        "thesis equation",
        "same, fitted here",
    ];
    let mut table = Table::new("", &head);
    for (metal, run) in METALS.iter().zip(runs) {
        let row = Row {
            density: metal.density,
            young_modulus: metal.young_modulus,
            strength: metal.strength,
            poisson_ratio: metal.poisson_ratio,
            radius: METAL_RADIUS,
            velocity: metal.velocity,
            restitution: run.restitution,
            force: run.max_force_n,
            displacement: run.max_displacement_m,
            residual: run.residual_displacement_m,
            compression: run.compression_ratio,
            strain: run.equivalent_plastic_strain,
            work: run.plastic_work_ratio,
            tolerance: f64::NAN,
            status: "ok".to_owned(),
        };
        for (number, name, ours, theirs) in [
            ("5-4", "ε_p", row.strain, metal.strain[0]),
            ("5-5", "1 − H_d/D", row.compression, metal.compression[0]),
            ("4-9", "e", row.restitution, f64::NAN),
        ] {
            let Some((equation, fitted)) = scored(number) else {
                continue;
            };
            table.rows.push(vec![
                metal.name.to_owned(),
                format!("{name} ({number})"),
                text(ours),
                text(theirs),
                text((equation.form)(&row, equation.constants)),
                text((equation.form)(&row, fitted)),
            ]);
        }
    }
    table
}
