//! Tables of a study file: those of a case file, each key with a value, a list or a range.

use super::axis::Axis;
use crate::Result;
use crate::case::scheme::SchemeTable;
use crate::document::Document;
use crate::document::keys::{self, Key, Kind, key, keys, table};
use crate::material::constant::{Constant, Dimension};
use crate::material::flow::{Spelling, WithFlow, YIELD_STRENGTH};
use crate::unit::{
    Angle, Density, Length, Pressure, Quantity, SpecificHeat, StrainRate, Temperature, Velocity,
};
use serde::{Deserialize, Deserializer};

/// The file as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyFile {
    pub samples: Option<Samples>,
    pub seed: Option<u64>,
    #[serde(default)]
    pub unusual: Vec<String>,
    particle: Option<ParticleTable>,
    material: Option<MaterialTable>,
    impact: Option<ImpactTable>,
    wall: Option<WallTable>,
    accuracy: Option<AccuracyTable>,
    pub scheme: Option<SchemeTable>,
    #[serde(default)]
    case: Vec<CaseTable>,
}

keys! {
    StudyFile
    "The tables of a case file. Each key holds a value, a list of values (every entry with every entry of the other lists), or a \
     range, `{ from = \"1 GPa\", to = \"100 GPa\", scale = \"log\" }`, for a Latin hypercube over all ranges together; `scale` is \
     `\"linear\"` where it is not named." {
        samples: samples_key(),
        seed: key("of the hypercube", "≥ 0", "1").or("0"),
        unusual: key("values that look like a slip of a unit and are meant all the same", "`particle.radius`, `impact.velocities`, or a number of `[material]` as `material.density`", "['particle.radius']").or("none"),
        particle: table("the particles").or(OR_EACH),
        material: table("their materials").or(OR_EACH),
        impact: table("speeds and angles").or(OR_EACH),
        wall: table("the rigid wall").or("frictionless"),
        accuracy: table("what the runs are planned for").or(OR_EACH),
        scheme: table("a published method in place of the crate's own, for all cases; as in a case file").or("the crate's own"),
        case: table("cases one by one: each has its own tables, and for keys that it does not name those above").or("none"),
    }
}

/// A number of cases, or a list of such.
#[derive(Debug, Deserialize)]
pub struct Samples(pub Axis<usize>);

impl keys::Value for Samples {
    fn kind() -> Kind {
        let list = Kind::List(Box::new(Kind::Whole));
        Kind::Either(Box::new(Kind::Whole), Box::new(list))
    }
}

const OR_EACH: &str = "every `[[case]]` has its own";

fn samples_key() -> keys::Line {
    key(
        "cases of the Latin hypercube; a list adds hypercubes to those that were run before",
        "≥ 1",
        "600",
    )
    .or("none: no ranges")
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseTable {
    name: Option<String>,
    particle: Option<ParticleTable>,
    material: Option<MaterialTable>,
    impact: Option<ImpactTable>,
    wall: Option<WallTable>,
    accuracy: Option<AccuracyTable>,
}

keys! {
    CaseTable {
        name: key("name in the results", "", "'lead'").or("the file's"),
        particle: table("the particle").or("that of the file"),
        material: table("its material").or("that of the file"),
        impact: table("speeds and angles").or("that of the file"),
        wall: table("the rigid wall").or("that of the file"),
        accuracy: table("what the runs are planned for").or("that of the file"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParticleTable {
    radius: Option<Axis<Quantity<Length>>>,
}

keys! {
    ParticleTable {
        radius: key("radius of the sphere", "> 0", "'250 um'").or(REQUIRED),
    }
}

/// Where a case may take the key from elsewhere, but has to have it.
const REQUIRED: &str = "required, here or in every `[[case]]`";

/// `yield_strength = ["1 MPa", "10 MPa"]`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct InAxes;

impl Spelling for InAxes {
    type Value = Axis<f64>;
    fn key(constant: &Constant) -> String {
        constant.key.to_owned()
    }
    fn described(constant: &Constant) -> Key {
        let one = constant.in_text();
        Key {
            kind: Kind::Axis(Box::new(one.kind)),
            ..one
        }
    }
    fn read<'de, D: Deserializer<'de>>(
        constant: &Constant,
        from: D,
    ) -> std::result::Result<Axis<f64>, D::Error> {
        match constant.dimension {
            Dimension::Number => Axis::deserialize(from),
            Dimension::Stress => Axis::<Quantity<Pressure>>::deserialize(from).map(|a| a.si()),
            Dimension::Rate => Axis::<Quantity<StrainRate>>::deserialize(from).map(|a| a.si()),
            Dimension::Temperature => {
                Axis::<Quantity<Temperature>>::deserialize(from).map(|a| a.si())
            }
            Dimension::SpecificHeat => {
                Axis::<Quantity<SpecificHeat>>::deserialize(from).map(|a| a.si())
            }
        }
    }
}

type MaterialTable = WithFlow<ElasticTable, InAxes>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticTable {
    density: Option<Axis<Quantity<Density>>>,
    young_modulus: Option<Axis<Quantity<Pressure>>>,
    poisson_ratio: Option<Axis<f64>>,
    young_over_yield: Option<Axis<f64>>,
    hardening_over_young: Option<Axis<f64>>,
}

keys! {
    ElasticTable {
        density: key("density", "> 0", "['1000 kg/m3', '8000 kg/m3']").or(REQUIRED),
        young_modulus: key("Young's modulus E", "> 0", "'100 GPa'").or(REQUIRED),
        poisson_ratio: key("Poisson's ratio", "[0, 0.5)", "0.35").or(REQUIRED),
        young_over_yield: key("E/Y, in place of `yield_strength`", "> 1", "{ from = 20, to = 2560, scale = 'log' }").or("none"),
        hardening_over_young: key("H/E, in place of `hardening_modulus`", "≥ 0", "[0, 0.01]").or("none"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ImpactTable {
    velocities: Option<Axis<Quantity<Velocity>>>,
    #[serde(rename = "rho_V2_over_Y")]
    severity: Option<Axis<f64>>,
    #[serde(rename = "V_over_Vy")]
    over_yield: Option<Axis<f64>>,
    angle: Option<Axis<Quantity<Angle>>>,
}

keys! {
    ImpactTable {
        velocities: key("impact speeds", "> 0, each once", "['10 m/s', '50 m/s']").or(REQUIRED),
        severity as "rho_V2_over_Y": key("ρV²/Y, in place of `velocities`", "> 0", "[0.01, 0.1, 1]").or("none"),
        over_yield as "V_over_Vy": key("speed over that of first yield, in place of `velocities`", "> 0", "[2, 20]").or("none"),
        angle: key("of the velocity from the wall's normal; above 0 with friction the impact is run in three dimensions", "0 to 85 deg", "'30 deg'").or("0"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WallTable {
    friction: Option<Axis<f64>>,
}

keys! {
    WallTable {
        friction: key("Coulomb's friction coefficient", "0 to 2", "0.3").or("0"),
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AccuracyTable {
    tolerance: Option<Axis<f64>>,
}

keys! {
    AccuracyTable {
        tolerance: key("error asked for: relative in F* and δ*, absolute in e", "(0, 0.2]", "0.02").or(REQUIRED),
    }
}

/// What an axis varies. The order is that of a study's cases: the last one changes fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Variable {
    Radius,
    Density,
    YoungModulus,
    Flow(Constant),
    YoungOverYield,
    HardeningOverYoung,
    PoissonRatio,
    Tolerance,
    Friction,
    Angle,
    Velocity,
    Severity,
    OverYield,
}

/// Key of the constant that `hardening_over_young` stands for.
pub const HARDENING: &str = "hardening_modulus";

impl Variable {
    /// What an axis stands for; two of the same cannot stand side by side.
    pub fn slot(&self) -> &'static str {
        match self {
            Variable::Radius => "particle.radius",
            Variable::Density => "material.density",
            Variable::YoungModulus => "material.young_modulus",
            Variable::YoungOverYield => YIELD_STRENGTH.key,
            Variable::HardeningOverYoung => HARDENING,
            Variable::Flow(constant) => constant.key,
            Variable::PoissonRatio => "material.poisson_ratio",
            Variable::Tolerance => "accuracy.tolerance",
            Variable::Friction => "wall.friction",
            Variable::Angle => "impact.angle",
            Variable::Velocity | Variable::Severity | Variable::OverYield => "impact.velocities",
        }
    }

    /// Whether `x` is allowed by itself, else what is.
    fn check(&self, document: &Document, key: &str, x: f64) -> Result<()> {
        let allowed: (&dyn Fn(f64) -> bool, &str) = match self {
            Variable::Radius
            | Variable::Density
            | Variable::YoungModulus
            | Variable::Velocity
            | Variable::Severity
            | Variable::OverYield => (&|x| x > 0.0, "must be positive"),
            Variable::YoungOverYield => (&|x| x > 1.0, "must be above 1"),
            Variable::HardeningOverYoung => (&|x| x >= 0.0, "must not be negative"),
            Variable::PoissonRatio => (&|x| (0.0..0.5).contains(&x), "must lie in [0, 0.5)"),
            Variable::Tolerance => (
                &|x| x > 0.0 && x <= 0.2,
                "must lie in (0, 0.2], e.g. 0.02 for two per cent",
            ),
            Variable::Friction => (&|x| (0.0..=2.0).contains(&x), "must lie in [0, 2]"),
            Variable::Angle => (
                &|x| (0.0..=85f64.to_radians()).contains(&x),
                "must lie in [0 deg, 85 deg], measured from the wall's normal",
            ),
            // its range depends on E: checked case by case
            Variable::Flow(_) => (&|_| true, ""),
        };
        document.check(key, x, allowed.0, allowed.1).map(drop)
    }
}

/// An axis with what it varies and its key.
#[derive(Debug, Clone, PartialEq)]
pub struct Named {
    pub variable: Variable,
    pub key: String,
    pub axis: Axis<f64>,
}

/// Cases that are made together: every list with every other, and the hypercube of the ranges.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Name of its cases; none for the file's.
    pub name: Option<String>,
    /// Dotted key of the table that made it; empty for the file.
    pub key: String,
    /// In the order of [`Variable`].
    pub axes: Vec<Named>,
}

/// Tables in which axes stand.
struct Tables<'a>(
    &'a Option<ParticleTable>,
    &'a Option<MaterialTable>,
    &'a Option<ImpactTable>,
    &'a Option<WallTable>,
    &'a Option<AccuracyTable>,
);

impl Tables<'_> {
    /// Axes of the tables below the dotted key `at`, in the order of [`Variable`].
    fn axes(&self, at: &str) -> Vec<Named> {
        let Tables(particle, material, impact, wall, accuracy) = self;
        let mut all = Vec::new();
        let mut add = |variable, key: &str, axis: Option<Axis<f64>>| {
            all.extend(axis.map(|axis| Named {
                variable,
                key: format!("{at}{key}"),
                axis,
            }));
        };
        let particle = particle.as_ref();
        let radius = particle.and_then(|p| p.radius.as_ref());
        add(Variable::Radius, "particle.radius", radius.map(Axis::si));
        if let Some(WithFlow { others, flow }) = material {
            let ElasticTable {
                density,
                young_modulus,
                poisson_ratio,
                young_over_yield,
                hardening_over_young,
            } = others;
            let density = density.as_ref().map(Axis::si);
            add(Variable::Density, "material.density", density);
            let young = young_modulus.as_ref().map(Axis::si);
            add(Variable::YoungModulus, "material.young_modulus", young);
            let ratio = young_over_yield.clone();
            add(Variable::YoungOverYield, "material.young_over_yield", ratio);
            for (constant, axis) in flow.named() {
                let key = format!("material.{}", constant.key);
                add(Variable::Flow(*constant), &key, Some(axis.clone()));
            }
            let ratio = hardening_over_young.clone();
            let key = "material.hardening_over_young";
            add(Variable::HardeningOverYoung, key, ratio);
            let poisson = poisson_ratio.clone();
            add(Variable::PoissonRatio, "material.poisson_ratio", poisson);
        }
        let accuracy = accuracy.as_ref();
        let tolerance = accuracy.and_then(|a| a.tolerance.clone());
        add(Variable::Tolerance, "accuracy.tolerance", tolerance);
        let friction = wall.as_ref().and_then(|w| w.friction.clone());
        add(Variable::Friction, "wall.friction", friction);
        if let Some(ImpactTable {
            velocities,
            severity,
            over_yield,
            angle,
        }) = impact
        {
            let angle = angle.as_ref().map(Axis::si);
            add(Variable::Angle, "impact.angle", angle);
            let velocities = velocities.as_ref().map(Axis::si);
            add(Variable::Velocity, "impact.velocities", velocities);
            add(Variable::Severity, "impact.rho_V2_over_Y", severity.clone());
            add(Variable::OverYield, "impact.V_over_Vy", over_yield.clone());
        }
        all
    }
}

impl StudyFile {
    /// What is run together: the file's own tables, or those of each `[[case]]` over them; every axis checked by itself.
    ///
    /// # Errors
    /// [`crate::Error::Value`] naming the key.
    pub fn blocks(&self, document: &Document) -> Result<Vec<Block>> {
        let StudyFile {
            samples: _,
            seed: _,
            unusual: _,
            particle,
            material,
            impact,
            wall,
            accuracy,
            scheme: _,
            case,
        } = self;
        let above = Tables(particle, material, impact, wall, accuracy).axes("");
        check_axes(document, &above)?;
        if case.is_empty() {
            return Ok(vec![Block {
                name: None,
                key: String::new(),
                axes: above,
            }]);
        }
        let block = |(i, table): (usize, &CaseTable)| {
            let key = format!("case[{i}]");
            let own = Tables(
                &table.particle,
                &table.material,
                &table.impact,
                &table.wall,
                &table.accuracy,
            )
            .axes(&format!("{key}."));
            check_axes(document, &own)?;
            let replaced = |named: &&Named| {
                let mut own = own.iter();
                own.any(|o| o.variable.slot() == named.variable.slot())
            };
            let kept = above.iter().filter(|named| !replaced(named));
            let mut axes: Vec<Named> = kept.chain(&own).cloned().collect();
            axes.sort_by_key(|named| order(&named.variable));
            if let Some(name) = &table.name
                && (name.trim().is_empty() || name.contains(char::is_control))
            {
                let allowed = "must be a name on one line";
                return Err(document.reject(&format!("{key}.name"), allowed));
            }
            Ok(Block {
                name: table.name.clone(),
                key,
                axes,
            })
        };
        case.iter().enumerate().map(block).collect()
    }
}

/// Place of a variable among the axes of a block.
fn order(variable: &Variable) -> usize {
    match variable {
        Variable::Radius => 0,
        Variable::Density => 1,
        Variable::YoungModulus => 2,
        Variable::YoungOverYield => 3,
        Variable::Flow(constant) if *constant == YIELD_STRENGTH => 3,
        Variable::Flow(_) => 4,
        Variable::HardeningOverYoung => 5,
        Variable::PoissonRatio => 6,
        Variable::Tolerance => 7,
        Variable::Friction => 8,
        Variable::Angle => 9,
        Variable::Velocity | Variable::Severity | Variable::OverYield => 10,
    }
}

/// That every axis holds something that is allowed, each value once, and none stands twice under two names.
fn check_axes(document: &Document, axes: &[Named]) -> Result<()> {
    for (i, named) in axes.iter().enumerate() {
        let before = &axes[..i];
        let same = |other: &&Named| other.variable.slot() == named.variable.slot();
        if let Some(other) = before.iter().find(same) {
            let allowed = format!("must not stand beside `{}`, which says the same", other.key);
            return Err(document.reject(&named.key, allowed));
        }
        let written = named.axis.written();
        if written.is_empty() {
            return Err(document.reject(&named.key, "must hold at least one value"));
        }
        for (k, (end, value)) in written.iter().enumerate() {
            let key = format!("{}{end}", named.key);
            named.variable.check(document, &key, *value)?;
            let twice = written[..k].iter().any(|(_, before)| before == value);
            if twice && matches!(named.axis, Axis::List(_)) {
                return Err(document.reject(&key, "must be given once"));
            }
        }
        if let Axis::Range(ends) = named.axis
            && let Some(wrong) = ends.wrong()
        {
            return Err(document.reject(&named.key, wrong));
        }
    }
    Ok(())
}
