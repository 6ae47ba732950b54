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

fn always(_: &Row) -> bool {
    true
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
    Equation {
        number: "4-4",
        text: "ε_p = C1 ρV²/Y",
        unit: "",
        constants: &[0.474],
        value: |row| row.strain,
        form: |row, c| c[0] * row.severity(),
        valid: always,
    },
    Equation {
        number: "5-4",
        text: "ε_p = C1 ρ(V² − V_y²)/Y",
        unit: "",
        constants: &[0.475],
        value: |row| row.strain,
        form: |row, c| c[0] * beyond(row),
        valid: always,
    },
    Equation {
        number: "4-5",
        text: "1 − H_d/D = C1 (ρV²/Y)^C2",
        unit: "",
        constants: &[0.34, 0.66],
        value: |row| row.compression,
        form: |row, c| c[0] * row.severity().powf(c[1]),
        valid: always,
    },
    Equation {
        number: "5-5",
        text: "1 − H_d/D = C1 (ρ(V² − V_y²)/Y)^C2",
        unit: "",
        constants: &[0.33, 0.66],
        value: |row| row.compression,
        form: |row, c| c[0] * beyond(row).powf(c[1]),
        valid: always,
    },
    Equation {
        number: "4-6",
        text: "ε_p = C1 (1 − H_d/D)^C2",
        unit: "",
        constants: &[2.43, 1.5],
        value: |row| row.strain,
        form: |row, c| c[0] * row.compression.max(0.0).powf(c[1]),
        valid: always,
    },
    Equation {
        number: "4-8",
        text: "e = C1 ((V/V_y)/(E*/Y))^C2",
        unit: "",
        constants: &[0.62, -0.5],
        value: |row| row.restitution,
        form: |row, c| c[0] * wu(row).powf(c[1]),
        valid: |row| wu(row) / row.stiffness() >= 0.008,
    },
    Equation {
        number: "4-9",
        text: "e = C1 (E/Y)^C2 exp(−C3 (ρV²/Y)^C4)",
        unit: "",
        constants: &[2.85, -0.325, 2.0, 0.325],
        value: |row| row.restitution,
        form: |row, c| {
            c[0] * row.young_over_yield().powf(c[1]) * (-c[2] * row.severity().powf(c[3])).exp()
        },
        valid: always,
    },
    Equation {
        number: "4-13",
        text: "F* = C1 π R² (Y ρ V²)^½",
        unit: "N",
        constants: &[2.0],
        value: |row| row.force,
        form: |row, c| c[0] * row.force_scale(),
        valid: always,
    },
];

impl Equation {
    /// The equation of this number.
    #[must_use]
    pub fn numbered(number: &str) -> Option<&'static Equation> {
        EQUATIONS.iter().find(|equation| equation.number == number)
    }
}
