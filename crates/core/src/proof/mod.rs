//! The explicit proof of a verdict: docs/proof.md.
//!
//! In: a graph and its verdict. Out: lines of numbers that a program which searches nothing verifies,
//! `viewcert-proved`, whose answers are theorems (`proofs/`). What a certificate says by draws and
//! pivots is written out here: centres, rows, the nodes of every body and what joins them.

mod bodies;
mod components;
mod core;
mod count;
mod eliminated;
mod flows;
mod links;
mod listed;
mod scales;
mod text;
mod unique;
mod upper;

pub use text::Proof;

use bodies::Record;

use crate::decide::evidence::Evidence;
use crate::decide::{Options, Question, Value, Verdict, decide};
use crate::graph::Graph;
use std::fmt;

/// Cores with more nodes would take minutes to check, and tens of megabytes.
const LARGEST_CORE: usize = 1000;

/// What of a verdict cannot be written as an explicit proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unproved {
    /// Known parts or displacements.
    Known,
    /// A graph with one node.
    OneNode,
    /// An upper bound that blocks and hubs alone do not show.
    UpperBound,
    /// The rank rests on draws, with an error bound.
    ErrorBound,
    /// The core has so many nodes.
    Core(usize),
    /// A record of merges that uses a body twice.
    Record,
    /// At no centres modulo 65521 that were tried the core had its rank.
    Unlucky,
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Known => f.write_str("not with known parts or displacements"),
            Self::OneNode => f.write_str("a graph with one node has nothing to prove"),
            Self::UpperBound => {
                f.write_str("an upper bound that blocks and hubs alone do not show")
            }
            Self::ErrorBound => f.write_str("a rank that is known with an error bound only"),
            Self::Core(nodes) => write!(f, "a core of {nodes} nodes, of {LARGEST_CORE} at most"),
            Self::Record => f.write_str("a record of merges that uses a body twice"),
            Self::Unlucky => f.write_str("a core that has its rank at no centres tried"),
        }
    }
}

impl std::error::Error for Unproved {}

impl Verdict {
    /// The explicit proof of this verdict on `graph`, which has to be the graph that was decided: a
    /// lower and an upper bound for the generic rank, and that the graph is solvable where the rules of
    /// Theorem 4.1, or linear algebra (Theorem 10.6), say so. Of a graph that is not finite solvable and
    /// has a large core it is the upper bound alone.
    ///
    /// O(size of the record of bodies) and an elimination of the core, which takes O(k^3) for k
    /// nodes at worst.
    ///
    /// ```
    /// use viewcert::{Graph, Options, decide};
    ///
    /// let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)])?;
    /// let verdict = decide(&graph, &Options::default())?;
    /// let proof = verdict.proof(&graph)?;
    /// assert_eq!((proof.lower(), proof.upper()), (28, 28));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the verdict rests on evidence that has no explicit proof yet.
    pub fn proof(&self, graph: &Graph) -> Result<Proof, Unproved> {
        let model = self.model;
        if !self.known_parts.is_empty() || !self.displacements.is_empty() {
            return Err(Unproved::Known);
        }
        if graph.nodes() < 2 {
            return Err(Unproved::OneNode);
        }
        let full = model.full(graph.nodes());
        let refuted = self.value == Value::NotFiniteSolvable;
        let (upper, blocks) = if refuted {
            upper::of(self)?
        } else {
            (full, Vec::new())
        };
        if refuted && upper >= full {
            return Err(Unproved::ErrorBound);
        }
        let mut record = Record::of(model, graph, &self.contraction)?;
        let last = record.last(&self.contraction);
        let wanted = refuted && self.components_claim().is_proved();
        let mut lower = self.rank / model.times();
        let mut components = None;
        if !last.is_empty() {
            match bodies::of_sets(model, &last, lower) {
                Ok(whole) => {
                    components = wanted
                        .then(|| components::of(self, &mut record).ok())
                        .flatten();
                    record.done.push(whole);
                }
                Err(Unproved::Core(_)) if refuted => {
                    lower = 0;
                    record.done.clear();
                }
                // Rounds take the place of bodies by rank, which would have left a smaller core.
                Err(unproved @ Unproved::Core(_)) if self.rests_on_rounds() => {
                    let asked = Question::without_solutions(model);
                    let options = Options::default().question(asked).seed(self.seed);
                    let by_rank = decide(graph, &options).map_err(|_| unproved)?;
                    return by_rank.proof(graph);
                }
                Err(unproved) => return Err(unproved),
            }
        }
        let cameras = !model.is_linear() && !refuted;
        let by_rules = cameras && listed::determine_all(&record.done, graph.nodes());
        let uniques = if cameras && !by_rules {
            unique::determine_all(graph.edges(), graph.nodes(), record.done.len() as u32 + 1)
        } else {
            None
        };
        Ok(Proof {
            model,
            nodes: graph.nodes(),
            pairs: graph.edges().len(),
            lower,
            upper,
            solvable: by_rules || uniques.is_some(),
            uniques: uniques.unwrap_or_default(),
            bodies: record.done,
            blocks,
            components,
        })
    }

    fn rests_on_rounds(&self) -> bool {
        let mut evidence = self.pieces.iter().flat_map(|piece| &piece.evidence);
        evidence.any(|one| *one == Evidence::OneSolution)
    }
}

#[cfg(test)]
mod tests;
