//! `bed export`: a scene file to the packing, walls, law and input script of a code that runs it on many processors.

use super::bed::on_a_worker;
use super::{Context, Verdict, output_folder, print};
use crate::Result;
use crate::bed::packing::packed;
use crate::bed::run::Options;
use crate::bed::scene::Scene;
use crate::cli::BedExportArgs;
use crate::export::scene::{self, Code};
use crate::files::write_atomic;
use crate::law::LawFile;
use std::fmt::Write;

/// Run the verb.
///
/// # Errors
/// Those of the arguments and input files, of a scene that cannot be expressed, of making its packing, and of writing.
pub fn run(args: &BedExportArgs, context: &Context) -> Result<Verdict> {
    let code: Code = args.to.parse()?;
    let scene = Scene::read(&args.scene)?;
    scene::check(&scene)?;
    let given = args.law.as_deref().map(LawFile::read).transpose()?;
    let law = scene::law(&scene, given.as_ref())?;
    let folder = output_folder(args.out.as_deref(), &scene.name)?;
    let prepare = scene.stages.iter().filter(|stage| stage.prepares()).count();
    let bar = context.progress((scene.output.rows * prepare) as u64, "packing");
    let provenance = context.provenance(&scene.hash);
    let packed = on_a_worker(|| {
        let options = Options {
            folder: &folder,
            provenance: &provenance,
            seed: args.seed,
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
