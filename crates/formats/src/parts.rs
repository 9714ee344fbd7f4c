//! Files of known parts: sets of cameras whose relative position is known, one a line.
//!
//! In: a text, and the graph whose cameras it names. Out: the parts in their canonical form
//! ([`KnownParts`]), with notes about what counts once or says nothing. The grammar is that of
//! docs/input.md: fields as in edge lists, all of them labels, and no head.

use std::io::Read;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::{Cameras, for_each_line, read_file};
use crate::edge_list::fields::{Field, split};
use crate::error::{Fault, Place, Problem, ReadError};
use viewcert::graph::{GraphError, KnownParts, Lists};
use viewcert::wording::counted;

/// Known parts as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedParts {
    /// The parts.
    pub parts: KnownParts,
    /// What was merged or left out in reading them.
    pub notes: Vec<String>,
}

impl NamedParts {
    /// Parts that were given as nodes of a graph with so many, with notes as of a file.
    /// O(k log k) for k nodes of parts, and for parts inside of others what it takes to compare them.
    ///
    /// # Errors
    /// A node that is not below `nodes`.
    pub fn of_nodes(
        nodes: u32,
        parts: impl IntoIterator<Item = Vec<u32>>,
    ) -> Result<Self, GraphError> {
        let mut lines = Lines::default();
        for (number, part) in (1..).zip(parts) {
            lines.see(number, part);
        }
        lines.finish(nodes, false)
    }
}

/// Reads the known parts of a graph from a file (`-` is standard input). Notes begin with its name.
/// O(k log k) for k fields, and for parts inside of others what it takes to compare them.
///
/// # Errors
/// With file and line: what the grammar excludes, a label that the graph does not have; a file
/// that cannot be read or holds no part.
pub fn read_parts(path: impl AsRef<Path>, input: &NamedGraph) -> Result<NamedParts, ReadError> {
    let read = |text: &mut dyn Read| read(text, input);
    read_file(path.as_ref(), read, |found| &mut found.notes)
}

/// Reads the known parts of a graph; see [`read_parts`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<NamedParts, Fault> {
    let mut lines = Lines::default();
    for_each_line(input, graph, |number, line, cameras| {
        lines.take(number, line, cameras)
    })?;
    if lines.first.is_none() {
        return Err(Place::Input.fault(Problem::NoParts));
    }
    let nodes = graph.graph.nodes() as u32;
    Ok(lines.finish(nodes, true).expect("nodes of the graph"))
}

/// What is left out, and the first line where something is.
#[derive(Default)]
struct LeftOut {
    count: usize,
    line: u64,
}

impl LeftOut {
    fn see(&mut self, count: usize, line: u64) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += count;
    }

    fn note(&self, what: &str, how: &str, place: &str) -> Option<String> {
        let note = note(self.count, what, how);
        note.map(|note| format!("{note} (first in {place} {})", self.line))
    }
}

fn note(count: usize, what: &str, how: &str) -> Option<String> {
    let are = if count == 1 { "is" } else { "are" };
    let how = if count == 1 {
        how.to_owned()
    } else {
        how.replace("counts", "count")
            .replace("adds", "add")
            .replace("says", "say")
            .replace("its", "their")
    };
    (count > 0).then(|| format!("{} {are} {how}", counted(count, what)))
}

/// The lines so far.
#[derive(Default)]
struct Lines {
    /// The first line with a part.
    first: Option<u64>,
    parts: Vec<Vec<u32>>,
    repeated: LeftOut,
    single: LeftOut,
    fields: Vec<Field>,
}

impl Lines {
    fn take(&mut self, number: u64, line: &str, cameras: &Cameras) -> Result<(), Problem> {
        split(line, &mut self.fields)?;
        if self.fields.is_empty() {
            return Ok(());
        }
        self.first.get_or_insert(number);
        let mut part = Vec::with_capacity(self.fields.len());
        for field in &self.fields {
            let label = field.text(line);
            let node = cameras.node(&label);
            part.push(node.ok_or_else(|| Problem::UnknownCamera(label.into_owned()))?);
        }
        self.see(number, part);
        Ok(())
    }

    /// Takes in a part with the number of its line.
    fn see(&mut self, number: u64, mut part: Vec<u32>) {
        let given = part.len();
        part.sort_unstable();
        part.dedup();
        if part.len() < given {
            self.repeated.see(given - part.len(), number);
        }
        match part.len() {
            0 | 1 => self.single.see(1, number),
            _ => self.parts.push(part),
        }
    }

    /// The parts of a graph with so many nodes, with notes that name lines or else parts.
    fn finish(self, nodes: u32, lines: bool) -> Result<NamedParts, GraphError> {
        let place = if lines { "line" } else { "part" };
        let given = self.parts.len();
        let parts = KnownParts::new(nodes, self.parts)?;
        let nested = nested(&parts, nodes as usize);
        let notes = [
            self.repeated
                .note("camera", "named again in its part and counts once", place),
            self.single
                .note("part", "of fewer than two cameras and says nothing", place),
            note(given - parts.len(), "part", "given again and counts once"),
            note(nested, "part", "inside of another one and adds nothing"),
        ];
        Ok(NamedParts {
            parts,
            notes: notes.into_iter().flatten().collect(),
        })
    }
}

/// How many parts lie inside of another one. Each is compared with the larger ones at that node of
/// it which is in the fewest parts.
fn nested(parts: &KnownParts, nodes: usize) -> usize {
    let all: Vec<&[u32]> = parts.iter().collect();
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(all[k as usize].len()));
    let places: Vec<(u32, u32)> = order
        .iter()
        .flat_map(|&k| all[k as usize].iter().map(move |&v| (v, k)))
        .collect();
    let at = Lists::group(nodes, places.iter().copied());
    let is_nested = |part: &&&[u32]| {
        let rarest = part.iter().min_by_key(|&&v| at.of(v as usize).len());
        let around = rarest.map_or(&[][..], |&v| at.of(v as usize));
        let around = around.iter().map(|&k| all[k as usize]);
        let mut larger = around.take_while(|other| other.len() > part.len());
        larger.any(|other| part.iter().all(|v| other.binary_search(v).is_ok()))
    };
    all.iter().filter(is_nested).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::Graph;
    use viewcert::graph::Labels;

    fn path(labels: Labels) -> NamedGraph {
        let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap();
        NamedGraph::new("path", graph, labels)
    }

    fn names() -> NamedGraph {
        let names = ["a", "b c", "d", "\"e"];
        path(Labels::Names(names.map(Into::into).into()))
    }

    fn parts(text: &str, graph: &NamedGraph) -> Result<(Vec<Vec<u32>>, Vec<String>), String> {
        let found = read(text.as_bytes(), graph);
        let found = found.map_err(|fault| fault.in_file("parts.txt").to_string())?;
        let parts = found.parts.iter().map(<[u32]>::to_vec).collect();
        Ok((parts, found.notes))
    }

    #[test]
    fn labels_quotes_and_comments() {
        let text = "\u{feff}# parts\nd \"b c\",a % three\r\n\n\"\"\"e\" d";
        let (found, notes) = parts(text, &names()).unwrap();
        assert_eq!(found, [vec![0, 1, 2], vec![2, 3]]);
        assert_eq!(notes, [""; 0]);
        for labels in [
            Labels::Numbers { first: 7 },
            Labels::Integers(vec![7, 8, 9, 10]),
        ] {
            assert_eq!(
                parts("10 8\n7 8 9", &path(labels)).unwrap().0,
                [vec![0, 1, 2], vec![1, 3]]
            );
        }
        // Only what the graph was read from would write 2 as 02.
        let unknown = parts("1 2\n3 02\n", &path(Labels::Numbers { first: 0 }));
        assert!(
            unknown
                .unwrap_err()
                .starts_with("parts.txt:2: `02` is no camera of the graph")
        );
    }

    #[test]
    fn what_counts_once_or_says_nothing_is_said() {
        let text = "0 1 2 3\n2 2\n1 0\n0 1 1 1\n3 2 1\n1\n";
        let (found, notes) = parts(text, &path(Labels::Numbers { first: 0 })).unwrap();
        assert_eq!(found, [vec![0, 1], vec![0, 1, 2, 3], vec![1, 2, 3]]);
        assert_eq!(
            notes,
            [
                "3 cameras are named again in their part and count once (first in line 2)",
                "2 parts are of fewer than two cameras and say nothing (first in line 2)",
                "1 part is given again and counts once",
                "2 parts are inside of another one and add nothing",
            ]
        );
        assert_eq!(
            parts("3\n", &path(Labels::Numbers { first: 0 })).unwrap().0,
            [[0; 0]; 0]
        );
    }

    #[test]
    fn parts_in_memory_have_the_notes_of_a_file() {
        let given = [vec![0, 1, 1], vec![], vec![1, 0]];
        let found = NamedParts::of_nodes(2, given).unwrap();
        assert_eq!(found.parts.iter().collect::<Vec<_>>(), [[0, 1]]);
        assert_eq!(
            found.notes,
            [
                "1 camera is named again in its part and counts once (first in part 1)",
                "1 part is of fewer than two cameras and says nothing (first in part 2)",
                "1 part is given again and counts once",
            ]
        );
        assert!(NamedParts::of_nodes(2, [vec![0, 2]]).is_err());
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, expected) in [
            (
                "",
                "parts.txt: the file holds no part of a reconstruction; ",
            ),
            (
                "# none\n",
                "parts.txt: the file holds no part of a reconstruction; ",
            ),
            ("a d\nd x\n", "parts.txt:2: `x` is no camera of the graph; "),
            ("a,,d", "parts.txt:1: there is an empty field; "),
            (
                "a \"d",
                "parts.txt:1: a quote (\") is not closed on its line; ",
            ),
            ("a d\n\na\u{1}d\n", "parts.txt:3: this is no plain text"),
        ] {
            let error = parts(text, &names()).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
        let numbers = path(Labels::Numbers { first: 1 });
        for label in ["0", "5", "-1", "18446744073709551616", "99999999999"] {
            let error = parts(&format!("1 {label}"), &numbers).unwrap_err();
            assert!(error.contains("is no camera of the graph"), "{error}");
        }
        assert!(read_parts("no such file", &numbers).is_err());
    }
}
