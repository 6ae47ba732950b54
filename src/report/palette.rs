//! Palette: colours and dashes that tell the laws apart, also in print and for colour-blind readers.

/// 8-bit red, green, blue.
pub type Rgb = [u8; 3];

/// What a series stands for; decides how much it stands out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Simulated impact: black.
    Simulation,
    /// Our fitted law: thick, vermilion.
    Law,
    /// A theory, or anything that is one of many.
    Theory,
}

/// Dash and gap, px; `None` for a solid line.
pub type Dash = Option<(f64, f64)>;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Colour.
    pub colour: Rgb,
    /// Line width, px.
    pub width: f64,
    /// Dashes.
    pub dash: Dash,
}

/// Text and axes.
pub const TEXT: Rgb = [0x22, 0x22, 0x22];
/// Axis lines and tick labels.
pub const AXIS: Rgb = [0x66, 0x66, 0x66];
/// Grid.
pub const GRID: Rgb = [0xe6, 0xe6, 0xe6];

/// Colours of Okabe and Ito (2008), distinguishable with every common colour blindness; vermilion is kept for our law,
/// black for the simulation. A name that begins another one comes after it.
const THEORIES: [(&str, Rgb, Dash); 10] = [
    ("hertz", [0x7f, 0x7f, 0x7f], Some((2.0, 3.0))),
    ("johnson", [0x56, 0xb4, 0xe9], None),
    ("thornton-hardness", [0x00, 0x72, 0xb2], Some((4.0, 2.0))),
    ("thornton", [0x00, 0x72, 0xb2], None),
    ("kogut-etsion", [0x00, 0x9e, 0x73], None),
    ("jackson-green", [0xcc, 0x79, 0xa7], None),
    (
        "walton-braun-variable",
        [0xe6, 0x9f, 0x00],
        Some((2.0, 2.0)),
    ),
    ("walton-braun", [0xe6, 0x9f, 0x00], Some((7.0, 3.0))),
    ("wu-li-thornton", [0x33, 0x22, 0x88], Some((4.0, 2.0))),
    ("luding", [0x8c, 0x51, 0x0a], Some((7.0, 3.0))),
];

/// Ink of the series `label`; `nth` counts the series of the same role before it.
///
/// A law keeps its colour in every figure: names are matched first, the order decides only for unknown ones.
#[must_use]
pub fn ink(role: Role, label: &str, nth: usize) -> Ink {
    let solid = |colour, width| Ink {
        colour,
        width,
        dash: None,
    };
    match role {
        Role::Simulation if nth == 0 => solid([0, 0, 0], 2.4),
        Role::Simulation => Ink {
            dash: Some((5.0, 3.0)),
            ..solid([0x55, 0x55, 0x55], 2.0)
        },
        Role::Law if nth == 0 => solid([0xd5, 0x5e, 0x00], 2.4),
        Role::Law => Ink {
            dash: Some((9.0, 4.0)),
            ..solid([0xd5, 0x5e, 0x00], 2.0)
        },
        Role::Theory => {
            let name = label.to_lowercase().replace([' ', '–', '_'], "-");
            let known = THEORIES
                .iter()
                .find(|(theory, ..)| name.starts_with(theory));
            let (_, colour, dash) = known.unwrap_or(&THEORIES[DISTINCT[nth % DISTINCT.len()]]);
            Ink {
                dash: *dash,
                ..solid(*colour, 1.6)
            }
        }
    }
}

/// Entries of [`THEORIES`] whose colours differ, for curves that are no theory.
const DISTINCT: [usize; 8] = [1, 2, 4, 5, 6, 8, 9, 0];

/// Anchors of the colour map viridis (S. van der Walt and N. Smith, 2015; CC0), equal steps from 0 to 1.
const VIRIDIS: [Rgb; 9] = [
    [0x44, 0x01, 0x54],
    [0x47, 0x2d, 0x7b],
    [0x3b, 0x52, 0x8b],
    [0x2c, 0x72, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x28, 0xae, 0x80],
    [0x5e, 0xc9, 0x62],
    [0xad, 0xdc, 0x30],
    [0xfd, 0xe7, 0x25],
];

/// Colour of `t` in 0..1 on a perceptually even scale; outside it is clamped.
#[must_use]
pub fn viridis(t: f64) -> Rgb {
    let last = (VIRIDIS.len() - 1) as f64;
    let place = if t.is_finite() {
        t.clamp(0.0, 1.0) * last
    } else {
        0.0
    };
    let i = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let f = place - i as f64;
    std::array::from_fn(|c| {
        (f64::from(VIRIDIS[i][c]) * (1.0 - f) + f64::from(VIRIDIS[i + 1][c]) * f).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_keeps_its_colour_in_every_figure() {
        let first = ink(Role::Theory, "Kogut–Etsion", 0);
        assert_eq!(first, ink(Role::Theory, "kogut-etsion", 5));
        assert_ne!(first.colour, ink(Role::Theory, "Jackson–Green", 0).colour);
    }

    #[test]
    fn the_colour_map_grows_brighter() {
        let luma = |t| {
            let [r, g, b] = viridis(t).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for i in 0..50 {
            assert!(luma(f64::from(i) / 50.0) < luma(f64::from(i + 1) / 50.0));
        }
        assert_eq!(viridis(f64::NAN), viridis(-1.0));
    }
}
