//! `verify catalog`: all candidates of a size, decided and certified.

use super::certificates::Target;
use anyhow::{Context, Result, ensure};
use clap::Args;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::time::Instant;
use viewcert::decide::{CountSolutions, Options, Prime, Question, Verdict, VerdictError, decide};
use viewcert::graph::{Graph, Labels};
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert_catalog::candidates::has_adjacent_nodes_of_degree_2;
use viewcert_catalog::mine::{COLUMNS, Entry, Summary};
use viewcert_catalog::{candidates, least_edges};
use viewcert_formats::{NamedGraph, csv};
use viewcert_report::table;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;

/// Candidates that are decided side by side.
const BATCH: usize = 256;

/// Options of the catalog.
#[derive(Args)]
pub(super) struct Arguments {
    /// Number of nodes, 3 to 12, or a range of them as in 3-10.
    #[arg(long, value_name = "N", value_parser = sizes)]
    nodes: RangeInclusive<usize>,
    /// Number of edges [default: the least that can do, ceil((11 N - 15) / 7)].
    #[arg(long, value_name = "M")]
    edges: Option<usize>,
    /// Leave out candidates with adjacent nodes of degree 2: they are not finite solvable.
    #[arg(long)]
    necessary: bool,
    /// Print a line of tab-separated values for every graph.
    #[arg(long)]
    list: bool,
    /// Write the certificate of every graph to this folder.
    #[arg(long, value_name = "DIR")]
    certificate: Option<PathBuf>,
    /// Count the solutions of the finite-solvable graphs: how many have each number stands under the
    /// table, and the last column of --list has it for each graph.
    #[arg(long)]
    solutions: bool,
    /// Compute modulo this prime, 5 <= P < 2^62.
    #[arg(long, value_name = "P", default_value_t = DEFAULT_PRIME)]
    prime: u64,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Reads `9` or `3-10`.
fn sizes(text: &str) -> Result<RangeInclusive<usize>, String> {
    let number = |text: &str| {
        text.parse()
            .map_err(|_| format!("{text:?} is not a number"))
    };
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let range = number(first)?..=number(last)?;
    match range.is_empty() {
        true => Err("the range is empty".into()),
        false => Ok(range),
    }
}

/// Decides the candidates of every size, and prints their list or the table.
pub(super) fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let prime = arguments.prime;
    let field = PrimeField::new(prime).with_context(|| format!("prime {prime}"))?;
    let effort = match arguments.solutions {
        true => CountSolutions::Full,
        false => CountSolutions::Off,
    };
    let options = Options::default()
        .question(Question::with_solutions(effort))
        .prime(Prime::Fixed(field))
        .seed(arguments.seed)
        .watch(session.watch());
    if let Some(folder) = &arguments.certificate {
        let path = folder.display();
        ensure!(
            folder.is_dir(),
            "--certificate {path}: a certificate for each graph goes to an existing folder"
        );
    }
    let mut target = arguments.certificate.as_deref().map(Target::new);
    let mut list = csv::Writer::tabs(std::io::stdout().lock());
    if arguments.list {
        list.row(COLUMNS).context("standard output")?;
    }
    let mut rows = Vec::new();
    for nodes in arguments.nodes.clone() {
        let start = Instant::now();
        let edges = arguments.edges.unwrap_or_else(|| least_edges(nodes.max(2)));
        let mut graphs = candidates(nodes, edges, &session.watch())?;
        if arguments.necessary {
            graphs.retain(|graph| nodes == 3 || !has_adjacent_nodes_of_degree_2(graph));
        }
        let (mut summary, mut solutions) = (Summary::default(), BTreeMap::new());
        session.doing(format!("deciding {} candidates", graphs.len()));
        for batch in graphs.chunks(BATCH) {
            for (graph, (entry, verdict)) in batch.iter().zip(decided(batch, &options)?) {
                summary.count(&entry);
                if let Some(words) = entry.solutions_in_words().filter(|_| arguments.solutions) {
                    *solutions.entry(words).or_default() += 1;
                }
                if let Some(target) = &mut target {
                    let numbers = Labels::Numbers { first: 0 };
                    let input = NamedGraph::new(&entry.graph6, graph.clone(), numbers);
                    let found = (&input, start.elapsed());
                    target.write(session.outputs(), found, &verdict, None)?;
                }
                if arguments.list {
                    list.row(entry.cells()).context("standard output")?;
                }
            }
        }
        let which = match arguments.necessary {
            true => "necessary",
            false => "biconnected",
        };
        rows.push(table::Row {
            name: format!("{nodes} nodes, {edges} edges, {which}"),
            summary,
            solutions,
            seconds: Some(start.elapsed().as_secs_f64()),
        });
    }
    list.finish().context("standard output")?;
    if !arguments.list {
        table::write(&mut std::io::stdout().lock(), &rows).context("standard output")?;
    }
    Ok(GOOD)
}

/// The verdicts on some graphs, in their order.
fn decided(graphs: &[Graph], options: &Options) -> Result<Vec<(Entry, Verdict)>, VerdictError> {
    let decided = graphs.par_iter().map(|graph| {
        let verdict = decide(graph, options)?;
        Ok((Entry::new(graph, &verdict), verdict))
    });
    decided.collect()
}
