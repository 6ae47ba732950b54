//! Inverse command: measured impacts to the yield strength, or yield strength and hardening modulus, that they tell.

use super::impact::interval;
use super::material_args::{FILE, MaterialArgs};
use super::show::inverse::{Asked, FoundCase, Report};
use super::study_runs::{queue, run_folder, simulated};
use super::{Command, Context, Verdict, output_folder, print_json};
use crate::atlas::Atlas;
use crate::case::Case;
use crate::curve::{Impact, Status};
use crate::files::{sha256, text, write_atomic};
use crate::inverse::confidence::{Sampling, intervals};
use crate::inverse::measurement::{LARGEST_SHARE, Measurements, Taken, Uncertainty};
use crate::inverse::model::{Known, Point};
use crate::inverse::refine::{Run, refine};
use crate::inverse::search::{Problem, Unknowns};
use crate::material::flow::{HARDENING_MODULUS, YIELD_STRENGTH};
use crate::material::{Flow, Material};
use crate::study::{Groups, Study};
use crate::unit::{Length, Pressure, argument};
use crate::{Error, Result};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Estimate the yield strength of a material, or that and its hardening, from measured impacts, with intervals.
#[derive(Debug, Args)]
pub struct InverseArgs {
    /// Table of measured impacts: `velocity_m_s` and `restitution`, `compression_ratio` or `flat_diameter_um`; further columns such
    /// as `restitution_sigma`, `velocity_sigma_m_s`, `radius_um` (guide, "From impacts to a material").
    pub measurements: PathBuf,
    /// Case file with radius and material; its yield strength is not looked at.
    #[arg(long, id = FILE, value_name = "CASE")]
    pub case: Option<PathBuf>,
    /// The material, and the radius of particles whose row has none.
    #[command(flatten)]
    pub material: MaterialArgs,
    /// What is sought.
    #[arg(long, value_delimiter = ',', default_value = "yield")]
    pub estimate: Vec<Sought>,
    /// Hardening modulus where it is not sought, e.g. `1GPa` (default: that of the case, or none).
    #[arg(long)]
    pub hardening: Option<String>,
    /// Standard deviation of e, for rows without `restitution_sigma`.
    #[arg(long, value_name = "SIGMA")]
    pub sigma_restitution: Option<f64>,
    /// Standard deviation of the compression ratio, for rows without their own.
    #[arg(long, value_name = "SIGMA")]
    pub sigma_compression_ratio: Option<f64>,
    /// Standard deviation of the flat's diameter, e.g. `1um`, for rows without their own.
    #[arg(long, value_name = "SIGMA")]
    pub sigma_flat_diameter: Option<String>,
    /// Standard deviation of each speed over it, e.g. `0.02`, for rows without their own.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_velocity: f64,
    /// Standard deviation of Young's modulus over it: all rows share it.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_young: f64,
    /// Standard deviation of the radius over it, which all rows without their own share.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0)]
    pub sigma_radius: f64,
    /// Take a flat for the base of a spherical cap that is cut off, as is often published, and not for the contact with its pile-up.
    #[arg(long)]
    pub cap: bool,
    /// Run impacts at the estimate, correct the atlas by them and estimate again, until it settles.
    #[arg(long)]
    pub refine: bool,
    /// Tolerance of these impacts; the estimate has settled when it moves by less than a tenth of it.
    #[arg(long, default_value_t = 0.02)]
    pub tolerance: f64,
    /// Draws for the intervals.
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(200..=100_000))]
    pub draws: u32,
    /// Seed of the draws.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Output folder (default: `out/` and the name of the table).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Print what `inverse.toml` holds as JSON.
    #[arg(long)]
    pub json: bool,
    /// How often a run of `--refine` saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

/// A constant that can be sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sought {
    /// Yield strength Y.
    Yield,
    /// Hardening modulus H.
    Hardening,
}

impl Command for InverseArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw inverse cases/inverse/steel.csv --young 100GPa --poisson 0.35 --density 8000kg/m3 --radius 250um",
        "impactlaw inverse cases/inverse/steel.csv --case cases/thesis-4-4.toml --sigma-young 0.03 --refine",
    ];

    /// Estimate, draw the intervals, and write `inverse.toml` and a case with the material that was found; [`Verdict::Missed`] when the
    /// refinement does not settle.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Refused`] for rows that do not determine what is sought.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let interval = interval(&self.checkpoint)?;
        let unknowns = self.unknowns()?;
        let uncertainty = self.uncertainty()?;
        let (known, radius) = self.known(unknowns)?;
        let (hash, read) = self.measured(Taken {
            radius,
            uncertainty,
            cap: self.cap,
        })?;
        let velocities = read.velocities();
        let atlas = Atlas::built_in()?;
        let mut problem = Problem::new(&atlas, known, read.all, unknowns)?;
        let sampling = Sampling {
            draws: self.draws as usize,
            seed: self.seed,
            young_modulus: self.sigma_young,
            radius: self.sigma_radius,
            atlas: false,
        };
        let name = self.measurements.file_stem().unwrap_or_default();
        let found = FoundCase {
            radius,
            velocities: &velocities,
            tolerance: self.tolerance,
        };
        // what no case file may have is said before anything is run
        let [low, high] = problem.strengths();
        let middle = Point {
            strength: 0.5 * (low + high),
            hardening: None,
        };
        found.text(&known.material(&middle))?;
        let mut estimate = problem.estimate()?;
        let first = estimate.point.constants(&known);
        let mut measured = intervals(&problem, &estimate, &sampling)?;
        let with_atlas = Sampling {
            atlas: true,
            ..sampling
        };
        let mut whole = match self.refine {
            true => measured,
            false => intervals(&problem, &estimate, &with_atlas)?,
        };
        let out = output_folder(self.out.as_deref(), &name.to_string_lossy())?;
        context.open_log(&out, "inverse", &hash);
        let (mut rounds, mut settled) = (Vec::new(), true);
        if self.refine {
            let run = |material: &Material, speeds: &[f64]| {
                self.runs(material, speeds, &hash, &out, interval, context)
            };
            (estimate, rounds, settled) =
                refine(&mut problem, estimate, 0.1 * self.tolerance, run)?;
            measured = intervals(&problem, &estimate, &sampling)?;
            whole = measured;
        }
        let asked = Asked {
            sampling,
            velocity: self.sigma_velocity,
            radius,
            cap: self.cap,
            refined: self.refine.then_some(self.tolerance),
        };
        let both = [&measured, &whole];
        let report = Report::of(&asked, &problem, &estimate, both, first, &rounds);
        let case = found.text(&known.material(&estimate.point))?;
        let target = write(&out, &context.provenance(&hash), &report, &case)?;
        match self.json {
            true => print_json(&report)?,
            false => context.say(&format!(
                "{}-> {}\n",
                report.text(settled),
                target.display()
            ))?,
        }
        if !settled {
            tracing::warn!("the refinement did not settle within a tenth of the tolerance");
        }
        Ok(match settled {
            true => Verdict::Met,
            false => Verdict::Missed,
        })
    }
}

/// Writes `case.toml` and `inverse.toml`; the path of the latter.
fn write(out: &Path, provenance: &str, report: &Report, case: &str) -> Result<PathBuf> {
    let case = format!("# {provenance}\n{case}");
    write_atomic(&out.join("case.toml"), case.as_bytes())?;
    let target = out.join("inverse.toml");
    let text = toml::to_string(report)
        .map_err(|error| Error::file("write", &target)(std::io::Error::other(error)))?;
    write_atomic(&target, format!("# {provenance}\n{text}").as_bytes())?;
    Ok(target)
}

impl InverseArgs {
    /// The measurements, and the SHA-256 of their file.
    fn measured(&self, taken: Taken) -> Result<(String, Measurements)> {
        let path = &self.measurements;
        let bytes = std::fs::read(path).map_err(Error::file("read", path))?;
        let hash = sha256([&bytes]);
        let read = Measurements::parse(&text(bytes, path)?, path, &taken)?;
        for column in &read.unused {
            tracing::warn!("column `{column}` is not used");
        }
        Ok((hash, read))
    }

    fn unknowns(&self) -> Result<Unknowns> {
        let hardening = self.estimate.contains(&Sought::Hardening);
        if !self.estimate.contains(&Sought::Yield) {
            return Err(Error::Argument {
                argument: "--estimate".to_owned(),
                found: "`hardening`".to_owned(),
                allowed: "must be `yield` or `yield,hardening`".to_owned(),
            });
        }
        if hardening && self.hardening.is_some() {
            return Err(Error::Argument {
                argument: "--hardening".to_owned(),
                found: "a value of what is sought".to_owned(),
                allowed: "must be left out, or `hardening` of --estimate".to_owned(),
            });
        }
        Ok(match hardening {
            true => Unknowns::YieldAndHardening,
            false => Unknowns::Yield,
        })
    }

    /// What is known of the material, and the radius, checked as those of a case are.
    fn known(&self, unknowns: Unknowns) -> Result<(Known, f64)> {
        let given = self.hardening.as_deref();
        let given = given.map(|text| argument::<Pressure>("--hardening", text));
        let given = given.transpose()?;
        if let Some(modulus) = given.filter(|modulus| !(*modulus >= 0.0)) {
            return Err(Error::Argument {
                argument: "--hardening".to_owned(),
                found: modulus.to_string(),
                allowed: "must be 0 or more".to_owned(),
            });
        }
        let case = match &self.case {
            Some(path) => Case::read(path)?,
            None => self.material.case("arguments", self.tolerance, None, &[])?,
        };
        case.of_a_normal_impact("the atlas")?;
        case.of_own_scheme("the atlas")?;
        let mut hardening = 0.0;
        for (constant, value) in case.material.flow.iter().flat_map(Flow::constants) {
            match constant {
                constant if constant == YIELD_STRENGTH => {}
                constant if constant == HARDENING_MODULUS => hardening = value,
                other => {
                    return Err(Error::Refused {
                        what: format!("{}", case.path.display()),
                        found: format!("`{}`", other.key),
                        allowed:
                            "must be left out: the atlas knows yield strength and linear hardening"
                                .to_owned(),
                    });
                }
            }
        }
        let known = Known {
            density: case.material.density,
            young_modulus: case.material.young_modulus,
            poisson_ratio: case.material.poisson_ratio,
            hardening: match unknowns {
                Unknowns::Yield => given.unwrap_or(hardening),
                Unknowns::YieldAndHardening => 0.0,
            },
        };
        Ok((known, case.radius))
    }

    fn uncertainty(&self) -> Result<Uncertainty> {
        let refuse = |argument: &str, found: f64, allowed: &str| Error::Argument {
            argument: argument.to_owned(),
            found: found.to_string(),
            allowed: allowed.to_owned(),
        };
        for (name, share) in [
            ("--sigma-velocity", self.sigma_velocity),
            ("--sigma-young", self.sigma_young),
            ("--sigma-radius", self.sigma_radius),
        ] {
            if !(0.0..=LARGEST_SHARE).contains(&share) {
                let allowed = "is a share of the value and must lie in [0, 0.5], e.g. 0.02";
                return Err(refuse(name, share, allowed));
            }
        }
        if !(self.tolerance > 0.0 && self.tolerance <= 0.2) {
            let allowed = "must lie in (0, 0.2], e.g. 0.02";
            return Err(refuse("--tolerance", self.tolerance, allowed));
        }
        let diameter = match &self.sigma_flat_diameter {
            Some(text) => Some(argument::<Length>("--sigma-flat-diameter", text)?),
            None => None,
        };
        for (name, sigma) in [
            ("--sigma-restitution", self.sigma_restitution),
            ("--sigma-compression-ratio", self.sigma_compression_ratio),
            ("--sigma-flat-diameter", diameter),
        ] {
            if let Some(sigma) = sigma.filter(|s| !(*s > 0.0 && *s < 1.0)) {
                return Err(refuse(name, sigma, "must lie between 0 and 1"));
            }
        }
        Ok(Uncertainty {
            restitution: self.sigma_restitution,
            compression_ratio: self.sigma_compression_ratio,
            flat_diameter: diameter,
            velocity: self.sigma_velocity,
            young_modulus: self.sigma_young,
            radius: self.sigma_radius,
        })
    }

    /// Impacts of a material, kept in the folder as those of a study are.
    fn runs(
        &self,
        material: &Material,
        speeds: &[f64],
        hash: &str,
        out: &Path,
        interval: Duration,
        context: &Context,
    ) -> Result<Vec<Run>> {
        let case = |speed: &f64| Case::of("inverse", 1.0, *material, &[*speed], self.tolerance);
        let cases = speeds.iter().map(case).collect::<Result<_>>()?;
        let study = Study::made_from(hash, "inverse", cases);
        simulated(&study, queue(&study), &[out], interval, context)?;
        let mut runs = Vec::new();
        for case in &study.cases {
            let groups = Groups::of(case);
            let impact = Impact::read(&run_folder(out, &groups.name()))?;
            let summary = &impact.summary;
            if summary.status != Status::Ok || !(summary.restitution > 0.0) {
                return Err(Error::Refused {
                    what: format!("impact at {} m/s", case.velocities[0]),
                    found: format!("{:?}, e = {}", summary.status, summary.restitution),
                    allowed: "must come back for --refine; leave out the fastest rows".to_owned(),
                });
            }
            let widest = impact.curve.samples.iter().map(|s| s.contact_radius_m);
            runs.push(Run {
                restitution: summary.restitution,
                compression_ratio: summary.compression_ratio,
                // kept runs are of a body with R = 1
                contact_radius: widest.fold(0.0, f64::max),
            });
        }
        Ok(runs)
    }
}
