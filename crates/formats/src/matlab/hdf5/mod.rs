//! MATLAB 7.3 files, which are HDF5, and other HDF5 files with a matrix at their root.
//!
//! A full matrix is a data set of two dimensions. A sparse one is a group with the data sets `jc`
//! (where each column begins), `ir` (the rows) and `data` (the values; the last two are left out
//! if there are no entries), and with the attribute `MATLAB_sparse`, the number of rows. MATLAB
//! stores columns as HDF5 stores rows, so a matrix of HDF5 is the transpose of that in MATLAB.
//!
//! The bytes of HDF5 are read by another crate; what a file promises is bounded here, before it is
//! asked for: no more bytes than deflating could have made of the file.

use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Attribute, ByteOrder, Dataset, Hdf5File, OpenOptions};

use super::{RealArray, malformed};
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::matrix::{List, Matrix, Places, are_pairs};
use crate::read_as::Parsed;
use crate::variables::{Candidate, choose};

/// Deflated data can hold at most so many times their own length.
const RATIO: usize = 1032;
/// The most bytes of one variable that are read: a full matrix of 32,768 rows of doubles.
const LIMIT: usize = 8 << 30;
/// The most bytes that the dimensions of an empty array take.
const EMPTY_LIMIT: usize = 4096;
/// The longest list of what lies at the root that is looked at.
const MEMBERS_LIMIT: usize = 10_000;

/// A variable: what it is, and where its numbers are.
struct Variable {
    name: String,
    /// What MATLAB or HDF5 calls it.
    class: String,
    /// Rows and columns, or other dimensions.
    shape: Vec<u64>,
    /// Whether MATLAB wrote it, so that its dimensions are in the opposite order in HDF5.
    by_matlab: bool,
    content: Content,
}

enum Content {
    Full(Box<Dataset>),
    /// `jc`, and `ir` and `data` if there are entries.
    Sparse(Box<(Dataset, Option<(Dataset, Dataset)>)>),
    Complex,
    /// An array without entries.
    Empty,
    /// No numbers.
    Other,
}

impl Candidate for Variable {
    fn name(&self) -> &str {
        &self.name
    }

    fn describe(&self) -> String {
        format!("{} ({} {})", self.name, self.shape_text(), self.class)
    }

    fn numeric_shape(&self) -> Option<[u64; 2]> {
        match self.shape[..] {
            [rows, columns] if !matches!(self.content, Content::Other) => Some([rows, columns]),
            _ => None,
        }
    }
}

impl Variable {
    fn shape_text(&self) -> String {
        let dimensions: Vec<String> = self.shape.iter().map(u64::to_string).collect();
        dimensions.join("x")
    }

    fn square(&self) -> Result<u32, Problem> {
        match self.shape[..] {
            [rows, columns] if rows == columns && rows <= i32::MAX as u64 => Ok(rows as u32),
            _ => Err(Problem::NotSquare(self.shape_text())),
        }
    }

    fn graph(&self, most: usize, options: &ListOptions) -> Result<Parsed, Problem> {
        if let Content::Full(dataset) = &self.content
            && let Some(shape) = self.numeric_shape().filter(|&shape| are_pairs(shape))
        {
            let numbers = Numbers::read(dataset, most)?;
            let mut list = List::new(shape, options);
            self.each_entry(&numbers, shape, |fast, slow, value| {
                if self.by_matlab {
                    list.entry(fast, slow, value)
                } else {
                    list.entry(slow, fast, value)
                }
            })?;
            return list.graph();
        }
        let size = match self.content {
            Content::Other => return Err(Problem::NotNumericNamed(self.class.clone())),
            Content::Complex => return Err(Problem::Complex),
            _ => self.square()?,
        };
        self.matrix(size, most, options)?.graph()
    }

    /// Calls `entry` with the entries of a full matrix that are not zero, in the order in which they
    /// are stored: with the index that changes from each to the next, and the other one.
    fn each_entry(
        &self,
        numbers: &Numbers,
        [rows, columns]: [u64; 2],
        mut entry: impl FnMut(u32, u32, f64) -> Result<(), Problem>,
    ) -> Result<(), Problem> {
        if rows.checked_mul(columns) != Some(numbers.count() as u64) {
            return Err(malformed("a matrix without all of its entries"));
        }
        let [fast, slow] = if self.by_matlab {
            [rows, columns]
        } else {
            [columns, rows]
        };
        let [fast, slow] = [fast, slow].map(u32::try_from);
        let (Ok(fast), Ok(slow)) = (fast, slow) else {
            return Err(Problem::TooManyNodes);
        };
        let places = (0..slow).flat_map(|slow| (0..fast).map(move |fast| (fast, slow)));
        for (value, (fast, slow)) in numbers.values().zip(places) {
            if value != 0.0 {
                entry(fast, slow, value)?;
            }
        }
        Ok(())
    }

    fn matrix<'o>(
        &self,
        size: u32,
        most: usize,
        options: &'o ListOptions,
    ) -> Result<Matrix<'o>, Problem> {
        let places = Places {
            first: 1,
            transposed: !self.by_matlab,
        };
        let mut matrix = Matrix::new(size, places, options);
        match &self.content {
            Content::Other | Content::Complex | Content::Empty => {}
            Content::Full(dataset) => {
                let numbers = Numbers::read(dataset, most)?;
                let shape = [u64::from(size); 2];
                self.each_entry(&numbers, shape, |row, column, value| {
                    matrix.entry(row, column, value)
                })?;
            }
            Content::Sparse(parts) => {
                let (starts, entries) = &**parts;
                let starts = indices(starts, most)?;
                let (rows, values) = match entries {
                    None => (Vec::new(), Vec::new()),
                    Some((rows, values)) => {
                        let values = Numbers::read(values, most)?;
                        (indices(rows, most)?, values.values().collect())
                    }
                };
                let given = starts.last().copied().unwrap_or_default() as usize;
                if starts.len() as u64 != u64::from(size) + 1
                    || starts[0] != 0
                    || !starts.is_sorted()
                    || given > rows.len()
                    || given > values.len()
                {
                    return Err(malformed("the column starts of a sparse matrix"));
                }
                for (ends, column) in starts.windows(2).zip(0..) {
                    let place = ends[0] as usize..ends[1] as usize;
                    let rows = &rows[place.clone()];
                    let increasing = rows.is_sorted_by(|a, b| a < b);
                    if !increasing || rows.last().is_some_and(|&row| row >= size) {
                        return Err(malformed("the row numbers of a sparse matrix"));
                    }
                    for (&row, &value) in rows.iter().zip(&values[place]) {
                        matrix.entry(row, column, value)?;
                    }
                }
            }
        }
        Ok(matrix)
    }
}

/// The name of the variable that is meant, and its graph or what is wrong with it.
///
/// # Errors
/// As [`super::read`].
pub(super) fn read(
    bytes: &[u8],
    variable: Option<&str>,
    options: &ListOptions,
) -> Result<(String, Result<Parsed, Problem>), Fault> {
    let most = bytes.len().saturating_mul(RATIO).min(LIMIT);
    let variables = variables(bytes, most).map_err(|problem| Place::Input.fault(problem))?;
    let chosen = choose(&variables, variable)?;
    Ok((chosen.name.clone(), chosen.graph(most, options)))
}

/// The full arrays of real numbers that MATLAB wrote and whose shape is asked for: the first index changes
/// fastest, as in files of version 5.
///
/// # Errors
/// A damaged file; an integer of 2^53 or beyond, which is not read exactly.
pub(super) fn real_arrays(
    bytes: &[u8],
    is_wanted: &dyn Fn(&[u32]) -> bool,
) -> Result<Vec<RealArray>, Problem> {
    let most = bytes.len().saturating_mul(RATIO).min(LIMIT);
    let mut all = Vec::new();
    for variable in variables(bytes, most)? {
        let shape = variable.shape.iter().map(|&count| u32::try_from(count));
        let Ok(shape) = shape.collect::<Result<Vec<u32>, _>>() else {
            continue;
        };
        let Content::Full(dataset) = &variable.content else {
            continue;
        };
        if !variable.by_matlab || !is_wanted(&shape) {
            continue;
        }
        let numbers: Vec<f64> = Numbers::read(dataset, most)?.values().collect();
        let is_integer = !matches!(dataset.dtype(), Datatype::FloatingPoint { .. });
        // 2^53 + 1 is 2^53 by now.
        if is_integer && numbers.iter().any(|x| x.abs() >= 9_007_199_254_740_992.0) {
            return Err(malformed("an integer of 2^53 or beyond"));
        }
        let entries = variable.shape.iter().product::<u64>();
        if numbers.len() as u64 != entries {
            return Err(malformed("an array without all of its entries"));
        }
        all.push((variable.name, shape, numbers));
    }
    Ok(all)
}

fn damaged(error: hdf5_reader::error::Error) -> Problem {
    Problem::Hdf5(error.to_string())
}

/// All variables at the root; MATLAB's own groups (`#refs#`) are none.
fn variables(bytes: &[u8], most: usize) -> Result<Vec<Variable>, Problem> {
    let options = OpenOptions::default()
        .with_max_read_bytes(most)
        .with_max_chunk_bytes(most);
    let file = Hdf5File::from_bytes_with_options(bytes, options).map_err(damaged)?;
    let promised = file.superblock().eof_address;
    if promised != u64::MAX && promised > bytes.len() as u64 {
        let found = bytes.len();
        let what = format!("{promised} bytes are promised, and {found} are there");
        return Err(Problem::Truncated(what));
    }
    let (groups, datasets) = file
        .root_group()
        .and_then(|root| root.members())
        .map_err(damaged)?;
    if groups.len() + datasets.len() > MEMBERS_LIMIT {
        return Err(malformed("more variables than any program writes"));
    }
    let mut variables = Vec::new();
    for group in groups.iter().filter(|group| !group.name().starts_with('#')) {
        let attributes = group.attributes().map_err(damaged)?;
        let class = text(&attributes, "MATLAB_class");
        let by_matlab = class.is_some();
        let members = group.datasets().map_err(damaged)?;
        let member = |name: &str| members.iter().find(|one| one.name() == name).cloned();
        let rows = number(&attributes, "MATLAB_sparse");
        let (shape, content) = match (rows, member("jc"), member("ir").zip(member("data"))) {
            (Some(_), Some(starts), entries) | (None, Some(starts), entries @ Some(_)) => {
                let columns = starts.num_elements().map_err(damaged)?.saturating_sub(1);
                // Without the attribute nothing says that it is not square.
                let rows = rows.unwrap_or(columns);
                (
                    vec![rows, columns],
                    Content::Sparse(Box::new((starts, entries))),
                )
            }
            _ => (vec![1, 1], Content::Other),
        };
        let sparse = matches!(content, Content::Sparse(..));
        variables.push(Variable {
            name: group.name().to_owned(),
            class: match class {
                _ if sparse => "sparse".to_owned(),
                Some(class) => class,
                None => "group".to_owned(),
            },
            shape,
            by_matlab,
            content,
        });
    }
    for dataset in datasets {
        if !dataset.name().starts_with('#') {
            variables.push(full(dataset)?);
        }
    }
    variables.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(variables)
}

/// A variable that is one data set.
fn full(dataset: Dataset) -> Result<Variable, Problem> {
    let attributes = dataset.attributes();
    let class = text(&attributes, "MATLAB_class");
    let by_matlab = class.is_some();
    let mut shape = dataset.shape().to_vec();
    if by_matlab {
        shape.reverse();
    }
    let numeric = class.as_deref().is_none_or(|class| {
        let integers = [
            "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64",
        ];
        ["double", "single", "logical"].contains(&class) || integers.contains(&class)
    });
    let empty = number(&attributes, "MATLAB_empty").is_some_and(|value| value != 0);
    let (kind, content) = match dataset.dtype() {
        _ if !numeric => ("array", Content::Other),
        Datatype::Compound { fields, .. } if is_complex(fields.iter().map(|f| &*f.name)) => {
            ("complex", Content::Complex)
        }
        Datatype::FixedPoint { .. } => ("integers", Content::Full(Box::new(dataset.clone()))),
        Datatype::FloatingPoint { .. } => ("numbers", Content::Full(Box::new(dataset.clone()))),
        // Truth values of NumPy.
        Datatype::Enum { .. } => ("enumeration", Content::Full(Box::new(dataset.clone()))),
        _ => ("data set", Content::Other),
    };
    let content = match content {
        // An empty array has its dimensions in place of its entries.
        Content::Full(dataset) if empty => {
            let dimensions = Numbers::read(&dataset, EMPTY_LIMIT)?;
            shape = dimensions.values().map(|value| value as u64).collect();
            Content::Empty
        }
        other => other,
    };
    Ok(Variable {
        name: dataset.name().to_owned(),
        class: class.unwrap_or_else(|| kind.to_owned()),
        shape,
        by_matlab,
        content,
    })
}

fn is_complex<'n>(fields: impl Iterator<Item = &'n str>) -> bool {
    let names: Vec<&str> = fields.collect();
    matches!(names[..], ["real", "imag"] | ["r", "i"])
}

/// An attribute that is a text.
fn text(attributes: &[Attribute], name: &str) -> Option<String> {
    let attribute = attributes.iter().find(|one| one.name == name)?;
    attribute.read_string().ok()
}

/// An attribute that is a natural number.
fn number(attributes: &[Attribute], name: &str) -> Option<u64> {
    let attribute = attributes.iter().find(|one| one.name == name)?;
    let value = attribute.read_as_f64().ok()?;
    (value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u64)
}

/// The numbers of a data set, not yet decoded.
struct Numbers {
    bytes: Vec<u8>,
    size: usize,
    decode: fn(&[u8]) -> f64,
}

/// Decodes numbers of one type in both orders of bytes.
macro_rules! decoder {
    ($order:expr, $number:ty) => {
        match $order {
            ByteOrder::LittleEndian => |bytes: &[u8]| {
                let bytes = bytes.first_chunk().copied().unwrap_or_default();
                <$number>::from_le_bytes(bytes) as f64
            },
            ByteOrder::BigEndian => |bytes: &[u8]| {
                let bytes = bytes.first_chunk().copied().unwrap_or_default();
                <$number>::from_be_bytes(bytes) as f64
            },
        }
    };
}

impl Numbers {
    fn read(dataset: &Dataset, most: usize) -> Result<Self, Problem> {
        let mut kind = dataset.dtype();
        if let Datatype::Enum { base, .. } = kind {
            kind = base;
        }
        let (size, decode): (usize, fn(&[u8]) -> f64) = match *kind {
            Datatype::FixedPoint {
                size,
                signed,
                byte_order,
            } => match (size, signed) {
                (1, true) => (1, decoder!(byte_order, i8)),
                (1, false) => (1, decoder!(byte_order, u8)),
                (2, true) => (2, decoder!(byte_order, i16)),
                (2, false) => (2, decoder!(byte_order, u16)),
                (4, true) => (4, decoder!(byte_order, i32)),
                (4, false) => (4, decoder!(byte_order, u32)),
                (8, true) => (8, decoder!(byte_order, i64)),
                (8, false) => (8, decoder!(byte_order, u64)),
                _ => return Err(Problem::NotNumericNamed(format!("integer of {size} bytes"))),
            },
            Datatype::FloatingPoint {
                size, byte_order, ..
            } => match size {
                4 => (4, decoder!(byte_order, f32)),
                8 => (8, decoder!(byte_order, f64)),
                _ => return Err(Problem::NotNumericNamed(format!("number of {size} bytes"))),
            },
            _ => return Err(Problem::NotNumericNamed("data set".to_owned())),
        };
        let length = dataset.raw_byte_len().map_err(damaged)?;
        if length > most {
            return Err(malformed("a matrix larger than the file can hold"));
        }
        let bytes = dataset.read_raw_bytes().map_err(damaged)?;
        Ok(Self {
            bytes,
            size,
            decode,
        })
    }

    fn count(&self) -> usize {
        self.bytes.len() / self.size
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        self.bytes.chunks_exact(self.size).map(self.decode)
    }
}

/// The indices of a sparse matrix.
fn indices(dataset: &Dataset, most: usize) -> Result<Vec<u32>, Problem> {
    let numbers = Numbers::read(dataset, most)?;
    numbers
        .values()
        .map(|value| {
            let index = value as u32;
            if f64::from(index) == value && index <= i32::MAX as u32 {
                Ok(index)
            } else {
                Err(malformed("an index of a sparse matrix is out of range"))
            }
        })
        .collect()
}

#[cfg(test)]
mod tests;
