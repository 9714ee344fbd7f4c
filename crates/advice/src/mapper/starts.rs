//! The pair that a model begins with: COLMAP's order of candidates, and what disqualifies them.
//!
//! Images come by known focal length, then by their matches; the partners of each likewise. A pair
//! is tried once at each strictness.

use super::growth::Growth;
use super::{Features, Geometry, Scene, Thresholds};
use anyhow::Result;
use std::cmp::Reverse;
use std::collections::{HashMap, HashSet};
use viewcert_formats::colmap::Estimate;

/// A pair that was looked at to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The two images, the smaller one first.
    pub images: (u32, u32),
    /// How many verified matches it has.
    pub inliers: u32,
    /// How many of these a third image is matched with.
    pub points: usize,
    /// What its relative pose says, where the database has one.
    pub estimate: Option<Estimate>,
    /// What disqualifies it, if anything.
    pub unfit: Option<Unfit>,
}

/// What disqualifies a pair to begin with, as the thresholds stood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unfit {
    /// A configuration without a relative pose.
    Configuration,
    /// The motion is forward.
    Forward,
    /// The angle between rays is too small.
    Angle,
    /// Both images are of one frame.
    Frame,
    /// Too few points that a third image sees: the next image would find too few.
    Points,
}

impl Unfit {
    /// The word for it in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Configuration => "configuration",
            Self::Forward => "forward motion",
            Self::Angle => "angle",
            Self::Frame => "one frame",
            Self::Points => "points",
        }
    }
}

/// The candidates, and what became of them.
pub(super) struct Starts {
    /// The images that have a pair, in the order in which they are tried.
    order: Vec<u32>,
    /// The partners of every image, in the order in which they are tried, with their inliers.
    partners: Vec<Vec<(u32, u32)>>,
    /// Pairs that were tried since thresholds were relaxed.
    tried: HashSet<(u32, u32)>,
    /// How often each image was of a pair that a model began with.
    trials: HashMap<u32, u32>,
    /// All pairs that were looked at: what became of them last.
    pub(super) seen: Vec<Start>,
    /// Where each pair is among these.
    place: HashMap<(u32, u32), usize>,
}

impl Starts {
    /// O(pairs log pairs).
    pub(super) fn new(scene: Scene, geometry: &dyn Geometry) -> Self {
        let mut partners = vec![Vec::new(); scene.images];
        let mut matches = vec![0u64; scene.images];
        for &((a, b), inliers) in scene.pairs {
            for (one, other) in [(a, b), (b, a)] {
                partners[one as usize].push((other, inliers));
                matches[one as usize] += u64::from(inliers);
            }
        }
        let unknown: Vec<bool> = (0..scene.images as u32)
            .map(|image| !geometry.has_prior_focal_length(image))
            .collect();
        for partners in &mut partners {
            partners.sort_by_key(|&(image, inliers)| (unknown[image as usize], Reverse(inliers)));
        }
        let all = 0..scene.images as u32;
        let mut order: Vec<u32> = all.filter(|&v| !partners[v as usize].is_empty()).collect();
        order.sort_by_key(|&v| (unknown[v as usize], Reverse(matches[v as usize])));
        Self {
            order,
            partners,
            tried: HashSet::new(),
            trials: HashMap::new(),
            seen: Vec::new(),
            place: HashMap::new(),
        }
    }

    /// How many images have a pair.
    pub(super) fn images(&self) -> usize {
        self.order.len()
    }

    /// Forgets what was tried, for thresholds that take more.
    pub(super) fn relax(&mut self) {
        self.tried.clear();
        self.trials.clear();
    }

    /// The next pair whose geometry is fit, of images that are `free`.
    ///
    /// # Errors
    /// Those of the geometry.
    pub(super) fn next(
        &mut self,
        thresholds: &Thresholds,
        growth: &Growth,
        features: &Features,
        geometry: &mut dyn Geometry,
        free: impl Fn(u32) -> bool,
    ) -> Result<Option<(u32, u32)>> {
        for k in 0..self.order.len() {
            let one = self.order[k];
            let trials = self.trials.get(&one).copied().unwrap_or(0);
            if !free(one) || trials >= thresholds.init_max_reg_trials {
                continue;
            }
            for j in 0..self.partners[one as usize].len() {
                let (other, inliers) = self.partners[one as usize][j];
                let pair = (one.min(other), one.max(other));
                if inliers < thresholds.init_min_num_inliers
                    || !free(other)
                    || !self.tried.insert(pair)
                {
                    continue;
                }
                let estimate = geometry.of(pair)?;
                let mut start = Start {
                    images: pair,
                    inliers,
                    points: features.shared(pair),
                    estimate,
                    unfit: estimate.and_then(|estimate| unfit(&estimate, thresholds)),
                };
                if growth.are_of_one_frame(pair) {
                    start.unfit = Some(Unfit::Frame);
                }
                let fit = start.unfit.is_none();
                if fit && start.points < thresholds.abs_pose_min_num_inliers as usize {
                    start.unfit = Some(Unfit::Points);
                }
                self.note(start);
                if fit {
                    *self.trials.entry(one).or_default() += 1;
                    *self.trials.entry(other).or_default() += 1;
                    return Ok(Some(pair));
                }
            }
        }
        Ok(None)
    }

    /// Keeps what became of a pair last.
    fn note(&mut self, start: Start) {
        let place = *self.place.entry(start.images).or_insert(self.seen.len());
        match self.seen.get_mut(place) {
            Some(known) => *known = start,
            None => self.seen.push(start),
        }
    }
}

/// What disqualifies a pair by its geometry.
fn unfit(estimate: &Estimate, thresholds: &Thresholds) -> Option<Unfit> {
    // COLMAP estimates the pair anew from its inliers, whatever the database calls it. A rotation alone
    // has no angle.
    if estimate.config == 5 {
        return Some(Unfit::Configuration);
    }
    if estimate
        .forward
        .is_some_and(|forward| forward >= thresholds.init_max_forward_motion)
    {
        return Some(Unfit::Forward);
    }
    let small = estimate
        .angle
        .is_some_and(|angle| angle <= thresholds.init_min_tri_angle);
    small.then_some(Unfit::Angle)
}
