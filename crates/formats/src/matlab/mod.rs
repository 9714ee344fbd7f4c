//! MATLAB files of version 5 (`save -v6`, `save -v7`): an adjacency matrix as a graph.
//!
//! Format by The MathWorks, "MAT-File Format": a header of 128 bytes, then data
//! elements, each a type, a length and that many bytes; a variable is an
//! element that holds further ones, alone or deflated. Read are sparse and full
//! matrices of every real numeric class, and every integer type in which MATLAB
//! stores numbers compactly, in the byte order of all machines of today.
//!
//! What makes a graph of a matrix is in `matrix`; nodes are numbered as rows.
//!
//! No length in a file is believed before the bytes are there: memory grows
//! with what has been read, and deflated data can hold at most 1032 times
//! their own length, which is checked first.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::Read;

use flate2::bufread::ZlibDecoder;

use crate::edge_list::columns::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::matrix::{self, Entry};
use crate::read_as::Parsed;
use viewcert::graph::Graph;

const HEADER_LENGTH: usize = 128;
const HDF5_SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";

/// Types of elements.
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Deflate codes at most 258 bytes in two bits.
const DEFLATE_LIMIT: u64 = 1032;
/// Classes of variables.
const SPARSE: u8 = 5;
const LAST_NUMERIC: u8 = 15;
const OPAQUE: u8 = 17;
const COMPLEX: u32 = 0x800;

/// Whether the first bytes of a file, 128 or more of them, are those of a
/// MATLAB file of any version.
pub fn is_matlab(head: &[u8]) -> bool {
    version(head).is_some()
}

/// Whether the first bytes of a file are those of version 5 of this machine's byte order; nothing, if they are
/// of no MATLAB file.
fn version(head: &[u8]) -> Option<Result<(), Problem>> {
    let hdf5 = || {
        let what = "HDF5, as MATLAB writes it in version 7.3, is not read here";
        let remedy =
            "in Python: viewcert.verify(h5py.File('FILE')['A'][:]); or save it in MATLAB with -v7";
        Some(Err(Problem::new(what, remedy)))
    };
    if head.starts_with(HDF5_SIGNATURE) || head.starts_with(b"MATLAB 7.3 MAT-file") {
        return hdf5();
    }
    match head.get(124..HEADER_LENGTH) {
        Some([_, 1, b'I', b'M']) => Some(Ok(())),
        Some([1, _, b'M', b'I']) => {
            let what = "a MATLAB file of a big-endian machine is not read here";
            Some(Err(Problem::new(what, "save it in MATLAB with -v7 or -v6")))
        }
        Some([_, 2, b'I', b'M'] | [2, _, b'M', b'I']) => hdf5(),
        _ => head.starts_with(b"MATLAB 5.0 MAT-file").then_some(Ok(())),
    }
}

fn malformed(what: &str) -> Problem {
    Problem::corrupt(what)
}

fn cut_off() -> Problem {
    Problem::truncated("the data of a variable end early")
}

/// The next element of `rest`: its type and its bytes. Small ones hold these in the tag; deflated ones are
/// not padded.
fn element<'a>(rest: &mut &'a [u8]) -> Result<(u32, &'a [u8]), Problem> {
    let whole = *rest;
    let (tag, body) = whole.split_first_chunk::<8>().ok_or_else(cut_off)?;
    let [a, b, c, d, length @ ..] = *tag;
    let kind = u32::from_le_bytes([a, b, c, d]);
    let small = (kind >> 16) as usize;
    if small > 0 {
        *rest = body;
        let data = whole[4..8].get(..small);
        let data = data.ok_or_else(|| malformed("a small element is longer than four bytes"))?;
        return Ok((kind & 0xffff, data));
    }
    let length = u32::from_le_bytes(length) as usize;
    let data = body.get(..length).ok_or_else(|| {
        let there = body.len();
        Problem::truncated(format!(
            "a variable takes {length} bytes, {there} are there"
        ))
    })?;
    let padded = match kind {
        COMPRESSED => length,
        _ => length.next_multiple_of(8),
    };
    *rest = body.get(padded..).unwrap_or_default();
    Ok((kind, data))
}

/// One variable of a file.
struct Variable<'a> {
    name: String,
    class: u8,
    flags: u32,
    /// Empty for opaque objects.
    dimensions: Vec<u32>,
    /// What follows, deflated or not.
    values: Cow<'a, [u8]>,
}

/// The bytes of a deflated element.
fn inflated(element: &[u8]) -> Result<Vec<u8>, Problem> {
    let mut decoder = ZlibDecoder::new(element);
    let mut inflated = |count: u64| -> Result<Vec<u8>, Problem> {
        let mut bytes = Vec::new();
        let read = decoder.by_ref().take(count).read_to_end(&mut bytes);
        read.map_err(|error| match error.kind() {
            std::io::ErrorKind::UnexpectedEof => cut_off(),
            _ => Problem::corrupt(format!("the deflated data of a variable: {error}")),
        })?;
        Ok(bytes)
    };
    let [a, b, c, d, length @ ..] = *inflated(8)?.first_chunk::<8>().ok_or_else(cut_off)?;
    if u32::from_le_bytes([a, b, c, d]) != MATRIX {
        return Err(malformed("a deflated element is not a variable"));
    }
    let (length, available) = (u64::from(u32::from_le_bytes(length)), element.len() as u64);
    if length > DEFLATE_LIMIT * available {
        return Err(Problem::truncated(format!(
            "a variable takes {length} bytes, which {available} deflated bytes cannot hold"
        )));
    }
    let content = inflated(length)?;
    if (content.len() as u64) < length {
        return Err(cut_off());
    }
    // What follows is the end, and the checksum.
    match inflated(1)?.is_empty() {
        true => Ok(content),
        false => Err(malformed("deflated bytes follow the variable")),
    }
}

impl<'a> Variable<'a> {
    fn new(kind: u32, element: &'a [u8]) -> Result<Self, Problem> {
        let mut variable = Self {
            name: String::new(),
            class: 0,
            flags: 0,
            dimensions: Vec::new(),
            values: Cow::Borrowed(&[]),
        };
        variable.values = match kind {
            MATRIX => Cow::Borrowed(variable.describe(element)?),
            _ => Cow::Owned(variable.describe(&inflated(element)?)?.to_vec()),
        };
        Ok(variable)
    }

    /// Takes in what stands before the values, which it returns.
    fn describe<'b>(&mut self, mut rest: &'b [u8]) -> Result<&'b [u8], Problem> {
        let words = |bytes: &[u8]| -> Vec<u32> {
            let (words, _) = bytes.as_chunks();
            words.iter().map(|&word| u32::from_le_bytes(word)).collect()
        };
        let [flags, _] = words(element(&mut rest)?.1)[..] else {
            return Err(malformed("the flags of a variable are not two integers"));
        };
        (self.flags, self.class) = (flags, flags as u8);
        if !(1..=OPAQUE).contains(&self.class) {
            let class = self.class;
            return Err(Problem::corrupt(format!("a variable of class {class}")));
        }
        if self.class != OPAQUE {
            self.dimensions = words(element(&mut rest)?.1);
            let dimensions = &self.dimensions;
            if dimensions.len() < 2 || dimensions.iter().any(|&d| d > i32::MAX as u32) {
                return Err(malformed("a variable without proper dimensions"));
            }
        }
        self.name = String::from_utf8_lossy(element(&mut rest)?.1).into_owned();
        Ok(rest)
    }

    fn is_numeric(&self) -> bool {
        (SPARSE..=LAST_NUMERIC).contains(&self.class)
    }

    fn shape(&self) -> String {
        let dimensions: Vec<String> = self.dimensions.iter().map(u32::to_string).collect();
        dimensions.join("x")
    }

    /// Rows and columns of a numeric matrix.
    fn numeric_shape(&self) -> Option<[u32; 2]> {
        let shape = self.dimensions.first_chunk().copied();
        shape.filter(|_| self.is_numeric() && self.dimensions.len() == 2)
    }

    fn is_square(&self) -> bool {
        let shape = self.numeric_shape();
        shape.is_some_and(|[rows, columns]| rows == columns)
    }

    /// The entries that are not zero, and zeros that a sparse matrix stores, column by column with rows
    /// increasing.
    fn entries(&self) -> Result<Vec<Entry>, Problem> {
        if !self.is_numeric() {
            return Err(Problem::new("this is no matrix of numbers", matrix::SQUARE));
        }
        if self.flags & COMPLEX != 0 {
            return Err(Problem::new(
                "the matrix is complex",
                "save its real part, or the matrix of its non-zero entries",
            ));
        }
        let shape = self.numeric_shape();
        let [rows, columns] = shape.ok_or_else(|| matrix::not_square(&self.shape()))?;
        let mut rest = &*self.values;
        let entries = match self.class {
            SPARSE => self.sparse(rows, columns, &mut rest)?,
            _ => self.full(rows, columns, &mut rest)?,
        };
        match rest.is_empty() {
            true => Ok(entries),
            false => Err(malformed("bytes follow the values of the matrix")),
        }
    }

    fn full(&self, rows: u32, columns: u32, rest: &mut &[u8]) -> Result<Vec<Entry>, Problem> {
        let expected = u64::from(rows) * u64::from(columns);
        let values: Vec<f64> = self.numbers(rest)?.collect();
        if values.len() as u64 != expected {
            let given = values.len();
            let what = format!("a matrix of {rows}x{columns} has {given} values");
            return Err(Problem::corrupt(what));
        }
        let places = (0..columns).flat_map(|column| (0..rows).map(move |row| (row, column)));
        let entries = places.zip(values).filter(|&(_, value)| value != 0.0);
        Ok(entries
            .map(|((row, column), value)| (row, column, value))
            .collect())
    }

    fn sparse(&self, rows: u32, columns: u32, rest: &mut &[u8]) -> Result<Vec<Entry>, Problem> {
        let index = |value: f64| match value as u32 {
            index if f64::from(index) == value && index <= i32::MAX as u32 => Ok(index as usize),
            _ => Err(malformed("an index of a sparse matrix is out of range")),
        };
        let row_of: Vec<usize> = self.numbers(rest)?.map(index).collect::<Result<_, _>>()?;
        let starts: Vec<usize> = self.numbers(rest)?.map(index).collect::<Result<_, _>>()?;
        let count = starts.last().copied().unwrap_or(0);
        let are_starts = starts.len() as u64 == u64::from(columns) + 1 && starts.is_sorted();
        if !are_starts || starts[0] != 0 || count > row_of.len() {
            return Err(malformed("the column starts of a sparse matrix"));
        }
        // Room for further entries may follow the last one.
        let values: Vec<f64> = self.numbers(rest)?.take(count).collect();
        if values.len() < count {
            return Err(malformed("a sparse matrix has fewer values than entries"));
        }
        let mut entries = Vec::with_capacity(count);
        for (column, ends) in (0..).zip(starts.windows(2)) {
            let of_column = &row_of[ends[0]..ends[1]];
            if !of_column.is_sorted_by(|a, b| a < b) || of_column.last() >= Some(&(rows as usize)) {
                return Err(malformed("the row numbers of a sparse matrix"));
            }
            let values = &values[ends[0]..ends[1]];
            let of_column = of_column.iter().zip(values);
            entries.extend(of_column.map(|(&row, &value)| (row as u32, column, value)));
        }
        Ok(entries)
    }

    /// The numbers of the next element, whatever their type.
    fn numbers<'r>(
        &self,
        rest: &mut &'r [u8],
    ) -> Result<Box<dyn Iterator<Item = f64> + 'r>, Problem> {
        let (kind, bytes) = element(rest)?;
        macro_rules! numbers {
            ($number:ty) => {{
                let (numbers, left) = bytes.as_chunks::<{ size_of::<$number>() }>();
                if !left.is_empty() {
                    return Err(malformed(
                        "the length of an element is no multiple of its numbers'",
                    ));
                }
                let number = |&bytes: &[u8; _]| <$number>::from_le_bytes(bytes) as f64;
                Box::new(numbers.iter().map(number))
            }};
        }
        Ok(match kind {
            1 => numbers!(i8),
            2 => numbers!(u8),
            3 => numbers!(i16),
            4 => numbers!(u16),
            5 => numbers!(i32),
            6 => numbers!(u32),
            7 => numbers!(f32),
            9 => numbers!(f64),
            12 => numbers!(i64),
            13 => numbers!(u64),
            kind => return Err(Problem::corrupt(format!("numbers of type {kind}"))),
        })
    }

    fn fault(&self, problem: Problem) -> Fault {
        Place::Variable(self.name.clone()).fault(problem)
    }
}

/// The graph of an adjacency matrix: of the variable named, else of `A`, else of the only square
/// numeric matrix with more than one row. O(bytes + m log m).
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
    name: Option<&str>,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let variables = variables(bytes)?;
    let variable = choose(&variables, name)?;
    let graph = || {
        let entries = variable.entries()?;
        match variable.numeric_shape() {
            Some([rows, columns]) if rows == columns => matrix::graph(rows, entries, options),
            _ => Err(matrix::not_square(&variable.shape())),
        }
    };
    let (mut parsed, _) = graph().map_err(|problem| variable.fault(problem))?;
    if name.is_none() && variable.name != "A" {
        let name = &variable.name;
        let note = format!("the graph is the variable {name}, the only one that can be");
        parsed.notes.insert(0, note);
    }
    parsed.read.format = "MATLAB matrix".into();
    Ok(parsed)
}

/// The non-zero entries `(row, column, value)` of a numeric variable of any shape in a file of
/// version 5, column by column; rows and columns count from 0, and integers beyond 2^53 are
/// rounded. O(bytes).
///
/// # Errors
/// As [`read`], but for what makes a matrix an adjacency.
pub fn entries(bytes: &[u8], variable: &str) -> Result<Vec<(u32, u32, f64)>, Fault> {
    let variables = variables(bytes)?;
    let variable = choose(&variables, Some(variable))?;
    let mut entries = variable
        .entries()
        .map_err(|problem| variable.fault(problem))?;
    entries.retain(|entry| entry.2 != 0.0);
    Ok(entries)
}

/// All variables of a file, in order; only what they are is read.
fn variables(bytes: &[u8]) -> Result<Vec<Variable<'_>>, Fault> {
    version(bytes).unwrap_or_else(|| Err(malformed("this is not a MATLAB file")))?;
    let mut rest = bytes.get(HEADER_LENGTH..).ok_or_else(|| {
        let there = bytes.len();
        let what = format!("the header takes {HEADER_LENGTH} bytes, the file has {there}");
        Problem::truncated(what)
    })?;
    let mut variables = Vec::new();
    let mut names = BTreeSet::new();
    while !rest.is_empty() {
        let (kind, content) = element(&mut rest)?;
        if kind != MATRIX && kind != COMPRESSED {
            continue;
        }
        let variable = Variable::new(kind, content)?;
        if !names.insert(variable.name.clone()) {
            return Err(variable.fault(malformed("there are two variables of this name")));
        }
        variables.push(variable);
    }
    Ok(variables)
}

const NAME: &str = "name the adjacency matrix with --variable";

/// The variable that is meant.
fn choose<'v, 'a>(
    variables: &'v [Variable<'a>],
    asked: Option<&str>,
) -> Result<&'v Variable<'a>, Fault> {
    let describe = |v: &Variable| match v.is_numeric() {
        true => format!("{} ({})", v.name, v.shape()),
        false => format!("{} (no numbers)", v.name),
    };
    let present = match variables {
        [] => "no variables".to_owned(),
        _ => variables
            .iter()
            .map(describe)
            .collect::<Vec<_>>()
            .join(", "),
    };
    let named = |name| variables.iter().find(|variable| variable.name == name);
    if let Some(variable) = named(asked.unwrap_or("A")) {
        return Ok(variable);
    }
    if let Some(name) = asked {
        let what = format!("there is no such variable; the file holds {present}");
        return Err(Place::Variable(name.to_owned()).fault(Problem::new(what, NAME)));
    }
    // A single number is no adjacency.
    let is_adjacency = |v: &&Variable| v.is_square() && v.dimensions[0] > 1;
    let squares: Vec<_> = variables.iter().filter(is_adjacency).collect();
    match squares[..] {
        [variable] => Ok(variable),
        [] => {
            let what = format!("there is no square matrix; the file holds {present}");
            let remedy = "save the adjacency matrix, or write pairs as text, one a line";
            Err(Problem::new(what, remedy).into())
        }
        _ => {
            let count = squares.len();
            let what =
                format!("no variable A and {count} square matrices; the file holds {present}");
            Err(Problem::new(what, NAME).into())
        }
    }
}

#[cfg(test)]
mod tests;
