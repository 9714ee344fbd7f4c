//! Files of known displacements: pairs of cameras whose vector is known, and cameras whose position
//! is.
//!
//! In: a text, and the graph whose cameras it names. Out: the groups ([`Displacements`]), with
//! notes on what counts once or says nothing. The grammar is that of docs/input.md: fields as
//! in edge lists, two labels per line or one, and no head (docs/models.md).

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::{Cameras, for_each_line, read_file};
use crate::edge_list::fields::{Field, split};
use crate::error::{Fault, Place, Problem, ReadError};
use viewcert::graph::{Displacements, Graph};
use viewcert::wording::counted;

/// Displacements as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedDisplacements {
    /// The groups.
    pub known: Displacements,
    /// What was merged or left out in reading them.
    pub notes: Vec<String>,
}

/// Reads the known displacements of a graph from a file (`-` is standard input). Notes begin with
/// its name. O(n + k log k) for k lines.
///
/// # Errors
/// With file and line: what the grammar excludes, a label that the graph does not have, more than
/// two labels; a file that cannot be read or holds no displacement.
pub fn read_displacements(
    path: impl AsRef<Path>,
    input: &NamedGraph,
) -> Result<NamedDisplacements, ReadError> {
    let read = |text: &mut dyn Read| read(text, input);
    read_file(path.as_ref(), read, |found| &mut found.notes)
}

/// Reads the known displacements of a graph; see [`read_displacements`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<NamedDisplacements, Fault> {
    let mut lines = Lines::default();
    for_each_line(input, graph, |_, line, cameras| lines.take(line, cameras))?;
    lines.finish(&graph.graph)
}

/// The lines so far.
#[derive(Default)]
struct Lines {
    /// Pairs, the smaller node first.
    pairs: BTreeSet<(u32, u32)>,
    /// Cameras with a known position.
    positions: BTreeSet<u32>,
    again: usize,
    with_itself: usize,
    fields: Vec<Field>,
}

impl Lines {
    fn take(&mut self, line: &str, cameras: &Cameras) -> Result<(), Problem> {
        split(line, &mut self.fields)?;
        let mut nodes = Vec::with_capacity(2);
        for field in &self.fields {
            let label = field.text(line);
            let node = cameras.node(&label);
            nodes.push(node.ok_or_else(|| Problem::UnknownCamera(label.into_owned()))?);
        }
        let new = match nodes[..] {
            [] => true,
            [v] => self.positions.insert(v),
            [v, w] if v == w => {
                self.with_itself += 1;
                true
            }
            [v, w] => self.pairs.insert((v.min(w), v.max(w))),
            _ => {
                let found = self.fields.len();
                return Err(Problem::NoPairOrCamera { found });
            }
        };
        self.again += usize::from(!new);
        Ok(())
    }

    fn finish(self, graph: &Graph) -> Result<NamedDisplacements, Fault> {
        // Positions are known in one frame: each is a displacement from the first.
        let first = self.positions.first().copied();
        let star = first.into_iter().flat_map(|first| {
            let others = self.positions.iter().skip(1);
            others.map(move |&v| (first, v))
        });
        let pairs = self.pairs.iter().copied().chain(star);
        let nodes = graph.nodes() as u32;
        let known = Displacements::new(nodes, pairs).expect("pairs of the graph's nodes");
        if known.is_empty() {
            return Err(Place::Input.fault(Problem::NoDisplacements));
        }
        let is_other = |&&(v, w): &&(u32, u32)| graph.edge_number(v, w).is_none();
        let others = self.pairs.iter().filter(is_other).count();
        let mut notes = Vec::new();
        let mut note = |count: usize, what: &str, one: &str, more: &str| {
            let how = if count == 1 { one } else { more };
            if count > 0 {
                notes.push(format!("{} {how}", counted(count, what)));
            }
        };
        note(
            self.again,
            "line",
            "says again what another one says, and counts once",
            "say again what others say, and count once",
        );
        note(
            self.with_itself,
            "pair",
            "is one of a camera with itself, which says nothing",
            "are of cameras with themselves, which says nothing",
        );
        note(
            usize::from(self.positions.len() == 1),
            "position",
            "is known, which says nothing about a single camera",
            "",
        );
        note(
            others,
            "known displacement",
            "is of no pair of the graph: its direction is known with it",
            "are of no pairs of the graph: their directions are known with them",
        );
        Ok(NamedDisplacements { known, notes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::graph::Labels;

    /// A path of five cameras.
    fn path(labels: Labels) -> NamedGraph {
        let graph = Graph::new(5, [(0, 1), (1, 2), (2, 3), (3, 4)]).unwrap();
        NamedGraph::new("path", graph, labels)
    }

    fn names() -> NamedGraph {
        let names = ["a", "b c", "d", "e", "f"];
        path(Labels::Names(names.map(Into::into).into()))
    }

    type Known = (Vec<Vec<u32>>, Vec<String>);

    fn known(text: &str, graph: &NamedGraph) -> Result<Known, String> {
        let found = read(text.as_bytes(), graph);
        let found = found.map_err(|fault| fault.in_file("known.txt").to_string())?;
        Ok((found.known.groups().to_vec(), found.notes))
    }

    #[test]
    fn pairs_and_positions() {
        let text = "\u{feff}# rigs\n\"b c\",a % left, right\r\n\n  d\te\ne f";
        let expected = (vec![vec![0, 1], vec![2, 3, 4]], vec![]);
        assert_eq!(known(text, &names()).unwrap(), expected);
        // Positions hang together, and with a pair at one of them.
        let numbers = path(Labels::Numbers { first: 7 });
        let expected = (vec![vec![0, 1, 2, 4]], vec![]);
        assert_eq!(known("7\n11\n9\n8 9", &numbers).unwrap(), expected);
        let integers = path(Labels::Integers(vec![1, 5, 8, 30, 400]));
        let expected = (vec![vec![3, 4]], vec![]);
        assert_eq!(known("400 30", &integers).unwrap(), expected);
    }

    #[test]
    fn what_counts_once_or_says_nothing_is_said() {
        let text = "1 0\n0 1\n1 0\n3 3\n4\n0 2\n1 3\n";
        let (groups, notes) = known(text, &path(Labels::Numbers { first: 0 })).unwrap();
        assert_eq!(groups, [vec![0, 1, 2, 3]]);
        assert_eq!(
            notes,
            [
                "2 lines say again what others say, and count once",
                "1 pair is one of a camera with itself, which says nothing",
                "1 position is known, which says nothing about a single camera",
                "2 known displacements are of no pairs of the graph: their directions are known \
                 with them",
            ]
        );
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, expected) in [
            ("", "known.txt: the file holds no displacement; "),
            (
                "d\n# no second one\nd\n",
                "known.txt: the file holds no displacement; ",
            ),
            ("a d\nd x\n", "known.txt:2: `x` is no camera of the graph; "),
            ("a d\na d e", "known.txt:2: the line has 3 fields; "),
            ("a,,d", "known.txt:1: there is an empty field; "),
            (
                "a \"d",
                "known.txt:1: a quote (\") is not closed on its line; ",
            ),
            ("a d\n\na\u{1}d\n", "known.txt:3: this is no plain text"),
        ] {
            let error = known(text, &names()).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
        let numbers = path(Labels::Numbers { first: 1 });
        for label in ["0", "6", "-1", "01", "18446744073709551616"] {
            let error = known(&format!("1 {label}"), &numbers).unwrap_err();
            assert!(error.contains("is no camera of the graph"), "{error}");
        }
        assert!(read_displacements("no such file", &numbers).is_err());
    }
}
