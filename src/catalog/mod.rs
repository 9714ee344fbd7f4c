//! `verify catalog`: candidates, verdicts, a table.

mod census;
mod merge;
mod parts;
mod publish;
mod source;
mod verdicts;

use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};
use parts::{Run, Shard, Writer};
use rayon::prelude::*;
use source::Source;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;
use std::time::Instant;
use viewcert::decide::{CountSolutions, Options, Prime, Projective};
use viewcert::graph::Graph;
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert::watch::Watch;
use viewcert_report::values::Values;
use viewcert_report::{counted, table};
use viewcert_session::Session;
use viewcert_session::exit::{BAD_INPUT, GOOD};
use viewcert_session::{Progress, Told};
use viewcert_studies::catalog::mine;
use viewcert_studies::catalog::mine::{Entry, Summary};
use viewcert_studies::catalog::minimal::decide_minimal;

/// Options of the catalog.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Number of nodes, or a range of them as in 3-10.
    #[arg(long, value_name = "N", required_unless_present = "from")]
    nodes: Option<Nodes>,
    /// Number of edges [default: the least that can do, ceil((11 N - 15) / 7)].
    #[arg(long, value_name = "M", conflicts_with_all = ["from", "minimal"])]
    edges: Option<usize>,
    /// Take the candidates from a file of graph6 instead; `-` is standard input.
    #[arg(long, value_name = "FILE", conflicts_with = "nodes")]
    from: Option<PathBuf>,
    /// Leave out candidates with adjacent nodes of degree 2: they are not finite solvable.
    #[arg(long, conflicts_with_all = ["from", "minimal"])]
    necessary: bool,
    /// All graphs that are finite solvable and not so without any one edge.
    #[arg(long, conflicts_with = "from")]
    minimal: bool,
    /// Only count the finite-solvable candidates: tens of times faster, without ranks and components
    /// of the others.
    #[arg(long, conflicts_with_all = ["from", "minimal", "solvable_only", "solutions", "prime"])]
    verdicts: bool,
    /// Print a line of tab-separated values for every graph; with --verdicts, the finite-solvable
    /// ones as graph6.
    #[arg(long, conflicts_with = "out")]
    list: bool,
    /// Do part I of K of the work only.
    #[arg(long, value_name = "I/K", default_value = "1/1")]
    shard: Shard,
    /// Write the lines to part files in this folder, and go on where an earlier run ended.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Candidates per part file; with --verdicts, kernels [default: 16384, or 1024 kernels].
    #[arg(long, value_name = "COUNT", requires = "out")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    part: Option<u32>,
    /// With --out: keep the lines of finite-solvable graphs and of unproved verdicts only.
    #[arg(long, requires = "out")]
    solvable_only: bool,
    /// Count the solutions of the finite-solvable graphs: how many have each number stands under the
    /// table, and the last column of --list and --out has it for each graph: the number, or the least
    /// and the largest one that it can be.
    #[arg(long)]
    solutions: bool,
    /// Compute modulo this prime, 5 <= P < 2^62.
    #[arg(long, value_name = "P", default_value_t = DEFAULT_PRIME)]
    prime: u64,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Candidates of one size, for front ends that have no command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Size {
    /// How many nodes, 3 at least.
    pub nodes: usize,
    /// How many edges; by default the least that can do.
    pub edges: Option<usize>,
    /// Whether those with adjacent nodes of degree 2 are left out.
    pub necessary: bool,
    /// Whether graphs are wanted that are finite solvable and not so without any one edge.
    pub minimal: bool,
    /// Whether the solutions of finite-solvable graphs are counted.
    pub solutions: bool,
    /// A prime, 5 <= p < 2^62; by default 2^61 - 1.
    pub prime: Option<u64>,
    /// The seed of all draws.
    pub seed: u64,
}

/// Which part of the work on a size, and where to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The folder for all shards.
    pub folder: PathBuf,
    /// Which shard, from 1.
    pub shard: u64,
    /// Of how many.
    pub of: u64,
    /// How many candidates a part file has.
    pub part: u32,
    /// Whether only the lines of finite-solvable graphs and of unproved verdicts are kept.
    pub solvable_only: bool,
}

impl Size {
    /// The options of the command line that ask for the same.
    ///
    /// # Errors
    /// Options that exclude each other.
    fn arguments(&self, part: Option<&Part>) -> Result<Arguments> {
        if self.minimal && (self.edges.is_some() || self.necessary) {
            bail!("minimal graphs have all numbers of edges: leave out edges and necessary");
        }
        let shard = part.map_or(Ok(Shard { index: 1, count: 1 }), |part| {
            format!("{}/{}", part.shard, part.of).parse()
        });
        Ok(Arguments {
            command: None,
            nodes: Some(Nodes(self.nodes..=self.nodes)),
            edges: self.edges,
            from: None,
            necessary: self.necessary,
            minimal: self.minimal,
            list: false,
            shard: shard.map_err(anyhow::Error::msg)?,
            out: part.map(|part| part.folder.clone()),
            part: part.map(|part| part.part),
            verdicts: false,
            solvable_only: part.is_some_and(|part| part.solvable_only),
            solutions: self.solutions,
            prime: self.prime.unwrap_or(DEFAULT_PRIME),
            seed: self.seed,
        })
    }

    /// Calls `each` for every candidate, always in the same order, until it returns false.
    ///
    /// # Errors
    /// A size without candidates.
    pub fn for_each(&self, each: &mut dyn FnMut(Graph) -> bool) -> Result<()> {
        let source = Source::new(&self.arguments(None)?, self.nodes)?;
        source.for_each(&mut |graph| graph.is_ok_and(&mut *each))
    }

    /// How many candidates there are, if that is known beforehand.
    ///
    /// # Errors
    /// A size without candidates.
    pub fn total(&self) -> Result<Option<u64>> {
        Ok(Source::new(&self.arguments(None)?, self.nodes)?.total())
    }

    /// How they are decided.
    ///
    /// # Errors
    /// A number that is no prime, or too large.
    pub fn options(&self) -> Result<Options> {
        let prime = self.prime.unwrap_or(DEFAULT_PRIME);
        let field = PrimeField::new(prime).with_context(|| format!("prime {prime}"))?;
        let options = Options::default().question(question(self.solutions));
        Ok(options.prime(Prime::Fixed(field)).seed(self.seed))
    }

    /// Writes one shard, as `--shard` with `--out` does: an earlier run of the same is completed.
    /// `told` learns how many candidates have been decided since the last call.
    ///
    /// # Errors
    /// A size without candidates, a shard that there cannot be, a folder of another run or that
    /// cannot be written; if the work is stopped.
    pub fn write_shard(&self, part: &Part, watch: Watch, told: Told) -> Result<()> {
        if !(1..=1 << 20).contains(&part.part) {
            bail!("a part file has 1 to {} candidates", 1 << 20);
        }
        let arguments = self.arguments(Some(part))?;
        let source = Source::new(&arguments, self.nodes)?;
        let options = self.options()?.watch(watch);
        let list: Option<&mut Values<std::io::Sink>> = None;
        mine_all(
            &Session::default(),
            &arguments,
            &source,
            &options,
            list,
            Progress::to(told),
        )?;
        Ok(())
    }
}

/// The table that `verify catalog merge` prints: all shards of a run, checked.
///
/// # Errors
/// Shards that are missing, or do not belong together.
pub fn merged(folder: &Path) -> Result<String> {
    let mut out = Vec::new();
    merge::write(&mut out, folder)?;
    Ok(String::from_utf8(out)?)
}

#[derive(Subcommand)]
enum Command {
    /// Check that all shards of one run are there, and print its table.
    Merge(merge::Arguments),
    /// Count how many graphs of a list each camera model determines.
    Census(census::Arguments),
    /// Write the published catalog to a folder.
    Publish(publish::Arguments),
}

/// A number of nodes, or a range of them.
#[derive(Clone, Debug)]
struct Nodes(RangeInclusive<usize>);

impl FromStr for Nodes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| {
            text.parse()
                .map_err(|_| format!("{text:?} is not a number"))
        };
        let range = match text.split_once('-') {
            Some((first, last)) => number(first)?..=number(last)?,
            None => number(text)?..=number(text)?,
        };
        if range.is_empty() {
            return Err("the range is empty".into());
        }
        Ok(Self(range))
    }
}

/// What a catalog asks of its graphs.
fn question(solutions: bool) -> Projective {
    Projective::with_solutions(if solutions {
        CountSolutions::Quick
    } else {
        CountSolutions::Off
    })
}

/// How many candidates are decided in one go, per shard.
const BATCH: usize = 4096;

/// Decides the candidates and prints the table.
pub(super) fn run(session: &Session, arguments: &Arguments) -> Result<ExitCode> {
    match &arguments.command {
        Some(Command::Merge(arguments)) => return merge::run(arguments),
        Some(Command::Census(arguments)) => return census::run(session, arguments),
        Some(Command::Publish(arguments)) => return publish::run(session, arguments),
        None => (),
    }
    let field =
        PrimeField::new(arguments.prime).with_context(|| format!("--prime {}", arguments.prime))?;
    let options = Options::default()
        .question(question(arguments.solutions))
        .prime(Prime::Fixed(field))
        .seed(arguments.seed)
        .watch(session.watch());
    let sizes = arguments.nodes.clone().map_or(0..=0, |nodes| nodes.0);
    let several = sizes.clone().nth(1).is_some();
    if several && (arguments.edges.is_some() || arguments.out.is_some()) {
        bail!("--edges and --out go with a single number of nodes");
    }
    if arguments.verdicts {
        return verdicts::run(session, arguments, sizes, &options);
    }
    let mut list = arguments
        .list
        .then(|| Values::tabs(std::io::stdout().lock()));
    if let Some(list) = &mut list {
        list.row(mine::COLUMNS).context("standard output")?;
    }
    let mut rows = Vec::new();
    let mut bad_lines = 0;
    for nodes in sizes {
        let start = Instant::now();
        let source = Source::new(arguments, nodes)?;
        let progress = session.progress("candidates", own_share(arguments.shard, &source)?);
        let (found, bad) = mine_all(
            session,
            arguments,
            &source,
            &options,
            list.as_mut(),
            progress,
        )?;
        bad_lines += bad;
        rows.push(table::Row {
            name: source.name(),
            summary: found.summary,
            solutions: found.solutions,
            seconds: Some(start.elapsed().as_secs_f64()),
        });
    }
    match list {
        Some(list) => list.finish(),
        None => table::write(&mut std::io::stdout().lock(), &rows),
    }
    .context("standard output")?;
    let code = if bad_lines > 0 { BAD_INPUT } else { GOOD };
    Ok(ExitCode::from(code))
}

/// What was counted.
#[derive(Default)]
struct Found {
    summary: Summary,
    /// How many graphs have each number of solutions, if they are asked for and not written to files.
    solutions: BTreeMap<String, u64>,
}

/// Decides what a source gives; returns the counts, and the number of malformed graphs.
fn mine_all(
    session: &Session,
    arguments: &Arguments,
    source: &Source,
    options: &Options,
    list: Option<&mut Values<impl Write>>,
    progress: Progress,
) -> Result<(Found, u64)> {
    let parts = match &arguments.out {
        Some(folder) => {
            let run = Run::new(arguments, source);
            Some(Writer::open(
                session.outputs(),
                folder,
                arguments.shard,
                run,
            )?)
        }
        None => None,
    };
    let mut miner = Miner {
        arguments,
        options,
        list,
        parts,
        progress,
        batch: Vec::with_capacity(BATCH),
        found: Found::default(),
    };
    let mut failure = None;
    let (mut index, mut bad) = (0, 0);
    source.for_each(&mut |graph| {
        let done = match graph {
            Ok(graph) => {
                index += 1;
                if arguments.shard.owns(index - 1) {
                    miner.push(graph)
                } else {
                    Ok(())
                }
            }
            Err(error) => {
                bad += 1;
                writeln!(std::io::stderr(), "verify: {error:#}").map_err(Into::into)
            }
        };
        failure = done.err();
        failure.is_none()
    })?;
    match failure {
        Some(error) => Err(error),
        None => Ok((miner.finish()?, bad)),
    }
}

/// How many candidates the shard decides, if that is known beforehand; said where it is not all.
fn own_share(shard: Shard, source: &Source) -> Result<Option<u64>> {
    let Some(total) = source.total() else {
        return Ok(None);
    };
    let own = shard.share(total);
    let Shard { index, count } = shard;
    if count > 1 {
        let candidates = counted(total as usize, "candidate");
        writeln!(
            std::io::stderr(),
            "verify: shard {index}/{count}: {own} of {candidates}"
        )?;
    }
    Ok(Some(own))
}

/// Decides candidates batch by batch, and passes on what is found.
struct Miner<'a, W: Write> {
    arguments: &'a Arguments,
    options: &'a Options,
    list: Option<&'a mut Values<W>>,
    parts: Option<Writer<'a>>,
    progress: Progress,
    batch: Vec<Graph>,
    found: Found,
}

impl<W: Write> Miner<'_, W> {
    fn push(&mut self, graph: Graph) -> Result<()> {
        self.batch.push(graph);
        if self.batch.len() == BATCH {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<()> {
        let graphs = std::mem::take(&mut self.batch);
        let decided = graphs.len();
        let decide = |graphs: &[Graph]| decide(self.arguments, graphs, self.options);
        match &mut self.parts {
            Some(parts) => parts.push(graphs, decide)?,
            None => {
                for entry in decide(&graphs)? {
                    self.found.summary.count(&entry);
                    let solutions = entry.solutions_in_words();
                    if let Some(solutions) = solutions.filter(|_| self.arguments.solutions) {
                        *self.found.solutions.entry(solutions).or_default() += 1;
                    }
                    if let Some(list) = &mut self.list {
                        list.row(entry.cells()).context("standard output")?;
                    }
                }
            }
        }
        self.progress.done(decided as u64);
        Ok(())
    }

    fn finish(mut self) -> Result<Found> {
        self.flush()?;
        if let Some(parts) = self.parts {
            let decide = |graphs: &[Graph]| decide(self.arguments, graphs, self.options);
            self.found.summary = parts.finish(decide)?;
        }
        self.progress.finish();
        Ok(self.found)
    }
}

/// The entries of some candidates; with `--minimal` of those that are minimal.
fn decide(arguments: &Arguments, graphs: &[Graph], options: &Options) -> Result<Vec<Entry>> {
    if !arguments.minimal {
        return Ok(mine::decide_all(graphs, options)?);
    }
    let entries: Vec<Option<Entry>> = graphs
        .par_iter()
        .map(|graph| {
            let minimal = decide_minimal(graph, options)?;
            Ok(minimal.map(|(verdict, strength)| Entry {
                // The claim is the minimality.
                strength,
                ..Entry::new(graph, &verdict)
            }))
        })
        .collect::<Result<_>>()?;
    Ok(entries.into_iter().flatten().collect())
}
