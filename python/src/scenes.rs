//! Other solutions to look at, and where a graph is drawn.

use crate::decided::Decided;
use crate::work::Job;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use viewcert_report::scene::Scene;
use viewcert_report::witness_file::{second, write_witness};

/// Two solutions modulo a prime, as JSON. Instead of them, why there is nothing to look at: a word and a
/// sentence.
#[pyfunction]
#[pyo3(signature = (decided, *, seed=1))]
pub(crate) fn witness(
    py: Python<'_>,
    decided: &Decided,
    seed: u64,
) -> PyResult<(Option<String>, (&'static str, String))> {
    let (input, verdict) = decided.answer();
    let work = move || {
        let found = match second(&input, &verdict, seed) {
            Ok(found) => found,
            Err(why) => return Ok((None, (why.name(), why.to_string()))),
        };
        let mut out = Vec::new();
        write_witness(&mut out, &input, &found)?;
        Ok((Some(String::from_utf8(out)?), ("", String::new())))
    };
    Job::new(py)?.answer(py, work)
}

/// Where the program draws each node, an array of shape (n, 2), x to the right and y down; and the colour of
/// each component. Nothing of graphs that are not drawn node by node.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
pub(crate) fn drawing<'py>(
    py: Python<'py>,
    decided: &Decided,
) -> PyResult<Option<(Bound<'py, PyArray2<f64>>, Vec<&'static str>)>> {
    let (input, verdict) = decided.answer();
    let found = Job::new(py)?.run(py, move || {
        let scene = Scene::new(&input, &verdict);
        // Of cameras and points the program draws the cameras alone.
        let points = scene.points().filter(|_| input.cameras.is_none())?;
        Some((points, scene.colours()))
    })?;
    let Some((points, colours)) = found else {
        return Ok(None);
    };
    let count = points.len();
    let points: Vec<f64> = points.into_iter().flatten().collect();
    let points = PyArray1::from_vec(py, points).reshape([count, 2])?;
    Ok(Some((points, colours)))
}
