//! Data elements: types, lengths, and bytes that may be deflated.

use std::io::{BufRead, BufReader, ErrorKind, Read};

use flate2::bufread::ZlibDecoder;

use crate::error::Problem;
use crate::matlab::ByteOrder;

pub(super) const MATRIX: u32 = 14;
pub(super) const COMPRESSED: u32 = 15;

/// Deflate codes at most 258 bytes in two bits.
const DEFLATE_LIMIT: u64 = 1032;
const BLOCK: usize = 1 << 16;

pub(super) fn malformed(what: &str) -> Problem {
    Problem::Corrupt(what.to_owned())
}

/// The elements of a file: their types and contents.
pub(super) struct Elements<'a> {
    rest: &'a [u8],
    order: ByteOrder,
}

impl<'a> Elements<'a> {
    pub(super) fn new(body: &'a [u8], order: ByteOrder) -> Self {
        Self { rest: body, order }
    }

    fn split(&mut self) -> Result<(u32, &'a [u8]), Problem> {
        let (tag, body) = self.rest.split_first_chunk().ok_or_else(|| {
            let left = self.rest.len();
            Problem::Truncated(format!("{left} bytes after the last variable"))
        })?;
        let tag = Tag::parse(*tag, self.order)?;
        if tag.small.is_some() {
            // No variable fits in four bytes, so what they hold is skipped.
            self.rest = body;
            return Ok((tag.kind, &[]));
        }
        // Deflated elements are not padded.
        let padded = match tag.kind {
            COMPRESSED => tag.length,
            _ => tag.length.next_multiple_of(8),
        };
        let length = tag.length as usize;
        if length > body.len() {
            return Err(Problem::Truncated(format!(
                "a variable takes {length} bytes, {} are there",
                body.len()
            )));
        }
        self.rest = body.get(padded as usize..).unwrap_or_default();
        Ok((tag.kind, &body[..length]))
    }
}

impl<'a> Iterator for Elements<'a> {
    type Item = Result<(u32, &'a [u8]), Problem>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let element = self.split();
        if element.is_err() {
            self.rest = &[];
        }
        Some(element)
    }
}

/// Type and length of an element; small elements hold their data in the tag.
pub(super) struct Tag {
    pub(super) kind: u32,
    /// In bytes, without padding.
    pub(super) length: u64,
    small: Option<[u8; 4]>,
}

impl Tag {
    fn parse(bytes: [u8; 8], order: ByteOrder) -> Result<Self, Problem> {
        let [a, b, c, d, data @ ..] = bytes;
        let first = order.u32([a, b, c, d]);
        let (kind, length, small) = match first >> 16 {
            0 => (first, order.u32(data), None),
            length => (first & 0xffff, length, Some(data)),
        };
        if small.is_some() && length > 4 {
            return Err(malformed("a small element is longer than four bytes"));
        }
        Ok(Self {
            kind,
            length: length.into(),
            small,
        })
    }
}

impl ByteOrder {
    pub(super) fn u32(self, bytes: [u8; 4]) -> u32 {
        match self {
            Self::Little => u32::from_le_bytes(bytes),
            Self::Big => u32::from_be_bytes(bytes),
        }
    }
}

/// The content of one variable, read from front to back.
pub(super) struct Source<'a> {
    input: Box<dyn BufRead + 'a>,
    pub(super) order: ByteOrder,
    /// Bytes of the variable that have not been read.
    left: u64,
}

impl<'a> Source<'a> {
    /// The content of a [`MATRIX`] element, itself or inside a [`COMPRESSED`] one.
    pub(super) fn of_element(
        kind: u32,
        content: &'a [u8],
        order: ByteOrder,
    ) -> Result<Self, Problem> {
        let available = content.len() as u64;
        if kind == MATRIX {
            return Ok(Self {
                input: Box::new(content),
                order,
                left: available,
            });
        }
        let inflated = ZlibDecoder::new(content);
        let mut source = Self {
            input: Box::new(BufReader::with_capacity(BLOCK, inflated)),
            order,
            left: 8,
        };
        let tag = source.tag()?;
        if tag.kind != MATRIX || tag.small.is_some() {
            return Err(malformed("a deflated element is not a variable"));
        }
        if tag.length > DEFLATE_LIMIT * available {
            return Err(Problem::Truncated(format!(
                "a variable takes {} bytes, which {available} deflated bytes cannot hold",
                tag.length
            )));
        }
        source.left = tag.length;
        Ok(source)
    }

    fn fill(&mut self, buffer: &mut [u8]) -> Result<(), Problem> {
        let wanted = buffer.len() as u64;
        if wanted > self.left {
            return Err(Problem::Truncated(format!(
                "{wanted} bytes are needed where the variable has {} left",
                self.left
            )));
        }
        self.input.read_exact(buffer).map_err(unreadable)?;
        self.left -= wanted;
        Ok(())
    }

    pub(super) fn tag(&mut self) -> Result<Tag, Problem> {
        let mut bytes = [0; 8];
        self.fill(&mut bytes)?;
        Tag::parse(bytes, self.order)
    }

    /// Calls `each` with the bytes of an element, block by block in whole items
    /// of `size` bytes, then skips the padding.
    pub(super) fn blocks(
        &mut self,
        tag: &Tag,
        size: usize,
        mut each: impl FnMut(&[u8]) -> Result<(), Problem>,
    ) -> Result<(), Problem> {
        if !tag.length.is_multiple_of(size as u64) {
            return Err(malformed(
                "the length of an element is no multiple of its numbers'",
            ));
        }
        if let Some(small) = tag.small {
            return each(&small[..tag.length as usize]);
        }
        if tag.length > self.left {
            return Err(Problem::Truncated(format!(
                "an element takes {} bytes where the variable has {} left",
                tag.length, self.left
            )));
        }
        let mut buffer = [0; BLOCK];
        let mut left = tag.length;
        while left > 0 {
            let block = &mut buffer[..left.min(BLOCK as u64) as usize];
            self.fill(block)?;
            each(block)?;
            left -= block.len() as u64;
        }
        let padding = (tag.length.next_multiple_of(8) - tag.length).min(self.left);
        self.fill(&mut [0; 8][..padding as usize])
    }

    /// The bytes of an element that may have at most `limit` of them.
    pub(super) fn bytes(&mut self, tag: &Tag, limit: u64) -> Result<Vec<u8>, Problem> {
        if tag.length > limit {
            return Err(malformed("an element of the header is too long"));
        }
        let mut bytes = Vec::new();
        self.blocks(tag, 1, |block| {
            bytes.extend_from_slice(block);
            Ok(())
        })?;
        Ok(bytes)
    }

    /// Checks that nothing follows what has been read, and the checksum of
    /// deflated data.
    pub(super) fn finish(mut self) -> Result<(), Problem> {
        if self.left > 0 {
            return Err(malformed("bytes follow the values of the matrix"));
        }
        let mut more = [0; 1];
        match self.input.read(&mut more) {
            Ok(0) => Ok(()),
            Ok(_) => Err(malformed("deflated bytes follow the variable")),
            Err(error) => Err(unreadable(error)),
        }
    }
}

/// Reading from memory fails only where the bytes end or the deflated ones are wrong.
fn unreadable(error: std::io::Error) -> Problem {
    match error.kind() {
        ErrorKind::UnexpectedEof => {
            Problem::Truncated("the data of a variable end early".to_owned())
        }
        _ => Problem::Corrupt(format!("the deflated data of a variable: {error}")),
    }
}
