//! Clearing pairs and images by nodes that are left out together.
//!
//! Let a node have three pairs with a body that stands without the node. Without any one of the
//! three the node joins the body by the other two (docs/theory.md, Theorem 4.1, rule 3), so none of
//! them is weak. Nodes that are pairwise no pairs can be left out at once, as they are no part of
//! each other's bodies: in a camera-point graph half of all points. So two contractions clear
//! the observations of points with three views and more where tracks abound.
//!
//! A node whose neighbours all lie in one such body is not weak: motions of the rest move that body as a whole,
//! and the node along with it.

use super::{Pair, bodies_of_nodes, check, in_one_body, independent};
use viewcert::Graph;
use viewcert::contract::Contraction;
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::{Adjacency, Lists};

/// In how many shares nodes are left out: halves, and what that does not clear in eighths.
const SHARES: [usize; 2] = [2, 8];

/// Pairs with a body that clear each other.
const ENOUGH: usize = 3;

/// In how many shares sets of images are left out once less than half of one set is cleared.
const THIN: usize = 4;

/// Fewer images than this are decided at once: a contraction for few of them clears too little.
const FEW: usize = 64;

const NONE: u32 = u32::MAX;

/// Those of some images, given increasing, that are not cleared so: by few of them at a time if there is no body
/// without many. A contraction for each set and share, again for the rest as long as half are cleared.
///
/// # Errors
/// If the work is stopped.
pub(super) fn images_not_cleared(
    graph: &Graph,
    mut images: Vec<u32>,
    options: &Options,
) -> Result<Vec<u32>, VerdictError> {
    let neighbours = Adjacency::new(graph);
    let mut is_thin = false;
    loop {
        let before = images.len();
        let mut left = Vec::new();
        let mut sets = independent(graph, images);
        sets.reverse();
        while let Some(set) = sets.pop() {
            let thin = THIN.min(1 + set.len() / 16);
            let shares = if is_thin { thin } else { 1 };
            let mut open = Vec::new();
            for share in 0..shares {
                check(graph, options)?;
                let out = set.iter().skip(share).step_by(shares).copied();
                let bodies = bodies_without(graph, out.clone(), options);
                open.extend(out.filter(|&v| !in_one_body(&bodies, neighbours.neighbours(v))));
            }
            if is_thin || 2 * open.len() <= set.len() {
                left.extend(open);
            } else {
                is_thin = true;
                sets.push(open);
            }
        }
        left.sort_unstable();
        images = left;
        if images.len() < FEW || 2 * images.len() > before {
            return Ok(images);
        }
    }
}

/// Those of some pairs of a graph that are not cleared so. Ten contractions of the graph, at most.
///
/// # Errors
/// If the work is stopped.
pub(super) fn not_cleared(
    graph: &Graph,
    mut pairs: Vec<Pair>,
    options: &Options,
) -> Result<Vec<Pair>, VerdictError> {
    let neighbours = Adjacency::new(graph);
    let apart = pairwise_no_pairs(&neighbours);
    // In a graph of pairs of images these are few, and few pairs are theirs.
    if 2 * apart.len() < graph.nodes() {
        return Ok(pairs);
    }
    for shares in SHARES {
        for share in 0..shares {
            if pairs.is_empty() {
                return Ok(pairs);
            }
            check(graph, options)?;
            let out = apart.iter().skip(share).step_by(shares).copied();
            pairs = not_cleared_without(graph, &neighbours, out, pairs, options);
        }
    }
    Ok(pairs)
}

/// Many nodes that are pairwise no pairs, those with few pairs first.
fn pairwise_no_pairs(neighbours: &Adjacency) -> Vec<u32> {
    let mut order: Vec<u32> = (0..neighbours.nodes() as u32).collect();
    order.sort_by_key(|&v| neighbours.degree(v));
    let mut is_near = vec![false; neighbours.nodes()];
    order.retain(|&v| {
        let free = !is_near[v as usize];
        if free {
            for &w in neighbours.neighbours(v) {
                is_near[w as usize] = true;
            }
        }
        free
    });
    order
}

/// As [`not_cleared`], by the nodes `out`.
fn not_cleared_without(
    graph: &Graph,
    neighbours: &Adjacency,
    out: impl Iterator<Item = u32> + Clone,
    mut pairs: Vec<Pair>,
    options: &Options,
) -> Vec<Pair> {
    let bodies = bodies_without(graph, out.clone(), options);
    // For every node left out the body that it has most pairs with, if these are enough.
    let mut anchor = vec![NONE; graph.nodes()];
    let mut at = Vec::new();
    for v in out {
        at.clear();
        let near = neighbours.neighbours(v).iter();
        at.extend(near.flat_map(|&w| bodies.of(w as usize)).copied());
        at.sort_unstable();
        let most = at.chunk_by(|a, b| a == b).max_by_key(|same| same.len());
        if let Some(same) = most.filter(|same| same.len() >= ENOUGH) {
            anchor[v as usize] = same[0];
        }
    }
    let holds = |v: u32, w: u32| {
        let anchor = anchor[v as usize];
        anchor != NONE && bodies.of(w as usize).contains(&anchor)
    };
    pairs.retain(|&(a, b)| !holds(a, b) && !holds(b, a));
    pairs
}

/// For every node the final bodies of the graph without some nodes.
fn bodies_without(graph: &Graph, out: impl Iterator<Item = u32>, options: &Options) -> Lists {
    let mut is_out = vec![false; graph.nodes()];
    out.for_each(|v| is_out[v as usize] = true);
    let edges = graph.edges().iter().copied();
    let edges = edges.filter(|&(a, b)| !is_out[a as usize] && !is_out[b as usize]);
    let rest = Graph::new(graph.nodes() as u32, edges).expect("edges of a graph");
    let contraction = Contraction::new(&rest, options.question.model);
    bodies_of_nodes(&contraction, graph.nodes())
}
