//! Tables of what somebody claims: values between commas, semicolons or tabs below a head, a JSON list of objects, or
//! JSON objects one after another.
//!
//! In: a text. Out: its rows with their lines; a table that may not say what its author means is refused whole.

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use serde_json::{Map, Value as Json};
use std::collections::BTreeMap;
use std::fmt;
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
    /// An object that the program itself wrote, whose members are no cells.
    pub record: Option<Json>,
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
        let rows = match text.trim_start().starts_with(['[', '{']) {
            true => self.objects(text),
            false => self.lines(text),
        };
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
            let (cells, record) = (cells.collect(), None);
            Ok(Row {
                line,
                cells,
                record,
            })
        };
        lines.map(row).collect()
    }

    fn objects(&self, text: &str) -> Result<Vec<Row>, Problem> {
        let mut stream = serde_json::Deserializer::from_str(text).into_iter();
        let found: Result<Vec<&RawValue>, _> = match text.trim_start().starts_with('[') {
            true => serde_json::from_str(text),
            false => stream.by_ref().collect(),
        };
        let none = |error: serde_json::Error| {
            format!("not a JSON list of objects, nor one object after another: {error}")
        };
        let found = found.map_err(|error| (error.line().max(1), none(error)))?;
        let row = |raw: &&RawValue| {
            let before = raw.get().as_ptr() as usize - text.as_ptr() as usize;
            let line = 1 + text[..before].matches('\n').count();
            let members = serde_json::from_str(raw.get()).map_err(|error| (line, none(error)))?;
            self.object(members, line)
                .map_err(|problem| (line, problem))
        };
        found.iter().map(row).collect()
    }

    fn object(&self, Members(members): Members, line: usize) -> Result<Row, String> {
        let own = ["program", "kind"];
        let is_own = |(name, value): &(String, Json)| {
            own.contains(&&**name) || name == "graph" && value.is_object()
        };
        let is_record = members.iter().any(is_own);
        let mut seen = Map::new();
        for (name, value) in members {
            let name = if is_record { name } else { name.to_lowercase() };
            if !is_record && (value.is_array() || value.is_object()) && self.keeps(&name)? {
                return Err(format!(
                    "{name:?} is a list or an object; a row takes strings and numbers"
                ));
            }
            if is_record || self.keeps(&name)? {
                if seen.contains_key(&name) {
                    return Err(format!("member {name:?} stands there twice"));
                }
                seen.insert(name, value);
            }
        }
        if is_record {
            let (cells, record) = (BTreeMap::new(), Some(Json::Object(seen)));
            return Ok(Row {
                line,
                cells,
                record,
            });
        }
        let cells = seen.into_iter().map(|(name, value)| match value {
            Json::Null => (name, String::new()),
            Json::String(text) => (name, text.trim().to_owned()),
            other => (name, other.to_string()),
        });
        let (cells, record) = (cells.filter(|(_, cell)| !cell.is_empty()).collect(), None);
        Ok(Row {
            line,
            cells,
            record,
        })
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

/// The members of an object as they stand there, one after another.
struct Members(Vec<(String, Json)>);

impl<'de> Deserialize<'de> for Members {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Object;
        impl<'de> Visitor<'de> for Object {
            type Value = Members;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Members, M::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(Object)
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
        let json = "[\n{\"Graph\": \"C~{\\\"\", \"components\": 1,\n \"rank\": null},\n{}]";
        let rows = COLUMNS.read(json).unwrap();
        assert_eq!(rows[0].cells["graph"], "C~{\"");
        assert_eq!(rows[0].cells["components"], "1");
        assert_eq!(rows[0].cells.get("rank"), None);
        assert_eq!((rows[0].line, rows[1].line), (2, 4));
        let lines = "{\"graph\": \"C~\"}\n\n{\"graph\": \"Cl\"} {\"rank\": 3}\n";
        let found: Vec<usize> = COLUMNS
            .read(lines)
            .unwrap()
            .iter()
            .map(|row| row.line)
            .collect();
        assert_eq!(found, [1, 3, 3]);
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
            ("[ ]\n", 1, "no rows"),
            ("name,component\na,1\n", 1, "unknown column \"component\""),
            ("[{},\n{\"vedict\": 1}]", 2, "unknown column \"vedict\""),
            ("name,Name\na,b\n", 1, "twice"),
            ("{\"rank\": 1, \"RANK\": 2}", 1, "twice"),
            ("{\"rank\": null, \"rank\": 2}", 1, "twice"),
            ("{\"program\": 1, \"program\": 2}", 1, "twice"),
            (
                "{\"graph\": \"C~\"}\n{\"rank\": [1]}",
                2,
                "a list or an object",
            ),
            ("[1, 2]", 1, "not a JSON list of objects"),
            ("[{}", 1, "not a JSON list of objects"),
            ("{\"rank\": 1} x", 1, "not a JSON list of objects"),
        ] {
            let error = COLUMNS.read(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}
