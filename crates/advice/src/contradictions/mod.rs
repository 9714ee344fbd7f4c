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
pub use packing::{Packing, Terms};
pub use sides::{Look, Neighbours};

use rayon::prelude::*;
use std::collections::HashSet;
use viewcert::graph::{Lists, biconnected_components};
use viewcert::watch::{Step as Stage, Stopped, Watch};
use viewcert_formats::{Motion, Motions, Source};
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
    /// The proof of how many are off, by rotations alone.
    pub packing: Packing,
    /// The same with directions, if it is more.
    pub directed: Option<Packing>,
    /// The same for a smaller angle, if it is more.
    pub finer: Option<Packing>,
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
/// The angles of a cycle's pairs sum to so many degrees at most.
const MOST: u32 = 179;
/// Cycles of a pair beside those without common pairs, for up to so many pairs in doubt.
const MORE: usize = 16;
const DOUBTS: usize = 2000;
/// The angle that is not enough for an alarm, and worth half a sentence.
const FINER: u32 = 5;

/// What contradicts what by more than so many degrees. Where rotations may be meant the other way, the way with
/// fewer contradictions is the one that counts: the motions that come back are meant so.
///
/// # Errors
/// If the watch stops it.
pub fn contradictions(
    motions: Motions,
    theta: u32,
    watch: &Watch,
) -> Result<(Motions, Contradictions), Stopped> {
    let found = one_way(&motions, theta, watch)?;
    if motions.either_way {
        let reversed = motions.reversed();
        let other = one_way(&reversed, theta, watch)?;
        let size = |found: &Contradictions| (found.at_least(), found.at_most());
        if size(&other) < size(&found) {
            return Ok((reversed, other));
        }
    }
    Ok((motions, found))
}

fn one_way(motions: &Motions, theta: u32, watch: &Watch) -> Result<Contradictions, Stopped> {
    let task = watch.task(Stage::Cycles, motions.images);
    let pairs = &motions.pairs[..];
    let web = Web::new(pairs, motions.images);
    let (rotations, beyond) = average::average(&web, theta);
    task.check()?;
    let terms = Terms::new(theta);
    let open = open_cycles(&web, &beyond, &terms);
    task.check()?;
    let packed = |cycles: &[Cycle], terms: Terms| {
        Packing::of(verified(pairs, cycles, &terms), pairs.len(), terms)
    };
    let packing = packed(&open, terms.clone());
    task.check()?;
    let at_least = packing.at_least();
    let is_more = |more: &Packing| more.at_least() > at_least;
    let mut one_way = Vec::new();
    if pairs.len() <= ALL && pairs.iter().any(|motion| motion.is_wide) {
        one_way = web.short(true, |walk| {
            let is_closed = walk.len() > 2 && web.open(walk) <= f64::from(terms.sum(walk));
            let found = is_closed.then(|| witness::one_way(&web, walk, [theta, terms.phi]));
            found.flatten()
        });
    }
    task.check()?;
    let directed = (!one_way.is_empty()).then(|| packed(&[&open[..], &one_way].concat(), terms));
    let finer = (theta > FINER).then(|| {
        let beyond = average::beyond(&web, &rotations, FINER);
        let terms = Terms::new(FINER);
        packed(&open_cycles(&web, &beyond, &terms), terms)
    });
    task.check()?;
    let names_neighbours = match motions.source {
        Source::Database => at_least > 0,
        Source::PoseGraph => true,
        Source::Poses => false,
    };
    let neighbours = names_neighbours.then(|| sides::neighbours(&web, motions, &one_way, theta));
    Ok(Contradictions {
        directed: directed.filter(is_more),
        finer: finer.filter(is_more),
        look_at: sides::look_at(&web, &open, &beyond, theta),
        without_cycle: without_cycle(pairs, motions.images),
        neighbours: neighbours.flatten(),
        packing,
        rotations,
        beyond,
    })
}

/// The cycles that integers confirm.
fn verified(pairs: &[Motion], cycles: &[Cycle], terms: &Terms) -> Vec<Cycle> {
    let holds = |cycle: &&Cycle| match cycle.witness {
        None => turns::is_open(pairs, &cycle.walk, terms.sum(&cycle.walk)),
        Some(_) => turns::is_one_way(pairs, cycle, [terms.theta, terms.phi]),
    };
    cycles.par_iter().filter(holds).cloned().collect()
}

/// Cycles whose composed rotation turns by more than their pairs may be off. First, for each pair in doubt that is
/// not assumed right, one with no other such pair, such that they share no pair; then all short ones of a small
/// graph, and some more of single pairs.
fn open_cycles(web: &Web, doubts: &[u32], terms: &Terms) -> Vec<Cycle> {
    let is_open = |walk: &[Step]| {
        let sum = terms.sum(walk);
        sum <= MOST && web.open(walk) > f64::from(sum) + 1e-6
    };
    let cycle = |walk: Vec<Step>| Cycle {
        walk,
        witness: None,
    };
    let mut is_doubtful = vec![false; web.motions.len()];
    doubts.iter().for_each(|&k| is_doubtful[k as usize] = true);
    let (mut used, nothing) = (is_doubtful.clone(), vec![false; web.motions.len()]);
    let is_free = |is_used: &[bool], pair: u32| !is_used[pair as usize] || terms.is_assumed(pair);
    let mut doubts = doubts.to_vec();
    let degree = |image: u32| web.at(image).len();
    doubts.sort_by_key(|&pair| {
        let [i, j] = web.motions[pair as usize].images;
        (degree(i).min(degree(j)), pair)
    });
    let (mut found, mut further) = (Vec::new(), Vec::new());
    let are_few = doubts.len() <= DOUBTS && (web.motions.len() <= ALL || terms.assumed.is_empty());
    for &pair in &doubts {
        let near = |is_used: &[bool], walk: &[Step]| {
            walk[1..].iter().all(|step| is_free(is_used, step.0)) && is_open(walk)
        };
        let around = |is_used: &[bool]| {
            let cost = |other| is_free(is_used, other).then(|| terms.within(other));
            let walk = web.around(pair, 1000 * MOST - terms.within(pair), cost);
            walk.filter(|walk| is_open(walk))
        };
        let first = web.triangles(pair).find(|walk| near(&used, walk));
        if let Some(walk) = first.or_else(|| around(&used)) {
            walk.iter().for_each(|step| used[step.0 as usize] = true);
            found.push(cycle(walk));
        }
        if are_few {
            let more = web.triangles(pair).filter(|walk| near(&is_doubtful, walk));
            further.extend(more.take(MORE).map(cycle));
            further.extend(around(&is_doubtful).map(cycle));
            further.extend(around(&nothing).map(cycle));
        }
    }
    if web.motions.len() <= ALL {
        found.extend(web.short(4 * terms.theta <= MOST, |walk| {
            is_open(walk).then(|| cycle(walk.to_vec()))
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
