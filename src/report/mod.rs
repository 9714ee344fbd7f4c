//! Reports: text for people, JSON for programs, tables and pictures.

pub mod bars;
pub mod catalog_page;
pub mod comparison;
pub mod conditions;
pub mod curves;
pub mod database;
pub mod force_layout;
pub mod graph_picture;
pub mod json;
pub mod layout;
pub mod many;
pub mod models;
pub mod overview;
pub mod page;
pub mod plot;
pub mod read;
pub mod svg;
pub mod table;
pub mod text;
pub mod tracks;
pub mod values;

use crate::act::Acted;
use crate::plane::Scope;
use std::fmt;
use std::path::Path;
use std::time::Duration;
use viewcert::decide::Verdict;
use viewcert::graph::Graph;
use viewcert::proof::Proof;
use viewcert_formats::NamedGraph;

pub use viewcert::wording::counted;

/// A graph's size: "5 cameras, 1 pair".
pub(crate) fn size(graph: &Graph) -> String {
    let (cameras, pairs) = (graph.nodes(), graph.edges().len());
    format!("{}, {}", counted(cameras, "camera"), counted(pairs, "pair"))
}

/// The same of a graph as it was read, with points and observations if it has them.
pub(crate) fn size_of(input: &NamedGraph) -> String {
    let Some(cameras) = input.cameras else {
        return size(&input.graph);
    };
    let points = input.graph.nodes() - cameras as usize;
    format!(
        "{}, {}, {}",
        counted(cameras as usize, "camera"),
        counted(points, "point"),
        counted(input.graph.edges().len(), "observation")
    )
}

/// The same, with the known parts that were taken for given.
pub(crate) fn size_with_parts(input: &NamedGraph, verdict: &Verdict) -> String {
    let size = size_of(input);
    match verdict.known_parts.len() {
        0 => size,
        parts => format!("{size}, {}", counted(parts, "known part")),
    }
}

/// Everything a report says about one graph.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The graph as it was read.
    pub input: &'a NamedGraph,
    /// What was decided.
    pub verdict: &'a Verdict,
    /// Whether the arithmetic was rational.
    pub rational: bool,
    /// Whether to list the members of the components.
    pub list_components: bool,
    /// How long reading, deciding and certifying took.
    pub time: Duration,
    /// What to do about it.
    pub(crate) acted: &'a Acted,
    /// What the answer holds for, beyond generic cameras of the model.
    pub(crate) scope: &'a Scope,
    /// The explicit proof that was written.
    pub(crate) proof: Option<&'a WrittenProof>,
}

/// An explicit proof that was written to a file, and what it shows.
#[derive(Debug, serde::Serialize)]
pub(crate) struct WrittenProof {
    file: String,
    rank_at_least: usize,
    rank_at_most: usize,
    /// How many components there are; left out if that is not shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    components: Option<usize>,
}

impl WrittenProof {
    /// A proof in this file.
    pub(crate) fn new(file: &Path, proof: &Proof) -> Self {
        Self {
            file: file.display().to_string(),
            rank_at_least: proof.lower(),
            rank_at_most: proof.upper(),
            components: proof.components(),
        }
    }
}

impl fmt::Display for WrittenProof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            file,
            rank_at_least,
            rank_at_most,
            ..
        } = self;
        write!(
            f,
            "{file} (rank {rank_at_least} at least, {rank_at_most} at most"
        )?;
        if let Some(components) = self.components {
            write!(f, "; {}", counted(components, "component"))?;
        }
        f.write_str(")")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_not_many() {
        let found = [0, 1, 2].map(|count| counted(count, "body"));
        assert_eq!(found, ["0 bodies", "1 body", "2 bodies"]);
        let (graph, _) = Graph::from_pairs(2, vec![(0, 1)]).unwrap();
        assert_eq!(size(&graph), "2 cameras, 1 pair");
    }
}
