//! Conditions of the literature, necessary or sufficient for solvability, each with the
//! grounds on which it is decided.
//!
//! # What is known
//!
//! *Necessary* for a graph with n >= 2 cameras to be finite solvable, and so for it to be
//! solvable:
//!
//! * every camera has at least two pairs, and no two cameras with exactly two are a pair
//!   (Levi, Werman 2003; n >= 3 and n >= 4);
//! * the graph is biconnected, and 7m >= 11n - 15 (Trager, Osserman, Ponce 2018);
//! * *d-condition* (same, Theorem 2): with d(H) = 7 e_H - 11 n_H + 15, no subgraph H has
//!   d(H) > d(G), where d of a subgraph that is cut into blocks is the sum of d over its
//!   blocks. By vertices: H is induced by a set of three or more cameras, and counts as one
//!   block. By edges: H is any set of edges;
//! * bearing rigidity: the calibrated problem is solvable (Arrigoni et al. 2022).
//!
//! *Sufficient* for a graph to be solvable:
//!
//! * it grows from a triangle by cameras with two pairs into what is there already (Trager,
//!   Hebert, Ponce 2015);
//! * the moves of Trager, Osserman and Ponce complete it; see [`moves`].
//!
//! # The d-condition by edges is a partition count
//!
//! Take the blocks B of H and every edge outside H as a block of its own (n_B = 2, and
//! 11 * 2 - 15 = 7): sum d(B) > d(G) says exactly that the sum of 11 n_B - 15 over this
//! partition of all edges is below 11n - 15. So the condition holds iff no partition has a
//! smaller sum, which [`pebbles`] decides in polynomial time.

pub mod degrees;
pub mod growth;
pub mod moves;
pub mod pebbles;
pub mod vertices;

use viewcert::decide as verdict;
use viewcert::decide::{Options, Value};
use viewcert::geometry::model::Model;
use viewcert::graph::{Adjacency, Graph};

/// Most cameras times pairs for the d-condition by edges: some seconds.
pub const MAX_PEBBLES: usize = 4_000_000;

/// Whether a condition holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It holds.
    Yes,
    /// It does not.
    No,
    /// It says nothing about this graph, or was not decided; and why.
    NotApplicable(String),
}

/// What decides a condition. Nodes are those of the graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Grounds {
    /// A camera with too few pairs.
    Degree(u32, usize),
    /// Two cameras with two pairs each that are a pair.
    Adjacent(u32, u32),
    /// A camera without which these cameras are cut off.
    Cut(u32, Vec<u32>),
    /// These cameras are not connected with the others.
    Apart(Vec<u32>),
    /// A left and a right side of a count, in words.
    Count(String),
    /// Cameras whose induced subgraph has a larger d, with it and d(G).
    Vertices(Vec<u32>, i64, i64),
    /// The cameras of the blocks of a partition of the edges, and the sum of 11 n_B - 15.
    Partition(Vec<Vec<u32>>, usize),
    /// An edge and the cameras in order, each with two pairs into what is there already.
    Growth((u32, u32), Vec<[u32; 3]>),
    /// Cameras that growth reaches at most.
    Reached(usize),
    /// Moves in order.
    Moves(Vec<moves::Move>),
    /// Pairs that no move joins.
    Missing(usize),
}

/// A condition, decided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// A short name.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// Necessary for solvability; otherwise sufficient.
    pub necessary: bool,
    /// Whether it holds.
    pub answer: Answer,
    /// What decides it.
    pub grounds: Option<Grounds>,
}

/// An answer with its grounds, or why there is none.
type Decided = Result<(Answer, Option<Grounds>), String>;

/// A condition fails if there are grounds against it.
fn unless(grounds: Option<Grounds>) -> Decided {
    match grounds {
        Some(grounds) => Ok((Answer::No, Some(grounds))),
        None => Ok((Answer::Yes, None)),
    }
}

/// A condition on the same grounds whether it holds or not.
fn answered(holds: bool, grounds: Grounds) -> Decided {
    let answer = if holds { Answer::Yes } else { Answer::No };
    Ok((answer, Some(grounds)))
}

const LEVI: &str = "Levi, Werman 2003";
const HEBERT: &str = "Trager, Hebert, Ponce 2015";
const TRAGER: &str = "Trager, Osserman, Ponce 2018";
const ARRIGONI: &str = "Arrigoni et al. 2022";

/// Decides all conditions, the necessary ones first. Of a single camera they say nothing.
pub fn decide(graph: &Graph) -> Vec<Condition> {
    let adjacency = Adjacency::new(graph);
    let mut conditions = necessary(graph, &adjacency);
    conditions.extend(sufficient(graph, &adjacency));
    if graph.nodes() < 2 {
        for condition in &mut conditions {
            condition.answer = Answer::NotApplicable("a single camera is solvable".into());
            condition.grounds = None;
        }
    }
    conditions
}

fn necessary(graph: &Graph, adjacency: &Adjacency) -> Vec<Condition> {
    let condition = |name, source, decided| Condition::new(true, name, source, decided);
    let by_edges = by_edges(graph);
    let holds_by_edges = matches!(by_edges, Ok((Answer::Yes, _)));
    let by_vertices = vertices::decide(graph, holds_by_edges);
    let biconnected = unless(degrees::cut(adjacency));
    vec![
        condition("minimum degree 2", LEVI, minimum_degree(adjacency)),
        condition(
            "no adjacent nodes of degree 2",
            LEVI,
            no_adjacent_twos(graph, adjacency),
        ),
        condition("biconnected", TRAGER, biconnected),
        condition("7m >= 11n - 15", TRAGER, enough_edges(graph)),
        condition("d-condition by vertices", TRAGER, by_vertices),
        condition("d-condition by edges", TRAGER, by_edges),
        condition("bearing rigid", ARRIGONI, bearing_rigid(graph)),
    ]
}

fn sufficient(graph: &Graph, adjacency: &Adjacency) -> Vec<Condition> {
    let condition = |name, source, decided| Condition::new(false, name, source, decided);
    let grows = growth::decide(graph, adjacency);
    vec![
        condition("grows from a triangle", HEBERT, grows),
        condition("moves", TRAGER, moves::decide(graph)),
    ]
}

impl Condition {
    fn new(necessary: bool, name: &'static str, source: &'static str, decided: Decided) -> Self {
        let (answer, grounds) = decided.unwrap_or_else(|why| (Answer::NotApplicable(why), None));
        Self {
            name,
            source,
            necessary,
            answer,
            grounds,
        }
    }
}

fn minimum_degree(adjacency: &Adjacency) -> Decided {
    if adjacency.nodes() < 3 {
        return Err("a single pair is solvable".into());
    }
    unless(degrees::below_two(adjacency))
}

fn no_adjacent_twos(graph: &Graph, adjacency: &Adjacency) -> Decided {
    if graph.nodes() < 4 {
        return Err("fewer than 4 cameras".into());
    }
    unless(degrees::adjacent_twos(graph, adjacency))
}

fn enough_edges(graph: &Graph) -> Decided {
    let left = 7 * graph.edges().len();
    let right = Model::Projective.required(graph.nodes());
    answered(left >= right, Grounds::Count(format!("{left} and {right}")))
}

/// The d-condition by edges, as a count over partitions (see the module).
fn by_edges(graph: &Graph) -> Decided {
    let (nodes, edges) = (graph.nodes(), graph.edges().len());
    if nodes * edges > MAX_PEBBLES {
        return Err(format!(
            "{nodes} cameras and {edges} pairs are too many for the count"
        ));
    }
    let blocks = pebbles::blocks(graph);
    let bound: usize = blocks.iter().map(|block| 11 * block.len() - 15).sum();
    let refuted = bound < Model::Projective.required(nodes);
    unless(refuted.then_some(Grounds::Partition(blocks, bound)))
}

/// The calibrated verdict.
fn bearing_rigid(graph: &Graph) -> Decided {
    let options = Options::default().model(Model::Calibrated);
    let verdict = verdict::decide(graph, &options).map_err(|error| error.to_string())?;
    let count = format!("rank {} of {}", verdict.rank, verdict.required);
    answered(
        verdict.value != Value::NotFiniteSolvable,
        Grounds::Count(count),
    )
}

/// Whether a necessary condition fails: then the graph is not finite solvable.
pub fn refuted(conditions: &[Condition]) -> bool {
    conditions
        .iter()
        .any(|condition| condition.necessary && condition.answer == Answer::No)
}

/// Whether a sufficient condition holds: then the graph is solvable.
pub fn solvable(conditions: &[Condition]) -> bool {
    conditions
        .iter()
        .any(|condition| !condition.necessary && condition.answer == Answer::Yes)
}

#[cfg(test)]
mod tests;
