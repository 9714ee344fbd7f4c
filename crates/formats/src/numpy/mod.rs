//! Arrays of NumPy: `.npy`, and `.npz`, which is a ZIP archive of such files.
//!
//! Format by NumPy, `numpy.lib.format`: eight bytes, the length of a header, the header, and the
//! entries as they lie in memory, in either order of bytes. An archive of SciPy's `save_npz` holds
//! the parts of one sparse matrix.
//!
//! A square matrix is an adjacency (`matrix`); two columns, or two rows, of integers
//! or of names are pairs. Nodes of a matrix are numbered as rows, from 0.
//!
//! No length in a file is believed before the bytes are there: memory grows with what has been read.

use std::io::{Cursor, Read};

use crate::documents::Collected;
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::matrix::{List, Matrix, Places, are_pairs};
use crate::read_as::Parsed;

mod archive;
mod header;
mod numbers;

use header::{Element, Header};

pub use archive::read_archive;
pub(super) use archive::read_archive_with;
pub(crate) use archive::{Held, held};
pub(super) use archive::{MAGIC as ARCHIVE_MAGIC, is_archive};
pub(super) use header::MAGIC;

fn malformed(what: &str) -> Problem {
    Problem::Corrupt(what.to_owned())
}

/// A failure to read an array; in memory there is none but that its bytes end, or are wrong.
fn damaged(error: std::io::Error) -> Problem {
    if error.kind() == std::io::ErrorKind::UnexpectedEof {
        return Problem::Truncated("the entries of an array end early".to_owned());
    }
    Problem::Corrupt(format!("the entries of an array: {error}"))
}

/// The graph of an array in an `.npy` file. O(bytes + m log m).
///
/// # Errors
/// An array that is no square symmetric matrix of real numbers with a zero diagonal, and not two
/// columns of integers or names; a file that is truncated or corrupt.
pub fn read(bytes: &[u8]) -> Result<Parsed, Fault> {
    read_with(bytes, &ListOptions::default())
}

/// The shape of an array of real numbers in an `.npy` file, and its numbers, rows first. O(bytes).
///
/// # Errors
/// Something else; integers beyond 2^53.
pub(crate) fn real_numbers(bytes: &[u8]) -> Result<(Vec<u64>, Vec<f64>), Problem> {
    let mut input = Cursor::new(bytes);
    let header = Header::read(&mut input)?;
    let mut numbers = Vec::new();
    numbers::each(&header, &mut input, |number| {
        numbers.push(number);
        Ok(())
    })?;
    check_real(&header, &numbers)?;
    if (input.position() as usize) < bytes.len() {
        return Err(malformed("bytes follow the array"));
    }
    Ok((header.shape, numbers))
}

/// Refuses numbers that are not in their place, or not what was stored.
fn check_real(header: &Header, numbers: &[f64]) -> Result<(), Problem> {
    if header.fortran && header.shape.len() > 1 {
        return Err(malformed(
            "an array with its columns first (save numpy.ascontiguousarray of it)",
        ));
    }
    let is_long = matches!(header.element, Element::Number(b'i' | b'u', 8, _));
    let is_beyond = |number: &f64| number.abs() > 9_007_199_254_740_992.0;
    match is_long && numbers.iter().any(is_beyond) {
        true => Err(malformed("an integer beyond 2^53")),
        false => Ok(()),
    }
}

/// The same with the options of whoever asks.
pub(super) fn read_with(bytes: &[u8], options: &ListOptions) -> Result<Parsed, Fault> {
    let fault = |problem| Place::Input.fault(problem);
    let mut input = Cursor::new(bytes);
    let header = Header::read(&mut input).map_err(fault)?;
    let mut parsed = graph(&header, &mut input, options).map_err(fault)?;
    parsed.read.format = "NumPy array".into();
    let rest = &bytes[input.position() as usize..];
    if rest.starts_with(MAGIC) {
        return Err(fault(Problem::Foreign {
            what: "a file of several NumPy arrays",
            advice: "save the one that is meant alone: numpy.save(name, array)",
        }));
    }
    if !rest.is_empty() {
        return Err(fault(malformed("bytes follow the array")));
    }
    Ok(parsed)
}

/// The graph of an array whose entries follow.
fn graph(header: &Header, input: &mut dyn Read, options: &ListOptions) -> Result<Parsed, Problem> {
    match (&header.element, &header.shape[..]) {
        (Element::Complex, _) => Err(Problem::Complex),
        (Element::Objects, _) => Err(Problem::Foreign {
            what: "a NumPy array of Python objects (a pickle)",
            advice: "save numbers: numpy.save(name, networkx.to_numpy_array(graph)), or \
                     numpy.save(name, array.astype(int))",
        }),
        (Element::Other(name), _) => {
            Err(Problem::NotNumericNamed(format!("NumPy array of {name}")))
        }
        (Element::Bytes(_) | Element::Characters(..), &[rows, 2]) => {
            names(header, rows, input, options)
        }
        (Element::Bytes(_) | Element::Characters(..), _) => {
            Err(Problem::NotNumericNamed("NumPy array of text".to_owned()))
        }
        (Element::Number(..), &[rows, columns]) if rows == columns => {
            let size = u32::try_from(rows).map_err(|_| Problem::TooManyNodes)?;
            let places = Places {
                first: 0,
                transposed: !header.fortran,
            };
            let mut matrix = Matrix::new(size, places, options);
            // By columns, as they come: those of the file, or its rows.
            each_entry(header, input, |fast, slow, value| {
                matrix.entry(fast, slow, value)
            })?;
            matrix.graph()
        }
        // Two rows of many are how graph libraries of Python keep edges.
        (Element::Number(..), &[rows, columns])
            if are_pairs([rows, columns]) || are_pairs([columns, rows]) =>
        {
            let mut list = List::new([rows, columns], options);
            each_entry(header, input, |fast, slow, value| {
                if header.fortran {
                    list.entry(fast, slow, value)
                } else {
                    list.entry(slow, fast, value)
                }
            })?;
            list.graph()
        }
        (Element::Number(..), _) => Err(Problem::NoMatrixShape(header.shape_text())),
    }
}

/// Calls `entry` with the entries of a matrix that are not zero, in the order in which they are
/// stored: with the index that changes from each to the next, and the other one.
fn each_entry(
    header: &Header,
    input: &mut dyn Read,
    mut entry: impl FnMut(u32, u32, f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let along = header.shape[if header.fortran { 0 } else { 1 }];
    let (mut fast, mut slow) = (0u64, 0u64);
    numbers::each(header, input, |value| {
        if value != 0.0 {
            let (Ok(fast), Ok(slow)) = (u32::try_from(fast), u32::try_from(slow)) else {
                return Err(Problem::TooManyNodes);
            };
            entry(fast, slow, value)?;
        }
        fast += 1;
        if fast == along {
            (fast, slow) = (0, slow + 1);
        }
        Ok(())
    })
}

/// The graph of two columns of names.
fn names(
    header: &Header,
    rows: u64,
    input: &mut dyn Read,
    options: &ListOptions,
) -> Result<Parsed, Problem> {
    let mut all = Vec::new();
    numbers::each_text(header, input, |name| all.push(name))?;
    let mut collected = Collected::new(options);
    let count = rows as usize;
    for row in 0..count {
        let [a, b] = if header.fortran {
            [row, count + row]
        } else {
            [2 * row, 2 * row + 1]
        };
        let (a, b) = (collected.node(&all[a])?, collected.node(&all[b])?);
        collected.pair(a, b)?;
    }
    let note = "the rows are pairs: two names of cameras each";
    collected.notes.push(note.to_owned());
    collected.finish().map_err(|fault| fault.problem)
}

#[cfg(test)]
mod tests;
