//! C kernel of a law: the functions of state that every dialect wraps, as text without dependency but `math.h`.
//!
//! The equations stand once in Rust (`contact`) and once in the files of `src/export/c`; dialects add only what their
//! code asks for around them. Text in those files: `law_` and `LAW_` stand for the law's identifier.

use crate::contact::elastoplastic::Elastoplastic;
use crate::contact::loading::{Loading, SoftenedHertz};
use crate::contact::spline::SplineLoading;
use crate::export::source::portable::Portable;
use crate::law::FittedLaw;
use std::fmt::Write;

const TYPES: &str = include_str!("types.h");
const HERTZ: &str = include_str!("hertz.h");
const CLOSED_FORM: &str = include_str!("closed_form.h");
const ELASTOPLASTIC: &str = include_str!("elastoplastic.h");
const PRESS: &str = include_str!("press.h");
const PAIR_PRESS: &str = include_str!("pair_press.h");
const INERTIA: &str = include_str!("inertia.h");

/// The kernel of `law`: constants as macros, types, and the functions `law_forget`, `law_wall`, `law_pair` (of the law of a pair of bodies
/// `law_press` in their place), `law_elastic_energy` and, where the law has inertia, `law_inertia`, all of them `static inline` unless `LAW_FUNCTION`
/// is defined before.
#[must_use]
pub fn text(law: &Portable) -> String {
    let mut constants = Vec::new();
    let curve = match &law.core {
        FittedLaw::Hertz(hertz) => {
            constants.push(("PREFACTOR", hertz.prefactor()));
            HERTZ.to_owned()
        }
        FittedLaw::ClosedForm(core) => {
            yields(core, &mut constants);
            softened(core.loading(), &mut constants);
            format!("{CLOSED_FORM}\n{ELASTOPLASTIC}")
        }
        FittedLaw::Spline(core) => {
            yields(core, &mut constants);
            format!("{}\n{ELASTOPLASTIC}", spline(core.loading()))
        }
    };
    constants.push(("VALID_TO", law.file.valid.displacement_over_radius_max));
    let press = match law.pair() {
        None => PRESS,
        Some(pair) => {
            let [first, second] = pair.materials().map(|m| m.contact_modulus());
            constants.push(("SHARE", 1.0 / (1.0 + first / second)));
            PAIR_PRESS
        }
    };
    let mut parts = vec![TYPES.to_owned(), curve, press.to_owned()];
    if law.inertia() > 0.0 {
        constants.push(("INERTIA", law.inertia()));
        constants.push(("DENSITY", law.material().density));
        constants.push(("INERTIA_START", departure(law)));
        parts.push(INERTIA.to_owned());
    }
    let mut text =
        "#ifndef LAW_FUNCTION\n#define LAW_FUNCTION static inline\n#endif\n\n".to_owned();
    for (name, value) in constants {
        let _ = writeln!(text, "#define LAW_{name} {}", number(value));
    }
    named(&format!("{text}\n{}", parts.join("\n")), law)
}

/// `text` with the law's identifier in the place of `law_` and `LAW_`.
#[must_use]
pub fn named(text: &str, law: &Portable) -> String {
    let identifier = &law.identifier;
    text.replace("law_", &format!("{identifier}_"))
        .replace("LAW_", &format!("{}_", identifier.to_uppercase()))
}

/// A double that C reads back bit for bit; in brackets if negative, so that it can stand anywhere in an expression.
#[must_use]
pub fn number(value: f64) -> String {
    match value < 0.0 {
        true => format!("({value:e})"),
        false => format!("{value:e}"),
    }
}

/// Constants of yielding and unloading.
fn yields<L: Loading>(law: &Elastoplastic<L>, constants: &mut Vec<(&'static str, f64)>) {
    let [scale, power, residual, strain] = law.unloading().constants();
    constants.extend([
        ("YIELD_FLATTENING", law.units().flattening),
        ("YIELD_FORCE", law.units().force),
        ("DEPARTURE", law.loading().departure()),
        ("RESIDUAL_SCALE", scale),
        ("RESIDUAL_POWER", power),
        ("EXPONENT_RESIDUAL", residual),
        ("EXPONENT_STRAIN", strain),
    ]);
}

fn softened(curve: &SoftenedHertz, constants: &mut Vec<(&'static str, f64)>) {
    constants.push(("BREADTH", curve.breadth()));
    constants.push(("SOFTENING", curve.softening()));
}

/// Loading curve of a spline: a chain of intervals, because tables cannot stand in every dialect.
fn spline(curve: &SplineLoading) -> String {
    let cubics: Vec<_> = curve.cubics().collect();
    let mut text = "\
/* Loading curve f = F/F_y at w = delta/delta_y, and its slope df/dw: w^1.5 up to LAW_DEPARTURE, then cubics in
   t = sqrt(w) - sqrt(w_k) between knots w_k, a straight line in w past the last knot. */
LAW_FUNCTION double law_loading(double w, double *slope)
{
    double root = sqrt(w), t, c0, c1, c2, c3;
    if (w <= LAW_DEPARTURE) {
        *slope = 1.5 * root;
        return w * root;
    }
"
    .to_owned();
    for (k, (_, start, coefficients)) in cubics.iter().enumerate() {
        let condition = match cubics.get(k + 1) {
            Some((end, ..)) => format!("if (w <= {}) {{", number(*end)),
            None => "{".to_owned(),
        };
        let lead = if k == 0 { "    " } else { " else " };
        let _ = writeln!(text, "{lead}{condition}");
        let _ = writeln!(text, "        t = root - {};", number(*start));
        for (i, c) in coefficients.iter().enumerate() {
            let _ = writeln!(text, "        c{i} = {};", number(*c));
        }
        text.push_str("    }");
    }
    text.push_str(
        "
    *slope = (c1 + t * (2.0 * c2 + t * 3.0 * c3)) / (2.0 * root);
    return c0 + t * (c1 + t * (c2 + t * c3));
}
",
    );
    text
}

/// Flattening over radius at which yielding, and with it inertia, begins.
fn departure(law: &Portable) -> f64 {
    match &law.core {
        FittedLaw::Hertz(_) => 0.0,
        FittedLaw::ClosedForm(core) => core.loading().departure() * core.units().flattening,
        FittedLaw::Spline(core) => core.loading().departure() * core.units().flattening,
    }
}
