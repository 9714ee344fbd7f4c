//! Counting alone: (K, L)-sparse edge sets (docs/theory.md, sections 5 and 13).
//!
//! In: the edges of a graph, each with 2 K - L copies. Out: how many of these are independent, the
//! components. In the plane and in space the first number is the rank of R and of N at generic points
//! (Corollary 13.8), in the projective model the smallest bound by a partition (Theorem 5.1). No
//! arithmetic: pebble games.

mod blocks;
mod game;
#[cfg(test)]
mod tests;

use crate::graph::Graph;
use crate::watch::{Stopped, Task};
use blocks::Blocks;
use game::PebbleGame;

/// The largest edge set of a graph, with 2 K - L copies of each edge, that is (K, L)-sparse: no set
/// of n >= 2 nodes spans more than K n - L. With it the components of the graph.
#[derive(Clone, Debug)]
pub struct Sparsity<const K: usize, const L: usize> {
    /// How many copies of each edge are in the set.
    copies: Vec<u8>,
    /// The number of its component for every edge.
    component: Vec<u32>,
    components: usize,
}

/// In the plane: directions.
pub type Plane = Sparsity<2, 3>;

/// In space: bearings.
pub type Space = Sparsity<3, 4>;

/// Fundamental matrices.
pub type Projective = Sparsity<11, 15>;

impl<const K: usize, const L: usize> Sparsity<K, L> {
    /// Plays the pebble game with K pebbles a node (Lee and Streinu 2008, K <= L < 2 K). Components
    /// are kept as they are found, so that at most O(n) insertions fail, of O(n) each; O(n^2 + m)
    /// in all, and near linear where searches stay local.
    ///
    /// # Errors
    /// If the task was stopped.
    pub fn new(graph: &Graph, task: &Task) -> Result<Self, Stopped> {
        let edges = graph.edges();
        let work = task.begin(2 * edges.len() as u64);
        let mut game = PebbleGame::<K, L>::new(graph.nodes());
        let mut blocks = Blocks::new(graph.nodes());
        let mut copies = vec![0u8; edges.len()];
        for (&(u, v), copies) in edges.iter().zip(&mut copies) {
            work.done(1)?;
            if blocks.common(u, v).is_some() {
                continue;
            }
            while *copies < (2 * K - L) as u8 {
                if !game.insert(u, v) {
                    blocks.replace_inside(&game.component(u, v));
                    break;
                }
                *copies += 1;
            }
        }
        // Blocks that were found on the way may have grown.
        let mut components = Blocks::new(graph.nodes());
        let mut component = Vec::with_capacity(edges.len());
        for &(u, v) in edges {
            work.done(1)?;
            let number = match components.common(u, v) {
                Some(number) => number,
                None => components.add(&game.component(u, v)),
            };
            component.push(number);
        }
        Ok(Self {
            copies,
            component,
            components: components.len(),
        })
    }

    /// The size of the set: in the plane the generic rank of R, in space of N.
    pub fn rank(&self) -> usize {
        self.copies.iter().map(|&copies| usize::from(copies)).sum()
    }

    /// The number of its component for every edge, below [`components`](Self::components).
    /// Components are the maximal subgraphs with the full rank K n - L for their n nodes.
    pub fn component_of_edges(&self) -> &[u32] {
        &self.component
    }

    /// How many components there are.
    pub fn components(&self) -> usize {
        self.components
    }
}
