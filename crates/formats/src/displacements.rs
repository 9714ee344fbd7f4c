//! Files of known displacements: pairs of cameras whose vector is known, and cameras whose position
//! is.
//!
//! In: a text, and the graph whose cameras it names. Out: the groups ([`Displacements`]), with
//! notes on what counts once or says nothing. The grammar is that of docs/input.md: fields as in
//! edge lists, two labels per line or one, and no head; behind them, on all lines or on none, the
//! vector from the first camera to the second, or the position (docs/models.md).

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::{Cameras, for_each_line, read_file};
use crate::edge_list::fields::{Field, split};
use crate::error::{Fault, Place, Problem, ReadError};
use viewcert::graph::{Coordinate, Displacements, VectorError};
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
/// two labels, vectors on some lines only or that contradict each other; a file that cannot be read
/// or holds no displacement.
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
    for_each_line(input, graph, |number, line, cameras| {
        lines.take(number, line, cameras)
    })?;
    lines.finish(graph)
}

/// The lines so far.
#[derive(Default)]
struct Lines {
    /// How many fields a line has behind its cameras, and has altogether: as the first line.
    shape: Option<(usize, usize)>,
    /// Pairs as they stand there, the number of their line, and the vector from the first to the
    /// second.
    pairs: Vec<Line<(u32, u32)>>,
    /// Cameras with a known position.
    positions: Vec<Line<u32>>,
    with_itself: usize,
    fields: Vec<Field>,
}

/// What a line says of a camera or a pair.
struct Line<T> {
    number: u64,
    about: T,
    vector: Option<Vector>,
}

type Vector = [Coordinate; 3];

impl Lines {
    fn take(&mut self, number: u64, line: &str, cameras: &Cameras) -> Result<(), Problem> {
        split(line, &mut self.fields)?;
        let found = self.fields.len();
        let names = match found {
            0 => return Ok(()),
            1 | 2 => found,
            4 | 5 => found - 3,
            _ => return Err(Problem::NoPairOrCamera { found }),
        };
        let &mut (behind, before) = self.shape.get_or_insert((found - names, found));
        if found - names != behind {
            return Err(Problem::SomeVectors { found, before });
        }
        let node = |field: &Field| {
            let label = field.text(line);
            let node = cameras.node(&label);
            node.ok_or_else(|| Problem::UnknownCamera(label.into_owned()))
        };
        let first = node(&self.fields[0])?;
        let second = self.fields[1..names].first().map(node).transpose()?;
        let vector = vector(line, &self.fields[names..])?;
        match second {
            None => self.positions.push(Line {
                number,
                about: first,
                vector,
            }),
            Some(second) if first == second => {
                let zero = Some([Coordinate::default(); 3]);
                if vector.is_some() && vector != zero {
                    return Err(Problem::Contradiction);
                }
                self.with_itself += 1;
            }
            Some(second) => self.pairs.push(Line {
                number,
                about: (first, second),
                vector,
            }),
        }
        Ok(())
    }

    fn finish(mut self, graph: &NamedGraph) -> Result<NamedDisplacements, Fault> {
        let pairs: BTreeSet<_> = self.pairs.iter().map(|line| sorted(line.about)).collect();
        let positions: BTreeSet<_> = self.positions.iter().map(|line| line.about).collect();
        let again = self.pairs.len() - pairs.len() + self.positions.len() - positions.len();
        self.take_positions()?;
        let known = self.known(graph)?;
        if known.is_empty() {
            return Err(Place::Input.fault(Problem::NoDisplacements));
        }
        let is_other = |&&(v, w): &&(u32, u32)| graph.graph.edge_number(v, w).is_none();
        let others = pairs.iter().filter(is_other).count();
        let mut notes = Vec::new();
        let mut note = |count: usize, what: &str, one: &str, more: &str| {
            let how = if count == 1 { one } else { more };
            if count > 0 {
                notes.push(format!("{} {how}", counted(count, what)));
            }
        };
        note(
            again,
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
            usize::from(positions.len() == 1),
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

    /// Makes positions, which are known in one frame, displacements from the first of them.
    fn take_positions(&mut self) -> Result<(), Fault> {
        let mut positions = std::mem::take(&mut self.positions).into_iter();
        let Some(first) = positions.next() else {
            return Ok(());
        };
        for line in positions {
            let fault = |problem| Place::Line(line.number).fault(problem);
            let vector = match line.vector.zip(first.vector) {
                None => None,
                Some((to, from)) => Some(between(from, to).map_err(fault)?),
            };
            if line.about != first.about {
                self.pairs.push(Line {
                    number: line.number,
                    about: (first.about, line.about),
                    vector,
                });
            } else if line.vector != first.vector {
                return Err(fault(Problem::Contradiction));
            }
        }
        Ok(())
    }

    /// The groups, with their vectors if there are any.
    fn known(&self, graph: &NamedGraph) -> Result<Displacements, Fault> {
        let nodes = graph.graph.nodes() as u32;
        let pairs = self.pairs.iter().map(|line| line.about);
        let given: Option<Vec<Vector>> = self.pairs.iter().map(|line| line.vector).collect();
        let Some(given) = given.filter(|given| !given.is_empty()) else {
            return Ok(Displacements::new(nodes, pairs).expect("pairs of the graph's nodes"));
        };
        let items = pairs.zip(given).map(|((u, v), vector)| (u, v, vector));
        Displacements::with_vectors(nodes, items).map_err(|error| match error {
            VectorError::Contradiction { vector } => {
                Place::Line(self.pairs[vector].number).fault(Problem::Contradiction)
            }
            VectorError::SamePlace { first, second } => {
                let [first, second] = [first, second].map(|v| graph.labels.label(v).into_owned());
                Place::Input.fault(Problem::SamePlace { first, second })
            }
            VectorError::TooLong => Place::Input.fault(Problem::LongVectors),
            VectorError::Pair(_) => unreachable!("pairs of the graph's nodes"),
        })
    }
}

fn sorted((v, w): (u32, u32)) -> (u32, u32) {
    (v.min(w), v.max(w))
}

/// The vector in the fields behind the cameras, if there are any.
fn vector(line: &str, fields: &[Field]) -> Result<Option<Vector>, Problem> {
    let coordinate = |field: &Field| {
        let field = field.text(line);
        field.parse().map_err(|why| Problem::NoCoordinate {
            field: field.clone().into_owned(),
            why,
        })
    };
    match fields {
        [x, y, z] => Ok(Some([coordinate(x)?, coordinate(y)?, coordinate(z)?])),
        _ => Ok(None),
    }
}

/// The vector from one position to another.
fn between(from: Vector, to: Vector) -> Result<Vector, Problem> {
    let minus = |k: usize| to[k].minus(from[k]).map_err(|_| Problem::LongVectors);
    Ok([minus(0)?, minus(1)?, minus(2)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::graph::{Graph, Labels};

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

    /// The vector of a line goes from its first camera to its second.
    #[test]
    fn vectors_and_positions_are_exact() {
        let read = |text: &str| read(text.as_bytes(), &names()).unwrap();
        let text =
            "\"b c\" a 0.5 0 -1e-1  # left\nd 1 2 3.0\ne,2,2,3\n  f 1 2 10/3\na \"b c\" -0.5 0 0.1";
        let found = read(text);
        assert_eq!(found.known.groups(), [vec![0, 1], vec![2, 3, 4]]);
        let expected = [vec![[-15, 0, 3]], vec![[30, 0, 0], [0, 0, 10]]];
        assert_eq!(found.known.vectors().unwrap(), expected);
        assert_eq!(
            found.notes,
            ["1 line says again what another one says, and counts once"]
        );
        // In another unit, and in other words.
        let again = read("a \"b c\" -50 0 10\nd f 0 0 100/3\nd e 100 0 0\ne e 0 0 0\ne 3 4 5");
        assert_eq!(again.known, found.known);
        assert!(read("a \"b c\"\nd\ne\nf").known.vectors().is_none());
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, expected) in [
            ("", "known.txt: the file holds no displacement; "),
            (
                "d\n# no second one\nd\n",
                "known.txt: the file holds no displacement; ",
            ),
            (
                "a d\nd e 1 2 3",
                "known.txt:2: the line has 5 fields, and an earlier one has 2; ",
            ),
            (
                "a 0 0 1\nd e",
                "known.txt:2: the line has 2 fields, and an earlier one has 4; ",
            ),
            (
                "a d 1 2 x",
                "known.txt:1: `x` is no decimal number and no fraction; ",
            ),
            (
                "a d 1 2 1e77",
                "known.txt:1: `1e77` is a number with more than 30 digits; ",
            ),
            (
                "a d 1 0 0\nd e 0 1 0\n\na e 1 1 1e-9",
                "known.txt:4: this contradicts the lines before it: ",
            ),
            (
                "a 1 2 3\nd 1 2 4\na 1 2 4",
                "known.txt:3: this contradicts ",
            ),
            ("a a 0 0 1", "known.txt:1: this contradicts the lines "),
            (
                "a d 1 0 0\ne d 1 0 0",
                "known.txt: `a` and `e` are at one place; ",
            ),
            ("d a 0 0 0", "known.txt: `a` and `d` are at one place; "),
            (
                "a d 1e20 0 0\ne f 1e-20 0 0",
                "known.txt: as multiples of one unit, the vectors have more than 30 digits; ",
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
