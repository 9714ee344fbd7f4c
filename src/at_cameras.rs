//! Cameras that `--given` brings: what is determined at these (docs/theory.md, section 16).

use anyhow::{Context, Result, anyhow};
use std::io::Write;
use viewcert::at_cameras::{Centres, Here, HereError, Motion, at_cameras, open_focal_lengths};
use viewcert::watch::Watch;
use viewcert_formats::{NamedGraph, centre_error};
use viewcert_report::assumptions::Asked;
use viewcert_session::Session;

/// Decides a graph at given cameras.
///
/// # Errors
/// A pair without length; work that was stopped.
pub(super) fn decide(input: &NamedGraph, centres: &Centres, watch: &Watch) -> Result<Here> {
    at_cameras(&input.graph, centres, watch).map_err(|error| match error {
        HereError::Centre(error) => anyhow!("{}: {}", input.name, centre_error(error, input)),
        other => anyhow!(other).context(input.name.clone()),
    })
}

/// The nodes whose focal length no pair fixes, if these are unknown.
///
/// # Errors
/// Centres alone, which do not say where optical axes point.
pub(super) fn open(asked: Asked, input: &NamedGraph, centres: &Centres) -> Result<Vec<u32>> {
    match asked.focal {
        false => Ok(Vec::new()),
        true => open_focal_lengths(&input.graph, centres).with_context(|| {
            format!(
                "{}: --model focal: centres do not say where optical axes point, which decides whether pairs fix \
                 focal lengths; give poses or matrices, or say --model calibrated if focal lengths are known",
                input.name
            )
        }),
    }
}

/// What moves, to be drawn: nothing where it cannot be listed, which is said.
///
/// # Errors
/// If the work is stopped.
pub(super) fn motions(here: &Here, centres: &Centres, session: &Session) -> Result<Vec<Motion>> {
    let found = session.watched(|watch| here.basis_of_motions(centres, watch))?;
    if found.is_none() && !here.is_determined() {
        let why = match here.model.in_plane() {
            true => "affine cameras have their centres at infinity",
            false => "too many parts move for exact velocities",
        };
        // Whoever does not read it has the picture of the graph.
        let _ = writeln!(std::io::stderr(), "verify: what moves is not drawn: {why}");
    }
    Ok(found.unwrap_or_default())
}
