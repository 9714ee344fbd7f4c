//! Cameras that `--given` brings: what is determined at these (docs/theory.md, section 16).

use anyhow::{Context, Result, anyhow};
use viewcert::at_cameras::{Centres, Here, HereError, at_cameras, open_focal_lengths};
use viewcert::watch::Watch;
use viewcert_formats::{NamedGraph, centre_error};
use viewcert_report::assumptions::Asked;

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
