//! What a search for pairs looks at: a graph, its components, and what is known of images.

use super::nearness::Nearness;
use super::tried::{PAIR_NEEDS, Tried};
use super::{Pair, Suggestion, ordered};
use crate::parts::Parts;
use crate::{Known, OtherPair};
use std::collections::HashMap;
use std::ops::Range;
use viewcert::Graph;
use viewcert::graph::Adjacency;

pub(super) struct Search<'a> {
    pub(super) graph: &'a Graph,
    pub(super) parts: &'a Parts,
    pub(super) neighbours: Adjacency,
    pub(super) known: HashMap<Pair, OtherPair>,
    /// Of every pair of the graph, or empty.
    pub(super) inliers: &'a [u32],
    pub(super) nearness: Option<&'a Nearness>,
    /// The nodes that are images: all, or the cameras of a camera-point graph.
    pub(super) images: Range<u32>,
}

impl<'a> Search<'a> {
    pub(super) fn new(graph: &'a Graph, parts: &'a Parts, known: Known<'a>, images: u32) -> Self {
        let others = known.others.iter();
        Self {
            graph,
            parts,
            neighbours: Adjacency::new(graph),
            known: others.map(|pair| (pair.images, *pair)).collect(),
            inliers: known.inliers,
            nearness: known.near,
            images: 0..images,
        }
    }

    /// Whether the graph is one of cameras and points.
    pub(super) fn is_of_tracks(&self) -> bool {
        self.images.len() < self.graph.nodes()
    }

    /// The group of an image: its first part, or itself.
    pub(super) fn group(&self, image: u32) -> u32 {
        match self.parts.of(image) {
            [] => self.parts.parts.len() as u32 + image,
            [part, ..] => *part,
        }
    }

    /// Pairs of images that are matched and used, with how many inliers; 30 where that is not known.
    pub(super) fn matched(&self) -> Vec<(Pair, u32)> {
        if self.is_of_tracks() {
            let used = self.known.values().filter(|known| known.used);
            return used.map(|known| (known.images, known.inliers)).collect();
        }
        let edges = self.graph.edges().iter().enumerate();
        let inliers = |edge: usize| self.inliers.get(edge).copied().unwrap_or(2 * PAIR_NEEDS);
        edges.map(|(edge, &pair)| (pair, inliers(edge))).collect()
    }

    /// Whether a pair could join anything, is where it is wanted, and was not matched with too little
    /// coming of it.
    pub(super) fn is_candidate(&self, (a, b): Pair, at: Option<u32>) -> bool {
        at.is_none_or(|v| v == a || v == b)
            && self.could_join((a, b))
            && !Tried::of(self.known.get(&ordered((a, b)))).is_failure()
    }

    /// Whether a pair could join anything.
    pub(super) fn could_join(&self, (a, b): Pair) -> bool {
        a != b
            // Not two images of a frame, whose base line is known.
            && !self.parts.are_of_one((a, b))
            // Of two cameras that are placed nowhere no point is known that would place either.
            && !(self.is_of_tracks() && self.parts.of(a).is_empty() && self.parts.of(b).is_empty())
    }

    /// Those of some nodes, given increasing, that are images.
    pub(super) fn images_of<'b>(&self, nodes: &'b [u32]) -> &'b [u32] {
        &nodes[..nodes.partition_point(|v| self.images.contains(v))]
    }

    /// Whether a part of each end of all pairs is joined, where it has one: an image of a part that
    /// becomes one of another part as well has joined nothing yet.
    pub(super) fn joins_both(&self, found: &Suggestion) -> bool {
        let mut ends = found.pairs.iter().flat_map(|&((a, b), _)| [a, b]);
        ends.all(|v| {
            let mut parts = self
                .parts
                .of(v)
                .iter()
                .map(|&part| &self.parts.parts[part as usize]);
            let none = parts.len() == 0;
            none || parts.any(|part| found.components.contains(&part.component))
        })
    }
}
