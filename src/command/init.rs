//! `init`: a commented input file that runs, to start from.

use super::schema::FileKind;
use super::{Command, Context, Verdict, quoted};
use crate::{Error, Result};
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A file to start from.
#[derive(Debug, Clone, Copy)]
pub struct Preset {
    /// Kind of file.
    pub kind: &'static str,
    /// Name on the command line, and of the file.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    text: &'static str,
    /// Other files it needs: name and bytes.
    beside: &'static [(&'static str, &'static [u8])],
}

/// A preset whose text is a file of the repository.
macro_rules! preset {
    ($kind:literal, $name:literal, $file:literal, $about:literal $(, $other:literal)*) => {
        Preset {
            kind: $kind,
            name: $name,
            about: $about,
            text: include_str!(concat!("../../", $file)),
            beside: &[$((base($other), include_bytes!(concat!("../../cases/", $other)))),*],
        }
    };
}

/// Name of a file, its folders left out.
const fn base(path: &'static str) -> &'static str {
    let mut at = path.len();
    while at > 0 && path.as_bytes()[at - 1] != b'/' {
        at -= 1;
    }
    path.split_at(at).1
}

/// Every preset; the first of its kind is written where `--like` does not choose.
pub const PRESETS: [Preset; 8] = [
    preset!(
        "case",
        "copper",
        "src/command/init/copper.toml",
        "annealed copper, in mm and MPa"
    ),
    preset!(
        "case",
        "solder",
        "src/command/init/solder.toml",
        "SAC305 solder, measured by nano-indentation"
    ),
    preset!(
        "case",
        "steel",
        "cases/thesis-4-4.toml",
        "E/Y = 80, the speeds of independent finite-element impacts"
    ),
    preset!(
        "scene",
        "mixture",
        "src/command/init/mixture.toml",
        "solder and steel balls poured into a box",
        "../models/sac305-solder.toml"
    ),
    preset!(
        "scene",
        "drum",
        "cases/bed-drum.toml",
        "rotating drum, a triangle mesh",
        "drum.stl"
    ),
    preset!(
        "scene",
        "hopper",
        "cases/bed-hopper.toml",
        "discharge of a silo, with Beverloo's formula"
    ),
    preset!(
        "scene",
        "repose",
        "cases/bed-repose.toml",
        "angle of repose of a heap"
    ),
    preset!(
        "scene",
        "impact",
        "cases/bed-impact.toml",
        "a steel ball falls into beads"
    ),
];

/// Write a commented case or scene file that runs; nothing is overwritten.
#[derive(Debug, Args)]
pub struct InitArgs {
    /// Kind of file.
    #[arg(value_parser = ["case", "scene"])]
    pub kind: String,
    /// What to start from.
    #[arg(long, value_parser = PossibleValuesParser::new(PRESETS.map(|preset| preset.name)), help = like())]
    pub like: Option<String>,
    /// File to write (default: named after what it is like, here).
    #[arg(short, long)]
    pub out: Option<PathBuf>,
}

/// Help of `--like`.
fn like() -> String {
    let of = |kind: &'static str| {
        let presets = PRESETS.iter().filter(move |preset| preset.kind == kind);
        let lines = presets.map(|preset| format!("{} ({})", preset.name, preset.about));
        lines.collect::<Vec<_>>().join("; ")
    };
    format!(
        "What to start from. case: {}. scene: {}",
        of("case"),
        of("scene")
    )
}

impl Command for InitArgs {
    const EXAMPLES: &'static [&'static str] = &[
        "impactlaw init case",
        "impactlaw init case --like solder --out ball.toml",
        "impactlaw init scene --like drum",
    ];

    /// Write the file, and what it needs beside it.
    ///
    /// # Errors
    /// [`Error::Argument`] for a preset of the other kind, or where a file stands already; [`Error::File`] where none can be
    /// written.
    fn run(&self, context: &Context) -> Result<Verdict> {
        let preset = self.preset()?;
        let name = format!("{}.toml", preset.name);
        let path = self.out.clone().unwrap_or_else(|| name.into());
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let beside = preset
            .beside
            .iter()
            .map(|(name, bytes)| (folder.join(name), *bytes));
        let text = text(&preset);
        let files: Vec<(PathBuf, &[u8])> = std::iter::once((path.clone(), text.as_bytes()))
            .chain(beside)
            .collect();
        if let Some((taken, _)) = files.iter().find(|(path, _)| path.exists()) {
            return Err(Error::Argument {
                argument: "--out".to_owned(),
                found: format!("{}, which is there already", taken.display()),
                allowed: "must name a new file: nothing is overwritten".to_owned(),
            });
        }
        for (path, bytes) in &files {
            let mut file = OpenOptions::new()
                .write(true)
                .create_new(true)
                .open(path)
                .map_err(Error::file("create", path))?;
            file.write_all(bytes).map_err(Error::file("write", path))?;
        }
        let next = FileKind::named(preset.kind)?.next;
        let next = next.replace("FILE", &quoted(&path.to_string_lossy()));
        context.say(&format!(
            "{}: {}; now `{next}`; `impactlaw help {}` explains its keys\n",
            path.display(),
            preset.about,
            preset.kind
        ))?;
        Ok(Verdict::Met)
    }
}

impl InitArgs {
    fn preset(&self) -> Result<Preset> {
        let of_kind = || {
            PRESETS
                .into_iter()
                .filter(|preset| preset.kind == self.kind)
        };
        let wanted = |preset: &Preset| self.like.as_deref().is_none_or(|name| name == preset.name);
        of_kind().find(wanted).ok_or_else(|| {
            let names = of_kind().map(|preset| preset.name);
            Error::not_one_of("--like", self.like.as_deref().unwrap_or_default(), names)
        })
    }
}

/// The text of a preset; the line that names the schema tells how to get one.
#[must_use]
pub fn text(preset: &Preset) -> String {
    let schema = format!("#:schema {}.schema.json\n", preset.kind);
    let body = preset.text.strip_prefix(&schema).unwrap_or(preset.text);
    format!(
        "# An editor checks this file if its first line is `{}` and\n# `impactlaw schema {kind} > {kind}.schema.json` was run here; `impactlaw help {kind}` explains every key.\n{body}",
        schema.trim_end(),
        kind = preset.kind
    )
}
