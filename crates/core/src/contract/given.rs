//! What contraction starts from: the known parts as bodies, and the graph without the edges that
//! they cover (docs/theory.md, Theorem 4.14).

use super::grow::Growth;
use super::{Body, Seed};
use crate::graph::{Adjacency, Graph, KnownParts, Lists};
use std::borrow::Cow;

/// A graph with its known parts.
pub(super) struct Given<'a> {
    /// The parts, in their order.
    pub(super) bodies: Vec<Body>,
    /// The edges that no part covers, on all nodes.
    pub(super) rest: Cow<'a, Graph>,
}

impl<'a> Given<'a> {
    /// Makes the parts bodies. Linear in the graph and the parts, and for every edge in the shorter
    /// list of parts at its ends; without parts the graph is left as it is.
    pub(super) fn new(graph: &'a Graph, parts: &KnownParts) -> Self {
        let mut bodies: Vec<Body> = parts.iter().map(body).collect();
        if parts.is_empty() {
            let rest = Cow::Borrowed(graph);
            return Self { bodies, rest };
        }
        let places: Vec<(u32, u32)> = (0..)
            .zip(parts.iter())
            .flat_map(|(k, part)| part.iter().map(move |&v| (v, k)))
            .collect();
        let parts_of = Lists::group(graph.nodes(), places.iter().copied());
        let mut rest = Vec::new();
        for &(i, j) in graph.edges() {
            match common(parts_of.of(i as usize), parts_of.of(j as usize)) {
                Some(part) => bodies[part as usize].edges += 1,
                None => rest.push((i, j)),
            }
        }
        let (rest, _) = Graph::from_pairs(graph.nodes() as u32, rest).expect("edges of a graph");
        let rest = Cow::Owned(rest);
        Self { bodies, rest }
    }
}

/// A part, before anything has joined it.
fn body(part: &[u32]) -> Body {
    Body {
        seed: Seed::Part,
        add: Vec::new(),
        merge: Vec::new(),
        nodes: part.to_vec(),
        edges: 0,
    }
}

/// A number that two increasing lists have in common. The shorter one is walked: a node may be in
/// very many parts.
fn common(one: &[u32], other: &[u32]) -> Option<u32> {
    let (short, long) = if one.len() <= other.len() {
        (one, other)
    } else {
        (other, one)
    };
    let in_both = |part: &&u32| long.binary_search(part).is_ok();
    short.iter().find(in_both).copied()
}

/// Grows the bodies by the edges that remain, the largest first, until none of them sees a node
/// twice, and removes the edges that they cover then. What has grown is a new body, which continues
/// the part.
///
/// O(sum of the degrees of the nodes of all bodies).
pub(super) fn grow(bodies: &mut Vec<Body>, remaining: &mut Adjacency) {
    let mut order: Vec<u32> = (0..bodies.len() as u32).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(bodies[k as usize].nodes.len()));
    let mut growth = Growth::new(remaining.nodes());
    for k in order {
        let part = &mut bodies[k as usize];
        let grown = growth.grow(std::mem::take(&mut part.nodes), k, None, remaining);
        if grown.add.is_empty() {
            part.nodes = grown.nodes;
            part.edges += grown.edges;
            continue;
        }
        let edges = std::mem::take(&mut part.edges) + grown.edges;
        bodies.push(Body {
            seed: Seed::Body(k),
            add: grown.add,
            merge: Vec::new(),
            nodes: grown.nodes,
            edges,
        });
    }
}
