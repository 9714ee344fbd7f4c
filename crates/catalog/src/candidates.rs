//! All biconnected graphs with given numbers of nodes and pairs.
//!
//! Such a graph has an ear decomposition (Whitney 1932). Unless it is a cycle, its last ear is a pair, a path over one
//! node, or a longer path. So it is a smaller biconnected graph with another pair, with a node on two of its nodes, or
//! with a node in one of its pairs. The number of independent cycles grows by one, by one, or not at all.

use super::label::greatest;
use rayon::prelude::*;
use viewcert::geometry::model::full_rank;
use viewcert::graph::Graph;
use viewcert::watch::{Step, Stopped, Watch};

/// The most nodes: more take hours here.
pub const MOST_NODES: usize = 12;

/// The least number of pairs of a finite-solvable graph with `nodes` >= 2 nodes: a pair
/// has rank 7, so it is ceil((11 n - 15) / 7).
///
/// # Example
/// ```
/// assert_eq!(viewcert_catalog::least_edges(9), 12);
/// ```
pub fn least_edges(nodes: usize) -> usize {
    full_rank(nodes).div_ceil(7)
}

/// Why there are no candidates.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SizeError {
    /// Fewer than 3 nodes, or more than [`MOST_NODES`].
    #[error(
        "graphs with {} are not enumerated: ask for 3 to {MOST_NODES} nodes, or see docs/catalog.md for larger ones",
        viewcert::wording::counted(*.0, "node")
    )]
    Nodes(usize),
    /// No biconnected simple graph has so few or so many pairs.
    #[error(
        "no biconnected graph has {nodes} nodes and {edges} edges: {nodes} nodes take {nodes} to {most} edges"
    )]
    Edges {
        /// How many nodes were asked for.
        nodes: usize,
        /// How many pairs.
        edges: usize,
        /// How many pairs there can be.
        most: usize,
    },
    /// The work was stopped.
    #[error("candidates")]
    Stopped(#[from] Stopped),
}

/// The biconnected graphs with so many nodes and pairs, one of each isomorphism class, in a fixed order.
///
/// Time and memory grow with their number: seconds for 10 nodes and the least number of pairs.
///
/// # Errors
/// A size without candidates, or work that was stopped.
///
/// # Example
/// ```
/// use viewcert::watch::Watch;
/// assert_eq!(viewcert_catalog::candidates(6, 8, &Watch::default())?.len(), 9);
/// # Ok::<(), viewcert_catalog::SizeError>(())
/// ```
pub fn candidates(nodes: usize, edges: usize, watch: &Watch) -> Result<Vec<Graph>, SizeError> {
    if !(3..=MOST_NODES).contains(&nodes) {
        return Err(SizeError::Nodes(nodes));
    }
    let most = nodes * (nodes - 1) / 2;
    if !(nodes..=most).contains(&edges) {
        return Err(SizeError::Edges { nodes, edges, most });
    }
    // The graphs with so many cycles, by their number of nodes from 3 on.
    let mut fewer: Vec<Vec<Graph>> = (3..=nodes).map(|n| vec![cycle(n)]).collect();
    for _ in 1..edges + 1 - nodes {
        let mut all: Vec<Vec<Graph>> = Vec::with_capacity(fewer.len());
        for n in 3..=nodes {
            let smaller = n.checked_sub(4);
            let by_pair = fewer[n - 3].iter().map(with_pair);
            let by_node = smaller.map_or(&[][..], |k| &fewer[k]).iter().map(with_node);
            let by_path = smaller.map_or(&[][..], |k| &all[k]).iter().map(with_path);
            let grown: Vec<Vec<Graph>> = by_pair.chain(by_node).chain(by_path).collect();
            all.push(of_each_class(&grown, n, watch)?);
        }
        fewer = all;
    }
    Ok(fewer.pop().unwrap_or_default())
}

/// Whether two nodes of degree 2 are adjacent. Then the graph is not finite solvable, unless it is the triangle.
pub fn has_adjacent_nodes_of_degree_2(graph: &Graph) -> bool {
    let mut degree = vec![0; graph.nodes()];
    for &(i, j) in graph.edges() {
        degree[i as usize] += 1;
        degree[j as usize] += 1;
    }
    let mut pairs = graph.edges().iter();
    pairs.any(|&(i, j)| degree[i as usize] == 2 && degree[j as usize] == 2)
}

/// One graph of each isomorphism class: that with the greatest line of graph6.
fn of_each_class(grown: &[Vec<Graph>], nodes: usize, watch: &Watch) -> Result<Vec<Graph>, Stopped> {
    let task = watch.task(Step::Enumeration, nodes);
    let classes = grown.par_iter().map(|graphs| {
        task.check()?;
        Ok(graphs.iter().filter_map(greatest).collect::<Vec<_>>())
    });
    let classes: Vec<Vec<Graph>> = classes.collect::<Result<_, Stopped>>()?;
    let mut classes = classes.concat();
    classes.par_sort_unstable_by(|one, two| one.edges().cmp(two.edges()));
    classes.dedup_by(|one, two| one.edges() == two.edges());
    Ok(classes)
}

fn made(nodes: usize, pairs: impl IntoIterator<Item = (u32, u32)>) -> Graph {
    Graph::new(nodes as u32, pairs).expect("pairs of different nodes below their number")
}

fn cycle(nodes: usize) -> Graph {
    let n = nodes as u32;
    let cycle = made(nodes, (0..n).map(|v| (v, (v + 1) % n)));
    greatest(&cycle).expect("few nodes")
}

fn pairs_of(nodes: usize) -> impl Iterator<Item = (u32, u32)> {
    (1..nodes as u32).flat_map(|j| (0..j).map(move |i| (i, j)))
}

fn with_pair(graph: &Graph) -> Vec<Graph> {
    let new = pairs_of(graph.nodes()).filter(|pair| !graph.edges().contains(pair));
    let more = new.map(|pair| made(graph.nodes(), graph.edges().iter().copied().chain([pair])));
    more.collect()
}

fn with_node(graph: &Graph) -> Vec<Graph> {
    let (nodes, old) = (graph.nodes(), graph.edges().iter().copied());
    let new = nodes as u32;
    let more =
        pairs_of(nodes).map(|(i, j)| made(nodes + 1, old.clone().chain([(i, new), (j, new)])));
    more.collect()
}

fn with_path(graph: &Graph) -> Vec<Graph> {
    let (nodes, new) = (graph.nodes(), graph.nodes() as u32);
    let each = graph.edges().iter().map(|&(i, j)| {
        let others = graph.edges().iter().copied().filter(|&pair| pair != (i, j));
        made(nodes + 1, others.chain([(i, new), (j, new)]))
    });
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(nodes: usize, edges: usize) -> usize {
        candidates(nodes, edges, &Watch::default()).unwrap().len()
    }

    /// The paper's Table 1, and all biconnected graphs with up to 7 nodes (OEIS A002218).
    #[test]
    fn as_published() {
        let least = (3..=9).map(|nodes| count(nodes, least_edges(nodes)));
        assert_eq!(least.collect::<Vec<_>>(), [1, 1, 2, 9, 20, 161, 433]);
        let all = |nodes: usize| {
            (nodes..=nodes * (nodes - 1) / 2)
                .map(|edges| count(nodes, edges))
                .sum()
        };
        let sums: [usize; 5] = [3, 4, 5, 6, 7].map(all);
        assert_eq!(sums, [1, 3, 10, 56, 468]);
    }

    #[test]
    fn sizes_without_candidates() {
        let error = |nodes, edges| candidates(nodes, edges, &Watch::default()).unwrap_err();
        assert_eq!(error(2, 1), SizeError::Nodes(2));
        assert_eq!(error(13, 19), SizeError::Nodes(13));
        for edges in [4, 11] {
            let expected = SizeError::Edges {
                nodes: 5,
                edges,
                most: 10,
            };
            assert_eq!(error(5, edges), expected);
        }
        let stopped = Watch::new(viewcert::watch::Limits::default());
        stopped.interrupt();
        let error = candidates(8, 11, &stopped).unwrap_err();
        assert!(matches!(error, SizeError::Stopped(_)));
    }

    #[test]
    fn adjacent_nodes_of_degree_2() {
        let cycle = cycle(4);
        assert!(has_adjacent_nodes_of_degree_2(&cycle));
        assert!(
            with_pair(&cycle)
                .iter()
                .all(|graph| !has_adjacent_nodes_of_degree_2(graph))
        );
    }
}
