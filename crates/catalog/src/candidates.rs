//! All biconnected graphs with given numbers of nodes and edges.

use super::grow::grow;
use super::kernel::{MAX_CYCLES, kernels};
use super::multigraph::{MAX_NODES, Multigraph};
use super::subdivide::{Edges, Subdivisions};
use viewcert::geometry::model::Model;
use viewcert::graph::Graph;

/// The least number of edges of a finite-solvable graph with `nodes` >= 2 nodes: an edge
/// has rank 7, so it is ceil((11 n - 15) / 7).
///
/// # Example
/// ```
/// assert_eq!(viewcert_catalog::least_edges(9), 12);
/// ```
pub fn least_edges(nodes: usize) -> usize {
    Model::Projective.required(nodes).div_ceil(7)
}

/// Why there are no candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SizeError {
    /// Fewer than 3 nodes, or more than the generator takes.
    #[error("graphs with {} are not enumerated: ask for 3 to {MAX_NODES} nodes", viewcert::wording::counted(*.nodes, "node"))]
    Nodes {
        /// How many were asked for.
        nodes: usize,
    },
    /// No biconnected simple graph has so few or so many edges.
    #[error(
        "no biconnected graph has {nodes} nodes and {edges} edges: {nodes} nodes take {nodes} to \
         {most} edges"
    )]
    Edges {
        /// How many nodes were asked for.
        nodes: usize,
        /// How many edges.
        edges: usize,
        /// How many edges there can be.
        most: usize,
    },
    /// Fewer than 2 nodes, or more than Laman graphs are grown to.
    #[error(
        "Laman graphs with {} are not enumerated: ask for 2 to {} nodes",
        viewcert::wording::counted(*.nodes, "node"),
        super::laman::MOST_NODES
    )]
    Laman {
        /// How many were asked for.
        nodes: usize,
    },
}

/// The candidates of a size.
pub struct Candidates {
    nodes: usize,
    edges: usize,
    necessary: bool,
    kernels: Option<Vec<Multigraph>>,
}

impl Candidates {
    /// Prepares the enumeration of the biconnected graphs with `nodes` nodes and `edges`
    /// edges; with `necessary`, of those without adjacent nodes of degree 2 (which are not
    /// finite solvable, except the triangle). With up to 9 independent cycles, m - n + 1 <= 9
    /// (6 with fewer than 10 nodes), the [`kernels`] are found here and kept; otherwise memory is
    /// negligible and time grows with the number of connected graphs on `nodes - 1` nodes.
    ///
    /// # Errors
    /// If there are none, or the graphs are too large.
    pub fn new(nodes: usize, edges: usize, necessary: bool) -> Result<Self, SizeError> {
        if !(3..=MAX_NODES).contains(&nodes) {
            return Err(SizeError::Nodes { nodes });
        }
        let most = nodes * (nodes - 1) / 2;
        if !(nodes..=most).contains(&edges) {
            return Err(SizeError::Edges { nodes, edges, most });
        }
        let cycles = edges + 1 - nodes;
        // There are many kernels with many cycles, and few graphs with few nodes.
        let most_cycles = if nodes < 10 { 6 } else { MAX_CYCLES };
        let by_kernels = (2..=most_cycles).contains(&cycles);
        Ok(Self {
            nodes,
            edges,
            necessary,
            kernels: by_kernels.then(|| kernels(cycles, nodes)),
        })
    }

    /// How many candidates there are, where counting them takes no longer than a small
    /// part of deciding them.
    pub fn count(&self) -> Option<u64> {
        let kernels = self.kernels.as_ref()?;
        let mut count = 0;
        for kernel in kernels {
            self.subdivisions(kernel).for_each(&mut |_| {
                count += 1;
                true
            });
        }
        Some(count)
    }

    /// Numbers of nodes and edges.
    pub fn size(&self) -> (usize, usize) {
        (self.nodes, self.edges)
    }

    /// The kernels that the candidates are made from; `None` if they are made node by node.
    pub fn kernels(&self) -> Option<&[Multigraph]> {
        self.kernels.as_deref()
    }

    /// The candidates of one of the [`kernels`](Self::kernels).
    pub fn subdivisions(&self, kernel: &Multigraph) -> Subdivisions {
        let edges = if self.necessary {
            Edges::Once
        } else {
            Edges::Any
        };
        Subdivisions::new(kernel, self.nodes, edges)
    }

    /// Calls `each` for every candidate, in a fixed order, until it returns false.
    pub fn for_each(&self, each: &mut impl FnMut(Graph) -> bool) {
        match &self.kernels {
            Some(kernels) => {
                for kernel in kernels {
                    let subdivisions = self.subdivisions(kernel);
                    if !subdivisions.for_each(&mut |subdivision| each(subdivision.graph())) {
                        return;
                    }
                }
            }
            // The cycle is the one graph with a single independent cycle.
            None if self.edges == self.nodes => {
                if self.nodes == 3 || !self.necessary {
                    let n = self.nodes as u32;
                    let cycle = (0..n).map(|v| (v, (v + 1) % n)).collect();
                    if let Ok((graph, _)) = Graph::from_pairs(n, cycle) {
                        each(graph);
                    }
                }
            }
            None => {
                // Every node to come brings at least one edge.
                let keep =
                    |graph: &Multigraph| graph.edges() + self.nodes - graph.nodes() <= self.edges;
                grow(self.nodes, &keep, &mut |graph| {
                    let wanted = graph.edges() == self.edges
                        && graph.is_biconnected()
                        && !(self.necessary && has_adjacent_nodes_of_degree_2(graph));
                    !wanted || each(to_graph(graph))
                });
            }
        }
    }
}

/// Whether two nodes of degree 2 are adjacent.
pub fn has_adjacent_nodes_of_degree_2(graph: &Multigraph) -> bool {
    graph
        .pairs()
        .any(|(u, v, _)| graph.degree(u) == 2 && graph.degree(v) == 2)
}

/// A multigraph without parallel edges as a graph.
///
/// # Panics
/// Never: a multigraph has no loops.
pub fn to_graph(graph: &Multigraph) -> Graph {
    let pairs = graph.pairs().map(|(u, v, _)| (u as u32, v as u32));
    let (graph, _) = Graph::from_pairs(graph.nodes() as u32, pairs.collect()).expect("no loops");
    graph
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canonical::canonical;
    use std::collections::BTreeSet;

    fn count(nodes: usize, edges: usize, necessary: bool) -> usize {
        let mut count = 0;
        Candidates::new(nodes, edges, necessary)
            .unwrap()
            .for_each(&mut |_| {
                count += 1;
                true
            });
        count
    }

    /// The number of biconnected graphs with n nodes: OEIS A002218.
    #[test]
    fn biconnected_graphs_with_any_number_of_edges() {
        for (nodes, expected) in [(3, 1), (4, 3), (5, 10), (6, 56), (7, 468)] {
            let found: usize = (nodes..=nodes * (nodes - 1) / 2)
                .map(|edges| count(nodes, edges, false))
                .sum();
            assert_eq!(found, expected, "{nodes} nodes");
        }
    }

    #[test]
    fn both_ways_of_enumeration_agree() {
        for (nodes, edges) in [(6, 8), (7, 10), (7, 13), (8, 11)] {
            let forms = |graph: &Graph| canonical(&Multigraph::from_graph(graph).unwrap()).key;
            let (mut one, mut two) = (BTreeSet::new(), BTreeSet::new());
            let mut candidates = Candidates::new(nodes, edges, false).unwrap();
            candidates.for_each(&mut |graph| one.insert(forms(&graph)));
            candidates.kernels = None;
            candidates.for_each(&mut |graph| two.insert(forms(&graph)));
            assert_eq!(one, two);
        }
    }

    #[test]
    fn necessary_candidates_are_those_without_adjacent_nodes_of_degree_2() {
        for (nodes, edges) in [(4, 5), (5, 5), (5, 6), (7, 9), (8, 11), (7, 16)] {
            let mut expected = 0;
            Candidates::new(nodes, edges, false)
                .unwrap()
                .for_each(&mut |graph| {
                    let graph = Multigraph::from_graph(&graph).unwrap();
                    expected += usize::from(!has_adjacent_nodes_of_degree_2(&graph));
                    true
                });
            assert_eq!(count(nodes, edges, true), expected, "({nodes}, {edges})");
        }
        // The exception: the triangle is finite solvable.
        assert_eq!(count(3, 3, true), 1);
    }

    #[test]
    fn impossible_sizes_are_refused() {
        let error = |nodes, edges| Candidates::new(nodes, edges, false).err();
        assert_eq!(error(2, 1), Some(SizeError::Nodes { nodes: 2 }));
        assert_eq!(error(17, 30), Some(SizeError::Nodes { nodes: 17 }));
        let edges = |nodes, edges, most| Some(SizeError::Edges { nodes, edges, most });
        assert_eq!(error(5, 4), edges(5, 4, 10));
        assert_eq!(error(5, 11), edges(5, 11, 10));
    }

    /// Edge numbers of the paper's Table 1.
    #[test]
    fn least_numbers_of_edges() {
        let expected = [3, 5, 6, 8, 9, 11, 12, 14];
        assert_eq!((3..=10).map(least_edges).collect::<Vec<_>>(), expected);
    }
}
