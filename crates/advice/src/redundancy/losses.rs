//! What rank the removal of each of some pairs takes.
//!
//! In: a graph, and pairs of it. Out: those pairs whose removal takes any, and how much. All of them
//! are left out together first. What a body of the rest holds takes nothing; what lies in a body
//! stays in it whatever else is left out, so bodies are replaced by chains of triangles on the nodes
//! where they touch anything else, and each half of the pairs is looked at in that smaller graph
//! (docs/theory.md, Theorem 15.1 (d)). At the end each pair is left out by itself, of a small graph,
//! and what is left is decided. Bodies come from the rules as long as these make the graph small, and
//! else from a decision.

use crate::condensation::{Condensation, shortfall, terminals, without};
use crate::parts::Parts;
use crate::weak::{bodies_of_nodes, by_distance, check, final_nodes, is_in_one};
use viewcert::contract::Contraction;
use viewcert::decide::{Options, VerdictError, decide};
use viewcert::{Graph, Strength};

/// What is known of a graph of which pairs are left out.
#[derive(Clone, Copy)]
pub(super) struct Base {
    /// By how much its rank falls short of that of a solvable graph.
    pub(super) shortfall: usize,
    /// How strong that is.
    pub(super) strength: Strength,
}

/// A rigid graph.
pub(super) const RIGID: Base = Base {
    shortfall: 0,
    strength: Strength::Proof,
};

type Pair = (u32, u32);

/// A condensation with more nodes than the first number, and the second for each pair, has a core.
const MOST_NODES: usize = 32;
const NODES_EACH: usize = 8;

/// Halves of so many are worth a thread of their own.
const SHARE: usize = 16;

/// A pair of a graph, and what it is called.
#[derive(Clone, Copy)]
struct Open {
    here: Pair,
    name: Pair,
}

/// A pair whose removal takes rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Loss {
    pub(super) pair: Pair,
    /// How much.
    pub(super) rank: usize,
    pub(super) strength: Strength,
}

/// Those of some pairs of a graph, given in any order, whose removal takes rank, increasing. Two
/// contractions of O(k) pairs for each of log k halvings of k pairs, and a decision for each pair, of
/// a graph of some nodes where separators are small.
///
/// # Errors
/// Those of [`decide`].
pub(super) fn losses(
    graph: &Graph,
    pairs: &[Pair],
    base: Base,
    options: &Options,
) -> Result<Vec<Loss>, VerdictError> {
    let place = by_distance(graph);
    let mut open: Vec<Open> = pairs
        .iter()
        .map(|&pair| Open {
            here: pair,
            name: pair,
        })
        .collect();
    // Halves that lie apart leave more whole.
    open.sort_by_key(|pair| {
        let [a, b] = [pair.here.0, pair.here.1].map(|v| place[v as usize]);
        (a.min(b), a.max(b))
    });
    let mut found = halved(graph, open, base, options)?;
    found.sort_unstable_by_key(|loss| loss.pair);
    Ok(found)
}

fn halved(
    graph: &Graph,
    mut open: Vec<Open>,
    base: Base,
    options: &Options,
) -> Result<Vec<Loss>, VerdictError> {
    check(graph, options)?;
    match open[..] {
        [] => return Ok(Vec::new()),
        [one] => return alone(graph, one, base, options),
        _ => {}
    }
    let small = condensed(graph, &mut open, options)?;
    for pair in &mut open {
        pair.here = small.pair(pair.here);
    }
    let half = open.split_off(open.len() / 2);
    let of = |half| halved(&small.graph, half, base, options);
    let (one, other) = if open.len() < SHARE {
        (of(open), of(half))
    } else {
        rayon::join(|| of(open), || of(half))
    };
    Ok([one?, other?].concat())
}

/// What one pair takes, of which nothing else is known.
fn alone(
    graph: &Graph,
    one: Open,
    base: Base,
    options: &Options,
) -> Result<Vec<Loss>, VerdictError> {
    let verdict = decide(&without(graph, &[one.here]), options)?;
    let rank = shortfall(&verdict) - base.shortfall;
    let loss = Loss {
        pair: one.name,
        rank,
        strength: Strength::all([base.strength, verdict.rank_claim().strength]),
    };
    Ok(if rank == 0 { Vec::new() } else { vec![loss] })
}

/// A smaller graph with those of the pairs that are left: no rigid part of the rest holds them.
fn condensed(
    graph: &Graph,
    open: &mut Vec<Open>,
    options: &Options,
) -> Result<Condensation, VerdictError> {
    let mut gone: Vec<Pair> = open.iter().map(|pair| pair.here).collect();
    gone.sort_unstable();
    let rest = without(graph, &gone);
    let contraction = Contraction::new(&rest, options.question.model);
    let of_nodes = bodies_of_nodes(&contraction, graph.nodes());
    open.retain(|pair| !is_in_one(&of_nodes, pair.here));
    let bodies: Vec<&[u32]> = final_nodes(&contraction).collect();
    let small = chained(&bodies, &contraction.loose, open);
    if small.nodes.len() <= MOST_NODES + NODES_EACH * open.len() {
        return Ok(small);
    }
    let verdict = decide(&rest, options)?;
    let parts = Parts::new(&rest, &verdict);
    open.retain(|pair| !parts.are_together(pair.here.0, pair.here.1));
    let bodies: Vec<&[u32]> = parts.parts.iter().map(|part| &part.nodes[..]).collect();
    let links: Vec<Pair> = parts.links.iter().map(|&(pair, _)| pair).collect();
    Ok(chained(&bodies, &links, open))
}

fn chained(bodies: &[&[u32]], loose: &[Pair], open: &[Open]) -> Condensation {
    let pairs = || {
        let back = open.iter().map(|pair| pair.here);
        loose.iter().copied().chain(back)
    };
    let ends = pairs().flat_map(|(a, b)| [a, b]);
    Condensation::new(terminals(bodies, ends), pairs(), std::iter::empty())
}
