//! Which pairs of images are worth trying: a guess, measured on photographs in
//! docs/reconstruction.md. What a pair would join is decided elsewhere.
//!
//! A pair costs as many steps as its images are apart: by the names of their files, by position, or
//! by what they are matched with: how many matches both have with one third image, or that they
//! stand beside two that are matched. Each failure of either image with an image
//! that it is in no component with costs one step more. Between two groups of images several pairs are
//! chosen, on different images.

use super::nearness::Near;
use super::{Pair, Search, ordered};
use crate::suggest::Tried;
use std::collections::HashMap;

/// A tenth of a step: the unit of costs.
const STEP: u32 = 10;

/// Up to so many steps apart images are neighbours.
const NEIGHBOURS: u32 = 2;

/// What a pair costs that nothing is known of.
const UNKNOWN: u32 = 8 * STEP;

/// What a pair costs of which each image is matched with one of two that are matched with each other.
const BESIDE: u32 = 5 * STEP / 2;

/// Up to so many images every pair is looked at.
const ALL: usize = 1500;

/// How many steps of a sequence are looked at where there are more.
const STEPS: u32 = 24;

/// How many neighbours of an image in one group are looked at for what they have in common.
const COMMON: usize = 8;

/// Most pairs that are chosen between two groups.
const OF_GAP: usize = 8;

/// Most pairs between two groups of images that are compared.
const POOL: usize = 250_000;

/// How many of them are chosen.
const CHOICE: usize = 12;

/// Why a pair is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its images are near each other.
    Near(Near),
    /// Both are matched with this image.
    Common(u32),
    /// Each is matched with one of these two, which are matched with each other.
    Beside(u32, u32),
    /// Images of the two groups, for want of anything better.
    Any,
}

/// Two images that may be worth matching.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// The smaller one first.
    pub pair: Pair,
    /// What has become of matching them so far.
    pub tried: Tried,
    /// In tenths of a step.
    pub cost: u32,
    /// Why they are tried.
    pub reason: Reason,
    /// How many better ones there are between the same groups.
    pub round: usize,
}

impl Candidate {
    /// The best ones first.
    pub fn rank(&self) -> (Tried, usize, u32) {
        (self.tried, self.round, self.cost)
    }

    /// Those first for which most speaks.
    pub(super) fn trust(&self) -> (Tried, u32, Pair) {
        (self.tried, self.cost, self.pair)
    }
}

/// What costs are made of.
pub(super) struct Costs<'a> {
    search: &'a Search<'a>,
    /// What pairs cost that are near by what is matched, and why.
    common: HashMap<Pair, (u32, Reason)>,
    /// How often matching every image with another group has failed.
    failures: Vec<u32>,
}

impl<'a> Costs<'a> {
    /// O(pairs that are known or used), up to sorting.
    pub(super) fn new(search: &'a Search<'a>) -> Self {
        let images = search.images.len();
        let mut neighbours: Vec<Vec<(u32, u32)>> = vec![Vec::new(); images];
        for ((a, b), inliers) in search.matched() {
            neighbours[a as usize].push((inliers, b));
            neighbours[b as usize].push((inliers, a));
        }
        let mut failures = vec![0; images];
        for (&(a, b), known) in &search.known {
            if Tried::of(Some(known)).is_failure() && !search.parts.are_together(a, b) {
                failures[a as usize] += 1;
                failures[b as usize] += 1;
            }
        }
        Self {
            search,
            common: common(search, neighbours),
            failures,
        }
    }

    /// A pair as a candidate.
    pub(super) fn candidate(&self, pair: Pair) -> Candidate {
        let (cost, reason) = self.of(pair);
        Candidate {
            pair,
            tried: Tried::of(self.search.known.get(&pair)),
            cost,
            reason,
            round: 0,
        }
    }

    /// The nearest two images of different parts, if all pairs that could join anything were matched.
    pub(super) fn gap(&self) -> Option<Pair> {
        let images = self.search.images.len();
        if images > ALL {
            return None;
        }
        let all = (0..images as u32).flat_map(|a| (a + 1..images as u32).map(move |b| (a, b)));
        let open = all.filter(|&(a, b)| {
            !self.search.parts.are_together(a, b) && self.search.could_join((a, b))
        });
        let was_tried = |pair: &Pair| {
            let tried = Tried::of(self.search.known.get(pair));
            tried.is_failure() || tried == Tried::Used
        };
        let tried: Option<Vec<Pair>> = open.map(|pair| was_tried(&pair).then_some(pair)).collect();
        tried?
            .into_iter()
            .min_by_key(|&pair| (self.near(pair).0, pair))
    }

    /// What a pair costs, and why it is tried.
    fn of(&self, pair: Pair) -> (u32, Reason) {
        let (cost, reason) = self.near(pair);
        let failed = self.failures[pair.0 as usize] + self.failures[pair.1 as usize];
        (cost.saturating_add(STEP * failed), reason)
    }

    /// How far apart its images are, and by what.
    fn near(&self, pair: Pair) -> (u32, Reason) {
        let near = self
            .search
            .nearness
            .and_then(|near| near.of(pair.0, pair.1));
        let near = near.map(|near| {
            // Neighbours come before what is guessed from matches.
            let step = if near.steps() <= NEIGHBOURS {
                STEP / 5
            } else {
                STEP
            };
            (step.saturating_mul(near.steps()), Reason::Near(near))
        });
        let common = self.common.get(&pair).copied();
        let known = common.into_iter().chain(near).min_by_key(|(cost, _)| *cost);
        known.unwrap_or((UNKNOWN, Reason::Any))
    }

    /// The best pairs between any two groups, of different images as far as there are any: `most` at
    /// most, with an end at `at` if that is given, and such as `keep` takes. O(n^2) for a thousand images,
    /// else O(n log n).
    pub(super) fn best(
        &self,
        at: Option<u32>,
        keep: impl Fn(Pair) -> bool,
        most: usize,
    ) -> Vec<Candidate> {
        let images = self.search.images.len() as u32;
        let pairs = match at {
            Some(image) => (0..images).map(|b| ordered((image, b))).collect(),
            None => self.hopeful(),
        };
        let is_one = |&pair: &Pair| self.search.is_candidate(pair, at) && keep(pair);
        self.chosen(pairs.into_iter().filter(is_one).collect(), most)
    }

    /// The pairs to look at: all of a thousand images, else those for which anything speaks.
    fn hopeful(&self) -> Vec<Pair> {
        let images = self.search.images.len();
        if images <= ALL {
            let images = images as u32;
            return (0..images)
                .flat_map(|b| (0..b).map(move |a| (a, b)))
                .collect();
        }
        let near = self.search.nearness.map(|near| near.pairs(STEPS));
        let common = self.common.keys().copied();
        let known = self.search.known.keys().copied();
        let near = near.into_iter().flatten();
        let mut pairs: Vec<Pair> = near.chain(common).chain(known).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// The best pairs between two groups of images, given increasing, that are not used already: the most
    /// promising first.
    pub(super) fn between(&self, one: &[u32], other: &[u32]) -> Vec<Pair> {
        let pairs: Vec<Pair> = if one.len().saturating_mul(other.len()) <= POOL {
            let of = |&a: &u32| other.iter().map(move |&b| ordered((a, b)));
            one.iter().flat_map(of).collect()
        } else {
            let has = |group: &[u32], v: u32| group.binary_search(&v).is_ok();
            let is_between = |a, b| has(one, a) && has(other, b);
            let mut pairs = self.hopeful();
            pairs.retain(|&(a, b)| is_between(a, b) || is_between(b, a));
            pairs
        };
        let is_open = |&pair: &Pair| {
            self.search.is_candidate(pair, None)
                && Tried::of(self.search.known.get(&pair)) != Tried::Used
        };
        let mut chosen = self.chosen(pairs.into_iter().filter(is_open).collect(), CHOICE);
        chosen.sort_by_key(Candidate::trust);
        chosen.into_iter().map(|one| one.pair).collect()
    }

    /// Several of each gap: the best, then the best of other images, then what is left.
    fn chosen(&self, pairs: Vec<Pair>, most: usize) -> Vec<Candidate> {
        let mut gaps: HashMap<(u32, u32), Gap> = HashMap::new();
        let mut chosen: Vec<Candidate> = Vec::new();
        let mut left: Vec<Candidate> = Vec::new();
        let mut sorted: Vec<Candidate> =
            pairs.into_iter().map(|pair| self.candidate(pair)).collect();
        sorted.sort_unstable_by_key(Candidate::trust);
        for candidate in sorted {
            let (a, b) = candidate.pair;
            let gap = gaps
                .entry(ordered((self.search.group(a), self.search.group(b))))
                .or_default();
            if gap.chosen >= OF_GAP {
                continue;
            }
            if gap.images.contains(&a) || gap.images.contains(&b) {
                if gap.left < OF_GAP {
                    gap.left += 1;
                    left.push(candidate);
                }
                continue;
            }
            gap.images.extend([a, b]);
            chosen.push(gap.next(candidate));
            if chosen.len() >= most {
                break;
            }
        }
        for candidate in left {
            let (a, b) = candidate.pair;
            let gap = gaps
                .entry(ordered((self.search.group(a), self.search.group(b))))
                .or_default();
            if gap.chosen < OF_GAP && chosen.len() < most {
                chosen.push(gap.next(candidate));
            }
        }
        chosen.sort_by_key(|candidate| (candidate.rank(), candidate.pair));
        chosen
    }
}

/// What is chosen between two groups.
#[derive(Default)]
struct Gap {
    chosen: usize,
    left: usize,
    images: Vec<u32>,
}

impl Gap {
    fn next(&mut self, candidate: Candidate) -> Candidate {
        self.chosen += 1;
        Candidate {
            round: self.chosen - 1,
            ..candidate
        }
    }
}

/// Pairs of different groups that are near by what is matched: those with a common neighbour, and
/// those of which each is a neighbour of one of two that are matched across the groups. What they
/// cost, and why.
fn common(search: &Search, neighbours: Vec<Vec<(u32, u32)>>) -> HashMap<Pair, (u32, Reason)> {
    let best: Vec<Vec<(u32, u32)>> = neighbours
        .into_iter()
        .map(|of| of_groups(search, of))
        .collect();
    let mut found: HashMap<Pair, (u32, Reason)> = HashMap::new();
    let mut near = |a: u32, b: u32, cost: u32, reason: Reason| {
        if a != b && !search.parts.are_together(a, b) {
            let known = found.entry(ordered((a, b))).or_insert((cost, reason));
            if cost < known.0 {
                *known = (cost, reason);
            }
        }
    };
    for (third, of) in (0..).zip(&best) {
        for (k, &(_, a)) in of.iter().enumerate() {
            for &(inliers, b) in &of[k + 1..] {
                // The later ones have no more matches. 30 are as good as standing side by side.
                let cost = STEP * 30 / inliers.clamp(15, 60);
                near(a, b, cost, Reason::Common(third));
            }
        }
    }
    for (one, of) in (0..).zip(&best) {
        let across = of.iter().filter(|&&(_, other)| one < other);
        for &(_, other) in across.filter(|&&(_, other)| !search.parts.are_together(one, other)) {
            for &(_, a) in best[one as usize].iter().take(COMMON) {
                for &(_, b) in best[other as usize].iter().take(COMMON) {
                    near(a, b, BESIDE, Reason::Beside(one, other));
                }
            }
        }
    }
    found
}

/// The neighbours of an image with most inliers in every group, falling.
fn of_groups(search: &Search, mut of: Vec<(u32, u32)>) -> Vec<(u32, u32)> {
    of.sort_unstable_by(|a, b| b.cmp(a));
    let mut groups: HashMap<u32, usize> = HashMap::new();
    of.retain(|&(_, v)| {
        let count = groups.entry(search.group(v)).or_default();
        *count += 1;
        *count <= COMMON
    });
    of.truncate(4 * COMMON);
    of
}
