//! The images behind the cameras of a camera-point graph, and their frames.
//!
//! In: the images of a database as nodes of a graph, and its camera-point graph, in which images of a
//! frame that were taken at one place are one camera. Out: the camera of every image, and which
//! images mappers place together.

use crate::named::Names;
use std::collections::{BTreeMap, HashMap};
use viewcert_formats::NamedGraph;

/// The images of a database.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Images {
    /// The camera of every image; empty if each image is the camera of its own number.
    camera: Vec<u32>,
    /// The images of every frame that has several whose places to each other are known, increasing.
    pub frames: Vec<Vec<u32>>,
}

impl Images {
    /// Those of a graph whose first nodes are the images, as cameras of a camera-point graph of the
    /// same names. O(images), up to sorting.
    pub fn new(images: &NamedGraph, cameras: &NamedGraph) -> Self {
        let Some(known) = &cameras.frames else {
            return Self::default();
        };
        if known.together.is_empty() {
            let frames = known.groups.clone();
            return Self {
                camera: Vec::new(),
                frames,
            };
        }
        let names = Names::new(cameras);
        let all = names.images();
        let all = all.flat_map(|camera| names.all_of(camera).map(move |name| (name, camera)));
        let camera_of: HashMap<String, u32> = all.collect();
        let names = Names::new(images);
        let camera: Vec<u32> = names.images().map(|v| camera_of[&names.of(v)]).collect();
        let mut frame_of: HashMap<u32, u32> = HashMap::new();
        for group in &known.groups {
            frame_of.extend(group.iter().map(|&camera| (camera, group[0])));
        }
        let mut frames: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (image, camera) in (0..).zip(&camera) {
            let frame = frame_of.get(camera).unwrap_or(camera);
            frames.entry(*frame).or_default().push(image);
        }
        let frames = frames.into_values().filter(|images| images.len() > 1);
        Self {
            frames: frames.collect(),
            camera,
        }
    }

    /// The camera of an image.
    pub fn camera_of(&self, image: u32) -> u32 {
        self.camera.get(image as usize).copied().unwrap_or(image)
    }

    /// In how many frames some images are; each image in none counts as one.
    pub fn count(&self, images: &[u32]) -> usize {
        let has = |image: &&u32| images.binary_search(image).is_ok();
        let shared = self
            .frames
            .iter()
            .map(|frame| frame.iter().filter(has).count());
        let shared: usize = shared.map(|count| count.saturating_sub(1)).sum();
        images.len() - shared
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_counted() {
        let images = Images {
            camera: Vec::new(),
            frames: vec![vec![0, 1], vec![2, 4, 5]],
        };
        assert_eq!(images.count(&[0, 1, 2, 3, 4, 5]), 3);
        assert_eq!((images.count(&[1, 3, 4]), images.count(&[])), (3, 0));
        assert_eq!(images.camera_of(4), 4);
    }
}
