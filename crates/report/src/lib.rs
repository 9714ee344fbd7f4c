//! Internal to viewcert, and may change at any time.
//!
//! Reports: text for people, JSON for programs, tables and pictures.

pub mod advice;
pub mod assumptions;
pub mod at_cameras;
pub mod audit;
mod bottlenecks;
mod condition;
pub mod contradictions;
pub mod database;
pub mod growth;
pub mod intrinsics;
pub mod json;
pub mod label;
pub mod lists;
pub mod many;
mod mappers;
pub mod merge;
pub mod models;
pub mod next;
pub mod overview;
pub mod overview_page;
pub mod own_frame;
mod page;
mod part_names;
pub mod scene;
pub mod screen;
mod shown;
pub mod split;
pub mod table;
pub mod text;
pub mod tracks;
pub mod witness_file;

use assumptions::Scope;
use scene::Scene;
use std::fmt;
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;
use viewcert::decide::Verdict;
use viewcert::graph::Graph;
use viewcert::proof::Proof;
use viewcert_advice::Advice;
use viewcert_formats::NamedGraph;

pub use shown::head;
pub use viewcert::wording::counted;

/// A graph's size: "5 cameras, 1 pair".
pub fn size(graph: &Graph) -> String {
    let (cameras, pairs) = (graph.nodes(), graph.edges().len());
    format!("{}, {}", counted(cameras, "camera"), counted(pairs, "pair"))
}

/// The same of a graph as it was read, with points and observations if it has them.
pub fn size_of(input: &NamedGraph) -> String {
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
pub fn size_with_parts(input: &NamedGraph, verdict: &Verdict) -> String {
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
    pub advice: &'a Advice,
    /// What the answer holds for, beyond generic cameras of the model.
    pub scope: &'a Scope,
    /// The explicit proof that was written.
    pub proof: Option<&'a WrittenProof>,
    /// What holds at cameras that are given.
    pub here: Option<at_cameras::HereReport<'a>>,
}

/// An explicit proof that was written to a file, and what it shows.
#[derive(Debug, serde::Serialize)]
pub struct WrittenProof {
    file: String,
    rank_at_least: usize,
    rank_at_most: usize,
    /// Whether it shows that the cameras are unique.
    solvable: bool,
    /// How many components there are; left out if that is not shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    components: Option<usize>,
}

impl WrittenProof {
    /// A proof in this file.
    pub fn new(file: &Path, proof: &Proof) -> Self {
        Self {
            file: file.display().to_string(),
            rank_at_least: proof.lower(),
            rank_at_most: proof.upper(),
            solvable: proof.is_solvable(),
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
        if self.solvable {
            f.write_str("; solvable")?;
        }
        f.write_str(")")
    }
}

impl Report<'_> {
    /// The line of `verify --json`, with its line feed.
    ///
    /// # Errors
    /// None that a graph can cause.
    pub fn json(&self) -> io::Result<Vec<u8>> {
        let mut out = Vec::new();
        json::write(&mut out, self)?;
        Ok(out)
    }

    /// The report for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        text::write(out, self)?;
        advice::write(out, self.advice)
    }

    /// The page that needs nothing but itself.
    ///
    /// # Errors
    /// As of [`json`](Self::json).
    pub fn page(&self) -> io::Result<Vec<u8>> {
        let mut out = Vec::new();
        page::write(&mut out, self, &Scene::of(self, &[], &[]), None)?;
        Ok(out)
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
