//! Files that are read in one piece.

use crate::error::{Place, Problem, ReadError};
use crate::inflate::{Inflater, is_gzip};
use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

/// All bytes of a file; `-` is standard input.
///
/// # Errors
/// A file that cannot be read.
pub fn bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let read = if path == Path::new("-") {
        let mut bytes = Vec::new();
        let all = std::io::stdin().lock().read_to_end(&mut bytes);
        all.map(|_| bytes)
    } else {
        fs::read(path)
    };
    read.map_err(|error| at(path, Problem::unreadable(&error)))
}

/// The same as text.
///
/// # Errors
/// A file that cannot be read, or is not UTF-8.
pub fn text(path: &Path) -> Result<String, ReadError> {
    String::from_utf8(bytes(path)?).map_err(|_| at(path, Problem::not_utf8()))
}

/// The text in bytes that may be compressed.
///
/// # Errors
/// What cannot be unpacked, or is not UTF-8.
pub(crate) fn text_of(bytes: &[u8]) -> Result<String, Problem> {
    let mut inner = Vec::new();
    let bytes = match is_gzip(bytes) {
        true => {
            Inflater::new(Cursor::new(bytes.to_vec())).read_to_end(&mut inner)?;
            inner
        }
        false => bytes.to_vec(),
    };
    String::from_utf8(bytes).map_err(|_| Problem::not_utf8())
}

fn at(path: &Path, problem: Problem) -> ReadError {
    Place::Input
        .fault(problem)
        .in_file(&path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_read_is_said_with_what_to_do() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let missing = text(&path).unwrap_err().to_string();
        assert!(
            missing.contains("cannot be read")
                && missing.ends_with("check its path and permissions")
        );
        fs::write(&path, b"a\xff").unwrap();
        assert_eq!(bytes(&path).unwrap(), b"a\xff");
        let other = text(&path).unwrap_err().to_string();
        assert!(other.contains("UTF-8"), "{other}");
        fs::write(&path, "\u{e4}").unwrap();
        assert_eq!(text(&path).unwrap(), "\u{e4}");
    }
}
