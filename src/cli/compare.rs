//! `verify compare GRAPH...`: every formulation side by side.

use super::input::InputArguments;
use super::{BAD_INPUT, GOOD, NOT, atomic};
use crate::exact::prime::{DEFAULT_PRIME, PrimeField};
use crate::formulation::compare::{self, Comparison};
use crate::graph::{NamedGraph, read_graphs};
use crate::report::{bars, comparison};
use anyhow::{Context, Result};
use clap::Args;
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of the comparison.
#[derive(Args)]
pub(super) struct CompareArguments {
    /// Graphs: edge lists, graph6 files (a graph a line), MATLAB 5 matrices; `-` is
    /// standard input.
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
    /// Bound on the numerators of rational cameras, at most 100.
    #[arg(long, value_name = "A", default_value_t = 9, requires = "rational")]
    numerator: u64,
    /// Bound on the denominators of rational cameras, at most 12.
    #[arg(long, value_name = "B", default_value_t = 4, requires = "rational")]
    denominator: u64,
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
    let mut code = GOOD;
    let options = arguments.input.read_options();
    for path in &arguments.graphs {
        for input in read_graphs(path, &options) {
            let done = input.map_err(Into::into).and_then(|input| {
                let found = compare(arguments, &field, &input)?;
                if arguments.json {
                    comparison::json(&mut out, &input, &found)?;
                } else {
                    comparison::text(&mut out, &input, &found)?;
                }
                if let Some(path) = svg.take() {
                    let picture = bars::draw(&comparison::sizes(&input, &found));
                    atomic::write(path, |out| out.write_all(picture.as_bytes()))?;
                }
                Ok(found.agrees(&input.graph))
            });
            code = code.max(match done {
                Ok(true) => GOOD,
                Ok(false) => NOT,
                Err(error) => {
                    let error: anyhow::Error = error;
                    writeln!(std::io::stderr(), "verify: {error:#}")?;
                    BAD_INPUT
                }
            });
            out.flush().context("standard output")?;
        }
    }
    Ok(ExitCode::from(code))
}

fn compare(
    arguments: &CompareArguments,
    field: &PrimeField,
    input: &NamedGraph,
) -> Result<Comparison> {
    let found = if arguments.rational {
        let bounds = (arguments.numerator, arguments.denominator);
        compare::rational(&input.graph, bounds, arguments.seed)
    } else {
        compare::modular(field, &input.graph, arguments.seed)
    };
    found.with_context(|| input.name.clone())
}
