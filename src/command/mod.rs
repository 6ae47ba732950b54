//! Commands: the verbs of the command line, one file a verb: its arguments and what it does from its input files to its
//! output files.
//!
//! A new verb is a new file, its `mod` line and one line of the list of [`Verb`].

pub mod another_kind;
pub(crate) mod atlas;
pub(crate) mod bed;
pub(crate) mod bed_export;
pub mod compare;
pub(crate) mod completions;
pub(crate) mod cost;
pub mod diagnostic;
pub(crate) mod discover;
mod discover_add;
pub(crate) mod explore;
pub(crate) mod export;
mod export_case;
pub mod fit;
pub mod help;
pub(crate) mod impact;
pub mod init;
pub(crate) mod inverse;
pub(crate) mod law;
pub(crate) mod law_atlas;
pub mod log;
pub(crate) mod man;
mod material_args;
mod pair_laws;
pub mod plan;
pub(crate) mod predict;
pub(crate) mod run;
mod run_pair;
pub mod schema;
pub(crate) mod show;
pub(crate) mod study;
pub(crate) mod study_merge;
pub(crate) mod study_report;
pub(crate) mod study_runs;
pub(crate) mod study_table;
pub(crate) mod tester;
pub mod theory;
pub(crate) mod units;
pub(crate) mod validate;

use crate::files::Claim;
use crate::{Error, Result};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The file a run under way is kept in, beside the results to come; gone when they are there.
pub const CHECKPOINT_FILE: &str = "checkpoint.bin";

/// The arguments of a verb; their doc comment is its description in the help.
pub trait Command: clap::Args {
    /// Command lines that work in the root of the repository, for the end of the verb's help.
    const EXAMPLES: &'static [&'static str];

    /// Run the verb.
    ///
    /// # Errors
    /// Those of reading its input and writing its output, and of the work between.
    fn run(&self, context: &Context) -> Result<Verdict>;
}

/// Makes the verbs of the command line from the list of their arguments.
macro_rules! verbs {
    ($($verb:ident($args:ty),)+) => {
        /// The verbs, in the order of the help.
        #[derive(Debug, clap::Subcommand)]
        #[allow(missing_docs)] // each verb is described by the doc comment of its arguments
        pub enum Verb {
            $(#[command(after_help = examples(<$args as Command>::EXAMPLES))] $verb($args),)+
        }

        impl Verb {
            /// Run the verb that was given.
            ///
            /// # Errors
            /// Those of the verb.
            pub fn run(&self, context: &Context) -> Result<Verdict> {
                let outcome = match self {
                    $(Verb::$verb(args) => args.run(context),)+
                };
                outcome.map_err(another_kind::named)
            }
        }
    };
}

/// End of a verb's help.
#[must_use]
pub fn examples(lines: &[&str]) -> String {
    let lines = lines.iter().map(|line| format!("\n  {line}"));
    format!("Examples:{}", lines.collect::<String>())
}

verbs! {
    Run(run::RunArgs),
    Plan(plan::PlanArgs),
    Impact(impact::ImpactArgs),
    Fit(fit::FitArgs),
    Compare(compare::CompareArgs),
    Theory(theory::TheoryArgs),
    Bed(bed::BedArgs),
    Study(study::StudyArgs),
    Discover(discover::DiscoverArgs),
    Predict(predict::PredictArgs),
    Atlas(atlas::AtlasArgs),
    Inverse(inverse::InverseArgs),
    Tester(tester::TesterArgs),
    Validate(validate::ValidateArgs),
    Cost(cost::CostArgs),
    Explore(explore::ExploreArgs),
    Export(export::ExportArgs),
    Law(law::LawArgs),
    Init(init::InitArgs),
    Units(units::UnitsArgs),
    Completions(completions::CompletionsArgs),
    Man(man::ManArgs),
    Schema(schema::SchemaArgs),
    Help(help::HelpArgs),
}

/// What a command knows besides its own arguments.
#[derive(Debug, Clone)]
pub struct Context {
    /// The command as it was given, for provenance.
    pub command: String,
    /// `-q`: say nothing but errors.
    pub quiet: bool,
    /// The program's verbs and options, for what is written about them.
    pub program: fn() -> clap::Command,
    /// Log of the run, written beside its results.
    pub log: Arc<log::Log>,
}

/// How a command that ran to its end came out; the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Every stated threshold is met.
    Met,
    /// The result fails a stated threshold.
    Missed,
}

impl Context {
    /// Context of a command line, the program's name first.
    #[must_use]
    pub fn of(words: &[OsString], quiet: bool, program: fn() -> clap::Command) -> Self {
        let words = words.iter().skip(1);
        let words = words.map(|word| quoted(&word.to_string_lossy()));
        let command = std::iter::once("impactlaw".to_owned())
            .chain(words)
            .collect::<Vec<_>>()
            .join(" ");
        Context {
            command,
            quiet,
            program,
            log: Arc::default(),
        }
    }

    /// One line that says what made a file: program version, hash of the case, command.
    #[must_use]
    pub fn provenance(&self, case_hash: &str) -> String {
        format!(
            "{}; case sha256 {case_hash}; {}",
            crate::PROGRAM,
            self.command
        )
    }

    /// Opens the log of `verb` in `folder`, once its input, whose hash is given, is good.
    pub fn open_log(&self, folder: &Path, verb: &str, hash: &str) {
        self.log.open(folder, verb, &self.command, hash);
    }

    /// Print what a verb found, which also stands in its files; nothing with `-q`.
    ///
    /// # Errors
    /// As [`print()`].
    pub fn say(&self, text: &str) -> Result<()> {
        match self.quiet {
            true => Ok(()),
            false => print(text),
        }
    }

    /// Progress on stderr; draws nothing with `-q` or where stderr is no terminal.
    #[must_use]
    pub fn progress(&self, length: u64, what: &'static str) -> ProgressBar {
        let bar = ProgressBar::new(length).with_message(what);
        if self.quiet {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        if let Ok(style) =
            ProgressStyle::with_template("{msg:>12} [{bar:32}] {percent:>3} % {eta:>6}")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        bar
    }
}

/// `word` as a shell would need it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:+,".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        // provenance is one line of a file that has others
        let word = word.replace('\'', r"'\''");
        let shown = word.chars().map(|c| match c.is_control() {
            true => c.escape_default().to_string(),
            false => c.to_string(),
        });
        format!("'{}'", shown.collect::<String>())
    }
}

/// Output folder: the one given, else `out/<name>`; made sure to be writable, by no other process, before any work starts.
///
/// Nothing is left behind when the verb refuses to work.
///
/// # Errors
/// [`Error::File`] when files cannot be created there or another process writes there, and as [`check_writable`].
pub fn output_folder(given: Option<&Path>, name: &str) -> Result<Claim> {
    let folder = given.map_or_else(|| Path::new("out").join(name), Path::to_owned);
    check_writable(&folder)?;
    Claim::new(&folder)
}

/// That files can be created in `folder`, which need not exist yet.
///
/// # Errors
/// [`Error::File`] naming `folder` when they cannot, [`Error::Argument`] when its name holds control characters.
pub fn check_writable(folder: &Path) -> Result<()> {
    let shown = folder.to_string_lossy();
    if shown.contains(char::is_control) {
        return Err(Error::Argument {
            argument: "output folder".to_owned(),
            found: format!("{shown:?}"),
            allowed: "must have no line breaks or other control characters in its name".to_owned(),
        });
    }
    let existing = folder
        .ancestors()
        .find(|ancestor| ancestor.exists())
        .unwrap_or(Path::new("."));
    let existing = match existing.as_os_str().is_empty() {
        true => Path::new("."),
        false => existing,
    };
    // a file without a name: whoever is killed here leaves nothing
    tempfile::tempfile_in(existing)
        .map(drop)
        .map_err(Error::file("write into output folder", folder))
}

/// Folder of the impact at `velocity` (m/s) below an output folder: `impact_V10`.
#[must_use]
pub fn impact_folder(out: &Path, velocity: f64) -> PathBuf {
    out.join(format!("impact_V{velocity}"))
}

/// Print to standard output; a reader that stops early (`| head`) is no error.
///
/// # Errors
/// [`Error::File`] when standard output cannot be written for another reason.
pub fn print(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::file("write", Path::new("standard output"))(e))
        }
        _ => Ok(()),
    }
}

/// Print as JSON, one value a line of its own with indents.
///
/// # Errors
/// As [`print()`].
pub fn print_json<T: serde::Serialize + ?Sized>(value: &T) -> Result<()> {
    let out = Path::new("standard output");
    let text = serde_json::to_string_pretty(value);
    let text = text.map_err(|error| Error::file("write", out)(error.into()))?;
    print(&format!("{text}\n"))
}

/// Runs `work` on a thread of the pool, so that its parallel loops need no change of threads.
pub(super) fn on_a_worker<T: Send>(work: impl FnOnce() -> Result<T> + Send) -> Result<T> {
    rayon::scope(|_| work())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_writability_check_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("a/b");
        check_writable(&out).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        let error = check_writable(&file.join("out")).unwrap_err().to_string();
        assert!(
            error.starts_with("cannot write into output folder"),
            "{error}"
        );
    }

    #[test]
    fn words_with_blanks_are_quoted() {
        assert_eq!(quoted("10 m/s"), "'10 m/s'");
        assert_eq!(quoted("cases/a.toml"), "cases/a.toml");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted("a\nb"), r"'a\nb'");
    }

    #[test]
    fn impact_folders_are_named_after_the_speed() {
        assert_eq!(
            impact_folder(Path::new("o"), 10.0),
            Path::new("o/impact_V10")
        );
        assert_eq!(
            impact_folder(Path::new("o"), 0.5),
            Path::new("o/impact_V0.5")
        );
    }
}
