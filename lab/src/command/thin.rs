//! `viewcert-lab thin`: pieces of graphs, thinned until they are only just finite solvable, and
//! how many solutions they have.

use super::sizes;
use crate::thinned::{draw_size, piece, thinned};
use anyhow::{Context, Result};
use clap::Args;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::time::Instant;
use viewcert::decide::{CountSolutions, Options, Question, VerdictError, decide};
use viewcert::graph::graph6;
use viewcert_formats::csv;
use viewcert_formats::{NamedGraph, ReadOptions, read_graphs};
use viewcert_lab_catalog::progress::Progress;
use viewcert_lab_catalog::random::generator;
use viewcert_report::counted;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Options of the experiment on thinned pieces.
#[derive(Args)]
pub struct Arguments {
    /// Graphs to take pieces of.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    /// How many nodes pieces have, drawn from this range.
    #[arg(long, value_name = "N", default_value = "20-110", value_parser = sizes)]
    nodes: RangeInclusive<usize>,
    /// How many pieces of each graph.
    #[arg(long, value_name = "COUNT", default_value_t = 10)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pieces: u32,
    /// Seed of the pieces, of the order in which pairs are removed, and of the cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a line for each piece to this file, as comma-separated values, the thinned piece as
    /// graph6 (`-`: to standard output, and the table to standard error).
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// A thinned piece, and what is known of it.
struct Row {
    sample: u32,
    nodes: usize,
    pairs: usize,
    left: usize,
    graph6: String,
    at_least: usize,
    at_most: Option<usize>,
    seconds: f64,
}

/// Thins pieces of all graphs, and prints a line for each and a summary.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let csv = arguments.csv.as_deref();
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    outputs::ensure_apart(&[("--csv", csv)], inputs)?;
    let mut out = outputs::text(&[csv]);
    writeln!(
        out,
        "nodes  pairs  thinned  solutions  seconds  piece  graph"
    )?;
    let mut all: Vec<(String, Row)> = Vec::new();
    for path in &arguments.graphs {
        session.reading(path);
        for input in read_graphs(path, &ReadOptions::default()) {
            let input = input?;
            let rows = of_graph(session, arguments, &input);
            for row in rows.with_context(|| input.name.clone())? {
                write_row(&mut out, &input.name, &row)?;
                all.push((input.name.clone(), row));
            }
            out.flush().context("standard output")?;
        }
    }
    write_summary(&mut out, &all)?;
    out.flush().context("standard output")?;
    if let Some(path) = csv {
        session.outputs().write(path, |out| {
            let mut table = csv::Writer::commas(out);
            table.row(COLUMNS)?;
            all.iter()
                .try_for_each(|(name, row)| table.row(row.cells(name)))?;
            table.finish()
        })?;
    }
    Ok(GOOD)
}

/// The pieces of a graph, in parallel.
fn of_graph(
    session: &Session,
    arguments: &Arguments,
    input: &NamedGraph,
) -> Result<Vec<Row>, VerdictError> {
    let options = Options::default()
        .seed(arguments.seed)
        .question(Question::with_solutions(CountSolutions::Full))
        .watch(session.watch());
    let progress = Progress::new("pieces", Some(u64::from(arguments.pieces)));
    let rows: Vec<Option<Row>> = (0..arguments.pieces)
        .into_par_iter()
        .map(|sample| {
            let row = row(arguments, input, sample, &options);
            progress.done(1);
            row
        })
        .collect::<Result<_, _>>()?;
    progress.finish();
    Ok(rows.into_iter().flatten().collect())
}

/// A piece, thinned; `None` if it has fewer nodes than were asked for.
fn row(
    arguments: &Arguments,
    input: &NamedGraph,
    sample: u32,
    options: &Options,
) -> Result<Option<Row>, VerdictError> {
    let mut generator = generator(arguments.seed, sample.into());
    let nodes = draw_size(&arguments.nodes, &mut generator);
    let piece = piece(&input.graph, nodes, options, &mut generator)?;
    if piece.nodes() < *arguments.nodes.start() {
        return Ok(None);
    }
    let Some(thin) = thinned(&piece, options, &mut generator)? else {
        return Ok(None);
    };
    let start = Instant::now();
    let Some(solutions) = decide(&thin, options)?.solutions else {
        return Ok(None);
    };
    Ok(Some(Row {
        sample,
        nodes: piece.nodes(),
        pairs: piece.edges().len(),
        left: thin.edges().len(),
        graph6: graph6::encode(&thin),
        at_least: solutions.at_least,
        at_most: solutions.at_most,
        seconds: start.elapsed().as_secs_f64(),
    }))
}

/// The table of `--csv`.
const COLUMNS: [&str; 9] = [
    "graph", "piece", "nodes", "pairs", "thinned", "at_least", "at_most", "seconds", "graph6",
];

impl Row {
    fn cells(&self, graph: &str) -> [String; 9] {
        let most = self.at_most.map(|most| most.to_string());
        [
            graph.into(),
            self.sample.to_string(),
            self.nodes.to_string(),
            self.pairs.to_string(),
            self.left.to_string(),
            self.at_least.to_string(),
            most.unwrap_or_default(),
            format!("{:.3}", self.seconds),
            self.graph6.clone(),
        ]
    }

    fn solutions(&self) -> String {
        match (self.at_least, self.at_most) {
            (least, Some(most)) if least == most => least.to_string(),
            (least, Some(most)) => format!("{least}-{most}"),
            (least, None) => format!("{least}-"),
        }
    }
}

fn write_row(out: &mut impl Write, graph: &str, row: &Row) -> std::io::Result<()> {
    writeln!(
        out,
        "{:>5}  {:>5}  {:>7}  {:>9}  {:>7.2}  {:>5}  {graph}",
        row.nodes,
        row.pairs,
        row.left,
        row.solutions(),
        row.seconds,
        row.sample,
    )
}

/// How many pieces have each number of solutions, or bounds for it.
fn write_summary(out: &mut impl Write, all: &[(String, Row)]) -> std::io::Result<()> {
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    for (_, row) in all {
        *tally.entry(row.solutions()).or_default() += 1;
    }
    let words = tally
        .iter()
        .map(|(solutions, pieces)| format!("{solutions}: {pieces}"));
    let words: Vec<String> = words.collect();
    writeln!(
        out,
        "{}; solutions: {}",
        counted(all.len(), "piece"),
        words.join(", ")
    )
}
