//! Comparison: contact laws compared with simulated impacts, as rows, `compare.csv` and a Markdown table.
//!
//! Each law is judged twice. *Impact*: the 1-D impact of the law at the same speed gives F*, delta*, delta_res, e
//! and the contact time. *Curve*: the law follows the displacements of the simulated impact and its force is compared
//! with the simulated one.

mod misfit;
mod row;
mod table;

pub use misfit::Misfit;
pub use row::{Errors, Row};

use crate::contact::rebound::rebound;
use crate::contact::{LawVisitor, NormalLaw};
use crate::curve::{Impact, Status};
use crate::files::write_atomic;
use crate::law::pair::PairTable;
use crate::material::{Effective, Material};
use crate::theory::Theory;
use crate::theory::published::Evidence;
use crate::unit::engineering;
use crate::{Error, Result};
use std::path::Path;

/// Name of the rows that hold the simulated impacts themselves.
pub const SIMULATION: &str = "mpm";

/// Relative difference of lengths that is rounding (a fitted law is supported to the largest displacement of its
/// own impacts).
const LENGTH_ROUNDING: f64 = 1e-9;

/// Laws and impacts that are being compared.
#[derive(Debug, Clone)]
pub struct Comparison {
    material: Material,
    radius: f64,
    /// What stands before the tables of a pair; none of a particle on a rigid wall.
    pair: Option<String>,
    impacts: Vec<Impact>,
    left_out: Vec<f64>,
    rows: Vec<Row>,
}

impl Comparison {
    /// Comparison with the impacts that rebounded, for a sphere of `radius` (m); it holds their `mpm` rows to begin
    /// with. Impacts that failed or did not rebound are left out, and named in the table.
    #[must_use]
    pub fn new(material: &Material, radius: f64, impacts: &[Impact]) -> Self {
        let (done, broken): (Vec<_>, Vec<_>) = impacts
            .iter()
            .cloned()
            .partition(|impact| impact.summary.status == Status::Ok);
        let velocity = |impact: &Impact| impact.summary.velocity_m_s;
        Self {
            material: *material,
            radius,
            pair: None,
            rows: done
                .iter()
                .map(|impact| Row::simulated(&impact.summary))
                .collect(),
            left_out: broken.iter().map(velocity).collect(),
            impacts: done,
        }
    }

    /// Comparison with the impacts of a pair of bodies: laws are those of the sphere on a rigid plane that stands for both, and of the
    /// theories only those are shown that are stated for two bodies.
    #[must_use]
    pub fn of_pair(bodies: &PairTable, impacts: &[Impact]) -> Self {
        let both = bodies.effective();
        let Effective { radius, material } = both;
        let said = format!(
            "Of a pair: {}. Laws have the effective radius {}, E* = {} of both, the reduced mass {}; theories the yield strength of the \
             softer body. `series`: the laws of the two materials, each on a rigid plane, in series; `effective`: the atlas' law of one sphere of \
             that radius, E* and mass and the softer strength.",
            bodies.bodies(),
            engineering(radius, "m", 4),
            engineering(material.contact_modulus(), "Pa", 4),
            engineering(both.mass(), "kg", 4),
        );
        Comparison {
            pair: Some(said),
            ..Self::new(&material, radius, impacts)
        }
    }

    /// Say something more of the laws of a pair, as that one is left out.
    pub fn note(&mut self, sentence: &str) {
        if let Some(said) = &mut self.pair {
            said.push(' ');
            said.push_str(sentence);
        }
    }

    /// Add a law under a name.
    pub fn add<L: NormalLaw>(&mut self, name: &str, law: &L) {
        let mass = self.material.sphere_mass(self.radius);
        for impact in &self.impacts {
            let hit = rebound(law, self.radius, mass, impact.summary.velocity_m_s);
            let misfit = Misfit::of(law, self.radius, mass, impact);
            let supported = law.valid_to() * self.radius;
            let extrapolated =
                impact.summary.max_displacement_m > supported * (1.0 + LENGTH_ROUNDING);
            self.rows
                .push(Row::law(name, &impact.summary, &hit, misfit, extrapolated));
        }
    }

    /// Add every theory that has a law of the material; those that are unverified if `all`.
    pub fn add_theories(&mut self, all: bool) {
        let (material, of_pair) = (self.material, self.pair.is_some());
        let shown = |theory: &Theory| {
            (all || theory.evidence() == Evidence::Checked) && (!of_pair || theory.is_of_pairs())
        };
        for theory in Theory::of(&material).filter(shown) {
            // the only refusal is a missing yield strength, which has just been looked at
            let _ = theory.visit(&material, Added(self, theory.name()));
        }
    }

    /// Rows: the simulated impacts first, then law by law in the order they were added, speeds ascending as given.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Write `compare.csv` (with a `#` provenance line) and `compare.md` into `folder`.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be written.
    pub fn write(&self, folder: &Path, provenance: &str) -> Result<()> {
        let path = folder.join("compare.csv");
        let mut writer = csv::Writer::from_writer(format!("# {provenance}\n").into_bytes());
        for row in &self.rows {
            writer
                .serialize(row)
                .map_err(|e| Error::file("write", &path)(e.into()))?;
        }
        let bytes = writer
            .into_inner()
            .map_err(|e| Error::file("write", &path)(e.into_error()))?;
        write_atomic(&path, &bytes)?;
        let text = format!("<!-- {provenance} -->\n{}", self.markdown());
        write_atomic(&folder.join("compare.md"), text.as_bytes())
    }
}

/// Adds the visited law.
struct Added<'a>(&'a mut Comparison, &'static str);

impl LawVisitor for Added<'_> {
    type Output = ();

    fn visit<L: NormalLaw>(self, law: &L) {
        self.0.add(self.1, law);
    }
}
