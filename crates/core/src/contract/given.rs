//! What contraction starts from: known parts or groups of known displacements as bodies, and the
//! graph without the edges that they cover (docs/theory.md, Theorems 4.14 and 13.16).

use super::body::{Body, Seed};
use super::grow::Growth;
use super::position::Generic;
use crate::graph::{Adjacency, Graph, Lists};
use std::borrow::Cow;

/// A graph with what is known besides its pairs.
pub(super) struct Given<'a> {
    /// Known parts, or groups of known displacements, in their order.
    pub(super) bodies: Vec<Body>,
    /// The edges that none of them covers, on all nodes.
    pub(super) rest: Cow<'a, Graph>,
}

impl<'a> Given<'a> {
    /// Makes sets of nodes bodies, scaled ones if they are groups of displacements. Linear in the
    /// graph and the sets, and for every edge in the shorter list of sets at its ends; without sets
    /// the graph is left as it is.
    pub(super) fn new<'s>(
        graph: &'a Graph,
        sets: impl Iterator<Item = &'s [u32]>,
        scaled: bool,
    ) -> Self {
        let mut bodies: Vec<Body> = sets
            .map(|nodes| Body {
                scaled,
                ..Body::known(nodes)
            })
            .collect();
        if bodies.is_empty() {
            let rest = Cow::Borrowed(graph);
            return Self { bodies, rest };
        }
        let places: Vec<(u32, u32)> = (0..)
            .zip(&bodies)
            .flat_map(|(k, body)| body.nodes.iter().map(move |&v| (v, k)))
            .collect();
        let sets_of = Lists::group(graph.nodes(), places.iter().copied());
        let mut rest = Vec::new();
        for &(i, j) in graph.edges() {
            match common(sets_of.of(i as usize), sets_of.of(j as usize)) {
                Some(k) => bodies[k as usize].edges += 1,
                None => rest.push((i, j)),
            }
        }
        let (rest, _) = Graph::from_pairs(graph.nodes() as u32, rest).expect("edges of a graph");
        let rest = Cow::Owned(rest);
        Self { bodies, rest }
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
        let grown = growth.grow(
            std::mem::take(&mut part.nodes),
            k,
            None,
            remaining,
            &Generic,
        );
        if grown.add.is_empty() {
            part.nodes = grown.nodes;
            part.edges += grown.edges;
            continue;
        }
        let edges = std::mem::take(&mut part.edges) + grown.edges;
        bodies.push(Body {
            add: grown.add,
            // Only known displacements are of known scale, and their bodies grow otherwise.
            ..Body::new(Seed::Body(k), grown.nodes, edges)
        });
    }
}
