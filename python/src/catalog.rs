//! The catalog: certified entries one by one; labels.

use crate::errors::{InputError, of_any, of_deciding};
use crate::work::{self, Job};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use viewcert::graph::graph6;
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert::watch::Watch;
use viewcert::{CountSolutions, Graph, Options, Prime, Question, VerdictError};
use viewcert_catalog::candidates::has_adjacent_nodes_of_degree_2;
use viewcert_catalog::label::{Label, greatest};
use viewcert_catalog::mine::{COLUMNS, Entry};
use viewcert_catalog::{candidates, least_edges};

/// Candidates that are decided together.
const BATCH: usize = 256;

/// Batches that are decided ahead of whoever takes the entries.
const AHEAD: usize = 2;

/// An entry with its certificate.
type CertifiedEntry = (Entry, Vec<u8>);

type Batch = Result<Vec<CertifiedEntry>, VerdictError>;

/// The entries of a size, decided while they are taken.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Candidates {
    /// Where they are decided.
    process: u32,
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
    #[pyo3(signature = (nodes, *, edges=None, necessary=false, solutions=false, prime=None, seed=1))]
    fn new(
        py: Python<'_>,
        nodes: usize,
        edges: Option<usize>,
        necessary: bool,
        solutions: bool,
        prime: Option<u64>,
        seed: u64,
    ) -> PyResult<Self> {
        let job = Job::new(py)?;
        let watch = job.unobserved();
        let effort = match solutions {
            true => CountSolutions::Quick,
            false => CountSolutions::Off,
        };
        let prime = prime.unwrap_or(DEFAULT_PRIME);
        let field = PrimeField::new(prime);
        let field = field.map_err(|why| InputError::new_err(format!("prime={prime}: {why}")))?;
        let options = Options::default()
            .question(Question::with_solutions(effort))
            .prime(Prime::Fixed(field))
            .seed(seed)
            .watch(watch.clone());
        let edges = edges.unwrap_or_else(|| least_edges(nodes.max(2)));
        // What cannot be asked for is refused now and not by the first entry.
        let stop = watch.clone();
        let graphs = job.run(py, move || candidates(nodes, edges, &stop))?;
        let mut graphs = graphs.map_err(|error| of_any(&error.into()))?;
        if necessary && nodes > 3 {
            graphs.retain(|graph| !has_adjacent_nodes_of_degree_2(graph));
        }
        let (sender, batches) = sync_channel(AHEAD);
        work::aside(move || {
            let batches = graphs.chunks(BATCH);
            send(batches.map(|graphs| entries(graphs, &options)), &sender);
        })?;
        Ok(Self {
            process: std::process::id(),
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
        if self.process != std::process::id() {
            return Err(InputError::new_err(
                "these entries are decided in the process that forked this one: begin with viewcert.catalog here",
            ));
        }
        loop {
            match work::beside(py, || self.next()) {
                Next::Entry(entry, certificate) => {
                    return Ok(Some((entry.cells(), PyBytes::new(py, &certificate))));
                }
                Next::End => return Ok(None),
                Next::NotYet => py.check_signals()?,
                Next::Failed(error) => return Err(of_deciding(&error)),
            }
        }
    }
}

/// What is there to be taken.
enum Next {
    Entry(Entry, Vec<u8>),
    NotYet,
    End,
    Failed(VerdictError),
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

/// Sends batches until nobody takes them.
fn send(mut batches: impl Iterator<Item = Batch>, sender: &SyncSender<Batch>) {
    // Whoever has gone does not miss the rest.
    let _ = batches.try_for_each(|batch| sender.send(batch));
}

/// The entries of some candidates, with certificates.
fn entries(graphs: &[Graph], options: &Options) -> Batch {
    let entries = graphs.par_iter().map(|graph| {
        let verdict = viewcert::decide(graph, options)?;
        let entry = Entry::new(graph, &verdict);
        let certificate = verdict.certificate(graph).named(&entry.graph6);
        let certificate = certificate.compact().to_string().into_bytes();
        Ok((entry, certificate))
    });
    entries.collect()
}

/// The label of a graph, and the greatest line of graph6 of its relabellings; nothing if it has too many nodes.
#[pyfunction]
pub(crate) fn label(
    py: Python<'_>,
    graph: &crate::graph::Graph,
) -> PyResult<Option<(String, String)>> {
    let graph = graph.0.clone();
    work::briefly(py, || {
        let line = graph6::encode(&greatest(&graph.graph)?);
        Some((Label::of(&graph.graph)?.to_string(), line))
    })
}

/// The graph of a label, as a line of graph6.
#[pyfunction]
pub(crate) fn label_graph6(py: Python<'_>, label: &str) -> PyResult<String> {
    let parsed = work::briefly(py, || {
        let parsed: Label = label.parse()?;
        Ok::<_, <Label as std::str::FromStr>::Err>(graph6::encode(&parsed.graph()))
    })?;
    parsed.map_err(|error| InputError::new_err(format!("{label}: {error}")))
}
