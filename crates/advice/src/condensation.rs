//! Rigid parts and pairs as one small graph with the same number of degrees of freedom
//! (docs/theory.md, Theorem 4.4; 4.11 in the calibrated model, 13.18 with known displacements).

use crate::parts::Parts;
use viewcert::decide::{Options, Verdict, VerdictError, decide};
use viewcert::graph::Displacements;
use viewcert::{Graph, Strength};

/// Rigid parts, each of them a chain of triangles on its terminals, and pairs.
///
/// The terminals of a part hold all its nodes that lie in a second part or in a pair, and two nodes
/// at least. Then rank required and rank fall short of each other by the same number here
/// and in the union of the whole parts and the pairs.
#[derive(Clone, Debug)]
pub(crate) struct Condensation {
    /// The nodes, increasing; the graph has their numbers in this list.
    pub nodes: Vec<u32>,
    /// Chains and pairs.
    pub graph: Graph,
    /// The terminals of every part, increasing, as nodes of the graph.
    pub terminals: Vec<Vec<u32>>,
    /// Pairs of the graph whose displacement is known: those of parts of known scale.
    pub known: Vec<(u32, u32)>,
}

impl Condensation {
    /// Condenses parts with given terminals, which are sorted here, and pairs; `alone` are further
    /// nodes, which may have no pair. O(t log t) for t terminals.
    pub(crate) fn new(
        mut terminals: Vec<Vec<u32>>,
        pairs: impl Iterator<Item = (u32, u32)> + Clone,
        alone: impl Iterator<Item = u32>,
    ) -> Self {
        let ends = pairs.clone().flat_map(|(a, b)| [a, b]);
        let mut nodes: Vec<u32> = terminals.iter().flatten().copied().collect();
        nodes.extend(ends.chain(alone));
        nodes.sort_unstable();
        nodes.dedup();
        let number = |v: u32| nodes.binary_search(&v).expect("a node") as u32;
        let mut edges: Vec<(u32, u32)> = pairs.map(|(a, b)| (number(a), number(b))).collect();
        for part in &mut terminals {
            part.iter_mut().for_each(|v| *v = number(*v));
            part.sort_unstable();
            part.dedup();
            edges.extend(chain(part));
        }
        let graph = Graph::new(nodes.len() as u32, edges).expect("pairs of different nodes");
        Self {
            nodes,
            graph,
            terminals,
            known: Vec::new(),
        }
    }

    /// The same where some of the parts have a known scale: all displacements in them are known.
    /// Nothing changes if there are none. O(edges times parts of a node).
    #[must_use]
    pub(crate) fn with_scales(mut self, parts: &Parts) -> Self {
        let edges = self.graph.edges().iter().copied();
        let of = |v: u32| self.nodes[v as usize];
        let known = edges.filter(|&(i, j)| parts.is_displacement((of(i), of(j))));
        self.known = known.collect();
        self
    }

    /// The question about this graph, or one with further edges.
    pub(crate) fn options(&self, options: &Options) -> Options {
        if self.known.is_empty() {
            return options.clone();
        }
        let known = Displacements::new(self.nodes.len() as u32, self.known.iter().copied());
        let known = known.expect("edges of the graph");
        options.clone().displacements(known)
    }

    /// How many degrees of freedom it has with further edges, and how strong that is.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub(crate) fn freedom(
        &self,
        more: impl IntoIterator<Item = (u32, u32)>,
        options: &Options,
    ) -> Result<(usize, Strength), VerdictError> {
        let verdict = decide(&with(&self.graph, more), &self.options(options))?;
        Ok((shortfall(&verdict), verdict.rank_claim().strength))
    }

    /// The number of a node, if it is here.
    pub(crate) fn number(&self, node: u32) -> Option<u32> {
        self.nodes.binary_search(&node).ok().map(|k| k as u32)
    }

    /// A pair of nodes that are here, as nodes of the graph, the smaller one first.
    pub(crate) fn pair(&self, (a, b): (u32, u32)) -> (u32, u32) {
        let at = |v| self.number(v).expect("a node of the condensation");
        (at(a).min(at(b)), at(a).max(at(b)))
    }
}

/// The edges of a chain of triangles: consecutive terminals, and those two apart.
pub(crate) fn chain(terminals: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    [1, 2].into_iter().flat_map(|step| {
        let ahead = terminals.iter().skip(step);
        terminals.iter().zip(ahead).map(|(&a, &b)| (a, b))
    })
}

/// The terminals of parts: the nodes that lie in two of them or are in `others`, and so many
/// more, the first ones, that each part has two. O(s log s) for parts of s nodes together.
///
/// # Panics
/// If a part has fewer than two nodes.
pub(crate) fn terminals(parts: &[&[u32]], others: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
    let mut marked: Vec<u32> = parts.iter().flat_map(|part| part.iter().copied()).collect();
    marked.sort_unstable();
    let twice = marked.windows(2).filter(|two| two[0] == two[1]);
    let mut marked: Vec<u32> = twice.map(|two| two[0]).chain(others).collect();
    marked.sort_unstable();
    marked.dedup();
    let of_part = |part: &&[u32]| {
        let (mut found, rest): (Vec<u32>, Vec<u32>) =
            part.iter().partition(|v| marked.binary_search(v).is_ok());
        let missing = 2usize.saturating_sub(found.len());
        assert!(rest.len() >= missing, "a part of two nodes or more");
        found.extend(&rest[..missing]);
        found
    };
    parts.iter().map(of_part).collect()
}

/// A graph without some of its edges, which are given increasing. O(m log k).
pub(crate) fn without(graph: &Graph, gone: &[(u32, u32)]) -> Graph {
    let left = graph.edges().iter().copied();
    let left = left.filter(|pair| gone.binary_search(pair).is_err());
    Graph::new(graph.nodes() as u32, left).expect("edges of a graph")
}

/// A graph with further edges.
pub(crate) fn with(graph: &Graph, more: impl IntoIterator<Item = (u32, u32)>) -> Graph {
    let edges = graph.edges().iter().copied().chain(more);
    Graph::new(graph.nodes() as u32, edges).expect("edges between its nodes")
}

/// By how much the rank falls short of that of a solvable graph.
pub(crate) fn shortfall(verdict: &Verdict) -> usize {
    verdict.required - verdict.rank
}
