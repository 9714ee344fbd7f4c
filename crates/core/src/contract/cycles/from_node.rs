//! A search from a shared node, for what stands around a cycle through it.
//!
//! The members that hold the node are its *branches*. From each the search goes on to the members
//! that touch it elsewhere, and to their nodes. Where two branches meet there is a cycle.

use super::{Reach, Structure, Way, append_smaller};
use crate::contract::body::{Body, Merge, Part, Seed};

/// One node at which members merge that stand around a cycle through it.
pub(super) struct FromNode<'a> {
    structure: &'a mut Structure,
    bodies: &'a mut Vec<Body>,
    /// The node where the search begins.
    hub: u32,
    search: u32,
    /// Of the node, at the beginning.
    rank: usize,
    /// Other nodes of branches, at which the search has still to look around.
    open: Vec<u32>,
    /// Two branches, by members that are part of them, and a second node that they share.
    shared: Vec<([u32; 2], u32)>,
    changed: bool,
}

impl<'a> FromNode<'a> {
    pub(super) fn new(structure: &'a mut Structure, bodies: &'a mut Vec<Body>, hub: u32) -> Self {
        let search = structure.begin_search();
        Self {
            rank: structure.held_by(hub),
            structure,
            bodies,
            hub,
            search,
            open: Vec::new(),
            shared: Vec::new(),
            changed: false,
        }
    }

    /// Runs to the end; appends a body for each merge. Returns whether there was one.
    pub(super) fn run(mut self) -> bool {
        let branches = self.structure.holders_of(self.hub);
        for branch in branches {
            if self.structure.size(branch) > self.rank {
                continue;
            }
            self.set_way(branch, self.hub);
            for at in 0..self.structure.size(branch) {
                let x = self.structure.own[branch as usize][at];
                if x != self.hub {
                    self.claim(branch, x);
                }
            }
        }
        self.merge_shared();
        while let Some(x) = self.open.pop() {
            if self.structure.held_by(x) <= self.rank {
                self.look_around(x);
            }
        }
        self.changed
    }

    /// A branch holds a node: the node is its own, or two branches share two nodes.
    fn claim(&mut self, branch: u32, x: u32) {
        match self.branch(x) {
            None => {
                self.structure.branches[x as usize] = (self.search, branch);
                self.open.push(x);
            }
            Some(other) if other != branch => self.shared.push(([other, branch], x)),
            Some(_) => (),
        }
    }

    /// The branch that a node is in, as it is now.
    fn branch(&mut self, x: u32) -> Option<u32> {
        let (search, branch) = self.structure.branches[x as usize];
        (search == self.search).then(|| self.structure.current(branch))
    }

    fn set_way(&mut self, member: u32, from: u32) {
        self.structure.ways[member as usize] = Way {
            search: self.search,
            from,
            through: None,
        };
    }

    /// Looks at the members that touch a branch at its node `x`.
    fn look_around(&mut self, x: u32) {
        for member in self.structure.holders_of(x) {
            let branch = self.branch(x).expect("a node of a branch");
            let is_outside = self.structure.is_current(member) && member != branch;
            if !is_outside || self.structure.size(member) > self.rank {
                continue;
            }
            let way = self.structure.ways[member as usize];
            if way.search != self.search {
                self.set_way(member, x);
                self.look_along(member, x, branch);
            } else if way.from == self.hub {
                self.unite([branch, member], [self.hub, x]);
            } else {
                self.close(branch, x, member, way.from);
            }
        }
    }

    /// Looks at the nodes of a member that touches a branch at `x`.
    fn look_along(&mut self, member: u32, x: u32, branch: u32) {
        for at in 0..self.structure.size(member) {
            let y = self.structure.own[member as usize][at];
            if y == x {
                continue;
            }
            if self.branch(y).is_some() {
                if self.close(branch, x, member, y) {
                    return;
                }
                continue;
            }
            if self.structure.held_by(y) > self.rank {
                continue;
            }
            let reach = self.structure.reaches[y as usize];
            if reach.search != self.search {
                self.structure.reaches[y as usize] = Reach {
                    search: self.search,
                    from: x,
                    member,
                };
                continue;
            }
            let other = self.branch(reach.from).expect("a node of a branch");
            // A cycle without this node is found from what has the highest rank on it.
            let at = [self.hub, x, y, reach.from];
            if other != branch && self.structure.is_general(at) {
                self.unite([branch, member, reach.member, other], at);
                return;
            }
        }
    }

    /// A member touches a branch at `x` and the same or another one at `y`. Returns whether they
    /// merge, which they do in general position.
    fn close(&mut self, branch: u32, x: u32, member: u32, y: u32) -> bool {
        let other = self.branch(y).expect("a node of a branch");
        if other == branch {
            self.unite([branch, member], [y, x]);
            return true;
        }
        let at = [self.hub, x, y];
        let merges = self.structure.is_general(at);
        if merges {
            self.unite([branch, member, other], at);
        }
        merges
    }

    /// Merges members around a cycle, some of which are branches, and then the branches that share
    /// two nodes thereby: `at[k]` is in the member k and the one before it.
    fn unite<const K: usize>(&mut self, members: [u32; K], at: [u32; K]) {
        self.merge(members, at);
        self.merge_shared();
    }

    fn merge_shared(&mut self) {
        while let Some((branches, x)) = self.shared.pop() {
            let branches = branches.map(|branch| self.structure.current(branch));
            if branches[0] != branches[1] {
                self.merge(branches, [self.hub, x]);
            }
        }
    }

    fn merge<const K: usize>(&mut self, mut members: [u32; K], mut at: [u32; K]) {
        self.changed = true;
        // The largest absorbs the others.
        let rank = |k: &usize| {
            let member = members[*k];
            let is_body = matches!(self.structure.part[member as usize], Part::Body(_));
            (is_body, self.structure.size(member))
        };
        let largest = (0..K).max_by_key(rank).expect("a cycle");
        members.rotate_left(largest);
        at.rotate_left(largest);
        self.record(&members, &at);
        self.join_nodes(&members);
    }

    /// The body that comes from the first member by merging it with the others.
    fn record(&mut self, members: &[u32], at: &[u32]) {
        let parts: Vec<Part> = members
            .iter()
            .map(|&member| self.structure.part[member as usize])
            .collect();
        let at: Vec<u32> = at
            .iter()
            .map(|&v| self.structure.names[v as usize])
            .collect();
        let merge = match (&parts[1..], &at[..]) {
            // An edge between two nodes of the body is the body's own.
            (&[Part::Edge(..)], _) => None,
            (&[part], &[a, b]) => Some(Merge::Shared { part, at: [a, b] }),
            (&[x, y], &[a, b, c]) => Some(Merge::Triangle {
                parts: [x, y],
                at: [b, a, c],
            }),
            (&[x, y, z], &[a, b, c, d]) => Some(Merge::Cycle {
                parts: [x, y, z],
                at: [b, c, d, a],
            }),
            _ => unreachable!("a cycle of two, three or four"),
        };
        let mut edges = 0;
        let mut nodes = Vec::new();
        let mut scaled = false;
        for &part in &parts {
            match part {
                Part::Edge(i, j) => {
                    nodes.extend([i, j]);
                    edges += 1;
                }
                Part::Body(k) => {
                    let body = &mut self.bodies[k as usize];
                    scaled |= body.scaled;
                    append_smaller(&mut nodes, std::mem::take(&mut body.nodes));
                    edges += std::mem::take(&mut body.edges);
                }
            }
        }
        let (seed, merge) = match (parts[0], merge) {
            (Part::Body(k), Some(merge)) => (Seed::Body(k), merge),
            (Part::Edge(i, j), Some(merge)) => (Seed::Edge(i, j), merge),
            (Part::Body(k), None) => {
                let body = &mut self.bodies[k as usize];
                (body.nodes, body.edges) = (nodes, edges);
                return;
            }
            (Part::Edge(..), None) => unreachable!("two edges share one node"),
        };
        self.structure.part[members[0] as usize] = Part::Body(self.bodies.len() as u32);
        self.bodies.push(Body {
            seed,
            add: Vec::new(),
            merge: vec![merge],
            nodes,
            edges,
            scaled,
        });
    }

    /// Whether a member holds the node where the search began.
    fn is_branch(&self, member: u32) -> bool {
        let way = self.structure.ways[member as usize];
        way.search == self.search && way.from == self.hub
    }

    /// Makes the shared nodes of some members those of the first one, which becomes a branch if it
    /// is none. O(shared nodes of the others, and of the first if it is no branch yet).
    fn join_nodes(&mut self, members: &[u32]) {
        let first = members[0];
        let (mut all, others) = if self.is_branch(first) {
            let own = &mut self.structure.own[first as usize];
            (std::mem::take(own), &members[1..])
        } else {
            (vec![self.hub], members)
        };
        for &member in others {
            for y in std::mem::take(&mut self.structure.own[member as usize]) {
                if y == self.hub {
                    continue;
                }
                match self.branch(y) {
                    None => {
                        self.structure.branches[y as usize] = (self.search, first);
                        self.open.push(y);
                        all.push(y);
                    }
                    Some(branch) if branch == member => all.push(y),
                    // That one brings it.
                    Some(branch) if members.contains(&branch) => (),
                    Some(branch) => {
                        self.shared.push(([branch, first], y));
                        all.push(y);
                    }
                }
            }
        }
        self.structure.own[first as usize] = all;
        for &member in &members[1..] {
            self.structure.parent[member as usize] = first;
        }
        self.set_way(first, self.hub);
    }
}
