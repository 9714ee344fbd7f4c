//! A shard of a source, decided batch by batch: counted, or written to part files.

use crate::mine::{Entry, Summary};
use crate::settings::{Files, Settings};
use crate::shard_files::{MOST_CANDIDATES, Run, Shard, Writer};
use crate::source::Source;
use anyhow::{Error, Result, ensure};
use viewcert::decide::Options;
use viewcert::graph::Graph;
use viewcert::watch::Watch;
use viewcert_session::{Outputs, Progress};

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
    /// Learns how many candidates have been decided.
    pub progress: Progress,
}

impl Work<'_> {
    /// Decides the candidates of the shard, and counts them.
    ///
    /// # Errors
    /// Settings that there cannot be, a folder of another run or that cannot be written, those of the
    /// listener; if the work is stopped by the watch.
    pub fn run(&self, outputs: &Outputs, watch: Watch, listener: Listener) -> Result<Summary> {
        let options = self.settings.options(watch)?;
        let mut miner = Miner {
            work: self,
            options: &options,
            listener,
            parts: self.writer(outputs)?,
            batch: Vec::with_capacity(BATCH),
            summary: Summary::default(),
        };
        let mut failure = None;
        let mut index = 0;
        self.source.for_each(&mut |graph| {
            failure = miner.take(graph, &mut index).err();
            failure.is_none()
        });
        match failure {
            Some(error) => Err(error),
            None => miner.finish(),
        }
    }

    fn writer<'a>(&self, outputs: &'a Outputs) -> Result<Option<Writer<'a>>> {
        let Some(files) = &self.files else {
            return Ok(None);
        };
        ensure!(
            (1..=MOST_CANDIDATES).contains(&files.part),
            "a part file has 1 to {MOST_CANDIDATES} candidates"
        );
        let run = Run::new(self.source.name(), self.settings, files);
        Ok(Some(Writer::open(outputs, &files.folder, self.shard, run)?))
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
    /// Takes a candidate if it is the shard's; `index` counts those that are graphs.
    fn take(&mut self, graph: Result<Graph>, index: &mut u64) -> Result<()> {
        let graph = match graph {
            Ok(graph) => graph,
            Err(error) => return (self.listener.malformed)(error),
        };
        *index += 1;
        if !self.work.shard.owns(*index - 1) {
            return Ok(());
        }
        self.batch.push(graph);
        if self.batch.len() == BATCH {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<()> {
        let graphs = std::mem::take(&mut self.batch);
        let decided = graphs.len();
        let decide = |graphs: &[Graph]| Ok(self.work.source.decide_all(graphs, self.options)?);
        if let Some(parts) = &mut self.parts {
            parts.push(graphs, decide)?;
        } else {
            for entry in decide(&graphs)? {
                self.summary.count(&entry);
                (self.listener.entry)(&entry)?;
            }
        }
        self.listener.progress.done(decided as u64);
        Ok(())
    }

    fn finish(mut self) -> Result<Summary> {
        self.flush()?;
        if let Some(parts) = self.parts.take() {
            let decide =
                |graphs: &[Graph]| Ok(self.work.source.decide_all(graphs, self.options)?);
            self.summary = parts.finish(decide)?;
        }
        self.listener.progress.finish();
        Ok(self.summary)
    }
}
