//! The features of images that are matched, and which are matched with which: COLMAP's graph of
//! correspondences.

use viewcert::graph::Lists;

/// Features and their matches. A feature has a number here, image by image.
#[derive(Clone, Debug)]
pub struct Features {
    /// The image of every feature.
    image: Vec<u32>,
    /// Where the features of every image begin, and the last ones end.
    begins: Vec<usize>,
    /// What every feature is matched with.
    matched: Lists,
}

impl Features {
    /// Those of matches of so many images: two images and a feature of each. O(matches), up to sorting.
    pub fn new(images: usize, matches: &[[(u32, u32); 2]]) -> Self {
        let mut all: Vec<(u32, u32)> = matches.as_flattened().to_vec();
        all.sort_unstable();
        all.dedup();
        let number = |feature: &(u32, u32)| all.partition_point(|other| other < feature) as u32;
        let mut pairs: Vec<(u32, u32)> = matches
            .iter()
            .map(|[one, other]| (number(one), number(other)))
            .flat_map(|(one, other)| [(one, other), (other, one)])
            .collect();
        // A list may have a match twice.
        pairs.sort_unstable();
        pairs.dedup();
        let begins = 0..=images as u32;
        Self {
            begins: begins
                .map(|image| all.partition_point(|feature| feature.0 < image))
                .collect(),
            image: all.iter().map(|feature| feature.0).collect(),
            matched: Lists::group(all.len(), pairs.iter().copied()),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.image.len()
    }

    /// The features of an image.
    pub(super) fn of(&self, image: u32) -> std::ops::Range<usize> {
        self.begins[image as usize]..self.begins[image as usize + 1]
    }

    /// The image of a feature.
    pub(super) fn image(&self, feature: usize) -> u32 {
        self.image[feature]
    }

    /// What a feature is matched with.
    pub(super) fn matched(&self, feature: usize) -> impl Iterator<Item = usize> {
        self.matched.of(feature).iter().map(|&other| other as usize)
    }

    /// Whether no third feature is matched with the two of a match, of which this is one: no point is made
    /// of them.
    pub(super) fn is_alone(&self, feature: usize) -> bool {
        match self.matched.of(feature) {
            &[other] => self.matched.of(other as usize).len() == 1,
            _ => false,
        }
    }

    /// How many matches of two images a third feature is matched with as well. O(matches of the first).
    pub(super) fn shared(&self, (one, other): (u32, u32)) -> usize {
        let features = self.of(one).filter(|&feature| !self.is_alone(feature));
        let matched = features.flat_map(|feature| self.matched(feature));
        matched
            .filter(|&feature| self.image(feature) == other)
            .count()
    }
}
