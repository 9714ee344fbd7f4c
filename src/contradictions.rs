//! `verify contradictions FILE`: how many measured motions cannot all be right, by proof.

use super::input::recorded;
use anyhow::{Context, Result};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;
use viewcert_advice::contradictions::{certificate, contradictions};
use viewcert_formats::{ReadOptions, read_motions};
use viewcert_report::contradictions::ContradictionsReport;
use viewcert_session::Session;
use viewcert_session::outputs;

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

/// The angle of an alarm, in degrees.
pub(super) const ANGLE: u32 = 10;

/// What is asked of a file, whoever asks.
pub struct Asked<'a> {
    /// The file.
    pub file: &'a Path,
    /// The angle in degrees, 1 to 59.
    pub angle: u32,
    /// Where the certificate goes.
    pub certificate: Option<&'a Path>,
}

impl Asked<'_> {
    /// Reads the motions, finds what contradicts what, and calls `say` with it.
    ///
    /// # Errors
    /// A file that cannot be read, or holds no motions; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        say: impl FnOnce(&ContradictionsReport<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        session.reading(self.file);
        let motions = read_motions(
            self.file,
            &ReadOptions::default(),
            self.certificate.is_some(),
        );
        session.hide();
        let motions = motions?;
        let found = session.watched(|watch| contradictions(&motions, self.angle, watch));
        let (motions, found) = found.with_context(|| motions.name.clone())?;
        if let Some(path) = self.certificate {
            let text = serde_json::to_vec(&certificate(&motions, &found))?;
            session.outputs().write(path, |out| out.write_all(&text))?;
        }
        say(&ContradictionsReport {
            path: self.file.display().to_string(),
            motions: &motions,
            found: &found,
            time: start.elapsed(),
        })
    }
}

/// Finds what contradicts what, and reports.
pub(super) fn run(session: &Session, arguments: &ContradictionsArguments) -> Result<u8> {
    let target = arguments.certificate.as_deref();
    outputs::ensure_apart(
        &[("--certificate", target)],
        std::iter::once(&*arguments.file),
    )?;
    let asked = Asked {
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
