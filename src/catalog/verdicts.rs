//! `verify catalog --verdicts`: how many candidates are finite solvable, kernel by kernel.
//!
//! With `--out` the kernels are counted in blocks, a file each: `block-000000.json` holds the
//! description of the run, which kernels they are, and the counts. A file takes its name only when it is
//! complete, so a run that is started again goes on where it was stopped. Block k belongs to shard
//! k modulo their number, and all shards write to one folder (or to several whose files are put
//! together).

use super::Arguments;
use super::parts::{self, PROGRAM};
use super::source::Source;
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide::Options;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;
use viewcert_studies::catalog::Candidates;
use viewcert_studies::catalog::verdicts::{Tally, tally};

/// Kernels per block, if nothing else is asked for.
const KERNELS: u32 = 1024;

/// What makes two blocks belong to the same run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Run {
    program: String,
    source: String,
    seed: u64,
    kernels: usize,
    kernels_per_block: u32,
}

impl Run {
    /// How many blocks there are: one at least.
    fn blocks(&self) -> usize {
        self.kernels
            .div_ceil(self.kernels_per_block as usize)
            .max(1)
    }

    fn kernels_of(&self, block: usize) -> Range<usize> {
        let size = self.kernels_per_block as usize;
        (block * size).min(self.kernels)..((block + 1) * size).min(self.kernels)
    }
}

/// A file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Block {
    run: Run,
    block: usize,
    tally: Tally,
}

/// One line of the table.
struct Row {
    name: String,
    tally: Tally,
    seconds: Option<f64>,
}

/// Counts all sizes, and prints a table or the finite-solvable graphs.
pub(super) fn run(
    session: &Session,
    arguments: &Arguments,
    sizes: RangeInclusive<usize>,
    options: &Options,
) -> Result<ExitCode> {
    let mut out = outputs::text(&[]);
    let mut rows = Vec::new();
    for nodes in sizes {
        let start = Instant::now();
        let source = Source::new(arguments, nodes)?;
        let Source::Size { candidates, .. } = &source else {
            unreachable!("a size, as nothing else goes with --verdicts");
        };
        let run = Run {
            program: PROGRAM.into(),
            source: source.name(),
            seed: arguments.seed,
            kernels: candidates.kernels().map_or(0, <[_]>::len),
            kernels_per_block: arguments.part.unwrap_or(KERNELS),
        };
        let tally = of_size(session, arguments, &run, candidates, options, &mut out)?;
        rows.push(Row {
            name: run.source,
            tally,
            seconds: Some(start.elapsed().as_secs_f64()),
        });
    }
    if !arguments.list {
        write(&mut out, &rows)?;
    }
    out.flush().context("standard output")?;
    Ok(ExitCode::from(GOOD))
}

/// The counts of one size, or of a shard of it.
fn of_size(
    session: &Session,
    arguments: &Arguments,
    run: &Run,
    candidates: &Candidates,
    options: &Options,
    out: &mut impl Write,
) -> Result<Tally> {
    if let Some(folder) = &arguments.out {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    let own = (0..run.blocks()).filter(|&block| arguments.shard.has_turn(block as u64));
    let kernels = own.clone().map(|block| run.kernels_of(block).len() as u64);
    let progress = session.progress("kernels", Some(kernels.sum()));
    let mut whole = Tally::default();
    for block in own {
        let path = arguments.out.as_ref().map(|folder| path(folder, block));
        if let Some(path) = path.as_ref().filter(|path| path.exists()) {
            let found = read(path)?;
            ensure!(
                found.run == *run && found.block == block,
                "{}: a block of another run: {}; give the same options, or name another folder",
                path.display(),
                parts::differences(&found.run, run)
            );
            whole.add(found.tally);
            continue;
        }
        let (tally, lines) = tally(
            candidates,
            run.kernels_of(block),
            options,
            arguments.list,
            |kernels| progress.done(kernels),
        )?;
        for line in lines {
            writeln!(out, "{line}").context("standard output")?;
        }
        whole.add(tally.clone());
        if let Some(path) = path {
            let block = Block {
                run: run.clone(),
                block,
                tally,
            };
            session.outputs().write(&path, |out| {
                serde_json::to_writer(&mut *out, &block)?;
                out.write_all(b"\n")
            })?;
        }
    }
    progress.finish();
    Ok(whole)
}

fn path(folder: &Path, block: usize) -> PathBuf {
    folder.join(format!("block-{block:06}.json"))
}

fn read(path: &Path) -> Result<Block> {
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    serde_json::from_str(&text)
        .with_context(|| format!("{}: not a block of verdicts", path.display()))
}

/// The blocks in a folder.
fn blocks(folder: &Path) -> Result<Vec<PathBuf>> {
    let listing = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths = Vec::new();
    for item in listing {
        let item = item.with_context(|| folder.display().to_string())?;
        let name = item.file_name();
        let name = name.to_string_lossy();
        if name.starts_with("block-") && name.ends_with(".json") {
            paths.push(item.path());
        }
    }
    paths.sort();
    Ok(paths)
}

/// Whether a folder has blocks of verdicts.
pub(super) fn is_here(folder: &Path) -> Result<bool> {
    Ok(!blocks(folder)?.is_empty())
}

/// Checks that all blocks of one run are there, and writes the table of the whole.
pub(super) fn write_merged(out: &mut impl Write, folder: &Path) -> Result<()> {
    let mut found: BTreeMap<usize, Block> = BTreeMap::new();
    let mut first: Option<Run> = None;
    for path in blocks(folder)? {
        let block = read(&path)?;
        let run = first.get_or_insert_with(|| block.run.clone());
        ensure!(
            block.run == *run,
            "{}: belongs to another run than the first block: {}",
            path.display(),
            parts::differences(&block.run, run)
        );
        ensure!(
            path == self::path(folder, block.block) && block.block < run.blocks(),
            "{}: holds block {}",
            path.display(),
            block.block
        );
        found.insert(block.block, block);
    }
    let Some(run) = first else {
        bail!("{}: no blocks here", folder.display());
    };
    let missing = (0..run.blocks()).filter(|block| !found.contains_key(block));
    let missing: Vec<String> = missing.map(|block| block.to_string()).collect();
    ensure!(
        missing.is_empty(),
        "{}: {} of {} blocks are missing: {}; run the shards again to complete them",
        folder.display(),
        missing.len(),
        run.blocks(),
        missing[..missing.len().min(10)].join(", ")
    );
    let mut tally = Tally::default();
    for block in found.into_values() {
        tally.add(block.tally);
    }
    let row = Row {
        name: run.source,
        tally,
        seconds: None,
    };
    write(out, &[row]).context("standard output")
}

/// Writes the table, the digests, and what is not proved.
fn write(out: &mut impl Write, rows: &[Row]) -> io::Result<()> {
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or(0);
    writeln!(
        out,
        "{:width$}  candidates  fin_solv  contract  proved negative  one block  several  \
         otherwise  unproved  seconds",
        ""
    )?;
    for Row {
        name,
        tally,
        seconds,
    } in rows
    {
        let seconds = seconds.map_or(String::new(), |seconds| format!("{seconds:.2}"));
        writeln!(
            out,
            "{name:width$}  {:>10}  {:>8}  {:>8}  {:>15}  {:>9}  {:>7}  {:>9}  {:>8}  {seconds:>7}",
            tally.candidates,
            tally.count_finite_solvable(),
            tally.unique,
            tally.refuted(),
            tally.by_one_block,
            tally.by_blocks,
            tally.otherwise,
            tally.unproved.len(),
        )?;
    }
    for Row { name, tally, .. } in rows {
        writeln!(out, "{name}: finite solvable {}", tally.finite_solvable)?;
        for graph in &tally.unproved {
            writeln!(out, "{name}: unproved {graph}")?;
        }
    }
    Ok(())
}
