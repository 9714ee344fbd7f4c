//! Degrees and connectivity.

use super::Grounds;
use viewcert::graph::{Adjacency, Graph, biconnected_components};

/// The first node with fewer than two neighbours.
pub(super) fn below_two(adjacency: &Adjacency) -> Option<Grounds> {
    (0..adjacency.nodes() as u32)
        .map(|v| (v, adjacency.degree(v)))
        .find(|&(_, degree)| degree < 2)
        .map(|(v, degree)| Grounds::Degree(v, degree))
}

/// The first edge between two nodes of degree two.
pub(super) fn adjacent_twos(graph: &Graph, adjacency: &Adjacency) -> Option<Grounds> {
    graph
        .edges()
        .iter()
        .find(|&&(i, j)| adjacency.degree(i) == 2 && adjacency.degree(j) == 2)
        .map(|&(i, j)| Grounds::Adjacent(i, j))
}

/// The nodes reachable from `start` without passing through `without`, increasing.
fn reach(adjacency: &Adjacency, start: u32, without: Option<u32>) -> Vec<u32> {
    let mut seen = vec![false; adjacency.nodes()];
    let mut open = vec![start];
    seen[start as usize] = true;
    let mut reached = Vec::new();
    while let Some(v) = open.pop() {
        reached.push(v);
        for &w in adjacency.neighbours(v) {
            if Some(w) != without && !std::mem::replace(&mut seen[w as usize], true) {
                open.push(w);
            }
        }
    }
    reached.sort_unstable();
    reached
}

/// The first node that two biconnected components share: without it a connected graph falls apart.
/// O(n + m).
fn first_cut_node(adjacency: &Adjacency) -> Option<u32> {
    let mut components = vec![0u32; adjacency.nodes()];
    biconnected_components(adjacency.lists(), |component| {
        for &v in component {
            components[v as usize] += 1;
        }
    });
    let first = components.iter().position(|&count| count > 1)?;
    Some(first as u32)
}

/// A part that is not connected with the rest, or is only through one node: the first such
/// node, and the smaller side. O(n log n + m).
pub(super) fn cut(adjacency: &Adjacency) -> Option<Grounds> {
    let nodes = adjacency.nodes() as u32;
    let side = |start: u32, without: Option<u32>| {
        let reached = reach(adjacency, start, without);
        let total = nodes as usize - usize::from(without.is_some());
        (reached.len() < total).then(|| {
            if 2 * reached.len() <= total {
                return reached;
            }
            let inside = |v: &u32| reached.binary_search(v).is_err() && Some(*v) != without;
            (0..nodes).filter(inside).collect()
        })
    };
    if let Some(part) = side(0, None) {
        return Some(Grounds::Apart(part));
    }
    let v = first_cut_node(adjacency)?;
    Some(Grounds::Cut(v, side(u32::from(v == 0), Some(v))?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn found(nodes: u32, pairs: &[(u32, u32)]) -> Option<Grounds> {
        let (graph, _) = Graph::from_pairs(nodes, pairs.to_vec()).unwrap();
        cut(&Adjacency::new(&graph))
    }

    #[test]
    fn connectivity_by_hand() {
        assert_eq!(found(2, &[(0, 1)]), None);
        assert_eq!(found(3, &[(0, 1), (1, 2), (0, 2)]), None);
        assert_eq!(found(3, &[(0, 1)]), Some(Grounds::Apart(vec![2])));
        // Two triangles that share node 0, and a path through it.
        let bowtie = [(0, 1), (0, 2), (1, 2), (0, 3), (0, 4), (3, 4)];
        assert_eq!(found(5, &bowtie), Some(Grounds::Cut(0, vec![1, 2])));
        assert_eq!(found(3, &[(0, 1), (1, 2)]), Some(Grounds::Cut(1, vec![0])));
    }

    proptest! {
        /// The first node after whose removal a search does not reach all others.
        #[test]
        fn the_first_cut_node_by_trying_all(
            nodes in 2u32..9,
            ends in prop::collection::vec((0u32..9, 0u32..9), 1..14),
        ) {
            let pairs = ends.iter().map(|(a, b)| (a % nodes, b % nodes));
            let pairs = pairs.filter(|(a, b)| a != b).collect();
            let (graph, _) = Graph::from_pairs(nodes, pairs).unwrap();
            let adjacency = Adjacency::new(&graph);
            let reached = |start, without| reach(&adjacency, start, without).len();
            if reached(0, None) == nodes as usize {
                let cuts = |&v: &u32| reached(u32::from(v == 0), Some(v)) + 1 < nodes as usize;
                let expected = (0..nodes).find(cuts);
                prop_assert_eq!(first_cut_node(&adjacency), expected);
                let found = match cut(&adjacency) {
                    Some(Grounds::Cut(v, _)) => Some(v),
                    _ => None,
                };
                prop_assert_eq!(found, expected);
            } else {
                prop_assert!(matches!(cut(&adjacency), Some(Grounds::Apart(_))));
            }
        }
    }
}
