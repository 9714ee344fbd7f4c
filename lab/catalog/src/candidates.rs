//! All biconnected graphs with given numbers of nodes and edges.

use super::grow::grow;
use super::kernel::{MAX_CYCLES, kernels};
use super::kernel_file::{self, Counted, KernelFile, Of};
use super::multigraph::{MAX_NODES, Multigraph, Packed};
use super::shard::Shard;
use super::subdivide::{Edges, MOST_NODES, Subdivisions};
use anyhow::{Result, anyhow, ensure};
use rayon::prelude::*;
use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;
use viewcert::geometry::model::Model;
use viewcert::graph::Graph;
use viewcert_session::Outputs;

/// The name of the file of kernels in a folder of shards.
pub(crate) const KERNELS: &str = "kernels";

/// Kernels that are read from a file in one go.
const SLICE: usize = 1024;

/// The least number of edges of a finite-solvable graph with `nodes` >= 2 nodes: an edge
/// has rank 7, so it is ceil((11 n - 15) / 7).
///
/// # Example
/// ```
/// assert_eq!(viewcert_lab_catalog::least_edges(9), 12);
/// ```
pub fn least_edges(nodes: usize) -> usize {
    Model::Projective.required(nodes).div_ceil(7)
}

/// Why there are no candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SizeError {
    /// Fewer than 3 nodes, or more than the generator takes.
    #[error("graphs with {} are not enumerated: ask for 3 to {MOST_NODES} nodes", viewcert::wording::counted(*.nodes, "node"))]
    Nodes {
        /// How many were asked for.
        nodes: usize,
    },
    /// Too many nodes for graphs that are made node by node.
    #[error(
        "graphs with {nodes} nodes are made from kernels alone, with up to {most} edges: ask for \
         these, or for 3 to {MAX_NODES} nodes"
    )]
    NodeByNode {
        /// How many nodes were asked for.
        nodes: usize,
        /// The most edges that kernels have.
        most: usize,
    },
    /// No biconnected simple graph has so few or so many edges.
    #[error(
        "no biconnected graph has {nodes} nodes and {edges} edges: {nodes} nodes take {nodes} to \
         {most} edges"
    )]
    Edges {
        /// How many nodes were asked for.
        nodes: usize,
        /// How many edges.
        edges: usize,
        /// How many edges there can be.
        most: usize,
    },
    /// Fewer than 2 nodes, or more than Laman graphs are grown to.
    #[error(
        "Laman graphs with {} are not enumerated: ask for 2 to {} nodes",
        viewcert::wording::counted(*.nodes, "node"),
        .most
    )]
    Laman {
        /// How many were asked for.
        nodes: usize,
        /// How many there may be.
        most: usize,
    },
}

/// The candidates of a size.
pub struct Candidates {
    nodes: usize,
    edges: usize,
    necessary: bool,
    by_kernels: bool,
    made: OnceLock<Vec<Packed>>,
    file: OnceLock<KernelFile>,
}

impl Candidates {
    /// Prepares the enumeration of the biconnected graphs with `nodes` nodes and `edges`
    /// edges; with `necessary`, of those without adjacent nodes of degree 2 (which are not
    /// finite solvable, except the triangle). With up to 9 independent cycles, m - n + 1 <= 9
    /// (6 with fewer than 10 nodes), the [`kernels`] are found when they are first asked for, and kept; otherwise memory is
    /// negligible and time grows with the number of connected graphs on `nodes - 1` nodes.
    ///
    /// # Errors
    /// If there are none, or the graphs are too large.
    pub fn new(nodes: usize, edges: usize, necessary: bool) -> Result<Self, SizeError> {
        if !(3..=MOST_NODES).contains(&nodes) {
            return Err(SizeError::Nodes { nodes });
        }
        let most = nodes * (nodes - 1) / 2;
        if !(nodes..=most).contains(&edges) {
            return Err(SizeError::Edges { nodes, edges, most });
        }
        let cycles = edges + 1 - nodes;
        // There are many kernels with many cycles, and few graphs with few nodes.
        let most_cycles = if nodes < 10 { 6 } else { MAX_CYCLES };
        let by_kernels = (2..=most_cycles).contains(&cycles);
        if nodes > MAX_NODES && !by_kernels && cycles > 1 {
            let most = nodes + MAX_CYCLES - 1;
            return Err(SizeError::NodeByNode { nodes, most });
        }
        Ok(Self {
            nodes,
            edges,
            necessary,
            by_kernels,
            made: OnceLock::new(),
            file: OnceLock::new(),
        })
    }

    /// The kernels, made if they are not yet.
    fn made(&self) -> &[Packed] {
        self.made
            .get_or_init(|| kernels(self.edges + 1 - self.nodes, self.nodes))
    }

    /// From now on reads the kernels from a file in a folder of shards, which is written if it is not
    /// there: what is made once takes neither the time nor the memory of all who share the folder.
    /// With `counted` it says how many candidates each kernel has. Nothing happens if there are no kernels.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn keep_kernels(
        &self,
        outputs: &Outputs,
        folder: &Path,
        counted: bool,
        note: &mut dyn FnMut(String),
    ) -> Result<()> {
        if !self.by_kernels || self.file.get().is_some() {
            return Ok(());
        }
        let path = folder.join(KERNELS);
        let of = self.kernels_of_this(counted);
        let file = if path.exists() {
            KernelFile::open(&path, &of).map_err(|why| {
                note(format!("{}: {why}; made again", path.display()));
            })
        } else {
            Err(())
        };
        let file = match file {
            Ok(file) => file,
            Err(()) => {
                let count = |kernel: &Packed| if counted { self.count_of(kernel) } else { 0 };
                // They are not kept here: whatever is wanted is read.
                let kernels = kernels(self.edges + 1 - self.nodes, self.nodes);
                let kernels = kernels.into_par_iter();
                let kernels: Vec<Counted> =
                    kernels.map(|kernel| (kernel, count(&kernel))).collect();
                outputs.write(&path, |out| kernel_file::write(out, of.clone(), &kernels))?;
                KernelFile::open(&path, &of).map_err(|why| anyhow!("{}: {why}", path.display()))?
            }
        };
        // Whoever was faster has the same.
        let _ = self.file.set(file);
        Ok(())
    }

    /// As [`Self::keep_kernels`], but only if the file is there.
    ///
    /// # Errors
    /// A file that was changed or cut off.
    pub fn find_kernels(&self, folder: &Path, counted: bool) -> Result<()> {
        let path = folder.join(KERNELS);
        if self.by_kernels && self.file.get().is_none() && path.exists() {
            let file = KernelFile::open(&path, &self.kernels_of_this(counted));
            let again = "run any shard again, which makes it anew";
            let file = file.map_err(|why| anyhow!("{}: {why}; {again}", path.display()))?;
            // Whoever was faster has the same.
            let _ = self.file.set(file);
        }
        Ok(())
    }

    fn kernels_of_this(&self, counted: bool) -> Of {
        Of {
            program: concat!("viewcert ", env!("CARGO_PKG_VERSION")).into(),
            nodes: self.nodes,
            edges: self.edges,
            necessary: self.necessary,
            counted,
        }
    }

    fn count_of(&self, kernel: &Packed) -> u64 {
        let mut count = 0;
        self.subdivisions(&kernel.multigraph()).for_each(&mut |_| {
            count += 1;
            true
        });
        count
    }

    /// How many candidates there are, where counting them takes no longer than a small
    /// part of deciding them.
    pub fn count(&self) -> Option<u64> {
        if !self.by_kernels {
            return None;
        }
        let counted = self.file.get().and_then(KernelFile::candidates);
        Some(
            counted.unwrap_or_else(|| self.made().iter().map(|kernel| self.count_of(kernel)).sum()),
        )
    }

    /// Numbers of nodes and edges.
    pub fn size(&self) -> (usize, usize) {
        (self.nodes, self.edges)
    }

    /// How many kernels the candidates are made from; `None` if they are made node by node.
    pub fn kernels(&self) -> Option<usize> {
        let in_file = || self.file.get().map(KernelFile::len);
        self.by_kernels
            .then(|| in_file().unwrap_or_else(|| self.made().len()))
    }

    /// Some of the [`kernels`](Self::kernels).
    ///
    /// # Errors
    /// If they are read from a file, and cannot be.
    ///
    /// # Panics
    /// If the range goes beyond them, or there are none.
    pub fn some_kernels(&self, range: Range<usize>) -> Result<Cow<'_, [Packed]>> {
        Ok(match self.file.get() {
            Some(file) => {
                let found = file.read(range)?.into_iter();
                found.map(|(kernel, _)| kernel).collect()
            }
            None => Cow::Borrowed(&self.made()[range]),
        })
    }

    /// The candidates of one of the [`kernels`](Self::kernels).
    pub fn subdivisions(&self, kernel: &Multigraph) -> Subdivisions {
        let edges = if self.necessary {
            Edges::Once
        } else {
            Edges::Any
        };
        Subdivisions::new(kernel, self.nodes, edges)
    }

    /// Calls `each` for every candidate, in a fixed order, until it returns false.
    pub fn for_each(&self, each: &mut impl FnMut(Graph) -> bool) {
        match self.by_kernels {
            true => {
                for kernel in self.made() {
                    let subdivisions = self.subdivisions(&kernel.multigraph());
                    if !subdivisions.for_each(&mut |subdivision| each(subdivision.graph())) {
                        return;
                    }
                }
            }
            // The cycle is the one graph with a single independent cycle.
            false if self.edges == self.nodes => {
                if self.nodes == 3 || !self.necessary {
                    let n = self.nodes as u32;
                    let cycle = (0..n).map(|v| (v, (v + 1) % n)).collect();
                    if let Ok((graph, _)) = Graph::from_pairs(n, cycle) {
                        each(graph);
                    }
                }
            }
            false => {
                // Every node to come brings at least one edge.
                let keep =
                    |graph: &Multigraph| graph.edges() + self.nodes - graph.nodes() <= self.edges;
                grow(self.nodes, &keep, &mut |graph| {
                    let wanted = graph.edges() == self.edges
                        && graph.is_biconnected()
                        && !(self.necessary && has_adjacent_nodes_of_degree_2(graph));
                    !wanted || each(to_graph(graph))
                });
            }
        }
    }
}

impl Candidates {
    /// Calls `each` for the candidates of a shard, in the order of [`for_each`](Self::for_each), until it
    /// returns false. Where a file of kernels says how many candidates each has, those of others are
    /// passed over kernel by kernel.
    ///
    /// # Errors
    /// If kernels cannot be read, or have other numbers of candidates than their file says.
    pub fn for_each_of(&self, shard: Shard, each: &mut dyn FnMut(Graph) -> bool) -> Result<()> {
        let counted = self.file.get().filter(|file| file.candidates().is_some());
        let mut index = 0;
        let Some(file) = counted else {
            self.for_each(&mut |graph| {
                index += 1;
                !shard.owns(index - 1) || each(graph)
            });
            return Ok(());
        };
        for start in (0..file.len()).step_by(SLICE) {
            for (kernel, count) in file.read(start..(start + SLICE).min(file.len()))? {
                let next = index + count;
                if shard.owns_any(index..next) {
                    let subdivisions = self.subdivisions(&kernel.multigraph());
                    let more = subdivisions.for_each(&mut |subdivision| {
                        index += 1;
                        !shard.owns(index - 1) || each(subdivision.graph())
                    });
                    if !more {
                        return Ok(());
                    }
                    ensure!(
                        index == next,
                        "{KERNELS}: a kernel has another number of candidates"
                    );
                }
                index = next;
            }
        }
        Ok(())
    }
}

/// Whether two nodes of degree 2 are adjacent.
pub fn has_adjacent_nodes_of_degree_2(graph: &Multigraph) -> bool {
    graph
        .pairs()
        .any(|(u, v, _)| graph.degree(u) == 2 && graph.degree(v) == 2)
}

/// A multigraph without parallel edges as a graph.
///
/// # Panics
/// Never: a multigraph has no loops.
pub fn to_graph(graph: &Multigraph) -> Graph {
    let pairs = graph.pairs().map(|(u, v, _)| (u as u32, v as u32));
    let (graph, _) = Graph::from_pairs(graph.nodes() as u32, pairs.collect()).expect("no loops");
    graph
}

#[cfg(test)]
mod tests;
