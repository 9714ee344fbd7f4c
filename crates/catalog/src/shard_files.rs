//! The part files of a shard: written whole or not at all, found again by the next run.
//!
//! A run splits its candidates into shards, block by block of 64 candidates in
//! turn; a shard splits its own ones into parts. `shard-I-of-K/part-000000.tsv` holds, in this
//! order, the description of the run, the header of the table, a line for each entry,
//! and the counts with a digest of the candidates. Since a part takes its name only when it
//! is complete, a killed run leaves complete parts; the next one compares their
//! description and digest and computes the rest. `done.json` says how many parts there are.

use crate::mine::{COLUMNS, Entry, Summary};
use crate::settings::{Files, Settings};
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::VecDeque;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use viewcert::graph::{Graph, graph6};
use viewcert_formats::csv;
use viewcert_session::Outputs;

/// Candidates that go to the same shard together.
const BLOCK: u64 = 64;

/// What a run was made by.
pub(crate) const PROGRAM: &str = concat!("viewcert ", env!("CARGO_PKG_VERSION"));

/// Candidates per part, if nothing else is asked for.
pub const CANDIDATES: u32 = 16384;

/// Most candidates that a part may have.
pub const MOST_CANDIDATES: u32 = 1 << 20;

/// The name of the file that closes a shard.
pub(crate) const DONE: &str = "done.json";

/// Part `index` of `count`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    count: u64,
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (index, count) = text.split_once('/')?;
            Self::new(index.parse().ok()?, count.parse().ok()?)
        };
        parse().ok_or("a shard is I/K with 1 <= I <= K, as in 2/8")
    }
}

impl Default for Shard {
    /// All of the work.
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl Shard {
    /// Part `index` of `count`, counted from 1; `None` if there is none.
    pub fn new(index: u64, count: u64) -> Option<Self> {
        (1 <= index && index <= count).then_some(Self { index, count })
    }

    /// Which part, from 1.
    pub fn index(self) -> u64 {
        self.index
    }

    /// Of how many.
    pub fn count(self) -> u64 {
        self.count
    }

    /// Whether the shard decides the candidate with this number.
    pub fn owns(self, candidate: u64) -> bool {
        self.has_turn(candidate / BLOCK)
    }

    /// Whether a block with this number is the shard's: blocks go to the shards in turn.
    pub fn has_turn(self, block: u64) -> bool {
        block % self.count == self.index - 1
    }

    /// How many of so many candidates the shard decides.
    pub fn share(self, candidates: u64) -> u64 {
        let round = BLOCK.saturating_mul(self.count);
        let before = BLOCK.saturating_mul(self.index - 1);
        let last = (candidates % round).saturating_sub(before).min(BLOCK);
        candidates / round * BLOCK + last
    }

    /// The name of its folder.
    pub(crate) fn folder(self) -> String {
        format!("shard-{}-of-{}", self.index, self.count)
    }
}

/// What makes two shards belong to the same run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Run {
    program: String,
    pub(crate) source: String,
    prime: u64,
    seed: u64,
    part: u32,
    solvable_only: bool,
}

impl Run {
    pub(crate) fn new(source: String, settings: Settings, files: &Files) -> Self {
        Self {
            program: PROGRAM.into(),
            source,
            prime: settings.prime,
            seed: settings.seed,
            part: files.part,
            solvable_only: files.solvable_only,
        }
    }
}

/// The last line of a part.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    summary: Summary,
    candidates_sha256: String,
}

/// The contents of `done.json`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Done {
    pub(crate) run: Run,
    pub(crate) shard: u64,
    pub(crate) of: u64,
    pub(crate) parts: u64,
    pub(crate) summary: Summary,
}

/// Writes the parts of a shard.
pub(crate) struct Writer<'a> {
    outputs: &'a Outputs,
    folder: PathBuf,
    shard: Shard,
    run: Run,
    waiting: VecDeque<Graph>,
    parts: u64,
    summary: Summary,
}

impl<'a> Writer<'a> {
    /// Makes the shard's folder if it is not there.
    pub(crate) fn open(
        outputs: &'a Outputs,
        folder: &Path,
        shard: Shard,
        run: Run,
    ) -> Result<Self> {
        let folder = folder.join(shard.folder());
        fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        Ok(Self {
            outputs,
            folder,
            shard,
            run,
            waiting: VecDeque::new(),
            parts: 0,
            summary: Summary::default(),
        })
    }

    /// Takes candidates, and writes every part that they complete.
    pub(crate) fn push(
        &mut self,
        graphs: Vec<Graph>,
        decide: impl Fn(&[Graph]) -> Result<Vec<Entry>>,
    ) -> Result<()> {
        self.waiting.extend(graphs);
        while self.waiting.len() >= self.run.part as usize {
            let part: Vec<Graph> = self.waiting.drain(..self.run.part as usize).collect();
            self.part(&part, &decide)?;
        }
        Ok(())
    }

    /// Writes the rest and closes the shard.
    pub(crate) fn finish(
        mut self,
        decide: impl Fn(&[Graph]) -> Result<Vec<Entry>>,
    ) -> Result<Summary> {
        let rest: Vec<Graph> = self.waiting.drain(..).collect();
        if !rest.is_empty() {
            self.part(&rest, &decide)?;
        }
        let done = Done {
            run: self.run,
            shard: self.shard.index,
            of: self.shard.count,
            parts: self.parts,
            summary: self.summary,
        };
        self.outputs.write(&self.folder.join(DONE), |out| {
            serde_json::to_writer(&mut *out, &done)?;
            out.write_all(b"\n")
        })?;
        Ok(self.summary)
    }

    fn part(
        &mut self,
        graphs: &[Graph],
        decide: impl Fn(&[Graph]) -> Result<Vec<Entry>>,
    ) -> Result<()> {
        let path = part_path(&self.folder, self.parts);
        let digest = digest(graphs);
        let summary = if path.exists() {
            let (summary, found) = read_part(&path, &self.run)?;
            ensure!(
                found == digest,
                "{}: made from other candidates; name another folder",
                path.display()
            );
            summary
        } else {
            let entries = decide(graphs)?;
            let mut summary = Summary::default();
            entries.iter().for_each(|entry| summary.count(entry));
            self.outputs.write(&path, |mut out| {
                serde_json::to_writer(&mut out, &self.run)?;
                out.write_all(b"\n")?;
                let mut table = csv::Writer::tabs(&mut out);
                table.row(COLUMNS)?;
                for entry in &entries {
                    if !self.run.solvable_only || entry.is_notable() {
                        table.row(entry.cells())?;
                    }
                }
                table.finish()?;
                let end = End {
                    summary,
                    candidates_sha256: digest,
                };
                serde_json::to_writer(&mut out, &end)?;
                out.write_all(b"\n")
            })?;
            summary
        };
        self.summary.add(&summary);
        self.parts += 1;
        Ok(())
    }
}

/// The path of a part.
pub(crate) fn part_path(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("part-{number:06}.tsv"))
}

fn digest(graphs: &[Graph]) -> String {
    let mut hash = Sha256::new();
    for graph in graphs {
        hash.update(graph6::encode(graph));
        hash.update(b"\n");
    }
    viewcert::certificate::hex(&hash.finalize())
}

/// Where two runs differ, in words: "the seed is 2 there and 1 here".
pub(crate) fn differences(there: &impl Serialize, here: &impl Serialize) -> String {
    let [there, here] = [serde_json::to_value(there), serde_json::to_value(here)]
        .map(|run| run.expect("numbers and words"));
    let words = |value: &Value| match value {
        Value::String(word) => word.clone(),
        Value::Bool(true) => "on".into(),
        Value::Bool(false) => "off".into(),
        other => other.to_string(),
    };
    let members = there.as_object().into_iter().flatten();
    let differing = members.filter(|(name, value)| *value != &here[name.as_str()]);
    let differing: Vec<String> = differing
        .map(|(name, value)| {
            let option = match name.as_str() {
                "program" => "the version of the program",
                "source" => "what is decided",
                "kernels" => "the number of kernels",
                "part" | "kernels_per_block" => "--part",
                "prime" => "--prime",
                "seed" => "--seed",
                "solvable_only" => "--solvable-only",
                other => other,
            };
            let (there, here) = (words(value), words(&here[name.as_str()]));
            format!("{option} is {there} there and {here} here")
        })
        .collect();
    differing.join(", ")
}

/// The counts and the digest of a part of the given run.
pub(crate) fn read_part(path: &Path, run: &Run) -> Result<(Summary, String)> {
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let parse = || -> Option<(Run, End)> {
        let first = text.lines().next()?;
        let last = text.lines().next_back()?;
        Some((
            serde_json::from_str(first).ok()?,
            serde_json::from_str(last).ok()?,
        ))
    };
    let Some((found, end)) = parse() else {
        bail!("{}: not a part of a catalog", path.display());
    };
    ensure!(
        found == *run,
        "{}: a part of another run: {}; give the same options, or name another folder",
        path.display(),
        differences(&found, run)
    );
    Ok((end.summary, end.candidates_sha256))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_a_shard_is_what_it_owns() {
        for count in [1, 2, 3, 7, 64] {
            for candidates in [0, 1, 63, 64, 65, 433, 5898] {
                for index in 1..=count {
                    let shard = Shard::new(index, count).unwrap();
                    let owned = (0..candidates).filter(|&candidate| shard.owns(candidate));
                    let owned = owned.count() as u64;
                    assert_eq!(shard.share(candidates), owned, "{shard:?} of {candidates}");
                }
            }
        }
        let count = u64::MAX;
        let shard = |index| Shard::new(index, count).unwrap();
        assert_eq!((shard(1).share(100), shard(2).share(100)), (64, 36));
        assert_eq!(shard(count).share(100), 0);
    }
}
