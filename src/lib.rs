//! `verify`: arguments in, reports out; no mathematics. One file a command.
//!
//! [`main`] is the program. [`front`] is what another front end takes from it, so that both say the
//! same, byte for byte.

mod act;
mod atomic;
mod audit;
mod bounds;
mod catalog;
mod certificates;
mod check;
mod compare;
mod conditions;
mod convert;
mod displacements;
mod experiment;
pub mod front;
mod input;
mod man;
mod manifest;
mod models;
mod overview;
mod pages;
mod parts;
mod plane;
mod progress;
mod report;
mod running;
mod verify;
mod witness;

use anyhow::{Result, bail};
use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;
use viewcert::decide::VerdictError;
use viewcert::watch::{Reason, Stopped};
use viewcert_formats::ReadError;
use viewcert_studies::audit::AuditError;

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
    limits: running::LimitArguments,
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
    /// Repeat an experiment of the paper.
    Experiment(experiment::Arguments),
    /// Hold floating point, or claims of others, against the exact verdict.
    Audit(audit::AuditArguments),
    /// Compare the formulations of the literature: sizes, ranks, time.
    Compare(compare::CompareArguments),
    /// Decide every camera model side by side, and say what changes between them.
    Models(models::ModelsArguments),
    /// Check the necessary and sufficient conditions of the literature.
    Conditions(conditions::ConditionArguments),
    /// Print the completion script of a shell.
    #[command(hide = true)]
    Completions(man::CompletionArguments),
    /// Print a manual page.
    #[command(hide = true)]
    Manpage(man::ManpageArguments),
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    let arguments = CommandLine::parse();
    let done = running::begin(&arguments.limits).and_then(|()| match arguments.command {
        Some(Command::Overview(arguments)) => overview::run(&arguments),
        Some(Command::Check(arguments)) => check::run(&arguments),
        Some(Command::Convert(arguments)) => convert::run(&arguments),
        Some(Command::Catalog(arguments)) => catalog::run(&arguments),
        Some(Command::Experiment(arguments)) => experiment::run(&arguments),
        Some(Command::Audit(arguments)) => audit::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Models(arguments)) => models::run(&arguments),
        Some(Command::Conditions(arguments)) => conditions::run(&arguments),
        Some(Command::Completions(arguments)) => man::completions(&arguments),
        Some(Command::Manpage(arguments)) => man::manpage(&arguments),
        None => no_command(&arguments.verify).and_then(|()| verify::run(&arguments.verify)),
    });
    running::hide();
    match done {
        Ok(code) => code,
        Err(error) if atomic::is_broken_pipe(&error) => ExitCode::from(BROKEN_PIPE),
        Err(error) => {
            if running::first_to_say() {
                // Nothing is left to tell if standard error is gone as well.
                let _ = std::io::Write::write_fmt(
                    &mut std::io::stderr(),
                    format_args!("verify: {error:#}\n"),
                );
            }
            ExitCode::from(exit_code(&error))
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

/// Why work was stopped, if that is what an error says.
fn stopped(error: &anyhow::Error) -> Option<&Stopped> {
    error
        .chain()
        .find_map(|cause| match cause.downcast_ref::<VerdictError>() {
            Some(VerdictError::Stopped(stopped)) => Some(stopped),
            _ => cause.downcast_ref(),
        })
}

/// Whether an error ends the whole run: not that of a graph, but of the time, by a signal, or since
/// nobody reads on.
fn ends_run(error: &anyhow::Error) -> bool {
    atomic::is_broken_pipe(error)
        || stopped(error).is_some_and(|stopped| !matches!(stopped.reason, Reason::TooLarge { .. }))
}

/// The exit code for an error.
fn exit_code(error: &anyhow::Error) -> u8 {
    if let Some(stopped) = stopped(error) {
        return running::stopped(&stopped.reason);
    }
    let too_large = error.chain().any(|cause| {
        matches!(cause.downcast_ref(), Some(VerdictError::TooLarge { .. }))
            || matches!(cause.downcast_ref(), Some(AuditError::TooLarge { .. }))
            || matches!(cause.downcast_ref::<ReadError>(), Some(error) if error.problem.is_size())
    });
    if too_large { TOO_LARGE } else { BAD_INPUT }
}

// The table of exit codes; the help above and the README say the same.

/// All good.
const GOOD: u8 = 0;
/// Not solvable, or refuted.
const NOT: u8 = 1;
/// Bad usage or input.
const BAD_INPUT: u8 = 2;
/// Too large for the method, or for the limits of time and memory.
const TOO_LARGE: u8 = 3;
/// Stopped by SIGINT: 128 and its number, as shells have it.
const INTERRUPTED: u8 = 130;
/// Nobody reads on: what shells show for programs that a pipe has ended, 128 + SIGPIPE.
const BROKEN_PIPE: u8 = 141;
/// Stopped by SIGTERM.
const TERMINATED: u8 = 143;
