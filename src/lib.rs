//! Internal to viewcert, and may change at any time.
//!
//! `verify`: arguments in, reports out; no mathematics. One file a command.
//!
//! [`main`] is the program. What a command finds out from several files is there for others too:
//! [`OverviewAsked`], [`ListsAsked`], [`MergeAsked`], [`check_archive`].

mod advise;
mod at_cameras;
mod audit;
mod bounds;
mod catalog;
mod certificates;
mod check;
mod command_line;
mod contradictions;
mod convert;
mod decisions;
mod draw;
mod export;
mod given;
mod help;
mod input;
mod intrinsics;
mod label;
mod limits;
mod lists;
mod merge;
mod models;
mod overview;
mod plan;
mod question;
mod self_check;
mod split;
mod verify;
mod watch;
mod witness;

pub use bounds::Bounds;
pub use check::{Archive, News, Statement, Terms, check_archive};
pub use command_line::parse;
pub use contradictions::Asked as ContradictionsAsked;
pub use input::{InputArguments, of_tracks_alone};
pub use limits::LimitArguments;
pub use lists::Asked as ListsAsked;
pub use merge::Asked as MergeAsked;
pub use overview::Asked as OverviewAsked;

use anyhow::{Result, bail};
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use viewcert_session::{Session, exit};

/// Exact, certified solvability of viewing graphs.
///
/// Does my viewing graph determine the cameras?              verify GRAPH
/// What do the matches of my photographs determine?          verify overview DATABASE
/// Does this certificate prove what it claims?               verify check CERTIFICATE [GRAPH]
#[derive(Parser)]
#[command(name = "verify", version, args_conflicts_with_subcommands = true)]
#[command(subcommand_negates_reqs = true, disable_help_subcommand = true)]
#[command(verbatim_doc_comment, after_help = after_help(), after_long_help = after_long_help())]
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
    "  models      Decide every camera model side by side, and say what changes between them",
    "  audit       Hold floating point, or claims of others, against the exact verdict",
    "  label       Name a small graph: a label that is the same for all its relabellings, and stays",
    "  catalog     Enumerate candidates and decide them all",
];

/// The end of the help.
fn after_help() -> String {
    format!(
        "Commands of the literature:\n{}\n\nHow files are read: `verify help input`. What else can be \
         known: `verify help given`.",
        LITERATURE.join("\n")
    )
}

/// The same with the exit codes.
fn after_long_help() -> String {
    after_help()
        + "\n\n\
Exit codes: 0 all graphs are solvable or finite solvable (check: verified; audit: all agree; overview:
all images with a pair are determined; models: solvable in every model; split: the model is one part
with all images; merge and lists: what is shared fixes everything; contradictions: there are none), 1 some are not (check: rejected;
audit: a disagreement, a refuted claim), 2 bad usage or input, 3 too large for the method or for the
limits of time and memory, 130 interrupted (Ctrl-C), 141 nobody reads the output, 143
terminated. Of several graphs the largest code counts."
}

#[derive(Subcommand)]
enum Command {
    /// Say on one screen what the pairs and tracks of a database determine, and what follows.
    Overview(overview::OverviewArguments),
    /// Say what to do about an answer: what it hangs on, what to match, what an image needs.
    Advise(advise::AdviseArguments),
    /// Follow a database while COLMAP matches, and say what joins.
    Watch(watch::WatchArguments),
    /// Prove that not all motions of pairs can be right, and say which pairs to look at.
    Contradictions(contradictions::ContradictionsArguments),
    /// Write the components to a folder, as COLMAP takes them.
    Export(export::ExportArguments),
    /// Take a COLMAP model apart where its tracks do not hold it together.
    Split(split::SplitArguments),
    /// Say whether what two COLMAP models share fixes the one against the other.
    Merge(merge::MergeArguments),
    /// Say whether lists of images are whole, and whether their overlaps fix scales.
    Lists(lists::ListArguments),
    /// Draw a graph with its components: a page, a picture.
    Draw(draw::DrawArguments),
    /// Write two sets of cameras that have the same fundamental matrices.
    Witness(witness::WitnessArguments),
    /// Verify a certificate with the independent checker.
    Check(check::CheckArguments),
    /// Write what both checkers read: a graph as pairs of node numbers or as graph6, or what is given
    /// besides.
    Convert(convert::ConvertArguments),
    /// Name a small graph: a label that is the same for all its relabellings, and stays.
    #[command(hide = true)]
    Label(label::LabelArguments),
    /// Enumerate candidates and decide them all.
    #[command(hide = true)]
    Catalog(catalog::Arguments),
    /// Hold floating point, or claims of others, against the exact verdict.
    #[command(hide = true)]
    Audit(audit::AuditArguments),
    /// Decide every camera model side by side, and say what changes between them.
    #[command(hide = true)]
    Models(models::ModelsArguments),
    /// Explain a command, how files are read (input), or what else can be known (given).
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

fn run(session: &Session, arguments: &CommandLine) -> Result<u8> {
    match &arguments.command {
        Some(Command::Overview(arguments)) => overview::run(session, arguments),
        Some(Command::Advise(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Watch(arguments)) => watch::run(session, arguments),
        Some(Command::Export(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Split(arguments)) => split::run(session, arguments),
        Some(Command::Contradictions(arguments)) => contradictions::run(session, arguments),
        Some(Command::Merge(arguments)) => merge::run(session, arguments),
        Some(Command::Lists(arguments)) => lists::run(session, arguments),
        Some(Command::Draw(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Witness(arguments)) => decisions::run(session, &arguments.plan()?),
        Some(Command::Help(arguments)) => help::run(CommandLine::command(), arguments),
        Some(Command::Check(arguments)) => check::run(arguments),
        Some(Command::Convert(arguments)) => convert::run(session, arguments),
        Some(Command::Label(arguments)) => label::run(session, arguments),
        Some(Command::Catalog(arguments)) => catalog::run(session, arguments),
        Some(Command::Audit(arguments)) => audit::run(session, arguments),
        Some(Command::Models(arguments)) => models::run(session, arguments),
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
