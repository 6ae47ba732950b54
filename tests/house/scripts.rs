//! Scripts hold no network address: packages come from wherever the machine takes its own.

use std::fs::{File, read_dir, read_to_string};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Ends of host names that stand in a script for an address without its scheme.
const HOSTS: [&str; 5] = [".com", ".dev", ".io", ".net", ".org"];

fn is_script(path: &Path) -> bool {
    let mut start = [0; 32];
    let read = File::open(path).and_then(|mut file| file.read(&mut start));
    let start = String::from_utf8_lossy(&start[..read.unwrap_or(0)]).into_owned();
    let first = start.lines().next().unwrap_or("");
    path.extension().is_some_and(|extension| extension == "sh")
        || (first.starts_with("#!") && first.ends_with("sh"))
}

/// Scripts below `folder`, and every file of `.ci`; version control and builds are not looked into.
fn scripts(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            if name != ".git" && name != "target" {
                scripts(&path, found);
            }
        } else if folder.file_name().is_some_and(|name| name == ".ci") || is_script(&path) {
            found.push(path);
        }
    }
}

/// The first word of `text` that is an address.
fn address(text: &str) -> Option<&str> {
    let no_host = |c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '-');
    let named = |word: &&str| {
        let mut hosts = word.split(no_host);
        word.contains("://") || hosts.any(|host| HOSTS.iter().any(|end| host.ends_with(end)))
    };
    text.split_whitespace().find(named)
}

#[test]
fn scripts_hold_no_network_address() {
    let mut found = Vec::new();
    scripts(Path::new(env!("CARGO_MANIFEST_DIR")), &mut found);
    let peers = |path: &PathBuf| path.ends_with(".ci/peers");
    assert!(found.len() >= 5 && found.iter().any(peers), "{found:?}");
    for path in found {
        let text = read_to_string(&path).unwrap();
        assert_eq!(address(&text), None, "{}", path.display());
    }
}

#[test]
fn addresses_are_seen_with_and_without_a_scheme() {
    assert_eq!(address("deb http://mirror main"), Some("http://mirror"));
    assert_eq!(
        address("host='deb.debian.org'"),
        Some("host='deb.debian.org'")
    );
    assert_eq!(
        address("cp a.orig.tar ./b.command; . /etc/os-release"),
        None
    );
}
