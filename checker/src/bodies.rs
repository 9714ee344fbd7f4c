//! Rigid bodies, rebuilt step by step (section 5 of the specification).

use crate::graph::Graph;
use crate::json::Value;
use crate::rejection::{Checked, Rejection, Within, ensure};
use std::collections::HashSet;

/// Which nodes are in which set. Most nodes are in one set only, which `first` holds; the others are in `more`.
struct Sets {
    first: Vec<u32>,
    more: HashSet<(u32, u32)>,
    nodes: Vec<Vec<u32>>,
}

const NONE: u32 = u32::MAX;

impl Sets {
    fn contains(&self, set: u32, node: u32) -> bool {
        self.first[node as usize] == set || self.more.contains(&(set, node))
    }

    fn insert(&mut self, set: u32, node: u32) {
        let first = &mut self.first[node as usize];
        if *first == set {
            return;
        }
        if *first == NONE {
            *first = set;
        } else if !self.more.insert((set, node)) {
            return;
        }
        self.nodes[set as usize].push(node);
    }

    /// The union of two sets under the name of the larger one, so that all unions together take n log n steps.
    fn unite(&mut self, a: u32, b: u32) -> u32 {
        let larger = if self.nodes[a as usize].len() >= self.nodes[b as usize].len() { a } else { b };
        for node in std::mem::take(&mut self.nodes[(a ^ b ^ larger) as usize]) {
            self.insert(larger, node);
        }
        larger
    }
}

/// An earlier body (by the name of its set) or an edge.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Body(u32),
    Edge(u32, u32),
}

struct Builder<'a> {
    graph: &'a Graph,
    sets: Sets,
    /// The set of every body so far; `None` once it is consumed.
    bodies: Vec<Option<u32>>,
}

/// Rebuilds all bodies; returns the nodes of each final one, in increasing order, and `None` for consumed ones.
pub(crate) fn rebuild(list: &Value, graph: &Graph) -> Checked<Vec<Option<Vec<u32>>>> {
    let sets = Sets { first: vec![NONE; graph.nodes()], more: HashSet::new(), nodes: Vec::new() };
    let mut builder = Builder { graph, sets, bodies: Vec::new() };
    for (k, body) in list.list().within(|| "bodies".into())?.iter().enumerate() {
        let set = builder.body(body).within(|| format!("bodies[{k}]"))?;
        builder.bodies.push(Some(set));
    }
    let Builder { mut sets, bodies, .. } = builder;
    let mut nodes_of = |set: u32| {
        let mut nodes = std::mem::take(&mut sets.nodes[set as usize]);
        nodes.sort_unstable();
        nodes
    };
    Ok(bodies.into_iter().map(|set| set.map(&mut nodes_of)).collect())
}

/// Reads `[i, j]` with i < j, an edge of the graph; also returns its number.
pub(crate) fn read_edge(value: &Value, graph: &Graph) -> Checked<((u32, u32), usize)> {
    let &[i, j] = value.ints()? else {
        return Err(Rejection::new("a pair has two nodes"));
    };
    let number = match (u32::try_from(i), u32::try_from(j)) {
        (Ok(i), Ok(j)) if i < j => graph.edge_number(i, j).map(|number| ((i, j), number)),
        _ => None,
    };
    number.ok_or_else(|| Rejection::new(format!("[{i}, {j}] is not an edge (i < j) of the graph")))
}

impl Builder<'_> {
    fn body(&mut self, body: &Value) -> Checked<u32> {
        let mut members = body.members()?;
        let mut set = members.read("seed", |seed| match self.part(seed)? {
            Part::Body(set) => {
                self.consume(seed)?;
                Ok(set)
            }
            Part::Edge(i, j) => {
                let set = self.sets.nodes.len() as u32;
                self.sets.nodes.push(Vec::new());
                self.sets.insert(set, i);
                self.sets.insert(set, j);
                Ok(set)
            }
        })?;
        for (k, entry) in members.read("add", Value::list)?.iter().enumerate() {
            self.add(set, entry).within(|| format!("add[{k}]"))?;
        }
        for (k, entry) in members.read("merge", Value::list)?.iter().enumerate() {
            set = self.merge(set, entry).within(|| format!("merge[{k}]"))?;
        }
        members.end()?;
        Ok(set)
    }

    fn add(&mut self, set: u32, entry: &Value) -> Checked<()> {
        let &[v, a, b] = self.nodes(entry)?.as_slice() else {
            return Err(Rejection::new("expected [v, a, b]"));
        };
        ensure!(!self.sets.contains(set, v), "node {v} is in the body already");
        ensure!(a != b, "the two nodes of the body are the same");
        for node in [a, b] {
            ensure!(self.sets.contains(set, node), "node {node} is not in the body");
            let edge = self.graph.edge_number(v.min(node), v.max(node));
            ensure!(edge.is_some(), "{v} and {node} are not joined by an edge");
        }
        self.sets.insert(set, v);
        Ok(())
    }

    fn merge(&mut self, set: u32, entry: &Value) -> Checked<u32> {
        let mut members = entry.members()?;
        let with = members.take("with")?;
        let single = with.ints().map(|list| list.iter().map(|&body| Value::Int(body)).collect::<Vec<_>>());
        let with = single.as_deref().or_else(|_| with.list()).within(|| "with".into())?;
        let at = members.read("at", |at| self.nodes(at))?;
        members.end()?;
        let inside = |part: Part, node: u32| {
            let found = match part {
                Part::Body(other) => self.sets.contains(other, node),
                Part::Edge(i, j) => node == i || node == j,
            };
            ensure!(found, "node {node} is not where the merge needs it");
            Ok(())
        };
        let body = Part::Body(set);
        let different = |nodes: &[u32]| nodes.iter().enumerate().all(|(k, node)| !nodes[..k].contains(node));
        ensure!(different(&at), "the nodes of `at` are not different");
        match (with, at.as_slice()) {
            ([x], &[a, b]) => {
                let x = self.part(x)?;
                for node in [a, b] {
                    inside(body, node)?;
                    inside(x, node)?;
                }
            }
            ([x, y], &[a, b, c]) => {
                let (x, y) = (self.part(x)?, self.part(y)?);
                ensure!(x != y, "the two parts of the merge are the same");
                for (part, node) in [(body, a), (x, a), (body, b), (y, b), (x, c), (y, c)] {
                    inside(part, node)?;
                }
            }
            _ => {
                return Err(Rejection::new("`with` and `at` have one and two, or two and three entries"));
            }
        }
        let mut set = set;
        for part in with {
            match self.part(part)? {
                Part::Body(other) => {
                    self.consume(part)?;
                    set = self.sets.unite(set, other);
                }
                Part::Edge(i, j) => {
                    self.sets.insert(set, i);
                    self.sets.insert(set, j);
                }
            }
        }
        Ok(set)
    }

    /// Reads an earlier body that is not consumed, or an edge.
    fn part(&self, value: &Value) -> Checked<Part> {
        let Value::Int(body) = value else {
            return read_edge(value, self.graph).map(|((i, j), _)| Part::Edge(i, j));
        };
        let set = usize::try_from(*body).ok().and_then(|body| self.bodies.get(body));
        let set = set.ok_or_else(|| Rejection::new(format!("{body} is not an earlier body")))?;
        set.map(Part::Body).ok_or_else(|| Rejection::new(format!("body {body} is used a second time")))
    }

    fn consume(&mut self, value: &Value) -> Checked<()> {
        self.bodies[value.count()? as usize] = None;
        Ok(())
    }

    fn nodes(&self, value: &Value) -> Checked<Vec<u32>> {
        let node = |&entry: &i64| match u32::try_from(entry) {
            Ok(node) if (node as usize) < self.graph.nodes() => Ok(node),
            _ => Err(Rejection::new(format!("{entry} is not a node"))),
        };
        value.ints()?.iter().map(node).collect()
    }
}
