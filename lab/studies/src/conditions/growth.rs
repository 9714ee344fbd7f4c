//! Growth from a triangle: cameras join that have two pairs into what is there already.

use super::{Answer, Decided, Grounds};
use viewcert::graph::{Adjacency, Graph};

const NONE: u32 = u32::MAX;

/// What the trials know of every node; a mark is that of a trial, so that the next one need not
/// wipe it.
struct Growth {
    /// The trial that the node has joined last.
    inside: Vec<u32>,
    /// The trial that has seen it from one node last...
    seen: Vec<u32>,
    /// ... and from which one.
    seen_from: Vec<u32>,
}

impl Growth {
    fn new(nodes: usize) -> Self {
        Self {
            inside: vec![NONE; nodes],
            seen: vec![NONE; nodes],
            seen_from: vec![0; nodes],
        }
    }

    /// What grows from the two ends of an edge: the nodes in the order of their joining, each
    /// with the two neighbours it was seen from. The first to join makes a triangle.
    fn grow(&mut self, adjacency: &Adjacency, trial: u32, (i, j): (u32, u32)) -> Vec<[u32; 3]> {
        let mut joined = Vec::new();
        let mut open = std::collections::VecDeque::from([i, j]);
        self.inside[i as usize] = trial;
        self.inside[j as usize] = trial;
        while let Some(v) = open.pop_front() {
            for &w in adjacency.neighbours(v) {
                let at = w as usize;
                if self.inside[at] == trial {
                    continue;
                }
                if self.seen[at] == trial {
                    self.inside[at] = trial;
                    joined.push([w, self.seen_from[at], v]);
                    open.push_back(w);
                } else {
                    self.seen[at] = trial;
                    self.seen_from[at] = v;
                }
            }
        }
        joined
    }
}

/// Whether two increasing lists have an element in common: looks up those of the shorter one.
fn meet(a: &[u32], b: &[u32]) -> bool {
    let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    short.iter().any(|x| long.binary_search(x).is_ok())
}

/// Tries an edge unless it lies within what an earlier one grew to, from where no more would
/// grow, or is in no triangle. Finding triangles takes O(m log m) times the arboricity; growing
/// looks at the neighbours of a node once for each of the parts that it is in.
pub(super) fn decide(graph: &Graph, adjacency: &Adjacency) -> Decided {
    if graph.nodes() < 3 {
        return Err("fewer than 3 cameras".into());
    }
    let mut largest = if graph.edges().is_empty() { 1 } else { 2 };
    let mut growth = Growth::new(graph.nodes());
    let mut grown: Vec<Vec<u32>> = vec![Vec::new(); graph.nodes()];
    for (trial, &(i, j)) in (0..).zip(graph.edges()) {
        let known = meet(&grown[i as usize], &grown[j as usize]);
        if known || !meet(adjacency.neighbours(i), adjacency.neighbours(j)) {
            continue;
        }
        let joined = growth.grow(adjacency, trial, (i, j));
        if joined.len() + 2 == graph.nodes() {
            return Ok((Answer::Yes, Some(Grounds::Growth((i, j), joined))));
        }
        largest = largest.max(joined.len() + 2);
        for v in joined.iter().map(|step| step[0]).chain([i, j]) {
            grown[v as usize].push(trial);
        }
    }
    Ok((Answer::No, Some(Grounds::Reached(largest))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(nodes: u32, pairs: &[(u32, u32)]) -> (Answer, Option<Grounds>) {
        let (graph, _) = Graph::from_pairs(nodes, pairs.to_vec()).unwrap();
        decide(&graph, &Adjacency::new(&graph)).unwrap()
    }

    #[test]
    fn by_hand() {
        // 3 sees 1 and 2; 4 sees 2 and 3.
        let strip = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4), (3, 4)];
        let steps = vec![[2, 0, 1], [3, 1, 2], [4, 2, 3]];
        let expected = (Answer::Yes, Some(Grounds::Growth((0, 1), steps)));
        assert_eq!(found(5, &strip), expected);
        // The 4-cycle has no triangle; nothing joins an edge.
        let square = [(0, 1), (1, 2), (2, 3), (0, 3)];
        assert_eq!(found(4, &square), (Answer::No, Some(Grounds::Reached(2))));
    }
}
