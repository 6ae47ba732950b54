//! Rows: one figure of one case, as it was measured, as the source and theories have it, and ours.

use super::measured::{Entry, Figure, Flag, Kind, Quantity};
use crate::case::Case;
use crate::case::pair::{PairCase, Target};
use crate::contact::rebound::{Rebound, rebound};
use crate::contact::{LawVisitor, NormalLaw};
use crate::curve::{Status, Summary};
use crate::material::Material;
use crate::material::flow::YIELD_STRENGTH;
use crate::theory::published::Evidence;
use crate::theory::{FORMULAS, Theory};
use crate::thesis::{EQUATIONS, Row as Numbers};
use std::f64::consts::PI;

/// A case and what its impact gave, SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// What it meets; none: a rigid wall.
    pub target: Option<Target>,
    /// Figures of its impact.
    pub summary: Summary,
    /// Largest contact radius over R.
    pub flat: f64,
}

impl Outcome {
    /// A figure; none where the impact did not end well.
    #[must_use]
    pub fn figure(&self, figure: Figure) -> Option<f64> {
        let of = &self.summary;
        let value = match figure {
            Figure::ContactTime => of.contact_time_s,
            Figure::Height => of.height_at_max_compression_ratio,
            Figure::Restitution => of.restitution,
            Figure::Compression => of.compression_ratio,
            Figure::Strain => of.equivalent_plastic_strain,
            Figure::Force => of.max_force_n,
            Figure::MeanPressure => {
                let radius = self.flat * self.case.radius;
                of.max_force_n / (PI * radius * radius) / self.strength()?
            }
            Figure::Length => of.cylinder.as_ref()?.final_length_m,
            Figure::Foot => of.cylinder.as_ref()?.foot_diameter_m,
            Figure::Fifth => of.cylinder.as_ref()?.diameter_at_fifth_m,
        };
        (of.status == Status::Ok && value.is_finite()).then_some(value)
    }

    /// The lower of the yield strengths of the two bodies, Pa; none of elastic ones.
    #[must_use]
    pub fn strength(&self) -> Option<f64> {
        let other = self.target.and_then(|target| target.material.flow);
        let flows = [self.case.material.flow, other].into_iter().flatten();
        flows.map(|flow| flow.yield_strength()).reduce(f64::min)
    }

    /// The sphere that meets a rigid wall as this one meets what it meets.
    fn effective(&self) -> Case {
        let Some(target) = self.target else {
            return self.case.clone();
        };
        let particle = self.case.clone();
        PairCase { particle, target }.effective()
    }

    /// Compression ratio of the spherical cap whose base has the diameter of the widest contact: what is had from a flat alone,
    /// $H_d = D/2 + (D^2 - d_d^2)^{1/2}/2$.
    #[must_use]
    pub fn by_cap(&self) -> Option<f64> {
        let whole = self.summary.status == Status::Ok && self.flat <= 1.0;
        whole.then(|| 0.5 * (1.0 - (1.0 - self.flat * self.flat).sqrt()))
    }
}

/// What was read of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Its value; none of what is lost.
    pub value: Option<f64>,
    /// Its uncertainty.
    pub uncertainty: Option<f64>,
    /// What has to be known of it.
    pub flag: Option<Flag>,
    /// Where it stands.
    pub source: String,
}

/// A figure of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Experiment.
    pub experiment: &'static str,
    /// Case of the case file.
    pub case: String,
    /// V, m/s.
    pub velocity: f64,
    /// What is compared.
    pub figure: Figure,
    /// As it was measured.
    pub measured: Option<Reading>,
    /// By the simulation of the source.
    pub simulation: Option<f64>,
    /// By an equation, as the source prints it.
    pub printed: Option<f64>,
    /// What the source says that it is at least and at most.
    pub limits: [Option<f64>; 2],
    /// Number of the thesis' equation, and its value.
    pub equation: Option<(&'static str, f64)>,
    /// Of each of [`theories`]; none where one says nothing of it.
    pub theories: Vec<Option<f64>>,
    /// Ours.
    pub ours: Option<f64>,
    /// 95 % of ours when the inputs are drawn within their uncertainties.
    pub interval: Option<[f64; 2]>,
    /// Ours by the cap on its flat.
    pub by_cap: Option<f64>,
}

impl Row {
    /// The row of `outcome` among the entries that are about it.
    #[must_use]
    pub fn of(
        experiment: &'static str,
        outcome: &Outcome,
        figure: Figure,
        about: &[&Entry],
        interval: Option<[f64; 2]>,
    ) -> Self {
        let entry = |kind: Kind| {
            let of = |one: &&&Entry| one.kind == kind && one.quantity == Quantity::Figure(figure);
            about.iter().find(of)
        };
        let case = &outcome.case;
        let velocity = case.velocities[0];
        let effective = outcome.effective();
        Row {
            experiment,
            case: case.name.clone(),
            velocity,
            figure,
            measured: entry(Kind::Measured).map(|one| Reading {
                value: one.value,
                uncertainty: one.uncertainty,
                flag: one.flag,
                source: one.source.clone(),
            }),
            simulation: entry(Kind::Simulation).and_then(|one| one.value),
            printed: entry(Kind::Equation).and_then(|one| one.value),
            limits: [Kind::AtLeast, Kind::AtMost].map(|kind| entry(kind)?.value),
            // fitted to impacts on a rigid wall
            equation: match outcome.target {
                None => equation(&case.material, case.radius, velocity, figure),
                Some(_) => None,
            },
            theories: of_theories(&effective.material, effective.radius, velocity, figure),
            ours: outcome.figure(figure),
            interval,
            by_cap: (figure == Figure::Compression)
                .then(|| outcome.by_cap())
                .flatten(),
        }
    }

    /// Measured value.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        self.measured.as_ref()?.value
    }

    /// Measured value and its uncertainty.
    #[must_use]
    pub fn reading(&self) -> Option<[f64; 2]> {
        let measured = self.measured.as_ref()?;
        Some([measured.value?, measured.uncertainty?])
    }

    /// Whether ours lies within the uncertainty of what was measured.
    #[must_use]
    pub fn inside(&self) -> Option<bool> {
        let [value, by] = self.reading()?;
        Some((self.ours? - value).abs() <= by)
    }

    /// Whether our interval meets that of what was measured.
    #[must_use]
    pub fn overlaps(&self) -> Option<bool> {
        let ([value, by], [low, high]) = (self.reading()?, self.interval?);
        Some(low <= value + by && high >= value - by)
    }
}

/// Theories that comparisons show unasked, and formulas of the restitution, by their names.
#[must_use]
pub fn theories() -> Vec<&'static str> {
    let laws = Theory::ALL.into_iter().filter(shown).map(Theory::name);
    laws.chain(FORMULAS.iter().map(|formula| formula.name))
        .collect()
}

fn shown(theory: &Theory) -> bool {
    theory.evidence() == Evidence::Checked
}

/// Impact by a law.
struct Bounce<'a>(&'a Material, f64, f64);

impl LawVisitor for Bounce<'_> {
    type Output = Rebound;

    fn visit<L: NormalLaw>(self, law: &L) -> Rebound {
        let Bounce(material, radius, velocity) = self;
        rebound(law, radius, material.sphere_mass(radius), velocity)
    }
}

/// Figure by each of [`theories`], restitution by the authors' own formula where they give one; none of a theory that leaves out
/// something of the material.
fn of_theories(
    material: &Material,
    radius: f64,
    velocity: f64,
    figure: Figure,
) -> Vec<Option<f64>> {
    let law = |theory: Theory| {
        let whole = theory.publication().leaves_out(material).is_empty();
        // Hertz's law of a body that yields is no answer
        if !whole || theory.needs_yield() != material.flow.is_some() {
            return None;
        }
        let closed = theory.restitution_closed_form(material, velocity);
        let hit = theory
            .visit(material, Bounce(material, radius, velocity))
            .ok()?;
        let diameter = 2.0 * radius;
        let value = match figure {
            Figure::ContactTime => hit.contact_time,
            Figure::Height => 1.0 - hit.max_displacement / diameter,
            Figure::Restitution => closed.unwrap_or(hit.restitution),
            // a law knows the centre of mass; to first order the height lost is the same
            Figure::Compression => hit.residual_displacement / diameter,
            Figure::Force => hit.max_force,
            Figure::Strain
            | Figure::MeanPressure
            | Figure::Length
            | Figure::Foot
            | Figure::Fifth => return None,
        };
        // far beyond what it was made for a law flattens a body by more than its diameter
        let whole = match figure {
            Figure::Height | Figure::Compression => (0.0..=1.0).contains(&value),
            _ => value.is_finite(),
        };
        whole.then_some(value)
    };
    let laws = Theory::ALL.into_iter().filter(shown).map(law);
    let formulas = FORMULAS.iter().map(|formula| {
        let asked = figure == Figure::Restitution && formula.leaves_out(material).is_empty();
        asked.then_some(formula.restitution?)?(material, velocity)
    });
    laws.chain(formulas).collect()
}

/// The thesis' equation of a figure: 4-9, 5-4 or 5-5; none for a material with hardening, or an elastic one.
#[must_use]
pub fn equation(
    material: &Material,
    radius: f64,
    velocity: f64,
    figure: Figure,
) -> Option<(&'static str, f64)> {
    let flow = material.flow?;
    let plain = |(constant, value): &(_, f64)| *constant == YIELD_STRENGTH || *value == 0.0;
    if !flow.constants().iter().all(plain) {
        return None;
    }
    let number = match figure {
        Figure::Restitution => "4-9",
        Figure::Strain => "5-4",
        Figure::Compression => "5-5",
        _ => return None,
    };
    let unknown = f64::NAN;
    let row = Numbers {
        density: material.density,
        young_modulus: material.young_modulus,
        strength: flow.yield_strength(),
        poisson_ratio: material.poisson_ratio,
        radius,
        velocity,
        restitution: unknown,
        force: unknown,
        displacement: unknown,
        residual: unknown,
        compression: unknown,
        strain: unknown,
        work: unknown,
        tolerance: unknown,
        status: String::new(),
    };
    let equation = EQUATIONS.iter().find(|one| one.number == number)?;
    Some((number, (equation.form)(&row, equation.constants)))
}
