//! Graphs that go to another process: what Python pickles, and what it makes of that.

use crate::errors::InputError;
use crate::graph::Graph;
use crate::work;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use std::sync::Arc;
use viewcert::graph::{Graph as Pairs, Labels};
use viewcert_formats::pickled;

/// What kind of labels a graph has: the first of numbers, integers, or names of all nodes or of the
/// cameras, which points follow.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Kind {
    #[pyo3(transparent)]
    First(u64),
    #[pyo3(transparent)]
    Integers(Vec<u64>),
    #[pyo3(transparent)]
    Names((bool, Vec<String>)),
}

/// The labels of a graph and what else is known of it, beside its name and pairs.
#[pyfunction]
pub(crate) fn about_graph(graph: &Graph) -> PyResult<(Kind, String)> {
    let input = &graph.0;
    let texts = |names: &[Box<str>]| names.iter().map(|name| name.to_string()).collect();
    let kind = match &input.labels {
        Labels::Numbers { first } => Kind::First(*first),
        Labels::Integers(values) => Kind::Integers(values.clone()),
        Labels::Names(names) => Kind::Names((false, texts(names))),
        Labels::CamerasAndPoints(names) => Kind::Names((true, texts(names))),
    };
    let about = pickled::about(input).map_err(|error| InputError::new_err(error.to_string()))?;
    Ok((kind, about))
}

/// The graph that was kept.
#[pyfunction]
pub(crate) fn graph_kept(
    py: Python<'_>,
    name: String,
    nodes: u32,
    pairs: PyReadonlyArray2<'_, u32>,
    labels: Kind,
    about: &str,
) -> PyResult<Graph> {
    let wrong = |why: &dyn std::fmt::Display| InputError::new_err(format!("{name}: {why}"));
    let boxed = |names: Vec<String>| names.into_iter().map(String::into_boxed_str).collect();
    let labels = match labels {
        Kind::First(first) => Labels::Numbers { first },
        Kind::Integers(values) => Labels::Integers(values),
        Kind::Names((false, names)) => Labels::Names(boxed(names)),
        Kind::Names((true, names)) => Labels::CamerasAndPoints(boxed(names)),
    };
    let listed = match &labels {
        Labels::Integers(values) => values.len() == nodes as usize,
        Labels::Names(names) => names.len() == nodes as usize,
        Labels::CamerasAndPoints(names) => names.len() <= nodes as usize,
        Labels::Numbers { .. } => true,
    };
    if !listed {
        return Err(wrong(&"there is not a label for every node"));
    }
    let view = pairs.as_array();
    let rows = view.rows().into_iter().map(|row| (row[0], row[1]));
    let rows: Vec<(u32, u32)> = rows.collect();
    let graph = work::briefly(py, || Pairs::new(nodes, rows))?.map_err(|error| wrong(&error))?;
    match pickled::with_about(name.clone(), graph, labels, about) {
        Ok(input) => Ok(Graph(Arc::new(input))),
        Err(error) => Err(wrong(&error)),
    }
}

/// Whether two graphs are one: pairs, cameras, and what frames say of these.
#[pyfunction]
pub(crate) fn same_graph(py: Python<'_>, one: &Graph, other: &Graph) -> PyResult<bool> {
    let (one, other) = (&one.0, &other.0);
    work::briefly(py, || {
        one.graph == other.graph && one.cameras == other.cameras && one.frames == other.frames
    })
}
