//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::io::Cursor;
use std::path::Path;
use viewcert::certificate::hex;
use viewcert::graph::sha256;
use viewcert_check::{Certificate, Failure, Graph, Verdict, Verified};
use viewcert_formats::read::graphs;
use viewcert_formats::{ReadOptions, read_graphs};

/// What a certificate proves.
pub(super) struct Proved {
    /// The hash of the graph.
    pub(super) sha256: String,
    /// The verdict.
    pub(super) verdict: String,
    /// The number of solutions, or bounds for it, if there are finitely many: "2", "1-3", "1-".
    pub(super) solutions: Option<String>,
    /// All of it in words, on several lines.
    pub(super) text: String,
}

impl Proved {
    fn new(verified: &Verified) -> Self {
        Self {
            sha256: verified.sha256.clone(),
            verdict: verified.verdict.0.to_string(),
            solutions: solutions(verified),
            text: verified.to_string(),
        }
    }
}

/// What is proved of the number of solutions; a number is proved by `solvable` as well.
fn solutions(verified: &Verified) -> Option<String> {
    match (verified.verdict.0, verified.solutions) {
        (Verdict::NotFiniteSolvable, _) => None,
        (Verdict::Solvable, _) => Some("1".into()),
        (Verdict::FiniteSolvable, None) => Some("1-".into()),
        (Verdict::FiniteSolvable, Some(count)) => Some(match count.at_most {
            Some(most) if most == count.at_least => most.to_string(),
            Some(most) => format!("{}-{most}", count.at_least),
            None => format!("{}-", count.at_least),
        }),
    }
}

/// What a certificate proves about the graph that it holds; otherwise why it is rejected.
pub(super) fn check(text: &[u8]) -> Result<Proved, Failure> {
    viewcert_check::check(text, None).map(|verified| Proved::new(&verified))
}

/// What a certificate proves about the graph in a file. The checker reads edge lists and graph6 by
/// itself; what it refuses (MATLAB, MatrixMarket, sparse6, gzip), or what is said to be of some
/// format, comes through this program's reader, of several graphs the one that is named.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    options: ReadOptions,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let graph = graph_at(&certificate, path, options)?;
    Ok(certificate
        .check(Some(&graph))
        .map(|verified| Proved::new(&verified)))
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
