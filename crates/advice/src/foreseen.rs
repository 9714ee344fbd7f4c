//! What mappers will probably do with a database: the simulation, and its geometry read on demand.

use crate::mapper::{Estimate, Foreseen, Geometry, estimate, foresee};
use crate::special::{Narrow, narrow};
use anyhow::{Context, Result};
use viewcert::Verdict;
use viewcert_formats::NamedGraph;
use viewcert_formats::colmap::{Database, Views};

/// Simulates both mappers on the tracks of a database, and finds the narrow places of its pairs; of
/// other inputs only the latter. A graph of cameras and points alone has no pairs. `each` are the tracks
/// with a camera for every image, if these are others.
///
/// # Errors
/// A database that cannot be read, or was written to meanwhile.
pub fn foreseen(
    database: Option<&Database>,
    pairs: &NamedGraph,
    tracks: Option<(&NamedGraph, &Verdict)>,
    each: Option<&NamedGraph>,
) -> Result<(Option<Foreseen>, Narrow)> {
    if let Some(database) = database {
        let (views, name) = (database.views()?, &pairs.name);
        return with_geometry(pairs, tracks, each, &mut OfDatabase { views, name });
    }
    if pairs.cameras.is_some() {
        return Ok((None, Narrow::default()));
    }
    with_geometry(pairs, tracks, each, &mut ())
}

fn with_geometry(
    pairs: &NamedGraph,
    tracks: Option<(&NamedGraph, &Verdict)>,
    each: Option<&NamedGraph>,
    geometry: &mut dyn Geometry,
) -> Result<(Option<Foreseen>, Narrow)> {
    let foreseen = match tracks {
        Some(tracks) => foresee(each.unwrap_or(tracks.0), tracks, geometry)?,
        None => None,
    };
    Ok((foreseen, narrow(pairs, tracks, geometry)?))
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
