//! What is given besides the pairs: known parts, and known displacements and positions, from files,
//! from pose priors and from the rigs of the input.
//!
//! In: a text, and the graph whose cameras it names. Out: [`Given`], with notes about what counts once
//! or says nothing. Each line begins with the word that says what it is: `part`, `displacement` or
//! `position` (docs/input.md); fields, quotes and comments are those of edge lists.

pub(crate) mod cameras;
mod displacements;
mod parts;
pub(crate) mod places;
mod priors;
mod table;

use std::collections::{BTreeSet, HashMap, HashSet};
use std::io::Read;
use std::path::Path;

use crate::cameras::for_each_line;
use crate::edge_list::fields::split;
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Problem, ReadError};
use crate::{NamedGraph, colmap, whole};
use viewcert::graph::{Displacements, UnionFind};
use viewcert::wording::counted;
use viewcert::{Known, Model};

pub use parts::NamedParts;
use places::GivenCameras;

/// What a file gives.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// Parts or displacements.
    pub known: Known,
    /// What was merged or left out in reading them.
    pub notes: Vec<String>,
}

/// What is given besides the pairs of a graph: by its rigs, and by a file if there is one (`-` is standard
/// input); of a COLMAP database these are the positions of its pose priors. Displacements and positions have
/// a frame of their own, unless the file or `one_frame` says that it is that of the directions. Notes begin
/// with its name.
/// O(n + k log k) for k fields, and for parts inside of others what it takes to compare them.
///
/// # Errors
/// With file and line: what the grammar excludes, a label that the graph does not have, parts beside
/// displacements, vectors on some lines only or that contradict each other; a file that cannot be read
/// or gives nothing; what does not go together with base lines of rigs.
pub fn given(path: Option<&Path>, input: &NamedGraph, one_frame: bool) -> Result<Given, ReadError> {
    match path {
        None if one_frame => Err(no_frame(&input.name)),
        None => {
            let mut given = joined(Given::default(), &input.name, input)?;
            given.notes.extend(priors::not_used(input));
            Ok(given)
        }
        Some(path) if colmap::is_database(path) => joined(
            priors::read(path, input, one_frame)?,
            &path.display().to_string(),
            input,
        ),
        Some(path) => {
            let name = path.display().to_string();
            given_in(&whole::bytes(path)?, &name, input, one_frame)
        }
    }
}

/// Nothing is given that has a frame.
fn no_frame(name: &str) -> ReadError {
    let why = "no displacements and no positions are given that could have another frame";
    Fault::from(Problem::unused("--one-frame", why)).in_file(name)
}

/// What the bytes of a file give.
fn given_in(
    bytes: &[u8],
    name: &str,
    input: &NamedGraph,
    one_frame: bool,
) -> Result<Given, ReadError> {
    let found = read(bytes, input, one_frame).map_err(|fault| fault.in_file(name))?;
    if one_frame && matches!(found.known, Known::Parts(_)) {
        return Err(no_frame(name));
    }
    let mut found = found;
    for note in &mut found.notes {
        *note = format!("{name}: {note}");
    }
    joined(found, name, input)
}

/// The same with the rigs of the graph.
fn joined(given: Given, name: &str, input: &NamedGraph) -> Result<Given, ReadError> {
    let known = with_rigs(given.known, input);
    let known = known.map_err(|problem| Fault::from(problem).in_file(name))?;
    Ok(Given { known, ..given })
}

/// What a file beside a graph holds.
#[derive(Clone, Debug)]
pub enum Beside {
    /// The cameras themselves.
    Cameras(GivenCameras),
    /// What is known of them.
    Known(Given),
}

/// The cameras that a file gives, see [`cameras_beside`]; or what is given besides the pairs, see
/// [`given`].
///
/// # Errors
/// As there.
pub fn beside(
    path: Option<&Path>,
    input: &NamedGraph,
    model: Model,
    one_frame: bool,
) -> Result<Beside, ReadError> {
    let Some(path) = path.filter(|path| !colmap::is_database(path)) else {
        return given(path, input, one_frame).map(Beside::Known);
    };
    let name = path.display().to_string();
    let cameras = match path.is_dir() {
        true => cameras::of_folder(path, input, model)?,
        false => {
            // What is no file can be read only once.
            let bytes = whole::bytes(path)?;
            match cameras::cameras_in(&bytes, &name, input, model)? {
                Some(cameras) => cameras,
                None => return given_in(&bytes, &name, input, one_frame).map(Beside::Known),
            }
        }
    };
    match one_frame {
        true => Err(no_frame(&name)),
        false => Ok(Beside::Cameras(cameras)),
    }
}

/// The cameras that a file gives (`-` is standard input), if it is one of cameras: a COLMAP model (a folder),
/// a text whose first word is `camera`, `pose` or `centre`, or a table whose head names such columns. O(bytes).
///
/// # Errors
/// With file and line: numbers that are none, cameras that the graph does not have, or that are missing.
pub fn cameras_beside(
    path: &Path,
    input: &NamedGraph,
    model: Model,
) -> Result<Option<GivenCameras>, ReadError> {
    if path.is_dir() {
        return cameras::of_folder(path, input, model).map(Some);
    }
    if colmap::is_database(path) {
        return Ok(None);
    }
    cameras::cameras_in(
        &whole::bytes(path)?,
        &path.display().to_string(),
        input,
        model,
    )
}

/// What is known, with the base lines of the graph's rigs.
///
/// # Errors
/// Known parts, or displacements with vectors, beside these base lines, which have none.
pub fn with_rigs(known: Known, input: &NamedGraph) -> Result<Known, Problem> {
    let frames = input.frames.as_ref();
    let groups = frames.map_or(&[][..], |frames| &frames.groups);
    if let Known::OwnFrame { given, .. } = known {
        let stars = stars(groups);
        let rigs = Displacements::new(input.graph.nodes() as u32, stars);
        let rigs = rigs.expect("groups of nodes of the graph");
        return Ok(Known::OwnFrame { given, rigs });
    }
    let displaced = match &known {
        _ if groups.is_empty() => return Ok(known),
        Known::OwnFrame { .. } => &[][..],
        Known::Parts(parts) if !parts.is_empty() => {
            return Err(beside_rigs("known parts"));
        }
        Known::Parts(_) => &[][..],
        Known::Displacements(known) if known.vectors().is_some() => {
            return Err(beside_rigs("displacements with vectors"));
        }
        Known::Displacements(known) => known.groups(),
    };
    let stars = stars(displaced).chain(stars(groups));
    let all = Displacements::new(input.graph.nodes() as u32, stars);
    Ok(Known::Displacements(
        all.expect("groups of nodes of the graph"),
    ))
}

/// Pairs that make sets of nodes hang together.
fn stars(groups: &[Vec<u32>]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let star = |group: &Vec<u32>| {
        let first = group[0];
        let others: Vec<_> = group[1..].iter().map(|&other| (first, other)).collect();
        others
    };
    groups.iter().flat_map(star)
}

/// Positions that are all at one place.
fn one_place(count: usize) -> Problem {
    let positions = counted(count, "camera");
    let why = "images at one place have one position: two are needed";
    Problem::new(
        format!("the positions of {positions} are one place, and {why}"),
        POSITIONS,
    )
}

/// What to do about positions that say too little.
const POSITIONS: &str = "import positions into the database, or write the cameras whose position is known into a file, `position` \
                         before each";

/// The parts of a graph, within which pairs and rigs say how images are turned against each other.
fn turned(input: &NamedGraph) -> UnionFind {
    let mut sets = UnionFind::new(input.graph.nodes());
    let frames = input.frames.iter();
    let rigs = frames.flat_map(|frames| stars(&frames.groups));
    for (u, v) in input.graph.edges().iter().copied().chain(rigs) {
        sets.union(u as usize, v as usize);
    }
    sets
}

/// Cameras that have a position alone, with a note about them: no pair and no rig holds them. In the frame
/// of the directions a position would place them, and nothing measures how they are turned.
fn unmeasured(
    nodes: impl Iterator<Item = u32>,
    input: &NamedGraph,
    one_frame: bool,
) -> (BTreeSet<u32>, Option<String>) {
    let pairs = input.graph.edges().iter().flat_map(|&(i, j)| [i, j]);
    let frames = input.frames.iter();
    let rigs = frames.flat_map(|frames| frames.groups.iter().flatten());
    let held: HashSet<u32> = pairs.chain(rigs.copied()).collect();
    let alone = nodes.filter(|node| one_frame && !held.contains(node));
    let alone: BTreeSet<u32> = alone.collect();
    let note = (!alone.is_empty()).then(|| {
        let has = if alone.len() == 1 { "has" } else { "have" };
        let cameras = counted(alone.len(), "camera");
        format!("{cameras} {has} a position alone, which nothing measures: it counts for nothing")
    });
    (alone, note)
}

/// Displacements in the frame of the directions, or in one of their own.
fn known_in(given: Displacements, one_frame: bool) -> Known {
    match one_frame {
        true => Known::Displacements(given),
        false => Known::OwnFrame {
            given,
            rigs: Displacements::default(),
        },
    }
}

/// Cameras of one part at one place have one position: that of the first of them. Returns the others
/// that are left out, and a note about them. All cameras are one part if they have one frame.
fn at_one_place<'p>(
    places: impl Iterator<Item = (u32, &'p displacements::Vector)>,
    input: &NamedGraph,
    one_frame: bool,
) -> (BTreeSet<u32>, Option<String>) {
    let mut parts = turned(input);
    let mut at: HashMap<(usize, &displacements::Vector), u32> = HashMap::new();
    let mut again: Vec<(u32, u32)> = Vec::new();
    for (node, place) in places {
        let part = if one_frame {
            0
        } else {
            parts.find(node as usize)
        };
        let first = *at.entry((part, place)).or_insert(node);
        if first != node {
            again.push((first, node));
        }
    }
    let note = again.first().map(|&(first, second)| {
        let [first, second] = [first, second].map(|v| input.labels.label(v));
        let has = if again.len() == 1 { "has" } else { "have" };
        format!(
            "{} {has} the very position of another one, first {second} that of {first}: images at one \
             place have one position, and the first of them has it",
            counted(again.len(), "camera")
        )
    });
    (again.into_iter().map(|(_, node)| node).collect(), note)
}

/// Reads what is given besides the pairs of a graph; see [`given`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph, one_frame: bool) -> Result<Given, Fault> {
    let mut parts: Vec<Vec<u32>> = Vec::new();
    let mut displacements = displacements::Lines::default();
    let mut one_frame = one_frame;
    let mut fields = Vec::new();
    for_each_line(input, graph, |number, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, fields)) = fields.split_first() else {
            return Ok(());
        };
        match &*word.text(line) {
            PART => {
                let nodes = fields.iter().map(|&field| cameras.named(field, line));
                parts.push(nodes.collect::<Result<_, _>>()?);
            }
            word @ (DISPLACEMENT | POSITION) => {
                let ends = 1 + usize::from(word == DISPLACEMENT);
                displacements.take(ends, number, line, fields, cameras)?;
            }
            ONE_FRAME if fields.is_empty() => one_frame = true,
            other if cameras::WORDS.contains(&other) => {
                let what = "gives a camera, and cameras are read from a file that holds nothing else, or from standard input (-)";
                let remedy =
                    "write one camera for each of the graph into a file of their own and name it";
                return Err(Problem::new(format!("`{other}` {what}"), remedy));
            }
            other => {
                let what = "not with part, displacement or position";
                let what = format!("the line begins with `{}`, {what}", shown(other));
                return Err(Problem::new(what, LINES));
            }
        }
        match (parts.is_empty(), displacements.is_empty()) {
            (false, false) => Err(Problem::new(
                "known parts stand beside known displacements, and there is no theorem about both",
                "leave out one of the two",
            )),
            _ => Ok(()),
        }
    })?;
    match (parts.is_empty(), displacements.is_empty()) {
        (true, true) => Err(Problem::new("the file gives nothing", LINES).into()),
        (true, false) => displacements.finish(graph, one_frame),
        (false, _) => {
            let nodes = graph.graph.nodes() as u32;
            let found = NamedParts::of_nodes(nodes, parts).expect("nodes of the graph");
            let (known, notes) = (Known::Parts(found.parts), found.notes);
            Ok(Given { known, notes })
        }
    }
}

/// The first word of a line with a known part: the cameras of it follow.
const PART: &str = "part";
/// The first word of a line with a known displacement: two cameras follow, and perhaps the vector
/// from the first to the second.
const DISPLACEMENT: &str = "displacement";
/// The first word of a line with a known position: a camera follows, and perhaps where it is.
const POSITION: &str = "position";
/// A line that says that displacements and positions are in the frame of the directions.
const ONE_FRAME: &str = "one-frame";

/// How a line with a camera is written.
const CAMERA_LINES: &str = "write `camera`, a name and the 12 entries of its matrix, row by row; or `pose`, a name, a quaternion (real \
                     part first) and a translation; or `centre`, a name and three coordinates";

/// A line with a camera that has another number of fields.
fn no_numbers(expected: usize, found: usize) -> Problem {
    let what = format!("{found} numbers stand behind the camera, and {expected} are expected");
    Problem::new(what, CAMERA_LINES)
}

/// Cameras and centres, or something else besides cameras, in one file.
fn mixed(what: &str) -> Problem {
    Problem::new(
        format!("lines with {what} stand beside others"),
        "give all cameras as matrices and poses, or all as centres, and what else is known in a run of its own",
    )
}

/// How a file of what is given is written.
const LINES: &str = "write on each line `part` and cameras whose relative position is known, `displacement` and two cameras, \
                     or `position` and a camera";

fn beside_rigs(what: &str) -> Problem {
    Problem::new(
        format!(
            "the rigs of this input know base lines without their vectors, and {what} do not go together with these"
        ),
        "leave the rigs out of account (--no-rigs), or what is given",
    )
}

#[cfg(test)]
mod tests;
