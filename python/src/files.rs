//! What is asked of files: the overview of a database, lists of images, two models, measured motions, archives of
//! certificates.

use crate::graph::Reading;
use crate::work::Job;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::collections::BTreeMap;
use std::path::PathBuf;
use viewcert_ask::archive::{News, Terms, check_archive};
use viewcert_check::Failure;
use viewcert_formats::folder::Listing;
use viewcert_report::{overview_page, screen};
use viewcert_session::Session;
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

/// What is asked in a session of its own.
fn asked<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Session) -> anyhow::Result<T> + Send + 'static,
) -> PyResult<T> {
    let job = Job::new(py)?;
    let session = Session::under(job.watch());
    job.answer(py, move || work(&session))
}

/// What pairs and tracks of an input determine: `kind` is `json`, `text`, `all` or `html`.
#[pyfunction]
pub(crate) fn overview<'py>(
    py: Python<'py>,
    path: PathBuf,
    reading: Reading,
    kind: String,
) -> PyResult<Bound<'py, PyBytes>> {
    let wish = viewcert_ask::overview::Asked {
        reading: reading.options()?,
    };
    let found = asked(py, move |session| {
        wish.of(session, &path, |found| {
            let mut out = Vec::new();
            match &*kind {
                "json" => found.write_json(&mut out)?,
                "html" => out = overview_page::html(found, found.joints)?,
                _ => screen::write(&mut out, found, kind == "all")?,
            }
            Ok(out)
        })
    })?;
    Ok(PyBytes::new(py, &found))
}

/// What lists of images determine, and what their overlaps fix, as JSON and as text.
#[pyfunction]
pub(crate) fn lists(
    py: Python<'_>,
    graph: PathBuf,
    files: Vec<PathBuf>,
    reading: Reading,
) -> PyResult<Said> {
    let reading = reading.options()?;
    asked(py, move |session| {
        let wish = viewcert_ask::lists::Asked {
            graph: &graph,
            files: &files,
            reading,
        };
        wish.of(session, |report| {
            said(|out| report.write_json(out), |out| report.write(out))
        })
    })
}

/// What two models share, and how well it fits, as JSON and as text.
#[pyfunction]
pub(crate) fn merge(
    py: Python<'_>,
    one: PathBuf,
    other: PathBuf,
    database: Option<PathBuf>,
    reading: Reading,
) -> PyResult<Said> {
    let reading = reading.options()?;
    asked(py, move |session| {
        let read = (database.as_deref(), &reading);
        viewcert_ask::merge::merge(session, [&one, &other], read, |report| {
            said(|out| report.write_json(out), |out| report.write(out))
        })
    })
}

/// How many measured motions cannot all be right, as JSON and as text.
#[pyfunction]
pub(crate) fn contradictions(
    py: Python<'_>,
    path: PathBuf,
    angle: u32,
    certificate: Option<PathBuf>,
) -> PyResult<Said> {
    asked(py, move |session| {
        let wish = viewcert_ask::contradictions::Asked {
            file: &path,
            angle,
            certificate: certificate.as_deref(),
        };
        wish.of(session, |report| {
            said(|out| report.write_json(out), |out| report.write(out))
        })
    })
}

/// Verifies all certificates of a file or folder: what came of it, by the names of `viewcert.Archive`. Of those
/// that are not verified file, line and reason.
#[pyfunction]
pub(crate) fn check_all(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let job = Job::new(py)?;
    let (teller, stop) = (job.told(), job.unobserved());
    let (found, listing, rejected, too_large) = job.answer(py, move || {
        let listing = Listing::new(&path)?;
        anyhow::ensure!(
            !listing.files.is_empty(),
            "{}: no certificates (.json, .jsonl, .jsonl.gz); name a folder that has some, or the files",
            path.display()
        );
        let (mut rejected, mut too_large) = (Vec::new(), Vec::new());
        let found = check_archive(&listing, &Terms::default(), &mut |news| {
            match news {
                News::File(_) => (),
                News::Done(more) => teller.counted("certificates", more),
                News::NotVerified(file, line, failure) => {
                    let (list, why) = match failure {
                        Failure::Rejected(why) => (&mut rejected, why.to_string()),
                        Failure::TooLarge(why) => (&mut too_large, why.to_string()),
                    };
                    list.push((file.display().to_string(), line, why));
                }
            }
            match stop.stopped() {
                None => Ok(()),
                Some(_) => Err(TooLarge("the time limit was reached".into()).into()),
            }
        })?;
        Ok((found, listing, rejected, too_large))
    })?;
    let (mut verdicts, mut supposing) = (BTreeMap::<_, u64>::new(), 0);
    for (statement, count) in found.statements {
        supposing += count * u64::from(!statement.supposed.is_empty());
        *verdicts.entry(statement.verdict).or_default() += count;
    }
    let (complete, manifest) = match found.completeness {
        Some(said) => (Some(said.complete), said.lines),
        None => (None, Vec::new()),
    };
    let skipped = listing.skipped.iter();
    let skipped = skipped.map(|(path, why)| (path.display().to_string(), *why));
    let said = PyDict::new(py);
    said.set_item("verified", found.verified)?;
    said.set_item("rejected", rejected)?;
    said.set_item("too_large", too_large)?;
    said.set_item("graphs", found.graphs)?;
    said.set_item("verdicts", verdicts)?;
    said.set_item("supposing", supposing)?;
    said.set_item("complete", complete)?;
    said.set_item("manifest", manifest)?;
    said.set_item("skipped", skipped.collect::<Vec<_>>())?;
    Ok(said)
}
