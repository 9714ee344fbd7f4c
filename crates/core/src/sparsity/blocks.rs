//! Sets of nodes, any two of which share at most one node: which of them holds two given ones?

use std::collections::{HashMap, HashSet};

/// Sets of nodes, numbered in the order in which they came. Two nodes lie together in at most one.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    /// For every node the blocks that hold it; some may be gone.
    of: Vec<Vec<u32>>,
    /// The nodes of a block; none of one that is gone.
    nodes: Vec<HashSet<u32>>,
}

impl Blocks {
    pub(super) fn new(nodes: usize) -> Self {
        Self {
            of: vec![Vec::new(); nodes],
            nodes: Vec::new(),
        }
    }

    /// How many blocks have been added.
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The block that holds two nodes.
    pub(super) fn common(&self, u: u32, v: u32) -> Option<u32> {
        let [less, more] = if self.of[u as usize].len() <= self.of[v as usize].len() {
            [u, v]
        } else {
            [v, u]
        };
        let mut blocks = self.of[less as usize].iter().copied();
        blocks.find(|&block| {
            let nodes = &self.nodes[block as usize];
            nodes.contains(&less) && nodes.contains(&more)
        })
    }

    /// Adds a block, and returns its number.
    pub(super) fn add(&mut self, nodes: &[u32]) -> u32 {
        let block = self.nodes.len() as u32;
        for &v in nodes {
            self.of[v as usize].push(block);
        }
        self.nodes.push(nodes.iter().copied().collect());
        block
    }

    /// Adds a block in the place of those that share two nodes with it, and so lie inside.
    pub(super) fn replace_inside(&mut self, nodes: &[u32]) {
        let mut shared: HashMap<u32, u32> = HashMap::new();
        for &v in nodes {
            let gone = &self.nodes;
            self.of[v as usize].retain(|&block| !gone[block as usize].is_empty());
            for &block in &self.of[v as usize] {
                *shared.entry(block).or_default() += 1;
            }
        }
        for (block, _) in shared.into_iter().filter(|&(_, count)| count > 1) {
            self.nodes[block as usize] = HashSet::new();
        }
        self.add(nodes);
    }
}
