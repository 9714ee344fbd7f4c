//! How graphs are read: the options that all commands with graphs share.

use super::{BAD_INPUT, GOOD, atomic, certificates};
use crate::graph::{Format, NamedGraph, ReadOptions, read_graphs};
use anyhow::{Context, Result, anyhow};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// What the graphs' files are, for those that do not show it.
#[derive(Args)]
pub(super) struct InputArguments {
    /// Format of the graphs [default: what they look like].
    #[arg(long, value_enum)]
    format: Option<FormatName>,
    /// Variable of a MATLAB file [default: A, or the only square matrix].
    #[arg(long, value_name = "NAME")]
    variable: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum FormatName {
    /// One pair a line.
    EdgeList,
    /// One graph a line.
    Graph6,
    /// Adjacency matrix, MATLAB 5.
    Matlab,
}

impl InputArguments {
    /// Calls `each` for every graph of the files in turn, with the time at which reading it began, and
    /// flushes after it; a bad graph, or one with which `each` fails, is reported and does not stop the others. Returns the worst exit code.
    ///
    /// If there is a `single` file for what comes out, an input with a second graph is refused before
    /// `each` has seen the first.
    ///
    /// # Errors
    /// If the output is gone: nobody reads on, and the rest would be work for nothing.
    pub(super) fn for_each<W: Write>(
        &self,
        paths: &[String],
        single: Option<&Path>,
        out: &mut W,
        mut each: impl FnMut(&mut W, &NamedGraph, Instant) -> Result<u8>,
    ) -> Result<u8> {
        let mut code = GOOD;
        let options = self.read_options();
        for path in paths {
            let mut start = Instant::now();
            let mut graphs = read_graphs(path, &options).peekable();
            while let Some(input) = graphs.next() {
                if let Some(file) = single.filter(|_| graphs.peek().is_some()) {
                    let several = format!("several in {path}");
                    return Err(anyhow!(certificates::too_many(file, &several)));
                }
                let done = input.map_err(Into::into);
                let done = done.and_then(|input| each(out, &input, start));
                code = code.max(match done {
                    Ok(code) => code,
                    Err(error) if atomic::is_broken_pipe(&error) => return Err(error),
                    Err(error) => {
                        writeln!(std::io::stderr(), "verify: {error:#}")?;
                        BAD_INPUT
                    }
                });
                out.flush().context("standard output")?;
                start = Instant::now();
            }
        }
        Ok(code)
    }

    /// The options of the readers.
    fn read_options(&self) -> ReadOptions {
        ReadOptions {
            format: self.format.map(|format| match format {
                FormatName::EdgeList => Format::EdgeList,
                FormatName::Graph6 => Format::Graph6,
                FormatName::Matlab => Format::Matlab,
            }),
            variable: self.variable.clone(),
        }
    }
}
