//! `viewcert-lab solutions`: how many solutions the graphs of a size have.

use super::sizes;
use crate::solutions::{Bounds, Source, Tally, tally};
use anyhow::{Context, Result};
use clap::Args;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::RangeInclusive;
use std::time::Instant;
use viewcert::decide::Options;
use viewcert_lab_catalog::progress::Progress;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Options of the experiment on numbers of solutions.
#[derive(Args)]
pub struct Arguments {
    /// Numbers of nodes, as in 9 or 3-10.
    #[arg(long, value_name = "N", default_value = "3-10", value_parser = sizes)]
    nodes: RangeInclusive<usize>,
    /// All Laman graphs, which have 2 n - 3 pairs, instead of those with the fewest pairs.
    #[arg(long)]
    laman: bool,
    /// Seed of the centres.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Counts solutions, and lists what the graphs with each number of solutions have of equations
/// beyond their unknowns, the first of them, and the graphs whose number is not known exactly.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let options = Options::default()
        .seed(arguments.seed)
        .watch(session.watch());
    let source = if arguments.laman {
        Source::Laman
    } else {
        Source::FewestEdges
    };
    let mut out = outputs::text(&[]);
    writeln!(
        out,
        "nodes  fin_solv  solutions: graphs                      not exact  seconds"
    )?;
    let mut tallies = Vec::new();
    for nodes in arguments.nodes.clone() {
        let start = Instant::now();
        let graphs = source.graphs(nodes)?;
        let progress = Progress::new("graphs", Some(graphs.len() as u64));
        let found = tally(&graphs, &options, |more| progress.done(more))?;
        progress.finish();
        writeln!(
            out,
            "{nodes:>5}  {:>8}  {:<38}  {:>9}  {:>7.1}",
            found.graphs,
            in_words(&found.exactly),
            found.open.len(),
            start.elapsed().as_secs_f64(),
        )?;
        out.flush().context("standard output")?;
        tallies.push((nodes, found));
    }
    write_excesses(&mut out, &tallies)?;
    for (nodes, tally) in &tallies {
        let several = tally.first.iter().filter(|(solutions, _)| **solutions > 1);
        for (solutions, graph) in several {
            writeln!(out, "{nodes} nodes, {solutions} solutions: first {graph}")?;
        }
    }
    let open = tallies.iter().flat_map(|(_, tally)| &tally.open);
    open.into_iter()
        .try_for_each(|graph| write_open(&mut out, graph))?;
    out.flush().context("standard output")?;
    Ok(GOOD)
}

/// How many graphs have each number of solutions.
fn in_words(exactly: &BTreeMap<usize, usize>) -> String {
    let words = exactly
        .iter()
        .map(|(solutions, graphs)| format!("{solutions}: {graphs}"));
    words.collect::<Vec<_>>().join(", ")
}

/// The same by what cores have more of equations than of unknowns.
fn write_excesses(out: &mut impl Write, tallies: &[(usize, Tally)]) -> std::io::Result<()> {
    writeln!(out, "nodes    excess  solutions: graphs")?;
    for (nodes, tally) in tallies {
        for (excess, exactly) in &tally.by_excess {
            let excess = excess.map_or("one body".into(), |excess| excess.to_string());
            writeln!(out, "{nodes:>5}  {excess:>8}  {}", in_words(exactly))?;
        }
    }
    Ok(())
}

fn write_open(out: &mut impl Write, graph: &Bounds) -> std::io::Result<()> {
    let most = graph.at_most;
    let most = most.map_or("unknown".into(), |most| most.to_string());
    let excess = graph
        .excess
        .map_or(String::new(), |excess| format!(", excess {excess}"));
    writeln!(
        out,
        "{}: at least {}, at most {most}{excess}",
        graph.graph6, graph.at_least
    )
}
