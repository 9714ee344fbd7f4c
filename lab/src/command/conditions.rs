//! `viewcert-lab conditions GRAPH...`: what the literature's conditions say.

use crate::report::conditions as report;
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use viewcert_cli::InputArguments;
use viewcert_formats::NamedGraph;
use viewcert_lab_studies::conditions;
use viewcert_session::exit::{GOOD, NOT};
use viewcert_session::{Session, outputs};

/// Options of the conditions.
#[derive(Args)]
pub struct ConditionArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, GraphML and more, also compressed; `-` is standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
}

/// Decides the conditions on every graph in turn; a bad one does not stop the others.
pub fn run(session: &Session, arguments: &ConditionArguments) -> Result<u8> {
    let mut out = outputs::text(&[]);
    let each = |out: &mut _, input: &NamedGraph, _| {
        let found = conditions::decide(&input.graph);
        if arguments.json {
            report::json(out, input, &found)?;
        } else {
            report::text(out, input, &found)?;
        }
        let refuted = conditions::refuted(&found);
        Ok(if refuted { NOT } else { GOOD })
    };
    arguments.input.for_each(
        session,
        (&arguments.graphs, arguments.json),
        &|_| None,
        &mut out,
        each,
    )
}
