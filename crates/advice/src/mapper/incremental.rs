//! Incremental mapping: models one after another, each from what is left.
//!
//! The order of steps is that of COLMAP's `IncrementalPipeline::Run` and `Reconstruct`: a pair to
//! begin with, growth, and again, until no pair is fit; then with half the inliers, half the angle,
//! and both again.

use super::geometry::Cached;
use super::growth::Growth;
use super::starts::{Start, Starts};
use super::{Features, Geometry, Scene, Thresholds};
use anyhow::Result;
use std::collections::HashSet;

/// Most pairs whose poses are read; what comes later passes.
const LOOKED_AT: usize = 1000;

/// Most pairs of a database whose angles are all read.
const ALL_READ: usize = 1000;

/// What incremental mapping is likely to return.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Incremental {
    /// The models, in the order in which they are made. An image may be in several.
    pub models: Vec<SimulatedModel>,
    /// The pairs that were looked at to begin with, and what became of each last.
    pub starts: Vec<Start>,
    /// For every image that is in no model, the most points that it sees of one.
    pub outside: Vec<Stop>,
    /// With how many images a model is kept where COLMAP's options are not changed, unless it is the
    /// first.
    pub kept_from: usize,
}

/// A model.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatedModel {
    /// The pair that it begins with.
    pub start: (u32, u32),
    /// Its images, increasing.
    pub images: Vec<u32>,
    /// The image that comes nearest to being added, if any image sees a point of it.
    pub stop: Option<Stop>,
    /// Whether it is kept where COLMAP's options are not changed.
    pub kept: bool,
}

/// An image that sees too few points of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The image.
    pub image: u32,
    /// How many points it sees.
    pub sees: u32,
}

/// The state between models.
struct Run<'a> {
    thresholds: Thresholds,
    features: &'a Features,
    growth: Growth<'a>,
    starts: Starts,
    /// In how many models every image is.
    registered: Vec<u32>,
    /// How many images are in a model.
    total: usize,
    /// The most points of one model that every image saw.
    sees: Vec<u32>,
    models: Vec<SimulatedModel>,
}

/// Simulates incremental mapping. O(matches) for each model that is begun, of which there are
/// few, and the reading of what geometry knows of the pairs that are looked at.
///
/// # Errors
/// Those of the geometry.
pub fn incremental(
    scene: Scene,
    geometry: &mut dyn Geometry,
    thresholds: Thresholds,
) -> Result<Incremental> {
    let mut geometry = Cached::new(geometry, LOOKED_AT);
    let geometry = &mut geometry;
    let blind = blind(scene, geometry, &thresholds)?;
    let mut run = Run {
        thresholds,
        features: scene.features,
        growth: Growth::new(scene, blind),
        starts: Starts::new(scene, geometry),
        registered: vec![0; scene.images],
        total: 0,
        sees: vec![0; scene.images],
        models: Vec::new(),
    };
    let mut go_on = run.models(geometry)?;
    for _ in 0..Thresholds::RELAXATIONS {
        if go_on {
            run.thresholds.init_min_num_inliers /= 2;
            go_on = run.relaxed(geometry)?;
        }
        if go_on {
            run.thresholds.init_min_tri_angle /= 2.0;
            go_on = run.relaxed(geometry)?;
        }
    }
    let outside = (0..).zip(&run.registered).zip(&run.sees);
    let outside = outside.filter(|((_, models), _)| **models == 0);
    Ok(Incremental {
        outside: outside
            .map(|((image, _), &sees)| Stop { image, sees })
            .collect(),
        kept_from: Thresholds::kept(run.starts.images()),
        models: run.models,
        starts: run.starts.seen,
    })
}

/// The pairs of whose rays no points are made; none, if there are too many pairs to read.
fn blind(
    scene: Scene,
    geometry: &mut dyn Geometry,
    thresholds: &Thresholds,
) -> Result<HashSet<(u32, u32)>> {
    let mut blind = HashSet::new();
    if scene.pairs.len() > ALL_READ {
        return Ok(blind);
    }
    for &(pair, _) in scene.pairs {
        let known = geometry.of(pair)?;
        let small = |angle: f64| angle < thresholds.min_angle;
        if known.is_some_and(|known| known.config == 5 || known.angle.is_some_and(small)) {
            blind.insert(pair);
        }
    }
    Ok(blind)
}

impl Run<'_> {
    /// More models, with thresholds that take more.
    fn relaxed(&mut self, geometry: &mut dyn Geometry) -> Result<bool> {
        if self.total == self.starts.images() {
            return Ok(false);
        }
        self.starts.relax();
        self.models(geometry)
    }

    /// Models, until no pair is fit to begin with; whether other thresholds may help.
    fn models(&mut self, geometry: &mut dyn Geometry) -> Result<bool> {
        for _ in 0..self.thresholds.init_num_trials {
            let registered = &self.registered;
            let free = |image: u32| registered[image as usize] == 0;
            let start = self.starts.next(
                &self.thresholds,
                &self.growth,
                self.features,
                geometry,
                free,
            )?;
            let Some(start) = start else {
                return Ok(true);
            };
            if self.features.shared(start) < self.thresholds.abs_pose_min_num_inliers as usize {
                continue;
            }
            self.model(start);
            if self.models.len() >= self.thresholds.max_num_models
                || self.total + 1 >= self.starts.images()
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// One model, kept unless it is small.
    fn model(&mut self, start: (u32, u32)) {
        let (registered, most) = (&self.registered, self.thresholds.max_model_overlap);
        let mut shared = 0;
        self.growth.grow(start, &self.thresholds, |image| {
            shared += usize::from(registered[image as usize] > 0);
            shared >= most
        });
        let size = self.growth.model.len();
        if !self.models.is_empty() && size < self.thresholds.min_model_size {
            return;
        }
        for &image in &self.growth.model {
            self.total += usize::from(self.registered[image as usize] == 0);
            self.registered[image as usize] += 1;
        }
        let mut images = self.growth.model.clone();
        images.sort_unstable();
        let all = 0..self.registered.len() as u32;
        let others = all.filter(|&image| !self.growth.has(image) && self.growth.sees(image) > 0);
        let stops = others.map(|image| Stop {
            image,
            sees: self.growth.sees(image),
        });
        for (image, sees) in (0..).zip(&mut self.sees) {
            *sees = (*sees).max(self.growth.sees(image));
        }
        self.models.push(SimulatedModel {
            start,
            images,
            stop: stops.max_by_key(|stop| (stop.sees, std::cmp::Reverse(stop.image))),
            kept: self.models.is_empty() || size >= Thresholds::kept(self.starts.images()),
        });
    }
}
