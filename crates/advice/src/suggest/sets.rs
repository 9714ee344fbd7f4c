//! Sets of pairs where no single pair is enough: for two parts the fewest of the most promising ones, and two
//! for an image that is in no part.

use super::{Candidate, Costs, Pair, Search, Suggestion, ordered};
use crate::condensation::{Condensation, terminals};
use crate::joints::{How, Joint};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::UnionFind;

/// Most pairs of parts for which sets of several pairs are looked for.
const SETS: usize = 20;

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
            let images = nodes.each_ref().map(|nodes| self.images_of(nodes));
            let mut pool = costs.between(images[0], images[1]);
            if let Some(single) = single(*components) {
                pool.retain(|&pair| costs.candidate(pair).trust() < single);
            }
            self.enough(&nodes, how, &pool, options)
        });
        let sets: Result<Vec<Option<Vec<Pair>>>, VerdictError> = sets.collect();
        Ok(sets?.into_iter().flatten().collect())
    }

    /// The largest part with the largest of every other connected part of the graph.
    fn apart(&self) -> Vec<[usize; 2]> {
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

    /// Pairs that make one of two parts: of the pool, the most promising first, as few as are enough. `None` if
    /// the pool is not enough, or one pair is.
    fn enough(
        &self,
        nodes: &[Vec<u32>; 2],
        how: &How,
        pool: &[Pair],
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
        Ok((enough > 1).then(|| pool[..enough].to_vec()))
    }

    /// The two best of some pairs between an image that is in no part and each part.
    pub(super) fn twice(&self, best: &[Candidate]) -> Vec<Vec<Pair>> {
        let mut gaps: BTreeMap<Pair, Vec<Pair>> = BTreeMap::new();
        for &Candidate { pair: (a, b), .. } in best {
            let gap = ordered((self.group(a), self.group(b)));
            gaps.entry(gap).or_default().push((a, b));
        }
        let two = gaps.into_values().filter(|pairs| pairs.len() > 1);
        two.map(|pairs| pairs[..2].to_vec()).collect()
    }
}
