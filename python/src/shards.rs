//! Shards of the catalog: written, completed, merged.

use crate::catalog::{settings, source, text};
use crate::errors::{InputError, Rejected, of_any};
use crate::work::{self, Job, Told};
use anyhow::Context;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use viewcert::watch::Watch;
use viewcert_catalog::shard_files::CANDIDATES;
use viewcert_catalog::verdict_files::{Blocks, KERNELS};
use viewcert_catalog::work::Listener;
use viewcert_catalog::{Files, Recheck, Sample, Shard, Source, Work, merged};
use viewcert_report::table;
use viewcert_session::{Outputs, Progress};

/// A share of the work on a size.
#[derive(FromPyObject)]
pub(crate) struct Share {
    folder: PathBuf,
    nodes: usize,
    index: u64,
    count: u64,
    edges: Option<usize>,
    necessary: bool,
    minimal: bool,
    solutions: bool,
    verdicts: bool,
    certificates: bool,
    part: Option<u32>,
    solvable_only: bool,
    prime: Option<u64>,
    seed: u64,
    threads: Option<usize>,
}

impl Share {
    fn source(&self) -> anyhow::Result<Source> {
        source(self.nodes, self.edges, self.necessary, self.minimal)
    }

    fn shard(&self) -> anyhow::Result<Shard> {
        let shard = Shard::new(self.index, self.count);
        shard.context("a shard is one of 1 to the number of shards")
    }

    /// Does the work, or only prepares the folder for it.
    fn run(
        &self,
        watch: Watch,
        progress: Progress,
        prepare: bool,
        note: &mut dyn FnMut(String),
    ) -> anyhow::Result<()> {
        let settings = settings(self.solutions, self.prime, self.seed);
        let (source, shard, outputs) = (self.source()?, self.shard()?, Outputs::default());
        if self.verdicts {
            let size = self.part.unwrap_or(KERNELS);
            let blocks = Blocks::new(&source, self.seed, size, shard, Some(&self.folder))?;
            if prepare {
                return blocks.prepare(&outputs, note);
            }
            let options = settings.options(watch)?;
            let tally = blocks.count(&options, &outputs, &progress, note, None);
            return tally.map(drop);
        }
        let work = Work {
            source: &source,
            settings,
            shard,
            files: Some(Files {
                folder: self.folder.clone(),
                part: self.part.unwrap_or(CANDIDATES),
                solvable_only: self.solvable_only,
                certificates: self.certificates,
            }),
        };
        if prepare {
            return work.prepare(&outputs, note);
        }
        let listener = Listener {
            entry: &mut |_| Ok(()),
            malformed: &mut Err,
            note,
            progress,
        };
        work.run(&outputs, watch, listener).map(drop)
    }
}

/// Writes one shard of the catalog, or completes it; or only prepares its folder. What was damaged and
/// was made again.
#[pyfunction]
#[pyo3(signature = (share, *, prepare=false, progress=None))]
pub(crate) fn catalog_shard(
    py: Python<'_>,
    share: Share,
    prepare: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Vec<String>> {
    let job = Job::within(py, (None, None), progress, Told::default())?;
    let threads = work::threads_of(share.threads)?;
    let (teller, what) = (job.told(), format!("shard {}/{}", share.index, share.count));
    let notes = Arc::new(Mutex::new(Vec::new()));
    let (noted, stop) = (notes.clone(), job.unobserved());
    let done = job.run(py, move || {
        let tell = Progress::to(Box::new(move |more| teller.counted(&what, more)));
        let mut note = |words| lock(&noted).push(words);
        threads.install(|| share.run(stop, tell, prepare, &mut note))
    })?;
    done.map_err(|error| of_any(&error))?;
    let notes = std::mem::take(&mut *lock(&notes));
    Ok(notes)
}

fn lock(notes: &Mutex<Vec<String>>) -> std::sync::MutexGuard<'_, Vec<String>> {
    notes.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The table of all shards in a folder, verified.
#[pyfunction]
#[pyo3(signature = (folder, *, recheck=None, threads=None, progress=None))]
pub(crate) fn catalog_merge(
    py: Python<'_>,
    folder: PathBuf,
    recheck: Option<&str>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let sample = recheck.map(str::parse::<Sample>).transpose();
    let sample = sample.map_err(|why| InputError::new_err(format!("recheck: {why}")))?;
    let job = Job::within(py, (None, None), progress, Told::default())?;
    let (teller, stop, threads) = (job.told(), job.unobserved(), work::threads_of(threads)?);
    let work = move || -> anyhow::Result<(String, bool)> {
        let tell = Progress::to(Box::new(move |more| teller.counted("recheck", more)));
        let recheck = sample.map(|sample| Recheck {
            sample,
            watch: stop,
            progress: tell,
        });
        let merged = threads.install(|| merged(&folder, recheck))?;
        let agrees = merged.agrees();
        let table = text(|out| table::write_merged(out, merged))?;
        Ok((table, agrees))
    };
    let (table, agrees) = job.run(py, work)?.map_err(|error| of_any(&error))?;
    if agrees {
        Ok(table)
    } else {
        Err(Rejected::new_err((String::new(), table)))
    }
}
