//! Why there is no verdict.

use crate::contract::Contraction;
use crate::decide::question::Meaningless;
use crate::geometry::draw::DrawError;
use crate::watch::{SoFar, Stopped};
use std::fmt;

/// Why there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum VerdictError {
    /// No cameras could be drawn.
    Draw(DrawError),
    /// The prime is too small to decide.
    Undecided {
        /// The prime.
        prime: u64,
        /// How many draws were tried.
        draws: u64,
    },
    /// The matrix is too large for the method that was asked for.
    TooLarge {
        /// Which computation.
        what: &'static str,
        /// Nodes of the matrix's graph.
        nodes: usize,
        /// Its edges.
        edges: usize,
        /// Memory or time, for people.
        needs: String,
        /// What to do instead.
        advice: &'static str,
    },
    /// A known part has a node that the graph does not have.
    PartOutsideGraph {
        /// The node.
        node: u32,
        /// How many nodes the graph has.
        nodes: usize,
    },
    /// What is asked does not go together.
    Meaningless(Meaningless),
    /// Displacements that say nothing about the question, and why.
    Displacements(&'static str),
    /// What is asked is answered for pairs alone, and the verdict rests on more.
    PairsAlone,
    /// The work was stopped before there was an answer.
    Stopped(Stopped),
}

impl fmt::Display for VerdictError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Draw(inner) => inner.fmt(f),
            Self::Undecided { prime, draws } => write!(
                f,
                "undecided modulo {prime}: the rank falls short at {draws} draws, which modulo so small a prime \
         says nothing; take a larger prime (the default is 2^61 - 1)"
            ),
            Self::TooLarge {
                what,
                nodes,
                edges,
                needs,
                advice,
            } => write!(
                f,
                "{what} for {nodes} cameras and {edges} pairs would need about {needs}; {advice}"
            ),
            Self::PartOutsideGraph { node, nodes } => write!(
                f,
                "a known part has the node {node}, and the graph has {nodes} nodes"
            ),
            Self::Meaningless(why) => why.fmt(f),
            Self::Displacements(why) => write!(f, "known displacements: {why}"),
            Self::PairsAlone => f.write_str(
                "this is answered for pairs alone, and the verdict rests on known parts or displacements; \
                 decide the graph without them",
            ),
            Self::Stopped(inner) => inner.fmt(f),
        }
    }
}

impl VerdictError {
    /// With what a contraction had proved before work was stopped.
    pub(super) fn after(mut self, contraction: &Contraction) -> Self {
        if let Self::Stopped(stopped) = &mut self {
            let finals = contraction.finals.iter();
            let sizes = finals.map(|&body| contraction.bodies[body as usize].nodes.len());
            let parts = sizes.clone().filter(|&size| size > 2).count();
            let largest = sizes.max().unwrap_or(0);
            stopped.so_far = Some(SoFar { parts, largest });
        }
        self
    }
}

impl std::error::Error for VerdictError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Draw(inner) => inner.source(),
            Self::Stopped(inner) => inner.source(),
            _ => None,
        }
    }
}

impl From<DrawError> for VerdictError {
    fn from(inner: DrawError) -> Self {
        Self::Draw(inner)
    }
}

impl From<Stopped> for VerdictError {
    fn from(inner: Stopped) -> Self {
        Self::Stopped(inner)
    }
}
