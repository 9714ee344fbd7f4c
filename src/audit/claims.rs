//! Somebody else's results: a table of claims, each decided again exactly.
//!
//! A row names a graph and claims a verdict, a number of components, a rank, or several of
//! these. Columns are known by their names (letters of either case):
//!
//! | column | holds |
//! |---|---|
//! | `graph` | a path, or a graph6 line |
//! | `file` | a file name in the folder of graphs |
//! | `name` | a name in the folder of graphs, with or without what follows the dot |
//! | `verdict` | `solvable`, `finite-solvable`, `not-finite-solvable`, `not-solvable` |
//! | `components`, `components_...` | a number of maximal finite-solvable components |
//! | `rank` | the generic rank of J_P |
//! | `nodes`, `edges` | the size, to tell whether it is the graph that was meant |
//!
//! Other columns are not looked at. Of several columns that name a graph the first in the
//! order of this table counts.

use serde_json::Value as Json;
use std::collections::BTreeMap;

use crate::verdict::{Value, Verdict};

/// The cells of a row by the names of their columns, in lower case.
pub type Row = BTreeMap<String, String>;

/// Why a table cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// No rows at all.
    #[error("the table is empty: a head with the names of the columns is needed")]
    Empty,
    /// A row has more or fewer cells than the head.
    #[error("line {line}: {found} cells, and the head has {expected}")]
    Cells {
        /// The line, from 1.
        line: usize,
        /// Cells of the head.
        expected: usize,
        /// Cells of the line.
        found: usize,
    },
    /// A quoted cell does not end.
    #[error("line {0}: a quoted cell does not end on its line")]
    Quote(usize),
    /// Not JSON, or not a list of objects.
    #[error("not a JSON list of objects: {0}")]
    Json(String),
}

/// Why a row has no claim that can be decided.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RowError {
    /// No column names a graph.
    #[error("no graph is named: one of the columns graph, file, name is needed")]
    NoGraph,
    /// Nothing is claimed.
    #[error("nothing is claimed: one of the columns verdict, components, rank is needed")]
    NoClaim,
    /// A cell does not hold a number.
    #[error("{column}: {text:?} is not a number")]
    Number {
        /// The column.
        column: String,
        /// What it holds.
        text: String,
    },
    /// A cell does not hold a verdict.
    #[error(
        "verdict: {0:?} is not one of solvable, finite-solvable, not-finite-solvable, not-solvable"
    )]
    Verdict(String),
    /// Two claims exclude each other, whatever the graph.
    #[error("the claims contradict each other: {0}")]
    Contradiction(String),
}

/// A claimed verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimedVerdict {
    /// The cameras are unique.
    Solvable,
    /// There are finitely many sets of cameras.
    FiniteSolvable,
    /// There are infinitely many.
    NotFiniteSolvable,
    /// There is more than one.
    NotSolvable,
}

impl ClaimedVerdict {
    fn parse(text: &str) -> Result<Self, RowError> {
        match text.trim().to_lowercase().replace([' ', '_'], "-").as_str() {
            "solvable" => Ok(Self::Solvable),
            "finite-solvable" => Ok(Self::FiniteSolvable),
            "not-finite-solvable" => Ok(Self::NotFiniteSolvable),
            "not-solvable" => Ok(Self::NotSolvable),
            _ => Err(RowError::Verdict(text.to_owned())),
        }
    }

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solvable => "solvable",
            Self::FiniteSolvable => "finite-solvable",
            Self::NotFiniteSolvable => "not-finite-solvable",
            Self::NotSolvable => "not-solvable",
        }
    }
}

/// How a graph is named.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Named {
    /// A path or a graph6 line.
    Graph(String),
    /// A file in the folder of graphs.
    File(String),
    /// A name in the folder of graphs.
    Name(String),
}

/// What a row claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Of which graph.
    pub graph: Named,
    /// Its size, if given.
    pub nodes: Option<usize>,
    /// Its size, if given.
    pub edges: Option<usize>,
    /// The verdict.
    pub verdict: Option<ClaimedVerdict>,
    /// The number of components.
    pub components: Option<usize>,
    /// The rank.
    pub rank: Option<usize>,
}

/// What the exact decision says about a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ruling {
    /// All that was claimed is so.
    Confirmed,
    /// Something is not; what.
    Refuted(Vec<String>),
    /// Something is neither confirmed nor refuted; why.
    NotDecidable(String),
}

/// Reads a table: a JSON list of objects if it begins with `[`, comma-separated values with
/// a head otherwise (cells may stand in double quotes, which are doubled within).
///
/// # Errors
/// See [`TableError`].
pub fn read_table(text: &str) -> Result<Vec<Row>, TableError> {
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with('[') {
        return read_json(text);
    }
    let mut lines = (1..)
        .zip(text.lines())
        .filter(|(_, line)| !line.trim().is_empty());
    let (number, head) = lines.next().ok_or(TableError::Empty)?;
    let head: Vec<String> = cells(head, number)?
        .iter()
        .map(|cell| cell.trim().to_lowercase())
        .collect();
    lines
        .map(|(line, text)| {
            let cells = cells(text, line)?;
            if cells.len() != head.len() {
                return Err(TableError::Cells {
                    line,
                    expected: head.len(),
                    found: cells.len(),
                });
            }
            Ok(head.iter().cloned().zip(cells).collect())
        })
        .collect()
}

fn read_json(text: &str) -> Result<Vec<Row>, TableError> {
    let fail = |error: &dyn std::fmt::Display| TableError::Json(error.to_string());
    let rows: Vec<serde_json::Map<String, Json>> =
        serde_json::from_str(text).map_err(|error| fail(&error))?;
    let cell = |value: Json| match value {
        Json::Null => String::new(),
        Json::String(text) => text,
        other => other.to_string(),
    };
    Ok(rows
        .into_iter()
        .map(|row| {
            let cells = row.into_iter();
            cells
                .map(|(name, value)| (name.to_lowercase(), cell(value)))
                .collect()
        })
        .collect())
}

/// The cells of a line.
fn cells(line: &str, number: usize) -> Result<Vec<String>, TableError> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut characters = line.trim_end_matches('\r').chars().peekable();
    while let Some(c) = characters.next() {
        let Some(cell) = cells.last_mut() else { break };
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' if quoted || cell.is_empty() => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cell.push(c),
        }
    }
    if quoted {
        return Err(TableError::Quote(number));
    }
    Ok(cells)
}

/// The claim of a row.
///
/// # Errors
/// See [`RowError`].
pub fn claim(row: &Row) -> Result<Claim, RowError> {
    let cell = |name: &str| {
        row.get(name)
            .map(|text| text.trim())
            .filter(|text| !text.is_empty())
    };
    let number = |column: &str, text: &str| {
        text.trim().parse::<usize>().map_err(|_| RowError::Number {
            column: column.to_owned(),
            text: text.to_owned(),
        })
    };
    let size = |name: &str| cell(name).map(|text| number(name, text)).transpose();
    let graph = cell("graph")
        .map(|text| Named::Graph(text.to_owned()))
        .or_else(|| cell("file").map(|text| Named::File(text.to_owned())))
        .or_else(|| cell("name").map(|text| Named::Name(text.to_owned())))
        .ok_or(RowError::NoGraph)?;
    let mut components: Option<(&str, usize)> = None;
    let columns = row
        .keys()
        .filter(|column| *column == "components" || column.starts_with("components_"));
    for column in columns {
        let Some(text) = cell(column) else { continue };
        let value = number(column, text)?;
        match components {
            Some((other, before)) if before != value => {
                return Err(RowError::Contradiction(format!(
                    "{other} is {before}, {column} is {value}"
                )));
            }
            _ => components = Some((column, value)),
        }
    }
    let claim = Claim {
        graph,
        nodes: size("nodes")?,
        edges: size("edges")?,
        verdict: cell("verdict").map(ClaimedVerdict::parse).transpose()?,
        components: components.map(|(_, value)| value),
        rank: size("rank")?,
    };
    if claim.verdict.is_none() && claim.components.is_none() && claim.rank.is_none() {
        return Err(RowError::NoClaim);
    }
    let finite = matches!(
        claim.verdict,
        Some(ClaimedVerdict::Solvable | ClaimedVerdict::FiniteSolvable)
    );
    let infinite = claim.verdict == Some(ClaimedVerdict::NotFiniteSolvable);
    if let Some(count) = claim.components
        && (finite && count > 1)
    {
        return Err(RowError::Contradiction(format!(
            "{} has one component, not {count}",
            claim.verdict.map_or("", ClaimedVerdict::name)
        )));
    }
    if let (Some(rank), Some(nodes)) = (claim.rank, claim.nodes) {
        let full = (11 * nodes).saturating_sub(15);
        let excluded = rank > full || finite && rank < full || infinite && rank == full;
        if excluded {
            return Err(RowError::Contradiction(format!(
                "rank {rank} of {full} at most{}",
                claim
                    .verdict
                    .map_or(String::new(), |verdict| format!(", and {}", verdict.name()))
            )));
        }
    }
    Ok(claim)
}

/// Holds a claim against the exact verdict.
pub fn rule(claim: &Claim, nodes: usize, edges: usize, verdict: &Verdict) -> Ruling {
    let other = |what, claimed: Option<usize>, found| {
        let claimed = claimed.filter(|&claimed| claimed != found)?;
        Some(format!("the row has {claimed} {what}, the graph {found}"))
    };
    let sizes = other("nodes", claim.nodes, nodes).or_else(|| other("edges", claim.edges, edges));
    if let Some(why) = sizes {
        return Ruling::NotDecidable(format!("another graph is meant: {why}"));
    }
    let mut wrong = Vec::new();
    let mut open = None;
    if let Some(claimed) = claim.verdict {
        use ClaimedVerdict as C;
        match (claimed, verdict.value) {
            (C::Solvable, Value::FiniteSolvable) | (C::NotSolvable, Value::FiniteSolvable) => {
                open = Some(
                    "finite solvable, and whether one or several sets of cameras is not decided"
                        .to_owned(),
                );
            }
            (C::Solvable | C::FiniteSolvable, Value::NotFiniteSolvable)
            | (C::NotFiniteSolvable, Value::Solvable | Value::FiniteSolvable)
            | (C::NotSolvable, Value::Solvable) => {
                wrong.push(format!(
                    "claimed {}, is {}",
                    claimed.name(),
                    verdict.value.name()
                ));
            }
            _ => {}
        }
    }
    for (what, claimed, found) in [
        ("components", claim.components, verdict.components.len()),
        ("rank", claim.rank, verdict.rank),
    ] {
        if let Some(claimed) = claimed.filter(|&claimed| claimed != found) {
            wrong.push(format!("claimed {what} {claimed}, is {found}"));
        }
    }
    match open {
        _ if !wrong.is_empty() => Ruling::Refuted(wrong),
        Some(why) => Ruling::NotDecidable(why),
        None => Ruling::Confirmed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::verdict::{Options, decide};

    fn row(cells: &[(&str, &str)]) -> Row {
        let owned = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
        cells.iter().map(owned).collect()
    }

    #[test]
    fn tables() {
        let csv = "Name,Components,note\n\"Tower, \"\"London\"\"\",4,x\r\n\nRome,1,\n";
        let rows = read_table(csv).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[0]["name"], "Tower, \"London\"");
        assert_eq!(rows[1]["components"], "1");
        let json = r#"[{"Graph": "C~", "components": 1, "rank": null}]"#;
        let rows = read_table(json).unwrap();
        assert_eq!(rows[0]["graph"], "C~");
        assert_eq!(rows[0]["components"], "1");
        assert_eq!(rows[0]["rank"], "");
        let cells = TableError::Cells {
            line: 3,
            expected: 2,
            found: 1,
        };
        assert_eq!(read_table("a,b\n1,2\n3\n"), Err(cells));
        assert_eq!(read_table("a,b\n\"1,2\n"), Err(TableError::Quote(2)));
        assert_eq!(read_table("\n"), Err(TableError::Empty));
        assert!(matches!(read_table("[1, 2]"), Err(TableError::Json(_))));
    }

    #[test]
    fn claims_that_are_none() {
        let error = |cells| claim(&row(cells)).unwrap_err().to_string();
        assert!(error(&[("rank", "3")]).contains("no graph"));
        assert!(error(&[("graph", "C~"), ("components", " ")]).contains("nothing is claimed"));
        assert!(error(&[("graph", "C~"), ("rank", "-1")]).contains("not a number"));
        assert!(error(&[("graph", "C~"), ("verdict", "maybe")]).contains("\"maybe\""));
        let two = [("file", "x"), ("components_a", "1"), ("components_b", "4")];
        assert!(error(&two).contains("contradict"));
        let both = [("file", "x"), ("verdict", "solvable"), ("components", "2")];
        assert!(error(&both).contains("contradict"));
        let full = [
            ("file", "x"),
            ("verdict", "not finite solvable"),
            ("rank", "29"),
            ("nodes", "4"),
        ];
        assert!(error(&full).contains("contradict"));
    }

    /// Every claim against every verdict.
    #[test]
    fn rulings() {
        let graph =
            |nodes, pairs: &[(u32, u32)]| Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0;
        let triangle = graph(3, &[(0, 1), (0, 2), (1, 2)]);
        let square = graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
        let ruled = |graph: &Graph, cells: &[(&str, &str)]| {
            let verdict = decide(graph, &Options::default()).unwrap();
            let mut cells = cells.to_vec();
            cells.push(("file", "x"));
            let claim = claim(&row(&cells)).unwrap();
            rule(&claim, graph.nodes(), graph.edges().len(), &verdict)
        };
        for (verdict, of_triangle, of_square) in [
            ("solvable", true, false),
            ("finite-solvable", true, false),
            ("not-finite-solvable", false, true),
            ("not-solvable", false, true),
        ] {
            let confirmed = |graph| ruled(graph, &[("verdict", verdict)]) == Ruling::Confirmed;
            assert_eq!(confirmed(&triangle), of_triangle, "{verdict}");
            assert_eq!(confirmed(&square), of_square, "{verdict}");
        }
        assert_eq!(
            ruled(&square, &[("components", "4"), ("rank", "28")]),
            Ruling::Confirmed
        );
        let wrong = ruled(&square, &[("components", "1"), ("rank", "29")]);
        let expected = ["claimed components 1, is 4", "claimed rank 29, is 28"];
        assert_eq!(wrong, Ruling::Refuted(expected.map(String::from).to_vec()));
        let other = ruled(&square, &[("components", "4"), ("nodes", "5")]);
        assert!(matches!(other, Ruling::NotDecidable(_)));
    }
}
