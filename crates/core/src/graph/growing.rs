//! Sets of nodes that take in every node with enough edges to them, and each other.

use super::{Adjacency, Graph};
use std::collections::{BTreeSet, HashMap};

/// Sets that grow: a node with `enough` edges to a set joins it, and sets that share `common` nodes
/// are one.
#[derive(Clone, Debug)]
pub struct Growing {
    neighbours: Adjacency,
    enough: usize,
    common: usize,
    /// The sets; empty once another one has taken it in.
    sets: Vec<BTreeSet<u32>>,
    /// For every node the sets that it was put into, gone ones included.
    of: Vec<Vec<u32>>,
}

impl Growing {
    /// No sets yet.
    pub fn new(graph: &Graph, enough: usize, common: usize) -> Self {
        Self {
            neighbours: Adjacency::new(graph),
            enough,
            common,
            sets: Vec::new(),
            of: vec![Vec::new(); graph.nodes()],
        }
    }

    /// The sets that are left, each increasing.
    pub fn into_sets(self) -> Vec<Vec<u32>> {
        let left = self.sets.into_iter().filter(|set| !set.is_empty());
        left.map(|set| set.into_iter().collect()).collect()
    }

    /// Whether one set holds these nodes, one at least.
    pub fn holds(&self, nodes: &[u32]) -> bool {
        self.of[nodes[0] as usize].iter().any(|&set| {
            let set = &self.sets[set as usize];
            nodes.iter().all(|v| set.contains(v))
        })
    }

    /// Looks for a clique of so many nodes at every edge that no set holds, greedily, and lets it grow.
    /// O(m) steps on adjacent nodes, and what growth takes: O(m log n) while sets do not merge.
    pub fn add_cliques(&mut self, graph: &Graph, size: usize) {
        for &(a, b) in graph.edges() {
            if self.holds(&[a, b]) {
                continue;
            }
            let near = self.neighbours.neighbours(b);
            let mut clique = vec![a, b];
            for &c in self.neighbours.neighbours(a) {
                if clique.len() == size {
                    break;
                }
                let joins = |&v: &u32| graph.edge_number(v, c).is_some();
                if near.contains(&c) && clique[2..].iter().all(joins) {
                    clique.push(c);
                }
            }
            if clique.len() == size {
                self.add(&clique);
            }
        }
    }

    /// Adds a set with all that it takes in, other sets among it.
    pub fn add(&mut self, seed: &[u32]) {
        if self.holds(seed) {
            return;
        }
        let number = self.sets.len() as u32;
        let mut set = BTreeSet::new();
        let mut edges: HashMap<u32, usize> = HashMap::new();
        let mut shared: HashMap<u32, usize> = HashMap::new();
        let mut open = seed.to_vec();
        while let Some(v) = open.pop() {
            if !set.insert(v) {
                continue;
            }
            for &w in self.neighbours.neighbours(v) {
                let count = edges.entry(w).or_default();
                *count += 1;
                if *count == self.enough {
                    open.push(w);
                }
            }
            for &other in &self.of[v as usize] {
                let count = shared.entry(other).or_default();
                *count += 1;
                if *count == self.common {
                    open.extend(std::mem::take(&mut self.sets[other as usize]));
                }
            }
            self.of[v as usize].push(number);
        }
        self.sets.push(set);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles with a common side, a third one that shares a node, and a fourth node that sees
    /// one of the first and one of the third.
    #[test]
    fn cliques_grow_and_merge() {
        let pairs = [
            (0, 1),
            (0, 2),
            (1, 2),
            (1, 3),
            (2, 3),
            (3, 4),
            (3, 5),
            (4, 5),
            (0, 6),
            (4, 6),
        ];
        let graph = Graph::new(7, pairs).unwrap();
        let sets = |enough, common| {
            let mut growing = Growing::new(&graph, enough, common);
            growing.add_cliques(&graph, 3);
            assert!(growing.holds(&[3, 5]) && !growing.holds(&[0, 6]));
            growing.into_sets()
        };
        assert_eq!(sets(2, 2), [vec![0, 1, 2, 3], vec![3, 4, 5]]);
        assert_eq!(sets(3, 2), [vec![0, 1, 2, 3], vec![3, 4, 5]]);
        assert_eq!(sets(3, 3), [vec![0, 1, 2], vec![1, 2, 3], vec![3, 4, 5]]);
        let mut growing = Growing::new(&graph, 2, 1);
        growing.add_cliques(&graph, 3);
        assert_eq!(growing.into_sets(), [vec![0, 1, 2, 3, 4, 5, 6]]);
    }
}
