//! Tracks: points that are seen in several images.
//!
//! In: COLMAP's models, Bundler's `bundle.out`, BAL, NVM, matches and models of OpenMVG, models of AliceVision, tracks
//! of OpenSfM, or the matches of a database ([`colmap`](crate::colmap)). Out: the camera-point graph (docs/theory.md, section 12):
//! nodes are the cameras and behind them the points, edges the observations of every track that
//! counts, and a summary of those that do not ([`TrackFacts`]). Which of the files it is, is told
//! by its content (`kind`).

mod bal;
mod bundler;
mod doubled;
mod frames;
mod graph;
mod join;
mod kind;
mod model;
mod nvm;
mod openmvg;
mod pipelines;
pub(crate) mod words;

pub use frames::Frames;
pub use graph::{TrackFacts, TrackOptions};

#[cfg(feature = "databases")]
pub(crate) use doubled::Places;
pub(crate) use frames::{Frame, Pose, Rig, read as read_frames};
pub(crate) use graph::TrackGraph;
pub(crate) use join::Joined;
pub(crate) use kind::{TrackFile, by_first_words, kind};

use std::io::Read;
use std::path::Path;

use crate::error::{Fault, Kind, Problem};
use crate::{NamedGraph, ReadAs};
use words::Words;

/// The camera-point graph of an input that begins with `head`, which is all of it if `whole`.
/// Linear in the bytes.
///
/// # Errors
/// An input without tracks, or whose tracks contradict it; where.
pub(crate) fn read(
    head: &[u8],
    whole: bool,
    input: impl Read,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let Some(kind) = kind(head, whole) else {
        let remedy = "they come from a COLMAP database or model, Bundler's bundle.out, BAL, NVM, and files of OpenMVG, AliceVision \
                      and OpenSfM; leave out --tracks to decide a graph of pairs";
        return Err(Problem::new("no tracks are found in this file", remedy).into());
    };
    if !options.rigs {
        return Err(Problem::unused("--no-rigs", "such a file holds no rigs").into());
    }
    ensure_no_spread(options)?;
    let graph = match kind {
        TrackFile::Bal => bal::read(Words::new(input), options),
        TrackFile::Bundler => bundler::read(Words::new(input), options),
        TrackFile::Nvm => nvm::read(Words::new(input), options),
        TrackFile::OpenMvgMatches => openmvg::read(Words::new(input), false, options),
        TrackFile::AliceVisionMatches => openmvg::read(Words::new(input), true, options),
        TrackFile::OpenMvg => pipelines::openmvg(input, options),
        TrackFile::AliceVision => pipelines::alicevision(input, options),
        TrackFile::OpenSfm => pipelines::opensfm(Words::new(input), options),
    };
    let graph = graph.map_err(|fault| match fault.problem.kind {
        Kind::NoPoints(cameras) => {
            let advice = "write it with its points, or decide the pairs of its images, from a list or a database";
            Problem::no_points(kind.name(), advice, cameras).into()
        }
        _ => fault,
    })?;
    Ok(NamedGraph {
        read: ReadAs::new(kind.format()),
        ..graph
    })
}

/// Refuses a spread of features, which databases alone hold.
fn ensure_no_spread(options: TrackOptions) -> Result<(), Fault> {
    let (option, why) = ("--max-spread", "this is no COLMAP database");
    match options.max_spread == TrackOptions::default().max_spread {
        true => Ok(()),
        false => Err(Problem::unused(option, why).into()),
    }
}

/// The camera-point graph of COLMAP's model in a folder.
///
/// # Errors
/// As of [`read`].
pub(crate) fn read_folder(folder: &Path, options: TrackOptions) -> Result<NamedGraph, Fault> {
    ensure_no_spread(options)?;
    let graph = model::folder(folder, options)?;
    Ok(NamedGraph {
        read: ReadAs::new("model of COLMAP"),
        ..graph
    })
}

#[cfg(test)]
mod tests;
