//! `viewcert-lab completions SHELL` and `viewcert-lab manpage`: what a package of `verify` installs
//! beside it.

use anyhow::{Context, Result};
use clap::Args;
use clap_complete::Shell;
use std::io::Write;
use viewcert_session::exit::GOOD;

/// Options of the completions.
#[derive(Args)]
pub struct CompletionArguments {
    /// For which shell.
    shell: Shell,
}

/// Options of the manual pages.
#[derive(Args)]
pub struct ManpageArguments {
    /// Of which command, as words (`catalog merge`) [default: of the program].
    #[arg(value_name = "COMMAND")]
    command: Vec<String>,
}

/// Prints the completion script of a shell.
pub fn completions(arguments: &CompletionArguments) -> Result<u8> {
    let mut command = viewcert_cli::command();
    let name = command.get_name().to_owned();
    // By way of a buffer: the generator panics where its output fails.
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut script);
    print(&script)
}

/// Prints a manual page in roff.
pub fn manpage(arguments: &ManpageArguments) -> Result<u8> {
    let mut command = viewcert_cli::command();
    command.build();
    let mut of = &command;
    for word in &arguments.command {
        of = of.find_subcommand(word).with_context(|| {
            let known = of.get_subcommands().filter(|known| !known.is_hide_set());
            let known: Vec<&str> = known.map(clap::Command::get_name).collect();
            match known.as_slice() {
                [] => format!("manpage: {} has no commands", of.get_name()),
                known => format!(
                    "manpage: {word} is not a command of {}; its commands are {}",
                    of.get_name(),
                    known.join(", ")
                ),
            }
        })?;
    }
    let mut page = Vec::new();
    clap_mangen::Man::new(of.clone()).render(&mut page)?;
    print(&page)
}

fn print(bytes: &[u8]) -> Result<u8> {
    let mut out = std::io::stdout().lock();
    out.write_all(bytes)
        .and_then(|()| out.flush())
        .context("standard output")?;
    Ok(GOOD)
}
