//! `verify check`: the independent checker on certificates.

mod bound;
mod checker;

use super::given::GivenArguments;
use super::input::InputArguments;
use super::plan::IntrinsicsFrom;
use anyhow::{Context, Result, bail, ensure};
use checker::Named;
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert_ask::archive::{News, Terms, check_archive, not_as_expected, reason};
use viewcert_check::program::{self, MAX_BYTES, is_certificate, no_certificate};
use viewcert_check::{Certificate, Expected, Failure, Limits, Model, Question};
use viewcert_formats::folder::{Listing, is_list, name};
use viewcert_formats::whole;
use viewcert_report::counted;
use viewcert_session::exit::{GOOD, NOT, TOO_LARGE};
use viewcert_session::printable;

/// What to check.
#[derive(Args)]
pub(super) struct CheckArguments {
    /// A certificate, a file with one a line (.jsonl, .jsonl.gz), or a folder.
    #[arg(value_name = "CERTIFICATE")]
    certificate: PathBuf,
    /// The graph it is about, if the certificate embeds none; the COLMAP database of one of contradictions.
    #[arg(value_name = "GRAPH")]
    graph: Option<PathBuf>,
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
    #[arg(long, value_name = "FILE", num_args = 0..=1, requires = "graph", conflicts_with = "classes")]
    intrinsics: Option<Option<PathBuf>>,
    #[command(flatten)]
    expected: ExpectedArguments,
}

/// What `viewcert-check` takes as well. With GRAPH or any of these the model is projective, and nothing else is
/// supposed, unless it is named.
#[derive(Args)]
#[command(next_help_heading = "What the certificate must be about")]
struct ExpectedArguments {
    /// The verdict: solvable, finite-solvable, not-finite-solvable, determined,
    /// not-determined, metric, not-metric or open.
    #[arg(long, value_name = "VERDICT", value_parser = program::verdict)]
    expect: Option<String>,
    /// The model: projective, calibrated or affine.
    #[arg(long, value_name = "MODEL", value_parser = program::model)]
    model: Option<Model>,
    /// The number of nodes.
    #[arg(long, value_name = "N")]
    nodes: Option<usize>,
    /// The number of edges.
    #[arg(long, value_name = "M")]
    edges: Option<usize>,
    /// The hash of the graph.
    #[arg(long, value_name = "HEX", value_parser = program::hash)]
    sha256: Option<String>,
    /// The hash of the cameras' centres, for a certificate at given cameras.
    #[arg(long, value_name = "HEX", value_parser = program::hash)]
    centres: Option<String>,
    /// The hash of the cameras' classes, for a certificate of intrinsics.
    #[arg(long, value_name = "HEX", value_parser = program::hash)]
    classes: Option<String>,
    /// Proofs, no error bounds.
    #[arg(long)]
    proofs_only: bool,
    /// Size of a certificate [default: 2^31; of a line of many: 2^28].
    #[arg(long, value_name = "N", help_heading = LIMITS, hide_short_help = true)]
    max_bytes: Option<u64>,
    /// Nodes of a core.
    #[arg(long, value_name = "N", help_heading = LIMITS, hide_short_help = true)]
    max_core: Option<u64>,
    /// Flows of a `plane-flow`.
    #[arg(long, value_name = "N", help_heading = LIMITS, hide_short_help = true)]
    max_flows: Option<u64>,
    /// Bits of an integer of an `integer-minor`.
    #[arg(long, value_name = "N", help_heading = LIMITS, hide_short_help = true)]
    max_bits: Option<u64>,
    /// Elementary operations in all.
    #[arg(long, value_name = "N", help_heading = LIMITS, hide_short_help = true)]
    max_operations: Option<u64>,
}

/// The title of limits in the help.
const LIMITS: &str = "Limits of checking (beyond them: exit code 3)";

impl CheckArguments {
    /// What is expected, and what it may cost to see.
    fn terms(&self) -> Terms {
        let asked = &self.expected;
        let default = Limits::default();
        Terms {
            expected: Expected {
                verdict: asked.expect.clone(),
                // Observations of points have no other model.
                model: asked.model.or(self.tracks.then_some(Model::Calibrated)),
                nodes: asked.nodes,
                edges: asked.edges,
                sha256: asked.sha256.clone(),
                centres: asked.centres.clone(),
                classes: asked.classes.clone(),
                proofs_only: asked.proofs_only,
                for_graph: self.graph.is_some(),
                given: self.given.path().is_some(),
            },
            limits: Limits {
                core: asked.max_core.unwrap_or(default.core),
                flows: asked.max_flows.unwrap_or(default.flows),
                bits: asked.max_bits.unwrap_or(default.bits),
                operations: asked.max_operations.unwrap_or(default.operations),
            },
            max_bytes: asked.max_bytes,
        }
    }
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
        return check_files(path, &listing, &arguments.terms());
    }
    let text = whole::bytes(path)?;
    let most = arguments.expected.max_bytes.unwrap_or(MAX_BYTES);
    if text.len() as u64 > most {
        writeln!(
            std::io::stderr(),
            "verify: too large for the limits: {} has more than {most} bytes; raise it with --max-bytes",
            name(path)
        )?;
        return Ok(TOO_LARGE);
    }
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
        true => Ok(arguments.input.reading().tracks),
        false => arguments.input.of_pairs(),
    };
    let from = arguments.intrinsics.clone().map(IntrinsicsFrom::from);
    let mut terms = arguments.terms();
    let checked = match (Certificate::parse(&text), &arguments.graph) {
        (Ok(certificate), Some(path)) if certificate.question() == Question::Contradictions => {
            bound::check(&certificate, path, &terms.limits)?
        }
        (Ok(certificate), _) => {
            let named = Named {
                graph: arguments.graph.as_deref(),
                given,
                one_frame: arguments.given.is_one_frame(),
                classes: from.as_ref(),
                read: &options()?,
            };
            let graph = named.resolve(&certificate, &mut terms.expected)?;
            certificate.check(graph.as_ref(), None, &terms.limits)
        }
        (Err(failure), _) => Err(failure),
    };
    let verified = match checked {
        Ok(verified) => verified,
        Err(failure) => return not_verified(&failure),
    };
    let found = terms.expected.differences(&verified);
    if !found.is_empty() {
        writeln!(
            std::io::stderr(),
            "verify: {}",
            printable(&not_as_expected(&found))
        )?;
        return Ok(NOT);
    }
    let mut out = std::io::stdout().lock();
    for line in verified.to_string().lines() {
        writeln!(out, "VERIFIED {}", printable(line))?;
    }
    out.flush().context("standard output")?;
    Ok(GOOD)
}

/// Says why a certificate is not verified, and returns the exit code.
fn not_verified(failure: &Failure) -> Result<u8> {
    match failure {
        Failure::Rejected(_) => {
            let mut out = std::io::stdout().lock();
            writeln!(out, "REJECTED: {}", reason(failure))?;
            out.flush().context("standard output")?;
            Ok(NOT)
        }
        Failure::TooLarge(_) => {
            writeln!(std::io::stderr(), "verify: {}", reason(failure))?;
            Ok(TOO_LARGE)
        }
    }
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

/// Checks every certificate of every file, and says what came of them: what all suppose is listed.
fn check_files(path: &Path, listing: &Listing, terms: &Terms) -> Result<u8> {
    let style = ProgressStyle::with_template("{bar:40} {pos} certificates, {per_sec}, {msg}")?;
    let bar = ProgressBar::new_spinner().with_style(style);
    let mut out = std::io::stdout().lock();
    let found = check_archive(listing, terms, &mut |news| {
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
    for (statement, count) in &found.statements {
        writeln!(out, "{count} {statement}")?;
    }
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
