//! What mappers will probably do with a database: the simulation, and its geometry read on demand.

use crate::degenerate::{Narrow, narrow};
use crate::frames::Images;
use crate::mapper::{Features, Foreseen, Geometry, Taken, foresee};
use anyhow::{Context, Result};
use viewcert::decide::{Options, decide};
use viewcert::watch::Watch;
use viewcert::{Model, Verdict};
use viewcert_formats::colmap::{Database, Estimate, Pipeline, Views, estimate};
use viewcert_formats::{NamedGraph, TrackOptions};

/// The tracks of a database, and what they determine.
#[derive(Clone, Copy)]
pub struct Tracks<'a> {
    /// The camera-point graph.
    pub input: &'a NamedGraph,
    /// What it determines.
    pub verdict: &'a Verdict,
    /// How it was read.
    pub options: TrackOptions,
}

impl Tracks<'_> {
    /// The images of every part that they determine, by the nodes of `pairs`, whose images they are of.
    pub fn parts(&self, pairs: &NamedGraph) -> Vec<Vec<u32>> {
        let images = Images::new(pairs, self.input);
        parts(pairs, self.verdict, |image| images.camera_of(image))
    }
}

/// Simulates both mappers on the tracks of a database, and finds the narrow places of its pairs; of
/// other inputs only the latter. A graph of cameras and points alone has no pairs. The tracks of the pairs of
/// global mapping are decided if these are others.
///
/// # Errors
/// A database that cannot be read, or was written to meanwhile; work that was stopped.
pub fn foreseen(
    database: Option<&Database>,
    pairs: &NamedGraph,
    tracks: Option<Tracks>,
    watch: Watch,
) -> Result<(Option<Foreseen>, Narrow)> {
    let decided = tracks.map(|tracks| (tracks.input, tracks.verdict));
    let Some(database) = database else {
        return Ok(match pairs.cameras {
            Some(_) => (None, Narrow::default()),
            None => (None, narrow(pairs, decided, &mut ())?),
        });
    };
    let taken = tracks.map(|tracks| taken(database, pairs, tracks, watch));
    let taken = taken.transpose()?;
    let (views, name) = (database.views()?, &pairs.name);
    let mut geometry = OfDatabase { views, name };
    let foreseen = taken.map(|taken| {
        foresee(pairs, &taken, &mut geometry, |images| {
            Ok(database.by_base_lines(images, &taken.frames.frames)?)
        })
    });
    Ok((
        foreseen.transpose()?,
        narrow(pairs, decided, &mut geometry)?,
    ))
}

/// What each mapper takes, and what the tracks of global mapping determine.
fn taken(database: &Database, pairs: &NamedGraph, tracks: Tracks, watch: Watch) -> Result<Taken> {
    let frames = tracks.input.frames.as_ref();
    let apart = TrackOptions {
        rigs: false,
        ..tracks.options
    };
    let own = database.tracks_of_global(apart)?;
    let each = match frames {
        // Mappers place images, of which several may be one camera here.
        Some(frames) if own.is_none() && !frames.together.is_empty() => {
            Some(database.tracks(apart)?)
        }
        _ => None,
    };
    let features = Features::new(pairs.graph.nodes(), &database.matches()?);
    database.rest()?;
    let parts = match &own {
        None => tracks.parts(pairs),
        Some(own) => {
            let options = Options::default().model(Model::Calibrated);
            let verdict = decide(&own.graph, &options.watch(watch))?;
            parts(pairs, &verdict, |image| image)
        }
    };
    Ok(Taken {
        incremental: database.taken_by(Pipeline::Incremental),
        features,
        refused: frames.is_some_and(|frames| frames.unknown > 0),
        global: database.taken_by(Pipeline::Global),
        sees_point: {
            let points = own.as_ref().or(each.as_ref()).unwrap_or(tracks.input);
            let images = 0..pairs.graph.nodes() as u32;
            images
                .map(|image| !points.graph.edges_from(image).is_empty())
                .collect()
        },
        parts,
        frames: Images::new(pairs, tracks.input),
    })
}

/// The images of every component, whose nodes are cameras.
fn parts(pairs: &NamedGraph, verdict: &Verdict, camera_of: impl Fn(u32) -> u32) -> Vec<Vec<u32>> {
    let parts = verdict.components.iter().map(|part| {
        let cameras = part.nodes();
        let images = 0..pairs.graph.nodes() as u32;
        let images = images.filter(|&image| cameras.binary_search(&camera_of(image)).is_ok());
        images.collect()
    });
    parts.collect()
}

/// The geometry of pairs as a database has it.
struct OfDatabase<'a> {
    views: Views<'a>,
    name: &'a str,
}

impl Geometry for OfDatabase<'_> {
    fn of(&mut self, (a, b): (u32, u32)) -> Result<Option<Estimate>> {
        let views = self.views.two(a, b);
        let views = views.with_context(|| self.name.to_owned())?;
        Ok(views.as_ref().map(estimate))
    }

    fn has_prior_focal_length(&self, image: u32) -> bool {
        self.views.has_prior_focal_length(image)
    }
}
