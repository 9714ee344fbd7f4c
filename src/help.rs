//! `verify help [TOPIC]`: a command, or what is common to many of them.

use super::input::InputArguments;
use super::{given, intrinsics};
use anyhow::{Context, Result, bail};
use clap::{Arg, Args, Command};
use std::io::Write;
use viewcert_session::exit::GOOD;

/// What to explain.
#[derive(Args)]
pub(super) struct HelpArguments {
    /// A command, or input, given, intrinsics [default: the program].
    #[arg(value_name = "TOPIC")]
    topic: Vec<String>,
}

/// How graphs are read, before the options.
const INPUT: &str = "\
How files are read: the same options for all commands with graphs.

Formats are known by their content, not by their names: lists of pairs and tables with a head that names
two images or nodes (COLMAP, hloc, kapture, GLOMAP, 1DSfM, SNAP, networkx), what --format names below, all of
it also compressed by gzip, and COLMAP's databases; with --tracks also models and other files of tracks.
The first line of every report says how the file was read; docs/input.md has all formats and rules.

A list of pairs has one separator and 2 fields on every line, 3 with a number, or 9 or 14 with a relative
pose; all labels are integers, or none is a number. Everything else is refused, with what was seen.
`--format edges` reads the first two fields of every line all the same.";

/// Prints a page of help.
///
/// # Errors
/// A topic that there is not.
pub(super) fn run(mut program: Command, arguments: &HelpArguments) -> Result<u8> {
    let words: Vec<&str> = arguments.topic.iter().map(String::as_str).collect();
    let text = match words[..] {
        ["input"] => input(),
        ["given"] => given::HELP.to_owned(),
        ["intrinsics"] => intrinsics::HELP.to_owned(),
        _ => {
            program.build();
            command(&program, &words)?
        }
    };
    let mut out = std::io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.context("standard output")?;
    Ok(GOOD)
}

fn command(program: &Command, words: &[&str]) -> Result<String> {
    let mut of = program;
    for word in words {
        let Some(found) = of.find_subcommand(word) else {
            bail!(
                "help: {word} is no command and no topic; the topics are input, given and intrinsics"
            );
        };
        of = found;
    }
    Ok(whole(of))
}

/// All of a command's help, with an option a line: clap's own long form takes three.
pub(super) fn whole(command: &Command) -> String {
    let end = command.get_after_long_help().cloned();
    let command = command.clone().after_help(end.unwrap_or_default());
    let shown = |arg: Arg| match arg.get_id() == "help" {
        true => arg.help("Print help (see a summary with '-h')"),
        false => arg.hide_short_help(false),
    };
    command.mut_args(shown).render_help().to_string()
}

fn input() -> String {
    let options = InputArguments::augment_args(Command::new("input"));
    let options = options
        .disable_help_flag(true)
        .mut_args(|arg| arg.hide(false));
    let page = options.help_template("{before-help}\n\n{options}\n");
    whole(&page.before_help(INPUT))
}
