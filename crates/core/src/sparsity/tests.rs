use super::*;
use crate::geometry::draw::DrawKey;
use crate::geometry::plane_direction::direction_rows;
use crate::geometry::plane_flow::rigidity_rows;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook::eliminate;
use crate::watch::unwatched;
use proptest::prelude::*;
use std::collections::BTreeSet;

fn sparsity<const K: usize, const L: usize>(graph: &Graph) -> Sparsity<K, L> {
    unwatched(|task| Sparsity::new(graph, task))
}

fn plane(graph: &Graph) -> Plane {
    sparsity(graph)
}

fn space(graph: &Graph) -> Space {
    sparsity(graph)
}

/// The rank of R (k = 2) or N (k = 3) at points modulo 2^61 - 1, by textbook elimination.
fn rank(k: usize, graph: &Graph) -> usize {
    let field = PrimeField::mersenne61();
    let key = DrawKey {
        graph_sha256: [7; 32],
        core_sha256: None,
        seed: 1,
        draw: 0,
    };
    let mut random = key.residues(&field);
    let nodes = graph.nodes();
    let rows = if k == 2 {
        let points: Vec<[u64; 2]> = (0..nodes).map(|_| [random(), random()]).collect();
        direction_rows(&field, graph, &points)
    } else {
        let centres: Vec<[u64; 3]> = (0..nodes).map(|_| [random(), random(), random()]).collect();
        rigidity_rows(&field, graph, &centres)
    };
    let mut matrix = Matrix::new(rows.len(), k * nodes, vec![0; rows.len() * k * nodes]);
    for (r, row) in rows.iter().enumerate() {
        for &(c, value) in row {
            matrix[(r, c)] = value;
        }
    }
    eliminate(&field, &matrix).rank()
}

/// The subgraph that a set of nodes spans, on the same nodes.
fn spanned(graph: &Graph, set: u32) -> Graph {
    let inside = |&&(i, j): &&(u32, u32)| set >> i & 1 == 1 && set >> j & 1 == 1;
    let edges = graph.edges().iter().filter(inside).copied();
    Graph::new(graph.nodes() as u32, edges).unwrap()
}

/// The maximal sets of nodes, as bits, whose edges have full rank for them.
fn maximal_rigid(k: usize, graph: &Graph) -> BTreeSet<u32> {
    let sets = (0u32..1 << graph.nodes()).filter(|set| set.count_ones() >= 2);
    let full = |set: &u32| {
        let size = set.count_ones() as usize;
        rank(k, &spanned(graph, *set)) == k * size - (k + 1)
    };
    let rigid: Vec<u32> = sets.filter(full).collect();
    let maximal = |&&set: &&u32| {
        !rigid
            .iter()
            .any(|&other| other != set && other & set == set)
    };
    rigid.iter().filter(maximal).copied().collect()
}

fn component_sets<const K: usize, const L: usize>(
    graph: &Graph,
    found: &Sparsity<K, L>,
) -> BTreeSet<u32> {
    let mut sets = vec![0; found.components()];
    for (&component, &(i, j)) in found.component_of_edges().iter().zip(graph.edges()) {
        sets[component as usize] |= 1 << i | 1 << j;
    }
    let sets: BTreeSet<u32> = sets.into_iter().collect();
    assert_eq!(sets.len(), found.components(), "components are different");
    sets
}

/// The ranks in the plane and in space.
fn check(graph: &Graph) {
    assert_eq!(plane(graph).rank(), rank(2, graph), "{graph:?}");
    assert_eq!(space(graph).rank(), rank(3, graph), "{graph:?}");
}

/// All graphs with the given nodes, each with every numbering.
fn all_graphs(nodes: u32) -> impl Iterator<Item = Graph> {
    let pairs: Vec<(u32, u32)> = (0..nodes)
        .flat_map(|j| (0..j).map(move |i| (i, j)))
        .collect();
    (0u32..1 << pairs.len()).map(move |chosen| {
        let edges = pairs.iter().enumerate();
        let edges = edges.filter(|(bit, _)| chosen >> bit & 1 == 1);
        Graph::new(nodes, edges.map(|(_, &edge)| edge)).unwrap()
    })
}

#[test]
fn ranks_of_all_graphs_with_up_to_six_nodes() {
    for nodes in 1..=6 {
        all_graphs(nodes).for_each(|graph| check(&graph));
    }
}

#[test]
fn components_of_all_graphs_with_up_to_five_nodes() {
    for nodes in 2..=5 {
        for graph in all_graphs(nodes) {
            let sets = component_sets(&graph, &plane(&graph));
            assert_eq!(sets, maximal_rigid(2, &graph), "{graph:?}");
            let sets = component_sets(&graph, &space(&graph));
            assert_eq!(sets, maximal_rigid(3, &graph), "{graph:?}");
        }
    }
}

/// An orientation with few out-edges proves nothing: K_4 with a pendant edge has 7 edges and
/// rank 6 (docs/theory.md, section 13).
#[test]
fn the_complete_graph_on_four_nodes_with_a_pendant_edge() {
    let pairs = (0..4).flat_map(|j| (0..j).map(move |i| (i, j)));
    let graph = Graph::new(5, pairs.chain([(3, 4)])).unwrap();
    let found = plane(&graph);
    assert_eq!((found.rank(), found.components()), (6, 2));
    // In space: 3 * 4 - 4 = 8, and 2 more.
    assert_eq!(space(&graph).rank(), 10);
}

/// K_{3,3} has 9 = 2 * 6 - 3 edges, and is a Laman graph.
#[test]
fn the_utility_graph_is_rigid_in_the_plane() {
    let graph = Graph::new(6, (0..3).flat_map(|a| (3..6).map(move |b| (a, b)))).unwrap();
    let found = plane(&graph);
    assert_eq!((found.rank(), found.components()), (9, 1));
}

/// A ring of 100,000 nodes, and a grid: searches stay local.
#[test]
fn large_sparse_graphs_take_no_quadratic_time() {
    let n = 100_000;
    let ring = Graph::new(n, (0..n).map(|v| (v, (v + 1) % n))).unwrap();
    let found = plane(&ring);
    assert_eq!((found.rank(), found.components()), (n as usize, n as usize));
}

fn random_graph() -> impl Strategy<Value = Graph> {
    let pairs = prop::collection::vec((0u32..14, 0u32..14), 1..50);
    (3u32..14, pairs).prop_map(|(nodes, pairs)| {
        let fits = |&(i, j): &(u32, u32)| i != j && i < nodes && j < nodes;
        Graph::new(nodes, pairs.into_iter().filter(fits)).unwrap()
    })
}

/// The bound by the components is the rank (Corollary 13.8), and components share at most one node.
fn check_components<const K: usize, const L: usize>(graph: &Graph, found: &Sparsity<K, L>) {
    let sets: Vec<u32> = component_sets(graph, found).into_iter().collect();
    let full = |set: &u32| K * set.count_ones() as usize - L;
    assert_eq!(sets.iter().map(full).sum::<usize>(), found.rank());
    for (at, a) in sets.iter().enumerate() {
        assert!(sets[..at].iter().all(|b| (a & b).count_ones() <= 1));
        assert_eq!(rank(K, &spanned(graph, *a)), full(a));
    }
}

proptest! {
    #[test]
    fn ranks_of_random_graphs(graph in random_graph()) {
        check(&graph);
    }

    #[test]
    fn components_of_random_graphs(graph in random_graph()) {
        check_components(&graph, &plane(&graph));
        check_components(&graph, &space(&graph));
    }
}
