//! `verify check` on a certificate at given cameras.

use super::checker::graph_at;
use anyhow::Result;
use std::path::Path;
use viewcert_check::{Failure, HereCertificate, Limits};
use viewcert_formats::ReadOptions;

/// What a certificate proves, for the graph in a file if there is one, in words.
///
/// # Errors
/// Those of the file.
pub(super) fn check(
    text: &[u8],
    graph: Option<&Path>,
    options: &ReadOptions,
) -> Result<Result<String, Failure>> {
    let certificate = match HereCertificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let graph = graph.map(|path| graph_at(certificate.graph_sha256(), path, None, options));
    let checked = certificate.check_within(graph.transpose()?.as_ref(), &Limits::default());
    Ok(checked.map(|verified| verified.to_string()))
}
