//! The smallest singular values of J by shift-and-invert: subspace iteration with a sparse
//! Cholesky factor of J^T J + shift.
//!
//! The shift is as small as the factor allows, so that a singular J^T J can be factored at
//! all. Values are not taken from J^T J, whose rounding hides everything below
//! eps |J|^2, but from J itself: the singular values of J on the subspace.

use super::AuditError;
use super::jacobian::Jacobian;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Mat, Side};
use rand::{Rng, SeedableRng};

/// Vectors more than are asked for, for convergence.
const GUARD: usize = 4;

/// Most iterations.
const ITERATIONS: usize = 100;

/// Relative change at which a value has converged.
const SETTLED: f64 = 1e-10;

/// The same where only the side of a tolerance matters.
const ROUGHLY: f64 = 1e-3;

/// The smallest singular values, rising, with their vectors as columns.
#[derive(Debug)]
pub struct Spectrum {
    /// The values.
    pub values: Vec<f64>,
    /// Orthonormal vectors.
    pub vectors: Mat<f64>,
}

/// J^T J + shift, lower triangle.
fn shifted_gram(j: &Jacobian) -> (SparseColMat<usize, f64>, f64) {
    let graph = j.blocks.graph;
    let (diagonal, below) = j.gram();
    let columns = 12 * graph.nodes();
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    let mut largest = 0.0f64;
    let mut edge = 0;
    for (v, block) in diagonal.iter().enumerate() {
        let first = edge;
        while graph
            .edges()
            .get(edge)
            .is_some_and(|&(i, _)| i as usize == v)
        {
            edge += 1;
        }
        for k in 0..12 {
            largest = largest.max(block[k][k]);
            for (r, line) in block.iter().enumerate().skip(k) {
                rows.push(12 * v + r);
                values.push(line[k]);
            }
            for (e, block) in below.iter().enumerate().take(edge).skip(first) {
                let w = graph.edges()[e].1 as usize;
                for (r, line) in block.iter().enumerate() {
                    rows.push(12 * w + r);
                    values.push(line[k]);
                }
            }
            starts.push(rows.len());
        }
    }
    let pattern = SymbolicSparseColMat::new_checked(columns, columns, starts, None, rows);
    (SparseColMat::new(pattern, values), largest)
}

/// The `count` smallest singular values of J.
///
/// # Errors
/// If J^T J cannot be factored at any shift, or values are not numbers.
pub fn smallest(j: &Jacobian, count: usize) -> Result<Spectrum, AuditError> {
    Inverse::new(j)?.iterate(count, SETTLED)
}

/// J with the factor of J^T J + shift.
struct Inverse<'a> {
    j: &'a Jacobian<'a>,
    factor: Llt<usize, f64>,
    /// Singular values below are zero up to rounding.
    floor: f64,
}

impl<'a> Inverse<'a> {
    fn new(j: &'a Jacobian<'a>) -> Result<Self, AuditError> {
        let (mut gram, largest) = shifted_gram(j);
        let columns = gram.ncols();
        let failed = |error: &dyn std::fmt::Debug| AuditError::NoFactor(format!("{error:?}"));
        if !largest.is_finite() {
            return Err(AuditError::NoConvergence);
        }
        let symbolic =
            SymbolicLlt::try_new(gram.symbolic(), Side::Lower).map_err(|error| failed(&error))?;
        let starts: Vec<usize> = gram.symbolic().col_ptr()[..columns].to_vec();
        let mut shift = 1e-15 * largest;
        let mut added = 0.0;
        let factor = loop {
            for &at in &starts {
                gram.val_mut()[at] += shift - added;
            }
            added = shift;
            match Llt::try_new_with_symbolic(symbolic.clone(), gram.as_ref(), Side::Lower) {
                Ok(factor) => break factor,
                Err(error) if shift > 1e-6 * largest => return Err(failed(&error)),
                Err(_) => shift *= 10.0,
            }
        };
        Ok(Self {
            j,
            factor,
            floor: 1e-15 * largest.sqrt(),
        })
    }

    /// The `count` smallest singular values, to a relative change of `settled`.
    fn iterate(&self, count: usize, settled: f64) -> Result<Spectrum, AuditError> {
        let columns = self.j.size().1;
        let size = (count + GUARD).min(columns);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        let mut vectors = Mat::from_fn(columns, size, |_, _| uniform());
        let mut values: Vec<f64> = vec![f64::INFINITY; size];
        for _ in 0..ITERATIONS {
            self.factor.solve_in_place(vectors.as_mut());
            let basis = vectors.qr().compute_thin_Q();
            let image = self.j.times(&basis);
            let svd = image.thin_svd().map_err(|_| AuditError::NoConvergence)?;
            // Rising values: the last right singular vector first.
            let turn = Mat::from_fn(size, size, |r, c| svd.V()[(r, size - 1 - c)]);
            vectors = &basis * &turn;
            let found: Vec<f64> = (0..size)
                .map(|k| svd.S().column_vector()[size - 1 - k])
                .collect();
            if found.iter().any(|x| !x.is_finite()) {
                return Err(AuditError::NoConvergence);
            }
            let done = found
                .iter()
                .zip(&values)
                .take(count)
                .all(|(new, old)| *new <= self.floor || (new - old).abs() <= settled * new);
            values = found;
            if done {
                break;
            }
        }
        values.truncate(count);
        Ok(Spectrum { values, vectors })
    }
}

/// Orthonormal vectors with |J v|^2 at most `tolerance`, one a column.
///
/// # Errors
/// As for [`smallest`].
pub fn null_space(j: &Jacobian, tolerance: f64) -> Result<Mat<f64>, AuditError> {
    let columns = j.size().1;
    let inverse = Inverse::new(j)?;
    let mut count = 8.min(columns);
    loop {
        let spectrum = inverse.iterate(count, ROUGHLY)?;
        let small = spectrum
            .values
            .iter()
            .take_while(|&&x| x * x <= tolerance)
            .count();
        if small < count || count == columns {
            return Ok(Mat::from_fn(columns, small, |row, k| {
                spectrum.vectors[(row, k)]
            }));
        }
        count = (2 * count).min(columns);
    }
}
