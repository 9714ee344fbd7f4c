//! The formulations side by side, as a table, as JSON, and as the bars of a chart.

use super::bars::{Chart, Group};
use serde::Serialize;
use std::io::{self, Write};
use viewcert::wording::printable;
use viewcert_formats::{NamedGraph, ReadAs};
use viewcert_lab_studies::formulation::compare::{Comparison, Line, MatrixLine, Outcome};
use viewcert_report::json::{GraphLine, write_line};
use viewcert_report::{counted, size};

/// Writes a table.
///
/// # Errors
/// Those of the writer.
pub fn text(out: &mut impl Write, input: &NamedGraph, found: &Comparison) -> io::Result<()> {
    let edges = input.graph.edges().len();
    writeln!(out, "{}", printable(&input.name))?;
    writeln!(out, "  read as     {}", input.read)?;
    writeln!(out, "  graph       {}", size(&input.graph))?;
    for note in &input.notes {
        writeln!(out, "  note        {note}")?;
    }
    let head = "rows x columns";
    writeln!(
        out,
        "  {:20} {head:>18} {:>10} {:>8} {:>8} {:>7} {:>10}  size by formula",
        "formulation", "non-zeros", "rank", "full", "excess", "seconds"
    )?;
    for line in &found.lines {
        formulation(out, line)?;
    }
    let pairs = counted(edges, "pair");
    match found.affine_f {
        _ if found.computed() == 0 => {}
        Some(held) => writeln!(
            out,
            "  checks      F by its minors is that of the left null vectors on {held} of {pairs}"
        )?,
        None => writeln!(
            out,
            "  checks      dPhi/dF has rank 8 and kernel F on {} of {pairs}; dPhi/dF dF/dP = -dPhi/dP on \
             {} of {edges}",
            found.kernel_is_f, found.identity
        )?,
    }
    let solvable = match found.affine_f {
        Some(_) => "affine solvable",
        None => "finite solvable",
    };
    let (computed, all) = (found.computed(), found.lines.len());
    let who = if computed == all {
        "all agree".to_owned()
    } else {
        format!("the {computed} of {all} that were computed agree")
    };
    let verdict = match found.outcome(&input.graph) {
        Outcome::Agree(0) => format!("{who}: full rank, {solvable}"),
        Outcome::Agree(excess) => {
            let dimensions = counted(excess, "dimension");
            format!("{who}: at these cameras {dimensions} of motions beyond the trivial")
        }
        Outcome::Disagree => "DISAGREE".to_owned(),
        Outcome::NotCompared => format!(
            "sizes only, nothing compared: {computed} of {all} computed, the others are too large; \
             --limit raises the limit"
        ),
    };
    writeln!(out, "  result      {verdict}")
}

/// A line for a formulation of one matrix; of several, one for what they decide together
/// and one for each.
fn formulation(out: &mut impl Write, line: &Line) -> io::Result<()> {
    if let [matrix] = &line.matrices[..] {
        write!(out, "  {:20} {}", line.name, matrix_cells(matrix))?;
        write!(out, " {}", rank_cells(line))?;
        return writeln!(out, "  {} x {}", matrix.formula[0], matrix.formula[1]);
    }
    let blank = "";
    writeln!(out, "  {:20} {blank:>29} {}", line.name, rank_cells(line))?;
    for matrix in &line.matrices {
        let name = format!("  {}", matrix.name.unwrap_or(""));
        let rank = matrix
            .found
            .map_or_else(String::new, |(_, rank)| rank.to_string());
        write!(
            out,
            "  {name:20} {} {rank:>8} {blank:>27}",
            matrix_cells(matrix)
        )?;
        writeln!(out, "  {} x {}", matrix.formula[0], matrix.formula[1])?;
    }
    Ok(())
}

/// Size and entries.
fn matrix_cells(matrix: &MatrixLine) -> String {
    let size = matrix.size.map_or_else(
        || "-".into(),
        |(rows, columns)| format!("{rows} x {columns}"),
    );
    let nonzeros = matrix
        .found
        .map_or_else(|| "-".into(), |(nonzeros, _)| nonzeros.to_string());
    format!("{size:>18} {nonzeros:>10}")
}

/// Rank, full rank, excess and time.
fn rank_cells(line: &Line) -> String {
    let Some(rank) = line.rank else {
        return format!("{:>36}", "not run: too large");
    };
    let seconds = rank.time.as_secs_f64();
    let (rank, full, excess) = (rank.rank, rank.full, rank.excess);
    format!("{rank:>8} {full:>8} {excess:>7} {seconds:>10.4}")
}

#[derive(Serialize)]
struct Json<'a> {
    graph: GraphLine<'a>,
    read: &'a ReadAs,
    notes: &'a [String],
    draw: u64,
    agree: Option<bool>,
    computed: usize,
    excess: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel_is_f: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    implicit_identity: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    affine_f: Option<usize>,
    formulations: Vec<JsonLine>,
}

#[derive(Serialize)]
struct JsonLine {
    name: &'static str,
    source: &'static str,
    matrices: Vec<JsonMatrix>,
    rank: Option<usize>,
    rank_full: Option<usize>,
    excess: Option<usize>,
    seconds: Option<f64>,
}

#[derive(Serialize)]
struct JsonMatrix {
    name: Option<&'static str>,
    rows: Option<usize>,
    columns: Option<usize>,
    rows_formula: &'static str,
    columns_formula: &'static str,
    nonzeros: Option<usize>,
    rank: Option<usize>,
}

impl From<&MatrixLine> for JsonMatrix {
    fn from(matrix: &MatrixLine) -> Self {
        Self {
            name: matrix.name,
            rows: matrix.size.map(|(rows, _)| rows),
            columns: matrix.size.map(|(_, columns)| columns),
            rows_formula: matrix.formula[0],
            columns_formula: matrix.formula[1],
            nonzeros: matrix.found.map(|(nonzeros, _)| nonzeros),
            rank: matrix.found.map(|(_, rank)| rank),
        }
    }
}

impl From<&Line> for JsonLine {
    fn from(line: &Line) -> Self {
        Self {
            name: line.name,
            source: line.source,
            matrices: line.matrices.iter().map(JsonMatrix::from).collect(),
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
pub fn json(
    out: &mut impl Write,
    (input, seed): (&NamedGraph, u64),
    found: &Comparison,
) -> io::Result<()> {
    let is_checked = found.affine_f.is_none() && found.computed() > 0;
    let line = Json {
        graph: GraphLine::of(input),
        read: &input.read,
        notes: &input.notes,
        draw: found.draw,
        agree: match found.outcome(&input.graph) {
            Outcome::Agree(_) => Some(true),
            Outcome::Disagree => Some(false),
            Outcome::NotCompared => None,
        },
        computed: found.computed(),
        excess: found.excess(),
        kernel_is_f: is_checked.then_some(found.kernel_is_f),
        implicit_identity: is_checked.then_some(found.identity),
        affine_f: found.affine_f,
        formulations: found.lines.iter().map(JsonLine::from).collect(),
    };
    write_line(out, "comparison", Some(seed), &line)
}

/// Rows and columns as a chart, as in the paper's figure of the sizes.
pub fn sizes(input: &NamedGraph, found: &Comparison) -> Chart {
    let group = |line: &Line, matrix: &MatrixLine| {
        let (rows, columns) = matrix.size?;
        let name = match matrix.name {
            Some(name) => format!("{}: {name}", line.name),
            None => line.name.into(),
        };
        Some(Group {
            name,
            values: vec![rows as u64, columns as u64],
        })
    };
    let groups = found
        .lines
        .iter()
        .flat_map(|line| line.matrices.iter().map(move |matrix| group(line, matrix)));
    Chart {
        title: format!("Rows and columns: {}", input.name),
        series: vec!["rows".into(), "columns".into()],
        groups: groups.flatten().collect(),
    }
}
