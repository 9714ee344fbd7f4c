//! What mappers will probably do with a database: the simulation, and its geometry read on demand.

use anyhow::Result;
use std::path::Path;
use viewcert::Verdict;
use viewcert_advice::mapper::{Foreseen, foresee};
use viewcert_formats::NamedGraph;

/// Simulates both mappers on the tracks of a database; nothing for other tracks.
///
/// # Errors
/// A database that cannot be read a third time, or was written to meanwhile.
pub(super) fn foreseen(
    path: &Path,
    tracks: &NamedGraph,
    verdict: &Verdict,
) -> Result<Option<Foreseen>> {
    #[cfg(feature = "databases")]
    if tracks.database.is_some() {
        let mut geometry = geometry::OfDatabase::open(path)?;
        let found = foresee(tracks, verdict, &mut geometry)?;
        geometry.finish()?;
        return Ok(found);
    }
    let _ = path;
    foresee(tracks, verdict, &mut ())
}

#[cfg(feature = "databases")]
pub(super) mod geometry {
    use super::*;
    use anyhow::Context;
    use viewcert_advice::mapper::{Estimate, Geometry, estimate};
    use viewcert_formats::colmap::Views;

    /// The geometry of pairs as a database has it.
    pub(in super::super) struct OfDatabase {
        views: Views,
        name: String,
    }

    impl OfDatabase {
        /// Opens it.
        ///
        /// # Errors
        /// A database that cannot be read.
        pub(in super::super) fn open(path: &Path) -> Result<Self> {
            let name = path.display().to_string();
            let views = Views::open(path).with_context(|| name.clone())?;
            Ok(Self { views, name })
        }

        /// To be called after everything is read.
        ///
        /// # Errors
        /// If somebody has written in between.
        pub(in super::super) fn finish(self) -> Result<()> {
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
