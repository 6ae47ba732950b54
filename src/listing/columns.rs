//! Columns of a list of grains: what each means by its name, in any order, and the grain a row of them stands for.

use super::text::{number, short};
use super::{Listed, Listing, Meaning};
use crate::unit::{self, Length, Velocity};
use parry3d::math::Vector;

/// How a place is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Frame {
    /// As it is, or with the periods it has gone through: the same place in a periodic box.
    Plain,
    /// As a share of the box.
    Scaled,
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Place(usize, Frame),
    Radius,
    Diameter,
    Velocity(usize),
    Spin(usize),
    Kind,
    Density,
    Mass,
    /// Told apart from unknown ones: it says nothing that is wanted here.
    Idle,
}

/// Names of columns, in small letters, with a component or unit taken off.
fn role(name: &str, axis: Option<usize>) -> Option<Role> {
    let of = |axes: [&str; 3]| axes.iter().position(|axis| *axis == name);
    let plain = [["x", "y", "z"], ["xu", "yu", "zu"]];
    let scaled = [["xs", "ys", "zs"], ["xsu", "ysu", "zsu"]];
    let turns = [["wx", "wy", "wz"], ["omegax", "omegay", "omegaz"]];
    if let Some(axis) = axis {
        return match name {
            "points" | "point" | "position" | "coordinates" | "centre" | "center" => {
                Some(Role::Place(axis, Frame::Plain))
            }
            "velocity" | "velocities" | "v" => Some(Role::Velocity(axis)),
            "spin" | "omega" | "angular_velocity" | "angvel" => Some(Role::Spin(axis)),
            _ => None,
        };
    }
    if let Some(axis) = plain.iter().find_map(|axes| of(*axes)) {
        return Some(Role::Place(axis, Frame::Plain));
    }
    if let Some(axis) = scaled.iter().find_map(|axes| of(*axes)) {
        return Some(Role::Place(axis, Frame::Scaled));
    }
    if let Some(axis) = of(["vx", "vy", "vz"]) {
        return Some(Role::Velocity(axis));
    }
    if let Some(axis) = turns.iter().find_map(|axes| of(*axes)) {
        return Some(Role::Spin(axis));
    }
    match name {
        "radius" | "r" | "rad" => Some(Role::Radius),
        "diameter" | "d" => Some(Role::Diameter),
        "material" | "type" | "mat" => Some(Role::Kind),
        "density" | "rho" => Some(Role::Density),
        "mass" | "m" => Some(Role::Mass),
        "id" | "ix" | "iy" | "iz" | "mol" | "proc" | "element" | "group" => Some(Role::Idle),
        _ => None,
    }
}

/// A name without its unit, and the unit: `x_mm`, `x (mm)`, `x [mm]`.
fn split(name: &str) -> (String, Option<String>) {
    let name = name.trim().trim_matches('"').trim();
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some((head, rest)) = name.split_once(open)
            && let Some(unit) = rest.trim().strip_suffix(close)
        {
            return (head.trim().to_lowercase(), Some(unit.trim().to_owned()));
        }
    }
    const ENDINGS: [(&str, &str); 16] = [
        ("_kg_m3", "kg/m3"),
        ("_g_cm3", "g/cm3"),
        ("_mm_s", "mm/s"),
        ("_cm_s", "cm/s"),
        ("_um_s", "um/s"),
        ("_rad_s", "rad/s"),
        ("_m_s", "m/s"),
        ("_kg", "kg"),
        ("_mg", "mg"),
        ("_nm", "nm"),
        ("_um", "um"),
        ("_mm", "mm"),
        ("_cm", "cm"),
        ("_km", "km"),
        ("_g", "g"),
        ("_m", "m"),
    ];
    let small = name.to_lowercase();
    let unit = ENDINGS.iter().find_map(|(ending, unit)| {
        let head = small.strip_suffix(ending)?;
        (!head.is_empty()).then(|| (head.to_owned(), Some((*unit).to_owned())))
    });
    unit.unwrap_or((small, None))
}

/// A column that is used.
#[derive(Debug, Clone, PartialEq)]
struct Column {
    at: usize,
    name: String,
    role: Role,
    /// SI over what is written.
    factor: f64,
}

/// Columns of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    used: Vec<Column>,
    /// Number of columns.
    width: usize,
    /// Lowest corner and edges of the box, in the file's unit of length, for places that are shares of it.
    block: Option<[Vector; 2]>,
}

impl Columns {
    /// What columns of these names mean; `block` are the corners of the box in the file's own unit, if it tells them. What
    /// is not used is noted in `listing`.
    ///
    /// # Errors
    /// What is missing or said twice.
    pub fn new(
        names: &[&str],
        meaning: &Meaning,
        block: Option<[Vector; 2]>,
        listing: &mut Listing,
    ) -> Result<Self, String> {
        let mut used: Vec<Column> = Vec::new();
        let mut unknown = Vec::new();
        for (at, name) in names.iter().enumerate() {
            let (base, axis) = match name.trim_matches('"').rsplit_once(':') {
                Some((base, axis)) if ["0", "1", "2"].contains(&axis) => (base, axis.parse().ok()),
                _ => (*name, None),
            };
            let (base, unit) = split(base);
            let Some(role) = role(&base, axis) else {
                unknown.push(short(name));
                continue;
            };
            let factor = factor(role, unit.as_deref(), name, meaning)?;
            if role == Role::Idle {
                continue;
            }
            // a place may be there twice, wrapped and not: the first one counts
            let same = |column: &Column| match (column.role, role) {
                (Role::Place(a, _), Role::Place(b, _)) => a == b,
                (a, b) => a == b,
            };
            if let Some(other) = used.iter().find(|column| same(column)) {
                if matches!(role, Role::Place(..)) {
                    continue;
                }
                return Err(format!(
                    "says the same twice, in the columns `{}` and `{name}`; leave one out",
                    other.name
                ));
            }
            let Some(factor) = factor else { continue };
            if role == Role::Kind {
                listing.counts_from = usize::from(base == "type");
            }
            if matches!(role, Role::Radius | Role::Diameter) {
                listing.tells_unit = unit.is_some();
            }
            used.push(Column {
                at,
                name: (*name).to_owned(),
                role,
                factor,
            });
        }
        let columns = Self {
            used,
            width: names.len(),
            block,
        };
        columns.check(names)?;
        if !unknown.is_empty() {
            let note = format!("has columns that are not used: {}", unknown.join(", "));
            listing.notes.push(note);
        }
        Ok(columns)
    }

    fn has(&self, role: impl Fn(Role) -> bool) -> bool {
        self.used.iter().any(|column| role(column.role))
    }

    fn check(&self, names: &[&str]) -> Result<(), String> {
        let found = names.iter().map(|name| short(name)).collect::<Vec<_>>();
        let found = found.join(" ");
        for axis in 0..3 {
            let name = ["x", "y", "z"][axis];
            if !self.has(|role| matches!(role, Role::Place(a, _) if a == axis)) {
                return Err(format!(
                    "has no column `{name}`: found `{found}`; must hold `x`, `y` and `z` (or `xs` ..., `xu` ...)"
                ));
            }
        }
        for (what, of) in [
            (
                "velocity (`vx`, `vy`, `vz`)",
                Role::Velocity as fn(usize) -> Role,
            ),
            ("spin (`omegax`, `omegay`, `omegaz`)", Role::Spin),
        ] {
            let there = (0..3).filter(|&axis| self.has(|role| role == of(axis)));
            if ![0, 3].contains(&there.count()) {
                return Err(format!(
                    "has a part of the {what} only: found `{found}`; must hold all three or none"
                ));
            }
        }
        let scaled = self.has(|role| matches!(role, Role::Place(_, Frame::Scaled)));
        if scaled && self.block.is_none() {
            return Err(
                "has places as shares of a box, and no box; write `x`, `y` and `z`".to_owned(),
            );
        }
        Ok(())
    }

    /// The grain of a row of words, in line or point number `at`.
    ///
    /// # Errors
    /// What was found, and what is allowed.
    pub fn grain(
        &self,
        words: &[&str],
        at: usize,
        listing: &mut Listing,
    ) -> Result<Listed, String> {
        if words.len() != self.width {
            return Err(format!(
                "line {at}: found {} values; must be {}, one for each column",
                words.len(),
                self.width
            ));
        }
        let mut grain = Listed {
            at,
            ..Listed::default()
        };
        for column in &self.used {
            let word = words[column.at];
            if column.role == Role::Kind {
                if word.is_empty() {
                    return Err(format!(
                        "line {at}: found nothing for `{}`; must be a material or type",
                        column.name
                    ));
                }
                // 1, 1.0 and "1" are one type
                let whole = word.parse::<f64>().ok().filter(|v| v.fract() == 0.0);
                let name = whole.map_or(word.to_owned(), |value| format!("{value}"));
                grain.kind = Some(listing.kind(&name));
                continue;
            }
            let value = number(word, &column.name, at)?;
            self.set(&mut grain, column, value)?;
        }
        Ok(grain)
    }

    fn set(&self, grain: &mut Listed, column: &Column, value: f64) -> Result<(), String> {
        let si = value * column.factor;
        let positive = |value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(Some(value)),
            false => Err(format!(
                "line {}: found {value:e} for `{}`; must be above 0",
                grain.at, column.name
            )),
        };
        match column.role {
            Role::Place(axis, Frame::Plain) => grain.centre[axis] = si,
            Role::Place(axis, Frame::Scaled) => {
                let [low, edges] = self.block.unwrap_or([Vector::ZERO; 2]);
                grain.centre[axis] = (low[axis] + value * edges[axis]) * column.factor;
            }
            Role::Radius | Role::Diameter => {
                let share = if column.role == Role::Radius {
                    1.0
                } else {
                    0.5
                };
                let radius = positive(share * si)?;
                if let (Some(one), Some(other)) = (grain.radius, radius)
                    && (one / other - 1.0).abs() > 1e-5
                {
                    return Err(format!(
                        "line {}: found a radius of {one:e} m and a diameter of {:e} m; must fit each other",
                        grain.at,
                        2.0 * other
                    ));
                }
                grain.radius = grain.radius.or(radius);
            }
            Role::Velocity(axis) => grain.velocity[axis] = si,
            Role::Spin(axis) => grain.spin[axis] = si,
            Role::Density => grain.density = positive(si)?,
            Role::Mass => grain.mass = positive(si)?,
            Role::Kind | Role::Idle => {}
        }
        Ok(())
    }
}

/// SI over what a column has written, `unit` being the one in its name; none if it is not known and not needed.
fn factor(
    role: Role,
    unit: Option<&str>,
    name: &str,
    meaning: &Meaning,
) -> Result<Option<f64>, String> {
    let wrong = |unit: &str, must: &str| {
        format!("has the unit `{unit}` in its column `{name}`; must be {must}")
    };
    let one = |unit: &str| format!("1 {unit}");
    Ok(match role {
        Role::Place(..) | Role::Radius | Role::Diameter => Some(match unit {
            Some(unit) => unit::parse::<Length>(&one(unit)).map_err(|_| wrong(unit, "a length"))?,
            None => meaning.length(),
        }),
        Role::Velocity(_) => Some(match unit {
            Some(unit) => {
                unit::parse::<Velocity>(&one(unit)).map_err(|_| wrong(unit, "a velocity"))?
            }
            None => meaning.velocity().ok_or_else(|| velocity_wanted(name))?,
        }),
        Role::Spin(_) => Some(match unit {
            Some("rad/s" | "1/s") => 1.0,
            Some(unit) => return Err(wrong(unit, "rad/s")),
            // the unit of time is that of length over that of velocity
            None => meaning.velocity().ok_or_else(|| velocity_wanted(name))? / meaning.length(),
        }),
        Role::Density => match unit {
            Some("kg/m3") => Some(1.0),
            Some("g/cm3") => Some(1e3),
            Some(unit) => return Err(wrong(unit, "kg/m3 or g/cm3")),
            None => meaning.is_si().then_some(1.0),
        },
        Role::Mass => match unit {
            Some("kg") => Some(1.0),
            Some("g") => Some(1e-3),
            Some("mg") => Some(1e-6),
            Some(unit) => return Err(wrong(unit, "kg, g or mg")),
            None => meaning.is_si().then_some(1.0),
        },
        Role::Kind | Role::Idle => Some(1.0),
    })
}

/// That a unit of velocity has to be given.
pub(super) fn velocity_wanted(name: &str) -> String {
    format!(
        "has velocities (`{name}`) beside lengths of another unit than 1 m; say what 1 in them means (`velocity = \"1 mm/s\"`)"
    )
}
