//! Any input to graphs: which format it is, and its graphs one by one.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

use crate::colmap::{self, Database, DatabaseFacts, Pipeline};
use crate::documents::{self, Document};
use crate::edge_list::Reading;
use crate::edge_list::columns::{Columns, ListOptions};
use crate::edge_list::decimal::Decimal;
use crate::error::{Fault, Kind as ProblemKind, Place, Problem, ReadError};
use crate::inflate::{Inflater, is_gzip};
use crate::lines::{Encoding, Lines};
use crate::matching::Matching;
use crate::read_as::{Parsed, ReadAs};
use crate::recognise;
use crate::recognise::Kind;
use crate::tracks::{self, Frames, TrackFacts, TrackOptions};
use crate::{edge_list, matlab, matrix_market, model};
use viewcert::graph::{Graph, Labels};

/// A graph as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedGraph {
    /// The path as given, what is not UTF-8 in it replaced; `-` for standard input; for line k of a
    /// graph6 or sparse6 file followed by `:k`.
    pub name: String,
    /// The graph.
    pub graph: Graph,
    /// What the user calls its nodes.
    pub labels: Labels,
    /// What the input was taken for, and what of it became the graph.
    pub read: ReadAs,
    /// What was merged, ignored or guessed in reading it.
    pub notes: Vec<String>,
    /// What is known of its pairs, if the input is a database of matches.
    pub matching: Option<Matching>,
    /// Of a camera-point graph: how many of its nodes, the first ones, are cameras.
    pub cameras: Option<u32>,
    /// The summary of COLMAP's database, if the input is one.
    pub database: Option<Box<DatabaseFacts>>,
    /// How many tracks there are, if this is a camera-point graph.
    pub tracks: Option<TrackFacts>,
    /// What rigs say of cameras, if the input has rigs and they count.
    pub frames: Option<Box<Frames>>,
}

impl NamedGraph {
    /// A graph of which nothing else is known.
    pub fn new(name: impl Into<String>, graph: Graph, labels: Labels) -> Self {
        Self {
            name: name.into(),
            graph,
            labels,
            read: ReadAs::default(),
            notes: Vec::new(),
            matching: None,
            cameras: None,
            database: None,
            tracks: None,
            frames: None,
        }
    }
}

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One pair a line, read leniently; see [`edge_list`]. (Without a format the same files are
    /// read strictly.)
    Edges,
    /// One graph a line; see [`graph6`](viewcert::graph::graph6).
    Graph6,
    /// One graph a line; see [`sparse6`](super::sparse6).
    Sparse6,
    /// An adjacency matrix in a MATLAB file of version 5; see [`matlab`].
    Matlab,
    /// An adjacency matrix in a MatrixMarket file; see [`matrix_market`].
    MatrixMarket,
    /// A whole text; see [`documents`].
    Document(Document),
}

impl Format {
    /// The formats: the names on the command line, the first of which is printed, and what it reads.
    pub fn all() -> impl Iterator<Item = (Self, &'static [&'static str], &'static str)> {
        let own: [(Self, &'static [&'static str], _); 5] = [
            (Self::Edges, &["edges", "edge-list"], EDGES),
            (Self::Graph6, &["graph6"], "One graph a line"),
            (Self::Sparse6, &["sparse6"], "One graph a line"),
            (Self::Matlab, &["matlab"], "Adjacency matrix, MATLAB 5"),
            (
                Self::MatrixMarket,
                &["matrix-market"],
                "Adjacency matrix, MatrixMarket coordinates",
            ),
        ];
        let documents = Document::ALL.into_iter().filter_map(|document| {
            let (words, help) = document.facts().asked?;
            Some((Self::Document(document), words, help))
        });
        own.into_iter().chain(documents)
    }
}

const EDGES: &str =
    "One pair a line: the first two fields, whatever follows; one field alone is a camera";

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        let found = Self::all().find(|(_, names, _)| names.contains(&name));
        found.map(|(format, ..)| format).ok_or(UnknownFormat)
    }
}

/// A word that is not the name of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the formats are {}", Format::all().map(|(_, names, _)| names[0]).collect::<Vec<_>>().join(", "))]
pub struct UnknownFormat;

/// The name on the command line, which [`FromStr`] reads.
impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let found = Self::all().find(|(format, ..)| format == self);
        f.pad(found.map_or("", |(_, names, _)| names[0]))
    }
}

/// How to read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The format; by default what the content is, if it can be only one.
    pub format: Option<Format>,
    /// The variable of a MATLAB file; by default `A`, the only square matrix or the only list of pairs.
    pub variable: Option<String>,
    /// Which mapper's pairs to take from a database; by default those of incremental mapping.
    pub pipeline: Option<Pipeline>,
    /// The least number of inliers of a database's pair; by default
    /// [`DEFAULT_MIN_INLIERS`](colmap::DEFAULT_MIN_INLIERS).
    pub min_inliers: Option<u32>,
    /// Whether tracks are asked for instead of pairs, and which of them count.
    pub tracks: Option<TrackOptions>,
    /// Which lines of a list count, and where in them the pairs stand.
    pub list: ListOptions,
    /// Of a database only the pairs between images with these names, as a mapper with a list of
    /// images takes them; by default all. The other images stay, without pairs.
    pub only: Option<Arc<BTreeSet<String>>>,
}

impl ReadOptions {
    /// What is said here, by the names of the command line: what reads the same file alike.
    pub fn given(&self) -> BTreeMap<String, String> {
        let list = &self.list;
        let number_of = |number: Option<u32>| number.map(|number| number.to_string());
        let yes = |is: bool| is.then(String::new);
        let (tracks, default) = (self.tracks, TrackOptions::default());
        let other = |number: u32, usual: u32| number_of(Some(number).filter(|it| *it != usual));
        let all = [
            ("format", self.format.map(|format| format.to_string())),
            ("variable", self.variable.clone()),
            ("pipeline", self.pipeline.map(|mapper| mapper.to_string())),
            ("min-inliers", number_of(self.min_inliers)),
            ("columns", list.columns.as_ref().map(Columns::to_string)),
            (
                "min-weight",
                list.min_weight.as_ref().map(Decimal::to_string),
            ),
            ("skip-loops", yes(list.skip_loops)),
            ("tracks", yes(tracks.is_some())),
            (
                "min-views",
                tracks.and_then(|of| other(of.min_views, default.min_views)),
            ),
            (
                "max-spread",
                tracks.and_then(|of| other(of.max_spread, default.max_spread)),
            ),
            ("no-rigs", yes(tracks.is_some_and(|of| !of.rigs))),
        ];
        let said = all
            .into_iter()
            .filter_map(|(name, value)| Some((name.to_owned(), value?)));
        said.collect()
    }
}

/// The graphs of an input, or why there is none.
pub type Graphs = Box<dyn Iterator<Item = Result<NamedGraph, ReadError>>>;

type Input = Box<dyn Read>;

/// Of the graphs of an input the first one that is meant, or else the first; nothing if there is none.
///
/// # Errors
/// Of the graphs before the one that is meant.
pub fn read_meant(
    path: impl AsRef<Path>,
    options: &ReadOptions,
    is_meant: impl Fn(&NamedGraph) -> bool,
) -> Result<Option<NamedGraph>, ReadError> {
    let mut first = None;
    for input in read_graphs(path, options) {
        let input = input?;
        if is_meant(&input) {
            return Ok(Some(input));
        }
        first.get_or_insert(input);
    }
    Ok(first)
}

/// Streams the graphs of one input (`-` is standard input): one a line for graph6 and
/// sparse6, else one. Nothing is read before the first item is asked for. What gzip has
/// compressed is unpacked.
///
/// A bad line of graph6 or sparse6 is an `Err` item, and the next line follows it, if a header or
/// the options say that it is such a file; every other error ends the stream.
pub fn read_graphs(path: impl AsRef<Path>, options: &ReadOptions) -> Graphs {
    let (path, options) = (path.as_ref().to_owned(), options.clone());
    let (name, given) = (path.display().to_string(), options.given());
    // A text that is refused at its beginning, and is called like a file of a model, is one.
    let part = model::title_of(&path).filter(|_| options.format.is_none());
    let place = path.clone();
    let open = move || match path.to_str() {
        Some("-") => graphs(name, std::io::stdin(), options),
        _ if path.is_dir() => Box::new(std::iter::once(folder(&path, &options))),
        _ => match (model::folder_of(&path), File::open(&path)) {
            (Some((folder, title)), _) if options.format.is_none() => {
                let of_part = || Problem::foreign(title, recognise::COLMAP);
                let found = in_model(folder, &options, of_part);
                Box::new(std::iter::once(tracks_called(&name, found)))
            }
            (_, Ok(file)) => graphs_at(Some(&path), name, file, options),
            (_, Err(error)) => failed(&name, Problem::unreadable(&error).into()),
        },
    };
    let named = move |mut error: ReadError| {
        let at_first = matches!(error.place, Place::Input | Place::Line(1));
        let is_alone = || model::folder_of(&place).is_none();
        if let Some(title) = part.filter(|_| at_first && is_alone()) {
            error.problem = Problem::foreign(title, recognise::COLMAP);
        }
        error
    };
    let graphs = std::iter::once_with(open).flatten();
    Box::new(graphs.map(move |graph| {
        let mut graph = graph.map_err(&named)?;
        graph.read.options.clone_from(&given);
        Ok(graph)
    }))
}

/// Streams the graphs of `input`, which its graphs and errors call `name`.
pub fn graphs(name: String, input: impl Read + 'static, options: ReadOptions) -> Graphs {
    graphs_at(None, name, input, options)
}

/// The same of an input that is the file at a path, for formats that are read there.
fn graphs_at(
    path: Option<&Path>,
    name: String,
    input: impl Read + 'static,
    options: ReadOptions,
) -> Graphs {
    let sampled = match sampled(Box::new(input)) {
        Ok(sampled) => sampled,
        Err(problem) => return failed(&name, Fault::from(problem)),
    };
    if !is_gzip(&sampled.head) {
        return of_sampled(path, name, sampled, options);
    }
    let inner = match sampled_again(sampled) {
        Ok(inner) => inner,
        Err(problem) => return failed(&name, Fault::from(problem)),
    };
    let graphs = of_sampled(None, name, inner, options);
    Box::new(graphs.map(move |graph| {
        graph.map(|mut graph| {
            graph.read.compression = Some("gzip".into());
            graph
        })
    }))
}

/// An input whose first bytes are known.
struct Sampled {
    /// The first bytes, which are all if `whole`.
    head: Vec<u8>,
    whole: bool,
    /// What follows them.
    rest: Input,
}

impl Sampled {
    fn into_input(self) -> Input {
        Box::new(Cursor::new(self.head).chain(self.rest))
    }
}

/// Reads as much of an input as is looked at.
fn sampled(mut input: Input) -> Result<Sampled, Problem> {
    let mut head = Vec::new();
    let most = recognise::SAMPLE;
    let whole = input.by_ref().take(most as u64).read_to_end(&mut head)? < most;
    let rest = input;
    Ok(Sampled { head, whole, rest })
}

/// What is in a compressed file, which has to be something else.
fn sampled_again(outer: Sampled) -> Result<Sampled, Problem> {
    let inner = sampled(Box::new(Inflater::new(outer.into_input())))?;
    if is_gzip(&inner.head) {
        let what = "a file that is compressed twice";
        return Err(Problem::foreign(what, "unpack it once"));
    }
    Ok(inner)
}

fn of_sampled(path: Option<&Path>, name: String, sampled: Sampled, options: ReadOptions) -> Graphs {
    if let Some(tracks) = options.tracks
        && !sampled.head.starts_with(colmap::MAGIC)
    {
        let graph = tracks_of(&name, sampled, &options, tracks);
        return Box::new(std::iter::once(graph));
    }
    let edges = match options.format {
        Some(Format::Edges) => Reading::Lenient,
        _ => Reading::Strict,
    };
    let guessed = false;
    let lines = |encoding| Kind::Lines { encoding, guessed };
    let kind = match options.format {
        Some(Format::Edges) => Ok(None),
        Some(Format::Graph6) => Ok(Some(lines(Encoding::Graph6))),
        Some(Format::Sparse6) => Ok(Some(lines(Encoding::Sparse6))),
        Some(Format::Matlab) => Ok(Some(Kind::Matlab)),
        Some(Format::MatrixMarket) => Ok(Some(Kind::MatrixMarket)),
        Some(Format::Document(document)) => Ok(Some(Kind::Document(document))),
        None => recognise::kind(&sampled.head, sampled.whole).map(Some),
    };
    let kind = kind.and_then(|kind| ensure_used(&options, kind).map(|()| kind));
    let one = match kind {
        Ok(Some(Kind::Lines { encoding, guessed })) => {
            let lines = Lines::new(name, encoding, guessed, sampled.into_input());
            return Box::new(lines);
        }
        Ok(Some(Kind::Sqlite)) => {
            return Box::new(std::iter::once(database(path, &name, &options)));
        }
        Ok(Some(Kind::Matlab)) => all(sampled.into_input()).and_then(|bytes| {
            matlab::read_noting(&bytes, options.variable.as_deref(), &options.list)
        }),
        Ok(Some(Kind::MatrixMarket)) => {
            matrix_market::read_with(sampled.into_input(), &options.list)
        }
        // Compressed data within such are refused.
        Ok(None | Some(Kind::Text | Kind::Compressed)) => list(sampled, edges, &options.list),
        Ok(Some(Kind::Document(document))) => {
            documents::read_with(document, sampled.into_input(), &options.list)
        }
        Err(problem) => Err(Fault::from(problem)),
    };
    match one {
        Ok(parsed) => Box::new(std::iter::once(Ok(NamedGraph {
            read: parsed.read,
            notes: parsed.notes,
            ..NamedGraph::new(name, parsed.graph, parsed.labels)
        }))),
        Err(fault) => failed(&name, fault),
    }
}

/// Reads a list of pairs. What its grammar refuses may have a name.
fn list(sampled: Sampled, reading: Reading, options: &ListOptions) -> Result<Parsed, Fault> {
    let (head, whole) = (sampled.head.clone(), sampled.whole);
    let read = edge_list::read_with(sampled.into_input(), (&head, whole), reading, options);
    read.map_err(|Fault { place, problem }| {
        let named = match reading {
            Reading::Strict if problem.kind == ProblemKind::Form => recognise::likely(&head, whole),
            _ => None,
        };
        match named {
            Some(problem) => Fault::from(problem),
            None if head.contains(&0) => Problem::control(&head, 0).into(),
            None => place.fault(problem),
        }
    })
}

/// Refuses an option that says nothing about a file of this kind, or about tracks.
fn ensure_used(options: &ReadOptions, kind: Option<Kind>) -> Result<(), Problem> {
    let of_tracks = options.tracks.is_some();
    // Weights are read, and loops may be there.
    let [has_weights, has_loops] = match kind {
        _ if of_tracks => [false; 2],
        None | Some(Kind::Text | Kind::Matlab | Kind::MatrixMarket) => [true; 2],
        Some(Kind::Document(document)) => [document.has_weights(), true],
        _ => [false; 2],
    };
    let (list, is_database) = (&options.list, kind == Some(Kind::Sqlite));
    let is_list = !of_tracks && matches!(kind, None | Some(Kind::Text));
    let unused = [
        options.format.is_some() && of_tracks,
        options.variable.is_some() && kind != Some(Kind::Matlab),
        list.columns.is_some() && !is_list,
        list.min_weight.is_some() && !has_weights,
        list.skip_loops && !has_loops,
        options.pipeline.is_some() && !is_database,
        options.min_inliers.is_some() && !is_database,
    ];
    match UNUSED.iter().zip(unused).find(|(_, is_unused)| *is_unused) {
        Some(((option, why), _)) => Err(Problem::unused(option, why)),
        None => Ok(()),
    }
}

/// Options, and why they may say nothing.
const UNUSED: [(&str, &str); 7] = [
    ("--format", "tracks are known by their content"),
    ("--variable", "this is no MATLAB file"),
    ("--columns", "this is no list of pairs"),
    ("--min-weight", "no weights are read from such a file"),
    ("--skip-loops", SKIP_LOOPS),
    ("--pipeline", "this is no COLMAP database"),
    ("--min-inliers", "this is no COLMAP database"),
];
const SKIP_LOOPS: &str = "of such a file no pairs are left out by that";

/// The database at a path, open to be read in several ways; nothing, if there is none or a format says
/// that it is something else. O(images + pairs) and the sorting of both.
///
/// # Errors
/// Those of [`read_graphs`] about a database.
pub fn open_database(
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Option<Result<Database, ReadError>> {
    let path = path.as_ref();
    let is_meant = options.format.is_none() && colmap::is_database(path);
    is_meant.then(|| {
        let name = path.display().to_string();
        ensure_used(options, Some(Kind::Sqlite))
            .map_err(|problem| Fault::from(problem).in_file(&name))?;
        Database::open(&name, path, options)
    })
}

/// The graph of a database, which has to be a file.
fn database(
    path: Option<&Path>,
    name: &str,
    options: &ReadOptions,
) -> Result<NamedGraph, ReadError> {
    let no_file = || Fault::from(colmap::error::no_file()).in_file(name);
    // A pipe by its path, as /dev/stdin, was read already.
    let path = path.filter(|path| path.is_file()).ok_or_else(no_file)?;
    let database = Database::open(name, path, options)?;
    let graph = match options.tracks {
        None => database.pairs(),
        Some(tracks) => database.tracks(tracks)?,
    };
    database.finish()?;
    Ok(graph)
}

/// The camera-point graph of an input.
fn tracks_of(
    name: &str,
    sampled: Sampled,
    options: &ReadOptions,
    tracks: TrackOptions,
) -> Result<NamedGraph, ReadError> {
    let (head, whole) = (sampled.head.clone(), sampled.whole);
    let used = ensure_used(options, None).map_err(Fault::from);
    let read = used.and_then(|()| tracks::read(&head, whole, sampled.into_input(), tracks));
    tracks_called(name, read)
}

/// What is in a folder.
fn folder(folder: &Path, options: &ReadOptions) -> Result<NamedGraph, ReadError> {
    let name = &folder.display().to_string();
    let found = match model::encoding_in(folder) {
        Some(_) => in_model(folder, options, Problem::model),
        None => Err(match &inside(folder, DEPTH)[..] {
            [] if options.tracks.is_some() => model::no_model().into(),
            [] => Problem::unreadable(&std::io::ErrorKind::IsADirectory.into()).into(),
            inside => {
                let what = format!("this is a folder that holds {}", inside.join(", "));
                let kind = ProblemKind::Holds(inside.into());
                let remedy = "name one of these (a model is read with --tracks)";
                Problem::of(kind, what, remedy).into()
            }
        }),
    };
    tracks_called(name, found)
}

/// The tracks of a model, if they are asked for or there are none.
fn in_model(
    folder: &Path,
    options: &ReadOptions,
    refused: impl FnOnce() -> Problem,
) -> Result<NamedGraph, Fault> {
    match options.tracks {
        None if model::has_no_points(folder) => {
            tracks::read_folder(folder, TrackOptions::default())
        }
        None => Err(refused().into()),
        Some(tracks) => {
            ensure_used(options, None)?;
            tracks::read_folder(folder, tracks)
        }
    }
}

/// How far down a folder is looked through: COLMAP's models lie in sparse/0, sparse/1.
const DEPTH: usize = 2;

/// The models and databases that lie in a folder, or in one of its folders, by name. O(files) there.
fn inside(folder: &Path, depth: usize) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let found = paths.into_iter().flat_map(|path| {
        // Thousands of photographs may lie here, and are not opened.
        let is_named_so = path
            .extension()
            .is_some_and(|is| is == "db" || is == "sqlite");
        let is_input =
            model::encoding_in(&path).is_some() || is_named_so && colmap::is_database(&path);
        match is_input || depth <= 1 {
            true => Vec::from_iter(is_input.then(|| path.display().to_string())),
            false => inside(&path, depth - 1),
        }
    });
    found.take(MOST_INSIDE).collect()
}

/// So many of them are named.
const MOST_INSIDE: usize = 8;

fn tracks_called(name: &str, graph: Result<NamedGraph, Fault>) -> Result<NamedGraph, ReadError> {
    let mut graph = graph.map_err(|fault| fault.in_file(name))?;
    name.clone_into(&mut graph.name);
    Ok(graph)
}

fn failed(name: &str, fault: Fault) -> Graphs {
    Box::new(std::iter::once(Err(fault.in_file(name))))
}

/// All bytes of an input.
fn all(mut input: impl Read) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    let done = input.read_to_end(&mut bytes);
    done.map_err(|error| Fault::from(Problem::from(error)))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests;
