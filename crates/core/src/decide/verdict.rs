//! The answer, with everything it rests on.

use crate::contract::Contraction;
use crate::contract::piece::Members;
use crate::decide::evidence::{PieceVerdict, Strength};
use crate::geometry::model::Model;
use crate::graph::Graph;
use std::fmt;
use std::str::FromStr;

/// The answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// The cameras are unique up to a projective map (calibrated: up to scale and
    /// translation).
    Solvable,
    /// Finitely many sets of cameras.
    FiniteSolvable,
    /// Infinitely many.
    NotFiniteSolvable,
}

impl Value {
    /// All answers, the strongest first.
    pub const ALL: [Self; 3] = [
        Self::Solvable,
        Self::FiniteSolvable,
        Self::NotFiniteSolvable,
    ];

    /// The name in certificates and in JSON output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Solvable => "solvable",
            Self::FiniteSolvable => "finite-solvable",
            Self::NotFiniteSolvable => "not-finite-solvable",
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A word that is not the name of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownValue;

impl fmt::Display for UnknownValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the answers are solvable, finite-solvable and not-finite-solvable")
    }
}

impl std::error::Error for UnknownValue {}

impl FromStr for Value {
    type Err = UnknownValue;

    fn from_str(name: &str) -> Result<Self, UnknownValue> {
        let named = |value: &Self| value.name() == name;
        Self::ALL.into_iter().find(named).ok_or(UnknownValue)
    }
}

/// A component of the whole graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// The bodies and loose edges it consists of.
    pub members: Members,
    /// How many nodes it has.
    pub nodes: usize,
    /// How many edges it has.
    pub edges: usize,
}

/// The verdict on a graph, with everything it rests on.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The question that was asked.
    pub model: Model,
    /// SHA-256 of the graph's canonical form.
    pub sha256: [u8; 32],
    /// The answer.
    pub value: Value,
    /// How strong it is.
    pub strength: Strength,
    /// The generic rank of J_P (calibrated: of N).
    pub rank: usize,
    /// The rank of a finite solvable graph with as many nodes.
    pub required: usize,
    /// How strong the claim of the rank is.
    pub rank_strength: Strength,
    /// The maximal components, by falling number of edges.
    pub components: Vec<Component>,
    /// How strong the claim of the components is.
    pub components_strength: Strength,
    /// Bodies and loose edges.
    pub contraction: Contraction,
    /// Pieces that are a single member.
    pub rigid: Members,
    /// The other pieces.
    pub pieces: Vec<PieceVerdict>,
}

impl Verdict {
    /// The edges of a component, increasing. O(m).
    ///
    /// Two components share at most one node, so an edge is in the component that has both its
    /// ends.
    pub fn component_edges(&self, graph: &Graph, component: &Component) -> Vec<(u32, u32)> {
        let nodes = self.component_nodes(component);
        let inside = |node: &u32| nodes.binary_search(node).is_ok();
        let edges = graph.edges().iter();
        edges
            .filter(|(i, j)| inside(i) && inside(j))
            .copied()
            .collect()
    }

    /// The nodes of a component, increasing.
    pub fn component_nodes(&self, component: &Component) -> Vec<u32> {
        let members = &component.members;
        let bodies = members.bodies.iter();
        let mut nodes: Vec<u32> = bodies
            .flat_map(|&body| &self.contraction.bodies[body as usize].nodes)
            .copied()
            .chain(members.edges.iter().flat_map(|&(i, j)| [i, j]))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}
