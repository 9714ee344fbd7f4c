//! What mappers will probably do, in the user's names: the member `mappers` of
//! `verify overview --json`.

use super::global::global;
use super::incremental::{Incremental, Stop, incremental};
use super::{Features, Geometry, Scene, Start, Thresholds};
use crate::frames::Images;
use crate::named::Names;
use anyhow::Result;
use serde::Serialize;
use std::cmp::Reverse;
use viewcert_formats::NamedGraph;
use viewcert_formats::colmap::Groups;

/// The version of COLMAP whose mappers are simulated.
const COLMAP: &str = "4.2";

/// What COLMAP's mappers will probably do: a simulation, and no proof.
#[derive(Clone, Debug, Serialize)]
pub struct Foreseen {
    /// Always true: says so in JSON.
    pub simulated: bool,
    /// The version of COLMAP whose mappers these are.
    pub colmap: &'static str,
    /// The models of global mapping.
    pub global: Global,
    /// The models of incremental mapping.
    pub incremental: Models,
}

/// The models of global mapping, larger ones first.
#[derive(Clone, Debug, Serialize)]
pub struct Global {
    /// One model for each connected part of the pairs that global mapping takes.
    pub models: Vec<GlobalModel>,
    /// How many images the database has.
    pub of: usize,
}

/// A model of global mapping.
#[derive(Clone, Debug, Serialize)]
pub struct GlobalModel {
    /// Its images.
    pub images: Vec<String>,
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

/// What mappers take of a database.
pub struct Taken {
    /// The pairs of incremental mapping, with their inliers, increasing.
    pub incremental: Vec<((u32, u32), u32)>,
    /// The matches of these.
    pub features: Features,
    /// The frames of the images.
    pub frames: Images,
    /// Whether the place of a sensor in its rig is not known.
    pub refused: bool,
    /// The pairs of global mapping.
    pub global: Vec<((u32, u32), u32)>,
    /// Whether each image sees a point that counts of these.
    pub sees_point: Vec<bool>,
    /// The parts that these tracks determine, as images.
    pub parts: Vec<Vec<u32>>,
}

/// Simulates both mappers on a database with the images of `pairs`. `base_lines` says which images of each
/// part pairs with a base line connect.
///
/// # Errors
/// Those of the geometry and of `base_lines`.
pub fn foresee(
    pairs: &NamedGraph,
    taken: &Taken,
    geometry: &mut dyn Geometry,
    base_lines: impl Fn(&[Vec<u32>]) -> Result<Vec<Groups>>,
) -> Result<Foreseen> {
    let names = Names::new(pairs);
    let count = pairs.graph.nodes();
    let scene = Scene {
        features: &taken.features,
        images: count,
        pairs: &taken.incremental,
        frames: &taken.frames.frames,
    };
    let thresholds = Thresholds::default();
    let frames = |images: &[u32]| {
        let known = &taken.frames;
        (!known.frames.is_empty()).then(|| known.count(images))
    };
    let found = match taken.refused {
        true => Incremental::default(),
        false => incremental(scene, geometry, thresholds)?,
    };
    // Images of which no pair has a base line have no points, and nothing determines them.
    let with_base_line = |parts: Vec<Vec<u32>>| -> Result<Vec<Vec<u32>>> {
        let held = base_lines(&parts)?;
        let parts = parts.into_iter().zip(held);
        let parts = parts.filter(|(images, held)| held.groups.len() < images.len());
        Ok(parts.map(|(images, _)| images).collect())
    };
    let mut parts = with_base_line(taken.parts.clone())?;
    parts.sort_by_key(|part| Reverse(part.len()));
    let all = |images: &[u32]| images.iter().map(|&image| names.of(image)).collect();
    let known = &taken.frames.frames;
    let of_global = global(&taken.global, taken.sees_point.clone(), known);
    let of_global = with_base_line(of_global)?;
    let global_model = |images: &Vec<u32>| {
        let is_in = |image: &u32| images.binary_search(image).is_ok();
        let parts = parts.iter().map(|part| part.iter().copied().filter(is_in));
        let parts = parts.map(Iterator::collect::<Vec<u32>>);
        GlobalModel {
            images: all(images),
            frames: frames(images),
            parts: parts
                .filter(|part| part.len() > 1)
                .map(|part| all(&part))
                .collect(),
        }
    };
    Ok(Foreseen {
        simulated: true,
        colmap: COLMAP,
        global: Global {
            models: of_global.iter().map(global_model).collect(),
            of: count,
        },
        incremental: Models {
            refused: taken.refused,
            ..models(&found, &names, frames, thresholds)
        },
    })
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
    outside.sort_by_key(|stop| (Reverse(stop.sees), stop.image));
    Models {
        models: found.models.iter().map(model).collect(),
        outside: outside.iter().map(sees).collect(),
        starts: found.starts.iter().map(beginning).collect(),
        kept_from: found.kept_from,
        refused: false,
        thresholds,
    }
}
