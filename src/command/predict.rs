//! Predict command: figures of the impacts of a case by equations that `discover` found.

use super::{Command, Context, Verdict, print};
use crate::case::Case;
use crate::discover::file::{EquationTable, EquationsFile, OVER_YIELD};
use crate::discover::infix::Infix;
use crate::material::YIELD_PRESSURE_RATIO;
use crate::{Error, Result};
use clap::Args;
use std::path::PathBuf;

/// Predict the impacts of a case by equations: one row a speed, one column an equation.
#[derive(Debug, Args)]
pub struct PredictArgs {
    /// Case file.
    pub case: PathBuf,
    /// Equations, as `discover` writes them.
    #[arg(long)]
    pub equation: PathBuf,
    /// Figures to predict (default: all of the file).
    #[arg(long, num_args = 1..)]
    pub target: Vec<String>,
    /// Speeds, overriding those of the case, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Also outside the range of the data.
    #[arg(long)]
    pub extrapolate: bool,
}

/// How far beyond the range of the data a group still counts as within: rounding.
const ROUNDING: f64 = 1e-6;

impl Command for PredictArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw predict cases/thesis-4-4.toml --equation out/study-480/discover/equations.toml",
        r#"impactlaw predict cases/thesis-4-4.toml --equation out/study-480/discover/equations.toml --velocity "20 m/s" --target restitution"#,
    ];

    /// Print the figures as CSV.
    ///
    /// # Errors
    /// Those of reading case and equations; [`Error::Refused`] for what the equations do not know: groups outside their range,
    /// inputs that never changed in their data and are others here, impacts that do not yield.
    fn run(&self, _context: &Context) -> Result<Verdict> {
        let case = Case::read(&self.case)?.with_velocities(&self.velocity)?;
        case.of_a_sphere("an equation")?;
        case.of_own_scheme("an equation")?;
        let file = EquationsFile::read(&self.equation)?;
        print(&self.table(&case, &file)?)?;
        Ok(Verdict::Met)
    }
}

impl PredictArgs {
    fn table(&self, case: &Case, file: &EquationsFile) -> Result<String> {
        let equations = self.equations(file)?;
        for one in &file.undetermined {
            let value = input(case, &one.column, f64::NAN)?;
            if (value - one.value).abs() > ROUNDING * one.value.abs() && !self.extrapolate {
                return Err(self.refuse(
                    &one.column,
                    value.to_string(),
                    format!(
                        "was {} in every run, so what it does is undetermined",
                        one.value
                    ),
                ));
            }
        }
        let mut text = String::from("velocity_m_s");
        for (equation, _) in &equations {
            text += ",";
            text += &equation.figure;
        }
        text += "\n";
        for &velocity in &case.velocities {
            let mut row = vec![velocity];
            let names = self.names(case, file, velocity)?;
            for (equation, formula) in &equations {
                let known = |name: &str| {
                    let group = names.iter().find(|(known, _)| known == name);
                    equation
                        .constant(name)
                        .or_else(|| group.map(|(_, value)| *value))
                };
                let mut value = formula.value(&known);
                for (column, exponent) in
                    equation.scale_columns.iter().zip(&equation.scale_exponents)
                {
                    value *= input(case, column, velocity)?.powi(*exponent as i32);
                }
                if !value.is_finite() {
                    return Err(self.refuse(
                        &equation.figure,
                        format!("no number at {velocity} m/s"),
                        "the formula has no value there".to_owned(),
                    ));
                }
                row.push(value);
            }
            text += &crate::files::row(&row);
        }
        Ok(text)
    }

    /// Equations to use, with their formulas.
    fn equations<'a>(&self, file: &'a EquationsFile) -> Result<Vec<(&'a EquationTable, Infix)>> {
        let chosen = || file.equation.iter().filter(|equation| equation.chosen);
        for wanted in &self.target {
            if !chosen().any(|equation| equation.figure == *wanted) {
                return Err(Error::not_one_of(
                    "--target",
                    wanted,
                    chosen().map(|equation| &equation.figure[..]),
                ));
            }
        }
        let found: Vec<(&EquationTable, Infix)> = chosen()
            .filter(|equation| self.target.is_empty() || self.target.contains(&equation.figure))
            .filter_map(|equation| Some((equation, Infix::parse(&equation.formula).ok()?)))
            .collect();
        match found.is_empty() {
            true => Err(self.refuse(
                "equations",
                "none that is chosen".to_owned(),
                "must hold one with `chosen = true`".to_owned(),
            )),
            false => Ok(found),
        }
    }

    /// Groups and V/V_y at a speed, within the range of the data.
    fn names(
        &self,
        case: &Case,
        file: &EquationsFile,
        velocity: f64,
    ) -> Result<Vec<(String, f64)>> {
        let mut names = Vec::new();
        for group in &file.group {
            let mut value = 1.0;
            for (column, exponent) in group.columns.iter().zip(&group.exponents) {
                value *= input(case, column, velocity)?.powi(*exponent as i32);
            }
            let within =
                value >= group.min * (1.0 - ROUNDING) && value <= group.max * (1.0 + ROUNDING);
            if !within && !self.extrapolate {
                return Err(self.refuse(
                    &group.text,
                    format!("{} at {velocity} m/s", crate::unit::significant(value, 4)),
                    format!(
                        "must lie in [{}, {}], the range of the data; --extrapolate predicts all the same",
                        crate::unit::significant(group.min, 4),
                        crate::unit::significant(group.max, 4)
                    ),
                ));
            }
            names.push((group.name.clone(), value));
        }
        if let Some(point) = case.material.yield_point(case.radius, YIELD_PRESSURE_RATIO) {
            let over = velocity / point.velocity;
            if over <= 1.0 {
                return Err(self.refuse(
                    "V/V_y",
                    format!("{} at {velocity} m/s", crate::unit::significant(over, 4)),
                    "must be above 1: this impact is elastic".to_owned(),
                ));
            }
            names.push((OVER_YIELD.to_owned(), over));
        }
        Ok(names)
    }

    fn refuse(&self, what: &str, found: String, allowed: String) -> Error {
        Error::Refused {
            what: format!("{}: {what}", self.equation.display()),
            found,
            allowed,
        }
    }
}

/// Value of a column of a study for a case at a speed, SI units.
fn input(case: &Case, column: &str, velocity: f64) -> Result<f64> {
    use crate::material::flow::{FlowConstants, InSi, Spelling};
    let material = &case.material;
    let flow = FlowConstants::<InSi>::of(material.flow.as_ref());
    let constant = crate::material::Flow::all_constants()
        .iter()
        .find(|constant| InSi::key(constant) == column)
        .and_then(|constant| flow.value(constant));
    match column {
        "density_kg_m3" => Ok(material.density),
        "young_modulus_Pa" => Ok(material.young_modulus),
        "poisson_ratio" => Ok(material.poisson_ratio),
        "radius_m" => Ok(case.radius),
        "velocity_m_s" => Ok(velocity),
        "angle_deg" => Ok(case.angle.to_degrees()),
        "friction" => Ok(case.friction),
        _ => constant.ok_or_else(|| Error::Refused {
            what: format!("column `{column}` of the equations"),
            found: "nothing of this name in the case".to_owned(),
            allowed: "the case must have what the equations were found in".to_owned(),
        }),
    }
}
