//! What is asked of several files at once: the overview of a database, lists of images, archives of
//! certificates.

use crate::decided::bytes_of;
use crate::errors::of_any;
use crate::graph::Reading;
use crate::studies::{Said, said};
use crate::work::Job;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;
use std::path::PathBuf;
use viewcert_ask::archive::{News, Terms, check_archive};
use viewcert_ask::{
    contradictions as motions, lists as lists_of, merge as models, overview as whole,
};
use viewcert_check::Failure;
use viewcert_formats::folder::Listing;
use viewcert_report::{overview_page, screen};
use viewcert_session::Session;
use viewcert_session::exit::TooLarge;

/// What pairs and tracks of an input determine: `kind` is `json`, `text`, `all` or `html`.
#[pyfunction]
pub(crate) fn overview<'py>(
    py: Python<'py>,
    path: PathBuf,
    reading: Reading,
    kind: String,
) -> PyResult<Bound<'py, PyBytes>> {
    let [options, of_tracks] = reading.options()?;
    let asked = whole::Asked {
        options,
        of_tracks,
        of_tracks_alone: reading.of_tracks_alone(),
    };
    let job = Job::new(py)?;
    let session = Session::under(job.watch());
    let work = move || {
        let mut out = Vec::new();
        asked.of(&session, &path, |found| {
            match &*kind {
                "json" => found.write_json(&mut out)?,
                "text" => screen::write(&mut out, found, false)?,
                "all" => screen::write(&mut out, found, true)?,
                _ => out = overview_page::html(found, found.joints)?,
            }
            Ok(())
        })?;
        Ok(out)
    };
    bytes_of(py, &job, work)
}

/// What lists of images determine, and what their overlaps fix, as JSON and as text.
#[pyfunction]
pub(crate) fn lists(
    py: Python<'_>,
    graph: PathBuf,
    files: Vec<PathBuf>,
    reading: Reading,
) -> PyResult<Said> {
    let [options, of_tracks] = reading.options()?;
    let of_tracks_alone = reading.of_tracks_alone();
    let job = Job::new(py)?;
    let session = Session::under(job.watch());
    let work = move || -> anyhow::Result<Said> {
        let asked = lists_of::Asked {
            graph: &graph,
            files: &files,
            options,
            of_tracks,
            of_tracks_alone,
        };
        asked.of(&session, |report| {
            said(|out| report.write_json(out), |out| report.write(out))
        })
    };
    let found = job.run(py, work)?;
    found.map_err(|error| of_any(&error))
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
    let [_, options] = reading.options()?;
    let job = Job::new(py)?;
    let session = Session::under(job.watch());
    let work = move || -> anyhow::Result<Said> {
        let asked = models::Asked {
            models: [&one, &other],
            database: database.as_deref(),
            options,
        };
        asked.of(&session, |report| {
            said(|out| report.write_json(out), |out| report.write(out))
        })
    };
    let found = job.run(py, work)?;
    found.map_err(|error| of_any(&error))
}

/// How many measured motions cannot all be right, as JSON and as text.
#[pyfunction]
pub(crate) fn contradictions(
    py: Python<'_>,
    path: PathBuf,
    angle: u32,
    certificate: Option<PathBuf>,
) -> PyResult<(String, String)> {
    let job = Job::new(py)?;
    let session = Session::under(job.watch());
    let work = move || -> anyhow::Result<(String, String)> {
        let asked = motions::Asked {
            file: &path,
            angle,
            certificate: certificate.as_deref(),
        };
        let (mut json, mut text) = (Vec::new(), Vec::new());
        asked.of(&session, |report| {
            report.write_json(&mut json)?;
            Ok(report.write(&mut text)?)
        })?;
        Ok((String::from_utf8(json)?, String::from_utf8(text)?))
    };
    let found = job.run(py, work)?;
    found.map_err(|error| of_any(&error))
}

/// What came of an archive of certificates.
#[pyclass(frozen, get_all, module = "viewcert._native")]
pub(crate) struct Archive {
    /// How many were verified.
    verified: usize,
    /// File, line and reason of those that were rejected.
    rejected: Vec<(String, u64, String)>,
    /// The same of those that take more than the limits allow.
    undecided: Vec<(String, u64, String)>,
    /// How many graphs those are about that were verified.
    graphs: usize,
    /// How many prove each verdict.
    verdicts: BTreeMap<String, u64>,
    /// How many suppose anything besides their graphs.
    supposing: usize,
    /// Whether all is there that manifests name; nothing without one.
    complete: Option<bool>,
    /// What the manifests say, in words.
    manifest: Vec<String>,
    /// Files that are neither certificates nor in a manifest, and why they are not looked into.
    skipped: Vec<(String, String)>,
}

/// Verifies all certificates of a file or folder.
#[pyfunction]
pub(crate) fn check_all(py: Python<'_>, path: PathBuf) -> PyResult<Archive> {
    let job = Job::new(py)?;
    let (teller, stop) = (job.told(), job.unobserved());
    let work = move || -> anyhow::Result<Archive> {
        let listing = Listing::new(&path)?;
        anyhow::ensure!(
            !listing.files.is_empty(),
            "{}: no certificates (.json, .jsonl, .jsonl.gz); name a folder that has some, or the files",
            path.display()
        );
        let (mut rejected, mut undecided) = (Vec::new(), Vec::new());
        let found = check_archive(&listing, &Terms::default(), &mut |news| {
            match news {
                News::File(_) => (),
                News::Done(more) => teller.counted("certificates", more),
                News::NotVerified(file, line, failure) => {
                    let file = file.display().to_string();
                    match failure {
                        Failure::Rejected(why) => rejected.push((file, line, why.to_string())),
                        Failure::TooLarge(why) => undecided.push((file, line, why.to_string())),
                    }
                }
            }
            match stop.stopped() {
                None => Ok(()),
                Some(_) => Err(TooLarge("the time limit was reached".into()).into()),
            }
        })?;
        let skipped = listing.skipped.iter();
        let skipped = skipped.map(|(path, why)| (path.display().to_string(), (*why).to_owned()));
        let (complete, manifest) = match found.completeness {
            Some(said) => (Some(said.complete), said.lines),
            None => (None, Vec::new()),
        };
        let mut verdicts = BTreeMap::new();
        for (statement, count) in &found.statements {
            *verdicts.entry(statement.verdict.clone()).or_default() += count;
        }
        let supposing = found.statements.iter();
        let supposing = supposing.filter(|(statement, _)| !statement.supposed.is_empty());
        Ok(Archive {
            verified: found.verified,
            rejected,
            undecided,
            graphs: found.graphs,
            verdicts,
            supposing: supposing.map(|(_, count)| *count as usize).sum(),
            complete,
            manifest,
            skipped: skipped.collect(),
        })
    };
    let found = job.run(py, work)?;
    found.map_err(|error| of_any(&error))
}
