//! `viewcert-lab compare GRAPH...`: every formulation side by side.

use crate::report::{bars, comparison};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::PathBuf;
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert_cli::{Bounds, InputArguments};
use viewcert_formats::NamedGraph;
use viewcert_lab_studies::formulation::compare;
use viewcert_lab_studies::formulation::compare::{
    CompareError, Comparison, Limits, MAX_RATIONALS, MAX_RESIDUES, Outcome,
};
use viewcert_session::Session;
use viewcert_session::exit::{GOOD, NOT};
use viewcert_session::outputs;

/// Options of the comparison.
#[derive(Args)]
pub struct CompareArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, GraphML and more, also compressed; `-` is standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Of which cameras.
    #[arg(long, value_enum, default_value_t = CameraName::Projective)]
    model: CameraName,
    /// Modulo which prime, 5 <= P < 2^62.
    #[arg(long, value_name = "P", default_value_t = DEFAULT_PRIME, conflicts_with = "rational")]
    prime: u64,
    /// Compute over the rationals, at cameras whose entries are fractions with numerators up to A and
    /// denominators up to B [default: 9,4].
    #[arg(long, value_name = "A,B", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "9,4")]
    rational: Option<Bounds>,
    /// Seed of the random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Do not eliminate matrices with more entries, rows times columns; Lambda, which is dense, counts
    /// eightfold. Their sizes are printed all the same [default: 134217728, with --rational 262144].
    #[arg(long, value_name = "ENTRIES")]
    limit: Option<usize>,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    /// Draw the sizes of the first graph's matrices to this file (`-`: to standard output, and the
    /// table to standard error).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CameraName {
    /// Any cameras, whose pairs have fundamental matrices.
    Projective,
    /// Affine cameras.
    Affine,
}

/// Compares on every graph in turn; a bad one is reported and does not stop the others.
pub fn run(session: &Session, arguments: &CompareArguments) -> Result<u8> {
    let field =
        PrimeField::new(arguments.prime).with_context(|| format!("--prime={}", arguments.prime))?;
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    outputs::ensure_apart(&[("--svg", arguments.svg.as_deref())], inputs)?;
    let mut out = outputs::text(&[arguments.svg.as_deref()]);
    let mut svg = arguments.svg.as_deref();
    let each = |out: &mut _, input: &NamedGraph, _| {
        let found = compare(arguments, &field, input).with_context(|| input.name.clone())?;
        if arguments.json {
            comparison::json(out, (input, arguments.seed), &found)?;
        } else {
            comparison::text(out, input, &found)?;
        }
        if let Some(path) = svg.take() {
            let picture = bars::draw(&comparison::sizes(input, &found));
            session
                .outputs()
                .write(path, |out| out.write_all(picture.as_bytes()))?;
        }
        Ok(match found.outcome(&input.graph) {
            Outcome::Agree(_) | Outcome::NotCompared => GOOD,
            Outcome::Disagree => NOT,
        })
    };
    arguments.input.for_each(
        session,
        (&arguments.graphs, arguments.json),
        &|_| None,
        &mut out,
        each,
    )
}

/// Largest matrix whose elimination is not announced: a few seconds, modulo a prime and over Q.
const SILENT: [usize; 2] = [1 << 25, 1 << 18];

fn compare(
    arguments: &CompareArguments,
    field: &PrimeField,
    input: &NamedGraph,
) -> Result<Comparison, CompareError> {
    let announce = |name: &str, (rows, columns): (usize, usize)| {
        // A notice is not worth failing for.
        let _ = writeln!(
            std::io::stderr(),
            "viewcert-lab: {}: {name}: about {rows} x {columns} entries, which may take minutes; --limit leaves \
             out what is too large",
            input.name
        );
    };
    let [residues, rationals] = SILENT;
    if let Some(Bounds {
        numerator,
        denominator,
    }) = arguments.rational
    {
        let bounds = (numerator, denominator);
        let limits = Limits {
            entries: arguments.limit.unwrap_or(MAX_RATIONALS),
            silent: rationals,
            announce: &announce,
        };
        let rational = match arguments.model {
            CameraName::Projective => compare::rational,
            CameraName::Affine => compare::affine::rational,
        };
        return rational(&input.graph, bounds, arguments.seed, &limits);
    }
    let limits = Limits {
        entries: arguments.limit.unwrap_or(MAX_RESIDUES),
        silent: residues,
        announce: &announce,
    };
    let modular = match arguments.model {
        CameraName::Projective => compare::modular,
        CameraName::Affine => compare::affine::modular,
    };
    modular(field, &input.graph, arguments.seed, &limits)
}
