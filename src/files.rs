//! Atomic writes: a file is either the old one or the whole new one, never a part. Folders that are claimed, and files that
//! carry their sum. Text that is UTF-8. VTP, which ParaView reads.

mod claim;
mod sum;
mod text;
pub mod vtp;

pub use claim::Claim;
pub use sum::{Sum, sha256, sum_of, with_sum};
pub use text::{read_text, text};

use crate::{Error, Result};
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// Write `bytes` to `path` through a temporary file in the same folder and a rename.
///
/// # Errors
/// [`Error::File`] when the folder cannot be created or written.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(Error::file("create", folder))?;
    let mut file = temporary(folder).map_err(Error::file("write", path))?;
    file.write_all(bytes).map_err(Error::file("write", path))?;
    file.persist(path)
        .map_err(|e| Error::file("write", path)(e.error))?;
    Ok(())
}

/// How names of temporary files begin and end; what is left of them is removed by the next [`Claim`].
const PREFIX: &str = ".impactlaw-";
const SUFFIX: &str = ".part";

/// Temporary file with the permissions any new file gets (tempfile's own are for the owner alone).
fn temporary(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Writes rows as CSV under a `#` provenance line.
///
/// # Errors
/// [`Error::File`] when the file cannot be written.
pub fn write_rows<R: Serialize>(path: &Path, provenance: &str, rows: &[R]) -> Result<()> {
    let bytes = rows_text(provenance, rows).map_err(Error::file("write", path))?;
    write_atomic(path, &bytes)
}

/// Rows as [`write_rows`] writes them.
///
/// # Errors
/// For rows that are none: of another length than the first.
pub fn rows_text<R: Serialize>(provenance: &str, rows: &[R]) -> std::io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(format!("# {provenance}\n").into_bytes());
    for row in rows {
        writer.serialize(row)?;
    }
    writer.into_inner().map_err(|e| e.into_error())
}

/// Row of numbers as [`write_rows`] writes them: shortest digits that read back bit for bit.
#[must_use]
pub fn row(numbers: &[f64]) -> String {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    // a row of numbers goes into memory whatever they are
    let _ = writer.serialize(numbers);
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_write_replaces_the_first_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b.txt");
        write_atomic(&path, b"one").unwrap();
        write_atomic(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(
            std::fs::read_dir(folder.path().join("a")).unwrap().count(),
            1
        );
    }

    #[test]
    fn a_row_has_the_number_format_of_all_files() {
        #[derive(Serialize)]
        struct Pair {
            a: f64,
            b: f64,
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        for (a, b) in [
            (1e-6, 2.5e9),
            (0.1 + 0.2, -0.0),
            (f64::NAN, 1e300),
            (3.0, 1e-5),
        ] {
            write_rows(&path, "test", &[Pair { a, b }]).unwrap();
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.ends_with(&format!("\n{}", row(&[a, b]))), "{text}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn files_are_readable_like_any_other_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write_atomic(&ours, b"").unwrap();
        std::fs::write(&plain, b"").unwrap();
        let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(ours), mode(plain));
    }
}
