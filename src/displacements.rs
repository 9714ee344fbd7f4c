//! `--displacements FILE`: which pairs of calibrated cameras know their distance too
//! (docs/models.md).
//!
//! In: the option of `verify GRAPH` and `verify check`. Out: the displacements of a graph in the
//! nodes' numbers, notes on the file, and what is refused together with it, by name.

use anyhow::{Result, bail, ensure};
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::Model;
use viewcert::graph::Displacements;
use viewcert_formats::{NamedGraph, read_displacements};

/// The option.
pub(super) const OPTION: &str = "--displacements";

/// Which displacements are known.
#[derive(Args)]
pub(super) struct DisplacementArguments {
    /// Pairs of cameras whose distance is known as well as its direction (stereo rigs), one a line;
    /// one camera on a line: its position is known (GPS).
    ///
    /// For --model calibrated and focal. Cameras are called what the graph calls them. The vectors
    /// are known in the frame of the directions. Three numbers behind each pair (the vector from the
    /// first to the second) and each camera (its position): the answer is about these vectors.
    #[arg(long, value_name = "FILE")]
    displacements: Option<PathBuf>,
}

impl DisplacementArguments {
    /// The file.
    pub(super) fn path(&self) -> Option<&Path> {
        self.displacements.as_deref()
    }

    /// Refuses other models, and options (each with whether it is there) that know nothing of
    /// displacements.
    ///
    /// # Errors
    /// What does not go together.
    pub(super) fn check(&self, model: Model, others: &[(&str, bool)]) -> Result<()> {
        if self.path().is_none() {
            return Ok(());
        }
        ensure!(
            model == Model::Calibrated,
            "{OPTION}: a distance means something between calibrated cameras only; say --model \
             calibrated (or focal), or leave out {OPTION}"
        );
        let refused = others.iter().find(|(_, there)| *there);
        if let Some((other, _)) = refused {
            bail!("{OPTION}: {other} knows nothing of displacements; leave out one of the two");
        }
        Ok(())
    }

    /// Why there cannot be several graphs, if there cannot.
    pub(super) fn too_many(&self, what: &str) -> Option<String> {
        let file = self.path()?.display();
        Some(format!(
            "{OPTION} {file}: the displacements are those of one graph, and there are {what}; run \
             them one by one"
        ))
    }

    /// The displacements of a graph, and the graph with the notes on the file; nothing without the
    /// option.
    ///
    /// # Errors
    /// Those of the file.
    pub(super) fn read(&self, input: &NamedGraph) -> Result<Option<(NamedGraph, Displacements)>> {
        let Some(path) = self.path() else {
            return Ok(None);
        };
        let found = read_displacements(path, input)?;
        let mut input = input.clone();
        input.notes.extend(found.notes);
        Ok(Some((input, found.known)))
    }
}
