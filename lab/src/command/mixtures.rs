//! `viewcert-lab intrinsics`: for which classes of cameras, and for which sensors, the graphs of a
//! list are metric.

use crate::mixtures::{Asked, Cases, KINDS, Kind, MOST_NODES};
use anyhow::{Result, ensure};
use clap::Args;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::graph6;
use viewcert_formats::csv;
use viewcert_formats::{Format, ReadOptions, read_graphs};
use viewcert_session::exit::GOOD;
use viewcert_session::{Session, outputs};

/// What to count.
#[derive(Args)]
pub struct Arguments {
    /// Connected graphs of graph6, a graph a line, as nauty's `geng -c` writes them; `-` is standard
    /// input.
    #[arg(value_name = "FILE")]
    from: PathBuf,
    /// Print a row for each graph and question, with the least assignments that are metric, instead of
    /// the sums.
    #[arg(long)]
    graphs: bool,
    /// Also write every assignment and its rank to a file.
    #[arg(long, value_name = "LIST")]
    list: Option<PathBuf>,
    /// Also write the certificate of every assignment to a file, a line each (`.jsonl`); `verify check`
    /// takes it. A graph is called by its graph6 and the letters of the assignment.
    #[arg(long, value_name = "JSONL")]
    certificates: Option<PathBuf>,
}

/// The sums of one question.
#[derive(Default)]
struct Sums {
    graphs: usize,
    cases: usize,
    metric: usize,
    open: usize,
}

/// Decides all assignments, and prints what was found.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let options = Options::default().watch(session.watch());
    let read = ReadOptions {
        format: Some(Format::Graph6),
        ..ReadOptions::default()
    };
    let written = [
        ("--list", arguments.list.as_deref()),
        ("--certificates", arguments.certificates.as_deref()),
    ];
    outputs::ensure_apart(&written, [&*arguments.from])?;
    let mut graphs = Vec::new();
    for input in read_graphs(&arguments.from, &read) {
        let input = input?;
        let nodes = input.graph.nodes();
        ensure!(
            (2..=MOST_NODES).contains(&nodes),
            "{}: {nodes} nodes; all symmetries are tried, of graphs with 2 to {MOST_NODES} nodes",
            input.name
        );
        graphs.push(input.graph);
    }
    let asked = graphs.par_iter().map(|graph| Asked::new(graph, &options));
    let asked: Vec<Asked> = asked.collect::<Result<_, VerdictError>>()?;
    let found: Vec<Vec<Cases>> = asked
        .par_iter()
        .map(|asked| {
            KINDS
                .iter()
                .map(|&kind| asked.cases(kind, &options))
                .collect()
        })
        .collect::<Result<_, VerdictError>>()?;
    let rows = || {
        let graphs = graphs.iter().zip(&found);
        graphs.flat_map(|(graph, found)| KINDS.into_iter().zip(found).map(move |row| (graph, row)))
    };
    if let Some(path) = &arguments.list {
        session.outputs().write(path, |out| {
            let mut list = csv::Writer::tabs(out);
            list.row(["graph6", "question", "nodes", "rank", "at_most", "required"])?;
            for (graph, (kind, cases)) in rows() {
                for case in &cases.all {
                    let numbers = [case.rank, case.at_most, case.required];
                    let words = [
                        graph6::encode(graph),
                        kind.name(),
                        kind.letters(&case.of_node),
                    ];
                    list.row(words.into_iter().chain(numbers.map(|x| x.to_string())))?;
                }
            }
            list.finish()
        })?;
    }
    if let Some(path) = &arguments.certificates {
        let of_graphs: Vec<Vec<u8>> = asked
            .par_iter()
            .zip(&found)
            .map(|(asked, found)| {
                let mut lines = Vec::new();
                for (kind, cases) in KINDS.into_iter().zip(found) {
                    for case in &cases.all {
                        lines.extend(asked.certificate(kind, &case.of_node, &options)?);
                    }
                }
                Ok(lines)
            })
            .collect::<Result<_, VerdictError>>()?;
        session.outputs().write(path, |out| {
            of_graphs.iter().try_for_each(|lines| out.write_all(lines))
        })?;
    }
    let mut out = outputs::text(&written.map(|(_, path)| path));
    if arguments.graphs {
        let mut table = csv::Writer::tabs(&mut out);
        table.row(["graph6", "question", "cases", "metric", "open", "least"])?;
        for (graph, (kind, cases)) in rows() {
            let sums = Sums::of(cases);
            let least = cases.least.iter().map(|of_node| kind.letters(of_node));
            let words = [graph6::encode(graph), kind.name()];
            let numbers = [sums.cases, sums.metric, sums.open];
            let numbers = numbers.map(|x| x.to_string());
            let least = least.collect::<Vec<String>>().join(" ");
            table.row(words.into_iter().chain(numbers).chain([least]))?;
        }
        table.finish()?;
        return Ok(GOOD);
    }
    let mut sums: BTreeMap<(Kind, usize), Sums> = BTreeMap::new();
    for (graph, (kind, cases)) in rows() {
        sums.entry((kind, graph.nodes()))
            .or_default()
            .add(&Sums::of(cases));
    }
    writeln!(
        out,
        "| what is assigned | n | graphs | assignments | metric | open |"
    )?;
    writeln!(out, "|---|---:|---:|---:|---:|---:|")?;
    for ((kind, nodes), sums) in &sums {
        writeln!(
            out,
            "| {} | {nodes} | {} | {} | {} | {} |",
            kind.name(),
            sums.graphs,
            sums.cases,
            sums.metric,
            sums.open
        )?;
    }
    Ok(GOOD)
}

impl Sums {
    fn of(cases: &Cases) -> Self {
        let count = |is: fn(&crate::mixtures::Case) -> bool| {
            cases.all.iter().filter(|case| is(case)).count()
        };
        Self {
            graphs: 1,
            cases: cases.all.len(),
            metric: count(|case| case.is_metric()),
            open: count(|case| case.rank != case.at_most),
        }
    }

    fn add(&mut self, other: &Self) {
        self.graphs += other.graphs;
        self.cases += other.cases;
        self.metric += other.metric;
        self.open += other.open;
    }
}
