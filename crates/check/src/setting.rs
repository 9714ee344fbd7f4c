//! What all evidence refers to, and what a lower bound on a rank amounts to.

use crate::document::Model;
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};
use crate::vectors::Vectors;

/// What all evidence refers to.
pub(crate) struct Setting<'a> {
    pub model: Model,
    /// The hash of the graph.
    pub sha256: [u8; 32],
    /// Where given displacements put nodes.
    pub vectors: Option<&'a Vectors>,
    /// The same of displacements in a frame of their own.
    pub own_frame: Option<&'a Vectors>,
    pub meter: &'a Meter,
}

impl<'a> Setting<'a> {
    /// That of a graph alone.
    pub(crate) fn bare(model: Model, sha256: [u8; 32], meter: &'a Meter) -> Self {
        Setting {
            model,
            sha256,
            vectors: None,
            own_frame: None,
            meter,
        }
    }

    /// Whether nodes that merge are independent (section 3), as all are in general position.
    pub(crate) fn check_independent(&self, nodes: &[u32]) -> Checked<()> {
        ensure!(
            [self.vectors, self.own_frame]
                .into_iter()
                .flatten()
                .all(|known| known.are_independent(nodes)),
            "the given vectors do not show that the nodes {nodes:?} are independent"
        );
        Ok(())
    }
}

/// Prime, seed and number of a draw of centres.
pub(crate) type Draw = (u64, u64, u64);

/// A lower bound on the rank of a core.
pub(crate) struct Lower {
    pub rank: i64,
    /// Where the rank is reached, if centres or plane points modulo p were drawn.
    pub at: Option<Draw>,
    /// For people: what else was verified.
    pub note: Option<String>,
}
