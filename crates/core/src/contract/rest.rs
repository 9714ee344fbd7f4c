//! Some edges of a graph as a graph of their own, its nodes numbered in the order in which the
//! edges name them: so neighbours lie close to each other in memory, and nothing is as long as the
//! graph has nodes.

use super::body::{Body, Merge, Part, Seed};
use crate::graph::{Adjacency, Lists};

const NONE: u32 = u32::MAX;

/// Some edges of a graph, with nodes of their own.
pub(super) struct Rest {
    /// The edges by the numbers of their nodes here, either end first.
    edges: Vec<(u32, u32)>,
    /// The nodes of the graph.
    names: Vec<u32>,
    /// Whether a body holds the node already.
    held: Vec<bool>,
}

impl Rest {
    /// Numbers the nodes of some edges of a graph with so many nodes; `bodies` hold some of these.
    /// O(n + m).
    pub(super) fn new(nodes: usize, mut edges: Vec<(u32, u32)>, bodies: &[Body]) -> Self {
        let mut number = vec![NONE; nodes];
        let mut names = Vec::new();
        let mut number_of = |v: u32| {
            let number = &mut number[v as usize];
            if *number == NONE {
                *number = names.len() as u32;
                names.push(v);
            }
            *number
        };
        for (i, j) in &mut edges {
            *i = number_of(*i);
            *j = number_of(*j);
        }
        let mut held = vec![false; names.len()];
        for v in bodies.iter().flat_map(|body| &body.nodes) {
            if let Some(held) = held.get_mut(number[*v as usize] as usize) {
                *held = true;
            }
        }
        Self { edges, names, held }
    }

    /// The neighbours of every node.
    pub(super) fn adjacency(&self) -> Adjacency {
        let forth = self.edges.iter().copied();
        let back = self.edges.iter().map(|&(i, j)| (j, i));
        Adjacency::of_lists(Lists::group(self.names.len(), back.chain(forth)))
    }

    /// Whether a body holds a node already.
    pub(super) fn is_held(&self, node: u32) -> bool {
        self.held[node as usize]
    }

    /// A node of the graph.
    pub(super) fn node(&self, v: u32) -> u32 {
        self.names[v as usize]
    }

    /// An edge of the graph, the smaller end first.
    pub(super) fn edge(&self, (a, b): (u32, u32)) -> (u32, u32) {
        let (a, b) = (self.names[a as usize], self.names[b as usize]);
        (a.min(b), a.max(b))
    }

    /// A body that was made here, as one of the graph; `before` bodies of the graph come before
    /// the first one made here.
    pub(super) fn body(&self, mut body: Body, before: u32) -> Body {
        let name = |v: &mut u32| *v = self.names[*v as usize];
        let part = |part: &mut Part| match part {
            Part::Edge(a, b) => (*a, *b) = self.edge((*a, *b)),
            Part::Body(k) => *k += before,
        };
        match &mut body.seed {
            Seed::Edge(a, b) => (*a, *b) = self.edge((*a, *b)),
            Seed::Body(k) => *k += before,
            Seed::Known => (),
            Seed::Rank(_) => unreachable!("nothing is known of ranks here"),
        }
        body.add.iter_mut().flatten().for_each(name);
        for merge in &mut body.merge {
            let (parts, at): (&mut [Part], &mut [u32]) = match merge {
                Merge::Scaled { part, at } => (std::slice::from_mut(part), at),
                Merge::Shared { part, at } => (std::slice::from_mut(part), at),
                Merge::Triangle { parts, at } => (parts, at),
                Merge::Cycle { parts, at } => (parts, at),
                Merge::Biclique { parts, at } => (parts, at),
                Merge::Tripod { parts, at } => (parts, at),
                Merge::Link { parts, at } => (parts, at),
            };
            parts.iter_mut().for_each(part);
            at.iter_mut().for_each(name);
        }
        body.nodes.iter_mut().for_each(name);
        body
    }
}
