//! Comma-separated values by lines, so that an error can name the line.

use csv::StringRecord;

/// A quoted cell that does not end on its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenQuote {
    /// The line, from 1.
    pub line: usize,
}

/// The lines of comma-separated values that are not blank, with their numbers from 1. A row may
/// have any number of cells; they may stand in double quotes, which are doubled within.
///
/// # Errors
/// A quoted cell that does not end on its line.
pub fn lines(text: &str) -> Result<Vec<(usize, StringRecord)>, OpenQuote> {
    // With its last line ended, a quoted cell that does not end has a line end in it.
    let text = format!("{text}\n");
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .terminator(csv::Terminator::Any(b'\n'))
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
            lines.push((line, without_carriage_return(&cells)));
        }
    }
    Ok(lines)
}

fn without_carriage_return(cells: &StringRecord) -> StringRecord {
    let last = cells.len().saturating_sub(1);
    let cells = cells.iter().enumerate();
    cells
        .map(|(k, cell)| match k {
            k if k == last => cell.trim_end_matches('\r'),
            _ => cell,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_their_numbers() {
        let found = lines("\n\na,b\r\n \r\n\n\"1,\"\"2\",\nc").unwrap();
        let numbers: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
        assert_eq!(numbers, [3, 6, 7]);
        let cells: Vec<Vec<&str>> = found
            .iter()
            .map(|(_, cells)| cells.iter().collect())
            .collect();
        assert_eq!(cells, [vec!["a", "b"], vec!["1,\"2", ""], vec!["c"]]);
        assert_eq!(lines("\n \n"), Ok(vec![]));
        // A quoted cell that is empty is no blank line.
        assert_eq!(lines("\"\"").unwrap().len(), 1);
    }

    #[test]
    fn quotes_end_on_their_line() {
        for open in ["a\n\n\"1,2\n", "a\n\n\"1,2", "a\n\nb,\"2\n3\"\n"] {
            assert_eq!(lines(open), Err(OpenQuote { line: 3 }), "{open:?}");
        }
    }
}
