//! `verify split MODEL DIR`: a model taken apart where its observations do not hold it together.

use super::input::recorded;
use anyhow::{Context, Result, anyhow, ensure};
use clap::Args;
use std::path::PathBuf;
use std::time::Instant;
use viewcert::at_cameras::finished::held;
use viewcert_advice::split::{self, Free};
use viewcert_ask::read_model;
use viewcert_audit::softness::softness;
use viewcert_formats::error::Kind;
use viewcert_formats::{ReadOptions, read_graphs};
use viewcert_report::counted;
use viewcert_report::split::SplitReport;
use viewcert_session::Session;
use viewcert_session::outputs;

/// What to take apart, and where to.
#[derive(Args)]
pub(super) struct SplitArguments {
    /// The folder of a COLMAP model: cameras, images and points3D, as .bin or as .txt, and rigs and
    /// frames if they are there. It is read and never written to.
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// The folder for the parts, a COLMAP model for each: a new or an empty one.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// In how many images a point has to be seen to hold them together: 3 asks what global mapping
    /// rests on.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(2..))]
    min_views: u32,
    /// Leave the rigs of the model out of account, as if every image had a centre of its own: for rigs
    /// whose base lines the mapper had to find.
    #[arg(long)]
    no_rigs: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Takes the model apart; a failure has a record too.
pub(super) fn run(session: &Session, arguments: &SplitArguments) -> Result<u8> {
    let done = taken_apart(session, arguments);
    recorded(arguments.json, &arguments.model, done)
}

/// Reads the model, decides its tracks, writes the parts and reports.
fn taken_apart(session: &Session, arguments: &SplitArguments) -> Result<u8> {
    let start = Instant::now();
    let (path, folder) = (&arguments.model, &arguments.folder);
    split::check(folder, path)?;
    let least = arguments.min_views as usize;
    // A model without points, and a folder that is none, are refused as they are everywhere.
    if path.is_dir()
        && let Some(Err(error)) = read_graphs(path, &ReadOptions::default()).next()
        && error.problem.kind != Kind::Model
    {
        return Err(error.into());
    }
    let model = read_model(session, path)?;
    let name = path.display();
    ensure!(
        model.images.len() > 1,
        "{name}: the model has one image, and a part has two or more; name another model"
    );
    let posed = model.posed(least, !arguments.no_rigs);
    let posed =
        posed.map_err(|why| anyhow!("{name}/{why}; map again, or leave it out of the model"))?;
    let held = session.watched(|watch| held(&posed.exact(), watch));
    let held = held.with_context(|| name.to_string())?;
    session.doing(format!(
        "measuring {name}, and writing {}",
        folder.display()
    ));
    let softness = softness(&posed, held.is_scaled);
    let found = split::split(session.outputs(), folder, &model, &posed, &held.parts);
    session.hide();
    let (softness, found) = (softness?, found?);
    let unplaced = counted(posed.unplaced, "image");
    let note = format!("the rig does not place the sensors of {unplaced}: each moves by itself");
    let report = SplitReport {
        model: name.to_string(),
        notes: (posed.unplaced > 0).then_some(note).into_iter().collect(),
        posed: &posed,
        least,
        free: &Free::of(&held, &model, &posed),
        held: &held,
        softness,
        split: &found,
        time: start.elapsed(),
    };
    outputs::answer(
        arguments.json,
        report.is_whole(),
        |out| report.write_json(out),
        |out| report.write(out),
    )
}
