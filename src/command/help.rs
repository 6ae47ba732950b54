//! `help`: of a verb, or of an input file and its tables.

use super::schema::{FILES, FileKind};
use super::{Command, Context, Verdict, print};
use crate::document::reference;
use crate::{Error, Result};
use clap::Args;
use std::fmt::Write;

/// Print the help of a verb, every key of an input file (`case`, `study`, `scene`, `law`), or a key by its name.
#[derive(Debug, Args)]
pub struct HelpArgs {
    /// Verb (`bed export`); file and, if wanted, a part of the headings of its tables (`scene body.free`); or key
    /// (`restitution`).
    pub topic: Vec<String>,
    /// Print the keys of all files as Markdown: the guide's reference.
    #[arg(long, conflicts_with = "topic")]
    pub markdown: bool,
}

impl Command for HelpArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw help run",
        "impactlaw help case",
        "impactlaw help scene grains",
        "impactlaw help restitution",
        "impactlaw help --markdown > src/guide/keys.md",
    ];

    /// Print what was asked for.
    ///
    /// # Errors
    /// [`Error::Argument`] for what is neither a verb nor a file.
    fn run(&self, context: &Context) -> Result<Verdict> {
        match self.markdown {
            true => print(&markdown())?,
            false => print(&text((context.program)(), &self.topic)?)?,
        }
        Ok(Verdict::Met)
    }
}

/// Help of a topic, `verb` being the program as a whole.
///
/// # Errors
/// [`Error::Argument`] for what is neither a verb nor a file.
pub fn text(mut verb: clap::Command, topic: &[String]) -> Result<String> {
    verb.build();
    let Some(first) = topic.first() else {
        return Ok(format!("{}\n{}", verb.render_long_help(), files()));
    };
    let verbs = verb
        .get_subcommands()
        .map(|verb| verb.get_name().to_owned());
    let mut names: Vec<String> = verbs
        .chain(FILES.map(|kind| kind.name.to_owned()))
        .collect();
    names.sort();
    let file = FileKind::named(first);
    let found = topic
        .iter()
        .try_fold(&mut verb, |verb, word| verb.find_subcommand_mut(word));
    let verb = found.map(|verb| verb.render_long_help().to_string());
    match (verb, file) {
        (None, Err(_)) => of_key(&topic.join(" "), names),
        (Some(verb), Err(_)) => Ok(verb),
        (None, Ok(file)) => of_file(&file, &topic[1..].join(" ")),
        (Some(verb), Ok(file)) => Ok(format!("{verb}\n{}", of_file(&file, "")?)),
    }
}

/// A key by its name, wherever a file has it.
fn of_key(name: &str, mut names: Vec<String>) -> Result<String> {
    let mut text = String::new();
    for file in FILES {
        let root = file.table();
        for section in reference::sections(&root) {
            if let Some(key) = section.table.key(name) {
                let place = section.opening.join("  ");
                let _ = writeln!(text, "{} file  {place}", file.name);
                text.push_str(&reference::wrapped(&reference::sentence(key), 80, "    "));
            }
        }
    }
    if text.is_empty() {
        names.dedup();
        return Err(Error::not_one_of("help", name, names));
    }
    Ok(text)
}

/// The keys of a file.
fn of_file(file: &FileKind, wanted: &str) -> Result<String> {
    let title = format!(
        "Keys of a {} file. {}",
        file.name,
        file.about.replace('`', "")
    );
    let keys = reference::terminal(&file.table(), wanted);
    if keys.is_empty() {
        let table = file.table();
        let sections = reference::sections(&table);
        let tables: Vec<String> = sections
            .iter()
            .skip(1)
            .map(|section| section.path.clone())
            .collect();
        return Err(Error::not_one_of("help", wanted, tables));
    }
    Ok(reference::wrapped(&title, 80, "") + &keys)
}

/// Where the files are explained.
fn files() -> String {
    let mut text = "Input files (keys: `impactlaw help FILE`):\n".to_owned();
    for file in FILES {
        let about = reference::wrapped(&file.about.replace('`', ""), 80, "            ");
        let _ = write!(text, "  {:<10}{}", file.name, about.trim_start());
    }
    text
}

/// What the guide's reference says before the tables.
const PREAMBLE: &str = "\
# Keys of the input files

Every key of every input file, table by table. A heading is the TOML that opens the table. `impactlaw help case` (`study`,
`scene`, `law`) prints the same; `impactlaw schema case` prints a schema by which an editor checks and completes the file.

- *Quantities* are text with a unit: `\"0.25 mm\"`, `\"59820 MPa\"`, `\"9.81 m/s2\"`. Any unit of the dimension will do;
  `impactlaw units` lists them.
- *Numbers* have no unit. *Vectors* are lists of three, along x, y and z; gravity acts along -z.
- A key whose default is \"required\" must be there. A default of \"none\" means that what the key stands for does not exist.
- An unknown key, a missing unit or a value out of range is refused before the first step, with file, line, what was found
  and what is allowed.
";

/// The chapter `keys.md` of the guide.
#[must_use]
pub fn markdown() -> String {
    let mut text = PREAMBLE.to_owned();
    for file in FILES {
        let (first, rest) = file.name.split_at(1);
        let about = reference::wrapped(file.about, 120, "");
        let _ = write!(text, "\n# {}{rest} file\n\n{about}", first.to_uppercase());
        text.push_str(&reference::markdown(file.name, &file.table()));
    }
    text
}
