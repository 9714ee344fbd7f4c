use std::collections::BTreeSet;

use proptest::prelude::*;

use super::*;

proptest! {
    /// Against an ordered set.
    #[test]
    fn pairs_are_sorted_and_merged(
        nodes in 2u32..9,
        ends in prop::collection::vec((0u32..9, 0u32..9), 0..100),
    ) {
        let pairs: Vec<_> = ends
            .into_iter()
            .map(|(a, b)| (a % nodes, b % nodes))
            .filter(|(a, b)| a != b)
            .collect();
        let set: BTreeSet<_> = pairs.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
        let (graph, merged) = Graph::from_pairs(nodes, pairs.clone()).unwrap();
        prop_assert!(graph.edges().iter().eq(&set));
        prop_assert_eq!(merged, pairs.len() - set.len());
    }
}

#[test]
fn edges_of_a_node() {
    let graph = Graph::from_edges([(3, 0), (2, 0), (2, 3)]).unwrap();
    assert_eq!(graph.nodes(), 4);
    assert_eq!(graph.edges_from(0), [(0, 2), (0, 3)]);
    assert_eq!(graph.edges_from(1), []);
    assert_eq!(graph.edges_from(2), [(2, 3)]);
    assert_eq!(graph.edges_from(3), []);
    assert_eq!(Graph::from_edges([]).unwrap().nodes(), 0);
    assert_eq!(Graph::from_edges([(4, 4)]), Err(GraphError::SelfLoop(4)));
    let last = u32::MAX;
    let beyond = GraphError::OutOfRange {
        node: last,
        nodes: last,
    };
    assert_eq!(Graph::from_edges([(0, last)]), Err(beyond));
}

#[test]
fn a_loop_and_a_missing_node_are_refused() {
    assert_eq!(
        Graph::from_pairs(2, vec![(0, 1), (1, 1)]),
        Err(GraphError::SelfLoop(1))
    );
    assert_eq!(
        Graph::from_pairs(2, vec![(0, 1), (2, 1)]),
        Err(GraphError::OutOfRange { node: 2, nodes: 2 })
    );
}
