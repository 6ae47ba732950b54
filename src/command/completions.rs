//! `completions`: the script by which a shell completes verbs, options and file names.

use super::{Command, Context, Verdict, print};
use crate::Result;
use clap::Args;
use clap_complete::{Shell, generate};

/// Print the completion script of a shell.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell.
    pub shell: Shell,
}

impl Command for CompletionsArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw completions bash > ~/.local/share/bash-completion/completions/impactlaw",
        "impactlaw completions zsh > ~/.zfunc/_impactlaw",
        "impactlaw completions fish > ~/.config/fish/completions/impactlaw.fish",
    ];

    /// Print the script.
    ///
    /// # Errors
    /// As [`print()`].
    fn run(&self, context: &Context) -> Result<Verdict> {
        let mut script = Vec::new();
        generate(
            self.shell,
            &mut (context.program)(),
            "impactlaw",
            &mut script,
        );
        print(&String::from_utf8_lossy(&script))?;
        Ok(Verdict::Met)
    }
}
