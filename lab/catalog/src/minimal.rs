//! Minimally finite-solvable graphs: finite solvable, and not so without any one edge.
//!
//! Call an edge e of a graph *redundant* if the rank is the same without it. In a
//! minimally finite-solvable graph no edge is redundant, and none is in any of its subgraphs
//! either: what an edge adds to the rank of a subgraph is at least what it adds to
//! that of the graph, because the rank of a set of rows is submodular. So the graphs without
//! redundant edges can be grown node by node.
//!
//! For pruning only the redundancy that contraction proves is used: the two ends of
//! e lie in one body of the graph without e. That body is there in every larger graph, so the
//! graphs without such an edge are closed under subgraphs, and nothing is lost by
//! growing inside this class. The verdicts at the end are those of the pipeline.

use super::candidates::{has_adjacent_nodes_of_degree_2, least_edges, to_graph};
use super::grow::grow;
use super::multigraph::{MAX_NODES, Multigraph};
use viewcert::decide::Strength;
use viewcert::decide::{Options, Value, Verdict, VerdictError, decide};
use viewcert::graph::Graph;

/// Calls `each` for every graph with `nodes` >= 3 nodes that may be minimally finite
/// solvable: biconnected, with the least number of edges of a finite-solvable graph or more,
/// without adjacent nodes of degree 2 unless it is the triangle, and without
/// edges that contraction proves redundant; until it returns false. In a fixed order.
pub fn for_each_candidate(nodes: usize, each: &mut impl FnMut(Graph) -> bool) {
    let may_be_solvable = |graph: &Multigraph| {
        graph.edges() >= least_edges(nodes)
            && (nodes == 3 || !has_adjacent_nodes_of_degree_2(graph))
            && graph.is_biconnected()
    };
    let keep = |graph: &Multigraph| {
        (graph.nodes() < nodes || may_be_solvable(graph)) && !has_redundant_edge(graph)
    };
    grow(nodes, &keep, &mut |graph| each(to_graph(graph)));
}

/// The verdict on a graph if it is minimally finite solvable, and whether minimality
/// is proved (finite solvability is in any case).
///
/// # Errors
/// Those of [`decide`].
pub fn decide_minimal(
    graph: &Graph,
    options: &Options,
) -> Result<Option<(Verdict, Strength)>, VerdictError> {
    let verdict = decide(graph, options)?;
    if verdict.value == Value::NotFiniteSolvable {
        return Ok(None);
    }
    let mut strengths = Vec::with_capacity(graph.edges().len());
    for k in 0..graph.edges().len() {
        let mut pairs = graph.edges().to_vec();
        pairs.remove(k);
        let Ok((without, _)) = Graph::from_pairs(graph.nodes() as u32, pairs) else {
            unreachable!("a part of a graph is a graph");
        };
        let verdict = decide(&without, options)?;
        if verdict.value != Value::NotFiniteSolvable {
            return Ok(None);
        }
        strengths.push(verdict.value_claim().strength);
    }
    Ok(Some((verdict, Strength::all(strengths))))
}

/// Whether the ends of some edge lie in one body of the graph without it.
///
/// That body is part of the body of the edge in the whole graph, and made of its edges. And
/// as a body is rigid in the plane, one with n nodes and no more than 2 n - 3 edges has no
/// more than 2 k - 3 between any k of its nodes, which leaves no body there without one
/// of them (Laman, J. Engrg. Math. 4, 1970). So few edges are tried, if any.
fn has_redundant_edge(graph: &Multigraph) -> bool {
    bodies(graph.pairs()).into_iter().any(|body| {
        let inside = |&(u, v, _): &(usize, usize, u8)| body >> u & body >> v & 1 == 1;
        let edges: Vec<_> = graph.pairs().filter(inside).collect();
        edges.len() > 2 * body.count_ones() as usize - 3
            && edges.iter().any(|edge| {
                let pair = 1 << edge.0 | 1 << edge.1;
                let others = edges.iter().filter(|other| *other != edge).copied();
                bodies(others).iter().any(|body| body & pair == pair)
            })
    })
}

/// The bodies of docs/theory.md, section 4, of a graph with the given edges, their nodes as
/// bits: edges, merged while two share two nodes or three pairwise share different nodes.
fn bodies(pairs: impl Iterator<Item = (usize, usize, u8)>) -> Vec<u16> {
    let mut bodies: Vec<u16> = Vec::with_capacity(MAX_NODES * 2);
    for (u, v, _) in pairs {
        let mut new = 1u16 << u | 1 << v;
        // What the new body takes up is taken off the list, until nothing is.
        while let Some(at) = partner(&bodies, new) {
            for k in at.into_iter().flatten() {
                new |= bodies.swap_remove(k);
            }
        }
        bodies.push(new);
    }
    bodies
}

/// One or two of `bodies`, the later one first, that merge with `new`. (None of `bodies`
/// merge with one another.)
fn partner(bodies: &[u16], new: u16) -> Option<[Option<usize>; 2]> {
    for (k, &one) in bodies.iter().enumerate() {
        let shared = one & new;
        if shared.count_ones() > 1 {
            return Some([Some(k), None]);
        }
        if shared == 0 {
            continue;
        }
        for (l, &two) in bodies[..k].iter().enumerate() {
            if two & new != 0 && two & one != 0 && two & one & new == 0 {
                return Some([Some(k), Some(l)]);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use viewcert::contract::{Contraction, Merge};
    use viewcert::geometry::model::Model;

    fn minimal(nodes: usize) -> Vec<Graph> {
        let mut found = Vec::new();
        for_each_candidate(nodes, &mut |graph| {
            if let Some((_, strength)) = decide_minimal(&graph, &Options::default()).unwrap() {
                assert_eq!(strength, Strength::Proof);
                found.push(graph);
            }
            true
        });
        found
    }

    /// The triangle, and two triangles with a common edge: with a further edge, two nodes
    /// would be seen twice.
    #[test]
    fn few_nodes() {
        assert_eq!(minimal(3).len(), 1);
        assert_eq!(minimal(4).len(), 1);
    }

    /// Against deleting edges from every biconnected graph.
    #[test]
    fn nothing_is_lost_by_pruning() {
        use crate::candidates::Candidates;
        for nodes in 5..=6 {
            let mut expected = 0;
            for edges in nodes..=nodes * (nodes - 1) / 2 {
                let candidates = Candidates::new(nodes, edges, false).unwrap();
                candidates.for_each(&mut |graph| {
                    let found = decide_minimal(&graph, &Options::default()).unwrap();
                    expected += usize::from(found.is_some());
                    true
                });
            }
            assert_eq!(minimal(nodes).len(), expected, "{nodes} nodes");
        }
    }

    proptest! {
        /// Against the definition, edge by edge.
        #[test]
        fn redundant_edges_are_found(
            ends in prop::collection::vec((0usize..8, 0usize..8), 1..20),
        ) {
            let mut graph = Multigraph::new(8);
            for (u, v) in ends {
                if u != v && graph.multiplicity(u, v) == 0 {
                    graph.add(u, v, 1);
                }
            }
            let expected = graph.pairs().any(|(u, v, _)| {
                let mut without = graph;
                without.remove(u, v);
                let pair = 1 << u | 1 << v;
                bodies(without.pairs()).iter().any(|body| body & pair == pair)
            });
            prop_assert_eq!(has_redundant_edge(&graph), expected);
        }

        #[test]
        fn bodies_are_those_of_the_contraction(
            ends in prop::collection::vec((0usize..9, 0usize..9), 1..20),
        ) {
            let mut graph = Multigraph::new(9);
            for (u, v) in ends {
                if u != v && graph.multiplicity(u, v) == 0 {
                    graph.add(u, v, 1);
                }
            }
            let contraction = Contraction::new(&to_graph(&graph), Model::Projective);
            // The search closes under cycles only, which is what it takes to find redundant edges.
            let is_other = |merge: &Merge| {
                matches!(merge, Merge::Biclique { .. } | Merge::Tripod { .. } | Merge::Link { .. })
            };
            prop_assume!(!contraction.bodies.iter().flat_map(|body| &body.merge).any(is_other));
            let mut expected: Vec<u16> = contraction
                .finals
                .iter()
                .map(|&k| {
                    let nodes = &contraction.bodies[k as usize].nodes;
                    nodes.iter().fold(0, |body, v| body | 1 << v)
                })
                .chain(contraction.loose.iter().map(|(u, v)| 1 << u | 1 << v))
                .collect();
            let mut found = bodies(graph.pairs());
            expected.sort_unstable();
            found.sort_unstable();
            prop_assert_eq!(found, expected);
        }
    }
}
