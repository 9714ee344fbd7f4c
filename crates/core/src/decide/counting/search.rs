//! What a search for a bound has at hand.

use crate::linalg::prime::PrimeField;
use crate::watch::Task;

/// How a search draws, computes and can be stopped.
pub(crate) struct Search<'a> {
    /// The field of its matrices. Where to look is not a claim, so that any field does.
    pub field: &'a PrimeField,
    /// Gives uniform residues; the choice steers the search but not the validity of what it
    /// finds.
    pub random: &'a mut dyn FnMut() -> u64,
    /// What it counts as.
    pub task: Task<'a>,
}

impl Search<'_> {
    /// Random centres for so many nodes.
    pub(super) fn centres(&mut self, nodes: usize) -> Vec<[u64; 3]> {
        (0..nodes)
            .map(|_| std::array::from_fn(|_| (self.random)()))
            .collect()
    }
}
