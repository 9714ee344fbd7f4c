//! Conditions of the literature, necessary or sufficient for solvability, each with the
//! witness that decides it.
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
pub enum Witness {
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
    pub witness: Option<Witness>,
}

/// A failed condition's witness; none if it holds.
type Decided = Result<(Answer, Option<Witness>), String>;

fn unless(witness: Option<Witness>) -> Decided {
    match witness {
        Some(witness) => Ok((Answer::No, Some(witness))),
        None => Ok((Answer::Yes, None)),
    }
}

/// Decides all conditions, the necessary ones first. Of a single camera they say nothing.
pub fn decide(graph: &Graph) -> Vec<Condition> {
    let (nodes, edges) = (graph.nodes(), graph.edges().len());
    let adjacency = Adjacency::new(graph);
    let required = Model::Projective.required(nodes);
    let partition = if nodes * edges <= MAX_PEBBLES {
        let blocks = pebbles::blocks(graph);
        let bound: usize = blocks.iter().map(|block| 11 * block.len() - 15).sum();
        unless((bound < required).then_some(Witness::Partition(blocks, bound)))
    } else {
        Err(format!(
            "{nodes} cameras and {edges} pairs are too many for the count"
        ))
    };
    let holds_by_edges = matches!(&partition, Ok((Answer::Yes, _)));
    let condition = |necessary, name, source, decided: Decided| {
        let decided = if nodes < 2 {
            Err("a single camera is solvable".into())
        } else {
            decided
        };
        let (answer, witness) = decided.unwrap_or_else(|why| (Answer::NotApplicable(why), None));
        Condition {
            name,
            source,
            necessary,
            answer,
            witness,
        }
    };
    let trager = "Trager, Osserman, Ponce 2018";
    vec![
        condition(true, "minimum degree 2", "Levi, Werman 2003", {
            if nodes < 3 {
                Err("a single pair is solvable".into())
            } else {
                unless(degrees::below_two(&adjacency))
            }
        }),
        condition(
            true,
            "no adjacent nodes of degree 2",
            "Levi, Werman 2003",
            {
                if nodes < 4 {
                    Err("fewer than 4 cameras".into())
                } else {
                    unless(degrees::adjacent_twos(graph, &adjacency))
                }
            },
        ),
        condition(
            true,
            "biconnected",
            trager,
            unless(degrees::cut(&adjacency)),
        ),
        condition(true, "7m >= 11n - 15", trager, {
            let (left, right) = (7 * edges, required);
            let count = Witness::Count(format!("{left} and {right}"));
            let answer = if left < right {
                Answer::No
            } else {
                Answer::Yes
            };
            Ok((answer, Some(count)))
        }),
        condition(
            true,
            "d-condition by vertices",
            trager,
            vertices::decide(graph, holds_by_edges),
        ),
        condition(true, "d-condition by edges", trager, partition),
        condition(
            true,
            "bearing rigid",
            "Arrigoni et al. 2022",
            bearing(graph),
        ),
        condition(
            false,
            "grows from a triangle",
            "Trager, Hebert, Ponce 2015",
            growth::decide(graph, &adjacency),
        ),
        condition(false, "moves", trager, moves::decide(graph)),
    ]
}

/// The calibrated verdict.
fn bearing(graph: &Graph) -> Decided {
    let options = Options::default().model(Model::Calibrated);
    let verdict = verdict::decide(graph, &options).map_err(|error| error.to_string())?;
    let count = Witness::Count(format!("rank {} of {}", verdict.rank, verdict.required));
    let answer = if verdict.value == Value::NotFiniteSolvable {
        Answer::No
    } else {
        Answer::Yes
    };
    Ok((answer, Some(count)))
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
