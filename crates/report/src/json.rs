//! One JSON object a line.

use super::text::{self, several};
use super::tracks;
use super::tracks::TrackLine;
use super::{Report, WrittenProof};
use crate::assumptions::{BaseLines, Planar, Scope};
use crate::intrinsics::IntrinsicsLine;
use crate::own_frame::OwnFrameLine;
use serde::Serialize;
use serde_json::{Value, json, to_value};
use std::io::{self, Write};
use viewcert::certificate::hex;
use viewcert::decide::{Component, SolutionCount, Verdict};
use viewcert_advice::Advice;
use viewcert_formats::colmap::DatabaseFacts;
use viewcert_formats::{NamedGraph, ReadAs};

/// The format of the records; another one is not read as this.
const FORMAT: u32 = 1;

/// A line with what it is.
#[derive(Serialize)]
struct Signed<'a, T> {
    kind: &'static str,
    format: u32,
    /// Which program wrote it.
    program: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(flatten)]
    line: &'a T,
}

/// Writes a record of this kind as one line of JSON, with the program and its version, and the seed where cameras
/// are drawn: every `--json` is of such lines. Their schema is docs/report.schema.json.
///
/// # Errors
/// Those of the writer.
pub fn write_line(
    out: &mut impl Write,
    kind: &'static str,
    seed: Option<u64>,
    line: &impl Serialize,
) -> io::Result<()> {
    let program = json!({"name": "verify", "version": env!("CARGO_PKG_VERSION")});
    let signed = Signed {
        kind,
        format: FORMAT,
        program,
        seed,
        line,
    };
    serde_json::to_writer(&mut *out, &signed)?;
    out.write_all(b"\n")
}

/// The members of an object that are there.
pub(super) fn present(mut object: Value) -> Value {
    if let Value::Object(members) = &mut object {
        members.retain(|_, member| !member.is_null());
    }
    object
}

/// The members of an object, and those of another one.
pub(super) fn joined(mut object: Value, more: &impl Serialize) -> Value {
    if let (Value::Object(members), Ok(Value::Object(more))) = (&mut object, to_value(more)) {
        members.extend(more);
    }
    object
}

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    /// How many known parts there are; left out if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    parts: Option<usize>,
    read: &'a ReadAs,
    notes: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    database: Option<&'a DatabaseFacts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tracks: Option<TrackLine<'a>>,
    model: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    displacements: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    own_frame: Option<&'a OwnFrameLine>,
    /// What is determined without what has a frame of its own, if that is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<Value>,
    #[serde(flatten)]
    answer: AnswerLine,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    conditions: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    planar: Option<&'a Planar>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_lines: Option<&'a BaseLines>,
    #[serde(skip_serializing_if = "Option::is_none")]
    intrinsics: Option<&'a IntrinsicsLine>,
    #[serde(skip_serializing_if = "Option::is_none")]
    at_cameras: Option<Value>,
    mode: &'static str,
    seconds: f64,
    #[serde(flatten)]
    advice: &'a Advice,
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<&'a WrittenProof>,
}

/// Which graph it is.
#[derive(Serialize)]
pub struct GraphLine<'a> {
    name: &'a str,
    nodes: usize,
    edges: usize,
    sha256: String,
}

impl<'a> GraphLine<'a> {
    /// With the hash of a verdict on it.
    pub fn new(input: &'a NamedGraph, verdict: &Verdict) -> Self {
        Self::with_hash(input, &verdict.sha256)
    }

    /// Where there is no verdict. O(n + m) for the hash.
    /// The same before it is decided.
    pub fn of(input: &'a NamedGraph) -> Self {
        Self::with_hash(input, &viewcert::graph::sha256(&input.graph))
    }

    fn with_hash(input: &'a NamedGraph, hash: &[u8; 32]) -> Self {
        Self {
            name: &input.name,
            nodes: input.graph.nodes(),
            edges: input.graph.edges().len(),
            sha256: hex(hash),
        }
    }
}

/// How many known parts a verdict rests on, if any.
pub(super) fn parts(verdict: &Verdict) -> Option<usize> {
    Some(verdict.known_parts.len()).filter(|&parts| parts > 0)
}

/// Which displacements are supposed to be known, if any, and whether their vectors are given, so that the answer is
/// about these.
fn displacements(verdict: &Verdict) -> Option<Value> {
    let known = &verdict.displacements;
    (!known.is_empty()).then(|| {
        json!({
            "groups": known.groups().len(),
            "cameras": known.nodes(),
            "vectors": known.vectors().is_some(),
            "sha256": hex(&known.sha256()),
        })
    })
}

/// What is decided, and how strong it is.
#[derive(Serialize)]
pub(super) struct AnswerLine {
    verdict: &'static str,
    /// What a good answer about photographs rests on.
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<String>,
    strength: &'static str,
    error_log2: Option<i64>,
    because: String,
    solutions: Option<SolutionsLine>,
    rank: usize,
    rank_required: usize,
    rank_strength: &'static str,
    components: Vec<ComponentLine>,
    components_strength: &'static str,
    /// The prime of the residues that it rests on.
    #[serde(skip_serializing_if = "Option::is_none")]
    prime: Option<u64>,
}

impl AnswerLine {
    pub(super) fn new(
        input: &NamedGraph,
        verdict: &Verdict,
        scope: &Scope,
        are_listed: bool,
    ) -> Self {
        let strength = verdict.value_claim().strength;
        let line = Self {
            verdict: verdict.value.name(),
            condition: text::condition(input, verdict, scope),
            strength: strength.name(),
            error_log2: strength.error_log2(),
            because: text::because(input, verdict, scope),
            solutions: verdict.solutions.as_ref().map(SolutionsLine::from),
            rank: verdict.rank,
            rank_required: verdict.required,
            rank_strength: verdict.rank_claim().strength.name(),
            components: components(input, verdict, are_listed),
            components_strength: verdict.components_claim().strength.name(),
            prime: verdict.prime(),
        };
        let Some(found) = scope.own_frame() else {
            return line;
        };
        let (rank, rank_required) = found.ranks();
        Self {
            verdict: found.name(),
            condition: text::promised(input, verdict, scope).filter(|_| found.is_good()),
            strength: if found.name() == "open" {
                "none"
            } else {
                "proof"
            },
            error_log2: None,
            because: found.because().to_owned(),
            solutions: None,
            rank,
            rank_required,
            ..line
        }
    }
}

impl From<&Report<'_>> for AnswerLine {
    fn from(report: &Report) -> Self {
        let listed = report.list_components;
        Self::new(report.input, report.verdict, report.scope, listed)
    }
}

/// How many solutions there are, if finitely many.
#[derive(Serialize)]
struct SolutionsLine {
    exactly: Option<usize>,
    at_least: usize,
    at_most: Option<usize>,
    strength: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    because: Option<String>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    full_may_tell_more: bool,
}

impl From<&SolutionCount> for SolutionsLine {
    fn from(count: &SolutionCount) -> Self {
        Self {
            exactly: count.exactly(),
            at_least: count.at_least,
            at_most: count.at_most,
            strength: count.strength().name(),
            because: count.because(),
            full_may_tell_more: count.full_may_tell_more,
        }
    }
}

/// A component, in numbers.
#[derive(Serialize)]
pub(super) struct ComponentLine {
    nodes: usize,
    edges: usize,
    /// Of a camera-point graph; the labels are those of the cameras then.
    #[serde(skip_serializing_if = "Option::is_none")]
    cameras: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    labels: Option<Vec<String>>,
    /// Of a graph that falls apart, where it is not proved to be just one.
    #[serde(skip_serializing_if = "Option::is_none")]
    solutions: Option<SolutionsLine>,
}

/// The record of a graph that has no answer, and why.
///
/// # Errors
/// Those of the writer.
pub fn write_failed(out: &mut impl Write, name: &str, error: &str) -> io::Result<()> {
    let failed = json!({"graph": {"name": name}, "error": error});
    write_line(out, "failed", None, &failed)
}

/// Writes the report as one line.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, report: &Report) -> io::Result<()> {
    let (input, verdict) = (report.input, report.verdict);
    let line = Line {
        graph: GraphLine::new(input, verdict),
        parts: parts(verdict),
        read: &input.read,
        notes: &input.notes,
        database: input.database.as_deref(),
        tracks: input
            .cameras
            .zip(input.tracks.as_ref())
            .map(|(cameras, facts)| TrackLine { cameras, facts }),
        model: verdict.model.name(),
        displacements: displacements(verdict),
        own_frame: report.scope.own_frame(),
        // What pairs and rigs determine by themselves.
        measured: report.scope.own_frame().map(|_| {
            json!({
                "verdict": verdict.value.name(),
                "strength": verdict.value_claim().strength.name(),
                "rank": verdict.rank,
                "rank_required": verdict.required,
            })
        }),
        answer: AnswerLine::from(report),
        conditions: report.scope.conditions(),
        planar: report.scope.planar(),
        base_lines: report.scope.base_lines(),
        intrinsics: report.scope.intrinsics(),
        at_cameras: report
            .here
            .as_ref()
            .map(|here| here.line(report.list_components)),
        mode: if report.rational { "rational" } else { "prime" },
        seconds: report.time.as_secs_f64(),
        advice: report.advice,
        proof: report.proof,
    };
    write_line(out, "report", Some(verdict.seed), &line)
}

/// The components, with their members if these are listed; of a camera-point graph with cameras and points.
pub(super) fn components(
    input: &NamedGraph,
    verdict: &Verdict,
    are_listed: bool,
) -> Vec<ComponentLine> {
    let line = |component: &Component| {
        let members = input
            .cameras
            .map(|cameras| tracks::members(component, cameras));
        let labels = are_listed.then(|| {
            let cameras = members.as_ref().map(|(cameras, _)| cameras.clone());
            let nodes = cameras.unwrap_or_else(|| component.nodes()).into_iter();
            nodes.map(|v| input.labels.label(v).into_owned()).collect()
        });
        ComponentLine {
            nodes: component.node_count(),
            edges: component.edge_count(),
            cameras: members.as_ref().map(|(cameras, _)| cameras.len()),
            points: members.map(|(_, points)| points),
            labels,
            solutions: several(verdict, component).map(SolutionsLine::from),
        }
    };
    verdict.components.iter().map(line).collect()
}
