//! `viewcert-lab motion`: what moves at given cameras, as a picture.

use crate::motion::{Moved, picture};
use anyhow::{Context, Result};
use clap::Args;
use std::path::PathBuf;
use viewcert::at_cameras::at_cameras;
use viewcert::geometry::model::Model;
use viewcert_formats::{ReadOptions, cameras_beside, read_graphs};
use viewcert_session::Session;
use viewcert_session::exit::GOOD;

/// A graph, its cameras, and where the picture goes.
#[derive(Args)]
pub struct Arguments {
    /// The graph, in whatever `verify` reads.
    graph: PathBuf,
    /// The cameras, as `verify --given` takes them.
    cameras: PathBuf,
    /// The picture (.svg).
    file: PathBuf,
    /// projective or calibrated: affine cameras have their centres at infinity.
    #[arg(long, default_value = "projective")]
    model: Model,
}

/// Draws the motions of first order.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let path = &arguments.graph;
    let input = read_graphs(path, &ReadOptions::default()).next();
    let input = input.with_context(|| format!("{}: no graph", path.display()))??;
    let given = cameras_beside(&arguments.cameras, &input, arguments.model)?;
    let given = given.with_context(|| format!("{}: no cameras", arguments.cameras.display()))?;
    let centres = &given.centres;
    let here = session.watched(|watch| at_cameras(&input.graph, centres, watch))?;
    let motions = session.watched(|watch| here.basis_of_motions(centres, watch))?;
    let picture = picture(&Moved {
        input: &input,
        here: &here,
        centres,
        motions: &motions.unwrap_or_default(),
    });
    let picture = picture.with_context(
        || "nothing to draw: these cameras are determined, at infinity, or in too many parts",
    )?;
    let outputs = session.outputs();
    outputs.write(&arguments.file, |out| out.write_all(picture.as_bytes()))?;
    Ok(GOOD)
}
