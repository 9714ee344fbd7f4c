//! What a database is, on one screen.

use super::Pipeline;
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;

/// A summary of a database, the member `database` of reports; images are those of its table of images, pairs the rows of its table of
/// verified pairs between two such images.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DatabaseFacts {
    /// The table that the verified pairs are from.
    pub table: Cow<'static, str>,
    /// Which mapper the graph is for.
    pub pipeline: Pipeline,
    /// The least number of inliers of an edge.
    pub min_inliers: u32,
    /// How many images there are.
    pub images: usize,
    /// How many of them are in no pair that is used.
    pub images_without_pair: usize,
    /// How many verified pairs there are.
    pub pairs: usize,
    /// How many of them are used: the pairs of the viewing graph.
    pub pairs_used: usize,
    /// The pairs by the configuration of their geometry, increasing.
    #[serde(serialize_with = "named")]
    pub configs: Vec<ConfigCount>,
    /// The pairs by their numbers of inliers; bins without pairs are left out.
    pub inliers: Vec<Bin>,
    /// The version of COLMAP that wrote it, if it says so: 3.13 is 3,130,000 and 4.2.1 is 4,020,100;
    /// before 3.13 it was a smaller number.
    pub version: Option<u32>,
    /// How many rigs have more than one sensor.
    pub rigs: usize,
    /// How many images have a position by their pose priors.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub positions: usize,
    /// How many images with a pair have a camera that no two others of them have, and a focal length that is
    /// a guess.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub focal_guessed: usize,
    /// How many cameras that three images or more with a pair have and whose focal length is a guess.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub focal_shared: usize,
    /// Whether, by the relative rotations of pairs, the optical axes of all images with a pair are parallel;
    /// asked only where a camera has a focal length that is a guess.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub axes_parallel: bool,
    /// How many images with a pair have no keypoints.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub images_without_keypoints: usize,
    /// The sizes of the connected parts of the viewing graph in images, falling; images without a
    /// pair are parts of one.
    pub connected: Vec<usize>,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Configurations with their names.
fn named<S: Serializer>(configs: &[ConfigCount], to: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Named {
        name: &'static str,
        #[serde(flatten)]
        count: ConfigCount,
    }
    to.collect_seq(configs.iter().map(|&count| Named {
        name: config_name(count.config),
        count,
    }))
}

/// How many pairs have a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ConfigCount {
    /// The number that the database has for it.
    pub config: i64,
    /// How many pairs have it.
    pub pairs: usize,
    /// How many of these are used.
    pub used: usize,
}

/// How many pairs have so many inliers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bin {
    /// The least number in the bin.
    pub from: u32,
    /// The largest, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<u32>,
    /// How many pairs there are.
    pub pairs: usize,
}

/// The images of a part by the pairs that have a base line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Groups {
    /// The images that such pairs connect, larger groups first; one group, if that is all of the part.
    pub groups: Vec<Vec<u32>>,
    /// How many pairs lead from one group to another: they have no fundamental matrix.
    pub pairs: usize,
    /// What these are called, by their configurations.
    pub configs: Vec<&'static str>,
}

impl Groups {
    /// Whether base lines connect all images.
    pub fn is_one(&self) -> bool {
        self.groups.len() < 2
    }
}

/// What COLMAP calls a configuration of two views (`TwoViewGeometry::ConfigurationType`).
pub fn config_name(config: i64) -> &'static str {
    match config {
        0 => "undefined",
        1 => "degenerate",
        2 => "calibrated",
        3 => "uncalibrated",
        4 => "planar",
        5 => "panoramic",
        6 => "planar or panoramic",
        7 => "watermark",
        8 => "multiple",
        9 => "calibrated rig",
        _ => "unknown",
    }
}
