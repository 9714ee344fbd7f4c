//! Where candidates come from.

use super::Arguments;
use anyhow::{Error, Result, bail};
use std::path::PathBuf;
use viewcert::graph::Graph;
use viewcert_formats::{Format, ReadOptions, read_graphs};
use viewcert_studies::catalog::{Candidates, least_edges, minimal};

/// A source of candidates, always in the same order.
pub(super) enum Source {
    /// Biconnected graphs of a size.
    Size {
        nodes: usize,
        edges: usize,
        necessary: bool,
        candidates: Candidates,
    },
    /// Graphs that may be minimally finite solvable.
    Minimal { nodes: usize },
    /// A file of graph6.
    File { path: PathBuf },
}

impl Source {
    pub(super) fn new(arguments: &Arguments, nodes: usize) -> Result<Self> {
        if let Some(path) = &arguments.from {
            return Ok(Self::File { path: path.clone() });
        }
        if arguments.minimal {
            if !(3..=12).contains(&nodes) {
                bail!("--minimal takes 3 to 12 nodes, not {nodes}");
            }
            return Ok(Self::Minimal { nodes });
        }
        let edges = match arguments.edges {
            Some(edges) => edges,
            None if nodes < 2 => 0,
            None => least_edges(nodes),
        };
        Ok(Self::Size {
            nodes,
            edges,
            necessary: arguments.necessary,
            candidates: Candidates::new(nodes, edges, arguments.necessary)?,
        })
    }

    /// What the source is called, in tables and in the description of a run.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Size {
                nodes,
                edges,
                necessary,
                ..
            } => {
                let which = if *necessary {
                    "necessary"
                } else {
                    "biconnected"
                };
                format!("{nodes} nodes, {edges} edges, {which}")
            }
            Self::Minimal { nodes } => format!("{nodes} nodes, minimal"),
            Self::File { path } if path.as_os_str() == "-" => "standard input".into(),
            Self::File { path } => path.display().to_string(),
        }
    }

    /// How many candidates there are, if that is known beforehand.
    pub(super) fn total(&self) -> Option<u64> {
        match self {
            Self::Size { candidates, .. } => candidates.count(),
            Self::Minimal { .. } | Self::File { .. } => None,
        }
    }

    /// Calls `each` for every candidate or malformed one until it returns false.
    pub(super) fn for_each(&self, each: &mut impl FnMut(Result<Graph>) -> bool) -> Result<()> {
        match self {
            Self::Size { candidates, .. } => candidates.for_each(&mut |graph| each(Ok(graph))),
            Self::Minimal { nodes } => {
                minimal::for_each_candidate(*nodes, &mut |graph| each(Ok(graph)));
            }
            Self::File { path } => {
                let options = ReadOptions {
                    format: Some(Format::Graph6),
                    ..ReadOptions::default()
                };
                for input in read_graphs(path, &options) {
                    if !each(input.map(|input| input.graph).map_err(Error::from)) {
                        break;
                    }
                }
            }
        }
        Ok(())
    }
}
