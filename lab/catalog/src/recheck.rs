//! Graphs of a run decided again, and held against what its files say.

use crate::counts::Rechecked;
use crate::merge_parts::Parts;
use crate::part::{Part, digest, is_kept, line};
use crate::progress::Progress;
use crate::run::Run;
use crate::sample::Sample;
use crate::set_digest::SetDigest;
use crate::shard::Shard;
use crate::source::{Certified, Source, decide_all};
use anyhow::{Context, Result, anyhow, ensure};
use std::collections::HashMap;
use std::path::Path;
use viewcert::decide::Options;
use viewcert::graph::{Graph, graph6};
use viewcert::watch::Watch;
use viewcert_catalog::mine::Summary;

/// What is to be decided again.
pub struct Recheck {
    /// How much.
    pub sample: Sample,
    /// What may stop it.
    pub watch: Watch,
    /// Learns how many graphs, or blocks of verdicts, have been decided.
    pub progress: Progress,
}

/// Makes the candidates of a folder of entries again, all of them, and decides the sample. The files
/// themselves are whole.
///
/// # Errors
/// Candidates that cannot be made again, graphs that cannot be decided; if the work is stopped.
pub(crate) fn of_entries(folder: &Path, run: &Run, recheck: &Recheck) -> Result<Rechecked> {
    let source = match run.source.source() {
        // Every candidate has a line.
        Err(_) if !run.solvable_only => None,
        source => Some(source.context("--recheck")?),
    };
    if let Some(source) = &source {
        source.find(folder, true)?;
    }
    let options = run.settings().options(recheck.watch.clone())?;
    let mut found = Rechecked::default();
    for index in 1..=run.shards.unwrap_or(1) {
        let shard = Shard::new(index, run.shards.unwrap_or(1)).context("a shard of the run")?;
        let mut of_shard = OfShard {
            parts: Parts { folder, shard, run },
            source: source.as_ref(),
            options: &options,
            recheck,
            part: 0,
            found: &mut found,
        };
        of_shard.run()?;
    }
    recheck.progress.finish();
    Ok(found)
}

/// A shard that is looked at again.
struct OfShard<'a> {
    parts: Parts<'a>,
    source: Option<&'a Source>,
    options: &'a Options,
    recheck: &'a Recheck,
    part: u64,
    found: &'a mut Rechecked,
}

impl OfShard<'_> {
    fn run(&mut self) -> Result<()> {
        let Some(source) = self.source else {
            while self.parts.place(self.part).path().exists() {
                let part = self.read()?;
                let graphs = part.rows.iter().map(|row| {
                    let graph = row.split('\t').next().unwrap_or_default();
                    graph6::decode(graph.as_bytes()).map_err(|error| anyhow!("{graph}: {error}"))
                });
                let graphs: Vec<Graph> = graphs.collect::<Result<_>>()?;
                self.look(&graphs, &part)?;
            }
            return Ok(());
        };
        let size = self.parts.run.part as usize;
        let mut waiting = Vec::new();
        let mut failure = None;
        source.for_each_of(self.parts.shard, &mut |graph| {
            // Malformed lines are none of the candidates.
            waiting.extend(graph.ok());
            if waiting.len() == size {
                let part = self.read().and_then(|part| self.look(&waiting, &part));
                failure = part.err();
                waiting.clear();
            }
            failure.is_none()
        })?;
        if let Some(error) = failure {
            return Err(error);
        }
        if !waiting.is_empty() {
            let part = self.read()?;
            self.look(&waiting, &part)?;
        }
        Ok(())
    }

    /// The next part.
    fn read(&self) -> Result<Part> {
        let place = self.parts.place(self.part);
        let part = place.read(self.parts.run)?;
        part.map_err(|_| anyhow!("{}: changed while it was read", place.path().display()))
    }

    /// Holds a part against its candidates.
    fn look(&mut self, graphs: &[Graph], part: &Part) -> Result<()> {
        let path = self.parts.place(self.part).path();
        let named = |what: String| format!("{}: {what}", path.display());
        self.part += 1;
        self.found.of += graphs.len() as u64;
        if digest(graphs) != part.end.candidates_sha256 {
            let what = "its candidates are not those that there are".into();
            self.found.contradictions.push(named(what));
            return Ok(());
        }
        let rows = part.rows.iter().map(|row| {
            let graph = row.split('\t').next().unwrap_or_default();
            (graph, row.as_str())
        });
        let mut rows: HashMap<&str, &str> = rows.collect();
        let encoded: Vec<String> = graphs.iter().map(graph6::encode).collect();
        let chosen = self.recheck.sample.of(&encoded);
        let all = chosen.len() == graphs.len();
        let (mut summary, mut digest) = (Summary::default(), SetDigest::default());
        let again: Vec<Graph> = chosen.iter().map(|&place| graphs[place].clone()).collect();
        let decided = match self.source {
            Some(source) => source.decide_all(&again, self.options, Certified::None)?,
            None => decide_all(&again, self.options)?,
        };
        let mut lines: HashMap<String, String> = HashMap::new();
        for (entry, _) in decided {
            summary.count(&entry);
            let line = line(&entry);
            digest.insert(line.as_bytes());
            if is_kept(self.parts.run, &entry) {
                lines.insert(entry.graph6, line);
            }
        }
        for place in chosen {
            let graph = encoded[place].as_str();
            let (there, here) = (rows.remove(graph), lines.remove(graph));
            if there != here.as_deref() {
                let words = |line: Option<&str>| line.unwrap_or("no line").replace('\t', " ");
                let (there, here) = (words(there), words(here.as_deref()));
                let what = format!("{graph}: the file says {there:?}, decided again {here:?}");
                self.found.contradictions.push(named(what));
            }
        }
        let agree =
            !all || rows.is_empty() && summary == part.end.summary && digest == part.end.rows;
        if !agree {
            let what = "its counts are not those of its graphs".into();
            self.found.contradictions.push(named(what));
        }
        self.found.graphs += again.len() as u64;
        self.recheck.progress.done(again.len() as u64);
        ensure!(
            self.found.contradictions.len() < 1000,
            "{}: a thousand contradictions",
            path.display()
        );
        Ok(())
    }
}
