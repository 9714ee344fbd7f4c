//! Merging bodies and loose edges around cycles of two, three and four, in the calibrated model.
//!
//! Members (bodies and loose edges) and the nodes that they share form a bipartite graph; a cycle
//! of k members is a cycle of 2k in it. What hangs on it as a tree lies on no cycle and is pruned.
//! The *rank* of a member is how many shared nodes it has, that of a node how many members hold
//! it. A cycle is found from the member or node of highest rank on it, so no search goes through
//! what has a higher rank than where it began: not from each body at a common node to all others.

mod from_body;
mod from_node;

use super::body::{Body, Part};
use super::general::General;
use crate::graph::{Lists, prune_leaves};
use from_body::FromBody;
use from_node::FromNode;

const NONE: u32 = u32::MAX;

/// Merges bodies, with the help of loose edges, until no cycle of two, three or four members is
/// left, but such of three and four as are not in general position. New bodies are appended; the
/// consumed ones lose their nodes. Returns the edges that are still loose.
///
/// Searches begin at bodies and nodes by falling rank, round after round until nothing changes. A
/// search without a find looks at every member and node at most once. In the last round nothing
/// changes, ranks neither, so what is of highest rank on a cycle would find it.
pub(super) fn close(
    bodies: &mut Vec<Body>,
    edges: Vec<(u32, u32)>,
    nodes: usize,
    general: &General,
) -> Vec<(u32, u32)> {
    let mut structure = Structure::new(bodies, &edges, nodes, general.clone());
    let first_edge = structure.members() - edges.len();
    let mut changed = true;
    while changed {
        changed = false;
        for start in structure.by_falling_rank() {
            changed |= match start {
                Start::Node(v) => FromNode::new(&mut structure, bodies, v).run(),
                Start::Body(k) if structure.is_current(k) => {
                    FromBody::new(&mut structure, bodies, k).run()
                }
                Start::Body(_) => false,
            }
        }
    }
    let still_loose = |k: &usize| structure.is_current((first_edge + k) as u32);
    (0..edges.len())
        .filter(still_loose)
        .map(|k| edges[k])
        .collect()
}

/// Where a search begins: at a body, by its number as a member, or at a shared node.
#[derive(Clone, Copy)]
enum Start {
    Body(u32),
    Node(u32),
}

/// How a search has come to a member that touches the body, or is one step farther; from a node,
/// to a member that holds it, or is one step farther.
#[derive(Clone, Copy)]
struct Way {
    /// The search; a way of an earlier one is none.
    search: u32,
    /// The node of the body where the way begins; from a node, the node where it ends.
    from: u32,
    /// The member in between and the node where it meets this one; none if this one touches the
    /// body itself. Always none from a node.
    through: Option<(u32, u32)>,
}

/// How a search has come to a node outside.
#[derive(Clone, Copy)]
struct Reach {
    search: u32,
    /// The node of the body where the way begins; from a node, the node where the member was met.
    from: u32,
    /// The member that holds both.
    member: u32,
}

/// The members and the nodes that they share. Members are numbered, bodies first; nodes have
/// numbers of their own here.
struct Structure {
    general: General,
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
    /// For every node the search from a node in which it was last met next to that node, and the
    /// member that holds both.
    branches: Vec<(u32, u32)>,
    /// The search that the node is inside of.
    inside: Vec<u32>,
    /// How many searches there have been.
    searches: u32,
    /// The listing of holders that a member has been met in last, and how many there have been.
    listed: Vec<u32>,
    listings: u32,
}

impl Structure {
    fn new(bodies: &[Body], edges: &[(u32, u32)], nodes: usize, general: General) -> Self {
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
        let shared = |v: &u32| Some(number[*v as usize]).filter(|&node| node != NONE);
        for (member, (_, body)) in (0..).zip(finals()) {
            let nodes = body.nodes.iter().filter_map(shared);
            pairs.extend(nodes.map(|node| (member, node)));
        }
        for (member, (i, j)) in (members as u32 - edges.len() as u32..).zip(edges) {
            let nodes = [i, j].into_iter().filter_map(shared);
            pairs.extend(nodes.map(|node| (member, node)));
        }

        let first_node = members as u32;
        let members_first = pairs.iter().map(|&(member, v)| (member, first_node + v));
        let nodes_after = pairs.iter().map(|&(member, v)| (first_node + v, member));
        let both_ways = members_first.chain(nodes_after);
        let mut incidence = Lists::group(members + names.len(), both_ways);
        prune_leaves(&mut incidence, |_| false);

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
            general,
            part,
            parent: (0..members as u32).collect(),
            own,
            ways: vec![way; members],
            reaches: vec![reach; names.len()],
            branches: vec![(NONE, NONE); names.len()],
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

    /// Whether a member is a body that holds a known displacement.
    fn is_scaled(&self, member: u32, bodies: &[Body]) -> bool {
        match self.part[member as usize] {
            Part::Body(k) => bodies[k as usize].scaled,
            Part::Edge(..) => false,
        }
    }

    /// Whether shared nodes, three or four, are in general position.
    fn is_general<const K: usize>(&self, at: [u32; K]) -> bool {
        let General(placed) = &self.general;
        let names = || at.map(|v| self.names[v as usize]);
        placed.is_none() || self.general.holds(&names())
    }

    fn size(&self, member: u32) -> usize {
        self.own[member as usize].len()
    }

    /// How many members hold a node: no fewer than there are, and as many after
    /// [`holders_of`](Self::holders_of).
    fn held_by(&self, v: u32) -> usize {
        self.holders.of(v as usize).len()
    }

    /// The bodies with shared nodes, and the nodes that two members hold, by falling rank.
    fn by_falling_rank(&mut self) -> Vec<Start> {
        let mut order: Vec<(usize, Start)> = Vec::new();
        for v in 0..self.names.len() as u32 {
            let rank = self.holders_of(v).len();
            if rank > 1 {
                order.push((rank, Start::Node(v)));
            }
        }
        for k in 0..self.members() as u32 {
            let is_body = matches!(self.part[k as usize], Part::Body(_));
            if is_body && self.size(k) > 0 {
                order.push((self.size(k), Start::Body(k)));
            }
        }
        order.sort_by_key(|&(rank, _)| std::cmp::Reverse(rank));
        order.into_iter().map(|(_, start)| start).collect()
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
        let first = self.held_by(v);
        let mut now = Vec::with_capacity(first);
        for at in 0..first {
            let current = self.current(self.holders.of(v as usize)[at]);
            if self.listed[current as usize] != self.listings {
                self.listed[current as usize] = self.listings;
                now.push(current);
            }
        }
        self.holders.rewrite(v as usize, &now);
        now
    }

    /// A search more.
    fn begin_search(&mut self) -> u32 {
        self.searches += 1;
        self.searches
    }
}

/// Puts two lists together, into the longer one. Their order does not matter.
fn append_smaller(list: &mut Vec<u32>, mut other: Vec<u32>) {
    if other.len() > list.len() {
        std::mem::swap(list, &mut other);
    }
    list.append(&mut other);
}
