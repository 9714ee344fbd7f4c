//! Growing bodies from cycles of three and four edges, in the calibrated model.

use super::grow::{Growth, by_falling_degree};
use super::{Body, Merge, Part, Seed};
use crate::graph::Adjacency;

const NONE: u32 = u32::MAX;

/// A short cycle through the node and the neighbour at hand.
enum Closing {
    /// With a third node.
    Triangle,
    /// With the opposite node and another neighbour.
    Quadrilateral { opposite: u32, other: u32 },
}

/// What is known of every node while the paths of two edges from one node are walked.
struct Paths {
    /// Where the node stands among all by falling degree.
    rank: Vec<u32>,
    /// The node at hand, at its neighbours by an edge that remains.
    near: Vec<u32>,
    /// The node at hand, at the ends of paths...
    seen: Vec<u32>,
    /// ... and the inner node of the last path there.
    via: Vec<u32>,
}

impl Paths {
    /// Walks from `u` through its neighbour `p`, to nodes of lower rank, until a cycle closes.
    fn walk(&mut self, u: u32, p: u32, remaining: &Adjacency) -> Option<Closing> {
        for &w in remaining.neighbours(p) {
            let at = w as usize;
            // The node of highest rank finds a cycle; u itself is not lower either.
            if self.rank[at] <= self.rank[u as usize] {
                continue;
            }
            if self.near[at] == u {
                return Some(Closing::Triangle);
            }
            let other = self.via[at];
            if self.seen[at] == u && self.near[other as usize] == u {
                return Some(Closing::Quadrilateral { opposite: w, other });
            }
            self.seen[at] = u;
            self.via[at] = p;
        }
        None
    }
}

/// Grows bodies until the remaining edges contain no cycle of three or four, and removes the
/// edges of every body from `remaining`.
///
/// Each node, by falling degree, walks the paths of two edges that go through and to nodes of
/// lower rank, which are O(m * arboricity) in all (Chiba and Nishizeki 1985); the second path to
/// the same end closes a cycle. Growth itself looks at each edge a constant number of times for
/// each body at its ends.
pub(super) fn grow(remaining: &mut Adjacency) -> Vec<Body> {
    let n = remaining.nodes();
    let (order, rank) = by_falling_degree(remaining);
    let mut paths = Paths {
        rank,
        near: vec![NONE; n],
        seen: vec![NONE; n],
        via: vec![0; n],
    };
    let mut growth = Growth::new(n);
    let mut refused_by = vec![NONE; n];
    let mut bodies = Vec::new();
    for &u in &order {
        for &x in remaining.neighbours(u) {
            paths.near[x as usize] = u;
        }
        let mut at = 0;
        while let Some(&p) = remaining.neighbours(u).get(at) {
            let lower = paths.rank[p as usize] > paths.rank[u as usize];
            let closing = if lower {
                paths.walk(u, p, remaining)
            } else {
                None
            };
            let Some(closing) = closing else {
                refused_by[p as usize] = u;
                at += 1;
                continue;
            };
            push_body(&mut bodies, &mut growth, (u, p), &closing, remaining);
            let body: &Body = bodies.last().expect("just pushed");
            for &x in &body.nodes {
                paths.near[x as usize] = NONE;
            }
            // Neighbours refused once are refused for good, as edges only go; the body's own
            // have left the list of u.
            at = remaining
                .neighbours(u)
                .partition_point(|&x| refused_by[x as usize] == u);
        }
    }
    bodies
}

/// Appends the body that grows from a cycle with the edge u-p. As a body's merges come after its
/// growth, a cycle of four that grows is continued by a second body.
fn push_body(
    bodies: &mut Vec<Body>,
    growth: &mut Growth,
    (u, p): (u32, u32),
    closing: &Closing,
    remaining: &mut Adjacency,
) {
    let k = bodies.len() as u32;
    let &Closing::Quadrilateral { opposite, other } = closing else {
        bodies.push(growth.body_from_edge(u, p, k, remaining));
        return;
    };
    let grown = growth.grow(vec![u, p, opposite, other], k, remaining);
    bodies.push(Body {
        seed: Seed::Edge(u.min(p), u.max(p)),
        add: Vec::new(),
        merge: vec![Merge::Cycle {
            parts: [
                Part::edge(p, opposite),
                Part::edge(opposite, other),
                Part::edge(other, u),
            ],
            at: [p, opposite, other, u],
        }],
        nodes: Vec::new(),
        edges: 0,
    });
    if !grown.add.is_empty() {
        bodies.push(Body {
            seed: Seed::Body(k),
            add: grown.add,
            merge: Vec::new(),
            nodes: Vec::new(),
            edges: 0,
        });
    }
    let last = bodies.last_mut().expect("just pushed");
    last.nodes = grown.nodes;
    last.edges = grown.edges;
}
