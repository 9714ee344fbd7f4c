//! Two models, and whether what they share fixes the one against the other.
//!
//! In: two models of COLMAP, each right in itself, and perhaps the tracks of their database. Out: what they share, and
//! what is left free between them. Two models differ by a similarity: 3 degrees of freedom of rotation, 3 of
//! translation and 1 of scale, which base lines say that both know. An image in both fixes rotation and translation,
//! one thing more at another place the scale; points alone fix everything if three of them are not on a line. Numbers
//! of the models say what is at one place, and how well what is shared fits ([`misfit`](crate::misfit)): two models
//! that contradict each other cannot both be right. Nothing is written.

use crate::misfit::{Common, Misfit, View, first_at_place};
use anyhow::{Context, Result, anyhow, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::model::Model;
use viewcert_formats::vectors::{Vector, dot, minus};

/// The least sine of an angle between two lines that are taken for two.
const OFF_LINE: f64 = 1e-3;

/// What two models share, and what follows.
#[derive(Clone, Debug, Serialize)]
pub struct Merge {
    /// The images of both.
    pub shared_images: Vec<String>,
    /// At how many places these were taken: images of a frame may be at one.
    pub shared_places: usize,
    /// How many points of both are seen by one feature of an image of both, or have one track in the database.
    pub shared_points: usize,
    /// How well both fit by what they share; null if they share too little to contradict each other.
    pub misfit: Option<Misfit>,
    /// How many of the 7 degrees of freedom are left.
    pub freedom: usize,
}

impl Merge {
    /// Whether the two can be made one: everything is determined, and nothing contradicts it.
    pub fn is_good(&self) -> bool {
        self.is_determined() && self.agree()
    }

    /// Whether something fixes the one against the other: rotation, translation and scale.
    pub fn is_determined(&self) -> bool {
        self.freedom == 0
    }

    /// Whether nothing that was compared contradicts something else.
    pub fn agree(&self) -> bool {
        self.misfit.as_ref().is_none_or(|misfit| misfit.agree)
    }

    /// What is free, in words.
    pub fn free(&self) -> &'static str {
        match (self.freedom, self.shared_places) {
            (0, _) => "nothing",
            (1, 0) => "a turn about the line through the points of both",
            (1, _) => "relative scale",
            (3, _) => "rotation",
            (4, _) => "rotation and relative scale",
            (6, _) => "rotation and translation",
            _ => "everything: rotation, translation and relative scale",
        }
    }
}

/// One of two models: its images' poses, and its points' places by number.
struct Half<'a> {
    model: &'a Model,
    views: Vec<View>,
    places: BTreeMap<u64, Vector>,
}

impl<'a> Half<'a> {
    fn new((path, model): (&Path, &'a Model)) -> Result<Self> {
        let path = path.display();
        let refusal = |why| anyhow!("{path}/{why}; map again, or leave it out of the model");
        let poses = model.measured_poses().map_err(refusal)?;
        let places = model.measured_points().map_err(refusal)?;
        let ids = model.points.iter().map(|point| point.id);
        Ok(Self {
            model,
            views: poses.into_iter().map(View::new).collect(),
            places: ids.zip(places).collect(),
        })
    }
}

/// Two models, and the images of both by name, as places in the lists of both.
pub struct Two<'a> {
    halves: [Half<'a>; 2],
    both: BTreeMap<&'a str, [usize; 2]>,
}

impl<'a> Two<'a> {
    /// Compares the images of two models. O(n log n) for n images.
    ///
    /// # Errors
    /// The first image or point of which the numbers are none.
    pub fn new([one, other]: [(&Path, &'a Model); 2]) -> Result<Self> {
        let places = (0..).zip(&other.1.images);
        let places: HashMap<&str, usize> = places.map(|(k, image)| (&*image.name, k)).collect();
        let both = (0..).zip(&one.1.images).filter_map(|(k, image)| {
            let name = &*image.name;
            Some((name, [k, *places.get(name)?]))
        });
        Ok(Self {
            both: both.collect(),
            halves: [Half::new(one)?, Half::new(other)?],
        })
    }

    /// Points of both that one feature of an image of both sees; none if such an image has other features in the other
    /// model, which is then of another database.
    fn seen_in_both(&self) -> BTreeSet<(u64, u64)> {
        let images = self
            .both
            .values()
            .map(|both| [0, 1].map(|side| &self.halves[side].model.images[both[side]].points));
        let images: Vec<[&Vec<Option<u64>>; 2]> = images.collect();
        if images.iter().any(|[a, b]| a.len() != b.len()) {
            return BTreeSet::new();
        }
        let features = images.into_iter().flat_map(|[a, b]| a.iter().zip(b));
        features.filter_map(|(a, b)| (*a).zip(*b)).collect()
    }

    /// Points of both by the tracks of their database: those of a track with one point of each, and of no other track.
    ///
    /// # Errors
    /// An image that the database does not have, or with other features.
    fn in_one_track(&self, tracks: &FeatureTracks) -> Result<BTreeSet<(u64, u64)>> {
        let mut of_tracks: BTreeMap<u32, [BTreeSet<u64>; 2]> = BTreeMap::new();
        for (side, half) in self.halves.iter().enumerate() {
            for image in &half.model.images {
                let known = tracks.get(&image.name).with_context(|| {
                    let name = &image.name;
                    format!("image {name} of the model is not in the database; name its own")
                })?;
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
                    of_tracks.entry(track).or_default()[side].insert(point);
                }
            }
        }
        let pairs = of_tracks.values().flat_map(|[one, other]| {
            let pairs = one.iter().map(|&a| other.iter().map(move |&b| (a, b)));
            pairs.flatten()
        });
        // A point in two tracks, or a track with two points of one model, says that one of them is wrong.
        let mut counts: [HashMap<u64, usize>; 2] = Default::default();
        for (a, b) in pairs.clone() {
            *counts[0].entry(a).or_default() += 1;
            *counts[1].entry(b).or_default() += 1;
        }
        Ok(pairs
            .filter(|(a, b)| counts[0][a] == 1 && counts[1][b] == 1)
            .collect())
    }

    /// At how many places the images of both were taken, by the numbers of both models.
    fn shared_places(&self) -> usize {
        let first = self.halves.each_ref().map(|half| {
            let points: Vec<Vector> = half.places.values().copied().collect();
            first_at_place(&half.views, &points)
        });
        let place = |both: &[usize; 2]| [0, 1].map(|side| first[side][both[side]]);
        BTreeSet::from_iter(self.both.values().map(place)).len()
    }

    /// What two models share, also by the tracks of their database, and what that leaves free.
    ///
    /// # Errors
    /// A model that is not of this database.
    pub fn merge(&self, tracks: Option<&FeatureTracks>) -> Result<Merge> {
        let mut same = self.seen_in_both();
        if let Some(tracks) = tracks {
            same.extend(self.in_one_track(tracks)?);
        }
        let [one, other] = self.halves.each_ref().map(|half| &half.places);
        let placed = same
            .iter()
            .filter_map(|(a, b)| Some([*one.get(a)?, *other.get(b)?]));
        let placed: Vec<[Vector; 2]> = placed.collect();
        let is_scaled = |half: &Half| !half.model.known_frames().groups.is_empty();
        let scale = usize::from(!self.halves.iter().all(is_scaled));
        let span = |side: usize| span(placed.iter().map(|both| both[side]).collect());
        let shared_places = self.shared_places();
        let freedom = match (shared_places, placed.len()) {
            (0, 0) => 6 + scale,
            (0, _) => match span(0).min(span(1)) {
                0 => 3 + scale,
                1 => 1,
                _ => 0,
            },
            (1, 0) => scale,
            _ => 0,
        };
        let images = self
            .both
            .iter()
            .map(|(&name, both)| (name, [0, 1].map(|side| self.halves[side].views[both[side]])));
        let at_one_place = self.both.len() > 1 && shared_places == 1;
        Ok(Merge {
            shared_images: self.both.keys().map(|&name| name.to_owned()).collect(),
            shared_places,
            shared_points: placed.len(),
            misfit: Common::new(images, &placed, at_one_place).misfit(),
            freedom,
        })
    }
}

/// The dimension of what points lie in: a place, a line, or more. Rounding moves the sine of an angle by less than a
/// billionth of [`OFF_LINE`].
fn span(points: Vec<Vector>) -> usize {
    let arms = points.iter().map(|&point| minus(point, points[0]));
    let arms: Vec<Vector> = arms.collect();
    // The farthest point from the first, and one that is off the line through both.
    let square = |v: &Vector| dot(*v, *v);
    let longest = arms.iter().max_by(|u, v| square(u).total_cmp(&square(v)));
    let Some(&u) = longest.filter(|u| square(u) > 0.0) else {
        return 0;
    };
    let is_off = |v: &Vector| {
        let both = square(&u) * square(v);
        both > 0.0 && dot(u, *v).powi(2) < (1.0 - OFF_LINE * OFF_LINE) * both
    };
    1 + usize::from(arms.iter().any(is_off))
}
