//! Growing bodies from triangles: a node seen from two nodes of a body joins it.

use super::body::{Body, Seed};
use super::position::Position;
use crate::graph::{Adjacency, Lists};

const NONE: u32 = u32::MAX;

/// What the growth knows of every node, for the body at hand. All of it side by side: the
/// neighbours of a node are anywhere in memory.
pub(super) struct Growth(Vec<Visit>);

#[derive(Clone, Copy)]
struct Visit {
    /// Twice the number of the last body whose edges have come to the node, and one more if the
    /// node joined it.
    stamp: u32,
    /// The node of that body that the first of these edges came from.
    from: u32,
    /// How many they are.
    edges: u32,
}

/// Grows bodies until the remaining edges contain no triangle, or none that is not on a line, and
/// removes the edges of every body from `remaining`.
///
/// Nodes are taken by falling degree, and a seed edge is looked for among the
/// neighbours of lower rank, so that looking costs O(m * arboricity) in all; growth
/// itself looks at each edge a constant number of times for each body at its ends, but never
/// through the neighbours of the node at hand, which are marked.
pub(super) fn grow(remaining: &mut Adjacency, at: &impl Position) -> Vec<Body> {
    let n = remaining.nodes();
    let (order, rank) = by_falling_degree(remaining);
    let mut state = Growth::new(n);
    let mut near = vec![NONE; n];
    let mut bodies: Vec<Body> = Vec::new();
    for &v in &order {
        for &w in remaining.neighbours(v) {
            near[w as usize] = v;
        }
        let before = bodies.len();
        let mut next = 0;
        // Neighbours refused once are refused for good, as edges only go.
        while let Some(&w) = remaining.neighbours(v).get(next) {
            next += 1;
            // The edge may have gone to a body meanwhile.
            let closes_triangle = near[w as usize] == v
                && rank[w as usize] > rank[v as usize]
                && remaining
                    .neighbours(w)
                    .iter()
                    .any(|&x| near[x as usize] == v && at.spans(v, w, x));
            if closes_triangle {
                let marked = Marked {
                    node: v,
                    near: &near,
                };
                let k = bodies.len() as u32;
                let grown = state.grow(vec![v, w], k, Some(marked), remaining, at);
                for &u in &grown.nodes {
                    near[u as usize] = NONE;
                }
                let seed = Seed::Edge(v.min(w), v.max(w));
                bodies.push(Body {
                    add: grown.add,
                    ..Body::new(seed, grown.nodes, grown.edges)
                });
            }
        }
        if bodies.len() > before {
            remaining.retain(v, |x| near[x as usize] == v);
        }
    }
    bodies
}

/// The nodes by falling degree, and where each node stands in that order.
pub(super) fn by_falling_degree(graph: &Adjacency) -> (Vec<u32>, Vec<u32>) {
    let nodes = 0..graph.nodes() as u32;
    let most = nodes.clone().map(|v| graph.degree(v)).max().unwrap_or(0);
    let by_degree = Lists::group(
        most + 1,
        nodes.map(|v| ((most - graph.degree(v)) as u32, v)),
    );
    let lists = (0..by_degree.len()).flat_map(|k| by_degree.of(k));
    let order: Vec<u32> = lists.copied().collect();
    let mut rank = vec![0u32; graph.nodes()];
    for (k, &v) in (0..).zip(&order) {
        rank[v as usize] = k;
    }
    (order, rank)
}

/// A node whose neighbours are marked, so that growth need not look through them for every body.
#[derive(Clone, Copy)]
pub(super) struct Marked<'a> {
    /// The node.
    pub(super) node: u32,
    /// The node again, at each neighbour by an edge that remains.
    pub(super) near: &'a [u32],
}

impl Marked<'_> {
    fn sees(&self, x: u32) -> bool {
        self.near[x as usize] == self.node
    }
}

/// Nodes that form a body, grown as far as edges go.
pub(super) struct Grown {
    /// The nodes: those it started from, then those that joined, in their order.
    pub(super) nodes: Vec<u32>,
    /// How each of these joined, as in [`Body::add`].
    pub(super) add: Vec<[u32; 3]>,
    /// How many edges it covers.
    pub(super) edges: usize,
}

impl Growth {
    pub(super) fn new(nodes: usize) -> Self {
        let never = Visit {
            stamp: NONE,
            from: NONE,
            edges: 0,
        };
        Self(vec![never; nodes])
    }

    /// Grows a body from some nodes until no node outside is seen twice, but on one line, and removes its edges
    /// from the lists of its nodes in `remaining`, except from that of the marked one, which is
    /// among those it starts from. `k` is a number that no other growth has.
    pub(super) fn grow(
        &mut self,
        mut nodes: Vec<u32>,
        k: u32,
        marked: Option<Marked>,
        remaining: &mut Adjacency,
        at: &impl Position,
    ) -> Grown {
        let is_marked = |v: u32| marked.is_some_and(|marked| marked.node == v);
        let seen_by_marked = |x: u32| marked.filter(|marked| marked.sees(x));
        let (reached, joined) = (2 * k, 2 * k + 1);
        let mut add = Vec::new();
        for &v in &nodes {
            self.0[v as usize] = Visit {
                stamp: joined,
                from: NONE,
                edges: u32::from(seen_by_marked(v).is_some()),
            };
        }
        let mut next = 0;
        while let Some(&u) = nodes.get(next) {
            next += 1;
            if is_marked(u) {
                continue;
            }
            for &x in remaining.neighbours(u) {
                let visit = &mut self.0[x as usize];
                if visit.stamp != joined && visit.stamp != reached {
                    let marked = seen_by_marked(x);
                    *visit = Visit {
                        stamp: reached,
                        from: marked.map_or(u, |marked| marked.node),
                        edges: 1,
                    };
                    if marked.is_none() {
                        continue;
                    }
                }
                visit.edges += 1;
                // All nodes that it was seen from and did not join by are on one line with it.
                if visit.stamp == reached && at.spans(x, visit.from, u) {
                    visit.stamp = joined;
                    nodes.push(x);
                    add.push([x, visit.from, u]);
                }
            }
        }
        // Every node of the body has been looked through by now, or is the marked one.
        let mut ends = 0;
        for &u in &nodes {
            ends += usize::from(seen_by_marked(u).is_some());
            if is_marked(u) {
                continue;
            }
            let inside = self.0[u as usize].edges as usize;
            ends += inside;
            if inside == remaining.degree(u) {
                remaining.clear(u);
            } else {
                remaining.retain(u, |x| self.0[x as usize].stamp != joined);
            }
        }
        Grown {
            nodes,
            add,
            edges: ends / 2,
        }
    }
}
