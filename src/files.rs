//! Commands about files, which `viewcert_ask` answers: overview, lists, merge, contradictions.

use super::input::{self, InputArguments, recorded};
use anyhow::{Result, ensure};
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert_ask::contradictions::{self, ANGLE};
use viewcert_ask::{Input, lists, merge, overview};
use viewcert_formats::error::ReadError;
use viewcert_report::overview::Overview;
use viewcert_report::{overview_page, screen};
use viewcert_session::exit::{GOOD, NOT};
use viewcert_session::{Session, outputs};

/// Options of the overview.
#[derive(Args)]
pub(super) struct OverviewArguments {
    /// COLMAP databases, models, folders that hold one, or files of other pipelines.
    #[arg(required = true, value_name = "DATABASE")]
    inputs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print everything: parts, joints, notes, all verdicts.
    #[arg(long)]
    all: bool,
    /// Print one JSON object an input.
    #[arg(long)]
    json: bool,
    /// Write a page as well, which needs no other file.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

/// The page in messages.
const PAGE: &str = "--html";

/// Writes the page.
fn write_page(session: &Session, file: &Path, found: &Overview) -> Result<()> {
    session.doing(format!("drawing {}", found.name));
    let page = overview_page::html(found, found.joints)?;
    session.hide();
    session.outputs().write(file, |out| out.write_all(&page))
}

/// Says what every input determines; a bad one is reported and does not stop the others.
pub(super) fn overview(session: &Session, arguments: &OverviewArguments) -> Result<u8> {
    let page = arguments.html.as_deref();
    let inputs = arguments.inputs.iter().map(PathBuf::as_path);
    outputs::ensure_apart(&[(PAGE, page)], inputs)?;
    let too_many = |what: &str| {
        let page = page?.display();
        Some(format!(
            "{PAGE} {page}: a page is about one input, and there are {what}; run the program on each"
        ))
    };
    if let Some(reason) = too_many(&format!("{} inputs", arguments.inputs.len())) {
        ensure!(arguments.inputs.len() == 1, reason);
    }
    let mut out = outputs::text(&[page]);
    let asked = overview::Asked {
        reading: arguments.input.reading(),
    };
    let each = |out: &mut _, path: &Path, read: Result<Input, ReadError>, start| {
        asked.of_read(session, (path, read, start), |found| {
            if let Some(file) = page {
                write_page(session, file, found)?;
            }
            if arguments.json {
                found.write_json(out)?;
            } else {
                screen::write(out, found, arguments.all)?;
            }
            let contradicts = found.contradictions.as_ref();
            let is_good = contradicts.is_none_or(|found| found.is_good());
            Ok(if found.determined() && is_good {
                GOOD
            } else {
                NOT
            })
        })
    };
    let read = |path: &Path| asked.inputs(path);
    let inputs = (&*arguments.inputs, arguments.json);
    input::for_each_read(session, &read, inputs, &too_many, &mut out, each)
}

/// Lists, and what they are about.
#[derive(Args)]
pub(super) struct ListArguments {
    /// A COLMAP database, of which each list is decided by its own tracks, or any other graph, of which
    /// it is decided by its own pairs.
    graph: PathBuf,
    /// Lists of images as COLMAP's mappers take them: a name on each line.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Reads the graph and the lists, and reports what they determine.
pub(super) fn lists(session: &Session, arguments: &ListArguments) -> Result<u8> {
    let asked = lists::Asked {
        graph: &arguments.graph,
        files: &arguments.files,
        reading: arguments.input.reading(),
    };
    let done = asked.of(session, |report| {
        outputs::answer(
            arguments.json,
            report.is_determined(),
            |out| report.write_json(out),
            |out| report.write(out),
        )
    });
    recorded(arguments.json, &arguments.graph, done)
}

/// Two models, and what they come from.
#[derive(Args)]
pub(super) struct MergeArguments {
    /// The folder of a COLMAP model. Nothing is written.
    #[arg(value_name = "MODEL")]
    one: PathBuf,
    /// The folder of the other.
    #[arg(value_name = "MODEL")]
    other: PathBuf,
    /// The database of both: its tracks may fix what the models alone leave free.
    database: Option<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Reads both models, decides what is between them, and reports.
pub(super) fn merge(session: &Session, arguments: &MergeArguments) -> Result<u8> {
    ensure!(
        arguments.database.is_some() || !arguments.input.says_anything(),
        "options say how a database is read, and none is named; leave them out, or name the database after \
         both models"
    );
    let models = [&*arguments.one, &*arguments.other];
    let read = (arguments.database.as_deref(), &arguments.input.reading());
    let done = merge::merge(session, models, read, |report| {
        outputs::answer(
            arguments.json,
            report.merge.is_good(),
            |out| report.write_json(out),
            |out| report.write(out),
        )
    });
    let [one, other] = models.map(Path::display);
    recorded(arguments.json, format!("{one} and {other}").as_ref(), done)
}

/// A file with measured motions, and from which angle on they contradict each other.
#[derive(Args)]
pub(super) struct ContradictionsArguments {
    /// A COLMAP database, a pose graph of g2o, or relative poses with 9 or 14 fields a line.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// A motion is off if its rotation is, by more than so many degrees. From 10 on right pairs raise no
    /// alarm, as far as we have seen.
    #[arg(long, value_name = "DEGREES", default_value_t = ANGLE, value_parser = clap::value_parser!(u32).range(1..=59))]
    angle: u32,
    /// Write the proof, which `verify check` verifies.
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Finds what contradicts what, and reports.
pub(super) fn contradictions(session: &Session, arguments: &ContradictionsArguments) -> Result<u8> {
    let target = arguments.certificate.as_deref();
    outputs::ensure_apart(
        &[("--certificate", target)],
        std::iter::once(&*arguments.file),
    )?;
    let asked = contradictions::Asked {
        file: &arguments.file,
        angle: arguments.angle,
        certificate: target,
    };
    let done = asked.of(session, |report| {
        outputs::answer(
            arguments.json,
            report.is_good(),
            |out| report.write_json(out),
            |out| report.write(out),
        )
    });
    recorded(arguments.json, &arguments.file, done)
}
