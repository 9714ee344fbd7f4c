//! Errors of the libraries as exceptions, which `viewcert._errors` defines.

use pyo3::PyErr;
use pyo3::exceptions::PyRuntimeError;
use viewcert::VerdictError;
use viewcert::watch::{Reason, Stopped};
use viewcert_check::{Failure, Rejection, TooLarge as TooLargeToCheck};
use viewcert_formats::ReadError;

pyo3::import_exception!(viewcert._errors, FileError);
pyo3::import_exception!(viewcert._errors, InputError);
pyo3::import_exception!(viewcert._errors, Rejected);
pyo3::import_exception!(viewcert._errors, TooLarge);
pyo3::import_exception!(viewcert._errors, Undecided);

/// Bad input, or input that is too large to be read.
pub(crate) fn of_reading(error: &ReadError) -> PyErr {
    let message = error.to_string();
    if error.problem.is_size() {
        TooLarge::new_err(message)
    } else {
        InputError::new_err(message)
    }
}

/// No verdict.
pub(crate) fn of_deciding(error: &VerdictError) -> PyErr {
    match error {
        VerdictError::TooLarge { .. } => TooLarge::new_err(error.to_string()),
        VerdictError::Stopped(stopped) => of_stopping(stopped),
        VerdictError::PartOutsideGraph { .. } | VerdictError::Displacements(_) => {
            InputError::new_err(error.to_string())
        }
        _ => Undecided::new_err(error.to_string()),
    }
}

/// Work that was stopped: by a limit, since interrupts are raised as they are.
fn of_stopping(stopped: &Stopped) -> PyErr {
    match stopped.reason {
        Reason::Interrupted => PyRuntimeError::new_err(stopped.to_string()),
        _ => TooLarge::new_err(stopped.to_string()),
    }
}

/// Any error of the program's parts.
pub(crate) fn of_any(error: &anyhow::Error) -> PyErr {
    let message = format!("{error:#}");
    if viewcert_session::exit::is_too_large(error) {
        return TooLarge::new_err(message);
    }
    let undecided = error.chain().any(|cause| {
        let cause = cause.downcast_ref::<VerdictError>();
        matches!(
            cause,
            Some(VerdictError::Draw(_) | VerdictError::Undecided { .. })
        )
    });
    if undecided {
        Undecided::new_err(message)
    } else {
        InputError::new_err(message)
    }
}

/// A certificate that was not verified.
pub(crate) fn of_checking(failure: Failure) -> PyErr {
    match failure {
        Failure::Rejected(Rejection { step, reason }) => Rejected::new_err((step, reason)),
        Failure::TooLarge(TooLargeToCheck { .. }) => TooLarge::new_err(failure.to_string()),
    }
}
