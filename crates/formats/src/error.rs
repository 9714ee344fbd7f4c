//! Why an input is not a viewing graph: where, what, and what to do about it.

use std::borrow::Cow;
use std::fmt;
use std::io::ErrorKind;

use crate::inflate::{Damaged, Inflated};
use viewcert::wording::counted;

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
        match (&self.problem.kind, &self.place) {
            (Kind::Line | Kind::LineSize, Place::Line(line)) => format!("{}:{line}", self.file),
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

/// Something wrong with the input as a whole.
impl From<Problem> for Fault {
    fn from(problem: Problem) -> Self {
        Place::Input.fault(problem)
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

/// What is wrong with an input, and what to do about it. Rows and columns of matrices count from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct Problem {
    pub(super) what: String,
    remedy: Cow<'static, str>,
    /// What whoever handles it may ask.
    pub kind: Kind,
}

/// Kinds of problems, as far as anything is done about them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The form of a text, which may be that of another format.
    Form,
    /// One graph of many is none, and the next may be one.
    Line,
    /// The same, and nothing is wrong but the size.
    LineSize,
    /// Nothing is wrong but the size.
    Size,
    /// The file ends before what it promises.
    Truncated,
    /// There are no nodes.
    Empty,
    /// There are so many cameras, and no point that they see.
    NoPoints(usize),
    /// A file of tracks where pairs are read.
    Tracks,
    /// A folder with a model of COLMAP where pairs are read.
    Model,
    /// A folder that is no model, and holds these models and databases.
    Holds(Box<[String]>),
    /// A database whose lists of matches are gone.
    NoLists,
    /// A database whose keypoints are damaged.
    Keypoints,
    /// Anything else.
    Other,
}

const TRACKS: &str =
    "it holds tracks, not pairs of images: --tracks decides the graph of its cameras and points";

impl Problem {
    /// What was seen, and what to do about it.
    pub(super) fn of(
        kind: Kind,
        what: impl Into<String>,
        remedy: impl Into<Cow<'static, str>>,
    ) -> Self {
        let (what, remedy) = (what.into(), remedy.into());
        Self { what, remedy, kind }
    }

    /// The form of a text.
    pub(super) fn new(what: impl Into<String>, remedy: impl Into<Cow<'static, str>>) -> Self {
        Self::of(Kind::Form, what, remedy)
    }

    /// Data of another kind, which is known by name.
    pub(super) fn foreign(what: &str, remedy: impl Into<Cow<'static, str>>) -> Self {
        Self::new(format!("this is {what}, which is not read here"), remedy)
    }

    /// An option that says nothing about such an input.
    pub(super) fn unused(option: &str, why: &str) -> Self {
        Self::new(format!("{option}: {why}"), "leave it out")
    }

    /// The operating system refuses the file.
    pub(super) fn unreadable(error: &std::io::Error) -> Self {
        let remedy = match error.kind() {
            ErrorKind::IsADirectory => {
                "name the files in it; a folder is read as a model of COLMAP alone, with --tracks"
            }
            _ => "check its path and permissions",
        };
        Self::of(Kind::Other, format!("cannot be read: {error}"), remedy)
    }

    /// The file ends before what it promises.
    pub(super) fn truncated(what: impl fmt::Display) -> Self {
        let what = format!("the file is truncated: {what}");
        Self::of(Kind::Truncated, what, "copy or write the file again")
    }

    /// The file contradicts itself or its format.
    pub(super) fn corrupt(what: impl fmt::Display) -> Self {
        let what = format!("the file is corrupt: {what}");
        Self::of(Kind::Other, what, "copy or write the file again")
    }

    pub(super) fn no_nodes() -> Self {
        Self::of(
            Kind::Empty,
            "the graph is empty",
            "give at least one pair of cameras",
        )
    }

    pub(super) fn too_many_nodes() -> Self {
        let what = "the graph has more than 4294967295 nodes";
        Self::of(Kind::Size, what, "split it into its connected components")
    }

    pub(super) fn too_many_pairs() -> Self {
        let what = "the graph has more than 2147483647 pairs";
        Self::of(Kind::Size, what, "split it into its connected components")
    }

    /// A pair of a camera with itself.
    pub(super) fn self_loop(label: &str) -> Self {
        Self::new(
            format!("camera {label} is paired with itself"),
            "remove the pair (or the line, if it holds counts); --skip-loops leaves such pairs out",
        )
    }

    pub(super) fn not_utf8() -> Self {
        Self::of(
            Kind::Other,
            "this is no UTF-8 text",
            "save it as UTF-8 with line feeds",
        )
    }

    /// A character that no text has, which the line may not hold.
    pub(super) fn control(bytes: &[u8], byte: u8) -> Self {
        let formats =
            "give an edge list, graph6, sparse6, MatrixMarket or a MATLAB file (save -v7)";
        let (what, remedy) = match byte {
            _ if byte == 0 || bytes.contains(&0) => {
                ("this is no text: it has a NUL byte".to_owned(), formats)
            }
            b'\r' => (
                "there is a carriage return within the line".to_owned(),
                "save it as UTF-8 with line feeds",
            ),
            _ => (
                format!("this is no plain text: it has the control character {byte:#04x}"),
                formats,
            ),
        };
        Self::of(Kind::Other, what, remedy)
    }

    /// A separator with nothing on one side of it.
    pub(super) fn empty_field() -> Self {
        let what = "there is an empty field";
        Self::new(what, "put a field on either side of every separator")
    }

    /// A quote where none belongs.
    pub(super) fn quote(what: &str) -> Self {
        let remedy = "quote whole fields only, and double the quotes within them";
        Self::new(format!("a quote (\") {what}"), remedy)
    }

    /// A line that no machine holds.
    pub(super) fn long_line(limit: u64) -> Self {
        let what = format!("the line is longer than {limit} bytes");
        Self::of(
            Kind::Size,
            what,
            "write the graph as an edge list or in sparse6",
        )
    }

    /// A file of tracks where pairs are read.
    pub(super) fn tracks(what: &str) -> Self {
        Self::of(Kind::Tracks, format!("this is {what}"), TRACKS)
    }

    /// A folder, where nobody has asked for tracks.
    pub(super) fn model() -> Self {
        let what = "this is a folder with a model of COLMAP: cameras, images and points";
        Self::of(Kind::Model, what, TRACKS)
    }

    /// Cameras, and no point that they see.
    pub(super) fn no_points(what: &str, advice: &'static str, cameras: usize) -> Self {
        let with = counted(cameras, "camera");
        let why = "it says where they are, and not what they see";
        let what = format!("this is {what} with {with} and no points: {why}");
        Self::of(Kind::NoPoints(cameras), what, advice)
    }

    /// The same in another file than the one that was named.
    pub(super) fn within(self, part: &str) -> Self {
        let what = format!("{part}: {}", self.what);
        Self { what, ..self }
    }

    /// What whoever gave the input can do about it.
    pub fn remedy(&self) -> &str {
        &self.remedy
    }

    /// Whether it is refused where pairs are read since it holds tracks.
    pub fn holds_tracks(&self) -> bool {
        matches!(self.kind, Kind::Model | Kind::Tracks)
    }

    /// Whether nothing is wrong with the input but its size.
    pub fn is_size(&self) -> bool {
        matches!(self.kind, Kind::Size | Kind::LineSize)
    }
}

impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        match error.downcast::<Inflated>() {
            Ok(inflated) => inflated.into(),
            Err(error) => match error.downcast::<Damaged>() {
                Ok(Damaged(error)) => Self::of(
                    Kind::Other,
                    format!("the compressed data are damaged: {error}"),
                    "copy the file again, and test it (`gzip -t`)",
                ),
                Err(error) => Self::unreadable(&error),
            },
        }
    }
}

impl From<Inflated> for Problem {
    fn from(inflated: Inflated) -> Self {
        let remedy = "if you trust it, unpack it first (`gunzip`)";
        Self::of(Kind::Size, inflated.to_string(), remedy)
    }
}
