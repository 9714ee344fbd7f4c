//! `verify experiment`: the experiments of the paper, and numbers of solutions.

use super::progress::Progress;
use super::{GOOD, atomic, running};
use crate::report::plot::{Point, plot};
use crate::report::values::Values;
use anyhow::{Context, Result, anyhow};
use clap::{Args, Subcommand};
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide::{CountSolutions, Options, Strength, Value};
use viewcert::solutions::Effort;
use viewcert_studies::catalog::mine;
use viewcert_studies::catalog::mine::Entry;
use viewcert_studies::catalog::random;
use viewcert_studies::catalog::random::{Density, Sampler, fisher};
use viewcert_studies::solutions::tally;
use viewcert_studies::values;

#[derive(Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Connected random graphs (the paper's Table 2).
    Random(Random),
    /// How many solutions the finite solvable graphs with the fewest pairs have.
    Solutions(Solutions),
}

/// Options of the experiment on numbers of solutions.
#[derive(Args)]
struct Solutions {
    /// Numbers of nodes, as in 9 or 3-10.
    #[arg(long, value_name = "N", default_value = "3-10", value_parser = sizes)]
    nodes: RangeInclusive<usize>,
    /// Seed of the centres.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Reads `9` or `3-10`.
fn sizes(text: &str) -> Result<RangeInclusive<usize>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if 3 <= first && first <= last => Ok(first..=last),
        _ => Err("write one number of nodes or two, from 3 up, as in 9 or 3-10".into()),
    }
}

/// Options of the random experiment.
#[derive(Args)]
struct Random {
    /// Number of nodes.
    #[arg(long, value_name = "N", default_value_t = 20)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=40))]
    nodes: u32,
    /// Probability of a pair, as in 0.05 or 5%; may be repeated or listed with commas.
    #[arg(long, value_name = "D", required = true, value_delimiter = ',')]
    density: Vec<Density>,
    /// How many graphs at each density.
    #[arg(long, value_name = "COUNT", default_value_t = 1000)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    samples: u32,
    /// Seed of the graphs and of the cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a line for each graph to this file, as comma-separated values (`-`: to standard
    /// output, and the table to standard error).
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a plot to this file (`-`: as with --csv).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Compare with a table: density_percent,graphs,finite_solvable,components_min,components_max.
    #[arg(long, value_name = "FILE")]
    compare: Option<PathBuf>,
}

/// The results at one density.
struct Column {
    percent: f64,
    graphs: u64,
    finite_solvable: u64,
    proved: u64,
    components: Vec<usize>,
}

/// A line of a table to compare with.
struct Published {
    percent: f64,
    graphs: u64,
    finite_solvable: u64,
    least: usize,
    most: usize,
}

/// How many graphs are decided in one go.
const BATCH: u64 = 1024;

pub(super) fn run(arguments: &Arguments) -> Result<ExitCode> {
    match &arguments.command {
        Command::Random(arguments) => run_random(arguments),
        Command::Solutions(arguments) => run_solutions(arguments),
    }
}

/// Counts solutions, and lists the graphs whose number is not known exactly.
fn run_solutions(arguments: &Solutions) -> Result<ExitCode> {
    let options = Options::default()
        .solutions(CountSolutions::Off)
        .watch(running::watch());
    let mut out = atomic::text(&[]);
    writeln!(
        out,
        "nodes  fin_solv  solutions: graphs                      not exact  seconds"
    )?;
    let mut open = Vec::new();
    for nodes in arguments.nodes.clone() {
        let progress = Progress::new(None);
        let start = Instant::now();
        let done = |more| progress.done(more);
        let tally = tally(nodes, &options, Effort::default(), arguments.seed, done)?;
        progress.finish();
        let exactly: Vec<String> = tally
            .exactly
            .iter()
            .map(|(solutions, graphs)| format!("{solutions}: {graphs}"))
            .collect();
        writeln!(
            out,
            "{nodes:>5}  {:>8}  {:<38}  {:>9}  {:>7.1}",
            tally.graphs,
            exactly.join(", "),
            tally.open.len(),
            start.elapsed().as_secs_f64(),
        )?;
        open.extend(tally.open);
    }
    for graph in open {
        let most = graph
            .at_most
            .map_or("unknown".into(), |most| most.to_string());
        writeln!(
            out,
            "{}: at least {}, at most {most}",
            graph.graph6, graph.at_least
        )?;
    }
    out.flush().context("standard output")?;
    Ok(ExitCode::from(GOOD))
}

fn run_random(arguments: &Random) -> Result<ExitCode> {
    let (csv, svg) = (arguments.csv.as_deref(), arguments.svg.as_deref());
    let inputs = arguments.compare.as_deref();
    atomic::ensure_apart(&[("--csv", csv), ("--svg", svg)], inputs)?;
    let published = match &arguments.compare {
        Some(path) => read_table(path)?,
        None => Vec::new(),
    };
    let options = Options::default()
        .solutions(CountSolutions::Off)
        .seed(arguments.seed)
        .watch(running::watch());
    let mut columns = Vec::new();
    let mut rows = Vec::new();
    let samples = u64::from(arguments.samples);
    let progress = Progress::new(Some(samples * arguments.density.len() as u64));
    for density in &arguments.density {
        let keep = csv.is_some().then_some(&mut rows);
        columns.push(at_density(arguments, density, &options, &progress, keep)?);
    }
    progress.finish();
    columns.sort_by(|a, b| a.percent.total_cmp(&b.percent));
    if let Some(path) = csv {
        atomic::write(path, |out| {
            let mut table = Values::commas(out);
            table.row(GRAPH_COLUMNS)?;
            rows.iter().try_for_each(|row| table.row(row))?;
            table.finish()
        })?;
    }
    if let Some(path) = svg {
        let points: Vec<Point> = columns.iter().map(Column::point).collect();
        atomic::write(path, |out| out.write_all(plot(&points).as_bytes()))?;
    }
    let mut out = atomic::text(&[csv, svg]);
    write_table(&mut out, &columns, &published).context("standard output")?;
    Ok(ExitCode::from(GOOD))
}

/// The table of `--csv`.
const GRAPH_COLUMNS: [&str; 7] = [
    "density",
    "sample",
    "edges",
    "verdict",
    "rank",
    "components",
    "graph6",
];

/// Draws and decides all graphs at one density, and adds their rows to `keep`.
fn at_density(
    arguments: &Random,
    density: &Density,
    options: &Options,
    progress: &Progress,
    mut keep: Option<&mut Vec<[String; 7]>>,
) -> Result<Column> {
    let sampler = Sampler::new(arguments.nodes as usize, density);
    let samples = u64::from(arguments.samples);
    let mut column = Column {
        percent: 100.0 * density.value(),
        graphs: 0,
        finite_solvable: 0,
        proved: 0,
        components: Vec::new(),
    };
    for first in (0..samples).step_by(BATCH as usize) {
        let batch = first..samples.min(first + BATCH);
        let graphs: Vec<_> = batch
            .clone()
            .map(|sample| sampler.draw(&mut random::generator(arguments.seed, sample)))
            .collect();
        let entries = mine::decide_all(&graphs, options)?;
        for ((sample, graph), entry) in batch.zip(&graphs).zip(entries) {
            column.count(&entry);
            if let Some(rows) = &mut keep {
                rows.push([
                    density.value().to_string(),
                    sample.to_string(),
                    graph.edges().len().to_string(),
                    entry.value.name().into(),
                    entry.rank.to_string(),
                    entry.components.to_string(),
                    entry.graph6,
                ]);
            }
        }
        progress.done(graphs.len() as u64);
    }
    column.components.sort_unstable();
    Ok(column)
}

impl Column {
    fn count(&mut self, entry: &Entry) {
        self.graphs += 1;
        self.finite_solvable += u64::from(entry.value != Value::NotFiniteSolvable);
        self.proved += u64::from(entry.strength == Strength::Proof);
        self.components.push(entry.components);
    }

    fn least(&self) -> usize {
        self.components.first().copied().unwrap_or(0)
    }

    fn most(&self) -> usize {
        self.components.last().copied().unwrap_or(0)
    }

    fn mean(&self) -> f64 {
        self.components.iter().sum::<usize>() as f64 / self.components.len() as f64
    }

    fn point(&self) -> Point {
        Point {
            density: self.percent / 100.0,
            share: self.finite_solvable as f64 / self.graphs as f64,
            components: [self.least() as f64, self.mean(), self.most() as f64],
        }
    }
}

/// The table, with the published one beside it.
///
/// `p` is that of Fisher's exact test that both counts have the same probability behind
/// them; `beyond` says how many of our graphs have fewer or more components than
/// any of the published ones.
fn write_table(
    out: &mut impl Write,
    columns: &[Column],
    published: &[Published],
) -> std::io::Result<()> {
    write!(
        out,
        "density %  graphs  fin_solv  proved  components        mean"
    )?;
    if !published.is_empty() {
        write!(out, "   published: fin_solv  components       p  beyond")?;
    }
    writeln!(out)?;
    for column in columns {
        write!(
            out,
            "{:>9}  {:>6}  {:>8}  {:>6}  {:>10}  {:>10.2}",
            format!("{}", column.percent),
            column.graphs,
            column.finite_solvable,
            column.proved,
            format!("[{} {}]", column.least(), column.most()),
            column.mean(),
        )?;
        let same = |other: &&Published| (other.percent - column.percent).abs() < 1e-9;
        if let Some(other) = published.iter().find(same) {
            let p = fisher(
                [column.finite_solvable, column.graphs],
                [other.finite_solvable, other.graphs],
            );
            let below = column.components.iter().filter(|&&c| c < other.least);
            let above = column.components.iter().filter(|&&c| c > other.most);
            write!(
                out,
                "  {:>20}  {:>10}  {p:>6.3}  {:>2} {:>2}",
                format!("{} of {}", other.finite_solvable, other.graphs),
                format!("[{} {}]", other.least, other.most),
                below.count(),
                above.count(),
            )?;
        }
        writeln!(out)?;
    }
    out.flush()
}

fn read_table(path: &Path) -> Result<Vec<Published>> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let refused = |line| format!("{}:{line}: not a line of the table", path.display());
    let lines = values::lines(&text).map_err(|quote| anyhow!("{}", refused(quote.line)))?;
    lines
        .iter()
        .skip(1)
        .map(|(line, cells)| published(cells).with_context(|| refused(*line)))
        .collect()
}

fn published(cells: &csv::StringRecord) -> Option<Published> {
    let (percent, graphs, finite_solvable, least, most) = cells.deserialize(None).ok()?;
    (cells.len() == 5 && finite_solvable <= graphs).then_some(Published {
        percent,
        graphs,
        finite_solvable,
        least,
        most,
    })
}
