//! Counting where the vectors of displacements are given (docs/theory.md, Theorem 13.22).
//!
//! In: a piece, and the scale of each of its core edges in a random motion. Out: a partition, and
//! its bound. All nodes of a group are one vertex here, as the groups are paid for first; a block
//! whose vectors agree around all cycles has a motion more than translations, like one without
//! displacements.

use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::evidence::{Block, Counting};
use crate::geometry::placed::Placed;
use crate::graph::{Hanging, UnionFind};
use std::collections::BTreeMap;

/// The partition into what the motion moves alike and what hangs together in vertices, with its
/// bound: the rank, if the motion is a random one.
pub(super) fn count(
    assembly: &Assembly,
    placed: &Placed,
    (members, core): (&Members, &Core),
    scales: &[u64],
) -> Counting {
    let mut sets = UnionFind::new(members.len());
    let mut first: BTreeMap<(u32, u64), usize> = BTreeMap::new();
    let edges = core.graph.edges().iter().zip(&core.owner).zip(scales);
    for ((&(i, j), &owner), &scale) in edges {
        for end in [i, j] {
            let vertex = placed.first(core.nodes[end as usize]);
            let other = *first.entry((vertex, scale)).or_insert(owner as usize);
            sets.union(other, owner as usize);
        }
    }
    let blocks = members.grouped(|member| sets.find(member));
    let vertices = vertices(assembly, placed, members);
    let groups = 3 * (assembly.count_nodes(members) - vertices.len());
    let bounds = blocks.iter().map(|block| bound(assembly, placed, block));
    Counting {
        bound: groups + bounds.sum::<usize>(),
        blocks: blocks
            .into_iter()
            .map(|members| Block { members, hub: None })
            .collect(),
    }
}

/// What a block adds to the rank of the groups at most.
fn bound(assembly: &Assembly, placed: &Placed, block: &Members) -> usize {
    let vertices = vertices(assembly, placed, block);
    let is_scaled = assembly.is_scaled(block) || !agrees(assembly, placed, block, &vertices);
    3 * vertices.len() - if is_scaled { 3 } else { 4 }
}

/// The vertices of some members, increasing.
fn vertices(assembly: &Assembly, placed: &Placed, members: &Members) -> Vec<u32> {
    let bodies = members.bodies.iter();
    let of_bodies = bodies.flat_map(|&body| assembly.nodes_of_body(body));
    let ends = members.edges.iter().flat_map(|(i, j)| [i, j]);
    let vertices = of_bodies.chain(ends).map(|&v| placed.first(v));
    let mut vertices: Vec<u32> = vertices.collect();
    crate::graph::sort_once(&mut vertices);
    vertices
}

/// Whether the vectors within groups add up to zero around all cycles of a block without scaled
/// bodies.
fn agrees(assembly: &Assembly, placed: &Placed, block: &Members, vertices: &[u32]) -> bool {
    let mut hanging = Hanging::new(vertices.len() as u32);
    let mut joins = |u: u32, v: u32| {
        let [x, y] = [u, v].map(|node| {
            let vertex = placed.first(node);
            vertices.partition_point(|&other| other < vertex) as u32
        });
        hanging.agrees((x, y), placed.between(u, v))
    };
    let mut of_bodies = block.bodies.iter().flat_map(|&body| {
        let nodes = assembly.nodes_of_body(body);
        nodes[1..].iter().map(|&v| (nodes[0], v))
    });
    of_bodies.all(|(u, v)| joins(u, v)) && block.edges.iter().all(|&(i, j)| joins(i, j))
}
