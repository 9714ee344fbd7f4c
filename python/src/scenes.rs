//! Other solutions to look at, and where a graph is drawn.

use crate::decided::Decided;
use crate::errors::of_any;
use crate::work::{self, Job};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use viewcert_report::graph_picture::Picture;
use viewcert_report::witness_file::{second, second_scene, write_second_scene, write_witness};

/// Two solutions as JSON: modulo a prime, or two scenes with the same images; and a picture of these, where
/// they can be drawn. Instead of both, why there is nothing to look at: a word and a sentence.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
#[pyo3(signature = (decided, *, seed=1, oriented=false))]
pub(crate) fn witness(
    py: Python<'_>,
    decided: &Decided,
    seed: u64,
    oriented: bool,
) -> PyResult<(Option<String>, Option<String>, (&'static str, String))> {
    let (input, verdict) = decided.answer();
    let work = move || {
        let (mut out, mut drawn) = (Vec::new(), None);
        let written = if oriented {
            second_scene(&verdict).map(|scene| {
                drawn = viewcert_report::second_scene::picture(&input, &scene);
                write_second_scene(&mut out, &input, &scene)
            })
        } else {
            let found = second(&input, &verdict, seed);
            found.map(|found| write_witness(&mut out, &input, &found))
        };
        match written {
            Ok(written) => written
                .map_err(anyhow::Error::from)
                .and_then(|()| Ok((Some(String::from_utf8(out)?), drawn, ("", String::new())))),
            Err(why) => Ok((None, None, (why.name(), why.to_string()))),
        }
    };
    let found: anyhow::Result<_> = Job::new(py)?.run(py, work)?;
    found.map_err(|error| of_any(&error))
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
    let found = work::run(py, move || {
        let picture = Picture::new(&input, &verdict);
        let points = picture.points()?;
        let components = 0..verdict.components.len();
        let colours = components.map(|k| picture.mark(k).colour());
        Some((points, colours.collect::<Vec<_>>()))
    })?;
    let Some((points, colours)) = found else {
        return Ok(None);
    };
    let count = points.len();
    let points: Vec<f64> = points.into_iter().flatten().collect();
    let points = PyArray1::from_vec(py, points).reshape([count, 2])?;
    Ok(Some((points, colours)))
}
