//! Errors of the libraries as exceptions, which `viewcert._errors` defines.

use pyo3::PyErr;
use viewcert::VerdictError;
use viewcert_check::{Failure, Rejection, TooLarge as TooLargeToCheck};

pyo3::import_exception!(viewcert._errors, FileError);
pyo3::import_exception!(viewcert._errors, InputError);
pyo3::import_exception!(viewcert._errors, Rejected);
pyo3::import_exception!(viewcert._errors, TooLarge);
pyo3::import_exception!(viewcert._errors, Undecided);

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
