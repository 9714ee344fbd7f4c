//! How an input was read: what every report begins with.
//!
//! A graph is only worth as much as the reading of its file, so each reader says what it took the
//! file for, what of it became the graph, and what it left out, guessed or merged.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use viewcert::graph::{Graph, Labels};

/// What a reader of one format returns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parsed {
    /// The graph.
    pub graph: Graph,
    /// What its nodes are called.
    pub labels: Labels,
    /// How it was read.
    pub read: ReadAs,
    /// What was merged, ignored or guessed, in sentences.
    pub notes: Vec<String>,
}

/// How an input was read; the member `read` of reports.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReadAs {
    /// What it was taken for: `edge list`, `graph6`, `COLMAP database`.
    pub format: Cow<'static, str>,
    /// What it was compressed by, if it was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compression: Option<Cow<'static, str>>,
    /// What of it became the graph: `names in columns 1 and 2`, `variable A`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub taken: Option<String>,
    /// What was left out, a short phrase each: `column 3 (weights?)`, `4 lines of comments`.
    pub ignored: Vec<String>,
    /// What was decided by the look of the content, a short phrase each.
    pub guessed: Vec<String>,
    /// How many pairs were given again, the same or reversed, and merged.
    pub merged: usize,
    /// What had to be said to read it so, as [`ReadOptions::given`](crate::ReadOptions::given) has it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub options: BTreeMap<String, String>,
}

impl ReadAs {
    /// An input of which only the format is worth saying.
    pub fn new(format: &'static str) -> Self {
        Self {
            format: Cow::Borrowed(format),
            ..Self::default()
        }
    }
}

/// One line: `edge list, names in columns 1 and 2; ignored: column 3 (weights?)`.
impl fmt::Display for ReadAs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.format)?;
        if let Some(compression) = &self.compression {
            write!(f, ", compressed by {compression}")?;
        }
        if let Some(taken) = &self.taken {
            write!(f, ", {taken}")?;
        }
        for (title, phrases) in [("guessed", &self.guessed), ("ignored", &self.ignored)] {
            if !phrases.is_empty() {
                write!(f, "; {title}: {}", phrases.join(", "))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line() {
        let plain = ReadAs::new("graph6");
        assert_eq!(plain.to_string(), "graph6");
        let list = ReadAs {
            compression: Some("gzip".into()),
            taken: Some("names in columns 1 and 2".into()),
            ignored: vec!["column 3 (weights?)".into(), "4 lines of comments".into()],
            guessed: vec!["the first line is a head".into()],
            merged: 3,
            ..ReadAs::new("edge list")
        };
        assert_eq!(
            list.to_string(),
            "edge list, compressed by gzip, names in columns 1 and 2; guessed: the first line is a \
             head; ignored: column 3 (weights?), 4 lines of comments"
        );
    }
}
