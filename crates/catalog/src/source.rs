//! Where candidates come from.

use crate::mine::Entry;
use crate::{Candidates, SizeError, least_edges, minimal};
use anyhow::{Error, Result, ensure};
use rayon::prelude::*;
use std::path::PathBuf;
use viewcert::decide::{Options, Verdict, VerdictError, decide};
use viewcert::graph::Graph;
use viewcert_formats::{Format, ReadOptions, read_graphs};

/// A source of candidates, always in the same order.
pub enum Source {
    /// Biconnected graphs of a size; with `necessary` those without adjacent nodes of degree 2.
    Size {
        /// What makes them.
        candidates: Candidates,
        /// Whether those with adjacent nodes of degree 2 are left out.
        necessary: bool,
    },
    /// Graphs with so many nodes that are finite solvable and not so without any one edge.
    Minimal {
        /// How many nodes, 3 to 12.
        nodes: usize,
    },
    /// A file of graph6; `-` is standard input.
    File {
        /// Where it is.
        path: PathBuf,
    },
}

impl Source {
    /// The biconnected graphs of a size, by default with the least number of edges that can do; with
    /// `necessary` those without adjacent nodes of degree 2, which are not finite solvable.
    ///
    /// # Errors
    /// A size without candidates.
    pub fn size(nodes: usize, edges: Option<usize>, necessary: bool) -> Result<Self, SizeError> {
        let least = if nodes < 2 { 0 } else { least_edges(nodes) };
        Ok(Self::Size {
            candidates: Candidates::new(nodes, edges.unwrap_or(least), necessary)?,
            necessary,
        })
    }

    /// The graphs with so many nodes that are finite solvable and not so without any one edge.
    ///
    /// # Errors
    /// Fewer than 3 nodes, or more than 12.
    pub fn minimal(nodes: usize) -> Result<Self> {
        ensure!(
            (3..=12).contains(&nodes),
            "minimal graphs have 3 to 12 nodes here, not {nodes}"
        );
        Ok(Self::Minimal { nodes })
    }

    /// What the source is called, in tables and in the description of a run.
    pub fn name(&self) -> String {
        match self {
            Self::Size {
                candidates,
                necessary,
            } => {
                let (nodes, edges) = candidates.size();
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
    pub fn total(&self) -> Option<u64> {
        match self {
            Self::Size { candidates, .. } => candidates.count(),
            Self::Minimal { .. } | Self::File { .. } => None,
        }
    }

    /// Calls `each` for every candidate or malformed one, of which only files have any, until it
    /// returns false.
    pub fn for_each(&self, each: &mut dyn FnMut(Result<Graph>) -> bool) {
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
    }

    /// The entry of a candidate, and its verdict; `None` if minimal graphs are asked for and it is
    /// none.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn decide(
        &self,
        graph: &Graph,
        options: &Options,
    ) -> Result<Option<(Entry, Verdict)>, VerdictError> {
        let Self::Minimal { .. } = self else {
            let verdict = decide(graph, options)?;
            return Ok(Some((Entry::new(graph, &verdict), verdict)));
        };
        let minimal = minimal::decide_minimal(graph, options)?;
        Ok(minimal.map(|(verdict, strength)| {
            // The claim is the minimality.
            let entry = Entry {
                strength,
                ..Entry::new(graph, &verdict)
            };
            (entry, verdict)
        }))
    }

    /// The entries of candidates, in their order, decided in parallel.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn decide_all(
        &self,
        graphs: &[Graph],
        options: &Options,
    ) -> Result<Vec<Entry>, VerdictError> {
        let decide = |graph| Ok(self.decide(graph, options)?.map(|(entry, _)| entry));
        let entries: Vec<Option<Entry>> = graphs
            .par_iter()
            .map(decide)
            .collect::<Result<_, VerdictError>>()?;
        Ok(entries.into_iter().flatten().collect())
    }
}
