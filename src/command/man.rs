//! `man`: manual pages, one for the program and one a verb.

use super::{Command, Context, Verdict, check_writable};
use crate::{Error, Result};
use clap::Args;
use std::path::PathBuf;

/// Write the manual pages: `impactlaw.1`, and one a verb.
#[derive(Debug, Args)]
pub struct ManArgs {
    /// Folder to write them to.
    pub folder: PathBuf,
}

impl Command for ManArgs {
    const EXAMPLES: &'static [&'static str] = &["impactlaw man ~/.local/share/man/man1"];

    /// Write the pages.
    ///
    /// # Errors
    /// [`Error::File`] when they cannot be written.
    fn run(&self, context: &Context) -> Result<Verdict> {
        check_writable(&self.folder)?;
        std::fs::create_dir_all(&self.folder)
            .and_then(|()| clap_mangen::generate_to((context.program)(), &self.folder))
            .map_err(Error::file("write manual pages to", &self.folder))?;
        Ok(Verdict::Met)
    }
}
