//! `verify split MODEL DIR`: a model taken apart where its tracks do not hold it together.

use anyhow::{Context, Result, ensure};
use clap::Args;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use viewcert::Known;
use viewcert::decide::{Options, Question, decide};
use viewcert_advice::{Advice, named_joints, split};
use viewcert_formats::{Model, ReadOptions, TrackOptions, read_graphs, with_rigs};
use viewcert_report::Report;
use viewcert_report::assumptions::{Asked, BaseLines, Scope};
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
    /// The folder for the parts: a COLMAP model for each, a table, and a page that says why. It holds
    /// nothing else.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// In how many images a point has to be seen to hold them together [default: 3, as in global
    /// mapping].
    #[arg(long, value_name = "N")]
    min_views: Option<u32>,
    /// Leave the rigs of the model out of account, as if every image had a centre of its own: for rigs
    /// whose base lines the mapper had to find.
    #[arg(long)]
    no_rigs: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Reads the model, decides its tracks, writes the parts and reports.
pub(super) fn run(session: &Session, arguments: &SplitArguments) -> Result<u8> {
    let start = Instant::now();
    let path = &arguments.model;
    ensure!(
        path.is_dir(),
        "{}: this is no folder; name the folder that holds cameras, images and points3D",
        path.display()
    );
    split::check(&arguments.folder, path)?;
    let default = TrackOptions::default();
    let options = ReadOptions {
        tracks: Some(TrackOptions {
            min_views: arguments.min_views.unwrap_or(default.min_views),
            rigs: !arguments.no_rigs,
            ..default
        }),
        ..ReadOptions::default()
    };
    session.reading(path);
    let input = read_graphs(path, &options).next();
    let input = input.with_context(|| format!("{}: no graph", path.display()))??;
    let model = Model::read(path)?;
    session.hide();
    let question = Question::calibrated(with_rigs(Known::default(), &input)?);
    let options = Options::default().question(question);
    let verdict = decide(&input.graph, &options.watch(session.shown_watch()));
    session.hide();
    let verdict = verdict.with_context(|| input.name.clone())?;
    let scope = Scope::new(&input, &verdict, Asked::default(), &session.shown_watch());
    session.hide();
    let scope = scope.with_context(|| input.name.clone())?;
    let whole = scope.base_lines().is_some_and(BaseLines::is_determined);
    // What frames hold together has no joints.
    let joints = match whole {
        true => Ok(Advice::default()),
        false => named_joints(&input, &verdict, Options::default().seed, session.watch()),
    };
    session.hide();
    let joints = joints.with_context(|| input.name.clone())?;
    let mut report = Report {
        input: &input,
        verdict: &verdict,
        rational: false,
        list_components: false,
        time: Duration::ZERO,
        advice: &joints,
        scope: &scope,
        proof: None,
        here: None,
    };
    session.doing(format!("writing {}", arguments.folder.display()));
    let (outputs, folder) = (session.outputs(), &arguments.folder);
    let found = split::split(outputs, folder, &model, &input, &verdict, whole, |split| {
        report.time = start.elapsed();
        let report = SplitReport { report, split };
        Ok(report.page()?)
    });
    session.hide();
    let found = found?;
    report.time = start.elapsed();
    let report = SplitReport {
        report,
        split: &found,
    };
    outputs::answer(
        arguments.json,
        report.is_whole(),
        |out| report.write_json(out),
        |out| report.write(out),
    )
}
