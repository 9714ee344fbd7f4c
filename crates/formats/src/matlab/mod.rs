//! MATLAB files of version 5 (`save -v6`, `save -v7`): an adjacency matrix as a graph.
//!
//! Format by The MathWorks, "MAT-File Format": a header of 128 bytes, then data
//! elements, each a type, a length and that many bytes; a variable is an
//! element that holds further ones, alone or deflated. Both byte orders are
//! read, sparse and full matrices of every real numeric class, and every
//! integer type in which MATLAB stores numbers compactly.
//!
//! What makes a graph of a matrix is in `matrix`; nodes are numbered as rows.
//!
//! No length in a file is believed before the bytes are there: memory grows
//! with what has been read, and deflated data can hold at most 1032 times
//! their own length, which is checked first.

use std::collections::BTreeSet;

use crate::edge_list::columns::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::matrix::{List, Matrix, Places, are_pairs};
use crate::read_as::Parsed;
use crate::variables::{Candidate, choose, chosen_note};
use viewcert::graph::Graph;

mod element;
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

    fn numeric_shape(&self) -> Option<[u64; 2]> {
        self.header.numeric_shape()
    }
}

/// The graph of an adjacency matrix or of two columns of pairs: of the variable named, else of
/// `A`, else of the only square numeric matrix with more than one row, else of the only one with two
/// columns. O(bytes + m log d) for largest degree d; takes about 24 bytes a pair beyond the file's
/// bytes, whether they are deflated or not.
///
/// # Errors
/// No such variable, or no way to choose one; a matrix that is not numeric,
/// real, square and symmetric with a zero diagonal, or has no rows; NaN; a
/// file of another version, truncated, or corrupt.
pub fn read(bytes: &[u8], variable: Option<&str>) -> Result<Graph, Fault> {
    read_noting(bytes, variable, &ListOptions::default()).map(|parsed| parsed.graph)
}

/// As [`read`]; with labels, and with notes: on the entries, and on the variable if it was neither
/// named nor is it `A`.
pub(super) fn read_noting(
    bytes: &[u8],
    variable: Option<&str>,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let (order, variables) = variables(bytes)?;
    let chosen = choose(&variables, variable)?;
    let name = chosen.header.name.clone();
    match graph(chosen, order, options) {
        Ok(mut parsed) => {
            if variable.is_none() && name != "A" {
                parsed.notes.insert(0, chosen_note(&name));
            }
            parsed.read.format = "MATLAB matrix".into();
            Ok(parsed)
        }
        Err(problem) => Err(Place::Variable(name).fault(problem)),
    }
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
        entries.extend((value != 0.0).then_some((row, column, value)));
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

/// Calls `entry` with row, column and value of all non-zero entries, and of stored zeros, column by
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

/// The graph of a variable.
fn graph(variable: &Variable, order: ByteOrder, options: &ListOptions) -> Result<Parsed, Problem> {
    let header = &variable.header;
    match header.numeric_shape() {
        Some(shape) if are_pairs(shape) && !header.is_sparse() => {
            let mut list = List::new(shape, options);
            each_entry(variable, order, |row, column, value| {
                list.entry(row, column, value)
            })?;
            list.graph()
        }
        _ => {
            let size = header.real_square()?;
            let mut matrix = Matrix::new(size, Places::MATLAB, options);
            each_entry(variable, order, |row, column, value| {
                matrix.entry(row, column, value)
            })?;
            matrix.graph()
        }
    }
}

#[cfg(test)]
mod tests;
