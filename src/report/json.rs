//! One JSON object a line.

use super::Report;
use crate::act::Acted;
use serde::Serialize;
use std::io::{self, Write};
use viewcert::certificate::hex;

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    notes: &'a [String],
    model: &'static str,
    verdict: &'static str,
    strength: &'static str,
    error_log2: Option<i64>,
    rank: usize,
    rank_required: usize,
    rank_strength: &'static str,
    components: Vec<ComponentLine>,
    components_strength: &'static str,
    mode: &'static str,
    seconds: f64,
    #[serde(flatten)]
    acted: &'a Acted,
}

#[derive(Serialize)]
struct GraphLine<'a> {
    name: &'a str,
    nodes: usize,
    edges: usize,
    sha256: String,
}

#[derive(Serialize)]
struct ComponentLine {
    nodes: usize,
    edges: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    labels: Option<Vec<String>>,
}

/// Writes the report as one line.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, report: &Report) -> io::Result<()> {
    let (input, verdict) = (report.input, report.verdict);
    let labels = |component| {
        let nodes = verdict.component_nodes(component);
        nodes
            .iter()
            .map(|&v| input.labels.label(v).into_owned())
            .collect()
    };
    let line = Line {
        graph: GraphLine {
            name: &input.name,
            nodes: input.graph.nodes(),
            edges: input.graph.edges().len(),
            sha256: hex(&verdict.sha256),
        },
        notes: &input.notes,
        model: verdict.model.name(),
        verdict: verdict.value.name(),
        strength: verdict.strength.name(),
        error_log2: verdict.strength.error_log2(),
        rank: verdict.rank,
        rank_required: verdict.required,
        rank_strength: verdict.rank_strength.name(),
        components: verdict
            .components
            .iter()
            .map(|component| ComponentLine {
                nodes: component.nodes,
                edges: component.edges,
                labels: report.list_components.then(|| labels(component)),
            })
            .collect(),
        components_strength: verdict.components_strength.name(),
        mode: if report.rational { "rational" } else { "prime" },
        seconds: report.time.as_secs_f64(),
        acted: report.acted,
    };
    serde_json::to_writer(&mut *out, &line)?;
    out.write_all(b"\n")
}
