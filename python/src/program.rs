//! The programs `verify` and `viewcert-check`, as commands of the Python package.

use crate::work;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs `verify` on its name and arguments, and returns the exit code.
#[pyfunction]
pub(crate) fn run_verify(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    work::briefly(py, || viewcert_cli::main(arguments))
}

/// The same for the independent checker.
#[pyfunction]
pub(crate) fn run_checker(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    work::briefly(py, || viewcert_check::program::run(arguments))
}
