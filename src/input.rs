//! How graphs are read: the options that all commands with graphs share.

use super::{GOOD, ends_run, exit_code, running};
use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::time::Instant;
use viewcert_formats::{Format, NamedGraph, ReadOptions, read_graphs};

/// What the graphs' files are, for those that do not show it.
#[derive(Args)]
pub(super) struct InputArguments {
    /// Format of the graphs [default: what they can only be, by their content].
    ///
    /// An edge list has 2, 3, 9 or 14 fields on every line, separated by blanks, tabs or a
    /// comma: two labels and numbers, which are ignored (weights, relative poses). Names with
    /// blanks stand in quotes; # and % begin comments; a head like source,target is recognised.
    /// What could be something else (a line of counts, a matrix, an adjacency list, files of other
    /// programs) is refused, by name where it has one. `--format edges` reads the first two fields
    /// of every line all the same. What is ignored, merged or guessed is printed as a note.
    #[arg(long, value_enum)]
    format: Option<FormatName>,
    /// Variable of a MATLAB file [default: A, or the only square matrix].
    #[arg(long, value_name = "NAME")]
    variable: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum FormatName {
    /// One pair a line: the first two fields, whatever follows; one field alone is a camera.
    #[value(alias = "edge-list")]
    Edges,
    /// One graph a line.
    Graph6,
    /// One graph a line, incremental ones among them.
    Sparse6,
    /// Adjacency matrix, MATLAB 5.
    Matlab,
    /// Adjacency matrix, MatrixMarket coordinates.
    MatrixMarket,
}

impl InputArguments {
    /// Calls `each` for every graph of the files in turn, with the time at which reading it began, and
    /// flushes after it; a bad graph, or one with which `each` fails, is reported and does not stop the others. Returns the worst exit code.
    ///
    /// Where `too_many` gives a reason, an input with a second graph is refused before `each` has seen
    /// the first.
    ///
    /// # Errors
    /// If the output is gone: nobody reads on, and the rest would be work for nothing. If a limit
    /// or a signal has ended the run.
    pub(super) fn for_each<W: Write>(
        &self,
        paths: &[String],
        too_many: &dyn Fn(&str) -> Option<String>,
        out: &mut W,
        mut each: impl FnMut(&mut W, &NamedGraph, Instant) -> Result<u8>,
    ) -> Result<u8> {
        let mut code = GOOD;
        let options = self.read_options();
        for path in paths {
            let mut start = Instant::now();
            running::reading(path);
            let mut graphs = read_graphs(path, &options).peekable();
            while let Some(input) = graphs.next() {
                if let Some(reason) = too_many(&format!("several in {path}"))
                    && graphs.peek().is_some()
                {
                    bail!(reason);
                }
                running::hide();
                if let Ok(input) = &input {
                    running::doing(format!("working on {}", input.name));
                }
                let done = input.map_err(Into::into);
                let done = done.and_then(|input| each(out, &input, start));
                code = code.max(match done {
                    Ok(code) => code,
                    Err(error) if ends_run(&error) => return Err(error),
                    Err(error) => {
                        writeln!(std::io::stderr(), "verify: {error:#}")?;
                        exit_code(&error)
                    }
                });
                out.flush().context("standard output")?;
                running::reading(path);
                start = Instant::now();
            }
        }
        Ok(code)
    }

    /// The options of the readers.
    pub(super) fn read_options(&self) -> ReadOptions {
        ReadOptions {
            format: self.format.map(|format| match format {
                FormatName::Edges => Format::Edges,
                FormatName::Graph6 => Format::Graph6,
                FormatName::Sparse6 => Format::Sparse6,
                FormatName::Matlab => Format::Matlab,
                FormatName::MatrixMarket => Format::MatrixMarket,
            }),
            variable: self.variable.clone(),
        }
    }
}
