//! Growing bodies from triangles: a node seen from two nodes of a body joins it.

use super::{Body, Seed};
use crate::graph::Adjacency;

const NONE: u32 = u32::MAX;

/// What the growth knows of every node, for the body at hand.
struct Growth {
    /// The body at hand that the node has joined last.
    joined: Vec<u32>,
    /// The body at hand that has reached the node by one edge last...
    reached: Vec<u32>,
    /// ... and the node it was reached from.
    reached_from: Vec<u32>,
}

/// Grows bodies until the remaining edges contain no triangle, and removes the
/// edges of every body from `remaining`.
///
/// Nodes are taken by falling degree, and a seed edge is looked for among the
/// neighbours of lower rank, so that looking costs O(m * arboricity) in all; growth
/// itself looks at each edge a constant number of times for each body at its ends.
pub(super) fn grow(remaining: &mut Adjacency) -> Vec<Body> {
    let n = remaining.nodes();
    let mut order: Vec<u32> = (0..n as u32).collect();
    order.sort_by_key(|&v| std::cmp::Reverse(remaining.degree(v)));
    let mut rank = vec![0u32; n];
    for (k, &v) in (0..).zip(&order) {
        rank[v as usize] = k;
    }

    let mut state = Growth {
        joined: vec![NONE; n],
        reached: vec![NONE; n],
        reached_from: vec![0; n],
    };
    let mut near = vec![NONE; n];
    let mut refused_by = vec![NONE; n];
    let mut bodies: Vec<Body> = Vec::new();
    for &v in &order {
        for &w in remaining.neighbours(v) {
            near[w as usize] = v;
        }
        let mut at = 0;
        while let Some(&w) = remaining.neighbours(v).get(at) {
            let closes_triangle = rank[w as usize] > rank[v as usize]
                && remaining
                    .neighbours(w)
                    .iter()
                    .any(|&x| near[x as usize] == v);
            if !closes_triangle {
                refused_by[w as usize] = v;
                at += 1;
                continue;
            }
            let k = bodies.len() as u32;
            let body = state.grow_from(v, w, k, remaining);
            for &u in &body.nodes {
                near[u as usize] = NONE;
            }
            // Neighbours refused once are refused for good, as edges only go; the
            // body's own have left the list of v.
            at = remaining
                .neighbours(v)
                .partition_point(|&x| refused_by[x as usize] == v);
            bodies.push(body);
        }
    }
    bodies
}

impl Growth {
    /// Grows body number `k` from the edge v-w until no node outside is seen twice.
    fn grow_from(&mut self, v: u32, w: u32, k: u32, remaining: &mut Adjacency) -> Body {
        let mut nodes = vec![v, w];
        let mut add = Vec::new();
        self.joined[v as usize] = k;
        self.joined[w as usize] = k;
        let mut next = 0;
        while let Some(&u) = nodes.get(next) {
            next += 1;
            for &x in remaining.neighbours(u) {
                let x_at = x as usize;
                if self.joined[x_at] == k {
                    continue;
                }
                if self.reached[x_at] == k {
                    self.joined[x_at] = k;
                    nodes.push(x);
                    add.push([x, self.reached_from[x_at], u]);
                } else {
                    self.reached[x_at] = k;
                    self.reached_from[x_at] = u;
                }
            }
        }
        let mut ends = 0;
        for &u in &nodes {
            ends += remaining.degree(u);
            remaining.retain(u, |x| self.joined[x as usize] != k);
            ends -= remaining.degree(u);
        }
        Body {
            seed: Seed::Edge(v.min(w), v.max(w)),
            add,
            merge: Vec::new(),
            nodes,
            edges: ends / 2,
        }
    }
}
