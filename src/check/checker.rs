//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::io::Cursor;
use std::path::Path;
use viewcert::certificate::hex;
use viewcert::graph::sha256;
use viewcert_check::{Certificate, Failure, Graph, Labels, Verified};
use viewcert_formats::read::graphs;
use viewcert_formats::{ReadOptions, read_graphs, read_parts};

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

/// What a certificate proves about the graph that it holds, with the known parts of a file, which
/// are sets of node numbers.
///
/// # Errors
/// If there are no such parts.
pub(super) fn check_with_parts(text: &[u8], parts: &Path) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let held = certificate.held_graph().ok().flatten();
    let held = held.map(|graph| of_file(graph, parts, &Labels::Numbers));
    let checked = certificate.check(held.transpose()?.as_ref());
    Ok(checked.map(|verified| Proved::new(&verified)))
}

/// A graph with the known parts of a file, read by the checker.
fn of_file(graph: Graph, parts: &Path, labels: &Labels) -> Result<Graph> {
    let file = super::read(parts)?;
    let graph = graph.with_parts_of(&file, labels);
    graph.with_context(|| parts.display().to_string())
}

/// What a certificate proves about the graph in a file, with the known parts of another one. The checker reads edge lists and graph6 by
/// itself; what it refuses (MATLAB, MatrixMarket, sparse6, gzip), or what is said to be of some
/// format, comes through this program's reader, of several graphs the one that is named.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    parts: Option<&Path>,
    options: ReadOptions,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let graph = graph_at(&certificate, path, parts, options)?;
    Ok(certificate
        .check(Some(&graph))
        .map(|verified| Proved::new(&verified)))
}

/// The graph in a file that a certificate is about; see [`check_for`].
///
/// # Errors
/// If there is no such graph, or no such parts.
pub(crate) fn graph_at(
    certificate: &Certificate,
    path: &Path,
    parts: Option<&Path>,
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
        } => {
            let wanted = || Some(certificate.graph_sha256());
            match parts {
                None => Graph::read(&bytes, wanted).map(|graph| (graph, Labels::Numbers)),
                Some(_) => Graph::read_labelled(&bytes, false, wanted),
            }
            .ok()
        }
        _ => None,
    };
    match (own, parts) {
        (Some((graph, _)), None) => Ok(graph),
        (Some((graph, labels)), Some(parts)) => of_file(graph, parts, &labels),
        (None, parts) => converted(certificate, bytes, (path, parts), options),
    }
}

/// The graph that a certificate is about, or else the first one, and its known parts, by this
/// program's readers.
fn converted(
    certificate: &Certificate,
    bytes: Vec<u8>,
    (path, parts): (&Path, Option<&Path>),
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
    let pairs = input.graph.edges().iter().copied();
    let graph = Graph::new(input.graph.nodes(), pairs).with_context(|| name)?;
    let Some(parts) = parts else {
        return Ok(graph);
    };
    let found = read_parts(parts, &input)?.parts;
    let lists = found.iter().map(<[u32]>::to_vec);
    graph
        .with_parts(lists)
        .with_context(|| parts.display().to_string())
}
