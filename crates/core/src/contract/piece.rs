//! Cutting a contracted graph into pieces at its articulation nodes, and the core of
//! a piece (docs/theory.md, section 4).
//!
//! Ranks add up over pieces and no component lies in two of them, so each piece is
//! decided by itself, on its core: the nodes that its members share.

use crate::contract::Contraction;
use crate::geometry::model::Model;
use crate::geometry::placed::Placed;
use crate::graph::{Graph, Lists, UnionFind, biconnected_components};
use std::collections::BTreeMap;

/// Some members of a contracted graph: final bodies and loose edges.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Members {
    /// Loose edges, increasing.
    pub edges: Vec<(u32, u32)>,
    /// Numbers of final bodies, increasing.
    pub bodies: Vec<u32>,
}

impl Members {
    /// How many members there are.
    pub fn len(&self) -> usize {
        self.edges.len() + self.bodies.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The members of each class, classes in the order of their first members. Members
    /// are counted bodies first, then edges, as in `Core::owner`.
    ///
    /// # Panics
    /// If a class is not named by a number below that of the members.
    pub fn grouped(&self, mut class: impl FnMut(usize) -> usize) -> Vec<Self> {
        let mut position = vec![None; self.len()];
        let mut groups: Vec<Self> = Vec::new();
        for member in 0..self.len() {
            let at = *position[class(member)].get_or_insert_with(|| {
                groups.push(Self::default());
                groups.len() - 1
            });
            match self.bodies.get(member) {
                Some(&body) => groups[at].bodies.push(body),
                None => groups[at]
                    .edges
                    .push(self.edges[member - self.bodies.len()]),
            }
        }
        groups
    }

    /// Where the members of a part stand among these: bodies first, then edges.
    ///
    /// # Panics
    /// If a member of the part is not one of these.
    pub fn positions(&self, part: &Self) -> Vec<usize> {
        let body = |body| self.bodies.binary_search(body).expect("a member");
        let edge = |edge| self.edges.binary_search(edge).expect("a member");
        part.bodies
            .iter()
            .map(body)
            .chain(part.edges.iter().map(|e| self.bodies.len() + edge(e)))
            .collect()
    }

    /// Whether all members of a part are among these.
    pub fn contains(&self, part: &Self) -> bool {
        let body = |body| self.bodies.binary_search(body).is_ok();
        let edge = |edge| self.edges.binary_search(edge).is_ok();
        part.bodies.iter().all(body) && part.edges.iter().all(edge)
    }

    /// Takes in the members of another part.
    pub fn extend(&mut self, part: &Self) {
        self.bodies.extend(&part.bodies);
        self.edges.extend(&part.edges);
        self.sort();
    }

    /// Each member by itself.
    pub fn singles(&self) -> Vec<Self> {
        self.grouped(|member| member)
    }

    fn sort(&mut self) {
        self.edges.sort_unstable();
        self.bodies.sort_unstable();
    }
}

/// A contracted graph: which member contains which of the nodes that members share.
#[derive(Clone, Debug)]
pub(crate) struct Assembly {
    all: Members,
    /// For every body of the contraction those of its nodes, increasing, that lie in
    /// a second member; empty for consumed bodies.
    shared: Vec<Vec<u32>>,
    /// Number of nodes of every body.
    size: Vec<usize>,
    /// Whether the scale of every body is known.
    scaled: Vec<bool>,
    /// Where given vectors put the nodes, and what counting has to know besides.
    given: Option<GivenVectors>,
}

/// Given vectors between nodes, and the groups in bodies.
#[derive(Clone, Debug)]
struct GivenVectors {
    placed: Placed,
    /// The nodes of every body; empty for consumed ones.
    nodes: Vec<Vec<u32>>,
}

/// Some members, cut at their articulation nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Split {
    /// The members that are pieces by themselves.
    pub rigid: Members,
    /// The other pieces, each of two members or more, in a fixed order.
    pub pieces: Vec<Members>,
}

impl Core {
    /// The rank of the core of a finite solvable piece.
    pub(crate) fn required(&self, model: Model) -> usize {
        model.required(self.graph.nodes()) + usize::from(!self.scales.is_empty())
    }
}

impl Assembly {
    /// The structure of a contracted graph. O(n + loose edges).
    pub(crate) fn new(graph: &Graph, contraction: &Contraction) -> Self {
        let mut count = vec![0u8; graph.nodes()];
        let mut see = |v: u32| count[v as usize] = count[v as usize].saturating_add(1);
        for &body in &contraction.finals {
            let nodes = &contraction.bodies[body as usize].nodes;
            nodes.iter().copied().for_each(&mut see);
        }
        for &(i, j) in &contraction.loose {
            see(i);
            see(j);
        }
        let shared = |v: &u32| count[*v as usize] > 1;
        let bodies = &contraction.bodies;
        Self {
            all: Members {
                edges: contraction.loose.clone(),
                bodies: contraction.finals.clone(),
            },
            shared: bodies
                .iter()
                .map(|body| body.nodes.iter().copied().filter(shared).collect())
                .collect(),
            size: bodies.iter().map(|body| body.nodes.len()).collect(),
            scaled: bodies.iter().map(|body| body.scaled).collect(),
            given: None,
        }
    }

    /// The same where the vectors between some nodes are given.
    pub(crate) fn with_vectors(self, contraction: &Contraction, placed: Option<Placed>) -> Self {
        let bodies = contraction.bodies.iter();
        let given = placed.map(|placed| GivenVectors {
            placed,
            nodes: bodies.map(|body| body.nodes.clone()).collect(),
        });
        Self { given, ..self }
    }

    /// Where given vectors put the nodes, if there are any.
    pub(crate) fn placed(&self) -> Option<&Placed> {
        self.given.as_ref().map(|given| &given.placed)
    }

    /// The nodes of a final body.
    ///
    /// # Panics
    /// If no vectors are given.
    pub(crate) fn nodes_of_body(&self, body: u32) -> &[u32] {
        &self.given.as_ref().expect("given vectors").nodes[body as usize]
    }

    /// All members.
    pub(crate) fn all(&self) -> Members {
        self.all.clone()
    }

    /// Cuts some members at the nodes that are articulations of their structure. Linear
    /// time, up to sorting.
    pub(crate) fn split(&self, part: &Members) -> Split {
        let piece_of = piece_of_members(part, &self.shared);
        let mut split = Split {
            rigid: Members::default(),
            pieces: Vec::new(),
        };
        for piece in part.grouped(|member| piece_of[member] as usize) {
            if piece.len() == 1 {
                split.rigid.bodies.extend(piece.bodies);
                split.rigid.edges.extend(piece.edges);
            } else {
                split.pieces.push(piece);
            }
        }
        split.rigid.sort();
        split.pieces.sort();
        split
    }

    /// Some members as one piece, whatever their articulations (a single member is rigid
    /// all the same, and none are no piece).
    pub(crate) fn whole(&self, part: &Members) -> Split {
        let (rigid, pieces) = if part.len() < 2 {
            (part.clone(), Vec::new())
        } else {
            (Members::default(), vec![part.clone()])
        };
        Split { rigid, pieces }
    }

    /// The core of a piece, or of a part of it.
    ///
    /// # Panics
    /// If two members share two nodes, which a contraction excludes.
    pub(crate) fn core(&self, part: &Members) -> Core {
        let mut nodes: Vec<u32> = part.edges.iter().flat_map(|&(i, j)| [i, j]).collect();
        let mut of_bodies: Vec<u32> = part
            .bodies
            .iter()
            .flat_map(|&b| self.shared[b as usize].iter().copied())
            .collect();
        of_bodies.sort_unstable();
        nodes.extend(
            of_bodies
                .windows(2)
                .filter(|pair| pair[0] == pair[1])
                .map(|pair| pair[0]),
        );
        crate::graph::sort_once(&mut nodes);

        let number = |v: &u32| nodes.binary_search(v).ok().map(|k| k as u32);
        let mut edges: Vec<(u32, u32, u32)> = Vec::new();
        let mut outside = 0;
        let mut scales = Vec::new();
        for (member, &body) in (0..).zip(&part.bodies) {
            let at: Vec<u32> = self.shared[body as usize]
                .iter()
                .filter_map(number)
                .collect();
            outside += self.size[body as usize] - at.len();
            let steps: &[usize] = match (self.scaled[body as usize], &self.given) {
                // Its nodes may lie on a line: what is known between neighbours is all.
                (true, Some(_)) => {
                    scales.extend(at.windows(2).map(|pair| (pair[0], pair[1])));
                    &[1]
                }
                (true, None) => {
                    scales.extend(at.first_chunk().map(|&[first, second]| (first, second)));
                    &[1, 2]
                }
                (false, _) => &[1, 2],
            };
            for &step in steps {
                edges.extend(
                    at.iter()
                        .zip(at.iter().skip(step))
                        .map(|(&a, &b)| (a, b, member)),
                );
            }
        }
        for (member, (i, j)) in (part.bodies.len() as u32..).zip(&part.edges) {
            let ends = number(i).zip(number(j)).expect("ends of edges are nodes");
            edges.push((ends.0, ends.1, member));
        }
        edges.sort_unstable();
        let owner = edges.iter().map(|&(_, _, member)| member).collect();
        let pairs = edges.into_iter().map(|(a, b, _)| (a, b)).collect();
        let (graph, merged) = Graph::from_pairs(nodes.len() as u32, pairs)
            .expect("core edges join two different core nodes");
        assert_eq!(merged, 0, "two members share two nodes");
        Core {
            total_nodes: nodes.len() + outside,
            known: self
                .placed()
                .map_or_else(Vec::new, |placed| known(placed, &nodes)),
            nodes,
            graph,
            owner,
            scales,
        }
    }

    /// Whether a part holds a known displacement.
    pub(crate) fn is_scaled(&self, part: &Members) -> bool {
        part.bodies.iter().any(|&body| self.scaled[body as usize])
    }

    /// The rank of a finite solvable part, or of a body, with the nodes of this part: that of the
    /// model, and one more if the scale is known (Theorem 13.16).
    pub(crate) fn required(&self, model: Model, part: &Members) -> usize {
        model.required(self.count_nodes(part)) + usize::from(self.is_scaled(part))
    }

    /// Parts with those that are scaled and share a node united, in the order of their first ones
    /// (Theorem 13.17).
    pub(crate) fn joined(&self, parts: Vec<Members>) -> Vec<Members> {
        let mut sets = UnionFind::new(parts.len());
        let mut at: BTreeMap<u32, usize> = BTreeMap::new();
        for (k, part) in parts.iter().enumerate().filter(|(_, p)| self.is_scaled(p)) {
            let of_bodies = part.bodies.iter().flat_map(|&b| &self.shared[b as usize]);
            let of_edges = part.edges.iter().flat_map(|(i, j)| [i, j]);
            for &node in of_bodies.chain(of_edges) {
                sets.union(*at.entry(node).or_insert(k), k);
            }
        }
        let mut place = vec![None; parts.len()];
        let mut joined: Vec<Members> = Vec::new();
        for (k, part) in parts.into_iter().enumerate() {
            let set = sets.find(k);
            match place[set] {
                None => {
                    place[set] = Some(joined.len());
                    joined.push(part);
                }
                Some(at) => joined[at].extend(&part),
            }
        }
        joined
    }

    /// Number of nodes of all members of a part together.
    pub(crate) fn count_nodes(&self, part: &Members) -> usize {
        let mut nodes: Vec<u32> = part.edges.iter().flat_map(|&(i, j)| [i, j]).collect();
        let mut inner = 0;
        for &body in &part.bodies {
            let shared = &self.shared[body as usize];
            inner += self.size[body as usize] - shared.len();
            nodes.extend(shared);
        }
        crate::graph::sort_once(&mut nodes);
        inner + nodes.len()
    }

    /// Whether a part contains a node that lies in two members or more.
    pub(crate) fn contains_node(&self, part: &Members, node: u32) -> bool {
        let in_body = |&b: &u32| self.shared[b as usize].binary_search(&node).is_ok();
        part.edges.iter().any(|&(i, j)| i == node || j == node) || part.bodies.iter().any(in_body)
    }
}

/// The core of a piece: its shared nodes, with a chain of triangles in the place of
/// every body.
#[derive(Clone, Debug)]
pub(crate) struct Core {
    /// The core's nodes as nodes of the whole graph, increasing.
    pub nodes: Vec<u32>,
    /// The core on the nodes `0 .. nodes.len()`.
    pub graph: Graph,
    /// For every core edge the member it stands for: first the bodies, then the
    /// edges, counted in the order of the part.
    pub owner: Vec<u32>,
    /// For every scaled body the first edge of its chain, in the order of the part; if vectors are
    /// given, all edges of its chain, a path.
    pub scales: Vec<(u32, u32)>,
    /// If vectors are given: for every node of the core the first one of its group that comes
    /// before it, if there is one, and the vector from there.
    pub(crate) known: Vec<Option<(usize, [i128; 3])>>,
    /// Number of nodes of the piece itself.
    pub total_nodes: usize,
}

/// For each of some nodes the first one of its group among those before it, and the vector from
/// there.
fn known(placed: &Placed, nodes: &[u32]) -> Vec<Option<(usize, [i128; 3])>> {
    let mut first = BTreeMap::new();
    let mut known = Vec::with_capacity(nodes.len());
    for (k, &v) in nodes.iter().enumerate() {
        let at = *first.entry(placed.first(v)).or_insert(k);
        known.push((at < k).then(|| (at, placed.between(nodes[at], v))));
    }
    known
}

/// The number of its piece for every member of a part, bodies first, then edges; `shared` lists
/// the shared nodes of every body.
///
/// Members are in one piece if they lie on a common cycle of the bipartite graph of members and
/// shared nodes, or are linked by such cycles.
fn piece_of_members(part: &Members, shared: &[Vec<u32>]) -> Vec<u32> {
    let members = part.len();
    let mut pieces = UnionFind::new(members);
    biconnected_components(&incidence(part, shared), |component| {
        // Two vertices are a bridge and not a cycle.
        if component.len() > 2 {
            let mut of_component = component.iter().filter(|&&v| (v as usize) < members);
            if let Some(&first) = of_component.next() {
                for &other in of_component {
                    pieces.union(first as usize, other as usize);
                }
            }
        }
    });
    (0..members)
        .map(|member| pieces.find(member) as u32)
        .collect()
}

/// The bipartite graph of the members of a part, which come first, and the nodes that they share.
fn incidence(part: &Members, shared: &[Vec<u32>]) -> Lists {
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for (member, &body) in (0..).zip(&part.bodies) {
        pairs.extend(shared[body as usize].iter().map(|&v| (member, v)));
    }
    for (member, &(i, j)) in (part.bodies.len() as u32..).zip(&part.edges) {
        pairs.extend([(member, i), (member, j)]);
    }
    let mut nodes: Vec<u32> = pairs.iter().map(|&(_, v)| v).collect();
    crate::graph::sort_once(&mut nodes);
    for (_, v) in &mut pairs {
        *v = (part.len() + nodes.partition_point(|w| w < v)) as u32;
    }
    let members_first = pairs.iter().copied();
    let nodes_after = pairs.iter().map(|&(member, v)| (v, member));
    Lists::group(part.len() + nodes.len(), members_first.chain(nodes_after))
}

#[cfg(test)]
mod tests;
