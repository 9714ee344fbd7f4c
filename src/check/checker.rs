//! All calls of the independent checker.

use anyhow::{Context, Result};
use std::path::Path;
use viewcert::Known;
use viewcert::certificate::hex;
use viewcert::graph::{Labels, sha256};
use viewcert_check::{
    Certificate, Failure, Graph, HereCertificate, IntrinsicsCertificate, Limits, Model, Verdict,
    Verified, VerifiedHere, VerifiedIntrinsics, is_here, is_of_intrinsics,
};
use viewcert_formats::{NamedGraph, ReadOptions, read_meant};

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
    /// The model, if it is about pairs alone, with nothing given.
    pub(super) of_pairs: Option<Model>,
    /// Whether it takes known parts, displacements or base lines for given.
    pub(super) supposes: bool,
    /// The generic rank.
    pub(super) rank: i64,
    /// The rank at which the graph is finite solvable.
    pub(super) required: i64,
    /// The number of components.
    pub(super) components: usize,
}

impl Proved {
    fn new(verified: &Verified) -> Self {
        let supposes =
            verified.parts > 0 || verified.displacements.is_some() || verified.base_lines.is_some();
        Self {
            sha256: verified.sha256.clone(),
            verdict: verified.verdict.0.to_string(),
            solutions: solutions(verified),
            text: verified.to_string(),
            of_pairs: (verified.parts == 0 && verified.displacements.is_none())
                .then_some(verified.model),
            supposes,
            rank: verified.rank.0,
            required: verified.required,
            components: verified.components.0,
        }
    }

    fn of_intrinsics(verified: &VerifiedIntrinsics) -> Self {
        Self {
            sha256: verified.sha256.clone(),
            verdict: verified.verdict.into(),
            solutions: None,
            text: verified.to_string(),
            of_pairs: None,
            supposes: false,
            rank: verified.rank[0],
            required: verified.required,
            components: verified.components.as_ref().map_or(0, Vec::len),
        }
    }

    fn of_here(verified: &VerifiedHere) -> Self {
        let is = if verified.is_determined {
            "determined"
        } else {
            "not-determined"
        };
        Self {
            sha256: verified.sha256.clone(),
            verdict: is.into(),
            solutions: None,
            text: verified.to_string(),
            of_pairs: None,
            supposes: false,
            rank: verified.rank.0,
            required: verified.required,
            components: verified.components.0 as usize,
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
    if is_of_intrinsics(text) {
        let certificate = IntrinsicsCertificate::parse(text)?;
        let verified = certificate.check_within(None, None, &Limits::default())?;
        return Ok(Proved::of_intrinsics(&verified));
    }
    if is_here(text) {
        let certificate = HereCertificate::parse(text)?;
        let verified = certificate.check_within(None, &Limits::default())?;
        return Ok(Proved::of_here(&verified));
    }
    viewcert_check::check(text, None).map(|verified| Proved::new(&verified))
}

/// The checker's graph with what is given of it, in node numbers.
fn with_given(graph: Graph, given: Option<&Path>, input: &NamedGraph) -> Result<Graph> {
    let graph = match input.frames.as_ref().and_then(|frames| frames.sha256()) {
        Some(hash) => graph.with_frames(hex(&hash)),
        None => graph,
    };
    Ok(match viewcert_formats::given(given, input)?.known {
        Known::Parts(parts) => {
            let graph = graph.with_parts(parts.iter().map(<[u32]>::to_vec));
            let file = given.map_or(&*input.name, |file| file.to_str().unwrap_or_default());
            graph.with_context(|| file.to_owned())?
        }
        Known::Displacements(known) => graph.with_displacements(hex(&known.sha256())),
    })
}

/// What a certificate proves about the graph that it holds, with what a file gives, which calls nodes by
/// their numbers.
///
/// # Errors
/// If the file gives no such thing.
pub(super) fn check_given(text: &[u8], given: &Path) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    // Where the certificate holds no graph, it is rejected for that.
    let held = match certificate.held_graph() {
        Ok(Some(graph)) => {
            let nodes = viewcert::Graph::new(u32::try_from(graph.nodes())?, [])?;
            let input = NamedGraph::new("", nodes, Labels::Numbers { first: 0 });
            Some(with_given(graph, Some(given), &input)?)
        }
        _ => None,
    };
    let checked = certificate.check(held.as_ref());
    Ok(checked.map(|verified| Proved::new(&verified)))
}

/// What a certificate proves about the graph in a file, of several the one that is named. What
/// is given has to be what the certificate supposes.
///
/// # Errors
/// If there is no such graph.
pub(super) fn check_for(
    text: &[u8],
    path: &Path,
    given: Option<&Path>,
    options: &ReadOptions,
) -> Result<Result<Proved, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let graph = graph_at(certificate.graph_sha256(), path, given, options)?;
    let checked = certificate.check(Some(&graph));
    Ok(checked.map(|verified| Proved::new(&verified)))
}

/// The graph in a file that a certificate is about, or else the first one, with what is known of it.
///
/// # Errors
/// If there is no such graph, or nothing of the kind is known.
pub(super) fn graph_at(
    hash: &str,
    path: &Path,
    given: Option<&Path>,
    options: &ReadOptions,
) -> Result<Graph> {
    let input = named_at(hash, path, options)?;
    with_given(graph_of(&input)?, given, &input)
}

/// The same as it was read.
///
/// # Errors
/// If there is no such graph.
pub(super) fn named_at(hash: &str, path: &Path, options: &ReadOptions) -> Result<NamedGraph> {
    let is_meant = |input: &NamedGraph| hex(&sha256(&input.graph)) == hash;
    let found = read_meant(path, options, is_meant)?;
    found.with_context(|| format!("{}: the file holds no graph", path.display()))
}

/// The checker's graph.
///
/// # Errors
/// If it is too large.
pub(super) fn graph_of(input: &NamedGraph) -> Result<Graph> {
    let pairs = input.graph.edges().iter().copied();
    let graph = Graph::new(input.graph.nodes(), pairs);
    graph.with_context(|| input.name.clone())
}
