//! Simple points of a tight core: conditions (S19) to (S23) of section 12 (theory, Lemma 10.9, Theorem
//! 10.10).

use super::dense::{Sparse, columns, dot};
use super::system::{Known, System, cross};
use crate::algebra::Ring;
use crate::cameras::{Camera, centre};
use crate::document::Model;
use crate::document::solutions::Lower;
use crate::elimination::Echelon;
use crate::json::Big;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::HashSet;

/// (S19): the rows of each chain at u = 1 are independent.
pub(super) fn check_chains(system: &System) -> Checked<()> {
    let ones: Known = vec![Some(system.field.one); system.chart.unknowns];
    let mut first = 0;
    for (k, &end) in system.ends.iter().enumerate() {
        // In the columns of the chain's nodes alone.
        let rows: Vec<Sparse> = (first..end).map(|row| system.row(row, &ones)).collect();
        let rank = columns(&system.field, system.meter, &rows)?.rank();
        ensure!(rank == end - first, "the rows of chain {k} are dependent");
        first = end;
    }
    Ok(())
}

/// (S23): how many solutions there are at least.
pub(super) fn check_points(lower: &Lower, system: &System) -> Checked<usize> {
    let points = &lower.points;
    let excess = excess(system);
    ensure!(
        excess == 0,
        "the core is not tight, but has an excess of {excess}"
    );
    ensure!(!points.is_empty(), "there is no point");
    let mut different = HashSet::new();
    for (k, values) in points.iter().enumerate() {
        let checked = checked_values(values, system).and_then(|values| {
            check_point(&values, system)?;
            Ok(values)
        });
        let values = checked.within(|| format!("points[{k}]"))?;
        ensure!(different.insert(values), "points[{k}] is there twice");
    }
    let identity = vec![system.field.one; system.chart.unknowns];
    Ok(points.len() + usize::from(!different.contains(&identity)))
}

/// Equations less unknowns.
fn excess(system: &System) -> i64 {
    let chart = system.chart;
    let sizes = chart.chains.iter().map(Vec::len);
    let pairs = chart.half_edges.iter().flat_map(|_| [2, 2]);
    let members = sizes
        .chain(pairs)
        .map(|size| Model::default().required(size));
    members.sum::<i64>() - Model::default().required(chart.nodes)
}

/// The values of all unknowns, none of which is zero.
fn checked_values(values: &[Big<u64>], system: &System) -> Checked<Vec<u64>> {
    let values = system.residues(values)?;
    ensure!(
        values.len() == system.chart.unknowns,
        "{} values for {} unknowns",
        values.len(),
        system.chart.unknowns
    );
    ensure!(!values.contains(&0), "a scale is zero");
    Ok(values)
}

/// (S20) to (S22): a simple point, with cameras.
fn check_point(values: &[u64], system: &System) -> Checked<()> {
    let known: Known = values.iter().copied().map(Some).collect();
    let space = system.space(&known)?;
    ensure!(
        space.rank() == system.target,
        "N(u) has rank {}, not {}",
        space.rank(),
        system.target
    );
    let kernel = space.free().into_iter();
    let kernel = kernel.map(|free| space.orthogonal(free));
    let kernel = kernel.collect::<Checked<Vec<_>>>()?;
    check_cameras(&kernel, &known, system)?;
    check_simple(&kernel, &known, system)
}

/// (S21): cameras of rank 3, with different centres within members.
fn check_cameras(kernel: &[Vec<u64>], known: &Known, system: &System) -> Checked<()> {
    let cameras = cameras(kernel, known, system)?;
    let centres: Vec<[u64; 4]> = cameras
        .iter()
        .map(|camera| centre(&system.field, camera))
        .collect();
    ensure!(
        !centres.contains(&[0; 4]),
        "a camera of the point has rank below 3"
    );
    let pairs = system.chart.half_edges.iter();
    let pairs = pairs.flat_map(|&[v, a, b]| [vec![v, a], vec![v, b]]);
    for nodes in system.chart.chains.iter().cloned().chain(pairs) {
        let different: HashSet<[u64; 4]> = nodes
            .iter()
            .map(|&node| normalised(system, centres[node]))
            .collect();
        ensure!(
            different.len() == nodes.len(),
            "two cameras of the point have the same centre"
        );
    }
    Ok(())
}

/// A centre up to a factor.
fn normalised(system: &System, centre: [u64; 4]) -> [u64; 4] {
    let first = centre.into_iter().find(|&entry| entry != 0);
    let inverse = system.field.inverse(first.unwrap_or_default());
    centre.map(|entry| system.field.mul(inverse, entry))
}

/// The cameras whose columns are the kernel vectors, those of eliminated nodes included.
fn cameras(kernel: &[Vec<u64>], known: &Known, system: &System) -> Checked<Vec<Camera<u64>>> {
    let wrong = || Failure::rejected("the kernel has not dimension 4");
    let kernel: &[Vec<u64>; 4] = kernel.try_into().map_err(|_| wrong())?;
    let camera = |column: &Option<usize>| {
        column.map_or([[0; 4]; 3], |first| {
            [0, 1, 2].map(|row| [0, 1, 2, 3].map(|k| kernel[k][first + row]))
        })
    };
    let mut cameras: Vec<Camera<u64>> = system.column.iter().map(camera).collect();
    for k in 0..system.chart.half_edges.len() {
        let [v, _, _] = system.chart.half_edges[k];
        cameras[v] = eliminated(k, &cameras, known, system);
    }
    Ok(cameras)
}

/// The camera of the node that a half-edge eliminates. In each column, y_a + t d = s y_b + r e for
/// the differences d and e of centres, and n . (y_a - s y_b) = 0 for n = d x e. So t solves
/// t (d x e) = (s y_b - y_a) x e, of which a coordinate is taken where d x e is not zero.
fn eliminated(k: usize, cameras: &[Camera<u64>], known: &Known, system: &System) -> Camera<u64> {
    let field = &system.field;
    let [v, a, b] = system.chart.half_edges[k];
    let minus = |x: [u64; 3], y: [u64; 3]| [0, 1, 2].map(|at| field.sub(x[at], y[at]));
    let d = minus(system.centres[a], system.centres[v]);
    let e = minus(system.centres[b], system.centres[v]);
    let normal = cross(field, d, e);
    let at = normal.iter().position(|&entry| entry != 0).unwrap_or(0);
    let inverse = field.inverse(normal[at]);
    let scale = system.chart.scale(system.chart.chains.len() + k, b);
    let scale = scale.and_then(|f| known[f]).unwrap_or(field.one);
    let mut camera = [[0; 4]; 3];
    for column in 0..4 {
        let [y_a, y_b] = [a, b].map(|node| cameras[node].map(|row| row[column]));
        let right = minus(y_b.map(|entry| field.mul(scale, entry)), y_a);
        let t = field.mul(inverse, cross(field, right, e)[at]);
        for row in 0..3 {
            camera[row][column] = field.add(y_a[row], field.mul(t, d[row]));
        }
    }
    camera
}

/// (S22): the derivatives by the unknowns of w N(u) y, for w in the left and y in the right kernel,
/// are independent: those of N(u) y are, modulo the columns of N(u).
fn check_simple(kernel: &[Vec<u64>], known: &Known, system: &System) -> Checked<()> {
    let (field, height) = (&system.field, system.rows.len());
    let rows: Vec<Sparse> = (0..height).map(|row| system.row(row, known)).collect();
    let mut image = columns(field, system.meter, &rows)?;
    // For each unknown what its sides are at each y.
    let mut derivatives = vec![vec![Sparse::new(); kernel.len()]; known.len()];
    for (number, row) in system.rows.iter().enumerate() {
        for (side, scale) in row.iter().zip([field.one, field.neg(field.one)]) {
            let Some(f) = side.unknown else { continue };
            for (y, derivative) in kernel.iter().zip(&mut derivatives[f]) {
                let product = dot(field, &side.vector, &y[side.column..side.column + 3]);
                derivative.push((number, field.mul(scale, product)));
            }
        }
    }
    let mut independent = Echelon::new(field, height * kernel.len(), system.meter);
    for derivatives in derivatives {
        let mut row = Sparse::new();
        for (k, derivative) in derivatives.into_iter().enumerate() {
            let rest = image.residue(derivative)?;
            row.extend(rest.into_iter().map(|(at, entry)| (k * height + at, entry)));
        }
        independent.push(row, None)?;
    }
    ensure!(
        independent.rank() == known.len(),
        "the point is not simple: {} of {} directions",
        independent.rank(),
        known.len()
    );
    Ok(())
}
