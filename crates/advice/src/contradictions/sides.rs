//! What single pairs are in question, from both sides; and what follows if neighbours are right.

use super::packing::Packing;
use super::web::Web;
use super::{Cycle, LONGEST, Step};
use crate::Near;
use crate::Nearness;
use std::cmp::Reverse;
use std::collections::HashSet;
use viewcert::graph::UnionFind;

/// A pair in question.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Its number.
    pub pair: u32,
    /// If it is right, so many others are off.
    pub if_right: usize,
    /// If it is off by more than three times the angle, so many others are off by more than the angle.
    pub if_off: usize,
}

/// What follows if pairs of images next to each other by name are right.
#[derive(Clone, Debug)]
pub struct Neighbours {
    /// How many files apart they are at most.
    pub window: u32,
    /// The pairs that are assumed to be right, increasing.
    pub assumed: Vec<u32>,
    /// The proof that others are wrong.
    pub packing: Packing,
    /// Which of them to look at first: the one with most inliers that is off by far along its neighbours.
    pub first: Option<u32>,
}

/// How many neighbours must have more inliers than other pairs: by this factor, in the median.
const MORE: u32 = 2;
/// Files apart of images that are near, for where to look first.
const NEAR: u32 = 3;

fn look(web: &Web, cycles: &[Cycle], pair: u32, theta: u32) -> Look {
    let mut used = HashSet::new();
    let through = cycles.iter().filter(|cycle| cycle.has(pair));
    let if_right = through.filter(|cycle| {
        let others = || {
            cycle
                .walk
                .iter()
                .map(|step| step.0)
                .filter(|&other| other != pair)
        };
        let is_free = others().all(|other| !used.contains(&other));
        if is_free {
            used.extend(others());
        }
        is_free
    });
    let if_right = if_right.count();
    let mut used = HashSet::new();
    let closed = web
        .triangles(pair)
        .filter(|walk| walk.len() == 3 && web.open(walk) < f64::from(theta) - 0.01);
    let if_off = closed
        .filter(|walk| used.insert(walk[1].0) & used.insert(walk[2].0))
        .count();
    Look {
        pair,
        if_right,
        if_off,
    }
}

/// Two pairs of which one group or the other is wrong: that with most contradictions of those that disagree with
/// the rotations of most, and its strongest opponent in a cycle without closure.
pub(super) fn look_at(web: &Web, cycles: &[Cycle], beyond: &[u32], theta: u32) -> Vec<Look> {
    let mut count = vec![0usize; web.motions.len()];
    cycles
        .iter()
        .flat_map(|cycle| &cycle.walk)
        .for_each(|step| count[step.0 as usize] += 1);
    let best = |pairs: &mut dyn Iterator<Item = u32>| {
        let mut pairs: Vec<u32> = pairs.collect();
        pairs.sort_by_key(|&pair| (Reverse(count[pair as usize]), pair));
        pairs.dedup();
        let found = pairs
            .into_iter()
            .take(8)
            .map(|pair| look(web, cycles, pair, theta));
        found.max_by_key(|one| (one.if_right, Reverse(one.pair)))
    };
    let Some(first) = best(
        &mut beyond
            .iter()
            .copied()
            .filter(|&pair| count[pair as usize] > 0),
    ) else {
        return Vec::new();
    };
    let others = cycles.iter().filter(|cycle| cycle.has(first.pair));
    let others = others.flat_map(|cycle| cycle.walk.iter().map(|step| step.0));
    let mut others =
        others.filter(|other| *other != first.pair && beyond.binary_search(other).is_err());
    std::iter::once(first).chain(best(&mut others)).collect()
}

/// What follows if neighbours by name are right; nothing, where names do not say who they are, or neighbours
/// contradict each other. `cycles` are those without closure, of both kinds.
pub(super) fn neighbours(
    web: &Web,
    unchecked: &[[u32; 2]],
    cycles: &[Cycle],
    near: &Nearness,
    theta: u32,
) -> Option<Neighbours> {
    let motions = web.motions;
    let near_by = |window: u32| move |[i, j]: [u32; 2]| matches!(near.of(i, j), Some(Near::Name(steps)) if steps <= window);
    let all = 0..motions.len() as u32;
    let median = |pairs: Vec<u32>| {
        let mut inliers: Vec<u32> = pairs
            .iter()
            .map(|&pair| motions[pair as usize].inliers)
            .collect();
        inliers.sort_unstable();
        inliers.get(inliers.len() / 2).copied().unwrap_or(0)
    };
    // The smallest window whose pairs join all images that have a pair.
    let window = (1..=2).find(|&window| {
        let mut sets = UnionFind::new(web.images());
        let (mut has_pair, mut joined) = (vec![false; web.images()], 0);
        let of_motions = motions.iter().map(|motion| motion.images);
        for [i, j] in of_motions.chain(unchecked.iter().copied()) {
            (has_pair[i as usize], has_pair[j as usize]) = (true, true);
            joined += usize::from(near_by(window)([i, j]) && sets.union(i as usize, j as usize));
        }
        joined + 1 == has_pair.iter().filter(|has| **has).count()
    })?;
    let is_near = near_by(window);
    let (assumed, others): (Vec<u32>, Vec<u32>) =
        all.partition(|&pair| is_near(motions[pair as usize].images));
    if median(assumed.clone()) < MORE * median(others.clone()) {
        return None;
    }
    let is_assumed = |pair: u32| assumed.binary_search(&pair).is_ok();
    let free = |cycle: &Cycle| cycle.walk.iter().filter(|step| !is_assumed(step.0)).count();
    if cycles.iter().any(|cycle| free(cycle) == 0) {
        return None;
    }
    let limit = f64::from(theta);
    let chains = others.iter();
    let chains = chains.filter_map(|&pair| web.around(pair, usize::MAX, is_assumed));
    let chains = chains.map(|walk| Cycle {
        walk,
        witness: None,
    });
    let chains: Vec<Cycle> = chains.collect();
    let most = LONGEST.min(179 / theta as usize);
    let is_open =
        |walk: &[Step]| walk.len() <= most && web.open(walk) > (limit + 1.0) * walk.len() as f64;
    let open = chains.iter().filter(|cycle| is_open(&cycle.walk));
    let all: Vec<Cycle> = open.chain(cycles).cloned().collect();
    let packing = Packing::of(all, motions.len(), is_assumed);
    // Where pairs of neighbours are unchecked, others near by lead past them: this says where to look, and no more.
    let is_near = |pair: u32| near_by(NEAR)(motions[pair as usize].images);
    let is_far = |pair: &u32| {
        let around = web.around(*pair, usize::MAX, is_near);
        around.is_some_and(|walk| web.open(&walk) > 3.0 * limit)
    };
    let weighty = packing.pairs().into_iter();
    let far = weighty.filter(|&pair| !is_near(pair)).filter(is_far);
    let first = far.max_by_key(|&pair| (motions[pair as usize].inliers, Reverse(pair)));
    Some(Neighbours {
        window,
        assumed,
        packing,
        first,
    })
}
