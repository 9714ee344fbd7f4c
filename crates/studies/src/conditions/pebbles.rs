//! The partition of the edges with the smallest sum of 11 n_B - 15, by the pebble game.
//!
//! Give every edge seven copies. A set of copies is *independent* if no set of k >= 2 nodes
//! spans more than 11k - 15 of them: a matroid, since 11 <= 15 < 22, whose rank is the
//! smallest sum of 11 n_B - 15 over the partitions of the edges (an edge alone counts
//! 7 = 11 * 2 - 15, which is all its copies). The game of Lee and Streinu (Discrete
//! Mathematics 308, 2008) finds it: every node has 11 pebbles; a copy is independent iff 16
//! pebbles can be moved to its ends, and then takes one.

use viewcert::graph::Graph;

/// Pebbles of a node.
const K: usize = 11;
/// Pebbles that always stay at the ends of an edge.
const L: usize = 15;
/// Copies of an edge.
const COPIES: usize = 7;

struct Game {
    /// For every node the other ends of the copies that its pebbles cover.
    covers: Vec<Vec<u32>>,
    /// Working space of the search: where a node was reached from.
    from: Vec<u32>,
}

const UNSEEN: u32 = u32::MAX;

impl Game {
    fn new(nodes: usize) -> Self {
        Self {
            covers: vec![Vec::new(); nodes],
            from: vec![UNSEEN; nodes],
        }
    }

    fn free(&self, v: u32) -> usize {
        K - self.covers[v as usize].len()
    }

    /// Moves one more pebble to `u` from any node but `v`; false if none can be moved.
    fn fetch(&mut self, u: u32, v: u32) -> bool {
        self.from.fill(UNSEEN);
        self.from[u as usize] = u;
        self.from[v as usize] = u;
        let mut open = vec![u];
        while let Some(x) = open.pop() {
            for at in 0..self.covers[x as usize].len() {
                let y = self.covers[x as usize][at];
                if self.from[y as usize] != UNSEEN {
                    continue;
                }
                self.from[y as usize] = x;
                if self.free(y) > 0 {
                    self.turn(u, y);
                    return true;
                }
                open.push(y);
            }
        }
        false
    }

    /// Lets every copy on the path from `u` to `end` be covered by its other end.
    fn turn(&mut self, u: u32, mut end: u32) {
        while end != u {
            let before = self.from[end as usize];
            let covers = &mut self.covers[before as usize];
            let at = covers
                .iter()
                .position(|&y| y == end)
                .unwrap_or_else(|| unreachable!("the search followed a covered copy"));
            covers.swap_remove(at);
            self.covers[end as usize].push(before);
            end = before;
        }
    }

    /// Brings as many pebbles as possible to the two nodes; returns how many there are.
    fn gather(&mut self, u: u32, v: u32) -> usize {
        while self.free(u) < K && self.fetch(u, v) {}
        while self.free(v) < K && self.fetch(v, u) {}
        self.free(u) + self.free(v)
    }

    /// Plays all copies of an edge.
    fn play(&mut self, u: u32, v: u32) {
        let spare = self.gather(u, v) - L;
        for _ in 0..spare.min(COPIES) {
            let (covering, other) = if self.free(u) > 0 { (u, v) } else { (v, u) };
            self.covers[covering as usize].push(other);
        }
    }

    /// The largest node set with u and v in which 11 k - 15 copies are independent, given
    /// that all copies of their edge have been played: the nodes from which no free pebble
    /// can be fetched.
    fn block(&mut self, u: u32, v: u32) -> Vec<u32> {
        self.gather(u, v);
        let nodes = self.covers.len() as u32;
        let mut backwards = vec![Vec::new(); nodes as usize];
        for x in 0..nodes {
            for &y in &self.covers[x as usize] {
                backwards[y as usize].push(x);
            }
        }
        let mut open: Vec<u32> = (0..nodes)
            .filter(|&w| w != u && w != v && self.free(w) > 0)
            .collect();
        let mut outside = vec![false; nodes as usize];
        for &w in &open {
            outside[w as usize] = true;
        }
        while let Some(y) = open.pop() {
            for &x in &backwards[y as usize] {
                if !std::mem::replace(&mut outside[x as usize], true) {
                    open.push(x);
                }
            }
        }
        (0..nodes).filter(|&w| !outside[w as usize]).collect()
    }
}

/// The node sets of the blocks of a partition of the edges with the smallest sum of
/// 11 n_B - 15, in the order of their first edges; any two share at most one node. Of
/// those partitions this is the coarsest. O(m n).
pub fn blocks(graph: &Graph) -> Vec<Vec<u32>> {
    let mut game = Game::new(graph.nodes());
    for &(i, j) in graph.edges() {
        game.play(i, j);
    }
    let mut blocks: Vec<Vec<u32>> = Vec::new();
    let mut of_node: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes()];
    for &(i, j) in graph.edges() {
        let known = of_node[i as usize]
            .iter()
            .any(|block| of_node[j as usize].contains(block));
        if !known {
            let block = game.block(i, j);
            for &v in &block {
                of_node[v as usize].push(blocks.len());
            }
            blocks.push(block);
        }
    }
    blocks
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
