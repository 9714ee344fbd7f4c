//! The d-condition by vertices: no three or more cameras induce a subgraph with a larger d.

use super::{Answer, Decided, Grounds};
use viewcert::graph::Graph;

/// Most cameras for which all subsets are looked at.
pub const MAX_NODES: usize = 20;

/// Looks at all subsets, except that nothing needs to be looked at where the condition by
/// edges holds: it implies this one, since d of a graph is at most the sum of d over its
/// blocks (joining two blocks at a node adds 11 - 15 < 0).
pub(super) fn decide(graph: &Graph, holds_by_edges: bool) -> Decided {
    let nodes = graph.nodes();
    if holds_by_edges {
        return Ok((Answer::Yes, None));
    }
    if nodes > MAX_NODES {
        return Err(format!(
            "{nodes} cameras have too many subsets (at most {MAX_NODES} are feasible)"
        ));
    }
    let whole = 7 * graph.edges().len() as i64 - 11 * nodes as i64 + 15;
    let mut neighbours = vec![0u32; nodes];
    for &(i, j) in graph.edges() {
        neighbours[i as usize] |= 1 << j;
        neighbours[j as usize] |= 1 << i;
    }
    // edges[W] is the number of edges within W.
    let mut edges = vec![0u16; 1 << nodes];
    let mut worst = (whole, 0u32);
    for set in 1..1u32 << nodes {
        let first = set.trailing_zeros();
        let rest = set & (set - 1);
        let count = edges[rest as usize] + (neighbours[first as usize] & rest).count_ones() as u16;
        edges[set as usize] = count;
        let size = i64::from(set.count_ones());
        let d = 7 * i64::from(count) - 11 * size + 15;
        if size >= 3 && d > worst.0 {
            worst = (d, set);
        }
    }
    if worst.1 == 0 {
        return Ok((Answer::Yes, None));
    }
    let members = (0..nodes as u32)
        .filter(|v| worst.1 >> v & 1 == 1)
        .collect();
    Ok((Answer::No, Some(Grounds::Vertices(members, worst.0, whole))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_part_shows() {
        // K4 (d = 42 - 44 + 15 = 13) with a pendant path: d(G) = 56 - 66 + 15 = 5.
        let mut pairs: Vec<_> = (0..4u32)
            .flat_map(|j| (0..j).map(move |i| (i, j)))
            .collect();
        pairs.extend([(3, 4), (4, 5)]);
        let (graph, _) = Graph::from_pairs(6, pairs).unwrap();
        let grounds = Grounds::Vertices(vec![0, 1, 2, 3], 13, 5);
        assert_eq!(decide(&graph, false), Ok((Answer::No, Some(grounds))));
    }
}
