//! How a model grows: an image is added, with all of its frame, if enough of its features are matched with
//! features of the model that see a point.
//!
//! A point is made of matched features of two images of the model, whose rays are not nearly parallel, if a
//! third feature is matched with one of the two. It is seen by every feature of the model that matches lead to.
//!
//! Images only become more visible as a model grows, so what is reached does not depend on the order;
//! only where a model stops because it shares too much with earlier ones, it does.

use super::{Scene, Thresholds};
use std::collections::{HashMap, HashSet, VecDeque};

/// The matches, and a model that grows in them.
pub(super) struct Growth<'a> {
    scene: Scene<'a>,
    /// Pairs of images whose rays are nearly parallel: no points are made of them, smaller image first.
    blind: HashSet<(u32, u32)>,
    /// Whether each feature is of the model and sees a point.
    pointed: Vec<bool>,
    /// Whether each feature is matched with one that does.
    seen: Vec<bool>,
    /// How many of these each image has.
    visible: Vec<u32>,
    in_model: Vec<bool>,
    /// For every image its place in the frames of the scene, if it is in one.
    frame_of: HashMap<u32, usize>,
    /// The images of the model in the order in which they came.
    pub(super) model: Vec<u32>,
}

impl<'a> Growth<'a> {
    /// No model yet. O(features).
    pub(super) fn new(scene: Scene<'a>, blind: HashSet<(u32, u32)>) -> Self {
        let frames = scene.frames.iter().enumerate();
        let frames = frames.flat_map(|(k, frame)| frame.iter().map(move |&image| (image, k)));
        Self {
            scene,
            frame_of: frames.collect(),
            blind,
            pointed: vec![false; scene.features.count()],
            seen: vec![false; scene.features.count()],
            visible: vec![0; scene.images],
            in_model: vec![false; scene.images],
            model: Vec::new(),
        }
    }

    /// How many points of the model an image sees.
    pub(super) fn sees(&self, image: u32) -> u32 {
        self.visible[image as usize]
    }

    /// Whether an image is in the model.
    pub(super) fn has(&self, image: u32) -> bool {
        self.in_model[image as usize]
    }

    /// Grows a model from two images until no image can be added, or until `crowded` says so of the
    /// image that was added last. O(matches of the model).
    pub(super) fn grow(
        &mut self,
        start: (u32, u32),
        thresholds: &Thresholds,
        mut crowded: impl FnMut(u32) -> bool,
    ) {
        self.clear();
        let needs = thresholds.abs_pose_min_num_inliers;
        let mut next = VecDeque::from([start.0, start.1]);
        while let Some(image) = next.pop_front() {
            if self.has(image) {
                continue;
            }
            let mut is_crowded = false;
            for image in self.frame(image) {
                self.add(image, needs, &mut next);
                is_crowded |= crowded(image);
            }
            if is_crowded {
                break;
            }
        }
    }

    /// The images of the frame of an image.
    fn frame(&self, image: u32) -> Vec<u32> {
        let frame = self.frame_of.get(&image);
        frame.map_or_else(|| vec![image], |&k| self.scene.frames[k].clone())
    }

    /// Whether two images are of one frame.
    pub(super) fn are_of_one_frame(&self, (a, b): (u32, u32)) -> bool {
        let frame = self.frame_of.get(&a);
        frame.is_some() && frame == self.frame_of.get(&b)
    }

    /// Adds an image; those that see enough points because of it are put behind `next`.
    fn add(&mut self, image: u32, needs: u32, next: &mut VecDeque<u32>) {
        self.in_model[image as usize] = true;
        self.model.push(image);
        let features = self.scene.features;
        for feature in features.of(image) {
            if !self.makes(image, feature) {
                continue;
            }
            // A point is seen wherever matches lead inside the model.
            let mut reached = vec![feature];
            while let Some(feature) = reached.pop() {
                if std::mem::replace(&mut self.pointed[feature], true) {
                    continue;
                }
                for other in features.matched(feature) {
                    let image = features.image(other);
                    if self.has(image) {
                        reached.push(other);
                    } else if !std::mem::replace(&mut self.seen[other], true) {
                        let visible = &mut self.visible[image as usize];
                        *visible += 1;
                        if *visible == needs {
                            next.push_back(image);
                        }
                    }
                }
            }
        }
    }

    /// Whether a feature of an image of the model sees a point, or makes one with another of the model.
    fn makes(&self, image: u32, feature: usize) -> bool {
        let features = self.scene.features;
        let apart = |other: u32| !self.blind.contains(&(image.min(other), image.max(other)));
        let makes = |other: usize| {
            let its = features.image(other);
            self.pointed[other] || (its != image && self.has(its) && apart(its))
        };
        !features.is_alone(feature) && features.matched(feature).any(makes)
    }

    /// Forgets the model. O(matches of the model).
    fn clear(&mut self) {
        let features = self.scene.features;
        for image in std::mem::take(&mut self.model) {
            self.in_model[image as usize] = false;
            for feature in features.of(image) {
                self.pointed[feature] = false;
                for other in features.matched(feature) {
                    self.seen[other] = false;
                }
            }
        }
        self.visible.fill(0);
    }
}
