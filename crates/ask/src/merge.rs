//! Whether two models can be made one.

use super::read_model;
use anyhow::{Context, Result};
use std::path::Path;
use std::time::Instant;
use viewcert::decide::Options;
use viewcert_advice::merge::{self, Two};
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::{NamedGraph, ReadOptions, open_database, read_graphs};
use viewcert_report::merge::MergeReport;
use viewcert_session::Session;

/// What is asked of two models, whoever asks.
pub struct Asked<'a> {
    /// The folders of the models.
    pub models: [&'a Path; 2],
    /// Their database, or another file of tracks.
    pub database: Option<&'a Path>,
    /// How its tracks are read.
    pub options: ReadOptions,
}

impl Asked<'_> {
    /// Reads everything, decides what is between the models, and calls `say` with what was found.
    ///
    /// # Errors
    /// If something cannot be read or decided; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        say: impl FnOnce(&MergeReport<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        let [one, other] = self.models.map(|path| read_model(session, path));
        let (one, other) = (one?, other?);
        let two = Two::new([(self.models[0], &one), (self.models[1], &other)])?;
        let mut tracks = self
            .database
            .map(|path| self.tracks(session, path))
            .transpose()?;
        let found = match &mut tracks {
            None => two.merge(&[]),
            Some((input, features)) => {
                let seed = Options::default().seed;
                let found =
                    session.watched(|watch| merge::of_tracks(&two, input, features, seed, watch));
                found.with_context(|| input.name.clone())?
            }
        };
        say(&MergeReport {
            models: self.models.map(|path| path.display().to_string()),
            tracks: tracks.as_ref().map(|(input, _)| input),
            merge: &found,
            time: start.elapsed(),
        })
    }

    /// The tracks, and of a database those of every feature.
    fn tracks(&self, session: &Session, path: &Path) -> Result<(NamedGraph, FeatureTracks)> {
        session.reading(path);
        let found = match open_database(path, &self.options) {
            Some(database) => {
                let database = database?;
                let graph = database.tracks(self.options.tracks.unwrap_or_default())?;
                let features = database.feature_tracks()?;
                database.finish()?;
                (graph, features)
            }
            None => {
                let graph = read_graphs(path, &self.options).next();
                let graph = graph.with_context(|| format!("{}: no graph", path.display()))??;
                (graph, FeatureTracks::default())
            }
        };
        session.hide();
        Ok(found)
    }
}
