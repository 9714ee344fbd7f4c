//! All calls of the independent checker.

use crate::graph::{ReadOptions, matlab, read_graphs};
use anyhow::{Context, Result, bail};
use std::path::Path;
use viewcert_check::{Certificate, Failure, Graph, Verified};

/// What a certificate proves.
pub(super) struct Proved {
    /// The hash of the graph.
    pub(super) sha256: String,
    /// The verdict.
    pub(super) verdict: String,
    /// All of it in words, on several lines.
    pub(super) text: String,
}

impl Proved {
    fn new(verified: &Verified) -> Self {
        Self {
            sha256: verified.sha256.clone(),
            verdict: verified.verdict.0.to_string(),
            text: verified.to_string(),
        }
    }
}

/// What a certificate proves about the graph that it holds; otherwise why it is rejected.
pub(super) fn check(text: &[u8]) -> Result<Proved, Failure> {
    viewcert_check::check(text, None).map(|verified| Proved::new(&verified))
}

/// What a certificate proves about the graph in a file. The checker reads edge lists and graph6 by
/// itself; it does not read MATLAB files, which come through this program's reader.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(text: &[u8], path: &Path) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let bytes = super::read(path)?;
    let graph = if matlab::is_matlab(&bytes) {
        let name = path
            .to_str()
            .context("the name of the graph's file is not UTF-8")?;
        let Some(input) = read_graphs(name, &ReadOptions::default()).next() else {
            bail!("{name}: no graph");
        };
        let graph = input?.graph;
        Graph::new(graph.nodes(), graph.edges().iter().copied())
    } else {
        Graph::read(&bytes, || Some(certificate.graph_sha256()))
    };
    let graph = graph.with_context(|| path.display().to_string())?;
    Ok(certificate
        .check(Some(&graph))
        .map(|verified| Proved::new(&verified)))
}
