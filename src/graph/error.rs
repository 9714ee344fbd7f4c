//! Why an input is not a viewing graph: where, what, and what to do about it.

use std::fmt;

use super::graph6::Graph6Error;

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
    /// Binary data of no known format.
    #[error("binary data of a format that is not read here")]
    UnknownFormat,
    /// As many lines speak for graph6 as for an edge list.
    #[error("could be graph6 as well as an edge list")]
    AmbiguousFormat,
    /// A relative of graph6.
    #[error("{0} is not read here")]
    OtherEncoding(&'static str),
    /// No nodes at all.
    #[error("the graph is empty")]
    NoNodes,
    /// Nodes, but nothing between them.
    #[error("the graph has no pairs, only isolated nodes ({nodes})")]
    NoPairs {
        /// How many nodes.
        nodes: usize,
    },
    /// More nodes than a graph can hold.
    #[error("the graph has more than 4294967295 nodes")]
    TooManyNodes,
    /// A pair of a camera with itself.
    #[error("camera {0} is paired with itself")]
    SelfLoop(String),
    /// Bytes that are no text.
    #[error("not plain UTF-8 text")]
    NotText,
    /// A line that no edge list has.
    #[error("the line is longer than {limit} bytes")]
    LineTooLong {
        /// The longest line that is read.
        limit: usize,
    },
    /// A line that is not graph6.
    #[error(transparent)]
    Graph6(#[from] Graph6Error),
    /// A MATLAB file of level 4.
    #[error("a MATLAB file of version 4 is not read here")]
    MatlabFour,
    /// A MATLAB file of level 7.3, which is HDF5.
    #[error("a MATLAB file of version 7.3 (HDF5) is not read here")]
    MatlabHdf5,
    /// The file ends before what it promises.
    #[error("the file is truncated: {0}")]
    Truncated(String),
    /// The file contradicts itself or its format.
    #[error("the file is corrupt: {0}")]
    Corrupt(String),
    /// The variable asked for is not there.
    #[error("there is no such variable; the file holds {present}")]
    NoSuchVariable {
        /// The variables that are there, described.
        present: String,
    },
    /// No variable, or more than one, that could be the adjacency.
    #[error("no variable A and {candidates} square matrices; the file holds {present}")]
    ChooseVariable {
        /// How many variables could be meant.
        candidates: usize,
        /// The variables that are there, described.
        present: String,
    },
    /// Cells, structures, text.
    #[error("a {0} is not a numeric matrix")]
    NotNumeric(&'static str),
    /// Complex numbers.
    #[error("the matrix is complex")]
    Complex,
    /// Not as many rows as columns, or more than two dimensions.
    #[error("the matrix is {0}, not square")]
    NotSquare(String),
    /// An entry that is not a number.
    #[error("entry ({row}, {column}) is not a number (NaN)")]
    NotANumber {
        /// Row, from 1.
        row: u32,
        /// Column, from 1.
        column: u32,
    },
    /// An entry without its mirror image.
    #[error(
        "the matrix is not symmetric: ({row}, {column}) is non-zero, ({column}, {row}) is zero"
    )]
    Asymmetric {
        /// Row of the non-zero entry, from 1.
        row: u32,
        /// Its column, from 1.
        column: u32,
    },
    /// A camera paired with itself, in a matrix.
    #[error("diagonal entry ({0}, {0}) is non-zero: a camera paired with itself")]
    Diagonal(u32),
}

impl Problem {
    /// What whoever gave the input can do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Unreadable(_) => "check its path and permissions",
            Self::UnknownFormat => "give an edge list, graph6 or a MATLAB 5 file (save -v7)",
            Self::AmbiguousFormat => "say which it is with --format",
            Self::OtherEncoding(_) => {
                "convert it to graph6, for example with `copyg -g` of nauty, or to an edge list"
            }
            Self::NoNodes => "give at least one pair of cameras",
            Self::NoPairs { .. } => {
                "give at least one pair of cameras, or name the format with --format"
            }
            Self::TooManyNodes => "split it into its connected components",
            Self::SelfLoop(_) => "remove the pair",
            Self::NotText => "save it as UTF-8 with line feeds, or name the format with --format",
            Self::LineTooLong { .. } => "put one pair on a line, or name the format with --format",
            Self::Graph6(_) => {
                "write the line again (where other formats are read, --format names them)"
            }
            Self::MatlabFour | Self::MatlabHdf5 => "save it in MATLAB with -v7 or -v6",
            Self::Truncated(_) | Self::Corrupt(_) => "copy or write the file again",
            Self::NoSuchVariable { .. } | Self::ChooseVariable { .. } => {
                "name the adjacency matrix with --variable"
            }
            Self::NotNumeric(_) | Self::NotSquare(_) => {
                "name a square numeric matrix with --variable"
            }
            Self::Complex => "save its real part, or the matrix of its non-zero entries",
            Self::NotANumber { .. } => "put zero where there is no pair",
            Self::Asymmetric { .. } => "save A | A' if the direction of pairs does not matter",
            Self::Diagonal(_) => "set the diagonal to zero",
        }
    }
}
