//! Files that are written whole or not at all.
//!
//! A file takes its name only when it is complete. It is not forced to the disk: that takes
//! longer than many verdicts, and what a power failure may tear, the checker rejects.

use anyhow::{Context, Result};
use std::io::{BufWriter, Write};
use std::path::Path;

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
        let file = builder.prefix(".viewcert-").tempfile_in(folder)?;
        let mut out = BufWriter::with_capacity(1 << 16, file);
        write(&mut out)?;
        let file = out.into_inner().map_err(|error| error.into_error())?;
        file.persist(path)?;
        Ok(())
    };
    attempt().with_context(|| format!("{} was not written", path.display()))
}
