//! Members: uniquely determined parts, merged until no rule applies (docs/theory.md, section 10).
//!
//! In: the nodes of the bodies and loose edges of a contraction. Out: members as sets of the nodes that lie in
//! two of them, closed under rules 2 and 3 of Theorem 4.1 and under the rule of the bicliques
//! K_{2,3} (Theorem 10.3), and every merge that led there.

use super::evidence::{Merge, Rule, Solutions};
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

/// Members of a graph, and how they came to be.
#[derive(Clone, Debug)]
pub(super) struct Members {
    /// The nodes of the graph that bits stand for: those that lay in two members at first.
    pub(super) nodes: Vec<u32>,
    /// The members that are left, in a fixed order.
    pub(super) sets: Vec<Set>,
    /// All merges, in order.
    pub(super) merges: Vec<Merge>,
}

impl Members {
    /// Members with these nodes, merged; `None` if they share more than [`MOST_NODES`] nodes.
    pub(super) fn new(all: &[Vec<u32>]) -> Option<Self> {
        let mut members = Self::unmerged(all)?;
        members.close();
        Some(members)
    }

    /// The same as they are.
    pub(super) fn unmerged(all: &[Vec<u32>]) -> Option<Self> {
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
        Some(Self {
            sets: all.iter().map(set).collect(),
            nodes,
            merges: Vec::new(),
        })
    }

    /// The shared nodes of the members that are left, as nodes of the graph.
    pub(super) fn lists(&self) -> Vec<Vec<u32>> {
        self.sets.iter().map(|&set| self.named(set)).collect()
    }

    /// The nodes of a set, as nodes of the graph.
    fn named(&self, set: Set) -> Vec<u32> {
        bits(set).map(|k| self.nodes[k]).collect()
    }

    /// Merges until no rule applies. O(nodes^3 + nodes^2 * members) a merge.
    pub(super) fn close(&mut self) {
        while self.merge_shared() || self.merge_triangle() || self.merge_biclique() {}
        self.sets.sort_unstable();
    }

    /// Replaces the members at some places by their union.
    pub(super) fn unite(&mut self, mut places: Vec<usize>, rule: Rule, at: &[usize]) {
        places.sort_unstable();
        places.dedup();
        let members = places.iter().map(|&k| self.named(self.sets[k])).collect();
        let at = at.iter().map(|&v| self.nodes[v]).collect();
        self.merges.push(Merge {
            rule,
            at,
            members,
            grown: None,
        });
        let union = places.iter().fold(0, |union, &k| union | self.sets[k]);
        for &k in places.iter().rev() {
            self.sets.swap_remove(k);
        }
        self.sets.push(union);
    }

    /// Equations less unknowns of the core: the sum of 11 k - 15 over all members, k being the
    /// number of their shared nodes, less 11 n - 15.
    pub(super) fn excess(&self) -> i64 {
        self.excess_between(shared(&self.sets))
    }

    /// The same for what members have between some nodes.
    pub(super) fn excess_between(&self, inside: Set) -> i64 {
        let required = |set: Set| full_rank(set.count_ones() as usize) as i64;
        let members = self.sets.iter().map(|set| set & inside);
        members
            .filter(|set| set.count_ones() > 1)
            .map(required)
            .sum::<i64>()
            - required(inside)
    }

    /// The nodes that have a member in common with one of these, themselves included.
    pub(super) fn near(&self, nodes: Set) -> Set {
        let at = self.sets.iter().filter(|&set| set & nodes != 0);
        at.fold(0, |near, set| near | set) & shared(&self.sets)
    }

    /// The part of the core between some nodes: what its members have there, if it is a core with
    /// two members or more, and enough equations to be finite solvable.
    pub(super) fn part(&self, inside: Set) -> Option<Self> {
        let sets = self.sets.iter().map(|set| set & inside);
        let sets: Vec<Set> = sets.filter(|set| set.count_ones() > 1).collect();
        if sets.len() < 2 || shared(&sets) != inside {
            return None;
        }
        let mut part = Self {
            nodes: self.nodes.clone(),
            sets,
            merges: Vec::new(),
        };
        if part.excess() < 0 {
            return None;
        }
        part.close();
        Some(part)
    }

    /// Makes one member of the part between some nodes, which has one solution, and of all members
    /// that share two nodes with it (Proposition 10.11).
    pub(super) fn grow(&mut self, inside: Set, evidence: Solutions) {
        let touching = |&k: &usize| (self.sets[k] & inside).count_ones() > 1;
        let places = (0..self.sets.len()).filter(touching).collect();
        let at: Vec<usize> = bits(inside).collect();
        self.unite(places, Rule::Grown, &at);
        if let Some(merge) = self.merges.last_mut() {
            merge.grown = Some(Box::new(evidence));
        }
        self.close();
    }

    fn merge_shared(&mut self) -> bool {
        for k in 0..self.sets.len() {
            for l in 0..k {
                let shared = self.sets[k] & self.sets[l];
                if shared.count_ones() > 1 {
                    let at: Vec<usize> = bits(shared).take(2).collect();
                    self.unite(vec![l, k], Rule::Shared, &at);
                    return true;
                }
            }
        }
        false
    }

    /// With no two members that share two nodes, three corners in two members need a third.
    fn merge_triangle(&mut self) -> bool {
        for k in 0..self.sets.len() {
            for l in 0..k {
                let corner = self.sets[k] & self.sets[l];
                if corner == 0 {
                    continue;
                }
                for m in 0..l {
                    let [first, second] = [k, l].map(|x| self.sets[m] & self.sets[x]);
                    if first != 0
                        && second != 0
                        && first != corner
                        && second != corner
                        && first != second
                    {
                        let at: Vec<usize> = bits(corner | first | second).collect();
                        self.unite(vec![m, l, k], Rule::Triangle, &at);
                        return true;
                    }
                }
            }
        }
        false
    }

    fn merge_biclique(&mut self) -> bool {
        let n = self.nodes.len();
        let near: Vec<Set> = (0..n)
            .map(|v| {
                let at_v = self.sets.iter().filter(|&&set| set >> v & 1 == 1);
                at_v.fold(0, |near, set| near | set) & !(1 << v)
            })
            .collect();
        for b in 0..n {
            for a in 0..b {
                let common = near[a] & near[b];
                if common.count_ones() < 3 {
                    continue;
                }
                let three: Vec<usize> = bits(common).take(3).collect();
                let used = |set: Set| {
                    [a, b]
                        .iter()
                        .any(|&x| three.iter().any(|&v| set >> x & set >> v & 1 == 1))
                };
                let places: Vec<usize> = (0..self.sets.len())
                    .filter(|&k| used(self.sets[k]))
                    .collect();
                // Inside one member there is nothing to merge.
                if places.len() > 1 {
                    let at: Vec<usize> = [a, b].into_iter().chain(three).collect();
                    self.unite(places, Rule::Biclique, &at);
                    return true;
                }
            }
        }
        false
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

/// The nodes that lie in two sets or more.
pub(super) fn shared(sets: &[Set]) -> Set {
    let (mut once, mut twice) = (0, 0);
    for set in sets {
        twice |= once & set;
        once |= set;
    }
    twice
}
