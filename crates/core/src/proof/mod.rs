//! The explicit proof of a verdict: docs/proof.md.
//!
//! In: a graph and its verdict. Out: lines of numbers that a program which searches nothing verifies,
//! `viewcert-proved`, whose answers are theorems (`proofs/`). What a certificate says by draws and
//! pivots is written out here: centres, rows, the nodes of every body and what joins them.

mod bodies;
mod components;
mod core;
mod eliminated;
mod flows;
mod text;

pub use text::Proof;

use bodies::Record;

use crate::contract::Body;
use crate::contract::piece::{Assembly, Members};
use crate::decide::evidence::{Bound, Evidence, PieceVerdict, Upper};
use crate::decide::{Counting, Value, Verdict};
use crate::geometry::model::Model;
use crate::graph::Graph;
use std::fmt;

/// Cores with more nodes would take minutes to check, and tens of megabytes.
const LARGEST_CORE: usize = 1000;

/// What of a verdict cannot be written as an explicit proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unproved {
    /// Another model than the projective one.
    Model,
    /// Known parts or displacements.
    Known,
    /// A graph with one node.
    OneNode,
    /// An upper bound by a hub.
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
            Self::Model => f.write_str("only verdicts of the projective model"),
            Self::Known => f.write_str("not with known parts or displacements"),
            Self::OneNode => f.write_str("a graph with one node has nothing to prove"),
            Self::UpperBound => f.write_str("an upper bound by a hub"),
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
    /// lower and an upper bound for the generic rank. Of a graph that is not finite solvable and
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
        if self.model != Model::Projective {
            return Err(Unproved::Model);
        }
        if !self.known_parts.is_empty() || !self.displacements.is_empty() {
            return Err(Unproved::Known);
        }
        if graph.nodes() < 2 {
            return Err(Unproved::OneNode);
        }
        let full = Model::Projective.required(graph.nodes());
        let refuted = self.value == Value::NotFiniteSolvable;
        let (upper, blocks) = if refuted {
            upper_bound(self, &Assembly::new(graph, &self.contraction))?
        } else {
            (full, Vec::new())
        };
        if refuted && upper >= full {
            return Err(Unproved::ErrorBound);
        }
        let mut record = Record::of(graph, &self.contraction)?;
        let last = record.last(&self.contraction);
        let wanted = refuted && self.components_claim().is_proved();
        let mut lower = self.rank;
        let mut components = None;
        if !last.is_empty() {
            match bodies::of_sets(&last, self.rank) {
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
                Err(unproved) => return Err(unproved),
            }
        }
        Ok(Proof {
            nodes: graph.nodes(),
            pairs: graph.edges().len(),
            lower,
            upper,
            bodies: record.done,
            blocks,
            components,
        })
    }
}

/// What a set of nodes has to have to be of full rank.
fn required(nodes: &[u32]) -> usize {
    Model::Projective.required(nodes.len())
}

/// An upper bound by counting, and its blocks of three nodes or more.
fn upper_bound(verdict: &Verdict, assembly: &Assembly) -> Result<(usize, Vec<Vec<u32>>), Unproved> {
    let mut parts: Vec<Members> = verdict.rigid.singles();
    for piece in &verdict.pieces {
        parts.extend(piece_blocks(piece, assembly)?);
    }
    let nodes = |part: &Members| part.nodes(&verdict.contraction.bodies);
    let blocks: Vec<Vec<u32>> = parts.iter().map(nodes).collect();
    let upper = blocks.iter().map(|block| required(block)).sum();
    Ok((
        upper,
        blocks.into_iter().filter(|block| block.len() > 2).collect(),
    ))
}

/// The blocks by which the bound of a piece is counted.
///
/// Parts that overlap and added pairs never give less than a partition does where no block has a
/// hub: the smallest sum over partitions is submodular in the pairs, and grows with them.
fn piece_blocks(piece: &PieceVerdict, assembly: &Assembly) -> Result<Vec<Members>, Unproved> {
    let required = assembly.required(Model::Projective, &piece.members);
    if piece.upper >= required {
        return Ok(vec![piece.members.clone()]);
    }
    let counted = piece.evidence.iter().filter_map(|evidence| match evidence {
        Evidence::Upper(Upper {
            by: Bound::Counting(counting),
            added,
        }) if added.is_empty() => Some(counting),
        _ => None,
    });
    let without_hubs =
        |counting: &&Counting| counting.blocks.iter().all(|block| block.hub.is_none());
    let best = counted
        .filter(without_hubs)
        .min_by_key(|counting| counting.bound);
    let best = best.filter(|counting| counting.bound == piece.upper);
    let best = best.ok_or(Unproved::UpperBound)?;
    Ok(best
        .blocks
        .iter()
        .map(|block| block.members.clone())
        .collect())
}

impl Members {
    /// Its nodes, increasing.
    fn nodes(&self, bodies: &[Body]) -> Vec<u32> {
        let of_bodies = self.bodies.iter().flat_map(|&k| &bodies[k as usize].nodes);
        let of_edges = self.edges.iter().flat_map(|&(i, j)| [i, j]);
        let mut nodes: Vec<u32> = of_bodies.copied().chain(of_edges).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}

#[cfg(test)]
mod tests;
