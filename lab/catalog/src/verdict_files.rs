//! How many candidates are finite solvable, kernel by kernel, in files.
//!
//! The kernels are counted in blocks, a file each: `block-000000.json` holds the description of the run,
//! a digest of the kernels, and the counts, sealed. A file takes its name only when it is complete, so a
//! run that is started again goes on where it was stopped; what is damaged is counted again. Block k
//! belongs to shard k modulo their number, and all shards write to one folder (or to several whose files
//! are put together); so the number of shards may change.

use crate::Candidates;
use crate::counts::{Counts, Merged, Rechecked};
use crate::faults::{listed, refuse};
use crate::files;
use crate::part::Bad;
use crate::progress::Progress;
use crate::recheck::Recheck;
use crate::run::{Run, differences};
use crate::sealed;
use crate::shard::Shard;
use crate::source::Source;
use crate::verdicts::{Tally, tally};
use anyhow::{Result, bail};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::ops::Range;
use std::path::{Path, PathBuf};
use viewcert::certificate::hex;
use viewcert::decide::Options;
use viewcert_session::Outputs;

/// Kernels per block, if nothing else is asked for.
pub const KERNELS: u32 = 1024;

/// A file: the counts of a block, sealed.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Block {
    run: Run,
    block: usize,
    /// The digest of the kernels that were counted.
    kernels_sha256: String,
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
    /// those that an earlier run has written are not counted again.
    ///
    /// # Errors
    /// If the source is not that of a size.
    pub fn new(
        source: &'a Source,
        seed: u64,
        kernels_per_block: u32,
        shard: Shard,
        folder: Option<&'a Path>,
    ) -> Result<Self> {
        let Source::Size { candidates, .. } = source else {
            bail!("verdicts are counted of candidates of a size");
        };
        Ok(Self {
            candidates,
            run: Run::of_verdicts(source.described(), seed, kernels_per_block),
            shard,
            folder,
        })
    }

    /// Makes the folder this run's, and keeps there what all shards need, the kernels. Without a folder
    /// nothing happens.
    ///
    /// # Errors
    /// A folder of another run, or one that cannot be written.
    pub fn prepare(&self, outputs: &Outputs, note: &mut dyn FnMut(String)) -> Result<()> {
        let Some(folder) = self.folder else {
            return Ok(());
        };
        self.run.claim(outputs, folder, note)?;
        self.candidates.keep_kernels(outputs, folder, false, note)
    }

    /// How many blocks there are: one at least.
    fn blocks(&self) -> usize {
        let kernels = self.candidates.kernels().unwrap_or(0);
        kernels.div_ceil(self.run.part as usize).max(1)
    }

    fn kernels_of(&self, block: usize) -> Range<usize> {
        let kernels = self.candidates.kernels().unwrap_or(0);
        let size = self.run.part as usize;
        (block * size).min(kernels)..((block + 1) * size).min(kernels)
    }

    fn own(&self) -> impl Iterator<Item = usize> {
        (0..self.blocks()).filter(|&block| self.shard.has_turn(block as u64))
    }

    /// How many kernels they have.
    pub fn kernels(&self) -> u64 {
        let kernels = self.own().map(|block| self.kernels_of(block).len());
        kernels.sum::<usize>() as u64
    }

    /// The digest of the kernels of a block.
    fn digest(&self, block: usize) -> Result<String> {
        let mut hash = Sha256::new();
        let range = self.kernels_of(block);
        if !range.is_empty() {
            for kernel in self.candidates.some_kernels(range)?.iter() {
                hash.update(kernel.bytes());
            }
        }
        Ok(hex(&hash.finalize()))
    }

    /// Counts them; `list` takes the finite-solvable graphs of each block as graph6, those of blocks
    /// that were counted before excepted; `note` what was damaged and is counted again.
    ///
    /// # Errors
    /// A folder of another run or that cannot be written, those of `list`; if the work is stopped.
    pub fn count(
        &self,
        options: &Options,
        outputs: &Outputs,
        progress: &Progress,
        note: &mut dyn FnMut(String),
        mut list: Option<&mut dyn FnMut(Vec<String>) -> Result<()>>,
    ) -> Result<Tally> {
        self.prepare(outputs, note)?;
        let mut whole = Tally::default();
        for block in self.own() {
            let kernels = self.kernels_of(block);
            let path = self.folder.map(|folder| path(folder, block));
            if let Some(path) = path.as_ref().filter(|path| path.exists()) {
                match self.read(path, block)? {
                    Ok(tally) => {
                        whole.add(tally);
                        progress.done(kernels.len() as u64);
                        continue;
                    }
                    Err(Bad::Foreign(there)) => bail!(
                        "{}: a block of another run: {}; give the same options, or name another \
                         folder",
                        path.display(),
                        differences(&there, &self.run)
                    ),
                    Err(Bad::Damaged(why)) => {
                        note(format!("{}: {why}; counted again", path.display()));
                    }
                }
            }
            let done = |kernels| progress.done(kernels);
            let (tally, lines) = tally(self.candidates, kernels, options, list.is_some(), done)?;
            if let Some(list) = &mut list {
                list(lines)?;
            }
            whole.add(tally.clone());
            if let Some(path) = path {
                let block = Block {
                    run: self.run.clone(),
                    block,
                    kernels_sha256: self.digest(block)?,
                    tally,
                };
                outputs.write(&path, |out| {
                    out.write_all(sealed::sealed(&block).as_bytes())
                })?;
            }
        }
        progress.finish();
        Ok(whole)
    }

    /// What was counted before, verified.
    fn read(&self, path: &Path, block: usize) -> Result<Result<Tally, Bad>> {
        let found: Block = match sealed::read(path)? {
            Ok(found) => found,
            Err(why) => return Ok(Err(Bad::Damaged(why))),
        };
        let damaged = |why: String| Ok(Err(Bad::Damaged(why)));
        if found.run != self.run {
            return Ok(Err(Bad::Foreign(Box::new(found.run))));
        }
        if found.block != block {
            return damaged(format!("it holds block {}", found.block));
        }
        if found.kernels_sha256 != self.digest(block)? {
            return damaged("its kernels are not those that there are".into());
        }
        if !found.tally.adds_up() {
            return damaged("its candidates and its answers do not add up".into());
        }
        Ok(Ok(found.tally))
    }

    /// Verifies all blocks of a folder; what is wrong is added to the faults.
    fn all(&self, folder: &Path, faults: &mut Vec<String>) -> Result<Vec<Tally>> {
        let (mut tallies, mut missing) = (Vec::new(), Vec::new());
        for (name, path) in files::listing(folder)? {
            let number = name.strip_prefix("block-").map(|rest| {
                let number = rest.strip_suffix(".json")?.parse().ok()?;
                (number < self.blocks() && path == self::path(folder, number)).then_some(number)
            });
            if number == Some(None) {
                faults.push(format!("{}: is no block of this run", path.display()));
            }
        }
        for block in 0..self.blocks() {
            let path = path(folder, block);
            if !path.exists() {
                missing.push(block.to_string());
                continue;
            }
            match self.read(&path, block)? {
                Ok(tally) => tallies.push(tally),
                Err(Bad::Damaged(why)) => faults.push(format!(
                    "{}: {why}; run the shards again, which counts it again",
                    path.display()
                )),
                Err(Bad::Foreign(there)) => faults.push(format!(
                    "{}: of another run than run.json: {}",
                    path.display(),
                    differences(&there, &self.run)
                )),
            }
        }
        if !missing.is_empty() {
            faults.push(format!(
                "{}: {} of {} blocks are missing: {}; run the shards again to complete them",
                folder.display(),
                missing.len(),
                self.blocks(),
                listed(&missing, ", ")
            ));
        }
        Ok(tallies)
    }

    /// Counts the blocks of a sample again.
    fn again(&self, folder: &Path, tallies: &[Tally], recheck: &Recheck) -> Result<Rechecked> {
        let options = self.run.settings().options(recheck.watch.clone())?;
        let mut found = Rechecked {
            of: tallies.iter().map(|tally| tally.candidates).sum(),
            ..Rechecked::default()
        };
        let names = (0..tallies.len()).map(|block| format!("block {block}"));
        for block in recheck.sample.of(names) {
            let range = self.kernels_of(block);
            let (tally, _) = tally(self.candidates, range, &options, false, |_| ())?;
            found.graphs += tally.candidates;
            if tally != tallies[block] {
                let (path, there) = (path(folder, block), &tallies[block]);
                found.contradictions.push(format!(
                    "{}: the file says {}, counted again {}",
                    path.display(),
                    in_words(there),
                    in_words(&tally)
                ));
            }
            recheck.progress.done(tally.candidates);
        }
        recheck.progress.finish();
        Ok(found)
    }
}

fn in_words(tally: &Tally) -> String {
    let (candidates, solvable) = (tally.candidates, tally.count_finite_solvable());
    let digest = tally.finite_solvable;
    format!("{solvable} of {candidates} finite solvable ({digest})")
}

fn path(folder: &Path, block: usize) -> PathBuf {
    folder.join(format!("block-{block:06}.json"))
}

/// Verifies that all blocks of a run are there, once each; the whole.
///
/// # Errors
/// What is missing, damaged, or of another run.
pub(crate) fn merged(folder: &Path, run: &Run, recheck: Option<Recheck>) -> Result<Merged> {
    let source = run.source.source()?;
    source.find(folder, false)?;
    let Source::Size { candidates, .. } = &source else {
        bail!("{}: verdicts are counted of sizes only", folder.display());
    };
    let blocks = Blocks {
        candidates,
        run: run.clone(),
        shard: Shard::default(),
        folder: Some(folder),
    };
    let mut faults = Vec::new();
    let tallies = blocks.all(folder, &mut faults)?;
    refuse(&faults)?;
    let rechecked = match recheck {
        Some(recheck) => Some(blocks.again(folder, &tallies, &recheck)?),
        None => None,
    };
    let mut whole = Tally::default();
    tallies.into_iter().for_each(|tally| whole.add(tally));
    Ok(Merged {
        source: run.source.name(),
        counts: Counts::Verdicts(whole),
        rechecked,
    })
}
