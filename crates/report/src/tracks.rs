//! Components of cameras in a camera-point graph, and its tracks, for people and programs.

use super::{Report, counted};
use crate::shown::row;
use serde::Serialize;
use std::collections::BTreeSet;
use std::io::{self, Write};
use viewcert::decide::Component;
use viewcert_formats::TrackFacts;

/// How many components are shown with their sizes.
const SHOWN: usize = 8;

/// The tracks as `verify --json` prints them, in the member `tracks`.
#[derive(Serialize)]
pub(super) struct TrackLine<'a> {
    pub(super) cameras: u32,
    #[serde(flatten)]
    pub(super) facts: &'a TrackFacts,
}

/// How many cameras and points a component has; the cameras are the first nodes of the graph.
pub fn members(component: &Component, cameras: u32) -> (Vec<u32>, usize) {
    let mut nodes = component.nodes();
    let split = nodes.partition_point(|&node| node < cameras);
    let points = nodes.len() - split;
    nodes.truncate(split);
    (nodes, points)
}

/// Writes what the tracks are and what the model takes for known.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, facts: &TrackFacts) -> io::Result<()> {
    write_size(out, facts)?;
    let words = "calibrated: rotations are known, and an observation is a direction";
    row(out, "model", words)
}

/// Writes what the tracks are.
///
/// # Errors
/// Those of the writer.
pub fn write_size(out: &mut impl Write, facts: &TrackFacts) -> io::Result<()> {
    let points = counted(facts.points, "point");
    let images = counted(facts.min_views as usize, "image");
    let observations = counted(facts.observations, "observation");
    row(
        out,
        "tracks",
        format!("{points} in at least {images}: {observations}"),
    )
}

/// Writes the components of cameras.
///
/// # Errors
/// Those of the writer.
pub fn write_components(
    out: &mut impl Write,
    report: &Report,
    cameras: u32,
    strength: &str,
) -> io::Result<()> {
    let components = report.verdict.components.iter();
    let parts = components.map(|component| members(component, cameras));
    let (parts, single): (Vec<_>, Vec<_>) = parts.partition(|(nodes, _)| nodes.len() > 1);
    let mut text: Vec<String> = parts
        .iter()
        .take(SHOWN)
        .map(|(nodes, points)| {
            let (nodes, points) = (counted(nodes.len(), "camera"), counted(*points, "point"));
            format!("{nodes} / {points}")
        })
        .collect();
    if parts.len() > SHOWN {
        text.push(format!("{} more", parts.len() - SHOWN));
    }
    match single.len() {
        0 => {}
        1 => text.push("1 observation by itself".to_owned()),
        count => text.push(format!("{count} observations by themselves")),
    }
    let total = parts.len() + single.len();
    let colon = if text.is_empty() { "" } else { ": " };
    // Those that a rig places are in one.
    let inside: BTreeSet<u32> = parts.iter().flat_map(|(nodes, _)| nodes).copied().collect();
    let graph = &report.input.graph;
    let alone = (0..cameras).filter(|v| graph.edges_from(*v).is_empty() && !inside.contains(v));
    let in_none = match alone.count() {
        0 => String::new(),
        count => format!("; in none: {} without a point", counted(count, "camera")),
    };
    let text = text.join(", ");
    row(
        out,
        "components",
        format!("{total} ({strength}){colon}{text}{in_none}"),
    )?;
    if !report.list_components {
        return Ok(());
    }
    for (k, (nodes, points)) in (1..).zip(parts) {
        write!(out, "  component {k} ({}):", counted(points, "point"))?;
        for node in nodes {
            write!(out, " {}", report.input.labels.display(node))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
