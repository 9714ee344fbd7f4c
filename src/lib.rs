//! Internal to viewcert, and may change at any time.
//!
//! `verify`: arguments in, reports out; no mathematics. One file a command.
//!
//! [`main`] is the program.

mod advise;
mod at_cameras;
mod audit;
mod bounds;
mod catalog;
mod certificates;
mod check;
mod command_line;
mod convert;
mod decisions;
mod draw;
mod export;
mod files;
mod given;
mod help;
mod input;
mod intrinsics;
mod label;
mod limits;
mod models;
mod plan;
mod question;
mod self_check;
mod split;
mod verify;
mod watch;
mod witness;

pub use bounds::Bounds;
pub use command_line::parse;
pub use input::InputArguments;
pub use limits::LimitArguments;

use anyhow::{Result, bail};
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use viewcert_session::{Session, exit};

/// Which cameras do the matches of your photographs determine? Exact, with certificates.
#[derive(Parser)]
#[command(name = "verify", version, args_conflicts_with_subcommands = true)]
#[command(subcommand_negates_reqs = true, disable_help_subcommand = true)]
#[command(after_long_help = after_help())]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    verify: verify::VerifyArguments,
    #[command(flatten)]
    limits: limits::LimitArguments,
}

/// The commands that the list of commands leaves out; a test holds them against it.
const LITERATURE: &[&str] = &[
    "  models      Every camera model side by side, and what changes between them",
    "  audit       Hold floating point, or claims of others, against the exact verdict",
    "  label       Name a small graph: one label for all its relabellings",
    "  catalog     Enumerate candidates and decide them all",
    "  witness     Two sets of cameras that have the same fundamental matrices",
    "  convert     A graph, or what is given besides, as both checkers read it",
];

/// The end of the help.
fn after_help() -> String {
    format!(
        "Commands of the literature:\n{}\n\nMore: `verify help input` (files), `given` (what else is known), \
         `intrinsics`. Exit codes: 0 good,\n1 not determined or rejected, 2 bad usage or input, 3 too large \
         (docs/reconstruction.md has a table).",
        LITERATURE.join("\n")
    )
}

#[derive(Subcommand)]
enum Command {
    /// What mappers will make of matches, whether to trust it, and what to do.
    Overview(files::OverviewArguments),
    /// What to match, what all hangs on, what an image needs.
    Advise(advise::AdviseArguments),
    /// Follow a database while COLMAP matches, and say what joins.
    Watch(watch::WatchArguments),
    /// Prove that not all motions of pairs can be right, and name pairs to look at.
    Contradictions(files::ContradictionsArguments),
    /// Write the parts to a folder, as COLMAP takes them.
    Export(export::ExportArguments),
    /// Take a model apart where its tracks do not hold it together.
    Split(split::SplitArguments),
    /// Whether what two models share fixes one against the other.
    Merge(files::MergeArguments),
    /// Whether lists of images are whole, and their overlaps fix scales.
    Lists(files::ListArguments),
    /// Draw a graph with its components, as a page or a picture.
    Draw(draw::DrawArguments),
    /// Two sets of cameras that have the same fundamental matrices.
    #[command(hide = true)]
    Witness(witness::WitnessArguments),
    /// Check a certificate with the independent checker.
    Check(check::CheckArguments),
    /// A graph, or what is given besides, as both checkers read it.
    #[command(hide = true)]
    Convert(convert::ConvertArguments),
    /// Name a small graph: one label for all its relabellings.
    #[command(hide = true)]
    Label(label::LabelArguments),
    /// Enumerate candidates and decide them all.
    #[command(hide = true)]
    Catalog(catalog::Arguments),
    /// Hold floating point, or claims of others, against the exact verdict.
    #[command(hide = true)]
    Audit(audit::AuditArguments),
    /// Every camera model side by side, and what changes between them.
    #[command(hide = true)]
    Models(models::ModelsArguments),
    /// Explain a command, or input, given, intrinsics.
    Help(help::HelpArguments),
}

/// Runs the program on its name and arguments, and returns the exit code. Where these ask for help or are
/// wrong, the process ends here.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: CommandLine = parse(arguments);
    let limits = arguments.limits.limits();
    Session::run("verify", &limits, |session| run(session, &arguments))
}

/// The arguments of the program, for its manual pages and completions.
pub fn command() -> clap::Command {
    CommandLine::command()
}

/// Whether this is the whole program. A page loads the program, so that of a page lacks what no page asks for.
const WHOLE: bool = !cfg!(target_family = "wasm");
/// Whether it answers about photographs; the page for graphs does not.
const PHOTOGRAPHS: bool = WHOLE || cfg!(feature = "databases");

fn run(session: &Session, arguments: &CommandLine) -> Result<u8> {
    match &arguments.command {
        Some(Command::Overview(arguments)) if PHOTOGRAPHS => files::overview(session, arguments),
        Some(Command::Advise(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Watch(arguments)) if WHOLE => watch::run(session, arguments),
        Some(Command::Export(arguments)) if WHOLE => decisions::run(session, &arguments.plan()?),
        Some(Command::Split(arguments)) if WHOLE => split::run(session, arguments),
        Some(Command::Contradictions(arguments)) if WHOLE => {
            files::contradictions(session, arguments)
        }
        Some(Command::Merge(arguments)) if WHOLE => files::merge(session, arguments),
        Some(Command::Lists(arguments)) if WHOLE => files::lists(session, arguments),
        Some(Command::Draw(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Witness(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Help(arguments)) if WHOLE => help::run(CommandLine::command(), arguments),
        Some(Command::Check(arguments)) if WHOLE => check::run(arguments),
        Some(Command::Convert(arguments)) => convert::run(session, arguments),
        Some(Command::Label(arguments)) => label::run(session, arguments),
        Some(Command::Catalog(arguments)) if WHOLE => catalog::run(session, arguments),
        Some(Command::Audit(arguments)) if WHOLE => audit::run(session, arguments),
        Some(Command::Models(arguments)) => models::run(session, arguments),
        Some(_) => bail!("no page has this command; install the program for it"),
        None => {
            let verify = &arguments.verify;
            verify.recorded(no_command(verify).map(|()| exit::GOOD))?;
            decisions::run(session, &verify.plan()?)
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
        let hidden = program.get_subcommands().filter(|one| one.is_hide_set());
        let mut lines: Vec<String> = hidden
            .map(|command| {
                let about = command.get_about().unwrap();
                format!("  {:<11} {about}", command.get_name())
            })
            .collect();
        let mut listed = LITERATURE.to_vec();
        lines.sort();
        listed.sort();
        assert_eq!(lines, listed);
    }
}
