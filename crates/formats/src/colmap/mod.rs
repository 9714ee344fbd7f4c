//! COLMAP's database: images, and the pairs that were matched and verified.
//!
//! In: a path. Out: the graph of the pairs that a mapper takes (nodes are all images, by name),
//! what the database knows of every pair ([`Matching`](crate::Matching)), and a summary
//! ([`DatabaseFacts`]). With `--tracks` the matches are joined to tracks and the graph is that of
//! cameras and points (docs/theory.md, section 12). The database is never written to. Who wants
//! several of these opens it once ([`Database`]).

#[cfg(not(feature = "databases"))]
mod absent;
#[cfg(feature = "databases")]
mod axes;
#[cfg(feature = "databases")]
mod base_lines;
#[cfg(feature = "databases")]
mod database;
pub(crate) mod error;
mod estimate;
mod facts;
#[cfg(feature = "databases")]
mod focal;
#[cfg(feature = "databases")]
mod keypoints;
#[cfg(feature = "databases")]
mod motion;
#[cfg(feature = "databases")]
mod open;
#[cfg(feature = "databases")]
mod pairs;
#[cfg(feature = "databases")]
mod positions;
#[cfg(feature = "databases")]
mod raw;
#[cfg(feature = "databases")]
mod rigs;
#[cfg(feature = "databases")]
mod summary;
#[cfg(feature = "databases")]
mod tables;
#[cfg(feature = "databases")]
mod tracks;
mod two_views;
#[cfg(feature = "databases")]
mod views;

#[cfg(not(feature = "databases"))]
pub use absent::{Database, RawRow, Views, raw_tables};
#[cfg(feature = "databases")]
pub use database::Database;
pub use estimate::{Estimate, LEAST_ANGLE, estimate};
pub use facts::{Bin, ConfigCount, DatabaseFacts, Groups, config_name};
#[cfg(feature = "databases")]
pub use raw::{RawRow, raw_tables};
pub use two_views::TwoViews;
#[cfg(feature = "databases")]
pub use views::Views;

#[cfg(feature = "databases")]
pub(crate) use focal::focal_lengths;
#[cfg(feature = "databases")]
pub(crate) use positions::pose_priors;

use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Says that this build reads none.
///
/// # Errors
/// Always.
#[cfg(not(feature = "databases"))]
pub(crate) fn pose_priors(_: &Path) -> Result<PosePriors, crate::error::Problem> {
    Err(error::not_built())
}

/// Says that this build reads none.
///
/// # Errors
/// Always.
#[cfg(not(feature = "databases"))]
pub(crate) fn focal_lengths(_: &Path) -> Result<FocalLengths, crate::error::Problem> {
    Err(error::not_built())
}

/// The positions that the pose priors of a database give.
#[derive(Default)]
pub(crate) struct PosePriors {
    /// The position of every image that has one, by its name, as it stands there.
    pub(crate) positions: BTreeMap<Box<str>, [f64; 3]>,
    /// Whether they are latitude, longitude and altitude; else x, y and z.
    pub(crate) on_earth: bool,
    /// How many images have a prior without a position: COLMAP writes numbers that are none.
    pub(crate) unknown: usize,
    /// The largest standard deviation along an axis, where a covariance is known.
    pub(crate) deviation: Option<f64>,
}

/// What a database knows of the focal length of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Focal {
    /// It is known beforehand (`prior_focal_length`).
    Prior,
    /// It is a guess.
    #[cfg(feature = "databases")]
    Guess,
    /// There is none: the camera sees the whole sphere, and each pixel has a known direction.
    Spherical,
}

/// Which features of the images of a database are the same point, by the names of the images.
pub type FeatureTracks = HashMap<Box<str>, ImageTracks>;

/// The features of an image.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ImageTracks {
    /// How many there are, if the database says so.
    pub features: Option<u32>,
    /// The track of every feature that has one.
    pub tracks: Vec<Option<u32>>,
}

/// What a database knows of focal lengths.
pub(crate) struct FocalLengths {
    /// By the name of an image, the `camera_id` of what took it.
    pub(crate) cameras: BTreeMap<Box<str>, i64>,
    /// By its id, what is known of a camera.
    pub(crate) known: HashMap<i64, Focal>,
}

/// Whether a file is an SQLite database, by what it begins with; one that cannot be read is none. What
/// comes through a pipe can be read once only, and is left to who reads it.
pub fn is_database(path: &Path) -> bool {
    if !path.is_file() {
        return false;
    }
    let mut head = [0; MAGIC.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == MAGIC
}

/// What every SQLite database begins with.
pub(crate) const MAGIC: &[u8] = b"SQLite format 3\0";

/// The least number of inliers of a pair that both of COLMAP's mappers take by default
/// (`min_num_matches`).
pub const DEFAULT_MIN_INLIERS: u32 = 15;

/// Which mapper the graph is for: it says which verified pairs are edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pipeline {
    /// Every pair with enough inliers, whatever its configuration.
    #[default]
    Incremental,
    /// Of these, the pairs of configuration 2 to 6 or with a stored relative pose.
    Global,
}

impl Pipeline {
    /// The word for it in options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Incremental => "incremental",
            Self::Global => "global",
        }
    }
}

impl fmt::Display for Pipeline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(all(test, feature = "databases"))]
mod tests;
