//! Pieces of graphs, thinned until they are only just finite solvable.
//!
//! In: a graph. Out: a connected piece of it, drawn, and of that a subgraph on the same nodes that
//! is finite solvable and not so without any one edge: edges are removed in a random order
//! as long as finite solvability remains. What has as few edges as possible is where the number of
//! solutions is least clear (docs/theory.md, section 10).

use rand::{Rng, RngExt};
use std::ops::RangeInclusive;
use viewcert::decide::{CountSolutions, Options, Question, Value, VerdictError, decide};
use viewcert::graph::Graph;

/// A number of nodes from a range, all equally likely.
pub fn draw_size(range: &RangeInclusive<usize>, generator: &mut impl Rng) -> usize {
    generator.random_range(range.clone())
}

/// The largest component of a connected piece with so many nodes (all, if there are not as many):
/// from a random node on, one random neighbour after another. Nodes keep their order.
///
/// # Errors
/// Those of [`decide`].
pub fn piece(
    graph: &Graph,
    nodes: usize,
    options: &Options,
    generator: &mut impl Rng,
) -> Result<Graph, VerdictError> {
    let chosen = connected_nodes(graph, nodes, generator);
    let part = induced(graph, &chosen);
    let verdict = decide(&part, &finite(options))?;
    let largest = verdict
        .components
        .iter()
        .max_by_key(|component| component.node_count());
    Ok(match largest {
        Some(component) => subgraph(&component.nodes(), component.edges(&part)),
        None => part,
    })
}

/// Whether a graph is finite solvable is all that is asked.
fn finite(options: &Options) -> Options {
    let question = Question::with_solutions(CountSolutions::Off);
    options.clone().question(question)
}

/// A finite solvable graph without edges that it is finite solvable without: removed one after
/// another, in a random order, if what is left is finite solvable. `None` if the graph itself is
/// not.
///
/// Finite solvability is lost with edges and never won, so where many edges can go at once, each of
/// them can in its turn: the answer is that of single steps.
///
/// # Errors
/// Those of [`decide`].
pub fn thinned(
    graph: &Graph,
    options: &Options,
    generator: &mut impl Rng,
) -> Result<Option<Graph>, VerdictError> {
    let mut edges = graph.edges().to_vec();
    shuffle(&mut edges, generator);
    let mut thin = Thin {
        nodes: graph.nodes() as u32,
        options: &finite(options),
        needed: Vec::new(),
    };
    if !thin.is_finite_solvable(&edges)? {
        return Ok(None);
    }
    thin.remove(&edges, &[])?;
    Ok(Some(with_edges(thin.nodes, thin.needed)))
}

struct Thin<'a> {
    nodes: u32,
    options: &'a Options,
    /// The edges that had their turn and stay.
    needed: Vec<(u32, u32)>,
}

impl Thin<'_> {
    /// Removes what it can of some edges, in their order, `later` having their turn after them.
    fn remove(
        &mut self,
        edges: &[(u32, u32)],
        later: &[&[(u32, u32)]],
    ) -> Result<(), VerdictError> {
        let without = later.iter().copied().flatten().chain(&self.needed);
        let without: Vec<(u32, u32)> = without.copied().collect();
        if edges.is_empty() || self.is_finite_solvable(&without)? {
            return Ok(());
        }
        if let [edge] = edges {
            self.needed.push(*edge);
            return Ok(());
        }
        let (first, second) = edges.split_at(edges.len() / 2);
        let after: Vec<&[(u32, u32)]> = [second].into_iter().chain(later.iter().copied()).collect();
        self.remove(first, &after)?;
        self.remove(second, later)
    }

    fn is_finite_solvable(&self, edges: &[(u32, u32)]) -> Result<bool, VerdictError> {
        let verdict = decide(&with_edges(self.nodes, edges.to_vec()), self.options)?;
        Ok(verdict.value != Value::NotFiniteSolvable)
    }
}

/// Some nodes that are connected, increasing.
fn connected_nodes(graph: &Graph, nodes: usize, generator: &mut impl Rng) -> Vec<u32> {
    let mut near = vec![Vec::new(); graph.nodes()];
    for &(u, v) in graph.edges() {
        near[u as usize].push(v);
        near[v as usize].push(u);
    }
    let start = generator.random_range(0..graph.nodes() as u32);
    let mut chosen = vec![start];
    let mut frontier = near[start as usize].clone();
    while chosen.len() < nodes && !frontier.is_empty() {
        let next = frontier.swap_remove(generator.random_range(0..frontier.len()));
        chosen.push(next);
        frontier.retain(|&v| v != next);
        for &v in &near[next as usize] {
            if !chosen.contains(&v) && !frontier.contains(&v) {
                frontier.push(v);
            }
        }
    }
    chosen.sort_unstable();
    chosen
}

/// The edges between some nodes, which are increasing.
fn induced(graph: &Graph, nodes: &[u32]) -> Graph {
    let inside = |v: u32| nodes.binary_search(&v).is_ok();
    let edges = graph.edges().iter().copied();
    subgraph(
        nodes,
        edges.filter(|&(u, v)| inside(u) && inside(v)).collect(),
    )
}

/// Some edges between some nodes, which are increasing and numbered anew.
fn subgraph(nodes: &[u32], edges: Vec<(u32, u32)>) -> Graph {
    let number = |v: u32| nodes.partition_point(|&w| w < v) as u32;
    let edges = edges.into_iter().map(|(u, v)| (number(u), number(v)));
    with_edges(nodes.len() as u32, edges.collect())
}

fn with_edges(nodes: u32, edges: Vec<(u32, u32)>) -> Graph {
    let Ok((graph, _)) = Graph::from_pairs(nodes, edges) else {
        unreachable!("a part of a graph is a graph");
    };
    graph
}

/// A uniform order (Fisher and Yates).
fn shuffle<T>(list: &mut [T], generator: &mut impl Rng) {
    for k in (1..list.len()).rev() {
        list.swap(k, generator.random_range(0..=k));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert_lab_catalog::random::generator;

    fn complete(n: u32) -> Graph {
        Graph::from_edges((0..n).flat_map(|v| (0..v).map(move |u| (u, v)))).unwrap()
    }

    fn is_finite_solvable(graph: &Graph) -> bool {
        let options = finite(&Options::default());
        decide(graph, &options).unwrap().value != Value::NotFiniteSolvable
    }

    /// Every edge is needed, in the end, and there were enough to begin with.
    #[test]
    fn nothing_is_left_to_remove() {
        for sample in 0..4 {
            let options = Options::default();
            let found = thinned(&complete(9), &options, &mut generator(5, sample)).unwrap();
            let found = found.unwrap();
            assert!(found.edges().len() >= 12 && is_finite_solvable(&found));
            for k in 0..found.edges().len() {
                let mut fewer = found.edges().to_vec();
                fewer.remove(k);
                assert!(!is_finite_solvable(&with_edges(9, fewer)));
            }
        }
        let cycle = Graph::from_edges((0..5).map(|v| (v, (v + 1) % 5))).unwrap();
        let none = thinned(&cycle, &Options::default(), &mut generator(5, 0));
        assert_eq!(none.unwrap(), None);
    }

    /// As many edges at once as one by one.
    #[test]
    fn halves_are_as_single_steps() {
        let graph = complete(8);
        let mut edges = graph.edges().to_vec();
        shuffle(&mut edges, &mut generator(1, 0));
        let mut left = edges.clone();
        for edge in &edges {
            let fewer: Vec<_> = left.iter().copied().filter(|other| other != edge).collect();
            if is_finite_solvable(&with_edges(8, fewer.clone())) {
                left = fewer;
            }
        }
        let found = thinned(&graph, &Options::default(), &mut generator(1, 0)).unwrap();
        assert_eq!(found.unwrap(), with_edges(8, left));
    }

    /// Two complete graphs with a common node, and a path from one of them: a piece is one of the
    /// two, whole, and its nodes keep their order.
    #[test]
    fn pieces_are_components() {
        let block =
            |first: u32| (first..first + 6).flat_map(move |v| (first..v).map(move |u| (u, v)));
        let path = (10..14).map(|v| (v, v + 1));
        let graph = Graph::from_edges(block(0).chain(block(5)).chain(path)).unwrap();
        for sample in 0..8 {
            let all = piece(&graph, 99, &Options::default(), &mut generator(1, sample));
            assert_eq!(all.unwrap(), complete(6));
            let few = piece(&graph, 3, &Options::default(), &mut generator(1, sample)).unwrap();
            assert!(few.nodes() <= 3 && few.nodes() >= 2);
        }
    }
}
