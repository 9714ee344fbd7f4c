//! The independent checker.

use crate::decided::{known_displacements, of_words};
use crate::errors::{InputError, Rejected, of_any, of_checking};
use crate::graph::Graph;
use crate::work::Job;
use anyhow::Context;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use viewcert::Known;
use viewcert::certificate::hex;
use viewcert::graph::{Displacements, sha256};
use viewcert::intrinsics::Sensors;
use viewcert_check::program::{is_certificate, no_certificate};
use viewcert_check::{
    BaseLines, Certificate, Failure, IntrinsicsCertificate, Limits, OwnFrame, Strength, Unreadable,
};
use viewcert_formats::{NamedGraph, ReadOptions, read_meant, with_rigs};

/// What a certificate proves.
#[pyclass(frozen, get_all, module = "viewcert._native")]
pub(crate) struct Verified {
    /// The answer.
    value: String,
    /// `proof` or `error-bound`.
    strength: &'static str,
    /// The exponent of the error bound.
    error_log2: Option<i64>,
    /// The generic rank.
    rank: i64,
    /// The rank of a finite solvable graph with as many nodes.
    required: i64,
    /// The number of maximal components.
    components: usize,
    /// Nodes of the graph.
    nodes: usize,
    /// Its pairs.
    edges: usize,
    /// Its hash.
    sha256: String,
    /// How many known parts are taken for given.
    parts: usize,
    /// Between how many sets of nodes displacements are taken for given.
    displacements: usize,
    /// What frames add where base lines are unknown: the answer, if the certificate has one.
    base_lines: Option<&'static str>,
    /// What is determined beside displacements in a frame of their own: the answer, if the certificate has
    /// one.
    own_frame: Option<&'static str>,
    /// The question.
    model: String,
    /// All of it in words.
    text: String,
}

impl From<viewcert_check::Verified> for Verified {
    fn from(verified: viewcert_check::Verified) -> Self {
        let (value, strength) = verified.verdict;
        let (strength, error_log2) = of_strength(strength);
        Self {
            value: value.to_string(),
            strength,
            error_log2,
            rank: verified.rank.0,
            required: verified.required,
            components: verified.components.0,
            nodes: verified.nodes,
            edges: verified.edges,
            parts: verified.parts,
            displacements: verified
                .displacements
                .as_ref()
                .map_or(0, |known| known.groups)
                + verified.own_frame.as_ref().map_or(0, |known| known.groups),
            base_lines: verified.base_lines.as_ref().map(BaseLines::value),
            own_frame: verified.own_frame.as_ref().map(OwnFrame::value),
            model: verified.model.to_string(),
            text: verified.to_string(),
            sha256: verified.sha256,
        }
    }
}

/// Where the graph comes from that a certificate is checked for.
enum Given {
    /// From the certificate.
    Held,
    /// From memory, with known parts and displacements.
    Graph(Arc<NamedGraph>, Vec<Vec<u32>>, Known),
    /// From a file.
    File(PathBuf),
}

/// Why a certificate was not verified.
enum Problem {
    Failure(Failure),
    Graph(Unreadable),
    File(anyhow::Error),
}

impl Problem {
    /// As an exception.
    fn raised(self) -> PyErr {
        match self {
            Self::Failure(failure) => of_checking(failure),
            Self::Graph(error) => InputError::new_err(error.to_string()),
            Self::File(error) => of_any(&error),
        }
    }
}

/// A graph as the checker takes it.
fn for_checker(input: &NamedGraph) -> Result<viewcert_check::Graph, Problem> {
    let edges = input.graph.edges().iter().copied();
    viewcert_check::Graph::new(input.graph.nodes(), edges).map_err(Problem::Graph)
}

/// A strength in a word, and the exponent of its error bound.
pub(crate) fn of_strength(strength: Strength) -> (&'static str, Option<i64>) {
    match strength {
        Strength::Proof => ("proof", None),
        Strength::ErrorBound(exponent) => ("error-bound", Some(exponent)),
    }
}

/// The graph in a file that a certificate is about, of several the one with its hash.
///
/// # Errors
/// If the file cannot be read, or holds no graph.
fn graph_in_file(certificate: &Certificate, path: &Path) -> anyhow::Result<viewcert_check::Graph> {
    let is_meant = |input: &NamedGraph| hex(&sha256(&input.graph)) == certificate.graph_sha256();
    let found = read_meant(path, &ReadOptions::default(), is_meant)?;
    let no_graph = || format!("{}: the file holds no graph", path.display());
    let input = found.with_context(no_graph)?;
    let pairs = input.graph.edges().iter().copied();
    Ok(viewcert_check::Graph::new(input.graph.nodes(), pairs)?)
}

/// Verifies a certificate.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // One a keyword.
#[pyo3(signature = (
    certificate,
    *,
    graph=None,
    parts=None,
    displacements=None,
    vectors=None,
    one_frame=false,
    file=None,
    max_operations=None
))]
pub(crate) fn check(
    py: Python<'_>,
    certificate: Vec<u8>,
    graph: Option<&Graph>,
    parts: Option<Vec<Vec<u32>>>,
    displacements: Option<Vec<Vec<u32>>>,
    vectors: Option<Vec<[String; 3]>>,
    one_frame: bool,
    file: Option<PathBuf>,
    max_operations: Option<u64>,
) -> PyResult<Verified> {
    let given = match (graph, file) {
        (Some(graph), _) => {
            let nodes = graph.0.graph.nodes() as u32;
            let groups = displacements.unwrap_or_default();
            let known = known_displacements(nodes, &groups, vectors.as_deref())?;
            let known = match one_frame || known.is_empty() {
                true => Known::Displacements(known),
                false => Known::OwnFrame {
                    given: known,
                    rigs: Displacements::default(),
                },
            };
            let known = with_rigs(known, &graph.0);
            let known = known.map_err(|error| InputError::new_err(error.to_string()))?;
            Given::Graph(Arc::clone(&graph.0), parts.unwrap_or_default(), known)
        }
        (None, Some(file)) => Given::File(file),
        (None, None) => Given::Held,
    };
    if !is_certificate(&certificate) {
        return Err(Rejected::new_err(("", no_certificate(false))));
    }
    let limits = limits(max_operations);
    let checked = Job::new(py)?.run(py, move || {
        let certificate = Certificate::parse(&certificate).map_err(Problem::Failure)?;
        let graph = match given {
            Given::Held => None,
            Given::Graph(input, parts, known) => {
                let graph = for_checker(&input)?.with_parts(parts);
                let mut graph = graph.map_err(Problem::Graph)?;
                if let Some(hash) = input.frames.as_ref().and_then(|frames| frames.sha256()) {
                    graph = graph.with_frames(hex(&hash));
                }
                let (known, given) = match known {
                    Known::OwnFrame { given, rigs } => (rigs, Some(given)),
                    Known::Displacements(known) => (known, None),
                    Known::Parts(_) => (Displacements::default(), None),
                };
                if let Some(given) = given {
                    graph = graph.with_own_frame(hex(&given.sha256()));
                }
                Some(if known.is_empty() {
                    graph
                } else {
                    graph.with_displacements(hex(&known.sha256()))
                })
            }
            Given::File(path) => {
                let graph = graph_in_file(&certificate, &path);
                Some(graph.map_err(Problem::File)?)
            }
        };
        let checked = certificate.check_within(graph.as_ref(), &limits);
        checked.map_err(Problem::Failure)
    })?;
    checked.map(Into::into).map_err(Problem::raised)
}

/// What a certificate of intrinsics proves.
#[pyclass(frozen, get_all, module = "viewcert._native")]
pub(crate) struct VerifiedIntrinsics {
    /// `metric`, `not-metric` or `open`.
    value: &'static str,
    /// What the generic rank is not below.
    rank: i64,
    /// What it is not above.
    rank_at_most: i64,
    /// The rank of a metric graph.
    required: i64,
    /// The numbers of the nodes of each metric component, if the bounds meet.
    components: Option<Vec<Vec<u32>>>,
    /// Those of the nodes whose intrinsics are not determined, if the bounds meet.
    not_determined: Option<Vec<u32>>,
    /// How many cameras are of which class.
    classes: Vec<(usize, &'static str)>,
    /// Their hash.
    classes_sha256: String,
    /// Nodes of the graph.
    nodes: usize,
    /// Its pairs.
    edges: usize,
    /// Its hash.
    sha256: String,
    /// All of it in words.
    text: String,
}

/// Verifies a certificate of intrinsics, for a graph and what is known of its intrinsics if it is given:
/// a class for each sensor, and the sensor of each node.
#[pyfunction]
#[pyo3(signature = (certificate, *, graph=None, sensors=None, max_operations=None))]
pub(crate) fn check_intrinsics(
    py: Python<'_>,
    certificate: Vec<u8>,
    graph: Option<&Graph>,
    sensors: Option<(Vec<String>, Vec<usize>)>,
    max_operations: Option<u64>,
) -> PyResult<VerifiedIntrinsics> {
    let hash = |(words, of_node): (Vec<String>, _)| -> PyResult<String> {
        Ok(hex(&Sensors::new(of_node, of_words(&words)?).sha256()))
    };
    let hash = sensors.map(hash).transpose()?;
    let verified = checked(py, graph, max_operations, move |graph, limits| {
        IntrinsicsCertificate::parse(&certificate)?.check_within(graph, hash.as_deref(), limits)
    })?;
    Ok(verified.into())
}

/// What a check proves that is done for a graph, if it is given, within limits.
pub(crate) fn checked<T: Send + 'static>(
    py: Python<'_>,
    graph: Option<&Graph>,
    max_operations: Option<u64>,
    check: impl FnOnce(Option<&viewcert_check::Graph>, &Limits) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let input = graph.map(|graph| Arc::clone(&graph.0));
    let limits = limits(max_operations);
    let checked = Job::new(py)?.run(py, move || {
        let graph = input.map(|input| for_checker(&input)).transpose()?;
        check(graph.as_ref(), &limits).map_err(Problem::Failure)
    })?;
    checked.map_err(Problem::raised)
}

/// The limits of a check that may take so many operations.
fn limits(max_operations: Option<u64>) -> Limits {
    let mut limits = Limits::default();
    limits.operations = max_operations.unwrap_or(limits.operations);
    limits
}

impl From<viewcert_check::VerifiedIntrinsics> for VerifiedIntrinsics {
    fn from(verified: viewcert_check::VerifiedIntrinsics) -> Self {
        Self {
            text: verified.to_string(),
            value: verified.verdict,
            rank: verified.rank[0],
            rank_at_most: verified.rank[1],
            required: verified.required,
            components: verified.components,
            not_determined: verified.not_determined,
            classes: verified.classes,
            classes_sha256: verified.classes_sha256,
            nodes: verified.size[0],
            edges: verified.size[1],
            sha256: verified.sha256,
        }
    }
}
