//! Folders that a command fills with what it has found: new ones, or empty ones.

use anyhow::{Result, ensure};
use std::fs;
use std::path::{Path, PathBuf};

/// Refuses a folder that holds anything.
///
/// # Errors
/// What is in the way.
pub(crate) fn ensure_new(command: &str, folder: &Path) -> Result<()> {
    let name = folder.display();
    let is_empty = || fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none());
    ensure!(
        fs::symlink_metadata(folder).is_err() || is_empty(),
        "{command} {name}: this is there, and no empty folder; name a new one, or remove it"
    );
    Ok(())
}

/// A path without links, as far as it is there.
pub(crate) fn resolved(path: &Path) -> PathBuf {
    if let Ok(real) = fs::canonicalize(path) {
        return real;
    }
    match (path.parent(), path.file_name()) {
        (Some(parent), Some(name)) if parent.as_os_str().is_empty() => {
            resolved(Path::new(".")).join(name)
        }
        (Some(parent), Some(name)) => resolved(parent).join(name),
        _ => path.to_owned(),
    }
}
