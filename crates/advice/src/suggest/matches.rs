//! Images that, if they were matched, would join components of a camera-point graph.
//!
//! A match of two images gives a camera a point of the other's component to see. How many are enough is
//! decided, on the condensation of all components (docs/theory.md, 4.11): each number is proved, for any
//! points that lie in one component only.

use super::{Candidate, Costs, Pair, Search, TRIED, Together, Wanted};
use crate::condensation::{Condensation, terminals, with};
use crate::parts::Parts;
use crate::{Known, OtherPair};
use rayon::prelude::*;
use std::cmp::Reverse;
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
    /// The components that become one, or parts of one, increasing.
    pub components: Vec<usize>,
    /// How many cameras the new component has.
    pub images: usize,
    /// How many cameras that is more than the largest of the components has.
    pub gain: usize,
    /// Why the two are worth trying.
    pub candidate: Candidate,
}

/// Most edges of the condensation, over all decisions and about.
const WORK: usize = 4_000_000;

/// So many candidates are decided at once, and at least.
const LEAST: usize = 20;

/// Suggests images to match in a camera-point graph, of which the first `cameras` nodes are
/// cameras: as they are worth trying, then by how few observations are enough, then by how many
/// cameras they add to a component.
///
/// Some decisions of the condensed graph for each of some candidates.
///
/// # Errors
/// Those of [`viewcert::decide()`].
pub fn suggest_matches(
    graph: &Graph,
    parts: &Parts,
    cameras: u32,
    known: Known,
    wanted: Wanted,
    options: &Options,
) -> Result<Vec<SuggestedMatch>, VerdictError> {
    let search = Search::new(graph, parts, known, cameras);
    let candidates = Costs::new(&search).best(wanted.at, |_| true, TRIED);
    let attempts = candidates.into_iter();
    let attempts = attempts.filter_map(|one| Some((Attempt::new(&search, one.pair)?, one)));
    let attempts: Vec<(Attempt, Candidate)> = attempts.collect();
    let nodes: Vec<&[u32]> = parts.parts.iter().map(|part| &part.nodes[..]).collect();
    let links = parts.links.iter().map(|&(pair, _)| pair);
    let ends = || attempts.iter().flat_map(|(attempt, _)| attempt.nodes());
    let touched = links.clone().flat_map(|(a, b)| [a, b]).chain(ends());
    let small = Condensation::new(terminals(&nodes, touched), links, ends()).with_scales(parts);
    let most = (WORK / (small.graph.edges().len() + 1)).max(LEAST);
    let mut found: Vec<SuggestedMatch> = Vec::new();
    for some in attempts[..most.min(attempts.len())].chunks(LEAST) {
        let each = some.par_iter();
        let each = each.map(|(attempt, one)| attempt.enough(&search, &small, *one, options));
        let each: Result<Vec<Option<SuggestedMatch>>, VerdictError> = each.collect();
        found.extend(each?.into_iter().flatten());
        if found.len() >= wanted.most {
            break;
        }
    }
    found.sort_by_key(|one| {
        let rank = one.candidate.rank();
        (rank, one.observations.len(), Reverse(one.gain), one.cameras)
    });
    found.truncate(wanted.most);
    Ok(found)
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
                components: found.components,
                images: found.images,
                gain: found.gain,
                candidate,
            }));
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
