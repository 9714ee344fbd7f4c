//! Verdicts by the thousand: many graphs, decided side by side.

use crate::decided::{Decided, Wanted};
use crate::errors::of_deciding;
use crate::graph::Graph;
use crate::work::{Job, Told};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};
use viewcert::{Known, KnownParts, Verdict, VerdictError};
use viewcert_formats::{NamedGraph, with_rigs};

/// Why there is no verdict on one of them.
enum Problem {
    Question(String),
    Verdict(VerdictError),
}

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
    let wanted = Arc::new(wanted);
    let inputs: Vec<Arc<NamedGraph>> = graphs.iter().map(|g| Arc::clone(&g.get().0)).collect();
    let told = Told::expecting("graphs", inputs.len() as u64);
    let job = Job::telling(py, told)?.on(threads)?;
    let (teller, stop, asked) = (job.told(), job.unobserved(), Arc::clone(&wanted));
    let decide = move |input: Arc<NamedGraph>| -> (Arc<NamedGraph>, Result<_, Problem>, Duration) {
        let start = Instant::now();
        let known = with_rigs(Known::Parts(KnownParts::default()), &input);
        let options = known
            .map_err(|error| error.to_string())
            .and_then(|known| asked.options(known, stop.clone()));
        let decided = options
            .map_err(Problem::Question)
            .and_then(|options| viewcert::decide(&input.graph, &options).map_err(Problem::Verdict));
        teller.counted("graphs", 1);
        (input, decided, start.elapsed())
    };
    let found: Vec<(_, Result<Verdict, _>, _)> =
        job.run(py, move || inputs.into_par_iter().map(decide).collect())?;
    found
        .into_iter()
        .map(|(input, decided, time)| match decided {
            Ok(verdict) => {
                let decided = Decided::new(input, verdict, &wanted, time);
                Ok(Py::new(py, decided)?.into_any())
            }
            Err(Problem::Question(why)) => Ok(crate::errors::InputError::new_err(why)
                .into_value(py)
                .into_any()),
            Err(Problem::Verdict(error)) => Ok(of_deciding(&error).into_value(py).into_any()),
        })
        .collect()
}
