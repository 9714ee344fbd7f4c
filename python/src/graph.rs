//! Graphs: from arrays, and from files.

use crate::errors::InputError;
use crate::work::{self, Job};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;
use viewcert::certificate::hex;
use viewcert::graph::{Labels, sha256};
use viewcert_ask::HowRead;
use viewcert_formats::colmap::Pipeline;
use viewcert_formats::{ListOptions, NamedGraph, ReadOptions, pairs, read_graphs};
use viewcert_report::scene::Scene;

/// A graph with its labels and notes.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Graph(pub(crate) Arc<NamedGraph>);

impl Graph {
    fn new(input: NamedGraph) -> Self {
        Self(Arc::new(input))
    }
}

#[pymethods]
impl Graph {
    /// What the graph is called: its path, if it was read.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// How many nodes.
    #[getter]
    fn nodes(&self) -> usize {
        self.0.graph.nodes()
    }

    /// How many pairs.
    #[getter]
    fn edges(&self) -> usize {
        self.0.graph.edges().len()
    }

    /// How many of the nodes, the first ones, are cameras, if the others are points.
    #[getter]
    fn cameras(&self) -> Option<u32> {
        self.0.cameras
    }

    /// Whether it was read from a database of COLMAP.
    #[getter]
    fn is_database(&self) -> bool {
        self.0.database.is_some()
    }

    /// What the input was taken for, and what of it became the graph, in a line.
    #[getter]
    fn read_as(&self) -> String {
        self.0.read.to_string()
    }

    /// What was merged, ignored or guessed.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }

    /// The number of inliers of every pair, if it is known.
    fn inliers<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<u32>>> {
        let known = self.0.matching.as_ref();
        let known = known.filter(|_| self.0.cameras.is_none());
        known.map(|known| PyArray1::from_slice(py, &known.inliers))
    }

    /// SHA-256 of the canonical form.
    fn sha256(&self, py: Python<'_>) -> PyResult<String> {
        work::briefly(py, || hex(&sha256(&self.0.graph)))
    }

    /// The labels in the order of the nodes: integers, or texts.
    fn labels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let nodes = self.0.graph.nodes();
        match &self.0.labels {
            Labels::Numbers { first } => PyList::new(py, (0..nodes as u64).map(|v| first + v)),
            Labels::Integers(values) => PyList::new(py, values),
            labels => PyList::new(py, (0..nodes as u32).map(|v| labels.label(v))),
        }
    }

    /// The pairs of node numbers, an array of shape (m, 2).
    fn pairs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let pairs = self.0.graph.edges();
        let flat: Vec<u32> = pairs.iter().flat_map(|&(i, j)| [i, j]).collect();
        PyArray1::from_vec(py, flat).reshape([pairs.len(), 2])
    }

    /// The graph as SVG.
    fn picture(&self, py: Python<'_>) -> PyResult<String> {
        let input = Arc::clone(&self.0);
        Job::new(py)?.run(py, move || Scene::plain(&input).svg(true))
    }
}

/// The graph of an array of shape (m, 2) with integers; its nodes are those that occur.
#[pyfunction]
pub(crate) fn graph_of_integers(
    py: Python<'_>,
    pairs: PyReadonlyArray2<'_, u64>,
    name: String,
) -> PyResult<Graph> {
    let flat = pairs.as_slice()?;
    let (short, long) = work::briefly(py, || match all(flat) {
        Some(short) => (short, None),
        None => (Vec::new(), all(flat)),
    })?;
    let build = move || match long {
        None => Ok(pairs::of_integers(&name, short)?),
        Some(long) => Ok(pairs::of_long_integers(&name, &long)?),
    };
    Job::new(py)?.answer(py, build).map(Graph::new)
}

/// The rows of an array of shape (m, 2) as other integers, if all fit.
pub(crate) fn all<T: Copy + TryInto<U>, U>(flat: &[T]) -> Option<Vec<(U, U)>> {
    let pairs = flat.as_chunks().0.iter();
    let pairs = pairs.map(|&[a, b]| Some((a.try_into().ok()?, b.try_into().ok()?)));
    pairs.collect()
}

/// The graph on `nodes` nodes with an array of shape (m, 2) of node numbers. Labels are `names`, or
/// else `integers`, which increase, or else the node numbers.
#[pyfunction]
#[pyo3(signature = (
    nodes, pairs, name, *, names=None, integers=None, inliers=None, min_inliers=0
))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn graph_of_nodes(
    py: Python<'_>,
    nodes: u32,
    pairs: PyReadonlyArray2<'_, u32>,
    name: String,
    names: Option<Vec<String>>,
    integers: Option<Vec<u64>>,
    inliers: Option<Vec<u32>>,
    min_inliers: u32,
) -> PyResult<Graph> {
    let labels = match (names, integers) {
        (Some(names), _) => Labels::Names(names.into_iter().map(String::into_boxed_str).collect()),
        (None, Some(integers)) => Labels::Integers(integers),
        (None, None) => Labels::Numbers { first: 0 },
    };
    let flat = pairs.as_slice()?;
    let found = work::briefly(py, || all(flat))?.unwrap_or_default();
    let build = move || match inliers {
        None => Ok(pairs::of_nodes(&name, nodes, labels, found)?),
        Some(inliers) => Ok(pairs::with_inliers(
            &name,
            nodes,
            labels,
            found,
            &inliers,
            min_inliers,
        )?),
    };
    Job::new(py)?.answer(py, build).map(Graph::new)
}

/// How pairs and tracks of a file are read: a `dict` in Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Reading {
    format: Option<String>,
    variable: Option<String>,
    pipeline: Option<String>,
    min_inliers: Option<u32>,
    min_views: Option<u32>,
    max_spread: Option<u32>,
    rigs: bool,
    columns: Option<String>,
    min_weight: Option<String>,
    skip_loops: bool,
}

impl Reading {
    /// How pairs and tracks are read.
    ///
    /// # Errors
    /// A word that is none of those that can be said.
    pub(crate) fn options(&self) -> PyResult<HowRead> {
        let pairs = ReadOptions {
            format: parsed("format", self.format.as_deref())?,
            variable: self.variable.clone(),
            pipeline: self.pipeline.as_deref().map(|name| match name {
                "global" => Pipeline::Global,
                _ => Pipeline::Incremental,
            }),
            min_inliers: self.min_inliers,
            tracks: None,
            list: ListOptions {
                columns: parsed("columns", self.columns.as_deref())?,
                min_weight: parsed("min_weight", self.min_weight.as_deref())?,
                skip_loops: self.skip_loops,
            },
            only: None,
        };
        let of_tracks = (self.min_views, self.max_spread, self.rigs);
        Ok(HowRead::new(
            pairs,
            of_tracks,
            ["min_views", "max_spread", "rigs"],
        ))
    }
}

/// What the text of an argument stands for.
fn parsed<T: FromStr<Err: std::fmt::Display>>(
    name: &str,
    text: Option<&str>,
) -> PyResult<Option<T>> {
    let parsed = text.map(str::parse).transpose();
    parsed.map_err(|error| InputError::new_err(format!("{name}: {error}")))
}

/// The graphs of a file, with another name for it where it is there for a moment only.
#[pyfunction]
pub(crate) fn read(
    py: Python<'_>,
    path: PathBuf,
    name: Option<String>,
    tracks: bool,
    reading: Reading,
) -> PyResult<Vec<Graph>> {
    let reading = reading.options()?;
    let options = if tracks {
        reading.tracks
    } else {
        reading.pairs
    };
    let shown = path.display().to_string();
    let called = |mut graph: NamedGraph| {
        if let Some(name) = &name {
            for text in graph.notes.iter_mut().chain([&mut graph.name]) {
                *text = text.replace(&shown, name);
            }
        }
        Graph::new(graph)
    };
    let read = move || Ok(read_graphs(path, &options).collect::<Result<Vec<_>, _>>()?);
    let read = Job::new(py)?.answer(py, read)?;
    Ok(read.into_iter().map(called).collect())
}
