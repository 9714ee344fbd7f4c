//! Internal to viewcert, and may change at any time.
//!
//! The verdict in floating point, as the paper computes it, to be held against the exact one.
//!
//! Cameras have entries uniform in [0, 1) and Frobenius norm 10, fundamental matrices Frobenius norm 10, as in the
//! authors' published code; the matrix is the augmented Jacobian J of the paper's section 4.1, 10m + n + 15 rows and 12n
//! columns, the frame on a camera of highest degree and its neighbour of highest degree. (The published code adds n - 1
//! auxiliary unknowns for the rank of the cameras, and halves the rows of the diagonal of S + S^T; the paper's J has
//! neither.) G is called finite solvable if the smallest eigenvalue of J^T J is above a tolerance.
//!
//! [`claims`] of others are decided again, also of given cameras, with an [`enclosure`] of the singular value. No float is in
//! any verdict or certificate.

pub mod claims;
pub mod enclosure;
pub mod linear;
pub mod softness;

use linear::{Doubles, Inverse, envelope_order, reordered};
use rayon::prelude::*;
use std::time::{Duration, Instant};
use viewcert::decide::{Value, Verdict};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian::{self, SparseRows, reference};
use viewcert::graph::{Graph, sha256};
use viewcert::linalg::prime::PrimeField;

/// The tolerance of the published code, on the smallest eigenvalue of J^T J.
pub const TOLERANCE: f64 = 1e-10;

/// The Frobenius norm of cameras and of fundamental matrices.
const NORM: f64 = 10.0;

/// The bound on a camera's part of the null space, as in the published code.
const VANISHES: f64 = 1e-4;

/// Whether floating point says finite solvable, by the smallest singular value of J; nothing where that is not a number, or its
/// square is infinite.
fn is_solvable(smallest: f64, tolerance: f64) -> Option<bool> {
    let eigenvalue = smallest * smallest;
    eigenvalue.is_finite().then_some(eigenvalue > tolerance)
}

/// Why floating point has no answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AuditError {
    /// The graph has no pairs, and so no frame.
    #[error("the graph has no pairs, and J no frame to fix")]
    NoPairs,
    /// Singular values did not converge, or no shift made a matrix positive definite.
    #[error("the singular values did not converge, or are not numbers")]
    NoConvergence,
}

/// Numbers uniform in [0, 1), with 53 random bits each.
pub fn uniform(graph: &Graph, seed: u64, draw: u64, count: usize) -> Vec<f64> {
    let field = PrimeField::mersenne61();
    let key = DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed,
        draw,
    };
    let mut residue = key.residues(&field);
    let mut entry = || (field.to_u64(residue()) >> 8) as f64 / (1u64 << 53) as f64;
    (0..count).map(|_| entry()).collect()
}

/// What a matrix is multiplied by to have Frobenius norm [`NORM`].
fn scale<const R: usize, const C: usize>(matrix: &[[f64; C]; R]) -> f64 {
    NORM / matrix.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

/// J_P at cameras that are scaled, with fundamental matrices that are. O(m).
fn plain(graph: &Graph, mut cameras: Vec<Camera<f64>>) -> SparseRows<f64> {
    for camera in &mut cameras {
        let factor = scale(camera);
        camera.iter_mut().flatten().for_each(|x| *x *= factor);
    }
    let mut rows = jacobian::jacobian(&Doubles, graph, &cameras);
    let blocks = rows.chunks_exact_mut(jacobian::VECH.len());
    for (block, &(i, j)) in blocks.zip(graph.edges()) {
        let [p_i, p_j] = [i, j].map(|v| &cameras[v as usize]);
        let factor = scale(&jacobian::fundamental(&Doubles, p_i, p_j));
        block.iter_mut().flatten().for_each(|(_, x)| *x *= factor);
    }
    rows
}

/// J_P at drawn cameras, whose entries are uniform in [0, 1) before they are scaled. Cameras of rank below 3 and
/// coincident centres do not occur in practice; they would show as a singular J.
fn drawn(graph: &Graph, seed: u64, draw: u64) -> SparseRows<f64> {
    let entries = uniform(graph, seed, draw, 12 * graph.nodes());
    let camera =
        |entries: &[f64]| std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c]));
    plain(graph, entries.chunks_exact(12).map(camera).collect())
}

/// J at drawn cameras.
///
/// # Panics
/// If the graph has no pair.
pub fn augmented(graph: &Graph, seed: u64, draw: u64) -> SparseRows<f64> {
    let mut rows = drawn(graph, seed, draw);
    rows.extend(jacobian::gauge(&Doubles, graph, reference(graph)));
    rows
}

/// The smallest singular value of J at one draw.
///
/// # Errors
/// See [`AuditError`].
pub fn smallest(graph: &Graph, seed: u64, draw: u64) -> Result<f64, AuditError> {
    if graph.edges().is_empty() {
        return Err(AuditError::NoPairs);
    }
    let mut j = augmented(graph, seed, draw);
    reordered(&mut j, 12, &envelope_order(graph));
    let (values, _) = Inverse::new(&j, 12 * graph.nodes())?.smallest(1, 1e-10)?;
    Ok(values[0])
}

/// Components by the rows of a null space that vanish (the paper's section 4.2): for every edge the number of its
/// component, counted in the order in which they were found. There is an edge.
///
/// The frame is put on an edge without component, first on the usual one. The cameras whose twelve rows of the null space
/// vanish (sums of absolute values, then the norm over the vectors, below 1e-4) are in its component, with all edges
/// between them.
///
/// # Errors
/// See [`AuditError`].
fn components(graph: &Graph, seed: u64, tolerance: f64) -> Result<Vec<usize>, AuditError> {
    let edges = graph.edges();
    let (place, rows) = (envelope_order(graph), drawn(graph, seed, 0));
    let mut component = vec![None; edges.len()];
    let mut frame = reference(graph);
    for number in 0.. {
        let mut j = rows.clone();
        j.extend(jacobian::gauge(&Doubles, graph, frame));
        reordered(&mut j, 12, &place);
        let null = Inverse::new(&j, 12 * graph.nodes())?.null_space(tolerance)?;
        let vanishes = |v: u32| {
            let rows = 12 * place[v as usize]..;
            let part = |x: &Vec<f64>| x[rows.clone()][..12].iter().map(|x| x.abs()).sum::<f64>();
            let squares: f64 = null.iter().map(part).map(|part| part * part).sum();
            squares.sqrt() < VANISHES
        };
        for (e, &(i, j)) in edges.iter().enumerate() {
            if component[e].is_none() && (e == frame || vanishes(i) && vanishes(j)) {
                component[e] = Some(number);
            }
        }
        let Some(next) = component.iter().position(Option::is_none) else {
            break;
        };
        frame = next;
    }
    Ok(component.into_iter().flatten().collect())
}

/// What floating point found of a graph, held against its verdict.
#[derive(Clone, Debug)]
pub struct Beside {
    /// Whether it says finite solvable at the first draw; nothing where a value is not a number.
    pub is_solvable: Option<bool>,
    /// The smallest singular value of J there.
    pub smallest: f64,
    /// Components of the float side; `None` if it is undecided.
    pub components: Option<usize>,
    /// Its time, components included.
    pub time: Duration,
    /// The smallest eigenvalue of J^T J above which it says finite solvable.
    pub tolerance: f64,
    /// How many draws there were.
    pub draws: usize,
    /// At how many of them the float verdict was not the exact one.
    pub misjudged: usize,
    /// Whether both sides agree at every draw, and on the number of components at the first.
    pub agrees: bool,
}

impl Beside {
    /// Computes it at so many draws of cameras, one at least.
    ///
    /// # Errors
    /// See [`AuditError`].
    pub fn new(
        graph: &Graph,
        exact: &Verdict,
        (seed, tolerance): (u64, f64),
        draws: u64,
    ) -> Result<Self, AuditError> {
        let start = Instant::now();
        let first = smallest(graph, seed, 0)?;
        let says = is_solvable(first, tolerance);
        let components = match says {
            Some(true) => Some(1),
            Some(false) => components(graph, seed, tolerance)?
                .into_iter()
                .max()
                .map(|last| last + 1),
            None => None,
        };
        let time = start.elapsed();
        let more = (1..draws).into_par_iter();
        let more = more.map(|draw| Ok(is_solvable(smallest(graph, seed, draw)?, tolerance)));
        let mut verdicts = more.collect::<Result<Vec<_>, AuditError>>()?;
        verdicts.push(says);
        let right = Some(exact.value != Value::NotFiniteSolvable);
        let misjudged = verdicts.iter().filter(|&&says| says != right).count();
        Ok(Self {
            is_solvable: says,
            smallest: first,
            components,
            time,
            tolerance,
            draws: verdicts.len(),
            misjudged,
            agrees: misjudged == 0 && components == Some(exact.components.len()),
        })
    }
}

#[cfg(test)]
mod tests;
