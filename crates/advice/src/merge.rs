//! Two models, and whether what they share fixes the one against the other.
//!
//! In: two models of COLMAP, each right in itself, and perhaps the camera-point graph of their
//! database. Out: what they share, what is left free between them, and what to match. Two models
//! differ by a similarity: 3 degrees of freedom of rotation, and in the terms of docs/theory.md,
//! section 12, 3 of translation and 1 of scale. An image in both fixes the rotation, and so does a
//! verified pair from the one to the other; then each model is a body, and its images and points
//! are nodes. Two bodies with two common nodes are one (Theorem 4.1, rule 2), with one the scale is
//! free. Images of a frame that were taken at one place are one camera; a model with a known base line
//! is a scaled body, and two of these that share a node are one (13.16). With a database the graph of
//! its tracks is decided with both models as known parts (Theorem 4.14). No number of a model is used
//! but to see which sensors are at one place; nothing is written.

use crate::Shapes;
use crate::condensation::{chain, with};
use crate::named::{Names, Suggestion};
use crate::parts::Parts;
use crate::task::{Task, number};
use crate::words::{self, Scales};
use anyhow::{Context, Result, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use viewcert::decide::{Calibrated, Known, Options, Question, decide};
use viewcert::geometry::model::Model as Geometry;
use viewcert::graph::UnionFind;
use viewcert::watch::Watch;
use viewcert::{KnownParts, Verdict};
use viewcert_formats::{Model, NamedGraph, with_rigs};

/// Degrees of freedom of a similarity, of translation and scale, and of scale.
const SIMILARITY: usize = 7;
const RIGID: usize = SIMILARITY - SCALE;
const TRANSLATION_AND_SCALE: usize = 4;
const SCALE: usize = 1;

/// How many images COLMAP's `model_merger` has to find in both models
/// (`AlignReconstructionsViaReprojections`).
pub const MERGER: usize = 3;

/// Most suggestions that are looked for, and that are kept.
const LOOKED_FOR: usize = 40;
const KEPT: usize = 8;

/// What two models share, and what follows.
#[derive(Clone, Debug, Serialize)]
pub struct Merge {
    /// How many images each has.
    pub images: [usize; 2],
    /// How many points each has.
    pub points: [usize; 2],
    /// The images of both.
    pub shared_images: Vec<String>,
    /// At how many places these were taken: images of a frame may be at one.
    pub shared_places: usize,
    /// Whether frames with a known base line say the scale of each.
    pub scaled: [bool; 2],
    /// How many points of both are seen by one feature of an image of both; null if the features
    /// of these images are not the same.
    pub shared_points: Option<usize>,
    /// Whether something fixes the one against the other: rotation, translation and scale.
    pub determined: bool,
    /// How many of the 7 degrees of freedom are left; null where third parts may fix some of them.
    pub freedom: Option<usize>,
    /// These in words.
    pub free: String,
    /// What it rests on: `models` or `tracks`.
    pub by: &'static str,
    /// Whether there are images enough in both for COLMAP's `model_merger`.
    pub model_merger: bool,
    /// With a database, images to match that would join the two; empty if none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suggestions: Option<Vec<Suggestion>>,
}

/// What two models alone tell. O(n log n) for n features of images of both.
pub fn of_models(models: [&Model; 2]) -> Merge {
    let [one, other] = models.map(|model| {
        let images = model.images.iter();
        let named = images.map(|image| (&*image.name, image));
        named.collect::<BTreeMap<_, _>>()
    });
    let both = one.iter().filter_map(|(name, first)| {
        let second = other.get(name)?;
        Some((*name, *first, *second))
    });
    let both: Vec<_> = both.collect();
    let places = places(models, both.iter().map(|(_, first, _)| first.id));
    let same_features = both
        .iter()
        .all(|(_, first, second)| first.points.len() == second.points.len());
    let same = both.iter().flat_map(|(_, first, second)| {
        let features = first.points.iter().zip(&second.points);
        features.filter_map(|(&a, &b)| Some((a?, b?)))
    });
    let shared_points = same_features.then(|| classes(same));
    let scaled = models.map(|model| !model.known_frames().groups.is_empty());
    let of_scale = if scaled == [true, true] { 0 } else { SCALE };
    let freedom = match (places, shared_points.unwrap_or(0)) {
        (0, _) => RIGID + of_scale,
        (1, 0) => of_scale,
        _ => 0,
    };
    Merge {
        images: models.map(|model| model.images.len()),
        shared_places: places,
        scaled,
        points: models.map(|model| model.points.len()),
        shared_images: both.iter().map(|(name, ..)| (*name).to_owned()).collect(),
        shared_points,
        determined: freedom == 0,
        freedom: Some(freedom),
        free: free(freedom),
        by: "models",
        model_merger: both.len() >= MERGER,
        suggestions: None,
    }
}

/// At how many places images of both were taken: images of a frame may be at one, by either model.
fn places(models: [&Model; 2], both: impl Iterator<Item = u32>) -> usize {
    let [first, second] = models;
    let both: BTreeSet<u32> = both.collect();
    let shared = first.images.iter().filter(|image| both.contains(&image.id));
    let names: Vec<&str> = shared.map(|image| &*image.name).collect();
    let at = |name: &str| names.iter().position(|of_both| *of_both == name);
    let mut sets = UnionFind::new(names.len());
    let mut count = names.len();
    for model in [first, second] {
        for (&one, others) in &model.known_frames().together {
            let one = std::iter::once(&model.images[one as usize].name);
            let here: Vec<usize> = one.chain(others).filter_map(|name| at(name)).collect();
            for two in here.windows(2) {
                count -= usize::from(sets.find(two[0]) != sets.find(two[1]));
                sets.union(two[0], two[1]);
            }
        }
    }
    count
}

/// How many classes of points there are: points of the two models that are the same, directly or by
/// others.
fn classes(same: impl Iterator<Item = (u64, u64)>) -> usize {
    let same: BTreeSet<(u64, u64)> = same.collect();
    let mut sets = UnionFind::new(0);
    let (mut first, mut second) = (BTreeMap::new(), BTreeMap::new());
    for (a, b) in same {
        let a = *first.entry(a).or_insert_with(|| sets.push());
        let b = *second.entry(b).or_insert_with(|| sets.push());
        sets.union(a, b);
    }
    let roots: BTreeSet<usize> = first.values().map(|&a| sets.find(a)).collect();
    roots.len()
}

fn free(freedom: usize) -> String {
    match freedom {
        0 => "nothing".to_owned(),
        SIMILARITY => "everything: rotation, translation and relative scale".to_owned(),
        RIGID => "rotation and translation".to_owned(),
        _ => words::meaning(Geometry::Calibrated, freedom, Scales::Free),
    }
}

/// What two models and the tracks of their database tell: `input` is the camera-point graph, whose
/// cameras have the names of images. Where rigs have known base lines, which known parts are not
/// decided with, it gets the pairs of a chain of triangles on the cameras of each model, which holds
/// them together as well (4.4). A decision, and those of suggestions.
///
/// # Errors
/// An image of a model that the database does not have; those of decisions; work that was stopped.
pub fn of_tracks(
    models: [&Model; 2],
    input: &mut NamedGraph,
    seed: u64,
    watch: &Watch,
) -> Result<(Merge, Verdict)> {
    let parts = cameras_of(models, input)?;
    let question = match with_rigs(Known::default(), input)? {
        Known::Parts(_) => {
            let known = KnownParts::new(input.graph.nodes() as u32, parts.clone())?;
            Question::with_parts(Geometry::Calibrated, known)
        }
        lines => {
            input.graph = with(&input.graph, parts.iter().flat_map(|part| chain(part)));
            Calibrated::with(lines).into()
        }
    };
    let input = &*input;
    let names = Names::new(input);
    let cameras = names.images().end;
    let graph = &input.graph;
    let options = Options::default().question(question).seed(seed);
    let verdict = decide(graph, &options.watch(watch.clone()))?;
    let found = Parts::new(graph, &verdict);
    let components = parts.each_ref().map(|part| home(&found, &verdict, part));
    let mut merge = of_models(models);
    merge.by = "tracks";
    merge.determined |= components[0].is_some() && components[0] == components[1];
    merge.suggestions = Some(Vec::new());
    if merge.determined {
        merge.freedom = Some(0);
        merge.free = free(0);
        return Ok((merge, verdict));
    }
    let task = Task::new(input, &verdict, seed, watch.clone());
    let (named, joints) = task.joints(&mut Shapes::default())?;
    let between = components.map(|component| component.map(number));
    let joint = named.joints.iter().find(|joint| {
        let [one, other] = joint.between.map(Some);
        between == [one, other] || between == [other, one]
    });
    let is_connected = are_connected(input, &parts, cameras);
    merge.freedom = match joint {
        Some(joint) => Some(joint.freedom),
        None if !merge.shared_images.is_empty() => merge.freedom,
        None if is_connected => None,
        None if merge.scaled == [true, true] => Some(RIGID),
        None => Some(SIMILARITY),
    };
    merge.free = match merge.freedom {
        Some(_) if let Some(joint) = joint => joint.meaning.clone(),
        Some(freedom) => free(freedom),
        None => format!(
            "{TRANSLATION_AND_SCALE} degrees of freedom at most: relative scale and translation; other \
             parts of the tracks may lie between"
        ),
    };
    let [Some(one), Some(other)] = between else {
        return Ok((merge, verdict));
    };
    let suggestions = task.suggest(&joints, LOOKED_FOR, None)?;
    let joins = |found: &Suggestion| [one, other].iter().all(|part| found.joins.contains(part));
    let suggestions = suggestions.into_iter().filter(joins).take(KEPT);
    merge.suggestions = Some(suggestions.collect());
    Ok((merge, verdict))
}

/// The cameras of both models in a camera-point graph, increasing.
fn cameras_of(models: [&Model; 2], input: &NamedGraph) -> Result<[Vec<u32>; 2]> {
    let names = Names::new(input);
    let all = names.images();
    let all = all.flat_map(|v| names.all_of(v).map(move |name| (name, v)));
    let nodes: BTreeMap<String, u32> = all.collect();
    let parts = models.map(|model| -> Result<Vec<u32>> {
        let node = |image: &viewcert_formats::model::Image| {
            nodes.get(&*image.name).copied().with_context(|| {
                let name = &image.name;
                format!(
                    "image {name} of the model is not in {}; name its database",
                    input.name
                )
            })
        };
        let mut part: Vec<u32> = model.images.iter().map(node).collect::<Result<_>>()?;
        part.sort_unstable();
        part.dedup();
        ensure!(
            part.len() > 1,
            "a model has fewer than two images at different places: there is nothing to join"
        );
        Ok(part)
    });
    let [one, other] = parts;
    Ok([one?, other?])
}

/// The component that holds all of a known part; none if no track that counts is at it.
fn home(parts: &Parts, verdict: &Verdict, part: &[u32]) -> Option<usize> {
    let mut all = 0..verdict.components.len();
    all.find(|&component| {
        let nodes = parts.nodes_of(component);
        part.iter().all(|v| nodes.binary_search(v).is_ok())
    })
}

/// Whether verified pairs, frames, or images of both, lead from the one model to the other, so that
/// the rotation between them is known.
fn are_connected(input: &NamedGraph, parts: &[Vec<u32>; 2], cameras: u32) -> bool {
    let mut sets = UnionFind::new(cameras as usize);
    let known = input.matching.iter().flat_map(|matching| &matching.others);
    for pair in known.filter(|pair| pair.used) {
        sets.union(pair.images.0 as usize, pair.images.1 as usize);
    }
    for part in parts {
        part.windows(2).for_each(|two| {
            sets.union(two[0] as usize, two[1] as usize);
        });
    }
    for frame in input.frames.iter().flat_map(|frames| &frames.groups) {
        frame.windows(2).for_each(|two| {
            sets.union(two[0] as usize, two[1] as usize);
        });
    }
    sets.find(parts[0][0] as usize) == sets.find(parts[1][0] as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_the_same_by_others() {
        assert_eq!(classes([].into_iter()), 0);
        // 1 = 10 = 2 = 20; 3 = 30.
        let same = [(1, 10), (2, 10), (2, 20), (3, 30), (3, 30)];
        assert_eq!(classes(same.into_iter()), 2);
    }

    #[test]
    fn what_is_free_has_words() {
        assert_eq!(free(0), "nothing");
        assert_eq!(free(1), "relative scale");
        assert!(free(7).contains("rotation"));
    }
}
