//! `verify conditions GRAPH...`: what the literature's conditions say.

use super::input::InputArguments;
use super::{BAD_INPUT, GOOD, NOT};
use crate::conditions;
use crate::graph::read_graphs;
use crate::report::conditions as report;
use anyhow::{Context, Result};
use clap::Args;
use std::io::{BufWriter, Write};
use std::process::ExitCode;

/// Options of the conditions.
#[derive(Args)]
pub(super) struct ConditionArguments {
    /// Graphs: edge lists, graph6 files (a graph a line), MATLAB 5 matrices; `-` is
    /// standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<String>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
}

/// Decides the conditions on every graph in turn; a bad one does not stop the others.
pub(super) fn run(arguments: &ConditionArguments) -> Result<ExitCode> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut code = GOOD;
    let options = arguments.input.read_options();
    for path in &arguments.graphs {
        for input in read_graphs(path, &options) {
            code = code.max(match input {
                Ok(input) => {
                    let found = conditions::decide(&input.graph);
                    if arguments.json {
                        report::json(&mut out, &input, &found)?;
                    } else {
                        report::text(&mut out, &input, &found)?;
                    }
                    if conditions::refuted(&found) {
                        NOT
                    } else {
                        GOOD
                    }
                }
                Err(error) => {
                    writeln!(std::io::stderr(), "verify: {error:#}")?;
                    BAD_INPUT
                }
            });
            out.flush().context("standard output")?;
        }
    }
    Ok(ExitCode::from(code))
}
