//! What mappers will probably do with a database: the simulation, and its geometry read on demand.

use anyhow::Result;
use std::path::Path;
use viewcert::Verdict;
use viewcert_advice::mapper::{Foreseen, Geometry, foresee};
use viewcert_advice::special::{Narrow, narrow};
use viewcert_formats::NamedGraph;

/// Simulates both mappers on the tracks of a database, and finds the narrow places of its pairs; of
/// other inputs only the latter. A graph of cameras and points alone has no pairs. `each` are the tracks
/// with a camera for every image, if these are others.
///
/// # Errors
/// A database that cannot be read a third time, or was written to meanwhile.
pub(super) fn foreseen(
    path: &Path,
    pairs: &NamedGraph,
    tracks: Option<(&NamedGraph, &Verdict)>,
    each: Option<&NamedGraph>,
) -> Result<(Option<Foreseen>, Narrow)> {
    #[cfg(feature = "databases")]
    if pairs.database.is_some() {
        let mut geometry = geometry::OfDatabase::open(path)?;
        let found = with_geometry(pairs, tracks, each, &mut geometry)?;
        geometry.finish()?;
        return Ok(found);
    }
    let _ = path;
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

#[cfg(feature = "databases")]
mod geometry {
    use super::*;
    use anyhow::Context;
    use viewcert_advice::mapper::{Estimate, estimate};
    use viewcert_formats::colmap::Views;

    /// The geometry of pairs as a database has it.
    pub(super) struct OfDatabase {
        views: Views,
        name: String,
    }

    impl OfDatabase {
        /// Opens it.
        ///
        /// # Errors
        /// A database that cannot be read.
        pub(super) fn open(path: &Path) -> Result<Self> {
            let name = path.display().to_string();
            let views = Views::open(path).with_context(|| name.clone())?;
            Ok(Self { views, name })
        }

        /// To be called after everything is read.
        ///
        /// # Errors
        /// If somebody has written in between.
        pub(super) fn finish(self) -> Result<()> {
            self.views.finish().with_context(|| self.name)
        }
    }

    impl Geometry for OfDatabase {
        fn of(&mut self, (a, b): (u32, u32)) -> Result<Option<Estimate>> {
            let views = self.views.two(a, b).with_context(|| self.name.clone())?;
            Ok(views.as_ref().map(estimate))
        }

        fn has_prior_focal_length(&self, image: u32) -> bool {
            self.views.has_prior_focal_length(image)
        }
    }
}
