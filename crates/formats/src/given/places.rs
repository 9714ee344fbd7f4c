//! Cameras or centres, one for each node of a graph, wherever they were read.

use std::collections::BTreeMap;

use crate::NamedGraph;
use crate::edge_list::refusal::shown;
use crate::error::Problem;
use viewcert::at_cameras::{CentreError, Centres};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::model::Model as Question;
use viewcert::linalg::rational::Rational;
use viewcert::wording::counted;

/// A camera for each node of a graph.
#[derive(Clone, Debug)]
pub struct GivenCameras {
    /// Their centres.
    pub centres: Centres,
    /// What was read, and what of it was left out.
    pub notes: Vec<String>,
}

/// What a line, or an entry of an array, gives.
pub(super) enum Given {
    Camera(Box<Camera<Rational>>),
    Centre([Rational; 3]),
}

/// What is wrong with cameras, by the names of these, and what to do.
pub fn centre_error(error: CentreError, input: &NamedGraph) -> String {
    let name = |v: u32| input.labels.display(v).to_string();
    match error {
        CentreError::Degenerate(v) => format!(
            "camera {} has rank below 3, or zero for its direction: it has no centre; mend it",
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

/// One camera for each node, with its centre as a model asks for it.
pub(super) fn all(
    given: BTreeMap<u32, Given>,
    input: &NamedGraph,
    model: Question,
    notes: Vec<String>,
) -> Result<GivenCameras, Problem> {
    let nodes = input.graph.nodes();
    let first = (0..nodes as u32).find(|v| !given.contains_key(v));
    if let Some(first) = first {
        let missing = counted(nodes - given.len(), "node");
        let first = input.labels.label(first);
        return Err(Problem::new(
            format!(
                "no camera is given for {missing} of the graph; `{}` is the first",
                shown(&first)
            ),
            "give every node a camera, or leave the pairs of those that have none out of the graph",
        ));
    }
    let (mut cameras, mut centres) = (Vec::new(), Vec::new());
    for place in given.into_values() {
        match place {
            Given::Camera(camera) => cameras.push(*camera),
            Given::Centre(centre) => centres.push(centre),
        }
    }
    let centres = match (cameras.is_empty(), centres.is_empty()) {
        (_, true) => Centres::of_cameras(model, &cameras),
        (true, _) => Centres::of_points(model, &centres),
        _ => return Err(super::mixed("centres")),
    };
    let remedy = "give cameras of rank 3 that the model knows";
    let centres = centres.map_err(|error| Problem::new(centre_error(error, input), remedy))?;
    Ok(GivenCameras { centres, notes })
}

/// Twelve numbers, row by row.
pub(super) fn matrix(entries: &[Rational]) -> Camera<Rational> {
    std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c].clone()))
}
