//! The catalog: certified entries one by one, and shards.

use crate::errors::{InputError, of_any, of_deciding};
use crate::work;
use crate::work::Told;
use anyhow::{Context, bail};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use viewcert::graph::graph6;
use viewcert::linalg::prime::DEFAULT_PRIME;
use viewcert::watch::{Limits, Watch};
use viewcert::{Graph, Options, VerdictError};
use viewcert_catalog::label::{Label, greatest};
use viewcert_catalog::mine::{COLUMNS, Entry};
use viewcert_catalog::work::Listener;
use viewcert_catalog::{Files, Settings, Shard, Source, Work, merged};
use viewcert_report::table;
use viewcert_session::{Outputs, Progress};

/// Candidates that are decided together.
const BATCH: usize = 256;

/// Batches that are decided ahead of whoever takes the entries.
const AHEAD: usize = 2;

/// An entry with its certificate.
type Certified = (Entry, Vec<u8>);

enum Problem {
    Verdict(VerdictError),
    Other(anyhow::Error),
}

type Batch = Result<Vec<Certified>, Problem>;

/// The entries of a size, decided while they are taken.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Candidates {
    watch: Watch,
    entries: Mutex<Entries>,
}

struct Entries {
    batches: Receiver<Batch>,
    waiting: std::vec::IntoIter<Certified>,
}

#[pymethods]
impl Candidates {
    /// Begins the work.
    #[new]
    #[pyo3(signature = (
        nodes, *, edges=None, necessary=false, minimal=false, solutions=false, prime=None, seed=1
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        nodes: usize,
        edges: Option<usize>,
        necessary: bool,
        minimal: bool,
        solutions: bool,
        prime: Option<u64>,
        seed: u64,
    ) -> PyResult<Self> {
        let watch = Watch::new(Limits::default());
        let options = settings(solutions, prime, seed)
            .options(watch.clone())
            .map_err(|error| of_any(&error))?;
        // What cannot be asked for is refused now and not by the first entry.
        let source = py
            .detach(|| source(nodes, edges, necessary, minimal))
            .map_err(|error| of_any(&error))?;
        let threads = work::threads()?;
        let (sender, batches) = sync_channel(AHEAD);
        std::thread::Builder::new().spawn(move || {
            let decide = |graphs: &[Graph]| threads.install(|| entries(graphs, &source, &options));
            enumerate(&source, &sender, &decide);
        })?;
        Ok(Self {
            watch,
            entries: Mutex::new(Entries {
                batches,
                waiting: Vec::new().into_iter(),
            }),
        })
    }

    fn __iter__(this: PyRef<'_, Self>) -> PyRef<'_, Self> {
        this
    }

    /// The next entry: its row of the catalog's table, and its certificate.
    fn __next__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Option<([String; COLUMNS.len()], Bound<'py, PyBytes>)>> {
        loop {
            match py.detach(|| self.next()) {
                Next::Entry(entry, certificate) => {
                    return Ok(Some((entry.cells(), PyBytes::new(py, &certificate))));
                }
                Next::End => return Ok(None),
                Next::NotYet => py.check_signals()?,
                Next::Failed(Problem::Verdict(error)) => return Err(of_deciding(&error)),
                Next::Failed(Problem::Other(error)) => return Err(of_any(&error)),
            }
        }
    }
}

/// What is there to be taken.
enum Next {
    Entry(Entry, Vec<u8>),
    NotYet,
    End,
    Failed(Problem),
}

impl Candidates {
    /// The next entry, if it is there within a moment.
    fn next(&self) -> Next {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((entry, certificate)) = entries.waiting.next() {
            return Next::Entry(entry, certificate);
        }
        match entries.batches.recv_timeout(Duration::from_millis(50)) {
            Ok(Ok(batch)) => {
                entries.waiting = batch.into_iter();
                Next::NotYet
            }
            Ok(Err(problem)) => Next::Failed(problem),
            Err(RecvTimeoutError::Timeout) => Next::NotYet,
            Err(RecvTimeoutError::Disconnected) => Next::End,
        }
    }
}

impl Drop for Candidates {
    /// Nobody takes entries any more.
    fn drop(&mut self) {
        self.watch.interrupt();
    }
}

/// Where candidates come from.
fn source(
    nodes: usize,
    edges: Option<usize>,
    necessary: bool,
    minimal: bool,
) -> anyhow::Result<Source> {
    if !minimal {
        return Ok(Source::size(nodes, edges, necessary)?);
    }
    if edges.is_some() || necessary {
        bail!("minimal graphs have all numbers of edges: leave out edges and necessary");
    }
    Source::minimal(nodes)
}

fn settings(solutions: bool, prime: Option<u64>, seed: u64) -> Settings {
    Settings {
        solutions,
        prime: prime.unwrap_or(DEFAULT_PRIME),
        seed,
    }
}

/// Sends the entries of all candidates, batch by batch, until nobody takes them.
fn enumerate(source: &Source, sender: &SyncSender<Batch>, decide: &dyn Fn(&[Graph]) -> Batch) {
    let mut waiting = Vec::with_capacity(BATCH);
    let mut open = true;
    source.for_each(&mut |graph| {
        match graph {
            Ok(graph) => waiting.push(graph),
            Err(error) => open = sender.send(Err(Problem::Other(error))).is_ok(),
        }
        if waiting.len() == BATCH {
            open = sender.send(decide(&waiting)).is_ok();
            waiting.clear();
        }
        open
    });
    if open {
        // Whoever has gone does not miss it.
        let _ = sender.send(decide(&waiting));
    }
}

/// The entries of some candidates, with certificates.
fn entries(graphs: &[Graph], source: &Source, options: &Options) -> Batch {
    let entry = |graph: &Graph| -> Result<Option<Certified>, VerdictError> {
        let decided = source.decide(graph, options)?;
        Ok(decided.map(|(entry, verdict)| {
            let certificate = verdict.certificate(graph).named(&entry.graph6).compact();
            let certificate = certificate.to_string().into_bytes();
            (entry, certificate)
        }))
    };
    let found: Result<Vec<Option<Certified>>, VerdictError> =
        graphs.par_iter().map(entry).collect();
    match found {
        Ok(found) => Ok(found.into_iter().flatten().collect()),
        Err(error) => Err(Problem::Verdict(error)),
    }
}

/// Writes one shard of the catalog, or completes it.
#[pyfunction]
#[pyo3(signature = (
    folder, nodes, shard, of, *, edges=None, necessary=false, minimal=false, solutions=false,
    part=16384, solvable_only=false, prime=None, seed=1, progress=None
))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub(crate) fn catalog_shard(
    py: Python<'_>,
    folder: PathBuf,
    nodes: usize,
    shard: u64,
    of: u64,
    edges: Option<usize>,
    necessary: bool,
    minimal: bool,
    solutions: bool,
    part: u32,
    solvable_only: bool,
    prime: Option<u64>,
    seed: u64,
    progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let settings = settings(solutions, prime, seed);
    let files = Files {
        folder,
        part,
        solvable_only,
    };
    let watch = Watch::new(Limits::default());
    let (told, stop, threads) = (Arc::new(Told::default()), watch.clone(), work::threads()?);
    let teller = told.clone();
    let what = format!("shard {shard}/{of}");
    let done = work::run(
        py,
        &watch,
        progress.as_ref().map(|callback| (callback, &*told)),
        move || {
            let tell = Box::new(move |more| teller.counted(&what, more));
            threads.install(|| {
                let source = source(nodes, edges, necessary, minimal)?;
                let shard = Shard::new(shard, of);
                let work = Work {
                    source: &source,
                    settings,
                    shard: shard.context("a shard is one of 1 to the number of shards")?,
                    files: Some(files),
                };
                let listener = Listener {
                    entry: &mut |_| Ok(()),
                    malformed: &mut Err,
                    progress: Progress::to(tell),
                };
                work.run(&Outputs::default(), stop, listener).map(drop)
            })
        },
    )?;
    done.map_err(|error| of_any(&error))
}

/// The label of a graph, and the greatest line of graph6 of its relabellings; nothing if it has too many nodes.
#[pyfunction]
pub(crate) fn label(py: Python<'_>, graph: &crate::graph::Graph) -> Option<(String, String)> {
    let graph = graph.0.clone();
    py.detach(|| {
        let line = graph6::encode(&greatest(&graph.graph)?);
        Some((Label::of(&graph.graph)?.to_string(), line))
    })
}

/// The graph of a label, as a line of graph6.
#[pyfunction]
pub(crate) fn label_graph6(label: &str) -> PyResult<String> {
    let parsed: Result<Label, _> = label.parse();
    let parsed = parsed.map_err(|error| InputError::new_err(format!("{label}: {error}")))?;
    Ok(graph6::encode(&parsed.graph()))
}

/// The table of all shards in a folder.
#[pyfunction]
pub(crate) fn catalog_merge(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    let table = || -> anyhow::Result<String> {
        let mut out = Vec::new();
        table::write_merged(&mut out, merged(&folder)?)?;
        Ok(String::from_utf8(out)?)
    };
    py.detach(table).map_err(|error| of_any(&error))
}
