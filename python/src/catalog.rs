//! The catalog: certified entries one by one, and shards.

use crate::errors::{InputError, of_any, of_deciding};
use crate::work;
use anyhow::bail;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use viewcert::graph::graph6;
use viewcert::linalg::prime::DEFAULT_PRIME;
use viewcert::watch::{Limits, Watch};
use viewcert::{Graph, Options, VerdictError};
use viewcert_catalog::label::{Label, greatest};
use viewcert_catalog::mine::{COLUMNS, Entry};
use viewcert_catalog::source::{Certified, Decided};
use viewcert_catalog::{Settings, Source};

/// Candidates that are decided together.
const BATCH: usize = 256;

/// Batches that are decided ahead of whoever takes the entries.
const AHEAD: usize = 2;

/// An entry with its certificate.
type CertifiedEntry = (Entry, Vec<u8>);

enum Problem {
    Verdict(VerdictError),
    Other(anyhow::Error),
}

type Batch = Result<Vec<CertifiedEntry>, Problem>;

/// The entries of a size, decided while they are taken.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Candidates {
    watch: Watch,
    entries: Mutex<Entries>,
}

struct Entries {
    batches: Receiver<Batch>,
    waiting: std::vec::IntoIter<CertifiedEntry>,
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
pub(crate) fn source(
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

pub(crate) fn settings(solutions: bool, prime: Option<u64>, seed: u64) -> Settings {
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
    let all = source.for_each(&mut |graph| {
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
        let _ = sender.send(match all {
            Ok(()) => decide(&waiting),
            Err(error) => Err(Problem::Other(error)),
        });
    }
}

/// The entries of some candidates, with certificates.
fn entries(graphs: &[Graph], source: &Source, options: &Options) -> Batch {
    let found = source.decide_all(graphs, options, Certified::All);
    let with_certificate = |(entry, certificate): Decided| Some((entry, certificate?));
    match found {
        Ok(found) => Ok(found.into_iter().filter_map(with_certificate).collect()),
        Err(error) => Err(Problem::Verdict(error)),
    }
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
