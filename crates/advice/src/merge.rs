//! Two models, and whether what they share fixes the one against the other.
//!
//! In: two models of COLMAP, each right in itself, and perhaps the camera-point graph of their
//! database. Out: what they share, what is left free between them, and what to match. Two models
//! differ by a similarity: 3 degrees of freedom of rotation, and in the terms of docs/theory.md,
//! section 12, 3 of translation and 1 of scale. An image in both fixes the rotation, and so does a
//! verified pair from the one to the other; then each model is a body, and its images and points
//! are nodes. Two bodies with two common nodes are one (Theorem 4.1, rule 2), with one the scale is
//! free. With a database the graph of its tracks is decided with both models as known parts
//! (Theorem 4.14). No number of a model is used, only who sees what; nothing is written.

use crate::named::{Names, Suggestion};
use crate::parts::Parts;
use crate::task::{Task, number};
use crate::{Shapes, words};
use anyhow::{Context, Result, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use viewcert::decide::{Options, Question, decide};
use viewcert::geometry::model::Model as Geometry;
use viewcert::graph::UnionFind;
use viewcert::watch::Watch;
use viewcert::{KnownParts, Verdict};
use viewcert_formats::{Model, NamedGraph};

/// Degrees of freedom of a similarity, of translation and scale, and of scale.
const SIMILARITY: usize = 7;
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
    let same_features = both
        .iter()
        .all(|(_, first, second)| first.points.len() == second.points.len());
    let same = both.iter().flat_map(|(_, first, second)| {
        let features = first.points.iter().zip(&second.points);
        features.filter_map(|(&a, &b)| Some((a?, b?)))
    });
    let shared_points = same_features.then(|| classes(same));
    let freedom = match (both.len(), shared_points.unwrap_or(0)) {
        (0, _) => SIMILARITY,
        (1, 0) => SCALE,
        _ => 0,
    };
    Merge {
        images: models.map(|model| model.images.len()),
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
        _ => words::meaning(Geometry::Calibrated, freedom),
    }
}

/// What two models and the tracks of their database tell: `input` is the camera-point graph, whose
/// cameras have the names of images. A decision, and those of suggestions.
///
/// # Errors
/// An image of a model that the database does not have; those of decisions; work that was stopped.
pub fn of_tracks(
    models: [&Model; 2],
    input: &NamedGraph,
    seed: u64,
    watch: &Watch,
) -> Result<(Merge, Verdict)> {
    let names = Names::new(input);
    let cameras = names.images().end;
    let nodes: BTreeMap<String, u32> = names.images().map(|v| (names.of(v), v)).collect();
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
        ensure!(
            part.len() > 1,
            "a model has fewer than two images: there is nothing to join"
        );
        Ok(part)
    });
    let [one, other] = parts;
    let parts = [one?, other?];
    let graph = &input.graph;
    let known = KnownParts::new(graph.nodes() as u32, parts.clone())?;
    let question = Question::with_parts(Geometry::Calibrated, known);
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
        None => Some(SIMILARITY),
    };
    merge.free = match merge.freedom {
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

/// The component that holds all of a known part; none if no track that counts is at it.
fn home(parts: &Parts, verdict: &Verdict, part: &[u32]) -> Option<usize> {
    let mut all = 0..verdict.components.len();
    all.find(|&component| {
        let nodes = parts.nodes_of(component);
        part.iter().all(|v| nodes.binary_search(v).is_ok())
    })
}

/// Whether verified pairs, or images of both, lead from the one model to the other, so that the
/// rotation between them is known.
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
