//! The cases of a study as the thesis looks at them: every row with its status, and its numbers without dimension.

use crate::Result;
use crate::material::flow::{InSi, Spelling, YIELD_STRENGTH};
use crate::material::{Flow, Material};
use crate::table::{self, Table};
use std::f64::consts::PI;
use std::path::Path;

/// Largest $\rho V^2/Y$ of the thesis: that of its largest plastic strain, 1.53, by its equation 4-4.
pub const LARGEST: f64 = 3.2;
/// Peak pressure at first yield over Y (thesis 4-10, 4-11).
const PRESSURE: f64 = 1.6;

/// A case with its figures, SI units; NaN where a run did not end well.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// rho.
    pub density: f64,
    /// E.
    pub young_modulus: f64,
    /// Y.
    pub strength: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// R.
    pub radius: f64,
    /// V.
    pub velocity: f64,
    /// e.
    pub restitution: f64,
    /// F*.
    pub force: f64,
    /// delta*.
    pub displacement: f64,
    /// delta_res; NaN where the table has none.
    pub residual: f64,
    /// 1 - H_d/D.
    pub compression: f64,
    /// eps_p.
    pub strain: f64,
    /// W_p/W_i.
    pub work: f64,
    /// Tolerance it was planned for; NaN where the table does not say it.
    pub tolerance: f64,
    /// How the run ended.
    pub status: String,
}

impl Row {
    /// $q = \rho V^2/Y$.
    #[must_use]
    pub fn severity(&self) -> f64 {
        self.density * self.velocity * self.velocity / self.strength
    }

    /// Its material.
    #[must_use]
    pub fn material(&self) -> Material {
        Material {
            density: self.density,
            young_modulus: self.young_modulus,
            poisson_ratio: self.poisson_ratio,
            flow: Some(Flow::perfectly_plastic(self.strength)),
        }
    }

    /// E/Y.
    #[must_use]
    pub fn young_over_yield(&self) -> f64 {
        self.young_modulus / self.strength
    }

    /// E*, Pa.
    #[must_use]
    pub fn contact_modulus(&self) -> f64 {
        self.young_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }

    /// E*/Y.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.contact_modulus() / self.strength
    }

    /// V_y by (4-3), m/s.
    #[must_use]
    pub fn first_yield(&self) -> f64 {
        (26.0 * self.strength / self.density).sqrt() / self.stiffness().powi(2)
    }

    /// V/V_y.
    #[must_use]
    pub fn over_yield(&self) -> f64 {
        self.velocity / self.first_yield()
    }

    /// F_y by (4-10), N.
    #[must_use]
    pub fn yield_force(&self) -> f64 {
        let pressure = PRESSURE * self.strength;
        PI.powi(3) * pressure.powi(3) * self.radius.powi(2) / (6.0 * self.contact_modulus().powi(2))
    }

    /// delta_y by (4-11), m.
    #[must_use]
    pub fn yield_displacement(&self) -> f64 {
        let pressure = PRESSURE * self.strength;
        (PI * pressure / (2.0 * self.contact_modulus())).powi(2) * self.radius
    }

    /// $\pi R^2 (Y \rho V^2)^{1/2}$, N.
    #[must_use]
    pub fn force_scale(&self) -> f64 {
        PI * self.radius.powi(2) * (self.strength * self.density).sqrt() * self.velocity
    }

    /// What of it no impact has, and what is allowed.
    fn flaw(&self) -> Option<[&'static str; 2]> {
        let inputs = [
            self.density,
            self.young_modulus,
            self.strength,
            self.radius,
            self.velocity,
        ];
        let positive = |x: &f64| *x > 0.0 && x.is_finite();
        if !inputs.iter().all(positive) || !(0.0..0.5).contains(&self.poisson_ratio) {
            let allowed =
                "density, moduli, radius and speed must be above 0, Poisson's ratio in [0, 0.5)";
            return Some(["an input that is no positive number", allowed]);
        }
        let figures = [
            self.restitution,
            self.force,
            self.displacement,
            self.compression,
            self.strain,
            self.work,
        ];
        let missing = self.ok() && !figures.iter().all(|x| x.is_finite());
        let found = "a figure without number in a row with status ok";
        missing.then_some([found, "must be a number"])
    }

    /// Whether its figures can be used.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.status == "ok"
    }

    /// Whether it yields.
    #[must_use]
    pub fn plastic(&self) -> bool {
        self.over_yield() > 1.0
    }

    /// Whether it lies where the thesis has results: it yields, and q is at most 3.2.
    #[must_use]
    pub fn inside(&self) -> bool {
        self.plastic() && self.severity() <= LARGEST
    }
}

/// Cases of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Data {
    /// Normal impacts of perfectly plastic bodies on a frictionless wall.
    pub rows: Vec<Row>,
    /// Others, of which the thesis says nothing.
    pub others: usize,
}

/// Inputs that must be there.
const INPUTS: [&str; 6] = [
    "density_kg_m3",
    "young_modulus_Pa",
    "yield_strength_Pa",
    "poisson_ratio",
    "radius_m",
    "velocity_m_s",
];
/// Figures that must be there.
const FIGURES: [&str; 6] = [
    "restitution",
    "max_force_N",
    "max_displacement_m",
    "compression_ratio",
    "equivalent_plastic_strain",
    "plastic_work_ratio",
];

/// Inputs of an oblique impact.
const OBLIQUE: [&str; 2] = ["angle_deg", "friction"];

/// Whether a column is a constant of a flow stress that is not perfectly plastic.
fn tells_flow(column: &str) -> bool {
    let constants = Flow::all_constants();
    let mut others = constants.iter().filter(|c| **c != YIELD_STRENGTH);
    others.any(|constant| InSi::key(constant) == column)
}

/// A table of which every row becomes a [`Row`].
struct Rows<'a> {
    table: Table<'a>,
    /// Columns that are 0 or absent in the cases of the thesis, by their places.
    others: Vec<usize>,
}

impl<'a> Rows<'a> {
    fn of(table: Table<'a>) -> Result<Self> {
        for name in INPUTS.iter().chain(&FIGURES) {
            if table.place(name).is_none() {
                let allowed = "must be there: a report needs the results.csv of a study";
                return Err(table.refuse(name, "no such column", allowed));
            }
        }
        let is_other = |name: &str| OBLIQUE.contains(&name) || tells_flow(name);
        let columns = table.columns.iter().enumerate();
        let others = columns.filter_map(|(at, column)| is_other(&column.name).then_some(at));
        Ok(Rows {
            others: others.collect(),
            table,
        })
    }

    /// A row; none of a case of which the thesis says nothing.
    fn row(&self, of: &table::Row) -> Result<Option<Row>> {
        let place = |name: &str| self.table.place(name);
        let number = |name: &str| {
            let value = place(name).and_then(|at| self.table.number(of, at));
            value.unwrap_or(f64::NAN)
        };
        let row = Row {
            density: number("density_kg_m3"),
            young_modulus: number("young_modulus_Pa"),
            strength: number("yield_strength_Pa"),
            poisson_ratio: number("poisson_ratio"),
            radius: number("radius_m"),
            velocity: number("velocity_m_s"),
            restitution: number("restitution"),
            force: number("max_force_N"),
            displacement: number("max_displacement_m"),
            residual: number("residual_displacement_m"),
            compression: number("compression_ratio"),
            strain: number("equivalent_plastic_strain"),
            work: number("plastic_work_ratio"),
            tolerance: number("tolerance"),
            status: place("status").map_or("ok", |at| of.cell(at)).to_owned(),
        };
        let refuse = |found: &str, allowed: &str| {
            let key = format!("line {}", of.line);
            Err(self.table.refuse(&key, found, allowed))
        };
        let is_word = |name: &&&str| {
            let cell = place(name).map_or("", |at| of.cell(at));
            !cell.is_empty() && cell.parse::<f64>().is_err()
        };
        if let Some(name) = INPUTS.iter().find(is_word) {
            return refuse(&format!("no number for `{name}`"), "must be one, or empty");
        }
        let is_set = |at: &usize| {
            let value = of.cell(*at).parse::<f64>();
            value.is_ok_and(|value| value.is_finite() && value != 0.0)
        };
        if self.others.iter().any(is_set) || row.strength.is_nan() {
            return Ok(None);
        }
        match row.flaw() {
            Some([found, allowed]) => refuse(found, allowed),
            None => Ok(Some(row)),
        }
    }
}

impl Data {
    /// Reads the text of `results.csv`.
    ///
    /// # Errors
    /// [`crate::Error::Value`] for what is no such table, or has no case the thesis speaks of.
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        let rows = Rows::of(Table::parse(
            text,
            path,
            "must be the results.csv of a study",
        )?)?;
        let mut data = Data {
            rows: Vec::new(),
            others: 0,
        };
        for row in &rows.table.rows {
            match rows.row(row)? {
                Some(row) => data.rows.push(row),
                None => data.others += 1,
            }
        }
        let usable = data.usable(Row::inside).len();
        if usable < FEWEST {
            return Err(rows.table.refuse(
                "rows",
                format!("{usable} that end well, yield and have rho V^2/Y up to {LARGEST}"),
                "must be at least 12 of perfectly plastic bodies: the equations of the thesis are of these",
            ));
        }
        Ok(data)
    }

    /// Rows that ended well and are `wanted`.
    #[must_use]
    pub fn usable(&self, wanted: impl Fn(&Row) -> bool) -> Vec<&Row> {
        self.rows
            .iter()
            .filter(|row| row.ok() && wanted(row))
            .collect()
    }

    /// Distinct values of a column, ascending; equal to nine digits.
    #[must_use]
    pub fn distinct(&self, of: impl Fn(&Row) -> f64) -> Vec<f64> {
        distinct(self.rows.iter().map(of).collect())
    }

    /// The row with these numbers.
    #[must_use]
    pub fn at(&self, density: f64, young: f64, ratio: f64, velocity: f64) -> Option<&Row> {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
        self.rows.iter().find(|row| {
            near(row.density, density)
                && near(row.young_modulus, young)
                && near(row.young_over_yield(), ratio)
                && near(row.velocity, velocity)
        })
    }
}

/// Fewest rows of a report.
const FEWEST: usize = 12;

/// Distinct values, ascending; equal to nine digits.
#[must_use]
pub fn distinct(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_of_other_flow_stresses_and_oblique_ones_are_counted_and_left_out() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/study-480.csv");
        let text = std::fs::read_to_string(&path).unwrap();
        let all = Data::parse(&text, &path).unwrap();
        assert_eq!(all.others, 0);
        let flow = Flow::all_constants();
        let flow = flow.iter().filter(|constant| **constant != YIELD_STRENGTH);
        let keys: Vec<String> = flow.map(InSi::key).collect();
        assert!(keys.len() > 10);
        for key in keys.iter().map(String::as_str).chain(OBLIQUE) {
            // the first case has it, in the second it is 0, the others say nothing of it
            let more = |(i, line): (usize, &str)| match i {
                0 => line.to_owned(),
                1 => format!("{line},{key}"),
                2 => format!("{line},0.5"),
                3 => format!("{line},0"),
                _ => format!("{line},"),
            };
            let text: Vec<String> = text.lines().enumerate().map(more).collect();
            let data = Data::parse(&text.join("\n"), &path).unwrap();
            assert_eq!(data.others, 1, "{key}");
            assert_eq!(data.rows.len() + 1, all.rows.len(), "{key}");
        }
    }
}
