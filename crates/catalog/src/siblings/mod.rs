//! Verdicts of all subdivisions of one kernel, and of nothing else: no ranks, no components.
//!
//! For each of them either N and Lambda have full rank modulo a prime, and it is finite solvable
//! (`flows`), or a partition bounds the rank below what is required, and it is not
//! (`slack`): both are proofs. The few that remain, which take a hub, say, are
//! for [`decide`](viewcert::decide::decide).

mod flows;
mod slack;

use super::multigraph::Multigraph;
use super::subdivide::Subdivision;
use flows::PlaneFlows;
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use sha2::{Digest, Sha256};
use slack::Blocks;

/// What is proved about one subdivision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proved {
    /// It is finite solvable: full rank at one point.
    FiniteSolvable,
    /// It is not: by a partition with one block of several edges, or because two nodes of degree 2
    /// are adjacent.
    RefutedByOneBlock,
    /// It is not: by a partition with several such blocks.
    RefutedByBlocks,
    /// Nothing.
    Nothing,
}

/// What the subdivisions of a kernel have in common.
pub struct Siblings {
    blocks: Blocks,
    flows: PlaneFlows,
}

impl Siblings {
    /// Prepares the subdivisions of `kernel` with `nodes` nodes in all, at centres that depend on
    /// the kernel and the seed.
    ///
    /// # Panics
    /// With fewer nodes than the kernel has.
    pub fn new(kernel: &Multigraph, nodes: usize, seed: u64) -> Self {
        assert!(nodes >= kernel.nodes(), "{nodes} nodes");
        let edges = kernel.edges() + nodes - kernel.nodes();
        let order: Vec<u8> = (0..kernel.nodes() as u8).collect();
        let mut hash = Sha256::new();
        hash.update(seed.to_le_bytes());
        for word in kernel.key(&order) {
            hash.update(word.to_le_bytes());
        }
        let mut random = ChaCha12Rng::from_seed(hash.finalize().into());
        Self {
            blocks: Blocks::new(kernel, 7 * edges as i32 - (11 * nodes as i32 - 15)),
            flows: PlaneFlows::new(kernel, &mut random),
        }
    }

    /// Decides a subdivision of the kernel with the given number of nodes, more than three.
    /// Fastest if those that begin with the same edges are asked for one after the other.
    pub fn decide(&mut self, subdivision: &Subdivision<'_>) -> Proved {
        let Some(subdivided) = subdivision.subdivided() else {
            return Proved::RefutedByOneBlock;
        };
        if self.blocks.one_refutes(subdivided) {
            Proved::RefutedByOneBlock
        } else if self.flows.full_rank(subdivided) {
            Proved::FiniteSolvable
        } else if self.blocks.several_refute(subdivided) {
            Proved::RefutedByBlocks
        } else {
            Proved::Nothing
        }
    }
}
