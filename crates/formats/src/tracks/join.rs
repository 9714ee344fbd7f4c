//! Matches of pairs of images, joined to tracks.

use super::TrackGraph;
use super::doubled::{Places, consistent, is_doubled};
use crate::error::Problem;
use viewcert::graph::{Lists, UnionFind};

/// The largest number of a feature in an image, against damaged numbers; COLMAP extracts 8192 by
/// default.
const MOST_FEATURES: u32 = 1 << 24;

/// Features of images, and which of them are the same point.
pub(crate) struct Joined {
    /// For every image and feature its element, counted from 1; 0 for none.
    features: Vec<Vec<u32>>,
    sets: UnionFind,
}

impl Joined {
    pub(crate) fn new(images: usize) -> Self {
        Self {
            features: vec![Vec::new(); images],
            sets: UnionFind::new(0),
        }
    }

    /// One more image without features.
    pub(crate) fn push_image(&mut self) {
        self.features.push(Vec::new());
    }

    /// The element of a feature.
    fn element(&mut self, image: u32, feature: u32) -> Result<usize, Problem> {
        if feature >= MOST_FEATURES {
            return Err(Problem::corrupt(format!(
                "a feature has the number {feature}"
            )));
        }
        let features = &mut self.features[image as usize];
        let feature = feature as usize;
        if features.len() <= feature {
            features.resize(feature + 1, 0);
        }
        if features[feature] == 0 {
            let element = self.sets.push();
            features[feature] =
                u32::try_from(element + 1).map_err(|_| Problem::too_many_nodes())?;
        }
        Ok(features[feature] as usize - 1)
    }

    /// Two features are the same point. Nearly constant time.
    ///
    /// # Errors
    /// A number of a feature that no image has.
    ///
    /// # Panics
    /// If there is no such image.
    pub(crate) fn join(&mut self, a: (u32, u32), b: (u32, u32)) -> Result<(), Problem> {
        let (a, b) = (self.element(a.0, a.1)?, self.element(b.0, b.1)?);
        self.sets.union(a, b);
        Ok(())
    }

    /// Gives all tracks to a graph whose node `nodes[image]` is the camera of `image`; tracks in
    /// the order of their first features, by node and feature. Of tracks with several features in
    /// one image those are kept that `places` find consistent; without places, none. Linear in the
    /// features.
    ///
    /// # Errors
    /// As of [`TrackGraph::push`], and those of `places`.
    pub(crate) fn tracks(
        mut self,
        nodes: &[u32],
        places: Option<&mut dyn Places>,
        to: &mut TrackGraph,
    ) -> Result<(), Problem> {
        let mut images: Vec<u32> = (0..nodes.len() as u32).collect();
        images.sort_unstable_by_key(|&image| nodes[image as usize]);
        let (seen, tracks) = self.observations(&images, nodes);
        let views = Lists::group(tracks, seen.iter().copied());
        let doubled: Vec<u32> = (0..tracks)
            .filter(|&track| is_doubled(views.of(track)))
            .map(|track| track as u32)
            .collect();
        let kept = match places {
            Some(places) if !doubled.is_empty() => {
                let mut asked = vec![false; tracks];
                doubled
                    .iter()
                    .for_each(|&track| asked[track as usize] = true);
                let features = images.iter().flat_map(|&image| {
                    self.features_of(image).map(move |feature| (image, feature))
                });
                let observed = seen.iter().zip(features);
                let observed = observed
                    .filter(|((track, _), _)| asked[*track as usize])
                    .map(|(&(track, _), (image, feature))| (image, track, feature));
                consistent(doubled, observed.collect(), places)?
            }
            _ => Vec::new(),
        };
        let mut kept = kept.into_iter().peekable();
        for track in 0..tracks {
            let views = views.of(track);
            match kept.next_if_eq(&(track as u32)) {
                Some(_) => to.push_merged(views)?,
                None => to.push(views)?,
            }
        }
        Ok(())
    }

    /// Of every image and feature the track that it is in.
    #[cfg(feature = "databases")]
    pub(crate) fn of_features(self) -> Vec<Vec<Option<u32>>> {
        let Self { features, mut sets } = self;
        let mut track = |element: u32| Some(sets.find(element.checked_sub(1)? as usize) as u32);
        let images = features.into_iter();
        images
            .map(|features| features.into_iter().map(&mut track).collect())
            .collect()
    }

    /// The features of an image that are in a track, increasing.
    fn features_of(&self, image: u32) -> impl Iterator<Item = u32> {
        let elements = (0u32..).zip(&self.features[image as usize]);
        elements
            .filter(|&(_, &element)| element > 0)
            .map(|(feature, _)| feature)
    }

    /// For every feature, by image in the order given and by number, its track and its camera; and
    /// how many tracks there are.
    fn observations(&mut self, images: &[u32], nodes: &[u32]) -> (Vec<(u32, u32)>, usize) {
        let Self { features, sets } = self;
        let elements: usize = features.iter().flatten().filter(|&&e| e > 0).count();
        // The track of every set, counted from 1.
        let mut track = vec![0u32; elements];
        let mut tracks = 0;
        let mut seen = Vec::with_capacity(elements);
        for &image in images {
            for element in &features[image as usize] {
                let Some(element) = element.checked_sub(1) else {
                    continue;
                };
                let set = sets.find(element as usize);
                if track[set] == 0 {
                    tracks += 1;
                    track[set] = tracks;
                }
                seen.push((track[set] - 1, nodes[image as usize]));
            }
        }
        (seen, tracks as usize)
    }
}
