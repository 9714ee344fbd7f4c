//! Two models, and whether what they share fixes the one against the other.
//!
//! In: two models of COLMAP, each right in itself, and perhaps the camera-point graph of their
//! database. Out: what they share, and what is left free between them. Two models
//! differ by a similarity: 3 degrees of freedom of rotation, and in the terms of docs/theory.md,
//! section 12, 3 of translation and 1 of scale. An image in both fixes the rotation, and so does a
//! verified pair from the one to the other; then each model is a body, and its images and points
//! are nodes. Two bodies with two common nodes are one (Theorem 4.1, rule 2), with one the scale is
//! free. Images of a frame that were taken at one place are one camera; a model with a known base line
//! is a scaled body, and two of these that share a node are one (13.16). With a database, three points of
//! both that are not on a line fix everything; else the graph of its tracks is decided with both models as known
//! parts (Theorem 4.14), and the answer supposes rotations of pairs. Numbers of the models say which
//! images are at one place, and how well what is shared fits ([`misfit`](crate::misfit)): two models that
//! contradict each other cannot both be right. Nothing is written.

use crate::condensation::{chain, with};
use crate::misfit::{Common, Misfit, View, dot, first_at_place, minus};
use crate::named::Names;
use anyhow::{Context, Error, Result, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use viewcert::KnownParts;
use viewcert::decide::{Known, Options, Question, decide};
use viewcert::geometry::model::Model as Geometry;
use viewcert::graph::UnionFind;
use viewcert::watch::Watch;
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::model::{Image, Model};
use viewcert_formats::{NamedGraph, with_rigs};

/// Degrees of freedom of a similarity, of translation and scale, and of scale.
const SIMILARITY: usize = 7;
const RIGID: usize = SIMILARITY - SCALE;
const SCALE: usize = 1;

/// The least sine of an angle between two lines that are taken for two.
const OFF_LINE: f64 = 1e-3;

/// How many images COLMAP's `model_merger` has to find in both models
/// (`AlignReconstructionsViaReprojections`).
pub const MERGER: usize = 3;

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
    /// How many points of both are seen by one feature of an image of both; null if the features
    /// of these images are not the same.
    pub shared_points: Option<usize>,
    /// How well both fit by what they share; null if they share too little to contradict each other.
    pub misfit: Option<Misfit>,
    /// How many of the 7 degrees of freedom are left; null where tracks fix some of them.
    pub freedom: Option<usize>,
    /// What it rests on.
    pub by: By,
    /// What COLMAP's `model_merger` does with both.
    #[serde(skip)]
    pub merger: Merger,
}

impl Merge {
    /// Whether the two can be made one: everything is determined, and nothing contradicts it.
    pub fn is_good(&self) -> bool {
        self.is_determined() && self.agree()
    }

    /// Whether something fixes the one against the other: rotation, translation and scale.
    pub fn is_determined(&self) -> bool {
        self.freedom == Some(0)
    }

    /// What is free, in words.
    pub fn free(&self) -> &'static str {
        free(self.freedom)
    }

    /// Whether nothing that was compared contradicts something else.
    pub fn agree(&self) -> bool {
        self.misfit.as_ref().is_none_or(|misfit| misfit.agree)
    }
}

/// What an answer about two models rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum By {
    /// Images, and points that one feature sees in both models.
    Models,
    /// Three points of both by tracks that do not lie on a line where they are: what keeps them keeps the whole model,
    /// its rotation too.
    Points,
    /// The graph of tracks: rotations are known from pairs, and places are in general position.
    Tracks,
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
    /// It aborts: an image has another number or other features in the other model.
    Other(String),
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
        let both: BTreeMap<&str, [usize; 2]> = both.collect();
        let features = |model: &Model, k: usize| model.images[k].points.len();
        let same_features = |&[a, b]: &[usize; 2]| features(one, a) == features(other, b);
        Ok(Self {
            models: [one, other],
            views: [views(models[0])?, views(models[1])?],
            places: [points(models[0])?, points(models[1])?],
            same_features: both.values().all(same_features),
            both,
        })
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
                let features = known.features.map_or(count, |features| features as usize);
                ensure!(
                    count == 0 || features == count,
                    "image {} has {count} features in a model and {features} in the database: the model is of \
                     another database; name its own",
                    image.name
                );
                let seen = image.points.iter().zip(&known.tracks);
                for (point, track) in seen.filter_map(|(point, track)| (*point).zip(*track)) {
                    of_tracks.entry(track).or_default().insert(point);
                }
            }
        }
        let [one, other] = of_tracks;
        let mut pairs = Vec::new();
        for (track, points) in &one {
            for &b in other.get(track).into_iter().flatten() {
                pairs.extend(points.iter().map(|&a| (a, b)));
            }
        }
        Ok(pairs)
    }

    /// Whether three points of both do not lie on a line, in either model. The similarity from the one model to the other
    /// is unique then. Rounding moves the sine of an angle by less than a billionth of [`OFF_LINE`].
    fn span_a_plane(&self, same: &[(u64, u64)]) -> bool {
        // A point in two tracks, or a track with two points of one model, says that one of them is wrong.
        let mut counts: [HashMap<u64, usize>; 2] = Default::default();
        for &(a, b) in same {
            *counts[0].entry(a).or_default() += 1;
            *counts[1].entry(b).or_default() += 1;
        }
        let is_only = |(a, b): &&(u64, u64)| counts[0][a] == 1 && counts[1][b] == 1;
        let only = same.iter().filter(is_only);
        let placed: Vec<[[f64; 3]; 2]> = only.filter_map(|pair| self.placed(pair)).collect();
        let from = |side: usize, k: usize| {
            let [origin, point] = [0, k].map(|k| placed[k][side]);
            minus(point, origin)
        };
        // The farthest point from the first, and one that is off the line through both.
        let farthest = (0..placed.len()).max_by(|&j, &k| {
            let [j, k] = [j, k].map(|k| dot(from(0, k), from(0, k)));
            j.total_cmp(&k)
        });
        farthest.is_some_and(|far| {
            (0..placed.len()).any(|k| {
                [0, 1].into_iter().all(|side| {
                    let [u, v] = [far, k].map(|k| from(side, k));
                    let both = dot(u, u) * dot(v, v);
                    both > 0.0 && dot(u, v).powi(2) < (1.0 - OFF_LINE * OFF_LINE) * both
                })
            })
        })
    }

    /// Where a point of both is in each.
    fn placed(&self, (a, b): &(u64, u64)) -> Option<[[f64; 3]; 2]> {
        Some([*self.places[0].get(a)?, *self.places[1].get(b)?])
    }

    /// What both share, as it is measured.
    fn common(&self, same: &BTreeSet<(u64, u64)>, at_one_place: bool) -> Common<'a> {
        let view = |(name, &[a, b]): (&&'a str, &[usize; 2])| {
            (*name, [self.views[0][a], self.views[1][b]])
        };
        Common {
            images: self.both.iter().map(view).collect(),
            points: same.iter().filter_map(|pair| self.placed(pair)).collect(),
            at_one_place,
        }
    }

    /// What COLMAP's own command does.
    fn merger(&self, at_one_place: bool) -> Merger {
        let names = self.models[1].images.iter();
        let names: HashMap<u32, &Box<str>> = names.map(|image| (image.id, &image.name)).collect();
        let is_seen = |[a, b]: &[&Image; 2]| {
            let mut both = a.points.iter().zip(&b.points);
            both.any(|(a, b)| a.is_some() && b.is_some())
        };
        let useful = self.images().filter(|(_, both)| is_seen(both)).count();
        let is_other = |[a, b]: [&Image; 2]| a.id != b.id || a.points.len() != b.points.len();
        let mut enough = self.images().filter(|_| self.both.len() >= MERGER);
        let other = enough.find(|(_, both)| is_other(*both));
        let is_renamed = |name: &str, id| names.get(id).is_some_and(|other| ***other != *name);
        let mut all = self.models[0].images.iter();
        let renamed = all.find(|image| is_renamed(&image.name, &image.id));
        match (other, renamed) {
            (Some((name, _)), _) => Merger::Other(name.to_owned()),
            _ if useful < MERGER => Merger::TooFew(useful),
            (_, Some(image)) => Merger::Other(image.name.to_string()),
            _ if at_one_place => Merger::OnePlace,
            _ => Merger::Works,
        }
    }

    /// At how many places the images of both were taken, by the numbers of both models.
    fn places(&self) -> usize {
        let first = [0, 1].map(|side| {
            let points: Vec<[f64; 3]> = self.places[side].values().copied().collect();
            first_at_place(&self.views[side], &points)
        });
        let place = |both: &[usize; 2]| [0, 1].map(|side| first[side][both[side]]);
        BTreeSet::from_iter(self.both.values().map(place)).len()
    }

    /// What two models tell, with further points that are the same.
    pub fn merge(&self, further: &[(u64, u64)]) -> Merge {
        let models = self.models;
        let places = self.places();
        let shared_points = self.same_features.then(|| {
            let points = self.seen_in_both().map(|(one, _)| one);
            points.collect::<BTreeSet<u64>>().len()
        });
        let is_scaled = |model: &Model| !model.known_frames().groups.is_empty();
        let of_scale = match models.iter().all(|model| is_scaled(model)) {
            true => 0,
            false => SCALE,
        };
        let freedom = match (places, shared_points.unwrap_or(0)) {
            (0, _) => RIGID + of_scale,
            (1, 0) => of_scale,
            _ => 0,
        };
        let is_one_place = self.both.len() > 1 && places == 1;
        let same = self.seen_in_both().chain(further.iter().copied()).collect();
        Merge {
            images: models.map(|model| model.images.len()),
            shared_places: places,
            points: models.map(|model| model.points.len()),
            shared_images: self.both.keys().map(|&name| name.to_owned()).collect(),
            shared_points,
            misfit: self.common(&same, is_one_place).misfit(),
            freedom: Some(freedom),
            by: By::Models,
            merger: self.merger(is_one_place),
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

/// What two models and the tracks of their database tell: `input` is the camera-point graph, whose
/// cameras have the names of images. Where rigs have known base lines, which known parts are not
/// decided with, it gets the pairs of a chain of triangles on the cameras of each model, which holds
/// them together as well (4.4). A decision, unless the models alone determine everything.
///
/// # Errors
/// An image of a model that the database does not have; those of decisions; work that was stopped.
pub fn of_tracks(
    two: &Two,
    input: &mut NamedGraph,
    tracks: &FeatureTracks,
    seed: u64,
    watch: &Watch,
) -> Result<Merge> {
    let mut parts = cameras_of(two.models, input)?;
    let same = two.in_one_track(tracks)?;
    let mut merge = two.merge(&same);
    if merge.is_determined() {
        return Ok(merge);
    }
    if two.span_a_plane(&same) {
        (merge.by, merge.freedom) = (By::Points, Some(0));
        return Ok(merge);
    }
    if merge.shared_images.len() > 1 && merge.shared_places == 1 {
        // Several cameras at one place are one place, and would be several.
        let [one, other] = &mut parts;
        let mut shared = 0;
        other.retain(|v| {
            let is_shared = one.binary_search(v).is_ok();
            shared += usize::from(is_shared);
            !is_shared || shared == 1
        });
    }
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
    let options = Options::default().question(question).seed(seed);
    let verdict = decide(&input.graph, &options.watch(watch.clone()))?;
    merge.by = By::Tracks;
    let are_one = verdict.components.iter().any(|component| {
        let nodes = component.nodes();
        let mut all = parts.iter().flatten();
        all.all(|v| nodes.binary_search(v).is_ok())
    });
    if are_one {
        merge.freedom = Some(0);
    } else if merge.shared_images.is_empty() && are_connected(input, &parts) {
        merge.freedom = None;
    }
    Ok(merge)
}

/// The cameras of both models in a camera-point graph, increasing.
fn cameras_of(models: [&Model; 2], input: &NamedGraph) -> Result<[Vec<u32>; 2]> {
    let names = Names::new(input);
    let all = names.images();
    let all = all.flat_map(|v| names.all_of(v).map(move |name| (name, v)));
    let nodes: BTreeMap<String, u32> = all.collect();
    let parts = models.map(|model| -> Result<Vec<u32>> {
        let node = |image: &Image| {
            let (name, of) = (&image.name, &input.name);
            let missing = || format!("image {name} of the model is not in {of}; name its database");
            nodes.get(&**name).copied().with_context(missing)
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

/// Whether verified pairs, frames, or images of both, lead from the one model to the other, so that
/// the rotation between them is known.
fn are_connected(input: &NamedGraph, parts: &[Vec<u32>; 2]) -> bool {
    let mut sets = UnionFind::new(input.graph.nodes());
    let known = input.matching.iter().flat_map(|matching| &matching.others);
    for pair in known.filter(|pair| pair.used) {
        sets.union(pair.images.0 as usize, pair.images.1 as usize);
    }
    let frames = input.frames.iter().flat_map(|frames| &frames.groups);
    for group in frames.chain(parts) {
        group.windows(2).for_each(|two| {
            sets.union(two[0] as usize, two[1] as usize);
        });
    }
    sets.find(parts[0][0] as usize) == sets.find(parts[1][0] as usize)
}

/// Degrees of freedom in words.
fn free(freedom: Option<usize>) -> &'static str {
    match freedom {
        Some(0) => "nothing",
        Some(SCALE) => "relative scale",
        Some(RIGID) => "rotation and translation",
        Some(_) => "everything: rotation, translation and relative scale",
        None => "translation and scale, or a part of them",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_free_has_words() {
        assert_eq!(free(Some(0)), "nothing");
        assert_eq!(free(Some(1)), "relative scale");
        assert!(free(Some(6)).starts_with("rotation and translation"));
        assert!(free(Some(7)).contains("rotation"));
        assert!(free(None).contains("scale"));
    }
}
