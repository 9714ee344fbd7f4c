//! Folders that a command fills with what it has found, and replaces as a whole.

use anyhow::{Context, Result, bail, ensure};
use std::fs;
use std::path::{Path, PathBuf};

/// Refuses a folder that holds an input or another output: it is replaced as a whole.
///
/// # Errors
/// Which of them is in it.
pub(crate) fn ensure_outside(
    command: &str,
    folder: &Path,
    inputs: &[PathBuf],
    outputs: &[(&str, Option<&Path>)],
) -> Result<()> {
    let name = folder.display();
    let real = resolved(folder);
    for input in inputs {
        let inside = fs::canonicalize(input).is_ok_and(|input| input.starts_with(&real));
        ensure!(
            !inside,
            "{command} {name}: the input {} is in this folder, which would be replaced; name another \
             folder",
            input.display()
        );
    }
    for &(option, path) in outputs {
        let inside = path.is_some_and(|path| resolved(path).starts_with(&real));
        ensure!(
            !inside,
            "{option} {}: this is in the folder of {command} {name}, which holds nothing else; name \
             another place",
            path.unwrap_or(Path::new("")).display()
        );
    }
    Ok(())
}

/// Refuses a folder that holds anything but an earlier run of the command, which is known by the first line of its table.
/// `foreign` finds what such a run does not write, in an entry of the folder.
///
/// # Errors
/// What is in the way.
pub(crate) fn ensure_own(
    command: &str,
    folder: &Path,
    (table, head): (&str, &[&str]),
    foreign: impl Fn(&Path) -> std::io::Result<Option<PathBuf>>,
) -> Result<()> {
    let Ok(found) = fs::symlink_metadata(folder) else {
        return Ok(());
    };
    let name = folder.display();
    ensure!(
        found.is_dir(),
        "{command} {name}: this is not a folder; name another place"
    );
    let first = || -> std::io::Result<Option<PathBuf>> {
        let entries = paths(folder)?;
        let text = fs::read_to_string(folder.join(table)).unwrap_or_default();
        if text.lines().next() != Some(&head.join("\t")) {
            return Ok(entries.into_iter().next());
        }
        let found = entries
            .iter()
            .map(|path| foreign(path))
            .find(|found| !matches!(found, Ok(None)));
        found.unwrap_or(Ok(None))
    };
    if let Some(foreign) = first().with_context(|| format!("{command} {name}"))? {
        bail!(
            "{command} {name}: {} is there, which no {command} has written; name another folder",
            foreign.display()
        );
    }
    Ok(())
}

/// Whether a path has one of some names.
pub(crate) fn is_called(path: &Path, names: &[&str]) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    name.is_some_and(|name| names.contains(&name))
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

/// What is in a folder, in a fixed order.
pub(crate) fn paths(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut paths = entries.collect::<std::io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}
