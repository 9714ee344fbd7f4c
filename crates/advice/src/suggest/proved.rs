//! What sets of pairs join: decided, on a condensation of the components.

use super::{Pair, Search, Suggestion};
use crate::condensation::{Condensation, terminals, with};
use crate::parts::Parts;
use rayon::prelude::*;
use viewcert::decide::{Options, VerdictError, decide};
use viewcert::{Graph, Verdict};

/// What becomes one component.
pub(super) struct Together {
    /// The components of the verdict that it is made of, increasing.
    pub(super) components: Vec<usize>,
    /// How many images it has.
    pub(super) images: usize,
    /// How many more than the largest of these components.
    pub(super) gain: usize,
}

impl Search<'_> {
    /// Which of some sets of pairs join components, and which.
    pub(super) fn proved(
        &self,
        sets: Vec<Vec<Pair>>,
        options: &Options,
    ) -> Result<Vec<Suggestion>, VerdictError> {
        let nodes: Vec<&[u32]> = self
            .parts
            .parts
            .iter()
            .map(|part| &part.nodes[..])
            .collect();
        let links = self.parts.links.iter().map(|&(pair, _)| pair);
        let ends = || sets.iter().flatten().flat_map(|&(a, b)| [a, b]);
        let touched = links.clone().flat_map(|(a, b)| [a, b]).chain(ends());
        let small = Condensation::new(terminals(&nodes, touched), links, ends());
        let small = small.with_scales(self.parts);
        let each = sets
            .par_iter()
            .map(|set| self.joined_by_no_less(&small, set, options));
        let found: Result<Vec<Option<Suggestion>>, VerdictError> = each.collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// What a set of pairs joins, if anything, without those of them that it does not take: other
    /// components may help.
    fn joined_by_no_less(
        &self,
        small: &Condensation,
        set: &[Pair],
        options: &Options,
    ) -> Result<Option<Suggestion>, VerdictError> {
        let Some(mut found) = self.joined(small, set, options)? else {
            return Ok(None);
        };
        let mut set = set.to_vec();
        // The first is the most promising.
        for k in (1..set.len()).rev() {
            let mut fewer = set.clone();
            fewer.remove(k);
            if let Some(same) = self.joined(small, &fewer, options)?
                && same.images == found.images
            {
                (set, found) = (fewer, same);
            }
        }
        Ok(Some(found))
    }

    /// What a set of pairs joins, if anything.
    fn joined(
        &self,
        small: &Condensation,
        set: &[Pair],
        options: &Options,
    ) -> Result<Option<Suggestion>, VerdictError> {
        let pairs: Vec<Pair> = set.iter().map(|&pair| small.pair(pair)).collect();
        let graph = with(&small.graph, pairs.iter().copied());
        let found = self.together(small, &graph, &pairs, options)?;
        let pairs = set
            .iter()
            .map(|&pair| (pair, self.known.get(&pair).copied()));
        Ok(found.map(|found| Suggestion {
            pairs: pairs.collect(),
            components: found.components,
            images: found.images,
            gain: found.gain,
            candidates: Vec::new(),
        }))
    }

    /// The component of a graph on a condensation's nodes that holds the ends of some pairs, if
    /// there is one that is more than it was.
    pub(super) fn together(
        &self,
        small: &Condensation,
        graph: &Graph,
        pairs: &[Pair],
        options: &Options,
    ) -> Result<Option<Together>, VerdictError> {
        let verdict: Verdict = decide(graph, &small.options(options))?;
        let found = Parts::new(graph, &verdict);
        let mut places = pairs.iter().map(|&(a, b)| found.common(a, b));
        let Some(place) = places.next().flatten() else {
            return Ok(None);
        };
        if places.any(|other| other != Some(place)) {
            return Ok(None);
        }
        let part = &found.parts[place];
        let of_small = part.nodes.iter().map(|&v| small.nodes[v as usize]);
        let mut images: Vec<u32> = of_small.filter(|v| self.images.contains(v)).collect();
        let mut components = Vec::new();
        let mut largest = 1;
        for (k, terminals) in small.terminals.iter().enumerate() {
            // Two components of one graph share a node at most, and this one is rigid.
            let mut shared = terminals.iter().filter(|&&v| part.contains(v));
            if shared.nth(1).is_some() {
                components.push(self.parts.parts[k].component);
                let own = self.images_of(&self.parts.parts[k].nodes);
                images.extend(own);
                largest = largest.max(own.len());
            }
        }
        for &((a, b), component) in &self.parts.links {
            let ends = small.number(a).zip(small.number(b));
            if ends.is_some_and(|(a, b)| part.contains(a) && part.contains(b)) {
                components.push(component);
                largest = largest.max(self.images_of(&[a, b]).len());
            }
        }
        images.sort_unstable();
        images.dedup();
        components.sort_unstable();
        let gain = images.len() - largest;
        Ok((gain > 0).then_some(Together {
            components,
            images: images.len(),
            gain,
        }))
    }
}
