//! A database that is open: its pairs, its tracks and the geometry of single pairs, all of one state.

use std::path::Path;

use super::open::Opened;
use super::pairs::{Tables, of_cameras};
use super::{DatabaseFacts, Estimate, FeatureTracks, Groups, Pipeline, Views, estimate};
use super::{axes, base_lines, positions, raw, rigs, tracks};
use crate::error::{Fault, Problem};
use crate::motions::{Motions, Source};
use crate::{Matching, NamedGraph, ReadAs, ReadError, ReadOptions, TrackOptions};
use viewcert::graph::{Graph, Labels};

/// What decides about tracks in global mapping and stands in no database.
const NOT_KNOWN: &str = "not known from a database: the pairs that global mapping drops because their \
                         rotations disagree, and the points that it drops once they are placed";

/// A database of COLMAP. Whatever is read of it is of the state that it had when it was opened, or it is
/// an error.
pub struct Database {
    name: String,
    opened: Opened,
    tables: Tables,
    /// The graph of the pairs that are used, and what is known of them.
    pairs: Graph,
    matching: Matching,
    facts: DatabaseFacts,
    /// What is said besides of every graph.
    note: Option<String>,
}

impl Database {
    /// Opens a database, which graphs and errors call `name`, and reads its images and pairs. O(images + pairs) and the sorting of both.
    ///
    /// # Errors
    /// See [`Problem`].
    pub(crate) fn open(name: &str, path: &Path, options: &ReadOptions) -> Result<Self, ReadError> {
        let read = || {
            let opened = Opened::new(path)?;
            let tables = Tables::read(&opened.connection, options)?;
            let (pairs, matching) = tables.graph()?;
            let positions = positions::read(&opened.connection, &tables.nodes)?;
            let mut geometry = Geometry::new(&opened, &tables);
            let without =
                base_lines::note(&tables.pairs, tables.names.len(), |pair| geometry.of(pair))?;
            let positioned = positions.iter().flatten().count();
            let mut facts = tables.facts(&opened.connection, &pairs, positioned)?;
            facts.axes_parallel = facts.axes_parallel
                && axes::are_parallel(&tables.pairs, &facts, |pair| geometry.of(pair))?;
            Ok(Self {
                facts,
                matching: Matching {
                    positions,
                    ..matching
                },
                name: name.to_owned(),
                opened,
                tables,
                pairs,
                note: without,
            })
        };
        read().map_err(|error| in_file(name, error))
    }

    /// The graph of the pairs that a mapper takes, whose nodes are all images.
    pub fn pairs(&self) -> NamedGraph {
        let labels = Labels::Names(self.tables.names.clone());
        let graph = NamedGraph {
            matching: Some(self.matching.clone()),
            ..NamedGraph::new("", self.pairs.clone(), labels)
        };
        self.finished(graph, false)
    }

    /// The graph of the images and the tracks of these pairs (docs/theory.md, section 12). Linear in the
    /// matches, but for nearly constant factors.
    ///
    /// # Errors
    /// See [`Problem`]; tracks that no graph can hold.
    pub fn tracks(&self, options: TrackOptions) -> Result<NamedGraph, ReadError> {
        let graph = self.camera_point_graph(options);
        let mut graph = graph.map_err(|fault| fault.in_file(&self.name))?;
        let mut notes: Vec<String> = self.tables.other_mapper().into_iter().collect();
        notes.append(&mut graph.notes);
        notes.push(NOT_KNOWN.to_owned());
        Ok(self.finished(NamedGraph { notes, ..graph }, options.rigs))
    }

    /// The graph of the images and tracks of the pairs that global mapping takes, if these are others.
    ///
    /// # Errors
    /// As of [`Self::tracks`].
    pub fn tracks_of_global(&self, options: TrackOptions) -> Result<Option<NamedGraph>, ReadError> {
        let taken = self.taken_by(Pipeline::Global);
        let taken = taken.iter().map(|&(pair, _)| pair);
        if taken.clone().eq(self.pairs.edges().iter().copied()) || taken.len() == 0 {
            return Ok(None);
        }
        let read = || {
            self.opened.wake()?;
            let pairs =
                Graph::new(self.tables.names.len() as u32, taken).map_err(Problem::corrupt)?;
            let connection = &self.opened.connection;
            tracks::read(connection, &self.tables, &pairs, None, options)
        };
        let graph = read().map_err(|fault: Fault| fault.in_file(&self.name))?;
        Ok(Some(self.finished(graph, false)))
    }

    /// The pairs that a mapper of COLMAP 4.2 takes, with their inliers, increasing.
    pub fn taken_by(&self, pipeline: Pipeline) -> Vec<((u32, u32), u32)> {
        self.tables.taken_by(pipeline)
    }

    /// What the pairs that incremental mapping takes say of the motion between two images, with the hash of all
    /// keypoints and matches if it is asked. O(matches), and linear in what is hashed.
    ///
    /// # Errors
    /// See [`Problem`].
    pub fn motions(&self, hashed: bool) -> Result<Motions, ReadError> {
        let read = || {
            self.opened.wake()?;
            let mut views = views(&self.opened, &self.tables)?;
            let names = self.tables.names.clone();
            let mut motions =
                Motions::of(&self.name, Labels::Names(names), self.tables.names.len());
            for ((a, b), _) in self.taken_by(Pipeline::Incremental) {
                motions.take([a, b], views.motion(a, b)?);
            }
            motions.source = Source::Database;
            if hashed {
                motions.hash = Some(raw::hash(&self.opened.connection)?);
            }
            Ok(motions)
        };
        read().map_err(|error| in_file(&self.name, error))
    }

    /// The matches of the pairs that incremental mapping takes: two images and a feature of each.
    ///
    /// # Errors
    /// As of [`Self::tracks`].
    pub fn matches(&self) -> Result<Vec<[(u32, u32); 2]>, ReadError> {
        let read = || {
            self.opened.wake()?;
            let taken = self.taken_by(Pipeline::Incremental);
            let taken = taken.iter().map(|&(pair, _)| pair);
            let pairs = Graph::new(self.tables.names.len() as u32, taken);
            let pairs = pairs.map_err(Problem::corrupt)?;
            tracks::matches(&self.opened.connection, &self.tables, &pairs)
        };
        read().map_err(|problem| in_file(&self.name, problem))
    }

    /// The images of each part by the pairs that have a base line; images of a frame stay together.
    ///
    /// # Errors
    /// See [`Problem`].
    pub fn by_base_lines(
        &self,
        parts: &[Vec<u32>],
        frames: &[Vec<u32>],
    ) -> Result<Vec<Groups>, ReadError> {
        let mut geometry = Geometry::new(&self.opened, &self.tables);
        let (pairs, images) = (&self.tables.pairs, self.tables.names.len());
        let found = base_lines::groups(pairs, images, parts, frames, |pair| geometry.of(pair));
        found.map_err(|error| in_file(&self.name, error))
    }

    fn camera_point_graph(&self, options: TrackOptions) -> Result<NamedGraph, Fault> {
        self.opened.wake()?;
        let connection = &self.opened.connection;
        let frames = if options.rigs {
            rigs::read(connection, &self.tables.names, &self.tables.nodes)?
        } else {
            None
        };
        let graph = tracks::read(connection, &self.tables, &self.pairs, frames, options)?;
        let known = self
            .tables
            .between_cameras(&self.pairs, self.matching.clone());
        Ok(NamedGraph {
            matching: Some(match &graph.frames {
                Some(frames) => of_cameras(known, |image| frames.camera_of(image)),
                None => known,
            }),
            ..graph
        })
    }

    /// Which features are the same point, by the matches of these pairs.
    ///
    /// # Errors
    /// See [`Problem`].
    pub fn feature_tracks(&self) -> Result<FeatureTracks, ReadError> {
        let fault = |problem| in_file(&self.name, problem);
        self.opened.wake().map_err(fault)?;
        let connection = &self.opened.connection;
        tracks::of_features(connection, &self.tables, &self.pairs).map_err(fault)
    }

    /// The geometry of its pairs, to be asked for one by one. O(images).
    ///
    /// # Errors
    /// See [`Problem`].
    pub fn views(&self) -> Result<Views<'_>, ReadError> {
        let views = views(&self.opened, &self.tables);
        views.map_err(|error| in_file(&self.name, error))
    }

    /// Keeps no writer waiting until something else is read.
    ///
    /// # Errors
    /// Those of SQLite.
    pub fn rest(&self) -> Result<(), ReadError> {
        let rest = self.opened.rest();
        rest.map_err(|error| in_file(&self.name, error))
    }

    /// To be called after everything is read.
    ///
    /// # Errors
    /// If somebody has written in between.
    pub fn finish(self) -> Result<(), ReadError> {
        let finish = self.opened.finish();
        finish.map_err(|error| in_file(&self.name, error))
    }

    /// A graph with what is said of all.
    fn finished(&self, graph: NamedGraph, rigs_count: bool) -> NamedGraph {
        let of_opening = self.opened.note.iter().cloned();
        let of_tables = self.tables.notes(&self.facts, rigs_count);
        let notes = of_opening.chain(of_tables).chain(graph.notes);
        NamedGraph {
            name: self.name.clone(),
            notes: notes.chain(self.note.clone()).collect(),
            read: ReadAs::new("COLMAP database"),
            database: Some(Box::new(self.facts.clone())),
            ..graph
        }
    }
}

fn views<'a>(opened: &'a Opened, tables: &Tables) -> Result<Views<'a>, Problem> {
    opened.wake()?;
    let images = tables.names.len();
    Views::new(&opened.connection, tables.table, images, &tables.nodes)
}

/// What is known of single pairs; nothing is read before the first is asked for.
struct Geometry<'a> {
    opened: &'a Opened,
    tables: &'a Tables,
    views: Option<Views<'a>>,
}

impl<'a> Geometry<'a> {
    fn new(opened: &'a Opened, tables: &'a Tables) -> Self {
        Self {
            opened,
            tables,
            views: None,
        }
    }

    fn of(&mut self, (a, b): (u32, u32)) -> Result<Option<Estimate>, Problem> {
        if self.views.is_none() {
            self.views = Some(views(self.opened, self.tables)?);
        }
        let Some(views) = &mut self.views else {
            return Ok(None);
        };
        Ok(views.two(a, b)?.as_ref().map(estimate))
    }
}

fn in_file(name: &str, error: Problem) -> ReadError {
    Fault::from(error).in_file(name)
}
