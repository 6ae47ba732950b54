//! A real browser, where one is installed.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Chromium or Chrome in PATH; `None`, said loudly, where there is none.
pub fn find() -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let found = names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)))
        .find(|path| path.is_file());
    if found.is_none() {
        eprintln!("!! SKIPPED: no chromium or chrome in PATH, the page was not opened");
    }
    found
}

/// The document that `page` has become, its scripts run, and what the browser itself said. `folder` is scratch.
pub fn open(browser: &Path, page: &str, folder: &Path) -> (String, String) {
    let path = folder.join("visited.html");
    std::fs::write(&path, page).unwrap();
    let profile = folder.join("profile");
    // WebGL without a graphics card; pages that only draw on a canvas would have every stroke go through that, for minutes
    let drawn: &[&str] = match page.contains("webgl") {
        true => &["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
        false => &["--disable-gpu"],
    };
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox"])
        .args(drawn)
        .args([
            "--disable-background-networking",
            "--virtual-time-budget=200000",
            "--window-size=640,480",
            "--dump-dom",
        ])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("file://{}", path.display()))
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}
