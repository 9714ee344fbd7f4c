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
    /// Those of matches of so many images: two images and a feature of each. O(matches), up to sorting the features
    /// of an image and the matches of a feature.
    pub fn new(images: usize, matches: &[[(u32, u32); 2]]) -> Self {
        let own = sorted(Lists::group(images, matches.as_flattened().iter().copied()));
        let image = (0..images).flat_map(|image| own.of(image).iter().map(move |_| image as u32));
        let image: Vec<u32> = image.collect();
        let begins = 0..=images as u32;
        let begins = begins.map(|from| image.partition_point(|&image| image < from));
        let begins: Vec<usize> = begins.collect();
        let number = |(image, feature): (u32, u32)| {
            let own = own.of(image as usize);
            (begins[image as usize] + own.partition_point(|&other| other < feature)) as u32
        };
        let both = |[one, other]: [u32; 2]| [(one, other), (other, one)];
        let pairs = matches.iter().flat_map(|ends| both(ends.map(number)));
        let pairs: Vec<(u32, u32)> = pairs.collect();
        Self {
            matched: sorted(Lists::group(image.len(), pairs.iter().copied())),
            begins,
            image,
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

/// The lists in increasing order; a list of matches may have one twice.
fn sorted(mut lists: Lists) -> Lists {
    for key in 0..lists.len() {
        let mut items = lists.of(key).to_vec();
        items.sort_unstable();
        items.dedup();
        lists.rewrite(key, &items);
    }
    lists
}
