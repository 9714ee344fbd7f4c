//! Special geometry: where a verdict about generic positions promises too much.
//!
//! In: the pairs of images, the tracks and their components, and what is known of the geometry of
//! pairs. Out: the places that a component hangs on ([`Narrow`]) and what is special there: pairs
//! of images that stand in one place, hinges in one place. Verdicts are about
//! generic positions; those of photographs that were taken from one place are not. The angles are
//! estimates of the database, and no verdict depends on them.

use crate::bottlenecks::{self, Cut, Hinges};
use crate::frames::Images;
use crate::mapper::Geometry;
use crate::named::Names;
use anyhow::Result;
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use viewcert::{Graph, Verdict};
use viewcert_formats::NamedGraph;
use viewcert_formats::colmap::{Estimate, LEAST_ANGLE};

/// Most places of each kind that are looked at, and most pairs of one.
const MOST: usize = 20;

/// The places that components hang on.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Narrow {
    /// Few pairs that alone hold images together.
    pub few: Vec<Few>,
    /// Pairs between different components.
    pub between: Vec<Between>,
    /// Two images through which alone groups of images hang together.
    pub hinges: Vec<Hinge>,
}

/// Few pairs that alone hold images together.
#[derive(Clone, Debug, Serialize)]
pub struct Few {
    /// The pairs.
    pub pairs: Vec<Pair>,
    /// How many images are on each side.
    pub sides: [usize; 2],
    /// Whether all the pairs are special.
    pub special: bool,
}

/// The pairs between two components.
#[derive(Clone, Debug, Serialize)]
pub struct Between {
    /// The components, from 1.
    pub components: [usize; 2],
    /// How many pairs there are.
    pub count: usize,
    /// Those with most inliers.
    pub pairs: Vec<Pair>,
    /// Whether all of these are special.
    pub special: bool,
}

/// Two images through which alone groups of images hang together.
#[derive(Clone, Debug, Serialize)]
pub struct Hinge {
    /// The two, as a pair.
    pub pair: Pair,
    /// How many images the groups have.
    pub sides: Vec<usize>,
    /// Whether they stand in one place, as far as is known.
    pub special: bool,
}

/// A pair, and what is known of it.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// The two images.
    pub images: [String; 2],
    /// Verified matches, if the two were matched.
    pub inliers: Option<u32>,
    /// The configuration of the database.
    pub config: Option<i64>,
    /// The median angle between rays to a point, in degrees.
    pub angle: Option<f64>,
    /// Whether it is panoramic, or its rays are less than a degree apart.
    pub special: bool,
}

/// What is looked at.
struct Look<'a> {
    names: Names<'a>,
    inliers: BTreeMap<(u32, u32), u32>,
    geometry: &'a mut dyn Geometry,
}

/// The narrow places of the pairs of `pairs`, whose images are the cameras of `tracks`. Images of a
/// frame are held together by it; where there are any, no hinges are looked for.
///
/// # Errors
/// Those of the geometry.
pub fn narrow(
    pairs: &NamedGraph,
    tracks: Option<(&NamedGraph, &Verdict)>,
    geometry: &mut dyn Geometry,
) -> Result<Narrow> {
    let graph = &pairs.graph;
    let inliers = pairs
        .matching
        .iter()
        .flat_map(|known| &known.inliers)
        .copied();
    let mut look = Look {
        names: Names::new(pairs),
        inliers: graph.edges().iter().copied().zip(inliers).collect(),
        geometry,
    };
    let mut found = Narrow::default();
    let known = tracks.map_or_else(Images::default, |(tracks, _)| Images::new(pairs, tracks));
    for cut in bottlenecks::cuts(graph, &known.frames).iter().take(MOST) {
        found.few.push(look.few(cut)?);
    }
    let Some((tracks, verdict)) = tracks else {
        return Ok(found);
    };
    for ((one, other), pairs) in between(graph, verdict, &known).into_iter().take(MOST) {
        found.between.push(look.between([one, other], pairs)?);
    }
    // Hinges are about the scale of groups, which base lines tell.
    if !known.frames.is_empty() {
        return Ok(found);
    }
    let hinges = bottlenecks::hinges(graph);
    let alone = hinges
        .iter()
        .filter(|hinges| hold_alone(&tracks.graph, graph.nodes(), hinges));
    for hinge in alone.take(MOST) {
        found.hinges.push(look.hinge(hinge)?);
    }
    Ok(found)
}

impl Look<'_> {
    fn pair(&mut self, (a, b): (u32, u32)) -> Result<Pair> {
        let inliers = self.inliers.get(&(a, b)).copied();
        let known = match inliers {
            Some(_) => self.geometry.of((a, b))?,
            None => None,
        };
        Ok(Pair {
            images: self.names.pair((a, b)),
            inliers,
            config: known.map(|known| known.config),
            angle: known.and_then(|known| known.angle),
            special: known.is_some_and(|known| is_special(&known)),
        })
    }

    fn few(&mut self, cut: &Cut) -> Result<Few> {
        let pairs = cut.pairs.iter().map(|&pair| self.pair(pair));
        let pairs = pairs.collect::<Result<Vec<_>>>()?;
        Ok(Few {
            sides: [cut.side.len(), cut.others],
            special: pairs.iter().all(|pair| pair.special),
            pairs,
        })
    }

    fn between(&mut self, components: [usize; 2], mut pairs: Vec<(u32, u32)>) -> Result<Between> {
        let count = pairs.len();
        pairs.sort_by_key(|pair| Reverse(self.inliers.get(pair).copied()));
        pairs.truncate(MOST);
        let pairs = pairs.into_iter().map(|pair| self.pair(pair));
        let pairs = pairs.collect::<Result<Vec<_>>>()?;
        Ok(Between {
            components,
            count,
            special: pairs.iter().all(|pair| pair.special),
            pairs,
        })
    }

    fn hinge(&mut self, hinges: &Hinges) -> Result<Hinge> {
        let [a, b] = hinges.images;
        let pair = self.pair((a, b))?;
        Ok(Hinge {
            special: pair.special,
            pair,
            sides: hinges.groups.iter().map(Vec::len).collect(),
        })
    }
}

/// Whether the images of a pair stand in one place, as far as is known.
fn is_special(known: &Estimate) -> bool {
    known.config == 5 || known.angle.is_some_and(|angle| angle < LEAST_ANGLE)
}

/// The pairs between images of different components, of which neither is in both.
fn between(
    graph: &Graph,
    verdict: &Verdict,
    images: &Images,
) -> BTreeMap<(usize, usize), Vec<(u32, u32)>> {
    // There are as many cameras as images, or fewer.
    let mut of_camera: Vec<Vec<usize>> = vec![Vec::new(); graph.nodes()];
    for (k, part) in (1..).zip(&verdict.components) {
        let cameras = part.nodes();
        let cameras = &cameras[..cameras.partition_point(|&v| (v as usize) < graph.nodes())];
        if cameras.len() > 1 && part.edge_count() > 0 {
            cameras
                .iter()
                .for_each(|&camera| of_camera[camera as usize].push(k));
        }
    }
    let of = |image: u32| &of_camera[images.camera_of(image) as usize][..];
    let mut found: BTreeMap<(usize, usize), Vec<(u32, u32)>> = BTreeMap::new();
    for &(a, b) in graph.edges() {
        if let ([one], [other]) = (of(a), of(b))
            && one != other
        {
            let key = (*one.min(other), *one.max(other));
            found.entry(key).or_default().push((a, b));
        }
    }
    found
}

/// Whether no track leads from one group to another past the hinges. O(observations).
fn hold_alone(tracks: &Graph, images: usize, hinges: &Hinges) -> bool {
    let mut group = vec![0; tracks.nodes()];
    for (k, images) in (1..).zip(&hinges.groups) {
        images.iter().for_each(|&image| group[image as usize] = k);
    }
    tracks.edges().iter().all(|&(image, point)| {
        debug_assert!(point as usize >= images);
        let here = group[image as usize];
        let of_point = &mut group[point as usize];
        let first = std::mem::replace(of_point, if here == 0 { *of_point } else { here });
        here == 0 || first == 0 || first == here
    })
}

#[cfg(test)]
mod tests;
