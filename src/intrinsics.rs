//! `--intrinsics`: what is not known of the intrinsics of each camera (docs/theory.md, section 17).
//!
//! In: a graph as it was read. Out: the graph with what was noted in reading, and the sensors.

use super::plan::{CERTIFICATE, INTRINSICS, IntrinsicsFrom};
use anyhow::{Context, Result};
use clap::Args;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use viewcert::decide::Verdict;
use viewcert::intrinsics::{Certified, Metric, Sensors};
use viewcert::watch::Watch;
use viewcert_formats::{NamedGraph, intrinsics, read_intrinsics};

/// What a file of classes looks like: `verify help intrinsics`.
pub(super) const HELP: &str = "\
What --intrinsics FILE holds: what is not known of the intrinsics of each camera, a class on each line.

  known A B                  All intrinsics of these cameras are known.
  focal C                    The focal length is not known.
  focal+point D              Focal length and principal point are not known.
  unknown E                  No intrinsics are known.
  default focal              The class of all others.
  shared focal F G           These images have one sensor, of the class that is named.

Does the graph determine cameras and intrinsics? Without FILE the prior focal lengths and `camera_id` of
the graph's own COLMAP database say what is known; with `free` in its place no focal length is known.
";

/// What is known of each camera.
#[derive(Args)]
pub(super) struct IntrinsicsArguments {
    /// Intrinsics that are unknown (`verify help intrinsics`).
    #[arg(long, value_name = "FILE", num_args = 0..=1, hide_short_help = true)]
    intrinsics: Option<Option<PathBuf>>,
}

impl IntrinsicsArguments {
    /// Where classes are from, if that is asked.
    pub(super) fn from(&self) -> Option<IntrinsicsFrom> {
        self.intrinsics.clone().map(IntrinsicsFrom::from)
    }
}

/// The graph with the notes on its classes, and the sensor of each node if that is asked.
///
/// # Errors
/// Those of the file.
pub(super) fn read<'a>(
    from: Option<&IntrinsicsFrom>,
    input: Cow<'a, NamedGraph>,
) -> Result<(Cow<'a, NamedGraph>, Option<Sensors>)> {
    let found = match from {
        None => return Ok((input, None)),
        Some(IntrinsicsFrom::File(path)) => read_intrinsics(path, &input),
        Some(IntrinsicsFrom::Input) => {
            intrinsics::of_database(Path::new(&input.name), &input, true)
        }
        Some(IntrinsicsFrom::Free) => {
            intrinsics::of_database(Path::new(&input.name), &input, false)
        }
    };
    let found = found.context(INTRINSICS)?;
    let mut input = input.into_owned();
    input.notes.extend(found.notes);
    Ok((Cow::Owned(input), Some(found.sensors)))
}

/// What the graph determines, and with what shows it if it is to be certified.
///
/// # Errors
/// If the work was stopped; a graph without pairs that is to be certified.
pub(super) fn decide(
    input: &NamedGraph,
    verdict: &Verdict,
    sensors: &Sensors,
    (seed, certify): (u64, bool),
    watch: &Watch,
) -> Result<(Metric, Option<Certified>)> {
    let graph = &input.graph;
    if !certify {
        return Ok((
            Metric::with_sensors(graph, verdict, sensors, seed, watch)?,
            None,
        ));
    }
    let found = Certified::new(graph, verdict, sensors, seed, watch)?;
    let found = found.with_context(|| {
        format!("{INTRINSICS}: a graph without pairs has no certificate; leave out {CERTIFICATE}")
    })?;
    Ok((found.metric.clone(), Some(found)))
}
