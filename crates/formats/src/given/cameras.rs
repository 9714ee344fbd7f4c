//! Cameras, at which a graph is decided as they are: text, a COLMAP model, arrays of NumPy and MATLAB.
//!
//! In: a file, and the graph whose cameras it names. Out: for every node a camera or a centre, as exact
//! fractions ([`GivenCameras`]); decimals, fractions and doubles are such. A quaternion q gives the
//! matrix [ R(q) | |q|^2 t ], whose centre is that of the pose, whatever the length of q.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use super::places::{Given, GivenCameras, all, matrix};
use super::table::Table;
use super::{CAMERA_LINES, mixed, no_numbers};
use crate::cameras::{Cameras, for_each_line};
use crate::edge_list::BYTE_ORDER_MARK;
use crate::edge_list::fields::{Field, split};
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Problem, ReadError};
use crate::{Model, NamedGraph, matlab};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::model::Model as Question;
use viewcert::linalg::integer::{Division, Integer, One, Zero};
use viewcert::linalg::rational::{Rational, parse};
use viewcert::wording::counted;

/// A camera, row by row.
const CAMERA: &str = "camera";
/// A quaternion, its real part first, and a translation, as in COLMAP.
const POSE: &str = "pose";
/// A centre (affine model: a viewing direction).
const CENTRE: &str = "centre";

/// The first words of lines with cameras.
pub(super) const WORDS: [&str; 3] = [CAMERA, POSE, CENTRE];

/// The cameras of a COLMAP model, by the names of its images.
pub(super) fn of_folder(
    folder: &Path,
    input: &NamedGraph,
    model: Question,
) -> Result<GivenCameras, ReadError> {
    let found = of_model(&Model::read(folder)?, input, model).map_err(Fault::from);
    finished(found, &folder.display().to_string())
}

/// The cameras that bytes hold which were read from what is called `name`, if they hold any. O(bytes).
pub(super) fn cameras_in(
    bytes: &[u8],
    name: &str,
    input: &NamedGraph,
    model: Question,
) -> Result<Option<GivenCameras>, ReadError> {
    if are_cameras(bytes) {
        return finished(of_text(bytes, input, model), name).map(Some);
    }
    arrays(bytes).map_or(Ok(None), |fault| Err(fault.in_file(name)))
}

/// Says of arrays, which are no text, how Python takes them.
fn arrays(bytes: &[u8]) -> Option<Fault> {
    let numpy: [&[u8]; 2] = [b"\x93NUMPY", b"PK\x03\x04"];
    let (what, advice) = match () {
        () if numpy.iter().any(|magic| bytes.starts_with(magic)) => (
            "a file of arrays of NumPy",
            "in Python: viewcert.at_cameras(viewcert.read('GRAPH'), numpy.load('FILE')), an array (n, 3, 4) or (n, 3)",
        ),
        () if matlab::is_matlab(bytes) => (
            "a MATLAB file",
            "in Python: viewcert.at_cameras(viewcert.read('GRAPH'), numpy.moveaxis(scipy.io.loadmat('FILE')['P'], 2, 0))",
        ),
        () => return None,
    };
    Some(Problem::foreign(what, advice).into())
}

fn finished(found: Result<GivenCameras, Fault>, name: &str) -> Result<GivenCameras, ReadError> {
    let mut found = found.map_err(|fault| fault.in_file(name))?;
    for note in &mut found.notes {
        *note = format!("{name}: {note}");
    }
    Ok(found)
}

/// Whether the first line that is no comment begins with the word of a camera, or is the head of a table of
/// such.
fn are_cameras(bytes: &[u8]) -> bool {
    let lines = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let mut lines = lines
        .split_inclusive(|&byte| byte == b'\n')
        .map(String::from_utf8_lossy);
    let is_line = |line: &Cow<str>| !line.trim().is_empty() && !line.trim().starts_with(['#', '%']);
    let Some(line) = lines.find(is_line) else {
        return false;
    };
    let separators = [' ', '\t', ','];
    if WORDS.contains(&line.trim().split(separators).next().unwrap_or_default()) {
        return true;
    }
    let words = line
        .trim()
        .split(separators)
        .filter(|word| !word.is_empty());
    let words: Vec<String> = words
        .map(|word| word.trim_matches('"').to_lowercase())
        .collect();
    let head = words.split_first();
    head.is_some_and(|(first, rest)| Table::of_head(first, rest).is_some())
}

/// The cameras of a text.
fn of_text(
    text: impl io::Read,
    input: &NamedGraph,
    model: Question,
) -> Result<GivenCameras, Fault> {
    let mut given = BTreeMap::new();
    let mut fields = Vec::new();
    let mut table: Option<Table> = None;
    for_each_line(text, input, |_, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, fields)) = fields.split_first() else {
            return Ok(());
        };
        let texts = || fields.iter().map(|&field| field.text(line).to_lowercase());
        if table.is_none() && given.is_empty() {
            table = Table::of_head(&word.text(line), &texts().collect::<Vec<_>>());
            if table.is_some() {
                return Ok(());
            }
        }
        let (expected, first, rest) = match &table {
            Some(table) => (table.width(), *word, table.ordered(fields)?),
            None => {
                let expected = match &*word.text(line) {
                    CAMERA => 12,
                    POSE => 7,
                    CENTRE => 3,
                    _ => return Err(mixed("cameras")),
                };
                let (&first, rest) = fields
                    .split_first()
                    .ok_or_else(|| Problem::new("the line names no camera", CAMERA_LINES))?;
                (expected, first, rest.to_vec())
            }
        };
        let node = cameras.named(first, line)?;
        let found = rest.len();
        let numbers = rest.iter().map(|&field| number(field, line));
        let numbers = numbers.collect::<Result<Vec<Rational>, Problem>>()?;
        let wrong = no_numbers(expected, found);
        let place = match &numbers[..] {
            [x, y, z] if expected == 3 => Given::Centre([x.clone(), y.clone(), z.clone()]),
            pose if expected == 7 && found == 7 => {
                Given::Camera(Box::new(of_pose(pose.first_chunk().ok_or(wrong)?)))
            }
            entries if expected == 12 && found == 12 => Given::Camera(Box::new(matrix(entries))),
            _ => return Err(wrong),
        };
        match given.insert(node, place) {
            None => Ok(()),
            Some(_) => Err(twice(&first.text(line))),
        }
    })?;
    all(given, input, model, Vec::new()).map_err(Fault::from)
}

fn twice(camera: &str) -> Problem {
    Problem::new(
        format!("the camera of `{}` is given twice", shown(camera)),
        "leave one out",
    )
}

fn number(field: Field, line: &str) -> Result<Rational, Problem> {
    let text = field.text(line);
    let number = parse(&text);
    number.map_err(|_| {
        let text = shown(&text);
        Problem::new(
            format!("`{text}` is no decimal number with an exponent up to 400, and no fraction"),
            CAMERA_LINES,
        )
    })
}

/// The cameras of a model, by the names of its images.
fn of_model(found: &Model, input: &NamedGraph, model: Question) -> Result<GivenCameras, Problem> {
    let cameras = Cameras::new(input);
    let poses = found.poses();
    let poses = poses.map_err(|image| Problem::corrupt(format!("the pose of image {image}")))?;
    let (mut given, mut strangers) = (BTreeMap::new(), 0);
    for (image, pose) in found.images.iter().zip(poses) {
        match cameras.node(&image.name) {
            None => strangers += 1,
            Some(node) => {
                if given
                    .insert(node, Given::Camera(Box::new(of_pose(&pose))))
                    .is_some()
                {
                    return Err(twice(&image.name));
                }
            }
        }
    }
    let note = (strangers > 0).then(|| {
        format!(
            "not in the graph, and left out: {} of the model",
            counted(strangers, "image")
        )
    });
    all(given, input, model, note.into_iter().collect())
}

/// [ d R(q) | |q|^2 d t ] for a quaternion and a translation, with d and a multiple of q that make all of them
/// integers, for which no fraction is ever reduced; zero for q = 0.
fn of_pose([q @ .., x, y, z]: &[Rational; 7]) -> Camera<Rational> {
    let one = Integer::one();
    let cleared = |values: &[&Rational]| -> (Integer, Vec<Integer>) {
        let first = one.clone();
        let common = values.iter().fold(first, |all, a| all.lcm(a.denom()));
        let scaled = |a: &&Rational| a.numer() * (&common / a.denom());
        let scaled = values.iter().map(scaled).collect();
        (common, scaled)
    };
    let (_, q) = cleared(&q.each_ref());
    let (unit, t) = cleared(&[x, y, z]);
    let times = |i: usize, j: usize| &q[i] * &q[j];
    let twice = |a: Integer| a.clone() + a;
    let norm = (0..4).fold(Integer::zero(), |sum, i| sum + times(i, i));
    // |q|^2 on the diagonal, less twice the squares of the two other axes.
    let diagonal = |i: usize, j: usize| &norm - twice(times(i, i) + times(j, j));
    let plus = |i: usize, j: usize, k: usize| twice(times(i, j) + times(0, k));
    let minus = |i: usize, j: usize, k: usize| twice(times(i, j) - times(0, k));
    let rotation = [
        [diagonal(2, 3), minus(1, 2, 3), plus(1, 3, 2)],
        [plus(1, 2, 3), diagonal(1, 3), minus(2, 3, 1)],
        [minus(1, 3, 2), plus(2, 3, 1), diagonal(1, 2)],
    ];
    std::array::from_fn(|r| {
        std::array::from_fn(|c| match c {
            3 => (&norm * &t[r]).into(),
            _ => (&rotation[r][c] * &unit).into(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::exact;
    use crate::{ReadOptions, read_graphs};
    use viewcert::at_cameras::Centres;
    use viewcert::linalg::rational::scaled;

    fn graph(text: &str) -> NamedGraph {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let mut graphs = read_graphs(file.path(), &ReadOptions::default());
        graphs.next().unwrap().unwrap()
    }

    fn read(text: &str, graph: &NamedGraph) -> Result<Centres, String> {
        let read = of_text(text.as_bytes(), graph, Question::Calibrated);
        read.map(|read| read.centres)
            .map_err(|fault| fault.in_file("f").to_string())
    }

    /// A quaternion of length 2 that turns by a quarter about the third axis: the pose stands at
    /// -R^T t = (-2, 1, -3), as the matrix and the centre do that are given for the others.
    #[test]
    fn poses_matrices_and_centres_say_the_same() {
        let graph = graph("a b\n");
        let text = "pose a 1.4142 0 0 1.4142 1 2 3\ncamera b 0 -1 0 1  1 0 0 2  0 0 1 3e0\n";
        let centres = read(text, &graph).unwrap();
        let points = "centre a -2 1 -3\ncentre b -4/2 1.0 -30e-1\n";
        let points = read(points, &graph).unwrap();
        assert_eq!(centres.sha256(), points.sha256());
        assert_eq!(
            centres.places()[0].each_ref().map(ToString::to_string),
            ["-2", "1", "-3", "1"]
        );
    }

    #[test]
    fn what_is_refused_by_name_and_line() {
        let graph = graph("a b\n");
        for (text, expected) in [
            (
                "centre a 1 2 3\ncentre b 1 2 nan\n",
                "f:2: `nan` is no decimal",
            ),
            (
                "centre a 1 2 3\ncentre b 1 2\n",
                "f:2: 2 numbers stand behind the camera, and 3",
            ),
            (
                "centre a 1 2 3\ncentre a 1 2 3\n",
                "f:2: the camera of `a` is given twice",
            ),
            ("centre c 1 2 3\n", "f:1: `c` is no camera of the graph"),
            (
                "centre b 1 2 3\n",
                "f: no camera is given for 1 node of the graph; `a` is the first",
            ),
            ("centre a 1 2 1e999\n", "f:1: `1e999` is no decimal"),
            (
                "centre a 1 2 3\npart a b\n",
                "f:2: lines with cameras stand beside others",
            ),
            (
                "centre a 1 2 3\npose b 1 0 0 0 1 2 3\n",
                "f: lines with centres stand beside others",
            ),
        ] {
            let error = read(text, &graph).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
    }

    /// 0.1 as a double is not a tenth.
    #[test]
    fn doubles_are_exact() {
        let tenth = parse("3602879701896397/36028797018963968").unwrap();
        assert_eq!(exact(0.1), Some(tenth));
        assert_eq!(exact(-3.0), parse("-3").ok());
        assert_eq!(exact(f64::NAN), None);
        assert_eq!(exact(5e-324).unwrap(), scaled(Integer::one(), 2, -1074));
    }
}
