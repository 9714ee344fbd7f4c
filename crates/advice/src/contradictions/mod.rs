//! Contradictions between pairs: that so many measured motions cannot all be right (docs/contradictions.md).
//!
//! In: [`Motions`]. Out: [`Contradictions`]: at least so many are off by more than an angle, at most so many need
//! be, by packings of cycles and by rotations that integers have verified; and which pairs to look at.

mod average;
mod certificate;
mod packing;
mod sides;
mod turns;
mod web;
mod witness;

pub use certificate::certificate;
pub use packing::Packing;
pub use sides::{Look, Neighbours};

use crate::Nearness;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::HashSet;
use viewcert::graph::{Lists, biconnected_components};
use viewcert::watch::{Step as Stage, Stopped, Watch};
use viewcert_formats::{Motion, Motions};
use web::Web;

/// A step along a pair, by its number: from its first image to its second, or back.
type Step = (u32, bool);

/// A closed walk whose pairs cannot all be right.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Its steps.
    pub walk: Vec<(u32, bool)>,
    /// The vector along which each step leads, if its directions contradict each other.
    pub witness: Option<[i64; 3]>,
}

impl Cycle {
    fn has(&self, pair: u32) -> bool {
        self.walk.iter().any(|step| step.0 == pair)
    }
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Contradictions {
    /// Theta and phi, in degrees.
    pub angles: [u32; 2],
    /// The proof of how many are off by more than theta, by rotations alone.
    pub packing: Packing,
    /// The same with directions, if it is more: by more than theta, or phi in direction.
    pub directed: Option<Packing>,
    /// The same for a smaller angle, if it is more.
    pub finer: Option<(u32, Packing)>,
    /// A rotation of each image.
    pub rotations: Vec<[i64; 4]>,
    /// The pairs that disagree with them by more than theta.
    pub beyond: Vec<u32>,
    /// How many pairs are in no cycle.
    pub without_cycle: usize,
    /// What follows if neighbours by name are right.
    pub neighbours: Option<Neighbours>,
    /// Two pairs to look at, of which one group is wrong.
    pub look_at: Vec<Look>,
}

impl Contradictions {
    /// At least so many pairs are off.
    pub fn at_least(&self) -> usize {
        self.packing.at_least()
    }

    /// At most so many need be.
    pub fn at_most(&self) -> usize {
        self.beyond.len()
    }
}

/// Above so many pairs cycles are looked for only where rotations of all images leave a doubt.
const ALL: usize = 2000;
/// Steps of the longest cycles.
const LONGEST: usize = 17;
/// Cycles of a pair beside those without common pairs, for up to so many pairs in doubt.
const MORE: usize = 16;
const DOUBTS: usize = 2000;
/// The angle that is not enough for an alarm, and worth half a sentence.
const FINER: u32 = 5;

/// Phi for this theta, in degrees.
fn phi(theta: u32) -> u32 {
    (theta + 10).min(89)
}

/// What contradicts what by more than so many degrees. Where rotations may be meant the other way, the way with
/// fewer contradictions is the one that counts: the motions that come back are meant so.
///
/// # Errors
/// If the watch stops it.
pub fn contradictions<'a>(
    motions: &'a Motions,
    theta: u32,
    watch: &Watch,
) -> Result<(Cow<'a, Motions>, Contradictions), Stopped> {
    let found = one_way(motions, theta, watch)?;
    if !motions.either_way {
        return Ok((Cow::Borrowed(motions), found));
    }
    let reversed = motions.reversed();
    let other = one_way(&reversed, theta, watch)?;
    let size = |found: &Contradictions| (found.at_least(), found.at_most());
    Ok(match size(&other) < size(&found) {
        true => (Cow::Owned(reversed), other),
        false => (Cow::Borrowed(motions), found),
    })
}

fn one_way(motions: &Motions, theta: u32, watch: &Watch) -> Result<Contradictions, Stopped> {
    let task = watch.task(Stage::Cycles, motions.images);
    let pairs = &motions.pairs[..];
    let web = Web::new(pairs, motions.images);
    let angles = [theta, phi(theta)];
    let average = average::average(&web, theta);
    task.check()?;
    let open = open_cycles(&web, &average.beyond, theta);
    task.check()?;
    let packing = Packing::of(verified(pairs, &open, angles), pairs.len(), |_| false);
    task.check()?;
    let names: Vec<Cow<'_, str>> = (0..motions.images as u32)
        .map(|v| motions.labels.label(v))
        .collect();
    let near = Nearness::new(&names, &[]);
    let has_directions = pairs.len() <= ALL && pairs.iter().any(|motion| motion.is_wide);
    let mut both = open.clone();
    if has_directions {
        both.extend(web.short(true, |walk| {
            let is_closed =
                walk.len() > 2 && web.open(walk) <= f64::from(theta) * walk.len() as f64;
            is_closed
                .then(|| witness::one_way(&web, walk, angles))
                .flatten()
        }));
    }
    let both = verified(pairs, &both, angles);
    task.check()?;
    let directed = has_directions.then(|| Packing::of(both.clone(), pairs.len(), |_| false));
    let finer = (theta > FINER).then(|| {
        let beyond = average::beyond(&web, &average.rotations, FINER);
        let open = open_cycles(&web, &beyond, FINER);
        Packing::of(
            verified(pairs, &open, [FINER, phi(FINER)]),
            pairs.len(),
            |_| false,
        )
    });
    task.check()?;
    let at_least = packing.at_least();
    let neighbours = (at_least > 0 && motions.is_database)
        .then(|| sides::neighbours(&web, &motions.others, &both, &near, theta));
    Ok(Contradictions {
        angles,
        directed: directed.filter(|more| more.at_least() > at_least),
        finer: finer
            .filter(|more| more.at_least() > at_least)
            .map(|more| (FINER, more)),
        look_at: sides::look_at(&web, &open, &average.beyond, theta),
        without_cycle: without_cycle(pairs, motions.images),
        neighbours: neighbours
            .flatten()
            .filter(|found| found.packing.at_least() > 0),
        packing,
        rotations: average.rotations,
        beyond: average.beyond,
    })
}

/// The cycles that integers confirm.
fn verified(pairs: &[Motion], cycles: &[Cycle], angles: [u32; 2]) -> Vec<Cycle> {
    let holds = |cycle: &&Cycle| match cycle.witness {
        None => turns::is_open(pairs, &cycle.walk, angles[0]),
        Some(_) => turns::is_one_way(pairs, cycle, angles),
    };
    cycles.par_iter().filter(holds).cloned().collect()
}

/// Cycles whose composed rotation turns by more than theta a step. First, for each pair that disagrees with the
/// rotations of all images, one with no other such pair, such that they share no pair; then all short ones of a
/// small graph, and some more of single pairs.
fn open_cycles(web: &Web, beyond: &[u32], theta: u32) -> Vec<Cycle> {
    let is_open = |walk: &[Step]| web.open(walk) > f64::from(theta) * walk.len() as f64 + 1e-6;
    let cycle = |walk: Vec<Step>| Cycle {
        walk,
        witness: None,
    };
    let most = LONGEST.min(179 / theta as usize);
    let mut is_beyond = vec![false; web.motions.len()];
    beyond
        .iter()
        .for_each(|&pair| is_beyond[pair as usize] = true);
    let (mut used, nothing) = (is_beyond.clone(), vec![false; web.motions.len()]);
    let mut doubts = beyond.to_vec();
    let degree = |image: u32| web.at(image).len();
    doubts.sort_by_key(|&pair| {
        let [i, j] = web.motions[pair as usize].images;
        (degree(i).min(degree(j)), pair)
    });
    let (mut found, mut further) = (Vec::new(), Vec::new());
    for &pair in &doubts {
        let free = |is_used: &[bool], walk: &[Step]| {
            walk.len() <= most && walk[1..].iter().all(|step| !is_used[step.0 as usize])
        };
        let first = web
            .triangles(pair)
            .find(|walk| free(&used, walk) && is_open(walk));
        let around = |is_used: &[bool]| {
            let walk = web.around(pair, most, |other| !is_used[other as usize]);
            walk.filter(|walk| is_open(walk))
        };
        if let Some(walk) = first.or_else(|| around(&used)) {
            walk.iter().for_each(|step| used[step.0 as usize] = true);
            found.push(cycle(walk));
        }
        if doubts.len() <= DOUBTS {
            let more = web
                .triangles(pair)
                .filter(|walk| free(&is_beyond, walk) && is_open(walk));
            further.extend(more.take(MORE).map(cycle));
            further.extend(around(&is_beyond).map(cycle));
            further.extend(around(&nothing).map(cycle));
        }
    }
    if web.motions.len() <= ALL {
        found.extend(web.short(most >= 4, |walk| {
            (walk.len() <= most && is_open(walk)).then(|| cycle(walk.to_vec()))
        }));
    }
    found.extend(further);
    found
}

/// How many pairs are bridges, which no cycle goes through.
fn without_cycle(pairs: &[Motion], images: usize) -> usize {
    let ends = pairs
        .iter()
        .map(|motion| (motion.images[0], motion.images[1]));
    let mut ends: Vec<(u32, u32)> = ends.map(|(i, j)| (i.min(j), i.max(j))).collect();
    ends.sort_unstable();
    let single: HashSet<(u32, u32)> = ends
        .chunk_by(|a, b| a == b)
        .filter(|same| same.len() == 1)
        .map(|same| same[0])
        .collect();
    ends.dedup();
    let both = ends.iter().flat_map(|&(i, j)| [(i, j), (j, i)]);
    let mut bridges = 0;
    biconnected_components(&Lists::group(images, both), |part| {
        if let [a, b] = *part {
            bridges += usize::from(single.contains(&(a.min(b), a.max(b))));
        }
    });
    bridges
}
