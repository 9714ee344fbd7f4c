//! Nodes in general position.

use crate::geometry::placed::Placed;
use std::sync::Arc;

/// Which nodes are in general position: all, unless vectors between some of them are given.
#[derive(Clone)]
pub(super) struct General(pub Option<Arc<Placed>>);

impl General {
    /// Whether three or four nodes are.
    pub(super) fn holds(&self, nodes: &[u32]) -> bool {
        let placed = self.0.as_ref();
        placed.is_none_or(|placed| placed.are_independent(nodes))
    }
}
