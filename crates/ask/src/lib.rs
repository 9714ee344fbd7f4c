//! Internal to viewcert, and may change at any time.
//!
//! What is asked of files: the overview of a database, lists of images, two models, measured motions,
//! archives of certificates.
//!
//! In: paths, and how they are read. Out: what was found, to whom it is said: the program `verify`, and the
//! Python package.

pub mod archive;
pub mod contradictions;
pub mod lists;
pub mod merge;
pub mod overview;

use anyhow::{Result, bail, ensure};
use std::path::Path;
use viewcert_formats::colmap::Database;
use viewcert_formats::error::ReadError;
use viewcert_formats::{Model, NamedGraph, ReadOptions, TrackOptions};
use viewcert_session::Session;

/// A graph, and the database that it is of, if that is open for more.
pub type Input = (NamedGraph, Option<Database>);

/// The graphs of a file, or why there is none.
pub type Inputs = Box<dyn Iterator<Item = Result<Input, ReadError>>>;

/// How inputs are read.
#[derive(Clone)]
pub struct HowRead {
    /// As pairs.
    pub pairs: ReadOptions,
    /// As cameras and points.
    pub tracks: ReadOptions,
    /// An option that is about tracks alone, if one is given.
    pub of_tracks_alone: Option<&'static str>,
}

impl HowRead {
    /// By the options of pairs, and those of tracks that are given: the least number of views, the largest spread, and
    /// whether rigs count. These have names in messages.
    #[must_use]
    pub fn new(
        pairs: ReadOptions,
        (min_views, max_spread, rigs): (Option<u32>, Option<u32>, bool),
        names: [&'static str; 3],
    ) -> Self {
        let default = TrackOptions::default();
        let tracks = TrackOptions {
            min_views: min_views.unwrap_or(default.min_views),
            max_spread: max_spread.unwrap_or(default.max_spread),
            rigs,
        };
        let given = [min_views.is_some(), max_spread.is_some(), !rigs];
        let given = names.into_iter().zip(given).find(|(_, is_given)| *is_given);
        let tracks = Some(tracks);
        Self {
            tracks: ReadOptions {
                tracks,
                ..pairs.clone()
            },
            of_tracks_alone: given.map(|(name, _)| name),
            pairs,
        }
    }

    /// Refuses an option that is about tracks, for an input that has none.
    ///
    /// # Errors
    /// If there is one.
    fn ensure_pairs(&self, path: &Path) -> Result<()> {
        match self.of_tracks_alone {
            None => Ok(()),
            Some(option) => bail!(
                "{}: {option} says how tracks count, and none are counted here; leave it out",
                path.display()
            ),
        }
    }
}

/// Reads a model of COLMAP.
///
/// # Errors
/// A path that is no folder; what is wrong in it.
pub fn read_model(session: &Session, path: &Path) -> Result<Model> {
    ensure!(
        path.is_dir(),
        "{}: this is no folder; name the folder that holds cameras, images and points3D",
        path.display()
    );
    session.reading(path);
    let model = Model::read(path);
    session.hide();
    Ok(model?)
}
