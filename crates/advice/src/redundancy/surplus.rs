//! The surplus of every pair: what it tells that the rest of the graph tells as well. In the calibrated model
//! that is about directions: rotations, which loops check, are supposed to be known.
//!
//! In: a graph and its verdict. Out: the pairs whose surplus is not full, each with it. Where the
//! ranks of the components add up to the rank of the graph, each component is looked at by itself;
//! elsewhere each block of the graph that no node separates (docs/theory.md, Theorem 15.1).

use super::losses::{Base, RIGID, losses};
use crate::parts::{Alone, Parts};
use crate::weak::{left_out, used};
use rayon::prelude::*;
use viewcert::contract::Contraction;
use viewcert::decide::{Options, VerdictError, decide};
use viewcert::graph::{Adjacency, biconnected_components};
use viewcert::{Graph, Strength, Verdict};

type Pair = (u32, u32);

/// A pair that the rest does not check in all its equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surplus {
    /// The pair.
    pub pair: Pair,
    /// In how many of its equations it is checked: 0 if an error in these can never be seen.
    pub surplus: usize,
    /// How strong that is.
    pub strength: Strength,
}

/// The pairs whose surplus is not full, increasing; that the others are checked in full is proved.
///
/// The rank that the removal of a pair takes is never more than the 7 equations of a pair (2 of a
/// bearing, 4 of an affine pair); the surplus is the rest. Close to the cost of a verdict where bodies
/// are all that is needed; for cores a decision for each of their pairs at worst.
///
/// # Errors
/// Those of [`decide`].
pub fn surplus(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Vec<Surplus>, VerdictError> {
    let mut found = if adds_up(verdict) {
        of_components(graph, verdict, options)?
    } else {
        of_blocks(graph, verdict, options)?
    };
    found.sort_unstable_by_key(|one| one.pair);
    Ok(found)
}

/// Whether the rank is that of the components together, which is no less: then it is proved.
fn adds_up(verdict: &Verdict) -> bool {
    let sizes = verdict.components.iter().map(|one| one.node_count());
    sizes.map(|n| verdict.model.required(n)).sum::<usize>() == verdict.rank
}

/// The components of a graph whose ranks add up, each by itself.
fn of_components(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Vec<Surplus>, VerdictError> {
    let parts = Parts::new(graph, verdict);
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        Ok(named(&alone, of_region(&alone.graph, RIGID, options)?))
    });
    let found: Result<Vec<Vec<Surplus>>, VerdictError> = of_part.collect();
    let mut found = found?.concat();
    found.extend(parts.links.iter().map(|&(pair, _)| unchecked(pair)));
    Ok(found)
}

/// Each biconnected component by itself: ranks add up over these.
fn of_blocks(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Vec<Surplus>, VerdictError> {
    let mut blocks: Vec<Vec<u32>> = Vec::new();
    biconnected_components(Adjacency::new(graph).lists(), |nodes| {
        blocks.push(nodes.to_vec())
    });
    let of_block = blocks.par_iter_mut().map(|nodes| {
        nodes.sort_unstable();
        if let [a, b] = nodes[..] {
            return Ok(vec![unchecked((a, b))]);
        }
        let inside = |&&(_, j): &&Pair| nodes.binary_search(&j).is_ok();
        let from = |&v: &u32| graph.edges_from(v).iter().filter(inside).copied();
        let edges: Vec<Pair> = nodes.iter().flat_map(from).collect();
        let alone = Alone::new(nodes, &edges);
        let own;
        let verdict = if edges.len() == graph.edges().len() {
            verdict
        } else {
            own = decide(&alone.graph, options)?;
            &own
        };
        let found = if adds_up(verdict) {
            of_components(&alone.graph, verdict, options)?
        } else {
            let base = Base {
                shortfall: verdict.model.required(nodes.len()) - verdict.rank,
                strength: verdict.rank_claim().strength,
            };
            of_region(&alone.graph, base, options)?
        };
        Ok(named(&alone, found))
    });
    let found: Result<Vec<Vec<Surplus>>, VerdictError> = of_block.collect();
    Ok(found?.concat())
}

/// A pair whose rows are independent of all others.
fn unchecked(pair: Pair) -> Surplus {
    Surplus {
        pair,
        surplus: 0,
        strength: Strength::Proof,
    }
}

/// The same in the numbers of the whole graph.
fn named(alone: &Alone, found: Vec<Surplus>) -> Vec<Surplus> {
    let global = |(a, b): Pair| (alone.nodes[a as usize], alone.nodes[b as usize]);
    let named = found.into_iter().map(|one| Surplus {
        pair: global(one.pair),
        ..one
    });
    named.collect()
}

/// The pairs of a graph without full surplus. What no merge of a contraction uses has full surplus,
/// as has a pair of a node with three pairs to a body that stands without the node.
fn of_region(graph: &Graph, base: Base, options: &Options) -> Result<Vec<Surplus>, VerdictError> {
    let model = options.question.model;
    let contraction = Contraction::new(graph, model);
    let is_loose = |pair: &Pair| contraction.loose.binary_search(pair).is_ok();
    let (loose, in_bodies): (Vec<Pair>, Vec<Pair>) =
        used(&contraction).into_iter().partition(is_loose);
    let mut candidates = left_out::not_cleared(graph, in_bodies, options)?;
    candidates.extend(loose);
    let found = losses(graph, &candidates, base, options)?;
    let surplus = found.into_iter().map(|loss| Surplus {
        pair: loss.pair,
        surplus: model.required(2) - loss.rank,
        strength: loss.strength,
    });
    Ok(surplus.collect())
}
