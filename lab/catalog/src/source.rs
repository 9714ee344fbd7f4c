//! Where candidates come from.

use crate::shard::Shard;
use crate::{Candidates, SizeError, least_edges, minimal};
use anyhow::{Error, Result, ensure};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use viewcert::decide::{Options, Strength, Value, Verdict, VerdictError, decide};
use viewcert::graph::Graph;
use viewcert_catalog::mine::Entry;
use viewcert_formats::{Format, ReadOptions, read_graphs};
use viewcert_session::Outputs;

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

    /// What the source is, for files.
    pub(crate) fn described(&self) -> Described {
        match self {
            Self::Size {
                candidates,
                necessary,
            } => {
                let (nodes, edges) = candidates.size();
                Described::Size {
                    nodes,
                    edges,
                    necessary: *necessary,
                }
            }
            &Self::Minimal { nodes } => Described::Minimal { nodes },
            Self::File { path } => Described::File {
                path: path.display().to_string(),
            },
        }
    }

    /// What the source is called, in tables.
    pub fn name(&self) -> String {
        self.described().name()
    }

    /// Keeps what is the same for all shards in their folder; see [`Candidates::keep_kernels`].
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn keep(
        &self,
        outputs: &Outputs,
        folder: &Path,
        counted: bool,
        note: &mut dyn FnMut(String),
    ) -> Result<()> {
        match self {
            Self::Size { candidates, .. } => {
                candidates.keep_kernels(outputs, folder, counted, note)
            }
            Self::Minimal { .. } | Self::File { .. } => Ok(()),
        }
    }

    /// Reads the kernels from the file in a folder of shards, if there is one.
    ///
    /// # Errors
    /// A file that was changed or cut off.
    pub(crate) fn find(&self, folder: &Path, counted: bool) -> Result<()> {
        match self {
            Self::Size { candidates, .. } => candidates.find_kernels(folder, counted),
            Self::Minimal { .. } | Self::File { .. } => Ok(()),
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
    ///
    /// # Errors
    /// Those of [`Candidates::for_each_of`].
    pub fn for_each(&self, each: &mut dyn FnMut(Result<Graph>) -> bool) -> Result<()> {
        self.for_each_of(Shard::default(), each)
    }

    /// Calls `each` for the candidates of a shard and for all malformed ones, until it returns false.
    ///
    /// # Errors
    /// Those of [`Candidates::for_each_of`].
    pub fn for_each_of(
        &self,
        shard: Shard,
        each: &mut dyn FnMut(Result<Graph>) -> bool,
    ) -> Result<()> {
        let mut index = 0;
        let mut own = |graph: Result<Graph>| {
            if graph.is_err() {
                return each(graph);
            }
            index += 1;
            !shard.owns(index - 1) || each(graph)
        };
        match self {
            Self::Size { candidates, .. } => {
                return candidates.for_each_of(shard, &mut |graph| each(Ok(graph)));
            }
            Self::Minimal { nodes } => {
                minimal::for_each_candidate(*nodes, &mut |graph| own(Ok(graph)));
            }
            Self::File { path } => {
                let options = ReadOptions {
                    format: Some(Format::Graph6),
                    ..ReadOptions::default()
                };
                for input in read_graphs(path, &options) {
                    if !own(input.map(|input| input.graph).map_err(Error::from)) {
                        break;
                    }
                }
            }
        }
        Ok(())
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

    /// The entries of candidates, in their order, decided in parallel, with a certificate each as
    /// one line where `certified` says so.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn decide_all(
        &self,
        graphs: &[Graph],
        options: &Options,
        certified: Certified,
    ) -> Result<Vec<Decided>, VerdictError> {
        let decide = |graph: &Graph| {
            let decided = self.decide(graph, options)?;
            Ok(decided.map(|(entry, verdict)| {
                let certificate = certified.holds(&entry).then(|| {
                    let certificate = verdict.certificate(graph).named(&entry.graph6);
                    certificate.compact().to_string().into_bytes()
                });
                (entry, certificate)
            }))
        };
        let entries: Vec<Option<Decided>> = graphs
            .par_iter()
            .map(decide)
            .collect::<Result<_, VerdictError>>()?;
        Ok(entries.into_iter().flatten().collect())
    }
}

/// The entries of graphs, as [`Source::decide_all`] decides those of a file.
///
/// # Errors
/// Those of [`decide`].
pub(crate) fn decide_all(
    graphs: &[Graph],
    options: &Options,
) -> Result<Vec<Decided>, VerdictError> {
    let path = PathBuf::from("-");
    Source::File { path }.decide_all(graphs, options, Certified::None)
}

/// An entry, and its certificate if that was asked for.
pub type Decided = (Entry, Option<Vec<u8>>);

/// Which entries have a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certified {
    /// None.
    None,
    /// Those of finite-solvable graphs and of unproved verdicts.
    Notable,
    /// All.
    All,
}

impl Certified {
    fn holds(self, entry: &Entry) -> bool {
        self == Self::All || self == Self::Notable && is_notable(entry)
    }
}

/// Whether the graph is finite solvable, or the answer is not proved.
pub(crate) fn is_notable(entry: &Entry) -> bool {
    entry.value != Value::NotFiniteSolvable || entry.strength != Strength::Proof
}

/// What a source is, in the files of its shards.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "lowercase")]
pub(crate) enum Described {
    /// [`Source::Size`].
    Size {
        /// How many nodes.
        nodes: usize,
        /// How many edges.
        edges: usize,
        /// Whether those with adjacent nodes of degree 2 are left out.
        necessary: bool,
    },
    /// [`Source::Minimal`].
    Minimal {
        /// How many nodes.
        nodes: usize,
    },
    /// [`Source::File`].
    File {
        /// Where it is.
        path: String,
    },
}

impl Described {
    /// In words.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Size {
                nodes,
                edges,
                necessary,
            } => {
                let which = if *necessary {
                    "necessary"
                } else {
                    "biconnected"
                };
                format!("{nodes} nodes, {edges} edges, {which}")
            }
            Self::Minimal { nodes } => format!("{nodes} nodes, minimal"),
            Self::File { path } if path == "-" => "standard input".into(),
            Self::File { path } => path.clone(),
        }
    }

    /// The source itself.
    ///
    /// # Errors
    /// A size without candidates; standard input, which is gone.
    pub(crate) fn source(&self) -> Result<Source> {
        match self {
            &Self::Size {
                nodes,
                edges,
                necessary,
            } => Ok(Source::size(nodes, Some(edges), necessary)?),
            &Self::Minimal { nodes } => Source::minimal(nodes),
            Self::File { path } => {
                ensure!(
                    path != "-",
                    "candidates of standard input cannot be read again"
                );
                Ok(Source::File { path: path.into() })
            }
        }
    }
}
