//! The answer, with everything it rests on.

use crate::contract::Contraction;
use crate::contract::piece::Members;
use crate::decide::claim::{Claim, Strength};
pub use crate::decide::claim::{UnknownValue, Value};
use crate::decide::evidence::{Evidence, PieceVerdict, smallest_prime};
use crate::decide::own_frame::OwnFrame;
use crate::decide::solution_count::SolutionCount;
use crate::geometry::model::Model;
use crate::graph::{Displacements, Graph, KnownParts};
use std::sync::Arc;

/// A component of the whole graph: a maximal part that pairs and known parts determine by itself.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Component {
    /// The bodies and loose edges it consists of.
    pub members: Members,
    /// How many solutions there are if it is taken by itself; `None` where that was not asked for.
    /// What this rests on is not part of certificates, which count for whole graphs.
    pub solutions: Option<SolutionCount>,
    nodes: usize,
    edges: usize,
    /// Nodes that no member has and frames hold.
    held: Vec<u32>,
    contraction: Arc<Contraction>,
}

impl Component {
    /// The component that is a whole graph, as frames hold it together.
    pub(crate) fn whole(graph: &Graph, contraction: &Arc<Contraction>) -> Self {
        let members = Members {
            bodies: contraction.finals.clone(),
            edges: contraction.loose.clone(),
        };
        Self {
            nodes: graph.nodes(),
            edges: graph.edges().len(),
            held: (0..graph.nodes() as u32).collect(),
            ..Self::new(members, 0, contraction)
        }
    }

    /// The component that consists of the given members, which have so many nodes together.
    pub(crate) fn new(members: Members, nodes: usize, contraction: &Arc<Contraction>) -> Self {
        let of_bodies = members.bodies.iter();
        let of_bodies = of_bodies.map(|&body| contraction.bodies[body as usize].edges);
        Self {
            nodes,
            edges: members.edges.len() + of_bodies.sum::<usize>(),
            members,
            solutions: None,
            held: Vec::new(),
            contraction: Arc::clone(contraction),
        }
    }

    /// How many nodes it has.
    pub fn node_count(&self) -> usize {
        self.nodes
    }

    /// How many edges it has.
    pub fn edge_count(&self) -> usize {
        self.edges
    }

    /// Its nodes, increasing. O(k log k) for k nodes; nothing is kept.
    pub fn nodes(&self) -> Vec<u32> {
        let bodies = self.members.bodies.iter();
        let mut nodes: Vec<u32> = bodies
            .flat_map(|&body| &self.contraction.bodies[body as usize].nodes)
            .copied()
            .chain(self.members.edges.iter().flat_map(|&(i, j)| [i, j]))
            .chain(self.held.iter().copied())
            .collect();
        crate::graph::sort_once(&mut nodes);
        nodes
    }

    /// Its edges in the graph that was decided, increasing. O(k log m + d log k) for k nodes with
    /// d edges to larger nodes; nothing is kept.
    ///
    /// Two components share at most one node, so an edge is in the component that has both its
    /// ends. A component that is a known part may have none.
    pub fn edges(&self, graph: &Graph) -> Vec<(u32, u32)> {
        let nodes = self.nodes();
        let inside = |&&(_, j): &&(u32, u32)| nodes.binary_search(&j).is_ok();
        let of_node = |&node: &u32| graph.edges_from(node).iter().filter(inside).copied();
        nodes.iter().flat_map(of_node).collect()
    }
}

/// The verdict on a graph, with everything it rests on.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Verdict {
    /// The question that was asked.
    pub model: Model,
    /// What was taken for known beside the pairs: sets of nodes, known relative to each other.
    pub known_parts: KnownParts,
    /// What was known besides the graph: the displacements that the answer supposes.
    pub displacements: Displacements,
    /// What displacements in a frame of their own add, if any are given; all else is about the graph
    /// without them.
    pub own_frame: Option<OwnFrame>,
    /// SHA-256 of the graph's canonical form.
    pub sha256: [u8; 32],
    /// The seed of all draws.
    pub seed: u64,
    /// The answer; [`value_claim`](Self::value_claim) says how strong it is.
    pub value: Value,
    /// How many solutions there are; `None` if infinitely many.
    pub solutions: Option<SolutionCount>,
    /// The generic rank of J_P (calibrated: of N; affine: four times that of R), with
    /// [`rank_claim`](Self::rank_claim).
    pub rank: usize,
    /// The rank of a finite solvable graph with as many nodes.
    pub required: usize,
    /// The maximal components, by falling number of edges, with
    /// [`components_claim`](Self::components_claim).
    pub components: Vec<Component>,
    /// Bodies and loose edges.
    pub contraction: Arc<Contraction>,
    /// Why each of the contraction's bodies by rank is rigid, in their order: a lower bound on the
    /// rank of its core that is as large as can be.
    pub by_rank: Vec<Evidence>,
    /// Pieces that are a single member.
    pub rigid: Members,
    /// The other pieces.
    pub pieces: Vec<PieceVerdict>,
    pub(super) value_strength: Strength,
}

impl Verdict {
    /// The prime of the residues that the answer rests on, of several the smallest; `None` if contraction and
    /// counting decide.
    pub fn prime(&self) -> Option<u64> {
        let pieces = self.pieces.iter().filter_map(PieceVerdict::prime);
        let rounds = self
            .solutions
            .iter()
            .filter_map(|count| count.rounds.as_ref());
        let rounds = rounds.flat_map(|rounds| &rounds.rounds);
        let rounds =
            rounds.filter_map(|round| smallest_prime(std::slice::from_ref(&round.evidence)));
        pieces
            .chain(smallest_prime(&self.by_rank))
            .chain(rounds)
            .min()
    }

    /// The answer, and how strong it is.
    pub fn value_claim(&self) -> Claim<Value> {
        Claim {
            value: self.value,
            strength: self.value_strength,
        }
    }

    /// The answer with all that is given; `None` if it is open, which only displacements in a frame of
    /// their own leave.
    pub fn answer(&self) -> Option<Value> {
        match &self.own_frame {
            Some(own_frame) => own_frame.value(),
            None => Some(self.value),
        }
    }

    /// Whether there are finitely many solutions with all that is given.
    pub fn is_good(&self) -> bool {
        self.answer()
            .is_some_and(|value| value != Value::NotFiniteSolvable)
    }

    /// The answer without what rests on counting solutions: what a certificate may claim that holds
    /// no evidence for their number.
    pub fn value_by_rank(&self) -> Value {
        let counted = self
            .solutions
            .as_ref()
            .is_some_and(|count| count.evidence.is_some() || count.rounds.is_some());
        match self.value {
            Value::Solvable if counted => Value::FiniteSolvable,
            value => value,
        }
    }

    /// The generic rank, and how strong the claim is that it is not larger.
    pub fn rank_claim(&self) -> Claim<usize> {
        let pieces = self.pieces.iter();
        Claim {
            value: self.rank,
            strength: Strength::all(pieces.map(|piece| piece.rank_strength)),
        }
    }

    /// The maximal components, and how strong the claim is that they are maximal.
    pub fn components_claim(&self) -> Claim<&[Component]> {
        let pieces = self.pieces.iter();
        Claim {
            value: &self.components,
            strength: Strength::all(pieces.map(|piece| piece.components_strength)),
        }
    }
}
