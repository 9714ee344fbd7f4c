//! Tables of what somebody claims: values between commas, semicolons or tabs below a head.
//!
//! In: a text. Out: its rows with their lines; a table that may not say what its author means is refused whole.

use std::collections::BTreeMap;
use std::str::FromStr;
use viewcert::wording::counted;
use viewcert_formats::csv;

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Its line in the table, from 1.
    pub line: usize,
    /// The cells that are not blank by the names of their columns, in lower case.
    pub cells: BTreeMap<String, String>,
}

/// Why a table cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct TableError {
    /// The line of the table, from 1.
    pub line: usize,
    /// What is wrong there, and what to do.
    pub problem: String,
}

/// Why a row has no claim that can be decided.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BadRow(pub String);

/// The columns of a kind of table, between blanks.
#[derive(Clone, Copy)]
pub(crate) struct Columns<'a> {
    /// Those that claim something. A name that ends with `_` stands for all that begin so.
    known: &'static str,
    /// Those that claim nothing.
    silent: &'static str,
    /// Those of the caller that claim nothing.
    ignored: &'a [String],
}

/// A line, and what is wrong there.
type Problem = (usize, String);

impl<'a> Columns<'a> {
    pub(crate) fn new(known: &'static str, silent: &'static str, ignored: &'a [String]) -> Self {
        Self {
            known,
            silent,
            ignored,
        }
    }

    /// Whether the cells of a column are kept; an error where it is not known.
    fn keeps(&self, column: &str) -> Result<bool, String> {
        let is = |name: &&str| column == *name || name.ends_with('_') && column.starts_with(name);
        let is_ignored = self
            .ignored
            .iter()
            .any(|name| name.to_lowercase() == column);
        let [known, silent] = [self.known, self.silent].map(str::split_whitespace);
        match (known.clone().any(|name| is(&name)), is_ignored) {
            (true, false) => Ok(true),
            (false, false) if !silent.clone().any(|name| is(&name)) => Err(format!(
                "unknown column {column:?}; known are {}; correct it, leave it out, or name it with --ignore {column:?}",
                known
                    .filter(|name| !name.ends_with('_'))
                    .collect::<Vec<_>>()
                    .join(", ")
            )),
            _ => Ok(false),
        }
    }

    /// Reads a table.
    pub(crate) fn read(&self, text: &str) -> Result<Vec<Row>, TableError> {
        let text = text.trim_start_matches('\u{feff}');
        if text.trim_start().starts_with(['[', '{']) {
            let problem = "this is JSON, and a table of claims is CSV; in Python: \
                           pandas.read_json('FILE').to_csv('claims.csv', index=False)";
            return Err(TableError {
                line: 1,
                problem: problem.to_owned(),
            });
        }
        let rows = self.lines(text);
        let none = (1, "the table has no rows, and so claims nothing".to_owned());
        let rows = rows.and_then(|rows| if rows.is_empty() { Err(none) } else { Ok(rows) });
        rows.map_err(|(line, problem)| TableError { line, problem })
    }

    fn lines(&self, text: &str) -> Result<Vec<Row>, Problem> {
        let mut heads = text.lines().filter(|line| !line.trim().is_empty());
        let head = heads.next().unwrap_or_default();
        let mut separators = [b'\t', b';'].into_iter();
        let separator = separators.find(|&byte| head.contains(char::from(byte)));
        let lines = csv::lines(text, separator.unwrap_or(b','));
        let quote = "a quoted cell does not end on its line".to_owned();
        let mut lines = lines.map_err(|open| (open.line, quote))?.into_iter();
        let empty = "the table is empty: a head with the names of the columns is needed".to_owned();
        let (number, head) = lines.next().ok_or((1, empty))?;
        let head: Vec<String> = head.iter().map(|cell| cell.trim().to_lowercase()).collect();
        let mut kept = Vec::with_capacity(head.len());
        for (k, column) in head.iter().enumerate() {
            kept.push(self.keeps(column).map_err(|problem| (number, problem))?);
            if head[..k].contains(column) {
                return Err((number, format!("column {column:?} stands there twice")));
            }
        }
        let row = |(line, cells): (usize, csv::StringRecord)| {
            if cells.len() != head.len() {
                let found = counted(cells.len(), "cell");
                return Err((line, format!("{found}, and the head has {}", head.len())));
            }
            let cells = head.iter().zip(cells.iter().map(str::trim)).zip(&kept);
            let cells = cells.filter(|((_, cell), is_kept)| **is_kept && !cell.is_empty());
            let cells = cells.map(|((column, cell), _)| (column.clone(), unguarded(cell)));
            let cells = cells.collect();
            Ok(Row { line, cells })
        };
        lines.map(row).collect()
    }
}

/// A cell without the apostrophe that keeps programs from taking it for a formula.
fn unguarded(cell: &str) -> String {
    let bare = cell
        .strip_prefix('\'')
        .filter(|bare| bare.starts_with(['=', '+', '-', '@']));
    bare.unwrap_or(cell).to_owned()
}

impl Row {
    /// What stands in a column, if anything does.
    pub(crate) fn cell(&self, column: &str) -> Option<&str> {
        self.cells.get(column).map(String::as_str)
    }

    /// The same as something else, or what it is not.
    pub(crate) fn parsed<T: FromStr>(&self, column: &str, what: &str) -> Result<Option<T>, BadRow> {
        let wrong = |text| BadRow(format!("{column}: {text:?} is not {what}"));
        let cell = self
            .cell(column)
            .map(|text| text.parse().map_err(|_| wrong(text)));
        cell.transpose()
    }

    /// The same as a number of things.
    pub(crate) fn count(&self, column: &str) -> Result<Option<usize>, BadRow> {
        self.parsed(column, "a number of things: 0, 1, 2, ...")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: Columns = Columns {
        known: "graph name components components_ rank",
        silent: "seconds seconds_",
        ignored: &[],
    };

    #[test]
    fn tables() {
        let csv = "Name,Components,seconds_mine\n\"Tower, \"\"London\"\"\",4,x\r\n\nRome,1,\n";
        for text in [csv, &csv.replace(',', ";"), &csv.replace(',', "\t")] {
            let rows = COLUMNS.read(text).unwrap();
            assert_eq!(rows.len(), 2);
            assert!(
                rows[0].cells["name"].starts_with("Tower")
                    && rows[0].cells["name"].ends_with("\"London\"")
            );
            assert_eq!((rows[0].line, rows[1].line), (2, 4));
            assert_eq!(rows[1].cells["components"], "1");
            assert_eq!(rows[1].cells.len(), 2);
        }
        let windows = "\u{feff}name,rank\r\n \r\na,1\r\n'=b,\"2\"\r\n";
        let rows = COLUMNS.read(windows).unwrap();
        assert_eq!((rows[0].line, rows[1].line), (3, 4));
        assert_eq!([&rows[0].cells["rank"], &rows[1].cells["rank"]], ["1", "2"]);
        assert_eq!(rows[1].cells["name"], "=b");
        let ignored = ["Note".to_owned()];
        let columns = Columns {
            ignored: &ignored,
            ..COLUMNS
        };
        assert_eq!(columns.read("name,note\na,b\n").unwrap()[0].cells.len(), 1);
    }

    #[test]
    fn tables_that_are_none() {
        for (text, line, why) in [
            ("name,rank\n1,2\n3\n", 3, "1 cell, and the head has 2"),
            ("name;rank\n\n1;2;3\n", 3, "3 cells, and the head has 2"),
            ("name,rank\n\"1,2\n", 2, "quoted"),
            ("name,rank\n1,\"2\n3,4\n", 2, "quoted"),
            ("name,rank\n\r\n1,\"2\r\n", 3, "quoted"),
            ("\n", 1, "empty"),
            ("name,rank\n", 1, "no rows"),
            ("name,component\na,1\n", 1, "unknown column \"component\""),
            ("name,Name\na,b\n", 1, "twice"),
            ("[{}", 1, "this is JSON"),
            ("{\"rank\": 1}\n", 1, "pandas.read_json"),
        ] {
            let error = COLUMNS.read(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}
