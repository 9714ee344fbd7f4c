//! Measured motions of pairs: what a database, a pose graph or a list of relative poses says of the rotation
//! between two images.
//!
//! In: a path. Out: [`Motions`]. Of a pair that cannot be checked they say why.

use crate::documents::is_g2o;
use crate::error::{Place, Problem, ReadError};
use crate::motions::{Motion, Motions, Source, Unchecked, integers};
use crate::quaternion::quaternion;
use crate::{ReadOptions, open_database, read_graphs, whole};
use std::collections::HashMap;
use std::path::Path;

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
    let is_pose_graph = is_g2o(&text);
    if is_pose_graph {
        motions.source = Source::PoseGraph;
    }
    for (line, number) in text.lines().zip(1..) {
        let fault = |problem| Place::Line(number).fault(problem).in_file(&name);
        let fields = line.split([' ', '\t', ',', ';', '"']).map(str::trim);
        let fields: Vec<&str> = fields.filter(|field| !field.is_empty()).collect();
        let (tag, fields) = fields.split_at(usize::from(is_pose_graph).min(fields.len()));
        let [one, other, rest @ ..] = fields else {
            continue;
        };
        let (Some(&i), Some(&j)) = (nodes.get(*one), nodes.get(*other)) else {
            continue;
        };
        let found = match Rotation::of(tag.first().copied(), rest).filter(|_| i != j) {
            Some(found) => found.map_err(fault)?,
            None => continue,
        };
        motions.either_way |= matches!(found, Rotation::EitherWay(_));
        let measured = match found {
            Rotation::None => Err((Unchecked::NoRotation, None)),
            Rotation::Of(q) | Rotation::EitherWay(q) => Ok(Motion {
                images: [i, j],
                inliers: 0,
                configuration: None,
                rotation: integers(q).ok_or_else(|| fault(no_rotation()))?,
                vector: None,
                is_wide: false,
            }),
        };
        motions.take([i, j], measured);
    }
    match motions.pairs.is_empty() && motions.unchecked.is_empty() {
        true => Err(in_file(Problem::new(
            "its pairs have no rotations",
            "name a COLMAP database, a pose graph of g2o, or a list of relative poses with 9 or 14 fields",
        ))),
        false => Ok(motions),
    }
}

/// What a line says of the rotation between its two nodes.
enum Rotation {
    /// From the first to the second.
    Of([f64; 4]),
    /// From one to the other.
    EitherWay([f64; 4]),
    None,
}

impl Rotation {
    /// Behind the names of a pair: of an edge of a pose graph with this tag, X = R X' + t, or of a list. None is in
    /// other lines.
    fn of(tag: Option<&str>, fields: &[&str]) -> Option<Result<Self, Problem>> {
        Some(match (tag, fields.len()) {
            (Some("EDGE_SE3:QUAT"), _) => {
                numbers(fields).map(|[_, _, _, x, y, z, w]| Self::Of([w, -x, -y, -z]))
            }
            (Some("EDGE_SE2"), _) => numbers(fields).map(|[_, _, turn]: [f64; 3]| {
                let (sine, cosine) = (turn / 2.0).sin_cos();
                Self::Of([cosine, 0.0, 0.0, -sine])
            }),
            (Some(tag), _) if tag.starts_with("EDGE_") => Ok(Self::None),
            (None, 7) => numbers(fields).map(Self::Of),
            (None, 12) => numbers(fields).map(|[a, b, c, d, e, f, g, h, i]| {
                Self::EitherWay(quaternion(&[[a, b, c], [d, e, f], [g, h, i]]))
            }),
            _ => return None,
        })
    }
}

/// The first so many numbers.
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
