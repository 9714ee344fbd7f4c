//! The fields of a model's files, one after another, whichever way they are written.
//!
//! Binary files are little endian and begin with the number of their records. Text files have a record a
//! line (images two), and `#` begins a comment.

use std::io::{self, BufRead, BufReader, ErrorKind, Read, Write};
use std::str::FromStr;

use crate::error::{Fault, Place, Problem};
use crate::tracks::words::{Words, shown};

/// How a model is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Binary,
    Text,
}

/// The longest name of an image.
const NAME_LIMIT: u64 = 1 << 16;
/// No file has as many records, and no record as many parts.
const RECORD_LIMIT: u64 = 1 << 40;
const LENGTH_LIMIT: u64 = 1 << 32;
/// Bytes of a feature.
const FEATURE: u64 = 24;

/// The fields of a file. Each refusal says what is missing or wrong, in a text file with the line.
pub(crate) trait Fields {
    fn encoding(&self) -> Encoding;
    /// Goes to the next record; whether there is one. Nothing may follow the last one.
    fn record(&mut self) -> Result<bool, Fault>;
    fn short(&mut self, what: &str) -> Result<u32, Fault>;
    fn long(&mut self, what: &str) -> Result<i64, Fault>;
    fn float(&mut self, what: &str) -> Result<f64, Fault>;
    fn flag(&mut self, what: &str) -> Result<bool, Fault>;
    /// The name of an image, at the end of a line.
    fn name(&mut self) -> Result<Box<str>, Fault>;
    /// Appends so many bytes or words as they are.
    fn raw(&mut self, size: (usize, usize), what: &str, into: &mut Vec<u8>) -> Result<(), Fault>;
    /// How many parts follow, at most: those of a line end where it ends.
    fn length(&mut self, what: &str) -> Result<u64, Fault>;
    /// Whether no part follows.
    fn is_end(&self) -> bool;
    /// Goes to the features of an image.
    fn features(&mut self) -> Result<(), Fault>;
    /// Passes over them.
    fn skip_features(&mut self) -> Result<(), Fault>;
    fn corrupt(&self, why: String) -> Fault;
}

/// The fields of a file.
pub(crate) fn fields<'a>(input: impl Read + 'a, encoding: Encoding) -> Box<dyn Fields + 'a> {
    match encoding {
        Encoding::Binary => Box::new(Binary::new(input)),
        Encoding::Text => Box::new(Words::new(input)),
    }
}

/// A binary file.
struct Binary<R> {
    input: BufReader<R>,
    /// How many records are still to come, once their number is read.
    left: Option<u64>,
}

fn input(problem: Problem) -> Fault {
    Place::Input.fault(problem)
}

fn truncated(what: &str) -> Fault {
    input(Problem::truncated(format!("{what} is missing")))
}

impl<R: Read> Binary<R> {
    fn new(input: R) -> Self {
        let input = BufReader::with_capacity(1 << 16, input);
        Self { input, left: None }
    }

    fn exact(&mut self, bytes: &mut [u8], what: &str) -> Result<(), Fault> {
        self.input
            .read_exact(bytes)
            .map_err(|error| match error.kind() {
                ErrorKind::UnexpectedEof => truncated(what),
                _ => input(error.into()),
            })
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        let mut bytes = [0; N];
        self.exact(&mut bytes, what)?;
        Ok(bytes)
    }

    fn count(&mut self, limit: u64, what: &str) -> Result<u64, Fault> {
        match self.array(what).map(u64::from_le_bytes)? {
            count if count > limit => Err(self.corrupt(format!("{what} is {count}"))),
            count => Ok(count),
        }
    }

    pub(super) fn skip(&mut self, count: u64, what: &str) -> Result<(), Fault> {
        let skipped = io::copy(&mut self.input.by_ref().take(count), &mut io::sink());
        match skipped.map_err(|error| input(error.into()))? == count {
            true => Ok(()),
            false => Err(truncated(what)),
        }
    }
}

impl<R: Read> Fields for Binary<R> {
    fn encoding(&self) -> Encoding {
        Encoding::Binary
    }

    fn record(&mut self) -> Result<bool, Fault> {
        let left = match self.left {
            Some(left) => left,
            None => self.count(RECORD_LIMIT, "the number of records")?,
        };
        self.left = Some(left.saturating_sub(1));
        if left > 0 {
            return Ok(true);
        }
        let rest = self.input.fill_buf().map_err(|error| input(error.into()))?;
        match rest.is_empty() {
            true => Ok(false),
            false => Err(self.corrupt("bytes follow the last record".to_owned())),
        }
    }

    fn short(&mut self, what: &str) -> Result<u32, Fault> {
        self.array(what).map(u32::from_le_bytes)
    }

    fn long(&mut self, what: &str) -> Result<i64, Fault> {
        self.array(what).map(i64::from_le_bytes)
    }

    fn float(&mut self, what: &str) -> Result<f64, Fault> {
        self.array(what).map(f64::from_le_bytes)
    }

    fn flag(&mut self, what: &str) -> Result<bool, Fault> {
        Ok(self.array(what)? != [0])
    }

    fn name(&mut self) -> Result<Box<str>, Fault> {
        let mut name = Vec::new();
        let read = self
            .input
            .by_ref()
            .take(NAME_LIMIT)
            .read_until(0, &mut name);
        read.map_err(|error| input(error.into()))?;
        if name.pop() != Some(0) {
            return Err(truncated("the end of an image's name"));
        }
        let name = String::from_utf8(name);
        let name = name.map_err(|_| self.corrupt("the name of an image is no UTF-8".to_owned()))?;
        match name.contains(char::is_control) {
            true => Err(self.corrupt("the name of an image has a control character".to_owned())),
            false => Ok(name.into()),
        }
    }

    fn raw(&mut self, size: (usize, usize), what: &str, into: &mut Vec<u8>) -> Result<(), Fault> {
        let start = into.len();
        into.resize(start + size.0, 0);
        self.exact(&mut into[start..], what)
    }

    fn length(&mut self, what: &str) -> Result<u64, Fault> {
        self.count(LENGTH_LIMIT, what)
    }

    fn is_end(&self) -> bool {
        false
    }

    fn features(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn skip_features(&mut self) -> Result<(), Fault> {
        let count = self.length("the number of an image's features")?;
        self.skip(FEATURE * count, "a feature")
    }

    fn corrupt(&self, why: String) -> Fault {
        input(Problem::corrupt(why))
    }
}

/// The next word of a line as a number.
fn parsed<T: FromStr>(words: &mut Words<impl Read>, what: &str) -> Result<T, Fault> {
    let why = match words.word_of_line() {
        None => format!("{what} is missing"),
        Some(word) => match std::str::from_utf8(word).map(T::from_str) {
            Ok(Ok(value)) => return Ok(value),
            _ => format!("`{}` stands where {what} is expected", shown(word)),
        },
    };
    Err(words.corrupt(why))
}

impl<R: Read> Fields for Words<R> {
    fn encoding(&self) -> Encoding {
        Encoding::Text
    }

    fn record(&mut self) -> Result<bool, Fault> {
        self.next_full_line()
    }

    fn short(&mut self, what: &str) -> Result<u32, Fault> {
        parsed(self, what)
    }

    fn long(&mut self, what: &str) -> Result<i64, Fault> {
        parsed(self, what)
    }

    fn float(&mut self, what: &str) -> Result<f64, Fault> {
        parsed(self, what)
    }

    fn flag(&mut self, what: &str) -> Result<bool, Fault> {
        Ok(self.short(what)? != 0)
    }

    fn name(&mut self) -> Result<Box<str>, Fault> {
        match std::str::from_utf8(self.rest()) {
            Ok("") => Err(self.corrupt("the image has no name")),
            Ok(name) if name.contains(char::is_control) => {
                Err(self.corrupt("the name of the image has a control character"))
            }
            Ok(name) => Ok(name.into()),
            Err(_) => Err(self.corrupt("the name of the image is no UTF-8")),
        }
    }

    fn raw(&mut self, size: (usize, usize), what: &str, into: &mut Vec<u8>) -> Result<(), Fault> {
        for k in 0..size.1 {
            let Some(word) = self.word_of_line() else {
                return Err(self.corrupt(format!("{what} is missing")));
            };
            if k > 0 {
                into.push(b' ');
            }
            into.extend_from_slice(word);
        }
        Ok(())
    }

    fn length(&mut self, _: &str) -> Result<u64, Fault> {
        Ok(u64::MAX)
    }

    fn is_end(&self) -> bool {
        self.rest().is_empty()
    }

    fn features(&mut self) -> Result<(), Fault> {
        self.next_line().map(|_| ())
    }

    fn skip_features(&mut self) -> Result<(), Fault> {
        self.features()
    }

    fn corrupt(&self, why: String) -> Fault {
        Words::corrupt(self, why)
    }
}

/// A file that is written.
pub(super) struct Out<W> {
    out: W,
    encoding: Encoding,
    /// Whether the line has begun.
    within: bool,
}

impl<W: Write> Out<W> {
    /// Begins with a comment, or with the number of records.
    pub(super) fn new(
        out: W,
        encoding: Encoding,
        comment: &str,
        records: usize,
    ) -> io::Result<Self> {
        let mut out = Self {
            out,
            encoding,
            within: false,
        };
        if encoding == Encoding::Text {
            out.out.write_all(comment.as_bytes())?;
        }
        out.length(records)?;
        Ok(out)
    }

    /// What was read as it is.
    pub(super) fn raw(&mut self, field: &[u8]) -> io::Result<()> {
        if self.encoding == Encoding::Text && std::mem::replace(&mut self.within, true) {
            self.out.write_all(b" ")?;
        }
        self.out.write_all(field)
    }

    fn integer(&mut self, value: i64, bytes: &[u8]) -> io::Result<()> {
        match self.encoding {
            Encoding::Binary => self.raw(bytes),
            Encoding::Text => self.raw(value.to_string().as_bytes()),
        }
    }

    pub(super) fn short(&mut self, value: u32) -> io::Result<()> {
        self.integer(value.into(), &value.to_le_bytes())
    }

    pub(super) fn long(&mut self, value: i64) -> io::Result<()> {
        self.integer(value, &value.to_le_bytes())
    }

    pub(super) fn name(&mut self, name: &str) -> io::Result<()> {
        self.raw(name.as_bytes())?;
        match self.encoding {
            Encoding::Binary => self.raw(&[0]),
            Encoding::Text => self.end(),
        }
    }

    /// How many parts follow: those of a line end where it ends.
    pub(super) fn length(&mut self, count: usize) -> io::Result<()> {
        match self.encoding {
            Encoding::Binary => self.raw(&(count as u64).to_le_bytes()),
            Encoding::Text => Ok(()),
        }
    }

    /// Ends a line.
    pub(super) fn end(&mut self) -> io::Result<()> {
        self.within = false;
        match self.encoding {
            Encoding::Binary => Ok(()),
            Encoding::Text => self.out.write_all(b"\n"),
        }
    }

    pub(super) fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
