//! What all evidence refers to, and what a lower bound on a rank amounts to.

use crate::document::Model;
use crate::elimination::SPARSE;
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};
use crate::structure::Core;
use crate::vectors::Vectors;

impl Model {
    /// The rank at which nodes are solvable up to finitely many solutions (sections 3 and 6).
    pub(crate) fn required(self, nodes: usize) -> i64 {
        match self {
            _ if nodes == 1 => 0,
            Model::Projective => 11 * nodes as i64 - 15,
            Model::Calibrated => 3 * nodes as i64 - 4,
            Model::Affine => 8 * nodes as i64 - 12,
        }
    }
}

/// What all evidence refers to.
pub(crate) struct Setting<'a> {
    pub model: Model,
    /// The hash of the graph.
    pub sha256: [u8; 32],
    /// Where given displacements put nodes.
    pub vectors: Option<&'a Vectors>,
    pub meter: &'a Meter,
}

impl Setting<'_> {
    /// The hashes to which draws for a core are bound (section 4).
    pub fn hashes<'h>(&'h self, core: &'h Core) -> [&'h [u8; 32]; 2] {
        [&self.sha256, &core.sha256]
    }

    /// The rank of a core that is solvable up to finitely many solutions: one more if it holds a
    /// known displacement (section 6; theory, Theorem 13.18).
    pub fn required_of_core(&self, core: &Core) -> i64 {
        self.model.required(core.nodes) + i64::from(!core.scales.is_empty())
    }

    /// Whether nodes that merge are independent (section 3), as all are in general position.
    pub fn check_independent(&self, nodes: &[u32]) -> Checked<()> {
        ensure!(
            self.vectors
                .is_none_or(|known| known.are_independent(nodes)),
            "the given vectors do not show that the nodes {nodes:?} are independent"
        );
        Ok(())
    }

    /// Counts what evidence costs in any case: cameras are drawn for all nodes of a core, and
    /// something is computed for all its edges.
    pub fn charge_draw(&self, core: &Core) -> Checked<()> {
        let size = core.nodes + core.edges.len();
        self.meter.charge(50 * SPARSE * size as u64)
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
