//! Why an input is not a viewing graph: where, what, and what to do about it.

use std::fmt;

use crate::colmap::DatabaseError;
use crate::edge_list::refusal::Refusal;
use crate::inflate::{Damaged, Inflated};
use crate::sparse6::Sparse6Error;
use viewcert::graph::graph6::Graph6Error;

/// An input that was refused, ready to be shown: `file:line: problem; what to do`.
#[derive(Debug, thiserror::Error)]
#[error("{file}{place}: {problem}; {}", .problem.remedy())]
pub struct ReadError {
    /// The file as it was named, `-` for standard input.
    pub file: String,
    /// Where in the file.
    pub place: Place,
    /// What is wrong there.
    pub problem: Problem,
}

impl ReadError {
    /// What the input is called: its path, and of a file with a graph on every line the line too.
    pub fn input(&self) -> String {
        match (&self.problem, &self.place) {
            (Problem::Graph6(_) | Problem::Sparse6(_), Place::Line(line)) => {
                format!("{}:{line}", self.file)
            }
            _ => self.file.clone(),
        }
    }
}

/// A refusal before the name of the file is known to it.
#[derive(Debug)]
pub struct Fault {
    /// Where in the input.
    pub place: Place,
    /// What is wrong there.
    pub problem: Problem,
}

impl Fault {
    pub(super) fn in_file(self, file: &str) -> ReadError {
        ReadError {
            file: file.to_owned(),
            place: self.place,
            problem: self.problem,
        }
    }
}

/// The part of an input that a problem belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The input as a whole.
    Input,
    /// A line of text, counted from 1.
    Line(u64),
    /// A variable of a MATLAB file.
    Variable(String),
}

impl Place {
    pub(super) fn fault(self, problem: Problem) -> Fault {
        Fault {
            place: self,
            problem,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input => Ok(()),
            Self::Line(line) => write!(f, ":{line}"),
            Self::Variable(name) => write!(f, ": variable {name}"),
        }
    }
}

/// What is wrong with an input. Rows and columns of matrices count from 1.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// The operating system refuses the file.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] std::io::Error),
    /// A file of tracks where pairs are read.
    #[error("this is {0}")]
    Tracks(&'static str),
    /// What only one reader refuses, in its words.
    #[error("{}", .0.what)]
    Refused(Refusal),
    /// Compressed data that end too early or contradict their checksum.
    #[error("the compressed data are damaged: {0}")]
    Compressed(#[source] std::io::Error),
    /// Compressed data that are much larger than they look.
    #[error(transparent)]
    Inflated(#[from] Inflated),
    /// No nodes at all.
    #[error("the graph is empty")]
    NoNodes,
    /// More nodes than a graph can hold.
    #[error("the graph has more than 4294967295 nodes")]
    TooManyNodes,
    /// More pairs than the program numbers.
    #[error("the graph has more than 2147483647 pairs")]
    TooManyPairs,
    /// A number of nodes that few pairs go with.
    #[error("{nodes} nodes and {pairs} pairs: more than {limit} nodes without pairs")]
    TooManyIsolated {
        /// How many nodes.
        nodes: u64,
        /// How many pairs.
        pairs: usize,
        /// How many nodes without pairs are allowed.
        limit: u64,
    },
    /// A pair of a camera with itself.
    #[error("camera {0} is paired with itself")]
    SelfLoop(String),
    /// Bytes that are no UTF-8.
    #[error("this is no UTF-8 text")]
    NotUtf8,
    /// A zero byte, which no text has.
    #[error("this is no text: it has a NUL byte")]
    Nul,
    /// A carriage return that is not the end of a line.
    #[error("there is a carriage return within the line")]
    CarriageReturn,
    /// Another control character.
    #[error("this is no plain text: it has the control character {0:#04x}")]
    Control(u8),
    /// U+FEFF somewhere else than at the start.
    #[error("there is a byte order mark (U+FEFF) within the text")]
    InnerMark,
    /// A comma with nothing on one side of it.
    #[error("there is an empty field")]
    EmptyField,
    /// A quote where none belongs; what is wrong with it.
    #[error("a quote (\") {0}")]
    Quote(&'static str),
    /// A line that contradicts all earlier ones.
    #[error("the lines before are {format}, and this one is not: {why}")]
    Unlike {
        /// What the others are.
        format: &'static str,
        /// Why this one is not.
        why: Box<Problem>,
    },
    /// A line that no machine holds.
    #[error("the line is longer than {limit} bytes")]
    LineTooLarge {
        /// The longest line that is read.
        limit: u64,
    },
    /// A line that is not graph6.
    #[error(transparent)]
    Graph6(#[from] Graph6Error),
    /// A line that is not sparse6.
    #[error(transparent)]
    Sparse6(#[from] Sparse6Error),
    /// The file ends before what it promises.
    #[error("the file is truncated: {0}")]
    Truncated(String),
    /// The file contradicts itself or its format.
    #[error("the file is corrupt: {0}")]
    Corrupt(String),
    /// A database that gives no graph.
    #[error(transparent)]
    Database(Box<DatabaseError>),
    /// A folder, where nobody has asked for tracks.
    #[error("this is a folder with a model of COLMAP: cameras, images and points")]
    Model,
    /// Cameras, and no point that they see.
    #[error(
        "this is {what} with {} and no points: it says where they are, and not what they see",
        viewcert::wording::counted(*.cameras, "camera")
    )]
    NoPoints {
        /// What it is.
        what: &'static str,
        /// What to do about it.
        advice: &'static str,
        /// How many cameras.
        cameras: usize,
    },
    /// A folder that is no model, and holds models or databases.
    #[error("this is a folder that holds {}", .0.join(", "))]
    Holds(Vec<String>),
    /// Something wrong with another file than the one that was named.
    #[error("{part}: {problem}")]
    Within {
        /// The other file, and the place in it.
        part: String,
        /// What is wrong there.
        problem: Box<Problem>,
    },
}

impl Problem {
    /// What was seen, and what to do about it.
    pub(super) fn new(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Refused(Refusal::new(what, remedy))
    }

    /// Data of another kind, which is known by name.
    pub(super) fn foreign(what: &str, remedy: &str) -> Self {
        Self::new(format!("this is {what}, which is not read here"), remedy)
    }

    /// An option that says nothing about such an input.
    pub(super) fn unused(option: &str, why: &str) -> Self {
        Self::new(format!("{option}: {why}"), "leave it out")
    }

    /// What whoever gave the input can do about it.
    pub fn remedy(&self) -> &str {
        match self {
            Self::Refused(refusal) => &refusal.remedy,
            Self::Unreadable(error) if error.kind() == std::io::ErrorKind::IsADirectory => {
                "name the files in it; a folder is read as a model of COLMAP alone, with --tracks"
            }
            Self::Unreadable(_) => "check its path and permissions",
            Self::NoPoints { advice, .. } => advice,
            Self::Compressed(_) => "copy the file again, and test it (`gzip -t`)",
            Self::Inflated(_) => "if you trust it, unpack it first (`gunzip`)",
            Self::NoNodes => "give at least one pair of cameras",
            Self::TooManyNodes | Self::TooManyPairs => "split it into its connected components",
            Self::TooManyIsolated { .. } => "leave out what has no pairs",
            Self::SelfLoop(_) => {
                "remove the pair (or the line, if it holds counts); --skip-loops leaves such pairs out"
            }
            Self::NotUtf8 | Self::CarriageReturn => "save it as UTF-8 with line feeds",
            Self::Nul | Self::Control(_) => {
                "give an edge list, graph6, sparse6, MatrixMarket or a MATLAB file (save -v7)"
            }
            Self::InnerMark => "remove it; files with such marks cannot be joined byte by byte",
            Self::EmptyField => "put a field on either side of every separator",
            Self::Quote(_) => "quote whole fields only, and double the quotes within them",
            Self::Unlike { .. } => "name the format with --format, or mend the line",
            Self::LineTooLarge { .. } => "write the graph as an edge list or in sparse6",
            Self::Graph6(_) | Self::Sparse6(_) => {
                "write the line again, or have it written: `verify convert GRAPH --to graph6` (where other \
                 formats are read, --format names them)"
            }
            Self::Truncated(_) | Self::Corrupt(_) => "copy or write the file again",
            Self::Database(error) => error.remedy(),
            Self::Model | Self::Tracks(_) => {
                "it holds tracks, not pairs of images: --tracks decides the graph of its cameras and points"
            }
            Self::Holds(_) => "name one of these (a model is read with --tracks)",
            Self::Within { problem, .. } => problem.remedy(),
        }
    }

    /// Whether it is refused where pairs are read since it holds tracks.
    pub fn holds_tracks(&self) -> bool {
        matches!(self, Self::Model | Self::Tracks(_))
    }

    /// Whether a text is refused for its form, which may be that of another format.
    pub(super) fn is_grammar(&self) -> bool {
        matches!(
            self,
            Self::Refused(_) | Self::EmptyField | Self::Quote(_) | Self::SelfLoop(_)
        )
    }

    /// Whether nothing is wrong with the input but its size.
    pub fn is_size(&self) -> bool {
        match self {
            Self::Inflated(_)
            | Self::TooManyNodes
            | Self::TooManyPairs
            | Self::TooManyIsolated { .. }
            | Self::LineTooLarge { .. }
            | Self::Sparse6(Sparse6Error::TooLarge { .. }) => true,
            Self::Unlike { why, .. } => why.is_size(),
            Self::Within { problem, .. } => problem.is_size(),
            _ => false,
        }
    }
}

impl From<Refusal> for Problem {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<DatabaseError> for Problem {
    fn from(error: DatabaseError) -> Self {
        Self::Database(Box::new(error))
    }
}

impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        match error.downcast::<Inflated>() {
            Ok(inflated) => Self::Inflated(inflated),
            Err(error) => match error.downcast::<Damaged>() {
                Ok(Damaged(error)) => Self::Compressed(error),
                Err(error) => Self::Unreadable(error),
            },
        }
    }
}
