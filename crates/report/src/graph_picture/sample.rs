//! Some nodes of a graph that is too large to be drawn node by node.
//!
//! Every node goes to the sampled one that is nearest, in steps; two sampled nodes are joined where an
//! edge leads from the nodes of the one to those of the other. So a sequence is a line, and a city
//! has its streets. O(n + m) and sorting.

use super::Picture;
use std::collections::{HashMap, VecDeque};
use viewcert::graph::Adjacency;

/// How many nodes are drawn, and the most that are so because they lie in other components than the
/// large one.
const NODES: usize = 600;
const MOST_OUTSIDE: usize = 200;

/// Most lines: those that stand for most edges.
const MOST_LINES: usize = 6000;

/// A line of the picture, in the colour of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line {
    pub(super) ends: (u32, u32),
    pub(super) component: u32,
}

/// Some nodes, increasing, and lines between them.
pub(super) fn sample(picture: &Picture) -> (Vec<u32>, Vec<Line>) {
    let graph = &picture.input.graph;
    let nodes = graph.nodes() as u32;
    let is_inside = |v: u32| matches!(picture.components_of(v), [0]);
    let mut chosen: Vec<u32> = (0..nodes)
        .filter(|&v| !is_inside(v))
        .take(MOST_OUTSIDE)
        .collect();
    let step = (nodes as usize).div_ceil(NODES - chosen.len()).max(1);
    chosen.extend((0..nodes).step_by(step));
    chosen.sort_unstable();
    chosen.dedup();
    let nearest = nearest(&Adjacency::new(graph), &chosen);
    let mut counts: HashMap<(u32, u32, u32), usize> = HashMap::new();
    for (k, &(i, j)) in graph.edges().iter().enumerate() {
        let [a, b] = [i, j].map(|v| nearest[v as usize]);
        if let (Some(a), Some(b)) = (a, b)
            && a != b
        {
            let component = picture.of_edge(k) as u32;
            *counts.entry((a.min(b), a.max(b), component)).or_default() += 1;
        }
    }
    let mut lines: Vec<((u32, u32, u32), usize)> = counts.into_iter().collect();
    // Lines of smaller components are few and must not be lost.
    lines.sort_unstable_by_key(|&((a, b, k), count)| (k == 0, usize::MAX - count, a, b, k));
    lines.truncate(MOST_LINES);
    lines.sort_unstable();
    let lines = lines.into_iter().map(|((a, b, component), _)| Line {
        ends: (a, b),
        component,
    });
    (chosen, lines.collect())
}

/// For every node the nearest of some, if any can be reached.
fn nearest(neighbours: &Adjacency, some: &[u32]) -> Vec<Option<u32>> {
    let mut nearest = vec![None; neighbours.nodes()];
    let mut queue: VecDeque<u32> = some.iter().copied().collect();
    some.iter().for_each(|&v| nearest[v as usize] = Some(v));
    while let Some(v) = queue.pop_front() {
        for &w in neighbours.neighbours(v) {
            if nearest[w as usize].is_none() {
                nearest[w as usize] = nearest[v as usize];
                queue.push_back(w);
            }
        }
    }
    nearest
}
