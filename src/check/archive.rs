//! Many certificates: files with one a line, folders, and by their manifests whether all are there.

use super::checker;
use anyhow::{Result, ensure};
use flate2::read::MultiGzDecoder;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::{fs, iter};
use viewcert_check::program::{is_certificate, no_certificate};
use viewcert_check::{Failure, Rejection};
use viewcert_formats::folder::{Completeness, Listing, is_list};
use viewcert_formats::manifest::Contents;
use viewcert_session::printable;

/// Certificates that are read before they are checked together.
const BATCH: usize = 256;

/// What is told while they are checked.
pub enum News<'a> {
    /// A file is begun.
    File(&'a Path),
    /// So many certificates more are checked.
    Done(u64),
    /// The one on a line of a file is not verified, and why.
    NotVerified(&'a Path, u64, &'a Failure),
}

/// What came of them.
#[derive(Default)]
pub struct Archive {
    /// How many were verified.
    pub verified: usize,
    /// How many were rejected.
    pub rejected: usize,
    /// How many take more than the limits allow.
    pub undecided: usize,
    /// How many graphs those are about that were verified.
    pub graphs: usize,
    /// How many prove each verdict.
    pub verdicts: BTreeMap<String, u64>,
    /// How many take known parts, displacements, or base lines for given.
    pub supposing: usize,
    /// Whether all is there that manifests name; nothing without one.
    pub completeness: Option<Completeness>,
}

/// Checks every certificate of every file; each must hold its graph. A file that cannot be read, or not to
/// its end, is rejected at the line that is missing, and keeps nobody from the others. `tell` says, after each
/// piece of news, whether to go on.
///
/// # Errors
/// If the files hold no certificates; those of `tell`.
pub fn check_archive(
    listing: &Listing,
    tell: &mut dyn FnMut(News<'_>) -> Result<()>,
) -> Result<Archive> {
    let mut archive = Archive::default();
    let mut graphs = BTreeSet::new();
    let mut found: BTreeMap<&Path, Contents> = BTreeMap::new();
    for (file, _) in &listing.files {
        tell(News::File(file))?;
        let mut lines = certificates(file);
        let mut of_file = BTreeSet::new();
        let contents = found.entry(file).or_default();
        let mut line = 0;
        loop {
            let (batch, broken) = up_to(BATCH, &mut lines);
            let outcomes: Vec<_> = batch.par_iter().map(|text| check(text)).collect();
            for outcome in outcomes {
                line += 1;
                let proved = match outcome {
                    Ok(proved) => proved,
                    Err(failure) => {
                        match failure {
                            Failure::Rejected(_) => archive.rejected += 1,
                            Failure::TooLarge(_) => archive.undecided += 1,
                        }
                        tell(News::NotVerified(file, line, &failure))?;
                        continue;
                    }
                };
                archive.verified += 1;
                archive.supposing += usize::from(proved.supposes);
                *contents.verdicts.entry(proved.verdict).or_default() += 1;
                if let Some(solutions) = proved.solutions {
                    *contents.solutions.entry(solutions).or_default() += 1;
                }
                of_file.insert(proved.sha256);
            }
            tell(News::Done(batch.len() as u64))?;
            if let Some(error) = &broken {
                archive.rejected += 1;
                tell(News::NotVerified(file, line + 1, &unreadable(error)))?;
            }
            if broken.is_some() || batch.len() < BATCH {
                break;
            }
        }
        contents.graphs = of_file.len() as u64;
        graphs.append(&mut of_file);
    }
    ensure!(
        archive.verified + archive.rejected + archive.undecided > 0,
        "the files hold no certificates"
    );
    archive.graphs = graphs.len();
    for contents in found.values() {
        for (verdict, count) in &contents.verdicts {
            *archive.verdicts.entry(verdict.clone()).or_default() += count;
        }
    }
    archive.completeness = listing.completeness(&found);
    Ok(archive)
}

/// The independent checker's answer on a certificate; of what is none the reason says what one is.
fn check(text: &[u8]) -> Result<checker::Proved, Failure> {
    if is_certificate(text) {
        return checker::check(text);
    }
    Err(Failure::Rejected(Rejection {
        step: String::new(),
        reason: no_certificate(false).to_owned(),
    }))
}

/// Why one is not verified, in words that can be printed.
pub(super) fn reason(failure: &Failure) -> String {
    printable(&match failure {
        Failure::Rejected(rejection) => rejection.to_string(),
        Failure::TooLarge(limit) => limit.to_string(),
    })
}

/// The certificates of a file, one after another, or why the next one cannot be read.
type Lines = Box<dyn Iterator<Item = io::Result<Vec<u8>>>>;

/// The certificates of a file; after an error there are none.
fn certificates(file: &Path) -> Lines {
    if !is_list(file) {
        return Box::new(iter::once(fs::read(file)));
    }
    let input = match fs::File::open(file) {
        Ok(input) => input,
        Err(error) => return Box::new(iter::once(Err(error))),
    };
    let input: Box<dyn Read> = match file.extension() {
        Some(extension) if extension == "gz" => Box::new(MultiGzDecoder::new(input)),
        _ => Box::new(input),
    };
    Box::new(BufReader::with_capacity(1 << 16, input).split(b'\n'))
}

/// The next certificates of a file, at most so many, and why there is not another one if that is an error.
fn up_to(most: usize, lines: &mut Lines) -> (Vec<Vec<u8>>, Option<io::Error>) {
    let mut found = Vec::new();
    while found.len() < most {
        match lines.next() {
            Some(Ok(line)) => found.push(line),
            Some(Err(error)) => return (found, Some(error)),
            None => break,
        }
    }
    (found, None)
}

/// What cannot be read is not verified.
fn unreadable(error: &io::Error) -> Failure {
    Failure::Rejected(Rejection {
        step: String::new(),
        reason: format!("the file cannot be read from here on: {error}"),
    })
}
