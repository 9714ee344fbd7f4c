//! `.npz`: arrays by name in a ZIP archive, or one sparse matrix of SciPy.

use std::io::Read;

use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive, ZipSliceArchive};

use super::header::{Element, Header};
use super::{damaged, graph, malformed, numbers};
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::inflate::Inflated;
use crate::matrix::{Matrix, Places};
use crate::read_as::Parsed;
use crate::variables::{Candidate, choose, chosen_note};

/// What ZIP archives begin with.
pub(in super::super) const MAGIC: &[u8] = b"PK\x03\x04";
/// The longest list of files that is looked at.
const MEMBERS_LIMIT: usize = 10_000;
/// The most rows of the blocks of a sparse matrix.
const SIDE_LIMIT: u64 = 1 << 10;

/// Whether a ZIP archive that begins like this holds arrays.
pub(in super::super) fn is_archive(head: &[u8]) -> bool {
    // The first file of an archive has its name behind 30 bytes.
    let length = head
        .get(26..28)
        .map(|two| u16::from_le_bytes([two[0], two[1]]));
    let name = length.and_then(|length| head.get(30..30 + usize::from(length)));
    head.starts_with(MAGIC) && name.is_some_and(|name| name.ends_with(b".npy"))
}

/// An array of an archive.
struct Array<'a> {
    name: String,
    header: Header,
    /// Its file, and whether that is deflated.
    entry: rawzip::ZipSliceEntry<'a>,
    deflated: bool,
}

impl Candidate for Array<'_> {
    fn name(&self) -> &str {
        &self.name
    }

    fn describe(&self) -> String {
        let (shape, class) = (self.header.shape_text(), self.header.class());
        if shape.is_empty() {
            return format!("{} ({class})", self.name);
        }
        format!("{} ({shape} {class})", self.name)
    }

    fn numeric_shape(&self) -> Option<[u64; 2]> {
        match (&self.header.element, &self.header.shape[..]) {
            (Element::Number(..), &[rows, columns]) => Some([rows, columns]),
            // Two columns of names are pairs as well.
            (Element::Bytes(_) | Element::Characters(..), &[rows, 2]) if rows != 2 => {
                Some([rows, 2])
            }
            _ => None,
        }
    }
}

fn zip(error: &rawzip::Error) -> Problem {
    Problem::Corrupt(format!("the ZIP archive: {error}"))
}

/// The bytes of a file, which are checked where they end.
fn unpacked<'a>(entry: &rawzip::ZipSliceEntry<'a>, deflated: bool) -> Box<dyn Read + 'a> {
    let data = entry.data();
    if deflated {
        Box::new(entry.verifying_reader(DeflateDecoder::new(data)))
    } else {
        Box::new(entry.verifying_reader(data))
    }
}

impl Array<'_> {
    /// Gives the entries to `take`, after which nothing may follow.
    fn read<T>(
        &self,
        take: impl FnOnce(&Header, &mut dyn Read) -> Result<T, Problem>,
    ) -> Result<T, Problem> {
        let mut bytes = unpacked(&self.entry, self.deflated);
        let header = Header::read(&mut bytes)?;
        let taken = take(&header, &mut bytes)?;
        match bytes.read(&mut [0]).map_err(damaged)? {
            0 => Ok(taken),
            _ => Err(malformed("bytes follow an array")),
        }
    }

    /// All numbers, which are kept.
    fn numbers(&self) -> Result<Vec<f64>, Problem> {
        let compressed = self.entry.data().len() as u64;
        self.read(|header, input| {
            let mut all = Vec::new();
            numbers::each(header, input, |value| {
                if all.len().is_power_of_two() {
                    Inflated::check(8 * all.len() as u64, compressed)?;
                }
                all.push(value);
                Ok(())
            })?;
            Ok(all)
        })
    }

    fn indices(&self) -> Result<Vec<u32>, Problem> {
        let index = |value: f64| {
            let index = value as u32;
            (f64::from(index) == value)
                .then_some(index)
                .ok_or_else(|| malformed("an index of a sparse matrix is out of range"))
        };
        self.numbers()?.into_iter().map(index).collect()
    }
}

/// The graph of an array in an `.npz` file: of the array named, else of the sparse matrix that it
/// holds, else of `A`, of the only square matrix, or of the only two columns of pairs.
/// O(bytes + m log m).
///
/// # Errors
/// As [`super::read`]; no such array, or no way to choose one.
pub fn read_archive(bytes: &[u8], variable: Option<&str>) -> Result<Parsed, Fault> {
    read_archive_with(bytes, variable, &ListOptions::default())
}

/// The same with the options of whoever asks.
pub(in super::super) fn read_archive_with(
    bytes: &[u8],
    variable: Option<&str>,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let fault = |problem| Place::Input.fault(problem);
    let archive = ZipArchive::from_slice(bytes).map_err(|error| fault(zip(&error)))?;
    let arrays = arrays(&archive).map_err(fault)?;
    let named = |name: &str| arrays.iter().find(|array| array.name == name);
    if variable.is_none()
        && let (Some(format), Some(shape), Some(data)) =
            (named("format"), named("shape"), named("data"))
    {
        let sparse = Sparse {
            format,
            shape,
            data,
            named: &named,
        };
        return sparse.graph(options).map_err(fault);
    }
    let chosen = choose(&arrays, variable)?;
    match chosen.read(|header, input| graph(header, input, options)) {
        Ok(mut parsed) => {
            if variable.is_none() && arrays.len() > 1 && chosen.name != "A" {
                parsed.notes.insert(0, chosen_note(&chosen.name));
            }
            parsed.read.format = "NumPy archive".into();
            Ok(parsed)
        }
        Err(problem) => Err(Place::Variable(chosen.name.clone()).fault(problem)),
    }
}

/// What an array of an archive holds, read.
pub(crate) enum Held {
    /// Real numbers, rows first, and their shape.
    Numbers(Vec<u64>, Vec<f64>),
    /// One text after another.
    Texts(Vec<String>),
}

/// The arrays of an archive with their names: those of one dimension that hold texts, and those of real numbers whose shape
/// is asked for. O(bytes).
///
/// # Errors
/// A file that is truncated or corrupt; columns first; integers beyond 2^53.
pub(crate) fn held(
    bytes: &[u8],
    is_wanted: impl Fn(&[u64]) -> bool,
) -> Result<Vec<(String, Held)>, Problem> {
    let archive = ZipArchive::from_slice(bytes).map_err(|error| zip(&error))?;
    let mut all = Vec::new();
    for array in arrays(&archive)? {
        let shape = array.header.shape.clone();
        let held = match array.header.element {
            Element::Bytes(_) | Element::Characters(..) if shape.len() == 1 => {
                let mut texts = Vec::new();
                array.read(|header, input| {
                    numbers::each_text(header, input, |text| texts.push(text))
                })?;
                Held::Texts(texts)
            }
            Element::Number(..) if is_wanted(&shape) => {
                let numbers = array.numbers()?;
                super::check_real(&array.header, &numbers)?;
                Held::Numbers(shape, numbers)
            }
            _ => continue,
        };
        all.push((array.name, held));
    }
    Ok(all)
}

/// All arrays of an archive; only their headers are read.
fn arrays<'a>(archive: &'a ZipSliceArchive<&'a [u8]>) -> Result<Vec<Array<'a>>, Problem> {
    let mut arrays: Vec<Array> = Vec::new();
    let mut entries = archive.entries();
    let mut count = 0;
    while let Some(record) = entries.next_entry().map_err(|error| zip(&error))? {
        count += 1;
        if count > MEMBERS_LIMIT {
            return Err(malformed("more files than any program writes"));
        }
        let path = String::from_utf8_lossy(record.file_path().as_bytes()).into_owned();
        let Some(name) = path.strip_suffix(".npy") else {
            continue;
        };
        let deflated = match record.compression_method() {
            CompressionMethod::STORE => false,
            CompressionMethod::DEFLATE => true,
            _ => {
                return Err(Problem::Foreign {
                    what: "a ZIP archive with a compression that NumPy does not write",
                    advice: "write it again with numpy.savez_compressed",
                });
            }
        };
        let entry = archive.get_entry(record.wayfinder());
        let entry = entry.map_err(|error| zip(&error))?;
        if arrays.iter().any(|other| other.name == name) {
            return Err(malformed("there are two arrays of one name"));
        }
        arrays.push(Array {
            name: name.to_owned(),
            header: Header::read(unpacked(&entry, deflated))?,
            entry,
            deflated,
        });
    }
    Ok(arrays)
}

/// A sparse matrix of SciPy.
struct Sparse<'s, 'a, F> {
    format: &'s Array<'a>,
    shape: &'s Array<'a>,
    data: &'s Array<'a>,
    named: &'s F,
}

impl<'s, 'a, F: Fn(&str) -> Option<&'s Array<'a>>> Sparse<'s, 'a, F> {
    fn part(&self, name: &str) -> Result<&'s Array<'a>, Problem> {
        let missing = || Problem::Corrupt(format!("a sparse matrix without its array `{name}`"));
        (self.named)(name).ok_or_else(missing)
    }

    fn graph(&self, options: &ListOptions) -> Result<Parsed, Problem> {
        let mut format = String::new();
        self.format
            .read(|header, input| numbers::each_text(header, input, |text| format += &text))?;
        let shape = self.shape.indices()?;
        let &[rows, columns] = &shape[..] else {
            return Err(malformed("a sparse matrix that has not two dimensions"));
        };
        if rows != columns {
            return Err(Problem::NotSquare(format!("{rows}x{columns}")));
        }
        if self.data.header.element == Element::Complex {
            return Err(Problem::Complex);
        }
        let values = self.data.numbers()?;
        let mut places = Vec::new();
        match &*format {
            // Rows and columns are exchanged, which changes nothing but what errors say.
            "csr" | "csc" | "bsr" => {
                let side = self.side(&format, rows)?;
                let starts = self.part("indptr")?.indices()?;
                let indices = self.part("indices")?.indices()?;
                let lines = rows / side;
                if starts.len() as u64 != u64::from(lines) + 1
                    || starts[0] != 0
                    || !starts.is_sorted()
                    || *starts.last().unwrap_or(&0) as usize != indices.len()
                    || indices.len() as u64 * u64::from(side) * u64::from(side)
                        != values.len() as u64
                    || indices.iter().any(|&index| index >= lines)
                {
                    return Err(malformed("the indices of a sparse matrix"));
                }
                for (line, ends) in (0..lines).zip(starts.windows(2)) {
                    for &index in &indices[ends[0] as usize..ends[1] as usize] {
                        let within = (0..side).flat_map(|r| (0..side).map(move |c| (r, c)));
                        places.extend(within.map(|(r, c)| (index * side + c, line * side + r)));
                    }
                }
            }
            "coo" => {
                let (row, column) = (self.part("row")?.indices()?, self.part("col")?.indices()?);
                let outside = row.iter().chain(&column).any(|&index| index >= rows);
                if row.len() != column.len() || row.len() != values.len() || outside {
                    return Err(malformed("the indices of a sparse matrix"));
                }
                places.extend(column.into_iter().zip(row));
            }
            _ => {
                return Err(Problem::Foreign {
                    what: "a sparse matrix of SciPy that is stored by diagonals",
                    advice: "save it by rows: scipy.sparse.save_npz(name, matrix.tocsr())",
                });
            }
        }
        let order = Places {
            first: 0,
            transposed: format != "csc",
        };
        let (matrix, again) = Matrix::of_entries(rows, order, &places, |at| values[at], options)?;
        let mut parsed = matrix.graph()?;
        parsed.read.format = "sparse matrix of SciPy".into();
        parsed.read.merged = again;
        parsed.notes.extend(crate::merged(again));
        Ok(parsed)
    }

    /// How many rows the blocks have of which the matrix consists.
    fn side(&self, format: &str, rows: u32) -> Result<u32, Problem> {
        match (format, &self.data.header.shape[..]) {
            ("bsr", &[_, side, other])
                if side == other
                    && (1..=SIDE_LIMIT).contains(&side)
                    && !self.data.header.fortran =>
            {
                let side = side as u32;
                let whole = rows.is_multiple_of(side);
                whole
                    .then_some(side)
                    .ok_or_else(|| malformed("the blocks of a sparse matrix"))
            }
            ("bsr", _) => Err(malformed("the blocks of a sparse matrix")),
            _ => Ok(1),
        }
    }
}
