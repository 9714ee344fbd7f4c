//! Growth from a triangle: cameras join that have two pairs into what is there already.

use super::{Answer, Decided, Witness};
use crate::graph::{Adjacency, Graph};

/// What grows from the two ends of an edge: the nodes in the order of their joining, each
/// with the two neighbours it was seen from. The first to join makes a triangle.
fn grow(adjacency: &Adjacency, (i, j): (u32, u32)) -> Vec<[u32; 3]> {
    let mut inside = vec![false; adjacency.nodes()];
    let mut seen_from: Vec<Option<u32>> = vec![None; adjacency.nodes()];
    let mut joined = Vec::new();
    let mut open = std::collections::VecDeque::from([i, j]);
    inside[i as usize] = true;
    inside[j as usize] = true;
    while let Some(v) = open.pop_front() {
        for &w in adjacency.neighbours(v) {
            if inside[w as usize] {
                continue;
            }
            match seen_from[w as usize] {
                None => seen_from[w as usize] = Some(v),
                Some(u) => {
                    inside[w as usize] = true;
                    joined.push([w, u, v]);
                    open.push_back(w);
                }
            }
        }
    }
    joined
}

/// Tries an edge unless it lies within what an earlier one grew to: from there no more
/// would grow.
pub(super) fn decide(graph: &Graph, adjacency: &Adjacency) -> Decided {
    if graph.nodes() < 3 {
        return Err("fewer than 3 cameras".into());
    }
    let mut largest = 1;
    let mut grown: Vec<Vec<u32>> = vec![Vec::new(); graph.nodes()];
    for (trial, &(i, j)) in (0..).zip(graph.edges()) {
        let known = grown[i as usize]
            .iter()
            .any(|trial| grown[j as usize].binary_search(trial).is_ok());
        if known {
            continue;
        }
        let joined = grow(adjacency, (i, j));
        if joined.len() + 2 == graph.nodes() {
            return Ok((Answer::Yes, Some(Witness::Growth((i, j), joined))));
        }
        largest = largest.max(joined.len() + 2);
        for v in joined.iter().map(|step| step[0]).chain([i, j]) {
            grown[v as usize].push(trial);
        }
    }
    Ok((Answer::No, Some(Witness::Reached(largest))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(nodes: u32, pairs: &[(u32, u32)]) -> (Answer, Option<Witness>) {
        let (graph, _) = Graph::from_pairs(nodes, pairs.to_vec()).unwrap();
        decide(&graph, &Adjacency::new(&graph)).unwrap()
    }

    #[test]
    fn by_hand() {
        // 3 sees 1 and 2; 4 sees 2 and 3.
        let strip = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4), (3, 4)];
        let steps = vec![[2, 0, 1], [3, 1, 2], [4, 2, 3]];
        let expected = (Answer::Yes, Some(Witness::Growth((0, 1), steps)));
        assert_eq!(found(5, &strip), expected);
        // The 4-cycle has no triangle; nothing joins an edge.
        let square = [(0, 1), (1, 2), (2, 3), (0, 3)];
        assert_eq!(found(4, &square), (Answer::No, Some(Witness::Reached(2))));
    }
}
