//! The matrices of the theory at given cameras, entry by entry and exactly.

use crate::errors::InputError;
use crate::graph::Graph;
use crate::work::Job;
use pyo3::prelude::*;
use std::sync::Arc;
use viewcert::geometry::camera::{Camera, centre};
use viewcert::geometry::jacobian::{SparseRows, augmented, fundamental, jacobian, reference};
use viewcert::geometry::plane_direction::direction_rows;
use viewcert::geometry::plane_flow::rigidity_rows;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::linalg::{Field, Ring};
use viewcert_formats::NamedGraph;

/// What is given of each node.
enum Given {
    Cameras(Vec<Camera<Rational>>),
    Points(Vec<[Rational; 3]>),
}

impl Given {
    fn cameras(&self, name: &str) -> Result<&[Camera<Rational>], String> {
        match self {
            Self::Cameras(cameras) => Ok(cameras),
            Self::Points(_) => Err(format!(
                "cameras: {name} takes matrices of 3 rows and 4 columns, and these are centres"
            )),
        }
    }

    /// The places of the nodes: (x, y, z, w).
    fn places(&self) -> Vec<[Rational; 4]> {
        let one = Rationals.one();
        match self {
            Self::Cameras(cameras) => {
                let each = cameras.iter();
                each.map(|camera| centre(&Rationals, camera)).collect()
            }
            Self::Points(points) => {
                let each = points.iter().cloned();
                each.map(|[x, y, z]| [x, y, z, one.clone()]).collect()
            }
        }
    }
}

/// A matrix: its rows, and how many columns it has.
fn matrix(
    name: &str,
    input: &NamedGraph,
    given: &Given,
) -> Result<(SparseRows<Rational>, usize), String> {
    let (graph, nodes) = (&input.graph, input.graph.nodes());
    let field = &Rationals;
    let label = |v: usize| input.labels.display(v as u32).to_string();
    let apart = |same: &dyn Fn(usize, usize) -> bool| -> Result<(), String> {
        let mut edges = graph.edges().iter().map(|&(i, j)| (i as usize, j as usize));
        edges.find(|&(i, j)| same(i, j)).map_or(Ok(()), |(i, j)| {
            let (i, j) = (label(i), label(j));
            Err(format!(
                "cameras: {i} and {j} are a pair at one place, which has no fundamental matrix"
            ))
        })
    };
    match name {
        "J_P" | "J" => {
            let cameras = given.cameras(name)?;
            let flat = |v: usize| {
                let place = centre(field, &cameras[v]);
                place.iter().all(|x| field.is_zero(x))
            };
            if let Some(v) = (0..nodes).find(|&v| flat(v)) {
                return Err(format!("cameras: that of {} has rank below 3", label(v)));
            }
            apart(&|i, j| {
                let found = fundamental(field, &cameras[i], &cameras[j]);
                found.iter().flatten().all(|x| field.is_zero(x))
            })?;
            let rows = match name {
                "J" if graph.edges().is_empty() => {
                    return Err("J: without pairs there is no frame to fix; ask for J_P".into());
                }
                "J" => augmented(field, graph, cameras, reference(graph)),
                _ => jacobian(field, graph, cameras),
            };
            Ok((rows, 12 * nodes))
        }
        "N" => {
            let mut centres = Vec::with_capacity(nodes);
            for (v, [x, y, z, w]) in given.places().into_iter().enumerate() {
                let below = field.inv(&w).ok_or_else(|| {
                    let v = label(v);
                    format!("N: the centre of {v} is at infinity; map the cameras first")
                })?;
                centres.push([x, y, z].map(|x| field.mul(&x, &below)));
            }
            apart(&|i, j| centres[i] == centres[j])?;
            Ok((rigidity_rows(field, graph, &centres), 3 * nodes))
        }
        "R" => {
            let mut points = Vec::with_capacity(nodes);
            for (v, [x, y, z, w]) in given.places().into_iter().enumerate() {
                if matches!(given, Given::Cameras(_)) && !field.is_zero(&w) {
                    let v = label(v);
                    return Err(format!("R: the camera of {v} is not affine"));
                }
                let below = field.inv(&z).ok_or_else(|| {
                    let v = label(v);
                    format!("R: {v} looks along the plane z = 0; turn the scene first")
                })?;
                points.push([x, y].map(|x| field.mul(&x, &below)));
            }
            apart(&|i, j| points[i] == points[j])?;
            Ok((direction_rows(field, graph, &points), 2 * nodes))
        }
        _ => Err(format!("matrix={name:?}: give 'J_P', 'J', 'N' or 'R'")),
    }
}

/// A matrix at given cameras, or centres, numbers in texts: its rows, columns, numerators and denominators,
/// entry by entry, and its shape.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "a tuple of Python")]
pub(crate) fn rigidity_matrix(
    py: Python<'_>,
    graph: &Graph,
    name: String,
    numbers: Vec<String>,
    width: usize,
) -> PyResult<([Vec<u64>; 2], [Vec<String>; 2], [usize; 2])> {
    let input = Arc::clone(&graph.0);
    let work = move || {
        let read = |text: &String| text.parse::<Rational>();
        let numbers = numbers.iter().map(read).collect::<Result<Vec<_>, _>>();
        let numbers = numbers.map_err(|_| "cameras: there is something that is no number")?;
        let given = match width {
            3 => Given::Points(numbers.as_chunks().0.to_vec()),
            _ => {
                let rows = numbers.as_chunks::<4>().0;
                Given::Cameras(rows.as_chunks().0.to_vec())
            }
        };
        let (rows, columns) = matrix(&name, &input, &given)?;
        let (mut places, mut values) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
        for (row, entries) in (0..).zip(&rows) {
            for (column, value) in entries {
                places[0].push(row);
                places[1].push(*column as u64);
                values[0].push(value.numerator().to_string());
                values[1].push(value.denominator().to_string());
            }
        }
        Ok((places, values, [rows.len(), columns]))
    };
    let found: Result<_, String> = Job::new(py)?.run(py, work)?;
    found.map_err(InputError::new_err)
}
