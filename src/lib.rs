//! `verify`: arguments in, reports out; no mathematics. One file a command.
//!
//! [`main`] is the program.

mod advise;
mod audit;
mod bounds;
mod catalog;
mod certificates;
mod check;
mod compare;
mod conditions;
mod convert;
mod decisions;
mod draw;
mod experiment;
mod export;
mod given;
mod help;
mod input;
mod limits;
mod man;
mod manifest;
mod models;
mod overview;
mod plan;
mod question;
mod verify;
mod witness;

pub use catalog::{Part, Size, merged};

use anyhow::{Result, bail};
use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;
use viewcert_session::Session;

/// Exact, certified solvability of viewing graphs.
///
/// Does my viewing graph determine the cameras?              verify GRAPH
/// What do the matches of my photographs determine?          verify overview DATABASE
/// Does this certificate prove what it claims?               verify check CERTIFICATE [GRAPH]
#[derive(Parser)]
#[command(name = "verify", version, args_conflicts_with_subcommands = true)]
#[command(subcommand_negates_reqs = true, disable_help_subcommand = true)]
#[command(verbatim_doc_comment, after_help = LITERATURE, after_long_help = AFTER)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    verify: verify::VerifyArguments,
    #[command(flatten)]
    limits: limits::LimitArguments,
}

/// The commands that the list of commands leaves out; a test holds them against it.
const LITERATURE: &str = "\
Commands of the literature:
  models      Decide every camera model side by side, and say what changes between them
  conditions  Check the necessary and sufficient conditions of the literature
  compare     Compare the formulations of the literature: sizes, ranks, time
  audit       Hold floating point, or claims of others, against the exact verdict
  catalog     Enumerate candidates and decide them all
  experiment  Repeat an experiment of the paper

How files are read: `verify help input`. What else can be known: `verify help given`.";

/// The same with the exit codes.
const AFTER: &str = "\
Commands of the literature:
  models      Decide every camera model side by side, and say what changes between them
  conditions  Check the necessary and sufficient conditions of the literature
  compare     Compare the formulations of the literature: sizes, ranks, time
  audit       Hold floating point, or claims of others, against the exact verdict
  catalog     Enumerate candidates and decide them all
  experiment  Repeat an experiment of the paper

How files are read: `verify help input`. What else can be known: `verify help given`.

Exit codes: 0 all graphs are solvable or finite solvable (check: verified; audit and compare: all
agree; conditions: no necessary one fails; overview: all images with a pair are determined; models:
solvable in every model), 1 some are not (check: rejected; audit and compare: a disagreement, a
refuted claim), 2 bad usage or input, 3 too large for the method or for the limits of time and memory
(compare: nothing could be compared), 130 interrupted (Ctrl-C), 141 nobody reads the output, 143
terminated. Of several graphs the largest code counts.";

#[derive(Subcommand)]
enum Command {
    /// Say on one screen what the pairs and tracks of a database determine, and what follows.
    Overview(overview::OverviewArguments),
    /// Say what to do about an answer: what it hangs on, what to match, what an image needs.
    Advise(advise::AdviseArguments),
    /// Write the components to a folder, as COLMAP takes them.
    Export(export::ExportArguments),
    /// Draw a graph with its components: a page, a picture.
    Draw(draw::DrawArguments),
    /// Write two sets of cameras that have the same fundamental matrices.
    Witness(witness::WitnessArguments),
    /// Verify a certificate with the independent checker.
    Check(check::CheckArguments),
    /// Write what both checkers read: a graph as pairs of node numbers or as graph6, or what is given
    /// besides.
    Convert(convert::ConvertArguments),
    /// Enumerate candidates and decide them all.
    #[command(hide = true)]
    Catalog(Box<catalog::Arguments>),
    /// Repeat an experiment of the paper.
    #[command(hide = true)]
    Experiment(experiment::Arguments),
    /// Hold floating point, or claims of others, against the exact verdict.
    #[command(hide = true)]
    Audit(audit::AuditArguments),
    /// Compare the formulations of the literature: sizes, ranks, time.
    #[command(hide = true)]
    Compare(compare::CompareArguments),
    /// Decide every camera model side by side, and say what changes between them.
    #[command(hide = true)]
    Models(models::ModelsArguments),
    /// Check the necessary and sufficient conditions of the literature.
    #[command(hide = true)]
    Conditions(conditions::ConditionArguments),
    /// Explain a command, how files are read (input), or what else can be known (given).
    Help(help::HelpArguments),
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
    let limits = arguments.limits.limits();
    let done = Session::begin(&limits).map_err(|error| (Session::default(), error));
    let done = done.and_then(|session| {
        let done = run(&session, &arguments);
        session.hide();
        done.map_err(|error| (session, error))
    });
    done.unwrap_or_else(|(session, error)| {
        session.say_end(&error);
        ExitCode::from(session.exit_code(&error))
    })
}

fn run(session: &Session, arguments: &CommandLine) -> Result<ExitCode> {
    match &arguments.command {
        Some(Command::Overview(arguments)) => overview::run(session, arguments),
        Some(Command::Advise(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Export(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Draw(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Witness(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Help(arguments)) => help::run(CommandLine::command(), arguments),
        Some(Command::Check(arguments)) => check::run(arguments),
        Some(Command::Convert(arguments)) => convert::run(session, arguments),
        Some(Command::Catalog(arguments)) => catalog::run(session, arguments),
        Some(Command::Experiment(arguments)) => experiment::run(session, arguments),
        Some(Command::Audit(arguments)) => audit::run(session, arguments),
        Some(Command::Compare(arguments)) => compare::run(session, arguments),
        Some(Command::Models(arguments)) => models::run(session, arguments),
        Some(Command::Conditions(arguments)) => conditions::run(session, arguments),
        Some(Command::Completions(arguments)) => {
            man::completions(CommandLine::command(), arguments)
        }
        Some(Command::Manpage(arguments)) => man::manpage(CommandLine::command(), arguments),
        None => {
            no_command(&arguments.verify)?;
            decisions::run(session, &arguments.verify.plan()?)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The commands that the list leaves out stand under a heading of their own, in the same words.
    #[test]
    fn every_command_is_in_the_help() {
        let program = CommandLine::command();
        for command in program.get_subcommands().filter(|one| one.is_hide_set()) {
            let (name, about) = (command.get_name(), command.get_about().unwrap());
            if ["completions", "manpage"].contains(&name) {
                continue;
            }
            let line = format!("  {name:<11} {about}\n");
            assert!(
                LITERATURE.contains(&line) && AFTER.contains(&line),
                "{line}"
            );
        }
        assert!(AFTER.starts_with(LITERATURE));
    }
}
