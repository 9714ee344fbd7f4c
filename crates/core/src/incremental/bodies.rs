//! Bodies that grow as pairs arrive: rules 2 and 3 of Theorem 4.1, kept closed.
//!
//! A pair that no body holds is a body of two nodes. Two bodies that share two nodes merge, and three that
//! pairwise share a node. The smaller body moves into the larger one, so each node moves O(log n) times.

use std::collections::HashMap;

/// The bodies, and who holds each node.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies {
    bodies: Vec<Body>,
    at: Vec<Holders>,
    /// The bodies of two nodes, by these in increasing order.
    of_pair: HashMap<(u32, u32), u32>,
    /// What each body has become part of.
    parent: Vec<u32>,
}

#[derive(Clone, Debug, Default)]
struct Body {
    /// Whether it has more than two nodes.
    is_large: bool,
    /// Its nodes, in no order; none once it is part of another.
    nodes: Vec<u32>,
    /// At least those of its nodes that another body holds as well.
    shared: Vec<u32>,
    /// How many of these there were when those that nobody shares any more went last.
    kept: usize,
}

/// The bodies that hold a node.
#[derive(Clone, Debug, Default)]
struct Holders {
    /// Those of two nodes.
    pairs: Vec<u32>,
    /// The others, increasing.
    large: Vec<u32>,
}

impl Holders {
    fn len(&self) -> usize {
        self.pairs.len() + self.large.len()
    }

    fn iter(&self) -> impl Iterator<Item = u32> {
        self.pairs.iter().chain(&self.large).copied()
    }
}

impl Bodies {
    /// A node that nobody holds yet.
    pub(super) fn push_node(&mut self) {
        self.at.push(Holders::default());
    }

    /// The bodies that are not part of others.
    pub(super) fn all(&self) -> Vec<u32> {
        let is_left = |&body: &u32| !self.nodes(body).is_empty();
        (0..self.bodies.len() as u32).filter(is_left).collect()
    }

    /// The bodies that hold a node.
    pub(super) fn at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.at[node as usize].iter()
    }

    /// The nodes of a body, in no order.
    pub(super) fn nodes(&self, body: u32) -> &[u32] {
        &self.bodies[body as usize].nodes
    }

    /// A body that holds both nodes. O(d log e) if d large bodies hold the one and e >= d the other.
    pub(super) fn common(&self, a: u32, b: u32) -> Option<u32> {
        let pair = self.of_pair.get(&(a.min(b), a.max(b)));
        let [mut few, mut many] = [a, b].map(|node| &self.at[node as usize].large);
        if few.len() > many.len() {
            std::mem::swap(&mut few, &mut many);
        }
        let held = |body: &&u32| many.binary_search(body).is_ok();
        pair.or_else(|| few.iter().find(held)).copied()
    }

    /// What a body has become part of.
    pub(super) fn root(&mut self, mut body: u32) -> u32 {
        while self.parent[body as usize] != body {
            let above = self.parent[body as usize];
            self.parent[body as usize] = self.parent[above as usize];
            body = above;
        }
        body
    }

    /// The nodes of a body that others hold too, and more if these are not two: what it is between bodies.
    pub(super) fn outline(&self, body: u32) -> Vec<u32> {
        let Body { nodes, shared, .. } = &self.bodies[body as usize];
        let is_shared = |node: &&u32| self.at[**node as usize].len() > 1;
        let mut outline: Vec<u32> = shared.iter().filter(is_shared).copied().collect();
        crate::graph::sort_once(&mut outline);
        let missing = 2usize.saturating_sub(outline.len());
        let inner = nodes.iter().filter(|node| !is_shared(node)).take(missing);
        outline.extend(inner);
        outline
    }

    /// Adds a pair that no body holds.
    pub(super) fn add(&mut self, a: u32, b: u32) {
        let body = self.push(Body {
            nodes: vec![a, b],
            shared: vec![a, b],
            ..Body::default()
        });
        self.of_pair.insert((a.min(b), a.max(b)), body);
        for node in [a, b] {
            self.tell_others(node);
            self.at[node as usize].pairs.push(body);
        }
        // A merge needs both ends, so the search may begin at either.
        let around = |node: u32| self.at[node as usize].len();
        let start = if around(a) <= around(b) { a } else { b };
        self.close(vec![(body, start)]);
    }

    /// Adds a body of three nodes or more, which no body holds.
    pub(super) fn add_body(&mut self, nodes: &[u32]) {
        let body = self.push(Body {
            is_large: true,
            ..Body::default()
        });
        let mut fresh = Vec::new();
        for &node in nodes {
            self.tell_others(node);
            self.take_in(body, node, &mut fresh);
        }
        self.close(fresh);
    }

    /// Whether one body holds all of several nodes.
    pub(super) fn holds_all(&self, nodes: &[u32]) -> bool {
        let common = self.common(nodes[0], nodes[1]);
        common.is_some_and(|body| nodes.iter().all(|&node| self.holds(body, node)))
    }

    /// Merges bodies that are known to be one, and all that follows.
    pub(super) fn join(&mut self, bodies: &[u32]) {
        let mut roots: Vec<u32> = bodies.iter().map(|&body| self.root(body)).collect();
        crate::graph::sort_once(&mut roots);
        let fresh = self.merge(roots);
        self.close(fresh);
    }

    fn push(&mut self, body: Body) -> u32 {
        let number = self.bodies.len() as u32;
        self.bodies.push(body);
        self.parent.push(number);
        number
    }

    /// A node gets another holder: the only large one that it had knows then that it is shared.
    fn tell_others(&mut self, node: u32) {
        let holders = &self.at[node as usize];
        if let ([], &[only]) = (&holders.pairs[..], &holders.large[..]) {
            self.bodies[only as usize].shared.push(node);
        }
    }

    /// Applies the rules where a body has a new node, until none applies.
    fn close(&mut self, mut work: Vec<(u32, u32)>) {
        while let Some((body, node)) = work.pop() {
            let body = self.root(body);
            if let Some(mut parts) = self.closing(body, node) {
                parts.push(body);
                work.push((body, node));
                work.extend(self.merge(parts));
            }
        }
    }

    /// Others that merge with a body, one of which shares `node` with it.
    fn closing(&self, body: u32, node: u32) -> Option<Vec<u32>> {
        let own = &self.bodies[body as usize].shared;
        for other in self.at(node).filter(|&other| other != body) {
            let theirs = &self.bodies[other as usize].shared;
            // Around the triangle from the side that has fewer ways.
            let (ways, from, to) = match theirs.len() <= own.len() {
                true => (theirs, other, body),
                false => (own, body, other),
            };
            for &way in ways.iter().filter(|&&way| way != node) {
                if self.holds(to, way) {
                    return Some(vec![other]);
                }
                if let Some(third) = self.between(way, from, to, node) {
                    return Some(vec![other, third]);
                }
            }
        }
        None
    }

    /// A body other than `from` that holds `way` and a node of the body `to` other than `node`.
    fn between(&self, way: u32, from: u32, to: u32, node: u32) -> Option<u32> {
        let ends = &self.bodies[to as usize].shared;
        let around = &self.at[way as usize];
        if ends.len() < around.len() {
            let ends = ends.iter().filter(|&&end| end != node);
            let mut thirds = ends.filter_map(|&end| self.common(way, end));
            return thirds.find(|&third| third != from);
        }
        let meets = |&third: &u32| {
            let of_third = &self.bodies[third as usize].shared;
            let (few, many) = match of_third.len() <= ends.len() {
                true => (of_third, to),
                false => (ends, third),
            };
            few.iter().any(|&end| end != node && self.holds(many, end))
        };
        around.iter().filter(|&third| third != from).find(meets)
    }

    fn holds(&self, body: u32, node: u32) -> bool {
        match &self.bodies[body as usize] {
            Body { is_large: true, .. } => {
                let large = &self.at[node as usize].large;
                large.binary_search(&body).is_ok()
            }
            pair => pair.nodes.contains(&node),
        }
    }

    /// Puts a node into a large body; if another holds it too, it is to be looked at again.
    fn take_in(&mut self, into: u32, node: u32, fresh: &mut Vec<(u32, u32)>) {
        let (held, body) = (&mut self.at[node as usize], &mut self.bodies[into as usize]);
        if let Err(place) = held.large.binary_search(&into) {
            held.large.insert(place, into);
            body.nodes.push(node);
            if held.len() > 1 {
                body.shared.push(node);
            }
        }
        if held.len() > 1 {
            fresh.push((into, node));
        }
    }

    /// Merges bodies into the largest, and names the nodes at which it is to be looked at again.
    fn merge(&mut self, mut parts: Vec<u32>) -> Vec<(u32, u32)> {
        if parts.len() < 2 {
            return Vec::new();
        }
        parts.sort_by_key(|&part| self.nodes(part).len());
        let into = match parts.last() {
            Some(&last) if self.bodies[last as usize].is_large => {
                parts.pop();
                last
            }
            _ => self.push(Body {
                is_large: true,
                ..Body::default()
            }),
        };
        let mut fresh = Vec::new();
        for part in parts {
            self.parent[part as usize] = into;
            let Body {
                nodes, is_large, ..
            } = std::mem::take(&mut self.bodies[part as usize]);
            if let ([a, b], false) = (&nodes[..], is_large) {
                self.of_pair.remove(&(*a.min(b), *a.max(b)));
            }
            for node in nodes {
                let held = &mut self.at[node as usize];
                let list = if is_large {
                    &mut held.large
                } else {
                    &mut held.pairs
                };
                list.retain(|&k| k != part);
                self.take_in(into, node, &mut fresh);
            }
        }
        let (at, body) = (&self.at, &mut self.bodies[into as usize]);
        if body.shared.len() > 2 * body.kept + 8 {
            body.shared.retain(|&node| at[node as usize].len() > 1);
            body.kept = body.shared.len();
        }
        fresh
    }
}
