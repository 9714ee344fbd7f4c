//! One rotation for each image, such that few pairs disagree: floats propose, integers count.
//!
//! From a spanning tree of pairs that close triangles, each image takes the rotation with which most of its pairs
//! agree, of their mean and of what single pairs say. Small graphs try many trees.

use super::Step;
use super::turns::{Turn, agrees, angle, conj, times, unit};
use super::web::Web;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Work of all trees, in looks at pairs.
const WORK: usize = 4_000_000;
const TREES: usize = 64;
/// Triangles of a pair that count for its place in the tree.
const TRIANGLES: usize = 24;
/// Other steps of a cycle that says the same of a pair in no triangle.
const AROUND: u32 = 5;
/// Single pairs whose word an image tries.
const WORDS: usize = 12;
/// Rounds through all images.
const SWEEPS: usize = 24;
/// The length of a pair beside what triangles it does not close add: 2^16 if these are all.
const BASE: u64 = 1 << 10;

/// Rotations in integers of 24 bits, and the pairs that disagree with them, increasing. O(pairs + triangles that are
/// looked at), times the number of trees.
pub(super) fn average(web: &Web, theta: u32) -> (Vec<[i64; 4]>, Vec<u32>) {
    let pairs = web.motions.len();
    let limit = f64::from(theta);
    let all: Vec<u32> = (0..pairs as u32).collect();
    let support = all.par_iter().map(|&pair| {
        let near = web.triangles(pair).take(TRIANGLES);
        let [mut seen, mut closed] = [0; 2];
        for walk in near {
            seen += 1;
            closed += usize::from(web.open(&walk) <= limit);
        }
        let around = || web.around(pair, AROUND, |_| Some(1));
        match seen {
            0 => around().map_or(0, |walk| usize::from(web.open(&walk) <= limit)),
            _ => closed,
        }
    });
    let support: Vec<usize> = support.collect();
    let degree = (0..web.images() as u32)
        .map(|image| web.at(image).len().min(64))
        .max()
        .unwrap_or(0);
    let trees = (WORK / (pairs * (degree + 1)).max(1)).clamp(1, TREES);
    let found = (0..trees as u64).into_par_iter().map(|seed| {
        let mut turns = from_tree(web, &support, seed);
        let sweeps = if trees > 1 { SWEEPS / 4 } else { SWEEPS };
        let _ = (0..sweeps)
            .take_while(|_| improve(web, &mut turns, limit))
            .count();
        let rotations = integers(&turns);
        let beyond = beyond(web, &rotations, theta);
        (rotations, beyond)
    });
    let best = found.min_by_key(|(_, beyond)| beyond.len());
    best.unwrap_or_default()
}

fn integers(turns: &[Turn]) -> Vec<[i64; 4]> {
    let integer = |turn: &Turn| turn.map(|x| (x * f64::from(1 << 24)).round() as i64);
    turns.iter().map(integer).collect()
}

/// The pairs that disagree with rotations along such that are trusted, increasing.
pub(super) fn beyond_trusted(web: &Web, is_trusted: impl Fn(u32) -> bool, theta: u32) -> Vec<u32> {
    let support = (0..web.motions.len() as u32).map(|pair| usize::from(is_trusted(pair)) << 20);
    let turns = from_tree(web, &support.collect::<Vec<_>>(), 1);
    beyond(web, &integers(&turns), theta)
}

/// The pairs that disagree with rotations of all images by more than an angle, increasing.
pub(super) fn beyond(web: &Web, rotations: &[[i64; 4]], theta: u32) -> Vec<u32> {
    let all = (0..web.motions.len() as u32).into_par_iter();
    let beyond = all.filter(|&pair| {
        let motion = &web.motions[pair as usize];
        !agrees(
            motion,
            motion.images.map(|image| rotations[image as usize]),
            theta,
        )
    });
    beyond.collect()
}

/// The rotations along a tree: with seed 0 of shortest ways from the image with most pairs, where pairs that close
/// triangles are short; with another one a shortest spanning tree of such pairs, shuffled.
fn from_tree(web: &Web, support: &[usize], seed: u64) -> Vec<Turn> {
    let mut turns: Vec<Option<Turn>> = vec![None; web.images()];
    let mut order: Vec<u32> = (0..web.images() as u32).collect();
    order.sort_by_key(|&image| Reverse(web.at(image).len()));
    let length = |pair: u32| {
        let mixed = (u64::from(pair) + 1).wrapping_mul(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let by = if seed == 0 {
            256
        } else {
            1 + (mixed >> 32 & 0xff)
        };
        BASE + (1 << 24) / ((1 + support[pair as usize] as u64) * by)
    };
    for root in order {
        let mut open = BinaryHeap::from([Reverse((0, root, None))]);
        while let Some(Reverse((cost, image, by))) = open.pop() {
            if turns[image as usize].is_some() {
                continue;
            }
            let along = |(from, step): (u32, Step)| {
                turns[from as usize].map(|turn| unit(times(&web.turn(step), &turn)))
            };
            turns[image as usize] = by.and_then(along).or(Some([1.0, 0.0, 0.0, 0.0]));
            let before = if seed == 0 { cost } else { 0 };
            for &(other, step) in web.at(image) {
                if turns[other as usize].is_none() {
                    open.push(Reverse((
                        before + length(step.0),
                        other,
                        Some((image, step)),
                    )));
                }
            }
        }
    }
    turns.into_iter().flatten().collect()
}

/// Lets each image in turn take a rotation with which more of its pairs agree; whether any did, or moved.
fn improve(web: &Web, turns: &mut [Turn], limit: f64) -> bool {
    let mut has_moved = false;
    for image in 0..web.images() as u32 {
        let said = web.at(image).iter();
        let said: Vec<Turn> = said
            .map(|&(other, step)| times(&conj(web.turn(step)), &turns[other as usize]))
            .collect();
        if said.len() < 2 {
            continue;
        }
        let least = (limit / 2.0).to_radians().cos();
        let apart = |a: &Turn, b: &Turn| (0..4).map(|k| a[k] * b[k]).sum::<f64>();
        let votes = |turn: &Turn| {
            said.iter()
                .filter(|one| apart(one, turn).abs() >= least)
                .count()
        };
        let now = turns[image as usize];
        let mut mean = [0.0; 4];
        for one in &said {
            let along = apart(one, &now);
            let weight = along.signum() / (1.0 - along * along).max(4e-4).sqrt();
            mean = [0, 1, 2, 3].map(|k| mean[k] + weight * one[k]);
        }
        let stride = said.len().div_ceil(WORDS);
        let tried = said.iter().step_by(stride).copied().chain([unit(mean)]);
        let (mut best, mut most) = (now, votes(&now));
        for turn in tried {
            let found = votes(&turn);
            if found > most || found == most && turn == unit(mean) {
                has_moved |= found > most || angle(&times(&conj(best), &turn)) > 0.1;
                (best, most) = (turn, found);
            }
        }
        turns[image as usize] = best;
    }
    has_moved
}
