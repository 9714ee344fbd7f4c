//! The thresholds of incremental mapping, with the names and defaults that they have in COLMAP.

use serde::Serialize;

/// Thresholds of COLMAP's incremental mapper (`IncrementalMapper::Options`,
/// `IncrementalPipelineOptions`; version 4.2).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Thresholds {
    /// Verified matches of the pair that a model begins with.
    pub init_min_num_inliers: u32,
    /// Degrees between the two rays to a point of that pair, in the median.
    pub init_min_tri_angle: f64,
    /// The share of the motion between the two that may be forward.
    pub init_max_forward_motion: f64,
    /// How often an image may be of the pair that a model begins with.
    pub init_max_reg_trials: u32,
    /// How many pairs are tried to begin with, at each strictness.
    pub init_num_trials: u32,
    /// Degrees between two rays to a point that is made of them (`triangulation.min_angle`).
    pub min_angle: f64,
    /// Points of the model that an image has to see to be added.
    pub abs_pose_min_num_inliers: u32,
    /// Images that a model has to have, but the first, to be kept. COLMAP's default is 10, or half of
    /// all images if these are fewer; here smaller models are simulated as well, and said to be
    /// dropped ([`Thresholds::kept`]).
    pub min_model_size: usize,
    /// Images that a model may share with earlier ones.
    pub max_model_overlap: usize,
    /// How many models there may be.
    pub max_num_models: usize,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self {
            init_min_num_inliers: 100,
            init_min_tri_angle: 16.0,
            init_max_forward_motion: 0.95,
            init_max_reg_trials: 2,
            init_num_trials: 200,
            min_angle: 1.5,
            abs_pose_min_num_inliers: 30,
            min_model_size: 3,
            max_model_overlap: 20,
            max_num_models: 50,
        }
    }
}

impl Thresholds {
    /// How often COLMAP halves first the inliers and then the angle that a beginning takes.
    pub const RELAXATIONS: u32 = 2;

    /// How many images a model needs to be kept where COLMAP's options are not changed, of so many
    /// that have a pair. The first model is kept in any case.
    pub fn kept(images: usize) -> usize {
        (images / 2).min(10)
    }
}
