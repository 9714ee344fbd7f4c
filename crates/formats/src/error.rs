//! Why an input is not a viewing graph: where, what, and what to do about it.

use std::fmt;

use crate::colmap::DatabaseError;
use crate::edge_list::refusal::{Refusal, shown};
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
    /// Data of another kind, which is known by name.
    #[error("this is {what}, which is not read here")]
    Foreign {
        /// What it is.
        what: &'static str,
        /// What to do about it.
        advice: &'static str,
    },
    /// A file of tracks where pairs are read.
    #[error("this is {0}")]
    Tracks(&'static str),
    /// A file of this program that is no graph.
    #[error("this is {what} that this program has written, and it is not read here")]
    Own {
        /// What it is.
        what: &'static str,
        /// Which command reads it.
        advice: &'static str,
    },
    /// Text that has the form of an edge list and may mean something else.
    #[error("{what}")]
    Doubtful {
        /// What it may be.
        what: &'static str,
        /// What to do about it.
        advice: &'static str,
    },
    /// An option that says nothing about such an input.
    #[error("{option}: {why}")]
    Unused {
        /// The option.
        option: &'static str,
        /// Why.
        why: &'static str,
    },
    /// A text that is no list of pairs, or may be something else.
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
    /// A file of what is given that gives nothing.
    #[error("the file gives nothing")]
    Empty,
    /// A line of such a file that begins with another word.
    #[error("the line begins with `{}`, not with part, displacement or position", shown(.0))]
    NothingGiven(String),
    /// A camera where none are read: beside other things, or through a pipe.
    #[error(
        "`{0}` gives a camera, and cameras are read from a file that holds nothing else, or from standard input (-)"
    )]
    CamerasBeside(String),
    /// Parts and displacements in one such file.
    #[error("known parts stand beside known displacements, and there is no theorem about both")]
    PartsAndDisplacements,
    /// What is given does not go together with the base lines of rigs.
    #[error(
        "the rigs of this input know base lines without their vectors, and {0} do not go together with these"
    )]
    BesideRigs(&'static str),
    /// A label that the graph does not have.
    #[error("`{}` is no camera of the graph", shown(.0))]
    UnknownCamera(String),
    /// A file of classes that says nothing.
    #[error("the file says nothing about intrinsics")]
    NoClasses,
    /// A word that is no class.
    #[error("`{0}` is no class of cameras")]
    NoClass(String),
    /// More than one default class, or none behind the word.
    #[error("there is one default, and one class")]
    OneDefault,
    /// A camera in two classes or sensors: what it is called, and the line before.
    #[error("`{0}` is of another class or sensor in line {1}")]
    TwoClasses(String, u64),
    /// Intrinsics are asked of what is no COLMAP database.
    #[error("this is no COLMAP database, which would say what is known of intrinsics")]
    NoDatabase,
    /// A camera of the graph that a database does not have.
    #[error("the database has no image `{0}`")]
    UnknownImage(String),
    /// A file of known displacements without one.
    #[error("the file holds no displacement")]
    NoDisplacements,
    /// Pose priors with positions of fewer than two cameras.
    #[error("the pose priors of the database give {} of the graph a position, and two are needed", viewcert::wording::counted(*.0, "camera"))]
    NoPositions(usize),
    /// A known displacement without two cameras.
    #[error("the line does not name two cameras")]
    NoPair,
    /// A known position without a camera.
    #[error("the line names no camera")]
    NoCamera,
    /// Fields behind cameras that are no vector.
    #[error("{found} fields stand behind the cameras, and a vector has three")]
    NoVector {
        /// How many fields.
        found: usize,
    },
    /// A line with a vector where others have none, or the other way round.
    #[error("some lines have vectors, and others have none")]
    SomeVectors,
    /// A coordinate that is no number, and why.
    #[error("`{}` is {why}", shown(.field))]
    NoCoordinate {
        /// What stands there.
        field: String,
        /// What that is.
        why: viewcert::graph::CoordinateError,
    },
    /// A vector that is not what others say.
    #[error("this contradicts the lines before it: their vectors add up to another one")]
    Contradiction,
    /// Two cameras of which the vectors say that they have the same centre.
    #[error("`{}` and `{}` are at one place", shown(.first), shown(.second))]
    SamePlace {
        /// One camera.
        first: String,
        /// The other.
        second: String,
    },
    /// Vectors that have too many digits as multiples of one unit.
    #[error("as multiples of one unit, the vectors have more than 30 digits")]
    LongVectors,
    /// A line with a camera that has another number of fields.
    #[error("{found} numbers stand behind the camera, and {expected} are expected")]
    NoCameraNumbers {
        /// How many there have to be.
        expected: usize,
        /// How many fields.
        found: usize,
    },
    /// What is no number that could be computed with exactly.
    #[error("`{}` is no decimal number with an exponent up to 400, and no fraction", shown(.0))]
    NoRational(String),
    /// Cameras and centres, or something else besides cameras, in one file.
    #[error("lines with {0} stand beside others")]
    MixedCameras(&'static str),
    /// A camera that is given again.
    #[error("the camera of `{}` is given twice", shown(.0))]
    CameraTwice(String),
    /// A camera without a centre, in words.
    #[error("{0}")]
    NoCentre(String),
    /// Nodes without a camera.
    #[error("no camera is given for {} of the graph; `{}` is the first", viewcert::wording::counted(*.missing, "node"), shown(.first))]
    MissingCameras {
        /// The first one.
        first: String,
        /// How many there are.
        missing: usize,
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
    /// A name of nothing.
    #[error("a camera has an empty name")]
    EmptyLabel,
    /// A name that would not stay on its line.
    #[error("the name \"{}\" has a control character", shown(.0))]
    ControlInLabel(String),
    /// A text that is not as its format says.
    #[error("{format}: {what}")]
    Malformed {
        /// The format's name.
        format: &'static str,
        /// What is wrong.
        what: String,
    },
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
    /// Something in a MatrixMarket file that is not as it has to be.
    #[error("MatrixMarket: {0}")]
    MatrixMarket(String),
    /// A MATLAB file whose numbers are stored the other way round.
    #[error("a MATLAB file of a big-endian machine is not read here")]
    MatlabBigEndian,
    /// A MATLAB file of level 7.3, which is HDF5.
    #[error("HDF5, as MATLAB writes it in version 7.3, is not read here")]
    MatlabHdf5,
    /// The file ends before what it promises.
    #[error("the file is truncated: {0}")]
    Truncated(String),
    /// The file contradicts itself or its format.
    #[error("the file is corrupt: {0}")]
    Corrupt(String),
    /// A database that gives no graph.
    #[error(transparent)]
    Database(Box<DatabaseError>),
    /// No tracks where they are asked for.
    #[error("no tracks are found in this file")]
    NoTracks,
    /// A part of a model without its tracks.
    #[error(
        "there is no model here: points3D.bin or points3D.txt, which holds the tracks, is missing"
    )]
    NoModel,
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
    /// An entry that is not a number, or is infinite.
    #[error("entry ({row}, {column}) is {}", if .value.is_nan() {"not a number (NaN)"} else {"infinite"})]
    NotANumber {
        /// Row, as the format counts.
        row: u32,
        /// Column, likewise.
        column: u32,
        /// The entry.
        value: f64,
    },
    /// No variable that could be an adjacency.
    #[error("there is no square matrix; the file holds {present}")]
    NoMatrix {
        /// The variables that are there, described.
        present: String,
    },
    /// An entry without its mirror image.
    #[error(
        "the matrix is not symmetric: ({row}, {column}) is non-zero, ({column}, {row}) is zero"
    )]
    Asymmetric {
        /// Row of the non-zero entry, as the format counts.
        row: u32,
        /// Its column, likewise.
        column: u32,
    },
    /// A camera paired with itself, in a matrix.
    #[error("diagonal entry ({0}, {0}) is non-zero: a camera paired with itself")]
    Diagonal(u32),
}

impl Problem {
    /// What whoever gave the input can do about it.
    pub fn remedy(&self) -> &str {
        match self {
            Self::Refused(refusal) => &refusal.remedy,
            Self::Unreadable(error) if error.kind() == std::io::ErrorKind::IsADirectory => {
                "name the files in it; a folder is read as a model of COLMAP alone, with --tracks"
            }
            Self::Unreadable(_) => "check its path and permissions",
            Self::Foreign { advice, .. }
            | Self::Own { advice, .. }
            | Self::Doubtful { advice, .. }
            | Self::NoPoints { advice, .. } => advice,
            Self::Compressed(_) => "copy the file again, and test it (`gzip -t`, `bzip2 -t`)",
            Self::Inflated(_) => "if you trust it, unpack it first (`gunzip`, `bunzip2`)",
            Self::Unused { .. } => "leave it out",
            Self::NoNodes => "give at least one pair of cameras",
            Self::Empty | Self::NothingGiven(_) => {
                "write on each line `part` and cameras whose relative position is known, `displacement` and two cameras, or `position` and a camera"
            }
            Self::CamerasBeside(_) => {
                "write one camera for each of the graph into a file of their own and name it"
            }
            Self::PartsAndDisplacements => "leave out one of the two",
            Self::BesideRigs(_) => "leave the rigs out of account (--no-rigs), or what is given",
            Self::UnknownCamera(_) => {
                "call cameras what the graph calls them; one without pairs stands alone on a line of an edge list (--format edges)"
            }
            Self::NoPositions(_) => {
                "import positions into the database, or write the cameras whose position is known into a file, `position` before each"
            }
            Self::NoClasses | Self::NoClass(_) | Self::OneDefault => {
                "write on each line `known`, `focal`, `focal+point` or `unknown`, for what is not known of their intrinsics, and cameras (`shared` before the class if they are images of one sensor); and on one line `default` and a class for the others"
            }
            Self::TwoClasses(..) => "name each camera once",
            Self::NoDatabase | Self::UnknownImage(_) => {
                "give a file with the classes of cameras: --intrinsics FILE"
            }
            Self::NoDisplacements => {
                "write pairs of cameras, one a line, or cameras with known positions, two at least"
            }
            Self::NoPair | Self::NoCamera | Self::NoVector { .. } => {
                "write `displacement` and two cameras, or `position` and one; behind them, on all lines or on none, the vector from the first to the second, or the position, as three numbers"
            }
            Self::NoCameraNumbers { .. } | Self::NoRational(_) => {
                "write `camera`, a name and the 12 entries of its matrix, row by row; or `pose`, a name, a quaternion (real part first) and a translation; or `centre`, a name and three coordinates"
            }
            Self::MixedCameras(_) => {
                "give all cameras as matrices and poses, or all as centres, and what else is known in a run of its own"
            }
            Self::CameraTwice(_) => "leave one out",
            Self::NoCentre(_) => "give cameras of rank 3 that the model knows",
            Self::MissingCameras { .. } => {
                "give every node a camera, or leave the pairs of those that have none out of the graph"
            }
            Self::SomeVectors => {
                "give vectors and positions on all lines, and the verdict is about these, or on none, and it is about vectors in general position"
            }
            Self::NoCoordinate { .. } => {
                "give three numbers, decimal (-1.25, 3e-2) or fractions (1/3)"
            }
            Self::Contradiction => {
                "vectors add up exactly here: leave out what follows from others, or what was rounded"
            }
            Self::SamePlace { .. } => {
                "two centres that are known to be one are one camera: leave one out"
            }
            Self::LongVectors => "round them, so that all have the same few decimals",
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
            Self::EmptyLabel | Self::ControlInLabel(_) => "give it another name",
            Self::Malformed { .. } => {
                "mend the file, or write one pair a line: two names and nothing else"
            }
            Self::EmptyField => "put a field on either side of every separator",
            Self::Quote(_) => "quote whole fields only, and double the quotes within them",
            Self::Unlike { .. } => "name the format with --format, or mend the line",
            Self::LineTooLarge { .. } => "write the graph as an edge list or in sparse6",
            Self::Graph6(_) | Self::Sparse6(_) => {
                "write the line again, or have it written: `verify convert GRAPH --to graph6` (where other \
                 formats are read, --format names them)"
            }
            Self::MatrixMarket(_) => {
                "write it again as `%%MatrixMarket matrix coordinate pattern symmetric`"
            }
            Self::MatlabBigEndian => "save it in MATLAB with -v7 or -v6",
            Self::MatlabHdf5 => {
                "in Python: viewcert.verify(h5py.File('FILE')['A'][:]); or save it in MATLAB with -v7"
            }
            Self::Truncated(_) | Self::Corrupt(_) => "copy or write the file again",
            Self::Database(error) => error.remedy(),
            Self::NoTracks => {
                "they come from a COLMAP database or model, Bundler's bundle.out, BAL, NVM, and files of OpenMVG, AliceVision and OpenSfM; leave out --tracks to decide a graph of pairs"
            }
            Self::NoModel => "name the folder that has all files of the model",
            Self::Model | Self::Tracks(_) => {
                "it holds tracks, not pairs of images: --tracks decides the graph of its cameras and points"
            }
            Self::Holds(_) => "name one of these (a model is read with --tracks)",
            Self::Within { problem, .. } => problem.remedy(),
            Self::NoSuchVariable { .. } | Self::ChooseVariable { .. } => {
                "name the adjacency matrix with --variable"
            }
            Self::NotNumeric(_) | Self::NotSquare(_) => {
                "give a square matrix, of which rows and columns are cameras (of several variables: --variable), or write pairs as text, one a line"
            }
            Self::Complex => "save its real part, or the matrix of its non-zero entries",
            Self::NotANumber { .. } => "put zero where there is no pair",
            Self::NoMatrix { .. } => {
                "save the adjacency matrix, or write pairs as text, one a line"
            }
            Self::Asymmetric { .. } => {
                "if the direction of pairs does not matter, fill in the other triangle: save A ~= 0 | \
                 A' ~= 0 in MATLAB, (A != 0) + (A != 0).T in SciPy"
            }
            Self::Diagonal(_) => "set the diagonal to zero; --skip-loops leaves it out",
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
