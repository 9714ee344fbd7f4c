//! `verify compare GRAPH...`: every formulation side by side.

use super::bounds::BoundArguments;
use super::input::InputArguments;
use super::{GOOD, NOT, atomic};
use crate::exact::prime::{DEFAULT_PRIME, PrimeField};
use crate::formulation::compare::{self, Comparison};
use crate::graph::NamedGraph;
use crate::report::{bars, comparison};
use anyhow::{Context, Result};
use clap::Args;
use std::io::BufWriter;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of the comparison.
#[derive(Args)]
pub(super) struct CompareArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, also compressed by gzip; `-` is standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<String>,
    #[command(flatten)]
    input: InputArguments,
    /// Modulo which prime, 5 <= P < 2^62.
    #[arg(long, value_name = "P", default_value_t = DEFAULT_PRIME, conflicts_with = "rational")]
    prime: u64,
    /// Compute over the rationals, at cameras with small rational entries.
    #[arg(long)]
    rational: bool,
    #[command(flatten)]
    bounds: BoundArguments,
    /// Seed of the random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    /// Draw the sizes of the first graph's matrices to this file.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Compares on every graph in turn; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &CompareArguments) -> Result<ExitCode> {
    let field =
        PrimeField::new(arguments.prime).with_context(|| format!("--prime={}", arguments.prime))?;
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut svg = arguments.svg.as_deref();
    let each = |out: &mut _, input: &NamedGraph, _| {
        let found = compare(arguments, &field, input)?;
        if arguments.json {
            comparison::json(out, input, &found)?;
        } else {
            comparison::text(out, input, &found)?;
        }
        if let Some(path) = svg.take() {
            let picture = bars::draw(&comparison::sizes(input, &found));
            atomic::write(path, |out| out.write_all(picture.as_bytes()))?;
        }
        let agree = found.agrees(&input.graph);
        Ok(if agree { GOOD } else { NOT })
    };
    let code = arguments
        .input
        .for_each(&arguments.graphs, &mut out, each)?;
    Ok(ExitCode::from(code))
}

fn compare(
    arguments: &CompareArguments,
    field: &PrimeField,
    input: &NamedGraph,
) -> Result<Comparison> {
    let found = if arguments.rational {
        let bounds = (arguments.bounds.numerator, arguments.bounds.denominator);
        compare::rational(&input.graph, bounds, arguments.seed)
    } else {
        compare::modular(field, &input.graph, arguments.seed)
    };
    found.with_context(|| input.name.clone())
}
