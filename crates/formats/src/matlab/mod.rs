//! MATLAB files (`save -v6`, `save -v7`, `save -v7.3`): an adjacency matrix as a graph.
//!
//! Version 7.3 is HDF5, in `hdf5`. The rest is of version 5.
//!
//! Format by The MathWorks, "MAT-File Format": a header of 128 bytes, then data
//! elements, each a type, a length and that many bytes; a variable is an
//! element that holds further ones, alone or deflated. Both byte orders are
//! read, sparse and full matrices of every real numeric class, and every
//! integer type in which MATLAB stores numbers compactly.
//!
//! Every entry that is not zero is a pair, whatever its value; only the pattern
//! has to be symmetric. Nodes are numbered as rows.
//!
//! No length in a file is believed before the bytes are there: memory grows
//! with what has been read, and deflated data can hold at most 1032 times
//! their own length, which is checked first.

use std::collections::BTreeSet;

use crate::error::{Fault, Place, Problem};
use viewcert::graph::{Graph, GraphError};

mod element;
mod hdf5;
mod matrix;

use element::{COMPRESSED, Elements, MATRIX, Source, malformed};
use matrix::Header;

const HEADER_LENGTH: usize = 128;
const HDF5_SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";

/// Whether the first bytes of a file, 128 or more of them, are those of a
/// MATLAB file of any version.
pub fn is_matlab(head: &[u8]) -> bool {
    version(head).is_some()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    Four,
    /// With the byte order.
    Five(ByteOrder),
    Hdf5,
}

/// In which order the file stores the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ByteOrder {
    Little,
    Big,
}

fn version(head: &[u8]) -> Option<Version> {
    if head.starts_with(HDF5_SIGNATURE) || head.starts_with(b"MATLAB 7.3 MAT-file") {
        return Some(Version::Hdf5);
    }
    match head.get(124..HEADER_LENGTH) {
        Some([_, 1, b'I', b'M']) => return Some(Version::Five(ByteOrder::Little)),
        Some([1, _, b'M', b'I']) => return Some(Version::Five(ByteOrder::Big)),
        Some([_, 2, b'I', b'M'] | [2, _, b'M', b'I']) => return Some(Version::Hdf5),
        _ => {}
    }
    if head.starts_with(b"MATLAB 5.0 MAT-file") {
        return Some(Version::Five(ByteOrder::Little));
    }
    is_version_four(head).then_some(Version::Four)
}

/// Version 4 has no signature: its header is five integers, the first of which
/// is a code of decimal digits, the fourth a flag, the fifth a short length.
fn is_version_four(head: &[u8]) -> bool {
    let Some(words) = head.first_chunk::<20>() else {
        return false;
    };
    let plausible = |number: fn([u8; 4]) -> u32| {
        let mut fields = words.as_chunks::<4>().0.iter().map(|&bytes| number(bytes));
        let mut next = || fields.next().unwrap_or(u32::MAX);
        let (code, rows, columns, imaginary, name) = (next(), next(), next(), next(), next());
        let digits = [code / 1000, code / 100 % 10, code / 10 % 10, code % 10];
        digits[0] <= 4
            && digits[1] == 0
            && digits[2] <= 5
            && digits[3] <= 2
            && rows.max(columns) <= i32::MAX as u32
            && imaginary <= 1
            && (2..=64).contains(&name)
    };
    plausible(u32::from_le_bytes) || plausible(u32::from_be_bytes)
}

/// A variable of a file that may be the one that is meant.
trait Candidate {
    fn name(&self) -> &str;
    /// Name, shape and class, for a list of what a file holds.
    fn describe(&self) -> String;
    /// Whether it is a square numeric matrix; a single number is none.
    fn could_be_adjacency(&self) -> bool;
}

/// One variable of a file, not yet read.
struct Variable<'a> {
    header: Header,
    /// The element that holds it.
    kind: u32,
    content: &'a [u8],
}

impl Candidate for Variable<'_> {
    fn name(&self) -> &str {
        &self.header.name
    }

    fn describe(&self) -> String {
        self.header.describe()
    }

    fn could_be_adjacency(&self) -> bool {
        self.header.could_be_adjacency()
    }
}

/// The graph of an adjacency matrix: of the variable named, else of `A`, else
/// of the only square numeric matrix with more than one row. O(bytes + m log d)
/// for largest degree d; takes about 16 bytes a pair beyond the file's bytes,
/// whether they are deflated or not.
///
/// # Errors
/// No such variable, or no way to choose one; a matrix that is not numeric,
/// real, square and symmetric with a zero diagonal, or has no rows; NaN; a
/// file of another version, truncated, or corrupt.
pub fn read(bytes: &[u8], variable: Option<&str>) -> Result<Graph, Fault> {
    read_noting(bytes, variable).map(|(graph, _)| graph)
}

/// As [`read`]; with a note if the variable was neither named nor is it `A`.
pub(super) fn read_noting(
    bytes: &[u8],
    variable: Option<&str>,
) -> Result<(Graph, Option<String>), Fault> {
    let (name, graph) = if version(bytes) == Some(Version::Hdf5) {
        hdf5::read(bytes, variable)?
    } else {
        let (order, variables) = variables(bytes)?;
        let chosen = choose(&variables, variable)?;
        let name = chosen.header.name.clone();
        let graph = pattern(chosen, order).and_then(|pattern| pattern.graph());
        (name, graph)
    };
    let note = (variable.is_none() && name != "A")
        .then(|| format!("the graph is the variable {name}, the only square matrix"));
    graph
        .map(|graph| (graph, note))
        .map_err(|problem| Place::Variable(name).fault(problem))
}

/// The non-zero entries `(row, column, value)` of a numeric variable of any shape in a file of
/// version 5, column by column; rows and columns count from 0, and integers beyond 2^53 are
/// rounded. O(bytes).
///
/// # Errors
/// As [`read`], but for what makes a matrix an adjacency.
pub fn entries(bytes: &[u8], variable: &str) -> Result<Vec<(u32, u32, f64)>, Fault> {
    let (order, variables) = variables(bytes)?;
    let variable = choose(&variables, Some(variable))?;
    let mut entries = Vec::new();
    each_entry(variable, order, |row, column, value| {
        entries.push((row, column, value));
        Ok(())
    })
    .map_err(|problem| Place::Variable(variable.header.name.clone()).fault(problem))?;
    Ok(entries)
}

/// All variables of a file, in order; only their headers are read.
fn variables(bytes: &[u8]) -> Result<(ByteOrder, Vec<Variable<'_>>), Fault> {
    let fault = |problem| Place::Input.fault(problem);
    let order = match version(bytes) {
        Some(Version::Five(order)) => order,
        Some(Version::Four) => return Err(fault(Problem::MatlabFour)),
        Some(Version::Hdf5) => return Err(fault(Problem::MatlabHdf5)),
        None => return Err(fault(malformed("this is not a MATLAB file"))),
    };
    let body = bytes.get(HEADER_LENGTH..).ok_or_else(|| {
        fault(Problem::Truncated(format!(
            "the header takes {HEADER_LENGTH} bytes, the file has {}",
            bytes.len()
        )))
    })?;
    let mut variables = Vec::new();
    let mut names = BTreeSet::new();
    for element in Elements::new(body, order) {
        let (kind, content) = element.map_err(fault)?;
        if kind != MATRIX && kind != COMPRESSED {
            continue;
        }
        let mut source = Source::of_element(kind, content, order).map_err(fault)?;
        let header = Header::read(&mut source).map_err(fault)?;
        if !names.insert(header.name.clone()) {
            let problem = malformed("there are two variables of this name");
            return Err(Place::Variable(header.name).fault(problem));
        }
        variables.push(Variable {
            header,
            kind,
            content,
        });
    }
    Ok((order, variables))
}

fn choose<'v, V: Candidate>(variables: &'v [V], asked: Option<&str>) -> Result<&'v V, Fault> {
    let named = |name| variables.iter().find(|v| v.name() == name);
    let present = || match variables {
        [] => "no variables".to_owned(),
        _ => {
            let all: Vec<String> = variables.iter().map(|v| v.describe()).collect();
            all.join(", ")
        }
    };
    if let Some(name) = asked {
        return named(name).ok_or_else(|| {
            let present = present();
            Place::Variable(name.to_owned()).fault(Problem::NoSuchVariable { present })
        });
    }
    if let Some(variable) = named("A") {
        return Ok(variable);
    }
    let candidates: Vec<_> = variables
        .iter()
        .filter(|v| v.could_be_adjacency())
        .collect();
    match candidates[..] {
        [variable] => Ok(variable),
        _ => Err(Place::Input.fault(Problem::ChooseVariable {
            candidates: candidates.len(),
            present: present(),
        })),
    }
}

/// Calls `entry` with row, column and value of all non-zero entries, column by
/// column, rows increasing.
fn each_entry(
    variable: &Variable,
    order: ByteOrder,
    entry: impl FnMut(u32, u32, f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let mut source = Source::of_element(variable.kind, variable.content, order)?;
    let header = Header::read(&mut source)?;
    matrix::each_entry(&header, &mut source, entry)?;
    source.finish()
}

/// The places of the non-zero entries of a square matrix, by columns.
struct Pattern {
    /// `rows[starts[c]..starts[c + 1]]` are the rows of column c, increasing.
    starts: Vec<usize>,
    rows: Vec<u32>,
}

fn pattern(variable: &Variable, order: ByteOrder) -> Result<Pattern, Problem> {
    let header = &variable.header;
    let size = header.real_square()?;
    let mut pattern = Pattern::new();
    each_entry(variable, order, |row, column, value| {
        pattern.entry(row, column, value)
    })?;
    pattern.complete(size);
    Ok(pattern)
}

impl Pattern {
    /// No entries so far.
    fn new() -> Self {
        Self {
            starts: vec![0],
            rows: Vec::new(),
        }
    }

    /// Takes in an entry that is not zero, behind all in earlier columns, and in earlier rows of
    /// its column.
    fn entry(&mut self, row: u32, column: u32, value: f64) -> Result<(), Problem> {
        if value.is_nan() {
            let (row, column) = (row + 1, column + 1);
            return Err(Problem::NotANumber { row, column });
        }
        if row == column {
            return Err(Problem::Diagonal(row + 1));
        }
        if self.starts.len() <= column as usize {
            self.starts.resize(column as usize + 1, self.rows.len());
        }
        self.rows.push(row);
        Ok(())
    }

    /// Ends the last column: there are as many as the file has, whose data have been read.
    fn complete(&mut self, columns: u32) {
        self.starts.resize(columns as usize + 1, self.rows.len());
    }

    /// The graph whose adjacency has this pattern. O(m).
    fn graph(self) -> Result<Graph, Problem> {
        let Self { starts, rows } = self;
        let nodes = starts.len() - 1;
        if nodes == 0 {
            return Err(Problem::NoNodes);
        }
        // next[c] is the first entry of column c whose mirror image has not come
        // by yet. Columns come in increasing order, so the mirror images of a
        // column's upper entries do too.
        let mut next = starts[..nodes].to_vec();
        let mut pairs = Vec::with_capacity(rows.len() / 2);
        for (c, number) in (0..nodes).zip(0u32..) {
            // What is above the diagonal and still waiting has no mirror image.
            if let Some(&row) = rows[next[c]..starts[c + 1]].first()
                && row < number
            {
                return Err(asymmetric(row, number));
            }
            for &row in &rows[next[c]..starts[c + 1]] {
                let mirror = &mut next[row as usize];
                match rows[*mirror..starts[row as usize + 1]].first() {
                    Some(&found) if found == number => *mirror += 1,
                    Some(&found) if found < number => return Err(asymmetric(found, row)),
                    _ => return Err(asymmetric(row, number)),
                }
                pairs.push((number, row));
            }
        }
        let nodes = nodes as u32;
        match Graph::from_pairs(nodes, pairs) {
            Ok((graph, _)) => Ok(graph),
            // The diagonal is empty and every row below the number of rows.
            Err(GraphError::SelfLoop(node) | GraphError::OutOfRange { node, .. }) => {
                Err(Problem::Diagonal(node + 1))
            }
        }
    }
}

fn asymmetric(row: u32, column: u32) -> Problem {
    Problem::Asymmetric {
        row: row + 1,
        column: column + 1,
    }
}

#[cfg(test)]
mod tests;
