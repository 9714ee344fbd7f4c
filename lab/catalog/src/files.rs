//! Reading files that may be damaged.

use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// The text of a file. What is no UTF-8 is replaced, so that no digest of it is right.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn text(path: &Path) -> Result<String> {
    let bytes = fs::read(path).with_context(|| path.display().to_string())?;
    Ok(String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned()))
}

/// What is in a folder, in the order of names, but files that are only being written.
///
/// # Errors
/// A folder that cannot be read.
pub(crate) fn listing(folder: &Path) -> Result<Vec<(String, PathBuf)>> {
    let named = || folder.display().to_string();
    let mut found = Vec::new();
    for item in fs::read_dir(folder).with_context(named)? {
        let item = item.with_context(named)?;
        let name = item.file_name().to_string_lossy().into_owned();
        if !name.starts_with('.') {
            found.push((name, item.path()));
        }
    }
    found.sort();
    Ok(found)
}
