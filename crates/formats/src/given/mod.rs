//! Files of what is given besides the pairs: known parts, and known displacements and positions.
//!
//! In: a text, and the graph whose cameras it names. Out: [`Given`], with notes about what counts once
//! or says nothing. Each line begins with the word that says what it is: `part`, `displacement` or
//! `position` (docs/input.md); fields, quotes and comments are those of edge lists.

mod displacements;
mod parts;

use std::io::Read;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::{for_each_line, read_file};
use crate::edge_list::fields::split;
use crate::error::{Fault, Place, Problem, ReadError};
use viewcert::Known;

pub use parts::NamedParts;

/// What a file gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Given {
    /// Parts or displacements.
    pub known: Known,
    /// What was merged or left out in reading them.
    pub notes: Vec<String>,
}

/// Reads what is given besides the pairs of a graph from a file (`-` is standard input). Notes begin
/// with its name. O(n + k log k) for k fields, and for parts inside of others what it takes to compare
/// them.
///
/// # Errors
/// With file and line: what the grammar excludes, a label that the graph does not have, parts beside
/// displacements, vectors on some lines only or that contradict each other; a file that cannot be read
/// or gives nothing.
pub fn read_given(path: impl AsRef<Path>, input: &NamedGraph) -> Result<Given, ReadError> {
    let read = |text: &mut dyn Read| read(text, input);
    read_file(path.as_ref(), read, |given| &mut given.notes)
}

/// Reads what is given besides the pairs of a graph; see [`read_given`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<Given, Fault> {
    let mut parts = parts::Lines::default();
    let mut displacements = displacements::Lines::default();
    let mut fields = Vec::new();
    for_each_line(input, graph, |number, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, fields)) = fields.split_first() else {
            return Ok(());
        };
        match &*word.text(line) {
            PART => parts.take(number, line, fields, cameras)?,
            DISPLACEMENT => displacements.take_pair(number, line, fields, cameras)?,
            POSITION => displacements.take_position(number, line, fields, cameras)?,
            other => return Err(Problem::NothingGiven(other.to_owned())),
        }
        match (parts.is_empty(), displacements.is_empty()) {
            (false, false) => Err(Problem::PartsAndDisplacements),
            _ => Ok(()),
        }
    })?;
    match (parts.is_empty(), displacements.is_empty()) {
        (true, true) => Err(Place::Input.fault(Problem::Empty)),
        (true, false) => displacements.finish(graph),
        (false, _) => {
            let nodes = graph.graph.nodes() as u32;
            let NamedParts { parts, notes } =
                parts.finish(nodes, true).expect("nodes of the graph");
            Ok(Given {
                known: Known::Parts(parts),
                notes,
            })
        }
    }
}

/// The first word of a line with a known part: the cameras of it follow.
const PART: &str = "part";
/// The first word of a line with a known displacement: two cameras follow, and perhaps the vector
/// from the first to the second.
const DISPLACEMENT: &str = "displacement";
/// The first word of a line with a known position: a camera follows, and perhaps where it is.
const POSITION: &str = "position";

#[cfg(test)]
mod tests;
