//! Figures 4-3 to 4-17 and 5-3 to 5-6 of the thesis from the results of a study, with its equations on top.

use crate::Result;
use crate::curve::Impact;
use crate::report::chart::{Chart, Mark, Series};
use crate::report::figure::Figure;
use crate::report::palette::Role;
use crate::report::scale::Axis;
use crate::thesis::equations::{beyond, wu};
use crate::thesis::tables::{DIAMETERS, FORCES, FORCES_OF, SIZES};
use crate::thesis::{Data, Equation, Row};
use crate::unit::significant;

/// Upper ends of the classes of E/Y that share a colour.
const CLASSES: [f64; 4] = [50.0, 200.0, 800.0, f64::INFINITY];
/// Points of a line.
const LINE: usize = 60;

/// A figure of a row.
type Of<'a> = &'a dyn Fn(&Row) -> f64;

/// Figures of a study.
pub struct Figures<'a> {
    /// Its cases.
    pub data: &'a Data,
    /// Fitted constants by the numbers of their equations.
    pub fitted: &'a dyn Fn(&str) -> Vec<f64>,
}

/// Number of an equation, and it over x with its constants.
type Line<'a> = (&'static str, &'a dyn Fn(f64, &[f64]) -> f64);

/// What a figure shows.
struct Plot<'a> {
    name: &'static str,
    caption: String,
    x: (&'static str, Of<'a>),
    y: (&'static str, Of<'a>),
    /// Rows that are shown.
    rows: Vec<&'a Row>,
    /// Number of the equation with the line it is over x, for its constants.
    line: Option<Line<'a>>,
}

fn series(label: &str, role: Role, mark: Mark, points: Vec<(f64, f64)>) -> Series {
    Series {
        label: label.to_owned(),
        role,
        mark,
        points,
        supported_to: None,
    }
}

fn axis(label: &str) -> Axis {
    Axis {
        log_if_wide: true,
        ..Axis::new(label, "")
    }
}

/// Points by class of E/Y.
fn classes(rows: &[&Row], x: Of<'_>, y: Of<'_>) -> Vec<Series> {
    let mut all = Vec::new();
    let mut low = 0.0;
    for high in CLASSES {
        let inside: Vec<&&Row> = rows
            .iter()
            .filter(|row| (low..high).contains(&row.young_over_yield()))
            .collect();
        low = high;
        let point = |row: &&&Row| Some((x(row), y(row))).filter(|(x, y)| *x > 0.0 && *y > 0.0);
        let points: Vec<(f64, f64)> = inside.iter().filter_map(point).collect();
        let ratios = || inside.iter().map(|row| row.young_over_yield());
        let (from, to) = (
            ratios().fold(f64::INFINITY, f64::min),
            ratios().fold(0.0, f64::max),
        );
        let label = match to / from < 1.001 {
            true => format!("E/Y {}", significant(from, 4)),
            false => format!("E/Y {} to {}", significant(from, 4), significant(to, 4)),
        };
        if !points.is_empty() {
            all.push(series(&label, Role::Other, Mark::Points, points));
        }
    }
    all
}

/// Smallest and largest positive x of series.
fn reach(all: &[Series]) -> (f64, f64) {
    let xs = all.iter().flat_map(|one| &one.points).map(|point| point.0);
    xs.fold((f64::INFINITY, 0.0), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

/// Points of a line over the logarithm of x.
fn line(from: f64, to: f64, y: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..=LINE)
        .map(|k| from * (to / from).powf(k as f64 / LINE as f64))
        .map(|x| (x, y(x)))
        .collect()
}

impl Figures<'_> {
    fn plot(&self, plot: Plot<'_>) -> Result<Figure> {
        let mut all = classes(&plot.rows, plot.x.1, plot.y.1);
        let (from, to) = reach(&all);
        if let Some((number, of)) = plot.line.filter(|_| to > 0.0) {
            let printed = Equation::numbered(number).map_or(&[][..], |e| e.constants);
            let fitted = (self.fitted)(number);
            let lines = [
                ("thesis, its constants", printed),
                ("its form, fitted", &fitted),
            ];
            for ((label, constants), role) in lines.into_iter().zip([Role::Simulation, Role::Law]) {
                let points = line(from, to, |x| of(x, constants));
                all.push(series(label, role, Mark::Line, points));
            }
        }
        Figure::chart(
            plot.name.to_owned(),
            plot.caption,
            Chart {
                x: axis(plot.x.0),
                y: axis(plot.y.0),
                series: all,
            },
        )
    }

    /// Rows that the thesis has too.
    fn inside(&self) -> Vec<&Row> {
        self.data.usable(Row::inside)
    }

    /// Those of the fastest speed.
    fn fastest(&self) -> (f64, Vec<&Row>) {
        let all = self.inside();
        let fastest = all.iter().map(|row| row.velocity).fold(0.0, f64::max);
        let rows = all.into_iter().filter(|row| row.velocity > 0.999 * fastest);
        (fastest, rows.collect())
    }

    /// Plastic strain: 4-3, 4-4, 5-3.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when one cannot be drawn, here and below.
    pub fn strain(&self) -> Result<Vec<Figure>> {
        let (speed, rows) = self.fastest();
        let strain: Of<'_> = &|row| row.strain;
        Ok(vec![
            self.plot(Plot {
                name: "figure_4_3",
                caption: format!(
                    "4-3: plastic strain over E/Y at {} m/s",
                    significant(speed, 4)
                ),
                x: ("E/Y", &Row::young_over_yield),
                y: ("ε_p", strain),
                rows,
                line: None,
            })?,
            self.plot(Plot {
                name: "figure_4_4",
                caption: "4-4: plastic strain over ρV²/Y".to_owned(),
                x: ("ρV²/Y", &Row::severity),
                y: ("ε_p", strain),
                rows: self.inside(),
                line: Some(("4-4", &|q, c| c[0] * q)),
            })?,
            self.plot(Plot {
                name: "figure_5_3",
                caption: "5-3: plastic strain over the group of equation 5-4".to_owned(),
                x: ("ρ(V² − V_y²)/Y", &beyond),
                y: ("ε_p", strain),
                rows: self.inside(),
                line: Some(("5-4", &|x, c| c[0] * x)),
            })?,
        ])
    }

    /// Compression: 4-6, 4-7, 5-5.
    ///
    /// # Errors
    /// As [`Figures::strain`].
    pub fn compression(&self) -> Result<Vec<Figure>> {
        let compression: Of<'_> = &|row| row.compression;
        Ok(vec![
            self.plot(Plot {
                name: "figure_4_6",
                caption: "4-6 b: compression ratio over ρV²/Y".to_owned(),
                x: ("ρV²/Y", &Row::severity),
                y: ("1 − H_d/D", compression),
                rows: self.inside(),
                line: Some(("4-5", &|q, c| c[0] * q.powf(c[1]))),
            })?,
            self.plot(Plot {
                name: "figure_4_7",
                caption: "4-7: plastic strain over the compression ratio".to_owned(),
                x: ("1 − H_d/D", compression),
                y: ("ε_p", &|row| row.strain),
                rows: self.inside(),
                line: Some(("4-6", &|x, c| c[0] * x.powf(c[1]))),
            })?,
            self.plot(Plot {
                name: "figure_5_5",
                caption: "5-5: compression ratio over the group of equation 5-5".to_owned(),
                x: ("ρ(V² − V_y²)/Y", &beyond),
                y: ("1 − H_d/D", compression),
                rows: self.inside(),
                line: Some(("5-5", &|x, c| c[0] * x.powf(c[1]))),
            })?,
        ])
    }

    /// Energy and restitution: 4-8 to 4-11, 5-6.
    ///
    /// # Errors
    /// As [`Figures::strain`].
    pub fn restitution(&self) -> Result<Vec<Figure>> {
        let (speed, rows) = self.fastest();
        let e: Of<'_> = &|row| row.restitution;
        let group =
            |row: &Row| Equation::numbered("4-9").map_or(f64::NAN, |e| (e.form)(row, e.constants));
        let mut gap = classes(&self.inside(), &|row| row.work, &|row| {
            1.0 - row.restitution.powi(2)
        });
        gap.push(series(
            "equal",
            Role::Simulation,
            Mark::Line,
            vec![(0.0, 0.0), (1.0, 1.0)],
        ));
        let mut eleven = classes(&self.inside(), &group, e);
        let (from, to) = reach(&eleven);
        eleven.push(series(
            "thesis, its constants",
            Role::Simulation,
            Mark::Line,
            line(from, to, |x| x),
        ));
        Ok(vec![
            self.plot(Plot {
                name: "figure_4_8",
                caption: "4-8: plastic work over incident energy".to_owned(),
                x: ("ρV²/Y", &Row::severity),
                y: ("W_p/W_i", &|row| row.work),
                rows: self.inside(),
                line: None,
            })?,
            self.plot(Plot {
                name: "figure_4_9",
                caption: format!(
                    "4-9: restitution over V/V_y at {} m/s",
                    significant(speed, 4)
                ),
                x: ("V/V_y", &Row::over_yield),
                y: ("e", e),
                rows,
                line: None,
            })?,
            self.plot(Plot {
                name: "figure_4_10",
                caption: "4-10: restitution and the law of Wu, Li and Thornton (4-8)".to_owned(),
                x: ("(V/V_y)/(E*/Y)", &wu),
                y: ("e", e),
                rows: self.inside(),
                line: Some(("4-8", &|x, c| c[0] * x.powf(c[1]))),
            })?,
            Figure::chart(
                "figure_4_11".to_owned(),
                "4-11: restitution over equation 4-9".to_owned(),
                Chart {
                    x: axis("2.85 (E/Y)^−0.325 exp(−2 (ρV²/Y)^0.325)"),
                    y: axis("e"),
                    series: eleven,
                },
            )?,
            Figure::chart(
                "figure_5_6".to_owned(),
                "5-6: energy that did not come back against plastic work".to_owned(),
                Chart {
                    x: Axis::new("W_p/W_i", ""),
                    y: Axis::new("1 − e²", ""),
                    series: gap,
                },
            )?,
        ])
    }

    /// Force and displacement: 4-12 to 4-17, those that share a legend together. `impact` finds the curve of a case, where it was kept, in the units of R = rho = E = 1.
    ///
    /// # Errors
    /// As [`Figures::strain`].
    pub fn force(&self, impact: &dyn Fn(&Row) -> Option<Impact>) -> Result<Vec<Vec<Figure>>> {
        let (most, left): (Of<'_>, Of<'_>) = (&|row| row.displacement / row.radius, &|row| {
            row.residual / row.radius
        });
        let (over, severity): (Of<'_>, Of<'_>) = (&Row::over_yield, &Row::severity);
        let mut all = Vec::new();
        for (name, caption, x, y) in [
            (
                "figure_4_13a",
                "4-13 a: largest displacement over V/V_y",
                ("V/V_y", over),
                ("δ*/R", most),
            ),
            (
                "figure_4_13b",
                "4-13 b: residual displacement over V/V_y",
                ("V/V_y", over),
                ("δ_res/R", left),
            ),
            (
                "figure_4_14a",
                "4-14 a: largest displacement over ρV²/Y",
                ("ρV²/Y", severity),
                ("δ*/R", most),
            ),
            (
                "figure_4_14b",
                "4-14 b: residual displacement over ρV²/Y",
                ("ρV²/Y", severity),
                ("δ_res/R", left),
            ),
            (
                "figure_4_15",
                "4-15: largest force over V/V_y",
                ("V/V_y", over),
                ("F*/F_y", &|row: &Row| row.force / row.yield_force()),
            ),
        ] {
            let rows: Vec<&Row> = self
                .inside()
                .into_iter()
                .filter(|row| y.1(row).is_finite())
                .collect();
            if !rows.is_empty() {
                let caption = caption.to_owned();
                all.push(self.plot(Plot {
                    name,
                    caption,
                    x,
                    y,
                    rows,
                    line: None,
                })?);
            }
        }
        // over R^2 Y, so that the modulus does not sort the cases
        let unit = |row: &Row| row.radius.powi(2) * row.strength;
        all.push(self.plot(Plot {
            name: "figure_4_16",
            caption: "4-16: largest force and equation 4-13, both over R²Y".to_owned(),
            x: ("π (ρV²/Y)^½", &|row| row.force_scale() / unit(row)),
            y: ("F*/(R²Y)", &|row| row.force / unit(row)),
            rows: self.inside(),
            line: Some(("4-13", &|x, c| c[0] * x)),
        })?);
        // their colours mean other things: each has its own legend
        let own = [self.curves(impact)?, self.sizes()?];
        let own = own.into_iter().flatten().map(|figure| vec![figure]);
        Ok(std::iter::once(all).chain(own).collect())
    }

    /// 4-12: curves of the cases of table 4-4 where they are kept, their turning points where not.
    fn curves(&self, impact: &dyn Fn(&Row) -> Option<Impact>) -> Result<Option<Figure>> {
        let (density, young, ratio) = FORCES_OF;
        let mut all = Vec::new();
        let mut tops = Vec::new();
        for (velocity, ..) in FORCES {
            let Some(row) = self
                .data
                .at(density, young, ratio, velocity)
                .filter(|row| row.ok())
            else {
                continue;
            };
            let (force, displacement) = (row.yield_force(), row.yield_displacement());
            tops.push((row.displacement / displacement, row.force / force));
            if let Some(impact) = impact(row) {
                let (newton, metre) = (
                    row.young_modulus * row.radius.powi(2) / force,
                    row.radius / displacement,
                );
                let point =
                    |s: &crate::curve::Sample| (s.displacement_m * metre, s.force_n * newton);
                let points = impact.curve.samples.iter().map(point).collect();
                all.push(series(
                    &format!("{velocity} m/s"),
                    Role::Other,
                    Mark::Line,
                    points,
                ));
            }
        }
        if tops.is_empty() {
            return Ok(None);
        }
        all.push(series("δ*, F*", Role::Simulation, Mark::Points, tops));
        let chart = Chart {
            x: Axis::new("δ/δ_y", ""),
            y: Axis::new("F/F_y", ""),
            series: all,
        };
        let caption =
            "4-12: force over displacement, ρ 8000 kg/m³, E 100 GPa, E/Y 80, 10 to 50 m/s"
                .to_owned();
        Figure::chart("figure_4_12".to_owned(), caption, chart).map(Some)
    }

    /// 4-17: the cases of table 4-5 in other sizes, which are the same run.
    fn sizes(&self) -> Result<Option<Figure>> {
        let mut all = Vec::new();
        for (k, (velocity, density, young, strength)) in SIZES.into_iter().enumerate() {
            let Some(row) = self
                .data
                .at(density, young, young / strength, velocity)
                .filter(|row| row.ok())
            else {
                continue;
            };
            let point = |diameter: f64| {
                let larger = (0.5 * diameter / row.radius).powi(2);
                (2.0 * row.force_scale() * larger, row.force * larger)
            };
            all.push(series(
                &format!("case {}", k + 1),
                Role::Other,
                Mark::Points,
                DIAMETERS.map(point).to_vec(),
            ));
        }
        if all.is_empty() {
            return Ok(None);
        }
        let (from, to) = reach(&all);
        all.push(series(
            "thesis, its constants",
            Role::Simulation,
            Mark::Line,
            line(from, to, |x| x),
        ));
        let newton = |label: &str| Axis {
            unit: "N",
            ..axis(label)
        };
        let chart = Chart {
            x: newton("2πR²(YρV²)^½"),
            y: newton("F*"),
            series: all,
        };
        let caption =
            "4-17 a: largest force of the cases of table 4-5, diameters of 100 to 1000 µm"
                .to_owned();
        Figure::chart("figure_4_17".to_owned(), caption, chart).map(Some)
    }
}
