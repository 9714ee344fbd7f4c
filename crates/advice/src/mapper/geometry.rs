//! What is known of the geometry of pairs, whoever knows it.

use anyhow::Result;
use std::collections::HashMap;
use viewcert_formats::colmap::Estimate;

/// What is known of pairs beyond their matches.
pub trait Geometry {
    /// What is known of one pair, if anything.
    ///
    /// # Errors
    /// Of whatever is read for it.
    fn of(&mut self, pair: (u32, u32)) -> Result<Option<Estimate>>;

    /// Whether the focal length of an image is known beforehand.
    fn has_prior_focal_length(&self, image: u32) -> bool;
}

/// Nothing is known.
impl Geometry for () {
    fn of(&mut self, _: (u32, u32)) -> Result<Option<Estimate>> {
        Ok(None)
    }

    fn has_prior_focal_length(&self, _: u32) -> bool {
        false
    }
}

/// What is known of pairs, read once each; of so many pairs at most, and nothing of later ones.
pub(super) struct Cached<'a> {
    geometry: &'a mut dyn Geometry,
    known: HashMap<(u32, u32), Option<Estimate>>,
    most: usize,
}

impl<'a> Cached<'a> {
    pub(super) fn new(geometry: &'a mut dyn Geometry, most: usize) -> Self {
        Self {
            geometry,
            known: HashMap::new(),
            most,
        }
    }
}

impl Geometry for Cached<'_> {
    fn of(&mut self, pair: (u32, u32)) -> Result<Option<Estimate>> {
        if let Some(&known) = self.known.get(&pair) {
            return Ok(known);
        }
        if self.known.len() == self.most {
            return Ok(None);
        }
        let found = self.geometry.of(pair)?;
        self.known.insert(pair, found);
        Ok(found)
    }

    fn has_prior_focal_length(&self, image: u32) -> bool {
        self.geometry.has_prior_focal_length(image)
    }
}
