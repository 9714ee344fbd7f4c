//! The formulations side by side, as a table, as JSON, and as the bars of a chart.

use super::bars::{Chart, Group};
use crate::formulation::compare::{Comparison, Line};
use crate::graph::NamedGraph;
use serde::Serialize;
use std::io::{self, Write};

/// Writes a table.
///
/// # Errors
/// Those of the writer.
pub fn text(out: &mut impl Write, input: &NamedGraph, found: &Comparison) -> io::Result<()> {
    let edges = input.graph.edges().len();
    writeln!(out, "{}", input.name)?;
    let nodes = input.graph.nodes();
    writeln!(out, "  graph       {nodes} cameras, {edges} pairs")?;
    let head = "rows x columns";
    writeln!(
        out,
        "  {:20} {head:>18} {:>10} {:>8} {:>8} {:>7} {:>10}  size by formula",
        "formulation", "non-zeros", "rank", "full", "excess", "seconds"
    )?;
    for line in &found.lines {
        let size = format!("{} x {}", line.size.0, line.size.1);
        write!(out, "  {:20} {size:>18}", line.name)?;
        match line.rank {
            Some(rank) => write!(
                out,
                " {:>10} {:>8} {:>8} {:>7} {:>10.4}",
                rank.nonzeros,
                rank.rank,
                rank.full,
                rank.excess,
                rank.time.as_secs_f64()
            )?,
            None => write!(out, " {:>47}", "not run: too large")?,
        }
        writeln!(out, "  {} x {}", line.formula[0], line.formula[1])?;
    }
    writeln!(
        out,
        "  checks      dPhi/dF has rank 8 and kernel F on {} of {edges} pairs; dPhi/dF dF/dP = -dPhi/dP on \
         {} of {edges}",
        found.kernel_is_f, found.identity
    )?;
    let verdict = match (found.agrees(&input.graph), found.excess()) {
        (true, Some(0)) => "all agree: full rank, finite solvable".to_owned(),
        (true, Some(excess)) => {
            format!("all agree: at these cameras {excess} dimensions of motions beyond the trivial")
        }
        _ => "DISAGREE".to_owned(),
    };
    writeln!(out, "  result      {verdict}")
}

#[derive(Serialize)]
struct Json<'a> {
    graph: JsonGraph<'a>,
    draw: u64,
    agree: bool,
    excess: Option<usize>,
    kernel_is_f: usize,
    implicit_identity: usize,
    formulations: Vec<JsonLine>,
}

#[derive(Serialize)]
struct JsonGraph<'a> {
    name: &'a str,
    nodes: usize,
    edges: usize,
}

#[derive(Serialize)]
struct JsonLine {
    name: &'static str,
    source: &'static str,
    rows: usize,
    columns: usize,
    rows_formula: &'static str,
    columns_formula: &'static str,
    nonzeros: Option<usize>,
    rank: Option<usize>,
    rank_full: Option<usize>,
    excess: Option<usize>,
    seconds: Option<f64>,
}

impl From<&Line> for JsonLine {
    fn from(line: &Line) -> Self {
        Self {
            name: line.name,
            source: line.source,
            rows: line.size.0,
            columns: line.size.1,
            rows_formula: line.formula[0],
            columns_formula: line.formula[1],
            nonzeros: line.rank.map(|rank| rank.nonzeros),
            rank: line.rank.map(|rank| rank.rank),
            rank_full: line.rank.map(|rank| rank.full),
            excess: line.rank.map(|rank| rank.excess),
            seconds: line.rank.map(|rank| rank.time.as_secs_f64()),
        }
    }
}

/// Writes one line of JSON.
///
/// # Errors
/// Those of the writer.
pub fn json(out: &mut impl Write, input: &NamedGraph, found: &Comparison) -> io::Result<()> {
    let line = Json {
        graph: JsonGraph {
            name: &input.name,
            nodes: input.graph.nodes(),
            edges: input.graph.edges().len(),
        },
        draw: found.draw,
        agree: found.agrees(&input.graph),
        excess: found.excess(),
        kernel_is_f: found.kernel_is_f,
        implicit_identity: found.identity,
        formulations: found.lines.iter().map(JsonLine::from).collect(),
    };
    serde_json::to_writer(&mut *out, &line)?;
    out.write_all(b"\n")
}

/// Rows and columns as a chart, as in the paper's figure of the sizes.
pub fn sizes(input: &NamedGraph, found: &Comparison) -> Chart {
    Chart {
        title: format!("Rows and columns: {}", input.name),
        series: vec!["rows".into(), "columns".into()],
        groups: found
            .lines
            .iter()
            .map(|line| Group {
                name: line.name.into(),
                values: vec![line.size.0 as u64, line.size.1 as u64],
            })
            .collect(),
    }
}
