//! Merging bodies: two that share two nodes, three that pairwise share a node.

use super::body::{Body, Merge, Part, Seed};
use super::position::Position;
use crate::graph::{Adjacency, Lists, sort_once};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// A node may be a hub with more bodies and edges around it than so many; tests have no large graphs.
const HUB: usize = if cfg!(test) { 3 } else { 64 };

/// For every node the bodies that contain it, by the numbers they had when it joined them,
/// and which body each of those has become part of.
pub(super) struct Owners {
    first: Lists,
    /// Bodies that contain a node because a loose edge brought it in.
    joined: HashMap<u32, Vec<u32>>,
    parent: Vec<u32>,
}

impl Owners {
    fn new(nodes: usize, bodies: &[Body]) -> Self {
        let pairs = (0..).zip(bodies).flat_map(|(k, body)| {
            let nodes = body.nodes.iter();
            nodes.map(move |&v| (v, k))
        });
        Self {
            first: Lists::group(nodes, pairs),
            joined: HashMap::new(),
            parent: (0..bodies.len() as u32).collect(),
        }
    }

    /// The body that body `k` is part of now.
    fn current(&self, mut k: u32) -> u32 {
        while self.parent[k as usize] != k {
            k = self.parent[k as usize];
        }
        k
    }

    /// As [`Self::current`], shortening the way for the next time.
    fn find(&mut self, k: u32) -> u32 {
        let root = self.current(k);
        let mut at = k;
        while self.parent[at as usize] != root {
            at = std::mem::replace(&mut self.parent[at as usize], root);
        }
        root
    }

    /// How many bodies contained a node at some time.
    fn count(&self, v: u32) -> usize {
        self.first.of(v as usize).len() + self.joined.get(&v).map_or(0, Vec::len)
    }

    /// The bodies that contain a node, perhaps with repetitions.
    fn of(&self, v: u32) -> impl Iterator<Item = u32> {
        let joined = self.joined.get(&v).map_or(&[][..], |list| list);
        let first = self.first.of(v as usize).iter();
        first.chain(joined).map(|&k| self.current(k))
    }

    /// The body that contains both nodes.
    pub(super) fn common_body(&self, v: u32, w: u32) -> Option<u32> {
        self.of(v).find(|&k| self.of(w).any(|l| l == k))
    }
}

/// Merges bodies, with the help of the loose edges among `remaining`, until no rule
/// applies. New bodies are appended; the consumed ones lose their nodes.
///
/// Bodies are taken by falling size, round after round until nothing changes. Of
/// three bodies that pairwise share a node the largest finds the other two, so a body
/// is only ever searched by larger ones that touch it. Without the bodies that are `new` no rule applies. So
/// only they are taken, and larger ones that touch them.
///
/// A body does not search around its hub, where all others would search the same. Two parts that touch it are found
/// from its other nodes, or one of them is, and the hub knows whether the other meets that one. A hub knows what
/// was around it when the round began to ask, so what merged since may wait for the next round.
pub(super) fn close(
    bodies: &mut Vec<Body>,
    mut new: Range<u32>,
    remaining: &Adjacency,
    nodes: usize,
    at: &impl Position,
) -> Owners {
    let mut owners = Owners::new(nodes, bodies);
    let mut inside = vec![u32::MAX; nodes];
    let mut stamp = 0;
    while !new.is_empty() {
        let size = |k: u32| bodies[k as usize].nodes.len();
        let mut order: Vec<u32> = new.filter(|&k| size(k) > 0).collect();
        order.sort_by_key(|&k| size(k));
        for k in order.clone() {
            // The smallest body looks around a node for all of them.
            for &v in &bodies[k as usize].nodes {
                if std::mem::replace(&mut inside[v as usize], stamp) != stamp {
                    order.extend(owners.of(v).filter(|&l| size(l) > size(k)));
                }
            }
        }
        stamp += 1;
        sort_once(&mut order);
        order.sort_by_key(|&k| std::cmp::Reverse(size(k)));
        let before = bodies.len() as u32;
        let mut hubs = Hubs::default();
        for k in order {
            if bodies[k as usize].nodes.is_empty() {
                continue;
            }
            let mut absorption = Absorption {
                bodies,
                owners: &mut owners,
                remaining,
                at,
                inside: &mut inside,
                hubs: &mut hubs,
                hub: None,
                stamp,
                nodes: Vec::new(),
                consumed: vec![k],
                edges: 0,
                touched: HashMap::new(),
                reached: HashMap::new(),
                merges: Vec::new(),
                brought_in: Vec::new(),
            };
            stamp += 1;
            absorption.run(k);
        }
        new = before..bodies.len() as u32;
    }
    for k in 0..bodies.len() as u32 {
        owners.find(k);
    }
    owners
}

/// What is around hubs, as far as somebody asked in this round.
#[derive(Default)]
struct Hubs {
    /// The bodies and the loose edges at each.
    around: HashMap<u32, HashSet<Part>>,
    /// What holds a hub and another node.
    between: HashMap<(u32, u32), Option<Part>>,
}

/// One body absorbing whatever the rules allow.
struct Absorption<'a, P> {
    bodies: &'a mut Vec<Body>,
    owners: &'a mut Owners,
    remaining: &'a Adjacency,
    /// Where centres are.
    at: &'a P,
    /// The stamp of the absorption that the node is inside of.
    inside: &'a mut [u32],
    hubs: &'a mut Hubs,
    /// The node of the body around which there is more than around all its others.
    hub: Option<u32>,
    stamp: u32,
    /// Nodes of the body; grows.
    nodes: Vec<u32>,
    /// The body itself and those absorbed.
    consumed: Vec<u32>,
    /// Edges that these cover.
    edges: usize,
    /// Bodies that share a node with this one, and that node.
    touched: HashMap<u32, u32>,
    /// Nodes outside that some part at a node of the body reaches: the part and that
    /// node.
    reached: HashMap<u32, (Part, u32)>,
    merges: Vec<Merge>,
    /// Nodes that only loose edges brought in so far.
    brought_in: Vec<u32>,
}

impl<P: Position> Absorption<'_, P> {
    /// Runs to the end; if anything was absorbed, appends the new body.
    fn run(&mut self, k: u32) {
        let own = std::mem::take(&mut self.bodies[k as usize].nodes);
        self.take_in(&own);
        self.hub = self.find_hub(&own);
        let mut searched = 0;
        while let Some(&a) = self.nodes.get(searched) {
            searched += 1;
            if self.hub != Some(a) && self.is_shared(a) {
                self.search(a);
            }
        }
        let nodes = std::mem::take(&mut self.nodes);
        if self.merges.is_empty() {
            self.bodies[k as usize].nodes = nodes;
            return;
        }
        let new = self.bodies.len() as u32;
        let edges = self.edges + std::mem::take(&mut self.bodies[k as usize].edges);
        for &k in &self.consumed {
            self.owners.parent[k as usize] = new;
        }
        self.owners.parent.push(new);
        for v in std::mem::take(&mut self.brought_in) {
            self.owners.joined.entry(v).or_default().push(new);
        }
        self.bodies.push(Body {
            merge: std::mem::take(&mut self.merges),
            ..Body::new(Seed::Body(k), nodes, edges)
        });
    }

    fn find_hub(&self, nodes: &[u32]) -> Option<u32> {
        let around = |&v: &u32| (self.owners.count(v) + self.remaining.degree(v), v);
        let (most, hub) = nodes.iter().map(around).max()?;
        let all: usize = nodes.iter().map(|v| around(v).0).sum();
        (most > HUB && 2 * most > all).then_some(hub)
    }

    fn is_inside(&self, v: u32) -> bool {
        self.inside[v as usize] == self.stamp
    }

    /// Whether more than one body or edge is around a node, where others may meet.
    fn is_shared(&self, v: u32) -> bool {
        self.owners.first.of(v as usize).len() > 1 || self.remaining.degree(v) > 0
    }

    fn take_in(&mut self, nodes: &[u32]) {
        for &v in nodes {
            if !self.is_inside(v) {
                self.inside[v as usize] = self.stamp;
                self.nodes.push(v);
            }
        }
    }

    fn absorb(&mut self, part: Part) {
        match part {
            Part::Edge(i, j) => {
                for v in [i, j] {
                    if !self.is_inside(v) {
                        self.brought_in.push(v);
                    }
                }
                self.take_in(&[i, j]);
            }
            Part::Body(k) => {
                let nodes = std::mem::take(&mut self.bodies[k as usize].nodes);
                self.take_in(&nodes);
                self.consumed.push(k);
                self.edges += std::mem::take(&mut self.bodies[k as usize].edges);
            }
        }
    }

    /// Looks at everything that touches the body at its node `a`.
    fn search(&mut self, a: u32) {
        let around: Vec<u32> = self.owners.of(a).collect();
        for k in around {
            // The body itself and what it has absorbed have no nodes of their own now.
            if self.bodies[k as usize].nodes.is_empty() {
                continue;
            }
            let part = Part::Body(k);
            match self.touched.insert(k, a) {
                Some(before) if before != a && self.at.apart(before, a) => {
                    self.merges.push(Merge::Shared {
                        part,
                        at: [before, a],
                    });
                    self.absorb(part);
                }
                _ => self.search_body(k, a),
            }
        }
        for &x in self.remaining.neighbours(a) {
            if !self.is_inside(x) {
                self.reach(x, Part::edge(a, x), a);
            }
        }
    }

    /// Looks at the nodes of body `k`, which touches this one at `a`.
    fn search_body(&mut self, k: u32, a: u32) {
        if self.bodies[k as usize].nodes.len() > self.nodes.len() {
            return;
        }
        for at in 0.. {
            let Some(&x) = self.bodies[k as usize].nodes.get(at) else {
                break;
            };
            if x == a || !self.is_shared(x) {
                continue;
            }
            if self.is_inside(x) {
                if !self.at.apart(a, x) {
                    continue;
                }
                let part = Part::Body(k);
                self.merges.push(Merge::Shared { part, at: [a, x] });
                self.absorb(part);
                break;
            }
            self.reach(x, Part::Body(k), a);
        }
    }

    /// Node x outside is in `part`, which touches the body at `a`: if another part
    /// reaches x from another node, the three are a triangle of bodies.
    fn reach(&mut self, x: u32, part: Part, a: u32) {
        // Of what x is reached from and refused with, all is on one line through x.
        if !self.at.apart(a, x) {
            return;
        }
        let Some(&(other, b)) = self.reached.get(&x) else {
            self.reached.insert(x, (part, a));
            if let Some((hub, second)) = self.at_hub(x).filter(|(_, second)| *second != part) {
                self.reach(x, second, hub);
            }
            return;
        };
        // From the same node: if these are two bodies they share two nodes, which one
        // of them finds when its turn comes.
        if a == b || !self.at.spans(a, b, x) {
            return;
        }
        self.merges.push(Merge::Triangle {
            parts: [other, part],
            at: [b, a, x],
        });
        self.absorb(other);
        self.absorb(part);
    }

    /// The hub, and what holds it and x outside; a body that is larger than this one finds it by itself.
    fn at_hub(&mut self, x: u32) -> Option<(u32, Part)> {
        let hub = self.hub?;
        let (owners, bodies) = (&*self.owners, &*self.bodies);
        let between = self.hubs.between.entry((hub, x)).or_insert_with(|| {
            let around = self.hubs.around.entry(hub).or_insert_with(|| {
                let loose = self.remaining.neighbours(hub).iter();
                let loose = loose.map(|&v| Part::edge(hub, v));
                owners.of(hub).map(Part::Body).chain(loose).collect()
            });
            let mut parts = owners.of(x).map(Part::Body).chain([Part::edge(hub, x)]);
            parts.find(|part| around.contains(part))
        });
        match (*between)? {
            Part::Body(k) => {
                let k = owners.current(k);
                let size = bodies[k as usize].nodes.len();
                (0 < size && size <= self.nodes.len()).then_some((hub, Part::Body(k)))
            }
            edge => Some((hub, edge)),
        }
    }
}
