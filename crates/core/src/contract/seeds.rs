//! Growing bodies from cycles of three and four edges, in the calibrated model.

use super::body::{Body, Merge, Part, Seed};
use super::grow::{Growth, Marked, by_falling_degree};
use super::position::Generic;
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
    fn is_lower(&self, v: u32, u: u32) -> bool {
        self.rank[v as usize] > self.rank[u as usize]
    }

    /// Walks from `u` through its neighbour `p`, to nodes of lower rank, until a cycle closes.
    fn walk(
        &mut self,
        u: u32,
        p: u32,
        remaining: &Adjacency,
        may_close: &impl Fn([u32; 4]) -> bool,
    ) -> Option<Closing> {
        for &w in remaining.neighbours(p) {
            let at = w as usize;
            // The node of highest rank finds a cycle; u is not lower than itself either.
            if !self.is_lower(w, u) {
                continue;
            }
            if self.near[at] == u {
                return Some(Closing::Triangle);
            }
            let other = self.via[at];
            let closes = self.seen[at] == u && self.near[other as usize] == u;
            if closes && may_close([u, p, w, other]) {
                return Some(Closing::Quadrilateral { opposite: w, other });
            }
            self.seen[at] = u;
            self.via[at] = p;
        }
        None
    }
}

/// Grows bodies until the remaining edges contain no cycle of three or four, and removes the
/// edges of every body from `remaining`. A cycle of four that may not close stays, and so may others
/// that run through two of its nodes.
///
/// Each node, by falling degree, walks the paths of two edges that go through and to nodes of
/// lower rank, which are O(m * arboricity) in all (Chiba and Nishizeki 1985); the second path to
/// the same end closes a cycle. Growth looks at each edge a constant number of times for each body
/// at its ends, but never through the neighbours of the node that walks, which may have many
/// bodies and many more neighbours.
pub(super) fn grow(remaining: &mut Adjacency, may_close: impl Fn([u32; 4]) -> bool) -> Vec<Body> {
    let n = remaining.nodes();
    let (order, rank) = by_falling_degree(remaining);
    let mut paths = Paths {
        rank,
        near: vec![NONE; n],
        seen: vec![NONE; n],
        via: vec![0; n],
    };
    let mut growth = Growth::new(n);
    let mut bodies = Vec::new();
    for &u in &order {
        for &x in remaining.neighbours(u) {
            paths.near[x as usize] = u;
        }
        let before = bodies.len();
        let mut next = 0;
        while let Some(&p) = remaining.neighbours(u).get(next) {
            next += 1;
            // The edge may have gone to a body meanwhile.
            let remains = paths.near[p as usize] == u;
            if remains
                && paths.is_lower(p, u)
                && let Some(closing) = paths.walk(u, p, remaining, &may_close)
            {
                let marked = Marked {
                    node: u,
                    near: &paths.near,
                };
                let k = bodies.len() as u32;
                bodies.extend(body(&mut growth, marked, p, &closing, k, remaining));
                let body = bodies.last().expect("one at least");
                for &x in &body.nodes {
                    paths.near[x as usize] = NONE;
                }
            }
        }
        if bodies.len() > before {
            remaining.retain(u, |x| paths.near[x as usize] == u);
        }
    }
    bodies
}

/// The body that grows from a cycle with the edge from the marked node to `p`. As a body's merges
/// come after its growth, a cycle of four that grows is a body by itself, continued by a second.
fn body(
    growth: &mut Growth,
    marked: Marked,
    p: u32,
    closing: &Closing,
    k: u32,
    remaining: &mut Adjacency,
) -> impl Iterator<Item = Body> + use<> {
    let u = marked.node;
    let (start, merge) = match *closing {
        Closing::Triangle => (vec![u, p], Vec::new()),
        Closing::Quadrilateral { opposite, other } => {
            let cycle = Merge::Cycle {
                parts: [
                    Part::edge(p, opposite),
                    Part::edge(opposite, other),
                    Part::edge(other, u),
                ],
                at: [p, opposite, other, u],
            };
            (vec![u, p, opposite, other], vec![cycle])
        }
    };
    let grown = growth.grow(start, k, Some(marked), remaining, &Generic);
    let seed = Seed::Edge(u.min(p), u.max(p));
    let is_continued = !merge.is_empty() && !grown.add.is_empty();
    let cycle = is_continued.then(|| Body {
        merge: merge.clone(),
        ..Body::new(seed, Vec::new(), 0)
    });
    let seed = if is_continued { Seed::Body(k) } else { seed };
    let whole = Body {
        add: grown.add,
        merge: if is_continued { Vec::new() } else { merge },
        ..Body::new(seed, grown.nodes, grown.edges)
    };
    cycle.into_iter().chain([whole])
}
