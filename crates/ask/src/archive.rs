//! Many certificates: files with one a line, folders, and by their manifests whether all are there.

use anyhow::{Result, ensure};
use flate2::read::MultiGzDecoder;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::path::Path;
use std::{fmt, fs, iter};
use viewcert_check::program::{MAX_BYTES, is_certificate, no_certificate};
use viewcert_check::{
    Answer, Certificate, Expected, Failure, Limits, Rejection, TooLarge, Verdict,
};
use viewcert_formats::folder::{Completeness, Listing, is_list};
use viewcert_formats::manifest::Contents;
use viewcert_session::printable;

/// Certificates that are read before they are checked together, and their bytes.
const BATCH: usize = 256;
const BATCH_BYTES: usize = 1 << 26;

/// Longest line that is read without being asked for more: a compressed file may hold a thousand times its size.
const LINE_BYTES: u64 = 1 << 28;

/// What is expected of every certificate, and what checking one may cost.
#[derive(Default)]
pub struct Terms {
    /// What it must be about.
    pub expected: Expected,
    /// What it may cost.
    pub limits: Limits,
    /// Bytes of a line, or of a file.
    pub max_bytes: Option<u64>,
}

/// What a certificate says, as far as it is counted.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Statement {
    /// The model.
    pub model: String,
    /// The verdict.
    pub verdict: String,
    /// What it supposes besides the graph.
    pub supposed: Vec<&'static str>,
}

/// What is told while they are checked.
pub enum News<'a> {
    /// A file is begun.
    File(&'a Path),
    /// So many certificates more are checked.
    Done(u64),
    /// The one on a line of a file is not verified, and why.
    NotVerified(&'a Path, u64, &'a Failure),
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.model, self.verdict)?;
        match self.supposed.is_empty() {
            true => Ok(()),
            false => write!(f, ", supposing {}", self.supposed.join(" and ")),
        }
    }
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
    /// How many say what.
    pub statements: BTreeMap<Statement, u64>,
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
    terms: &Terms,
    tell: &mut dyn FnMut(News<'_>) -> Result<()>,
) -> Result<Archive> {
    let mut archive = Archive::default();
    let mut graphs = BTreeSet::new();
    let mut found: BTreeMap<&Path, Contents> = BTreeMap::new();
    for (file, _) in &listing.files {
        tell(News::File(file))?;
        let mut lines = certificates(file, terms.max_bytes);
        let mut of_file = BTreeSet::new();
        let contents = found.entry(file).or_default();
        let mut line = 0;
        let mut more = true;
        while more {
            let (batch, broken) = next_batch(&mut lines);
            more = !batch.is_empty() && broken.is_none();
            let outcomes = batch.par_iter().map(|(_, text)| check(text, terms));
            let outcomes: Vec<_> = outcomes.collect();
            for (outcome, (number, _)) in outcomes.into_iter().zip(&batch) {
                line = *number;
                let verified = match outcome {
                    Ok(verified) => verified,
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
                let statement = Statement {
                    model: verified.model().to_string(),
                    verdict: verified.verdict(),
                    supposed: verified.supposed(),
                };
                contents.add(&statement.model, &statement.verdict, &statement.supposed);
                if let Some(solutions) = solutions(&verified) {
                    *contents.solutions.entry(solutions).or_default() += 1;
                }
                *archive.statements.entry(statement).or_default() += 1;
                of_file.insert(verified.graph().1.to_owned());
            }
            tell(News::Done(batch.len() as u64))?;
            if let Some(error) = &broken {
                let failure = unreadable(error);
                match failure {
                    Failure::Rejected(_) => archive.rejected += 1,
                    Failure::TooLarge(_) => archive.undecided += 1,
                }
                tell(News::NotVerified(file, line + 1, &failure))?;
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
    archive.completeness = listing.completeness(&found);
    Ok(archive)
}

/// The independent checker's answer on a certificate; of what is none the reason says what one is.
fn check(text: &[u8], terms: &Terms) -> Result<Answer, Failure> {
    if !is_certificate(text) {
        return Err(rejected(no_certificate(false).to_owned()));
    }
    let verified = Certificate::parse(text)?.check(None, None, &terms.limits)?;
    let found = terms.expected.differences(&verified);
    match found.is_empty() {
        true => Ok(verified),
        false => Err(rejected(not_as_expected(&found))),
    }
}

/// Why a certificate is right, and still not the one that was asked for.
#[must_use]
pub fn not_as_expected(found: &[String]) -> String {
    format!("not what is expected: {}", found.join("; "))
}

fn rejected(reason: String) -> Failure {
    Failure::Rejected(Rejection {
        step: String::new(),
        reason,
    })
}

/// What is proved of the number of solutions, "2", "1-3" or "1-"; a number is proved by `solvable` as well.
#[must_use]
pub fn solutions(verified: &Answer) -> Option<String> {
    let Answer::Generic(verified) = verified else {
        return None;
    };
    match (verified.verdict.0, &verified.solutions) {
        (Verdict::NotFiniteSolvable, _) => None,
        (Verdict::Solvable, _) => Some("1".into()),
        (Verdict::FiniteSolvable, None) => Some("1-".into()),
        (Verdict::FiniteSolvable, Some(count)) => Some(match count.at_most {
            Some(most) if most == count.at_least => most.to_string(),
            Some(most) => format!("{}-{most}", count.at_least),
            None => format!("{}-", count.at_least),
        }),
    }
}

/// Why one is not verified, in words that can be printed.
#[must_use]
pub fn reason(failure: &Failure) -> String {
    printable(&failure.to_string())
}

/// The certificates of a file with their lines, one after another, or why the next one cannot be read.
type Lines = Box<dyn Iterator<Item = io::Result<(u64, Vec<u8>)>>>;

/// The certificates of a file, of which none is longer than so many bytes; after an error there are none.
/// Blank lines hold none.
fn certificates(file: &Path, max_bytes: Option<u64>) -> Lines {
    let input = match fs::File::open(file) {
        Ok(input) => input,
        Err(error) => return Box::new(iter::once(Err(error))),
    };
    if !is_list(file) {
        let most = max_bytes.unwrap_or(MAX_BYTES);
        let mut text = Vec::new();
        let read = input.take(most.saturating_add(1)).read_to_end(&mut text);
        let read = read.and_then(|_| fits(&text, most));
        return Box::new(iter::once(read.map(|()| (1, text))));
    }
    let most = max_bytes.unwrap_or(LINE_BYTES);
    let input: Box<dyn Read> = match file.extension() {
        Some(extension) if extension == "gz" => Box::new(MultiGzDecoder::new(input)),
        _ => Box::new(input),
    };
    let mut input = BufReader::with_capacity(1 << 16, input);
    let lines = (1..).map_while(move |number| {
        let mut line = Vec::new();
        let within = &mut (&mut input).take(most.saturating_add(1));
        match within.read_until(b'\n', &mut line) {
            Ok(0) => None,
            Ok(_) => Some(fits(&line, most).map(|()| (number, line))),
            Err(error) => Some(Err(error)),
        }
    });
    Box::new(lines.filter(|line| {
        !line
            .as_ref()
            .is_ok_and(|(_, text)| text.trim_ascii().is_empty())
    }))
}

fn fits(text: &[u8], most: u64) -> io::Result<()> {
    match text.len() as u64 > most {
        true => Err(io::Error::new(
            ErrorKind::FileTooLarge,
            format!("a certificate of more than {most} bytes, at which reading ends"),
        )),
        false => Ok(()),
    }
}

/// The next certificates of a file, and why there is not another one if that is an error.
fn next_batch(lines: &mut Lines) -> (Vec<(u64, Vec<u8>)>, Option<io::Error>) {
    let (mut found, mut bytes) = (Vec::new(), 0);
    while found.len() < BATCH && bytes < BATCH_BYTES {
        match lines.next() {
            Some(Ok(line)) => {
                bytes += line.1.len();
                found.push(line);
            }
            Some(Err(error)) => return (found, Some(error)),
            None => break,
        }
    }
    (found, None)
}

/// What cannot be read is not verified.
fn unreadable(error: &io::Error) -> Failure {
    if error.kind() == ErrorKind::FileTooLarge {
        return Failure::TooLarge(TooLarge {
            step: String::new(),
            reason: error.to_string(),
            option: "--max-bytes",
        });
    }
    rejected(format!("the file cannot be read from here on: {error}"))
}
