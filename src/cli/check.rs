//! `verify check`: the independent checker on a certificate.

use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// What to check.
#[derive(Args)]
pub(super) struct CheckArguments {
    /// The certificate; `-` is standard input.
    certificate: PathBuf,
    /// The graph it is about; not needed if the certificate embeds it.
    graph: Option<PathBuf>,
}

pub(super) fn run(_: &CheckArguments) -> Result<ExitCode> {
    anyhow::bail!("not yet")
}
