//! Files that are written whole or not at all.
//!
//! A file takes its name only when it is complete. It is not forced to the disk: that takes
//! longer than many verdicts, and what a power failure may tear, the checker rejects.

use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

/// The temporary files that there are. Files are made, and take their names, while this is locked.
static PENDING: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn pending() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PENDING.lock().unwrap_or_else(|broken| broken.into_inner())
}

/// Removes all temporary files: the program is about to end. While the result is kept no file
/// takes its name any more.
pub fn abandon() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    let mut pending = pending();
    for path in std::mem::take(&mut *pending) {
        // There is nobody left to tell.
        let _ = std::fs::remove_file(path);
    }
    pending
}

/// Writes a file through a temporary one beside it, which takes its name when everything
/// has been written.
///
/// # Errors
/// If the folder is not writable, the disk is full, or `write` fails; the file is then as it was
/// before.
pub fn write(path: &Path, write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let attempt = || -> Result<()> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file: the process's mask takes off what it will.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = {
            let mut pending = pending();
            let file = builder.prefix(".viewcert-").tempfile_in(folder)?;
            pending.insert(file.path().to_owned());
            file
        };
        let temporary = file.path().to_owned();
        let written = || -> Result<_> {
            let mut out = BufWriter::with_capacity(1 << 16, file);
            write(&mut out)?;
            Ok(out.into_inner().map_err(|error| error.into_error())?)
        };
        let written = written();
        let mut pending = pending();
        pending.remove(&temporary);
        written?.persist(path)?;
        Ok(())
    };
    attempt().with_context(|| format!("{} was not written", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_abandoned_file_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let count = || std::fs::read_dir(folder.path()).unwrap().count();
        let done = write(&path, |out| {
            out.write_all(b"half")?;
            assert_eq!(count(), 1);
            drop(abandon());
            assert_eq!(count(), 0);
            Ok(())
        });
        assert!(done.is_err());
        assert_eq!(count(), 0);
        write(&path, |out| out.write_all(b"whole")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"whole");
    }
}
