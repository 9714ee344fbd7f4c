//! Why a database gives no graph.

#[cfg(feature = "databases")]
use rusqlite::{Error, ErrorCode, ffi};
use viewcert::wording::counted;

/// What is wrong with a database, or with reading it.
#[derive(Debug, thiserror::Error)]
pub enum DatabaseError {
    /// The program was built without the feature `databases`.
    #[error("this is an SQLite database, and this program was built without reading any")]
    NotBuilt,
    /// It came through a pipe or compressed.
    #[error("an SQLite database can be read only from a file of its own")]
    NoFile,
    /// Somebody writes to it under a rollback journal.
    #[error("the SQLite database is locked by a program that writes to it")]
    Locked,
    /// A rollback journal of a program that did not finish.
    #[error("a program has stopped in the middle of writing this SQLite database")]
    Unfinished,
    /// It changed meanwhile.
    #[error("the SQLite database was written to while it was read")]
    Changed,
    /// Files beside it that cannot be opened.
    #[error("the SQLite database cannot be opened together with its -wal and -shm files: {0}")]
    Companions(String),
    /// No room for a copy.
    #[error("the last changes are in the -wal file, and a temporary copy of both fails: {0}")]
    NoCopy(#[source] std::io::Error),
    /// Pages that contradict themselves, or are not there.
    #[error("the SQLite database is damaged: {0}")]
    Damaged(String),
    /// Another database.
    #[error("this is an SQLite database, but not COLMAP's: {0}")]
    NotColmap(String),
    /// No features were extracted.
    #[error("the database has no images")]
    NoImages,
    /// No pair was matched.
    #[error("the database has images, {0}, but no matches")]
    NotMatched(usize),
    /// Pairs were matched, and the verification was not run.
    #[error("{} matched, but none is verified: {} is empty", are(*.0, "pair"), .1)]
    NotVerified(usize, &'static str),
    /// A name that cannot be shown.
    #[error("the name of image {0} is no UTF-8")]
    NameNotUtf8(i64),
    /// A name that would not stay on its line.
    #[error("the name of image {0} has a control character")]
    ControlInName(i64),
    /// Two images of one name.
    #[error("two images are called `{0}`")]
    NameTwice(String),
    /// Matches that contradict their number.
    #[error("the matches of the images {first} and {second} are damaged: {why}")]
    Matches {
        /// The name of the first image.
        first: String,
        /// The name of the second.
        second: String,
        /// What is wrong.
        why: String,
    },
    /// Features that contradict their number.
    #[error("the keypoints of the image {image} are damaged: {why}")]
    Keypoints {
        /// The name of the image.
        image: String,
        /// What is wrong.
        why: String,
    },
    /// An image of no camera.
    #[error("the image {image} is taken by camera {camera}, which is not there")]
    NoCamera {
        /// The name of the image.
        image: String,
        /// The number of the camera.
        camera: i64,
    },
    /// Rigs and frames that contradict themselves.
    #[error("the rigs of the database contradict themselves: {0}")]
    Rigs(String),
    /// A pose prior that COLMAP cannot take.
    #[error("the position of the image {image} {why}")]
    PosePrior {
        /// The name of the image.
        image: String,
        /// What is wrong.
        why: String,
    },
    /// Matches were emptied.
    #[error("{0} of the pairs that are used have inliers, but no list of them")]
    NoLists(usize),
    /// Pairs that are used, and no match of theirs counts; or no pair is used.
    #[error("the database has no tracks: {}", match .0 { 0 => "no pair has enough inliers to be used".to_owned(), _ => format!("{} used", are(*.0, "pair")) })]
    NoTracks(usize),
    /// Something else, as SQLite says it.
    #[error("the SQLite database cannot be read: {0}")]
    Other(String),
}

impl DatabaseError {
    /// What whoever gave the database can do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::NotBuilt => {
                "build it with them, as it is built by default: `cargo install --path .`, or among other features --features databases"
            }
            Self::NoFile => "name the file itself, uncompressed",
            Self::Locked => "try again when it is done, or read a copy",
            Self::Unfinished => {
                "open it once with the program that wrote it, or `sqlite3 FILE .tables`, which takes back the unfinished part; if it is still being written, wait"
            }
            Self::Changed => "try again when the program that writes to it is done",
            Self::Companions(_) => {
                "check the permissions of all three, or copy them to a folder of yours"
            }
            Self::NoCopy(_) => {
                "make room, name another folder in TMPDIR, or close the database properly: `sqlite3 FILE 'pragma wal_checkpoint(truncate)'`"
            }
            Self::Damaged(_) | Self::Matches { .. } | Self::Keypoints { .. } => {
                "copy it again (with its -wal file, if there is one), or save what is left: `sqlite3 FILE .recover | sqlite3 new.db`"
            }
            Self::NotColmap(_) => "name COLMAP's database, or write the pairs as an edge list",
            Self::NoImages => {
                "extract features first: `colmap feature_extractor --database_path FILE --image_path images`"
            }
            Self::NotMatched(_) => {
                "match the images first, for example with `colmap exhaustive_matcher --database_path FILE`"
            }
            Self::NotVerified(..) => {
                "run the geometric verification: `colmap geometric_verifier --database_path FILE`, or in Python `pycolmap.geometric_verification(FILE)`; COLMAP 3.8 has neither, there match again, for example with `colmap exhaustive_matcher`"
            }
            Self::NoCamera { .. } => {
                "write the classes of cameras into a file, and give it to --intrinsics"
            }
            Self::Rigs(_) => {
                "configure them again (`colmap rig_configurator`), or leave them out of account: --no-rigs"
            }
            Self::PosePrior { .. } => {
                "write the pose priors again, all in one system of coordinates, or write the cameras whose position is known into a file, `position` before each"
            }
            Self::NameNotUtf8(_) | Self::ControlInName(_) | Self::NameTwice(_) => {
                "rename the image"
            }
            Self::NoLists(_) => {
                "tracks need the lists: give the database as the matching left it, or decide its pairs, without --tracks (of export: --model projective)"
            }
            Self::NoTracks(0) => {
                "ask for fewer inliers (--min-inliers; in COLMAP --Mapper.min_num_matches and --GlobalMapper.min_num_matches), or decide its pairs without --tracks"
            }
            Self::NoTracks(_) => {
                "match the images again: the features that are matched are not in the database"
            }
            Self::Other(_) => "check its path and permissions, or read a copy",
        }
    }
}

/// `1 pair is`, `2 pairs are`.
fn are(count: usize, thing: &str) -> String {
    let verb = if count == 1 { "is" } else { "are" };
    format!("{} {verb}", counted(count, thing))
}

#[cfg(feature = "databases")]
impl From<Error> for DatabaseError {
    fn from(error: Error) -> Self {
        let Error::SqliteFailure(code, text) = &error else {
            // A value of another type than every COLMAP writes.
            return Self::Damaged(error.to_string());
        };
        let text = text.clone().unwrap_or_else(|| code.to_string());
        match code.code {
            ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked => Self::Locked,
            ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase => Self::Damaged(text),
            ErrorCode::ReadOnly if code.extended_code == ffi::SQLITE_READONLY_ROLLBACK => {
                Self::Unfinished
            }
            ErrorCode::SystemIoFailure if code.extended_code == ffi::SQLITE_IOERR_SHORT_READ => {
                Self::Damaged("it ends too early".into())
            }
            _ => Self::Other(text),
        }
    }
}
