//! Members: uniquely determined parts that no rule merges (docs/theory.md, section 10).
//!
//! In: the nodes of the bodies and loose edges of a contraction. Out: members as sets of the nodes that lie in
//! two of them.

use crate::contract::Contraction;
use crate::geometry::model::full_rank;
use std::collections::BTreeMap;

/// The most nodes that members may share: one bit for each.
pub const MOST_NODES: usize = 128;

/// A set of shared nodes, one bit for each.
pub(super) type Set = u128;

/// The nodes of some bodies and edges of a contracted graph.
pub(crate) fn nodes_of(
    contraction: &Contraction,
    bodies: &[u32],
    edges: &[(u32, u32)],
) -> Vec<Vec<u32>> {
    let bodies = bodies.iter();
    let bodies = bodies.map(|&k| contraction.bodies[k as usize].nodes.clone());
    bodies
        .chain(edges.iter().map(|&(i, j)| vec![i, j]))
        .collect()
}

/// Members of a graph.
#[derive(Clone, Debug)]
pub(super) struct Members {
    /// The nodes of the graph that bits stand for: those that lie in two members at least.
    pub(super) nodes: Vec<u32>,
    /// The members, in a fixed order.
    pub(super) sets: Vec<Set>,
}

impl Members {
    /// Members with these nodes; `None` if they share more than [`MOST_NODES`] nodes.
    pub(super) fn new(all: &[Vec<u32>]) -> Option<Self> {
        let mut count: BTreeMap<u32, u32> = BTreeMap::new();
        for &v in all.iter().flatten() {
            *count.entry(v).or_default() += 1;
        }
        let shared = count.into_iter().filter(|&(_, k)| k > 1);
        let nodes: Vec<u32> = shared.map(|(v, _)| v).collect();
        if nodes.len() > MOST_NODES {
            return None;
        }
        let bit = |v: &u32| nodes.binary_search(v).ok().map(|k| 1 << k);
        let set = |member: &Vec<u32>| member.iter().filter_map(bit).sum();
        let mut sets: Vec<Set> = all.iter().map(set).collect();
        sets.sort_unstable();
        Some(Self { nodes, sets })
    }

    /// Equations less unknowns of the core: the sum of 11 k - 15 over all members, k being the
    /// number of their shared nodes, less 11 n - 15.
    pub(super) fn excess(&self) -> i64 {
        let required = |nodes: usize| full_rank(nodes) as i64;
        let members = self
            .sets
            .iter()
            .map(|set| required(set.count_ones() as usize));
        members.sum::<i64>() - required(self.nodes.len())
    }
}

/// The members of a set, increasing.
pub(super) fn bits(mut set: Set) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (set != 0).then(|| set.trailing_zeros() as usize)?;
        set &= set - 1;
        Some(lowest)
    })
}
