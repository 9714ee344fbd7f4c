//! Cameras in arrays: `.npy`, `.npz`, and MATLAB's files of version 5.
//!
//! In: a file, and the graph. Out: for every node a camera or a centre, by the order of the nodes, which are called by
//! numbers, or by the array `names` of an `.npz` file.

use std::collections::BTreeMap;

use super::places::{Given, Read, all, matrix};
use crate::cameras::Cameras;
use crate::error::{Fault, Place, Problem};
use crate::model::exact;
use crate::{NamedGraph, matlab, numpy};
use viewcert::graph::Labels;
use viewcert::linalg::rational::Rational;

/// Reads cameras from bytes.
type Reader = fn(&[u8], &NamedGraph) -> Result<Read, Fault>;

/// The reader of a file that begins like this, if it is one of arrays.
pub(super) fn reader(start: &[u8]) -> Option<Reader> {
    if start.starts_with(numpy::MAGIC) {
        return Some(|bytes, input| of_numpy(bytes, input).map_err(|p| Place::Input.fault(p)));
    }
    if numpy::is_archive(start) {
        return Some(|bytes, input| of_archive(bytes, input).map_err(|p| Place::Input.fault(p)));
    }
    matlab::is_matlab(start).then_some(of_matlab as Reader)
}

/// What says which node a row is of, where no names do.
const BY_NUMBER: &str =
    "row k of the array is the k-th camera in increasing order of their numbers";

/// An array with its rows one after the other, in the order of the nodes.
fn in_order(
    (shape, numbers): (&[u64], &[f64]),
    input: &NamedGraph,
    mut notes: Vec<String>,
) -> Result<Read, Problem> {
    let nodes = input.graph.nodes();
    let is_numbered = matches!(input.labels, Labels::Numbers { .. } | Labels::Integers(_));
    if !is_numbered || !is_of_cameras(shape, nodes) {
        return Err(Problem::NoCameraArray(shape.to_vec(), nodes));
    }
    notes.push(BY_NUMBER.to_owned());
    all((0..).zip(rows(shape, numbers)?).collect(), input, notes)
}

fn is_of_cameras(shape: &[u64], nodes: usize) -> bool {
    matches!(shape, [n, 3, 4] | [n, 3] if *n == nodes as u64)
}

/// The cameras or centres of an array, as exact fractions.
fn rows(shape: &[u64], numbers: &[f64]) -> Result<Vec<Given>, Problem> {
    let width = if shape.len() == 3 { 12 } else { 3 };
    let numbers = numbers
        .iter()
        .map(|&x| exact(x).ok_or_else(|| Problem::NoRational(x.to_string())));
    let numbers = numbers.collect::<Result<Vec<Rational>, Problem>>()?;
    let entries = numbers.chunks(width).map(|entries| match entries {
        [x, y, z] => Given::Centre([x.clone(), y.clone(), z.clone()]),
        _ => Given::Camera(Box::new(matrix(entries))),
    });
    Ok(entries.collect())
}

fn of_numpy(bytes: &[u8], input: &NamedGraph) -> Result<Read, Problem> {
    let (shape, numbers) = numpy::real_numbers(bytes)?;
    in_order((&shape, &numbers), input, Vec::new())
}

/// The only one of some arrays.
fn only<T>(
    mut arrays: Vec<(String, T)>,
    shape: &'static str,
    nodes: usize,
) -> Result<(String, T), Problem> {
    if arrays.len() > 1 {
        let names: Vec<&str> = arrays.iter().map(|(name, _)| &**name).collect();
        return Err(Problem::SeveralCameraArrays(names.join(", ")));
    }
    arrays.pop().ok_or(Problem::NoCameraArrays(shape, nodes))
}

fn of_archive(bytes: &[u8], input: &NamedGraph) -> Result<Read, Problem> {
    let nodes = input.graph.nodes();
    // With names there may be cameras that the graph does not have.
    let is_wanted = |shape: &[u64]| matches!(shape, [_, 3, 4] | [_, 3]);
    let (mut arrays, mut names) = (Vec::new(), None);
    for (name, held) in numpy::held(bytes, is_wanted)? {
        match held {
            numpy::Held::Numbers(shape, numbers) => arrays.push((name, (shape, numbers))),
            numpy::Held::Texts(texts) if name == "names" => names = Some(texts),
            numpy::Held::Texts(_) => (),
        }
    }
    let (name, (shape, numbers)) = only(arrays, "n, 3, 4", nodes)?;
    let note = format!("cameras are the array {name} of the archive");
    let Some(names) = names else {
        return in_order((&shape, &numbers), input, vec![note]);
    };
    if names.len() as u64 != shape[0] {
        return Err(Problem::NoCameraArray(shape, names.len()));
    }
    let cameras = Cameras::new(input);
    let (mut given, mut strangers) = (BTreeMap::new(), 0);
    for (label, place) in names.iter().zip(rows(&shape, &numbers)?) {
        match cameras.node(label) {
            None => strangers += 1,
            Some(node) => {
                if given.insert(node, place).is_some() {
                    return Err(Problem::CameraTwice(label.clone()));
                }
            }
        }
    }
    let mut notes = vec![note];
    if strangers > 0 {
        notes.push(format!(
            "not in the graph, and left out: {strangers} of the names"
        ));
    }
    all(given, input, notes)
}

fn of_matlab(bytes: &[u8], input: &NamedGraph) -> Result<Read, Fault> {
    let nodes = input.graph.nodes();
    let is_wanted = |shape: &[u32]| match *shape {
        [3, 4, n] | [n, 3] => n as usize == nodes,
        _ => false,
    };
    let arrays = matlab::real_arrays(bytes, is_wanted)?;
    let arrays = arrays
        .into_iter()
        .map(|(name, shape, numbers)| (name, (shape, numbers)));
    let found = only(arrays.collect(), "3 x 4 x n", nodes);
    let (name, (shape, numbers)) = found.map_err(|problem| Place::Input.fault(problem))?;
    // MATLAB's first index changes fastest.
    let is_cameras = shape.len() == 3;
    let at = |k: usize| match is_cameras {
        true => 12 * (k / 12) + k % 12 / 4 + 3 * (k % 4),
        false => k / 3 + nodes * (k % 3),
    };
    let shape: &[u64] = match is_cameras {
        true => &[nodes as u64, 3, 4],
        false => &[nodes as u64, 3],
    };
    let numbers: Vec<f64> = (0..numbers.len()).map(|k| numbers[at(k)]).collect();
    let notes = vec![format!("cameras are the variable {name}")];
    let read = in_order((shape, &numbers), input, notes);
    read.map_err(|problem| Place::Variable(name).fault(problem))
}

#[cfg(test)]
mod tests;
