//! How graphs are read: the options that all commands with graphs share.

use crate::graph::{Format, ReadOptions};
use clap::{Args, ValueEnum};

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
    /// The options of the readers.
    pub(super) fn read_options(&self) -> ReadOptions {
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
