//! The equations of the thesis this project starts from, as baselines (Saifoori, Leeds 2025, chapters 4 and 5).

use super::formula::{Formula, Ratio, Shape, Source};
use super::problem::{Inputs, VANISHING};

/// A published equation.
#[derive(Debug, Clone)]
pub struct Published {
    /// Its number.
    pub name: &'static str,
    /// It, with its constants free; their values are those it was published with.
    pub formula: Formula,
}

/// Johnson's V_y as the thesis rounds it: rho V_y^2/Y = 26 (Y over E*)^4.
const ROUNDED: f64 = 26.0;

/// Places of E/Y and rho V^2/Y among the groups, which the equations are written in.
fn places(inputs: &Inputs) -> Option<(usize, usize)> {
    let of = |wanted: &[(&str, i32)]| {
        inputs.groups.iter().position(|group| {
            group.exponents.len() == wanted.len()
                && wanted.iter().all(|(name, x)| group.of(name) == *x)
        })
    };
    Some((
        of(&[("young_modulus_Pa", 1), ("yield_strength_Pa", -1)])?,
        of(&[
            ("density_kg_m3", 1),
            ("velocity_m_s", 2),
            ("yield_strength_Pa", -1),
        ])?,
    ))
}

/// Equations for a figure; none where the groups of the study are others or E* is not known to be a multiple of E.
#[must_use]
pub fn equations(figure: &str, inputs: &Inputs, poisson_ratio: Option<f64>) -> Vec<Published> {
    let Some((modulus, severity)) = places(inputs) else {
        return Vec::new();
    };
    let groups = inputs.groups.len();
    let two = VANISHING.iter().position(|k| *k == 2.0);
    // coefficient, exponents of E/Y and rho V^2/Y; of 1 - (V_y/V)^2
    let leaf = |c: f64, x: f64, y: f64| {
        let mut numbers = vec![0.0; groups + 1];
        numbers[0] = c;
        numbers[1 + modulus] = x;
        numbers[1 + severity] = y;
        numbers
    };
    let fix =
        |formula: &mut Formula, at: usize, ratio: Ratio| formula.sources[at] = Source::Fixed(ratio);
    let zero = Ratio::whole(0);
    let with_fixed_others = |formula: &mut Formula, first: usize, free: &[usize]| {
        for j in 0..groups {
            if !free.contains(&j) {
                fix(formula, first + 1 + j, zero);
            }
        }
    };
    let power = |c: f64, exponent: f64, fitted: bool| {
        let mut formula = Formula::free(Shape::Leaf(None), leaf(c, 0.0, exponent));
        with_fixed_others(&mut formula, 0, &[severity]);
        if !fitted {
            let half = (2.0 * exponent).round() as i32;
            fix(
                &mut formula,
                1 + severity,
                if half == 2 {
                    Ratio::whole(1)
                } else {
                    Ratio {
                        over: half,
                        under: 2,
                    }
                },
            );
        }
        formula
    };
    let beyond = |c: f64, exponent: f64, fitted: bool| {
        let mut numbers = leaf(c, 0.0, exponent);
        numbers.push(exponent);
        let mut formula = Formula::free(Shape::Leaf(two), numbers);
        with_fixed_others(&mut formula, 0, &[severity]);
        match fitted {
            true => formula.sources[1 + groups] = Source::Tied(1 + severity, Ratio::whole(1)),
            false => {
                fix(&mut formula, 1 + severity, Ratio::whole(1));
                fix(&mut formula, 1 + groups, Ratio::whole(1));
            }
        }
        formula
    };
    let named = |name, formula| Published { name, formula };
    match figure {
        "equivalent_plastic_strain" => vec![
            named("thesis 4-4", power(0.474, 1.0, false)),
            named("thesis 5-4", beyond(0.475, 1.0, false)),
        ],
        "compression_ratio" => vec![
            named("thesis 4-5", power(0.34, 0.66, true)),
            named("thesis 5-5", beyond(0.33, 0.66, true)),
        ],
        "max_force_N" => vec![named(
            "thesis 4-13",
            power(2.0 * std::f64::consts::PI, 0.5, false),
        )],
        "restitution" => {
            let shape = Shape::Product(vec![
                Shape::Leaf(None),
                Shape::Exp(Box::new(Shape::Leaf(None))),
            ]);
            let numbers = [leaf(2.85, -0.325, 0.0), leaf(-2.0, 0.0, 0.325)].concat();
            let mut formula = Formula::free(shape, numbers);
            with_fixed_others(&mut formula, 0, &[modulus]);
            with_fixed_others(&mut formula, groups + 1, &[severity]);
            let mut all = vec![named("thesis 4-9", formula)];
            // 0.62 (V/V_y / (E*/Y))^(-1/2) with V/V_y = (rho V^2/Y)^(1/2) (E*/Y)^2 / 26^(1/2)
            if let Some(nu) = poisson_ratio {
                let star = 1.0 / (1.0 - nu * nu);
                let c = 0.62 * (star / ROUNDED.sqrt()).powf(-0.5);
                let mut wu = Formula::free(Shape::Leaf(None), leaf(c, -0.5, -0.25));
                with_fixed_others(&mut wu, 0, &[]);
                fix(&mut wu, 1 + modulus, Ratio { over: -1, under: 2 });
                fix(&mut wu, 1 + severity, Ratio { over: -1, under: 4 });
                all.push(named("Wu, Li and Thornton 2003 (thesis 4-8)", wu));
            }
            all
        }
        _ => Vec::new(),
    }
}
