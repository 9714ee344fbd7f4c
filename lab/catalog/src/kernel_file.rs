//! Kernels in a file: made once, and read in slices by all who work on them.
//!
//! The first line describes them, sealed; then each kernel has a record of 41 bytes: the kernel,
//! [`Packed`]; how many candidates it has (0 if that was not counted), a number of 64 bits with the lowest
//! byte first; and the first 8 bytes of the SHA-256 of its place and the 33 bytes before.

use crate::multigraph::{PACKED_BYTES, Packed};
use crate::sealed;
use anyhow::{Context, Result, anyhow};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Bytes of a record.
const RECORD: usize = PACKED_BYTES + 8 + 8;

/// What the kernels are of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Of {
    pub(crate) program: String,
    pub(crate) nodes: usize,
    pub(crate) edges: usize,
    pub(crate) necessary: bool,
    /// Whether each one's candidates were counted.
    pub(crate) counted: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    of: Of,
    kernels: usize,
    candidates: u64,
}

/// A kernel, and how many candidates it has.
pub(crate) type Counted = (Packed, u64);

/// A file of kernels.
#[derive(Debug)]
pub(crate) struct KernelFile {
    path: PathBuf,
    head: u64,
    kernels: usize,
    candidates: Option<u64>,
}

/// Writes kernels.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write(out: &mut dyn Write, of: Of, kernels: &[Counted]) -> io::Result<()> {
    let head = Head {
        of,
        kernels: kernels.len(),
        candidates: kernels.iter().map(|(_, count)| count).sum(),
    };
    out.write_all(sealed::sealed(&head).as_bytes())?;
    for (place, (kernel, count)) in kernels.iter().enumerate() {
        let mut record = Vec::with_capacity(RECORD);
        record.extend(kernel.bytes());
        record.extend(count.to_le_bytes());
        let check = check(place, &record);
        record.extend(check);
        out.write_all(&record)?;
    }
    Ok(())
}

fn check(place: usize, record: &[u8]) -> [u8; 8] {
    let mut hash = Sha256::new();
    hash.update((place as u64).to_le_bytes());
    hash.update(record);
    let mut first = [0; 8];
    first.copy_from_slice(&hash.finalize()[..8]);
    first
}

impl KernelFile {
    /// Opens a file, and goes through all of its records.
    ///
    /// # Errors
    /// What is wrong with it: it is cut off, changed, or of other kernels.
    pub(crate) fn open(path: &Path, of: &Of) -> Result<Self, String> {
        let found = |error: io::Error| error.to_string();
        let mut file = BufReader::new(File::open(path).map_err(found)?);
        let mut line = Vec::new();
        let most = (&mut file).take(1 << 16).read_until(b'\n', &mut line);
        let head = most.map_err(found)? as u64;
        let text = String::from_utf8_lossy(&line);
        let Head {
            of: there,
            kernels,
            candidates,
        } = sealed::opened(&text)?;
        if there != *of {
            return Err("of other kernels".into());
        }
        let mut record = [0; RECORD];
        let mut sum = 0u64;
        for place in 0..kernels {
            let read = file.read_exact(&mut record);
            read.map_err(|error| format!("cut off at kernel {place} ({error})"))?;
            let (_, count) = decoded(place, &record)?;
            sum = sum.wrapping_add(count);
        }
        if sum != candidates || file.read(&mut record).map_err(found)? > 0 {
            return Err("changed: it has another length than it says".into());
        }
        Ok(Self {
            path: path.to_owned(),
            head,
            kernels,
            candidates: of.counted.then_some(candidates),
        })
    }

    /// How many kernels there are.
    pub(crate) fn len(&self) -> usize {
        self.kernels
    }

    /// How many candidates they have, if they were counted.
    pub(crate) fn candidates(&self) -> Option<u64> {
        self.candidates
    }

    /// Some of the kernels.
    ///
    /// # Errors
    /// If they cannot be read, or were changed since the file was opened.
    pub(crate) fn read(&self, range: Range<usize>) -> Result<Vec<Counted>> {
        let read = || -> Result<Vec<Counted>> {
            let mut file = File::open(&self.path)?;
            file.seek(SeekFrom::Start(self.head + (range.start * RECORD) as u64))?;
            let mut bytes = vec![0; range.len() * RECORD];
            file.read_exact(&mut bytes)?;
            let records = range.clone().zip(bytes.chunks_exact(RECORD));
            let kernels = records.map(|(place, record)| decoded(place, record));
            kernels
                .collect::<Result<_, String>>()
                .map_err(|why| anyhow!(why))
        };
        read().with_context(|| self.path.display().to_string())
    }
}

fn decoded(place: usize, record: &[u8]) -> Result<Counted, String> {
    let (content, given) = record.split_at(RECORD - 8);
    if check(place, content) != given {
        return Err(format!("changed: kernel {place} is another one"));
    }
    let wrong = || format!("kernel {place} is none");
    let (kernel, count) = content.split_first_chunk().ok_or_else(wrong)?;
    let kernel = Packed::from_bytes(kernel).ok_or_else(wrong)?;
    let count = count.first_chunk().ok_or_else(wrong)?;
    Ok((kernel, u64::from_le_bytes(*count)))
}
