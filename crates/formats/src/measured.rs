//! Measured motions of pairs: what a database, a pose graph or a list of relative poses says of the rotation
//! between two images.
//!
//! In: a path. Out: [`Motions`]. Of a pair that cannot be checked they say why.

use crate::documents::is_g2o;
use crate::error::{Fault, Place, Problem, ReadError};
use crate::motions::{Motion, Motions, Unchecked, integers};
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
