//! The catalog: candidates, certified entries; labels.

use crate::errors::InputError;
use crate::graph::Graph;
use crate::work::{self, Job};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;
use viewcert::graph::graph6;
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert::{CountSolutions, Options, Prime, Question};
use viewcert_catalog::candidates::has_adjacent_nodes_of_degree_2;
use viewcert_catalog::label::{Label, greatest};
use viewcert_catalog::least_edges;
use viewcert_catalog::mine::{COLUMNS, Entry};

/// A row of the catalog's table, and its certificate.
type Certified<'py> = ([String; COLUMNS.len()], Bound<'py, PyBytes>);

/// The candidates of a size, as lines of graph6.
#[pyfunction]
pub(crate) fn candidates(
    py: Python<'_>,
    nodes: usize,
    edges: Option<usize>,
    necessary: bool,
) -> PyResult<Vec<String>> {
    let edges = edges.unwrap_or_else(|| least_edges(nodes.max(2)));
    let job = Job::new(py)?;
    let stop = job.watch();
    job.answer(py, move || {
        let mut graphs = viewcert_catalog::candidates(nodes, edges, &stop)?;
        if necessary && nodes > 3 {
            graphs.retain(|graph| !has_adjacent_nodes_of_degree_2(graph));
        }
        Ok(graphs.iter().map(graph6::encode).collect())
    })
}

/// The entries of some candidates.
#[pyfunction]
pub(crate) fn entries(
    py: Python<'_>,
    lines: Vec<String>,
    solutions: bool,
    prime: Option<u64>,
    seed: u64,
) -> PyResult<Vec<Certified<'_>>> {
    let effort = match solutions {
        true => CountSolutions::Quick,
        false => CountSolutions::Off,
    };
    let prime = prime.unwrap_or(DEFAULT_PRIME);
    let field = PrimeField::new(prime);
    let field = field.map_err(|why| InputError::new_err(format!("prime={prime}: {why}")))?;
    let job = Job::new(py)?;
    let options = Options::default()
        .question(Question::with_solutions(effort))
        .prime(Prime::Fixed(field))
        .seed(seed)
        .watch(job.unobserved());
    let entry = move |line: &String| -> anyhow::Result<(Entry, Vec<u8>)> {
        let graph = graph6::decode(line.as_bytes())?;
        let verdict = viewcert::decide(&graph, &options)?;
        let certificate = verdict.certificate(&graph).named(line).compact();
        let certificate = certificate.to_string().into_bytes();
        Ok((Entry::new(&graph, &verdict), certificate))
    };
    let work = move || {
        lines
            .par_iter()
            .map(entry)
            .collect::<anyhow::Result<Vec<_>>>()
    };
    let found = job.answer(py, work)?.into_iter();
    let found = found.map(|(entry, bytes)| (entry.cells(), PyBytes::new(py, &bytes)));
    Ok(found.collect())
}

/// The label of a graph, and the greatest line of graph6 of its relabellings; nothing if it has too many nodes.
#[pyfunction]
pub(crate) fn label(py: Python<'_>, graph: &Graph) -> PyResult<Option<(String, String)>> {
    let graph = &graph.0.graph;
    work::briefly(py, || {
        let line = graph6::encode(&greatest(graph)?);
        Some((Label::of(graph)?.to_string(), line))
    })
}

/// The graph of a label, as a line of graph6.
#[pyfunction]
pub(crate) fn label_graph6(py: Python<'_>, label: &str) -> PyResult<String> {
    let line = work::briefly(py, || {
        let label = label.parse::<Label>()?;
        Ok::<_, <Label as std::str::FromStr>::Err>(graph6::encode(&label.graph()))
    })?;
    line.map_err(|error| InputError::new_err(format!("{label}: {error}")))
}
