//! A graph: its pairs, sorted.

use super::error::GraphError;
use super::sort::{self, SHARE};
use rayon::prelude::*;

/// A simple undirected graph on the nodes `0..nodes`.
///
/// Edges are pairs `(i, j)` with `i < j`, sorted lexicographically and without
/// repetition; the index of an edge in that order is its number everywhere in
/// the program and in certificates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    nodes: u32,
    edges: Vec<(u32, u32)>,
}

impl Graph {
    /// A graph from pairs in any order and orientation; pairs given more than once are one edge.
    /// O(m log m), or O(m) when the pairs are already sorted.
    ///
    /// # Errors
    /// A self-loop, or a node that is not below `nodes`.
    ///
    /// ```
    /// let graph = viewcert::Graph::new(3, [(1, 0), (1, 2), (0, 1)])?;
    /// assert_eq!(graph.edges(), [(0, 1), (1, 2)]);
    /// # Ok::<(), viewcert::GraphError>(())
    /// ```
    pub fn new(
        nodes: u32,
        pairs: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<Self, GraphError> {
        let (graph, _) = Self::from_pairs(nodes, pairs.into_iter().collect())?;
        Ok(graph)
    }

    /// The graph with the given edges on the nodes from 0 to the largest end; see
    /// [`new`](Self::new). It is no `FromIterator`, because a pair of a node with itself is an
    /// error and not left out.
    ///
    /// # Errors
    /// A self-loop, or the node 2^32 - 1, which would be one too many.
    ///
    /// ```
    /// let graph = viewcert::Graph::from_edges([(1, 0), (1, 3)])?;
    /// assert_eq!(graph.nodes(), 4);
    /// # Ok::<(), viewcert::GraphError>(())
    /// ```
    pub fn from_edges(pairs: impl IntoIterator<Item = (u32, u32)>) -> Result<Self, GraphError> {
        let pairs: Vec<(u32, u32)> = pairs.into_iter().collect();
        let last = pairs.iter().map(|&(i, j)| i.max(j)).max();
        let (graph, _) = Self::from_pairs(last.map_or(0, |last| last.saturating_add(1)), pairs)?;
        Ok(graph)
    }

    /// Builds a graph from pairs in any order and orientation; pairs given more
    /// than once are merged. Returns the graph and how many pairs were merged
    /// away. O(m log m), or O(m) if they are in order; in place.
    ///
    /// # Errors
    /// A self-loop, or a node that is not below `nodes`.
    pub fn from_pairs(nodes: u32, mut pairs: Vec<(u32, u32)>) -> Result<(Self, usize), GraphError> {
        let given = pairs.len();
        let shares = pairs.par_chunks_mut(SHARE);
        let looked: Vec<_> = shares.map(|share| sort::orient(nodes, share)).collect();
        let are_increasing: Vec<bool> = looked.into_iter().collect::<Result<_, _>>()?;
        sort::sort(&mut pairs, &are_increasing);
        let merged = given - pairs.len();
        Ok((
            Self {
                nodes,
                edges: pairs,
            },
            merged,
        ))
    }

    /// Number of cameras, n.
    pub fn nodes(&self) -> usize {
        self.nodes as usize
    }

    /// The edges `(i, j)`, `i < j`, sorted; its length is m.
    pub fn edges(&self) -> &[(u32, u32)] {
        &self.edges
    }

    /// The edges from a node to larger ones, sorted. O(log m).
    pub fn edges_from(&self, node: u32) -> &[(u32, u32)] {
        let start = self.edges.partition_point(|&(i, _)| i < node);
        let rest = &self.edges[start..];
        &rest[..rest.partition_point(|&(i, _)| i == node)]
    }

    /// The number of the edge between two nodes, in either order. O(log m).
    pub fn edge_number(&self, a: u32, b: u32) -> Option<usize> {
        self.edges.binary_search(&(a.min(b), a.max(b))).ok()
    }
}
