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

use std::io::Read;
use std::path::Path;

use crate::cameras::for_each_line;
use crate::edge_list::fields::split;
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Place, Problem, ReadError};
use crate::{NamedGraph, colmap, whole};
use viewcert::graph::Displacements;
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
/// input); of a COLMAP database these are the positions of its pose priors. Notes begin with its name.
/// O(n + k log k) for k fields, and for parts inside of others what it takes to compare them.
///
/// # Errors
/// With file and line: what the grammar excludes, a label that the graph does not have, parts beside
/// displacements, vectors on some lines only or that contradict each other; a file that cannot be read
/// or gives nothing; what does not go together with base lines of rigs.
pub fn given(path: Option<&Path>, input: &NamedGraph) -> Result<Given, ReadError> {
    match path {
        None => joined(Given::default(), &input.name, input),
        Some(path) if colmap::is_database(path) => joined(
            priors::read(path, input)?,
            &path.display().to_string(),
            input,
        ),
        Some(path) => given_in(&whole::bytes(path)?, &path.display().to_string(), input),
    }
}

/// What the bytes of a file give.
fn given_in(bytes: &[u8], name: &str, input: &NamedGraph) -> Result<Given, ReadError> {
    let mut found = read(bytes, input).map_err(|fault| fault.in_file(name))?;
    for note in &mut found.notes {
        *note = format!("{name}: {note}");
    }
    joined(found, name, input)
}

/// The same with the rigs of the graph.
fn joined(given: Given, name: &str, input: &NamedGraph) -> Result<Given, ReadError> {
    let known = with_rigs(given.known, input);
    let known = known.map_err(|problem| Place::Input.fault(problem).in_file(name))?;
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
pub fn beside(path: Option<&Path>, input: &NamedGraph, model: Model) -> Result<Beside, ReadError> {
    let Some(path) = path.filter(|path| !colmap::is_database(path)) else {
        return given(path, input).map(Beside::Known);
    };
    if path.is_dir() {
        return cameras::of_folder(path, input, model).map(Beside::Cameras);
    }
    // What is no file can be read only once.
    let (bytes, name) = (whole::bytes(path)?, path.display().to_string());
    match cameras::cameras_in(&bytes, &name, input, model)? {
        Some(cameras) => Ok(Beside::Cameras(cameras)),
        None => given_in(&bytes, &name, input).map(Beside::Known),
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
    let groups = input
        .frames
        .as_ref()
        .map_or(&[][..], |frames| &frames.groups);
    let displaced = match &known {
        _ if groups.is_empty() => return Ok(known),
        Known::Parts(parts) if !parts.is_empty() => {
            return Err(beside_rigs("known parts"));
        }
        Known::Parts(_) => &[][..],
        Known::Displacements(known) if known.vectors().is_some() => {
            return Err(beside_rigs("displacements with vectors"));
        }
        Known::Displacements(known) => known.groups(),
    };
    let groups = displaced.iter().chain(groups);
    let stars = groups.flat_map(|group| group[1..].iter().map(|&other| (group[0], other)));
    let all = Displacements::new(input.graph.nodes() as u32, stars);
    Ok(Known::Displacements(
        all.expect("groups of nodes of the graph"),
    ))
}

/// Reads what is given besides the pairs of a graph; see [`given`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<Given, Fault> {
    let mut parts = parts::Lines::default();
    let mut displacements = displacements::Lines::default();
    let mut fields = Vec::new();
    for_each_line(input, graph, |number, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, fields)) = fields.split_first() else {
            return Ok(());
        };
        match &*word.text(line) {
            PART => parts.take(number, line, fields, cameras)?,
            DISPLACEMENT => displacements.take_pair(number, line, fields, cameras)?,
            POSITION => displacements.take_position(number, line, fields, cameras)?,
            other if cameras::WORDS.contains(&other) => {
                return Err(Problem::new(
                    format!(
                        "`{other}` gives a camera, and cameras are read from a file that holds nothing else, or from standard input (-)"
                    ),
                    "write one camera for each of the graph into a file of their own and name it",
                ));
            }
            other => {
                let what = format!(
                    "the line begins with `{}`, not with part, displacement or position",
                    shown(other)
                );
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
        (true, true) => Err(Place::Input.fault(Problem::new("the file gives nothing", LINES))),
        (true, false) => displacements.finish(graph),
        (false, _) => {
            let nodes = graph.graph.nodes() as u32;
            let NamedParts { parts, notes } =
                parts.finish(nodes, true).expect("nodes of the graph");
            Ok(Given {
                known: Known::Parts(parts),
                notes,
            })
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
