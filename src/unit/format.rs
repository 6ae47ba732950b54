//! Numbers as a person reads them: significant digits, SI prefixes.

/// `value` with `digits` significant digits and an SI prefix: `engineering(250e-6, "m", 3)` is "250 µm".
///
/// Compound units ("m/s", "kg/m³") take no prefix; kilograms become grams with a prefix.
///
/// ```
/// use impactlaw::unit::engineering;
/// assert_eq!(engineering(1.25e9, "Pa", 3), "1.25 GPa");
/// assert_eq!(engineering(14.72, "N", 3), "14.7 N");
/// assert_eq!(engineering(7274.0, "kg/m³", 4), "7274 kg/m³");
/// assert_eq!(engineering(4.76e-7, "kg", 3), "476 µg");
/// ```
#[must_use]
pub fn engineering(value: f64, unit: &str, digits: usize) -> String {
    // The prefix is that of the rounded number, so that 999.9 at three digits is "1 k", not "1000 ".
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1))
        .parse()
        .unwrap_or(value);
    let (factor, unit) = prefixed(rounded, unit);
    format!("{} {unit}", significant(value * factor, digits))
}

/// Factor and unit that bring `size` into 1 .. 1000: `prefixed(2e-4, "m")` is `(1e6, "µm")`.
///
/// For axes and columns, whose numbers share one unit. Compound units take no prefix, kilograms become grams.
#[must_use]
pub fn prefixed(size: f64, unit: &str) -> (f64, String) {
    const PREFIXES: [&str; 9] = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];
    if unit == "kg" {
        let (factor, unit) = prefixed(size * 1e3, "g");
        return (factor * 1e3, unit);
    }
    if unit.contains(['/', '²', '³']) || unit.is_empty() || size == 0.0 || !size.is_finite() {
        return (1.0, unit.to_owned());
    }
    // Powers of ten are their own group although their logarithm is rounded.
    let group = (size.abs().log10() / 3.0 + 1e-12).floor().clamp(-4.0, 4.0);
    let prefix = PREFIXES[(group + 4.0) as usize];
    (1000f64.powi(-group as i32), format!("{prefix}{unit}"))
}

/// `value` with `digits` significant digits, trailing zeros dropped, and an exponent only outside 1e-4 .. 1e6.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    let text = rounded(value, digits);
    let (mantissa, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    format!("{}{exponent}", without_trailing_zeros(mantissa))
}

/// As [`significant`], trailing zeros kept: for columns, where 3.50 stands under 10.5.
#[must_use]
pub fn rounded(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent: Option<i32> = scientific.split_once('e').and_then(|(_, e)| e.parse().ok());
    match exponent {
        Some(exponent) if (-4..6).contains(&exponent) => {
            let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
            format!("{value:.decimals$}")
        }
        _ => scientific,
    }
}

fn without_trailing_zeros(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}
