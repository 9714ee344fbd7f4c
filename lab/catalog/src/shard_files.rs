//! The part files of a shard: written whole or not at all, verified and found again by the next run.
//!
//! A run splits its candidates into shards, block by block of 64 candidates in turn; a shard splits its
//! own ones into parts, `shard-I-of-K/part-000000.tsv` and so on (`part.rs`). Since a part
//! takes its name only when it is complete, a killed run leaves complete parts; the next one verifies
//! them, and computes what is missing or damaged. `done.json` says how many parts there are.

use crate::part::{Bad, CERTIFICATES, Part, Place, digest};
use crate::run::{Run, differences};
use crate::sealed;
use crate::set_digest::SetDigest;
use crate::shard::Shard;
use crate::source::{Certified, Decided};
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::fs;
use std::path::PathBuf;
use viewcert::graph::Graph;
use viewcert_catalog::mine::Summary;
use viewcert_session::Outputs;

/// Candidates per part, if nothing else is asked for.
pub const CANDIDATES: u32 = 16384;

/// Most candidates that a part may have.
pub const MOST_CANDIDATES: u32 = 1 << 20;

/// The name of the file that closes a shard.
pub(crate) const DONE: &str = "done.json";

/// The contents of `done.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Done {
    pub(crate) run: Run,
    pub(crate) shard: u64,
    pub(crate) of: u64,
    pub(crate) totals: Totals,
}

/// What some parts have together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Totals {
    pub(crate) parts: u64,
    pub(crate) candidates: u64,
    pub(crate) summary: Summary,
    pub(crate) rows: SetDigest,
}

impl Totals {
    /// Adds others.
    pub(crate) fn add(&mut self, other: &Self) {
        self.parts += other.parts;
        self.candidates += other.candidates;
        self.summary.add(&other.summary);
        self.rows.add(&other.rows);
    }

    /// Those of a part.
    pub(crate) fn of(part: &crate::part::End) -> Self {
        Self {
            parts: 1,
            candidates: part.candidates,
            summary: part.summary,
            rows: part.rows,
        }
    }
}

/// Writes the parts of a shard.
pub(crate) struct Writer<'a> {
    outputs: &'a Outputs,
    folder: PathBuf,
    shard: Shard,
    run: Run,
    waiting: VecDeque<Graph>,
    totals: Totals,
    notes: Vec<String>,
}

/// How candidates are decided.
pub(crate) trait Decide: Fn(&[Graph], Certified) -> Result<Vec<Decided>> {}

impl<T: Fn(&[Graph], Certified) -> Result<Vec<Decided>>> Decide for T {}

impl<'a> Writer<'a> {
    /// Makes the shard's folder, in one that belongs to the run, if it is not there.
    pub(crate) fn open(
        outputs: &'a Outputs,
        folder: PathBuf,
        shard: Shard,
        run: Run,
    ) -> Result<Self> {
        let mut folders = vec![folder.join(shard.folder())];
        if run.certificates {
            folders.push(folder.join(CERTIFICATES));
        }
        for folder in folders {
            fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        }
        Ok(Self {
            outputs,
            folder,
            shard,
            run,
            waiting: VecDeque::new(),
            totals: Totals::default(),
            notes: Vec::new(),
        })
    }

    /// Takes candidates, and writes every part that they complete.
    pub(crate) fn push(&mut self, graphs: Vec<Graph>, decide: impl Decide) -> Result<()> {
        self.waiting.extend(graphs);
        while self.waiting.len() >= self.run.part as usize {
            let part: Vec<Graph> = self.waiting.drain(..self.run.part as usize).collect();
            self.part(&part, &decide)?;
        }
        Ok(())
    }

    /// What was found damaged since this was last asked.
    pub(crate) fn notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Writes the rest and closes the shard.
    pub(crate) fn finish(&mut self, decide: impl Decide) -> Result<Summary> {
        let rest: Vec<Graph> = self.waiting.drain(..).collect();
        if !rest.is_empty() {
            self.part(&rest, &decide)?;
        }
        let done = Done {
            run: self.run.clone(),
            shard: self.shard.index(),
            of: self.shard.count(),
            totals: self.totals,
        };
        let path = self.folder.join(self.shard.folder()).join(DONE);
        self.outputs
            .write(&path, |out| out.write_all(sealed::sealed(&done).as_bytes()))?;
        Ok(self.totals.summary)
    }

    fn part(&mut self, graphs: &[Graph], decide: impl Decide) -> Result<()> {
        let place = Place {
            folder: &self.folder,
            shard: self.shard,
            part: self.totals.parts,
        };
        let found = if place.path().exists() {
            Some(place.read(&self.run)?)
        } else {
            None
        };
        let end = match found {
            Some(Ok(Part { end, .. })) => {
                ensure!(
                    end.candidates_sha256 == digest(graphs),
                    "{}: made from other candidates; name another folder",
                    place.path().display()
                );
                end
            }
            Some(Err(Bad::Foreign(there))) => bail!(
                "{}: a part of another run: {}; give the same options, or name another folder",
                place.path().display(),
                differences(&there, &self.run)
            ),
            found => {
                if let Some(Err(Bad::Damaged(why))) = found {
                    let path = place.path();
                    self.notes
                        .push(format!("{}: {why}; computed again", path.display()));
                }
                let run = &self.run;
                let certified = match (run.certificates, run.solvable_only) {
                    (false, _) => Certified::None,
                    (true, true) => Certified::Notable,
                    (true, false) => Certified::All,
                };
                let entries = decide(graphs, certified)?;
                place.write(self.outputs, run, graphs, &entries)?
            }
        };
        self.totals.add(&Totals::of(&end));
        Ok(())
    }
}
