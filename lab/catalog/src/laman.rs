//! Laman graphs: 2 n - 3 edges, and at most 2 k - 3 between any k >= 2 nodes. They are the affine
//! solvable graphs with the least number of edges (docs/theory.md, section 13).
//!
//! In: a number of nodes. Out: one graph of each isomorphism class, grown node by node among the
//! sparse graphs, which are closed under subgraphs.

use super::candidates::{SizeError, to_graph};
use super::grow::grow;
use super::multigraph::{Multigraph, bits};
use viewcert::graph::Graph;

/// The most nodes: sparse graphs are grown from smaller ones, and there are millions with more.
pub const MOST_NODES: usize = 10;

/// Calls `each` for every Laman graph with `nodes` nodes in a fixed order, until it returns false.
///
/// # Errors
/// If there are fewer than two nodes, or more than [`MOST_NODES`].
pub fn for_each(nodes: usize, each: &mut impl FnMut(Graph) -> bool) -> Result<(), SizeError> {
    if !(2..=MOST_NODES).contains(&nodes) {
        return Err(SizeError::Laman {
            nodes,
            most: MOST_NODES,
        });
    }
    grow(nodes, &is_sparse, &mut |graph| {
        graph.edges() != 2 * nodes - 3 || each(to_graph(graph))
    });
    Ok(())
}

/// Whether no k >= 2 nodes have more than 2 k - 3 edges between them, if that is so without the
/// newest node. O(2^n n).
fn is_sparse(graph: &Multigraph) -> bool {
    let newest = 1 << (graph.nodes() - 1);
    let others = graph.all() & !newest;
    // Sets with the newest node, by the rest of them: all subsets of the others but the empty one.
    let mut rest = others;
    while rest != 0 {
        let inside = rest | newest;
        let degrees = bits(inside).map(|v| (graph.neighbours(v) & inside).count_ones());
        let ends: u32 = degrees.sum();
        if ends / 2 > 2 * inside.count_ones() - 3 {
            return false;
        }
        rest = (rest - 1) & others;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::decide::plane_rank;
    use viewcert::watch::Watch;

    /// The published numbers (OEIS A227117), and each is rigid in the plane, which is decided by
    /// other means.
    #[test]
    fn as_many_as_published() {
        for (nodes, expected) in [(2, 1), (3, 1), (4, 1), (5, 3), (6, 13), (7, 70), (8, 608)] {
            let mut found = 0;
            for_each(nodes, &mut |graph| {
                found += 1;
                let rank = plane_rank(&graph, &Watch::default()).unwrap();
                assert_eq!(rank, 2 * nodes - 3, "{graph:?}");
                true
            })
            .unwrap();
            assert_eq!(found, expected, "{nodes} nodes");
        }
    }
}
