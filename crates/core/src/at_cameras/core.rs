//! Cores at given centres (docs/theory.md, Theorem 16.2): frames in the place of bodies.

use super::centres::Centres;
use crate::contract::piece::{Core, Members};
use crate::contract::{Contraction, Position};
use crate::graph::Graph;

/// The core of some members. O(k log k) for all nodes of the members.
pub(super) fn core(contraction: &Contraction, part: &Members, at: &Centres) -> Core {
    let body = |k: &u32| &contraction.bodies[*k as usize].nodes[..];
    let mut of_bodies: Vec<u32> = part.bodies.iter().flat_map(body).copied().collect();
    of_bodies.sort_unstable();
    let twice = of_bodies.windows(2).filter(|pair| pair[0] == pair[1]);
    let ends = part.edges.iter().flat_map(|&(i, j)| [i, j]);
    let mut nodes: Vec<u32> = twice.map(|pair| pair[0]).chain(ends.clone()).collect();
    crate::graph::sort_once(&mut nodes);
    let frames = part.bodies.iter().map(|k| frame(body(k), &nodes, at));
    let frames: Vec<Vec<(u32, u32)>> = frames.collect();
    let more = frames.iter().flatten().flat_map(|&(a, b)| [a, b]);
    nodes.extend(more);
    crate::graph::sort_once(&mut nodes);

    let number = |v: u32| nodes.binary_search(&v).expect("a node of the core") as u32;
    let edges = frames.iter().chain([&part.edges]).zip(0u32..);
    let mut pairs: Vec<(u32, u32, u32)> = Vec::new();
    for (frame, first) in edges {
        for (&(a, b), k) in frame.iter().zip(0u32..) {
            let is_loose = first as usize == part.bodies.len();
            let member = if is_loose { first + k } else { first };
            let (a, b) = (number(a), number(b));
            pairs.push((a.min(b), a.max(b), member));
        }
    }
    pairs.sort_unstable();
    let owner = pairs.iter().map(|&(_, _, member)| member).collect();
    let pairs = pairs.into_iter().map(|(a, b, _)| (a, b)).collect();
    let (graph, merged) =
        Graph::from_pairs(nodes.len() as u32, pairs).expect("pairs of different nodes");
    assert_eq!(merged, 0, "two members share two nodes that are apart");
    of_bodies.extend(ends);
    crate::graph::sort_once(&mut of_bodies);
    Core {
        total_nodes: of_bodies.len(),
        nodes,
        graph,
        owner,
        scales: Vec::new(),
        known: Vec::new(),
    }
}

/// The pairs of a body's nodes that hold it in the core: a frame of those among `shared`, and of such as
/// they need besides (Theorem 16.2 (c)). Both lists increase.
fn frame(body: &[u32], shared: &[u32], at: &Centres) -> Vec<(u32, u32)> {
    let is_shared = |v: &&u32| shared.binary_search(v).is_ok();
    let mut inside: Vec<u32> = body.iter().filter(is_shared).copied().collect();
    let first = |inside: &[u32], rank: usize| {
        let all = |v: u32| at.rank(&[inside, &[v]].concat());
        body.iter().copied().find(|&v| all(v) == rank)
    };
    if at.rank(&inside) < 2 {
        inside.extend(first(&inside, at.rank(&inside) + 1));
    }
    // A part may hold a body alone with none of its nodes shared.
    if at.rank(&inside) < 2 {
        inside.extend(first(&inside, 2));
    }
    if inside.len() > 2 && at.rank(&inside) < 3 {
        inside.extend(first(&inside, 3));
    }
    inside.sort_unstable();
    let a = inside[0];
    let b = inside.iter().copied().find(|&v| at.apart(a, v));
    let b = b.expect("a body has two places");
    let c = inside.iter().copied().find(|&v| at.spans(a, b, v));
    let mut pairs = vec![(a, b)];
    for &v in inside.iter().filter(|&&v| v != a && v != b) {
        let on_line = !at.spans(a, b, v);
        let third = if on_line { c.expect("off the line") } else { b };
        let first = if at.apart(a, v) { a } else { b };
        pairs.extend([(v, first), (v, third)]);
    }
    pairs
}
