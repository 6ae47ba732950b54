//! Measured impacts: a table of speeds and what was measured of each, with uncertainties, in units that its header names.

use super::table::Measured;
use crate::Result;
use crate::table::Row;
use std::path::Path;

/// What was measured of an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Figure {
    /// Coefficient of restitution e.
    Restitution,
    /// 1 - H_d/D of the particle afterwards.
    CompressionRatio,
    /// Diameter of the flat over that of the particle.
    FlatDiameter,
}

impl Figure {
    /// All of them.
    pub const ALL: [Figure; 3] = [
        Figure::Restitution,
        Figure::CompressionRatio,
        Figure::FlatDiameter,
    ];

    /// Its name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Figure::Restitution => "restitution",
            Figure::CompressionRatio => "compression_ratio",
            Figure::FlatDiameter => "flat_diameter_ratio",
        }
    }
}

/// One figure of one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Line of the table: figures of one line are of one impact.
    pub line: u64,
    /// V, m/s.
    pub velocity: f64,
    /// Standard deviation of V over V.
    pub velocity_sigma: f64,
    /// What it is.
    pub figure: Figure,
    /// Its value, without unit.
    pub value: f64,
    /// Its standard deviation; none where neither row nor argument says it.
    pub sigma: Option<f64>,
    /// What a relative error of the radius does to the value.
    pub radius_slope: f64,
    /// Standard deviation of this particle's own radius over it.
    pub radius_sigma: f64,
}

/// Standard deviations of what rows do not give, and of what all rows share.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Uncertainty {
    /// Of e.
    pub restitution: Option<f64>,
    /// Of the compression ratio.
    pub compression_ratio: Option<f64>,
    /// Of the flat's diameter, m.
    pub flat_diameter: Option<f64>,
    /// Of each speed, relative.
    pub velocity: f64,
    /// Of Young's modulus, relative.
    pub young_modulus: f64,
    /// Of the radius that all rows without their own share, relative.
    pub radius: f64,
}

/// A table that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurements {
    /// Row by row.
    pub all: Vec<Measurement>,
    /// Columns that mean nothing here.
    pub unused: Vec<String>,
}

/// How the table is to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Radius of rows without their own, m.
    pub radius: f64,
    /// Uncertainties.
    pub uncertainty: Uncertainty,
    /// Flat diameters stand for compression ratios, by the spherical cap.
    pub cap: bool,
}

impl Measurements {
    /// Reads the text of a table: comma, semicolon or tab between its values, `#` before remarks.
    ///
    /// # Errors
    /// [`crate::Error::Value`] naming line and column of what is no measured impact.
    pub fn parse(text: &str, path: &Path, taken: &Taken) -> Result<Self> {
        let table = Measured::of(text, path)?;
        let figures = ["restitution", "compression_ratio", "flat_diameter_m"];
        if !table.has("velocity_m_s") {
            return Err(table.refuse(
                "velocity",
                "no such column",
                "must be there with its unit, e.g. `velocity_m_s` or `velocity (mm/s)`",
            ));
        }
        if !figures.iter().any(|name| table.has(name)) {
            return Err(table.refuse(
                "columns",
                "no figure of an impact",
                "must hold `restitution`, `compression_ratio` or `flat_diameter` with its unit",
            ));
        }
        if table.has("radius_m") && table.has("diameter_m") {
            return Err(table.refuse("radius", "a diameter too", "must be one of both"));
        }
        let mut all = Vec::new();
        for row in table.rows() {
            let before = all.len();
            let shot = Shot::of(&table, row, taken)?;
            for figure in Figure::ALL {
                all.extend(shot.figure(&table, row, figure, taken)?);
            }
            if all.len() == before {
                return Err(table.at(row, "row", "no figure", "must have one measured figure"));
            }
        }
        if all.is_empty() {
            return Err(table.refuse("rows", "none", "must hold one measured impact at least"));
        }
        let unused = table.unused.clone();
        Ok(Measurements { all, unused })
    }

    /// Distinct speeds, ascending, m/s.
    #[must_use]
    pub fn velocities(&self) -> Vec<f64> {
        velocities(&self.all)
    }
}

/// Distinct speeds of measurements, ascending, m/s.
#[must_use]
pub fn velocities(all: &[Measurement]) -> Vec<f64> {
    let mut speeds: Vec<f64> = all.iter().map(|one| one.velocity).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// What the figures of a row share.
struct Shot {
    velocity: f64,
    velocity_sigma: f64,
    radius: f64,
    radius_sigma: f64,
}

impl Shot {
    fn of(table: &Measured<'_>, row: &Row, taken: &Taken) -> Result<Self> {
        let positive = |value: f64| value > 0.0;
        let Some(velocity) = table.number(row, "velocity_m_s", positive, "must be above 0")? else {
            return Err(table.at(
                row,
                "velocity",
                "nothing",
                "must be the speed of the impact",
            ));
        };
        let sigma = |name: &str| table.number(row, name, |s| s >= 0.0, "must be 0 or more");
        let velocity_sigma = match sigma("velocity_sigma_m_s")? {
            Some(sigma) => sigma / velocity,
            None => taken.uncertainty.velocity,
        };
        let mut own = table.number(row, "radius_m", positive, "must be above 0")?;
        let mut own_sigma = sigma("radius_sigma_m")?;
        if let Some(diameter) = table.number(row, "diameter_m", positive, "must be above 0")? {
            own = Some(0.5 * diameter);
            own_sigma = sigma("diameter_sigma_m")?.map(|sigma| 0.5 * sigma);
        }
        let radius = own.unwrap_or(taken.radius);
        let radius_sigma = own_sigma.map_or(0.0, |sigma| sigma / radius);
        for (what, share) in [("velocity", velocity_sigma), ("radius", radius_sigma)] {
            if !(share <= LARGEST_SHARE) {
                let allowed = "its standard deviation must be at most half of it";
                return Err(table.at(row, what, &format!("{share} of it"), allowed));
            }
        }
        Ok(Shot {
            velocity,
            velocity_sigma,
            radius,
            radius_sigma,
        })
    }

    /// A figure of the row, if it has it.
    fn figure(
        &self,
        table: &Measured<'_>,
        row: &Row,
        figure: Figure,
        taken: &Taken,
    ) -> Result<Option<Measurement>> {
        let (column, default) = match figure {
            Figure::Restitution => ("restitution", taken.uncertainty.restitution),
            Figure::CompressionRatio => ("compression_ratio", taken.uncertainty.compression_ratio),
            Figure::FlatDiameter => ("flat_diameter_m", taken.uncertainty.flat_diameter),
        };
        let Some(mut value) = table.number(row, column, |_| true, "")? else {
            return Ok(None);
        };
        let deviation = match figure {
            Figure::FlatDiameter => "flat_diameter_sigma_m".to_owned(),
            _ => format!("{column}_sigma"),
        };
        let own = table.number(row, &deviation, |s| s > 0.0, "must be above 0")?;
        let mut sigma = own.or(default);
        let (mut figure, mut radius_slope) = (figure, 0.0);
        if figure == Figure::FlatDiameter {
            let diameter = 2.0 * self.radius;
            value /= diameter;
            sigma = sigma.map(|sigma| sigma / diameter);
            radius_slope = -value;
        }
        if let Err(allowed) = possible(figure, value) {
            let found = table.cell(row, column);
            return Err(table.at(row, column, &found, allowed));
        }
        if figure == Figure::FlatDiameter && taken.cap {
            // H_d = R + (R^2 - d^2/4)^(1/2)
            let root = (1.0 - value * value).sqrt();
            figure = Figure::CompressionRatio;
            sigma = sigma.map(|sigma| 0.5 * value / root * sigma);
            radius_slope *= 0.5 * value / root;
            // (1 - root)/2 without its cancellation: a small flat has a small ratio, not none
            value = 0.5 * value * value / (1.0 + root);
            if value == 0.0 {
                let found = table.cell(row, column);
                return Err(table.at(row, column, &found, "must be a size that numbers can hold"));
            }
        }
        if sigma.is_some_and(|sigma| !(sigma > 0.0 && sigma.is_finite())) {
            let found = table.cell(row, &deviation);
            return Err(table.at(
                row,
                &deviation,
                &found,
                "must be a size that numbers can hold",
            ));
        }
        Ok(Some(Measurement {
            line: row.line,
            velocity: self.velocity,
            velocity_sigma: self.velocity_sigma,
            figure,
            value,
            sigma,
            radius_slope,
            radius_sigma: self.radius_sigma,
        }))
    }
}

/// Largest standard deviation of a speed or radius over it.
pub const LARGEST_SHARE: f64 = 0.5;

/// Whether a value can tell of a strength; why not.
fn possible(figure: Figure, value: f64) -> std::result::Result<(), &'static str> {
    match figure {
        Figure::Restitution if value > 1.0 => {
            Err("must be below 1: no impact gives back more than it had")
        }
        Figure::Restitution if value == 1.0 => Err(
            "must be below 1: an impact that stayed elastic says only that the strength is above some value; leave it out",
        ),
        Figure::Restitution if !(value > 0.0) => {
            Err("must be above 0: a particle that stays at the wall says nothing here")
        }
        Figure::CompressionRatio if !(value > 0.0) => {
            Err("must be above 0: a particle that kept its height did not yield; leave it out")
        }
        Figure::CompressionRatio if value >= 1.0 => Err("must be below 1: it is 1 - H/D"),
        Figure::FlatDiameter if !(value > 0.0) => Err("must be above 0"),
        Figure::FlatDiameter if value >= 1.0 => {
            Err("must be below the diameter of the particle; check radius and unit")
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Measurements> {
        let taken = Taken {
            radius: 1e-4,
            uncertainty: Uncertainty {
                restitution: Some(0.01),
                ..Uncertainty::default()
            },
            cap: false,
        };
        Measurements::parse(text, Path::new("m.csv"), &taken)
    }

    #[test]
    fn units_of_the_header_are_converted_and_own_deviations_come_before_those_of_all() {
        let one = read("velocity_m_s,restitution,restitution_sigma\n2,0.5,0.02\n3,0.4,\n").unwrap();
        let other =
            read("# of today\nVelocity (mm/s);restitution;restitution_sigma;who\n2000;0.5;0.02;me\n3000;0.4;;me\n")
                .unwrap();
        let values = |m: &Measurements| -> Vec<(f64, f64, Option<f64>)> {
            let one = |m: &Measurement| (m.velocity, m.value, m.sigma);
            m.all.iter().map(one).collect()
        };
        let expected = [(2.0, 0.5, Some(0.02)), (3.0, 0.4, Some(0.01))];
        assert_eq!(values(&one), expected);
        assert_eq!(values(&other), expected);
        assert_eq!(other.unused, ["who"]);
    }

    #[test]
    fn the_cap_of_a_small_flat_is_small_and_not_none() {
        let taken = Taken {
            radius: 1e-4,
            uncertainty: Uncertainty::default(),
            cap: true,
        };
        let of = |flat: &str| {
            let text = format!("velocity_m_s,flat_diameter_um,radius_um\n5,{flat},50\n");
            Measurements::parse(&text, Path::new("m.csv"), &taken)
        };
        let value = of("1e-7").unwrap().all[0].value;
        assert!((value / 0.25e-18 - 1.0).abs() < 1e-12, "{value}");
        assert!(of("1e-180").is_err());
    }

    #[test]
    fn a_flat_is_over_the_diameter_of_its_particle_and_its_cap_is_that_of_a_sphere() {
        let text = "velocity_m_s,flat_diameter_um,radius_um,radius_sigma_um\n5,60,50,1\n5,120,,\n";
        let flat = read(text).unwrap();
        assert!(
            (flat.all[0].value - 0.6).abs() < 1e-15
                && flat.all[0].radius_slope == -flat.all[0].value
        );
        assert!((flat.all[0].radius_sigma - 0.02).abs() < 1e-15);
        assert!((flat.all[1].value - 0.6).abs() < 1e-15);
        let taken = Taken {
            radius: 1e-4,
            uncertainty: Uncertainty::default(),
            cap: true,
        };
        let cap = Measurements::parse(text, Path::new("m.csv"), &taken).unwrap();
        // 3, 4, 5: H = R (1 + 0.8), and a larger radius has the same flat at a lesser share
        assert_eq!(cap.all[0].figure, Figure::CompressionRatio);
        assert!((cap.all[0].value - 0.1).abs() < 1e-15);
        let h = 1e-6;
        let of = |radius: f64| 0.5 * (1.0 - (1.0 - (30e-6f64 / radius).powi(2)).sqrt());
        let slope = (of(50e-6 * (1.0 + h)) - of(50e-6 * (1.0 - h))) / (2.0 * h);
        assert!((cap.all[0].radius_slope / slope - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_tells_of_no_strength_is_refused_with_its_line() {
        for (text, part) in [
            (
                "velocity_m_s,restitution\n1,0.5\n2,1.2\n",
                "line 3, restitution`: found `1.2`",
            ),
            ("velocity_m_s,restitution\n1,1\n", "stayed elastic"),
            ("velocity_m_s,restitution\n1,0\n", "stays at the wall"),
            ("velocity_m_s,restitution\n1,-0.2\n", "must be above 0"),
            ("velocity_m_s,restitution\n1,0,5\n", "as many values"),
            ("velocity_m_s;restitution\n1;0,5\n", "must be a number"),
            ("velocity_m_s,restitution\n-1,0.5\n", "line 2, velocity_m_s"),
            ("velocity_m_s,restitution\n,0.5\n", "must be the speed"),
            ("velocity_m_s,restitution\n1,NaN\n", "must be a number"),
            ("velocity_m_s,restitution\n1,\n", "no figure"),
            ("velocity,restitution\n1,0.5\n", "no column of this name"),
            (
                "velocity_m_s,restitution,restitution_sgma_sigma\n1,0.5,1\n",
                "no column of this name",
            ),
            (
                "velocity_m_s,velocity_mm_s,restitution\n1,1,0.5\n",
                "the column twice",
            ),
            (
                "velocity_m_s,restitution,restitution_sigma,Restitution_Sigma\n1,0.5,1,2\n",
                "the column twice",
            ),
            ("velocity_m_s\n1\n", "no figure of an impact"),
            ("velocity_m_s,restitution\n", "one measured impact"),
            (
                "velocity_m_s,restitution,restitution_sigma\n1,0.5,0\n",
                "must be above 0",
            ),
            (
                "velocity_m_s,velocity_sigma_m_s,restitution\n1,0.6,0.5\n",
                "at most half",
            ),
            (
                "velocity_m_s,flat_diameter_um\n1,201\n",
                "check radius and unit",
            ),
            ("velocity_m_s,compression_ratio\n1,0\n", "kept its height"),
            (
                "velocity_m_s,radius_um,diameter_um,restitution\n1,1,2,0.5\n",
                "one of both",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
