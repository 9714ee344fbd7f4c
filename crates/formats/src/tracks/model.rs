//! The graph of a model of COLMAP ([`model`](crate::model)): the tracks are those of points3D; images gives
//! the names of the images, and those that see no point.

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use super::graph::{TrackGraph, TrackOptions, sorted};
use crate::NamedGraph;
use crate::error::{Fault, Place, Problem};
use crate::model::{self, Encoding, Fields, Part};
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
    let Some(encoding) = model::encoding_in(folder) else {
        return Err(Place::Input.fault(model::no_model()));
    };
    let tracks = Part::Points.read(folder, encoding, tracks)?;
    graph(Some(folder), encoding, &tracks, options)
}

/// The graph of a model of which one file is `input`, and the others are in a folder.
pub(super) fn beside(
    folder: Option<&Path>,
    part: Part,
    encoding: Encoding,
    input: impl Read,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let with_points = folder.filter(|folder| Part::Points.is_in(folder, encoding));
    let tracks = match (part, with_points) {
        (Part::Points, _) => tracks(&mut *model::fields(input, encoding))?,
        (_, Some(folder)) => Part::Points.read(folder, encoding, tracks)?,
        (_, None) => return Err(Place::Input.fault(model::no_model())),
    };
    graph(folder, encoding, &tracks, options)
}

/// The graph of tracks; images by name, or in the order of their numbers if they have none.
fn graph(
    folder: Option<&Path>,
    encoding: Encoding,
    tracks: &Tracks,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let input = |problem: Problem| Place::Input.fault(problem);
    let named = folder.filter(|folder| Part::Images.is_in(folder, encoding));
    let (ids, names, nodes): (Vec<u32>, _, _) = match named {
        Some(folder) => {
            let images =
                Part::Images.read(folder, encoding, |fields| model::images(fields, false))?;
            let images = images.into_iter().map(|image| (image.id, image.name));
            let (ids, names) = images.unzip();
            let (names, nodes) = sorted(names).map_err(input)?;
            (ids, names, nodes)
        }
        None => {
            let mut ids = tracks.images.clone();
            ids.sort_unstable();
            ids.dedup();
            let names = ids.iter().map(|id| id.to_string().into()).collect();
            let nodes = (0..ids.len() as u32).collect();
            (ids, names, nodes)
        }
    };
    let count = ids.len();
    let node_of: HashMap<u32, u32> = ids.into_iter().zip(nodes).collect();
    if node_of.len() < count {
        return Err(input(Problem::Corrupt("two images have one number".into())));
    }
    let rigs = |folder: &&Path| {
        let parts = [Part::Rigs, Part::Frames];
        options.rigs && parts.iter().all(|part| part.is_in(folder, encoding))
    };
    let frames = match named.filter(rigs) {
        Some(folder) => {
            let rigs = Part::Rigs.read(folder, encoding, model::rigs)?;
            let frames = Part::Frames.read(folder, encoding, model::frames)?;
            Some(model::known(&rigs, &frames, &names, &node_of)?)
        }
        None => None,
    };
    let mut graph = TrackGraph::new(names, options)?;
    if let Some(frames) = frames {
        graph.set_frames(frames);
    }
    let mut views = Vec::new();
    let (mut from, mut doubled) = (0, 0);
    for &end in &tracks.ends {
        views.clear();
        for id in &tracks.images[from..end] {
            let Some(&node) = node_of.get(id) else {
                let why = format!("a point is seen in image {id}, which is not among the images");
                return Err(input(Problem::Corrupt(why)));
            };
            views.push(node);
        }
        // A mapper keeps features at one place of an image as one point: it is one view.
        let seen = views.len();
        views.sort_unstable();
        views.dedup();
        doubled += usize::from(views.len() < seen);
        from = end;
        graph.push(&views).map_err(input)?;
    }
    let mut graph = graph.finish()?;
    if doubled > 0 {
        let note = format!(
            "{} with several features in one image: one view each",
            counted(doubled, "point")
        );
        graph.notes.insert(0, note);
    }
    if named.is_none() {
        let note = format!(
            "{} is not beside it: images are called by their numbers, and those without points are not known",
            Part::Images.file(encoding)
        );
        graph.notes.insert(0, note);
    }
    Ok(graph)
}
