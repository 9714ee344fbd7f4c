//! What single pairs are in question, from both sides; and what follows if neighbours are right.

use super::average::beyond_trusted;
use super::packing::{Packing, Terms};
use super::web::Web;
use super::{ALL, Cycle, Step, open_cycles, verified};
use crate::{Near, Nearness};
use std::cmp::Reverse;
use std::collections::HashSet;
use viewcert::graph::UnionFind;
use viewcert_formats::{Motions, Source};

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
    /// The proof that others are off.
    pub packing: Packing,
    /// Which of them to look at first: the one with most inliers that is off by far along its neighbours.
    pub first: Option<u32>,
}

/// How many neighbours must have more inliers than other pairs: by this factor, in the median.
const MORE: u32 = 2;
/// Files apart of images that are near, for where to look first.
const NEAR: u32 = 3;
/// By how many thousandths of a degree a step of odometry may be off and be right: the first that nine in ten of the
/// other pairs do not contradict, of twenty or fewer half of them.
const ODOMETRY: [u32; 3] = [10, 100, 1000];
const FEW: usize = 10;

fn look(web: &Web, cycles: &[Cycle], pair: u32, theta: u32) -> Look {
    // Walks through the pair of which no two have another pair in common.
    let count = |walks: &mut dyn Iterator<Item = &[Step]>| {
        let mut used = HashSet::from([pair]);
        let is_apart = |walk: &&[Step]| {
            let others = walk.iter().filter(|step| step.0 != pair);
            let is_free = others.clone().all(|step| !used.contains(&step.0));
            used.extend(others.filter(|_| is_free).map(|step| step.0));
            is_free
        };
        walks.filter(is_apart).count()
    };
    let through = cycles.iter().filter(|cycle| cycle.has(pair));
    let is_closed = |walk: &Vec<Step>| walk.len() == 3 && web.open(walk) < f64::from(theta) - 0.01;
    let closed: Vec<Vec<Step>> = web.triangles(pair).filter(is_closed).collect();
    Look {
        pair,
        if_right: count(&mut through.map(|cycle| &cycle.walk[..])),
        if_off: count(&mut closed.iter().map(|walk| &walk[..])),
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
/// contradict each other. Of a pose graph they are its odometry, which most of the other pairs have to agree with.
/// `directed` are the cycles of directions that contradict.
pub(super) fn neighbours(
    web: &Web,
    motions: &Motions,
    directed: &[Cycle],
    theta: u32,
) -> Option<Neighbours> {
    let names = (0..motions.images as u32).map(|image| motions.labels.label(image));
    let near = &Nearness::new(&names.collect::<Vec<_>>(), &[]);
    let pairs = &motions.pairs;
    let near_by = |window: u32| move |[i, j]: [u32; 2]| matches!(near.of(i, j), Some(Near::Name(steps)) if steps <= window);
    let median = |pairs: &[u32]| {
        let inliers = pairs.iter().map(|&pair| web.motions[pair as usize].inliers);
        let mut inliers: Vec<u32> = inliers.collect();
        inliers.sort_unstable();
        inliers.get(inliers.len() / 2).copied().unwrap_or(0)
    };
    // The smallest window whose pairs join all images that have a pair.
    let window = (1..=2).find(|&window| {
        let mut sets = UnionFind::new(web.images());
        let (mut has_pair, mut joined) = (vec![false; web.images()], 0);
        let of_motions = pairs.iter().map(|motion| motion.images);
        for [i, j] in of_motions.chain(motions.others.iter().copied()) {
            (has_pair[i as usize], has_pair[j as usize]) = (true, true);
            joined += usize::from(near_by(window)([i, j]) && sets.union(i as usize, j as usize));
        }
        joined + 1 == has_pair.iter().filter(|has| **has).count()
    })?;
    let is_near = |pair: u32, window| near_by(window)(pairs[pair as usize].images);
    let (assumed, others): (Vec<u32>, Vec<u32>) =
        (0..pairs.len() as u32).partition(|&pair| is_near(pair, window));
    if median(&assumed) < MORE * median(&others) {
        return None;
    }
    let is_database = motions.source == Source::Database;
    let most = if is_database {
        others.len()
    } else {
        (others.len() / FEW).max(others.len().min(2 * FEW) / 2)
    };
    let is_assumed = |pair: u32| assumed.binary_search(&pair).is_ok();
    let mut doubts = others;
    if pairs.len() > ALL {
        doubts = beyond_trusted(web, is_assumed, theta);
        doubts.retain(|&pair| !is_assumed(pair));
        if doubts.len() > most {
            return None;
        }
    }
    let supposed = |assumed_within| {
        let terms = Terms {
            assumed: assumed.clone(),
            assumed_within,
            ..Terms::new(theta)
        };
        let cycles = [&open_cycles(web, &doubts, &terms)[..], directed].concat();
        let cycles = verified(pairs, &cycles, &terms);
        let is_free = |step: &Step| !terms.is_assumed(step.0);
        let are_free = cycles.iter().all(|cycle| cycle.walk.iter().any(is_free));
        are_free.then(|| Packing::of(cycles, pairs.len(), terms))
    };
    let is_some = |found: &Packing| (1..=most).contains(&found.at_least());
    let packing = match is_database {
        true => supposed(1000 * theta).filter(is_some)?,
        false => ODOMETRY
            .into_iter()
            .find_map(|within| supposed(within).filter(is_some))?,
    };
    // Where pairs of neighbours are unchecked, others near by lead past them: this says where to look, and no more.
    let near_cost = |pair| is_near(pair, NEAR).then_some(1);
    let is_far = |pair: &u32| {
        let around = web.around(*pair, u32::MAX, near_cost);
        around.is_some_and(|walk| web.open(&walk) > 3.0 * f64::from(theta))
    };
    let weighty = packing.pairs().into_iter();
    let far = weighty.filter(|&pair| !is_near(pair, NEAR) && is_far(&pair));
    let first = far.max_by_key(|&pair| (pairs[pair as usize].inliers, Reverse(pair)));
    Some(Neighbours {
        window,
        packing,
        first,
    })
}
