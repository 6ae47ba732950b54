//! Stages as they are written, and the order they must follow.

use super::at::{At, check_name};
use super::drive::{BeltTable, DrivenTable};
use super::stage::{Change, Duration, Move, RunStage, Stage, Until};
use crate::Result;
use crate::dem::bodies::motion::Motion;
use crate::dem::force::named::Constants;
use crate::document::Document;
use crate::document::keys::{key, keys, table};
use crate::error::must_be_one_of;
use crate::unit::{Energy, Force, Length, Pressure, Quantity, Time, Velocity};
use parry3d::math::Vector;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Stage as it is written.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum StageTable {
    Settle {
        stiffness: Option<f64>,
        friction: Option<f64>,
        restitution: Option<f64>,
        longest: Quantity<Time>,
        rest_speed: Quantity<Velocity>,
    },
    Relax {
        steps: u64,
    },
    Compress {
        speed: Quantity<Velocity>,
        approach: Option<Quantity<Velocity>>,
        seating_stress: Quantity<Pressure>,
        seating_travel: Option<Quantity<Length>>,
        strain: f64,
    },
    Unload {
        speed: Quantity<Velocity>,
    },
    Run(RunTable),
}

keys! {
    enum StageTable by "kind" {
        Settle as "settle" "Fall and come to rest; the packing all laws start from. Contacts are elastic meanwhile, and may be softer than true." {
            stiffness: key("contact stiffness over that of the material", "(0, 1]", "1e-3").or("of `[contact]`"),
            friction: key("friction meanwhile: little packs densely", "≥ 0", "0.0").or("of `[contact]`"),
            restitution: key("restitution meanwhile: a low one settles quickly", "(0, 1]", "0.3").or("of `[contact]`"),
            longest: key("it ends then in any case", "> 0", "'100 ms'"),
            rest_speed: key("root mean square speed below which the bed is at rest", "> 0", "'2 mm/s'"),
        }
        Relax as "relax" "After a softer `settle`: raises the stiffness to that of the scene." {
            steps: key("time steps it takes", "≥ 1", "4000"),
        }
        Compress as "compress" "Lowers the piston of the box." {
            speed: key("of the piston", "> 0", "'0.5 m/s'"),
            approach: key("speed of the piston without resistance; falls to `speed` as its stress comes up to `seating_stress`", "≥ `speed`", "'0.5 m/s'").or("`speed`"),
            seating_stress: key("stress from which strain counts", "> 0", "'50 kPa'"),
            seating_travel: key("travel over which that stress must be sustained", "> 0", "'125 um'").or("none"),
            strain: key("strain at which the stage ends", "(0, 0.2]", "0.035"),
        }
        Unload as "unload" "Raises the piston until it carries nothing." {
            speed: key("of the piston", "> 0", "'0.5 m/s'"),
        }
    } and {
        Run as "run" (RunTable)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RunTable {
    name: Option<String>,
    duration: Option<Quantity<Time>>,
    steps: Option<u64>,
    #[serde(default)]
    insert: Vec<String>,
    #[serde(default, rename = "move")]
    moves: Vec<MoveTable>,
    #[serde(default)]
    until: UntilTable,
}

keys! {
    RunTable "Goes on, with changes at its start, until the time is over or a condition holds." {
        name: key("name in files", "", "'discharge'").or("`\"run\"`"),
        duration: key("longest duration", "> 0", "'2 s'").or("or `steps`"),
        steps: key("longest duration, in time steps", "≥ 1", "2000").or("or `duration`"),
        insert: key("groups that come in from its start on", "of groups", "['shot']").or("none"),
        moves as "move": table("changes of bodies at its start").or("none"),
        until: table("conditions that end it earlier, any of them").or("none"),
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MoveTable {
    body: String,
    driven: Option<DrivenTable>,
    belt: Option<BeltTable>,
    #[serde(default)]
    stop: bool,
    #[serde(default)]
    remove: bool,
    #[serde(default)]
    release: bool,
}

keys! {
    MoveTable "One change a table." {
        body: key("the body", "of a body or wall", "'gate'"),
        driven: table("goes on with this motion").or("one change"),
        belt: table("its surface goes on with this motion; `{}` stops it").within("a body that is a belt").or("one change"),
        stop: key("stands still", "", "true").or("false"),
        remove: key("is taken out of the bed", "", "true").or("false"),
        release: key("is let go", "a held body", "true").or("false"),
    }
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct UntilTable {
    rest_speed: Option<Quantity<Velocity>>,
    kinetic_energy: Option<Quantity<Energy>>,
    stress: Option<Quantity<Pressure>>,
    force: Option<ForceTable>,
    flow_ended: Option<Quantity<Time>>,
}

keys! {
    UntilTable {
        rest_speed: key("all grains are in and their root mean square speed is below", "> 0", "'2 mm/s'").or("none"),
        kinetic_energy: key("all grains are in and their kinetic energy is below", "> 0", "'2 uJ'").or("none"),
        stress: key("the stress on the box's piston is above", "> 0", "'1 MPa'").or("none"),
        force: table("the force of the grains on a body is above").or("none"),
        flow_ended: key("for this time no grain has gone through the plane of the measure `flow`, after the first one", "> 0", "'0.1 s'").or("none"),
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct ForceTable {
    body: String,
    above: Quantity<Force>,
}

keys! {
    ForceTable {
        body: key("the body", "of a body or wall", "'plate'"),
        above: key("the force", "> 0", "'2.5 N'"),
    }
}

/// What stages refer to.
pub(super) struct Cast<'a> {
    /// Effects where a stage says nothing.
    pub(super) contact: &'a Constants,
    /// Names of the bodies, box walls included.
    pub(super) bodies: Vec<String>,
    /// Origins (m) of the scene's own bodies.
    pub(super) centres: BTreeMap<String, Vector>,
    /// Names of the groups of grains.
    pub(super) groups: Vec<String>,
    /// Whether there is a box.
    pub(super) boxed: bool,
}

/// Checks stages one by one and their order.
pub(super) fn check_stages(
    document: &Document,
    stages: Vec<StageTable>,
    cast: &Cast,
) -> Result<Vec<Stage>> {
    let mut checked: Vec<Stage> = Vec::new();
    for (index, table) in stages.into_iter().enumerate() {
        let at = format!("stage[{index}]");
        let stage = table.check(document, &at, cast)?;
        let order_holds = match (checked.last(), &stage) {
            (None, Stage::Settle { .. } | Stage::Compress { .. } | Stage::Run(_)) => true,
            (Some(last), Stage::Relax { .. }) => matches!(last, Stage::Settle { .. }),
            (Some(last), Stage::Compress { .. }) => !matches!(last, Stage::Compress { .. }),
            (Some(last), Stage::Unload { .. }) => matches!(last, Stage::Compress { .. }),
            (Some(_), Stage::Run(_)) => true,
            _ => false,
        };
        if !order_holds {
            let before = match checked.last() {
                Some(last) => format!("after \"{}\"", last.name()),
                None => "first".to_owned(),
            };
            let order = format!(
                "must not come {before}: the order is settle, relax right after it, then run, compress and unload as often as wanted, \
                 unload after compress"
            );
            return Err(document.reject(&format!("{at}.kind"), order));
        }
        if matches!(stage, Stage::Compress { .. }) && !cast.boxed {
            let allowed = "needs a `[box]`, whose piston compresses the bed; or move a body of your own in a stage \"run\"";
            return Err(document.reject(&format!("{at}.kind"), allowed));
        }
        checked.push(stage);
    }
    check_preparation(document, &checked, cast.contact)?;
    Ok(checked)
}

/// That a packing made with softer contacts is brought to the scene's stiffness.
fn check_preparation(document: &Document, stages: &[Stage], contact: &Constants) -> Result<()> {
    match stages.first() {
        None => Err(document.reject("stage", "must hold at least one stage")),
        Some(Stage::Settle { stiffness, .. }) if *stiffness > contact.softening() => {
            let allowed = format!(
                "must be at most {}, the stiffness of the contacts of the scene (`contact.stiffness`)",
                contact.softening()
            );
            Err(document.reject("stage[0].stiffness", allowed))
        }
        Some(Stage::Settle { stiffness, .. })
            if *stiffness < contact.softening()
                && !matches!(stages.get(1), Some(Stage::Relax { .. })) =>
        {
            let allowed = "must have a stage \"relax\" after the softer stage \"settle\", which raises the stiffness";
            Err(document.reject("stage", allowed))
        }
        _ => Ok(()),
    }
}

impl StageTable {
    fn check(self, document: &Document, key: &str, cast: &Cast) -> Result<Stage> {
        let at = At { document, key };
        Ok(match self {
            StageTable::Settle {
                stiffness,
                friction,
                restitution,
                longest,
                rest_speed,
            } => Stage::Settle {
                stiffness: document.check(
                    &at.name("stiffness"),
                    stiffness.unwrap_or(cast.contact.softening()),
                    |s| s > 0.0 && s <= 1.0,
                    "must lie in (0, 1]",
                )?,
                contact: settling_contact(&at, friction, restitution, cast.contact)?,
                longest: at.positive("longest", longest)?,
                rest_speed: at.positive("rest_speed", rest_speed)?,
            },
            StageTable::Relax { steps } => Stage::Relax {
                steps: at_least_one(&at, steps)?,
            },
            StageTable::Compress {
                speed,
                approach,
                seating_stress,
                seating_travel,
                strain,
            } => Stage::Compress {
                speed: at.positive("speed", speed)?,
                approach: match approach {
                    Some(approach) => document.check(
                        &at.name("approach"),
                        at.positive("approach", approach)?,
                        |approach| approach >= speed.si(),
                        "must be at least `speed`: the piston slows down as it meets the grains",
                    )?,
                    None => speed.si(),
                },
                seating_stress: at.positive("seating_stress", seating_stress)?,
                seating_travel: some(&at, "seating_travel", seating_travel)?.unwrap_or(0.0),
                strain: document.check(
                    &at.name("strain"),
                    strain,
                    |s| s > 0.0 && s <= 0.2,
                    "must lie in (0, 0.2]",
                )?,
            },
            StageTable::Unload { speed } => Stage::Unload {
                speed: at.positive("speed", speed)?,
            },
            StageTable::Run(run) => Stage::Run(run.check(&at, cast)?),
        })
    }
}

impl RunTable {
    fn check(self, at: &At, cast: &Cast) -> Result<RunStage> {
        let (document, key) = (at.document, at.key);
        if let Some(name) = &self.name {
            check_name(document, &at.name("name"), name)?;
        }
        Ok(RunStage {
            name: self.name.unwrap_or_else(|| "run".to_owned()),
            insert: self
                .insert
                .iter()
                .map(|group| all_of(at, "insert", group, &cast.groups))
                .collect::<Result<Vec<_>>>()?
                .concat(),
            moves: self
                .moves
                .into_iter()
                .enumerate()
                .map(|(index, table)| {
                    let key = format!("{key}.move[{index}]");
                    table.check(document, &key, cast)
                })
                .collect::<Result<_>>()?,
            longest: longest(at, self.duration, self.steps)?,
            until: self.until.check(document, &at.name("until"), cast)?,
        })
    }
}

fn some<D>(at: &At, name: &str, quantity: Option<Quantity<D>>) -> Result<Option<f64>> {
    quantity.map(|q| at.positive(name, q)).transpose()
}

fn one_of(at: &At, name: &str, wanted: &str, names: &[String]) -> Result<usize> {
    let place = names.iter().position(|name| name == wanted);
    place.ok_or_else(|| at.reject(name, &must_be_one_of(names)))
}

/// Places of all that have a name: a file of several materials is several groups of one.
fn all_of(at: &At, name: &str, wanted: &str, names: &[String]) -> Result<Vec<usize>> {
    let first = one_of(at, name, wanted, names)?;
    Ok((first..names.len())
        .filter(|&k| names[k] == wanted)
        .collect())
}

fn at_least_one(at: &At, steps: u64) -> Result<u64> {
    match steps {
        0 => Err(at.document.reject(&at.name("steps"), "must be at least 1")),
        steps => Ok(steps),
    }
}

fn longest(at: &At, duration: Option<Quantity<Time>>, steps: Option<u64>) -> Result<Duration> {
    match (duration, steps) {
        (Some(duration), None) => Ok(Duration::Time(at.positive("duration", duration)?)),
        (None, Some(steps)) => Ok(Duration::Steps(at_least_one(at, steps)?)),
        _ => Err(at.document.reject(
            &at.name("duration"),
            "must say how long the stage may last: either `duration` or `steps`",
        )),
    }
}

fn settling_contact(
    at: &At,
    friction: Option<f64>,
    restitution: Option<f64>,
    contact: &Constants,
) -> Result<Constants> {
    let check = |name: &str, value: Option<f64>, holds: fn(f64) -> bool, must: &str| {
        value
            .map(|value| at.document.check(&at.name(name), value, holds, must))
            .transpose()
    };
    let friction = check("friction", friction, |mu| mu >= 0.0, "must not be negative")?;
    let restitution = check(
        "restitution",
        restitution,
        |e| e > 0.0 && e <= 1.0,
        "must lie in (0, 1]",
    )?;
    Ok(Constants {
        friction: friction.or(contact.friction).filter(|mu| *mu > 0.0),
        rolling: None,
        restitution: restitution.or(contact.restitution),
        stiffness: contact.stiffness,
    })
}

impl MoveTable {
    fn check(self, document: &Document, key: &str, cast: &Cast) -> Result<Move> {
        let at = At { document, key };
        one_of(&at, "body", &self.body, &cast.bodies)?;
        let wanted = [self.stop, self.remove, self.release];
        let change = match (&self.driven, &self.belt, wanted) {
            (Some(driven), None, [false, false, false]) => {
                Change::Drive(driven.check(document, &at.name("driven"))?)
            }
            (None, Some(belt), [false, false, false]) => {
                let centre = cast.centres.get(&self.body);
                let centre = centre.copied().unwrap_or(Vector::ZERO);
                Change::Belt(belt.check(document, &at.name("belt"), centre)?)
            }
            (None, None, [true, false, false]) => Change::Drive(Motion::default()),
            (None, None, [false, true, false]) => Change::Remove,
            (None, None, [false, false, true]) => Change::Release,
            _ => {
                let allowed = "must hold one change: `driven = {...}`, `belt = {...}`, `stop = true`, `remove = true` or `release = true`";
                return Err(document.reject(key, allowed));
            }
        };
        Ok(Move {
            body: self.body,
            change,
        })
    }
}

impl UntilTable {
    fn check(self, document: &Document, key: &str, cast: &Cast) -> Result<Until> {
        let at = At { document, key };
        if self.stress.is_some() && !cast.boxed {
            let allowed =
                "needs a `[box]`, whose piston it is the stress on; or use `force` on a body";
            return Err(document.reject(&at.name("stress"), allowed));
        }
        let force = match self.force {
            Some(force) => {
                one_of(&at, "force.body", &force.body, &cast.bodies)?;
                let above = at.positive("force.above", force.above)?;
                Some((force.body, above))
            }
            None => None,
        };
        Ok(Until {
            rest_speed: some(&at, "rest_speed", self.rest_speed)?,
            kinetic_energy: some(&at, "kinetic_energy", self.kinetic_energy)?,
            stress: some(&at, "stress", self.stress)?,
            force,
            flow_ended: some(&at, "flow_ended", self.flow_ended)?,
        })
    }
}
