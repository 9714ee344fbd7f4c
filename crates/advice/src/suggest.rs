//! Pairs that, if they were matched, would join components.
//!
//! Each suggestion is proved: the graph with the pairs added is decided, on a condensation of its
//! components; it is worth something only if its images really overlap. Which pairs are tried first is a
//! guess ([`candidates`]): pairs that are known to have matches, else images that are near each other
//! ([`nearness`]). A pair that was matched with too little coming of it is not named again ([`tried`]).

use crate::joints::Joint;
use crate::parts::Parts;
use crate::{Known, OtherPair};
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use viewcert::Graph;
use viewcert::decide::{Options, VerdictError};

pub mod candidates;
mod matches;
pub mod nearness;
mod proved;
mod search;
mod sets;
pub mod tried;

pub use candidates::{Candidate, Reason};
pub use matches::{SuggestedMatch, suggest_matches};
pub use nearness::{Near, Nearness};
pub use tried::{IMAGE_NEEDS, PAIR_NEEDS, Tried};

use candidates::Costs;
use proved::Together;
use search::Search;

/// Pairs that join components, if they are matched and verified.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// The pairs, with what is known of each, the most promising first. One, if one is enough; otherwise a
    /// set that is enough and of which none but the first can be left out, though a smaller set may exist.
    pub pairs: Vec<((u32, u32), Option<OtherPair>)>,
    /// The components that become one, or parts of one, increasing.
    pub components: Vec<usize>,
    /// How many images the new component has.
    pub images: usize,
    /// How many images that is more than the largest of the components has.
    pub gain: usize,
    /// Why each of the pairs is worth trying, in their order.
    pub candidates: Vec<Candidate>,
}

/// How far it was tried, round and cost; whether it is a set, gain and pairs.
type Rank = (Tried, usize, u32, (bool, Reverse<usize>, usize));

impl Suggestion {
    /// The most promising ones first, and of a set the pair that is least promising counts; then single pairs
    /// before sets, and of sets those that join most.
    fn rank(&self) -> Rank {
        let all = || self.candidates.iter();
        let tried = all().map(|one| one.tried).max().unwrap_or(Tried::Not);
        let cost = all().map(|one| one.cost).max().unwrap_or(0);
        match &self.candidates[..] {
            [one] => (tried, one.round, cost, (false, Reverse(0), 1)),
            pairs => (tried, 0, cost, (true, Reverse(self.gain), pairs.len())),
        }
    }
}

/// How many suggestions are wanted, and where.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Not more than these.
    pub most: usize,
    /// Only such with pairs at this image.
    pub at: Option<u32>,
}

/// Most pairs that are tried.
const TRIED: usize = 200;

/// Most suggestions, of pairs or of matches, that join the same components.
const ALIKE: usize = 8;

/// Suggests pairs, and sets of pairs where no single one that is as promising is enough: the most promising
/// first.
///
/// A decision of the condensed graph for each of some hundred candidates.
///
/// # Errors
/// Those of [`decide`](viewcert::decide::decide).
pub fn suggest(
    graph: &Graph,
    parts: &Parts,
    joints: &[Joint],
    known: Known,
    wanted: Wanted,
    options: &Options,
) -> Result<Vec<Suggestion>, VerdictError> {
    let search = Search::new(graph, parts, known, graph.nodes() as u32);
    let costs = Costs::new(&search);
    // A single pair places no image that has none.
    let is_seen = |v: u32| search.neighbours.degree(v) > 0;
    let seen = costs.best(wanted.at, |(a, b)| is_seen(a) && is_seen(b), TRIED);
    let mut sets: Vec<Vec<Pair>> = seen.iter().map(|one| vec![one.pair]).collect();
    // Two pairs place any image that is in no part, however it hangs on single ones.
    let is_placed = |v: u32| !parts.of(v).is_empty();
    let alone = costs.best(wanted.at, |(a, b)| is_placed(a) != is_placed(b), TRIED);
    sets.extend(search.twice(&alone));
    let rounds: HashMap<Pair, Candidate> = seen.into_iter().map(|one| (one.pair, one)).collect();
    // The most promising pair of a set is its first.
    let trusted = |mut sets: Vec<Vec<Pair>>| {
        for set in &mut sets {
            set.sort_by_key(|&pair| costs.candidate(pair).trust());
        }
        sets
    };
    let explained = |mut found: Vec<Suggestion>| {
        for one in &mut found {
            let pairs = one.pairs.iter().map(|(pair, _)| {
                let chosen = rounds.get(pair).copied();
                chosen.unwrap_or_else(|| costs.candidate(*pair))
            });
            one.candidates = pairs.collect();
        }
        found
    };
    let found = explained(search.proved(trusted(sets), options)?);
    let (mut found, others): (Vec<Suggestion>, Vec<Suggestion>) =
        found.into_iter().partition(|one| search.joins_both(one));
    // A set for two parts is about none of their images.
    if wanted.at.is_none() {
        let several = search.several(joints, &found, &costs, options)?;
        found.extend(explained(search.proved(trusted(several), options)?));
        // A ring of parts may need a pair that joins others than those that it leads between.
        if found.is_empty() {
            found = others;
        }
    }
    Ok(ranked(found, wanted.most))
}

type Pair = (u32, u32);

/// The two images of different parts that are nearest to each other, if all pairs that could join anything
/// were matched already: a photograph between them would help. Of the first `images` nodes, and for some
/// thousand images at most.
pub fn gap(graph: &Graph, parts: &Parts, known: Known, images: u32) -> Option<(u32, u32)> {
    let search = Search::new(graph, parts, known, images);
    Costs::new(&search).gap()
}

fn ordered((a, b): Pair) -> Pair {
    (a.min(b), a.max(b))
}

/// The best first, few of a kind.
fn ranked(mut found: Vec<Suggestion>, most: usize) -> Vec<Suggestion> {
    found.sort_by_key(|one| {
        let pairs: Vec<Pair> = one.pairs.iter().map(|&(pair, _)| pair).collect();
        (one.rank(), Reverse(one.gain), pairs)
    });
    found.dedup_by(|one, other| one.pairs == other.pairs);
    let mut alike: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    found.retain(|one| {
        let count = alike.entry(one.components.clone()).or_default();
        *count += 1;
        *count <= ALIKE
    });
    found.truncate(most);
    found
}

#[cfg(test)]
mod tests;
