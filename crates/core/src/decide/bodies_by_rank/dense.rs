//! One region of a large core that is likely to be rigid: as few core nodes as possible with as many pairs among them.
//!
//! A random graph of mean degree d is locally a tree, and no rule and no small region begins in it. But once some n / d^2
//! nodes are together, more nodes have two neighbours among them than join, and each brings more equations than
//! unknowns (bootstrap percolation: Janson, Luczak, Turova, Vallier, Annals of Applied Probability 22, 2012).

use crate::graph::{Adjacency, Graph};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Core nodes of the largest one: its rank takes a minute.
const MOST: usize = 8192;

/// Marks nodes, most of them of the core: from one of most neighbours on always the one with most neighbours among
/// them, the oldest of these first, until equations are more than unknowns by half of one for each node. `None` if that
/// takes more than half of the core, or too many nodes.
///
/// O(m log n) in the pairs at the nodes that it meets.
pub(super) fn grow(graph: &Graph, core_nodes: &[u32]) -> Option<Vec<bool>> {
    let neighbours = Adjacency::new(graph);
    let degree = |&v: &u32| neighbours.neighbours(v).len();
    let start = core_nodes.iter().copied().max_by_key(degree)?;
    let most = MOST.min(core_nodes.len() / 2);
    let mut inside = vec![false; graph.nodes()];
    let mut among = vec![0u32; graph.nodes()];
    let (mut nodes, mut pairs, mut met) = (Vec::new(), 0, 0);
    let mut next = BinaryHeap::from([(0, Reverse(0), start)]);
    while let Some((count, _, v)) = next.pop() {
        if inside[v as usize] || count < among[v as usize] {
            continue;
        }
        inside[v as usize] = true;
        nodes.push(v);
        pairs += count as usize;
        if 14 * pairs >= 23 * nodes.len() {
            prune(&neighbours, &nodes, &mut inside);
            return Some(inside);
        }
        if nodes.len() == most {
            return None;
        }
        for &w in neighbours.neighbours(v) {
            if inside[w as usize] {
                continue;
            }
            met += 1;
            among[w as usize] += 1;
            next.push((among[w as usize], Reverse(met), w));
        }
    }
    None
}

/// Takes out nodes with one neighbour among them, over and over: a pair has seven equations, and a node eleven
/// unknowns.
fn prune(neighbours: &Adjacency, nodes: &[u32], inside: &mut [bool]) {
    let mut left = nodes.to_vec();
    while let Some(v) = left.pop() {
        let among = neighbours.neighbours(v).iter();
        let among = among.filter(|&&w| inside[w as usize]).take(2).count();
        if inside[v as usize] && among < 2 {
            inside[v as usize] = false;
            left.extend(neighbours.neighbours(v));
        }
    }
}
