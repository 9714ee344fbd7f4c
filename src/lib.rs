//! `verify`: arguments in, reports out; no mathematics. One file a command.
//!
//! [`main`] is the program.

mod advice;
#[cfg(feature = "studies")]
mod audit;
mod bounds;
mod catalog;
mod certificates;
mod check;
#[cfg(feature = "studies")]
mod compare;
#[cfg(feature = "studies")]
mod conditions;
mod convert;
mod displacements;
mod input;
mod limits;
mod models;
mod overview;
mod pages;
mod parts;
mod verify;
mod witness;

pub use limits::LimitArguments;

use anyhow::{Result, bail};
use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;
use viewcert_session::Session;

/// Exact, certified solvability of viewing graphs.
///
/// For every graph: is the set of cameras that its fundamental matrices determine unique,
/// finite, or infinite, and which maximal parts of it are determined?
///
/// Exit codes: 0 all graphs are solvable or finite solvable (check: verified; audit and
/// compare: all agree; conditions: no necessary one fails; overview: all images with a pair are
/// determined; models: solvable in every model), 1 some are not (check:
/// rejected; audit and compare: a disagreement, a refuted claim), 2 bad usage or input, 3 too
/// large for the method or for the limits of time and memory (compare: nothing could be
/// compared), 130 interrupted (Ctrl-C), 141 nobody reads the output, 143 terminated. Of several
/// graphs the largest code counts.
#[derive(Parser)]
#[command(name = "verify", version, args_conflicts_with_subcommands = true)]
#[command(subcommand_negates_reqs = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    verify: verify::VerifyArguments,
    #[command(flatten)]
    limits: limits::LimitArguments,
}

#[derive(Subcommand)]
enum Command {
    /// Say on one screen what the pairs and tracks of a database determine, and what follows.
    Overview(overview::OverviewArguments),
    /// Verify a certificate with the independent checker.
    Check(check::CheckArguments),
    /// Write what both checkers read: a graph as pairs of node numbers or as graph6, or with
    /// --parts its known parts.
    Convert(convert::ConvertArguments),
    /// Enumerate candidates and decide them all.
    Catalog(Box<catalog::Arguments>),
    /// Hold floating point, or claims of others, against the exact verdict.
    #[cfg(feature = "studies")]
    Audit(audit::AuditArguments),
    /// Compare the formulations of the literature: sizes, ranks, time.
    #[cfg(feature = "studies")]
    Compare(compare::CompareArguments),
    /// Decide every camera model side by side, and say what changes between them.
    Models(models::ModelsArguments),
    /// Check the necessary and sufficient conditions of the literature.
    #[cfg(feature = "studies")]
    Conditions(conditions::ConditionArguments),
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    let arguments = CommandLine::parse();
    let limits = arguments.limits.limits();
    Session::run("verify", &limits, |session| run(session, &arguments))
}

/// The arguments of the program, for its manual pages and completions.
pub fn command() -> clap::Command {
    CommandLine::command()
}

fn run(session: &Session, arguments: &CommandLine) -> Result<ExitCode> {
    match &arguments.command {
        Some(Command::Overview(arguments)) => overview::run(session, arguments),
        Some(Command::Check(arguments)) => check::run(arguments),
        Some(Command::Convert(arguments)) => convert::run(session, arguments),
        Some(Command::Catalog(arguments)) => catalog::run(session, arguments),
        #[cfg(feature = "studies")]
        Some(Command::Audit(arguments)) => audit::run(session, arguments),
        #[cfg(feature = "studies")]
        Some(Command::Compare(arguments)) => compare::run(session, arguments),
        Some(Command::Models(arguments)) => models::run(session, arguments),
        #[cfg(feature = "studies")]
        Some(Command::Conditions(arguments)) => conditions::run(session, arguments),
        None => {
            no_command(&arguments.verify)?;
            verify::run(session, &arguments.verify)
        }
    }
}

/// That the first graph is none of our commands, mistyped.
fn no_command(arguments: &verify::VerifyArguments) -> Result<()> {
    /// Letters that differ, or are in each other's places.
    const NEAR: usize = 2;
    let Some(word) = arguments.first_word() else {
        return Ok(());
    };
    let commands = CommandLine::command();
    let names = commands.get_subcommands().map(clap::Command::get_name);
    let near = names.map(|name| (strsim::osa_distance(&word.to_lowercase(), name), name));
    let nearest = near.filter(|(distance, _)| *distance <= NEAR).min();
    let meant = nearest.map(|(_, name)| format!("; did you mean `verify {name}`?"));
    let or = || "; give the path of a graph, or see `verify --help` for the commands".to_owned();
    bail!(
        "{word}: no such file and no such command{}",
        meant.unwrap_or_else(or)
    )
}
