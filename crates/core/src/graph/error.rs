//! Pairs that are no graph.

use std::fmt;

/// Why a list of pairs is not a viewing graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GraphError {
    /// A pair joins a camera with itself.
    SelfLoop(u32),
    /// A pair names a node that the graph does not have.
    OutOfRange {
        /// The offending node.
        node: u32,
        /// How many nodes there are.
        nodes: u32,
    },
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SelfLoop(inner) => write!(f, "camera {inner} is paired with itself"),
            Self::OutOfRange { node, nodes } => write!(
                f,
                "node {node} is out of range: the graph has {nodes} nodes"
            ),
        }
    }
}

impl std::error::Error for GraphError {}
