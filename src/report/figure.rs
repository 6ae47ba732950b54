//! Figure: a drawing with its caption; the figures of an impact, a comparison and a bed.

use super::chart::{Chart, Entry, Mark, Series};
use super::palette::Role;
use super::scale::Axis;
use crate::Result;
use crate::curve::Curve;
use crate::files::write_atomic;
use crate::unit::significant;
use std::path::Path;

/// A drawing with its caption.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name without extension.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The drawing, complete in itself.
    pub svg: String,
    /// The drawing for a page that shows its legend elsewhere.
    pub bare: String,
    /// That legend; empty for a drawing without one.
    pub legend: Vec<Entry>,
}

/// Room above and beside the simulation and our law; theories that go further are cut.
const HEADROOM: f64 = 1.3;

impl Figure {
    /// Force against displacement of the centre of mass at one speed: the simulated curve and any laws, which are
    /// cut where they leave the frame.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn force_displacement(velocity: f64, curve: &Curve, laws: &[Series]) -> Result<Self> {
        let speed = significant(velocity, 4);
        let mut series = vec![Series {
            label: "MPM".to_owned(),
            role: Role::Simulation,
            mark: Mark::Line,
            points: curve
                .samples
                .iter()
                .map(|sample| (sample.displacement_m, sample.force_n))
                .collect(),
            supported_to: None,
        }];
        series.extend_from_slice(laws);
        let leading = |role| matches!(role, Role::Simulation | Role::Law);
        let (x_max, y_max) = series
            .iter()
            .filter(|one| leading(one.role))
            .flat_map(|one| &one.points)
            .fold((0.0f64, 0.0f64), |(x, y), point| {
                (x.max(point.0), y.max(point.1))
            });
        let range = |max: f64, room| (max > 0.0).then_some((0.0, max * room));
        Self::chart(
            format!("force_displacement_V{speed}"),
            format!("{speed} m/s"),
            Chart {
                x: Axis {
                    range: range(x_max, 1.1),
                    ..Axis::new("displacement δ", "m")
                },
                y: Axis {
                    range: range(y_max, HEADROOM),
                    ..Axis::new("force F", "N")
                },
                series,
            },
        )
    }

    /// Restitution against impact speed: markers for simulations, lines for laws.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn restitution(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "restitution".to_owned(),
            "Coefficient of restitution against impact speed: discs from the simulated impacts, lines from the laws \
             integrated for a single impact."
                .to_owned(),
            Chart {
                x: Axis {
                    log_if_wide: true,
                    ..Axis::new("impact speed V", "m/s")
                },
                y: Axis {
                    range: Some((0.0, 1.05)),
                    ..Axis::new("restitution e", "")
                },
                series,
            },
        )
    }

    /// Axial stress against axial strain of a compressed bed, one curve a law.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn stress_strain(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "bed_stress_strain".to_owned(),
            "Axial stress on the piston against axial strain of the bed.".to_owned(),
            Chart {
                x: Axis::new("axial strain", ""),
                y: Axis::new("axial stress", "Pa"),
                series,
            },
        )
    }

    /// Void ratio against axial stress, as soil engineers draw a compression, one curve a law.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn compression(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "bed_compression".to_owned(),
            "Void ratio against axial stress: loading, letting go and loading again. The slope of the loading is the compression index."
                .to_owned(),
            Chart {
                x: Axis {
                    log_if_wide: true,
                    ..Axis::new("axial stress", "Pa")
                },
                y: Axis::new("void ratio", ""),
                series,
            },
        )
    }

    /// Constrained modulus of the loading against axial stress, one curve a law beside a bound from theory.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn modulus(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "bed_modulus".to_owned(),
            "Tangent constrained modulus of the loading against axial stress; Walton: elastic grains that all strain alike, an \
             upper bound with the contacts the bed has."
                .to_owned(),
            Chart {
                x: Axis::new("axial stress", "Pa"),
                y: Axis::new("constrained modulus", "Pa"),
                series,
            },
        )
    }

    /// Mean number of contacts a grain against axial strain, one curve a law.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn coordination(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "bed_coordination".to_owned(),
            "Mean coordination number against axial strain of the bed.".to_owned(),
            Chart {
                x: Axis::new("axial strain", ""),
                y: Axis::new("contacts per grain", ""),
                series,
            },
        )
    }

    /// Part of all losses that went into plastic flow against axial strain, one curve a law.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn plastic_share(series: Vec<Series>) -> Result<Self> {
        Self::chart(
            "bed_plastic_share".to_owned(),
            "Energy lost to plastic flow over all energy lost so far, against axial strain of the bed."
                .to_owned(),
            Chart {
                x: Axis::new("axial strain", ""),
                y: Axis::new("plastic part of losses", ""),
                series,
            },
        )
    }

    /// Any chart as a figure.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when it cannot be drawn.
    pub fn chart(name: String, caption: String, chart: Chart) -> Result<Self> {
        Ok(Figure {
            name,
            caption,
            svg: chart.svg()?,
            bare: chart.bare()?,
            legend: chart.legend(),
        })
    }

    /// A drawing without a legend.
    #[must_use]
    pub fn plain(name: String, caption: String, svg: String) -> Self {
        Figure {
            name,
            caption,
            bare: svg.clone(),
            svg,
            legend: Vec::new(),
        }
    }

    /// Write `folder/<name>.svg`.
    ///
    /// # Errors
    /// [`crate::Error::File`] when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let path = folder.join(format!("{}.svg", self.name));
        write_atomic(&path, self.svg.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Sample;

    #[test]
    fn theories_do_not_stretch_the_frame() {
        let sample = |x: f64| Sample {
            time_s: x,
            displacement_m: x * 1e-6,
            centre_displacement_m: x * 1e-6,
            force_n: x,
            tangential_force_n: None,
            target_displacement_m: None,
            surface_j: None,
            contact_radius_m: 0.0,
            kinetic_j: 0.0,
            elastic_j: 0.0,
            plastic_j: 0.0,
        };
        let curve = Curve {
            samples: (0..20).map(|i| sample(f64::from(i))).collect(),
        };
        let hertz = Series {
            label: "Hertz".to_owned(),
            role: Role::Theory(0),
            mark: Mark::Line,
            points: vec![(0.0, 0.0), (19e-6, 400.0)],
            supported_to: None,
        };
        let figure = Figure::force_displacement(12.5, &curve, &[hertz]).unwrap();
        assert_eq!(figure.name, "force_displacement_V12.5");
        assert!(
            figure.svg.contains(">\n20\n<"),
            "the axis ends near 1.3 x 19 N"
        );
        assert!(!figure.svg.contains(">\n100\n<"));
    }
}
