//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::io::Cursor;
use std::path::Path;
use viewcert::certificate::hex;
use viewcert::graph::sha256;
use viewcert_check::{Certificate, Failure, Graph, Rejection, Verified};
use viewcert_formats::read::graphs;
use viewcert_formats::{ReadOptions, read_displacements, read_graphs};

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
/// itself; what it refuses (MATLAB, MatrixMarket, sparse6, gzip), or what is said to be of some
/// format, comes through this program's reader, of several graphs the one that is named. With a file
/// of displacements these have to be what the certificate supposes.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    options: ReadOptions,
    displacements: Option<&Path>,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let expected = displacements.map(|file| supposed(&certificate, path, &options, file));
    let expected = expected.transpose()?;
    let graph = graph_at(&certificate, path, options)?;
    let verified = match certificate.check(Some(&graph)) {
        Ok(verified) => verified,
        Err(failure) => return Ok(Err(failure)),
    };
    let known = verified.displacements.as_ref().map(|known| &known.sha256);
    if expected.is_some() && known != expected.as_ref() {
        let reason = match known {
            Some(_) => "other displacements are supposed to be known than those of the file",
            None => "no displacements are supposed to be known",
        };
        return Ok(Err(Failure::Rejected(Rejection {
            step: "displacements".into(),
            reason: reason.into(),
        })));
    }
    Ok(Ok(Proved::new(&verified)))
}

/// The hash of the displacements in a file, in the names of the graph that a certificate is about.
///
/// # Errors
/// If there is no such graph; those of the file.
fn supposed(
    certificate: &Certificate,
    path: &Path,
    options: &ReadOptions,
    file: &Path,
) -> Result<String> {
    let name = path
        .to_str()
        .context("the path of the graph is not UTF-8")?;
    let mut first = None;
    for input in read_graphs(name, options) {
        let input = input?;
        let wanted = hex(&sha256(&input.graph)) == certificate.graph_sha256();
        if wanted || first.is_none() {
            first = Some(input);
        }
        if wanted {
            break;
        }
    }
    let input = first.with_context(|| format!("{name}: the file holds no graph"))?;
    Ok(hex(&read_displacements(file, &input)?.known.sha256()))
}

/// The graph in a file that a certificate is about; see [`check_for`].
///
/// # Errors
/// If there is no such graph.
pub(crate) fn graph_at(
    certificate: &Certificate,
    path: &Path,
    options: ReadOptions,
) -> Result<Graph> {
    // A folder may be a model.
    let bytes = if path.is_dir() {
        Vec::new()
    } else {
        super::read(path)?
    };
    let own = match options {
        ReadOptions {
            format: None,
            variable: None,
            tracks: None,
            ..
        } => Graph::read(&bytes, || Some(certificate.graph_sha256())).ok(),
        _ => None,
    };
    match own {
        Some(graph) => Ok(graph),
        None => converted(certificate, bytes, path, options),
    }
}

/// The graph that a certificate is about, or else the first one, by this program's reader.
fn converted(
    certificate: &Certificate,
    bytes: Vec<u8>,
    path: &Path,
    options: ReadOptions,
) -> Result<Graph> {
    let name = path.display().to_string();
    let mut first = None;
    // Some formats are read from their place only.
    let inputs = match path.to_str().filter(|_| path.is_file() || path.is_dir()) {
        Some(path) => read_graphs(path, &options),
        None => graphs(name.clone(), Cursor::new(bytes), options),
    };
    for input in inputs {
        let graph = input?.graph;
        let wanted = hex(&sha256(&graph)) == certificate.graph_sha256();
        if wanted || first.is_none() {
            first = Some(graph);
        }
        if wanted {
            break;
        }
    }
    let graph = first.with_context(|| format!("{name}: the file holds no graph"))?;
    let pairs = graph.edges().iter().copied();
    Graph::new(graph.nodes(), pairs).with_context(|| name)
}
