//! Pairs and images that a component hangs on.
//!
//! A pair of a component is weak if the component is not finite solvable without it: then it falls
//! apart. Most pairs are shown not to be weak by contraction (docs/theory.md, section 4): what no
//! merge uses can go. The others are left out together, then in halves of halves, each on a
//! condensation of the graph without all others of its half, and decided: one decision for a set of
//! pairs where that is enough.

mod decisions;
mod left_out;

use crate::parts::{Alone, Parts};
use rayon::prelude::*;
use std::collections::BTreeSet;
use viewcert::contract::{Contraction, Part as Joined, Seed};
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::{Adjacency, Lists};
use viewcert::watch::Step;
use viewcert::{Graph, Strength};

/// Why something is weak.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Without it this image has a single pair in its component.
    Hangs(u32),
    /// The component without it was decided: it falls apart.
    Decided,
    /// Without this other pair the component falls apart, by a count that is the same with
    /// the two pairs exchanged (docs/theory.md, Theorem 5.1).
    Counted((u32, u32)),
}

/// A pair, or an image, without which its component, or the rest of it, falls apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Weakness {
    /// The pair or the image.
    pub nodes: Vec<u32>,
    /// The component, by its place in the verdict.
    pub component: usize,
    /// Why.
    pub why: Why,
    /// How strong that is.
    pub strength: Strength,
}

/// The weak pairs, by component and then increasing. Pairs that are components by themselves are
/// left out: without them there is nothing to fall apart.
///
/// Where bodies are all that is needed, as in sequences, O(m + k log k) up to the logarithm of
/// sorting, for the k pairs that carry a merge: k is below 2 n. For cores two decisions for each pair
/// at worst, of condensations that shrink with the number of pairs that they are about where
/// separators are small, and far fewer where one count tells of many.
///
/// # Errors
/// Those of [`decide`](viewcert::decide()).
pub fn weak_pairs(
    graph: &Graph,
    parts: &Parts,
    options: &Options,
) -> Result<Vec<Weakness>, VerdictError> {
    let find = |part: &Graph| pairs_of(part, options);
    of_parts(graph, parts, find, |(a, b)| vec![a, b])
}

/// The weak images, by component and then increasing: the rest of the component, of three images or
/// more, is not finite solvable without them.
///
/// One contraction clears many images that are no pairs of each other: all that it leaves in one body with their
/// neighbours. The others are as [`weak_pairs`], in such sets.
///
/// # Errors
/// Those of [`decide`](viewcert::decide()).
pub fn weak_images(
    graph: &Graph,
    parts: &Parts,
    options: &Options,
) -> Result<Vec<Weakness>, VerdictError> {
    of_parts(graph, parts, |part| images_of(part, options), |v| vec![v])
}

/// What is found in each part by itself.
fn of_parts<T>(
    graph: &Graph,
    parts: &Parts,
    find: impl Fn(&Graph) -> Result<Vec<(T, Why, Strength)>, VerdictError> + Sync,
    nodes: impl Fn(T) -> Vec<u32> + Sync,
) -> Result<Vec<Weakness>, VerdictError> {
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        let global = |v: u32| alone.nodes[v as usize];
        let weak = find(&alone.graph)?.into_iter();
        let weak = weak.map(|(what, why, strength)| Weakness {
            nodes: nodes(what).into_iter().map(global).collect(),
            component: part.component,
            why: match why {
                Why::Hangs(v) => Why::Hangs(global(v)),
                Why::Counted(pair) => Why::Counted(alone.pair(pair)),
                Why::Decided => why,
            },
            strength,
        });
        Ok(weak.collect())
    });
    let found: Result<Vec<Vec<Weakness>>, VerdictError> = of_part.collect();
    Ok(found?.concat())
}

type Pair = (u32, u32);

/// The weak pairs of a component with three nodes or more, increasing.
fn pairs_of(graph: &Graph, options: &Options) -> Result<Vec<(Pair, Why, Strength)>, VerdictError> {
    let model = options.question.model;
    let neighbours = Adjacency::new(graph);
    let mut weak: Vec<(Pair, Why, Strength)> = Vec::new();
    for &(i, j) in graph.edges() {
        // A pair adds less to the rank (7; 2) than a node to the required one (11; 3).
        if let Some(v) = [i, j].into_iter().find(|&v| neighbours.degree(v) == 2) {
            weak.push(((i, j), Why::Hangs(v), Strength::Proof));
        }
    }
    let hanging: Vec<Pair> = weak.iter().map(|&(pair, ..)| pair).collect();
    let contraction = Contraction::new(graph, model);
    let candidates = used(&contraction).into_iter();
    let candidates = candidates.filter(|pair| hanging.binary_search(pair).is_err());
    // What is in no body now is in none with fewer pairs.
    let (loose, in_bodies): (Vec<Pair>, Vec<Pair>) =
        candidates.partition(|pair| contraction.loose.binary_search(pair).is_ok());
    let candidates = left_out::not_cleared(graph, in_bodies, options)?;
    weak.extend(decisions::weak(
        graph,
        [candidates, loose].concat(),
        options,
    )?);
    weak.sort_unstable_by_key(|&(pair, ..)| pair);
    Ok(weak)
}

/// The pairs that a contraction uses, and those that it leaves loose, increasing: every other pair
/// joins two nodes of a body that stands without it.
fn used(contraction: &Contraction) -> Vec<Pair> {
    let mut used: BTreeSet<Pair> = contraction.loose.iter().copied().collect();
    let ordered = |a: u32, b: u32| (a.min(b), a.max(b));
    for body in &contraction.bodies {
        if let Seed::Edge(a, b) = body.seed {
            used.insert(ordered(a, b));
        }
        used.extend(
            body.add
                .iter()
                .flat_map(|&[v, a, b]| [ordered(v, a), ordered(v, b)]),
        );
        for merge in &body.merge {
            used.extend(merge.parts().iter().filter_map(|part| match *part {
                Joined::Edge(a, b) => Some(ordered(a, b)),
                Joined::Body(_) => None,
            }));
        }
    }
    used.into_iter().collect()
}

fn check(graph: &Graph, options: &Options) -> Result<(), VerdictError> {
    let task = options.watch.task(Step::Contraction, graph.nodes());
    Ok(task.check()?)
}

/// The nodes of every final body, increasing.
fn final_nodes(contraction: &Contraction) -> impl Iterator<Item = &[u32]> + Clone {
    let finals = contraction.finals.iter();
    finals.map(|&body| &contraction.bodies[body as usize].nodes[..])
}

/// For every node the final bodies that it lies in, by their place in the list.
fn bodies_of_nodes(contraction: &Contraction, nodes: usize) -> Lists {
    let of_node = (0..).zip(final_nodes(contraction));
    let of_node = of_node.flat_map(|(k, nodes): (u32, _)| nodes.iter().map(move |&v| (v, k)));
    Lists::group(nodes, of_node)
}

/// Whether one body holds all of some nodes.
fn in_one_body(bodies: &Lists, nodes: &[u32]) -> bool {
    let of = |&v: &u32| bodies.of(v as usize);
    let mut first = of(&nodes[0]).iter();
    first.any(|body| nodes.iter().all(|v| of(v).binary_search(body).is_ok()))
}

/// The weak images of a component with three nodes or more, increasing.
fn images_of(graph: &Graph, options: &Options) -> Result<Vec<(u32, Why, Strength)>, VerdictError> {
    let n = graph.nodes() as u32;
    // Without an image of a triangle there is a pair, which is solvable.
    if n < 4 {
        return Ok(Vec::new());
    }
    let neighbours = Adjacency::new(graph);
    let mut weak = Vec::new();
    let mut open = Vec::new();
    for v in 0..n {
        let near = neighbours.neighbours(v).iter();
        match near.copied().find(|&u| neighbours.degree(u) == 2) {
            Some(u) => weak.push((v, Why::Hangs(u), Strength::Proof)),
            None => open.push(v),
        }
    }
    for set in independent(graph, left_out::images_not_cleared(graph, open, options)?) {
        let found = decisions::weak_images(graph, set, options)?.into_iter();
        weak.extend(found.map(|(v, strength)| (v, Why::Decided, strength)));
    }
    weak.sort_unstable_by_key(|&(v, ..)| v);
    Ok(weak)
}

/// Some nodes, given increasing, in sets without an edge in them, by greedy colouring.
fn independent(graph: &Graph, nodes: Vec<u32>) -> Vec<Vec<u32>> {
    let neighbours = Adjacency::new(graph);
    let mut colour = vec![usize::MAX; graph.nodes()];
    let mut sets: Vec<Vec<u32>> = Vec::new();
    for v in nodes {
        let near = neighbours.neighbours(v).iter();
        let taken: BTreeSet<usize> = near.map(|&u| colour[u as usize]).collect();
        let free = (0..).find(|k| !taken.contains(k)).expect("a colour");
        colour[v as usize] = free;
        if free == sets.len() {
            sets.push(Vec::new());
        }
        sets[free].push(v);
    }
    sets
}

#[cfg(test)]
mod tests;
