//! Groups of grains whose places, sizes, velocities and materials are listed in a file.

use super::at::At;
use super::body::Files;
use super::material::GrainMaterial;
use super::written::vector;
use crate::Result;
use crate::document::keys::{key, keys};
use crate::error::must_be_one_of;
use crate::listing::{self, Format, Listed, Listing, Meaning};
use crate::unit::{Length, Quantity, Velocity, engineering};
use parry3d::math::Vector;
use serde::Deserialize;
use std::f64::consts::PI;
use std::path::Path;

/// Largest overlap over the smaller diameter where the scene does not say: contacts of one grain are no longer apart beyond.
const OVERLAP: f64 = 0.05;
/// Smallest radius of a file, m, above which it must tell a unit: in a list in mm, what is read is a thousand times as large.
const LARGE_WITHOUT_UNIT: f64 = 0.02;
/// Largest error of a density or mass in a file: text is often rounded to three digits.
const DENSITY_ERROR: f64 = 0.01;

/// Grains of one material as a file lists them.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// The file, for messages.
    pub file: String,
    /// Largest overlap over the smaller diameter that is let in.
    pub overlap: f64,
    /// The grains, in the order of the file.
    pub grains: Vec<Place>,
}

/// A grain as a file lists it, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Number of its line or point in the file.
    pub at: usize,
    /// Centre, m.
    pub centre: Vector,
    /// Radius, m.
    pub radius: f64,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Angular velocity, rad/s.
    pub spin: Vector,
}

/// Table `[grains.file]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileTable {
    path: String,
    format: Option<Format>,
    length: Option<Quantity<Length>>,
    velocity: Option<Quantity<Velocity>>,
    frame: Option<usize>,
    types: Option<Vec<String>>,
    overlap: Option<f64>,
    shift: Option<[Quantity<Length>; 3]>,
}

keys! {
    FileTable "Grains as a file lists them: places, sizes, velocities, spins, materials, with columns in any order. `radius` and `material` of the group hold where the file tells none, `velocity` and `stir` come on top." {
        path: key("the file", "", "'packing.csv'"),
        format: key("what it is; a `restart.bin` is that of another bed", "`\"csv\"`, `\"lammps-dump\"`, `\"lammps-data\"`, `\"vtp\"`, `\"restart\"`", "'csv'").or("by the ending"),
        length: key("length that 1 in the file means, where its columns name no unit; required where all radii would be above 2 cm in m", "> 0", "'1 mm'").or("`\"1 m\"`"),
        velocity: key("the same for velocities; required beside `length`", "> 0", "'1 mm/s'").or("`\"1 m/s\"`"),
        frame: key("frame of a dump that holds several", "≥ 1", "1").or("the last"),
        types: key("materials of the `type` 1, 2, ... of the file, or of its `material` 0, 1, ...", "of `materials`", "['steel', 'glass']").or("the group's `material`"),
        overlap: key("largest overlap that is let in, over the smaller diameter; with bodies, over the radius", "[0, 0.25]", "0.01").or("0.05"),
        shift: key("added to every place", "", "['0 mm', '0 mm', '5 mm']").or("0"),
    }
}

impl FileTable {
    /// Grains of each material of the file, in the order of the scene's materials. `alone` is the material of a file that
    /// tells none, `radius` (m) that of a file that tells none.
    ///
    /// # Errors
    /// One, naming file, line, what was found and what is allowed.
    pub(super) fn check(
        &self,
        at: &At,
        materials: &[GrainMaterial],
        alone: Option<usize>,
        radius: Option<f64>,
        files: &mut Files,
    ) -> Result<Vec<(usize, Given)>> {
        let overlap = at.document.check(
            &at.name("overlap"),
            self.overlap.unwrap_or(OVERLAP),
            |overlap| (0.0..=0.25).contains(&overlap),
            "must lie in [0, 0.25]: the largest overlap of two grains over the smaller diameter",
        )?;
        let path = at.document.resolve(&self.path);
        let listing = self.listing(at, &path, files)?;
        let kinds = self.kinds(at, &listing, materials, alone)?;
        let shift = self.shift.map_or(Vector::ZERO, vector);
        let mut given: Vec<Option<Given>> = vec![None; materials.len()];
        for grain in &listing.grains {
            let wrong = |wrong: String| {
                at.reject(
                    "path",
                    &format!("{} line {}: {wrong}", path.display(), grain.at),
                )
            };
            let material = match (grain.kind, alone) {
                (Some(kind), _) => kinds[kind],
                (None, Some(material)) => material,
                (None, None) => {
                    let names = materials.iter().map(|material| &material.name);
                    let wanted = must_be_one_of(names);
                    let allowed = format!("{wanted}, for the file tells no material");
                    let key = at.key.trim_end_matches(".file");
                    return Err(at.document.reject(&format!("{key}.material"), allowed));
                }
            };
            let radius = grain.radius.or(radius).ok_or_else(|| {
                at.reject(
                    "path",
                    &format!(
                        "{} has no `radius` and no `diameter`; give one beside the file (`radius = \"1 mm\"`)",
                        path.display()
                    ),
                )
            })?;
            let density = materials[material].material.density;
            check_density(grain, radius, density).map_err(wrong)?;
            given[material]
                .get_or_insert_with(|| Given {
                    file: path.display().to_string(),
                    overlap,
                    grains: Vec::new(),
                })
                .grains
                .push(Place {
                    at: grain.at,
                    centre: grain.centre + shift,
                    radius,
                    velocity: grain.velocity,
                    spin: grain.spin,
                });
        }
        let given = given.into_iter().enumerate();
        Ok(given.filter_map(|(k, given)| Some((k, given?))).collect())
    }

    /// What the file lists.
    fn listing(&self, at: &At, path: &Path, files: &mut Files) -> Result<Listing> {
        let format = match self.format.or_else(|| Format::of(&self.path)) {
            Some(format) => format,
            None => {
                let endings = Format::ENDINGS.join(", .");
                let allowed = format!("must end in one of .{endings}; or say its `format`");
                return Err(at.reject("path", &allowed));
            }
        };
        let meaning = Meaning {
            length: self.length.map(|q| at.positive("length", q)).transpose()?,
            velocity: self
                .velocity
                .map(|q| at.positive("velocity", q))
                .transpose()?,
            frame: self.frame,
        };
        let bytes = std::fs::read(path).map_err(|error| {
            let allowed = format!(
                "must name a file that can be read: {}: {error}",
                path.display()
            );
            at.reject("path", &allowed)
        })?;
        let listing = listing::read(&bytes, format, &meaning)
            .map_err(|wrong| at.reject("path", &format!("{} {}", path.display(), wrong)))?;
        files.insert(self.path.clone(), bytes);
        for note in &listing.notes {
            tracing::warn!("{} {note}", path.display());
        }
        let radii = listing.grains.iter().filter_map(|grain| grain.radius);
        let smallest = radii.fold(f64::INFINITY, f64::min);
        let all_large = smallest.is_finite() && smallest > LARGE_WITHOUT_UNIT;
        if !listing.tells_unit && self.length.is_none() && all_large {
            let allowed = format!(
                "{} names no unit of length, and 1 is taken for 1 m: a radius is {}; say what 1 means: `length = \"1 mm\"`, or `length = \"1 m\"` if that is meant",
                path.display(),
                engineering(smallest, "m", 3)
            );
            return Err(at.reject("path", &allowed));
        }
        Ok(listing)
    }

    /// Material of each kind of grain in the file.
    fn kinds(
        &self,
        at: &At,
        listing: &Listing,
        materials: &[GrainMaterial],
        alone: Option<usize>,
    ) -> Result<Vec<usize>> {
        let named = |name: &str| materials.iter().position(|material| material.name == name);
        let mut types = Vec::new();
        for (index, name) in self.types.iter().flatten().enumerate() {
            types.push(named(name).ok_or_else(|| {
                let names = materials.iter().map(|material| &material.name);
                at.reject(&format!("types[{index}]"), &must_be_one_of(names))
            })?);
        }
        let first = listing.counts_from;
        let of_kind = |kind: &String| {
            let number = kind.parse::<usize>().ok();
            let place = number.and_then(|number| number.checked_sub(first));
            let of_type = place.and_then(|place| types.get(place).copied());
            let alone = match self.types {
                Some(_) => None,
                None => alone,
            };
            of_type.or_else(|| named(kind)).or(alone).ok_or_else(|| {
                let names: Vec<&str> = materials.iter().map(|m| m.name.as_str()).collect();
                at.reject(
                    "types",
                    &format!(
                        "must name the material of each type of the file, in their order from {first} on: it has {}, and the scene {}; or give the group one `material`",
                        listing.kinds.join(", "),
                        names.join(", ")
                    ),
                )
            })
        };
        listing.kinds.iter().map(of_kind).collect()
    }
}

/// That a density or mass in the file is that of the material.
fn check_density(grain: &Listed, radius: f64, density: f64) -> std::result::Result<(), String> {
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    let told = grain.density.or(grain.mass.map(|mass| mass / volume));
    match told {
        Some(told) if !((told / density - 1.0).abs() <= DENSITY_ERROR) => Err(format!(
            "found a grain of {told:.4e} kg/m3; must be of the density of its material, {density:.4e} kg/m3; look at units and types, or leave the column out"
        )),
        _ => Ok(()),
    }
}
