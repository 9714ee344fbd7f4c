//! Opening a database without leaving a trace: no lock file, no `-shm`, no migration.
//!
//! SQLite's ways to read a database are these. A database with a rollback journal is read as it is:
//! read-only connections take locks, and write nothing. A database in WAL mode whose `-wal` file is
//! empty or missing holds all its data itself; as `immutable` it is read without its companions,
//! and that nobody has written meanwhile is checked at the end. If there is data in the `-wal`
//! file, a `-shm` file beside it belongs to a program that has the database open: it is used and
//! not written to. If there is none, SQLite would make one; so a temporary copy is read.

use super::error;
use crate::error::Problem;
use std::cell::Cell;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags};

/// How long a writer may keep a reader waiting.
const PATIENCE: Duration = Duration::from_secs(2);

/// Where the header says how the database is written: 2 stands for a write-ahead log.
const WRITE_VERSION: usize = 18;

/// A database that is open for reading.
pub(super) struct Opened {
    pub(super) connection: Connection,
    /// What is to be said of the way it was opened.
    pub(super) note: Option<String>,
    /// The state of the files, if no lock keeps them as they are.
    unlocked: Option<State>,
    /// While nothing is read: SQLite's number of the state that was read (`data_version`).
    resting: Cell<Option<i64>>,
    /// Holds the copy, if one is read; goes last.
    _copy: Option<tempfile::TempDir>,
}

/// What tells whether somebody has written.
struct State {
    path: PathBuf,
    modified: Option<SystemTime>,
    size: u64,
}

impl State {
    fn of(path: &Path) -> std::io::Result<Self> {
        let metadata = fs::metadata(path)?;
        Ok(Self {
            path: path.to_owned(),
            modified: metadata.modified().ok(),
            size: metadata.len(),
        })
    }

    /// Whether it is still the same.
    fn holds(&self) -> bool {
        let now = Self::of(&self.path);
        now.is_ok_and(|now| (now.modified, now.size) == (self.modified, self.size))
            && !has_data(&beside(&self.path, "-wal"))
    }
}

impl Opened {
    /// Opens a database.
    ///
    /// # Errors
    /// If it cannot be opened; much of what is wrong with a database shows only when it is read.
    pub(super) fn new(path: &Path) -> Result<Self, Problem> {
        let other = |error: std::io::Error| error::other(error);
        // Companions stand beside the file itself, not beside a link to it.
        let path = fs::canonicalize(path).map_err(other)?;
        if cfg!(target_os = "wasi") {
            // In a page nobody else has the file, and there are no locks (site/).
            return Self::with(&path, "mode=ro&vfs=unix-none", None);
        }
        let (wal, shm) = (beside(&path, "-wal"), beside(&path, "-shm"));
        if !is_wal(&path).map_err(other)? {
            return Self::with(&path, "mode=ro", None);
        }
        if !has_data(&wal) {
            let state = State::of(&path).map_err(other)?;
            return Self::with(&path, "mode=ro&immutable=1", Some(state));
        }
        if shm.exists() {
            return Self::with(&path, "mode=ro&readonly_shm=1", None);
        }
        Self::copied(&path, &wal)
    }

    fn with(path: &Path, how: &str, unlocked: Option<State>) -> Result<Self, Problem> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
            | OpenFlags::SQLITE_OPEN_URI
            | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let connection = Connection::open_with_flags(uri(path, how)?, flags)?;
        connection.busy_timeout(PATIENCE)?;
        // The database comes from anywhere, and what it defines is not run.
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, true)?;
        if cfg!(target_os = "wasi") {
            // A log is read without memory that programs share.
            connection.execute_batch("pragma locking_mode = exclusive")?;
        }
        let opened = Self {
            connection,
            note: None,
            unlocked,
            resting: Cell::new(None),
            _copy: None,
        };
        match opened.begin() {
            Err(rusqlite::Error::SqliteFailure(code, text))
                if code.code == rusqlite::ErrorCode::CannotOpen =>
            {
                let why = text.unwrap_or_else(|| code.to_string());
                let what =
                    "the SQLite database cannot be opened together with its -wal and -shm files";
                Err(error::refused(
                    format!("{what}: {why}"),
                    "check the permissions of all three, or copy them to a folder of yours",
                ))
            }
            Err(error) => Err(error.into()),
            Ok(()) => Ok(opened),
        }
    }

    /// All that follows sees one state of the database.
    fn begin(&self) -> rusqlite::Result<()> {
        self.connection
            .execute_batch("begin; select 1 from sqlite_schema limit 1")
    }

    /// SQLite's number of the state that is read: another one after another connection has written.
    fn data_version(&self) -> rusqlite::Result<i64> {
        self.connection
            .pragma_query_value(None, "data_version", |row| row.get(0))
    }

    /// Lets go of the lock, so that nobody waits who wants to write.
    ///
    /// # Errors
    /// Those of SQLite.
    pub(super) fn rest(&self) -> Result<(), Problem> {
        if self.resting.get().is_none() {
            self.resting.set(Some(self.data_version()?));
            self.connection.execute_batch("commit")?;
        }
        Ok(())
    }

    /// To be called before anything more is read.
    ///
    /// # Errors
    /// If somebody has written meanwhile.
    pub(super) fn wake(&self) -> Result<(), Problem> {
        let Some(version) = self.resting.take() else {
            return Ok(());
        };
        self.begin()?;
        if self.data_version()? != version {
            return Err(error::changed());
        }
        Ok(())
    }

    /// A copy of the database and of its log, which nobody has open.
    fn copied(path: &Path, wal: &Path) -> Result<Self, Problem> {
        let copy = || {
            let folder = tempfile::Builder::new().prefix("verify-").tempdir()?;
            let to = folder.path().join("database.db");
            let states = [State::of(path)?, State::of(wal)?];
            fs::copy(path, &to)?;
            fs::copy(wal, beside(&to, "-wal"))?;
            Ok((folder, to, states))
        };
        let no_copy = |why: std::io::Error| {
            let what = "the last changes are in the -wal file, and a temporary copy of both fails";
            error::refused(
                format!("{what}: {why}"),
                "make room, name another folder in TMPDIR, or close the database properly: `sqlite3 FILE 'pragma wal_checkpoint(truncate)'`",
            )
        };
        let (folder, to, states) = copy().map_err(no_copy)?;
        let same = |state: &State| {
            let now = State::of(&state.path);
            now.is_ok_and(|now| (now.modified, now.size) == (state.modified, state.size))
        };
        if !states.iter().all(same) {
            return Err(error::changed());
        }
        let to = fs::canonicalize(to).map_err(no_copy)?;
        let mut opened = Self::with(&to, "mode=ro", None)?;
        opened.note = Some(
            "its last changes are in the -wal file beside it; a temporary copy of both was read"
                .to_owned(),
        );
        opened._copy = Some(folder);
        Ok(opened)
    }

    /// To be called after everything is read.
    ///
    /// # Errors
    /// If somebody has written in between.
    pub(super) fn finish(self) -> Result<(), Problem> {
        match &self.unlocked {
            Some(state) if !state.holds() => Err(error::changed()),
            _ => Ok(()),
        }
    }
}

/// A file whose name goes on.
fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

fn has_data(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| metadata.len() > 0)
}

/// Whether the header says that changes go to a log.
fn is_wal(path: &Path) -> std::io::Result<bool> {
    let mut head = Vec::new();
    File::open(path)?
        .take(WRITE_VERSION as u64 + 1)
        .read_to_end(&mut head)?;
    Ok(head.get(WRITE_VERSION) == Some(&2))
}

/// A path as SQLite takes it with parameters.
fn uri(path: &Path, parameters: &str) -> Result<String, Problem> {
    let path = path
        .to_str()
        .ok_or_else(|| error::other("its path is no UTF-8, which SQLite does not open"))?;
    let mut uri = String::from("file:");
    for c in path.chars() {
        match c {
            '%' | '?' | '#' => uri.push_str(&format!("%{:02x}", c as u32)),
            '\\' if cfg!(windows) => uri.push('/'),
            _ => uri.push(c),
        }
    }
    uri.push('?');
    uri.push_str(parameters);
    Ok(uri)
}
