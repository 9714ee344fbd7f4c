//! Neighbours of every node, in one array.

use super::leaves::prune_leaves;
use super::lists::Lists;
use super::viewing_graph::Graph;

/// Neighbour lists in compressed form: 8 bytes an edge and 8 bytes a node. The
/// lists can shrink.
#[derive(Clone, Debug)]
pub struct Adjacency(Lists);

impl Adjacency {
    /// Neighbours of every node in increasing order. O(n + m).
    ///
    /// # Panics
    /// With more than 2^31 - 1 edges.
    pub fn new(graph: &Graph) -> Self {
        assert!(
            i32::try_from(graph.edges().len()).is_ok(),
            "more than 2^31 - 1 edges"
        );
        Self(Lists::of_edges(graph))
    }

    /// Lists that hold every edge at both its ends, in any order.
    pub(crate) fn of_lists(neighbours: Lists) -> Self {
        Self(neighbours)
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.0.len()
    }

    /// The neighbours of all nodes.
    pub fn lists(&self) -> &Lists {
        &self.0
    }

    /// The neighbours of `node`, in increasing order.
    pub fn neighbours(&self, node: u32) -> &[u32] {
        self.0.of(node as usize)
    }

    /// How many neighbours `node` has.
    pub fn degree(&self, node: u32) -> usize {
        self.neighbours(node).len()
    }

    /// Keeps only the neighbours of `node` that `keep` accepts; the lists of those
    /// neighbours stay as they are. O(degree).
    pub fn retain(&mut self, node: u32, keep: impl FnMut(u32) -> bool) {
        self.0.retain(node as usize, keep);
    }

    /// Forgets the neighbours of `node`; their lists stay as they are.
    pub fn clear(&mut self, node: u32) {
        self.0.clear(node as usize);
    }

    /// Each edge `(i, j)`, `i < j`, that both its ends still list, in increasing order while the
    /// lists are.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> {
        let of = |v| self.neighbours(v).iter().map(move |&w| (v, w));
        let nodes = 0..self.nodes() as u32;
        nodes.flat_map(of).filter(|(v, w)| v < w)
    }

    /// Removes the edges at nodes with a single neighbour, again and again until there is no such
    /// node but those that are `held`, and returns them. O(n + m).
    pub fn prune_leaves(&mut self, held: impl Fn(u32) -> bool) -> Vec<(u32, u32)> {
        let removed = prune_leaves(&mut self.0, held);
        let ordered = |(v, w): (u32, u32)| (v.min(w), v.max(w));
        removed.into_iter().map(ordered).collect()
    }
}
