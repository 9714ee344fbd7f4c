//! Matrices: what a variable is, and the entries of a numeric one.

use crate::error::Problem;
use crate::matlab::ByteOrder;
use crate::matlab::element::{Source, Tag, malformed};

const SPARSE: u8 = 5;
const OPAQUE: u8 = 17;
const COMPLEX: u32 = 0x800;
const LOGICAL: u32 = 0x200;

/// MATLAB's own limit for a name is 63 characters.
const NAME_LIMIT: u64 = 4096;
const DIMENSIONS_LIMIT: u64 = 4096;

/// What MATLAB calls a class, and whether its variables are numeric matrices.
fn class_name(class: u8) -> Option<(&'static str, bool)> {
    const CLASSES: [(&str, bool); 17] = [
        ("cell array", false),
        ("structure", false),
        ("object", false),
        ("character array", false),
        ("sparse", true),
        ("double", true),
        ("single", true),
        ("int8", true),
        ("uint8", true),
        ("int16", true),
        ("uint16", true),
        ("int32", true),
        ("uint32", true),
        ("int64", true),
        ("uint64", true),
        ("function handle", false),
        ("opaque object", false),
    ];
    CLASSES.get(usize::from(class).checked_sub(1)?).copied()
}

/// Name, class and shape of a variable.
pub(super) struct Header {
    pub(super) name: String,
    class: u8,
    flags: u32,
    /// Empty for opaque objects.
    dimensions: Vec<u32>,
}

impl Header {
    pub(super) fn read(source: &mut Source) -> Result<Self, Problem> {
        let order = source.order;
        let numbers = |bytes: Vec<u8>| -> Vec<u32> {
            let (words, _) = bytes.as_chunks();
            words.iter().map(|&word| order.u32(word)).collect()
        };
        let tag = source.tag()?;
        let [flags, _] = numbers(source.bytes(&tag, 8)?)[..] else {
            return Err(malformed("the flags of a variable are not two integers"));
        };
        let class = flags as u8;
        if class_name(class).is_none() {
            return Err(Problem::Corrupt(format!("a variable of class {class}")));
        }
        let mut dimensions = Vec::new();
        if class != OPAQUE {
            let tag = source.tag()?;
            dimensions = numbers(source.bytes(&tag, DIMENSIONS_LIMIT)?);
            if dimensions.len() < 2 || dimensions.iter().any(|&d| d > i32::MAX as u32) {
                return Err(malformed("a variable without proper dimensions"));
            }
        }
        let tag = source.tag()?;
        let name = String::from_utf8_lossy(&source.bytes(&tag, NAME_LIMIT)?).into_owned();
        Ok(Self {
            name,
            class,
            flags,
            dimensions,
        })
    }

    fn class_name(&self) -> &'static str {
        match class_name(self.class) {
            Some((_, true)) if self.class != SPARSE && self.flags & LOGICAL != 0 => "logical",
            Some((name, _)) => name,
            None => "unknown class",
        }
    }

    fn shape(&self) -> String {
        let dimensions: Vec<String> = self.dimensions.iter().map(u32::to_string).collect();
        dimensions.join("x")
    }

    /// Name, shape and class, for a list of what a file holds.
    pub(super) fn describe(&self) -> String {
        format!("{} ({} {})", self.name, self.shape(), self.class_name())
    }

    fn is_numeric(&self) -> bool {
        class_name(self.class).is_some_and(|(_, numeric)| numeric)
    }

    /// Rows and columns of a numeric matrix.
    pub(super) fn numeric_shape(&self) -> Option<[u64; 2]> {
        match self.dimensions[..] {
            [rows, columns] if self.is_numeric() => Some([rows.into(), columns.into()]),
            _ => None,
        }
    }

    pub(super) fn is_sparse(&self) -> bool {
        self.class == SPARSE
    }

    /// Rows and columns of a real numeric matrix.
    fn real_matrix(&self) -> Result<[u32; 2], Problem> {
        if !self.is_numeric() {
            return Err(Problem::NotNumeric(self.class_name()));
        }
        if self.flags & COMPLEX != 0 {
            return Err(Problem::Complex);
        }
        match self.dimensions[..] {
            [rows, columns] => Ok([rows, columns]),
            _ => Err(Problem::NotSquare(self.shape())),
        }
    }

    fn square(&self) -> Result<u32, Problem> {
        match self.dimensions[..] {
            [rows, columns] if rows == columns => Ok(rows),
            _ => Err(Problem::NotSquare(self.shape())),
        }
    }

    /// The number of rows of a real square matrix.
    pub(super) fn real_square(&self) -> Result<u32, Problem> {
        self.real_matrix()?;
        self.square()
    }
}

/// Calls `entry` with row, column and value of every non-zero entry of a real
/// matrix, and with zeros that a sparse one stores, column by column with rows increasing; `source` stands behind the
/// header, and is left behind the last value.
pub(super) fn each_entry(
    header: &Header,
    source: &mut Source,
    mut entry: impl FnMut(u32, u32, f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let [rows, columns] = header.real_matrix()?;
    if header.class == SPARSE {
        return each_sparse_entry(rows, columns, source, entry);
    }
    let tag = source.tag()?;
    let expected = u64::from(rows) * u64::from(columns);
    let (mut row, mut column) = (0, 0);
    let mut given = 0;
    each_number(source, &tag, |value| {
        if given == expected {
            return Err(malformed("a matrix has more values than entries"));
        }
        given += 1;
        if value != 0.0 {
            entry(row, column, value)?;
        }
        row += 1;
        if row == rows {
            row = 0;
            column += 1;
        }
        Ok(())
    })?;
    if given != expected {
        return Err(Problem::Corrupt(format!(
            "a matrix of {rows}x{columns} has {given} values"
        )));
    }
    Ok(())
}

fn each_sparse_entry(
    rows: u32,
    columns: u32,
    source: &mut Source,
    mut entry: impl FnMut(u32, u32, f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let tag = source.tag()?;
    let mut row_of: Vec<u32> = Vec::new();
    each_number(source, &tag, |value| {
        row_of.push(index(value)?);
        Ok(())
    })?;
    let tag = source.tag()?;
    let mut starts: Vec<u32> = Vec::new();
    each_number(source, &tag, |value| {
        starts.push(index(value)?);
        Ok(())
    })?;
    if starts.len() as u64 != u64::from(columns) + 1 {
        let found = starts.len();
        return Err(Problem::Corrupt(format!(
            "a sparse matrix of {columns} columns has {found} column starts"
        )));
    }
    let entries = starts[columns as usize];
    if starts[0] != 0 || !starts.is_sorted() || entries as usize > row_of.len() {
        return Err(malformed("the column starts of a sparse matrix"));
    }
    let tag = source.tag()?;
    let (mut at, mut column) = (0, 0);
    let mut least_row = 0;
    each_number(source, &tag, |value| {
        // Room for further entries may follow the last one.
        if at == entries {
            return Ok(());
        }
        while starts[column as usize + 1] == at {
            column += 1;
            least_row = 0;
        }
        let row = row_of[at as usize];
        if row < least_row || row >= rows {
            return Err(malformed("the row numbers of a sparse matrix"));
        }
        at += 1;
        least_row = row + 1;
        entry(row, column, value)
    })?;
    if at != entries {
        return Err(Problem::Corrupt(format!(
            "a sparse matrix of {entries} entries has {at} values"
        )));
    }
    Ok(())
}

/// A number that is an index of a sparse matrix.
fn index(value: f64) -> Result<u32, Problem> {
    let index = value as u32;
    if f64::from(index) == value && index <= i32::MAX as u32 {
        Ok(index)
    } else {
        Err(malformed("an index of a sparse matrix is out of range"))
    }
}

/// Calls `each` with the numbers of an element, whatever their type.
fn each_number(
    source: &mut Source,
    tag: &Tag,
    mut each: impl FnMut(f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let order = source.order;
    macro_rules! numbers {
        ($number:ty) => {{
            const SIZE: usize = size_of::<$number>();
            source.blocks(tag, SIZE, |block| {
                let (numbers, _) = block.as_chunks::<SIZE>();
                for &bytes in numbers {
                    let value = match order {
                        ByteOrder::Little => <$number>::from_le_bytes(bytes),
                        ByteOrder::Big => <$number>::from_be_bytes(bytes),
                    };
                    each(value as f64)?;
                }
                Ok(())
            })
        }};
    }
    match tag.kind {
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
        kind => Err(Problem::Corrupt(format!("numbers of type {kind}"))),
    }
}
