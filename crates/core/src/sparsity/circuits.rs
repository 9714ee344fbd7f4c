//! Which edges depend on each other (docs/theory.md, Theorem 15.3).

use super::blocks::Blocks;
use super::game::PebbleGame;
use crate::graph::{Graph, Growing, Lists};
use crate::watch::{Stopped, Task};

/// For every edge the number of its group, below the number of groups: the finest partition of the
/// edges such that the largest (K, L)-sparse set, with 2 K - L copies of each edge, is as large as
/// those of its parts together. Numbers are in the order of the groups' first edges.
///
/// Small cliques, and nodes with so many edges to them that these depend on each other, are groups, or
/// parts of one, without a game: a chain stands for them. In what is left a copy that is refused lies
/// on one circuit with all that the smallest tight set of its ends spans. O(k^2) for k nodes that are
/// left, and near linear where searches stay local; O(m log n) before.
///
/// # Errors
/// If the task was stopped.
pub fn groups<const K: usize, const L: usize>(
    graph: &Graph,
    task: &Task,
) -> Result<Vec<u32>, Stopped> {
    let sets = dependent_sets::<K, L>(graph);
    let of_node = (0..).zip(&sets);
    let of_node = of_node.flat_map(|(k, set): (u32, _)| set.iter().map(move |&v| (v, k)));
    let of_node = Lists::group(graph.nodes(), of_node);
    let set_of = |&(i, j): &(u32, u32)| {
        let other = of_node.of(j as usize);
        let mut one = of_node.of(i as usize).iter();
        one.find(|k| other.binary_search(k).is_ok()).copied()
    };
    let of_edges: Vec<Option<u32>> = graph.edges().iter().map(set_of).collect();
    let mut blocks = Blocks::new(graph.nodes());
    let mut touched = vec![false; graph.nodes()];
    let edges = graph.edges().iter().zip(&of_edges);
    let outside = edges.filter(|(_, set)| set.is_none());
    let outside: Vec<(u32, u32)> = outside.map(|(&pair, _)| pair).collect();
    for &(i, j) in &outside {
        touched[i as usize] = true;
        touched[j as usize] = true;
    }
    let mut ends = Vec::with_capacity(sets.len());
    let mut chains = Vec::new();
    for set in &sets {
        let is_shared = |v: &u32| touched[*v as usize] || of_node.of(*v as usize).len() > 1;
        let mut at: Vec<u32> = set.iter().copied().filter(is_shared).collect();
        let others = set.iter().filter(|v| !is_shared(v));
        at.extend(others.take(2usize.saturating_sub(at.len())));
        ends.push((at[0], at[1]));
        for step in [1, 2] {
            chains.extend(at.iter().zip(at.iter().skip(step)).map(|(&a, &b)| (a, b)));
        }
        blocks.merge(at);
    }
    play::<K, L>(graph.nodes(), &chains, &outside, &mut blocks, task)?;
    let mut number = vec![None; blocks.len()];
    let mut count = 0;
    let mut next = || {
        count += 1;
        count - 1
    };
    let numbered = graph.edges().iter().zip(&of_edges).map(|(&pair, set)| {
        let (u, v) = set.map_or(pair, |set| ends[set as usize]);
        match blocks.common(u, v) {
            Some(block) => *number[block as usize].get_or_insert_with(&mut next),
            None => next(),
        }
    });
    Ok(numbered.collect())
}

/// Sets of nodes that are tight, and the edges of each within one group. A node with one edge more than
/// it takes copies of has all of these on one circuit with the set; so has a clique with one node more
/// than that.
fn dependent_sets<const K: usize, const L: usize>(graph: &Graph) -> Vec<Vec<u32>> {
    let enough = K / (2 * K - L) + 1;
    let mut growing = Growing::new(graph, enough, 2);
    growing.add_cliques(graph, enough + 1);
    growing.into_sets()
}

/// Takes in the copies of edges one by one, those of chains first, which have to become tight, and unites
/// what is found to depend on each other.
fn play<const K: usize, const L: usize>(
    nodes: usize,
    chains: &[(u32, u32)],
    outside: &[(u32, u32)],
    blocks: &mut Blocks,
    task: &Task,
) -> Result<(), Stopped> {
    let work = task.begin((chains.len() + outside.len()) as u64);
    let mut game = PebbleGame::<K, L>::new(nodes);
    for (k, &(u, v)) in chains.iter().chain(outside).enumerate() {
        work.done(1)?;
        for _ in 0..2 * K - L {
            // What lies in a block is dependent, but for the chain of a set.
            if k >= chains.len() && blocks.common(u, v).is_some() {
                break;
            }
            if !game.insert(u, v) {
                blocks.merge(game.smallest(u, v));
                break;
            }
        }
    }
    Ok(())
}
