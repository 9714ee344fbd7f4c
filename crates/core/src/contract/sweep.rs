//! Growing the few bodies that hold most edges, in the order in which edges are stored, in the
//! calibrated model.
//!
//! In: a graph. Out: bodies (docs/theory.md, Theorem 4.9), and the edges that none of them covers.
//! A graph keeps its edges by their smaller ends; a camera-point graph keeps the points by the
//! cameras that see them. Here edges are read in that way only: no lists of neighbours are made,
//! and an edge costs one look at its larger end. As no node knows the smaller nodes that see it,
//! bodies may stay smaller than they could be. That is no loss: `seeds` and `cycles` complete
//! them, and the closure does not depend on the order (Proposition 4.13).

use super::body::{Body, Merge, Part, Seed};
use super::general::General;
use crate::graph::Graph;

/// The body has no edge to the node so far.
const UNSEEN: u32 = u32::MAX;
/// The node is in the body.
const INSIDE: u32 = u32::MAX - 1;

/// Bodies are grown while they cover one edge in so many.
const SHARE: usize = 16;

/// In so many places a row is looked at before it is walked through.
const PROBES: usize = 32;

/// At most so many times the number of edges is looked at in vain.
const PATIENCE: usize = 2;

/// Large bodies, and the rest.
pub(super) struct Swept {
    /// The bodies; one without nodes is continued by the next.
    pub(super) bodies: Vec<Body>,
    /// The edges that no body covers, in no order.
    pub(super) left: Vec<(u32, u32)>,
}

/// Grows large bodies, behind those that are there already. O(n + m), as there are few of them.
///
/// # Panics
/// With 2^32 edges and more.
pub(super) fn grow(graph: &Graph, bodies: Vec<Body>, general: &General) -> Swept {
    let mut swept = Swept {
        bodies,
        left: Vec::new(),
    };
    let large = graph.edges().len().div_ceil(SHARE);
    let mut sweep = Sweep::new(graph, general);
    while sweep.waiting_edges() >= large {
        match sweep.body(&mut swept) {
            Some(covered) if covered >= large => (),
            _ => break,
        }
    }
    for &row in &sweep.waiting {
        swept.left.extend_from_slice(sweep.edges(row));
    }
    swept
}

/// A body that grows: what it starts from, and what has joined.
struct Growing {
    seed: Seed,
    /// The merge that makes a cycle of four edges of the seed.
    cycle: Option<Merge>,
    add: Vec<[u32; 3]>,
}

struct Sweep<'a> {
    graph: &'a Graph,
    general: &'a General,
    /// Where the edges from each node to larger ones, its *row*, begin; and the end of the last.
    /// Nodes without such edges have no row.
    starts: Vec<u32>,
    /// The rows of nodes that are in no body so far, increasing.
    waiting: Vec<u32>,
    /// Rows that no body starts from.
    fruitless: Vec<u32>,
    /// For every node [`UNSEEN`], [`INSIDE`], or the one node of the body that has an edge to it.
    seen: Vec<u32>,
    /// How many edges may still be looked at in vain.
    patience: usize,
}

impl<'a> Sweep<'a> {
    fn new(graph: &'a Graph, general: &'a General) -> Self {
        let edges = graph.edges();
        let mut starts = vec![0];
        let mut at = 0;
        while at < edges.len() {
            at += row_length(&edges[at..]);
            starts.push(u32::try_from(at).expect("fewer than 2^32 edges"));
        }
        Self {
            graph,
            general,
            waiting: (0..starts.len() as u32 - 1).collect(),
            starts,
            fruitless: Vec::new(),
            seen: vec![UNSEEN; graph.nodes()],
            patience: PATIENCE * edges.len(),
        }
    }

    fn edges(&self, row: u32) -> &'a [(u32, u32)] {
        let [from, to] = [0, 1].map(|k| self.starts[row as usize + k] as usize);
        &self.graph.edges()[from..to]
    }

    fn node(&self, row: u32) -> u32 {
        self.edges(row)[0].0
    }

    fn waiting_edges(&self) -> usize {
        self.waiting.iter().map(|&row| self.edges(row).len()).sum()
    }

    /// Grows one body. Returns how many edges it covers; nothing if none was found.
    fn body(&mut self, swept: &mut Swept) -> Option<usize> {
        let (mut growing, mut rows, mut order) = self.start()?;
        let mut before = usize::MAX;
        // Each pass goes the way of the one before backwards: a row that comes too early in one of
        // them comes after its neighbours in the other.
        while order.len() < before && self.patience > 0 {
            before = order.len();
            order.retain(|&row| {
                let joins = self.takes_in(row, &mut growing.add);
                if joins {
                    rows.push(row);
                }
                !joins
            });
            order.reverse();
        }
        order.sort_unstable();
        self.waiting = order;
        let edges: usize = rows.iter().map(|&row| self.edges(row).len()).sum();
        let left_before = swept.left.len();
        let mut nodes = Vec::with_capacity(growing.add.len() + 4);
        for (v, seen) in (0..).zip(&mut self.seen) {
            match std::mem::replace(seen, UNSEEN) {
                UNSEEN => (),
                INSIDE => nodes.push(v),
                // The only edge to the node in the rows of the body.
                from => swept.left.push((from, v)),
            }
        }
        let covered = edges - (swept.left.len() - left_before);
        growing.finish(nodes, covered, &mut swept.bodies);
        Some(covered)
    }

    /// A cycle of three or four edges at the node of the longest row possible: what grows, its two
    /// rows, which have been taken in, and the other ones, those nearest to the first.
    fn start(&mut self) -> Option<(Growing, Vec<u32>, Vec<u32>)> {
        while self.patience > 0 {
            let may_start = |row: &&u32| !self.fruitless.contains(row);
            let candidates = self.waiting.iter().filter(may_start);
            let &first = candidates.max_by_key(|&&row| self.edges(row).len())?;
            let at = self.waiting.partition_point(|&row| row < first);
            let after = self.waiting[at + 1..].iter();
            let mut order: Vec<u32> = after
                .chain(self.waiting[..at].iter().rev())
                .copied()
                .collect();
            let node = self.node(first);
            self.seen[node as usize] = INSIDE;
            // Nothing was seen before, so nothing joins.
            self.spread(first, &mut Vec::new());
            for k in 0..order.len() {
                let row = order[k];
                if let Some((seed, cycle)) = self.closing(first, row) {
                    order.remove(k);
                    let add = Vec::new();
                    let mut growing = Growing { seed, cycle, add };
                    self.spread(row, &mut growing.add);
                    return Some((growing, vec![first, row], order));
                }
            }
            for &(v, x) in self.edges(first) {
                self.seen[v as usize] = UNSEEN;
                self.seen[x as usize] = UNSEEN;
            }
            self.fruitless.push(first);
        }
        None
    }

    /// A cycle of three or four edges with the nodes of two rows, the first of which has been taken
    /// in and nothing else; takes its nodes in.
    fn closing(&mut self, first: u32, row: u32) -> Option<(Seed, Option<Merge>)> {
        let (a, b) = (self.node(first), self.node(row));
        let edge = (a.min(b), a.max(b));
        let joined = self.graph.edge_number(a, b).is_some();
        let edges = self.edges(row).iter();
        let mut common = edges.filter(|&&(_, x)| self.seen[x as usize] == a);
        let (p, q) = (common.next(), common.next());
        self.patience = self.patience.saturating_sub(self.edges(row).len());
        let &(_, p) = p?;
        if joined {
            self.seen[b as usize] = INSIDE;
            // The common neighbours join as soon as the row is taken in.
            return Some((Seed::Edge(edge.0, edge.1), None));
        }
        let &(_, q) = q?;
        if !self.general.holds(&[a, p, b, q]) {
            return None;
        }
        for v in [b, p, q] {
            self.seen[v as usize] = INSIDE;
        }
        let cycle = Merge::Cycle {
            parts: [Part::edge(p, b), Part::edge(b, q), Part::edge(q, a)],
            at: [p, b, q, a],
        };
        Some((Seed::Edge(a.min(p), a.max(p)), Some(cycle)))
    }

    /// Takes in the node of a row, if it is seen from two nodes of the body or is one, and what
    /// joins by its edges. Returns whether it was.
    fn takes_in(&mut self, row: u32, add: &mut Vec<[u32; 3]>) -> bool {
        let node = self.node(row);
        let known = self.seen[node as usize];
        if known != INSIDE {
            let Some([a, b]) = self.two_inside(row, known) else {
                return false;
            };
            self.seen[node as usize] = INSIDE;
            add.push([node, a, b]);
        }
        self.spread(row, add);
        true
    }

    /// Two nodes of the body with an edge to the node of a row; `known` is one if it is a node.
    fn two_inside(&mut self, row: u32, known: u32) -> Option<[u32; 2]> {
        let edges = self.edges(row);
        let inside = |x: &u32| self.seen[*x as usize] == INSIDE;
        let ends = |step| edges.iter().step_by(step).map(|&(_, x)| x);
        let step = edges.len().div_ceil(PROBES);
        if !ends(step).any(|x| inside(&x)) {
            self.patience = self.patience.saturating_sub(edges.len().min(PROBES));
            return None;
        }
        let before = Some(known).filter(|&known| known != UNSEEN);
        let mut found = before.into_iter().chain(ends(1).filter(inside));
        if let (Some(a), Some(b)) = (found.next(), found.next()) {
            return Some([a, b]);
        }
        self.patience = self.patience.saturating_sub(edges.len());
        None
    }

    /// Looks from a node of the body along its row: what was seen before joins.
    fn spread(&mut self, row: u32, add: &mut Vec<[u32; 3]>) {
        for &(u, x) in self.edges(row) {
            let seen = &mut self.seen[x as usize];
            match *seen {
                INSIDE => (),
                UNSEEN => *seen = u,
                from => {
                    *seen = INSIDE;
                    add.push([x, from, u]);
                }
            }
        }
    }
}

impl Growing {
    /// The body, and the one that it continues: the merges of a body come after all that joins it.
    fn finish(self, nodes: Vec<u32>, edges: usize, bodies: &mut Vec<Body>) {
        let mut seed = self.seed;
        let mut merge = Vec::from_iter(self.cycle);
        if !merge.is_empty() && !self.add.is_empty() {
            bodies.push(Body {
                merge: std::mem::take(&mut merge),
                ..Body::new(seed, Vec::new(), 0)
            });
            seed = Seed::Body(bodies.len() as u32 - 1);
        }
        bodies.push(Body {
            add: self.add,
            merge,
            ..Body::new(seed, nodes, edges)
        });
    }
}

/// How many of the first edges, one at least, have the same smaller end.
fn row_length(edges: &[(u32, u32)]) -> usize {
    let node = edges[0].0;
    let mut within = 1;
    while edges.get(within).is_some_and(|&(v, _)| v == node) {
        within *= 2;
    }
    let end = within.min(edges.len());
    within / 2 + edges[within / 2..end].partition_point(|&(v, _)| v == node)
}
