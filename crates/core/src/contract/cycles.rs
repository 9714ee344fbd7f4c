//! Merging bodies and loose edges around cycles of two, three and four, in the calibrated model.
//!
//! Members (bodies and loose edges) and the nodes that they share form a bipartite graph; a cycle
//! of k members is a cycle of 2k in it. What hangs on it as a tree lies on no cycle and is pruned.

use super::{Body, Merge, Part, Seed};
use crate::graph::{Lists, prune_leaves};

const NONE: u32 = u32::MAX;

/// Merges bodies, with the help of loose edges, until no cycle of two, three or four members is
/// left. New bodies are appended; the consumed ones lose their nodes. Returns the edges that are
/// still loose.
///
/// Bodies are taken by falling number of shared nodes, round after round until nothing changes. A
/// cycle is found by the largest body on it, so a body is only searched by larger ones. A search
/// without a find looks at every member and node at most once.
pub(super) fn close(
    bodies: &mut Vec<Body>,
    edges: Vec<(u32, u32)>,
    nodes: usize,
) -> Vec<(u32, u32)> {
    let mut structure = Structure::new(bodies, &edges, nodes);
    let first_edge = structure.members() - edges.len();
    let mut changed = true;
    while changed {
        changed = false;
        for member in structure.by_falling_size() {
            if structure.is_current(member) {
                changed |= Absorption::new(&mut structure, bodies, member).run();
            }
        }
    }
    let still_loose = |k: &usize| structure.is_current((first_edge + k) as u32);
    (0..edges.len())
        .filter(still_loose)
        .map(|k| edges[k])
        .collect()
}

/// How a search has come to a member that touches the body, or is one step farther.
#[derive(Clone, Copy)]
struct Way {
    /// The search; a way of an earlier one is none.
    search: u32,
    /// The node of the body where the way begins.
    from: u32,
    /// The member in between and the node where it meets this one; none if this one touches the
    /// body itself.
    through: Option<(u32, u32)>,
}

/// How a search has come to a node outside.
#[derive(Clone, Copy)]
struct Reach {
    search: u32,
    /// The node of the body where the way begins.
    from: u32,
    /// The member that holds both.
    member: u32,
}

/// The members and the nodes that they share. Members are numbered, bodies first; nodes have
/// numbers of their own here.
struct Structure {
    /// What the member is in a record.
    part: Vec<Part>,
    /// The member that each has become part of.
    parent: Vec<u32>,
    /// The shared nodes of each member; those of a consumed one are gone.
    own: Vec<Vec<u32>>,
    /// For every node the members that hold it, by the numbers they had at first.
    holders: Lists,
    /// The node of the graph.
    names: Vec<u32>,
    ways: Vec<Way>,
    reaches: Vec<Reach>,
    /// The search that the node is inside of.
    inside: Vec<u32>,
    /// How many searches there have been.
    searches: u32,
    /// The listing of holders that a member has been met in last, and how many there have been.
    listed: Vec<u32>,
    listings: u32,
}

impl Structure {
    fn new(bodies: &[Body], edges: &[(u32, u32)], nodes: usize) -> Self {
        let finals = || (0..).zip(bodies).filter(|(_, body)| !body.nodes.is_empty());
        let part: Vec<Part> = finals()
            .map(|(k, _)| Part::Body(k))
            .chain(edges.iter().map(|&(i, j)| Part::Edge(i, j)))
            .collect();
        let members = part.len();

        let in_bodies = || finals().flat_map(|(_, body)| body.nodes.iter().copied());
        let in_edges = || edges.iter().flat_map(|&(i, j)| [i, j]);
        let mut number = vec![0u32; nodes];
        for v in in_bodies().chain(in_edges()) {
            number[v as usize] = number[v as usize].saturating_add(1);
        }
        let mut names = Vec::new();
        for (v, count) in (0..).zip(&mut number) {
            let shared = *count > 1;
            *count = NONE;
            if shared {
                *count = names.len() as u32;
                names.push(v);
            }
        }
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (member, (_, body)) in (0..).zip(finals()) {
            pairs.extend(body.nodes.iter().map(|&v| (member, number[v as usize])));
        }
        for (member, &(i, j)) in (members as u32 - edges.len() as u32..).zip(edges) {
            pairs.extend([i, j].map(|v| (member, number[v as usize])));
        }
        pairs.retain(|&(_, node)| node != NONE);

        let first_node = members as u32;
        let members_first = pairs.iter().map(|&(member, v)| (member, first_node + v));
        let nodes_after = pairs.iter().map(|&(member, v)| (first_node + v, member));
        let both_ways = members_first.chain(nodes_after);
        let mut incidence = Lists::group(members + names.len(), both_ways);
        prune_leaves(&mut incidence);

        let own = (0..members)
            .map(|member| {
                incidence
                    .of(member)
                    .iter()
                    .map(|v| v - first_node)
                    .collect()
            })
            .collect();
        let held = (0..names.len()).flat_map(|v| {
            incidence
                .of(members + v)
                .iter()
                .map(move |&m| (v as u32, m))
        });
        let holders = Lists::group(names.len(), held);
        let way = Way {
            search: NONE,
            from: NONE,
            through: None,
        };
        let reach = Reach {
            search: NONE,
            from: NONE,
            member: NONE,
        };
        Self {
            part,
            parent: (0..members as u32).collect(),
            own,
            ways: vec![way; members],
            reaches: vec![reach; names.len()],
            inside: vec![NONE; names.len()],
            holders,
            names,
            searches: 0,
            listed: vec![NONE; members],
            listings: 0,
        }
    }

    fn members(&self) -> usize {
        self.part.len()
    }

    fn is_current(&self, member: u32) -> bool {
        self.parent[member as usize] == member
    }

    fn size(&self, member: u32) -> usize {
        self.own[member as usize].len()
    }

    /// The bodies with shared nodes, by falling number of these.
    fn by_falling_size(&self) -> Vec<u32> {
        let is_body = |&k: &u32| matches!(self.part[k as usize], Part::Body(_));
        let mut order: Vec<u32> = (0..self.members() as u32)
            .filter(|k| is_body(k) && self.size(*k) > 0)
            .collect();
        order.sort_by_key(|&k| std::cmp::Reverse(self.size(k)));
        order
    }

    /// The member that another is part of now.
    fn current(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let up = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = up;
            member = up;
        }
        member
    }

    /// The members that hold a node now, each once. Forgets the repetitions.
    fn holders_of(&mut self, v: u32) -> Vec<u32> {
        self.listings += 1;
        let first = self.holders.of(v as usize).to_vec();
        let mut now = Vec::with_capacity(first.len());
        for &member in &first {
            let current = self.current(member);
            if self.listed[current as usize] != self.listings {
                self.listed[current as usize] = self.listings;
                now.push(current);
            }
        }
        if now.len() < first.len() {
            self.holders.rewrite(v as usize, &now);
        }
        now
    }
}

/// One body absorbing what stands around a cycle with it.
struct Absorption<'a> {
    structure: &'a mut Structure,
    bodies: &'a mut Vec<Body>,
    /// The body, as a member.
    centre: u32,
    search: u32,
    merges: Vec<Merge>,
    /// Nodes of the graph, and how many of its edges, of all that was absorbed.
    nodes: Vec<u32>,
    edges: usize,
}

impl<'a> Absorption<'a> {
    fn new(structure: &'a mut Structure, bodies: &'a mut Vec<Body>, centre: u32) -> Self {
        let search = structure.searches;
        structure.searches += 1;
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
        }
    }

    /// Runs to the end; if a rule was applied, appends the new body. Returns whether one was.
    fn run(mut self) -> bool {
        let mut next = 0;
        while let Some(&a) = self.structure.own[self.centre as usize].get(next) {
            next += 1;
            self.search_from(a);
        }
        let Part::Body(k) = self.structure.part[self.centre as usize] else {
            unreachable!("edges absorb nothing");
        };
        let old = &mut self.bodies[k as usize];
        if self.merges.is_empty() {
            old.edges += self.edges;
            return false;
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
        });
        true
    }

    fn is_inside(&self, v: u32) -> bool {
        self.structure.inside[v as usize] == self.search
    }

    /// Whether a member is outside, and the body not the smaller one of the two.
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
            let before = self.way(member);
            if let Some(way) = before
                && way.from != a
            {
                match way.through {
                    None => self.merge_shared(member, [way.from, a]),
                    Some((first, x)) => self.merge_triangle([first, member], [way.from, a, x]),
                }
                continue;
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
            let reach = self.structure.reaches[x as usize];
            if reach.search != self.search {
                self.structure.reaches[x as usize] = Reach {
                    search: self.search,
                    from: a,
                    member,
                };
                self.search_node(x, member, a);
            } else if reach.from != a {
                self.merge_triangle([reach.member, member], [reach.from, a, x]);
            }
            // Two members with the nodes a and x in common: one of them finds the other.
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
            // A cycle without the body is left to the largest body on it.
            if way.from == a {
                continue;
            }
            match way.through {
                None => self.merge_triangle([member, other], [a, way.from, x]),
                Some((last, y)) => {
                    self.merge_cycle([member, other, last], [a, x, y, way.from]);
                }
            }
            // The member has joined.
            break;
        }
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

/// Puts two lists together, into the longer one. Their order does not matter.
fn append_smaller(list: &mut Vec<u32>, mut other: Vec<u32>) {
    if other.len() > list.len() {
        std::mem::swap(list, &mut other);
    }
    list.append(&mut other);
}
