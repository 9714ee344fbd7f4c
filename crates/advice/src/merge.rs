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
//! its tracks is decided with both models as known parts (Theorem 4.14). Numbers of the models say which
//! images are at one place, and how well what is shared fits ([`misfit`](crate::misfit)): two models that
//! contradict each other cannot both be right. Nothing is written.

use crate::Shapes;
use crate::condensation::{chain, with};
use crate::misfit::{Common, Misfit, View, first_at_place};
use crate::named::{Names, Suggestion};
use crate::parts::Parts;
use crate::task::{Task, number};
use crate::words::{self, Scales};
use anyhow::{Context, Error, Result, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use viewcert::decide::{Known, Options, Question, decide};
use viewcert::geometry::model::Model as Geometry;
use viewcert::graph::UnionFind;
use viewcert::watch::Watch;
use viewcert::{KnownParts, Verdict};
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::model::{Image, Model};
use viewcert_formats::{NamedGraph, with_rigs};

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
    /// How well both fit by what they share; null if they share too little to contradict each other.
    pub misfit: Option<Misfit>,
    /// Whether something fixes the one against the other: rotation, translation and scale.
    pub determined: bool,
    /// How many of the 7 degrees of freedom are left; null where third parts may fix some of them.
    pub freedom: Option<usize>,
    /// These in words.
    pub free: String,
    /// What it rests on: `models` or `tracks`.
    pub by: &'static str,
    /// Whether COLMAP's `model_merger` can work on both.
    pub model_merger: bool,
    /// What it does.
    #[serde(skip)]
    pub merger: Merger,
    /// With a database, images to match that would join the two; empty if none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suggestions: Option<Vec<Suggestion>>,
}

impl Merge {
    /// Whether the two can be made one: everything is determined, and nothing contradicts it.
    pub fn is_good(&self) -> bool {
        self.determined && self.agree()
    }

    /// Whether nothing that was compared contradicts something else.
    pub fn agree(&self) -> bool {
        self.misfit.as_ref().is_none_or(|misfit| misfit.agree)
    }
}

/// What COLMAP's `model_merger` does with two models, whose images it takes for the same by name and
/// then by number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Merger {
    /// It merges them.
    Works,
    /// It refuses: too few images with points of both.
    TooFew(usize),
    /// It would make up the scale, as all images of both are at one place.
    OnePlace,
    /// It aborts: an image has these numbers.
    OtherNumbers(String, [u32; 2]),
    /// It aborts: an image has so many features.
    OtherFeatures(String, [usize; 2]),
    /// It refuses: a number is that of these images.
    OtherNames(u32, [String; 2]),
}

/// Two models, and what they share.
pub struct Two<'a> {
    models: [&'a Model; 2],
    /// The poses of their images.
    views: [Vec<View>; 2],
    /// The places of their points, by number.
    places: [BTreeMap<u64, [f64; 3]>; 2],
    /// The images of both by name: their places in both lists.
    both: BTreeMap<&'a str, [usize; 2]>,
    /// Whether an image of both has as many features in both.
    same_features: bool,
}

impl<'a> Two<'a> {
    /// Compares the images of two models. O(n log n) for n features.
    ///
    /// # Errors
    /// The first image or point of which the numbers are none.
    pub fn new(models: [(&Path, &'a Model); 2]) -> Result<Self> {
        let [one, other] = models.map(|(_, model)| model);
        let places: HashMap<&str, usize> = (0..)
            .zip(&other.images)
            .map(|(k, image)| (&*image.name, k))
            .collect();
        let both = (0..).zip(&one.images).filter_map(|(k, image)| {
            let name = &*image.name;
            Some((name, [k, *places.get(name)?]))
        });
        let mut two = Self {
            models: [one, other],
            views: [views(models[0])?, views(models[1])?],
            places: [points(models[0])?, points(models[1])?],
            both: both.collect(),
            same_features: true,
        };
        let same = |(_, [a, b]): (&str, [&Image; 2])| a.points.len() == b.points.len();
        let same_features = two.images().all(same);
        two.same_features = same_features;
        Ok(two)
    }

    /// The images of both.
    fn images(&self) -> impl Iterator<Item = (&'a str, [&'a Image; 2])> {
        let [one, other] = self.models;
        let both = self.both.iter();
        both.map(|(name, &[a, b])| (*name, [&one.images[a], &other.images[b]]))
    }

    /// Points of both that one feature of an image of both sees.
    fn seen_in_both(&self) -> impl Iterator<Item = (u64, u64)> {
        let images = self.images().filter(|_| self.same_features);
        images.flat_map(|(_, [a, b])| {
            let features = a.points.iter().zip(&b.points);
            features.filter_map(|(&a, &b)| Some((a?, b?)))
        })
    }

    /// Points of both by the tracks of their database.
    ///
    /// # Errors
    /// An image with other features than the database has.
    fn in_one_track(&self, tracks: &FeatureTracks) -> Result<Vec<(u64, u64)>> {
        let mut of_tracks: [BTreeMap<u32, BTreeSet<u64>>; 2] = Default::default();
        for (model, of_tracks) in self.models.iter().zip(&mut of_tracks) {
            for image in &model.images {
                let Some(known) = tracks.get(&image.name) else {
                    continue;
                };
                let count = image.points.len();
                let features = known
                    .features
                    .filter(|&features| features as usize != count);
                if let Some(features) = features.filter(|_| count > 0) {
                    return Err(Error::msg(format!(
                        "image {} has {count} features in a model and {features} in the database: the model is \
                         of another database; name its own",
                        image.name
                    )));
                }
                let seen = image.points.iter().zip(&known.tracks);
                for (point, track) in seen.filter_map(|(point, track)| (*point).zip(*track)) {
                    of_tracks.entry(track).or_default().insert(point);
                }
            }
        }
        let [one, other] = of_tracks;
        let both = one
            .iter()
            .filter_map(|(track, points)| Some((points, other.get(track)?)));
        let pairs = both.flat_map(|(one, other)| {
            let pairs = one.iter().flat_map(|&a| other.iter().map(move |&b| (a, b)));
            pairs.collect::<Vec<_>>()
        });
        Ok(pairs.collect())
    }

    /// What both share, as it is measured: of points those that are one of each model.
    fn common(&self, same: impl Iterator<Item = (u64, u64)>, at_one_place: bool) -> Common<'a> {
        let same: BTreeSet<(u64, u64)> = same.collect();
        let (mut of_one, mut of_other) = (HashMap::new(), HashMap::new());
        for (a, b) in &same {
            *of_one.entry(a).or_insert(0) += 1;
            *of_other.entry(b).or_insert(0) += 1;
        }
        let single = same
            .iter()
            .filter(|(a, b)| of_one[a] == 1 && of_other[b] == 1);
        let [one, other] = &self.places;
        let images = self.both.iter();
        Common {
            images: images
                .map(|(name, &[a, b])| (*name, [self.views[0][a], self.views[1][b]]))
                .collect(),
            points: single
                .filter_map(|(a, b)| Some([*one.get(a)?, *other.get(b)?]))
                .collect(),
            at_one_place,
        }
    }

    /// What COLMAP's own command does.
    fn merger(&self, at_one_place: bool) -> Merger {
        let [one, other] = self.models;
        let names = other.images.iter().map(|image| (image.id, &image.name));
        let names: HashMap<u32, &Box<str>> = names.collect();
        let seen = |[a, b]: &[&Image; 2]| {
            a.points
                .iter()
                .zip(&b.points)
                .any(|(a, b)| a.is_some() && b.is_some())
        };
        let useful = self.images().filter(|(_, both)| seen(both)).count();
        let all = || {
            self.images().take(if self.both.len() < MERGER {
                0
            } else {
                usize::MAX
            })
        };
        let number = all().find(|(_, [a, b])| a.id != b.id);
        let features = all().find(|(_, [a, b])| a.points.len() != b.points.len());
        let renamed = one.images.iter().find_map(|image| {
            let name = *names.get(&image.id)?;
            (*name != image.name).then(|| (image.id, [image.name.to_string(), name.to_string()]))
        });
        match (number, features, renamed) {
            (Some((name, both)), ..) => {
                Merger::OtherNumbers(name.to_owned(), both.map(|image| image.id))
            }
            (_, Some((name, both)), _) => {
                Merger::OtherFeatures(name.to_owned(), both.map(|image| image.points.len()))
            }
            _ if useful < MERGER => Merger::TooFew(useful),
            (_, _, Some((number, names))) => Merger::OtherNames(number, names),
            _ if at_one_place => Merger::OnePlace,
            _ => Merger::Works,
        }
    }

    /// For every image of both, in the order of names, the first one at the same place: images of a frame
    /// may be at one, by either model, and others are where the numbers of both say so.
    fn places(&self) -> Vec<usize> {
        let names: Vec<&str> = self.both.keys().copied().collect();
        let at = |name: &str| names.binary_search(&name).ok();
        let mut sets = UnionFind::new(names.len());
        for model in self.models {
            for (&one, others) in &model.known_frames().together {
                let one = std::iter::once(&model.images[one as usize].name);
                let here: Vec<usize> = one.chain(others).filter_map(|name| at(name)).collect();
                here.windows(2).for_each(|two| {
                    sets.union(two[0], two[1]);
                });
            }
        }
        let [one, other] = [0, 1].map(|side| {
            let points: Vec<[f64; 3]> = self.places[side].values().copied().collect();
            let first = first_at_place(&self.views[side], &points);
            let of_both = self.both.values();
            of_both
                .map(|both| first[both[side]])
                .collect::<Vec<usize>>()
        });
        let mut known = HashMap::new();
        for (k, place) in one.into_iter().zip(other).enumerate() {
            sets.union(*known.entry(place).or_insert(k), k);
        }
        (0..names.len()).map(|k| sets.find(k)).collect()
    }

    /// What two models alone tell.
    pub fn merge(&self) -> Merge {
        self.merge_with(std::iter::empty())
    }

    /// The same, with further points that are the same.
    fn merge_with(&self, further: impl Iterator<Item = (u64, u64)>) -> Merge {
        let models = self.models;
        let places = self.places().into_iter().collect::<BTreeSet<_>>().len();
        let shared_points = self.same_features.then(|| classes(self.seen_in_both()));
        let scaled = models.map(|model| !model.known_frames().groups.is_empty());
        let of_scale = if scaled == [true, true] { 0 } else { SCALE };
        let freedom = match (places, shared_points.unwrap_or(0)) {
            (0, _) => RIGID + of_scale,
            (1, 0) => of_scale,
            _ => 0,
        };
        let is_one_place = self.both.len() > 1 && places == 1;
        let merger = self.merger(is_one_place);
        Merge {
            images: models.map(|model| model.images.len()),
            shared_places: places,
            scaled,
            points: models.map(|model| model.points.len()),
            shared_images: self.both.keys().map(|&name| name.to_owned()).collect(),
            shared_points,
            misfit: self
                .common(self.seen_in_both().chain(further), is_one_place)
                .misfit(),
            determined: freedom == 0,
            freedom: Some(freedom),
            free: free(freedom),
            by: "models",
            model_merger: matches!(merger, Merger::Works | Merger::OnePlace),
            merger,
            suggestions: None,
        }
    }
}

/// The poses of a model.
fn views((path, model): (&Path, &Model)) -> Result<Vec<View>> {
    let poses = model.measured_poses().map_err(|why| refusal(path, &why))?;
    Ok(poses.into_iter().map(View::new).collect())
}

/// The places of its points, by number.
fn points((path, model): (&Path, &Model)) -> Result<BTreeMap<u64, [f64; 3]>> {
    let places = model.measured_points().map_err(|why| refusal(path, &why))?;
    let ids = model.points.iter().map(|point| point.id);
    Ok(ids.zip(places).collect())
}

fn refusal(path: &Path, why: &str) -> Error {
    let path = path.display();
    Error::msg(format!(
        "{path}/{why}; map again, or leave it out of the model"
    ))
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
    two: &Two,
    input: &mut NamedGraph,
    tracks: &FeatureTracks,
    seed: u64,
    watch: &Watch,
) -> Result<(Merge, Verdict)> {
    let mut parts = cameras_of(two.models, input)?;
    let mut merge = two.merge_with(two.in_one_track(tracks)?.into_iter());
    if merge.shared_images.len() > 1 && merge.shared_places == 1 && !merge.determined {
        // Several cameras at one place are one place, and would be several.
        let [one, other] = &mut parts;
        let mut shared = 0;
        other.retain(|v| {
            let is_shared = one.binary_search(v).is_ok();
            shared += usize::from(is_shared);
            !is_shared || shared == 1
        });
    }
    let parts = parts;
    let question = match with_rigs(Known::default(), input)? {
        Known::Parts(_) => {
            let known = KnownParts::new(input.graph.nodes() as u32, parts.clone())?;
            Question::with_parts(Geometry::Calibrated, known)
        }
        lines => {
            input.graph = with(&input.graph, parts.iter().flat_map(|part| chain(part)));
            Question::calibrated(lines)
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
    merge.by = "tracks";
    let is_connected = are_connected(input, &parts, cameras);
    let is_one = components[0].is_some() && components[0] == components[1];
    merge.determined |= is_one && is_connected;
    merge.suggestions = Some(Vec::new());
    if merge.determined {
        merge.freedom = Some(0);
        merge.free = free(0);
        return Ok((merge, verdict));
    }
    if is_one {
        // Tracks are decided with known rotations, and nothing says this one.
        merge.freedom = None;
        merge.free =
            "rotation: no verified pair and no image leads from the one to the other".to_owned();
        return Ok((merge, verdict));
    }
    let task = Task::new(input, &verdict, seed, watch.clone());
    let (named, joints) = task.joints(&mut Shapes::default())?;
    let between = components.map(|component| component.map(number));
    let joint = named.joints.iter().find(|joint| {
        let [one, other] = joint.between.map(Some);
        between == [one, other] || between == [other, one]
    });
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
