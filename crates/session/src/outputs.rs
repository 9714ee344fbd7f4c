//! Where outputs go: files that are written whole or not at all; pipes and devices, which are
//! written through; standard output, which is called `-`.
//!
//! A file takes its name only when it is complete. It is not forced to the disk: that takes
//! longer than many verdicts, and what a power failure may tear, the checker rejects.
//!
//! Nothing but a file is ever replaced. A symbolic link stays and what it points at is
//! written; an input is never an output.

use crate::exit::{GOOD, NOT};
use crate::unpoisoned;
use anyhow::{Context, Result, anyhow, ensure};
use std::collections::BTreeSet;
use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};
use viewcert::wording::spelt;

/// The outputs of a run: its temporary files and folders, which are made, and take their names, while
/// this is locked.
#[derive(Debug, Default)]
pub struct Outputs {
    pending: Mutex<BTreeSet<PathBuf>>,
}

/// The name of standard output among outputs, and of standard input among inputs.
const STANDARD: &str = "-";

/// Most symbolic links that are followed, as in the Linux kernel.
const MOST_LINKS: usize = 40;

/// Size of the buffer in front of every output.
const BUFFER: usize = 1 << 16;

/// What an output is.
enum Place {
    /// Standard output.
    Standard,
    /// A device or a pipe.
    Through(PathBuf),
    /// A file that is there, with its permissions, or that is not there yet.
    File(PathBuf, Option<Permissions>),
}

impl Outputs {
    /// Writes an output: a file through a temporary one beside it, which takes its name when
    /// everything has been written; anything else as it comes.
    ///
    /// # Errors
    /// If the folder is not writable, the disk is full, or `write` fails; a file is then as it was
    /// before.
    pub fn write(
        &self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<()> {
        let attempt = || -> Result<()> {
            let name = path.as_os_str().to_string_lossy();
            if name.ends_with(std::path::is_separator) && !path.exists() {
                return Err(no_room(path, &io::ErrorKind::NotFound.into()));
            }
            match locate(path)? {
                Place::Standard => through(io::stdout().lock(), write)?,
                Place::Through(path) => through(File::options().write(true).open(path)?, write)?,
                Place::File(path, permissions) => self.complete(&path, permissions, write)?,
            }
            Ok(())
        };
        attempt().with_context(|| format!("{} was not written", path.display()))
    }

    /// Removes all temporary files and folders: the program is about to end. While the result is
    /// kept no file takes its name any more.
    pub(crate) fn abandon(&self) -> MutexGuard<'_, BTreeSet<PathBuf>> {
        let mut pending = unpoisoned(&self.pending);
        for path in std::mem::take(&mut *pending) {
            // There is nobody left to tell.
            let _ = if path.is_dir() {
                fs::remove_dir_all(path)
            } else {
                fs::remove_file(path)
            };
        }
        pending
    }

    /// Writes a temporary file beside a path, and lets it take its name.
    fn complete(
        &self,
        path: &Path,
        permissions: Option<Permissions>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<()> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file: the process's mask takes off what it will.
            builder.permissions(Permissions::from_mode(0o666));
        }
        let file = {
            let mut pending = unpoisoned(&self.pending);
            let folder = folder_of(path);
            let file = builder.prefix(".viewcert-").tempfile_in(folder);
            let file = file.map_err(|error| no_room(folder, &error))?;
            pending.insert(file.path().to_owned());
            file
        };
        let temporary = file.path().to_owned();
        let written = || -> io::Result<_> {
            let mut out = BufWriter::with_capacity(BUFFER, file);
            write(&mut out)?;
            let file = out.into_inner().map_err(|error| error.into_error())?;
            if let Some(permissions) = permissions {
                file.as_file().set_permissions(permissions)?;
            }
            Ok(file)
        };
        let written = written();
        let mut pending = unpoisoned(&self.pending);
        pending.remove(&temporary);
        written?.persist(path).map_err(|failed| failed.error)?;
        Ok(())
    }

    /// Writes a folder: one beside it is filled by `fill` and takes its name when it is complete. What
    /// was there goes then; the caller has made sure that nothing is lost.
    ///
    /// # Errors
    /// If the folder around it is not writable, the disk is full, or `fill` fails; everything is then
    /// as it was before.
    pub fn folder(&self, path: &Path, fill: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
        let attempt = || -> Result<()> {
            let new = self.temporary_folder(path)?;
            let filled = fill(&new);
            let mut pending = unpoisoned(&self.pending);
            if let Err(error) = filled.and_then(|()| exchange(&new, path)) {
                // What was made is given up; the first error is the one to tell.
                let _ = fs::remove_dir_all(&new);
                pending.remove(&new);
                return Err(error);
            }
            pending.remove(&new);
            Ok(())
        };
        attempt().with_context(|| format!("{} was not written", path.display()))
    }

    /// A folder beside a path, which is removed if the program ends.
    fn temporary_folder(&self, path: &Path) -> Result<PathBuf> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(Permissions::from_mode(0o777));
        }
        let mut pending = unpoisoned(&self.pending);
        let folder = folder_of(path);
        let new = builder.prefix(".viewcert-").tempdir_in(folder);
        let new = new.map_err(|error| no_room(folder, &error))?.keep();
        pending.insert(new.clone());
        Ok(new)
    }
}

fn through(out: impl Write, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    write(&mut out)?;
    Ok(out.flush()?)
}

/// Gives a folder another's name. If that fails the other is as it was.
fn exchange(new: &Path, path: &Path) -> Result<()> {
    if fs::symlink_metadata(path).is_err() {
        return Ok(fs::rename(new, path)?);
    }
    let aside = new.with_extension("old");
    fs::rename(path, &aside)?;
    if let Err(error) = fs::rename(new, path) {
        fs::rename(&aside, path)?;
        return Err(error.into());
    }
    Ok(fs::remove_dir_all(&aside)?)
}

/// Why nothing can be put into a folder, without the name that it would have had for a while.
fn no_room(folder: &Path, error: &io::Error) -> anyhow::Error {
    let name = folder.display();
    match error.kind() {
        io::ErrorKind::NotFound => {
            anyhow!("there is no folder {name}; make it, or name another place")
        }
        io::ErrorKind::NotADirectory => anyhow!("{name} is not a folder; name another place"),
        kind => {
            anyhow!("{name}: {kind}; name another place, or see to it that it can be written to")
        }
    }
}

/// The folder that a path is in.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Follows symbolic links one by one, so that the last one may point at nothing yet.
fn locate(path: &Path) -> io::Result<Place> {
    if is_standard(path) {
        return Ok(Place::Standard);
    }
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        let found = match fs::symlink_metadata(&target) {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Place::File(target, None));
            }
            Err(error) => return Err(error),
        };
        if found.is_file() {
            return Ok(Place::File(target, Some(found.permissions())));
        }
        if found.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        if !found.is_symlink() || is_of_a_process(&target) {
            return Ok(Place::Through(target));
        }
        target = folder_of(&target).join(fs::read_link(&target)?);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Whether a link stands for an open file of a process (`/dev/fd/3`): what it points at is only
/// described by its text.
fn is_of_a_process(link: &Path) -> bool {
    fs::canonicalize(folder_of(link)).is_ok_and(|folder| folder.starts_with("/proc"))
}

/// Whether an output is standard output: `-`, one of its names, or the file or pipe that it has
/// been sent to.
pub fn is_standard(path: &Path) -> bool {
    let names = [STANDARD, "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    if names.iter().any(|name| path == Path::new(name)) {
        return true;
    }
    let found = Identity::of(path);
    found.is_some() && found == Identity::of_standard_output()
}

/// Where the text of a command goes.
pub type Text = BufWriter<Box<dyn Write>>;

/// Where the text of a command goes: to standard output, unless one of its outputs goes there;
/// then to standard error.
pub fn text(outputs: &[Option<&Path>]) -> Text {
    let taken = outputs.iter().flatten().any(|path| is_standard(path));
    BufWriter::new(if taken {
        Box::new(Words(io::stderr()))
    } else {
        Box::new(Words(io::stdout().lock()))
    })
}

/// What is written for people and for programs that read JSON or tables: of what a terminal would obey the number
/// is spelt out.
struct Words<W>(W);

impl<W: Write> Write for Words<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut shown = String::with_capacity(bytes.len());
        let text = String::from_utf8_lossy(bytes);
        text.chars().for_each(|c| spelt(c, &mut shown));
        self.0.write_all(shown.as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Prints the one answer of a command on standard output, as JSON or as text, and says by the exit
/// code whether it is good.
///
/// # Errors
/// Standard output cannot be written.
pub fn answer(
    is_json: bool,
    is_good: bool,
    json: impl FnOnce(&mut Text) -> io::Result<()>,
    words: impl FnOnce(&mut Text) -> io::Result<()>,
) -> Result<u8> {
    let mut out = text(&[]);
    let written = if is_json {
        json(&mut out)
    } else {
        words(&mut out)
    };
    let written = written.and_then(|()| out.flush());
    written.context("standard output")?;
    Ok(if is_good { GOOD } else { NOT })
}

/// Refuses an output that is one of the inputs, by whatever names, or one of the outputs before
/// it. Options of the outputs come with them, for the message.
///
/// # Errors
/// Which output is what.
pub fn ensure_apart<'a>(
    outputs: &[(&str, Option<&Path>)],
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<()> {
    let inputs: Vec<(&Path, Identity)> = inputs
        .into_iter()
        .filter_map(|input| Some((input, Identity::of_input(input)?)))
        .collect();
    let given = |&(option, path): &(_, Option<_>)| path.map(|path: &Path| (option, path));
    let outputs: Vec<(&str, &Path)> = outputs.iter().filter_map(given).collect();
    for (k, &(option, output)) in outputs.iter().enumerate() {
        let found = Identity::of_output(output);
        for (input, identity) in &inputs {
            ensure!(
                found.as_ref() != Some(identity),
                "{option} {}: this is the input {}, which would be overwritten; name another file",
                output.display(),
                input.display()
            );
        }
        for (other, before) in &outputs[..k] {
            let same = output == *before || found.is_some() && found == Identity::of_output(before);
            ensure!(
                !same,
                "{option} {}: {other} goes to the same file; name another one",
                output.display()
            );
        }
    }
    Ok(())
}

/// What tells a file or a pipe from all others, however it is called. Devices have none: to read
/// and to write one (a terminal, `/dev/null`) does no harm.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Identity(#[cfg(unix)] (u64, u64), #[cfg(not(unix))] PathBuf);

impl Identity {
    /// Of a path that may be `-` and is read.
    fn of_input(path: &Path) -> Option<Self> {
        if path == Path::new(STANDARD) {
            Self::of_standard_input()
        } else {
            Self::of(path)
        }
    }

    /// Of a path that may be `-` and is written.
    fn of_output(path: &Path) -> Option<Self> {
        if path == Path::new(STANDARD) {
            Self::of_standard_output()
        } else {
            Self::of(path)
        }
    }
}

#[cfg(unix)]
impl Identity {
    fn of(path: &Path) -> Option<Self> {
        Self::from(&fs::metadata(path).ok()?)
    }

    fn of_standard_input() -> Option<Self> {
        Self::open(&io::stdin())
    }

    fn of_standard_output() -> Option<Self> {
        Self::open(&io::stdout())
    }

    fn open(file: &impl std::os::fd::AsFd) -> Option<Self> {
        let copy = file.as_fd().try_clone_to_owned().ok()?;
        Self::from(&File::from(copy).metadata().ok()?)
    }

    fn from(found: &fs::Metadata) -> Option<Self> {
        use std::os::unix::fs::{FileTypeExt, MetadataExt};
        let kind = found.file_type();
        (kind.is_file() || kind.is_fifo()).then(|| Self((found.dev(), found.ino())))
    }
}

#[cfg(not(unix))]
impl Identity {
    fn of(path: &Path) -> Option<Self> {
        let path = fs::canonicalize(path).ok()?;
        path.is_file().then_some(Self(path))
    }

    fn of_standard_input() -> Option<Self> {
        None
    }

    fn of_standard_output() -> Option<Self> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_abandoned_file_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        let count = || std::fs::read_dir(folder.path()).unwrap().count();
        let outputs = Outputs::default();
        let done = outputs.write(&path, |out| {
            out.write_all(b"half")?;
            assert_eq!(count(), 1);
            drop(outputs.abandon());
            assert_eq!(count(), 0);
            Ok(())
        });
        assert!(done.is_err());
        assert_eq!(count(), 0);
        outputs.write(&path, |out| out.write_all(b"whole")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"whole");
    }
}
