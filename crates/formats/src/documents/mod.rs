//! Graphs in texts that are read as a whole: g2o, GraphML, raw matches, files of pipelines, and stars if they are
//! asked for.
//!
//! In: a text and which of these it is. Out: the graph with its labels, and notes about what was
//! ignored or merged. Nodes are numbered by their sorted labels, as those of an edge list
//! (docs/input.md), so the same pairs are the same graph in every format.

use std::io::Read;

use crate::edge_list::columns::ListOptions;
use crate::edge_list::{self, BYTE_ORDER_MARK};
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

mod collected;
mod g2o;
pub(crate) use g2o::is_g2o;
mod pipelines;
mod raw_matches;
mod stars;
mod xml;

/// The formats of this folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Document {
    /// Pose graphs of g2o.
    G2o,
    /// Graphs in XML.
    GraphMl,
    /// A node and its neighbours a line: pairs of OpenMVG, adjacency lists.
    Stars,
    /// Pose graphs of Open3D.
    PoseGraph,
    /// MVSNet's `pair.txt`.
    ViewSelection,
    /// Matches of features of COLMAP's importer: a pair of names, and lines of two features.
    RawMatches,
}

/// What there is to a format.
pub(super) struct Facts {
    /// What it is called in reports.
    name: &'static str,
    /// The names on the command line, the first of which is printed, and what it reads; none if its files are always
    /// known.
    pub(super) asked: Option<(&'static [&'static str], &'static str)>,
    /// Whether a text is of it that begins with this, which is all of it if it is `whole`.
    is: fn(&str, bool) -> bool,
    read: fn(&str, &ListOptions) -> Result<Parsed, Fault>,
}

impl Document {
    /// All of them. Where several know a text, the last one has it.
    pub(super) const ALL: [Self; 6] = [
        Self::Stars,
        Self::RawMatches,
        Self::ViewSelection,
        Self::PoseGraph,
        Self::G2o,
        Self::GraphMl,
    ];

    pub(super) const fn facts(self) -> Facts {
        match self {
            Self::G2o => Facts {
                name: "pose graph of g2o",
                asked: Some((&["g2o"], "Pose graph of g2o")),
                is: |text, _| g2o::is_g2o(text),
                read: g2o::read,
            },
            Self::GraphMl => Facts {
                name: "GraphML",
                asked: Some((&["graphml"], "Graph in XML")),
                is: |text, _| xml::is_graphml(text),
                read: xml::read,
            },
            // Lines of neighbours look like sets of cameras, and have to be asked for.
            Self::Stars => Facts {
                name: "adjacency list",
                asked: Some((
                    &["openmvg-pairs", "adjacency-list"],
                    "The first field of every line with each of the others: pairs and stars of OpenMVG, adjacency lists",
                )),
                is: |_, _| false,
                read: stars::read,
            },
            Self::PoseGraph => Facts {
                name: "pose graph of Open3D",
                asked: None,
                is: |text, _| pipelines::is_pose_graph(text),
                read: pipelines::pose_graph,
            },
            Self::ViewSelection => Facts {
                name: "MVSNet's pair.txt",
                asked: None,
                is: |text, _| pipelines::is_view_selection(text),
                read: pipelines::view_selection,
            },
            Self::RawMatches => Facts {
                name: "raw matches of COLMAP",
                asked: Some((
                    &["raw-matches"],
                    "Matches of features as COLMAP imports them: two names, and below them two numbers a line",
                )),
                is: raw_matches::is_raw,
                read: raw_matches::read,
            },
        }
    }

    /// Which of them a text is that begins with `head`, which is all of it if `whole`.
    pub(super) fn of(head: &[u8], whole: bool) -> Option<Self> {
        // What is no UTF-8 is refused by the reader, with the line.
        let text = &*String::from_utf8_lossy(head);
        let mut all = Self::ALL.into_iter();
        all.rfind(|document| (document.facts().is)(text, whole))
    }

    /// Whether weights of its pairs are read.
    pub(super) fn has_weights(self) -> bool {
        self == Self::RawMatches
    }
}

/// Reads a graph. O(bytes + n log n + m log m), in memory a few times the size of the text.
///
/// # Errors
/// With the number of the line where there is one: what is no text, or not of the format; a pair
/// of a node with itself; no nodes.
pub fn read(document: Document, input: impl Read) -> Result<Parsed, Fault> {
    read_with(document, input, &ListOptions::default())
}

/// The same with the options of whoever asks.
pub(super) fn read_with(
    document: Document,
    mut input: impl Read,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes).map_err(Problem::from)?;
    let text = text(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&bytes))?;
    let Facts { name, read, .. } = document.facts();
    let mut parsed = read(text, options)?;
    parsed.read.format = name.into();
    Ok(parsed)
}

/// Bytes as text without control characters but tabs and the ends of lines.
fn text(bytes: &[u8]) -> Result<&str, Fault> {
    for (line, number) in bytes.split(|&byte| byte == b'\n').zip(1..) {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        edge_list::text(line).map_err(|problem| Place::Line(number).fault(problem))?;
    }
    str::from_utf8(bytes).map_err(|_| Problem::not_utf8().into())
}

/// The number of the line in which a byte stands, from 1.
fn line_of(text: &[u8], at: usize) -> u64 {
    let before = &text[..at.min(text.len())];
    1 + before.iter().filter(|&&b| b == b'\n').count() as u64
}

/// What a format does not allow.
fn malformed(format: &'static str, what: impl Into<String>) -> Problem {
    Problem::new(
        format!("{format}: {}", what.into()),
        "mend the file, or write one pair a line: two names and nothing else",
    )
}

#[cfg(test)]
mod tests;
