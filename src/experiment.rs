//! `verify experiment`: the experiments of the paper.

use super::progress::Progress;
use super::{GOOD, atomic, running};
use crate::report::plot::{Point, plot};
use anyhow::{Context, Result, ensure};
use clap::{Args, Subcommand};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use viewcert::decide::{Options, Strength, Value};
use viewcert_studies::catalog::mine;
use viewcert_studies::catalog::random;
use viewcert_studies::catalog::random::{Density, Sampler, fisher};

#[derive(Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Connected random graphs (the paper's Table 2).
    Random(Random),
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
    let Command::Random(arguments) = &arguments.command;
    let (csv, svg) = (arguments.csv.as_deref(), arguments.svg.as_deref());
    let inputs = arguments.compare.as_deref();
    atomic::ensure_apart(&[("--csv", csv), ("--svg", svg)], inputs)?;
    let published = match &arguments.compare {
        Some(path) => read_table(path)?,
        None => Vec::new(),
    };
    let options = Options::default()
        .seed(arguments.seed)
        .watch(running::watch());
    let mut columns = Vec::new();
    let mut lines = Vec::new();
    let samples = u64::from(arguments.samples);
    let progress = Progress::new(Some(samples * arguments.density.len() as u64));
    for density in &arguments.density {
        let sampler = Sampler::new(arguments.nodes as usize, density);
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
            let entries = mine::decide_all(&graphs, &options)?;
            for ((sample, graph), entry) in batch.zip(&graphs).zip(entries) {
                column.graphs += 1;
                column.finite_solvable += u64::from(entry.value != Value::NotFiniteSolvable);
                column.proved += u64::from(entry.strength == Strength::Proof);
                column.components.push(entry.components);
                if arguments.csv.is_some() {
                    lines.push(format!(
                        "{},{sample},{},{},{},{},{}",
                        density.value(),
                        graph.edges().len(),
                        entry.value.name(),
                        entry.rank,
                        entry.components,
                        quoted(&entry.graph6),
                    ));
                }
            }
            progress.done(graphs.len() as u64);
        }
        column.components.sort_unstable();
        columns.push(column);
    }
    progress.finish();
    columns.sort_by(|a, b| a.percent.total_cmp(&b.percent));
    if let Some(path) = &arguments.csv {
        atomic::write(path, |out| {
            writeln!(out, "density,sample,edges,verdict,rank,components,graph6")?;
            lines.iter().try_for_each(|line| writeln!(out, "{line}"))
        })?;
    }
    if let Some(path) = &arguments.svg {
        let points: Vec<Point> = columns.iter().map(Column::point).collect();
        atomic::write(path, |out| out.write_all(plot(&points).as_bytes()))?;
    }
    let mut out = atomic::text(&[csv, svg]);
    write_table(&mut out, &columns, &published).context("standard output")?;
    Ok(ExitCode::from(GOOD))
}

/// A field of comma-separated values that may hold any character but a line end.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

impl Column {
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
    let mut rows = Vec::new();
    for (k, line) in text.lines().enumerate().skip(1) {
        let parse = || {
            let mut fields = line.split(',');
            let row = Published {
                percent: fields.next()?.parse().ok()?,
                graphs: fields.next()?.parse().ok()?,
                finite_solvable: fields.next()?.parse().ok()?,
                least: fields.next()?.parse().ok()?,
                most: fields.next()?.parse().ok()?,
            };
            (fields.next().is_none() && row.finite_solvable <= row.graphs).then_some(row)
        };
        let row = parse();
        ensure!(
            row.is_some(),
            "{}:{}: not a line of the table",
            path.display(),
            k + 1
        );
        rows.extend(row);
    }
    Ok(rows)
}
