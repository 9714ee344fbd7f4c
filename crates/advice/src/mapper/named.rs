//! What mappers will probably do, in the user's names: the member `mappers` of
//! `verify overview --json`.

use super::global::global;
use super::incremental::{Incremental, Stop, incremental};
use super::{Geometry, Scene, Start, Thresholds};
use crate::frames::Images;
use crate::named::Names;
use anyhow::Result;
use serde::Serialize;
use viewcert::Verdict;
use viewcert_formats::NamedGraph;

/// What COLMAP's mappers will probably do: a simulation, and no proof.
#[derive(Clone, Debug, Serialize)]
pub struct Foreseen {
    /// Always true: says so in JSON.
    pub simulated: bool,
    /// The one model of global mapping.
    pub global: Global,
    /// The models of incremental mapping.
    pub incremental: Models,
}

/// The one model of global mapping.
#[derive(Clone, Debug, Serialize)]
pub struct Global {
    /// Its images.
    pub images: Vec<String>,
    /// How many images the database has.
    pub of: usize,
    /// In how many frames these are, if any frame has several images.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<usize>,
    /// What of them the tracks determine against each other: the parts of two images and more.
    pub parts: Vec<Vec<String>>,
}

/// The models of incremental mapping.
#[derive(Clone, Debug, Serialize)]
pub struct Models {
    /// The models, in the order in which they are made.
    pub models: Vec<Model>,
    /// Images in no model, those first that come nearest to one.
    pub outside: Vec<Sees>,
    /// The pairs that were looked at to begin with.
    pub starts: Vec<Beginning>,
    /// With how many images a model is kept by default, unless it is the first.
    pub kept_from: usize,
    /// Whether COLMAP refuses to make any: it has to know the poses of all sensors in their rigs.
    pub refused: bool,
    /// The thresholds, by COLMAP's names.
    pub thresholds: Thresholds,
}

/// A model of incremental mapping.
#[derive(Clone, Debug, Serialize)]
pub struct Model {
    /// Its images.
    pub images: Vec<String>,
    /// In how many frames these are, if any frame has several images.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<usize>,
    /// The pair that it begins with.
    pub start: [String; 2],
    /// The image that comes nearest to being added.
    pub stop: Option<Sees>,
    /// Whether it is kept where COLMAP's options are not changed.
    pub kept: bool,
}

/// How many points of a model an image sees.
#[derive(Clone, Debug, Serialize)]
pub struct Sees {
    /// The image.
    pub image: String,
    /// How many points.
    pub sees: u32,
    /// How many it needs.
    pub needs: u32,
}

/// A pair that was looked at to begin with.
#[derive(Clone, Debug, Serialize)]
pub struct Beginning {
    /// The two images.
    pub images: [String; 2],
    /// Verified matches.
    pub inliers: u32,
    /// Points that count and that both see.
    pub points: usize,
    /// The configuration of the database, if it was read.
    pub config: Option<i64>,
    /// The median angle between rays in degrees, if a relative pose is known.
    pub angle: Option<f64>,
    /// The part of the motion that is forward, if a relative pose is known.
    pub forward: Option<f64>,
    /// What disqualified it, as thresholds stood last: `configuration`, `forward motion`, `angle`, `one
    /// frame` or `points`.
    pub unfit: Option<&'static str>,
}

/// Simulates both mappers on the tracks of a database that `verdict` is about; nothing for tracks
/// that are not from a database. `each` are the tracks with a camera for every image: these themselves,
/// unless images of a frame are one camera.
///
/// # Errors
/// Those of the geometry.
pub fn foresee(
    each: &NamedGraph,
    (tracks, verdict): (&NamedGraph, &Verdict),
    geometry: &mut dyn Geometry,
) -> Result<Option<Foreseen>> {
    let (Some(count), Some(facts), Some(matching)) = (each.cameras, &each.database, &each.matching)
    else {
        return Ok(None);
    };
    let enough = matching.others.iter();
    let enough = enough.filter(|pair| pair.inliers >= facts.min_inliers);
    let pairs: Vec<((u32, u32), u32)> = enough.map(|pair| (pair.images, pair.inliers)).collect();
    let known = Images::new(each, tracks);
    let scene = Scene {
        tracks: &each.graph,
        images: count as usize,
        pairs: &pairs,
        frames: &known.frames,
    };
    let thresholds = Thresholds::default();
    let names = Names::new(each);
    let all = |images: &[u32]| images.iter().map(|&image| names.of(image)).collect();
    let one_model = global(scene);
    let parts = verdict.components.iter().map(|part| {
        let cameras = part.nodes();
        let is_in = |image: &u32| cameras.binary_search(&known.camera_of(*image)).is_ok();
        one_model.iter().copied().filter(is_in).collect()
    });
    let mut parts: Vec<Vec<u32>> = parts.filter(|images: &Vec<u32>| images.len() > 1).collect();
    parts.sort_by_key(|images| std::cmp::Reverse(images.len()));
    let frames = |images: &[u32]| (!known.frames.is_empty()).then(|| known.count(images));
    let refused = tracks
        .frames
        .as_ref()
        .is_some_and(|frames| frames.unknown > 0);
    let found = match refused {
        true => Incremental::default(),
        false => incremental(scene, geometry, thresholds)?,
    };
    Ok(Some(Foreseen {
        simulated: true,
        global: Global {
            frames: frames(&one_model),
            images: all(&one_model),
            of: count as usize,
            parts: parts.iter().map(|images| all(images)).collect(),
        },
        incremental: Models {
            refused,
            ..models(&found, &names, frames, thresholds)
        },
    }))
}

fn models(
    found: &Incremental,
    names: &Names,
    frames: impl Fn(&[u32]) -> Option<usize>,
    thresholds: Thresholds,
) -> Models {
    let sees = |stop: &Stop| Sees {
        image: names.of(stop.image),
        sees: stop.sees,
        needs: thresholds.abs_pose_min_num_inliers,
    };
    let model = |model: &super::SimulatedModel| Model {
        images: model.images.iter().map(|&image| names.of(image)).collect(),
        frames: frames(&model.images),
        start: names.pair(model.start),
        stop: model.stop.as_ref().map(sees),
        kept: model.kept,
    };
    let beginning = |start: &Start| Beginning {
        images: names.pair(start.images),
        inliers: start.inliers,
        points: start.points,
        config: start.estimate.map(|estimate| estimate.config),
        angle: start.estimate.and_then(|estimate| estimate.angle),
        forward: start.estimate.and_then(|estimate| estimate.forward),
        unfit: start.unfit.map(super::Unfit::name),
    };
    let mut outside = found.outside.clone();
    outside.sort_by_key(|stop| (std::cmp::Reverse(stop.sees), stop.image));
    Models {
        models: found.models.iter().map(model).collect(),
        outside: outside.iter().map(sees).collect(),
        starts: found.starts.iter().map(beginning).collect(),
        kept_from: found.kept_from,
        refused: false,
        thresholds,
    }
}
