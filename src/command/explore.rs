//! Command `explore`: the page of laws and theories with sliders.

use super::{Command, Context, Verdict, check_writable};
use crate::explore::page::{COMMANDS, MADE, html};
use crate::files::write_atomic;
use crate::{Error, Result};
use clap::Args;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// The laws as WebAssembly, where IMPACTLAW_EXPLORER named them when the program was built; else nothing.
const BUILT_IN: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/explorer.wasm"));

/// Write a page with sliders: law of the atlas or of a file beside all theories, from a browser, without network or program.
#[derive(Debug, Args)]
pub struct ExploreArgs {
    /// Page to write.
    #[arg(short, long, default_value = "explorer.html")]
    pub out: PathBuf,
    /// The laws as WebAssembly, where they are not built into the program.
    #[arg(long)]
    pub wasm: Option<PathBuf>,
}

impl Command for ExploreArgs {
    const EXAMPLES: &'static [&'static str] = &["impactlaw explore --out explorer.html"];

    /// Write the page.
    ///
    /// # Errors
    /// [`Error::Argument`] where there is no WebAssembly, those of [`html`] and of reading and writing.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let (wasm, path) = self.wasm()?;
        let page = html(&wasm, path)?;
        let folder = self.out.parent().unwrap_or(Path::new(""));
        check_writable(match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        })?;
        write_atomic(&self.out, page.as_bytes())?;
        context.say(&format!(
            "{} kB -> {}\n",
            page.len() / 1000,
            self.out.display()
        ))?;
        Ok(Verdict::Met)
    }
}

impl ExploreArgs {
    /// The WebAssembly of the file, else that of the program, with where it comes from.
    fn wasm(&self) -> Result<(Cow<'static, [u8]>, &Path)> {
        if let Some(path) = &self.wasm {
            let bytes = std::fs::read(path).map_err(Error::file("read", path))?;
            return Ok((Cow::Owned(bytes), path));
        }
        if BUILT_IN.is_empty() {
            return Err(Error::Argument {
                argument: "--wasm".to_owned(),
                found: "nothing".to_owned(),
                allowed: format!(
                    "must name the laws as WebAssembly: this program was built without. In its sources `{}` and `{}` make {MADE}; \
                     IMPACTLAW_EXPLORER with the full path of that file builds it into the program",
                    COMMANDS[0], COMMANDS[1]
                ),
            });
        }
        Ok((
            Cow::Borrowed(BUILT_IN),
            Path::new("WebAssembly of the program"),
        ))
    }
}
