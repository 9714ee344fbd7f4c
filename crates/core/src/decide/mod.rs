//! From a graph to its verdict and the evidence for it (docs/theory.md, sections 5 to 7).
//!
//! ```text
//! decide(graph)
//!   contract   graph -> rigid bodies and loose edges, the members           theory 4.1, 4.14
//!   by rank    of a large core, regions of full rank -> more bodies          4.15
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
//!   rounds     nodes removed, the rest rigid -> members merge                19
//!              stresses at a node -> its members merge
//!   solutions  how many a finite solvable graph has: one makes it solvable   10
//! ```
//!
//! In the affine model counting alone decides a piece (section 13), in `plane_piece`. The other
//! pieces are in `one_piece` and `walk`, bodies that ranks give before in `bodies_by_rank`, their ranks at some
//! centres in `drawn`, classes in `motion_class`, bounds in `counting`, the
//! paper's own matrix (`--method matrix`, `--rational`) in `whole_matrix`, the number of solutions in
//! `rounds`, `stressed` and `solution_count`. What unknown base lines that frames share add to it is in `base_lines`.
//! What is asked is in `question`, with what it is decided in
//! `options`, what is found in [`evidence`], what comes out in `verdict`.

pub mod evidence;

mod base_lines;
mod bodies_by_rank;
mod claim;
mod counting;
mod drawn;
mod error;
pub(crate) mod motion_class;
mod one_piece;
mod options;
mod own_frame;
mod plane_piece;
mod question;
mod rounds;
mod solution_count;
mod stressed;
mod stresses;
mod vectors;
mod verdict;
mod walk;
mod whole_matrix;

pub(crate) use base_lines::BaseLinesEvidence;
pub use base_lines::{RigFrames, SharedBaseLines, Turns};
pub use claim::{Claim, Strength, UnknownStrength};
#[cfg(test)]
pub(crate) use counting::GAMMA;
pub use error::VerdictError;
pub use evidence::{Block, Counting, Hub};
pub use options::{Options, Prime};
pub(crate) use own_frame::OwnFrameEvidence;
pub use own_frame::{OwnFrame, TurningPart};
pub use plane_piece::{plane_rank, rank_in_plane};
pub use question::{Arithmetic, CountSolutions, Known, Meaningless, Question};
pub use rounds::{Joined, Round, Rounds};
pub use solution_count::SolutionCount;
pub use verdict::{Component, UnknownValue, Value, Verdict};

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Members, Split};
use crate::decide::evidence::{Evidence, PieceVerdict};
use crate::geometry::model::Model;
use crate::geometry::placed::Placed;
use crate::graph::{Displacements, Graph, KnownParts, sha256};
use crate::solutions::nodes_of;
use crate::watch::{Step, Stopped};
use std::sync::Arc;

/// Decides a graph.
///
/// # Errors
/// If what is asked does not go together, cameras cannot be drawn, a small prime leaves the question open, the matrix is
/// too large for the method, or the work is stopped. If known parts or displacements are of another
/// graph.
pub fn decide(graph: &Graph, options: &Options) -> Result<Verdict, VerdictError> {
    let Question {
        model,
        whole_graph,
        known,
        ..
    } = &options.question;
    options
        .question
        .check()
        .map_err(VerdictError::Meaningless)?;
    check_known(graph, known)?;
    let task = options.watch.task(Step::Contraction, graph.nodes());
    let work = task.begin(0);
    work.done(0)?;
    let contract = || match known {
        _ if *whole_graph => Contraction::none(graph),
        Known::Displacements(known) if !known.is_empty() => {
            Contraction::with_displacements(graph, known, known)
        }
        Known::Displacements(_) => Contraction::new(graph, *model),
        Known::OwnFrame { given, rigs } => Contraction::with_displacements(graph, rigs, given),
        Known::Parts(parts) => Contraction::with_parts(graph, parts, *model),
    };
    let (contraction, sha256) = rayon::join(contract, || sha256(graph));
    work.done(0)?;
    let whole = Whole::new(graph, &contraction, &sha256, options);
    if let Some(whole) = &whole
        && let Some(rounds) = whole
            .first_rounds()
            .map_err(|error| error.after(&contraction))?
    {
        return whole.conclude(rounds);
    }
    let (contraction, by_rank) = bodies_by_rank::extend(graph, contraction, &sha256, options)?;
    let placed = match known {
        Known::Displacements(known) => Placed::new(graph.nodes(), known),
        Known::Parts(_) | Known::OwnFrame { .. } => None,
    };
    let assembly = Assembly::new(graph, &contraction).with_vectors(&contraction, placed);
    let all = assembly.all();
    let Split { rigid, pieces } = match whole_graph {
        true => assembly.whole(&all),
        false => assembly.split(&all),
    };
    drop(work);
    let pieces = if model.in_plane() {
        plane_piece::decide_all(&assembly, &pieces, &sha256, options)
    } else {
        one_piece::decide_all(&assembly, &pieces, &sha256, options)
    };
    let pieces = pieces.map_err(|error| error.after(&contraction))?;
    let own_frame = match known {
        Known::OwnFrame { given, .. } if !given.is_empty() => Some(given.clone()),
        _ => None,
    };
    let (known_parts, displacements) = known.clone().split();
    let mut found = Found {
        graph,
        options,
        known_parts,
        displacements,
        assembly: &assembly,
        by_rank,
        rigid,
        pieces,
        rounds: None,
    };
    if let Some(whole) = &whole
        && found.value(found.rank(), &contraction) == Value::FiniteSolvable
    {
        let rounds = whole.rounds(true)?;
        if rounds.is_one() {
            return whole.conclude(rounds);
        }
        found.rounds = Some(rounds);
    }
    let mut verdict = found.conclude(sha256, contraction)?;
    if let Some(given) = own_frame {
        let (of, contraction) = ((graph, sha256), &verdict.contraction);
        let found = OwnFrame::new(of, contraction, &given, options.seed, &options.watch)?;
        verdict.own_frame = Some(found);
    }
    Ok(verdict)
}

/// Whether what is known is known of the nodes of the graph.
fn check_known(graph: &Graph, known: &Known) -> Result<(), VerdictError> {
    let outside = |&node: &u32| node as usize >= graph.nodes();
    match known {
        Known::Parts(parts) => match parts.largest_node().filter(outside) {
            Some(node) => Err(VerdictError::PartOutsideGraph {
                node,
                nodes: graph.nodes(),
            }),
            None => Ok(()),
        },
        Known::Displacements(known) => match known.groups().iter().flatten().any(outside) {
            true => Err(VerdictError::Displacements("the graph has fewer nodes")),
            false => Ok(()),
        },
        Known::OwnFrame { given, rigs } => {
            let mut groups = given.groups().iter().chain(rigs.groups());
            match groups.any(|group| group.iter().any(outside)) {
                true => Err(VerdictError::Displacements("the graph has fewer nodes")),
                false => Ok(()),
            }
        }
    }
}

/// How many components with several members a quick count looks at.
const MOST_COMPONENTS: usize = 16;

/// A graph whose members, unique by the rules, are one piece: what rounds go on from.
struct Whole<'a> {
    graph: &'a Graph,
    contraction: Contraction,
    assembly: Assembly,
    members: Members,
    sha256: &'a [u8; 32],
    options: &'a Options,
}

impl<'a> Whole<'a> {
    /// `None` if there are several pieces or a single body, or if nobody counts solutions.
    fn new(
        graph: &'a Graph,
        contraction: &Contraction,
        sha256: &'a [u8; 32],
        options: &'a Options,
    ) -> Option<Self> {
        let asked = &options.question;
        let is_counted = asked.model == Model::Projective
            && !asked.whole_graph
            && asked.arithmetic == Arithmetic::Prime
            && asked.solutions != CountSolutions::Off;
        if !is_counted || contraction.finals.len() + contraction.loose.len() < 2 {
            return None;
        }
        let assembly = Assembly::new(graph, contraction);
        let Split { rigid, mut pieces } = assembly.split(&assembly.all());
        let members = pieces
            .pop()
            .filter(|_| pieces.is_empty() && rigid.is_empty())?;
        (assembly.count_nodes(&members) == graph.nodes()).then(|| Self {
            graph,
            contraction: contraction.clone(),
            assembly,
            members,
            sha256,
            options,
        })
    }

    fn nodes_of_members(&self) -> Vec<Vec<u32>> {
        nodes_of(&self.contraction, &self.members.bodies, &self.members.edges)
    }

    /// Rounds that leave one member, where equations are so many that they probably do: one rank
    /// serves the verdict and the first of them.
    fn first_rounds(&self) -> Result<Option<Rounds>, VerdictError> {
        let members = self.nodes_of_members();
        if !rounds::may_be_many(self.graph.nodes(), &members) {
            return Ok(None);
        }
        Ok(Some(self.rounds(false)?).filter(Rounds::is_one))
    }

    fn rounds(&self, is_patient: bool) -> Result<Rounds, VerdictError> {
        let (nodes, members) = (self.graph.nodes(), self.nodes_of_members());
        rounds::merge(nodes, members, self.sha256, self.options, is_patient)
    }

    /// The verdict where rounds leave one member, which proves the rank too.
    fn conclude(&self, rounds: Rounds) -> Result<Verdict, VerdictError> {
        let (known_parts, displacements) = self.options.question.known.clone().split();
        let found = Found {
            graph: self.graph,
            options: self.options,
            known_parts,
            displacements,
            assembly: &self.assembly,
            by_rank: Vec::new(),
            rigid: Members::default(),
            pieces: vec![PieceVerdict::of_one_solution(
                self.members.clone(),
                Model::Projective.required(self.graph.nodes()),
            )],
            rounds: Some(rounds),
        };
        found.conclude(*self.sha256, self.contraction.clone())
    }
}

/// What is known of a graph, piece by piece.
struct Found<'a> {
    graph: &'a Graph,
    options: &'a Options,
    known_parts: KnownParts,
    displacements: Displacements,
    assembly: &'a Assembly,
    /// Why bodies by rank are rigid.
    by_rank: Vec<Evidence>,
    /// The members that are pieces by themselves.
    rigid: Members,
    /// The other pieces.
    pieces: Vec<PieceVerdict>,
    /// Rounds that merge members of the graph, if it is finite solvable.
    rounds: Option<Rounds>,
}

impl Found<'_> {
    /// Sums up over the pieces (Theorem 4.3 and Corollary 4.6 of docs/theory.md; calibrated:
    /// Theorem 4.10 and Corollary 4.12; affine: Theorem 13.10 and Corollary 13.12;
    /// with displacements: Theorems 13.17 and 13.18).
    fn conclude(self, sha256: [u8; 32], contraction: Contraction) -> Result<Verdict, VerdictError> {
        let rank = self.rank();
        let upper = self.rigid_rank() + self.pieces.iter().map(|piece| piece.upper).sum::<usize>();
        let value = self.value(rank, &contraction);
        let value_strength = self.strength(value, upper);
        let solutions = self.solutions(value, &contraction)?;
        let is_one = solutions.as_ref().is_some_and(SolutionCount::is_one);
        let contraction = Arc::new(contraction);
        let mut components = self.components(&contraction);
        match &solutions {
            Some(_) => components
                .iter_mut()
                .for_each(|all| all.solutions = solutions.clone()),
            None => self.count_in_components(&mut components, &contraction, &sha256)?,
        }
        Ok(Verdict {
            model: self.model(),
            known_parts: self.known_parts.clone(),
            displacements: self.displacements.clone(),
            own_frame: None,
            sha256,
            seed: self.options.seed,
            value: if is_one { Value::Solvable } else { value },
            value_strength,
            solutions,
            rank,
            required: self.required(),
            components,
            contraction,
            by_rank: self.by_rank,
            rigid: self.rigid,
            pieces: self.pieces,
        })
    }

    fn model(&self) -> Model {
        self.options.question.model
    }

    /// The rank of a finite solvable graph with as many nodes.
    fn required(&self) -> usize {
        let scale = usize::from(!self.displacements.is_empty());
        self.model().required(self.graph.nodes()) + scale
    }

    /// The rank, which is no less.
    fn rank(&self) -> usize {
        self.rigid_rank() + self.pieces.iter().map(|piece| piece.lower).sum::<usize>()
    }

    /// The rank of the members that are pieces by themselves.
    fn rigid_rank(&self) -> usize {
        let singles = self.rigid.singles();
        let ranks = singles
            .iter()
            .map(|part| self.assembly.required(self.model(), part));
        ranks.sum()
    }

    /// The answer before solutions are counted: one body that comes from the rules and what is known
    /// is unique (Corollary 4.2), one piece of full rank, a body by rank too, is finite (Theorem 1.3)
    /// and in the other models unique (Theorems 4.8, 13.2 and, with displacements, 13.20).
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
        match self.model() {
            // Pieces may hang together in scaled bodies.
            _ if !self.displacements.is_empty() && rank == self.required() => Value::Solvable,
            _ if is_unique || self.graph.nodes() == 1 => Value::Solvable,
            model if is_full && model.is_linear() => Value::Solvable,
            _ if is_full => Value::FiniteSolvable,
            _ => Value::NotFiniteSolvable,
        }
    }

    /// How many solutions there are (section 10), if finitely many.
    fn solutions(
        &self,
        value: Value,
        contraction: &Contraction,
    ) -> Result<Option<SolutionCount>, Stopped> {
        Ok(match value {
            Value::Solvable => Some(SolutionCount::one()),
            Value::FiniteSolvable => {
                let effort = self.effort(contraction);
                if let Some(found) = self.after_rounds(effort)? {
                    return Ok(Some(found));
                }
                let (bodies, edges) = (&contraction.finals, &contraction.loose);
                Some(self.count(contraction, bodies, edges, effort)?)
            }
            Value::NotFiniteSolvable => None,
        })
    }

    /// What rounds show, and counting where they end, if that is one solution.
    fn after_rounds(&self, effort: CountSolutions) -> Result<Option<SolutionCount>, Stopped> {
        let Some(rounds) = &self.rounds else {
            return Ok(None);
        };
        if rounds.is_one() {
            return Ok(Some(SolutionCount::by_rounds(rounds.clone())));
        }
        if rounds.rounds.is_empty() || effort == CountSolutions::Off {
            return Ok(None);
        }
        let task = self.options.watch.task(Step::Solutions, self.graph.nodes());
        SolutionCount::after(rounds.clone(), self.graph, effort, self.options.seed, &task)
    }

    /// How much is spent on counting. It is done between bodies that are unique.
    fn effort(&self, contraction: &Contraction) -> CountSolutions {
        let asked = &self.options.question;
        if asked.whole_graph || !contraction.by_rank.is_empty() {
            return CountSolutions::Off;
        }
        asked.solutions
    }

    /// The number of solutions of what some bodies and edges form, which is finite solvable.
    fn count(
        &self,
        contraction: &Contraction,
        bodies: &[u32],
        edges: &[(u32, u32)],
        effort: CountSolutions,
    ) -> Result<SolutionCount, Stopped> {
        let members = nodes_of(contraction, bodies, edges);
        let task = self.options.watch.task(Step::Solutions, self.graph.nodes());
        SolutionCount::of(self.graph, members, effort, self.options.seed, &task)
    }

    /// The number of solutions of a component, by rounds if they show one.
    fn count_component(
        &self,
        contraction: &Contraction,
        Members { bodies, edges }: &Members,
        sha256: &[u8; 32],
        effort: CountSolutions,
    ) -> Result<SolutionCount, VerdictError> {
        if effort != CountSolutions::Off {
            let members = nodes_of(contraction, bodies, edges);
            let nodes = self.graph.nodes();
            let rounds = rounds::merge(nodes, members, sha256, self.options, true)?;
            if rounds.is_one() {
                return Ok(SolutionCount::by_rounds(rounds));
            }
        }
        Ok(self.count(contraction, bodies, edges, effort)?)
    }

    /// The numbers of solutions of components, each by itself. A quick count ends with the first that
    /// stays open, or after some of the largest.
    fn count_in_components(
        &self,
        components: &mut [Component],
        contraction: &Contraction,
        sha256: &[u8; 32],
    ) -> Result<(), VerdictError> {
        let (mut effort, mut counted) = (self.effort(contraction), 0);
        for component in components {
            let (bodies, edges) = (&component.members.bodies, &component.members.edges);
            let is_one = self.model().is_linear()
                || bodies.len() + edges.len() == 1 && contraction.by_rank.is_empty();
            let mut count = if is_one {
                SolutionCount::one()
            } else {
                self.count_component(contraction, &component.members, sha256, effort)?
            };
            // Quick counts have ended before this one.
            count.full_may_tell_more |= !is_one && effort != self.effort(contraction);
            let is_open = count.at_most.is_none() && count.evidence.is_some();
            counted += usize::from(!is_one);
            if effort == CountSolutions::Quick && (is_open || counted == MOST_COMPONENTS) {
                effort = CountSolutions::Off;
            }
            component.solutions = Some(count);
        }
        Ok(())
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
        let all = self.assembly.joined(all.collect());
        let mut components: Vec<Component> = all
            .into_iter()
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
