//! Merging five members or six in the projective model: around a K_{2,3} (docs/theory.md, Theorem
//! 10.3), a tripod or a link (Theorems 19.7 and 19.8).
//!
//! In: bodies and loose edges of which no two share two nodes and no three pairwise share one. Out:
//! new bodies. In a K_{2,3} two nodes a, b are joined to each of three others, a by the one
//! member, b by another. In a tripod a node is joined to a body by one member, and by two ways of two
//! members; if both ways end in one node, that is a K_{2,3}. In a link two bodies are joined by two
//! members, and by a way of two. That members differ and that ways are in general position follows
//! from what goes in (Propositions 10.12 and 19.9). A call uses a member in one merge only, but for the body
//! that finds the others: it grows by many, as long as they lie outside of what it has grown to. Whoever calls
//! closes under the other rules again and comes back.

use super::body::{Body, Merge, Part, Seed};
use crate::graph::{Graph, Lists, prune_leaves};
use std::cell::Cell;
use std::collections::HashMap;

/// How many steps the searches in one graph may take together.
///
/// Bodies with many nodes in many others have more ways between them than is of use. Where the
/// steps end, members are left that could be merged: cores are larger then, and nothing is wrong.
pub(super) struct Steps(Cell<u64>);

impl Steps {
    /// Linear in the graph, and enough for all small ones.
    pub(super) fn new(graph: &Graph) -> Self {
        let linear = 64 * (graph.nodes() + graph.edges().len()) as u64;
        Self(Cell::new((1 << 23) + linear))
    }

    /// Takes so many steps; whether they were left.
    fn take(&self, steps: usize) -> bool {
        let left = self.0.get().checked_sub(steps as u64);
        self.0.set(left.unwrap_or(0));
        left.is_some()
    }
}

/// Merges wherever the rule applies and no member is used twice. New bodies are appended; the
/// consumed ones lose their nodes. Returns whether there are new ones.
///
/// The largest member finds the others, so a body is only searched by larger ones. Where nothing is
/// left to be found so, the body of a tripod finds larger members too, in as many steps.
pub(super) fn merge(
    bodies: &mut Vec<Body>,
    loose: &[(u32, u32)],
    nodes: usize,
    steps: &[Steps; 2],
) -> bool {
    let left = bodies.iter().filter(|body| !body.nodes.is_empty()).count() + loose.len();
    if left < 5 {
        return false;
    }
    let mut search = Search::new(bodies, loose, nodes, &steps[0]);
    search.search_bodies();
    search.search_edges();
    if search.found.is_empty() {
        (search.steps, search.is_limited) = (&steps[1], false);
        search.search_bodies();
    }
    let Search { part, found, .. } = search;
    let members = part.len() as u32;
    let node = |place: u32| place - members;
    for found in found.chunk_by(|one, other| one.members[0] == other.members[0]) {
        let merges = found.iter().map(|found| {
            let [_, parts @ ..] = found.members.map(|member| part[member as usize]);
            match found.at {
                At::Biclique(at) => Merge::Biclique {
                    parts,
                    at: at.map(node),
                },
                At::Tripod(at) => Merge::Tripod {
                    parts,
                    at: at.map(node),
                },
                At::Link(at) => Merge::Link {
                    parts,
                    at: at.map(node),
                },
            }
        });
        let first = part[found[0].members[0] as usize];
        let body = merged(bodies, first, merges.collect());
        bodies.push(body);
    }
    !found.is_empty()
}

/// The body of a part and those that are merged with it, which are taken from the list.
fn merged(bodies: &mut [Body], first: Part, merge: Vec<Merge>) -> Body {
    let mut take = |part: Part| match part {
        Part::Edge(i, j) => (vec![i, j], 0),
        Part::Body(k) => {
            let body = &mut bodies[k as usize];
            let nodes = std::mem::take(&mut body.nodes);
            (nodes, std::mem::take(&mut body.edges))
        }
    };
    let (mut nodes, mut edges) = take(first);
    for &part in merge.iter().flat_map(Merge::parts) {
        let (more, covered) = take(part);
        nodes.extend(more);
        edges += covered;
    }
    crate::graph::sort_once(&mut nodes);
    let seed = match first {
        Part::Edge(i, j) => Seed::Edge(i, j),
        Part::Body(k) => Seed::Body(k),
    };
    Body {
        merge,
        ..Body::new(seed, nodes, edges)
    }
}

/// A body or edge and what is merged with it, in the order of [`Merge`].
struct Found {
    members: [u32; 6],
    at: At,
}

/// The nodes of a merge.
enum At {
    Biclique([u32; 5]),
    Tripod([u32; 6]),
    Link([u32; 7]),
}

/// How a search from a body has come to a node outside: from its node, through a member.
#[derive(Clone, Copy)]
struct Reach {
    from: u32,
    member: u32,
}

/// Members and the nodes that they share. Both are places: members first, then nodes.
struct Search<'a> {
    /// What the member is in a record; bodies first.
    part: Vec<Part>,
    /// How many members are bodies.
    bodies: usize,
    /// The shared nodes of every member, the members at every node; without what lies on no cycle.
    incidence: Lists,
    used: Vec<bool>,
    /// For every node the body that last took it in.
    taken: Vec<u32>,
    found: Vec<Found>,
    steps: &'a Steps,
    /// Whether a body is searched by larger ones only.
    is_limited: bool,
}

impl<'a> Search<'a> {
    fn new(bodies: &[Body], loose: &[(u32, u32)], nodes: usize, steps: &'a Steps) -> Self {
        let finals = || (0..).zip(bodies).filter(|(_, body)| !body.nodes.is_empty());
        let part: Vec<Part> = finals()
            .map(|(k, _)| Part::Body(k))
            .chain(loose.iter().map(|&(i, j)| Part::Edge(i, j)))
            .collect();
        let members = part.len();
        let edges = (members - loose.len()) as u32..;
        let mut pairs: Vec<(u32, u32)> = (0..)
            .zip(finals())
            .flat_map(|(member, (_, body))| body.nodes.iter().map(move |&v| (member, v)))
            .chain(
                edges
                    .zip(loose)
                    .flat_map(|(member, &(i, j))| [(member, i), (member, j)]),
            )
            .collect();
        let mut count = vec![0u8; nodes];
        for &(_, v) in &pairs {
            count[v as usize] = count[v as usize].saturating_add(1);
        }
        pairs.retain(|&(_, v)| count[v as usize] > 1);
        let place = |v: u32| members as u32 + v;
        let both_ways = pairs
            .iter()
            .flat_map(|&(member, v)| [(member, place(v)), (place(v), member)]);
        let mut incidence = Lists::group(members + nodes, both_ways);
        prune_leaves(&mut incidence, |_| false);
        Self {
            bodies: members - loose.len(),
            used: vec![false; members],
            taken: vec![u32::MAX; nodes],
            part,
            incidence,
            found: Vec::new(),
            steps,
            is_limited: true,
        }
    }

    fn of(&self, place: u32) -> &[u32] {
        self.incidence.of(place as usize)
    }

    fn is_free(&self, member: u32) -> bool {
        !self.used[member as usize]
    }

    /// Enters what was found, if none of the others is used and what has to be outside of the first still is.
    fn accept(&mut self, found: Found) {
        let (places, [first, others @ ..]) = (self.part.len(), found.members);
        let is_outside = |&x: &u32| self.taken[x as usize - places] != first;
        let are_outside = match found.at {
            At::Biclique([_, b, _, v, w]) | At::Tripod([.., b, v, w]) => {
                [b, v, w].iter().all(is_outside)
            }
            At::Link([.., g]) => self.of(others[0]).iter().chain([&g]).all(is_outside),
        };
        if are_outside && others.iter().all(|&member| self.is_free(member)) {
            for member in found.members {
                self.used[member as usize] = true;
            }
            for &x in others
                .iter()
                .flat_map(|&member| self.incidence.of(member as usize))
            {
                self.taken[x as usize - places] = first;
            }
            self.found.push(found);
        }
    }

    /// Everything whose largest member is a body, by falling size.
    fn search_bodies(&mut self) {
        let mut order: Vec<u32> = (0..self.bodies as u32).collect();
        order.sort_by_key(|&body| std::cmp::Reverse(self.of(body).len()));
        let mut reached = vec![None; self.incidence.len() - self.part.len()];
        for body in order {
            if self.is_free(body) {
                self.around(body, &mut reached);
            }
        }
    }

    /// Every K_{2,3} in which the body holds a and the first of the three, every tripod on it, and every link.
    ///
    /// A node outside that touches the body through a member does so through one member and at one
    /// node only: anything else would be two members that share two nodes, or a triangle.
    fn around(&mut self, body: u32, reached: &mut [Option<Reach>]) {
        let members = self.part.len();
        let size = self.of(body).len();
        if !self.steps.take(size) {
            return;
        }
        let joins = |search: &Self, member: u32| {
            let fits = !search.is_limited || search.of(member).len() <= size;
            member != body && search.is_free(member) && fits
        };
        let mut layer = Vec::new();
        let mut cost = size;
        for &from in self.of(body) {
            for &member in self.of(from) {
                cost += 1;
                if joins(self, member) {
                    cost += self.of(member).len();
                    let others = self.of(member).iter().filter(|&&x| x != from);
                    layer.extend(others.map(|&x| (x, Reach { from, member })));
                }
            }
        }
        // The members that do not touch the body, with the nodes of the layer in them.
        let mut far: Vec<(u32, u32)> = Vec::new();
        for &(x, reach) in &layer {
            reached[x as usize - members] = Some(reach);
            cost += self.of(x).len();
            let next = self.of(x).iter().filter(|&&member| member != reach.member);
            far.extend(
                next.filter(|&&member| joins(self, member))
                    .map(|&member| (member, x)),
            );
        }
        if self.steps.take(cost) {
            far.sort_unstable();
            self.two_squares(body, &far, reached);
            self.links(body, &far, reached);
        }
        for (x, _) in layer {
            reached[x as usize - members] = None;
        }
    }

    /// Two cycles of four around the body through the same node outside. `far` lists the members
    /// opposite to it with their nodes, in order.
    fn two_squares(&mut self, body: u32, far: &[(u32, u32)], reached: &[Option<Reach>]) {
        let members = self.part.len();
        let reach = |x: u32| reached[x as usize - members];
        // For a node outside the next one on the first such cycle, and the member between them.
        let mut squares: HashMap<u32, (u32, u32)> = HashMap::new();
        for opposite in far.chunk_by(|one, other| one.0 == other.0) {
            if !self.steps.take(opposite.len() * opposite.len()) {
                return;
            }
            let member = opposite[0].0;
            let ends = opposite.iter().filter_map(|&(_, x)| Some((x, reach(x)?)));
            for (b, at_b) in ends.clone() {
                for (v, at_v) in ends.clone().filter(|(_, at)| at.from != at_b.from) {
                    let Some((w, other)) =
                        squares.insert(b, (v, member)).filter(|last| last.0 != v)
                    else {
                        continue;
                    };
                    let Some(at_w) = reach(w) else { continue };
                    let (from, [x, y]) = (at_b.from, [at_v.from, at_w.from]);
                    let [to_b, to_v, to_w] = [at_b, at_v, at_w].map(|at| at.member);
                    self.accept(if x == y {
                        Found {
                            members: [body, to_b, to_v, member, to_w, other],
                            at: At::Biclique([x, b, from, v, w]),
                        }
                    } else {
                        Found {
                            members: [body, to_b, member, to_v, to_w, other],
                            at: At::Tripod([from, x, y, b, v, w]),
                        }
                    });
                }
            }
        }
    }

    /// Bodies with two nodes that touch this one, and a way of two members between both.
    fn links(&mut self, body: u32, far: &[(u32, u32)], reached: &[Option<Reach>]) {
        for opposite in far.chunk_by(|one, other| one.0 == other.0) {
            if !self.steps.take(1) {
                return;
            }
            if let &[(other, d), (_, e)] = opposite
                && (other as usize) < self.bodies
                && let Some(found) = self.link([body, other, d, e], reached)
            {
                self.accept(found);
            }
        }
    }

    /// The first link to a body, whose nodes d and e touch this one.
    fn link(&self, [body, other, d, e]: [u32; 4], reached: &[Option<Reach>]) -> Option<Found> {
        let reach = |x: u32| reached[x as usize - self.part.len()];
        let [to_d, to_e] = [reach(d)?, reach(e)?];
        for &f in self.of(other) {
            if !self.steps.take(self.of(f).len()) {
                return None;
            }
            for &last in self.of(f) {
                if last == other || !self.is_free(last) || !self.steps.take(self.of(last).len()) {
                    continue;
                }
                let ends = self.of(last).iter().filter(|&&g| g != f);
                let ends = ends.filter_map(|&g| Some((g, reach(g)?)));
                // A member that touches the body itself is a way of one, and no node of a layer
                // is in this body.
                let mut ends = ends.filter(|(_, at)| {
                    at.member != last && ![to_d.member, to_e.member].contains(&at.member)
                });
                if let Some((g, at)) = ends.next() {
                    return Some(Found {
                        members: [body, other, to_d.member, to_e.member, at.member, last],
                        at: At::Link([to_d.from, to_e.from, at.from, d, e, f, g]),
                    });
                }
            }
        }
        None
    }

    /// Every K_{2,3} of edges.
    fn search_edges(&mut self) {
        let members = self.part.len() as u32;
        for a in members..self.incidence.len() as u32 {
            // Ways of two edges from a to a larger node: that node, the one between, both edges.
            let mut ways: Vec<(u32, u32, [u32; 2])> = Vec::new();
            for &first in self.of(a).iter().filter(|&&edge| self.is_edge(edge)) {
                let v = self.other_end(first, a);
                if !self.steps.take(self.of(v).len()) {
                    return;
                }
                let seconds = self.of(v).iter().filter(|&&edge| self.is_edge(edge));
                ways.extend(seconds.filter_map(|&second| {
                    let b = self.other_end(second, v);
                    (b > a).then_some((b, v, [first, second]))
                }));
            }
            ways.sort_unstable();
            for to_one in ways.chunk_by(|one, other| one.0 == other.0) {
                let free = |(_, _, edges): &&(u32, u32, [u32; 2])| {
                    edges.iter().all(|&edge| self.is_free(edge))
                };
                let mut free = to_one.iter().filter(free);
                if let (Some(x), Some(y), Some(z)) = (free.next(), free.next(), free.next()) {
                    let ([p, q], [r, s], [t, u]) = (x.2, y.2, z.2);
                    self.accept(Found {
                        members: [p, q, r, s, t, u],
                        at: At::Biclique([a, x.0, x.1, y.1, z.1]),
                    });
                }
            }
        }
    }

    fn is_edge(&self, member: u32) -> bool {
        member as usize >= self.bodies && self.is_free(member)
    }

    /// The end of an edge that is not the given one. Both ends are on cycles, or the edge is not
    /// listed at any.
    fn other_end(&self, edge: u32, end: u32) -> u32 {
        let ends = self.of(edge);
        ends[usize::from(ends[0] == end)]
    }
}
