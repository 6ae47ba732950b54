//! Rust sources of the library.

use std::path::{Path, PathBuf};

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// Every source file of the library, by its place in `src`, with its text.
///
/// The C interface, the WebAssembly and the Python package are packages of their own, examples are programs; the program and the list of rooms
/// stand above all rooms.
pub fn sources() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&root, &mut files);
    files.sort();
    let inside = files.into_iter().map(|path| {
        let text = std::fs::read_to_string(&path).unwrap();
        (path.strip_prefix(&root).unwrap().to_owned(), text)
    });
    let apart = [
        "build.rs",
        "capi",
        "examples",
        "explorer",
        "explorer.rs",
        "lib.rs",
        "main.rs",
        "python",
    ];
    inside
        .filter(|(file, _)| !apart.iter().any(|name| file.starts_with(name)))
        .collect()
}
