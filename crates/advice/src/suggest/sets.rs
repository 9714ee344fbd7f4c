//! Sets of pairs for two parts that no single pair joins: of the most promising pairs the fewest that are
//! enough.

use super::{CHOICE, Costs, Pair, Search, Suggestion, touched};
use crate::condensation::{Condensation, terminals};
use crate::joints::{How, Joint};
use rayon::prelude::*;
use std::collections::BTreeSet;
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::UnionFind;

/// Most pairs of parts for which sets of several pairs are looked for.
const SETS: usize = 20;

/// Most pairs between two parts that are compared for a set.
const POOL: usize = 250_000;

impl Search<'_> {
    /// Sets of pairs for joints, and for the largest part and parts that are not connected with it: of pairs
    /// that are more promising than any single one that joins the two.
    pub(super) fn several(
        &self,
        joints: &[Joint],
        found: &[Suggestion],
        costs: &Costs,
        options: &Options,
    ) -> Result<Vec<Vec<Pair>>, VerdictError> {
        let single = |[one, other]: [usize; 2]| {
            let joins = |found: &&Suggestion| {
                let parts = &found.components;
                found.pairs.len() == 1 && parts.contains(&one) && parts.contains(&other)
            };
            let singles = found.iter().filter(joins);
            singles.map(|found| found.candidates[0].trust()).min()
        };
        let open = joints
            .iter()
            .map(|joint| (joint.components, joint.how.clone()));
        let apart = self
            .apart()
            .into_iter()
            .map(|parts| (parts, How::default()));
        let open: Vec<([usize; 2], How)> = open.take(SETS).chain(apart.take(SETS)).collect();
        let sets = open.par_iter();
        let sets = sets.map(|(components, how)| {
            let nodes = components.map(|component| self.parts.nodes_of(component));
            let mut pool = self.pool(&nodes, how, costs);
            if let Some(single) = single(*components) {
                pool.retain(|&pair| costs.candidate(pair).trust() < single);
            }
            self.enough(&nodes, how, &pool, costs, options)
        });
        let sets: Result<Vec<Option<Vec<Pair>>>, VerdictError> = sets.collect();
        Ok(sets?.into_iter().flatten().collect())
    }

    /// The largest part with the largest of every other connected part of the graph.
    pub(super) fn apart(&self) -> Vec<[usize; 2]> {
        let mut sets = UnionFind::new(self.graph.nodes());
        for &(i, j) in self.graph.edges() {
            sets.union(i as usize, j as usize);
        }
        let mut seen = BTreeSet::new();
        let mut firsts = self.parts.parts.iter().filter(|part| {
            let root = sets.find(part.nodes[0] as usize);
            seen.insert(root)
        });
        let largest = firsts.next().map(|part| part.component);
        let others: Vec<usize> = firsts.map(|part| part.component).collect();
        let largest = largest.into_iter();
        largest
            .flat_map(|k| others.iter().map(move |&other| [k, other]))
            .collect()
    }

    /// Pairs that make one of two parts: of the pool, the most promising first, as few as are enough; of these
    /// those are left out that the others make superfluous, the least promising first, but never one that is
    /// more promising than all others. `None` if the pool is not enough, or one pair is.
    fn enough(
        &self,
        nodes: &[Vec<u32>; 2],
        how: &How,
        pool: &[Pair],
        costs: &Costs,
        options: &Options,
    ) -> Result<Option<Vec<Pair>>, VerdictError> {
        let by = how.through.iter().flat_map(|&[a, x, b]| [(a, x), (x, b)]);
        let links = how.pairs.iter().copied().chain(by);
        let alone = || pool.iter().flat_map(|&(a, b)| [a, b]);
        let ends = links.clone().flat_map(|(a, b)| [a, b]).chain(alone());
        let parts = [&nodes[0][..], &nodes[1]];
        let small = Condensation::new(terminals(&parts, ends), links, alone());
        let small = small.with_scales(self.parts);
        let is_enough = |set: &[Pair]| {
            let more = set.iter().map(|&pair| small.pair(pair));
            Ok::<bool, VerdictError>(small.freedom(more, options)?.0 == 0)
        };
        if pool.is_empty() || !is_enough(pool)? {
            return Ok(None);
        }
        let (mut too_few, mut enough) = (0, pool.len());
        while too_few + 1 < enough {
            let middle = (too_few + enough) / 2;
            match is_enough(&pool[..middle])? {
                true => enough = middle,
                false => too_few = middle,
            }
        }
        let mut chosen = pool[..enough].to_vec();
        // The first stays if it is more promising than the second.
        let worth = |k: usize| pool.get(k).map(|&pair| costs.candidate(pair).rank());
        let first = usize::from(worth(0) != worth(1));
        for k in (first..enough.saturating_sub(1)).rev() {
            let mut fewer = chosen.clone();
            fewer.remove(k);
            if is_enough(&fewer)? {
                chosen = fewer;
            }
        }
        Ok((chosen.len() > 1).then_some(chosen))
    }

    /// Pairs between two parts: the best ones, of different images first; of very large parts those
    /// near the joint.
    fn pool(&self, nodes: &[Vec<u32>; 2], how: &How, costs: &Costs) -> Vec<Pair> {
        let [one, other] = [0, 1].map(|side| self.ends(&nodes[side], &touched(how, side), CHOICE));
        if nodes[0].len().saturating_mul(nodes[1].len()) <= POOL {
            return costs.between(&nodes[0], &nodes[1], CHOICE);
        }
        let known = self.known.keys().copied();
        let near = self.nearness.map(|near| near.pairs(CHOICE as u32));
        let within = |k: usize, v: u32| nodes[k].binary_search(&v).is_ok();
        let between = |&(a, b): &Pair| within(0, a) && within(1, b) || within(1, a) && within(0, b);
        let pairs = known.chain(near.into_iter().flatten()).filter(between);
        let ends = pairs.flat_map(|(a, b)| [a, b]);
        let mut sides = [one, other];
        for v in ends {
            let side = usize::from(!within(0, v));
            if sides[side].len() < POOL.isqrt() && !sides[side].contains(&v) {
                sides[side].push(v);
            }
        }
        costs.between(&sides[0], &sides[1], CHOICE)
    }
}
