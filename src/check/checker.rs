//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::io::Cursor;
use std::path::Path;
use viewcert::certificate::hex;
use viewcert::graph::sha256;
use viewcert_check::{Certificate, Failure, Graph, Labels, Rejection, Verdict, Verified};
use viewcert_formats::read::graphs;
use viewcert_formats::{
    ListOptions, NamedGraph, ReadError, ReadOptions, read_displacements, read_graphs, read_parts,
};

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

/// Files of what is known besides the pairs.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub(super) parts: Option<&'a Path>,
    pub(super) displacements: Option<&'a Path>,
}

/// What a certificate proves about the graph in a file. The checker reads edge lists and graph6 by
/// itself; what it refuses (MATLAB, MatrixMarket, sparse6, gzip), or what is said to be of some
/// format, comes through this program's reader, of several graphs the one that is named. Known parts,
/// and displacements of a file, have to be those that the certificate supposes.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    known: Known,
    options: ReadOptions,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let expected = known.displacements;
    let expected = expected.map(|file| supposed(&certificate, path, &options, file));
    let expected = expected.transpose()?;
    let graph = graph_at(&certificate, path, known.parts, options)?;
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
    let input = meant(certificate, read_graphs(name, options), name)?;
    Ok(hex(&read_displacements(file, &input)?.known.sha256()))
}

/// The graph that a certificate is about, or else the first one.
fn meant(
    certificate: &Certificate,
    inputs: impl Iterator<Item = Result<NamedGraph, ReadError>>,
    name: &str,
) -> Result<NamedGraph> {
    let mut first = None;
    for input in inputs {
        let input = input?;
        let wanted = hex(&sha256(&input.graph)) == certificate.graph_sha256();
        if wanted {
            return Ok(input);
        }
        first.get_or_insert(input);
    }
    first.with_context(|| format!("{name}: the file holds no graph"))
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
            ref list,
            ..
        } if *list == ListOptions::default() => {
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
    // Some formats are read from their place only.
    let inputs = match path.to_str().filter(|_| path.is_file() || path.is_dir()) {
        Some(path) => read_graphs(path, &options),
        None => graphs(name.clone(), Cursor::new(bytes), options),
    };
    let input = meant(certificate, inputs, &name)?;
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
