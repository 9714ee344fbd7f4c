//! Counting alone: (k, k+1)-sparse edge sets (docs/theory.md, section 13).
//!
//! In: the edges of a graph, each with k - 1 copies. Out: how many of these are independent, the
//! components, and for k = 2 a sequence of pinchings that proves the first number (Lemma 13.5).
//! With k = 2 this is the rank of the plane direction matrix R, with k = 3 that of N, at generic
//! points (Corollary 13.8). No arithmetic: pebble games.

mod blocks;
mod game;
mod pinching;
#[cfg(test)]
mod tests;

pub use pinching::{Pinching, Step as PinchingStep};

use crate::graph::Graph;
use crate::watch::{Stopped, Task};
use blocks::Blocks;
use game::PebbleGame;

/// The largest edge set of a graph, with k - 1 copies of each edge, that is (k, k+1)-sparse, and
/// the components of the graph.
#[derive(Clone, Debug)]
pub struct Sparsity {
    game: PebbleGame,
    /// How many copies of each edge are in the set.
    copies: Vec<u8>,
    /// The number of its component for every edge.
    component: Vec<u32>,
    components: usize,
}

impl Sparsity {
    /// Plays the pebble game with k pebbles a node (Lee and Streinu 2008). Components are kept as
    /// they are found, so that at most O(n) insertions fail, of O(n) each; O(n^2 + m) in all,
    /// and near linear where searches stay local.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If k is neither 2 nor 3.
    pub fn new(k: usize, graph: &Graph, task: &Task) -> Result<Self, Stopped> {
        let edges = graph.edges();
        let work = task.begin(2 * edges.len() as u64);
        let mut game = PebbleGame::new(k, graph.nodes());
        let mut blocks = Blocks::new(graph.nodes());
        let mut copies = vec![0u8; edges.len()];
        for (&(u, v), copies) in edges.iter().zip(&mut copies) {
            work.done(1)?;
            if blocks.common(u, v).is_some() {
                continue;
            }
            while *copies < (k - 1) as u8 {
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
            game,
            copies,
            component,
            components: components.len(),
        })
    }

    /// The size of the set: the generic rank of R (k = 2), or of N (k = 3).
    pub fn rank(&self) -> usize {
        self.copies.iter().map(|&copies| usize::from(copies)).sum()
    }

    /// How many copies of each edge are in the set.
    pub fn copies(&self) -> &[u8] {
        &self.copies
    }

    /// The number of its component for every edge, below [`components`](Self::components).
    /// Components are the maximal subgraphs with the full rank k n - (k + 1) for their n nodes.
    pub fn component_of_edges(&self) -> &[u32] {
        &self.component
    }

    /// How many components there are.
    pub fn components(&self) -> usize {
        self.components
    }

    /// Why so many edges are independent.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If k is not 2, or there are fewer than two nodes.
    pub fn pinching(self, task: &Task) -> Result<Pinching, Stopped> {
        Pinching::reduce(self.game, task)
    }
}
