//! Cameras that `--given` brings: what is determined at these (docs/theory.md, section 16).

use anyhow::{Result, anyhow};
use std::path::Path;
use viewcert::here::{Centres, Here, HereError, here};
use viewcert::{Model, watch::Watch};
use viewcert_formats::{NamedGraph, centre_error, read_cameras};

/// The centres of the cameras that a file gives, if it gives any; what was noted goes to the graph.
///
/// # Errors
/// Those of the file; a camera that the model excludes.
pub(super) fn read(
    given: Option<&Path>,
    input: &NamedGraph,
    model: Model,
) -> Result<Option<(NamedGraph, Centres)>> {
    let cameras = given.map(|path| read_cameras(path, input, model));
    Ok(cameras.transpose()?.flatten().map(|cameras| {
        let mut input = input.clone();
        input.notes.extend(cameras.notes);
        (input, cameras.centres)
    }))
}

/// Decides a graph at given cameras.
///
/// # Errors
/// A pair without length; work that was stopped.
pub(super) fn decide(input: &NamedGraph, centres: &Centres, watch: &Watch) -> Result<Here> {
    here(&input.graph, centres, watch).map_err(|error| match error {
        HereError::Centre(error) => anyhow!("{}: {}", input.name, centre_error(error, input)),
        other => anyhow!(other).context(input.name.clone()),
    })
}
