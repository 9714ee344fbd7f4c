//! From a graph to its verdict and the evidence for it (docs/theory.md, sections 5 to 7).
//!
//! ```text
//! decide(graph)
//!   contract   graph -> rigid bodies and loose edges, the members           theory 4.1
//!   by rank    of a large core, regions of full rank -> more bodies          4.14
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
//!   solutions  how many a finite solvable graph has: one makes it solvable   10
//! ```
//!
//! In the affine model counting alone decides a piece (section 13), in `plane_piece`. The other
//! pieces are in `one_piece`, bodies that ranks give before in `bodies_by_rank`, their ranks at some centres in `drawn`, classes in `motion_class`,
//! bounds in `counting`, the paper's own matrix (`--no-contraction`, `--rational`) in
//! `whole_matrix`, the number of solutions in `solution_count`. What goes in is in `options`, what
//! is found in [`evidence`], what comes out in `verdict`.

pub mod evidence;

mod bodies_by_rank;
mod claim;
mod counting;
mod drawn;
mod error;
mod motion_class;
mod one_piece;
mod options;
mod plane_piece;
mod solution_count;
mod verdict;
mod whole_matrix;

pub use claim::{Claim, Strength, UnknownStrength};
pub use counting::{Block, Counting, Hub};
pub use error::VerdictError;
pub use options::{Arithmetic, CountSolutions, Options, Prime};
pub use plane_piece::plane_rank;
pub use solution_count::SolutionCount;
pub use verdict::{Component, UnknownValue, Value, Verdict};

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Members, Split};
use crate::decide::evidence::{Evidence, PieceVerdict};
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::watch::Step;
use std::sync::Arc;

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
    let (contraction, by_rank) = bodies_by_rank::extend(graph, contraction, &sha256, options)?;
    let assembly = Assembly::new(graph, &contraction);
    let all = assembly.all();
    let Split { rigid, pieces } = if options.contraction {
        assembly.split(&all)
    } else {
        assembly.whole(&all)
    };
    drop(work);
    let pieces = if options.model == Model::Affine {
        plane_piece::decide_all(&assembly, &pieces, &sha256, options)?
    } else {
        one_piece::decide_all(&assembly, &pieces, &sha256, options)?
    };
    let found = Found {
        graph,
        options,
        assembly: &assembly,
        by_rank,
        rigid,
        pieces,
    };
    Ok(found.conclude(sha256, contraction))
}

/// What is known of a graph, piece by piece.
struct Found<'a> {
    graph: &'a Graph,
    options: &'a Options,
    assembly: &'a Assembly,
    /// Why bodies by rank are rigid.
    by_rank: Vec<Evidence>,
    /// The members that are pieces by themselves.
    rigid: Members,
    /// The other pieces.
    pieces: Vec<PieceVerdict>,
}

impl Found<'_> {
    /// Sums up over the pieces (Theorem 4.3 and Corollary 4.6 of docs/theory.md; calibrated:
    /// Theorem 4.10 and Corollary 4.12; affine: Theorem 13.10 and Corollary 13.12).
    fn conclude(self, sha256: [u8; 32], contraction: Contraction) -> Verdict {
        let rigid_rank = self.rigid_rank();
        let rank = rigid_rank + self.pieces.iter().map(|piece| piece.lower).sum::<usize>();
        let upper = rigid_rank + self.pieces.iter().map(|piece| piece.upper).sum::<usize>();
        let value = self.value(rank, &contraction);
        let value_strength = self.strength(value, upper);
        let solutions = self.solutions(value, &contraction);
        let is_one = solutions.as_ref().and_then(SolutionCount::exactly) == Some(1);
        let contraction = Arc::new(contraction);
        Verdict {
            model: self.options.model,
            sha256,
            value: if is_one { Value::Solvable } else { value },
            value_strength,
            solutions,
            rank,
            required: self.required(),
            components: self.components(&contraction),
            contraction,
            by_rank: self.by_rank,
            rigid: self.rigid,
            pieces: self.pieces,
        }
    }

    /// The rank of a finite solvable graph with as many nodes.
    fn required(&self) -> usize {
        self.options.model.required(self.graph.nodes())
    }

    /// The rank of the members that are pieces by themselves.
    fn rigid_rank(&self) -> usize {
        let singles = self.rigid.singles();
        let nodes = singles.iter().map(|part| self.assembly.count_nodes(part));
        nodes.map(|nodes| self.options.model.required(nodes)).sum()
    }

    /// The answer before solutions are counted: one body that comes from the rules is unique
    /// (Corollary 4.2), one piece of full rank, a body by rank too, is finite (Theorem 1.3) and in the other models unique (Theorems 4.8 and 13.2).
    fn value(&self, rank: usize, contraction: &Contraction) -> Value {
        let one_piece = self.rigid.len() + self.pieces.len() == 1;
        let all_nodes =
            |part: &Members| one_piece && self.assembly.count_nodes(part) == self.graph.nodes();
        let is_body = !self.rigid.is_empty() && all_nodes(&self.rigid);
        let is_full = rank == self.required()
            && (is_body
                || self
                    .pieces
                    .first()
                    .is_some_and(|piece| all_nodes(&piece.members)));
        let is_unique = is_body && contraction.are_unique_finals();
        match self.options.model {
            _ if is_unique || self.graph.nodes() == 1 => Value::Solvable,
            Model::Calibrated | Model::Affine if is_full => Value::Solvable,
            Model::Projective if is_full => Value::FiniteSolvable,
            _ => Value::NotFiniteSolvable,
        }
    }

    /// How many solutions there are (section 10), if finitely many.
    fn solutions(&self, value: Value, contraction: &Contraction) -> Option<SolutionCount> {
        let effort = match self.options.contraction {
            true if contraction.by_rank.is_empty() => self.options.solutions,
            _ => CountSolutions::Off,
        };
        let seed = self.options.seed;
        match value {
            Value::Solvable => Some(SolutionCount::one()),
            Value::FiniteSolvable => Some(SolutionCount::of(self.graph, contraction, effort, seed)),
            Value::NotFiniteSolvable => None,
        }
    }

    /// How strong the answer is: full rank and a bound below it are proofs.
    fn strength(&self, value: Value, upper: usize) -> Strength {
        if value != Value::NotFiniteSolvable || upper < self.required() {
            Strength::Proof
        } else {
            Strength::all(self.pieces.iter().map(|piece| piece.rank_strength))
        }
    }

    /// The components of all pieces (Theorem 6.1), by falling number of edges.
    fn components(&self, contraction: &Arc<Contraction>) -> Vec<Component> {
        let pieces = self.pieces.iter();
        let of_pieces = pieces.flat_map(|piece| piece.components.clone());
        let all = self.rigid.singles().into_iter().chain(of_pieces);
        let mut components: Vec<Component> = all
            .map(|members| {
                let nodes = self.assembly.count_nodes(&members);
                Component::new(members, nodes, contraction)
            })
            .collect();
        components.sort_by(|a, b| {
            let more_edges = b.edge_count().cmp(&a.edge_count());
            more_edges.then_with(|| a.members.cmp(&b.members))
        });
        components
    }
}
