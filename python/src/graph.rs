//! Graphs: from arrays, and from files.

use crate::errors::{InputError, of_reading};
use crate::work::{self, Job};
use numpy::ndarray::ArrayView2;
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::path::PathBuf;
use std::sync::Arc;
use viewcert::certificate::hex;
use viewcert::graph::{Labels, sha256};
use viewcert_formats::colmap::Pipeline;
use viewcert_formats::{
    ListOptions, NamedGraph, ReadError, ReadOptions, TrackOptions, pairs, read_graphs,
};

/// A graph with its labels and notes.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Graph(pub(crate) Arc<NamedGraph>);

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
        pair_array(py, self.0.graph.edges())
    }
}

/// Pairs as an array of shape (k, 2).
pub(crate) fn pair_array<'py>(
    py: Python<'py>,
    pairs: &[(u32, u32)],
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let flat: Vec<u32> = pairs.iter().flat_map(|&(i, j)| [i, j]).collect();
    numpy::PyArray1::from_vec(py, flat).reshape([pairs.len(), 2])
}

/// The graph of an array of shape (m, 2) with integers; its nodes are those that occur.
#[pyfunction]
pub(crate) fn graph_of_integers(
    py: Python<'_>,
    pairs: &Bound<'_, PyAny>,
    name: String,
) -> PyResult<Graph> {
    let found = if let Ok(pairs) = pairs.extract() {
        integers::<i64>(py, &pairs)
    } else if let Ok(pairs) = pairs.extract() {
        integers::<u64>(py, &pairs)
    } else if let Ok(pairs) = pairs.extract() {
        integers::<i32>(py, &pairs)
    } else {
        integers::<u32>(py, &pairs.extract()?)
    }?;
    let build = move || match found {
        Integers::Short(found) => pairs::of_integers(&name, found),
        Integers::Long(found) => pairs::of_long_integers(&name, &found),
    };
    graph(work::run(py, build)?)
}

enum Integers {
    Short(Vec<(u32, u32)>),
    /// At least one does not fit into 32 bits.
    Long(Vec<(u64, u64)>),
}

fn integers<T>(py: Python<'_>, pairs: &PyReadonlyArray2<'_, T>) -> PyResult<Integers>
where
    T: Element + Copy + Send + Sync + std::fmt::Display + TryInto<u32> + TryInto<u64>,
{
    let view = pairs.as_array();
    let found = work::briefly(py, || {
        if let Some(pairs) = all(&view) {
            return Ok(Integers::Short(pairs));
        }
        if let Some(pairs) = all(&view) {
            return Ok(Integers::Long(pairs));
        }
        let negative = |value: &T| TryInto::<u64>::try_into(*value).is_err();
        let row = view
            .rows()
            .into_iter()
            .position(|row| row.iter().any(negative));
        Err(row.unwrap_or(0))
    })?;
    found.map_err(|row| {
        let (a, b) = (view[[row, 0]], view[[row, 1]]);
        InputError::new_err(format!(
            "row {row} of the pairs is ({a}, {b}): the numbers of images are not negative; leave \
             out rows that stand for no pair"
        ))
    })
}

/// All pairs as other integers, if they fit.
pub(crate) fn all<T: Copy + TryInto<U>, U>(view: &ArrayView2<'_, T>) -> Option<Vec<(U, U)>> {
    let pair = |a: T, b: T| Some((a.try_into().ok()?, b.try_into().ok()?));
    match view.as_slice() {
        Some(flat) => flat
            .chunks_exact(2)
            .map(|row| pair(row[0], row[1]))
            .collect(),
        None => view
            .rows()
            .into_iter()
            .map(|row| pair(row[0], row[1]))
            .collect(),
    }
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
    let given = match &labels {
        Labels::Names(names) => names.len(),
        Labels::Integers(integers) => integers.len(),
        _ => nodes as usize,
    };
    if given != nodes as usize {
        return Err(InputError::new_err(format!(
            "{given} labels for {nodes} nodes"
        )));
    }
    let view = pairs.as_array();
    let found = work::briefly(py, || all(&view))?.unwrap_or_default();
    if let Some(given) = inliers.as_ref().map(Vec::len)
        && given != found.len()
    {
        return Err(InputError::new_err(format!(
            "{given} numbers of inliers for {} pairs",
            found.len()
        )));
    }
    let build = move || match inliers {
        None => pairs::of_nodes(&name, nodes, labels, found),
        Some(inliers) => pairs::with_inliers(&name, nodes, labels, found, &inliers, min_inliers),
    };
    graph(work::run(py, build)?)
}

fn graph(built: Result<NamedGraph, ReadError>) -> PyResult<Graph> {
    match built {
        Ok(graph) => Ok(Graph(Arc::new(graph))),
        Err(error) => Err(of_reading(&error)),
    }
}

/// The graphs of a file, with another name for it where it is there for a moment only.
#[pyfunction]
#[pyo3(signature = (
    path, *, name=None, format=None, variable=None, pipeline=None, min_inliers=None, min_views=None,
    max_spread=None, rigs=true, columns=None, min_weight=None, skip_loops=false
))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn read(
    py: Python<'_>,
    path: PathBuf,
    name: Option<String>,
    format: Option<&str>,
    variable: Option<String>,
    pipeline: Option<&str>,
    min_inliers: Option<u32>,
    min_views: Option<u32>,
    max_spread: Option<u32>,
    rigs: bool,
    columns: Option<&str>,
    min_weight: Option<&str>,
    skip_loops: bool,
) -> PyResult<Vec<Graph>> {
    let options = ReadOptions {
        list: list_options(columns, min_weight, skip_loops)?,
        ..read_options(
            format,
            variable,
            pipeline,
            min_inliers,
            min_views,
            max_spread,
            rigs,
        )?
    };
    let shown = path.display().to_string();
    let called = |mut graph: NamedGraph| {
        if let Some(name) = &name {
            for text in graph.notes.iter_mut().chain([&mut graph.name]) {
                *text = text.replace(&shown, name);
            }
        }
        Graph(Arc::new(graph))
    };
    let read = Job::new(py)?.run(py, move || {
        read_graphs(path, &options).collect::<Result<Vec<_>, _>>()
    })?;
    match read {
        Ok(graphs) => Ok(graphs.into_iter().map(called).collect()),
        Err(error) => Err(of_reading(&error)),
    }
}

/// The options of the readers; `min_views` asks for tracks.
pub(crate) fn read_options(
    format: Option<&str>,
    variable: Option<String>,
    pipeline: Option<&str>,
    min_inliers: Option<u32>,
    min_views: Option<u32>,
    max_spread: Option<u32>,
    rigs: bool,
) -> PyResult<ReadOptions> {
    let format = format.map(str::parse).transpose();
    let pipeline = match pipeline {
        None => None,
        Some("incremental") => Some(Pipeline::Incremental),
        Some("global") => Some(Pipeline::Global),
        Some(other) => {
            return Err(InputError::new_err(format!(
                "pipeline={other:?}: the pipelines are incremental and global"
            )));
        }
    };
    Ok(ReadOptions {
        format: format.map_err(|error| InputError::new_err(format!("format: {error}")))?,
        variable,
        pipeline,
        min_inliers,
        tracks: min_views.map(|min_views| TrackOptions {
            min_views,
            max_spread: max_spread.unwrap_or(TrackOptions::default().max_spread),
            rigs,
        }),
        list: ListOptions::default(),
        only: None,
    })
}

/// The options of lists.
pub(crate) fn list_options(
    columns: Option<&str>,
    min_weight: Option<&str>,
    skip_loops: bool,
) -> PyResult<ListOptions> {
    let columns = columns.map(str::parse).transpose();
    let min_weight = min_weight.map(str::parse).transpose();
    Ok(ListOptions {
        columns: columns.map_err(|error| InputError::new_err(format!("columns: {error}")))?,
        min_weight: min_weight
            .map_err(|error| InputError::new_err(format!("min_weight: {error}")))?,
        skip_loops,
    })
}
