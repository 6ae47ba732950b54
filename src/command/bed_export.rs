//! `bed export`: a scene file to the packing, walls, law and input script of a code that runs it on many processors.

use super::{Command, Context, Verdict, on_a_worker, output_folder, print};
use crate::Result;
use crate::bed::run::Options;
use crate::bed::run::packing::packed;
use crate::bed::scene::Scene;
use crate::export::scene::{self, Code};
use crate::files::write_atomic;
use crate::law::LawFile;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

/// Write the packing, walls, piston, law and stages of a scene for LAMMPS or LIGGGHTS, which run it on many processors.
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

impl Command for BedExportArgs {
    const EXAMPLES: &'static [&'static str] =
        &["impactlaw bed export cases/solder-bed.toml --to lammps --law models/sac305-solder.toml"];

    /// Run the verb.
    ///
    /// # Errors
    /// Those of the arguments and input files, of a scene that cannot be expressed, of making its packing, and of writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let code: Code = self.to.parse()?;
        let scene = Scene::read(&self.scene)?;
        scene::check(&scene)?;
        let given = self.law.as_deref().map(LawFile::read).transpose()?;
        let law = scene::law(&scene, given.as_ref())?;
        let folder = output_folder(self.out.as_deref(), &scene.name)?;
        let prepare = scene.stages.iter().filter(|stage| stage.prepares()).count();
        let bar = context.progress((scene.output.rows * prepare) as u64, "packing");
        let provenance = context.provenance(&scene.hash);
        let packed = on_a_worker(|| {
            let options = Options {
                folder: &folder,
                provenance: &provenance,
                seed: self.seed,
                checkpoint: None,
                progress: &|_, _| bar.inc(1),
            };
            packed(&scene, &options)
        })?;
        bar.finish_and_clear();
        let mut said = String::new();
        for file in scene::export(&scene, &law, &packed, code)? {
            let path = folder.join(&file.name);
            write_atomic(&path, file.text.as_bytes())?;
            let _ = writeln!(said, "{}", path.display());
        }
        print(&said)?;
        Ok(Verdict::Met)
    }
}
