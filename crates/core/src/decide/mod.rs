//! From a graph to its verdict and the evidence for it (docs/theory.md, sections 5 to 7).
//!
//! ```text
//! decide(graph)
//!   contract   graph -> rigid bodies and loose edges, the members           theory 4.1
//!   split      members -> single ones, which are rigid, and pieces          4.3
//!   piece      of each piece, side by side:
//!     core       the nodes that its members share, a chain for every body   4.4
//!     ranks      N, plane flows and Lambda at drawn centres                 3.3
//!                full rank: the piece is finite solvable, a proof
//!     motion     one random motion -> motion classes                        6
//!     class      a single member, or of full rank by itself: a component;
//!                else split again, and its pieces decided as these are
//!     counting   a partition and hubs -> an upper bound                     5
//!                a gap is left: draws that nobody chooses, an error bound   7.2
//!   conclude   ranks add up; the verdict, and the components                4.6
//! ```
//!
//! Pieces are in `one_piece`, classes in [`motion_class`], bounds in [`counting`], the paper's
//! own matrix (`--no-contraction`, `--rational`) in `whole_matrix`, what is found in [`evidence`].

pub mod counting;
pub mod evidence;
pub mod motion_class;

mod one_piece;
mod whole_matrix;

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Members};
use crate::decide::evidence::{PieceVerdict, Strength};
use crate::geometry::draw::DrawError;
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::linalg::prime::{PrimeField, SMALL_PRIME};
use crate::watch::{Step, Stopped, Watch};
use std::fmt;
use std::str::FromStr;

/// How the question is decided.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which question.
    pub model: Model,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// The prime of the residues (in rational mode, of components and their evidence).
    pub field: PrimeField,
    /// Cores with so many nodes or more are decided modulo [`SMALL_PRIME`] instead, where
    /// elimination is several times as fast. What it proves is as strong; a draw falls
    /// short of the generic rank with probability below 22 nodes / 2^29 (Schwartz and Zippel), and
    /// costs another one then.
    pub small_prime_from: usize,
    /// Whether to contract to bodies first, and to decide piece by piece.
    pub contraction: bool,
    /// Whether to look for proofs by counting.
    pub counting: bool,
    /// The seed of all draws.
    pub seed: u64,
    /// Who is told what is being done, and may stop it.
    pub watch: Watch,
}

/// From so many nodes on elimination is most of the work on a core.
const LARGE_CORE: usize = 256;

impl Options {
    /// Asks another question.
    #[must_use]
    pub fn model(mut self, model: Model) -> Self {
        self.model = model;
        self
    }

    /// Draws other cameras.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Tells somebody what is being done, who may stop it.
    #[must_use]
    pub fn watch(mut self, watch: Watch) -> Self {
        self.watch = watch;
        self
    }

    /// The field in which a core with so many nodes is decided.
    fn field_for(&self, nodes: usize) -> PrimeField {
        if nodes < self.small_prime_from {
            self.field
        } else {
            PrimeField::new(SMALL_PRIME).expect("a prime")
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            model: Model::Projective,
            arithmetic: Arithmetic::Prime,
            field: PrimeField::mersenne61(),
            small_prime_from: LARGE_CORE,
            contraction: true,
            counting: true,
            seed: 1,
            watch: Watch::default(),
        }
    }
}

/// The arithmetic of the rank computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo a prime.
    Prime,
    /// Integers, at cameras with small rational entries.
    Rational {
        /// Largest absolute value of a numerator.
        numerator: u64,
        /// Largest denominator.
        denominator: u64,
    },
}

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

/// Why there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
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
            Self::Stopped(inner) => inner.fmt(f),
        }
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

/// Decides a graph.
///
/// # Errors
/// If cameras cannot be drawn, a small prime leaves the question open, the matrix is
/// too large for the method, or the work is stopped.
pub fn decide(graph: &Graph, options: &Options) -> Result<Verdict, VerdictError> {
    let task = options.watch.task(Step::Contraction, graph.nodes());
    let work = task.begin(0);
    work.done(0)?;
    let sha256 = sha256(graph);
    let contraction = if options.contraction {
        Contraction::new(graph, options.model)
    } else {
        Contraction::none(graph)
    };
    work.done(0)?;
    let assembly = Assembly::new(graph, &contraction);
    let all = assembly.all();
    let split = if options.contraction {
        assembly.split(&all)
    } else {
        assembly.whole(&all)
    };
    drop(work);
    let pieces = one_piece::decide_all(&assembly, &split.pieces, &sha256, options)?;
    Ok(conclude(
        graph,
        options.model,
        sha256,
        contraction,
        &assembly,
        split.rigid,
        pieces,
    ))
}

/// Sums up over the pieces.
fn conclude(
    graph: &Graph,
    model: Model,
    sha256: [u8; 32],
    contraction: Contraction,
    assembly: &Assembly,
    rigid: Members,
    pieces: Vec<PieceVerdict>,
) -> Verdict {
    let singles = rigid.singles();
    let rigid_rank: usize = singles
        .iter()
        .map(|member| model.required(assembly.count_nodes(member)))
        .sum();
    let rank = rigid_rank + pieces.iter().map(|piece| piece.lower).sum::<usize>();
    let required = model.required(graph.nodes());
    let one_piece = rigid.len() + pieces.len() == 1;
    let all_nodes = |part: &Members| one_piece && assembly.count_nodes(part) == graph.nodes();
    let is_body = !rigid.is_empty() && all_nodes(&rigid);
    let is_full = pieces
        .first()
        .is_some_and(|piece| all_nodes(&piece.members) && rank == required);
    let value = match model {
        _ if is_body || graph.nodes() == 1 => Value::Solvable,
        Model::Calibrated if is_full => Value::Solvable,
        Model::Projective if is_full => Value::FiniteSolvable,
        _ => Value::NotFiniteSolvable,
    };
    let upper = rigid_rank + pieces.iter().map(|piece| piece.upper).sum::<usize>();
    let strength = if value != Value::NotFiniteSolvable || upper < required {
        Strength::Proof
    } else {
        Strength::all(pieces.iter().map(|piece| piece.rank_strength))
    };
    let mut components: Vec<Component> = singles
        .into_iter()
        .chain(pieces.iter().flat_map(|piece| piece.components.clone()))
        .map(|members| Component {
            nodes: assembly.count_nodes(&members),
            edges: members.edges.len()
                + members
                    .bodies
                    .iter()
                    .map(|&body| contraction.bodies[body as usize].edges)
                    .sum::<usize>(),
            members,
        })
        .collect();
    components.sort_by(|a, b| {
        b.edges
            .cmp(&a.edges)
            .then_with(|| a.members.cmp(&b.members))
    });
    Verdict {
        model,
        sha256,
        value,
        strength,
        rank,
        required,
        rank_strength: Strength::all(pieces.iter().map(|piece| piece.rank_strength)),
        components,
        components_strength: Strength::all(pieces.iter().map(|piece| piece.components_strength)),
        contraction,
        rigid,
        pieces,
    }
}
