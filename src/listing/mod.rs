//! Listing: grains as this and other programs list them in files: tables, dumps, data files, VTP, restarts.

pub(crate) mod columns;
mod data;
mod dump;
mod format;
mod restart;
mod table;
mod text;
mod vtp;

pub use self::format::Format;

use parry3d::math::Vector;

/// A grain of a list, SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Listed {
    /// Where it stands in the file: number of its line, or of its point, from 1.
    pub at: usize,
    /// Centre, m.
    pub centre: Vector,
    /// Radius, m, if the list has one.
    pub radius: Option<f64>,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
    /// Its material or type, as an index into [`Listing::kinds`].
    pub kind: Option<usize>,
    /// Density, kg/m3, if the list has one.
    pub density: Option<f64>,
    /// Mass, kg, if the list has one.
    pub mass: Option<f64>,
}

/// Grains of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Listing {
    /// The grains, in the order of the file.
    pub grains: Vec<Listed>,
    /// Materials and types as the file calls them.
    pub kinds: Vec<String>,
    /// The first of them where they are numbers: 1 of types, 0 of materials.
    pub counts_from: usize,
    /// What is not used of the file, for the user to know.
    pub notes: Vec<String>,
    /// Whether the file itself says in which unit its radii are.
    pub tells_unit: bool,
}

impl Listing {
    /// Index of a kind, which is new if it has not been met before.
    fn kind(&mut self, name: &str) -> usize {
        let place = self.kinds.iter().position(|kind| kind == name);
        place.unwrap_or_else(|| {
            self.kinds.push(name.to_owned());
            self.kinds.len() - 1
        })
    }
}

/// How the numbers of a file are meant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Meaning {
    /// Length that 1 means, m; 1 m if none.
    pub length: Option<f64>,
    /// Velocity that 1 means, m/s; 1 m/s if there is no `length` either.
    pub velocity: Option<f64>,
    /// Number of the frame, from 1; the last if none.
    pub frame: Option<usize>,
}

impl Meaning {
    /// Length that 1 means, m.
    fn length(&self) -> f64 {
        self.length.unwrap_or(1.0)
    }

    /// Velocity that 1 means, m/s; none if that is not known.
    fn velocity(&self) -> Option<f64> {
        self.velocity.or(self.length.is_none().then_some(1.0))
    }

    /// Whether masses and densities are SI.
    fn is_si(&self) -> bool {
        self.length() == 1.0
    }
}

/// Reads the bytes of a file.
///
/// # Errors
/// What is wrong, as the end of a sentence that starts with the file's name.
pub fn read(bytes: &[u8], format: Format, meaning: &Meaning) -> Result<Listing, String> {
    if meaning.frame.is_some() && format != Format::LammpsDump {
        return Err(
            "has no frames to choose from: leave out `frame`, or name a LAMMPS dump".to_owned(),
        );
    }
    let listing = format.read(bytes, meaning)?;
    if listing.grains.is_empty() {
        return Err("has no grains; name a file with some".to_owned());
    }
    match listing.grains.iter().find(|grain| !grain.is_sound()) {
        Some(grain) => Err(format!(
            "line {}: its place, size or motion is beyond what a number holds; must be finite, and its size positive, in SI units",
            grain.at
        )),
        None => Ok(listing),
    }
}

impl Listed {
    /// Whether its numbers are finite and its sizes positive: those of a file need not be after units and bounds are applied to
    /// them.
    fn is_sound(&self) -> bool {
        let vectors = [self.centre, self.velocity, self.spin];
        let sizes = [self.radius, self.density, self.mass];
        vectors.iter().all(|vector| vector.is_finite())
            && sizes
                .iter()
                .flatten()
                .all(|&size| size > 0.0 && size.is_finite())
    }
}
