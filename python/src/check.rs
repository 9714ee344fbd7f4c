//! The independent checker, on certificates of every kind.

use crate::decided::{Beside, of_words};
use crate::errors::{Rejected, of_any, of_checking};
use crate::graph::Graph;
use crate::work::Job;
use anyhow::Context;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use viewcert::Known;
use viewcert::certificate::hex;
use viewcert::graph::sha256;
use viewcert::intrinsics::Sensors;
use viewcert_check::program::{is_certificate, no_certificate};
use viewcert_check::{
    Answer, BaseLines, Certificate, Failure, Graph as Pairs, Limits, OwnFrame, Question, Strength,
};
use viewcert_formats::{NamedGraph, ReadOptions, read_meant};

/// A graph as the checker takes it.
fn pairs_of(input: &NamedGraph) -> anyhow::Result<Pairs> {
    let pairs = input.graph.edges().iter().copied();
    Ok(Pairs::new(input.graph.nodes(), pairs)?)
}

/// The graph with what is known besides, frames included, which the check compares.
fn with_known(input: &NamedGraph, parts: Vec<Vec<u32>>, known: Known) -> anyhow::Result<Pairs> {
    let mut graph = pairs_of(input)?.with_parts(parts)?;
    if let Some(hash) = input.frames.as_ref().and_then(|frames| frames.sha256()) {
        graph = graph.with_frames(hex(&hash));
    }
    let known = match known {
        Known::OwnFrame { given, rigs } => {
            graph = graph.with_own_frame(hex(&given.sha256()));
            rigs
        }
        Known::Displacements(known) => known,
        Known::Parts(_) => return Ok(graph),
    };
    Ok(match known.is_empty() {
        true => graph,
        false => graph.with_displacements(hex(&known.sha256())),
    })
}

/// The graph in a file that a certificate is about, of several the one with its hash.
fn in_file(certificate: &Certificate, path: &Path) -> anyhow::Result<Pairs> {
    let is_meant = |input: &NamedGraph| hex(&sha256(&input.graph)) == certificate.graph_sha256();
    let found = read_meant(path, &ReadOptions::default(), is_meant)?;
    let no_graph = || format!("{}: the file holds no graph", path.display());
    pairs_of(&found.with_context(no_graph)?)
}

/// Verifies a certificate, for a graph with what is known besides, or in a file; and for cameras with a hash, or a
/// class for each sensor and the sensor of each node. What it proves.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
#[pyo3(signature = (
    certificate, *, graph=None, beside=None, file=None, centres=None, sensors=None, max_operations=None
))]
pub(crate) fn check<'py>(
    py: Python<'py>,
    certificate: Vec<u8>,
    graph: Option<&Graph>,
    beside: Option<Beside>,
    file: Option<PathBuf>,
    centres: Option<String>,
    sensors: Option<(Vec<String>, Vec<usize>)>,
    max_operations: Option<u64>,
) -> PyResult<Bound<'py, PyDict>> {
    if !is_certificate(&certificate) {
        return Err(rejected("", no_certificate(false)));
    }
    let is_for_graph = graph.is_some() || file.is_some();
    let beside = beside.unwrap_or_default();
    let given = graph.map(|graph| -> PyResult<_> {
        let known = beside.displaced(&graph.0)?;
        Ok((
            Arc::clone(&graph.0),
            beside.parts.unwrap_or_default(),
            known,
        ))
    });
    let given = given.transpose()?;
    let classes = sensors.map(|(words, of_node)| -> PyResult<String> {
        Ok(hex(&Sensors::new(of_node, of_words(&words)?).sha256()))
    });
    let classes = classes.transpose()?;
    let mut limits = Limits::default();
    limits.operations = max_operations.unwrap_or(limits.operations);
    let checked = Job::new(py)?.run(py, move || -> anyhow::Result<Answer> {
        let certificate = Certificate::parse(&certificate)?;
        let is_generic = certificate.question() == Question::Generic;
        let graph = match (given, file) {
            (Some((input, parts, known)), _) if is_generic => {
                Some(with_known(&input, parts, known)?)
            }
            (Some((input, ..)), _) => Some(pairs_of(&input)?),
            (None, Some(path)) => Some(in_file(&certificate, &path)?),
            (None, None) => None,
        };
        Ok(certificate.check(graph.as_ref(), None, &limits)?)
    })?;
    let verified = checked.map_err(|error| match error.downcast::<Failure>() {
        Ok(failure) => of_checking(failure),
        Err(error) => of_any(&error),
    })?;
    let (of_cameras, of_classes) = match &verified {
        Answer::AtCameras(found) => (Some(&found.centres_sha256), None),
        Answer::Intrinsics(found) => (None, Some(&found.classes_sha256)),
        _ => (None, None),
    };
    named("cameras", of_cameras, centres, is_for_graph)?;
    named("classes", of_classes, classes, is_for_graph)?;
    said(py, &verified)
}

/// Refuses hypotheses that are others than those that are named, or are not named although a graph is.
fn named(
    what: &str,
    found: Option<&String>,
    named: Option<String>,
    is_for_graph: bool,
) -> PyResult<()> {
    match (found, named) {
        (Some(found), Some(named)) if *found != named => Err(rejected(
            what,
            &format!("the {what} that are expected have another hash"),
        )),
        (Some(_), None) if is_for_graph => Err(rejected(
            what,
            &format!("it supposes {what}, and none are named: give them as well"),
        )),
        (None, Some(_)) => Err(rejected(what, &format!("it supposes no {what}"))),
        _ => Ok(()),
    }
}

fn rejected(step: &str, reason: &str) -> PyErr {
    Rejected::new_err((step.to_owned(), reason.to_owned()))
}

/// What is proved, by the names of `viewcert.Verified`.
fn said<'py>(py: Python<'py>, verified: &Answer) -> PyResult<Bound<'py, PyDict>> {
    let said = PyDict::new(py);
    let ([nodes, edges], sha256) = verified.graph();
    said.set_item("nodes", nodes)?;
    said.set_item("edges", edges)?;
    said.set_item("sha256", sha256)?;
    said.set_item("value", verified.verdict())?;
    said.set_item("model", verified.model().to_string())?;
    said.set_item("text", verified.to_string())?;
    let (rank, required, components, strength) = match verified {
        Answer::Generic(found) => {
            let known = found.displacements.as_ref().map_or(0, |known| known.groups);
            let own = found.own_frame.as_ref().map_or(0, |known| known.groups);
            said.set_item("parts", found.parts)?;
            said.set_item("displacements", known + own)?;
            said.set_item(
                "base_lines",
                found.base_lines.as_ref().map(BaseLines::value),
            )?;
            said.set_item("own_frame", found.own_frame.as_ref().map(OwnFrame::value))?;
            let components = Some(found.components.0);
            (found.rank.0, found.required, components, found.verdict.1)
        }
        Answer::AtCameras(found) => {
            said.set_item("centres_sha256", &found.centres_sha256)?;
            let components = Some(found.components.0);
            (found.rank.0, found.required, components, found.rank.1)
        }
        Answer::Intrinsics(found) => {
            said.set_item("classes_sha256", &found.classes_sha256)?;
            said.set_item("classes", &found.classes)?;
            said.set_item("rank_at_most", found.rank[1])?;
            said.set_item("not_determined", found.not_determined.as_deref())?;
            let components = found.components.as_ref().map(Vec::len);
            (found.rank[0], found.required, components, Strength::Proof)
        }
        Answer::Contradictions(_) => {
            let reason = "it is about motions, and not about a graph: `verify check` verifies it";
            return Err(rejected("", reason));
        }
    };
    let (strength, error_log2) = match strength {
        Strength::Proof => ("proof", None),
        Strength::ErrorBound(exponent) => ("error-bound", Some(exponent)),
    };
    said.set_item("rank", rank)?;
    said.set_item("required", required)?;
    said.set_item("components", components)?;
    said.set_item("strength", strength)?;
    said.set_item("error_log2", error_log2)?;
    Ok(said)
}
