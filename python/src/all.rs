//! Verdicts by the thousand: many graphs, decided side by side.

use crate::decided::{Decided, Wanted};
use crate::errors::of_any;
use crate::graph::Graph;
use crate::work::Job;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;
use viewcert::Known;
use viewcert_formats::{NamedGraph, with_rigs};

/// Decides graphs, each on one of so many threads (by default as many as there are cores). In the
/// place of a graph that has no verdict stands the error. Nothing is asked of one graph that is not
/// asked of all.
#[pyfunction]
#[pyo3(signature = (graphs, wanted, *, threads=None))]
pub(crate) fn decide_all(
    py: Python<'_>,
    graphs: Vec<Py<Graph>>,
    wanted: Wanted,
    threads: Option<usize>,
) -> PyResult<Vec<Py<PyAny>>> {
    let inputs: Vec<Arc<NamedGraph>> = graphs.iter().map(|g| Arc::clone(&g.get().0)).collect();
    let job = Job::new(py)?.on(threads)?;
    job.told().expect("graphs", inputs.len() as u64);
    let (teller, stop) = (job.told(), job.unobserved());
    let decide = move |input: Arc<NamedGraph>| -> anyhow::Result<Decided> {
        let known = with_rigs(Known::default(), &input);
        let decided = Decided::of(input, known?, &wanted, stop.clone());
        teller.counted("graphs", 1);
        decided
    };
    let work = move || inputs.into_par_iter().map(decide).collect();
    let found: Vec<anyhow::Result<Decided>> = job.run(py, work)?;
    let found = found.into_iter().map(|decided| match decided {
        Ok(decided) => Ok(Py::new(py, decided)?.into_any()),
        Err(error) => Ok(of_any(&error).into_value(py).into_any()),
    });
    found.collect()
}
