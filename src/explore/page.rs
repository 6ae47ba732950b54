//! Page: one HTML file with the laws as WebAssembly in it, which needs nothing else.

use super::answer::{LAW, is_checked};
use crate::document::Document;
use crate::material::flow::{HARDENING_MODULUS, YIELD_STRENGTH};
use crate::report::palette::{Role, inks};
use crate::study::Study;
use crate::theory::published::Publication;
use crate::theory::{FORMULAS, Theory};
use crate::{Error, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use std::path::Path;

/// What the WebAssembly of this version holds, and no other.
pub const MARK: &str = concat!("explorer of impactlaw ", env!("CARGO_PKG_VERSION"), ";");

/// The commands that make the WebAssembly, and the file they make.
pub const COMMANDS: [&str; 2] = [
    "rustup target add wasm32-unknown-unknown",
    "cargo build --profile explorer --manifest-path src/explorer/Cargo.toml --target wasm32-unknown-unknown",
];
/// The file that [`COMMANDS`] make, from the root of the sources.
pub const MADE: &str = "target/wasm32-unknown-unknown/explorer/impactlaw_explorer.wasm";

const HTML: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
/// Materials to start from.
const MATERIALS: &str = include_str!("../../cases/materials.toml");
/// Beginning of every WebAssembly file.
const MAGIC: &[u8] = b"\0asm";

/// A law or theory of the list.
#[derive(Debug, Serialize)]
struct ShownLaw {
    name: &'static str,
    about: String,
    colour: String,
    width: f64,
    dash: Option<[f64; 2]>,
    /// Whether it is shown unasked.
    shown: bool,
}

/// A material to start from, SI units.
#[derive(Debug, Serialize)]
struct ShownMaterial {
    name: String,
    young: f64,
    strength: f64,
    poisson: f64,
    hardening: f64,
    density: f64,
}

#[derive(Debug, Serialize)]
struct Data {
    program: &'static str,
    laws: Vec<ShownLaw>,
    materials: Vec<ShownMaterial>,
}

/// The page with `wasm`, which was read from `path`.
///
/// # Errors
/// [`Error::Refused`] for bytes that are not the WebAssembly of this version.
pub fn html(wasm: &[u8], path: &Path) -> Result<String> {
    let holds = |bytes: &[u8]| wasm.windows(bytes.len()).any(|part| part == bytes);
    if !wasm.starts_with(MAGIC) || !holds(MARK.as_bytes()) {
        return Err(Error::Refused {
            what: path.display().to_string(),
            found: match wasm.starts_with(MAGIC) {
                true => "the WebAssembly of something else".to_owned(),
                false => "no WebAssembly".to_owned(),
            },
            allowed: format!(
                "must be the laws of {} as WebAssembly: `{}` makes {MADE}",
                crate::PROGRAM,
                COMMANDS[1]
            ),
        });
    }
    let data = Data {
        program: crate::PROGRAM,
        laws: laws(),
        materials: materials()?,
    };
    let data = serde_json::to_string(&data).map_err(|why| Error::Refused {
        what: "data of the page".to_owned(),
        found: why.to_string(),
        allowed: "must be JSON".to_owned(),
    })?;
    // "</script" would end the script that holds the data, and "<!--<script" would keep it open for ever
    let data = data.replace('<', "\\u003c");
    let filled = HTML
        .replace("{{style}}", STYLE)
        .replace("{{script}}", SCRIPT)
        .replace("{{data}}", &data);
    // last: there is much of it
    Ok(filled.replace("{{wasm}}", &STANDARD.encode(wasm)))
}

/// The law and every theory in the inks of the reports.
fn laws() -> Vec<ShownLaw> {
    let models = Theory::ALL.map(Theory::publication);
    let models = models.into_iter().chain(FORMULAS).enumerate();
    let theories = models.map(|(place, model)| {
        shown(
            model.name,
            about(&model),
            Role::Theory(place),
            is_checked(&model),
        )
    });
    let law = "fitted to simulated impacts: of the atlas, or of the law file that was opened";
    std::iter::once(shown(LAW, law.to_owned(), Role::Law, true))
        .chain(theories)
        .collect()
}

fn about(model: &Publication) -> String {
    let unverified = match is_checked(model) {
        true => "",
        false => " (its constants are unverified)",
    };
    format!("{}{unverified}. {}", model.summary, model.papers.join(", "))
}

fn shown(name: &'static str, about: String, role: Role, shown: bool) -> ShownLaw {
    let ink = inks(&[role])[0];
    let [r, g, b] = ink.colour;
    ShownLaw {
        name,
        about,
        colour: format!("#{r:02x}{g:02x}{b:02x}"),
        width: ink.width,
        dash: ink.dash.map(|(dash, gap)| [dash, gap]),
        shown,
    }
}

/// The materials whose laws are shipped.
fn materials() -> Result<Vec<ShownMaterial>> {
    let document = Document::new(Path::new("cases/materials.toml"), MATERIALS);
    let cases = Study::from_document(&document)?.cases;
    let of = |case: &crate::case::Case| {
        let material = &case.material;
        let constant = |constant| material.flow.and_then(|flow| flow.value(constant));
        ShownMaterial {
            name: case.name.clone(),
            young: material.young_modulus,
            strength: constant(&YIELD_STRENGTH).unwrap_or(0.0),
            poisson: material.poisson_ratio,
            hardening: constant(&HARDENING_MODULUS).unwrap_or(0.0),
            density: material.density,
        }
    };
    Ok(cases.iter().map(of).collect())
}
