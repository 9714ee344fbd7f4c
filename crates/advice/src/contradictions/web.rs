//! Closed walks over measured pairs: short ones, and those through a pair.

use super::Step;
use super::turns::{Turn, angle, conj, times, unit};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use viewcert_formats::Motion;

/// The pairs at every image.
pub(super) struct Web<'a> {
    pub(super) motions: &'a [Motion],
    /// Of length 1, from the first image to the second.
    pub(super) turns: Vec<Turn>,
    /// At every image the other one and the step to it, increasing.
    at: Vec<Vec<(u32, Step)>>,
}

/// Most images that a search for one walk meets.
const MET: usize = 4000;

impl<'a> Web<'a> {
    pub(super) fn new(motions: &'a [Motion], images: usize) -> Self {
        let mut at = vec![Vec::new(); images];
        for (pair, motion) in (0..).zip(motions) {
            let [i, j] = motion.images;
            at[i as usize].push((j, (pair, true)));
            at[j as usize].push((i, (pair, false)));
        }
        at.iter_mut().for_each(|here| here.sort_unstable());
        let turns = motions
            .iter()
            .map(|motion| unit(motion.rotation.map(|x| x as f64)));
        Self {
            motions,
            turns: turns.collect(),
            at,
        }
    }

    pub(super) fn images(&self) -> usize {
        self.at.len()
    }

    pub(super) fn at(&self, image: u32) -> &[(u32, Step)] {
        &self.at[image as usize]
    }

    /// The steps from one image to another.
    fn between(&self, a: u32, b: u32) -> &[(u32, Step)] {
        let here = self.at(a);
        let from = here.partition_point(|&(other, _)| other < b);
        let count = here[from..].partition_point(|&(other, _)| other == b);
        &here[from..from + count]
    }

    /// The rotation of a step.
    pub(super) fn turn(&self, (pair, forth): Step) -> Turn {
        let turn = self.turns[pair as usize];
        if forth { turn } else { conj(turn) }
    }

    /// The composed rotation of a walk.
    pub(super) fn along(&self, walk: &[Step]) -> Turn {
        let turns = walk.iter().map(|&step| self.turn(step));
        turns.fold([1.0, 0.0, 0.0, 0.0], |before, turn| times(&turn, &before))
    }

    /// What `each` makes of the closed walks of two and three steps, and of four if that is asked; each once.
    pub(super) fn short<T: Send>(
        &self,
        four: bool,
        each: impl Fn(&[Step]) -> Option<T> + Sync,
    ) -> Vec<T> {
        let images: Vec<u32> = (0..self.images() as u32).collect();
        let found = images.par_iter().flat_map_iter(|&i| {
            let mut found = Vec::new();
            let above = |image: u32| self.at(image).iter().filter(move |&&(other, _)| other > i);
            for &(j, one) in above(i) {
                let again = self.between(j, i).iter().filter(|(_, back)| back.0 > one.0);
                found.extend(again.filter_map(|&(_, back)| each(&[one, back])));
                for &(k, two) in above(j) {
                    if k > j {
                        let close = self.between(k, i).iter();
                        found.extend(close.filter_map(|&(_, three)| each(&[one, two, three])));
                    }
                    for &(l, three) in above(k).filter(|&&(l, _)| four && k != j && l > j && l != k)
                    {
                        let close = self.between(l, i).iter();
                        found.extend(close.filter_map(|&(_, last)| each(&[one, two, three, last])));
                    }
                }
            }
            found
        });
        found.collect()
    }

    /// The closed walks of two and three steps that begin with a pair.
    pub(super) fn triangles(&self, pair: u32) -> impl Iterator<Item = Vec<Step>> {
        let [i, j] = self.motions[pair as usize].images;
        let one = (pair, true);
        let (fewer, j_is_fewer) = match self.at(j).len() <= self.at(i).len() {
            true => (j, true),
            false => (i, false),
        };
        let again = self
            .between(j, i)
            .iter()
            .filter(move |(_, back)| back.0 != pair);
        let again = again.map(move |&(_, back)| vec![one, back]);
        // Each pair begins elsewhere, or all would use up the pairs of the first images.
        let here = self.at(fewer);
        let (last, first) = here.split_at(pair as usize * 7919 % here.len().max(1));
        let third = first.iter().chain(last);
        let third = third.filter(move |&&(k, _)| k != i && k != j);
        let third = third.flat_map(move |&(k, near)| {
            let far = self.between(k, if j_is_fewer { i } else { j }).iter();
            far.map(move |&(_, far)| match j_is_fewer {
                true => vec![one, near, far],
                false => vec![one, (far.0, !far.1), (near.0, !near.1)],
            })
        });
        again.chain(third)
    }

    /// A closed walk that begins with a pair and goes on over others, which cost so much each, or are closed; nearly
    /// the cheapest, if it costs so much at most.
    pub(super) fn around(
        &self,
        pair: u32,
        most: u32,
        cost: impl Fn(u32) -> Option<u32>,
    ) -> Option<Vec<Step>> {
        let [target, start] = self.motions[pair as usize].images;
        let mut from = HashMap::from([(start, (0, None))]);
        let mut open = BinaryHeap::from([Reverse((0, start))]);
        while let Some(Reverse((spent, image))) = open.pop() {
            if from.len() > MET {
                return None;
            }
            if from[&image].0 < spent {
                continue;
            }
            for &(other, step) in self.at(image) {
                let more = cost(step.0).filter(|_| step.0 != pair);
                let Some(sum) = more.map(|more| spent + more).filter(|&sum| sum <= most) else {
                    continue;
                };
                if from.get(&other).is_some_and(|&(least, _)| least <= sum) {
                    continue;
                }
                from.insert(other, (sum, Some((image, step))));
                if other == target {
                    let back = std::iter::successors(from[&target].1, |(image, _)| from[image].1);
                    let mut walk: Vec<Step> = back.map(|(_, step)| step).collect();
                    walk.push((pair, true));
                    walk.reverse();
                    return Some(walk);
                }
                open.push(Reverse((sum, other)));
            }
        }
        None
    }

    /// By how much a closed walk turns, in degrees.
    pub(super) fn open(&self, walk: &[Step]) -> f64 {
        angle(&self.along(walk))
    }
}
