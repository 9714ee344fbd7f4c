//! Floating point beside the exact verdict, and the claims of others.
//!
//! In: graphs and verdicts. Out: what the report crate says, as JSON and as text.

use crate::at_cameras::AtCameras;
use crate::decided::{Decided, Wanted};
use crate::errors::{InputError, TooLarge, of_any};
use crate::graph::Graph;
use crate::work::{self, Job};
use anyhow::anyhow;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use viewcert::linalg::rational::Rational;
use viewcert_audit::at_cameras::{SigmaError, read_table, ruled, sigma};
use viewcert_audit::enclosure::Matrix;
use viewcert_audit::table::{BadRow, Row};
use viewcert_audit::{Beside, Options as FloatOptions, claims};
use viewcert_report::audit::{AtCameras as AtCamerasReport, Audit, Ruled};

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
        said(|out| found.write_json(out), |out| found.write_text(out))
    };
    job.answer(py, work)
}

/// A table of claims.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Claims(Vec<Row>);

#[pymethods]
impl Claims {
    /// Reads comma-separated values; columns in `ignored` are left out.
    #[new]
    fn new(text: &str, ignored: Vec<String>) -> PyResult<Self> {
        let rows = claims::read_table(text, &ignored);
        rows.map(Self)
            .map_err(|error| InputError::new_err(format!("line {}: {error}", error.line)))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// What a row calls its graph, if that may be a name which somebody has to know, and whether it is nothing else.
    fn name(&self, row: usize) -> PyResult<Option<(String, bool)>> {
        let claim = claims::claim(&self.0[row]).map_err(of_row)?;
        let called = claim.called();
        Ok(called.map(|(name, is_name)| (name.to_owned(), is_name)))
    }

    /// Rules on a row: about this graph, or the one that it names, which is in the folder if that is needed.
    #[pyo3(signature = (row, wanted, *, graph=None, folder=None))]
    fn rule(
        &self,
        py: Python<'_>,
        row: usize,
        wanted: Wanted,
        graph: Option<&Graph>,
        folder: Option<PathBuf>,
    ) -> PyResult<(Graph, Decided, Said)> {
        let found = &self.0[row];
        let claim = claims::claim(found).map_err(of_row)?;
        let input = match graph {
            Some(graph) => Arc::clone(&graph.0),
            None => {
                let named = work::briefly(py, || claim.graph(folder.as_deref(), &|_| None))?;
                Arc::new(named.map_err(of_row)?)
            }
        };
        let wanted = wanted.of_model(claim.model().name());
        let (job, line) = (Job::new(py)?, found.line);
        let options = wanted.options(viewcert::Known::default(), job.watch());
        let options = options.map_err(|error| of_any(&error))?;
        let (start, asked) = (Instant::now(), Arc::clone(&input));
        let decide = move || Ok(claims::ruled(&claim, &asked, &options)?);
        let (ruling, exact) = job.answer(py, decide)?;
        let ruled = Ruled {
            number: row + 1,
            line,
            ruling,
            input: (*input).clone(),
            exact,
            certificate: None,
        };
        let said = said(|out| ruled.write_json(out), |out| ruled.write_text(out));
        let said = said.map_err(|error| of_any(&error))?;
        let decided = Decided::new(Arc::clone(&input), ruled.exact, &wanted, start.elapsed());
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
        sigma(matrix, &input.graph, at, (norm.as_ref(), None), &stop)
    };
    let found = job.run(py, work)?;
    let found = found.map_err(of_sigma)?;
    Ok(([found.least.to_string(), found.most.to_string()], place))
}

fn of_sigma(error: SigmaError) -> PyErr {
    match error {
        SigmaError::TooLarge { .. } => TooLarge::new_err(error.to_string()),
        SigmaError::Stopped(stopped) => of_any(&stopped.into()),
        error => InputError::new_err(error.to_string()),
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
    if let Some(other) = rows.iter().find(|row| row.model != model) {
        let (line, of_row) = (other.line, other.model);
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
            let (ruling, sigma) = ruled(claim, &input.graph, at, &stop)?;
            let report = AtCamerasReport {
                input: &input,
                here: &here,
                sigma: sigma.as_ref(),
                ruled: Some((number, claim, &ruling)),
            };
            Ok(said(
                |out| report.write_json(out),
                |out| report.write_text(out),
            ))
        });
        each.collect::<Result<Vec<_>, SigmaError>>()
    };
    let found = job.run(py, work)?;
    let found = found.map_err(of_sigma)?.into_iter();
    let found: anyhow::Result<Vec<Said>> = found.collect();
    found.map_err(|error| of_any(&anyhow!("{error:#}")))
}
