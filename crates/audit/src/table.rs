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

/// Reads a table that may have these columns, between blanks, and others that claim nothing. A name that ends with `_`
/// stands for all that begin so.
///
/// # Errors
/// The table is refused whole.
pub(crate) fn read(text: &str, known: &str, silent: &str) -> Result<Vec<Row>, TableError> {
    let refused = |line, problem: String| TableError { line, problem };
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with(['[', '{']) {
        let problem = "this is JSON, and a table of claims is CSV; in Python: \
                       pandas.read_json('FILE').to_csv('claims.csv', index=False)";
        return Err(refused(1, problem.to_owned()));
    }
    let head = text.lines().find(|line| !line.trim().is_empty());
    let has = |&byte: &u8| head.is_some_and(|head| head.contains(char::from(byte)));
    let separator = [b'\t', b';'].into_iter().find(has).unwrap_or(b',');
    let lines = csv::lines(text, separator);
    let quote = "a quoted cell does not end on its line".to_owned();
    let lines = lines.map_err(|open| refused(open.line, quote))?;
    let [(number, head), rows @ ..] = &lines[..] else {
        let why = "the table is empty: a head with the names of the columns is needed";
        return Err(refused(1, why.to_owned()));
    };
    let head: Vec<String> = head.iter().map(|cell| cell.trim().to_lowercase()).collect();
    let is = |column: &str, names: &str| {
        let is = |name: &str| column == name || name.ends_with('_') && column.starts_with(name);
        names.split_whitespace().any(is)
    };
    for (k, column) in head.iter().enumerate() {
        if !is(column, known) && !is(column, silent) {
            let names = known.split_whitespace().filter(|name| !name.ends_with('_'));
            let names = names.collect::<Vec<_>>().join(", ");
            let hint = format!("known are {names}; correct it, or leave it out");
            return Err(refused(
                *number,
                format!("unknown column {column:?}; {hint}"),
            ));
        }
        if head[..k].contains(column) {
            return Err(refused(
                *number,
                format!("column {column:?} stands there twice"),
            ));
        }
    }
    if rows.is_empty() {
        let why = "the table has no rows, and so claims nothing";
        return Err(refused(1, why.to_owned()));
    }
    let row = |(line, cells): &(usize, csv::StringRecord)| {
        if cells.len() != head.len() {
            let found = counted(cells.len(), "cell");
            let why = format!("{found}, and the head has {}", head.len());
            return Err(refused(*line, why));
        }
        let cells = head.iter().zip(cells.iter().map(str::trim));
        let cells = cells.filter(|(column, cell)| is(column, known) && !cell.is_empty());
        let cells = cells
            .map(|(column, cell)| (column.clone(), unguarded(cell)))
            .collect();
        Ok(Row { line: *line, cells })
    };
    rows.iter().map(row).collect()
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

    fn read(text: &str) -> Result<Vec<Row>, TableError> {
        super::read(
            text,
            "graph name components components_ rank",
            "seconds seconds_",
        )
    }

    #[test]
    fn tables() {
        let csv = "Name,Components,seconds_mine\n\"Tower, \"\"London\"\"\",4,x\r\n\nRome,1,\n";
        for text in [csv, &csv.replace(',', ";"), &csv.replace(',', "\t")] {
            let rows = read(text).unwrap();
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
        let rows = read(windows).unwrap();
        assert_eq!((rows[0].line, rows[1].line), (3, 4));
        assert_eq!([&rows[0].cells["rank"], &rows[1].cells["rank"]], ["1", "2"]);
        assert_eq!(rows[1].cells["name"], "=b");
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
            let error = read(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}
