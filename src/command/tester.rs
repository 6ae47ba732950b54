//! Command `tester`: speeds of a single-particle impact tester, what they do to the particle, and constants from measured speeds.

use super::material_args::MaterialArgs;
use super::show::inverse::FoundCase;
use super::show::tester::{Answer, Found, Throw};
use super::{Command, Context, Verdict, print, print_json};
use crate::atlas::Atlas;
use crate::files::{self, write_atomic};
use crate::inverse::model::{Correction, Known, Model, Point};
use crate::material::flow::{HARDENING_MODULUS, LinearHardening, YIELD_STRENGTH};
use crate::material::{Flow, Material};
use crate::tester::fall::fall;
use crate::tester::fit::{Fitted, Measured, Undetermined, by_steps, determination, together};
use crate::tester::table::parse;
use crate::tester::{Air, Deviations, POLYMERS_AND_GLASS, Particle, Support, Tester, WITH_SOLDER};
use crate::unit::{Density, Length, Pressure, Viscosity, argument, significant};
use crate::{Error, Result};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Speed at which a single-particle impact tester throws a particle, by the correlation of Saifoori (2025), with e and compression by the
/// atlas where the material is given; or the correlation's constants from measured speeds.
#[derive(Debug, Args)]
pub struct TesterArgs {
    /// Diameter of the particle, e.g. `500um`.
    #[arg(long, required_unless_present = "measured", requires = "density")]
    pub diameter: Option<String>,
    /// Its density, e.g. `7274kg/m3`.
    #[arg(long, requires = "diameter")]
    pub density: Option<String>,
    /// Gauge pressures of the vacuum, e.g. `10kPa`; `0kPa` is a fall through still air.
    #[arg(long, num_args = 1.., value_delimiter = ',', requires = "diameter")]
    pub pressure: Vec<String>,
    /// Constants of the correlation: those found with solder balls, or those of polymers and glass alone.
    #[arg(
        long,
        value_enum,
        default_value = "solder",
        conflicts_with = "measured"
    )]
    pub constants: Printed,
    /// Measured speeds, from which the constants are found and then used: a CSV file with the columns `density_kg_m3`, `diameter_um`,
    /// `gauge_pressure_kPa`, `velocity_m_s`, in these or other units.
    #[arg(long, value_name = "CSV")]
    pub measured: Option<PathBuf>,
    /// Density of the air.
    #[arg(long, default_value = "1.204 kg/m3")]
    pub air_density: String,
    /// Dynamic viscosity of the air.
    #[arg(long, default_value = "18.1 uPa s")]
    pub air_viscosity: String,
    /// Length of the tube.
    #[arg(long, default_value = "401 mm")]
    pub tube: String,
    /// Standard deviation of the pressure over it.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_pressure: f64,
    /// Standard deviation of the diameter over it.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_diameter: f64,
    /// Standard deviation of the particle's density over it.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_density: f64,
    /// Scatter of measured speeds about the correlation, over the speed; of `--measured` it is found.
    #[arg(long, value_name = "SHARE", conflicts_with = "measured")]
    pub scatter: Option<f64>,
    /// Young's modulus of the particle: with it, Poisson's ratio and yield strength, e and compression ratio are given.
    #[arg(long, requires_all = ["poisson", "strength", "diameter"])]
    pub young: Option<String>,
    /// Poisson's ratio.
    #[arg(long, requires = "young")]
    pub poisson: Option<String>,
    /// Yield strength, e.g. `97.59MPa`.
    #[arg(long = "yield", requires = "young")]
    pub strength: Option<String>,
    /// Hardening modulus, e.g. `1GPa`.
    #[arg(long, requires = "young")]
    pub hardening: Option<String>,
    /// Case file to write, with the material and these speeds.
    #[arg(short, long, value_name = "CASE", requires = "young")]
    pub out: Option<PathBuf>,
    /// Print as JSON.
    #[arg(long)]
    pub json: bool,
}

/// A printed set of constants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Printed {
    /// Equation (6-7).
    Solder,
    /// Equation (6-6).
    Polymers,
}

/// Deviations in an interval of 95 %.
const DEVIATIONS: f64 = 1.959_964;
/// Most gauge pressure that a vacuum has, Pa.
const ATMOSPHERE: f64 = 101_325.0;
/// What is said of another gauge pressure.
const NO_VACUUM: &str = "must be 0 to 101 kPa: what a vacuum is below the air, counted positive";
/// Tolerance of a case that is written.
const TOLERANCE: f64 = 0.02;

impl Command for TesterArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw tester --diameter 500um --density 7274kg/m3 --pressure 0kPa,10kPa,15kPa,20kPa --sigma-diameter 0.02",
        "impactlaw tester --diameter 500um --density 7274kg/m3 --pressure 10kPa --young 59.82GPa --poisson 0.33 --yield 97.59MPa -o solder.toml",
        "impactlaw tester --measured cases/inverse/tester-synthetic.csv",
    ];

    /// Print the speeds, and the constants where they are found; write the case.
    ///
    /// # Errors
    /// [`Error::Argument`] and [`Error::Refused`] for arguments, [`Error::Value`] for measured speeds that are none or do not determine the
    /// constants, and for a material outside the atlas.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let mut tester = self.tester()?;
        let deviations = self.deviations()?;
        let (mut support, mut measured, mut found) = (self.support(), None, None);
        if let Some(path) = &self.measured {
            let text = files::read_text(path)?;
            let all = parse(&text, path)?;
            let (fitted, said) = constants(&tester, &all, path)?;
            tester.constants = fitted.constants;
            support = support_of(&all);
            (measured, found) = (Some(fitted), Some(said));
        }
        let mut throws = Vec::new();
        if let Some(particle) = self.particle(&tester.air)? {
            if self.pressure.is_empty() {
                return Err(Error::Argument {
                    argument: "--pressure".to_owned(),
                    found: "none".to_owned(),
                    allowed: "must be given with a diameter, e.g. `10kPa`".to_owned(),
                });
            }
            for text in &self.pressure {
                let pressure = self.gauge(text)?;
                if throws
                    .iter()
                    .any(|throw: &Throw| throw.gauge_pressure_pa == pressure)
                {
                    return Err(refused("--pressure", text, "must be given once"));
                }
                let of_fit = |fit: &Fitted| fit.half_width(&tester, &particle, pressure);
                let spread = Spread {
                    given: &deviations,
                    of_fit: measured.as_ref().map_or(0.0, of_fit),
                };
                throws.push(throw(&tester, &particle, pressure, &spread, &support));
            }
            self.hit(&particle, &mut throws, context)?;
        }
        let answer = Answer {
            constants: tester.constants.values,
            found,
            throws,
        };
        match self.json {
            true => print_json(&answer)?,
            false => print(&answer.text())?,
        }
        Ok(Verdict::Met)
    }
}

impl TesterArgs {
    fn tester(&self) -> Result<Tester> {
        let positive = |name: &str, given: &str, value: f64| match value > 0.0 {
            true => Ok(value),
            false => Err(refused(name, given, "must be positive")),
        };
        let density = argument::<Density>("--air-density", &self.air_density)?;
        let viscosity = argument::<Viscosity>("--air-viscosity", &self.air_viscosity)?;
        let tube = argument::<Length>("--tube", &self.tube)?;
        Ok(Tester {
            air: Air {
                density: positive("--air-density", &self.air_density, density)?,
                viscosity: positive("--air-viscosity", &self.air_viscosity, viscosity)?,
            },
            tube: positive("--tube", &self.tube, tube)?,
            constants: match self.constants {
                Printed::Solder => WITH_SOLDER,
                Printed::Polymers => POLYMERS_AND_GLASS,
            },
        })
    }

    fn support(&self) -> Support {
        match self.constants {
            Printed::Solder => Support::with_solder(),
            Printed::Polymers => Support::of_polymers_and_glass(),
        }
    }

    fn deviations(&self) -> Result<Deviations> {
        let share = |name: &str, value: f64| match (0.0..0.5).contains(&value) {
            true => Ok(value),
            false => Err(refused(
                name,
                &value.to_string(),
                "must be a share from 0 to 0.5, 0.02 for 2 %",
            )),
        };
        Ok(Deviations {
            pressure: share("--sigma-pressure", self.sigma_pressure)?,
            diameter: share("--sigma-diameter", self.sigma_diameter)?,
            density: share("--sigma-density", self.sigma_density)?,
            scatter: share("--scatter", self.scatter.unwrap_or(0.0))?,
        })
    }

    fn particle(&self, air: &Air) -> Result<Option<Particle>> {
        let (Some(diameter), Some(density)) = (&self.diameter, &self.density) else {
            return Ok(None);
        };
        let particle = Particle {
            diameter: argument::<Length>("--diameter", diameter)?,
            density: argument::<Density>("--density", density)?,
        };
        // what an air stream can throw; beside it, slips of a unit
        if !(1e-7..=0.05).contains(&particle.diameter) {
            let allowed = "must be 0.1 um to 50 mm: check the unit";
            return Err(refused("--diameter", diameter, allowed));
        }
        if !(10.0 * air.density..=3e4).contains(&particle.density) {
            let allowed = "must be ten times that of the air to 30000 kg/m3: check the unit";
            return Err(refused("--density", density, allowed));
        }
        Ok(Some(particle))
    }

    /// A gauge pressure, Pa.
    fn gauge(&self, text: &str) -> Result<f64> {
        let pressure = argument::<Pressure>("--pressure", text)?;
        match (0.0..ATMOSPHERE).contains(&pressure) {
            true => Ok(pressure),
            false => Err(refused("--pressure", text, NO_VACUUM)),
        }
    }

    /// The particle's material, held to what a case file is.
    fn material(&self, strength: f64, hardening: f64, radius: f64) -> Result<Material> {
        let flow = match hardening {
            0.0 => Flow::perfectly_plastic(strength),
            modulus => LinearHardening { strength, modulus }.into(),
        };
        let elastic = MaterialArgs {
            young: self.young.clone(),
            poisson: self.poisson.clone(),
            density: self.density.clone(),
            radius: Some(format!("{radius:e} m")),
        };
        let told = [
            (YIELD_STRENGTH, "--yield", &self.strength),
            (HARDENING_MODULUS, "--hardening", &self.hardening),
        ];
        let case = elastic.case("tester", TOLERANCE, Some(flow), &told)?;
        Ok(case.material)
    }

    /// What the throws do to the particle, by the atlas, and the case of them.
    fn hit(&self, particle: &Particle, throws: &mut [Throw], context: &Context) -> Result<()> {
        let (Some(_), Some(given)) = (&self.young, &self.strength) else {
            return Ok(());
        };
        let strength = argument::<Pressure>("--yield", given)?;
        let hardening = match &self.hardening {
            Some(given) => argument::<Pressure>("--hardening", given)?,
            None => 0.0,
        };
        let radius = 0.5 * particle.diameter;
        let material = self.material(strength, hardening, radius)?;
        let known = Known {
            density: material.density,
            young_modulus: material.young_modulus,
            poisson_ratio: material.poisson_ratio,
            hardening,
        };
        let point = Point {
            strength: strength.ln(),
            hardening: None,
        };
        let velocities: Vec<f64> = throws.iter().map(|throw| throw.velocity_m_s).collect();
        let case = FoundCase {
            radius,
            velocities: &velocities,
            tolerance: TOLERANCE,
        }
        .text(&material)?;
        let atlas = Atlas::built_in()?;
        let model = Model {
            atlas: &atlas,
            known,
            correction: Correction::default(),
        };
        let told = model.told(&point, &velocities)?;
        let [slowest, fastest] = atlas.velocities(&material);
        for (throw, [restitution, compression, _]) in throws.iter_mut().zip(told) {
            if (slowest..=fastest).contains(&throw.velocity_m_s) {
                throw.restitution = Some(restitution);
                throw.compression_ratio = Some(compression);
            } else {
                throw.notes.push(format!(
                    "the atlas knows this material from {} to {} m/s",
                    significant(slowest, 3),
                    significant(fastest, 3)
                ));
            }
        }
        if let Some(path) = &self.out {
            let text = format!("# {}; {}\n{case}", crate::PROGRAM, context.command);
            write_atomic(path, text.as_bytes())?;
            tracing::info!("case -> {}", path.display());
        }
        Ok(())
    }
}

fn refused(argument: &str, found: &str, allowed: &str) -> Error {
    Error::Argument {
        argument: argument.to_owned(),
        found: format!("\"{found}\""),
        allowed: allowed.to_owned(),
    }
}

/// What makes the speed of a throw uncertain.
struct Spread<'a> {
    /// Standard deviations that were given.
    given: &'a Deviations,
    /// Half the width of its 95 % interval by the fit of measured speeds, over the speed.
    of_fit: f64,
}

/// One throw, and what has to be known of it.
fn throw(
    tester: &Tester,
    particle: &Particle,
    pressure: f64,
    spread: &Spread<'_>,
    support: &Support,
) -> Throw {
    let fallen = fall(particle, tester.tube, &tester.air);
    if pressure == 0.0 {
        return Throw {
            gauge_pressure_pa: pressure,
            velocity_m_s: fallen,
            interval_m_s: None,
            restitution: None,
            compression_ratio: None,
            notes: vec!["falls through still air; the correlation gives no speed".to_owned()],
        };
    }
    let velocity = tester.speed(particle, pressure);
    let half = spread
        .of_fit
        .hypot(DEVIATIONS * tester.deviation(particle, spread.given));
    let mut notes = Vec::new();
    let lacks = support.lacks(particle, pressure);
    if !lacks.is_empty() {
        notes.push(format!(
            "extrapolated: {} outside the measurements the constants are from",
            lacks.join(" and ")
        ));
    }
    if velocity < fallen {
        notes.push(format!(
            "slower than a fall, {} m/s: too small a pressure for the correlation",
            significant(fallen, 3)
        ));
    }
    Throw {
        gauge_pressure_pa: pressure,
        velocity_m_s: velocity,
        interval_m_s: (half > 0.0).then(|| [-half, half].map(|half| velocity * half.exp())),
        restitution: None,
        compression_ratio: None,
        notes,
    }
}

/// Constants from measured speeds, and what is said of them.
fn constants(tester: &Tester, all: &[Measured], path: &Path) -> Result<(Fitted, Found)> {
    let refuse =
        |key: &str, found: String, allowed: &str| Error::in_table(path, key, found, allowed);
    for one in all {
        if one.particle.density <= tester.air.density {
            let found = one.particle.density.to_string();
            return Err(refuse(
                "density_kg_m3",
                found,
                "must be above that of the air",
            ));
        }
        if one.pressure >= ATMOSPHERE {
            let found = one.pressure.to_string();
            return Err(refuse("gauge_pressure_Pa", found, NO_VACUUM));
        }
    }
    let refuse = |Undetermined { constant, wants }: Undetermined| {
        let found = format!("{} speeds that do not determine it", all.len());
        refuse(constant, found, &format!("needs {wants}"))
    };
    let fitted = together(tester, all).map_err(refuse)?;
    let steps = by_steps(tester, all).map_err(refuse)?;
    let with = |constants| Tester {
        constants,
        ..*tester
    };
    let found = Found {
        speeds: all.len(),
        half_widths_95: fitted.half_widths,
        scatter: fitted.scatter,
        determination: determination(&with(fitted.constants), all),
        by_steps: steps.values,
        by_steps_determination: determination(&with(steps), all),
    };
    Ok((fitted, found))
}

/// Range of measured speeds.
fn support_of(all: &[Measured]) -> Support {
    let range = |of: fn(&Measured) -> f64| {
        let [low, high] = all
            .iter()
            .map(of)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x: f64| {
                [low.min(x), high.max(x)]
            });
        low..=high
    };
    Support {
        pressures: range(|one| one.pressure),
        diameters: range(|one| one.particle.diameter),
        densities: range(|one| one.particle.density),
    }
}
