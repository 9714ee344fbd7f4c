//! Floating point beside the exact verdict, and the claims of others.
//!
//! In: graphs and verdicts. Out: what the report crate says, as JSON and as text.

use crate::at_cameras::AtCameras;
use crate::decided::{Decided, Wanted};
use crate::errors::{InputError, of_any};
use crate::graph::Graph;
use crate::work::{self, Job};
use pyo3::prelude::*;
use std::sync::Arc;
use std::time::Instant;
use viewcert::linalg::rational::Rational;
use viewcert_audit::at_cameras::{read_table, ruled};
use viewcert_audit::enclosure::{Matrix, SigmaError, enclose};
use viewcert_audit::table::{BadRow, Row};
use viewcert_audit::{Beside, Options as FloatOptions, claims};
use viewcert_report::audit::{Audit, Found, Ruled};
use viewcert_session::exit::TooLarge;

/// What is said for programs, as JSON, and for people.
pub(crate) type Said = (String, String);

/// Both of them.
pub(crate) fn said(
    json: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>,
    text: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>,
) -> anyhow::Result<Said> {
    let (mut of_json, mut of_text) = (Vec::new(), Vec::new());
    json(&mut of_json)?;
    text(&mut of_text)?;
    Ok((String::from_utf8(of_json)?, String::from_utf8(of_text)?))
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
    if !(tolerance.is_finite() && tolerance > 0.0) {
        return Err(InputError::new_err(format!(
            "tolerance={tolerance}: take a positive number"
        )));
    }
    let options = FloatOptions { tolerance, seed };
    let ((input, verdict), (.., time)) = (decided.answer(), decided.asked());
    let job = Job::new(py)?;
    let work = move || {
        let float = Beside::new(&input.graph, &verdict, &options, draws)?;
        let found = Audit {
            input: &input,
            exact: &verdict,
            exact_time: time,
            tolerance,
            float,
        };
        said(|out| found.write(out, true), |out| found.write(out, false))
    };
    job.answer(py, work)
}

/// A table of claims.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Claims(Vec<Row>);

#[pymethods]
impl Claims {
    /// Reads comma-separated values.
    #[new]
    fn new(text: &str) -> PyResult<Self> {
        let rows = claims::read_table(text);
        rows.map(Self)
            .map_err(|error| InputError::new_err(format!("line {}: {error}", error.line)))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// Rules on a row: about this graph, or the one that it names.
    #[pyo3(signature = (row, wanted, *, graph=None))]
    fn rule(
        &self,
        py: Python<'_>,
        row: usize,
        wanted: Wanted,
        graph: Option<&Graph>,
    ) -> PyResult<(Graph, Decided, Said)> {
        let claim = claims::claim(&self.0[row]).map_err(of_row)?;
        let input = match graph {
            Some(graph) => Arc::clone(&graph.0),
            None => Arc::new(work::briefly(py, || claim.graph())?.map_err(of_row)?),
        };
        let wanted = wanted.of_model(claim.claim.model.name());
        let job = Job::new(py)?;
        let options = wanted.options(viewcert::Known::default(), job.watch());
        let options = options.map_err(|error| of_any(&error))?;
        let (start, asked) = (Instant::now(), Arc::clone(&input));
        let decide = move || {
            let found = claims::ruled(&claim, &asked, &options)?;
            Ok((claim, found))
        };
        let (claim, (ruling, exact)) = job.answer(py, decide)?;
        let ruled = Ruled {
            row: Some((row + 1, &claim.claim, &ruling)),
            input: &input,
            found: Found::Generic(&exact),
        };
        let said = said(|out| ruled.write(out, true), |out| ruled.write(out, false));
        let said = said.map_err(|error| of_any(&error))?;
        let decided = Decided::new(Arc::clone(&input), exact, &wanted, start.elapsed());
        Ok((Graph(input), decided, said))
    }
}

/// Why a row has no claim, or no graph.
fn of_row(BadRow(why): BadRow) -> PyErr {
    InputError::new_err(why)
}

/// A matrix of the literature by its name.
fn of_name(name: &str) -> PyResult<Matrix> {
    let found = Matrix::ALL.into_iter().find(|matrix| matrix.name() == name);
    found.ok_or_else(|| {
        let names = Matrix::ALL.map(Matrix::name).join(", ");
        InputError::new_err(format!("matrix={name:?}: give one of {names}"))
    })
}

/// The lesser and the greater of two fractions.
type Between = [String; 2];

/// Two fractions between which the smallest singular value that is not trivial lies, and its number from
/// below: of a matrix at the given cameras, with cameras and fundamental matrices scaled to a norm.
#[pyfunction]
#[pyo3(signature = (at, matrix, *, norm=None))]
pub(crate) fn singular_value(
    py: Python<'_>,
    at: &AtCameras,
    matrix: &str,
    norm: Option<&str>,
) -> PyResult<(Between, usize)> {
    let matrix = of_name(matrix)?;
    let norm = norm.map(str::parse::<Rational>).transpose();
    let norm = norm.map_err(|_| InputError::new_err("norm: this is no number"))?;
    let (input, centres, here) = at.found();
    if matrix.model() != centres.model() {
        let (name, model) = (matrix.name(), centres.model());
        return Err(InputError::new_err(format!(
            "matrix: {name} is no matrix of the {model} model"
        )));
    }
    let place = matrix.place(input.graph.nodes());
    let job = Job::new(py)?;
    let stop = job.watch();
    let work = move || {
        let at = (&*centres, &*here);
        let found = enclose(matrix, &input.graph, at, (norm.as_ref(), None), &stop);
        found.map_err(not_enclosed)
    };
    let found = job.answer(py, work)?;
    Ok(([found.least.to_string(), found.most.to_string()], place))
}

/// Why a singular value is not enclosed.
fn not_enclosed(error: SigmaError) -> anyhow::Error {
    match error {
        SigmaError::TooLarge { .. } => TooLarge(error.to_string()).into(),
        SigmaError::Stopped(stopped) => stopped.into(),
        error => error.into(),
    }
}

/// Rules on a table of floating-point results at the given cameras, row by row.
#[pyfunction]
pub(crate) fn audit_at_cameras(py: Python<'_>, at: &AtCameras, table: &str) -> PyResult<Vec<Said>> {
    let rows = read_table(table);
    let rows =
        rows.map_err(|error| InputError::new_err(format!("line {}: {error}", error.line)))?;
    let (input, centres, here) = at.found();
    let model = centres.model();
    if let Some(other) = rows.iter().find(|row| row.claim.model != model) {
        let (line, of_row) = (other.claim.line, other.claim.model);
        return Err(InputError::new_err(format!(
            "line {line}: the row is about the {of_row} model, and the verdict is of the {model} model; \
             audit each at the cameras of its own verdict"
        )));
    }
    let job = Job::new(py)?;
    let stop = job.watch();
    let work = move || {
        let each = (1..).zip(&rows).map(|(number, claim)| {
            let at = (&*centres, &*here);
            let (ruling, sigma) = ruled(claim, &input.graph, at, &stop).map_err(not_enclosed)?;
            let ruled = Ruled {
                row: Some((number, &claim.claim, &ruling)),
                input: &input,
                found: Found::AtCameras(&here, sigma.as_ref()),
            };
            said(|out| ruled.write(out, true), |out| ruled.write(out, false))
        });
        each.collect::<anyhow::Result<Vec<_>>>()
    };
    job.answer(py, work)
}
