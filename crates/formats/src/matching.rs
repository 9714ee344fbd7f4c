//! What a matching of images says of pairs, beyond the graph that it gives.

use serde::{Deserialize, Serialize};

/// Facts about pairs of images, from a database of matches; images are nodes of the graph.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Matching {
    /// For every edge, in the order of the graph's edges, how many verified matches it has. Of a
    /// camera-point graph, whose edges are observations, empty.
    pub inliers: Vec<u32>,
    /// Pairs of images that are known and are no edges, increasing. Of a camera-point graph, all.
    pub others: Vec<OtherPair>,
    /// Where every image was taken, in a frame of metres or of whatever the database has; empty if
    /// no place is known. What is near is looked for by it, and nothing is decided.
    pub positions: Vec<Option<[f64; 3]>>,
}

/// A pair of images that was matched: with too few matches or none, or not verified, unless tracks
/// are made of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OtherPair {
    /// The two images, the smaller node first.
    pub images: (u32, u32),
    /// How many matches were verified.
    pub inliers: u32,
    /// How many there were before verification, if that is known.
    pub matches: Option<u32>,
    /// Whether the verification was run, whatever came of it.
    pub verified: bool,
    /// Whether tracks are made of its matches; never in a graph of pairs.
    pub used: bool,
}
