//! Internal to viewcert, and may change at any time.
//!
//! What is asked of files: the overview of a database, lists of images, two models, measured motions,
//! archives of certificates.
//!
//! In: paths, and how they are read. Out: what was found, to whom it is said: the program `verify`, and the
//! Python package.

pub mod archive;
pub mod contradictions;
pub mod lists;
pub mod merge;
pub mod overview;

use anyhow::{Result, bail, ensure};
use std::path::Path;
use viewcert_formats::colmap::Database;
use viewcert_formats::error::ReadError;
use viewcert_formats::{Model, NamedGraph};
use viewcert_session::Session;

/// A graph, and the database that it is of, if that is open for more.
pub type Input = (NamedGraph, Option<Database>);

/// The graphs of a file, or why there is none.
pub type Inputs = Box<dyn Iterator<Item = Result<Input, ReadError>>>;

/// Refuses an option that is about tracks, for an input that has none.
///
/// # Errors
/// If there is one.
fn ensure_not_of_tracks(option: Option<&str>, path: &Path) -> Result<()> {
    match option {
        None => Ok(()),
        Some(option) => bail!(
            "{}: {option} says how tracks count, and there are none; leave it out",
            path.display()
        ),
    }
}

/// Reads a model of COLMAP.
///
/// # Errors
/// A path that is no folder; what is wrong in it.
pub fn read_model(session: &Session, path: &Path) -> Result<Model> {
    ensure!(
        path.is_dir(),
        "{}: this is no folder; name the folder that holds cameras, images and points3D",
        path.display()
    );
    session.reading(path);
    let model = Model::read(path);
    session.hide();
    Ok(model?)
}
