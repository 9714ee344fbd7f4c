//! Cameras, at which a graph is decided as they are: text, a COLMAP model, an array of NumPy.
//!
//! In: a file, and the graph whose cameras it names. Out: for every node a camera or a centre, as exact
//! fractions ([`GivenCameras`]); decimals, fractions and doubles are such. A quaternion q gives the
//! matrix [ R(q) | |q|^2 t ], whose centre is that of the pose, whatever the length of q.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use crate::cameras::{Cameras, for_each_line, read_file};
use crate::edge_list::fields::{Field, split};
use crate::error::{Fault, Place, Problem, ReadError};
use crate::model::exact;
use crate::{Model, NamedGraph, numpy};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::model::Model as Question;
use viewcert::graph::Labels;
use viewcert::here::{CentreError, Centres};
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::Rational;
use viewcert::wording::counted;

/// A camera, row by row.
const CAMERA: &str = "camera";
/// A quaternion, its real part first, and a translation, as in COLMAP.
const POSE: &str = "pose";
/// A centre (affine model: a viewing direction).
const CENTRE: &str = "centre";

/// The first words of lines with cameras.
pub(super) const WORDS: [&str; 3] = [CAMERA, POSE, CENTRE];

/// A camera for each node of a graph.
#[derive(Clone, Debug)]
pub struct GivenCameras {
    /// Their centres.
    pub centres: Centres,
    /// What was read, and what of it was left out.
    pub notes: Vec<String>,
}

enum Places {
    Cameras(Vec<Camera<Rational>>),
    Centres(Vec<[Rational; 3]>),
}

/// What a line, or an entry of an array, gives.
enum Given {
    Camera(Box<Camera<Rational>>),
    Centre([Rational; 3]),
}

/// The cameras as they were read.
struct Read {
    places: Places,
    notes: Vec<String>,
}

impl Read {
    /// With the centres, as a model asks for them.
    fn finish(self, model: Question, input: &NamedGraph) -> Result<GivenCameras, Fault> {
        let centres = match &self.places {
            Places::Cameras(cameras) => Centres::of_cameras(model, cameras),
            Places::Centres(centres) => Centres::of_points(model, centres),
        };
        let problem = |error| Problem::NoCentre(centre_error(error, input));
        let notes = self.notes;
        let centres = centres.map_err(|error| Place::Input.fault(problem(error)))?;
        Ok(GivenCameras { centres, notes })
    }
}

/// What is wrong with cameras, by the names of these, and what to do.
pub fn centre_error(error: CentreError, input: &NamedGraph) -> String {
    let name = |v: u32| input.labels.display(v).to_string();
    match error {
        CentreError::Degenerate(v) => format!(
            "camera {} has rank below 3, or zero for its direction: it has no centre; mend the file",
            name(v)
        ),
        CentreError::AtInfinity(v) => format!(
            "the centre of camera {} is at infinity, which no calibrated camera's is; say --model projective",
            name(v)
        ),
        CentreError::NotAffine(v) => format!(
            "camera {} is not affine: the last row of its matrix is not (0, 0, 0, 1) up to a factor; leave out --model affine",
            name(v)
        ),
        CentreError::Coincide(i, j) => format!(
            "{} and {} are at one place (or have one viewing direction), so that their pair has no fundamental matrix; leave the pair out",
            name(i),
            name(j)
        ),
        other => other.to_string(),
    }
}

/// Reads the cameras of a graph from a file, if it is one of cameras: a COLMAP model (a folder), an `.npy` file with an
/// array (n, 3, 4) of cameras or (n, 3) of centres, or a text whose first word is `camera`, `pose` or
/// `centre`. Nothing is read from standard input and pipes, which can be read once only. O(bytes).
///
/// # Errors
/// With file and line: numbers that are none, cameras that the graph does not have, or that are missing.
pub fn read_cameras(
    path: &Path,
    input: &NamedGraph,
    model: Question,
) -> Result<Option<GivenCameras>, ReadError> {
    let name = path.display().to_string();
    let found = if path.is_dir() {
        of_model(&Model::read(path)?, input).map_err(|problem| Place::Input.fault(problem))
    } else if path == Path::new("-") || !path.is_file() {
        return Ok(None);
    } else {
        let mut start = [0; 512];
        let Ok(count) = File::open(path).and_then(|mut file| file.read(&mut start)) else {
            return Ok(None);
        };
        if start.starts_with(numpy::MAGIC) {
            let bytes = std::fs::read(path).map_err(|error| Place::Input.fault(error.into()));
            bytes.and_then(|bytes| {
                let array = of_array(&bytes, input);
                array.map_err(|problem| Place::Input.fault(problem))
            })
        } else if is_text_of_cameras(path, &start[..count]) {
            let read = |text: &mut dyn io::Read| of_text(text, input)?.finish(model, input);
            return read_file(path, read, |given| &mut given.notes).map(Some);
        } else {
            return Ok(None);
        }
    };
    let found = found.and_then(|read| read.finish(model, input));
    let mut found = found.map_err(|fault: Fault| fault.in_file(&name))?;
    for note in &mut found.notes {
        *note = format!("{name}: {note}");
    }
    Ok(Some(found))
}

/// Whether the first line that is no comment begins with the word of a camera; in a file that begins with
/// long comments the whole is looked at.
fn is_text_of_cameras(path: &Path, start: &[u8]) -> bool {
    let first_word = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        let mut lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
        let line = lines.find(|line| !line.is_empty() && !line.starts_with(['#', '%']))?;
        Some(line.split([' ', '\t', ',']).next()?.to_owned())
    };
    let word = first_word(start).or_else(|| first_word(&std::fs::read(path).ok()?));
    word.is_some_and(|word| WORDS.contains(&&*word))
}

/// The cameras of a text.
fn of_text(text: impl io::Read, input: &NamedGraph) -> Result<Read, Fault> {
    let mut given = BTreeMap::new();
    let mut fields = Vec::new();
    for_each_line(text, input, |_, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, fields)) = fields.split_first() else {
            return Ok(());
        };
        let word = word.text(line);
        let expected = match &*word {
            CAMERA => 12,
            POSE => 7,
            CENTRE => 3,
            _ => return Err(Problem::MixedCameras("cameras")),
        };
        let (&first, rest) = fields.split_first().ok_or(Problem::NoCamera)?;
        let node = cameras.named(first, line)?;
        let found = rest.len();
        let numbers = rest.iter().map(|&field| number(field, line));
        let numbers = numbers.collect::<Result<Vec<Rational>, Problem>>()?;
        let wrong = Problem::NoCameraNumbers { expected, found };
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
            Some(_) => Err(Problem::CameraTwice(first.text(line).into_owned())),
        }
    })?;
    all(given, input, Vec::new()).map_err(|problem| Place::Input.fault(problem))
}

fn number(field: Field, line: &str) -> Result<Rational, Problem> {
    let text = field.text(line);
    let number = text.parse();
    number.map_err(|_| Problem::NoRational(text.into_owned()))
}

/// The cameras of a model, by the names of its images.
fn of_model(model: &Model, input: &NamedGraph) -> Result<Read, Problem> {
    let cameras = Cameras::new(input);
    let poses = model.poses();
    let poses = poses.map_err(|image| Problem::Corrupt(format!("the pose of image {image}")))?;
    let (mut given, mut strangers) = (BTreeMap::new(), 0);
    for (image, pose) in model.images.iter().zip(poses) {
        match cameras.node(&image.name) {
            None => strangers += 1,
            Some(node) => {
                if given
                    .insert(node, Given::Camera(Box::new(of_pose(&pose))))
                    .is_some()
                {
                    return Err(Problem::CameraTwice(image.name.to_string()));
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
    all(given, input, note.into_iter().collect())
}

/// The cameras of an array, in the order of the nodes, which are called by numbers.
fn of_array(bytes: &[u8], input: &NamedGraph) -> Result<Read, Problem> {
    let (shape, numbers) = numpy::real_numbers(bytes)?;
    let nodes = input.graph.nodes();
    let wrong = || Problem::NoCameraArray(shape.clone(), nodes);
    let numbered = matches!(input.labels, Labels::Numbers { .. } | Labels::Integers(_));
    let width = match shape[..] {
        [n, 3, 4] if n == nodes as u64 && numbered => 12,
        [n, 3] if n == nodes as u64 && numbered => 3,
        _ => return Err(wrong()),
    };
    let numbers = numbers
        .into_iter()
        .map(|x| exact(x).ok_or_else(|| Problem::NoRational(x.to_string())));
    let numbers = numbers.collect::<Result<Vec<Rational>, Problem>>()?;
    let entries = numbers.chunks(width).map(|entries| match entries {
        [x, y, z] => Given::Centre([x.clone(), y.clone(), z.clone()]),
        _ => Given::Camera(Box::new(matrix(entries))),
    });
    let note =
        "row k of the array is the k-th camera in increasing order of their numbers".to_owned();
    all((0..).zip(entries).collect(), input, vec![note])
}

/// One camera for each node.
fn all(
    given: BTreeMap<u32, Given>,
    input: &NamedGraph,
    notes: Vec<String>,
) -> Result<Read, Problem> {
    let nodes = input.graph.nodes();
    let first = (0..nodes as u32).find(|v| !given.contains_key(v));
    if let Some(first) = first {
        return Err(Problem::MissingCameras {
            first: input.labels.label(first).into_owned(),
            missing: nodes - given.len(),
        });
    }
    let (mut cameras, mut centres) = (Vec::new(), Vec::new());
    for place in given.into_values() {
        match place {
            Given::Camera(camera) => cameras.push(*camera),
            Given::Centre(centre) => centres.push(centre),
        }
    }
    let places = match (cameras.is_empty(), centres.is_empty()) {
        (_, true) => Places::Cameras(cameras),
        (true, _) => Places::Centres(centres),
        _ => return Err(Problem::MixedCameras("centres")),
    };
    Ok(Read { places, notes })
}

/// Twelve numbers, row by row.
fn matrix(entries: &[Rational]) -> Camera<Rational> {
    std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c].clone()))
}

/// [ d R(q) | |q|^2 d t ] for a quaternion and a translation, with d and a multiple of q that make all of them
/// integers, for which no fraction is ever reduced; zero for q = 0.
fn of_pose([q @ .., x, y, z]: &[Rational; 7]) -> Camera<Rational> {
    let one = Integer::one();
    let cleared = |values: &[&Rational]| -> (Integer, Vec<Integer>) {
        let first = one.clone();
        let common = values.iter().fold(first, |all, a| all.lcm(a.denominator()));
        let scaled = |a: &&Rational| a.numerator().mul(&common.div_exact(a.denominator()));
        let scaled = values.iter().map(scaled).collect();
        (common, scaled)
    };
    let (_, q) = cleared(&q.each_ref());
    let (unit, t) = cleared(&[x, y, z]);
    let times = |i: usize, j: usize| q[i].mul(&q[j]);
    let twice = |a: Integer| a.add(&a);
    let norm = (0..4).fold(Integer::zero(), |sum, i| sum.add(&times(i, i)));
    // |q|^2 on the diagonal, less twice the squares of the two other axes.
    let diagonal = |i: usize, j: usize| norm.sub(&twice(times(i, i).add(&times(j, j))));
    let plus = |i: usize, j: usize, k: usize| twice(times(i, j).add(&times(0, k)));
    let minus = |i: usize, j: usize, k: usize| twice(times(i, j).sub(&times(0, k)));
    let rotation = [
        [diagonal(2, 3), minus(1, 2, 3), plus(1, 3, 2)],
        [plus(1, 2, 3), diagonal(1, 3), minus(2, 3, 1)],
        [minus(1, 3, 2), plus(2, 3, 1), diagonal(1, 2)],
    ];
    std::array::from_fn(|r| {
        std::array::from_fn(|c| match c {
            3 => norm.mul(&t[r]).into(),
            _ => rotation[r][c].mul(&unit).into(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, read_graphs};

    fn graph(text: &str) -> NamedGraph {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let mut graphs = read_graphs(file.path(), &ReadOptions::default());
        graphs.next().unwrap().unwrap()
    }

    fn read(text: &str, graph: &NamedGraph) -> Result<Centres, String> {
        let read = of_text(text.as_bytes(), graph);
        let read = read.and_then(|read| read.finish(Question::Calibrated, graph));
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
        let tenth: Rational = "3602879701896397/36028797018963968".parse().unwrap();
        assert_eq!(exact(0.1), Some(tenth));
        assert_eq!(exact(-3.0), "-3".parse().ok());
        assert_eq!(exact(f64::NAN), None);
        assert_eq!(
            exact(5e-324).unwrap(),
            Rational::scaled(Integer::one(), 2, -1074)
        );
    }
}
