//! Whether two models can be made one.

use super::{HowRead, read_model};
use anyhow::{Context, Result};
use std::path::Path;
use std::time::Instant;
use viewcert_advice::merge::Two;
use viewcert_formats::colmap::FeatureTracks;
use viewcert_formats::open_database;
use viewcert_report::merge::MergeReport;
use viewcert_session::Session;

/// Reads two models, and perhaps their database, compares them, and calls `say` with what was found.
///
/// # Errors
/// If something cannot be read; those of `say`.
pub fn merge<T>(
    session: &Session,
    models: [&Path; 2],
    (database, reading): (Option<&Path>, &HowRead),
    say: impl FnOnce(&MergeReport<'_>) -> Result<T>,
) -> Result<T> {
    let start = Instant::now();
    let [one, other] = models.map(|path| read_model(session, path));
    let (one, other) = (one?, other?);
    let two = Two::new([(models[0], &one), (models[1], &other)])?;
    let tracks = database.map(|path| tracks(session, path, reading));
    let merge = two.merge(tracks.transpose()?.as_ref());
    let merge = merge.with_context(|| database.unwrap_or(models[0]).display().to_string())?;
    say(&MergeReport {
        models: models.map(|path| path.display().to_string()),
        has_database: database.is_some(),
        merge: &merge,
        time: start.elapsed(),
    })
}

/// The tracks of every feature of a database.
fn tracks(session: &Session, path: &Path, reading: &HowRead) -> Result<FeatureTracks> {
    reading.ensure_pairs(path)?;
    session.reading(path);
    let database = open_database(path, &reading.pairs);
    let database = database.with_context(|| {
        let path = path.display();
        format!("{path}: this is no database of COLMAP; name that of both models")
    })??;
    let tracks = database.feature_tracks()?;
    database.finish()?;
    session.hide();
    Ok(tracks)
}
