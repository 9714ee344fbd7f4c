//! Tracks that count, as a graph of cameras and points.

use crate::NamedGraph;
use crate::error::{Fault, Problem};
use crate::tracks::Frames;
use serde::{Deserialize, Serialize};
use viewcert::graph::{Graph, Labels};
use viewcert::wording::counted;

/// Which tracks count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrackOptions {
    /// In how many images a track has to be seen.
    pub min_views: u32,
    /// Features of one track in one image are one if they are at most so many pixels apart; it
    /// counts where their places are known, which is in databases.
    pub max_spread: u32,
    /// Whether the rigs of the input count: then images of a frame know their base lines.
    pub rigs: bool,
}

impl Default for TrackOptions {
    /// Three images and ten pixels, as COLMAP's global mapper has it
    /// (`track_min_num_views_per_track`, `track_intra_image_consistency_threshold`).
    fn default() -> Self {
        Self {
            min_views: 3,
            max_spread: 10,
            rigs: true,
        }
    }
}

/// How many tracks there are, and how many count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrackFacts {
    /// In how many images a track has to be seen.
    pub min_views: u32,
    /// How many tracks count: the points of the graph.
    pub points: usize,
    /// In how many images these are seen, counted with repetition: the edges of the graph.
    pub observations: usize,
    /// How many cameras see none of these points.
    pub cameras_without_point: usize,
    /// Tracks with several features in one image that are one, with one observation there.
    pub merged: usize,
    /// Tracks with two features in one image that are not one, which do not count.
    pub inconsistent: usize,
    /// Consistent tracks in fewer than `min_views` images, which do not count.
    pub short: usize,
}

/// What to do with a model of COLMAP that has poses and no points.
const KNOWN_POSES: &str = "let COLMAP find the points (`colmap point_triangulator`), or decide the pairs of its \
                           database at these cameras: `verify database.db --given FOLDER`";

/// A camera-point graph that grows by tracks.
#[derive(Default)]
pub(crate) struct TrackGraph {
    facts: TrackFacts,
    /// Within how many pixels features of one track in one image are one, if their places are known.
    pub(crate) spread: Option<u32>,
    /// Whether places are missing that were asked for.
    pub(crate) places_missing: bool,
    cameras: Vec<Box<str>>,
    /// For every camera, the last track that saw it, counted from 1.
    stamp: Vec<u32>,
    track: u32,
    /// How many points every camera sees.
    degree: Vec<u32>,
    /// The cameras of every point, one point after another.
    views: Vec<u32>,
    /// Where the cameras of every point end.
    ends: Vec<usize>,
    /// What is known of frames.
    pub(crate) frames: Option<Frames>,
}

impl TrackGraph {
    /// No points yet; the cameras in the order of the nodes.
    ///
    /// # Errors
    /// No camera at all, or more than nodes can be numbered.
    pub(crate) fn new(cameras: Vec<Box<str>>, options: TrackOptions) -> Result<Self, Fault> {
        if cameras.is_empty() {
            return Err(Problem::corrupt("it has no cameras").into());
        }
        if u32::try_from(cameras.len()).is_err() {
            return Err(Problem::too_many_nodes().into());
        }
        Ok(Self {
            facts: TrackFacts {
                min_views: options.min_views,
                ..TrackFacts::default()
            },
            stamp: vec![0; cameras.len()],
            degree: vec![0; cameras.len()],
            cameras,
            ..Self::default()
        })
    }

    /// One track more, by the nodes of the cameras that see it, each feature once. O(views).
    ///
    /// # Errors
    /// More nodes or edges than a graph can hold.
    ///
    /// # Panics
    /// If a node is no camera.
    pub(crate) fn push(&mut self, views: &[u32]) -> Result<(), Problem> {
        self.track = self
            .track
            .checked_add(1)
            .ok_or_else(Problem::too_many_nodes)?;
        let mut twice = false;
        for &camera in views {
            twice |= std::mem::replace(&mut self.stamp[camera as usize], self.track) == self.track;
        }
        if twice {
            self.facts.inconsistent += 1;
            return Ok(());
        }
        self.count(views)
    }

    /// One track more whose features in one image are one: its views, each camera once or several
    /// times in a row. O(views).
    ///
    /// # Errors
    /// As of [`Self::push`].
    ///
    /// # Panics
    /// If a node is no camera.
    pub(crate) fn push_merged(&mut self, views: &[u32]) -> Result<(), Problem> {
        self.track = self
            .track
            .checked_add(1)
            .ok_or_else(Problem::too_many_nodes)?;
        self.facts.merged += 1;
        let mut cameras = views.to_vec();
        cameras.dedup();
        self.count(&cameras)
    }

    /// A consistent track, each camera once.
    fn count(&mut self, views: &[u32]) -> Result<(), Problem> {
        if views.len() < self.facts.min_views as usize {
            self.facts.short += 1;
            return Ok(());
        }
        for &camera in views {
            self.degree[camera as usize] += 1;
        }
        self.views.extend_from_slice(views);
        self.ends.push(self.views.len());
        if self.views.len() > i32::MAX as usize {
            return Err(Problem::too_many_pairs());
        }
        Ok(())
    }

    /// The graph. O(cameras + observations).
    ///
    /// # Errors
    /// No track at all, or more nodes than can be numbered.
    pub(crate) fn finish(mut self) -> Result<NamedGraph, Fault> {
        if self.track == 0 {
            let cameras = self.cameras.len();
            return Err(Problem::no_points("a model of COLMAP", KNOWN_POSES, cameras).into());
        }
        self.unite();
        let cameras = self.cameras.len() as u32;
        let nodes = u32::try_from(self.cameras.len() + self.ends.len())
            .map_err(|_| Problem::too_many_nodes())?;
        self.facts.points = self.ends.len();
        self.facts.observations = self.views.len();
        let blind = self.degree.iter().filter(|&&degree| degree == 0);
        self.facts.cameras_without_point = blind.count();
        let notes = self.notes();
        // By camera, then by point: the order of edges.
        let mut next = Vec::with_capacity(self.degree.len());
        let mut start = 0;
        for &degree in &self.degree {
            next.push(start);
            start += degree as usize;
        }
        let mut edges = vec![(0, 0); self.views.len()];
        let mut from = 0;
        for (point, &end) in (cameras..).zip(&self.ends) {
            for &camera in &self.views[from..end] {
                let place = &mut next[camera as usize];
                edges[*place] = (camera, point);
                *place += 1;
            }
            from = end;
        }
        let (graph, _) = Graph::from_pairs(nodes, edges).map_err(Problem::corrupt)?;
        let labels = Labels::CamerasAndPoints(self.cameras);
        Ok(NamedGraph {
            frames: self.frames.map(Box::new),
            notes,
            cameras: Some(cameras),
            tracks: Some(self.facts),
            ..NamedGraph::new("", graph, labels)
        })
    }

    /// Images that are one camera are one node, called by the first of them. O(observations), if there
    /// are any.
    fn unite(&mut self) {
        let Some(frames) = &mut self.frames else {
            return;
        };
        let Some(first_of) = frames.number_anew(&self.cameras) else {
            return;
        };
        // Cameras keep their order, so that a number is new where it is the next one.
        let mut kept = 0;
        let mut numbers = first_of.iter();
        self.cameras.retain(|_| {
            let is_first = numbers.next() == Some(&kept);
            kept += u32::from(is_first);
            is_first
        });
        self.degree = vec![0; self.cameras.len()];
        let (mut views, mut from) = (Vec::with_capacity(self.views.len()), 0);
        for end in &mut self.ends {
            let start = views.len();
            for &camera in &self.views[from..*end] {
                let camera = first_of[camera as usize];
                if !views[start..].contains(&camera) {
                    views.push(camera);
                    self.degree[camera as usize] += 1;
                }
            }
            from = std::mem::replace(end, views.len());
        }
        self.views = views;
    }

    /// What does not count, in words.
    fn notes(&self) -> Vec<String> {
        let facts = &self.facts;
        let mut notes = self.frames.as_ref().map_or_else(Vec::new, Frames::notes);
        if facts.merged > 0 {
            let has = if facts.merged == 1 { "has" } else { "have" };
            notes.push(format!(
                "{} {has} several features in one image, at most {} apart: one observation there, \
                 as in global mapping",
                counted(facts.merged, "track"),
                counted(self.spread.unwrap_or(0) as usize, "pixel"),
            ));
        }
        if facts.inconsistent > 0 {
            let apart = match self.spread {
                None => String::new(),
                Some(pixels) => {
                    let or = if self.places_missing {
                        ", or not known where"
                    } else {
                        ""
                    };
                    format!(
                        ", more than {} apart{or}",
                        counted(pixels as usize, "pixel")
                    )
                }
            };
            notes.push(format!(
                "dropped: {} with two features in one image{apart}",
                counted(facts.inconsistent, "track")
            ));
        }
        if facts.short > 0 {
            notes.push(format!(
                "not counted: {} in fewer than {} (--min-views)",
                counted(facts.short, "track"),
                counted(facts.min_views as usize, "image"),
            ));
        }
        if facts.cameras_without_point > 0 {
            let cameras = counted(facts.cameras_without_point, "camera");
            let see = if facts.cameras_without_point == 1 {
                "sees no track that counts: no track determines it"
            } else {
                "see no track that counts: no track determines them"
            };
            notes.push(format!("{cameras} {see}"));
        }
        notes
    }
}

/// Names in bytewise order, and the node of each by its place in `names`.
///
/// # Errors
/// If two are the same.
pub(super) fn sorted(names: Vec<Box<str>>) -> Result<(Vec<Box<str>>, Vec<u32>), Problem> {
    let mut named: Vec<(Box<str>, u32)> = names.into_iter().zip(0..).collect();
    named.sort_unstable();
    if let Some(two) = named.windows(2).find(|two| two[0].0 == two[1].0) {
        let name = &two[0].0;
        return Err(Problem::corrupt(format!("two cameras are called `{name}`")));
    }
    let mut nodes = vec![0; named.len()];
    for (node, (_, place)) in (0..).zip(&named) {
        nodes[*place as usize] = node;
    }
    Ok((named.into_iter().map(|(name, _)| name).collect(), nodes))
}

/// Cameras without names, called by their numbers from 0.
pub(super) fn numbered(count: u32) -> Vec<Box<str>> {
    (0..count).map(|k| k.to_string().into()).collect()
}
