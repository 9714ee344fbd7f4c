//! Compressed files: gzip, bzip2, xz and Zstandard, unpacked within limits, so that a small file does
//! not fill the machine.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Error, ErrorKind, Read};
use std::rc::Rc;

use bzip2::read::MultiBzDecoder;
use flate2::read::MultiGzDecoder;
use lzma_rust2::XzReader;
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

/// More than that is not inflated from one file.
const LIMIT: u64 = 64 << 30;
/// So much is inflated whatever it was before.
const ALWAYS: u64 = 256 << 20;
/// Beyond [`ALWAYS`], at most this times its size: edge lists are 3 to 20 times as long as their
/// gzip files.
const RATIO: u64 = 200;
/// The most memory that unpacking takes, which a file may ask for in its first bytes: four times
/// what `xz -9` asks for, and as much as `zstd` takes unless it is told otherwise.
const MEMORY: u64 = 256 << 20;
const WINDOW: u64 = 128 << 20;

/// How a file is compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    Gzip,
    Bzip2,
    Xz,
    Zstandard,
}

impl Compression {
    /// That of a file with these first bytes, if it is compressed.
    pub(super) fn of(head: &[u8]) -> Option<Self> {
        match head {
            [0x1f, 0x8b, ..] => Some(Self::Gzip),
            // The first block, or the end of a file without any.
            [b'B', b'Z', b'h', b'1'..=b'9', b'1', b'A', b'Y', ..]
            | [b'B', b'Z', b'h', b'1'..=b'9', 0x17, b'r', b'E', ..] => Some(Self::Bzip2),
            [0xfd, b'7', b'z', b'X', b'Z', 0, ..] => Some(Self::Xz),
            // Frames of data, and frames to be skipped, with which some begin.
            [0x28, 0xb5, 0x2f, 0xfd, ..] | [0x50..=0x5f, 0x2a, 0x4d, 0x18, ..] => {
                Some(Self::Zstandard)
            }
            _ => None,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Bzip2 => "bzip2",
            Self::Xz => "xz",
            Self::Zstandard => "Zstandard",
        }
    }
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
    /// It cannot be unpacked in little memory.
    #[error("unpacking the compressed data takes more than {} MiB of memory", WINDOW >> 20)]
    Memory,
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

/// What has been read of a file, and whether that failed.
#[derive(Default)]
struct Progress {
    read: Cell<u64>,
    failed: Cell<bool>,
}

/// Counts what is read.
struct Counter<R> {
    input: R,
    progress: Rc<Progress>,
}

impl<R: Read> Read for Counter<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self.input.read(buffer);
        match &got {
            Ok(got) => {
                let read = &self.progress.read;
                read.set(read.get() + *got as u64);
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(_) => self.progress.failed.set(true),
        }
        got
    }
}

/// The unpacked bytes of a file of one or more members. Its errors are [`Inflated`] and
/// [`Damaged`], or those of the file.
pub(super) struct Inflater {
    input: Box<dyn Read>,
    progress: Rc<Progress>,
    inflated: u64,
}

impl Inflater {
    pub(super) fn new(input: impl Read + 'static, compression: Compression) -> Self {
        let progress = Rc::new(Progress::default());
        let input = Counter {
            input,
            progress: Rc::clone(&progress),
        };
        Self {
            input: match compression {
                Compression::Gzip => Box::new(MultiGzDecoder::new(input)),
                Compression::Bzip2 => Box::new(MultiBzDecoder::new(input)),
                Compression::Xz => {
                    let memory = (MEMORY >> 10) as u32;
                    let input = BufReader::new(input);
                    Box::new(XzReader::new_mem_limit(input, true, memory))
                }
                Compression::Zstandard => Box::new(Frames::new(BufReader::new(input))),
            },
            progress,
            inflated: 0,
        }
    }

    /// An error that is not one of the file.
    fn damaged(&self, error: Error) -> Error {
        match error.kind() {
            _ if self.progress.failed.get() => error,
            ErrorKind::Interrupted => error,
            ErrorKind::OutOfMemory => Error::other(Inflated::Memory),
            kind => Error::new(kind, Damaged(error)),
        }
    }
}

impl Read for Inflater {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let got = self
            .input
            .read(buffer)
            .map_err(|error| self.damaged(error))?;
        self.inflated += got as u64;
        Inflated::check(self.inflated, self.progress.read.get()).map_err(Error::other)?;
        Ok(got)
    }
}

/// The frames of a Zstandard file, one after another.
struct Frames<R> {
    source: R,
    decoder: FrameDecoder,
    /// A frame has begun, and not all of it is given.
    within: bool,
}

impl<R: BufRead> Frames<R> {
    fn new(source: R) -> Self {
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(WINDOW);
        Self {
            source,
            decoder,
            within: false,
        }
    }

    /// Begins the next frame, or skips one that has no data.
    fn begin(&mut self) -> std::io::Result<()> {
        match self.decoder.reset(&mut self.source) {
            Ok(()) => self.within = true,
            Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame {
                length,
                ..
            })) => {
                let mut skipped = self.source.by_ref().take(length.into());
                if std::io::copy(&mut skipped, &mut std::io::sink())? < length.into() {
                    return Err(ErrorKind::UnexpectedEof.into());
                }
            }
            Err(error @ FrameDecoderError::WindowSizeTooBig { .. }) => {
                return Err(Error::new(ErrorKind::OutOfMemory, error));
            }
            Err(_) => return Err(self.invalid()),
        }
        Ok(())
    }

    /// Why the data cannot be unpacked, in plain words.
    fn invalid(&mut self) -> Error {
        match self.source.fill_buf() {
            Ok([]) => Error::new(ErrorKind::UnexpectedEof, "they end early"),
            Ok(_) => Error::new(ErrorKind::InvalidData, "no Zstandard data"),
            Err(error) => error,
        }
    }

    /// What follows the data of a frame is their checksum.
    fn end(&mut self) -> std::io::Result<()> {
        self.within = false;
        let promised = self.decoder.get_checksum_from_data();
        if promised.is_some() && promised != self.decoder.get_calculated_checksum() {
            return Err(Error::new(ErrorKind::InvalidData, "wrong checksum"));
        }
        Ok(())
    }
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        loop {
            if !self.within {
                if self.source.fill_buf()?.is_empty() {
                    return Ok(0);
                }
                self.begin()?;
                continue;
            }
            while self.decoder.can_collect() == 0 && !self.decoder.is_finished() {
                let one = BlockDecodingStrategy::UptoBlocks(1);
                if self.decoder.decode_blocks(&mut self.source, one).is_err() {
                    return Err(self.invalid());
                }
            }
            match self.decoder.read(buffer)? {
                0 => self.end()?,
                got => return Ok(got),
            }
        }
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

    /// What the programs `bzip2`, `xz` and `zstd` make of `1 2\n`, and of `2 3\n`.
    const PACKED: [(Compression, [&[u8]; 2]); 3] = [
        (
            Compression::Bzip2,
            [
                include_bytes!("samples/1.bz2"),
                include_bytes!("samples/2.bz2"),
            ],
        ),
        (
            Compression::Xz,
            [
                include_bytes!("samples/1.xz"),
                include_bytes!("samples/2.xz"),
            ],
        ),
        (
            Compression::Zstandard,
            [
                include_bytes!("samples/1.zst"),
                include_bytes!("samples/2.zst"),
            ],
        ),
    ];

    fn members() -> Vec<(Compression, [Vec<u8>; 2])> {
        let gzip = [deflated(&b"1 2\n"[..]), deflated(&b"2 3\n"[..])];
        let packed = PACKED.map(|(compression, both)| (compression, both.map(<[u8]>::to_vec)));
        [vec![(Compression::Gzip, gzip)], packed.to_vec()].concat()
    }

    fn inflated(bytes: Vec<u8>, compression: Compression) -> std::io::Result<String> {
        let mut text = String::new();
        Inflater::new(Cursor::new(bytes), compression).read_to_string(&mut text)?;
        Ok(text)
    }

    #[test]
    fn members_are_joined_and_damage_is_found() {
        for (compression, [first, second]) in members() {
            assert_eq!(Compression::of(&first), Some(compression));
            let both = [first, second].concat();
            assert_eq!(inflated(both.clone(), compression).unwrap(), "1 2\n2 3\n");
            for bad in [both[..both.len() - 3].to_vec(), [&both[..], b"x"].concat()] {
                let error = inflated(bad, compression).unwrap_err();
                assert!(error.downcast::<Damaged>().is_ok(), "{compression:?}");
            }
        }
    }

    /// No byte may change without being noticed, but for those that say nothing of the data.
    #[test]
    fn changed_bytes_are_found_by_the_checksum() {
        for (compression, [first, _]) in members() {
            for at in 0..first.len() {
                let mut changed = first.clone();
                changed[at] ^= 0x04;
                if let Ok(text) = inflated(changed, compression) {
                    assert_eq!(text, "1 2\n", "{compression:?} {at}");
                }
            }
        }
    }

    /// A Zstandard frame that is to be skipped, and one that asks for a window of gigabytes.
    #[test]
    fn frames_are_skipped_and_large_windows_refused() {
        let frame = PACKED[2].1[0];
        let skipped = [b"\x53\x2a\x4d\x18\x02\0\0\0ab", frame].concat();
        assert_eq!(Compression::of(&skipped), Some(Compression::Zstandard));
        assert_eq!(inflated(skipped, Compression::Zstandard).unwrap(), "1 2\n");
        let window = b"\x28\xb5\x2f\xfd\x00\xa8\x01\x00\x00".to_vec();
        let error = inflated(window, Compression::Zstandard).unwrap_err();
        assert_eq!(error.downcast::<Inflated>().unwrap(), Inflated::Memory);
    }

    #[test]
    fn what_inflates_a_thousandfold_is_refused() {
        let bomb = deflated(std::io::repeat(b'7').take(ALWAYS + (1 << 20)));
        let mut sink = std::io::sink();
        let mut inflater = Inflater::new(Cursor::new(bomb), Compression::Gzip);
        let error = std::io::copy(&mut inflater, &mut sink).unwrap_err();
        assert_eq!(error.downcast::<Inflated>().unwrap(), Inflated::Ratio);
        sink.flush().unwrap();
    }
}
