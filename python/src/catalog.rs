//! The catalog: certified entries one by one, and shards.

use crate::errors::{InputError, of_any, of_deciding};
use crate::work::{self, Job, Told};
use anyhow::{Context, bail, ensure};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use viewcert::graph::graph6;
use viewcert::linalg::prime::DEFAULT_PRIME;
use viewcert::watch::Watch;
use viewcert::{Graph, Options, Value, VerdictError};
use viewcert_catalog::label::{Label, greatest};
use viewcert_catalog::mine::{COLUMNS, Entry};
use viewcert_catalog::source::{Certified, Decided};
use viewcert_catalog::verdict_files::{Blocks, KERNELS};
use viewcert_catalog::work::Listener;
use viewcert_catalog::{Settings, Shard, Source, Work};
use viewcert_report::table;
use viewcert_session::{Outputs, Progress};

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
        nodes=None, *, from_file=None, edges=None, necessary=false, minimal=false, solutions=false, prime=None, seed=1
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        nodes: Option<usize>,
        from_file: Option<PathBuf>,
        edges: Option<usize>,
        necessary: bool,
        minimal: bool,
        solutions: bool,
        prime: Option<u64>,
        seed: u64,
    ) -> PyResult<Self> {
        let watch = Job::new(py)?.unobserved();
        let options = settings(solutions, prime, seed)
            .options(watch.clone())
            .map_err(|error| of_any(&error))?;
        // What cannot be asked for is refused now and not by the first entry.
        let source = py
            .detach(|| source_of(nodes, from_file, (edges, necessary, minimal)))
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

/// The same, or a file with a graph a line.
fn source_of(
    nodes: Option<usize>,
    from_file: Option<PathBuf>,
    (edges, necessary, minimal): (Option<usize>, bool, bool),
) -> anyhow::Result<Source> {
    match (nodes, from_file) {
        (Some(nodes), None) => source(nodes, edges, necessary, minimal),
        (None, Some(path)) if edges.is_none() && !necessary && !minimal => {
            // Otherwise a file that is not there would be one without graphs.
            let file = File::open(&path).and_then(|file| file.metadata());
            let file = file.with_context(|| path.display().to_string())?;
            ensure!(!file.is_dir(), "{}: is a directory", path.display());
            Ok(Source::File { path })
        }
        (None, Some(_)) => {
            bail!(
                "from_file: its graphs are the candidates: leave out edges, necessary and minimal"
            )
        }
        _ => bail!("give either the number of nodes or a file, from_file"),
    }
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

/// What is counted of all candidates: a `dict` of arguments in Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Counted {
    nodes: Option<usize>,
    from_file: Option<PathBuf>,
    edges: Option<usize>,
    necessary: bool,
    minimal: bool,
    solutions: bool,
    verdicts: bool,
    listed: bool,
    prime: Option<u64>,
    seed: u64,
    threads: Option<usize>,
}

/// The counts of a size, by their names.
#[derive(Default)]
#[pyclass(frozen, get_all, module = "viewcert._native")]
pub(crate) struct Census {
    /// What was counted, in words.
    name: String,
    /// How many graphs have which answer.
    counts: BTreeMap<&'static str, u64>,
    /// How many have each number of solutions, or bounds for it.
    solutions: BTreeMap<String, u64>,
    /// With `verdicts` the digest of the set of finite-solvable graphs.
    digest: Option<String>,
    /// With `listed` the finite-solvable graphs, as graph6.
    listed: Option<Vec<String>>,
    /// Lines of a file that are no graphs, and why.
    malformed: Vec<String>,
    /// The table of the program.
    table: String,
}

/// Decides all candidates of a size, or of a file, and counts them.
#[pyfunction]
#[pyo3(signature = (counted, *, progress=None))]
pub(crate) fn census(
    py: Python<'_>,
    counted: Counted,
    progress: Option<Py<PyAny>>,
) -> PyResult<Census> {
    let threads = work::threads_of(counted.threads)?;
    let job = Job::within(py, (None, None), progress, Told::default())?;
    let (stop, told) = (job.unobserved(), job.told());
    let work = move || {
        let (of_size, path) = (
            (counted.edges, counted.necessary, counted.minimal),
            counted.from_file.clone(),
        );
        let source = source_of(counted.nodes, path, of_size)?;
        let teller = told.clone();
        let what = match counted.verdicts {
            true => "kernels",
            false => "candidates",
        };
        let progress = Progress::to(Box::new(move |more| teller.counted(what, more)));
        let settings = settings(counted.solutions, counted.prime, counted.seed);
        let options = settings.options(stop.clone())?;
        if counted.verdicts {
            let blocks = Blocks::new(&source, counted.seed, KERNELS, Shard::default(), None)?;
            told.expects(what, blocks.kernels());
            return of_verdicts(&source, &blocks, &options, &progress, counted.listed);
        }
        if let Some(total) = source.total() {
            told.expects(what, total);
        }
        of_entries(&source, settings, stop, progress, &counted)
    };
    let found: anyhow::Result<Census> = job.run(py, move || threads.install(work))?;
    found.map_err(|error| of_any(&error))
}

/// A table of the program as text.
pub(crate) fn text(
    write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>,
) -> anyhow::Result<String> {
    let mut out = Vec::new();
    write(&mut out)?;
    Ok(String::from_utf8(out)?)
}

/// Counts finite-solvable candidates alone.
fn of_verdicts(
    source: &Source,
    blocks: &Blocks<'_>,
    options: &Options,
    progress: &Progress,
    listed: bool,
) -> anyhow::Result<Census> {
    let mut lines = Vec::new();
    let mut take = |more: Vec<String>| {
        lines.extend(more);
        Ok(())
    };
    let list: Option<&mut dyn FnMut(Vec<String>) -> anyhow::Result<()>> = match listed {
        true => Some(&mut take),
        false => None,
    };
    let tally = blocks.count(options, &Outputs::default(), progress, &mut |_| (), list)?;
    let counts = [
        ("candidates", tally.candidates),
        ("finite_solvable", tally.count_finite_solvable()),
        ("contracted", tally.unique),
        ("refuted", tally.refuted()),
        ("by_one_block", tally.by_one_block),
        ("by_blocks", tally.by_blocks),
        ("otherwise", tally.otherwise),
        ("unproved", tally.unproved.len() as u64),
    ];
    let digest = Some(tally.finite_solvable.to_string());
    let row = table::VerdictRow {
        name: source.name(),
        tally,
        seconds: None,
    };
    Ok(Census {
        name: source.name(),
        counts: counts.into(),
        digest,
        listed: listed.then_some(lines),
        table: text(|out| table::write_verdicts(out, &[row]))?,
        ..Census::default()
    })
}

/// Decides every candidate whole.
fn of_entries(
    source: &Source,
    settings: Settings,
    stop: Watch,
    progress: Progress,
    counted: &Counted,
) -> anyhow::Result<Census> {
    let (mut solutions, mut lines, mut malformed) = (BTreeMap::new(), Vec::new(), Vec::new());
    let work = Work {
        source,
        settings,
        shard: Shard::default(),
        files: None,
    };
    let listener = Listener {
        entry: &mut |entry| {
            if let Some(words) = entry.solutions_in_words().filter(|_| counted.solutions) {
                *solutions.entry(words).or_default() += 1;
            }
            if counted.listed && entry.value != Value::NotFiniteSolvable {
                let [graph6, ..] = entry.cells();
                lines.push(graph6);
            }
            Ok(())
        },
        malformed: &mut |error| {
            malformed.push(format!("{error:#}"));
            Ok(())
        },
        note: &mut |_| (),
        progress,
    };
    let summary = work.run(&Outputs::default(), stop, listener)?;
    let counts = [
        ("candidates", summary.candidates),
        ("finite_solvable", summary.finite_solvable()),
        ("contracted", summary.unique),
        ("refuted", summary.refuted),
        ("by_a_hub", summary.hub),
        ("unproved", summary.unproved),
        ("rank_proved", summary.rank_proved),
        ("components_proved", summary.components_proved),
    ];
    let row = table::Row {
        name: source.name(),
        summary,
        solutions: solutions.clone(),
        seconds: None,
    };
    Ok(Census {
        name: source.name(),
        counts: counts.into(),
        solutions,
        listed: counted.listed.then_some(lines),
        malformed,
        table: text(|out| table::write(out, &[row]))?,
        ..Census::default()
    })
}
