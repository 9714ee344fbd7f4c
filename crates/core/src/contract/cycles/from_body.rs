//! A search from a body, which absorbs what stands around a cycle with it.

use super::{Reach, Structure, Way, append_smaller};
use crate::contract::body::{Body, Merge, Part, Seed};

/// One body that absorbs what stands around a cycle with it.
pub(super) struct FromBody<'a> {
    structure: &'a mut Structure,
    bodies: &'a mut Vec<Body>,
    /// The body, as a member.
    centre: u32,
    search: u32,
    merges: Vec<Merge>,
    /// Nodes of the graph, and how many of its edges, of all that was absorbed.
    nodes: Vec<u32>,
    edges: usize,
    /// Whether the body, with all that was absorbed, is scaled.
    scaled: bool,
}

impl<'a> FromBody<'a> {
    pub(super) fn new(
        structure: &'a mut Structure,
        bodies: &'a mut Vec<Body>,
        centre: u32,
    ) -> Self {
        let search = structure.begin_search();
        let scaled = structure.is_scaled(centre, bodies);
        for &v in &structure.own[centre as usize] {
            structure.inside[v as usize] = search;
        }
        Self {
            structure,
            bodies,
            centre,
            search,
            merges: Vec::new(),
            nodes: Vec::new(),
            edges: 0,
            scaled,
        }
    }

    /// Runs to the end; if a rule was applied, appends the new body. Returns whether anything was
    /// absorbed.
    pub(super) fn run(mut self) -> bool {
        let mut next = 0;
        while let Some(&a) = self.structure.own[self.centre as usize].get(next) {
            next += 1;
            if self.may_pass(a) {
                self.search_from(a);
            }
        }
        let Part::Body(k) = self.structure.part[self.centre as usize] else {
            unreachable!("edges absorb nothing");
        };
        let old = &mut self.bodies[k as usize];
        if self.merges.is_empty() {
            // Edges of its own at most.
            old.edges += self.edges;
            return self.edges > 0;
        }
        let mut nodes = std::mem::take(&mut old.nodes);
        append_smaller(&mut nodes, self.nodes);
        let edges = std::mem::take(&mut old.edges) + self.edges;
        self.structure.part[self.centre as usize] = Part::Body(self.bodies.len() as u32);
        self.bodies.push(Body {
            seed: Seed::Body(k),
            add: Vec::new(),
            merge: self.merges,
            nodes,
            edges,
            scaled: self.scaled,
        });
        true
    }

    fn is_inside(&self, v: u32) -> bool {
        self.structure.inside[v as usize] == self.search
    }

    /// Whether a node has no higher rank than the body.
    fn may_pass(&self, v: u32) -> bool {
        self.structure.held_by(v) <= self.structure.size(self.centre)
    }

    /// Whether a member is outside and has no higher rank than the body.
    fn may_join(&mut self, member: u32) -> bool {
        self.structure.is_current(member)
            && member != self.centre
            && self.structure.size(member) <= self.structure.size(self.centre)
    }

    /// The way to a member, unless what lies in between has joined meanwhile.
    fn way(&self, member: u32) -> Option<Way> {
        let way = self.structure.ways[member as usize];
        let open = way.through.is_none_or(|(_, x)| !self.is_inside(x));
        (way.search == self.search && open).then_some(way)
    }

    fn set_way(&mut self, member: u32, from: u32, through: Option<(u32, u32)>) {
        self.structure.ways[member as usize] = Way {
            search: self.search,
            from,
            through,
        };
    }

    /// Looks at everything that touches the body at its node `a`.
    fn search_from(&mut self, a: u32) {
        for member in self.structure.holders_of(a) {
            if !self.may_join(member) {
                continue;
            }
            if self.scaled && self.structure.is_scaled(member, self.bodies) {
                self.merge_scaled(member, a);
                continue;
            }
            let before = self.way(member).filter(|way| way.from != a);
            match before.map(|way| (way.from, way.through)) {
                Some((from, None)) => {
                    self.merge_shared(member, [from, a]);
                    continue;
                }
                Some((from, Some((first, x)))) if self.structure.is_general([from, a, x]) => {
                    self.merge_triangle([first, member], [from, a, x]);
                    continue;
                }
                _ => (),
            }
            self.set_way(member, a, None);
            self.search_member(member, a);
        }
    }

    /// Looks at the nodes of a member that touches the body at `a`.
    fn search_member(&mut self, member: u32, a: u32) {
        for at in 0.. {
            // Nothing is left once the member has joined.
            let Some(&x) = self.structure.own[member as usize].get(at) else {
                break;
            };
            if x == a {
                continue;
            }
            if self.is_inside(x) {
                self.merge_shared(member, [a, x]);
                continue;
            }
            if !self.may_pass(x) {
                continue;
            }
            let reach = self.structure.reaches[x as usize];
            if reach.search != self.search {
                self.structure.reaches[x as usize] = Reach {
                    search: self.search,
                    from: a,
                    member,
                };
                self.search_node(x, member, a);
            } else if reach.from != a && self.structure.is_general([reach.from, a, x]) {
                self.merge_triangle([reach.member, member], [reach.from, a, x]);
            }
            // Two members with the nodes a and x in common are found from one of the four.
        }
    }

    /// Looks at the members that meet `member`, which touches the body at `a`, at the node `x`
    /// outside.
    fn search_node(&mut self, x: u32, member: u32, a: u32) {
        for other in self.structure.holders_of(x) {
            if other == member || !self.may_join(other) {
                continue;
            }
            let Some(way) = self.way(other) else {
                self.set_way(other, a, Some((member, x)));
                continue;
            };
            // A cycle without the body is found from what has the highest rank on it.
            if way.from == a {
                continue;
            }
            match way.through {
                None if self.structure.is_general([a, way.from, x]) => {
                    self.merge_triangle([member, other], [a, way.from, x]);
                }
                Some((last, y)) if self.structure.is_general([a, x, y, way.from]) => {
                    self.merge_cycle([member, other, last], [a, x, y, way.from]);
                }
                _ => continue,
            }
            // The member has joined.
            break;
        }
    }

    fn merge_scaled(&mut self, member: u32, a: u32) {
        let part = self.structure.part[member as usize];
        let at = self.names([a]);
        self.merges.push(Merge::Scaled { part, at });
        self.absorb(member);
    }

    fn merge_shared(&mut self, member: u32, at: [u32; 2]) {
        let part = self.structure.part[member as usize];
        // An edge between two nodes of the body is the body's own.
        if let Part::Body(_) = part {
            let at = self.names(at);
            self.merges.push(Merge::Shared { part, at });
        }
        self.absorb(member);
    }

    fn merge_triangle(&mut self, members: [u32; 2], at: [u32; 3]) {
        let parts = members.map(|member| self.structure.part[member as usize]);
        let at = self.names(at);
        self.merges.push(Merge::Triangle { parts, at });
        members.into_iter().for_each(|member| self.absorb(member));
    }

    fn merge_cycle(&mut self, members: [u32; 3], at: [u32; 4]) {
        let parts = members.map(|member| self.structure.part[member as usize]);
        let at = self.names(at);
        self.merges.push(Merge::Cycle { parts, at });
        members.into_iter().for_each(|member| self.absorb(member));
    }

    /// The nodes of the graph.
    fn names<const K: usize>(&self, nodes: [u32; K]) -> [u32; K] {
        nodes.map(|v| self.structure.names[v as usize])
    }

    fn absorb(&mut self, member: u32) {
        self.scaled |= self.structure.is_scaled(member, self.bodies);
        match self.structure.part[member as usize] {
            Part::Edge(i, j) => {
                self.nodes.extend([i, j]);
                self.edges += 1;
            }
            Part::Body(k) => {
                let body = &mut self.bodies[k as usize];
                append_smaller(&mut self.nodes, std::mem::take(&mut body.nodes));
                self.edges += std::mem::take(&mut body.edges);
            }
        }
        let structure = &mut *self.structure;
        structure.parent[member as usize] = self.centre;
        for v in std::mem::take(&mut structure.own[member as usize]) {
            if structure.inside[v as usize] != self.search {
                structure.inside[v as usize] = self.search;
                structure.own[self.centre as usize].push(v);
            }
        }
    }
}
