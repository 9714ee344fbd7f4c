//! Neighbours of every node, in one array.

use crate::graph::Graph;

/// Neighbour lists in compressed form: 8 bytes an edge and 8 bytes a node. The
/// lists can shrink.
#[derive(Clone, Debug)]
pub struct Adjacency {
    start: Vec<u32>,
    len: Vec<u32>,
    neighbours: Vec<u32>,
}

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
        let mut start = vec![0u32; graph.nodes() + 1];
        for &(i, j) in graph.edges() {
            start[i as usize + 1] += 1;
            start[j as usize + 1] += 1;
        }
        for v in 0..graph.nodes() {
            start[v + 1] += start[v];
        }
        let mut len = vec![0; graph.nodes()];
        let mut neighbours = vec![0; 2 * graph.edges().len()];
        let mut put = |at: u32, neighbour: u32| {
            let at = at as usize;
            neighbours[(start[at] + len[at]) as usize] = neighbour;
            len[at] += 1;
        };
        // Edges are sorted, so a first pass over the smaller ends and a second over
        // the larger ones leaves every list in increasing order.
        for &(i, j) in graph.edges() {
            put(j, i);
        }
        for &(i, j) in graph.edges() {
            put(i, j);
        }
        Self {
            start,
            len,
            neighbours,
        }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.len.len()
    }

    /// The neighbours of `node`, in increasing order.
    pub fn neighbours(&self, node: u32) -> &[u32] {
        let start = self.start[node as usize] as usize;
        &self.neighbours[start..start + self.len[node as usize] as usize]
    }

    /// How many neighbours `node` has.
    pub fn degree(&self, node: u32) -> usize {
        self.len[node as usize] as usize
    }

    /// Keeps only the neighbours of `node` that `keep` accepts; the lists of those
    /// neighbours stay as they are. O(degree).
    pub fn retain(&mut self, node: u32, mut keep: impl FnMut(u32) -> bool) {
        let start = self.start[node as usize] as usize;
        let mut kept = start;
        for at in start..start + self.degree(node) {
            let neighbour = self.neighbours[at];
            if keep(neighbour) {
                self.neighbours[kept] = neighbour;
                kept += 1;
            }
        }
        self.len[node as usize] = (kept - start) as u32;
    }
}
