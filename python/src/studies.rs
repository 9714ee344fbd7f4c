//! Floating point beside the exact verdict, and the claims of others.
//!
//! In: graphs and verdicts. Out: what the report crate says, as JSON and as text.

use crate::at_cameras::AtCameras;
use crate::decided::{Decided, Wanted};
use crate::errors::{InputError, of_any};
use crate::files::{Said, said};
use crate::graph::Graph;
use crate::work::{self, Job};
use anyhow::Context;
use pyo3::prelude::*;
use std::sync::Arc;
use std::time::Instant;
use viewcert_audit::Beside;
use viewcert_audit::claims::{Bad, Claim, of_cameras, of_graphs};
use viewcert_audit::enclosure::{CENTRES_ALONE, enclose, matrix};
use viewcert_report::audit::{Found, write_audit, write_ruling};

/// What one writer says, which takes whether it is for programs.
fn both(write: impl Fn(&mut Vec<u8>, bool) -> std::io::Result<()>) -> anyhow::Result<Said> {
    said(|out| write(out, true), |out| write(out, false))
}

/// Floating point beside a verdict of the projective model.
#[pyfunction]
pub(crate) fn audit(
    py: Python<'_>,
    decided: &Decided,
    tolerance: f64,
    draws: u64,
    seed: u64,
) -> PyResult<Said> {
    let ((input, verdict), (.., time)) = (decided.answer(), decided.asked());
    let job = Job::new(py)?;
    job.answer(py, move || {
        let float = Beside::new(&input.graph, &verdict, (seed, tolerance), draws)?;
        both(|out, json| write_audit(out, json, (&input, &verdict, time), &float))
    })
}

/// A table of claims.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Claims(Vec<Result<Claim, Bad>>);

#[pymethods]
impl Claims {
    /// Reads comma-separated values.
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        of_graphs(text).map(Self).map_err(of_table)
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// Rules on a row: about this graph, or the one that it names.
    fn rule(
        &self,
        py: Python<'_>,
        row: usize,
        wanted: Wanted,
        graph: Option<&Graph>,
    ) -> PyResult<(Graph, Decided, Said)> {
        let of_row = |error: Bad| InputError::new_err(error.problem);
        let claim = self.0[row].clone().map_err(of_row)?;
        let input = match graph {
            Some(graph) => Arc::clone(&graph.0),
            None => Arc::new(work::briefly(py, || claim.graph())?.map_err(of_row)?),
        };
        let wanted = wanted.of_model(claim.model.name());
        let job = Job::new(py)?;
        let options = wanted.options(viewcert::Known::default(), job.watch());
        let options = options.map_err(|error| of_any(&error))?;
        let (start, asked) = (Instant::now(), Arc::clone(&input));
        let of = claim.clone();
        let (ruling, exact) = job.answer(py, move || Ok(of.ruled(&asked, &options)?))?;
        let (row, found) = (Some((row + 1, &claim, &ruling)), Found::Generic(&exact));
        let said = both(|out, json| write_ruling(out, json, row, &input, found));
        let said = said.map_err(|error| of_any(&error))?;
        let decided = Decided::new(Arc::clone(&input), exact, &wanted, start.elapsed());
        Ok((Graph(input), decided, said))
    }
}

/// Why a table is refused.
fn of_table(error: Bad) -> PyErr {
    InputError::new_err(format!("line {}: {error}", error.line))
}

/// The name of the model's matrix, the number from below of its smallest singular value that is not trivial, and two
/// fractions between which that lies at the given cameras.
#[pyfunction]
pub(crate) fn singular_value(
    py: Python<'_>,
    at: &AtCameras,
) -> PyResult<(&'static str, usize, String, String)> {
    let (input, centres, here) = at.found();
    let job = Job::new(py)?;
    let stop = job.watch();
    job.answer(py, move || {
        let none = "no matrix of the affine model is enclosed; ask for one of the others";
        let (matrix, _, place) = matrix(here.model, input.graph.nodes()).context(none)?;
        let found = enclose(&input.graph, (&centres, &here), None, &stop)?;
        let found = found.context(CENTRES_ALONE)?;
        let [least, most] = [found.least, found.most].map(|x| x.to_string());
        Ok((matrix, place, least, most))
    })
}

/// Rules on a table of floating-point results at the given cameras, row by row.
#[pyfunction]
pub(crate) fn audit_at_cameras(py: Python<'_>, at: &AtCameras, table: &str) -> PyResult<Vec<Said>> {
    let rows = of_cameras(table).map_err(of_table)?;
    let (input, centres, here) = at.found();
    let model = centres.model();
    if let Some(other) = rows.iter().find(|row| row.model != model) {
        let (line, of_row) = (other.line, other.model);
        return Err(InputError::new_err(format!(
            "line {line}: the row is about the {of_row} model, and the verdict is of the {model} model; \
             audit each at the cameras of its own verdict"
        )));
    }
    let job = Job::new(py)?;
    let stop = job.watch();
    job.answer(py, move || {
        let each = (1..).zip(&rows).map(|(number, claim)| {
            let found = claim.at_cameras(&input.graph, (&centres, &here), &stop)?;
            let (ruling, sigma) = found.context(CENTRES_ALONE)?;
            let row = Some((number, claim, &ruling));
            let found = Found::AtCameras(&here, sigma.as_ref());
            both(|out, json| write_ruling(out, json, row, &input, found))
        });
        each.collect()
    })
}
