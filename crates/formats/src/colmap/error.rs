//! Why a database gives no graph.

use crate::error::{Kind, Problem};

/// What is wrong with a database, or with reading it.
pub(super) fn refused(what: impl Into<String>, remedy: &'static str) -> Problem {
    Problem::of(Kind::Other, what, remedy)
}

/// The program was built without the feature `databases`.
#[cfg(not(feature = "databases"))]
pub(super) fn not_built() -> Problem {
    refused(
        "this is an SQLite database, and this program was built without reading any",
        "build it with them, as it is built by default: `cargo install --path .`, or among other features --features databases",
    )
}

/// It came through a pipe or compressed.
pub(crate) fn no_file() -> Problem {
    let what = "an SQLite database can be read only from a file of its own";
    refused(what, "name the file itself, uncompressed")
}

#[cfg(feature = "databases")]
pub(super) use sqlite::*;

#[cfg(feature = "databases")]
mod sqlite {
    use super::{Problem, refused};
    use rusqlite::{Error, ErrorCode, ffi};
    use std::fmt::Display;
    use viewcert::wording::counted;

    /// `1 pair is`, `2 pairs are`.
    pub(crate) fn are(pairs: usize) -> String {
        let verb = if pairs == 1 { "is" } else { "are" };
        format!("{} {verb}", counted(pairs, "pair"))
    }

    /// It changed meanwhile.
    pub(crate) fn changed() -> Problem {
        refused(
            "the SQLite database was written to while it was read",
            "try again when the program that writes to it is done",
        )
    }

    /// What to do about parts that contradict themselves, or are not there.
    pub(crate) const AGAIN: &str = "copy it again (with its -wal file, if there is one), or save what is left: `sqlite3 FILE .recover | sqlite3 new.db`";

    /// Pages that contradict themselves, or are not there.
    pub(crate) fn damaged(why: impl Display) -> Problem {
        refused(format!("the SQLite database is damaged: {why}"), AGAIN)
    }

    /// Another database.
    pub(crate) fn not_colmap(why: impl Display) -> Problem {
        let what = format!("this is an SQLite database, but not COLMAP's: {why}");
        refused(
            what,
            "name COLMAP's database, or write the pairs as an edge list",
        )
    }

    /// Rigs and frames that contradict themselves.
    pub(crate) fn rigs(why: impl Display) -> Problem {
        refused(
            format!("the rigs of the database contradict themselves: {why}"),
            "configure them again (`colmap rig_configurator`), or leave them out of account: --no-rigs",
        )
    }

    /// Something else, as SQLite says it.
    pub(crate) fn other(why: impl Display) -> Problem {
        let what = format!("the SQLite database cannot be read: {why}");
        refused(what, "check its path and permissions, or read a copy")
    }

    impl From<Error> for Problem {
        fn from(error: Error) -> Self {
            let Error::SqliteFailure(code, text) = &error else {
                // A value of another type than every COLMAP writes.
                return damaged(error);
            };
            let text = text.clone().unwrap_or_else(|| code.to_string());
            match code.code {
                ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked => refused(
                    "the SQLite database is locked by a program that writes to it",
                    "try again when it is done, or read a copy",
                ),
                ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase => damaged(text),
                ErrorCode::ReadOnly if code.extended_code == ffi::SQLITE_READONLY_ROLLBACK => {
                    refused(
                        "a program has stopped in the middle of writing this SQLite database",
                        "open it once with the program that wrote it, or `sqlite3 FILE .tables`, which takes back the unfinished part; if it is still being written, wait",
                    )
                }
                ErrorCode::SystemIoFailure
                    if code.extended_code == ffi::SQLITE_IOERR_SHORT_READ =>
                {
                    damaged("it ends too early")
                }
                _ => other(text),
            }
        }
    }
}
