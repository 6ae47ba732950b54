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
    /// A theory, by its place in the list of theories.
    Theory(usize),
    /// Anything else that is one of many.
    Other,
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

/// Inks of theories by their place in the list of theories, a few in reserve for new ones at its end. Colours of Okabe and
/// Ito (2008) first, distinguishable with every common colour blindness, then muted ones of Tol (2021); vermilion is kept for
/// our law, black for the simulation.
pub const THEORIES: [(Rgb, Dash); 15] = [
    ([0x7f, 0x7f, 0x7f], Some((2.0, 3.0))),
    ([0x56, 0xb4, 0xe9], None),
    ([0x00, 0x72, 0xb2], None),
    ([0x00, 0x72, 0xb2], Some((4.0, 2.0))),
    ([0x00, 0x9e, 0x73], None),
    ([0xcc, 0x79, 0xa7], None),
    ([0xe6, 0x9f, 0x00], Some((7.0, 3.0))),
    ([0xe6, 0x9f, 0x00], Some((2.0, 2.0))),
    ([0x8c, 0x51, 0x0a], Some((7.0, 3.0))),
    ([0x33, 0x22, 0x88], Some((4.0, 2.0))),
    ([0x88, 0x22, 0x55], None),
    ([0x99, 0x99, 0x33], Some((7.0, 3.0))),
    ([0x44, 0xaa, 0x99], Some((4.0, 2.0))),
    ([0x88, 0x22, 0x55], Some((2.0, 2.0))),
    ([0x99, 0x99, 0x33], None),
];

/// Inks of the series of a figure. A theory keeps its ink in every figure; what is no theory has none of their colours.
#[must_use]
pub fn inks(roles: &[Role]) -> Vec<Ink> {
    let theirs: Vec<Rgb> = roles
        .iter()
        .filter_map(|role| match role {
            Role::Theory(place) => Some(THEORIES[place % THEORIES.len()].0),
            _ => None,
        })
        .collect();
    let mut free = DISTINCT.to_vec();
    free.retain(|place| !theirs.contains(&THEORIES[*place].0));
    if free.is_empty() {
        free = DISTINCT.to_vec();
    }
    let of = |(i, role): (usize, &Role)| {
        let nth = roles[..i].iter().filter(|other| *other == role).count();
        ink(*role, nth, &free)
    };
    roles.iter().enumerate().map(of).collect()
}

/// Ink of a series; `nth` counts the series of the same role before it, `free` are the places for those that are no theory.
fn ink(role: Role, nth: usize, free: &[usize]) -> Ink {
    let solid = |colour, width| Ink {
        colour,
        width,
        dash: None,
    };
    let listed = |place: usize| {
        let (colour, dash) = THEORIES[place % THEORIES.len()];
        Ink {
            colour,
            width: 1.6,
            dash,
        }
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
        Role::Theory(place) => listed(place),
        Role::Other => listed(free[nth % free.len()]),
    }
}

/// Entries of [`THEORIES`] whose colours differ, for curves that are no theory.
const DISTINCT: [usize; 8] = [1, 3, 4, 5, 7, 9, 8, 0];

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
    fn inks_of_theories_differ_and_do_not_depend_on_the_order_in_a_figure() {
        for (place, one) in THEORIES.iter().enumerate() {
            assert!(!THEORIES[..place].contains(one), "{place}");
            let (alone, last) = (
                [Role::Theory(place)],
                [Role::Other, Role::Law, Role::Theory(place)],
            );
            assert_eq!(inks(&alone)[0], inks(&last)[2]);
        }
    }

    #[test]
    fn curves_that_are_no_theory_have_no_colour_of_a_theory_beside_them() {
        for place in 0..THEORIES.len() {
            let shown = inks(&[Role::Theory(place), Role::Other, Role::Other, Role::Other]);
            for (nth, one) in shown.iter().enumerate() {
                assert!(shown[..nth].iter().all(|other| other.colour != one.colour));
            }
        }
    }

    #[test]
    fn curves_that_are_no_theory_differ_in_colour() {
        let colours = DISTINCT.map(|place| THEORIES[place].0);
        for (nth, colour) in colours.iter().enumerate() {
            assert!(!colours[..nth].contains(colour), "{nth}");
        }
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
