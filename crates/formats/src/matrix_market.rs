//! MatrixMarket files: an adjacency matrix as text.
//!
//! Format by NIST, "The Matrix Market Exchange Formats": a line that says what the matrix is,
//! comments, a line with the sizes, and the entries of the format `coordinate`, one a line: row
//! and column, counted from 1, and its value unless only the pattern is given. Of a symmetric matrix one triangle
//! is enough.
//!
//! What makes a graph of a matrix is in `matrix`; nodes are numbered as rows.

use std::io::{BufRead, BufReader, Read};

use crate::edge_list::columns::ListOptions;
use crate::edge_list::text;
use crate::error::{Fault, Place, Problem};
use crate::matrix::{self, Entry};
use crate::read_as::Parsed;

/// What every file begins with; upper and lower case are the same.
pub const HEADER: &str = "%%MatrixMarket";

/// The longest line that is read.
const LINE_LIMIT: u64 = 1 << 20;

/// Whether these are the first bytes of a MatrixMarket file.
pub(super) fn is_matrix_market(head: &[u8]) -> bool {
    head.get(..HEADER.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(HEADER.as_bytes()))
}

/// What the first line says of the entries.
#[derive(Clone, Copy)]
struct Kind {
    /// Whether values follow the row and the column, and whether they are integers.
    values: Option<bool>,
    /// One triangle says what is in the other.
    symmetric: bool,
}

/// The graph of an adjacency matrix, and notes about what was merged or ignored.
/// O(bytes + m log d) for largest degree d.
///
/// # Errors
/// With the number of the line: what is not a matrix, pattern, integer or real, symmetric
/// or general, square; an entry out of range; NaN. Without: a pattern that is not
/// symmetric with a zero diagonal, fewer or more entries than promised.
pub fn read(input: impl Read) -> Result<Parsed, Fault> {
    read_with(input, &ListOptions::default())
}

/// The same with the options of whoever asks.
pub(super) fn read_with(input: impl Read, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut input = BufReader::with_capacity(1 << 16, input);
    let mut line = Vec::new();
    let mut file = File::default();
    for number in 1.. {
        line.clear();
        let got = input
            .by_ref()
            .take(LINE_LIMIT + 1)
            .read_until(b'\n', &mut line)
            .map_err(Problem::from)?;
        if got == 0 {
            break;
        }
        let taken = file.take(&line);
        taken.map_err(|problem| Place::Line(number).fault(problem))?;
    }
    file.graph(options).map_err(Fault::from)
}

/// What the lines have said so far.
#[derive(Default)]
struct File {
    kind: Option<Kind>,
    size: Option<Size>,
    /// In both triangles.
    entries: Vec<Entry>,
    seen: u64,
}

/// Rows, as many as columns, and how many entries are promised.
#[derive(Clone, Copy)]
struct Size {
    nodes: u32,
    entries: u64,
}

impl File {
    /// One more line, with its end.
    fn take(&mut self, line: &[u8]) -> Result<(), Problem> {
        if line.len() as u64 > LINE_LIMIT {
            return Err(Problem::long_line(LINE_LIMIT));
        }
        let bytes = line.strip_suffix(b"\n").unwrap_or(line);
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        let line = text(bytes)?;
        let mut words = line.split([' ', '\t']).filter(|word| !word.is_empty());
        let Some(kind) = self.kind else {
            self.kind = Some(Kind::of_header(words)?);
            return Ok(());
        };
        let Some(first) = words.next().filter(|word| !word.starts_with('%')) else {
            return Ok(());
        };
        let Some(size) = self.size else {
            self.size = Some(Kind::sizes(first, words)?);
            return Ok(());
        };
        self.seen += 1;
        if self.seen > size.entries {
            let promised = size.entries;
            return Err(said(format!(
                "{promised} entries are promised, and here is one more"
            )));
        }
        let row = place(first, size.nodes)?;
        let Some(word) = words.next() else {
            return Err(said("the entry has no column".into()));
        };
        let column = place(word, size.nodes)?;
        let value = kind.value(words.next())?;
        if !value.is_finite() {
            return Err(matrix::no_number([row + 1, column + 1], value));
        }
        if words.next().is_some() {
            return Err(said("the entry has too many fields".into()));
        }
        self.entries.push((row, column, value));
        if kind.symmetric && row != column {
            self.entries.push((column, row, value));
        }
        Ok(())
    }

    /// The graph, after the last line.
    fn graph(self, options: &ListOptions) -> Result<Parsed, Problem> {
        let (Some(kind), Some(size)) = (self.kind, self.size) else {
            return Err(said("the line with the sizes is missing".into()));
        };
        let (seen, promised) = (self.seen, size.entries);
        if seen < promised {
            return Err(said(format!(
                "{promised} entries are promised, and {seen} are there"
            )));
        }
        let (mut parsed, again) = matrix::graph(size.nodes, self.entries, options)?;
        parsed.read.format = "MatrixMarket matrix".into();
        // Of a symmetric matrix both triangles were filled in.
        parsed.read.merged = if kind.symmetric { again / 2 } else { again };
        parsed.notes.extend(crate::merged(parsed.read.merged));
        Ok(parsed)
    }
}

fn said(what: String) -> Problem {
    Problem::new(
        format!("MatrixMarket: {what}"),
        "write it again as `%%MatrixMarket matrix coordinate pattern symmetric`",
    )
}

/// A row or column, from 0.
fn place(word: &str, nodes: u32) -> Result<u32, Problem> {
    let digits = word.bytes().all(|b| b.is_ascii_digit());
    match word.parse::<u32>() {
        Ok(value @ 1..) if digits && value <= nodes => Ok(value - 1),
        _ => Err(said(format!("`{word}` is no row or column of {nodes}"))),
    }
}

impl Kind {
    fn of_header<'a>(words: impl Iterator<Item = &'a str>) -> Result<Self, Problem> {
        let words: Vec<String> = words.map(str::to_ascii_lowercase).collect();
        let word = |k: usize| words.get(k).map_or("", |word| &**word);
        let refused = |what: &str| Err(said(format!("{what} not read here")));
        if word(0) != HEADER.to_ascii_lowercase() || word(1) != "matrix" {
            return Err(said(format!("a {} {} is not a matrix", word(0), word(1))));
        }
        if word(2) == "array" {
            let what = "MatrixMarket: the format `array` is not read here";
            let remedy = "in Python: scipy.io.mmwrite('graph.mtx', scipy.sparse.coo_array(scipy.io.mmread('FILE')))";
            return Err(Problem::new(what, remedy));
        }
        if word(2) != "coordinate" {
            return refused(&format!("the format `{}` is", word(2)));
        }
        let values = match word(3) {
            "pattern" => None,
            "integer" | "unsigned-integer" => Some(true),
            "real" | "double" => Some(false),
            other => return refused(&format!("entries that are `{other}` are")),
        };
        let symmetric = match word(4) {
            "symmetric" => true,
            "general" => false,
            other => return refused(&format!("a matrix that is `{other}` is")),
        };
        Ok(Self { values, symmetric })
    }

    /// The line with rows, columns and entries.
    fn sizes<'a>(rows: &'a str, others: impl Iterator<Item = &'a str>) -> Result<Size, Problem> {
        let number = |word: &str| {
            let digits = word.bytes().all(|b| b.is_ascii_digit());
            word.parse::<u64>().ok().filter(|_| digits)
        };
        let numbers: Option<Vec<u64>> = std::iter::once(rows).chain(others).map(number).collect();
        let Some(&[rows, columns, entries]) = numbers.as_deref() else {
            let what = "the line with the sizes holds rows, columns and entries";
            return Err(said(what.into()));
        };
        let (Ok(nodes), Ok(_)) = (u32::try_from(rows), u32::try_from(columns)) else {
            return Err(Problem::too_many_nodes());
        };
        if rows != columns {
            return Err(matrix::not_square(&format!("{rows} x {columns}")));
        }
        Ok(Size { nodes, entries })
    }

    /// A value; that of a pattern is 1.
    fn value(self, value: Option<&str>) -> Result<f64, Problem> {
        let (integers, word) = match (self.values, value) {
            (None, None) => return Ok(1.0),
            (None, Some(_)) => {
                let what = "the entry has a value, and only the pattern is promised";
                return Err(said(what.into()));
            }
            (_, None) => return Err(said("the entry has no value".into())),
            (Some(integers), Some(word)) => (integers, word),
        };
        match word.parse::<f64>() {
            Ok(value) if integers && value.fract() != 0.0 => {
                Err(said(format!("`{word}` is no integer")))
            }
            Ok(value) => Ok(value),
            Err(_) => Err(said(format!("`{word}` is no number"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graph(text: &str) -> (usize, Vec<(u32, u32)>, Vec<String>) {
        let Parsed {
            graph,
            labels,
            notes,
            ..
        } = read(text.as_bytes()).unwrap();
        assert_eq!(labels.label(0), "1");
        (graph.nodes(), graph.edges().to_vec(), notes)
    }

    fn refusal(text: &str) -> String {
        let fault = read(text.as_bytes()).unwrap_err();
        fault.in_file("a.mtx").to_string()
    }

    const SYMMETRIC: &str = "%%MatrixMarket matrix coordinate pattern symmetric\n";
    const GENERAL: &str = "%%matrixmarket MATRIX Coordinate Real General\n";

    #[test]
    fn symmetric_and_general_matrices() {
        let triangle = vec![(0, 1), (0, 2), (1, 2)];
        let text = format!("{SYMMETRIC}% a comment\n\n4 4 3\r\n2 1\n3 1\n 3\t2\n");
        assert_eq!(graph(&text), (4, triangle.clone(), vec![]));
        let text = format!("{SYMMETRIC}4 4 4\n2 1\n3 1\n3 2\n1 2\n");
        let note = "1 pair is given again, the same or reversed, and merged";
        assert_eq!(graph(&text), (4, triangle.clone(), vec![note.into()]));
        let text = format!(
            "{GENERAL}3 3 9\n1 2 5.\n2 1 1e3\n3 1 1e4\n1 3 10e-1\n2 3 7\n3 2 8\n1 1 0\n2 2 -0.0e5\n3 3 +.0"
        );
        let values = "entries are integers from 1 to 10000 (counts, weights?): each that is not zero is a pair";
        let note = "explicit zeros are no pairs: 3 entries";
        assert_eq!(
            graph(&text),
            (3, triangle, vec![values.into(), note.into()])
        );
        assert_eq!(graph(&format!("{GENERAL}2 2 0\n")), (2, vec![], vec![]));
    }

    #[test]
    fn refusals() {
        let header = |words: &str| format!("%%MatrixMarket matrix {words}\n2 2 1\n2 1 1\n");
        for (text, phrase) in [
            (
                header("elemental real general"),
                "a.mtx:1: MatrixMarket: the format `elemental` is not read",
            ),
            (
                header("coordinate complex general"),
                "a.mtx:1: MatrixMarket: entries that are `complex`",
            ),
            (
                header("coordinate real hermitian"),
                "a.mtx:1: MatrixMarket: a matrix that is `hermitian`",
            ),
            (header("coordinate real"), "a matrix that is ``"),
            (
                header("coordinate real skew-symmetric"),
                "`skew-symmetric` is not read",
            ),
            (
                header("coordinate integer general"),
                "not symmetric: (2, 1) is non-zero, (1, 2) is zero",
            ),
            (
                format!("{GENERAL}2 2 1\n1 2 1\n"),
                "not symmetric: (1, 2) is non-zero",
            ),
            (
                format!("{GENERAL}2 3 0\n"),
                "a.mtx:2: the matrix is 2 x 3, not square",
            ),
            (
                format!("{GENERAL}2 2 1\n1 1 1\n"),
                "a.mtx: diagonal entry (1, 1)",
            ),
            (
                format!("{GENERAL}2 2 1\n1 2 nan\n"),
                "a.mtx:3: entry (1, 2) is not a number",
            ),
            (
                format!("{GENERAL}2 2 1\n1 2 -inf\n"),
                "a.mtx:3: entry (1, 2) is infinite",
            ),
            (
                header("array real general"),
                "the format `array` is not read here; in Python: scipy.io.mmwrite",
            ),
            (format!("{GENERAL}2 2 1\n1 2 x\n"), "`x` is no number"),
            (
                format!("{GENERAL}2 2 1\n1 3 1\n"),
                "`3` is no row or column of 2",
            ),
            (
                format!("{GENERAL}2 2 1\n0 1 1\n"),
                "`0` is no row or column of 2",
            ),
            (format!("{GENERAL}2 2 1\n1\n"), "has no column"),
            (format!("{GENERAL}2 2 1\n1 2\n"), "has no value"),
            (format!("{GENERAL}2 2 1\n1 2 3 4\n"), "too many fields"),
            (
                format!("{GENERAL}2 2 2\n1 2 3\n"),
                "2 entries are promised, and 1 are there",
            ),
            (
                format!("{SYMMETRIC}2 2 1\n2 1\n1 2\n"),
                "a.mtx:4: MatrixMarket: 1 entries are promised",
            ),
            (
                format!("{SYMMETRIC}2 2 1\n2 1 5\n"),
                "only the pattern is promised",
            ),
            (format!("{SYMMETRIC}2 2\n"), "rows, columns and entries"),
            (SYMMETRIC.to_owned(), "sizes is missing"),
            (format!("{SYMMETRIC}0 0 0\n"), "the graph is empty"),
            (
                format!("{SYMMETRIC}4000000000 4000000000 0\n"),
                "4000000000 nodes and 0 pairs",
            ),
            (
                format!("{SYMMETRIC}5000000000 5000000000 0\n"),
                "more than 4294967295 nodes",
            ),
        ] {
            let found = refusal(&text);
            assert!(found.contains(phrase), "{text}{found}");
        }
    }
}
