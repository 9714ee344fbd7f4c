//! `verify experiment`: the experiments of the paper, and numbers of solutions.

mod random;
mod solutions;
mod thin;

use anyhow::Result;
use clap::{Args, Subcommand};
use std::ops::RangeInclusive;
use std::process::ExitCode;
use viewcert_session::Session;

#[derive(Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Connected random graphs (the paper's Table 2).
    Random(random::Arguments),
    /// How many solutions the finite solvable graphs with the fewest pairs have, or the Laman
    /// graphs.
    Solutions(solutions::Arguments),
    /// How many solutions pieces of graphs have that are only just finite solvable.
    Thin(thin::Arguments),
}

pub(super) fn run(session: &Session, arguments: &Arguments) -> Result<ExitCode> {
    match &arguments.command {
        Command::Random(arguments) => random::run(session, arguments),
        Command::Solutions(arguments) => solutions::run(session, arguments),
        Command::Thin(arguments) => thin::run(session, arguments),
    }
}

/// Reads `9` or `3-10`.
fn sizes(text: &str) -> Result<RangeInclusive<usize>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if 3 <= first && first <= last => Ok(first..=last),
        _ => Err("write one number of nodes or two, from 3 up, as in 9 or 3-10".into()),
    }
}
