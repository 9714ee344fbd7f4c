//! How many solutions the finite solvable graphs with the fewest edges have
//! (docs/theory.md, section 10).

use crate::catalog::{Candidates, SizeError, least_edges};
use rayon::prelude::*;
use std::collections::BTreeMap;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::{Graph, graph6};
use viewcert::solutions::{Effort, count};

/// A graph whose number of solutions is not known exactly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Open {
    /// The graph as graph6.
    pub graph6: String,
    /// It has as many solutions at least.
    pub at_least: usize,
    /// It has no more than that, if there is a bound.
    pub at_most: Option<usize>,
}

/// What was found for one number of nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many graphs are finite solvable.
    pub graphs: usize,
    /// How many graphs have exactly so many solutions.
    pub exactly: BTreeMap<usize, usize>,
    /// The others, in the order of the candidates.
    pub open: Vec<Open>,
}

/// Why there is no tally.
#[derive(Debug, thiserror::Error)]
pub enum TallyError {
    /// There are no candidates.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// A graph was not decided.
    #[error(transparent)]
    Verdict(#[from] VerdictError),
}

/// The number of solutions of every finite solvable graph with `nodes` nodes and the least number
/// of edges, in parallel; `done` is told of every batch of candidates.
///
/// # Errors
/// If there are no candidates, or deciding was stopped.
pub fn tally(
    nodes: usize,
    options: &Options,
    effort: Effort,
    seed: u64,
    mut done: impl FnMut(u64),
) -> Result<Tally, TallyError> {
    let mut graphs = Vec::new();
    // Adjacent nodes of degree 2 exclude finite solvability from four nodes on.
    Candidates::new(nodes, least_edges(nodes), true)?.for_each(&mut |graph| {
        graphs.push(graph);
        true
    });
    let mut tally = Tally::default();
    for batch in graphs.chunks(256) {
        let found: Vec<Option<Open>> = batch
            .par_iter()
            .map(|graph| bounds(graph, options, effort, seed))
            .collect::<Result<_, _>>()?;
        for graph in found.into_iter().flatten() {
            tally.graphs += 1;
            if graph.at_most == Some(graph.at_least) {
                *tally.exactly.entry(graph.at_least).or_default() += 1;
            } else {
                tally.open.push(graph);
            }
        }
        done(batch.len() as u64);
    }
    Ok(tally)
}

/// The bounds of a graph, if it is finite solvable.
fn bounds(
    graph: &Graph,
    options: &Options,
    effort: Effort,
    seed: u64,
) -> Result<Option<Open>, VerdictError> {
    if decide(graph, options)?.value == Value::NotFiniteSolvable {
        return Ok(None);
    }
    let found = count(graph, effort, seed);
    Ok(Some(Open {
        graph6: graph6::encode(graph),
        // The cameras themselves are a solution, whatever is known besides.
        at_least: found.as_ref().map_or(1, |found| found.at_least),
        at_most: found.and_then(|found| found.at_most),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One solution each up to eight nodes; ten of the 27 graphs with nine nodes have two
    /// (Arrigoni, Kohn, Fusiello, Pajdla). That all with ten nodes are known, and how many have two
    /// or three, is our own count.
    #[test]
    fn published_numbers() {
        for (nodes, exactly) in [
            (3, vec![(1, 1)]),
            (4, vec![(1, 1)]),
            (5, vec![(1, 1)]),
            (6, vec![(1, 4)]),
            (7, vec![(1, 3)]),
            (8, vec![(1, 36)]),
            (9, vec![(1, 17), (2, 10)]),
            (10, vec![(1, 595), (2, 153), (3, 8)]),
        ] {
            let tally = tally(nodes, &Options::default(), Effort::default(), 1, |_| {}).unwrap();
            assert_eq!(tally.open, []);
            assert_eq!(
                tally.exactly.into_iter().collect::<Vec<_>>(),
                exactly,
                "{nodes} nodes"
            );
        }
    }

    /// Other centres give other evidence and the same numbers.
    #[test]
    fn seeds_do_not_matter() {
        let of_seed = |seed| {
            tally(9, &Options::default(), Effort::default(), seed, |_| {})
                .unwrap()
                .exactly
        };
        assert_eq!(of_seed(2), of_seed(3));
    }
}
