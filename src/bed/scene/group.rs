//! Groups of grains: how many, how large, of what, and how they come into the bed.

use super::at::{At, check_name};
use super::body::Files;
use super::given::{FileTable, Given};
use super::material::GrainMaterial;
use super::region::Region;
use super::region::RegionTable;
use super::sizes::Sizes;
use super::written::OneOrMany;
use super::written::vector;
use crate::Result;
use crate::document::Document;
use crate::document::keys::{key, keys, names, table};
use crate::error::must_be_one_of;
use crate::unit::{Length, Mass, MassRate, Quantity, Velocity};
use parry3d::math::Vector;
use serde::Deserialize;
use std::sync::Arc;

/// Grains of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Name, by which stages insert it.
    pub name: String,
    /// Dotted key of its table.
    pub key: String,
    /// How many.
    pub amount: Amount,
    /// How large.
    pub sizes: Sizes,
    /// Index into the scene's materials.
    pub material: usize,
    /// How they come in.
    pub insertion: Insertion,
    /// Where; the container if none.
    pub region: Option<Region>,
    /// Their places, if a file lists them; they come in all at once then, as a lattice does.
    pub given: Option<Arc<Given>>,
    /// Velocity they come in with, m/s; on top of that of their file.
    pub velocity: Vector,
    /// Root mean square of the random velocities on top, along each axis, m/s.
    pub stir: f64,
}

/// Amount of grains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// Number.
    Count(usize),
    /// Mass, kg, reached by the last grain.
    Mass(f64),
}

/// How grains come in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Insertion {
    /// All at once, on a lattice with each grain a little off its place.
    Lattice,
    /// Lattices that fill the region, each once the one before has left it, until the amount is reached.
    Pour,
    /// One by one at random places of the region, at a rate in kg/s.
    Stream(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum InsertionName {
    Lattice,
    Pour,
    Stream,
}

names! { InsertionName { Lattice as "lattice", Pour as "pour", Stream as "stream", } }

/// Table `[grains]` or `[[grains]]` as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GroupTable {
    name: Option<String>,
    count: Option<usize>,
    mass: Option<Quantity<Mass>>,
    radius: Option<Quantity<Length>>,
    spread: Option<f64>,
    sieve: Option<Vec<SieveTable>>,
    lognormal: Option<LogNormalTable>,
    material: Option<String>,
    insertion: Option<InsertionName>,
    rate: Option<Quantity<MassRate>>,
    region: Option<RegionTable>,
    velocity: Option<[Quantity<Velocity>; 3]>,
    stir: Option<Quantity<Velocity>>,
    file: Option<FileTable>,
}

keys! {
    GroupTable "Also as a list, `[[grains]]`, one table a group. A group that a stage names in `insert` comes in from then on, every other one from the start." {
        name: key("name, for `insert`; wanted where there are several groups", "each once", "'shot'").or("`\"grains\"`"),
        count: key("number of grains", "≥ 1", "800").or("or `mass`"),
        mass: key("mass, reached by the last grain", "> 0", "'5 g'").or("or `count`"),
        radius: key("radius, or its mean", "> 0", "'250 um'").or("one way of three"),
        spread: key("evenly spread radii: share of `radius` up and down", "[0, 0.5)", "0.1").or("0"),
        sieve: table("sizes as sieve classes").within("at least one").or("one way of three"),
        lognormal: table("sizes with a normal logarithm, cut off at both ends").or("one way of three"),
        material: key("material of the grains", "one of `materials`", "'steel'").or("the only one"),
        insertion: key("all at once; lattice after lattice as room becomes free; one by one at a rate", "`\"lattice\"`, `\"pour\"`, `\"stream\"`", "'pour'").or("`\"lattice\"`"),
        rate: key("mass that comes in a second", "> 0", "'5 g/s'").or("required for a stream"),
        region: table("where they come in; grains begin wholly inside").or("the box (lattice only)"),
        velocity: key("they come in with", "", "['0 m/s', '0 m/s', '-1 m/s']").or("0"),
        stir: key("root mean square of random velocities on top, along each axis", "≥ 0", "'0.2 m/s'").or("0"),
        file: table("a file that lists the grains and their places; leaves of the keys above name, radius, material, velocity and stir").or("none"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SieveTable {
    radius: Quantity<Length>,
    share: f64,
}

keys! {
    SieveTable {
        radius: key("radius of the class", "> 0", "'1 mm'"),
        share: key("its share of the mass; shares need not add up to 1", "> 0", "0.3"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LogNormalTable {
    median: Quantity<Length>,
    deviation: f64,
    smallest: Quantity<Length>,
    largest: Quantity<Length>,
}

keys! {
    LogNormalTable {
        median: key("median radius", "> 0", "'1 mm'"),
        deviation: key("standard deviation of the logarithm of the radius", "(0, 1]", "0.2"),
        smallest: key("where it is cut off below", "> 0, < median", "'0.6 mm'"),
        largest: key("where it is cut off above", "> median, ≤ 20 × smallest", "'1.6 mm'"),
    }
}

pub(super) fn check_groups(
    document: &Document,
    tables: OneOrMany<GroupTable>,
    materials: &[GrainMaterial],
    files: &mut Files,
) -> Result<Vec<Group>> {
    let mut groups: Vec<Group> = Vec::new();
    for (key, table) in tables.keyed("grains") {
        let these = match &table.file {
            Some(file) => table.listed(file, document, &key, materials, files)?,
            None => vec![table.check(document, &key, materials)?],
        };
        for group in &these {
            check_name(document, &format!("{key}.name"), &group.name)?;
            if groups.iter().any(|other| other.name == group.name) {
                let key = format!("{key}.name");
                return Err(document.reject(&key, "must be given, and another one for every group"));
            }
        }
        groups.extend(these);
    }
    if groups.is_empty() {
        return Err(document.reject("grains", "must hold at least one group of grains"));
    }
    Ok(groups)
}

impl GroupTable {
    /// Groups of the grains of a file, one for each material, all of one name.
    fn listed(
        &self,
        file: &FileTable,
        document: &Document,
        key: &str,
        materials: &[GrainMaterial],
        files: &mut Files,
    ) -> Result<Vec<Group>> {
        let GroupTable {
            name,
            count,
            mass,
            radius,
            spread,
            sieve,
            lognormal,
            material,
            insertion,
            rate,
            region,
            velocity,
            stir,
            file: _,
        } = self;
        let at = |name: &str| format!("{key}.{name}");
        let told = [
            ("count", count.is_some()),
            ("mass", mass.is_some()),
            ("spread", spread.is_some()),
            ("sieve", sieve.is_some()),
            ("lognormal", lognormal.is_some()),
            ("insertion", insertion.is_some()),
            ("rate", rate.is_some()),
            ("region", region.is_some()),
        ];
        if let Some((name, _)) = told.iter().find(|(_, told)| *told) {
            let allowed = "must not stand beside `file`, which lists the grains and their places";
            return Err(document.reject(&at(name), allowed));
        }
        let radius = radius
            .map(|radius| document.positive(&at("radius"), radius))
            .transpose()?;
        let alone = match material {
            None if materials.len() > 1 => None,
            _ => Some(self.material(document, key, materials)?),
        };
        let stir = stir.map_or(Ok(0.0), |stir| document.non_negative(&at("stir"), stir))?;
        let key_of_file = at("file");
        let place = At {
            document,
            key: &key_of_file,
        };
        let given = file.check(&place, materials, alone, radius, files)?;
        let group = |(material, given): (usize, Given)| {
            let radii = given.grains.iter().map(|grain| grain.radius).collect();
            Group {
                name: name.clone().unwrap_or_else(|| "grains".to_owned()),
                key: key.to_owned(),
                amount: Amount::Count(given.grains.len()),
                sizes: Sizes::listed(radii),
                material,
                insertion: Insertion::Lattice,
                region: None,
                given: Some(Arc::new(given)),
                velocity: velocity.map_or(Vector::ZERO, vector),
                stir,
            }
        };
        let groups: Vec<Group> = given.into_iter().map(group).collect();
        check_span(&groups, document, &key_of_file)?;
        Ok(groups)
    }

    fn check(self, document: &Document, key: &str, materials: &[GrainMaterial]) -> Result<Group> {
        let at = |name: &str| format!("{key}.{name}");
        let insertion = self.insertion(document, key)?;
        let region = match &self.region {
            Some(region) => Some(region.check(document, &at("region"))?),
            None if insertion == Insertion::Lattice => None,
            None => {
                let allowed = "must say where the grains come in: `low` and `high`, or `base`, `radius` and `height`";
                return Err(document.reject(&at("region"), allowed));
            }
        };
        Ok(Group {
            name: self.name.clone().unwrap_or_else(|| "grains".to_owned()),
            key: key.to_owned(),
            amount: self.amount(document, key)?,
            sizes: self.sizes(document, key)?,
            material: self.material(document, key, materials)?,
            insertion,
            region,
            given: None,
            velocity: self.velocity.map_or(Vector::ZERO, vector),
            stir: self
                .stir
                .map_or(Ok(0.0), |stir| document.non_negative(&at("stir"), stir))?,
        })
    }

    fn amount(&self, document: &Document, key: &str) -> Result<Amount> {
        match (self.count, self.mass) {
            (Some(0), None) => Err(document.reject(&format!("{key}.count"), "must be at least 1")),
            (Some(count), None) => Ok(Amount::Count(count)),
            (None, Some(mass)) => {
                let mass = document.positive(&format!("{key}.mass"), mass)?;
                Ok(Amount::Mass(mass))
            }
            _ => Err(document.reject(key, "must hold either `count` or `mass`")),
        }
    }

    fn sizes(&self, document: &Document, key: &str) -> Result<Sizes> {
        let at = |name: &str| format!("{key}.{name}");
        let one_of = "must give the sizes in one way: `radius` (with `spread`, if wanted), `sieve` or `lognormal`";
        let sizes = match (self.radius, &self.sieve, &self.lognormal) {
            (Some(radius), None, None) => Sizes::Uniform {
                mean: document.positive(&at("radius"), radius)?,
                spread: document.check(
                    &at("spread"),
                    self.spread.unwrap_or(0.0),
                    |s| (0.0..0.5).contains(&s),
                    "must lie in [0, 0.5)",
                )?,
            },
            (None, Some(classes), None) if !classes.is_empty() => {
                let mut by_mass = Vec::new();
                for (index, class) in classes.iter().enumerate() {
                    let at = |name: &str| format!("{key}.sieve[{index}].{name}");
                    let radius = document.positive(&at("radius"), class.radius)?;
                    let must = "must be positive: the class's share of the mass";
                    let share = document.check(&at("share"), class.share, |s| s > 0.0, must)?;
                    by_mass.push((radius, share));
                }
                Sizes::sieve(&by_mass)
            }
            (None, None, Some(table)) => table.check(document, &at("lognormal"))?,
            _ => return Err(document.reject(key, one_of)),
        };
        if self.spread.is_some() && self.radius.is_none() {
            return Err(document.reject(&at("spread"), "needs `radius` beside it"));
        }
        match spans_too_much(sizes.limits()) {
            true => {
                let [low, high] = sizes.limits();
                let allowed = format!("{SPAN}; the radii go from {low:.3e} to {high:.3e} m");
                Err(document.reject(key, allowed))
            }
            false => Ok(sizes),
        }
    }

    fn material(
        &self,
        document: &Document,
        key: &str,
        materials: &[GrainMaterial],
    ) -> Result<usize> {
        let key = format!("{key}.material");
        let refusal = || {
            let names = materials.iter().map(|material| &material.name);
            document.reject(&key, must_be_one_of(names))
        };
        match &self.material {
            None if materials.len() == 1 => Ok(0),
            None => Err(refusal()),
            Some(name) => materials
                .iter()
                .position(|material| material.name == *name)
                .ok_or_else(refusal),
        }
    }

    fn insertion(&self, document: &Document, key: &str) -> Result<Insertion> {
        let key = format!("{key}.rate");
        match (self.insertion.unwrap_or(InsertionName::Lattice), self.rate) {
            (InsertionName::Stream, Some(rate)) => {
                Ok(Insertion::Stream(document.positive(&key, rate)?))
            }
            (InsertionName::Stream, None) => Err(document.reject(
                &key,
                "must be there: the mass that comes in a second, e.g. \"5 g/s\"",
            )),
            (_, Some(_)) => Err(document.reject(&key, "belongs to `insertion = \"stream\"`")),
            (InsertionName::Lattice, None) => Ok(Insertion::Lattice),
            (InsertionName::Pour, None) => Ok(Insertion::Pour),
        }
    }
}

/// What sizes must be.
const SPAN: &str =
    "must span at most a factor of 20: neighbours are searched in cells of the largest grain";

fn spans_too_much([smallest, largest]: [f64; 2]) -> bool {
    largest > 20.0 * smallest
}

/// That the grains of a file are not too different in size.
fn check_span(groups: &[Group], document: &Document, key: &str) -> Result<()> {
    let limits = groups.iter().map(|group| group.sizes.limits());
    let limits = limits.fold([f64::INFINITY, 0.0f64], |[low, high], [a, b]| {
        [low.min(a), high.max(b)]
    });
    match spans_too_much(limits) {
        true => {
            let [low, high] = limits;
            let allowed = format!("{SPAN}; the file has radii from {low:.3e} to {high:.3e} m");
            Err(document.reject(&format!("{key}.path"), allowed))
        }
        false => Ok(()),
    }
}

impl LogNormalTable {
    fn check(&self, document: &Document, key: &str) -> Result<Sizes> {
        let at = |name: &str| format!("{key}.{name}");
        let median = document.positive(&at("median"), self.median)?;
        let deviation = document.check(
            &at("deviation"),
            self.deviation,
            |d| d > 0.0 && d <= 1.0,
            "must lie in (0, 1]: the standard deviation of the logarithm of the radius",
        )?;
        let smallest = document.check(
            &at("smallest"),
            self.smallest.si(),
            |r| r > 0.0 && r < median,
            "must be positive and below the median",
        )?;
        let largest = document.check(
            &at("largest"),
            self.largest.si(),
            |r| r > median,
            "must be above the median",
        )?;
        Ok(Sizes::LogNormal {
            median,
            deviation,
            limits: [smallest, largest],
        })
    }
}
