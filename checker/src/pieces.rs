//! Final bodies and loose edges, the pieces they form, and the cores of pieces (section 6 of the specification).

use crate::bodies::read_edge;
use crate::graph::Graph;
use crate::json::{Members, Value};
use crate::rejection::{Checked, Rejection, Within, ensure};

/// A set of members: final bodies and loose edges, both in increasing order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Part {
    pub bodies: Vec<usize>,
    pub edges: Vec<(u32, u32)>,
}

impl Part {
    /// The number of members.
    pub fn len(&self) -> usize {
        self.bodies.len() + self.edges.len()
    }

    /// The positions here of the members of another part, bodies first.
    fn positions(&self, other: &Part) -> impl Iterator<Item = Option<usize>> {
        let edge = |edge| self.edges.binary_search(edge).ok().map(|position| self.bodies.len() + position);
        let bodies = other.bodies.iter().map(|body| self.bodies.binary_search(body).ok());
        bodies.chain(other.edges.iter().map(edge))
    }

    fn describe(&self, position: usize) -> String {
        match self.bodies.get(position) {
            Some(body) => format!("body {body}"),
            None => format!("the edge {:?}", self.edges[position - self.bodies.len()]),
        }
    }
}

/// The parts of a partition with what else was read of each, and for each member of the whole its part's number.
type Partition<T> = (Vec<(Part, T)>, Vec<usize>);

/// A final body. Only contacts matter to the rest: nodes that lie in another member, too.
struct Body {
    contacts: Vec<u32>,
    /// The number of the other nodes.
    inner: usize,
}

/// All members of the graph.
pub(crate) struct Structure<'a> {
    graph: &'a Graph,
    bodies: Vec<Option<Body>>,
    /// The final bodies of every node, in increasing order.
    bodies_of: Vec<Vec<u32>>,
    /// All final bodies and loose edges.
    pub everything: Part,
}

/// Pieces being laid out within a set of members: each member once, and no cycle of pieces.
pub(crate) struct Layout<'s> {
    structure: &'s Structure<'s>,
    whole: &'s Part,
    placed: Vec<bool>,
    /// The nodes at which pieces can touch, and a union-find over their positions (first) and the pieces.
    nodes: Vec<u32>,
    touching: Forest,
}

/// The graph on which a piece or part is computed.
pub(crate) struct Core {
    pub nodes: usize,
    pub edges: Vec<(usize, usize)>,
    /// For each edge the position of its member in the part (bodies come first).
    pub member: Vec<usize>,
}

/// Union-find with path halving.
pub(crate) struct Forest(Vec<usize>);

impl Forest {
    pub fn new(size: usize) -> Forest {
        Forest((0..size).collect())
    }

    /// Adds one element.
    fn add(&mut self) -> usize {
        self.0.push(self.0.len());
        self.0.len() - 1
    }

    pub fn find(&mut self, mut at: usize) -> usize {
        while self.0[at] != at {
            self.0[at] = self.0[self.0[at]];
            at = self.0[at];
        }
        at
    }

    /// Whether the two were not connected before.
    pub fn unite(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        // The smaller index stays the root: cheap, and short paths for what occurs here.
        self.0[a.max(b)] = a.min(b);
        a != b
    }
}

impl<'s> Layout<'s> {
    pub fn new(structure: &'s Structure<'s>, whole: &'s Part) -> Layout<'s> {
        let mut nodes = structure.ends(whole);
        nodes.dedup();
        let touching = Forest::new(nodes.len());
        Layout { structure, whole, placed: vec![false; whole.len()], nodes, touching }
    }

    /// Places one piece.
    pub fn place(&mut self, part: &Part) -> Checked<()> {
        for position in self.whole.positions(part) {
            let position = position.ok_or_else(|| Rejection::new("a body or edge from elsewhere"))?;
            ensure!(!std::mem::replace(&mut self.placed[position], true), "a body or edge that stands in two pieces");
        }
        let mut ends = self.structure.ends(part);
        ends.dedup();
        let piece = self.touching.add();
        for node in ends {
            let new = self.touching.unite(self.nodes.partition_point(|&other| other < node), piece);
            ensure!(new, "the piece closes a cycle of pieces at node {node}");
        }
        Ok(())
    }

    /// Rejects if a member is in no piece.
    pub fn end(self) -> Checked<()> {
        let missing = self.placed.iter().position(|&placed| !placed);
        ensure!(missing.is_none(), "{} is in no piece", self.whole.describe(missing.unwrap_or_default()));
        Ok(())
    }
}

impl<'a> Structure<'a> {
    /// Finds which edges each body covers; rejects an edge covered twice.
    pub fn new(graph: &'a Graph, finals: Vec<Option<Vec<u32>>>) -> Checked<Structure<'a>> {
        let mut bodies_of = vec![Vec::new(); graph.nodes()];
        for (k, nodes) in finals.iter().enumerate() {
            for &node in nodes.iter().flatten() {
                bodies_of[node as usize].push(k as u32);
            }
        }
        let mut touched = vec![false; graph.nodes()];
        let mut everything = Part::default();
        for (i, j) in graph.pairs() {
            let (a, b) = (&bodies_of[i as usize], &bodies_of[j as usize]);
            // The shorter list is walked, the longer one searched: hubs in many bodies stay cheap.
            let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
            let covering = short.iter().filter(|&body| long.binary_search(body).is_ok()).count();
            ensure!(covering <= 1, "the edge [{i}, {j}] is covered by two bodies");
            if covering == 0 {
                everything.edges.push((i, j));
                touched[i as usize] = true;
                touched[j as usize] = true;
            }
        }
        let contact = |node: &u32| touched[*node as usize] || bodies_of[*node as usize].len() > 1;
        let body = |nodes: Vec<u32>| {
            let contacts: Vec<u32> = nodes.iter().copied().filter(contact).collect();
            Body { inner: nodes.len() - contacts.len(), contacts }
        };
        everything.bodies = (0..finals.len()).filter(|&k| finals[k].is_some()).collect();
        let bodies = finals.into_iter().map(|nodes| nodes.map(body)).collect();
        Ok(Structure { graph, bodies, bodies_of, everything })
    }

    /// Reads the members `bodies` and `edges`. That they belong together is for `place` or `partition` to see.
    pub fn read_part(&self, members: &mut Members) -> Checked<Part> {
        let bodies = members.read("bodies", |list| list.increasing(self.bodies.len()))?;
        let edges = members.read("edges", |list| {
            let edges: Checked<Vec<_>> = list.list()?.iter().map(|edge| Ok(read_edge(edge, self.graph)?.0)).collect();
            edges.and_then(|edges| {
                ensure!(edges.windows(2).all(|pair| pair[0] < pair[1]), "the list is not increasing");
                Ok(edges)
            })
        })?;
        for &body in &bodies {
            ensure!(self.bodies[body].is_some(), "body {body} is not a final one");
        }
        Ok(Part { bodies, edges })
    }

    /// Takes a list of objects with `bodies` and `edges` that are a partition of a part; `rest` reads other members.
    /// Returns the parts, and for each member of the whole (bodies first) the number of its part.
    pub fn read_partition<T>(
        &self,
        whole: &Part,
        name: &str,
        members: &mut Members,
        rest: impl Fn(&mut Members, &Part) -> Checked<T>,
    ) -> Checked<Partition<T>> {
        let mut parts = Vec::new();
        let mut owner = vec![usize::MAX; whole.len()];
        for (k, value) in members.read(name, Value::list)?.iter().enumerate() {
            let mut read = || {
                let mut members = value.members()?;
                let part = self.read_part(&mut members)?;
                ensure!(part.len() > 0, "no members");
                for position in whole.positions(&part) {
                    let position = position.ok_or_else(|| Rejection::new("a body or edge from elsewhere"))?;
                    ensure!(owner[position] == usize::MAX, "a body or edge that stands in two parts");
                    owner[position] = k;
                }
                let rest = rest(&mut members, &part)?;
                members.end()?;
                Ok((part, rest))
            };
            parts.push(read().within(|| format!("{name}[{k}]"))?);
        }
        ensure!(owner.iter().all(|&part| part != usize::MAX), "`{name}` leaves out a body or edge");
        Ok((parts, owner))
    }

    /// The nodes of a part that matter: contacts of its bodies and ends of its edges, sorted, with repetitions.
    fn ends(&self, part: &Part) -> Vec<u32> {
        let mut ends: Vec<u32> = part.edges.iter().flat_map(|&(i, j)| [i, j]).collect();
        ends.extend(self.bodies_in(part).flat_map(|body| &body.contacts));
        ends.sort_unstable();
        ends
    }

    fn bodies_in(&self, part: &Part) -> impl Iterator<Item = &Body> {
        part.bodies.iter().filter_map(|&body| self.bodies[body].as_ref())
    }

    /// The number of nodes of a part.
    pub fn size(&self, part: &Part) -> usize {
        let mut ends = self.ends(part);
        ends.dedup();
        ends.len() + self.bodies_in(part).map(|body| body.inner).sum::<usize>()
    }

    /// Whether a node lies in a part.
    pub fn contains(&self, part: &Part, node: u32) -> bool {
        let bodies = self.bodies_of.get(node as usize).map_or(&[][..], |list| list);
        bodies.iter().any(|&body| part.bodies.binary_search(&(body as usize)).is_ok())
            || part.edges.iter().any(|&(i, j)| i == node || j == node)
    }

    /// The contacts or ends of each member of a part, bodies first.
    pub fn member_ends(&self, part: &Part) -> impl Iterator<Item = Vec<u32>> {
        let bodies = self.bodies_in(part).map(|body| body.contacts.clone());
        bodies.chain(part.edges.iter().map(|&(i, j)| vec![i, j]))
    }

    /// The core of a part.
    pub fn core(&self, part: &Part) -> Checked<Core> {
        // Ends of loose edges are in the core in any case: they count twice.
        let mut ends = self.ends(part);
        ends.extend(part.edges.iter().flat_map(|&(i, j)| [i, j]));
        ends.sort_unstable();
        let mut nodes: Vec<u32> = ends.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
        nodes.dedup();
        let number = |node: &u32| nodes.binary_search(node).ok();
        let mut edges = Vec::new();
        for (member, ends) in self.member_ends(part).enumerate() {
            let chain: Vec<usize> = ends.iter().filter_map(number).collect();
            ensure!(chain.len() >= 2, "a body of the part has fewer than two nodes in the core");
            for distance in [1, 2] {
                edges.extend(chain.iter().zip(&chain[distance..]).map(|(&i, &j)| (i, j, member)));
            }
        }
        edges.sort_unstable();
        let repeated = edges.windows(2).any(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1));
        ensure!(!repeated, "an edge of the core arises twice");
        let member = edges.iter().map(|&(_, _, member)| member).collect();
        Ok(Core { nodes: nodes.len(), edges: edges.into_iter().map(|(i, j, _)| (i, j)).collect(), member })
    }
}
