//! Somebody else's results: a table of claims, each decided again exactly.
//!
//! A row names a graph and claims a verdict, a number of components, a rank, or several of
//! these. Columns are known by their names (letters of either case):
//!
//! | column | holds |
//! |---|---|
//! | `graph` | a path, `path:line` for a line of a graph6 file, or a graph6 line |
//! | `file` | a file name in the folder of graphs |
//! | `name` | a name in the folder of graphs, with or without what follows the dot |
//! | `verdict` | `solvable`, `finite-solvable`, `not-finite-solvable`, `not-solvable` |
//! | `components`, `components_...` | a number of maximal finite-solvable components |
//! | `solutions` | how many solutions there are: a number, `1` meaning solvable |
//! | `rank` | the generic rank of J_P (calibrated: of N; affine: four times that of R) |
//! | `model` | `projective`, which is meant where it is not said, `calibrated` or `affine` |
//! | `nodes`, `edges`, `sha256` | size and hash, to tell whether it is the graph that was meant |
//! | `seconds`, `seconds_...`, `density_...` | how long it took, how dense it is: no claim |
//!
//! Any other column is refused, so that no claim is passed over for a slip of the pen, unless the
//! caller names it as one to be ignored. Of several columns that name a graph the first in the
//! order of this table counts.
//!
//! A table is comma-separated values with a head, a JSON list of objects, or JSON objects one
//! after another. Among the latter two the objects that `verify --json` prints are known, whose
//! members are not flat.

mod graphs;
mod ruling;

pub use graphs::{GraphError, graph};
pub use ruling::{Claim, ClaimedVerdict, Named, RowError, Ruling, claim, rule};

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::fmt;
use viewcert::wording::counted;
use viewcert_formats::csv;

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// Its line in the table, from 1.
    pub line: usize,
    /// The cells by the names of their columns, in lower case.
    pub cells: BTreeMap<String, String>,
    /// Cameras and pairs of every component, where they are listed.
    pub sizes: Option<Vec<(usize, usize)>>,
}

/// Why a table cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct TableError {
    /// The line of the table, from 1.
    pub line: usize,
    /// What is wrong there.
    pub problem: TableProblem,
}

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableProblem {
    /// Nothing at all.
    #[error("the table is empty: a head with the names of the columns is needed")]
    Empty,
    /// A head, or a list, of nothing.
    #[error("the table has no rows, and so claims nothing")]
    NoRows,
    /// A column, or a member, that says nothing here.
    #[error(
        "unknown column {0:?}; known are graph, file, name, verdict, components, solutions, rank, model, nodes, edges, \
         sha256, and seconds and density, which claim nothing; correct it, or leave it out with \
         --ignore {0}"
    )]
    Column(String),
    /// A column, or a member, more than once.
    #[error("column {0:?} stands there twice")]
    Twice(String),
    /// A row has more or fewer cells than the head.
    #[error("{}, and the head has {expected}", counted(*.found, "cell"))]
    Cells {
        /// Cells of the head.
        expected: usize,
        /// Cells of the line.
        found: usize,
    },
    /// A quoted cell does not end.
    #[error("a quoted cell does not end on its line")]
    Quote,
    /// A list or an object in the place of a value.
    #[error("{0:?} is a list or an object; a row takes strings and numbers")]
    Nested(String),
    /// The output of `verify --json`, but not as it is written.
    #[error("not a line as `verify --json` writes it: {0}")]
    Report(String),
    /// Not JSON, or not a list of objects.
    #[error("not a JSON list of objects, nor one object after another: {0}")]
    Json(String),
}

impl TableProblem {
    fn at(self, line: usize) -> TableError {
        TableError {
            line,
            problem: self,
        }
    }
}

/// Whether a column is known; the names are in lower case.
fn is_known(column: &str) -> bool {
    matches!(
        column,
        "graph"
            | "file"
            | "name"
            | "verdict"
            | "components"
            | "solutions"
            | "rank"
            | "model"
            | "nodes"
            | "edges"
            | "sha256"
            | "seconds"
    ) || ["components_", "seconds_", "density_"]
        .iter()
        .any(|prefix| column.starts_with(prefix))
}

/// Reads a table (see the module): JSON if it begins with `[` or `{`, comma-separated values with a
/// head otherwise (cells may stand in double quotes, which are doubled within). Columns named in
/// `ignored` are left out.
///
/// # Errors
/// See [`TableError`].
pub fn read_table(text: &str, ignored: &[String]) -> Result<Vec<Row>, TableError> {
    let text = text.trim_start_matches('\u{feff}');
    let ignored: Vec<String> = ignored.iter().map(|name| name.to_lowercase()).collect();
    let rows = if text.trim_start().starts_with(['[', '{']) {
        read_json(text, &ignored)?
    } else {
        read_csv(text, &ignored)?
    };
    if rows.is_empty() {
        return Err(TableProblem::NoRows.at(1));
    }
    Ok(rows)
}

fn read_csv(text: &str, ignored: &[String]) -> Result<Vec<Row>, TableError> {
    let lines = csv::lines(text).map_err(|quote| TableProblem::Quote.at(quote.line))?;
    let mut lines = lines.into_iter();
    let (number, head) = lines.next().ok_or(TableProblem::Empty.at(1))?;
    let head: Vec<String> = head.iter().map(|cell| cell.trim().to_lowercase()).collect();
    for (k, column) in head.iter().enumerate() {
        if !is_known(column) && !ignored.contains(column) {
            return Err(TableProblem::Column(column.clone()).at(number));
        }
        if head[..k].contains(column) {
            return Err(TableProblem::Twice(column.clone()).at(number));
        }
    }
    lines
        .map(|(line, cells)| {
            if cells.len() != head.len() {
                let (expected, found) = (head.len(), cells.len());
                return Err(TableProblem::Cells { expected, found }.at(line));
            }
            let cells = cells.iter().map(str::to_owned);
            let cells = head.iter().cloned().zip(cells);
            Ok(Row {
                line,
                cells: cells
                    .filter(|(column, _)| !ignored.contains(column))
                    .collect(),
                sizes: None,
            })
        })
        .collect()
}

/// The members of a JSON object in their order, repeated ones included.
struct Members(Vec<(String, Json)>);

impl<'de> Deserialize<'de> for Members {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Object;
        impl<'de> Visitor<'de> for Object {
            type Value = Members;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members, A::Error> {
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

fn read_json(text: &str, ignored: &[String]) -> Result<Vec<Row>, TableError> {
    let is_list = text.trim_start().starts_with('[');
    let objects: Result<Vec<Members>, serde_json::Error> = if is_list {
        serde_json::from_str(text)
    } else {
        serde_json::Deserializer::from_str(text)
            .into_iter()
            .collect()
    };
    let objects =
        objects.map_err(|error| TableProblem::Json(error.to_string()).at(error.line().max(1)))?;
    let lines = lines_of_objects(text, usize::from(is_list));
    objects
        .into_iter()
        .zip(lines)
        .map(|(Members(members), line)| {
            row(members, ignored, line).map_err(|problem| problem.at(line))
        })
        .collect()
}

/// The lines, from 1, on which the objects at a depth of nesting begin in a JSON text.
fn lines_of_objects(text: &str, depth: usize) -> Vec<usize> {
    let (mut line, mut open, mut quoted, mut escaped) = (1, 0usize, false, false);
    let mut lines = Vec::new();
    for byte in text.bytes() {
        line += usize::from(byte == b'\n');
        match byte {
            _ if escaped => escaped = false,
            b'\\' if quoted => escaped = true,
            b'"' => quoted = !quoted,
            _ if quoted => {}
            b'{' | b'[' => {
                if byte == b'{' && open == depth {
                    lines.push(line);
                }
                open += 1;
            }
            b'}' | b']' => open = open.saturating_sub(1),
            _ => {}
        }
    }
    lines
}

/// The row of an object.
fn row(members: Vec<(String, Json)>, ignored: &[String], line: usize) -> Result<Row, TableProblem> {
    if members
        .iter()
        .any(|(name, value)| name == "graph" && value.is_object())
    {
        return reported(members, line);
    }
    let mut cells = BTreeMap::new();
    for (name, value) in members {
        let name = name.to_lowercase();
        if ignored.contains(&name) {
            continue;
        }
        if !is_known(&name) {
            return Err(TableProblem::Column(name));
        }
        let cell = match value {
            Json::Null => String::new(),
            Json::String(text) => text,
            Json::Array(_) | Json::Object(_) => return Err(TableProblem::Nested(name)),
            other => other.to_string(),
        };
        if cells.insert(name.clone(), cell).is_some() {
            return Err(TableProblem::Twice(name));
        }
    }
    Ok(Row {
        line,
        cells,
        sizes: None,
    })
}

/// What `verify --json` writes about a graph, as far as it is a claim; how it was found (strengths,
/// mode, time) is none.
#[derive(Deserialize)]
struct Reported {
    graph: ReportedGraph,
    model: String,
    verdict: String,
    /// Missing where an earlier version did not count.
    #[serde(default)]
    solutions: Option<ReportedSolutions>,
    rank: usize,
    rank_required: usize,
    components: Vec<ReportedComponent>,
}

#[derive(Deserialize)]
struct ReportedGraph {
    name: String,
    nodes: usize,
    edges: usize,
    sha256: String,
}

/// Bounds are how it was found; the number is a claim.
#[derive(Deserialize)]
struct ReportedSolutions {
    exactly: Option<usize>,
}

#[derive(Deserialize)]
struct ReportedComponent {
    nodes: usize,
    edges: usize,
}

/// The members of a line of `verify --json`; see `report::json`.
const REPORTED: [&str; 34] = [
    "graph",
    "parts",
    "read",
    "notes",
    "database",
    "tracks",
    "model",
    "displacements",
    "verdict",
    "condition",
    "strength",
    "error_log2",
    "solutions",
    "rank",
    "rank_required",
    "rank_strength",
    "kind",
    "format",
    "program",
    "seed",
    "prime",
    "because",
    "components",
    "components_strength",
    "conditions",
    "planar",
    "mode",
    "seconds",
    "joints",
    "joints_complete",
    "weak",
    "suggestions",
    "explain",
    "export",
];

fn reported(members: Vec<(String, Json)>, line: usize) -> Result<Row, TableProblem> {
    let mut object = serde_json::Map::new();
    for (name, value) in members {
        if !REPORTED.contains(&name.as_str()) {
            return Err(TableProblem::Report(format!("unknown member {name:?}")));
        }
        if name == "displacements" {
            let why = "it rests on known displacements, without which it is another claim";
            return Err(TableProblem::Report(why.into()));
        }
        if object.insert(name.clone(), value).is_some() {
            return Err(TableProblem::Twice(name));
        }
    }
    // What is decided again is the graph alone.
    if object.contains_key("parts") {
        let why = "the report is about a graph with known parts, which is not decided again here";
        return Err(TableProblem::Report(why.to_owned()));
    }
    let found: Reported = serde_json::from_value(Json::Object(object))
        .map_err(|error| TableProblem::Report(error.to_string()))?;
    let exactly = found.solutions.and_then(|solutions| solutions.exactly);
    let cells = [
        (
            "solutions",
            exactly.map_or_else(String::new, |number| number.to_string()),
        ),
        ("graph", found.graph.name),
        ("model", found.model),
        ("verdict", found.verdict),
        ("rank", found.rank.to_string()),
        ("rank_required", found.rank_required.to_string()),
        ("components", found.components.len().to_string()),
        ("nodes", found.graph.nodes.to_string()),
        ("edges", found.graph.edges.to_string()),
        ("sha256", found.graph.sha256),
    ];
    let sizes = found.components.iter().map(|part| (part.nodes, part.edges));
    Ok(Row {
        line,
        cells: cells.map(|(name, cell)| (name.to_owned(), cell)).into(),
        sizes: Some(sizes.collect()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables() {
        let csv = "Name,Components,seconds_mine\n\"Tower, \"\"London\"\"\",4,x\r\n\nRome,1,\n";
        let rows = read_table(csv, &[]).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[0].cells["name"], "Tower, \"London\"");
        assert_eq!((rows[0].line, rows[1].line), (2, 4));
        assert_eq!(rows[1].cells["components"], "1");
        let windows = "name,rank\r\n \r\na,1\r\nb,\"2\"\r\n";
        let rows = read_table(windows, &[]).unwrap();
        assert_eq!((rows[0].line, rows[1].line), (3, 4));
        let ranks = [&rows[0].cells["rank"], &rows[1].cells["rank"]];
        assert_eq!(ranks, ["1", "2"]);
        let json = "[\n{\"Graph\": \"C~{\\\"\", \"components\": 1,\n \"rank\": null},\n{}]";
        let rows = read_table(json, &[]).unwrap();
        assert_eq!(rows[0].cells["graph"], "C~{\"");
        assert_eq!(rows[0].cells["components"], "1");
        assert_eq!(rows[0].cells["rank"], "");
        assert_eq!((rows[0].line, rows[1].line), (2, 4));
        let lines = "{\"graph\": \"C~\"}\n\n{\"graph\": \"Cl\"} {\"rank\": 3}\n";
        let rows = read_table(lines, &[]).unwrap();
        let found: Vec<usize> = rows.iter().map(|row| row.line).collect();
        assert_eq!(found, [1, 3, 3]);
        let ignored = ["Note".to_owned()];
        let rows = read_table("name,note\na,b\n", &ignored).unwrap();
        assert_eq!(rows[0].cells.len(), 1);
    }

    #[test]
    fn tables_that_are_none() {
        use TableProblem as P;
        let problem = |text: &str| {
            let error = read_table(text, &[]).unwrap_err();
            (error.line, error.problem)
        };
        let cells = |expected, found| P::Cells { expected, found };
        assert_eq!(problem("name,rank\n1,2\n3\n"), (3, cells(2, 1)));
        assert_eq!(problem("name,rank\n\n1,2,3\n"), (3, cells(2, 3)));
        for open in [
            "\"1,2\n",
            "\"1,2",
            "1,\"2\n3,4\n",
            "1,\"2\n3\"\n",
            "\r\n1,\"2\r\n",
        ] {
            let line = 2 + usize::from(open.starts_with('\r'));
            assert_eq!(
                problem(&format!("name,rank\n{open}")),
                (line, P::Quote),
                "{open:?}"
            );
        }
        assert_eq!(problem("\n"), (1, P::Empty));
        for none in ["name,rank\n", "[]", "[ ]\n"] {
            assert_eq!(problem(none), (1, P::NoRows), "{none}");
        }
        let column = |name: &str| P::Column(name.into());
        assert_eq!(problem("name,component\na,1\n"), (1, column("component")));
        assert_eq!(problem("[{},\n{\"vedict\": 1}]"), (2, column("vedict")));
        assert_eq!(problem("name,Name\na,b\n"), (1, P::Twice("name".into())));
        let twice = "{\"rank\": 1, \"RANK\": 2}";
        assert_eq!(problem(twice), (1, P::Twice("rank".into())));
        for nested in ["[1]", "{}"] {
            let text = format!("{{\"graph\": \"C~\"}}\n{{\"rank\": {nested}}}");
            assert_eq!(problem(&text), (2, P::Nested("rank".into())));
        }
        for bad in ["[1, 2]", "[{}", "{\"rank\": 1} x"] {
            assert!(matches!(problem(bad), (1, P::Json(_))), "{bad}");
        }
        let report = "{\"graph\": {\"name\": \"a\"}}";
        assert!(matches!(problem(report), (1, P::Report(_))));
    }
}
