//! MatrixMarket files: a sparse adjacency matrix as text.
//!
//! Format by NIST, "The Matrix Market Exchange Formats": a line that says what the matrix is,
//! comments, a line with the numbers of rows, columns and entries, and an entry a line: row and
//! column, counted from 1, and its value unless only the pattern is given. Of a symmetric matrix
//! one triangle is enough.
//!
//! Every entry that is not zero is a pair, whatever its value; only the pattern has to be
//! symmetric. Nodes are numbered as rows.

use std::io::{BufRead, BufReader, Read};

use crate::edge_list::fields::is_number;
use crate::edge_list::text;
use crate::error::{Fault, Place, Problem};
use viewcert::graph::{Graph, GraphError};
use viewcert::wording::counted;

/// What every file begins with; upper and lower case are the same.
pub const HEADER: &str = "%%MatrixMarket";

/// Nodes without pairs that a file may promise.
const ISOLATED_LIMIT: u64 = 1 << 24;

/// The longest line that is read.
const LINE_LIMIT: u64 = 1 << 20;

/// Whether these are the first bytes of a MatrixMarket file.
pub(super) fn is_matrix_market(head: &[u8]) -> bool {
    head.get(..HEADER.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(HEADER.as_bytes()))
}

/// What the first line says of the entries.
struct Kind {
    values: Values,
    symmetric: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Values {
    Pattern,
    Integer,
    Real,
}

/// The graph of an adjacency matrix, and notes about what was merged or ignored.
/// O(bytes + m log m).
///
/// # Errors
/// With the number of the line: what is not a coordinate matrix, pattern, integer or real,
/// symmetric or general, square, with a zero diagonal; an entry out of range; NaN. Without: a
/// pattern that is not symmetric, fewer or more entries than promised.
pub fn read(input: impl Read) -> Result<(Graph, Vec<String>), Fault> {
    let mut input = BufReader::with_capacity(1 << 16, input);
    let mut line = Vec::new();
    let mut matrix = Matrix::default();
    for number in 1.. {
        line.clear();
        let got = input
            .by_ref()
            .take(LINE_LIMIT + 1)
            .read_until(b'\n', &mut line)
            .map_err(|error| Place::Input.fault(error.into()))?;
        if got == 0 {
            break;
        }
        let taken = matrix.take(&line);
        taken.map_err(|problem| Place::Line(number).fault(problem))?;
    }
    matrix
        .graph()
        .map_err(|problem| Place::Input.fault(problem))
}

/// What the lines have said so far.
#[derive(Default)]
struct Matrix {
    kind: Option<Kind>,
    /// Rows, and how many entries are promised.
    size: Option<(u32, u64)>,
    /// The pairs of entries that are not zero, and whether each stands below the diagonal.
    entries: Vec<(u32, u32, bool)>,
    seen: u64,
    zeros: usize,
}

impl Matrix {
    /// One more line, with its end.
    fn take(&mut self, line: &[u8]) -> Result<(), Problem> {
        if line.len() as u64 > LINE_LIMIT {
            return Err(Problem::LineTooLong {
                limit: LINE_LIMIT as usize,
            });
        }
        let bytes = line.strip_suffix(b"\n").unwrap_or(line);
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        let line = text(bytes)?;
        let mut words = line.split([' ', '\t']).filter(|word| !word.is_empty());
        let Some(kind) = &self.kind else {
            self.kind = Some(Kind::of_header(words)?);
            return Ok(());
        };
        let Some(first) = words.next().filter(|word| !word.starts_with('%')) else {
            return Ok(());
        };
        let Some((nodes, promised)) = self.size else {
            self.size = Some(sizes(first, words)?);
            return Ok(());
        };
        self.seen += 1;
        if self.seen > promised {
            return Err(said(format!(
                "{promised} entries are promised, and here is one more"
            )));
        }
        match kind.entry(first, words, nodes)? {
            None => self.zeros += 1,
            Some((row, column)) if row == column => return Err(Problem::Diagonal(row + 1)),
            Some((row, column)) => {
                let entry = (row.min(column), row.max(column), row > column);
                self.entries.push(entry);
            }
        }
        Ok(())
    }

    /// The graph, after the last line.
    fn graph(self) -> Result<(Graph, Vec<String>), Problem> {
        let (Some(kind), Some((nodes, promised))) = (self.kind, self.size) else {
            return Err(said("the line with the sizes is missing".into()));
        };
        let seen = self.seen;
        if seen < promised {
            return Err(said(format!(
                "{promised} entries are promised, and {seen} are there"
            )));
        }
        let (pairs, repeated) = kind.pairs(self.entries)?;
        if nodes == 0 {
            return Err(Problem::NoNodes);
        }
        if pairs.len() > i32::MAX as usize {
            return Err(Problem::TooManyPairs);
        }
        if u64::from(nodes) > ISOLATED_LIMIT + 2 * pairs.len() as u64 {
            return Err(Problem::TooManyIsolated {
                nodes: nodes.into(),
                pairs: pairs.len(),
                limit: ISOLATED_LIMIT,
            });
        }
        let graph = Graph::from_pairs(nodes, pairs).map_err(|error| match error {
            // Neither happens: entries are off the diagonal, and within the size.
            GraphError::SelfLoop(node) | GraphError::OutOfRange { node, .. } => {
                Problem::Diagonal(node + 1)
            }
        })?;
        let mut notes = Vec::from_iter(crate::merged(repeated));
        if self.zeros > 0 {
            let entries = counted(self.zeros, "entry");
            notes.push(format!("explicit zeros are no pairs: {entries}"));
        }
        Ok((graph.0, notes))
    }
}

fn said(what: String) -> Problem {
    Problem::MatrixMarket(what)
}

/// Rows and entries, from the line with rows, columns and entries.
fn sizes<'a>(rows: &str, mut others: impl Iterator<Item = &'a str>) -> Result<(u32, u64), Problem> {
    let (columns, entries) = (others.next(), others.next());
    let number = |word: Option<&str>| {
        word.filter(|word| word.bytes().all(|b| b.is_ascii_digit()))
            .and_then(|word| word.parse::<u64>().ok())
    };
    let (Some(row), Some(column), Some(entries), None) = (
        number(Some(rows)),
        number(columns),
        number(entries),
        others.next(),
    ) else {
        return Err(said(
            "the line with the sizes holds rows, columns and entries".into(),
        ));
    };
    if row != column {
        return Err(Problem::NotSquare(format!("{row} x {column}")));
    }
    let rows = u32::try_from(row).map_err(|_| Problem::TooManyNodes)?;
    Ok((rows, entries))
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
    fn of_header<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Self, Problem> {
        let mut next = || {
            words
                .next()
                .map(str::to_ascii_lowercase)
                .unwrap_or_default()
        };
        let (header, object, format, values, symmetry) = (next(), next(), next(), next(), next());
        if header != HEADER.to_ascii_lowercase() || object != "matrix" {
            return Err(said(format!("a {header} {object} is not a matrix")));
        }
        if format != "coordinate" {
            return Err(said(format!(
                "the format `{format}` is not read here, only `coordinate`"
            )));
        }
        let values = match &*values {
            "pattern" => Values::Pattern,
            "integer" => Values::Integer,
            "real" => Values::Real,
            _ => {
                return Err(said(format!(
                    "entries that are `{values}` are not read here"
                )));
            }
        };
        let symmetric = match &*symmetry {
            "symmetric" => true,
            "general" => false,
            _ => {
                return Err(said(format!(
                    "a matrix that is `{symmetry}` is not read here"
                )));
            }
        };
        Ok(Self { values, symmetric })
    }

    /// Row and column of an entry, from 0, unless it is zero.
    fn entry<'a>(
        &self,
        row: &str,
        mut words: impl Iterator<Item = &'a str>,
        nodes: u32,
    ) -> Result<Option<(u32, u32)>, Problem> {
        let row = place(row, nodes)?;
        let column = match words.next() {
            Some(word) => place(word, nodes)?,
            None => return Err(said("the entry has no column".into())),
        };
        let present = self.is_present(words.next(), row, column)?;
        if words.next().is_some() {
            return Err(said("the entry has too many fields".into()));
        }
        Ok(present.then_some((row, column)))
    }

    /// Whether an entry of this value is not zero.
    fn is_present(&self, value: Option<&str>, row: u32, column: u32) -> Result<bool, Problem> {
        let word = match (self.values, value) {
            (Values::Pattern, None) => return Ok(true),
            (Values::Pattern, Some(_)) => {
                return Err(said(
                    "the entry has a value, and only the pattern is promised".into(),
                ));
            }
            (_, None) => return Err(said("the entry has no value".into())),
            (_, Some(word)) => word,
        };
        let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
        if self.values == Values::Integer {
            let integer = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
            return if integer {
                Ok(digits.bytes().any(|b| b != b'0'))
            } else {
                Err(said(format!("`{word}` is no integer")))
            };
        }
        let lower = digits.to_ascii_lowercase();
        if lower == "nan" {
            let (row, column) = (row + 1, column + 1);
            return Err(Problem::NotANumber { row, column });
        }
        if is_number(word.as_bytes()) {
            let mantissa = lower.split('e').next().unwrap_or_default();
            return Ok(mantissa.bytes().any(|b| matches!(b, b'1'..=b'9')));
        }
        if lower == "inf" || lower == "infinity" {
            return Ok(true);
        }
        Err(said(format!("`{word}` is no number")))
    }

    /// The pairs of all entries, each with its smaller node first and whether it stands below the
    /// diagonal; and how many entries were repeated.
    fn pairs(
        &self,
        mut entries: Vec<(u32, u32, bool)>,
    ) -> Result<(Vec<(u32, u32)>, usize), Problem> {
        let given = entries.len();
        entries.sort_unstable();
        entries.dedup();
        let mut repeated = given - entries.len();
        let mut pairs = Vec::with_capacity(entries.len());
        for both in entries.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (i, j, below) = both[0];
            if !self.symmetric && both.len() == 1 {
                let (row, column) = if below { (j, i) } else { (i, j) };
                return Err(Problem::Asymmetric {
                    row: row + 1,
                    column: column + 1,
                });
            }
            if self.symmetric {
                repeated += both.len() - 1;
            }
            pairs.push((i, j));
        }
        Ok((pairs, repeated))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graph(text: &str) -> (usize, Vec<(u32, u32)>, Vec<String>) {
        let (graph, notes) = read(text.as_bytes()).unwrap();
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
            "{GENERAL}3 3 9\n1 2 .5\n2 1 -1e3\n3 1 inf\n1 3 1e-999\n2 3 7\n3 2 8\n1 1 0\n2 2 -0.0e5\n3 3 +.0"
        );
        let note = "explicit zeros are no pairs: 3 entries";
        assert_eq!(graph(&text), (3, triangle, vec![note.into()]));
        assert_eq!(graph(&format!("{GENERAL}2 2 0\n")), (2, vec![], vec![]));
    }

    #[test]
    fn refusals() {
        let header = |words: &str| format!("%%MatrixMarket matrix {words}\n2 2 1\n2 1 1\n");
        for (text, phrase) in [
            (
                header("array real general"),
                "a.mtx:1: MatrixMarket: the format `array` is not read",
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
                "a.mtx:3: diagonal entry (1, 1)",
            ),
            (
                format!("{GENERAL}2 2 1\n1 2 nan\n"),
                "entry (1, 2) is not a number",
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
