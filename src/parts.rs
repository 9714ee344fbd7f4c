//! `--parts`: sets of cameras whose relative position is known (docs/theory.md, Theorem 4.14).
//!
//! In: a graph as it was read. Out: the known parts of the file that is named, and the graph with
//! what was noted in reading them. Whoever decides the graph passes them on.

use anyhow::{Result, ensure};
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::KnownParts;
use viewcert_formats::{NamedGraph, read_parts};

/// The option.
pub(super) const OPTION: &str = "--parts";

/// What is known of the cameras beside the pairs.
#[derive(Args)]
pub(super) struct PartArguments {
    /// Sets of cameras whose relative position is known, from trifocal tensors, rigs or partial
    /// reconstructions: one set a line, cameras called as in the graph.
    ///
    /// Each set is as good as all pairs of it, in every model, and costs no more than its cameras.
    /// Fields, quotes and comments are those of edge lists. The certificate states the sets, and
    /// `verify check` asks for the same file.
    #[arg(long, value_name = "FILE")]
    parts: Option<PathBuf>,
}

impl PartArguments {
    /// The file.
    pub(super) fn path(&self) -> Option<&Path> {
        self.parts.as_deref()
    }

    /// Refuses standard input for two things.
    ///
    /// # Errors
    /// If both a graph and the parts are `-`.
    pub(super) fn check(&self, graphs: &[PathBuf]) -> Result<()> {
        let is_input = |path: &Path| path == Path::new("-");
        let graph = graphs.iter().any(|path| is_input(path));
        ensure!(
            !(graph && self.path().is_some_and(is_input)),
            "{OPTION} -: standard input is the graph already; put the parts into a file"
        );
        Ok(())
    }

    /// Why there cannot be several graphs, if there cannot.
    pub(super) fn too_many(&self, what: &str) -> Option<String> {
        let path = self.path()?.display();
        Some(format!(
            "{OPTION} {path}: the parts are those of one graph, and there are {what}; run the \
             program on each"
        ))
    }

    /// Reads the parts of a graph; what is noted joins the notes of the graph.
    ///
    /// # Errors
    /// Those of the file.
    pub(super) fn read(&self, input: &NamedGraph) -> Result<Option<(NamedGraph, KnownParts)>> {
        let Some(path) = self.path() else {
            return Ok(None);
        };
        let found = read_parts(path, input)?;
        let mut input = input.clone();
        input.notes.extend(found.notes);
        Ok(Some((input, found.parts)))
    }
}
