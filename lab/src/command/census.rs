//! `viewcert-lab census`: how many graphs of a list each camera model determines.

use crate::census::{Census, MODELS, Row};
use anyhow::{Context, Result};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert::decide::Options;
use viewcert::graph::Graph;
use viewcert_formats::csv;
use viewcert_formats::{Format, ReadOptions, read_graphs};
use viewcert_report::json::write_line;
use viewcert_session::Session;
use viewcert_session::exit::{BAD_INPUT, GOOD};

/// How many graphs are decided in one go.
const BATCH: usize = 4096;

/// What to count.
#[derive(Args)]
pub struct Arguments {
    /// Graphs of graph6, a graph a line, as nauty's `geng -c` writes them; `-` is standard input.
    #[arg(value_name = "FILE")]
    from: PathBuf,
    /// One JSON object for each number of nodes, with the counts by numbers of edges.
    #[arg(long)]
    json: bool,
}

/// Decides all graphs in every model, and prints the counts.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let (census, bad_lines) = count(session, &arguments.from)?;
    write(&mut std::io::stdout().lock(), arguments, &census).context("standard output")?;
    Ok(if bad_lines > 0 { BAD_INPUT } else { GOOD })
}

/// Decides all graphs of a file in every model. Lines that are no graphs are reported; how many
/// there are is returned.
pub fn count(session: &Session, from: &Path) -> Result<(Census, usize)> {
    let options = Options::default().watch(session.watch());
    let read = ReadOptions {
        format: Some(Format::Graph6),
        ..ReadOptions::default()
    };
    let mut census = Census::default();
    let mut batch: Vec<Graph> = Vec::with_capacity(BATCH);
    let mut bad_lines = 0;
    for input in read_graphs(from, &read) {
        match input {
            Ok(input) => batch.push(input.graph),
            Err(error) => {
                writeln!(std::io::stderr(), "viewcert-lab: {error:#}")?;
                bad_lines += 1;
            }
        }
        if batch.len() == BATCH {
            census.add(&batch, &options)?;
            batch.clear();
        }
    }
    census.add(&batch, &options)?;
    Ok((census, bad_lines))
}

/// Writes a row for each number of nodes and of edges: how many graphs there are, and how many of
/// them each model determines.
pub fn write_table(out: &mut dyn Write, census: &Census) -> std::io::Result<()> {
    let mut table = csv::Writer::tabs(out);
    let models = MODELS.map(|model| model.name().to_owned());
    let names = ["nodes", "edges", "connected"].map(str::to_owned);
    table.row(names.into_iter().chain(models))?;
    for (nodes, row) in &census.0 {
        for (edges, graphs) in &row.graphs {
            let determined = row.determined.iter().map(|counts| counts.get(edges));
            let determined = determined.map(|count| *count.unwrap_or(&0));
            let cells = [*nodes, *edges, *graphs].into_iter().chain(determined);
            table.row(cells.map(|cell| cell.to_string()))?;
        }
    }
    table.finish()
}

/// For each model how many graphs it determines, and, of these, how many have the least number of
/// edges.
fn write(out: &mut impl Write, arguments: &Arguments, census: &Census) -> std::io::Result<()> {
    if !arguments.json {
        let names = MODELS.map(|model| format!(" {model} | least edges |"));
        writeln!(out, "| n | graphs |{}", names.concat())?;
        writeln!(out, "|---:|---:|{}", "---:|---:|".repeat(MODELS.len()))?;
    }
    for (&nodes, row) in &census.0 {
        if arguments.json {
            json(out, nodes, row)?;
            continue;
        }
        write!(out, "| {nodes} | {} |", row.graphs.values().sum::<usize>())?;
        for model in 0..MODELS.len() {
            let least = row.least(model).map_or_else(
                || "none".to_owned(),
                |(edges, count)| format!("{count} with {edges}"),
            );
            write!(out, " {} | {least} |", row.total(model))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn json(out: &mut impl Write, nodes: usize, row: &Row) -> std::io::Result<()> {
    let mut line = serde_json::Map::new();
    line.insert("nodes".into(), nodes.into());
    line.insert("graphs".into(), row.graphs.values().sum::<usize>().into());
    for (model, by_edges) in MODELS.iter().zip(&row.determined) {
        let counts = by_edges
            .iter()
            .map(|(edges, &count)| (edges.to_string(), count.into()));
        line.insert(
            model.name().into(),
            serde_json::Value::Object(counts.collect()),
        );
    }
    write_line(out, "census", Some(Options::default().seed), &line)
}
