//! COLMAP's models: a folder with `cameras`, `images` and `points3D`, as `.bin` or as `.txt`.
//!
//! The tracks are those of points3D; images gives the names of the images, and those that see no
//! point. Formats: COLMAP's documentation, "Output Format".

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::graph::{TrackGraph, TrackOptions, sorted};
use super::model_files::{Encoding, Image, Part, Points};
use super::words::Words;
use super::{Frames, model_binary, model_rigs, model_text};
use crate::NamedGraph;
use crate::error::{Fault, Place, Problem};
use viewcert::wording::counted;

/// The name of a file of a model.
fn file_name(part: Part, encoding: Encoding) -> &'static str {
    match (part, encoding) {
        (Part::Cameras, Encoding::Binary) => "cameras.bin",
        (Part::Cameras, Encoding::Text) => "cameras.txt",
        (Part::Images, Encoding::Binary) => "images.bin",
        (Part::Images, Encoding::Text) => "images.txt",
        (Part::Points, Encoding::Binary) => "points3D.bin",
        (Part::Points, Encoding::Text) => "points3D.txt",
    }
}

/// How the model in a folder is written, if there is one; `.bin` goes first, as in COLMAP.
pub(crate) fn encoding_in(folder: &Path) -> Option<Encoding> {
    let there = |&encoding: &_| folder.join(file_name(Part::Points, encoding)).is_file();
    [Encoding::Binary, Encoding::Text].into_iter().find(there)
}

/// Whether there is a model in a folder.
pub(crate) fn is_model(folder: &Path) -> bool {
    encoding_in(folder).is_some()
}

/// Whether there is a model in a folder, and no point in it. O(bytes) of the comments.
pub(crate) fn has_no_points(folder: &Path) -> bool {
    let Some(encoding) = encoding_in(folder) else {
        return false;
    };
    let file = File::open(folder.join(file_name(Part::Points, encoding)));
    file.is_ok_and(|file| match encoding {
        Encoding::Binary => {
            let mut count = [0; 8];
            let mut file = file;
            file.read_exact(&mut count).is_ok() && count == [0; 8]
        }
        Encoding::Text => matches!(Words::new(file).next_full_line(), Ok(false)),
    })
}

/// The graph of the model in a folder.
pub(super) fn folder(folder: &Path, options: TrackOptions) -> Result<NamedGraph, Fault> {
    let Some(encoding) = encoding_in(folder) else {
        return Err(Place::Input.fault(Problem::NoModel));
    };
    let input = open(&folder.join(file_name(Part::Points, encoding)))?;
    beside(Some(folder), Part::Points, encoding, input, options)
}

/// The graph of a model of which one file is `input`, and the others are in a folder.
pub(super) fn beside(
    folder: Option<&Path>,
    part: Part,
    encoding: Encoding,
    input: impl Read,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let other = |part| -> Option<PathBuf> {
        let path = folder?.join(file_name(part, encoding));
        path.is_file().then_some(path)
    };
    let points = match (part, other(Part::Points)) {
        (Part::Points, _) => points(input, encoding)?,
        (_, Some(path)) => points(open(&path)?, encoding).map_err(|fault| within(&path, fault))?,
        (_, None) => return Err(Place::Input.fault(Problem::NoModel)),
    };
    let images = match other(Part::Images) {
        Some(path) => Some(images(&path, encoding).map_err(|fault| within(&path, fault))?),
        None => None,
    };
    let unnamed = images.is_none();
    let images = images.unwrap_or_else(|| numbered(&points));
    let rigs = if options.rigs && !unnamed {
        rigs_beside(folder, encoding)?.map(|rigs| (encoding, rigs))
    } else {
        None
    };
    let mut graph = graph(images, unnamed, &points, rigs, options)?;
    if unnamed {
        graph.notes.insert(
            0,
            format!(
                "{} is not beside it: images are called by their numbers, and those without points \
                 are not known",
                file_name(Part::Images, encoding)
            ),
        );
    }
    Ok(graph)
}

/// The files of rigs and of frames, if both are there.
fn rigs_beside(folder: Option<&Path>, encoding: Encoding) -> Result<Option<[Vec<u8>; 2]>, Fault> {
    let names = match encoding {
        Encoding::Binary => ["rigs.bin", "frames.bin"],
        Encoding::Text => ["rigs.txt", "frames.txt"],
    };
    let Some(folder) = folder else {
        return Ok(None);
    };
    let paths = names.map(|name| folder.join(name));
    if !paths.iter().all(|path| path.is_file()) {
        return Ok(None);
    }
    let read = |path: &Path| {
        std::fs::read(path).map_err(|error| within(path, Place::Input.fault(error.into())))
    };
    Ok(Some([read(&paths[0])?, read(&paths[1])?]))
}

/// What the rigs of the model in a folder say of the images `names`, whose nodes are known by their
/// numbers; nothing, if it has none.
pub(crate) fn frames_in(
    folder: &Path,
    encoding: Encoding,
    names: &[Box<str>],
    nodes: &HashMap<u32, u32>,
) -> Result<Frames, Fault> {
    match rigs_beside(Some(folder), encoding)? {
        Some([rigs, frames]) => model_rigs::frames(&rigs, &frames, encoding, names, nodes),
        None => Ok(Frames::default()),
    }
}

fn open(path: &Path) -> Result<File, Fault> {
    File::open(path).map_err(|error| within(path, Place::Input.fault(error.into())))
}

/// A fault of another file than the one that was named.
fn within(path: &Path, fault: Fault) -> Fault {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Place::Input.fault(Problem::Within {
        part: format!("{name}{}", fault.place),
        problem: Box::new(fault.problem),
    })
}

fn points(input: impl Read, encoding: Encoding) -> Result<Points, Fault> {
    match encoding {
        Encoding::Binary => model_binary::points(input),
        Encoding::Text => model_text::points(input),
    }
}

fn images(path: &Path, encoding: Encoding) -> Result<Vec<Image>, Fault> {
    let file = File::open(path).map_err(|error| Place::Input.fault(error.into()))?;
    match encoding {
        Encoding::Binary => model_binary::images(file),
        Encoding::Text => model_text::images(file),
    }
}

/// The images that tracks name, increasing, called by their numbers.
fn numbered(points: &Points) -> Vec<Image> {
    let mut ids = points.images.clone();
    ids.sort_unstable();
    ids.dedup();
    let image = |id: u32| Image {
        id,
        name: id.to_string().into(),
    };
    ids.into_iter().map(image).collect()
}

/// The graph of tracks; images by name, or in the order given if they have none.
fn graph(
    images: Vec<Image>,
    in_order: bool,
    points: &Points,
    rigs: Option<(Encoding, [Vec<u8>; 2])>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let input = |problem: Problem| Place::Input.fault(problem);
    let ids: Vec<u32> = images.iter().map(|image| image.id).collect();
    let names: Vec<Box<str>> = images.into_iter().map(|image| image.name).collect();
    let (names, nodes) = if in_order {
        let nodes = (0..names.len() as u32).collect();
        (names, nodes)
    } else {
        sorted(names).map_err(input)?
    };
    let count = ids.len();
    let node_of: HashMap<u32, u32> = ids.into_iter().zip(nodes).collect();
    if node_of.len() < count {
        return Err(input(Problem::Corrupt("two images have one number".into())));
    }
    let frames = match &rigs {
        Some((encoding, [rigs, frames])) => Some(model_rigs::frames(
            rigs, frames, *encoding, &names, &node_of,
        )?),
        None => None,
    };
    let mut graph = TrackGraph::new(names, options)?;
    if let Some(frames) = frames {
        graph.set_frames(frames);
    }
    let mut views = Vec::new();
    let (mut from, mut doubled) = (0, 0);
    for &end in &points.ends {
        views.clear();
        for id in &points.images[from..end] {
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
        graph.notes.insert(
            0,
            format!(
                "{} with several features in one image: one view each",
                counted(doubled, "point")
            ),
        );
    }
    Ok(graph)
}
