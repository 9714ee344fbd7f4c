//! `viewcert-lab catalog`: candidates, verdicts, a table.

mod verdicts;

use crate::report::verdicts as of_verdicts;
use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Instant;
use viewcert::linalg::prime::DEFAULT_PRIME;
use viewcert_catalog::mine::{COLUMNS, Entry};
use viewcert_formats::csv;
use viewcert_lab_catalog::progress::Progress;
use viewcert_lab_catalog::shard_files::{CANDIDATES, MOST_CANDIDATES};
use viewcert_lab_catalog::work::Listener;
use viewcert_lab_catalog::{Files, Recheck, Sample, Settings, Shard, Source, Work, merged};
use viewcert_report::{counted, table};
use viewcert_session::exit::{BAD_INPUT, GOOD, NOT};
use viewcert_session::{Session, complain};

/// Options of the catalog.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
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
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_CANDIDATES)))]
    part: Option<u32>,
    /// With --out: keep the lines of finite-solvable graphs and of unproved verdicts only.
    #[arg(long, requires = "out")]
    solvable_only: bool,
    /// With --out: write the certificates of these lines too, for `verify check DIR/certificates`.
    #[arg(long, requires = "out", conflicts_with = "verdicts")]
    certificates: bool,
    /// With --out: only make the folder ready for all shards, which then need not find the kernels
    /// themselves.
    #[arg(long, requires = "out")]
    prepare: bool,
    /// Compute with so many threads [default: one for each core].
    #[arg(long, value_name = "N", global = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
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

#[derive(Subcommand)]
enum Command {
    /// Verify that all shards of one run are there, whole and once each, and print its table.
    Merge(MergeArguments),
}

/// What to merge.
#[derive(Args)]
struct MergeArguments {
    /// The folder that was given to `--out`.
    folder: PathBuf,
    /// Decide a share of the graphs (1%) or all of them again, and hold the files against that; of
    /// verdicts, blocks.
    #[arg(long, value_name = "SHARE")]
    recheck: Option<Sample>,
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

impl Arguments {
    /// Where the candidates with so many nodes come from.
    fn source(&self, nodes: usize) -> Result<Source> {
        if let Some(path) = &self.from {
            return Ok(Source::File { path: path.clone() });
        }
        if self.minimal {
            return Source::minimal(nodes);
        }
        Ok(Source::size(nodes, self.edges, self.necessary)?)
    }

    fn settings(&self) -> Settings {
        Settings {
            solutions: self.solutions,
            prime: self.prime,
            seed: self.seed,
        }
    }

    /// Where entries are written.
    fn files(&self) -> Option<Files> {
        self.out.clone().map(|folder| Files {
            folder,
            part: self.part.unwrap_or(CANDIDATES),
            solvable_only: self.solvable_only,
            certificates: self.certificates,
        })
    }
}

/// Decides the candidates and prints the table.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global().context("--threads")?;
    }
    if let Some(Command::Merge(arguments)) = &arguments.command {
        return merge(session, arguments);
    }
    // What cannot be asked for is refused before anything is made.
    let options = arguments.settings().options(session.watch())?;
    let sizes = arguments.nodes.clone().map_or(0..=0, |nodes| nodes.0);
    let several = sizes.clone().nth(1).is_some();
    if several && (arguments.edges.is_some() || arguments.out.is_some()) {
        bail!("--edges and --out go with a single number of nodes");
    }
    if arguments.verdicts {
        return verdicts::run(session, arguments, sizes, &options);
    }
    let mut found = Found::default();
    if arguments.list {
        let mut list = csv::Writer::tabs(std::io::stdout().lock());
        list.row(COLUMNS).context("standard output")?;
        for nodes in sizes {
            of_size(session, arguments, nodes, &mut found, &mut |entry| {
                list.row(entry.cells()).context("standard output")
            })?;
        }
        list.finish().context("standard output")?;
    } else {
        for nodes in sizes {
            of_size(session, arguments, nodes, &mut found, &mut |_| Ok(()))?;
        }
        if !arguments.prepare {
            table::write(&mut std::io::stdout().lock(), &found.rows).context("standard output")?;
        }
    }
    let code = if found.bad_lines > 0 { BAD_INPUT } else { GOOD };
    Ok(code)
}

/// Verifies every shard and prints the table of the whole.
fn merge(session: &Session, arguments: &MergeArguments) -> Result<u8> {
    let recheck = arguments.recheck.map(|sample| Recheck {
        sample,
        watch: session.watch(),
        progress: Progress::new("graphs", None),
    });
    let merged = merged(&arguments.folder, recheck)?;
    let agrees = merged.agrees();
    of_verdicts::write_merged(&mut std::io::stdout().lock(), merged).context("standard output")?;
    Ok(if agrees { GOOD } else { NOT })
}

/// Says what was damaged and is made again.
fn note(words: String) {
    // Nobody is there to be told if it cannot be said.
    let _ = writeln!(std::io::stderr(), "viewcert-lab: {words}");
}

/// What was counted.
#[derive(Default)]
struct Found {
    rows: Vec<table::Row>,
    bad_lines: u64,
}

/// Decides the candidates with so many nodes, and adds a row of the table; `list` takes the entries.
fn of_size(
    session: &Session,
    arguments: &Arguments,
    nodes: usize,
    found: &mut Found,
    list: &mut dyn FnMut(&Entry) -> Result<()>,
) -> Result<()> {
    let start = Instant::now();
    let source = arguments.source(nodes)?;
    let work = Work {
        source: &source,
        settings: arguments.settings(),
        shard: arguments.shard,
        files: arguments.files(),
    };
    // What is kept in the folder says how many candidates there are.
    work.prepare(session.outputs(), &mut note)?;
    if arguments.prepare {
        return Ok(());
    }
    let own = own_share(arguments.shard, &source)?;
    let mut solutions = BTreeMap::new();
    let listener = Listener {
        entry: &mut |entry| {
            if let Some(words) = entry.solutions_in_words().filter(|_| arguments.solutions) {
                *solutions.entry(words).or_default() += 1;
            }
            list(entry)
        },
        malformed: &mut |error| {
            found.bad_lines += 1;
            Ok(complain("viewcert-lab", format_args!("{error:#}"))?)
        },
        note: &mut note,
        progress: Progress::new("candidates", own),
    };
    let summary = work.run(session.outputs(), session.watch(), listener)?;
    found.rows.push(table::Row {
        name: source.name(),
        summary,
        solutions,
        seconds: Some(start.elapsed().as_secs_f64()),
    });
    Ok(())
}

/// How many candidates the shard decides, if that is known beforehand; said where it is not all.
fn own_share(shard: Shard, source: &Source) -> Result<Option<u64>> {
    let Some(total) = source.total() else {
        return Ok(None);
    };
    let own = shard.share(total);
    let (index, count) = (shard.index(), shard.count());
    if count > 1 {
        let candidates = counted(total as usize, "candidate");
        writeln!(
            std::io::stderr(),
            "viewcert-lab: shard {index}/{count}: {own} of {candidates}"
        )?;
    }
    Ok(Some(own))
}
