//! Files that gzip has compressed, unpacked within limits, so that a small file does not fill the machine.

use std::cell::Cell;
use std::io::{Error, ErrorKind, Read};
use std::rc::Rc;

use flate2::read::MultiGzDecoder;

/// More than that is not inflated from one file.
const LIMIT: u64 = 64 << 30;
/// So much is inflated whatever it was before.
const ALWAYS: u64 = 256 << 20;
/// Beyond [`ALWAYS`], at most this times its size: edge lists are 3 to 20 times as long as their
/// gzip files.
const RATIO: u64 = 200;

/// Whether a file with these first bytes is one of gzip.
pub(super) fn is_gzip(head: &[u8]) -> bool {
    head.starts_with(b"\x1f\x8b")
}

/// A compressed file that is too large, or suspiciously small.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Inflated {
    /// It has more bytes than any file that is read.
    #[error("the compressed data are too large: they inflate to more than {} GiB", LIMIT >> 30)]
    Limit,
    /// It is hundreds of times as large as its compressed form.
    #[error(
        "the compressed data are too large: they inflate to more than {} MiB and {RATIO} times \
         their size",
        ALWAYS >> 20
    )]
    Ratio,
}

impl Inflated {
    /// Whether so many bytes are too much from a file of so many.
    ///
    /// # Errors
    /// If they are.
    pub(super) fn check(inflated: u64, compressed: u64) -> Result<(), Self> {
        if inflated > LIMIT {
            return Err(Self::Limit);
        }
        if inflated > ALWAYS && inflated / RATIO > compressed {
            return Err(Self::Ratio);
        }
        Ok(())
    }
}

/// Compressed data that cannot be inflated.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub(super) struct Damaged(pub(super) Error);

/// Counts what is read.
struct Counter(Box<dyn Read>, Rc<Cell<u64>>);

impl Read for Counter {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self.0.read(buffer)?;
        self.1.set(self.1.get() + got as u64);
        Ok(got)
    }
}

/// The unpacked bytes of a file of one or more members. Its errors are [`Inflated`] and [`Damaged`].
pub(super) struct Inflater {
    input: MultiGzDecoder<Counter>,
    read: Rc<Cell<u64>>,
    inflated: u64,
}

impl Inflater {
    pub(super) fn new(input: impl Read + 'static) -> Self {
        let read = Rc::default();
        let input = Counter(Box::new(input), Rc::clone(&read));
        Self {
            input: MultiGzDecoder::new(input),
            read,
            inflated: 0,
        }
    }
}

impl Read for Inflater {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self
            .input
            .read(buffer)
            .map_err(|error| match error.kind() {
                ErrorKind::Interrupted => error,
                kind => Error::new(kind, Damaged(error)),
            })?;
        self.inflated += got as u64;
        Inflated::check(self.inflated, self.read.get()).map_err(Error::other)?;
        Ok(got)
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Write};

    use flate2::write::GzEncoder;

    use super::*;

    fn deflated(data: impl Read) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), flate2::Compression::best());
        let mut data = data;
        std::io::copy(&mut data, &mut encoder).unwrap();
        encoder.finish().unwrap()
    }

    fn members() -> [Vec<u8>; 2] {
        [deflated(&b"1 2\n"[..]), deflated(&b"2 3\n"[..])]
    }

    fn inflated(bytes: Vec<u8>) -> std::io::Result<String> {
        let mut text = String::new();
        Inflater::new(Cursor::new(bytes)).read_to_string(&mut text)?;
        Ok(text)
    }

    #[test]
    fn members_are_joined_and_damage_is_found() {
        let both = members().concat();
        assert!(is_gzip(&both));
        assert_eq!(inflated(both.clone()).unwrap(), "1 2\n2 3\n");
        for bad in [both[..both.len() - 3].to_vec(), [&both[..], b"x"].concat()] {
            let error = inflated(bad).unwrap_err();
            assert!(error.downcast::<Damaged>().is_ok());
        }
    }

    /// No byte may change without being noticed, but for those that say nothing of the data.
    #[test]
    fn changed_bytes_are_found_by_the_checksum() {
        let [first, _] = members();
        for at in 0..first.len() {
            let mut changed = first.clone();
            changed[at] ^= 0x04;
            if let Ok(text) = inflated(changed) {
                assert_eq!(text, "1 2\n", "{at}");
            }
        }
    }

    #[test]
    fn what_inflates_a_thousandfold_is_refused() {
        let bomb = deflated(std::io::repeat(b'7').take(ALWAYS + (1 << 20)));
        let mut sink = std::io::sink();
        let mut inflater = Inflater::new(Cursor::new(bomb));
        let error = std::io::copy(&mut inflater, &mut sink).unwrap_err();
        assert_eq!(error.downcast::<Inflated>().unwrap(), Inflated::Ratio);
        sink.flush().unwrap();
    }
}
