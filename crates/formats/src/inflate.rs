//! gzip: inflating within limits, so that a small file does not fill the machine.

use std::io::{Error, ErrorKind, Read};

use flate2::read::MultiGzDecoder;

/// What a gzip file begins with.
pub(super) const MAGIC: &[u8] = b"\x1f\x8b";

/// More than that is not inflated from one file.
const LIMIT: u64 = 64 << 30;
/// So much is inflated whatever it was before.
const ALWAYS: u64 = 256 << 20;
/// Beyond [`ALWAYS`], at most this times its size: edge lists are 3 to 20 times as long as their
/// gzip files.
const RATIO: u64 = 200;

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

/// Compressed data that cannot be inflated.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub(super) struct Damaged(pub(super) Error);

/// Counts what is read.
struct Counter<R> {
    input: R,
    read: u64,
}

impl<R: Read> Read for Counter<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self.input.read(buffer)?;
        self.read += got as u64;
        Ok(got)
    }
}

/// The inflated bytes of a gzip file of one or more members. Its errors are [`Inflated`] and
/// [`Damaged`], or those of the file.
pub(super) struct Inflater<R> {
    input: MultiGzDecoder<Counter<R>>,
    inflated: u64,
}

impl<R: Read> Inflater<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input: MultiGzDecoder::new(Counter { input, read: 0 }),
            inflated: 0,
        }
    }
}

impl<R: Read> Read for Inflater<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self
            .input
            .read(buffer)
            .map_err(|error| match error.kind() {
                ErrorKind::InvalidInput | ErrorKind::InvalidData | ErrorKind::UnexpectedEof => {
                    Error::new(error.kind(), Damaged(error))
                }
                _ => error,
            })?;
        self.inflated += got as u64;
        if self.inflated > LIMIT {
            return Err(Error::other(Inflated::Limit));
        }
        if self.inflated > ALWAYS && self.inflated / RATIO > self.input.get_ref().read {
            return Err(Error::other(Inflated::Ratio));
        }
        Ok(got)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    fn deflated(data: impl Read) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
        let mut data = data;
        std::io::copy(&mut data, &mut encoder).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn members_are_joined_and_damage_is_found() {
        let both = [deflated(&b"1 2\n"[..]), deflated(&b"2 3\n"[..])].concat();
        let mut text = String::new();
        Inflater::new(&both[..]).read_to_string(&mut text).unwrap();
        assert_eq!(text, "1 2\n2 3\n");
        for bad in [&both[..both.len() - 3], &[&both[..], b"x"].concat()] {
            let error = Inflater::new(bad).read_to_end(&mut Vec::new()).unwrap_err();
            assert!(error.downcast::<Damaged>().is_ok());
        }
    }

    #[test]
    fn what_inflates_a_thousandfold_is_refused() {
        let bomb = deflated(std::io::repeat(b'7').take(ALWAYS + (1 << 20)));
        let mut sink = std::io::sink();
        let error = std::io::copy(&mut Inflater::new(&bomb[..]), &mut sink).unwrap_err();
        assert_eq!(error.downcast::<Inflated>().unwrap(), Inflated::Ratio);
        sink.flush().unwrap();
    }
}
