//! Command line: the clap types, one struct a verb. Verbs are the arrows of the data flow.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// Contact laws for discrete-element codes, from simulated impacts of yielding particles.
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
    /// Worker threads (0: all cores). Results do not depend on it.
    #[arg(long, global = true, default_value_t = 0)]
    pub threads: usize,
    /// More output: -v progress of every stage, -vv solver detail.
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Print errors only.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Run everything: plan, impacts, fit, comparison, bed, report.
    Run(RunArgs),
    /// Print what would be run, why, and the predicted seconds.
    Plan(PlanArgs),
    /// Simulate the impacts of a case: `curve.csv` and `summary.json` for each speed.
    Impact(ImpactArgs),
    /// Fit a contact law to simulated impacts: `law.toml`.
    Fit(FitArgs),
    /// Compare a law and the theories with simulated impacts: `compare.csv`, table, plots.
    Compare(CompareArgs),
    /// Evaluate a theory: force against displacement, or restitution against velocity, as CSV.
    Theory(TheoryArgs),
    /// Run a granular bed from a scene file.
    Bed(BedArgs),
    /// Run a grid of cases, equal dimensionless groups once: `results.csv`. Finished runs are kept and not repeated.
    Study(StudyArgs),
    /// Show what accuracy costs: ladders over grid, points, time step and scheme; errors against wall time.
    Cost(CostArgs),
    /// Write a law for other codes, and check there that it is the same law.
    Export(ExportArgs),
    /// Work with a law file.
    Law {
        /// What to do with it.
        #[command(subcommand)]
        verb: LawVerb,
    },
}

/// Verbs on a law file.
#[derive(Debug, Subcommand)]
pub enum LawVerb {
    /// Print F(delta) as CSV: the law at rest, without the inertia term of a fast first loading.
    Eval(LawEvalArgs),
}

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// Case file.
    pub case: PathBuf,
    /// Output folder (default: `out/<case name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Skip the bed even if the case names a scene.
    #[arg(long)]
    pub no_bed: bool,
    /// Random seed (bed insertion), overriding the scene's.
    #[arg(long)]
    pub seed: Option<u64>,
}

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
}

/// Arguments of `impact`.
#[derive(Debug, Args)]
pub struct ImpactArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Output folder (default: `out/<case name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct FitArgs {
    /// Case file the impacts were made from.
    pub case: PathBuf,
    /// Folder that holds the `impact_V*` folders (default: `out/<case name>`).
    #[arg(short, long)]
    pub impacts: Option<PathBuf>,
    /// Law file to write (default: `law.toml` in that folder).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// Case file the impacts were made from.
    pub case: PathBuf,
    /// Law file (default: `law.toml` in the impacts' folder).
    #[arg(short, long)]
    pub law: Option<PathBuf>,
    /// Folder that holds the `impact_V*` folders (default: `out/<case name>`).
    #[arg(short, long)]
    pub impacts: Option<PathBuf>,
    /// Output folder (default: the impacts' folder).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Arguments of `theory`.
#[derive(Debug, Args)]
pub struct TheoryArgs {
    /// Model name, e.g. `hertz`, `thornton`, `kogut-etsion`.
    pub model: String,
    /// Case file: radius and material.
    pub case: PathBuf,
    /// Displacements with units, e.g. `"1 um"`; prints `displacement_m,force_N,contact_radius_m`.
    #[arg(long, num_args = 1.., value_delimiter = ',')]
    pub displacements: Vec<String>,
    /// Largest displacement reached before: the displacements lie on the unloading branch.
    #[arg(long)]
    pub max_displacement: Option<String>,
    /// Speeds with units; prints `velocity_m_s,restitution`.
    #[arg(long, num_args = 1.., value_delimiter = ',', conflicts_with = "displacements")]
    pub velocities: Vec<String>,
}

/// Arguments of `bed`.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true
)]
pub struct BedArgs {
    /// What to do other than run the scene here.
    #[command(subcommand)]
    pub verb: Option<BedVerb>,
    /// The run.
    #[command(flatten)]
    pub run: Option<BedRunArgs>,
}

/// Verbs on a scene.
#[derive(Debug, Subcommand)]
pub enum BedVerb {
    /// Write the packing, walls, piston, law and stages of a scene for LAMMPS or LIGGGHTS, which run it on many processors.
    Export(BedExportArgs),
}

/// Arguments of `bed export`.
#[derive(Debug, Args)]
pub struct BedExportArgs {
    /// Scene file.
    pub scene: PathBuf,
    /// Code to write for: `lammps` or `liggghts`.
    #[arg(long)]
    pub to: String,
    /// Law file for the grains whose law the scene calls `fitted`.
    #[arg(short, long)]
    pub law: Option<PathBuf>,
    /// Output folder (default: `out/<scene name>`); files go into a subfolder named after the code.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Insertion seed, overriding the scene's.
    #[arg(long)]
    pub seed: Option<u64>,
}

/// Arguments of `bed` for a run.
#[derive(Debug, Args)]
pub struct BedRunArgs {
    /// Scene file.
    pub scene: PathBuf,
    /// Law file for the grains whose law the scene calls `fitted`.
    #[arg(short, long)]
    pub law: Option<PathBuf>,
    /// Output folder (default: `out/<scene name>`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Insertion seed, overriding the scene's.
    #[arg(long)]
    pub seed: Option<u64>,
    /// How often a run saves a checkpoint, from which the same command resumes after an interruption.
    #[arg(long, default_value = "30 s")]
    pub checkpoint: String,
}

/// Arguments of `study`.
#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Study file.
    pub study: PathBuf,
    /// Output folder; by default `out/` and the study's name.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Also run this many cases, drawn over the whole range, with cells of half the size, and compare the change with
    /// the tolerance.
    #[arg(long, default_value_t = 0)]
    pub refine: usize,
}

/// Arguments of `cost`.
#[derive(Debug, Args)]
pub struct CostArgs {
    /// Case file.
    pub case: PathBuf,
    /// Speeds, overriding the case's fastest, e.g. `--velocity "10 m/s"`.
    #[arg(long)]
    pub velocity: Vec<String>,
    /// Coarse ladders only: less than a minute.
    #[arg(long)]
    pub quick: bool,
    /// Ladders to run beside the reference, selected by the start of their names, e.g. `--ladder cells` (default: all).
    #[arg(long)]
    pub ladder: Vec<String>,
    /// Skip runs predicted to take longer than this.
    #[arg(long, default_value = "2 min")]
    pub longest: String,
    /// Output folder (default: `out/<case name>`); files go to `cost` in it, and finished runs are kept there.
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Arguments of `law eval`.
#[derive(Debug, Args)]
pub struct LawEvalArgs {
    /// Law file.
    pub law: PathBuf,
    /// Radius of the body with unit, e.g. `"250 um"`.
    #[arg(long)]
    pub body: String,
    /// Displacements with units, e.g. `"1 um"`.
    #[arg(long, num_args = 1.., value_delimiter = ',', required = true)]
    pub displacements: Vec<String>,
    /// Largest displacement reached before: the displacements lie on the unloading branch.
    #[arg(long)]
    pub max_displacement: Option<String>,
}

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Law file.
    pub law: PathBuf,
    /// Targets: `c`, `liggghts`, `lammps`, `table`, `native`, `deme`, `mercurydpm`; several separated by commas, or `all`.
    #[arg(long, num_args = 1.., value_delimiter = ',')]
    pub to: Vec<String>,
    /// Form of the law, overriding the file's: `closed_form`, `spline` or `hertz`.
    #[arg(long)]
    pub form: Option<String>,
    /// Law file of a second material: contacts of the two, for target `c`.
    #[arg(long)]
    pub with: Option<PathBuf>,
    /// Output folder (default: `out/<law name>/export`).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
    /// Compile and run the law in the codes that are installed, and print how well they agree.
    #[arg(long)]
    pub check: bool,
}
