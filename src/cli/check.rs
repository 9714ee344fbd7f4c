//! `verify check`: the independent checker on certificates.

use super::{GOOD, NOT};
use crate::graph::{ReadOptions, matlab, read_graphs};
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use flate2::read::MultiGzDecoder;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use viewcert_check::{Certificate, Failure, Graph, Verified};

/// Too large for the limits of the checker.
const TOO_LARGE: u8 = 3;

/// Certificates that are read before they are checked together.
const BATCH: usize = 256;

/// What to check.
#[derive(Args)]
pub(super) struct CheckArguments {
    /// A certificate (`-` is standard input), a file with a certificate a line (`.jsonl`,
    /// `.jsonl.gz`), or a folder of such files.
    #[arg(value_name = "CERTIFICATE")]
    certificate: PathBuf,
    /// The graph it is about; not needed if the certificate embeds it.
    #[arg(value_name = "GRAPH")]
    graph: Option<PathBuf>,
}

/// Checks one certificate, or all of a file or folder.
pub(super) fn run(arguments: &CheckArguments) -> Result<ExitCode> {
    let path = &arguments.certificate;
    if path.is_dir() || is_list(path) {
        ensure!(
            arguments.graph.is_none(),
            "a graph goes with one certificate, and {} has many",
            path.display()
        );
        let mut files = Vec::new();
        collect(path, &mut files).with_context(|| path.display().to_string())?;
        ensure!(
            !files.is_empty(),
            "{}: no certificates (.json, .jsonl, .jsonl.gz)",
            path.display()
        );
        return check_files(&files);
    }
    let text = read(path)?;
    let outcome = match &arguments.graph {
        None => viewcert_check::check(&text, None),
        Some(graph) => check_for(&text, graph)?,
    };
    let mut out = std::io::stdout().lock();
    let code = match outcome {
        Ok(verified) => {
            for line in verified.to_string().lines() {
                writeln!(out, "VERIFIED {line}")?;
            }
            GOOD
        }
        Err(Failure::Rejected(rejection)) => {
            writeln!(out, "REJECTED: {rejection}")?;
            NOT
        }
        Err(Failure::TooLarge(limit)) => {
            eprintln!("{limit} (of viewcert-check)");
            TOO_LARGE
        }
    };
    out.flush().context("standard output")?;
    Ok(ExitCode::from(code))
}

/// Checks a certificate for the graph in a file. The checker reads edge lists and graph6 by
/// itself; it does not read MATLAB files, which come through this program's reader.
fn check_for(text: &[u8], path: &Path) -> Result<Result<Verified, Failure>> {
    let certificate = match Certificate::parse(text) {
        Ok(certificate) => certificate,
        Err(rejection) => return Ok(Err(rejection)),
    };
    let bytes = read(path)?;
    let graph = if matlab::is_matlab(&bytes) {
        let name = path
            .to_str()
            .context("the name of the graph's file is not UTF-8")?;
        let Some(input) = read_graphs(name, &ReadOptions::default()).next() else {
            bail!("{name}: no graph");
        };
        let graph = input?.graph;
        Graph::new(graph.nodes(), graph.edges().iter().copied())
    } else {
        Graph::read(&bytes, || Some(certificate.graph_sha256()))
    };
    let graph = graph.with_context(|| path.display().to_string())?;
    Ok(certificate.check(Some(&graph)))
}

fn read(path: &Path) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let done = if path == Path::new("-") {
        std::io::stdin()
            .lock()
            .read_to_end(&mut bytes)
            .map(|_| bytes)
    } else {
        fs::read(path)
    };
    done.with_context(|| path.display().to_string())
}

/// Whether a file holds a certificate a line.
fn is_list(path: &Path) -> bool {
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .unwrap_or("");
    name.ends_with(".jsonl") || name.ends_with(".jsonl.gz")
}

/// All certificate files at or below a path, in a fixed order. Other JSON in the folder (a
/// schema, say) is not named `.json` alone but `.schema.json`.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    if path.is_dir() {
        let mut entries: Vec<PathBuf> = fs::read_dir(path)?
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<std::io::Result<_>>()?;
        entries.sort();
        return entries.iter().try_for_each(|entry| collect(entry, files));
    }
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .unwrap_or("");
    if is_list(path) || (name.ends_with(".json") && !name.ends_with(".schema.json")) {
        files.push(path.to_owned());
    }
    Ok(())
}

/// Checks every certificate of every file; each must hold its graph.
fn check_files(files: &[PathBuf]) -> Result<ExitCode> {
    let style = ProgressStyle::with_template("{bar:40} {pos} certificates, {per_sec}, {msg}")?;
    let bar = ProgressBar::new_spinner().with_style(style);
    let (mut verified, mut rejected, mut undecided) = (0u64, 0u64, 0u64);
    let mut out = std::io::stdout().lock();
    for file in files {
        let name = file.display().to_string();
        bar.set_message(name.clone());
        let mut lines = certificates(file).with_context(|| name.clone())?;
        let mut first = 1;
        loop {
            let batch: Vec<Vec<u8>> = lines
                .by_ref()
                .take(BATCH)
                .collect::<std::io::Result<_>>()
                .with_context(|| name.clone())?;
            if batch.is_empty() {
                break;
            }
            let outcomes: Vec<Option<Failure>> = batch
                .par_iter()
                .map(|text| viewcert_check::check(text, None).err())
                .collect();
            for (line, outcome) in (first..).zip(&outcomes) {
                match outcome {
                    None => verified += 1,
                    Some(Failure::Rejected(rejection)) => {
                        rejected += 1;
                        writeln!(out, "REJECTED {name}:{line}: {rejection}")?;
                    }
                    Some(Failure::TooLarge(limit)) => {
                        undecided += 1;
                        eprintln!("{name}:{line}: {limit} (of viewcert-check)");
                    }
                }
            }
            first += batch.len() as u64;
            bar.inc(batch.len() as u64);
        }
    }
    bar.finish_and_clear();
    ensure!(
        verified + rejected + undecided > 0,
        "the files hold no certificates"
    );
    write!(out, "{verified} certificates verified, {rejected} rejected")?;
    if undecided > 0 {
        write!(out, ", {undecided} too large for the limits")?;
    }
    writeln!(out)?;
    out.flush().context("standard output")?;
    Ok(ExitCode::from(match (rejected, undecided) {
        (0, 0) => GOOD,
        (0, _) => TOO_LARGE,
        _ => NOT,
    }))
}

/// The certificates of a file, one after another.
fn certificates(
    file: &Path,
) -> std::io::Result<Box<dyn Iterator<Item = std::io::Result<Vec<u8>>>>> {
    if !is_list(file) {
        return Ok(Box::new(std::iter::once(fs::read(file))));
    }
    let input = fs::File::open(file)?;
    let input: Box<dyn Read> = match file.extension() {
        Some(extension) if extension == "gz" => Box::new(MultiGzDecoder::new(input)),
        _ => Box::new(input),
    };
    Ok(Box::new(
        BufReader::with_capacity(1 << 16, input).split(b'\n'),
    ))
}
