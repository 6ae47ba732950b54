//! Show: the results of a run turned into the plain data that the report takes.

mod bed;
pub mod chapter;
pub(crate) mod discover;
pub(crate) mod equations;
mod impacts;
pub(crate) mod inverse;
mod law;
pub(crate) mod study;
pub(crate) mod tester;
pub(crate) mod thesis;
pub(crate) mod validate;

pub use bed::bed;
pub use impacts::{Shown, choices, curves, maps};
pub use law::fit;

use crate::Result;
use crate::contact::rebound::rebound;
use crate::contact::{LawVisitor, NormalLaw};
use crate::law::{AnyLaw, LawFile};
use crate::material::Material;
use crate::report::page::Block;
use crate::report::palette::{self, Role};
use crate::report::table::Table;
use crate::theory::Theory;

const _: () = assert!(
    Theory::ALL.len() <= palette::THEORIES.len(),
    "every theory needs an ink of its own: add one to `palette::THEORIES`"
);

/// A law with the name and the rank it has in figures.
pub struct NamedLaw {
    /// Name in legends.
    pub name: String,
    /// Ours, or one of the theories.
    pub role: Role,
    /// The law.
    pub law: AnyLaw,
}

/// The fitted law, then every theory that the material allows and comparisons show unasked.
///
/// # Errors
/// As [`LawFile::law`].
pub fn laws(file: &LawFile, material: &Material) -> Result<Vec<NamedLaw>> {
    let mut laws = vec![NamedLaw {
        name: "fitted".to_owned(),
        role: Role::Law,
        law: AnyLaw::Fitted(file.law()?),
    }];
    laws.extend(Theory::compared(material).map(|theory| NamedLaw {
        name: theory.name().to_owned(),
        role: Role::Theory(theory.place()),
        law: AnyLaw::Theory(theory, *material),
    }));
    Ok(laws)
}

/// The fitted law of a pair, every theory that is stated for two bodies and shown unasked, then `others` under their names.
///
/// # Errors
/// As [`LawFile::law`].
pub fn laws_of_pair<'a>(
    file: &LawFile,
    effective: &Material,
    others: impl Iterator<Item = (&'static str, &'a AnyLaw)>,
) -> Result<Vec<NamedLaw>> {
    let of_pairs =
        |law: &NamedLaw| !matches!(law.law, AnyLaw::Theory(theory, _) if !theory.is_of_pairs());
    let mut laws: Vec<NamedLaw> = laws(file, effective)?
        .into_iter()
        .filter(of_pairs)
        .collect();
    laws.extend(others.map(|(name, law)| NamedLaw {
        name: name.to_owned(),
        role: Role::Other,
        law: law.clone(),
    }));
    Ok(laws)
}

/// A sphere about to hit the wall.
#[derive(Debug, Clone, Copy)]
pub struct Sphere {
    /// R, m.
    pub radius: f64,
    /// m, kg.
    pub mass: f64,
}

/// Points on each branch of a drawn curve.
const BRANCH: u32 = 120;

/// Force against displacement of a law in its own impact at a speed (m/s): up to its turning point and back.
struct Loop(Sphere, f64);

impl LawVisitor for Loop {
    type Output = Vec<(f64, f64)>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        let Loop(Sphere { radius, mass }, velocity) = self;
        let turn = rebound(law, radius, mass, velocity).max_displacement;
        if !turn.is_finite() {
            return Vec::new();
        }
        let mut history = L::History::default();
        let mut points = Vec::new();
        for i in (0..=BRANCH).chain((0..BRANCH).rev()) {
            let delta = turn * f64::from(i) / f64::from(BRANCH);
            let force = radius * radius * law.force(delta / radius, &mut history);
            points.push((delta, force));
            // Contact is lost on the way back; what is left of the way is flight.
            if force <= 0.0 && points.len() > BRANCH as usize {
                break;
            }
        }
        points
    }
}

/// Impact of a law at a speed.
#[derive(Debug, Clone, Copy)]
struct Bounce {
    /// m/s.
    velocity: f64,
    /// e.
    restitution: f64,
    /// Largest displacement, m.
    displacement: f64,
}

/// Impacts of a law at each of some speeds (m/s).
struct Restitution<'a>(Sphere, &'a [f64]);

impl LawVisitor for Restitution<'_> {
    type Output = Vec<Bounce>;

    fn visit<L: NormalLaw>(self, law: &L) -> Self::Output {
        let Restitution(Sphere { radius, mass }, speeds) = self;
        let at = |&velocity: &f64| {
            let hit = rebound(law, radius, mass, velocity);
            Bounce {
                velocity,
                restitution: hit.restitution,
                displacement: hit.max_displacement,
            }
        };
        speeds.iter().map(at).collect()
    }
}

/// Largest flattening a law's source supports.
struct ValidTo;

impl LawVisitor for ValidTo {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        law.valid_to()
    }
}

/// What stars, empty cells and column names of the comparison mean.
const EXPLAINED: &str = "Each law makes the same impacts by itself. Errors are those of its F*, δ* (relative), δ_res (over δ*), e and \
    contact time (relative); overall is their root mean square. RMSE is the root mean square of its force less the simulated \
    one, at the simulated displacements, over F*. All in per cent. A star marks a law that some of these impacts take beyond \
    what its source supports. The simulation, mpm, has no errors: its cells are empty. An empty cell among the authors’ \
    formulas: the formula does not hold at that speed.";

/// The comparison's Markdown as tables: those over all speeds open, those of single speeds folded.
#[must_use]
pub fn comparison(markdown: &str) -> Vec<Block> {
    let typeset = |text: &String| {
        let text = text
            .replace("delta", "δ")
            .replace(" um", " µm")
            .replace(" us", " µs");
        text.replace(
            '-',
            if text.starts_with('-') {
                "\u{2212}"
            } else {
                "-"
            },
        )
    };
    let mut tables = Table::in_markdown(markdown);
    for table in &mut tables {
        table.head.iter_mut().for_each(|cell| *cell = typeset(cell));
        table
            .rows
            .iter_mut()
            .flatten()
            .for_each(|cell| *cell = typeset(cell));
    }
    let (single, all) = tables
        .into_iter()
        .partition(|table| table.caption.ends_with(" m/s"));
    let mut blocks = vec![Block::Text(EXPLAINED.to_owned())];
    let all: Vec<Table> = all;
    blocks.extend(all.into_iter().map(Block::Table));
    blocks.push(Block::Folded("Each speed".to_owned(), single));
    blocks
}

/// Papers of the theories, as their rooms name them.
#[must_use]
pub fn references(laws: &[NamedLaw]) -> Vec<String> {
    laws.iter()
        .filter_map(|law| match law.law {
            AnyLaw::Theory(theory, _) => Some(format!("{}: {}", law.name, theory.reference())),
            AnyLaw::Fitted(_) | AnyLaw::Series(_) => None,
        })
        .collect()
}

/// What the results of this version do not cover.
#[must_use]
pub fn limits(file: &LawFile) -> Vec<String> {
    let valid = &file.valid;
    let outside = valid.displacement_over_radius_max;
    let met = match &file.pair {
        None => {
            "One particle hits a rigid, frictionless, flat wall at a right angle and without spin."
                .to_owned()
        }
        Some(pair) => format!(
            "Two bodies meet without friction at a right angle and without spin: {}. The law is of these two materials and of bodies \
             similar to these.",
            pair.bodies()
        ),
    };
    [
        met,
        "The material does not depend on rate or temperature, and it does not crack.".to_owned(),
        format!(
            "The fitted law rests on impacts from {} to {} m/s and flattenings up to δ/R = {outside:.3}; beyond that it \
             is extrapolated.",
            valid.velocity_min_m_s, valid.velocity_max_m_s
        ),
        "The law has no waves: early in a fast impact simulated forces oscillate about its curve. Curves and beds show it \
         without its inertia term."
            .to_owned(),
        "There is no adhesion, neither in the impacts nor in the bed.".to_owned(),
    ]
    .into()
}
