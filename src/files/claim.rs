//! Claim: a folder that one process at a time writes results to.

use super::{PREFIX, SUFFIX};
use crate::{Error, Result};
use std::fs::{File, TryLockError};
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// File that is locked as long as a process writes into its folder; the lock ends with the process, however it ends.
const LOCK: &str = ".impactlaw-lock";
/// Depth of the folders below an output folder: `bed/<law>/film`, and one more.
const DEPTH: usize = 4;

/// A folder that is ours to write to. Dropped, it leaves no trace but the results.
#[derive(Debug)]
pub struct Claim {
    folder: PathBuf,
    /// None where the file system knows no locks.
    lock: Option<File>,
    /// Folders that were made for it, the innermost first.
    made: Vec<PathBuf>,
}

impl Claim {
    /// Makes `folder` where it is missing, claims it, and removes what a process that was killed had half written in it.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be written to, or another process has claimed it.
    pub fn new(folder: &Path) -> Result<Self> {
        let missing = folder.ancestors().take_while(|place| !place.exists());
        let missing = missing.filter(|place| !place.as_os_str().is_empty());
        let mut claim = Claim {
            folder: folder.to_owned(),
            lock: None,
            made: missing.map(Path::to_owned).collect(),
        };
        let wrong = || Error::file("write into output folder", folder);
        std::fs::create_dir_all(folder).map_err(wrong())?;
        claim.lock = lock(&folder.join(LOCK)).map_err(wrong())?;
        sweep(folder, DEPTH);
        Ok(claim)
    }
}

/// The file at `path`, locked; none where the file system knows no locks.
fn lock(path: &Path) -> std::io::Result<Option<File>> {
    loop {
        let mut options = File::options();
        let file = options
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)?;
        match file.try_lock() {
            Ok(()) if is_at(&file, path) => return Ok(Some(file)),
            // whoever held it has just removed it
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let busy = "another impactlaw is writing there; wait for it to end, or give another folder with `--out`";
                return Err(std::io::Error::new(std::io::ErrorKind::WouldBlock, busy));
            }
            Err(TryLockError::Error(_)) => {
                let _ = std::fs::remove_file(path);
                return Ok(None);
            }
        }
    }
}

/// Whether `file` is still the one at `path`.
fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let name = |data: std::fs::Metadata| (data.dev(), data.ino());
        let there = std::fs::metadata(path).map(name).ok();
        there.is_some() && there == file.metadata().map(name).ok()
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
    }
}

/// Removes temporary files of ours from `folder` and those `depth` levels below it.
fn sweep(folder: &Path, depth: usize) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        match entry.file_type() {
            Ok(kind) if kind.is_dir() && depth > 0 => sweep(&entry.path(), depth - 1),
            Ok(kind) if kind.is_file() && name.starts_with(PREFIX) && name.ends_with(SUFFIX) => {
                // one that stays does no harm
                let _ = std::fs::remove_file(entry.path());
            }
            _ => {}
        }
    }
}

impl Deref for Claim {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.folder
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if self.lock.is_some() {
            // while it is still locked: nobody takes a file that is about to go for a lock
            let _ = std::fs::remove_file(self.folder.join(LOCK));
        }
        for folder in &self.made {
            // only those go that hold nothing
            let _ = std::fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_claimed_once_at_a_time_and_nothing_is_left_of_it() {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("a/b");
        let claim = Claim::new(&folder).unwrap();
        let error = Claim::new(&folder).unwrap_err().to_string();
        assert!(
            error.contains("another impactlaw is writing there"),
            "{error}"
        );
        drop(claim);
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
        let claim = Claim::new(&folder).unwrap();
        std::fs::write(claim.join("result"), "").unwrap();
        drop(claim);
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    }

    #[test]
    fn half_written_files_are_swept_and_others_are_not() {
        let home = tempfile::tempdir().unwrap();
        let film = home.path().join("bed/thornton/film");
        std::fs::create_dir_all(&film).unwrap();
        let half = film.join(format!("{PREFIX}abc{SUFFIX}"));
        let others = [
            film.join("00000.bin"),
            home.path().join(".tmpabc"),
            home.path().join("x.part"),
        ];
        for path in others.iter().chain([&half]) {
            std::fs::write(path, "").unwrap();
        }
        drop(Claim::new(home.path()).unwrap());
        assert!(!half.exists() && others.iter().all(|path| path.exists()));
    }
}
