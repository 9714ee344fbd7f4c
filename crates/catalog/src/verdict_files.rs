//! How many candidates are finite solvable, kernel by kernel, in files.
//!
//! The kernels are counted in blocks, a file each: `block-000000.json` holds the
//! description of the run, which kernels they are, and the counts. A file takes its name only when it is
//! complete, so a run that is started again goes on where it was stopped. Block k belongs to shard
//! k modulo their number, and all shards write to one folder (or to several whose files are put
//! together).

use crate::Candidates;
use crate::counts::{Counts, Merged};
use crate::shard_files::{PROGRAM, Shard, differences};
use crate::source::Source;
use crate::verdicts::{Tally, tally};
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use viewcert::decide::Options;
use viewcert_session::{Outputs, Progress};

/// Kernels per block, if nothing else is asked for.
pub const KERNELS: u32 = 1024;

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

/// Which blocks of a size are counted, and where to.
pub struct Blocks<'a> {
    candidates: &'a Candidates,
    run: Run,
    shard: Shard,
    folder: Option<&'a Path>,
}

impl<'a> Blocks<'a> {
    /// The blocks of a shard, of so many kernels each; with a folder they are written there, and
    /// those that an earlier run has written are not counted again. `None` if the source is not that of a size.
    pub fn new(
        source: &'a Source,
        seed: u64,
        kernels_per_block: u32,
        shard: Shard,
        folder: Option<&'a Path>,
    ) -> Option<Self> {
        let Source::Size { candidates, .. } = source else {
            return None;
        };
        let run = Run {
            program: PROGRAM.into(),
            source: source.name(),
            seed,
            kernels: candidates.kernels().map_or(0, <[_]>::len),
            kernels_per_block: kernels_per_block.max(1),
        };
        Some(Self {
            candidates,
            run,
            shard,
            folder,
        })
    }

    fn own(&self) -> impl Iterator<Item = usize> {
        (0..self.run.blocks()).filter(|&block| self.shard.has_turn(block as u64))
    }

    /// How many kernels they have.
    pub fn kernels(&self) -> u64 {
        let kernels = self.own().map(|block| self.run.kernels_of(block).len());
        kernels.sum::<usize>() as u64
    }

    /// Counts them; `list` takes the finite-solvable graphs of each block as graph6.
    ///
    /// # Errors
    /// A folder of another run or that cannot be written, those of `list`; if the work is stopped.
    pub fn count(
        &self,
        options: &Options,
        outputs: &Outputs,
        progress: &Progress,
        mut list: Option<&mut dyn FnMut(Vec<String>) -> Result<()>>,
    ) -> Result<Tally> {
        if let Some(folder) = self.folder {
            fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        }
        let mut whole = Tally::default();
        for block in self.own() {
            let path = self.folder.map(|folder| path(folder, block));
            if let Some(path) = path.as_ref().filter(|path| path.exists()) {
                whole.add(self.read(path, block)?);
                continue;
            }
            let kernels = self.run.kernels_of(block);
            let (tally, lines) = tally(
                self.candidates,
                kernels,
                options,
                list.is_some(),
                |kernels| progress.done(kernels),
            )?;
            if let Some(list) = &mut list {
                list(lines)?;
            }
            whole.add(tally.clone());
            if let Some(path) = path {
                let block = Block {
                    run: self.run.clone(),
                    block,
                    tally,
                };
                outputs.write(&path, |out| {
                    serde_json::to_writer(&mut *out, &block)?;
                    out.write_all(b"\n")
                })?;
            }
        }
        progress.finish();
        Ok(whole)
    }

    /// What an earlier run has counted.
    fn read(&self, path: &Path, block: usize) -> Result<Tally> {
        let found = read(path)?;
        ensure!(
            found.run == self.run && found.block == block,
            "{}: a block of another run: {}; give the same options, or name another folder",
            path.display(),
            differences(&found.run, &self.run)
        );
        Ok(found.tally)
    }
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
pub(crate) fn is_here(folder: &Path) -> Result<bool> {
    Ok(!blocks(folder)?.is_empty())
}

/// Checks that all blocks of one run are there; the whole.
pub(crate) fn merged(folder: &Path) -> Result<Merged> {
    let mut found: BTreeMap<usize, Block> = BTreeMap::new();
    let mut first: Option<Run> = None;
    for path in blocks(folder)? {
        let block = read(&path)?;
        let run = first.get_or_insert_with(|| block.run.clone());
        ensure!(
            block.run == *run,
            "{}: belongs to another run than the first block: {}",
            path.display(),
            differences(&block.run, run)
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
    Ok(Merged {
        source: run.source,
        counts: Counts::Verdicts(tally),
    })
}
