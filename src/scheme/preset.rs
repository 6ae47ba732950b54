//! Preset: a published material point method as one name and a few settings.

use serde::Deserialize;
use std::fmt;

/// A material point method that a case may ask for by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// The method of the thesis behind this crate (Leeds 2025, chapters 3 and 4).
    Thesis,
    /// Total Lagrangian, linear functions, FLIP, as de Vaucorbeil and Nguyen (2020) have it.
    Tlmpm,
    /// Updated Lagrangian, cubic functions, FLIP.
    Ulmpm,
    /// The planner's grid and points; velocity mapped by FLIP.
    Flip,
    /// The same by PIC.
    Pic,
    /// The same by APIC.
    Apic,
}

impl Preset {
    /// All of them, in the order of messages.
    pub const ALL: [Preset; 6] = [
        Preset::Thesis,
        Preset::Tlmpm,
        Preset::Ulmpm,
        Preset::Flip,
        Preset::Pic,
        Preset::Apic,
    ];

    /// Name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Preset::Thesis => "thesis",
            Preset::Tlmpm => "tlmpm",
            Preset::Ulmpm => "ulmpm",
            Preset::Flip => "flip",
            Preset::Pic => "pic",
            Preset::Apic => "apic",
        }
    }

    /// The preset with its usual settings.
    #[must_use]
    pub fn usual(self) -> Method {
        let lattice = |points, ratio| Some(Filling { points, ratio });
        let (filling, degree, step, dimensions) = match self {
            Preset::Thesis => (lattice(50, 1.05), 3, StepRule::OfOrder(0.1), 3),
            Preset::Tlmpm => (lattice(50, 2.0), 1, StepRule::OfCrossing(0.1), 2),
            Preset::Ulmpm => (lattice(50, 2.0), 3, StepRule::OfCrossing(0.1), 2),
            // the limit is that of velocities on the nodes: FLIP comes apart at a quarter of it (elastic, 1 and 5 m/s, tolerances of
            // 0.02 and 0.2: at 0.5 four of four, at 0.25 one of four, at 0.1 none)
            Preset::Flip => (None, 2, StepRule::OfStable(0.1), 2),
            Preset::Pic | Preset::Apic => (None, 2, StepRule::OfStable(0.5), 2),
        };
        Method {
            preset: self,
            filling,
            degree,
            step,
            dimensions,
        }
    }
}

/// How a lattice of points fills the body and its cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filling {
    /// Points a diameter.
    pub points: u32,
    /// Side of a cell over the distance of the points.
    pub ratio: f64,
}

impl Filling {
    /// Side of a cell, R.
    #[must_use]
    pub fn cell(&self) -> f64 {
        2.0 * self.ratio / f64::from(self.points)
    }
}

/// How long the steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepRule {
    /// This share of the power of ten, in seconds, below the time in which wave and body cross a cell (the thesis, section 3.5.3).
    OfOrder(f64),
    /// This share of the time in which wave and body cross a cell (its equation 3-27).
    OfCrossing(f64),
    /// This share of the stability limit, estimated as the body deforms.
    OfStable(f64),
}

impl StepRule {
    /// Length of the step in the unit of `crossing`, the time in which wave and body cross a cell; `unit` is that unit in s. None
    /// where the step follows the stability limit.
    ///
    /// ```
    /// use impactlaw::scheme::preset::StepRule;
    /// // table 3-2 of the thesis: 8 us and a multiplier of 0.1 make 100 ns
    /// let step = StepRule::OfOrder(0.1).fixed(8.0, 1e-6).unwrap();
    /// assert!((step - 0.1).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn fixed(self, crossing: f64, unit: f64) -> Option<f64> {
        match self {
            StepRule::OfOrder(share) => {
                // a crossing of just 10 ns must not fall to either side by rounding
                let order = ((crossing * unit).log10() + 1e-9).floor();
                Some(share * 10f64.powf(order) / unit)
            }
            StepRule::OfCrossing(share) => Some(share * crossing),
            StepRule::OfStable(_) => None,
        }
    }

    /// The number that the file has.
    #[must_use]
    pub fn share(self) -> f64 {
        match self {
            StepRule::OfOrder(share) | StepRule::OfCrossing(share) | StepRule::OfStable(share) => {
                share
            }
        }
    }

    /// The same rule with another number.
    #[must_use]
    pub fn with(self, share: f64) -> Self {
        match self {
            StepRule::OfOrder(_) => StepRule::OfOrder(share),
            StepRule::OfCrossing(_) => StepRule::OfCrossing(share),
            StepRule::OfStable(_) => StepRule::OfStable(share),
        }
    }
}

/// A preset with its settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// Which one.
    pub preset: Preset,
    /// Lattice of its points; none of a preset on the planner's grid.
    pub filling: Option<Filling>,
    /// Degree of the splines; the planner's of a preset on its grid.
    pub degree: u32,
    /// Length of the steps.
    pub step: StepRule,
    /// 2: the axisymmetric section, 3: a quarter of the sphere.
    pub dimensions: u32,
}

impl Method {
    /// Whether its figures are also read from output files, as the thesis reads them.
    #[must_use]
    pub fn reads_files(&self) -> bool {
        self.preset == Preset::Thesis
    }
}

impl fmt::Display for Method {
    /// Name and all settings: equal texts are equal methods.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Method {
            preset,
            filling,
            degree,
            step,
            dimensions,
        } = self;
        write!(f, "{}", preset.name())?;
        if let Some(Filling { points, ratio }) = filling {
            write!(
                f,
                ", {points} points a diameter, cells of {ratio} point distances, degree {degree}"
            )?;
        }
        match step {
            StepRule::OfOrder(share) => {
                write!(f, ", step {share} of the order of the crossing time")?;
            }
            StepRule::OfCrossing(share) => write!(f, ", step {share} of the crossing time")?,
            StepRule::OfStable(share) => write!(f, ", step {share} of the stability limit")?,
        }
        match dimensions {
            3 => write!(f, ", three dimensions"),
            _ => write!(f, ", section"),
        }
    }
}
