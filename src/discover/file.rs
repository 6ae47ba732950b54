//! File of equations: `equations.toml`, written by `discover`, read by `predict`.

use super::infix::Infix;
use super::score::Score;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{Kind, key, keys, table};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Schema of the files that this version reads and writes.
pub const SCHEMA: i64 = 1;
/// Name of V/V_y in formulas.
pub const OVER_YIELD: &str = "V_Vy";

/// Text above the tables.
pub const HEADER: &str = "\
Equations of impacts of a sphere on a rigid plane, found by `impactlaw discover` in the results of a study.
A figure is its formula times the product of powers of its scale, SI units. Names in a formula: the groups below, c1, c2, ... the
constants in their order, and V_Vy, the speed over the speed at first yield (Johnson 1985, peak pressure 1.6 Y).
seen: errors on the runs the constants were fitted to; levels, materials: on runs of whole levels and whole materials left out,
constants fitted anew to the rest, the structure as found on all. Absolute errors without unit; intervals: 95 %, bootstrap.
chosen: least bits of structure, constants and misfit, levels left out.
";

/// A file of equations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EquationsFile {
    /// [`SCHEMA`].
    pub schema: i64,
    /// Where it comes from.
    pub provenance: ProvenanceTable,
    /// Groups.
    pub group: Vec<GroupTable>,
    /// Inputs that never changed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub undetermined: Vec<UndeterminedTable>,
    /// Equations.
    pub equation: Vec<EquationTable>,
}

keys! {
    EquationsFile {
        schema: key("format of the file", "1", "1"),
        provenance: table("where the equations come from"),
        group: table("products of powers without unit"),
        undetermined: table("inputs that were the same in every run and that units do not rule out").or("none"),
        equation: table("one equation"),
    }
}

/// `[provenance]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProvenanceTable {
    /// Name and version.
    pub program: String,
    /// Hash of the results.
    pub results_sha256: String,
    /// Number of cases.
    pub cases: usize,
    /// Number of distinct runs.
    pub runs: usize,
    /// Seed of the search.
    pub seed: u64,
}

keys! {
    ProvenanceTable {
        program: key("name and version", "", "'impactlaw 0.1.0'"),
        results_sha256: key("SHA-256 of the study's results", "hexadecimal digits", "'00ff'"),
        cases: key("cases the equations were found in", "", "445"),
        runs: key("distinct runs among them", "", "337"),
        seed: key("seed of the search", "", "1"),
    }
}

/// `[[group]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupTable {
    /// Name in formulas.
    pub name: String,
    /// As people write it.
    pub text: String,
    /// Columns.
    pub columns: Vec<String>,
    /// Their exponents.
    pub exponents: Vec<i64>,
    /// Smallest value in the data.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

keys! {
    GroupTable {
        name: key("name in formulas", "", "'E_Y'"),
        text: key("as people write it", "", "'E/Y'"),
        columns: key("columns of the study's results", "", "['young_modulus_Pa', 'yield_strength_Pa']"),
        exponents: key("their exponents", "as many", "[1, -1]"),
        min: key("smallest value in the data", "> 0", "20.0"),
        max: key("largest value in the data", "> 0", "2560.0"),
    }
}

/// `[[undetermined]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UndeterminedTable {
    /// Column.
    pub column: String,
    /// Its value.
    pub value: f64,
}

keys! {
    UndeterminedTable {
        column: key("column of the study's results", "", "'poisson_ratio'"),
        value: key("its value in every run; SI units", "", "0.35"),
    }
}

/// `[[equation]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EquationTable {
    /// Figure.
    pub figure: String,
    /// Whether this is the one to use.
    pub chosen: bool,
    /// Formula.
    pub formula: String,
    /// What the formula is multiplied with: columns.
    pub scale_columns: Vec<String>,
    /// And their exponents.
    pub scale_exponents: Vec<i64>,
    /// Constants.
    pub constants: Vec<f64>,
    /// Lower ends of their intervals.
    pub low: Vec<f64>,
    /// Upper ends.
    pub high: Vec<f64>,
    /// Bits of structure and constants.
    pub bits: f64,
    /// Bits of the misfit.
    pub misfit_bits: f64,
    /// Errors on what was fitted.
    pub seen: Score,
    /// With levels left out.
    pub levels: Score,
    /// With materials left out.
    pub materials: Score,
}

keys! {
    EquationTable {
        figure: key("column of the study's results", "", "'restitution'"),
        chosen: key("whether `predict` uses it", "", "true"),
        formula: key("+ - * / ^ exp log sqrt tanh of groups, V_Vy and constants c1, c2, ...", "", "'c1 * rho_V2_Y'"),
        scale_columns: key("what the formula is multiplied with", "", "[]"),
        scale_exponents: key("exponents of these columns", "as many", "[]"),
        constants: key("c1, c2, ...", "", "[0.497]"),
        low: key("lower ends of their 95 % intervals", "as many", "[0.496]"),
        high: key("upper ends of their 95 % intervals", "as many", "[0.498]"),
        bits: key("bits of structure and constants", "", "20.0"),
        misfit_bits: key("bits of the misfit by the error of the data", "", "10.0"),
        seen: table("errors on the runs that were fitted"),
        levels: table("errors on levels left out"),
        materials: table("errors on materials left out"),
    }
}

keys! {
    Score {
        mae: key("mean absolute error, without unit", "", "0.01"),
        r2: key("1 - sum of squares of the errors over that of the figure about its mean", "", "0.99"),
        median_rel: key("median of the relative error", "", "0.02"),
        p90_rel: key("90 % of the relative errors are below", "", "0.06"),
    }
}

/// What exponents must be.
const SMALL: &str = "must lie in [-64, 64]";

fn small(exponent: &i64) -> bool {
    exponent.abs() <= 64
}

impl EquationsFile {
    /// Keys of the file.
    #[must_use]
    pub fn keys() -> Kind {
        use crate::document::keys::Value;
        Self::kind()
    }

    /// Reads and checks a file.
    ///
    /// # Errors
    /// As [`EquationsFile::parse`], and when it cannot be read.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&Document::read(path)?)
    }

    /// Checks the text of a file.
    ///
    /// # Errors
    /// [`crate::Error::Syntax`] for unknown or missing keys, [`crate::Error::Value`] for another schema, lists of different
    /// lengths, and formulas that cannot be read or hold unknown names.
    pub fn parse(document: &Document) -> Result<Self> {
        let file: EquationsFile = document.parse()?;
        if file.schema != SCHEMA {
            return Err(document.reject(
                "schema",
                format!("must be {SCHEMA}, the schema of this version"),
            ));
        }
        for (i, group) in file.group.iter().enumerate() {
            if group.columns.len() != group.exponents.len() {
                return Err(document.reject(
                    &format!("group[{i}].exponents"),
                    "must be as many as columns",
                ));
            }
            if !group.exponents.iter().all(small) {
                return Err(document.reject(&format!("group[{i}].exponents"), SMALL));
            }
            if !(group.min > 0.0 && group.max >= group.min && group.max.is_finite()) {
                return Err(document.reject(
                    &format!("group[{i}].max"),
                    "must be finite, positive and not below min",
                ));
            }
        }
        for (i, equation) in file.equation.iter().enumerate() {
            let key = |name: &str| format!("equation[{i}].{name}");
            if equation.scale_columns.len() != equation.scale_exponents.len() {
                return Err(
                    document.reject(&key("scale_exponents"), "must be as many as scale_columns")
                );
            }
            if !equation.scale_exponents.iter().all(small) {
                return Err(document.reject(&key("scale_exponents"), SMALL));
            }
            if !equation.constants.iter().all(|c| c.is_finite()) {
                return Err(document.reject(&key("constants"), "must be finite"));
            }
            let formula = Infix::parse(&equation.formula).map_err(|why| {
                document.reject(&key("formula"), format!("cannot be read: {why}"))
            })?;
            for name in formula.names() {
                if !file.knows(equation, name) {
                    return Err(document.reject(
                        &key("formula"),
                        format!(
                            "must hold groups, {OVER_YIELD} and c1 to c{} only; `{name}` is none",
                            equation.constants.len()
                        ),
                    ));
                }
            }
        }
        Ok(file)
    }

    fn knows(&self, equation: &EquationTable, name: &str) -> bool {
        let constant = equation.constant(name).is_some();
        constant || name == OVER_YIELD || self.group.iter().any(|group| group.name == name)
    }
}

impl EquationTable {
    /// Value of the constant with this name.
    #[must_use]
    pub fn constant(&self, name: &str) -> Option<f64> {
        let number: usize = name.strip_prefix('c')?.parse().ok()?;
        self.constants.get(number.checked_sub(1)?).copied()
    }
}
