//! A shard of a source, decided batch by batch: counted, or written to part files.

use crate::progress::Progress;
use crate::run::Run;
use crate::settings::{Files, Settings};
use crate::shard::Shard;
use crate::shard_files::{MOST_CANDIDATES, Writer};
use crate::source::{Certified, Decided, Source};
use anyhow::{Error, Result, ensure};
use viewcert::decide::Options;
use viewcert::graph::Graph;
use viewcert::watch::Watch;
use viewcert_catalog::mine::{Entry, Summary};
use viewcert_session::Outputs;

/// How many candidates are decided in one go.
const BATCH: usize = 4096;

/// Which part of the work on a source, and where to.
pub struct Work<'a> {
    /// Where candidates come from.
    pub source: &'a Source,
    /// How they are decided.
    pub settings: Settings,
    /// Which of them.
    pub shard: Shard,
    /// The files that entries are written to; an earlier run of the same is completed.
    pub files: Option<Files>,
}

/// Whom the work tells of what it finds.
pub struct Listener<'a> {
    /// Learns of every entry, unless they are written to files.
    pub entry: &'a mut dyn FnMut(&Entry) -> Result<()>,
    /// Learns of every malformed candidate.
    pub malformed: &'a mut dyn FnMut(Error) -> Result<()>,
    /// Learns of what was damaged and is made again.
    pub note: &'a mut dyn FnMut(String),
    /// Learns how many candidates have been decided.
    pub progress: Progress,
}

impl Work<'_> {
    /// Makes the folder this run's, and keeps there what all shards need, the kernels: whoever does that
    /// first spares all others the time. Without files nothing happens.
    ///
    /// # Errors
    /// A folder of another run or split, or one that cannot be written.
    pub fn prepare(&self, outputs: &Outputs, note: &mut dyn FnMut(String)) -> Result<()> {
        let Some((files, run)) = self.run_of_files()? else {
            return Ok(());
        };
        run.claim(outputs, &files.folder, note)?;
        self.source.keep(outputs, &files.folder, true, note)
    }

    /// Decides the candidates of the shard, and counts them.
    ///
    /// # Errors
    /// Settings that there cannot be, a folder of another run or that cannot be written, those of the
    /// listener; if the work is stopped by the watch.
    pub fn run(&self, outputs: &Outputs, watch: Watch, listener: Listener) -> Result<Summary> {
        let options = self.settings.options(watch)?;
        self.prepare(outputs, listener.note)?;
        let mut miner = Miner {
            work: self,
            options: &options,
            listener,
            parts: self.writer(outputs)?,
            batch: Vec::with_capacity(BATCH),
            summary: Summary::default(),
        };
        let mut failure = None;
        self.source.for_each_of(self.shard, &mut |graph| {
            failure = miner.take(graph).err();
            failure.is_none()
        })?;
        match failure {
            Some(error) => Err(error),
            None => miner.finish(),
        }
    }

    fn run_of_files(&self) -> Result<Option<(&Files, Run)>> {
        let Some(files) = &self.files else {
            return Ok(None);
        };
        ensure!(
            (1..=MOST_CANDIDATES).contains(&files.part),
            "a part file has 1 to {MOST_CANDIDATES} candidates"
        );
        let source = self.source.described();
        let run = Run::of_entries(source, self.settings, files, self.shard.count());
        Ok(Some((files, run)))
    }

    fn writer<'a>(&self, outputs: &'a Outputs) -> Result<Option<Writer<'a>>> {
        let Some((files, run)) = self.run_of_files()? else {
            return Ok(None);
        };
        let folder = files.folder.clone();
        Ok(Some(Writer::open(outputs, folder, self.shard, run)?))
    }
}

/// Decides candidates batch by batch, and passes on what is found.
struct Miner<'a, 'l> {
    work: &'a Work<'a>,
    options: &'a Options,
    listener: Listener<'l>,
    parts: Option<Writer<'a>>,
    batch: Vec<Graph>,
    summary: Summary,
}

impl Miner<'_, '_> {
    /// Takes a candidate of the shard.
    fn take(&mut self, graph: Result<Graph>) -> Result<()> {
        match graph {
            Ok(graph) => self.batch.push(graph),
            Err(error) => return (self.listener.malformed)(error),
        }
        if self.batch.len() == BATCH {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<()> {
        let graphs = std::mem::take(&mut self.batch);
        let decided = graphs.len();
        let (source, options) = (self.work.source, self.options);
        let decide = |graphs: &[Graph], certified| -> Result<Vec<Decided>> {
            Ok(source.decide_all(graphs, options, certified)?)
        };
        if let Some(parts) = &mut self.parts {
            parts.push(graphs, decide)?;
            parts.notes().into_iter().for_each(&mut self.listener.note);
        } else {
            for (entry, _) in decide(&graphs, Certified::None)? {
                self.summary.count(&entry);
                (self.listener.entry)(&entry)?;
            }
        }
        self.listener.progress.done(decided as u64);
        Ok(())
    }

    fn finish(mut self) -> Result<Summary> {
        self.flush()?;
        if let Some(mut parts) = self.parts.take() {
            let (source, options) = (self.work.source, self.options);
            let decide = |graphs: &[Graph], certified| -> Result<Vec<Decided>> {
                Ok(source.decide_all(graphs, options, certified)?)
            };
            self.summary = parts.finish(decide)?;
            parts.notes().into_iter().for_each(&mut self.listener.note);
        }
        self.listener.progress.finish();
        Ok(self.summary)
    }
}
