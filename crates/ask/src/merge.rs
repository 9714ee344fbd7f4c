//! Whether two models can be made one.

use super::{HowRead, read_model};
use anyhow::{Context, Result};
use std::path::Path;
use std::time::Instant;
use viewcert_advice::merge::Two;
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::{NamedGraph, open_database};
use viewcert_report::merge::MergeReport;
use viewcert_session::Session;

/// What is asked of two models, whoever asks.
pub struct Asked<'a> {
    /// The folders of the models.
    pub models: [&'a Path; 2],
    /// Their database.
    pub database: Option<&'a Path>,
    /// How its pairs are read.
    pub reading: HowRead,
}

impl Asked<'_> {
    /// Reads everything, compares the models, and calls `say` with what was found.
    ///
    /// # Errors
    /// If something cannot be read; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        say: impl FnOnce(&MergeReport<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        let [one, other] = self.models.map(|path| read_model(session, path));
        let (one, other) = (one?, other?);
        let two = Two::new([(self.models[0], &one), (self.models[1], &other)])?;
        let (input, merge) = match self.database {
            None => (None, two.merge(None)?),
            Some(path) => {
                let (input, tracks) = self.tracks(session, path)?;
                let merge = two.merge(Some(&tracks));
                let merge = merge.with_context(|| input.name.clone())?;
                (Some(input), merge)
            }
        };
        say(&MergeReport {
            models: self.models.map(|path| path.display().to_string()),
            input: input.as_ref(),
            merge: &merge,
            time: start.elapsed(),
        })
    }

    /// The pairs of the database, and the tracks of every feature.
    fn tracks(&self, session: &Session, path: &Path) -> Result<(NamedGraph, FeatureTracks)> {
        self.reading.ensure_pairs(path)?;
        session.reading(path);
        let database = open_database(path, &self.reading.pairs);
        let database = database.with_context(|| {
            let path = path.display();
            format!("{path}: this is no database of COLMAP; name that of both models")
        })??;
        let found = (database.pairs(), database.feature_tracks()?);
        database.finish()?;
        session.hide();
        Ok(found)
    }
}
