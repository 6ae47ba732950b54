//! Quantities as text: `"70 GPa"` to an SI number and back; the only place where a unit is converted.
//!
//! Structs that mirror a file hold [`Quantity`] fields; command-line arguments go through [`argument`].
//! Both accept what uom knows ("250 µm", "7274 kg/m³"), its ASCII spellings ("250 um", "7274 kg/m^3", "9.81 m/s2"), the
//! units of each dimension's list, and a number without a blank before its unit ("0.5mm").

mod format;

pub use format::{engineering, prefixed, rounded, significant};

use crate::{Error, Result};
use serde::de::{self, Deserializer, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;
use uom::si::f64 as si;

/// Physical dimension of a quantity in a file: which units it takes and what to suggest.
pub trait Dimension: Copy + fmt::Debug {
    /// With article, as in "must be a length with its unit".
    const NAME: &'static str;
    /// An example of an acceptable text.
    const EXAMPLE: &'static str;
    /// Units that messages list; uom's other units are accepted too.
    const UNITS: &'static [&'static str];
    /// Units that uom does not know, in SI base units.
    const OURS: &'static [(&'static str, f64)];
    /// Number in SI base units; `None` when the text is not "number unit" of this dimension, as uom spells it.
    fn si(text: &str) -> Option<f64>;
}

/// Declares the dimensions: marker, name with article, example, uom's type, units that uom knows, units of ours.
macro_rules! dimensions {
    ($($(#[$doc:meta])* $marker:ident, $name:literal, $example:literal, $quantity:ty,
        [$($unit:literal),+], [$($ours:literal = $factor:literal),*];)+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $marker {}

        impl Dimension for $marker {
            const NAME: &'static str = $name;
            const EXAMPLE: &'static str = $example;
            const UNITS: &'static [&'static str] = &[$($unit),+ $(, $ours)*];
            const OURS: &'static [(&'static str, f64)] = &[$(($ours, $factor)),*];
            fn si(text: &str) -> Option<f64> {
                <$quantity>::from_str(text).ok().map(|quantity| quantity.value)
            }
        }
    )+
        /// Every dimension, in the order of the list.
        pub const DIMENSIONS: &[Units] = &[$(Units::of::<$marker>()),+];
    };
}

/// What a [`Dimension`] states, as a value.
#[derive(Debug, Clone, Copy)]
pub struct Units {
    /// [`Dimension::NAME`].
    pub name: &'static str,
    /// [`Dimension::EXAMPLE`].
    pub example: &'static str,
    /// [`Dimension::UNITS`].
    pub units: &'static [&'static str],
    /// [`parse()`].
    pub parse: fn(&str) -> std::result::Result<f64, UnitError>,
}

/// The parser follows from the rest.
impl PartialEq for Units {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Units {}

impl Units {
    /// What `D` states.
    #[must_use]
    pub const fn of<D: Dimension>() -> Self {
        Self {
            name: D::NAME,
            example: D::EXAMPLE,
            units: D::UNITS,
            parse: parse::<D>,
        }
    }

    /// Name without its article.
    #[must_use]
    pub fn noun(&self) -> &'static str {
        self.name
            .split_once(' ')
            .map_or(self.name, |(_, noun)| noun)
    }
}

dimensions! {
    /// m.
    Length, "a length", "250 um", si::Length,
        ["nm", "um", "mm", "cm", "dm", "m", "km", "in", "ft"], ["micron" = 1e-6];
    /// m/s.
    Velocity, "a velocity", "10 m/s", si::Velocity,
        ["um/s", "mm/s", "cm/s", "m/s", "km/s", "km/h", "ft/s"], [];
    /// m/s2.
    Acceleration, "an acceleration", "9.81 m/s2", si::Acceleration, ["mm/s2", "cm/s2", "m/s2", "km/s2"], [];
    /// rad/s.
    AngularVelocity, "an angular velocity", "30 rpm", si::AngularVelocity, ["rad/s", "deg/s", "rps", "rpm"], [];
    /// rad.
    Angle, "an angle", "45 deg", si::Angle, ["rad", "deg"], [];
    /// kg/m3.
    Density, "a density", "7274 kg/m3", si::MassDensity,
        ["kg/m3", "g/cm3", "t/m3", "lb/in3", "lb/ft3"],
        ["g/cc" = 1e3, "g/ml" = 1e3, "kg/dm3" = 1e3, "kg/l" = 1e3, "g/l" = 1.0, "g/mm3" = 1e6, "kg/mm3" = 1e9, "t/mm3" = 1e12];
    /// kg.
    Mass, "a mass", "1.5 mg", si::Mass, ["ng", "ug", "mg", "g", "kg", "t", "lb"], [];
    /// Pa.
    Pressure, "a pressure", "70 GPa", si::Pressure,
        ["Pa", "kPa", "MPa", "GPa", "N/mm2", "bar", "psi"],
        ["N/m2" = 1.0, "kN/m2" = 1e3, "kN/mm2" = 1e9, "ksi" = 6.894_757_293_168e6, "Msi" = 6.894_757_293_168e9];
    /// N.
    Force, "a force", "2.5 N", si::Force, ["uN", "mN", "N", "kN", "MN", "lbf"], [];
    /// N m.
    Torque, "a torque", "2.5 mN m", si::Torque, ["uN m", "mN m", "N m", "kN m"], [];
    /// Hz.
    Frequency, "a frequency", "50 Hz", si::Frequency, ["mHz", "Hz", "kHz", "MHz"], [];
    /// Pa s.
    Viscosity, "a viscosity", "18.1 uPa s", si::DynamicViscosity, ["uPa s", "mPa s", "Pa s"], [];
    /// kg/s.
    MassRate, "a mass rate", "5 g/s", si::MassRate, ["mg/s", "g/s", "kg/s", "kg/h", "t/h"], [];
    /// J.
    Energy, "an energy", "2 uJ", si::Energy, ["nJ", "uJ", "mJ", "J", "kJ"], [];
    /// J/m2.
    SurfaceEnergy, "an energy per area", "50 mJ/m2", si::RadiantExposure,
        ["uJ/m2", "mJ/m2", "J/m2", "kJ/m2"], ["N/m" = 1.0, "mN/m" = 1e-3, "erg/cm2" = 1e-3, "dyn/cm" = 1e-3];
    /// s.
    Time, "a time", "20 ms", si::Time, ["ns", "us", "ms", "s", "min", "h", "d"], [];
    /// 1/s.
    StrainRate, "a strain rate", "40 1/s", si::Frequency, ["1/s"], ["1/ms" = 1e3, "1/min" = 0.016_666_666_666_666_666];
    /// K.
    Temperature, "a temperature", "293 K", si::ThermodynamicTemperature, ["K", "degC"], [];
    /// J/(kg K).
    SpecificHeat, "a specific heat", "450 J/(kg K)", si::SpecificHeatCapacity, ["J/(kg K)"], ["kJ/(kg K)" = 1e3, "J/(g K)" = 1e3];
}

/// Text that is not a quantity of the dimension asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found {found}; {allowed}")]
pub struct UnitError {
    /// What was given, quoted.
    pub found: String,
    /// What is allowed, with an example.
    pub allowed: String,
}

/// SI value of a text such as `"250 um"`.
///
/// ```
/// use impactlaw::unit::{self, Density, Length};
/// assert_eq!(unit::parse::<Length>("250 um").unwrap(), 250e-6);
/// assert_eq!(unit::parse::<Density>("7274 kg/m3").unwrap(), 7274.0);
/// let error = unit::parse::<Length>("250").unwrap_err();
/// let said = error.to_string();
/// assert!(said.starts_with(r#"found "250"; must be a length with its unit, e.g. "250 um" (units: nm, um, mm,"#), "{said}");
/// ```
///
/// # Errors
/// [`UnitError`] when the unit is missing, unknown or of another dimension, or the number is not finite.
pub fn parse<D: Dimension>(text: &str) -> std::result::Result<f64, UnitError> {
    split(text)
        .and_then(|(number, unit)| {
            let ours = D::OURS
                .iter()
                .find(|(spelling, _)| *spelling == plain(unit));
            let in_si = |number: &str| match ours {
                Some((_, factor)) => number.parse::<f64>().ok().map(|number| number * factor),
                None => D::si(&format!("{number} {}", uom_spelling(unit))),
            };
            match in_si("1").and_then(power_of_ten) {
                Some(power) => shifted(number, power),
                None => in_si(number),
            }
        })
        .filter(|value| value.is_finite())
        .ok_or_else(|| UnitError {
            found: format!("\"{text}\""),
            allowed: format!(
                "must be {} with its unit, e.g. \"{}\" (units: {})",
                D::NAME,
                D::EXAMPLE,
                D::UNITS.join(", ")
            ),
        })
}

/// SI value of a command-line argument.
///
/// # Errors
/// [`Error::Refused`] naming `argument`, as for [`parse`].
pub fn argument<D: Dimension>(argument: &str, text: &str) -> Result<f64> {
    parse::<D>(text).map_err(|UnitError { found, allowed }| Error::Refused {
        what: argument.to_owned(),
        found,
        allowed,
    })
}

/// k where `factor` is the number nearest to $10^k$.
fn power_of_ten(factor: f64) -> Option<i32> {
    let power = factor.log10().round();
    let nearest: f64 = format!("1e{power}").parse().ok()?;
    (factor == nearest).then_some(power as i32)
}

/// The number nearest to `number` times $10^k$: 5 um is 5e-6, which 5 times the number nearest to 1e-6 is not.
fn shifted(number: &str, power: i32) -> Option<f64> {
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (number, 0),
    };
    format!("{mantissa}e{}", exponent.saturating_add(power.into()))
        .parse()
        .ok()
}

/// Number and unit of "250 um" or "0.5mm"; `None` when the text does not begin with a number that a unit follows.
fn split(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let digits = |from: usize| {
        let rest = text.as_bytes().get(from..).unwrap_or_default();
        from + rest.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    let sign = |from: usize| from + usize::from(text[from..].starts_with(['+', '-']));
    let mut end = digits(sign(0));
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    // an exponent is one only with its digits: the e of "3 eV" is not
    if text[end..].starts_with(['e', 'E']) {
        let first = sign(end + 1);
        let last = digits(first);
        if last > first {
            end = last;
        }
    }
    let (number, unit) = text.split_at(end);
    let unit = unit.trim_start();
    let follows = |c: char| c.is_alphabetic() || c == '°';
    let is_unit = unit.starts_with(follows) || unit.starts_with("1/");
    is_unit.then_some((number, unit))
}

/// "kg/m^3", "kg/m³" and "N·m" as the lists spell them: "kg/m3", "N m".
fn plain(unit: &str) -> String {
    let plain = unit.replace('^', "").replace('²', "2").replace('³', "3");
    plain.replace("\u{3bc}", "u").replace('µ', "u")
}

/// "kg/m^3" and "um" as uom spells them: "kg/m³", "µm".
fn uom_spelling(unit: &str) -> String {
    let mut unit = unit.replace('^', "").replace('\u{3bc}', "µ");
    unit = unit
        .replace('2', "²")
        .replace('3', "³")
        .replace("deg/", "°/")
        .replace("N m", "N · m")
        .replace("Pa s", "Pa · s")
        .replace("kg K", "kg · K");
    unit = match unit.as_str() {
        "deg" => "°".to_owned(),
        "degC" => "°C".to_owned(),
        "1/s" => "Hz".to_owned(),
        _ => unit,
    };
    if let Some(rest) = unit.strip_prefix('u').filter(|rest| !rest.is_empty()) {
        unit = format!("µ{rest}");
    }
    unit
}

/// Quantity in an input file: written as text with a unit, held in SI.
///
/// ```
/// use impactlaw::unit::{Length, Quantity};
/// #[derive(serde::Deserialize)]
/// struct Particle { radius: Quantity<Length> }
/// let particle: Particle = toml::from_str(r#"radius = "250 um""#).unwrap();
/// assert_eq!(particle.radius.si(), 250e-6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity<D> {
    si: f64,
    dimension: PhantomData<D>,
}

impl<D> Quantity<D> {
    /// Value in SI base units.
    #[must_use]
    pub fn si(self) -> f64 {
        self.si
    }
}

impl<'de, D: Dimension> de::Deserialize<'de> for Quantity<D> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> std::result::Result<Self, T::Error> {
        deserializer.deserialize_any(TextVisitor(PhantomData))
    }
}

/// Reads a [`Quantity`]; says what is missing when the file holds a bare number.
struct TextVisitor<D>(PhantomData<D>);

impl<D: Dimension> Visitor<'_> for TextVisitor<D> {
    type Value = Quantity<D>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{} with its unit as text, e.g. \"{}\"",
            D::NAME,
            D::EXAMPLE
        )
    }

    fn visit_str<E: de::Error>(self, text: &str) -> std::result::Result<Self::Value, E> {
        let si = parse::<D>(text).map_err(E::custom)?;
        Ok(Quantity {
            si,
            dimension: PhantomData,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    #[test]
    fn ascii_and_typographic_spellings_agree() {
        for (a, b) in [
            ("3 um", "3 µm"),
            ("3 um", "3 \u{3bc}m"),
            ("3 um", "0.003 mm"),
        ] {
            let (a, b) = (parse::<Length>(a).unwrap(), parse::<Length>(b).unwrap());
            approx::assert_relative_eq!(a, b, max_relative = 1e-15);
        }
        assert_eq!(parse::<Density>("8 g/cm^3").unwrap(), 8000.0);
        assert_eq!(
            parse::<Acceleration>("9.81 m/s^2"),
            parse::<Acceleration>("9.81 m/s²")
        );
        assert_eq!(parse::<Angle>("180 deg").unwrap(), std::f64::consts::PI);
        assert_eq!(
            parse::<AngularVelocity>("360 deg/s"),
            parse::<AngularVelocity>("360 °/s")
        );
        assert_eq!(parse::<Time>("2 us").unwrap(), 2e-6);
        assert_eq!(parse::<Force>("2 uN").unwrap(), 2e-6);
        assert_eq!(parse::<Mass>("1 g").unwrap(), 1e-3);
        assert_eq!(parse::<Velocity>("-5 mm/s").unwrap(), -5e-3);
    }

    #[test]
    fn decimals_stay_what_they_are_in_another_unit() {
        for (text, si) in [
            ("5 um", 5e-6),
            ("0.7 um", 0.7e-6),
            ("1.1e1 um", 11e-6),
            ("3 micron", 3e-6),
            ("-2.3E-2 mm", -2.3e-5),
            ("9 km", 9e3),
        ] {
            assert_eq!(parse::<Length>(text), Ok(si), "{text}");
        }
        assert_eq!(parse::<Pressure>("59.82 GPa"), Ok(59.82e9));
        assert_eq!(parse::<Pressure>("0.3 N/mm2"), Ok(0.3e6));
        assert_eq!(parse::<Density>("7.3 g/cc"), Ok(7.3e3));
        assert_eq!(parse::<Mass>("0.7 mg"), Ok(0.7e-6));
        // units that are no power of ten are multiplied as before
        assert_eq!(parse::<Length>("2 in"), Ok(0.0508));
        for text in ["1e999999999999999999999 um", "1e9223372036854775807 um"] {
            assert!(parse::<Length>(text).is_err(), "{text}");
        }
        assert_eq!(parse::<Length>("1e-9223372036854775807 um"), Ok(0.0));
    }

    #[test]
    fn wrong_dimension_missing_unit_and_non_finite_are_rejected() {
        for text in [
            "", "250", "um", "250 Pa", "inf m", "NaN m", "1e400 m", "1,5 m", "3 u", "2 m 3", "+ m",
            ". m", "- 3 m", "3e m", "3 e2 m", "1 2 m", "250 µ", "ü m", "3. 2 m",
        ] {
            let error = parse::<Length>(text).unwrap_err();
            assert_eq!(error.found, format!("\"{text}\""));
            assert!(error.allowed.contains("250 um"), "{error}");
        }
    }

    #[test]
    fn spellings_of_other_codes_and_tables_are_understood() {
        let close = |a: f64, b: f64| approx::assert_relative_eq!(a, b, max_relative = 1e-7);
        for (text, si) in [
            ("0.5mm", 5e-4),
            ("250um", 250e-6),
            ("1e-3m", 1e-3),
            ("5E2 micron", 5e-4),
        ] {
            close(parse::<Length>(text).unwrap(), si);
        }
        for text in [
            "7.85 g/cc",
            "7.85e-9 t/mm3",
            "7.85e-9t/mm^3",
            "7.85 kg/dm3",
            "7.85 kg/dm³",
            "7.85e-3 g/mm3",
            "7.85 t/m3",
            "7.85 kg/l",
            "7.85 g/ml",
            "7.85e-6 kg/mm3",
            "7850 g/l",
        ] {
            close(parse::<Density>(text).unwrap(), 7850.0);
        }
        for (text, si) in [
            ("70 kN/mm2", 70e9),
            ("70kN/mm²", 70e9),
            ("70e3 N/mm2", 70e9),
            ("1 ksi", 6.894_757e6),
            ("1 psi", 6.894_757e3),
            ("10 Msi", 6.894_757e10),
            ("1 bar", 1e5),
            ("3 kN/m2", 3e3),
        ] {
            close(parse::<Pressure>(text).unwrap(), si);
        }
        close(parse::<Velocity>("36km/h").unwrap(), 10.0);
        close(parse::<Angle>("180°").unwrap(), std::f64::consts::PI);
    }

    #[test]
    fn an_unknown_unit_is_answered_with_all_units_there_are() {
        let said = parse::<Pressure>("70 GPA").unwrap_err().allowed;
        for unit in Pressure::UNITS {
            assert!(said.contains(unit), "{unit} is not in: {said}");
        }
    }

    #[test]
    fn every_example_and_every_listed_unit_is_acceptable() {
        for dimension in DIMENSIONS {
            assert!((dimension.parse)(dimension.example).unwrap() > 0.0);
            for unit in dimension.units {
                let text = format!("1.5 {unit}");
                assert!((dimension.parse)(&text).is_ok_and(|si| si > 0.0), "{text}");
            }
        }
    }

    #[test]
    fn engineering_text_rounds_across_a_prefix() {
        assert_eq!(engineering(999.96e-6, "m", 3), "1 mm");
        assert_eq!(engineering(1e-6, "s", 3), "1 µs");
        assert_eq!(engineering(1000.0, "N", 3), "1 kN");
        assert_eq!(engineering(-2.5e-3, "m", 3), "-2.5 mm");
        assert_eq!(engineering(0.0, "N", 3), "0 N");
        assert_eq!(engineering(3e-15, "J", 2), "0.003 pJ");
        assert_eq!(engineering(12.0, "m/s", 3), "12 m/s");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

        #[test]
        fn engineering_text_reads_back(mantissa in 1.0f64..10.0, exponent in -11i32..13) {
            let value = mantissa * 10f64.powi(exponent);
            let back = parse::<Pressure>(&engineering(value, "Pa", 6)).unwrap();
            prop_assert!((back / value - 1.0).abs() < 1e-5);
        }
    }
}
