//! `schema`: the keys of an input file as JSON schema, for editors.

use super::{Command, Context, Verdict, print};
use crate::bed::scene::Scene;
use crate::case::Case;
use crate::discover::file::EquationsFile;
use crate::document::keys::{Kind, Table};
use crate::document::schema::schema;
use crate::error::must_be_one_of;
use crate::law::LawFile;
use crate::study::Study;
use crate::{Error, Result};
use clap::Args;
use clap::builder::PossibleValuesParser;

/// A kind of input file.
#[derive(Debug, Clone, Copy)]
pub struct FileKind {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is for, and who reads it.
    pub about: &'static str,
    /// The command line that a file of this kind is for, `FILE` standing for it.
    pub next: &'static str,
    /// Its keys.
    kind: fn() -> Kind,
}

/// Every kind of input file.
pub const FILES: [FileKind; 5] = [
    FileKind {
        name: "case",
        about: "Particle, material and impacts: read by `run`, `plan`, `impact`, `fit`, `compare`, `theory` and `cost`.",
        next: "impactlaw run FILE",
        kind: Case::keys,
    },
    FileKind {
        name: "study",
        about: "Many cases: values, lists, ranges, and cases one by one. Read by `study` and `study merge`.",
        next: "impactlaw study FILE",
        kind: Study::keys,
    },
    FileKind {
        name: "scene",
        about: "A bed: read by `bed` and `bed export`.",
        next: "impactlaw bed FILE",
        kind: Scene::keys,
    },
    FileKind {
        name: "law",
        about: "Written by `fit` and `run`, read by `compare`, `law`, `export`, `bed` and scenes. SI units, in the keys. The file \
                says its equations in its head; numbers survive reading and writing bit for bit.",
        next: "impactlaw export FILE --to liggghts,lammps",
        kind: LawFile::keys,
    },
    FileKind {
        name: "equations",
        about: "Written by `discover`, read by `predict`. SI units. The file says how its formulas are meant in its head.",
        next: "impactlaw predict --equation FILE",
        kind: EquationsFile::keys,
    },
];

impl FileKind {
    /// The kind called `name`.
    ///
    /// # Errors
    /// [`Error::Argument`] when there is none.
    pub fn named(name: &str) -> Result<Self> {
        let found = FILES.into_iter().find(|kind| kind.name == name);
        found.ok_or_else(|| Error::Argument {
            argument: "FILE".to_owned(),
            found: format!("`{name}`"),
            allowed: must_be_one_of(FILES.map(|kind| kind.name)),
        })
    }

    /// Its keys.
    #[must_use]
    pub fn table(&self) -> Table {
        match (self.kind)() {
            Kind::Table(table) => table,
            // a file is a table
            _ => Table {
                about: "",
                keys: Vec::new(),
            },
        }
    }

    /// Its JSON schema, as text.
    #[must_use]
    pub fn schema(&self) -> String {
        let about = self.about.replace('`', "");
        format!("{:#}\n", schema(self.name, &about, &self.table()))
    }
}

/// Print the JSON schema (draft 7) of an input file, by which editors check and complete it.
#[derive(Debug, Args)]
pub struct SchemaArgs {
    /// Kind of file.
    #[arg(value_parser = PossibleValuesParser::new(FILES.map(|kind| kind.name)))]
    pub file: String,
}

impl Command for SchemaArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw schema case > case.schema.json",
        "impactlaw schema scene > scene.schema.json",
    ];

    /// Print the schema. A line `#:schema case.schema.json` on top of a case file beside it tells the editor.
    ///
    /// # Errors
    /// As [`print()`].
    fn run(&self, _context: &Context) -> Result<Verdict> {
        print(&FileKind::named(&self.file)?.schema())?;
        Ok(Verdict::Met)
    }
}
