//! How a model grows: an image is added, with all of its frame, if it sees enough points that two images
//! of the model see, whose rays are not nearly parallel.
//!
//! Images only become more visible as a model grows, so what is reached does not depend on the order;
//! only where a model stops because it shares too much with earlier ones, it does.

use super::{Scene, Thresholds};
use std::collections::{HashMap, HashSet, VecDeque};
use viewcert::graph::Lists;

/// The tracks, and a model that grows in them.
pub(super) struct Growth<'a> {
    scene: Scene<'a>,
    /// The images of every point.
    images_of: Lists,
    /// Pairs of images whose rays are nearly parallel: no points are made of them, smaller image first.
    blind: HashSet<(u32, u32)>,
    /// Whether each point is made.
    made: Vec<bool>,
    /// Whether an image of the model sees each point.
    seen: Vec<bool>,
    /// How many points of the model each image sees.
    visible: Vec<u32>,
    in_model: Vec<bool>,
    /// For every image its place in the frames of the scene, if it is in one.
    frame_of: HashMap<u32, usize>,
    /// The images of the model in the order in which they came.
    pub(super) model: Vec<u32>,
}

impl<'a> Growth<'a> {
    /// No model yet. O(observations).
    pub(super) fn new(scene: Scene<'a>, blind: HashSet<(u32, u32)>) -> Self {
        let images = scene.images as u32;
        let points = scene.tracks.nodes() - scene.images;
        let seen_by = scene.tracks.edges().iter();
        let seen_by = seen_by.map(move |&(image, point)| (point - images, image));
        let frames = scene.frames.iter().enumerate();
        let frames = frames.flat_map(|(k, frame)| frame.iter().map(move |&image| (image, k)));
        Self {
            scene,
            frame_of: frames.collect(),
            images_of: Lists::group(points, seen_by),
            blind,
            made: vec![false; points],
            seen: vec![false; points],
            visible: vec![0; scene.images],
            in_model: vec![false; scene.images],
            model: Vec::new(),
        }
    }

    /// How many points two images both see. O(points of both).
    pub(super) fn shared(&self, (a, b): (u32, u32)) -> usize {
        let points = |image: u32| {
            self.scene
                .tracks
                .edges_from(image)
                .iter()
                .map(|edge| edge.1)
        };
        let mut others = points(b).peekable();
        points(a)
            .filter(|&point| {
                while others.next_if(|&other| other < point).is_some() {}
                others.next_if_eq(&point).is_some()
            })
            .count()
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
    /// image that was added last. O(observations of the model).
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
        let images = self.scene.images as u32;
        for &(_, point) in self.scene.tracks.edges_from(image) {
            let point = (point - images) as usize;
            let first = !std::mem::replace(&mut self.seen[point], true);
            if !first && !self.made[point] && self.makes(image, point) {
                self.made[point] = true;
                for &other in self.images_of.of(point) {
                    let visible = &mut self.visible[other as usize];
                    *visible += 1;
                    if *visible == needs && !self.in_model[other as usize] {
                        next.push_back(other);
                    }
                }
            }
        }
    }

    /// Whether an image makes a point together with another one of the model that sees it.
    fn makes(&self, image: u32, point: usize) -> bool {
        let apart = |other: u32| !self.blind.contains(&(image.min(other), image.max(other)));
        let mut others = self.images_of.of(point).iter().copied();
        self.blind.is_empty()
            || others.any(|other| other != image && self.has(other) && apart(other))
    }

    /// Forgets the model. O(observations of the model).
    fn clear(&mut self) {
        let images = self.scene.images as u32;
        for image in std::mem::take(&mut self.model) {
            self.in_model[image as usize] = false;
            for &(_, point) in self.scene.tracks.edges_from(image) {
                self.seen[(point - images) as usize] = false;
                self.made[(point - images) as usize] = false;
            }
        }
        self.visible.fill(0);
    }
}
