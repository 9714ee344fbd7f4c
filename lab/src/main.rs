//! `viewcert-lab`: what was published with viewcert, made anew - the catalog of small graphs, the census, the
//! experiments with their charts, manual pages and completions; the catalog by the million; the formulations and
//! conditions of the literature.
//!
//! Arguments are read by [`command`], a file for each; the rest has no arguments.

mod catalog_page;
mod census;
mod command;
mod layout;
mod mixtures;
mod motion;
mod oriented;
mod report;
mod solutions;
mod svg;
mod thinned;

use clap::{Parser, Subcommand};
use std::process::ExitCode;
use viewcert_cli::LimitArguments;
use viewcert_session::Session;

/// What was published with viewcert, made anew, and studies of the literature.
///
/// Exit codes are those of verify: 0 done, 2 bad usage or input, 3 too large for the limits of time
/// and memory, 130 interrupted (Ctrl-C), 141 nobody reads the output, 143 terminated.
#[derive(Parser)]
#[command(name = "viewcert-lab", version)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    limits: LimitArguments,
}

#[derive(Subcommand)]
enum Command {
    /// Enumerate candidates and decide them all, on many machines.
    Catalog(Box<command::catalog::Arguments>),
    /// Compare the formulations of the literature: sizes, ranks, time.
    Compare(command::compare::CompareArguments),
    /// Check the necessary and sufficient conditions of the literature.
    Conditions(command::conditions::ConditionArguments),
    /// Print, as CSV, how often each tolerance of floating point misjudges the given graphs.
    Tolerances(command::tolerances::Arguments),
    /// Repeat the published method of components in exact arithmetic.
    Published(command::published::Arguments),
    /// Write the published catalog to a folder.
    Publish(command::publish::Arguments),
    /// Count how many graphs of a list each camera model determines.
    Census(command::census::Arguments),
    /// Count for which classes of cameras, and for which sensors, the graphs of a list are metric.
    Intrinsics(command::mixtures::Arguments),
    /// Decide connected random graphs (the paper's Table 2).
    Random(command::random::Arguments),
    /// Count the solutions of the finite solvable graphs with the fewest pairs, or of the Laman
    /// graphs.
    Solutions(command::solutions::Arguments),
    /// Count in how many scenes of the graphs with several solutions the scene is unique all the same.
    Oriented(command::oriented::Arguments),
    /// Draw what moves at given cameras at which a graph is not determined.
    Motion(command::motion::Arguments),
    /// Write, as JSON, another scene with the same images for each graph that has one.
    Scenes(command::scenes::Arguments),
    /// Count the solutions of pieces of graphs that are only just finite solvable.
    Thin(command::thin::Arguments),
    /// Print the completion script of a shell for verify.
    Completions(command::man::CompletionArguments),
    /// Print a manual page of verify.
    Manpage(command::man::ManpageArguments),
}

fn main() -> ExitCode {
    let arguments: CommandLine = viewcert_cli::parse(std::env::args_os());
    let limits = arguments.limits.limits();
    let code = Session::run("viewcert-lab", &limits, |session| {
        match &arguments.command {
            Command::Catalog(arguments) => command::catalog::run(session, arguments),
            Command::Compare(arguments) => command::compare::run(session, arguments),
            Command::Conditions(arguments) => command::conditions::run(session, arguments),
            Command::Tolerances(arguments) => command::tolerances::run(session, arguments),
            Command::Published(arguments) => command::published::run(session, arguments),
            Command::Publish(arguments) => command::publish::run(session, arguments),
            Command::Census(arguments) => command::census::run(session, arguments),
            Command::Intrinsics(arguments) => command::mixtures::run(session, arguments),
            Command::Random(arguments) => command::random::run(session, arguments),
            Command::Solutions(arguments) => command::solutions::run(session, arguments),
            Command::Oriented(arguments) => command::oriented::run(session, arguments),
            Command::Motion(arguments) => command::motion::run(session, arguments),
            Command::Scenes(arguments) => command::scenes::run(session, arguments),
            Command::Thin(arguments) => command::thin::run(session, arguments),
            Command::Completions(arguments) => command::man::completions(arguments),
            Command::Manpage(arguments) => command::man::manpage(arguments),
        }
    });
    code.into()
}
