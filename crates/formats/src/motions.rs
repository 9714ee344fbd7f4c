//! Measured motions of pairs: what a database, a pose graph or a list of relative poses says of the rotation
//! between two images, in integers (docs/contradictions.md, section 1).
//!
//! In: a path. Out: [`Motions`]. Of a pair that cannot be checked it says why.

use crate::documents::is_g2o;
use crate::error::{Fault, Place, Problem, ReadError};
use crate::quaternion::quaternion;
use crate::{ReadOptions, open_database, read_graphs, whole};
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use viewcert::graph::Labels;

/// A pair with a measured motion: X' = R X + t for a point in the frames of its two images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    /// The two images.
    pub images: [u32; 2],
    /// How many matches were verified; 0 where nothing says.
    pub inliers: u32,
    /// COLMAP's configuration, 2 or 3, if it is of a database.
    pub configuration: Option<i64>,
    /// R as a quaternion (w, x, y, z) of any length but zero.
    pub rotation: [i64; 4],
    /// t, up to a positive factor; never zero.
    pub vector: Option<[i64; 3]>,
    /// Whether rays meet at angles that tell the direction of t.
    pub is_wide: bool,
}

/// Why a pair cannot be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unchecked {
    /// A homography explains its matches.
    Planar,
    /// A focal length was not known before matching.
    FocalLength,
    /// Fewer than 15 inliers.
    FewInliers,
    /// Neither calibrated nor uncalibrated.
    Configuration,
    /// No essential matrix is stored, or what is stored is none.
    NoEssential,
    /// The cameras have distortion.
    Distortion,
    /// Too few points lie in front of both cameras.
    Behind,
    /// No rotation is read from such lines.
    NoRotation,
}

impl Unchecked {
    /// The reason in a few words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Planar => "planar",
            Self::FocalLength => "focal length unknown",
            Self::FewInliers => "few inliers",
            Self::Configuration => "neither calibrated nor uncalibrated",
            Self::NoEssential => "no essential matrix",
            Self::Distortion => "distortion",
            Self::Behind => "too few points in front",
            Self::NoRotation => "no rotation",
        }
    }
}

/// What is measured of a pair, or why nothing is; of a pair with too few points in front, its motion all the same.
pub(crate) type Measured = Result<Motion, (Unchecked, Option<Motion>)>;

/// The motions of all pairs of an input.
#[derive(Clone, Debug)]
pub struct Motions {
    /// The input.
    pub name: String,
    /// What images are called.
    pub labels: Labels,
    /// How many there are.
    pub images: usize,
    /// The pairs that can be checked.
    pub pairs: Vec<Motion>,
    /// Pairs that could be, were enough points in front.
    pub excluded: Vec<Motion>,
    /// How many pairs cannot be checked, by the reason.
    pub unchecked: BTreeMap<Unchecked, usize>,
    /// The pairs that cannot be checked and join images all the same.
    pub others: Vec<[u32; 2]>,
    /// Whether this is a COLMAP database.
    pub is_database: bool,
    /// Its hash, if that was asked.
    pub hash: Option<String>,
    /// Whether rotations may be meant from the second image to the first.
    pub either_way: bool,
}

impl Motions {
    pub(crate) fn of(name: &str, labels: Labels, images: usize) -> Self {
        Self {
            name: name.to_owned(),
            labels,
            images,
            pairs: Vec::new(),
            excluded: Vec::new(),
            unchecked: BTreeMap::new(),
            others: Vec::new(),
            is_database: false,
            hash: None,
            either_way: false,
        }
    }

    /// Takes in what is measured between two images.
    pub(crate) fn take(&mut self, images: [u32; 2], measured: Measured) {
        match measured {
            Ok(motion) => self.pairs.push(motion),
            Err((why, motion)) => {
                self.others.push(images);
                self.excluded.extend(motion);
                *self.unchecked.entry(why).or_default() += 1;
            }
        }
    }

    /// The same with all rotations meant the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut other = self.clone();
        for pair in &mut other.pairs {
            let [w, x, y, z] = pair.rotation;
            pair.rotation = [w, -x, -y, -z];
        }
        other
    }
}

/// Numbers in the ratio of these, rounded to integers of 24 bits; none of zeros, or of what is not finite.
pub(crate) fn integers<const N: usize>(numbers: [f64; N]) -> Option<[i64; N]> {
    let largest = numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let scaled = numbers.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    let is_good = length.is_finite() && largest.is_finite();
    is_good.then(|| scaled.map(|x| (x / length * f64::from(1 << 24)).round() as i64))
}

/// The motions of a database, with its hash if that is asked, of a pose graph of g2o, or of a list of relative poses.
///
/// # Errors
/// A file that cannot be read, and one that holds no motions.
pub fn read_motions(
    path: &Path,
    options: &ReadOptions,
    hashed: bool,
) -> Result<Motions, ReadError> {
    if let Some(database) = open_database(path, options) {
        let database = database?;
        let motions = database.motions(hashed)?;
        database.finish()?;
        return Ok(motions);
    }
    let name = path.display().to_string();
    let in_file = |problem| Place::Input.fault(problem).in_file(&name);
    if path == Path::new("-") {
        return Err(in_file(Problem::new(
            "motions are read from files",
            "name the file",
        )));
    }
    let graph = read_graphs(path, options).next();
    let graph = graph.unwrap_or_else(|| {
        Err(in_file(Problem::new(
            "the file is empty",
            "name another one",
        )))
    })?;
    let nodes: HashMap<String, u32> = (0..graph.graph.nodes() as u32)
        .map(|v| (graph.labels.label(v).into_owned(), v))
        .collect();
    let mut motions = Motions::of(&graph.name, graph.labels, nodes.len());
    let bytes = whole::bytes(path)?;
    let text = whole::text_of(&bytes).map_err(in_file)?;
    let lines = text.lines().zip(1..);
    let read = match is_g2o(&text) {
        true => of_g2o(lines, &nodes, &mut motions),
        false => of_poses(lines, &nodes, &mut motions),
    };
    read.map_err(|fault| fault.in_file(&name))?;
    match motions.pairs.is_empty() && motions.unchecked.is_empty() {
        true => Err(in_file(Problem::new(
            "its pairs have no rotations",
            "name a COLMAP database, a pose graph of g2o, or a list of relative poses with 9 or 14 fields",
        ))),
        false => Ok(motions),
    }
}

type Lines<'t> = std::iter::Zip<std::str::Lines<'t>, std::ops::RangeFrom<u64>>;

/// The edges of a pose graph, X = R X' + t each.
fn of_g2o(
    lines: Lines<'_>,
    nodes: &HashMap<String, u32>,
    motions: &mut Motions,
) -> Result<(), Fault> {
    for (line, number) in lines {
        let fault = |problem| Place::Line(number).fault(problem);
        let fields: Vec<&str> = line.split_ascii_whitespace().collect();
        let (Some(tag), Some(images)) = (fields.first(), ends(&fields, 1, nodes)) else {
            continue;
        };
        let quaternion = match *tag {
            "EDGE_SE3:QUAT" => {
                let [.., x, y, z, w] = numbers::<7>(&fields[3..]).map_err(fault)?;
                [w, -x, -y, -z]
            }
            "EDGE_SE2" => {
                let [_, _, turn] = numbers::<3>(&fields[3..]).map_err(fault)?;
                [(turn / 2.0).cos(), 0.0, 0.0, -(turn / 2.0).sin()]
            }
            tag if tag.starts_with("EDGE_") => {
                motions.take(images, Err((Unchecked::NoRotation, None)));
                continue;
            }
            _ => continue,
        };
        let rotation = integers(quaternion).ok_or_else(|| fault(no_rotation()))?;
        motions.take(images, Ok(posed(images, rotation)));
    }
    Ok(())
}

/// Lines of two names and a quaternion from the first to the second, or a matrix either way.
fn of_poses(
    lines: Lines<'_>,
    nodes: &HashMap<String, u32>,
    motions: &mut Motions,
) -> Result<(), Fault> {
    for (line, number) in lines {
        let fault = |problem| Place::Line(number).fault(problem);
        let split = line.split([' ', '\t', ',', ';', '"']).map(str::trim);
        let fields: Vec<&str> = split.filter(|field| !field.is_empty()).collect();
        let Some(images) = ends(&fields, 0, nodes) else {
            continue;
        };
        let q = match fields.len() {
            9 => numbers::<4>(&fields[2..]).map_err(fault)?,
            14 => {
                motions.either_way = true;
                let [a, b, c, d, e, f, g, h, i] = numbers(&fields[2..]).map_err(fault)?;
                quaternion(&[[a, b, c], [d, e, f], [g, h, i]])
            }
            _ => continue,
        };
        let rotation = integers(q).ok_or_else(|| fault(no_rotation()))?;
        motions.take(images, Ok(posed(images, rotation)));
    }
    Ok(())
}

fn posed(images: [u32; 2], rotation: [i64; 4]) -> Motion {
    Motion {
        images,
        inliers: 0,
        configuration: None,
        rotation,
        vector: None,
        is_wide: false,
    }
}

/// The two nodes that a line names from this field on, if they are two.
fn ends(fields: &[&str], from: usize, nodes: &HashMap<String, u32>) -> Option<[u32; 2]> {
    let [a, b] = [fields.get(from)?, fields.get(from + 1)?].map(|name| nodes.get(*name));
    a.zip(b).map(|(&a, &b)| [a, b]).filter(|[a, b]| a != b)
}

fn numbers<const N: usize>(fields: &[&str]) -> Result<[f64; N], Problem> {
    let all = fields.iter().take(N).map(|field| field.parse().ok());
    let all: Option<Vec<f64>> = all.collect();
    all.and_then(|all| all.try_into().ok())
        .ok_or_else(no_rotation)
}

fn no_rotation() -> Problem {
    Problem::new(
        "this line has no rotation",
        "write all numbers of the pose behind its pair",
    )
}
