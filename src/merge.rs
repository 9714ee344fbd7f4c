//! `verify merge MODEL MODEL [DATABASE]`: whether two models can be made one.

use super::input::InputArguments;
use anyhow::{Context, Result, ensure};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;
use viewcert::decide::Options;
use viewcert_advice::merge;
use viewcert_formats::{Model, read_graphs};
use viewcert_report::merge::MergeReport;
use viewcert_session::Session;
use viewcert_session::outputs;

/// Two models, and what they come from.
#[derive(Args)]
pub(super) struct MergeArguments {
    /// The folder of a COLMAP model. Each model is taken for right in itself; nothing is written.
    #[arg(value_name = "MODEL")]
    one: PathBuf,
    /// The folder of the other.
    #[arg(value_name = "MODEL")]
    other: PathBuf,
    /// The database of both: its tracks may fix what the models alone leave free, and say what to match.
    database: Option<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Reads both models, decides what is between them, and reports.
pub(super) fn run(session: &Session, arguments: &MergeArguments) -> Result<u8> {
    let start = Instant::now();
    let models = [
        read(session, &arguments.one)?,
        read(session, &arguments.other)?,
    ];
    let both = models.each_ref();
    let seed = Options::default().seed;
    let mut tracks = match &arguments.database {
        None => {
            ensure!(
                !arguments.input.says_anything(),
                "options say how a database is read, and none is named; leave them out, or name the \
                 database after both models"
            );
            None
        }
        Some(path) => {
            session.reading(path);
            let input = read_graphs(path, &arguments.input.of_tracks()).next();
            session.hide();
            Some(input.with_context(|| format!("{}: no graph", path.display()))??)
        }
    };
    let (found, verdict) = match &mut tracks {
        None => (merge::of_models(both), None),
        Some(input) => {
            let found = merge::of_tracks(both, input, seed, &session.shown_watch());
            session.hide();
            let (found, verdict) = found.with_context(|| input.name.clone())?;
            (found, Some(verdict))
        }
    };
    let report = MergeReport {
        models: [&arguments.one, &arguments.other].map(|path| path.display().to_string()),
        tracks: tracks.as_ref().zip(verdict.as_ref()),
        merge: &found,
        time: start.elapsed(),
    };
    outputs::answer(
        arguments.json,
        found.determined,
        |out| report.write_json(out),
        |out| report.write(out),
    )
}

fn read(session: &Session, path: &Path) -> Result<Model> {
    ensure!(
        path.is_dir(),
        "{}: this is no folder; name the folder that holds cameras, images and points3D",
        path.display()
    );
    session.reading(path);
    let model = Model::read(path);
    session.hide();
    Ok(model?)
}
