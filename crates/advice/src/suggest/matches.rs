//! Images that, if they were matched, would join components of a camera-point graph.
//!
//! A match of two images gives a camera a point of the other's component to see, or makes two
//! points one. How many of either are enough is decided, on the condensation of all components
//! (docs/theory.md, 4.11): each number is proved, for any points that lie in one component only.

use super::{Candidate, Costs, Pair, Search, TRIED, Together, Wanted, ordered, touched};
use crate::condensation::{Condensation, terminals, with};
use crate::joints::{How, Joint};
use crate::parts::Parts;
use crate::{Known, OtherPair};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::HashMap;
use viewcert::Graph;
use viewcert::decide::{Options, VerdictError};

/// Two images to match, and how much has to come of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SuggestedMatch {
    /// The two cameras, the smaller node first.
    pub cameras: (u32, u32),
    /// What is known of the pair.
    pub known: Option<OtherPair>,
    /// Further observations that are enough, a camera and a point each. None of them can be left
    /// out; any points of the same component that are in no other one do as well.
    pub observations: Vec<(u32, u32)>,
    /// How many points of the one camera's component have to become one with points of the other's,
    /// if that is enough too.
    pub merged: Option<usize>,
    /// The components that become one, or parts of one, increasing.
    pub components: Vec<usize>,
    /// How many cameras the new component has.
    pub images: usize,
    /// How many cameras that is more than the largest of the components has.
    pub gain: usize,
    /// Why the two are worth trying.
    pub candidate: Candidate,
}

/// Most edges of the condensation, together and about, that are decided for all suggestions.
const WORK: usize = 4_000_000;

/// Fewest suggestions that are decided, however large the graph is.
const LEAST: usize = 20;

/// Suggests images to match in a camera-point graph, of which the first `cameras` nodes are
/// cameras: as they are worth trying, then by how few observations are enough, then by how many
/// cameras they add to a component.
///
/// Some decisions of a small graph for each of some hundred candidates, and of the condensed graph
/// for each of the best.
///
/// # Errors
/// Those of [`viewcert::decide()`].
pub fn suggest_matches(
    graph: &Graph,
    parts: &Parts,
    cameras: u32,
    joints: &[Joint],
    known: Known,
    wanted: Wanted,
    options: &Options,
) -> Result<Vec<SuggestedMatch>, VerdictError> {
    let search = Search::new(graph, parts, known, cameras);
    let touching: HashMap<[usize; 2], &How> = joints
        .iter()
        .map(|joint| (joint.components, &joint.how))
        .collect();
    let costs = Costs::new(&search);
    let further = further(&search, joints, wanted).into_iter();
    let candidates = costs.best(further, wanted.at, |_| true, TRIED);
    let near = candidates.par_iter().map(|&candidate| {
        let Some(attempt) = Attempt::new(&search, candidate.pair) else {
            return Ok(None);
        };
        let count = attempt.enough_alone(&search, &touching, options)?;
        Ok(count.map(|count| Promising::new(&search, attempt, candidate, count)))
    });
    let near: Result<Vec<Option<Promising>>, VerdictError> = near.collect();
    let mut near: Vec<Promising> = near?.into_iter().flatten().collect();
    near.sort_by_key(Promising::key);
    // What else is there may help: fewer observations may do.
    let nodes: Vec<&[u32]> = parts.parts.iter().map(|part| &part.nodes[..]).collect();
    let links = parts.links.iter().map(|&(pair, _)| pair);
    near.truncate(wanted.most);
    let ends = || near.iter().flat_map(|near| near.attempt.nodes());
    let touched = links.clone().flat_map(|(a, b)| [a, b]).chain(ends());
    let small = Condensation::new(terminals(&nodes, touched), links, ends()).with_scales(parts);
    let most = (WORK / (small.graph.edges().len() + 1)).max(LEAST);
    let each = near.par_iter().take(most);
    let found = each.map(|near| near.enough(&search, &small, options));
    let found: Result<Vec<Option<SuggestedMatch>>, VerdictError> = found.collect();
    let mut found: Vec<SuggestedMatch> = found?.into_iter().flatten().collect();
    found.sort_by_key(|one| {
        let rank = one.candidate.rank();
        (rank, one.observations.len(), Reverse(one.gain), one.cameras)
    });
    Ok(found)
}

/// An attempt that succeeds if there is nothing but the two components and what joins them.
struct Promising {
    attempt: Attempt,
    candidate: Candidate,
    /// How many observations are enough then.
    observations: usize,
    /// How many cameras are added to the larger component.
    gain: usize,
}

impl Promising {
    fn new(search: &Search, attempt: Attempt, candidate: Candidate, observations: usize) -> Self {
        let sizes = attempt.sides.iter().map(|side| match side {
            Some((part, _)) => search.images_of(&search.parts.parts[*part].nodes).len(),
            None => 1,
        });
        Self {
            candidate,
            gain: sizes.min().unwrap_or(0),
            observations,
            attempt,
        }
    }

    /// The best first.
    fn key(&self) -> ((super::Tried, usize, u32), usize, Reverse<usize>, Pair) {
        let rank = self.candidate.rank();
        (
            rank,
            self.observations,
            Reverse(self.gain),
            self.candidate.pair,
        )
    }

    /// The suggestion, if the components of both cameras are joined.
    fn enough(
        &self,
        search: &Search,
        small: &Condensation,
        options: &Options,
    ) -> Result<Option<SuggestedMatch>, VerdictError> {
        self.attempt.enough(search, small, self.candidate, options)
    }
}

/// Pairs of cameras to look at in graphs of any size: such near joints, near cameras that hang on
/// single observations, and of parts that are not connected.
fn further(search: &Search, joints: &[Joint], wanted: Wanted) -> Vec<Pair> {
    let here = |components: [usize; 2]| {
        wanted.at.is_none_or(|v| {
            let of = search.parts.components_of(v);
            components.iter().any(|part| of.contains(part))
        })
    };
    let near = joints.iter().filter(|joint| here(joint.components));
    let near = near.take(TRIED);
    let mut pairs: Vec<Pair> = near
        .filter_map(|joint| between(search, joint.components, &joint.how, wanted.at))
        .collect();
    pairs.extend(hanging(search, wanted.at));
    let apart = search.apart().into_iter().filter(|&parts| here(parts));
    pairs.extend(
        apart
            .take(TRIED)
            .filter_map(|components| between(search, components, &How::default(), wanted.at)),
    );
    pairs.extend(wanted.at.and_then(|camera| with_largest(search, camera)));
    pairs
}

/// A pair of cameras of two components, near where these touch.
fn between(search: &Search, components: [usize; 2], how: &How, at: Option<u32>) -> Option<Pair> {
    let [one, other] = [0, 1].map(|side| {
        let nodes = search.parts.nodes_of(components[side]);
        match at.filter(|v| nodes.binary_search(v).is_ok()) {
            Some(v) => vec![v],
            None => search.ends(&nodes, &touched(how, side), super::CHOICE),
        }
    });
    let mut pairs = one.iter().flat_map(|&a| other.iter().map(move |&b| (a, b)));
    pairs
        .find(|&pair| search.is_candidate(pair, at))
        .map(ordered)
}

/// Cameras of no part, with a camera that sees, in a part, a point that they see as well.
fn hanging(search: &Search, at: Option<u32>) -> Vec<Pair> {
    let mut found = Vec::new();
    for &((camera, point), _) in &search.parts.links {
        let is_frame = search.images.contains(&point);
        if is_frame || !search.parts.of(camera).is_empty() || at.is_some_and(|v| v != camera) {
            continue;
        }
        let near = search.neighbours.neighbours(point).iter();
        let mut near = near.filter(|&&other| search.parts.common(other, point).is_some());
        found.extend(near.next().map(|&other| ordered((camera, other))));
        if found.len() >= TRIED {
            break;
        }
    }
    found
}

/// A camera, and the one of the largest part that sees most.
fn with_largest(search: &Search, camera: u32) -> Option<Pair> {
    let largest = search.parts.parts.first()?;
    let mut ends = search.ends(&largest.nodes, &[], super::CHOICE).into_iter();
    ends.find(|&other| search.is_candidate((camera, other), None))
        .map(|other| ordered((camera, other)))
}

/// The pairs by which two components touch.
fn links_of(how: &How) -> impl Iterator<Item = Pair> {
    let by = how.through.iter().flat_map(|&[a, x, b]| [(a, x), (x, b)]);
    how.pairs.iter().copied().chain(by)
}

/// Two cameras, and points that they see in one component each and nowhere else.
struct Attempt {
    cameras: Pair,
    /// The part of each of the two, and two points at most.
    sides: [Option<(usize, Vec<u32>)>; 2],
}

impl Attempt {
    /// None, if neither camera sees a point of a part that is in no other component.
    fn new(search: &Search, cameras: Pair) -> Option<Self> {
        let side = |camera: u32| {
            let part = *search.parts.of(camera).first()?;
            let alone = |&&point: &&u32| {
                let is_point = !search.images.contains(&point);
                let is_alone = search.parts.links_at(point).next().is_none();
                is_point && is_alone && search.parts.of(point) == [part]
            };
            let points = search.neighbours.neighbours(camera).iter().filter(alone);
            Some((part as usize, points.take(2).copied().collect()))
        };
        let sides = [side(cameras.0), side(cameras.1)];
        let sees = |side: &Option<(usize, Vec<u32>)>| {
            side.as_ref().is_some_and(|(_, points)| !points.is_empty())
        };
        sides.iter().any(sees).then_some(Self { cameras, sides })
    }

    /// All nodes that it is about.
    fn nodes(&self) -> impl Iterator<Item = u32> {
        let points = self.sides.iter().flatten().flat_map(|(_, points)| points);
        points.copied().chain([self.cameras.0, self.cameras.1])
    }

    /// Sets of observations, the smaller ones first.
    fn observations(&self) -> Vec<Vec<Pair>> {
        let (a, b) = self.cameras;
        // What the camera of the other side would see.
        let seen = |camera: u32, side: usize| -> Vec<Pair> {
            let points = self.sides[side].iter().flat_map(|(_, points)| points);
            points.map(|&point| (camera, point)).collect()
        };
        let (by_b, by_a) = (seen(b, 0), seen(a, 1));
        let mut sets: Vec<Vec<Pair>> = [&by_b, &by_a]
            .into_iter()
            .filter_map(|seen| Some(vec![*seen.first()?]))
            .collect();
        match (by_b.first(), by_a.first()) {
            (Some(&one), Some(&other)) => sets.push(vec![one, other]),
            _ => sets.extend([by_b, by_a].into_iter().filter(|seen| seen.len() == 2)),
        }
        sets
    }

    /// Points of both sides that become one: one of them, two of them.
    fn merges(&self) -> Vec<Vec<Pair>> {
        let [Some((_, one)), Some((_, other))] = &self.sides else {
            return Vec::new();
        };
        let all: Vec<Pair> = one.iter().zip(other).map(|(&a, &b)| (a, b)).collect();
        (1..=all.len()).map(|count| all[..count].to_vec()).collect()
    }

    /// How many observations are enough, if there is nothing else than the components of both
    /// cameras and what joins these.
    fn enough_alone(
        &self,
        search: &Search,
        touching: &HashMap<[usize; 2], &How>,
        options: &Options,
    ) -> Result<Option<usize>, VerdictError> {
        let parts = &search.parts.parts;
        let sides: Vec<usize> = self.sides.iter().flatten().map(|side| side.0).collect();
        let nodes: Vec<&[u32]> = sides.iter().map(|&part| &parts[part].nodes[..]).collect();
        let links: Vec<Pair> = match sides[..] {
            [one, other] => {
                let key = [one.min(other), one.max(other)].map(|part| parts[part].component);
                let how = touching.get(&key).copied();
                how.into_iter().flat_map(links_of).collect()
            }
            _ => self.single(search),
        };
        let ends = || links.iter().flat_map(|&(a, b)| [a, b]).chain(self.nodes());
        let small = Condensation::new(terminals(&nodes, ends()), links.iter().copied(), ends());
        let small = small.with_scales(search.parts);
        for set in self.observations() {
            let more = set.iter().map(|&pair| small.pair(pair));
            if small.freedom(more, options)?.0 == 0 {
                return Ok(Some(set.len()));
            }
        }
        Ok(None)
    }

    /// What the camera that is in no part sees of the other one's.
    fn single(&self, search: &Search) -> Vec<Pair> {
        let cameras = [self.cameras.0, self.cameras.1];
        let both = cameras.iter().zip(self.sides.iter().rev());
        let seen = both.filter_map(|(&camera, other)| Some((camera, other.as_ref()?.0)));
        seen.flat_map(|(camera, part)| {
            let points = search.parts.links_at(camera).map(|(point, _)| point);
            let within = points.filter(move |&point| search.parts.parts[part].contains(point));
            within.map(move |point| (camera, point))
        })
        .collect()
    }

    /// The suggestion, if some of the sets of observations join the components of both cameras.
    fn enough(
        &self,
        search: &Search,
        small: &Condensation,
        candidate: Candidate,
        options: &Options,
    ) -> Result<Option<SuggestedMatch>, VerdictError> {
        for set in self.observations() {
            let pairs: Vec<Pair> = set.iter().map(|&pair| small.pair(pair)).collect();
            let graph = with(&small.graph, pairs.iter().copied());
            let found = search.together(small, &graph, &pairs, options)?;
            let Some(found) = found.filter(|found| self.is_joined(search, found)) else {
                continue;
            };
            return Ok(Some(SuggestedMatch {
                cameras: self.cameras,
                known: search.known.get(&self.cameras).copied(),
                observations: set,
                merged: self.merged(search, small, options)?,
                components: found.components,
                images: found.images,
                gain: found.gain,
                candidate,
            }));
        }
        Ok(None)
    }

    /// How many points have to become one, if two are enough.
    fn merged(
        &self,
        search: &Search,
        small: &Condensation,
        options: &Options,
    ) -> Result<Option<usize>, VerdictError> {
        for set in self.merges() {
            let merged = small.merged(&set);
            let cameras = [small.pair(self.cameras)];
            let found = search.together(&merged, &merged.graph, &cameras, options)?;
            if found.is_some_and(|found| self.is_joined(search, &found)) {
                return Ok(Some(set.len()));
            }
        }
        Ok(None)
    }

    /// Whether the components of both cameras have become one.
    fn is_joined(&self, search: &Search, found: &Together) -> bool {
        let mut sides = self.sides.iter().flatten();
        sides.all(|&(part, _)| {
            let component = search.parts.parts[part].component;
            found.components.binary_search(&component).is_ok()
        })
    }
}

#[cfg(test)]
mod tests;
