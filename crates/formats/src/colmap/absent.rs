//! What stands for an open database in a build that opens none: nothing, so its methods are never called.

use super::error;
use std::path::Path;

use super::{FeatureTracks, Groups, Pipeline, TwoViews};
use crate::error::{Fault, Problem};
use crate::{NamedGraph, ReadError, ReadOptions, TrackOptions};

/// A row, of which there is none.
pub type RawRow = (Vec<i64>, Vec<Vec<u8>>);

/// Says that this build reads none.
///
/// # Errors
/// Always.
pub fn raw_tables(path: &Path) -> Result<[Vec<RawRow>; 4], ReadError> {
    Err(Fault::from(error::not_built()).in_file(&path.display().to_string()))
}

/// A database, which this build does not have.
pub enum Database {}

/// The geometry of its pairs.
pub struct Views<'a>(&'a Database);

impl Database {
    /// Says that this build opens none.
    ///
    /// # Errors
    /// Always.
    pub(crate) fn open(name: &str, _: &Path, _: &ReadOptions) -> Result<Self, ReadError> {
        Err(Fault::from(error::not_built()).in_file(name))
    }

    /// The graph of its pairs.
    pub fn pairs(&self) -> NamedGraph {
        match *self {}
    }

    /// The graph of its tracks.
    ///
    /// # Errors
    /// None.
    pub fn tracks(&self, _: TrackOptions) -> Result<NamedGraph, ReadError> {
        match *self {}
    }

    /// Which features are the same point.
    ///
    /// # Errors
    /// None.
    pub fn feature_tracks(&self) -> Result<FeatureTracks, ReadError> {
        match *self {}
    }

    /// The graph of the tracks of global mapping.
    ///
    /// # Errors
    /// None.
    pub fn tracks_of_global(&self, _: TrackOptions) -> Result<Option<NamedGraph>, ReadError> {
        match *self {}
    }

    /// The pairs that a mapper takes.
    pub fn taken_by(&self, _: Pipeline) -> Vec<((u32, u32), u32)> {
        match *self {}
    }

    /// The motions of its pairs.
    ///
    /// # Errors
    /// None.
    pub fn motions(&self, _: bool) -> Result<crate::Motions, ReadError> {
        match *self {}
    }

    /// The matches of incremental mapping.
    ///
    /// # Errors
    /// None.
    pub fn matches(&self) -> Result<Vec<[(u32, u32); 2]>, ReadError> {
        match *self {}
    }

    /// The images of each part by the pairs that have a base line.
    ///
    /// # Errors
    /// None.
    pub fn by_base_lines(&self, _: &[Vec<u32>], _: &[Vec<u32>]) -> Result<Vec<Groups>, ReadError> {
        match *self {}
    }

    /// The geometry of its pairs.
    ///
    /// # Errors
    /// None.
    pub fn views(&self) -> Result<Views<'_>, ReadError> {
        match *self {}
    }

    /// Keeps no writer waiting.
    ///
    /// # Errors
    /// None.
    pub fn rest(&self) -> Result<(), ReadError> {
        match *self {}
    }

    /// To be called after everything is read.
    ///
    /// # Errors
    /// None.
    pub fn finish(self) -> Result<(), ReadError> {
        match self {}
    }
}

impl Views<'_> {
    /// Whether the focal length of an image was known before matching.
    pub fn has_prior_focal_length(&self, _: u32) -> bool {
        match *self.0 {}
    }

    /// What is known of a pair.
    ///
    /// # Errors
    /// None.
    pub fn two(&mut self, _: u32, _: u32) -> Result<Option<TwoViews>, Problem> {
        match *self.0 {}
    }
}
