//! `verify GRAPH...`: decide, report, certify.

use super::act;
use super::act::ActArguments;
use super::bounds::BoundArguments;
use super::certificates::Target;
use super::input::InputArguments;
use super::{GOOD, NOT, atomic, running};
use crate::report;
use crate::report::Report;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide as verdict;
use viewcert::decide::{Arithmetic, Options, Value};
use viewcert::geometry::model::Model;
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert_formats::NamedGraph;

/// Options of the verifier.
#[derive(Args)]
pub(super) struct VerifyArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, also compressed by gzip; `-` is standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<String>,
    /// Compute modulo a prime, 5 <= P < 2^62 [default: 2305843009213693951 = 2^61 - 1, and
    /// without this option 2^29 - 3 for cores of 256 cameras and more].
    #[arg(long, value_name = "P", num_args = 0..=1, require_equals = true)]
    #[arg(
        default_missing_value = "2305843009213693951",
        conflicts_with = "rational"
    )]
    prime: Option<u64>,
    /// Compute over the integers, at cameras with small rational entries.
    #[arg(long)]
    rational: bool,
    #[command(flatten)]
    bounds: BoundArguments,
    /// What is known of the cameras.
    #[arg(long, value_enum, default_value_t = ModelName::Projective)]
    model: ModelName,
    /// Compute the Jacobian of the whole graph, as the paper does.
    #[arg(long)]
    no_contraction: bool,
    /// Do not look for proofs by counting: negative verdicts get an error bound.
    #[arg(long)]
    no_counting: bool,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    input: InputArguments,
    /// Write a certificate to this file, or for every graph to this folder (`-`: to standard
    /// output, and the report to standard error).
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Embed graphs of any size in their certificates.
    #[arg(long, requires = "certificate")]
    embed_graph: bool,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    /// List the members of every component.
    #[arg(long)]
    components: bool,
    #[command(flatten)]
    act: ActArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum ModelName {
    /// Edges carry fundamental matrices.
    Projective,
    /// Edges carry essential matrices: known intrinsics.
    Calibrated,
}

impl VerifyArguments {
    fn options(&self) -> Result<Options> {
        let prime = self.prime.unwrap_or(DEFAULT_PRIME);
        ensure!(
            !self.rational || matches!(self.model, ModelName::Projective),
            "--rational: the calibrated model is decided modulo primes only; leave out --rational, or \
             --model calibrated"
        );
        let arithmetic = if self.rational {
            Arithmetic::Rational {
                numerator: self.bounds.numerator,
                denominator: self.bounds.denominator,
            }
        } else {
            Arithmetic::Prime
        };
        Ok(Options {
            model: match self.model {
                ModelName::Projective => Model::Projective,
                ModelName::Calibrated => Model::Calibrated,
            },
            arithmetic,
            field: PrimeField::new(prime).with_context(|| format!("--prime={prime}"))?,
            small_prime_from: if self.prime.is_some() {
                usize::MAX
            } else {
                Options::default().small_prime_from
            },
            contraction: !self.no_contraction,
            counting: !self.no_counting,
            seed: self.seed,
            watch: running::shown_watch(),
        })
    }
}

/// Decides every graph in turn; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &VerifyArguments) -> Result<ExitCode> {
    let options = arguments.options()?;
    arguments.act.check(&arguments.graphs)?;
    let mut target = arguments
        .certificate
        .as_deref()
        .map(|path| Target::new(path, arguments.embed_graph, &arguments.graphs))
        .transpose()?;
    let single = target
        .as_ref()
        .and_then(Target::single)
        .map(Path::to_path_buf);
    let mut out = atomic::text(&[arguments.certificate.as_deref()]);
    let mut is_first = true;
    let each = |out: &mut _, input: &NamedGraph, start| {
        if !std::mem::take(&mut is_first) {
            arguments.act.ensure_one()?;
        }
        arguments.act.check_input(input)?;
        let decided = decide(arguments, &options, input, target.as_mut(), start, out);
        Ok(match decided? {
            Value::NotFiniteSolvable => NOT,
            _ => GOOD,
        })
    };
    let code = arguments
        .input
        .for_each(&arguments.graphs, single.as_deref(), &mut out, each)?;
    Ok(ExitCode::from(code))
}

/// Decides one graph that has been read since `start`, certifies and reports.
fn decide(
    arguments: &VerifyArguments,
    options: &Options,
    input: &NamedGraph,
    target: Option<&mut Target>,
    start: Instant,
    out: &mut impl Write,
) -> Result<Value> {
    let decided = verdict::decide(&input.graph, options);
    running::hide();
    let verdict = decided.with_context(|| input.name.clone())?;
    let certificate = target
        .map(|target| target.write(input, &verdict))
        .transpose()?;
    let time = start.elapsed();
    let acted = arguments.act.act(input, &verdict, options.seed);
    running::hide();
    let acted = acted.with_context(|| input.name.clone())?;
    let report = Report {
        input,
        verdict: &verdict,
        rational: arguments.rational,
        list_components: arguments.components,
        time,
        acted: &acted,
    };
    if arguments.json {
        report::json::write(out, &report)?;
    } else {
        report::text::write(out, &report)?;
        act::write(out, &acted)?;
        if let Some(path) = certificate {
            writeln!(out, "  certificate {}", path.display())?;
        }
    }
    Ok(verdict.value)
}
