//! Comma- and tab-separated values: written for other programs, and read line by line, so that an
//! error can name the line.

use std::io::{self, Write};

pub use ::csv::StringRecord;

/// A table of values, written row by row: a cell is quoted where it has to be (RFC 4180), and
/// lines end with a line feed. It is buffered: what matters ends with [`finish`](Self::finish).
pub struct Writer<W: Write>(::csv::Writer<W>);

impl<W: Write> Writer<W> {
    /// Comma-separated.
    pub fn commas(out: W) -> Self {
        Self(::csv::Writer::from_writer(out))
    }

    /// Tab-separated.
    pub fn tabs(out: W) -> Self {
        Self(
            ::csv::WriterBuilder::new()
                .delimiter(b'\t')
                .from_writer(out),
        )
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
fn of_the_writer(error: ::csv::Error) -> io::Error {
    if error.is_io_error()
        && let ::csv::ErrorKind::Io(error) = error.into_kind()
    {
        return error;
    }
    io::Error::other("rows of different lengths")
}

/// A quoted cell that does not end on its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenQuote {
    /// The line, from 1.
    pub line: usize,
}

/// The lines of values between separators that are not blank, with their numbers from 1. A row may
/// have any number of cells; they may stand in double quotes, which are doubled within.
///
/// # Errors
/// A quoted cell that does not end on its line.
pub fn lines(text: &str, separator: u8) -> Result<Vec<(usize, StringRecord)>, OpenQuote> {
    // With its last line ended, a quoted cell that does not end has a line end in it.
    let text = text.replace("\r\n", "\n") + "\n";
    let mut reader = ::csv::ReaderBuilder::new()
        .has_headers(false)
        .delimiter(separator)
        .flexible(true)
        .terminator(::csv::Terminator::Any(b'\n'))
        .from_reader(text.as_bytes());
    let mut lines = Vec::new();
    let mut cells = StringRecord::new();
    while reader
        .read_record(&mut cells)
        .unwrap_or_else(|_| unreachable!("a text, and rows of any length"))
    {
        // Its position is before the empty lines that the reader passes over.
        let from = cells.position().map_or((0, 1), |at| (at.byte(), at.line()));
        let rest = &text[from.0 as usize..];
        let record = rest.trim_start_matches('\n');
        let line = from.1 as usize + rest.len() - record.len();
        if cells.iter().any(|cell| cell.contains('\n')) {
            return Err(OpenQuote { line });
        }
        let is_blank = record
            .lines()
            .next()
            .is_none_or(|line| line.trim().is_empty());
        if !is_blank {
            lines.push((line, cells.clone()));
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_have_to_be() {
        let mut out = Vec::new();
        let mut table = Writer::commas(&mut out);
        table.row(["a", "b c"]).unwrap();
        table.row(["1,2", "say \"x\""]).unwrap();
        table.finish().unwrap();
        assert_eq!(out, b"a,b c\n\"1,2\",\"say \"\"x\"\"\"\n");
        let mut out = Vec::new();
        let mut table = Writer::tabs(&mut out);
        table.row(["a,b", ""]).unwrap();
        table.finish().unwrap();
        assert_eq!(out, b"a,b\t\n");
        let mut table = Writer::commas(Vec::new());
        table.row(["a", "b"]).unwrap();
        assert!(table.row(["alone"]).is_err());
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
        let mut table = Writer::commas(Closed);
        let long = "x".repeat(1 << 16);
        let error = table.row([long]).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::BrokenPipe);
    }

    #[test]
    fn lines_have_their_numbers() {
        let found = lines("\n\na,b\r\n \r\n\n\"1,\"\"2\",\nc", b',').unwrap();
        let numbers: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
        assert_eq!(numbers, [3, 6, 7]);
        let cells: Vec<Vec<&str>> = found
            .iter()
            .map(|(_, cells)| cells.iter().collect())
            .collect();
        assert_eq!(cells, [vec!["a", "b"], vec!["1,\"2", ""], vec!["c"]]);
        assert_eq!(lines("\n \n", b','), Ok(vec![]));
        // A quoted cell that is empty is no blank line.
        assert_eq!(lines("\"\"", b',').unwrap().len(), 1);
    }

    #[test]
    fn quotes_end_on_their_line() {
        for open in ["a\n\n\"1,2\n", "a\n\n\"1,2", "a\n\nb,\"2\n3\"\n"] {
            assert_eq!(lines(open, b','), Err(OpenQuote { line: 3 }), "{open:?}");
        }
    }
}
