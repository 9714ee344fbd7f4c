//! `verify check`: the independent checker on certificates.

mod archive;
pub(crate) mod checker;
mod here;
mod intrinsics;
mod proved;

pub use archive::{Archive, News, check_archive};

use super::given::GivenArguments;
use super::input::InputArguments;
use super::plan::{INTRINSICS, IntrinsicsFrom};
use anyhow::{Context, Result, bail, ensure};
use archive::reason;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert_check::program::{is_certificate, no_certificate};
use viewcert_check::{Failure, is_here, is_of_intrinsics};
use viewcert_formats::folder::{Listing, is_list, name};
use viewcert_formats::whole;
use viewcert_report::counted;
use viewcert_session::exit::{GOOD, NOT, TOO_LARGE};
use viewcert_session::printable;

/// What to check.
#[derive(Args)]
pub(super) struct CheckArguments {
    /// A certificate (`-` is standard input), a file with a certificate a line (`.jsonl`,
    /// `.jsonl.gz`), or a folder of such files; a folder's `manifest.json` says what belongs to it.
    #[arg(value_name = "CERTIFICATE")]
    certificate: PathBuf,
    /// The graph it is about; not needed if the certificate embeds it.
    #[arg(value_name = "GRAPH")]
    graph: Option<PathBuf>,
    /// Ask `viewcert-proved` as well, with this explicit proof (`verify GRAPH --proof`), and say which
    /// checkers vouch for each claim.
    #[arg(
        long,
        value_name = "PROOF",
        requires = "graph",
        conflicts_with = "tracks"
    )]
    proved: Option<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// The graph is that of cameras and points, as for `verify GRAPH --tracks`.
    #[arg(long)]
    tracks: bool,
    /// What the certificate has to suppose, in the names of the graph, as for `verify GRAPH`: anything
    /// else is a rejection. With GRAPH and without this option: nothing.
    #[command(flatten)]
    given: GivenArguments,
    /// For a certificate of intrinsics: the classes it has to suppose, as for `verify GRAPH`.
    #[arg(long, value_name = "FILE", num_args = 0..=1, requires = "graph")]
    intrinsics: Option<Option<PathBuf>>,
}

/// Checks one certificate, or all of a file or folder.
pub(super) fn run(arguments: &CheckArguments) -> Result<u8> {
    let path = &arguments.certificate;
    ensure!(
        arguments.graph.is_some() || !(arguments.tracks || arguments.input.says_anything()),
        "--tracks and the options of `verify help input` say how a graph is read: name the graph as \
         well, or leave them out"
    );
    if path.is_dir() || is_list(path) {
        ensure!(
            arguments.graph.is_none(),
            "a graph goes with one certificate, and {} has many",
            path.display()
        );
        ensure!(
            arguments.given.path().is_none(),
            "what is given goes with one certificate, and {} has many",
            path.display()
        );
        let listing = Listing::new(path)?;
        for (skipped, why) in &listing.skipped {
            writeln!(
                std::io::stderr(),
                "verify: skipped {}: {why}",
                name(skipped)
            )?;
        }
        ensure!(
            !listing.files.is_empty(),
            "{}: no certificates (.json, .jsonl, .jsonl.gz); name a folder that has some, or the files",
            path.display()
        );
        return check_files(path, &listing);
    }
    let text = whole::bytes(path)?;
    ensure_certificate(path, &text, arguments.graph.as_deref())?;
    let given = arguments.given.path();
    let classes = arguments.intrinsics.as_ref().and_then(Option::as_deref);
    let inputs = [Some(&**path), arguments.graph.as_deref(), given, classes];
    let standard = inputs
        .into_iter()
        .flatten()
        .filter(|&path| path == Path::new("-"));
    ensure!(
        standard.count() < 2,
        "only one of certificate, graph and what is given can be standard input"
    );
    let options = || match arguments.tracks {
        true => Ok(arguments.input.of_tracks()),
        false => arguments.input.of_pairs(),
    };
    if is_here(&text) {
        ensure!(
            given.is_none() && arguments.proved.is_none(),
            "this certificate is about given cameras, which it holds: leave out --given and --proved, and compare \
             the hash of the centres with that of `verify GRAPH --given FILE`"
        );
        let checked = here::check(&text, arguments.graph.as_deref(), &options()?)?;
        return say(checked, String::clone, |_, _| Ok(GOOD));
    }
    let classes = arguments.intrinsics.clone().map(IntrinsicsFrom::from);
    if is_of_intrinsics(&text) {
        ensure!(
            given.is_none() && arguments.proved.is_none(),
            "this certificate is about classes of cameras and nothing else: leave out --given and --proved"
        );
        let graph = arguments.graph.as_deref();
        let checked = intrinsics::check(&text, graph, classes.as_ref(), &options()?)?;
        return say(checked, String::clone, |_, _| Ok(GOOD));
    }
    ensure!(
        classes.is_none(),
        "{INTRINSICS}: this certificate is about no classes of cameras; leave it out"
    );
    let outcome = match (&arguments.graph, given) {
        (None, None) => checker::check(&text),
        (None, Some(given)) => checker::check_given(&text, given)?,
        (Some(graph), given) => checker::check_for(&text, graph, given, &options()?)?,
    };
    let text = |proved: &checker::Proved| proved.text.clone();
    say(outcome, text, |out, proved| {
        match (&arguments.proved, &arguments.graph) {
            (Some(proof), Some(graph)) => say_vouched(out, proved, graph, proof),
            _ => Ok(GOOD),
        }
    })
}

/// Says what was verified in words, or not, and returns the exit code; what else there is to say of what was
/// verified follows.
fn say<T>(
    outcome: Result<T, Failure>,
    text: impl Fn(&T) -> String,
    more: impl FnOnce(&mut std::io::StdoutLock, &T) -> Result<u8>,
) -> Result<u8> {
    let mut out = std::io::stdout().lock();
    let code = match outcome {
        Ok(proved) => {
            for line in text(&proved).lines() {
                writeln!(out, "VERIFIED {}", printable(line))?;
            }
            more(&mut out, &proved)?
        }
        Err(Failure::Rejected(rejection)) => {
            writeln!(out, "REJECTED: {}", printable(&rejection.to_string()))?;
            NOT
        }
        Err(Failure::TooLarge(limit)) => {
            writeln!(
                std::io::stderr(),
                "verify: {}",
                printable(&limit.to_string())
            )?;
            TOO_LARGE
        }
    };
    out.flush().context("standard output")?;
    Ok(code)
}

/// Which checkers vouch for the claims, and the exit code.
fn say_vouched(
    out: &mut impl Write,
    proved: &checker::Proved,
    graph: &Path,
    proof: &Path,
) -> Result<u8> {
    Ok(match proved::vouch(proved, graph, proof)? {
        Ok(claims) => {
            for claim in claims.lines() {
                writeln!(out, "CHECKED {claim}")?;
            }
            GOOD
        }
        Err(why) => {
            writeln!(out, "REJECTED: {}", printable(&why))?;
            NOT
        }
    })
}

/// What is no certificate is not rejected, which would say something about a claim.
///
/// # Errors
/// If it is none; whether the other file is one is said.
fn ensure_certificate(path: &Path, text: &[u8], graph: Option<&Path>) -> Result<()> {
    if is_certificate(text) {
        return Ok(());
    }
    let swapped = graph.is_some_and(|graph| {
        let other = graph.is_file().then(|| fs::read(graph));
        matches!(other, Some(Ok(other)) if is_certificate(&other))
    });
    bail!("{}: {}", path.display(), no_certificate(swapped))
}

/// Checks every certificate of every file, and says what came of them.
fn check_files(path: &Path, listing: &Listing) -> Result<u8> {
    let style = ProgressStyle::with_template("{bar:40} {pos} certificates, {per_sec}, {msg}")?;
    let bar = ProgressBar::new_spinner().with_style(style);
    let mut out = std::io::stdout().lock();
    let found = check_archive(listing, &mut |news| {
        match news {
            News::File(file) => bar.set_message(name(file)),
            News::Done(more) => bar.inc(more),
            News::NotVerified(file, line, failure) => {
                let word = match failure {
                    Failure::Rejected(_) => "REJECTED",
                    Failure::TooLarge(_) => "UNDECIDED",
                };
                writeln!(out, "{word} {}:{line}: {}", name(file), reason(failure))?;
            }
        }
        Ok(())
    })?;
    bar.finish_and_clear();
    let certificates = counted(found.verified, "certificate");
    write!(out, "{certificates} verified, {} rejected", found.rejected)?;
    if found.undecided > 0 {
        write!(out, ", {} too large for the limits", found.undecided)?;
    }
    writeln!(out)?;
    writeln!(out, "{}", counted(found.graphs, "distinct graph"))?;
    let mut good = found.rejected == 0;
    match found.completeness {
        Some(completeness) => {
            good &= completeness.complete;
            for line in completeness.lines {
                writeln!(out, "{line}")?;
            }
        }
        None if path.is_dir() => writeln!(
            out,
            "{}: no manifest.json, so that nothing is known of files that are not there",
            name(path)
        )?,
        None => {}
    }
    out.flush().context("standard output")?;
    Ok(match (good, found.undecided) {
        (true, 0) => GOOD,
        (true, _) => TOO_LARGE,
        (false, _) => NOT,
    })
}
