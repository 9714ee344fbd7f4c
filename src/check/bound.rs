//! A certificate of contradictions beside the database that it is about: the checker finds what the bytes say.

use anyhow::{Context, Result, ensure};
use std::path::Path;
use viewcert_check::{Answer, Certificate, Database, Failure, Limits};
use viewcert_formats::colmap::{is_database, raw_tables};

/// Checks the certificate, and that its numbers are those of the database.
///
/// # Errors
/// If the file is no database that can be read.
pub(super) fn check(
    certificate: &Certificate,
    path: &Path,
    limits: &Limits,
) -> Result<Result<Answer, Failure>> {
    ensure!(
        is_database(path),
        "{}: this certificate is about the numbers of a COLMAP database, and this is none; without it the \
         numbers written there are checked",
        path.display()
    );
    let database = Database::new(raw_tables(path)?).with_context(|| path.display().to_string())?;
    Ok(certificate.check(None, Some(&database), limits))
}
