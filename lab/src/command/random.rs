//! `viewcert-lab random`: connected random graphs, the paper's Table 2.

use anyhow::{Context, Result, anyhow};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert::decide::{CountSolutions, Options, Question, Strength, Value};
use viewcert_catalog::mine;
use viewcert_catalog::mine::Entry;
use viewcert_formats::csv;
use viewcert_lab_catalog::progress::Progress;
use viewcert_lab_catalog::random;
use viewcert_lab_catalog::random::{Density, Sampler, fisher};
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Options of the random experiment.
#[derive(Args)]
pub struct Arguments {
    /// Number of nodes.
    #[arg(long, value_name = "N", default_value_t = 20)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=40))]
    nodes: u32,
    /// Probability of a pair, as in 0.05 or 5%; may be repeated or listed with commas.
    #[arg(long, value_name = "D", value_delimiter = ',')]
    #[arg(default_value = "5%,10%,20%,30%,40%,50%,60%,70%")]
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

/// Draws and decides graphs, and prints the table.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let csv = arguments.csv.as_deref();
    let inputs = arguments.compare.as_deref();
    outputs::ensure_apart(&[("--csv", csv)], inputs)?;
    let published = match &arguments.compare {
        Some(path) => read_table(path)?,
        None => Vec::new(),
    };
    let options = Options::default()
        .question(Question::with_solutions(CountSolutions::Off))
        .seed(arguments.seed)
        .watch(session.watch());
    let mut columns = Vec::new();
    let mut rows = Vec::new();
    let samples = u64::from(arguments.samples);
    let progress = Progress::new("graphs", Some(samples * arguments.density.len() as u64));
    for density in &arguments.density {
        let keep = csv.is_some().then_some(&mut rows);
        columns.push(at_density(arguments, density, &options, &progress, keep)?);
    }
    progress.finish();
    columns.sort_by(|a, b| a.percent.total_cmp(&b.percent));
    if let Some(path) = csv {
        session.outputs().write(path, |out| {
            let mut table = csv::Writer::commas(out);
            table.row(GRAPH_COLUMNS)?;
            rows.iter().try_for_each(|row| table.row(row))?;
            table.finish()
        })?;
    }
    let mut out = outputs::text(&[csv]);
    write_table(&mut out, &columns, &published).context("standard output")?;
    Ok(GOOD)
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
    arguments: &Arguments,
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
    let lines = csv::lines(&text, b',').map_err(|quote| anyhow!("{}", refused(quote.line)))?;
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
