//! The graph of a model of COLMAP ([`model`](crate::model)): the tracks are those of points3D; images gives
//! the names of the images, and those that see no point.

use std::collections::HashMap;
use std::path::Path;

use super::graph::{TrackGraph, TrackOptions, sorted};
use crate::NamedGraph;
use crate::error::{Fault, Problem};
use crate::model::{self, Fields, Part};
use viewcert::wording::counted;

/// The tracks of a model by the numbers of images, one track after another.
#[derive(Default)]
struct Tracks {
    images: Vec<u32>,
    /// Where the images of every track end.
    ends: Vec<usize>,
}

fn tracks(fields: &mut dyn Fields) -> Result<Tracks, Fault> {
    let mut tracks = Tracks::default();
    model::each_point(fields, |point| {
        let images = point.track.iter().map(|&(image, _)| image);
        tracks.images.extend(images);
        tracks.ends.push(tracks.images.len());
    })?;
    Ok(tracks)
}

/// The graph of the model in a folder.
pub(super) fn folder(folder: &Path, options: TrackOptions) -> Result<NamedGraph, Fault> {
    let encoding = model::encoding_in(folder).ok_or_else(model::no_model)?;
    let tracks = Part::Points.read(folder, encoding, tracks)?;
    let images = Part::Images.read(folder, encoding, |fields| model::images(fields, false))?;
    let images = images.into_iter().map(|image| (image.id, image.name));
    let (ids, names): (Vec<u32>, _) = images.unzip();
    let (names, nodes) = sorted(names)?;
    let count = ids.len();
    let node_of: HashMap<u32, u32> = ids.into_iter().zip(nodes).collect();
    if node_of.len() < count {
        return Err(Problem::corrupt("two images have one number").into());
    }
    let mut parts = [Part::Rigs, Part::Frames].into_iter();
    let frames = match options.rigs && parts.all(|part| part.is_in(folder, encoding)) {
        true => {
            let rigs = Part::Rigs.read(folder, encoding, model::rigs)?;
            let frames = Part::Frames.read(folder, encoding, model::frames)?;
            Some(model::known(&rigs, &frames, &names, &node_of)?)
        }
        false => None,
    };
    let mut graph = TrackGraph::new(names, options)?;
    graph.frames = frames;
    let mut views = Vec::new();
    let (mut from, mut doubled) = (0, 0);
    for &end in &tracks.ends {
        views.clear();
        for id in &tracks.images[from..end] {
            let Some(&node) = node_of.get(id) else {
                let why = format!("a point is seen in image {id}, which is not among the images");
                return Err(Problem::corrupt(why).into());
            };
            views.push(node);
        }
        // A mapper keeps features at one place of an image as one point: it is one view.
        let seen = views.len();
        views.sort_unstable();
        views.dedup();
        doubled += usize::from(views.len() < seen);
        from = end;
        graph.push(&views)?;
    }
    let mut graph = graph.finish()?;
    if doubled > 0 {
        let note = format!(
            "{} with several features in one image: one view each",
            counted(doubled, "point")
        );
        graph.notes.insert(0, note);
    }
    Ok(graph)
}
