//! Tracks of other pipelines: OpenMVG's `sfm_data.json`, AliceVision's `.sfm`, OpenSfM's `tracks.csv`.
//!
//! In: the text. Out: of the first two all views, whether they were placed or not, and the points of the structure;
//! of OpenSfM the tracks before a reconstruction, and the images in them.

use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use std::collections::HashMap;
use std::io::Read;

use super::graph::{TrackGraph, TrackOptions, sorted};
use super::words::Words;
use crate::NamedGraph;
use crate::error::{Fault, Place, Problem};

/// An entry of a map of cereal.
#[derive(Deserialize)]
struct Keyed<T> {
    key: u64,
    value: T,
}

#[derive(Deserialize)]
struct OpenMvg {
    views: Vec<Keyed<OpenMvgPointer>>,
    #[serde(default)]
    structure: Vec<Keyed<OpenMvgPoint>>,
}

#[derive(Deserialize)]
struct OpenMvgPointer {
    ptr_wrapper: OpenMvgData,
}

#[derive(Deserialize)]
struct OpenMvgData {
    data: OpenMvgView,
}

#[derive(Deserialize)]
struct OpenMvgView {
    #[serde(default)]
    local_path: String,
    filename: String,
}

#[derive(Deserialize)]
struct OpenMvgPoint {
    observations: Vec<Keyed<IgnoredAny>>,
}

/// OpenMVG's `sfm_data.json`.
pub(super) fn openmvg(input: impl Read, options: TrackOptions) -> Result<NamedGraph, Fault> {
    let found: OpenMvg = json(input)?;
    let views = found.views.into_iter().map(|view| {
        let data = view.value.ptr_wrapper.data;
        let name = match data.local_path.trim_end_matches(['/', '\\']) {
            "" => data.filename,
            folder => format!("{folder}/{}", data.filename),
        };
        (view.key, name)
    });
    let points = found.structure.into_iter().map(|point| {
        let seen = point.value.observations.into_iter();
        seen.map(|view| view.key).collect()
    });
    graph(views.collect(), points.collect(), options)
}

#[derive(Deserialize)]
struct AliceVision {
    views: Vec<AliceVisionView>,
    #[serde(default)]
    structure: Vec<AliceVisionPoint>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AliceVisionView {
    view_id: String,
    path: String,
}

#[derive(Deserialize)]
struct AliceVisionPoint {
    observations: Vec<AliceVisionObservation>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AliceVisionObservation {
    observation_id: String,
}

/// AliceVision's `.sfm`, in which all numbers are strings.
pub(super) fn alicevision(input: impl Read, options: TrackOptions) -> Result<NamedGraph, Fault> {
    let found: AliceVision = json(input)?;
    let folders = found.views.iter().map(|view| folder(&view.path));
    let shared = folders
        .reduce(|a, b| if a == b { a } else { "" })
        .unwrap_or_default();
    let views = found.views.iter().map(|view| {
        let name = view.path[shared.len()..].to_owned();
        (view.view_id.clone(), name)
    });
    let views = views.collect();
    let points = found.structure.into_iter().map(|point| {
        let seen = point.observations.into_iter();
        seen.map(|view| view.observation_id).collect()
    });
    graph(views, points.collect(), options)
}

/// The folder of a path, with its last separator.
fn folder(path: &str) -> &str {
    path.rfind(['/', '\\']).map_or("", |end| &path[..=end])
}

fn json<T: DeserializeOwned>(mut input: impl Read) -> Result<T, Fault> {
    let mut text = Vec::new();
    let read = input.read_to_end(&mut text);
    read.map_err(Problem::from)?;
    serde_json::from_slice(&text).map_err(|error| {
        let line = Place::Line(error.line() as u64);
        line.fault(Problem::corrupt(error))
    })
}

/// The graph of views (number, name) and of the views of every point. A view that sees no point is a camera all the
/// same: somebody took the photograph, and asks where it is.
fn graph<Id: Eq + std::hash::Hash + std::fmt::Display>(
    views: Vec<(Id, String)>,
    points: Vec<Vec<Id>>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    if points.is_empty() {
        return Err(Problem::no_points("", "", views.len()).into());
    }
    let names = views.iter().map(|(_, name)| name.as_str().into());
    let (names, nodes) = sorted(names.collect())?;
    let places = views.iter().map(|(id, _)| id).zip(nodes);
    let places: HashMap<&Id, u32> = places.collect();
    let mut graph = TrackGraph::new(names, options)?;
    for point in &points {
        let node = |id: &Id| {
            let found = places.get(id).copied();
            found.ok_or_else(|| {
                Problem::corrupt(format!("a point is seen by view {id}, which is not listed"))
            })
        };
        let views: Vec<u32> = point.iter().map(node).collect::<Result<_, _>>()?;
        graph.push(&views)?;
    }
    graph.finish()
}

/// OpenSfM's `tracks.csv` (versions 1 and 2): behind a line with the version `image`, `track`, `feature` and more,
/// with tabs between.
pub(super) fn opensfm<R: Read>(
    mut words: Words<R>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    words.next_full_line()?;
    let mut images: HashMap<Box<str>, u32> = HashMap::new();
    let mut tracks: HashMap<Box<str>, Vec<u32>> = HashMap::new();
    while words.next_line()? {
        let line = std::str::from_utf8(words.rest());
        let line = line.map_err(|_| words.corrupt("the line is no UTF-8"))?;
        if line.is_empty() {
            continue;
        }
        let fields: Vec<&str> = line.split('\t').collect();
        let [image, track, _, _, _, ..] = fields[..] else {
            return Err(words.corrupt(
                "a line has an image, a track, a feature and its place, with tabs between",
            ));
        };
        let next = images.len() as u32;
        let image = *images.entry(image.into()).or_insert(next);
        tracks.entry(track.into()).or_default().push(image);
    }
    let mut named: Vec<(Box<str>, u32)> = images.into_iter().collect();
    named.sort_unstable_by_key(|(_, image)| *image);
    let names = named.into_iter().map(|(name, _)| name).collect();
    let (names, nodes) = sorted(names)?;
    let mut graph = TrackGraph::new(names, options)?;
    let mut tracks: Vec<(Box<str>, Vec<u32>)> = tracks.into_iter().collect();
    tracks.sort_unstable();
    for (_, track) in tracks {
        let views: Vec<u32> = track.iter().map(|&image| nodes[image as usize]).collect();
        graph.push(&views)?;
    }
    graph.finish()
}
