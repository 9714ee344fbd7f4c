//! Comma- and tab-separated values, for other programs.

use std::io::{self, Write};

/// A table of values, written row by row: a cell is quoted where it has to be (RFC 4180), and
/// lines end with a line feed. It is buffered: what matters ends with [`finish`](Self::finish).
pub struct Values<W: Write>(csv::Writer<W>);

impl<W: Write> Values<W> {
    /// Comma-separated.
    pub fn commas(out: W) -> Self {
        Self(csv::Writer::from_writer(out))
    }

    /// Tab-separated.
    pub fn tabs(out: W) -> Self {
        Self(csv::WriterBuilder::new().delimiter(b'\t').from_writer(out))
    }

    /// Writes a row, or the head; all have the same number of cells.
    ///
    /// # Errors
    /// Those of the writer; another number of cells.
    pub fn row<T: AsRef<[u8]>>(&mut self, cells: impl IntoIterator<Item = T>) -> io::Result<()> {
        self.0.write_record(cells).map_err(of_the_writer)
    }

    /// Writes what is left in the buffer.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn finish(mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// The writer's own error where it is one, so that its kind is not lost.
fn of_the_writer(error: csv::Error) -> io::Error {
    if error.is_io_error()
        && let csv::ErrorKind::Io(error) = error.into_kind()
    {
        return error;
    }
    io::Error::other("rows of different lengths")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_have_to_be() {
        let mut out = Vec::new();
        let mut values = Values::commas(&mut out);
        values.row(["a", "b c"]).unwrap();
        values.row(["1,2", "say \"x\""]).unwrap();
        values.finish().unwrap();
        assert_eq!(out, b"a,b c\n\"1,2\",\"say \"\"x\"\"\"\n");
        let mut out = Vec::new();
        let mut values = Values::tabs(&mut out);
        values.row(["a,b", ""]).unwrap();
        values.finish().unwrap();
        assert_eq!(out, b"a,b\t\n");
        let mut values = Values::commas(Vec::new());
        values.row(["a", "b"]).unwrap();
        assert!(values.row(["alone"]).is_err());
    }

    #[test]
    fn a_closed_pipe_stays_one() {
        struct Closed;
        impl Write for Closed {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let mut values = Values::commas(Closed);
        let long = "x".repeat(1 << 16);
        let error = values.row([long]).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::BrokenPipe);
    }
}
