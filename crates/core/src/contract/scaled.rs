//! Bodies that hold known displacements, in the calibrated model (docs/theory.md, Theorem 13.16).
//!
//! In: bodies, of which the groups of displacements are the first. Out: the same, closed under the
//! rule that is theirs alone: scaled bodies that share one node are one.

use super::body::{Body, Merge, Part, Seed};
use crate::graph::Lists;
use std::collections::VecDeque;

/// Merges scaled bodies that share a node, until there are none. New bodies are appended, the
/// consumed ones lose their nodes. Returns whether anything was merged. O(n + nodes of bodies).
pub(super) fn join(bodies: &mut Vec<Body>, nodes: usize) -> bool {
    let is_scaled = |&k: &u32| {
        let body = &bodies[k as usize];
        body.scaled && !body.nodes.is_empty()
    };
    let scaled: Vec<u32> = (0..bodies.len() as u32).filter(is_scaled).collect();
    if scaled.len() < 2 {
        return false;
    }
    let pairs = scaled.iter().flat_map(|&k| {
        let nodes = bodies[k as usize].nodes.iter();
        nodes.map(move |&v| (v, k))
    });
    let holders = Lists::group(nodes, pairs);
    let mut taken = vec![false; bodies.len()];
    let before = bodies.len();
    for first in scaled {
        if !std::mem::replace(&mut taken[first as usize], true) {
            let merge = touching(bodies, &holders, &mut taken, first);
            if !merge.is_empty() {
                let body = merged(bodies, first, merge);
                bodies.push(body);
            }
        }
    }
    bodies.len() > before
}

/// The merges of all that hangs together with a body in nodes of scaled bodies.
fn touching(bodies: &[Body], holders: &Lists, taken: &mut [bool], first: u32) -> Vec<Merge> {
    let mut merges = Vec::new();
    let mut queue = VecDeque::from([first]);
    while let Some(k) = queue.pop_front() {
        for &v in &bodies[k as usize].nodes {
            for &other in holders.of(v as usize) {
                if !std::mem::replace(&mut taken[other as usize], true) {
                    let part = Part::Body(other);
                    merges.push(Merge::Scaled { part, at: [v] });
                    queue.push_back(other);
                }
            }
        }
    }
    merges
}

/// The body that continues the first one by these merges.
fn merged(bodies: &mut [Body], first: u32, merge: Vec<Merge>) -> Body {
    let others = merge.iter().filter_map(|merge| match merge {
        Merge::Scaled {
            part: Part::Body(k),
            ..
        } => Some(*k),
        _ => None,
    });
    let all: Vec<u32> = std::iter::once(first).chain(others).collect();
    let (mut nodes, mut edges) = (Vec::new(), 0);
    for k in all {
        let body = &mut bodies[k as usize];
        nodes.append(&mut body.nodes);
        edges += std::mem::take(&mut body.edges);
    }
    crate::graph::sort_once(&mut nodes);
    Body {
        seed: Seed::Body(first),
        add: Vec::new(),
        merge,
        nodes,
        edges,
        scaled: true,
    }
}
