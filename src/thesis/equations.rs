//! Equations of chapters 4 and 5, their constants free.

use super::data::Row;

/// A published equation.
#[derive(Debug, Clone, Copy)]
pub struct Equation {
    /// Its number.
    pub number: &'static str,
    /// It, with C1, C2, ... for its constants.
    pub text: &'static str,
    /// Unit of what it gives.
    pub unit: &'static str,
    /// Constants as they are printed.
    pub constants: &'static [f64],
    /// What it is to give.
    pub value: fn(&Row) -> f64,
    /// What it gives.
    pub form: fn(&Row, &[f64]) -> f64,
    /// Whether it is said to hold, besides where the thesis has results.
    pub valid: fn(&Row) -> bool,
}

/// $\rho (V^2 - V_y^2)/Y$; 0 for what does not yield.
#[must_use]
pub fn beyond(row: &Row) -> f64 {
    (row.severity() * (1.0 - row.over_yield().powi(-2))).max(0.0)
}

/// $(V/V_y)/(E^\ast/Y)$.
#[must_use]
pub fn wu(row: &Row) -> f64 {
    row.over_yield() / row.stiffness()
}

/// All of them.
pub const EQUATIONS: [Equation; 8] = [
    Equation::of(
        "4-4",
        "ε_p = C1 ρV²/Y",
        &[0.474],
        |row| row.strain,
        |row, c| c[0] * row.severity(),
    ),
    Equation::of(
        "5-4",
        "ε_p = C1 ρ(V² − V_y²)/Y",
        &[0.475],
        |row| row.strain,
        |row, c| c[0] * beyond(row),
    ),
    Equation::of(
        "4-5",
        "1 − H_d/D = C1 (ρV²/Y)^C2",
        &[0.34, 0.66],
        |row| row.compression,
        |row, c| c[0] * row.severity().powf(c[1]),
    ),
    Equation::of(
        "5-5",
        "1 − H_d/D = C1 (ρ(V² − V_y²)/Y)^C2",
        &[0.33, 0.66],
        |row| row.compression,
        |row, c| c[0] * beyond(row).powf(c[1]),
    ),
    Equation::of(
        "4-6",
        "ε_p = C1 (1 − H_d/D)^C2",
        &[2.43, 1.5],
        |row| row.strain,
        |row, c| c[0] * row.compression.max(0.0).powf(c[1]),
    ),
    Equation::of(
        "4-8",
        "e = C1 ((V/V_y)/(E*/Y))^C2",
        &[0.62, -0.5],
        |row| row.restitution,
        |row, c| c[0] * wu(row).powf(c[1]),
    )
    .valid_where(|row| wu(row) / row.stiffness() >= 0.008),
    Equation::of(
        "4-9",
        "e = C1 (E/Y)^C2 exp(−C3 (ρV²/Y)^C4)",
        &[2.85, -0.325, 2.0, 0.325],
        |row| row.restitution,
        |row, c| {
            c[0] * row.young_over_yield().powf(c[1]) * (-c[2] * row.severity().powf(c[3])).exp()
        },
    ),
    Equation::of(
        "4-13",
        "F* = C1 π R² (Y ρ V²)^½",
        &[2.0],
        |row| row.force,
        |row, c| c[0] * row.force_scale(),
    )
    .in_unit("N"),
];

impl Equation {
    /// An equation that gives the pure number `value` by its `form`, and is said to hold everywhere.
    const fn of(
        number: &'static str,
        text: &'static str,
        constants: &'static [f64],
        value: fn(&Row) -> f64,
        form: fn(&Row, &[f64]) -> f64,
    ) -> Self {
        Equation {
            number,
            text,
            unit: "",
            constants,
            value,
            form,
            valid: |_| true,
        }
    }

    const fn in_unit(self, unit: &'static str) -> Self {
        Equation { unit, ..self }
    }

    const fn valid_where(self, valid: fn(&Row) -> bool) -> Self {
        Equation { valid, ..self }
    }

    /// The equation of this number.
    #[must_use]
    pub fn numbered(number: &str) -> Option<&'static Equation> {
        EQUATIONS.iter().find(|equation| equation.number == number)
    }
}
