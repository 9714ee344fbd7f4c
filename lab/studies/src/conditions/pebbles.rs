//! The partition of the edges with the smallest sum of 11 n_B - 15, by the pebble game.
//!
//! Give every edge seven copies. A set of copies is *independent* if no set of k >= 2 nodes
//! spans more than 11k - 15 of them: a matroid, since 11 <= 15 < 22, whose rank is the
//! smallest sum of 11 n_B - 15 over the partitions of the edges (an edge alone counts
//! 7 = 11 * 2 - 15, which is all its copies). The game of Lee and Streinu (Discrete
//! Mathematics 308, 2008) finds it: every node has 11 pebbles; a copy is independent iff 16
//! pebbles can be moved to its ends, and then takes one.

use viewcert::graph::Graph;
use viewcert::sparsity::Projective;
use viewcert::watch::unwatched;

/// The node sets of the blocks of a partition of the edges with the smallest sum of
/// 11 n_B - 15, in the order of their first edges; any two share at most one node. Of
/// those partitions this is the coarsest. O(n^2 + m).
pub fn blocks(graph: &Graph) -> Vec<Vec<u32>> {
    let found = unwatched(|task| Projective::new(graph, task));
    let mut nodes = vec![Vec::new(); found.components()];
    for (&component, &(i, j)) in found.component_of_edges().iter().zip(graph.edges()) {
        nodes[component as usize].extend([i, j]);
    }
    for nodes in &mut nodes {
        nodes.sort_unstable();
        nodes.dedup();
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use viewcert::geometry::model::Model;

    fn sum(blocks: &[Vec<u32>]) -> usize {
        blocks
            .iter()
            .map(|block| Model::Projective.required(block.len()))
            .sum()
    }

    /// The smallest sum over all partitions of the edges, one by one.
    fn smallest(graph: &Graph) -> usize {
        fn extend(edges: &[(u32, u32)], blocks: &mut Vec<u64>) -> usize {
            let Some((&(i, j), rest)) = edges.split_first() else {
                return blocks
                    .iter()
                    .map(|block| Model::Projective.required(block.count_ones() as usize))
                    .sum();
            };
            let edge = 1 << i | 1 << j;
            blocks.push(edge);
            let mut best = extend(rest, blocks);
            blocks.pop();
            for k in 0..blocks.len() {
                let before = blocks[k];
                blocks[k] |= edge;
                best = best.min(extend(rest, blocks));
                blocks[k] = before;
            }
            best
        }
        extend(graph.edges(), &mut Vec::new())
    }

    #[test]
    fn by_hand() {
        // Two triangles at a node: two blocks. The 4-cycle: four edges, 28 < 29.
        let bowtie = vec![(0, 1), (0, 2), (1, 2), (0, 3), (0, 4), (3, 4)];
        let (graph, _) = Graph::from_pairs(5, bowtie).unwrap();
        assert_eq!(blocks(&graph), [vec![0, 1, 2], vec![0, 3, 4]]);
        let (square, _) = Graph::from_pairs(4, vec![(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
        assert_eq!(sum(&blocks(&square)), 28);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]
        #[test]
        fn the_sum_is_the_smallest(
            nodes in 3..7u32,
            bits in any::<u32>(),
        ) {
            let pairs: Vec<(u32, u32)> = (0..nodes)
                .flat_map(|j| (0..j).map(move |i| (i, j)))
                .enumerate()
                .filter(|(k, _)| bits >> k & 1 == 1)
                .map(|(_, pair)| pair)
                .take(9)
                .collect();
            let (graph, _) = Graph::from_pairs(nodes, pairs).unwrap();
            let found = blocks(&graph);
            prop_assert_eq!(sum(&found), smallest(&graph));
            for &(i, j) in graph.edges() {
                let holding = found.iter().filter(|block| block.contains(&i) && block.contains(&j));
                prop_assert_eq!(holding.count(), 1);
            }
        }
    }
}
