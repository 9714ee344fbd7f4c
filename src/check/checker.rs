//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::path::Path;
use viewcert::certificate::hex;
use viewcert::graph::{Labels, sha256};
use viewcert_check::{Certificate, Failure, Graph, Verdict, Verified};
use viewcert_formats::{NamedGraph, ReadOptions, read_displacements, read_graphs, read_parts};

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
    match (verified.verdict.0, &verified.solutions) {
        (Verdict::NotFiniteSolvable, _) => None,
        (Verdict::Solvable, _) => Some("1".into()),
        (Verdict::FiniteSolvable, None) => Some("1-".into()),
        (Verdict::FiniteSolvable, Some(count)) => Some(match &count.at_most {
            Some(most) if *most == count.at_least => most.to_string(),
            Some(most) => format!("{}-{most}", count.at_least),
            None => format!("{}-", count.at_least),
        }),
    }
}

/// What a certificate proves about the graph that it holds; otherwise why it is rejected.
pub(super) fn check(text: &[u8]) -> Result<Proved, Failure> {
    viewcert_check::check(text, None).map(|verified| Proved::new(&verified))
}

/// Files of what is known besides the pairs, in the labels of the graph.
#[derive(Clone, Copy, Default)]
pub(crate) struct Known<'a> {
    pub(crate) parts: Option<&'a Path>,
    pub(crate) displacements: Option<&'a Path>,
}

impl Known<'_> {
    /// The checker's graph with what is known of it, in node numbers.
    fn of(self, graph: Graph, input: &NamedGraph) -> Result<Graph> {
        let graph = match self.parts {
            None => graph,
            Some(file) => {
                let found = read_parts(file, input)?.parts;
                let graph = graph.with_parts(found.iter().map(<[u32]>::to_vec));
                graph.with_context(|| file.display().to_string())?
            }
        };
        Ok(match self.displacements {
            None => graph,
            Some(file) => {
                let found = read_displacements(file, input)?.known;
                graph.with_displacements(hex(&found.sha256()))
            }
        })
    }
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
    // Where the certificate holds no graph, it is rejected for that.
    let held = match certificate.held_graph() {
        Ok(Some(graph)) => {
            let nodes = viewcert::Graph::new(u32::try_from(graph.nodes())?, [])?;
            let input = NamedGraph::new("", nodes, Labels::Numbers { first: 0 });
            let known = Known {
                parts: Some(parts),
                ..Known::default()
            };
            Some(known.of(graph, &input)?)
        }
        _ => None,
    };
    let checked = certificate.check(held.as_ref());
    Ok(checked.map(|verified| Proved::new(&verified)))
}

/// What a certificate proves about the graph in a file, of several the one that is named. Known
/// parts and displacements have to be those that the certificate supposes.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    known: Known,
    options: &ReadOptions,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let graph = graph_at(&certificate, path, known, options)?;
    let checked = certificate.check(Some(&graph));
    Ok(checked.map(|verified| Proved::new(&verified)))
}

/// The graph in a file that a certificate is about, or else the first one, with what is known of it.
///
/// # Errors
/// If there is no such graph, or nothing of the kind is known.
pub(crate) fn graph_at(
    certificate: &Certificate,
    path: &Path,
    known: Known,
    options: &ReadOptions,
) -> Result<Graph> {
    let (mut meant, mut first) = (None, None);
    for input in read_graphs(path, options) {
        let input = input?;
        if hex(&sha256(&input.graph)) == certificate.graph_sha256() {
            meant = Some(input);
            break;
        }
        first.get_or_insert(input);
    }
    let name = || path.display().to_string();
    let no_graph = || format!("{}: the file holds no graph", name());
    let input = meant.or(first).with_context(no_graph)?;
    let pairs = input.graph.edges().iter().copied();
    let graph = Graph::new(input.graph.nodes(), pairs).with_context(name)?;
    known.of(graph, &input)
}
