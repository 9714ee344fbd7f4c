//! Graphs that go to another process: what Python pickles, and what it makes of that.

use crate::errors::InputError;
use crate::graph::{Graph, all};
use crate::work;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::sync::Arc;
use viewcert::graph::Graph as Pairs;
use viewcert_formats::pickled;

/// All that is known of a graph beside its name and pairs.
#[pyfunction]
pub(crate) fn about_graph(graph: &Graph) -> PyResult<String> {
    pickled::about(&graph.0).map_err(|error| InputError::new_err(error.to_string()))
}

/// The graph that was kept.
#[pyfunction]
pub(crate) fn graph_kept(
    py: Python<'_>,
    name: String,
    nodes: u32,
    pairs: PyReadonlyArray2<'_, u32>,
    about: &str,
) -> PyResult<Graph> {
    let wrong = |why: &dyn std::fmt::Display| InputError::new_err(format!("{name}: {why}"));
    let rows: Vec<(u32, u32)> = all(pairs.as_slice()?).unwrap_or_default();
    let graph = work::briefly(py, || Pairs::new(nodes, rows))?.map_err(|error| wrong(&error))?;
    let input = pickled::with_about(name.clone(), graph, about);
    Ok(Graph(Arc::new(input.map_err(|error| wrong(&error))?)))
}

/// Whether two graphs are one: pairs, cameras, and what frames say of these.
#[pyfunction]
pub(crate) fn same_graph(py: Python<'_>, one: &Graph, other: &Graph) -> PyResult<bool> {
    let (one, other) = (&one.0, &other.0);
    work::briefly(py, || {
        one.graph == other.graph && one.cameras == other.cameras && one.frames == other.frames
    })
}
