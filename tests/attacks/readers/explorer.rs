//! What the page of laws asks, and what is put into it.

use super::{Accepted, text};
use impactlaw::explore::answer;
use impactlaw::explore::page::{MARK, html};
use serde_json::{Value, json};
use std::path::Path;

/// Questions of each kind, of constants and of a law file.
pub(super) fn questions() -> Vec<Vec<u8>> {
    let body = json!({"young": "128 GPa", "poisson": "0.343", "density": "8.96 g/cc", "strength": "162 MPa", "hardening": "500 MPa",
        "radius": "250 um", "velocity": "10 m/s", "law": null});
    let mut own = body.clone();
    own["law"] =
        json!({"name": "own.toml", "text": include_str!("../../../models/sac305-solder.toml")});
    let laws = ["law", "thornton", "wu-li-thornton"];
    let questions = [
        json!({"ask": "impact", "body": body, "laws": laws, "press": null}),
        json!({"ask": "impact", "body": own, "laws": laws, "press": "5 um"}),
        json!({"ask": "restitution", "body": body, "laws": laws, "velocities": [0.01, 1.0, 100.0]}),
        json!({"ask": "header", "body": body, "name": "copper"}),
        json!({"ask": "file", "body": own, "name": "copper"}),
    ];
    questions.map(|one| one.to_string().into_bytes()).to_vec()
}

pub(super) fn question(bytes: &[u8], _: &Path) -> Accepted {
    let told: Value = serde_json::from_str(&answer(&text(bytes))).unwrap();
    for law in told["laws"].as_array().into_iter().flatten() {
        let pressed = &law["pressed"];
        // never a refusal and figures
        assert!(law["refused"].is_null() || pressed.is_null(), "{law}");
        let figure = |key: &str| pressed[key].as_f64();
        if let (Some(most), Some(left)) = (
            figure("max_displacement_m"),
            figure("residual_displacement_m"),
        ) {
            assert!(left <= most, "{law}");
        }
    }
    told["error"].is_null()
}

/// As much of a module as is looked at.
pub(super) fn modules() -> Vec<Vec<u8>> {
    let rest: String = ('a'..='z').cycle().take(2000).collect();
    vec![["\0asm", MARK, &rest].concat().into_bytes()]
}

pub(super) fn module(bytes: &[u8], _: &Path) -> Accepted {
    html(bytes, Path::new("laws.wasm")).is_ok_and(|page| {
        assert!(page.len() > bytes.len() && page.ends_with("</html>\n"));
        true
    })
}
