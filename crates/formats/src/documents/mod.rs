//! Graphs in texts that are read as a whole: DOT, g2o, GML, GraphML, GEXF, node-link JSON, stars, raw
//! matches, matrices as text.
//!
//! In: a text and which of these it is. Out: the graph with its labels, and notes about what was
//! ignored, merged or guessed. Nodes are numbered by their sorted labels, as those of an edge list
//! (docs/input.md), so the same pairs are the same graph in every format.
//!
//! A text that a reader of edge lists may take for one is refused unless its format was asked for:
//! nobody then reads one file as two graphs.

use std::io::Read;

use crate::edge_list::layout::ListOptions;
use crate::edge_list::{self, BYTE_ORDER_MARK};
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

mod collected;
mod dot;
mod g2o;
mod gml;
mod node_link;
mod raw_matches;
mod stars;
mod text_matrix;
mod xml;

pub(crate) use collected::Collected;

/// The formats of this folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Document {
    /// The language of Graphviz.
    Dot,
    /// Pose graphs of g2o.
    G2o,
    /// Graphs of Gephi in XML.
    Gexf,
    /// Lists of keys and values, of networkx, igraph and Gephi.
    Gml,
    /// Graphs in XML.
    GraphMl,
    /// Graphs in JSON as networkx writes them: lists of nodes and of edges (or links).
    NodeLink,
    /// A node and its neighbours a line: pairs of OpenMVG, adjacency lists of networkx.
    Stars,
    /// Matches of features of COLMAP's importer: a pair of names, and lines of two features.
    RawMatches,
    /// A matrix as text: counts of matches, zeros and ones.
    TextMatrix,
}

impl Document {
    /// Which of them a text is that begins with `head`, which is all of it if `whole`.
    pub(super) fn of(head: &[u8], whole: bool) -> Option<Self> {
        // What is no UTF-8 is refused by the reader, with the line.
        let text = &*String::from_utf8_lossy(head);
        [
            (Self::GraphMl, xml::is_graphml(text)),
            (Self::Gexf, xml::is_gexf(text)),
            (Self::NodeLink, node_link::is_object(text)),
            (Self::Dot, dot::is_dot(text)),
            (Self::Gml, gml::is_gml(text)),
            (Self::G2o, g2o::is_g2o(text)),
            (Self::RawMatches, raw_matches::is_raw(text, whole)),
            (Self::TextMatrix, text_matrix::is_matrix(text, whole)),
            (Self::Stars, stars::is_stars(text, whole)),
        ]
        .into_iter()
        .find_map(|(document, is)| is.then_some(document))
    }

    /// Whether weights of its pairs are read.
    pub(super) fn has_weights(self) -> bool {
        matches!(self, Self::RawMatches | Self::TextMatrix)
    }

    /// What it is called in reports.
    fn name(self) -> &'static str {
        match self {
            Self::Dot => "DOT",
            Self::G2o => "pose graph of g2o",
            Self::Gexf => "GEXF",
            Self::Gml => "GML",
            Self::GraphMl => "GraphML",
            Self::NodeLink => "node-link JSON",
            Self::Stars => "adjacency list",
            Self::RawMatches => "raw matches of COLMAP",
            Self::TextMatrix => "matrix as text",
        }
    }

    /// What to say of a text that may be an edge list as well.
    fn doubt(self) -> Option<Problem> {
        let (what, advice) = match self {
            Self::Dot => (
                "it could be an edge list as well as a graph in DOT",
                "say --format dot or --format edges",
            ),
            Self::G2o => (
                "it could be an edge list as well as a pose graph of g2o",
                "say --format g2o or --format edges",
            ),
            // Texts that begin with a bracket are no edge lists, and stars are of uneven lines.
            // The others say themselves what could be one.
            _ => return None,
        };
        Some(Problem::Doubtful { what, advice })
    }
}

/// Reads a graph; `asked` if the user has named the format, and nothing else can be meant.
/// O(bytes + n log n + m log m), in memory a few times the size of the text.
///
/// # Errors
/// With the number of the line where there is one: what is no text, or not of the format; a pair
/// of a node with itself; no nodes. Without `asked`: a text that could be something else.
pub fn read(document: Document, input: impl Read, asked: bool) -> Result<Parsed, Fault> {
    read_with(document, input, asked, &ListOptions::default())
}

/// The same with the options of whoever asks.
pub(super) fn read_with(
    document: Document,
    mut input: impl Read,
    asked: bool,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let mut bytes = Vec::new();
    input
        .read_to_end(&mut bytes)
        .map_err(|error| Place::Input.fault(error.into()))?;
    let text = text(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&bytes))?;
    if let Some(doubt) = document.doubt().filter(|_| !asked)
        && edge_list::may_be(text)
    {
        return Err(Place::Input.fault(doubt));
    }
    let mut parsed = match document {
        Document::Dot => dot::read(text, options),
        Document::G2o => g2o::read(text, options),
        Document::Gexf => xml::read(text, xml::GEXF, options),
        Document::Gml => gml::read(text, options),
        Document::GraphMl => xml::read(text, xml::GRAPHML, options),
        Document::NodeLink => node_link::read(text, options),
        Document::Stars => stars::read(text, asked, options),
        Document::RawMatches => raw_matches::read(text, asked, options),
        Document::TextMatrix => text_matrix::read(text, options),
    }?;
    parsed.read.format = document.name().into();
    Ok(parsed)
}

/// Bytes as text without control characters but tabs and the ends of lines.
fn text(bytes: &[u8]) -> Result<&str, Fault> {
    let odd = bytes.iter().enumerate().find(|&(at, byte)| match byte {
        b'\t' | b'\n' => false,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => byte.is_ascii_control(),
    });
    if let Some((at, byte)) = odd {
        let problem = match byte {
            0 => Problem::Nul,
            b'\r' => Problem::CarriageReturn,
            &byte => Problem::Control(byte),
        };
        return Err(Place::Line(line_of(bytes, at)).fault(problem));
    }
    std::str::from_utf8(bytes)
        .map_err(|error| Place::Line(line_of(bytes, error.valid_up_to())).fault(Problem::NotUtf8))
}

/// The number of the line in which a byte stands, from 1.
fn line_of(text: &[u8], at: usize) -> u64 {
    let before = &text[..at.min(text.len())];
    1 + before.iter().filter(|&&b| b == b'\n').count() as u64
}

/// What a format does not allow.
fn malformed(format: &'static str, what: impl Into<String>) -> Problem {
    Problem::Malformed {
        format,
        what: what.into(),
    }
}

#[cfg(test)]
mod tests;
