//! Matrices of doubles: singular values, and a Cholesky factor in the envelope of a symmetric matrix.
//!
//! Singular values come from inverse iteration, and on its subspace from rotations of the columns until these are
//! orthogonal (Hestenes 1958).

use super::AuditError;
use rand::{Rng, SeedableRng};
use rayon::prelude::*;
use std::collections::VecDeque;
use std::ops::{AddAssign, Mul};
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::{Adjacency, Graph};
use viewcert::linalg::Ring;

/// A matrix by its columns.
pub type Columns = Vec<Vec<f64>>;

/// Sweeps over all pairs of columns, at most: ten are many.
const SWEEPS: usize = 60;
/// Vectors more than are asked for, for convergence.
const GUARD: usize = 4;
/// Most inverse iterations.
const ITERATIONS: usize = 100;

/// The operations of IEEE 754 doubles in the place of a ring, so that the audit rounds the very formulas that the exact
/// side computes. Nothing exact may be concluded from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doubles;

impl Ring for Doubles {
    type Elem = f64;

    fn zero(&self) -> f64 {
        0.0
    }
    fn one(&self) -> f64 {
        1.0
    }
    /// Rounded to 53 bits.
    fn from_i64(&self, value: i64) -> f64 {
        value as f64
    }
    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }
    fn sub(&self, a: &f64, b: &f64) -> f64 {
        a - b
    }
    fn mul(&self, a: &f64, b: &f64) -> f64 {
        a * b
    }
    fn neg(&self, a: &f64) -> f64 {
        -a
    }
    fn is_zero(&self, a: &f64) -> bool {
        *a == 0.0
    }
}

/// The scalar product of two vectors, in eight sums side by side.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, left), (b, right)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let rest: f64 = left.iter().zip(right).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        (0..8).for_each(|k| sums[k] += a[k] * b[k]);
    }
    sums.iter().sum::<f64>() + rest
}

/// Adds a multiple of `b` to `a`.
pub fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += factor * y;
    }
}

/// Rotates pairs of columns until all are orthogonal, and `vectors` alike; the lengths then, rising, with the vectors in
/// the same order. Columns no longer than rounding leaves of zero stay as they are.
pub(crate) fn singular(
    mut columns: Columns,
    mut vectors: Columns,
) -> Result<(Vec<f64>, Columns), AuditError> {
    let rounding = 4.0 * f64::EPSILON * (columns[0].len() as f64).sqrt();
    let noise = rounding * columns.iter().map(|x| dot(x, x)).fold(0.0, f64::max).sqrt();
    for _ in 0..SWEEPS {
        let mut is_done = true;
        for (p, q) in (0..columns.len()).flat_map(|q| (0..q).map(move |p| (p, q))) {
            let [a, b, c] = [(p, p), (q, q), (p, q)].map(|(k, l)| dot(&columns[k], &columns[l]));
            if c.abs() <= rounding * (a * b).sqrt() || a.min(b) <= noise * noise {
                continue;
            }
            is_done = false;
            let zeta = (b - a) / (2.0 * c);
            let tan = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let (cos, sin) = (1.0 / tan.hypot(1.0), tan / tan.hypot(1.0));
            for both in [&mut columns, &mut vectors] {
                let (head, tail) = both.split_at_mut(q);
                for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
                    (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
                }
            }
        }
        if is_done {
            let values = columns.iter().map(|x| dot(x, x).sqrt());
            let mut found: Vec<(f64, Vec<f64>)> = values.zip(vectors).collect();
            found.sort_by(|a, b| a.0.total_cmp(&b.0));
            return Ok(found.into_iter().unzip());
        }
    }
    Err(AuditError::NoConvergence)
}

/// The place of each node in an order in which neighbours stand near each other (Cuthill and McKee 1969, reversed).
pub(crate) fn envelope_order(graph: &Graph) -> Vec<usize> {
    let (n, adjacency) = (graph.nodes(), Adjacency::new(graph));
    let mut by_degree: Vec<u32> = (0..n as u32).collect();
    by_degree.sort_by_key(|&v| adjacency.degree(v));
    let (mut place, mut seen, mut left) = (vec![0; n], vec![false; n], n);
    for start in by_degree {
        let mut queue = VecDeque::from([start]);
        while let Some(v) = queue.pop_front() {
            if !std::mem::replace(&mut seen[v as usize], true) {
                left -= 1;
                place[v as usize] = left;
                let mut next = adjacency.neighbours(v).to_vec();
                next.sort_by_key(|&w| adjacency.degree(w));
                queue.extend(next);
            }
        }
    }
    place
}

/// Puts the columns of each node, so many, where [`envelope_order`] has it.
pub(crate) fn reordered<T>(rows: &mut SparseRows<T>, width: usize, place: &[usize]) {
    for (column, _) in rows.iter_mut().flatten() {
        *column = width * place[*column / width] + *column % width;
    }
}

/// M^T M below and on its diagonal, for a sparse M: of each row the column of the first entry that is not zero, and all
/// from there on.
pub(crate) fn gram<T>(matrix: &[Vec<(usize, T)>], columns: usize) -> Vec<(usize, Vec<T>)>
where
    T: Copy + Default + AddAssign + Mul<Output = T>,
{
    let mut first: Vec<usize> = (0..columns).collect();
    for row in matrix {
        let least = row.iter().map(|&(at, _)| at).min().unwrap_or(0);
        for &(at, _) in row {
            first[at] = first[at].min(least);
        }
    }
    let empty = |(i, from)| (from, vec![T::default(); i + 1 - from]);
    let mut rows: Vec<_> = first.into_iter().enumerate().map(empty).collect();
    for row in matrix {
        for &(i, x) in row {
            let (from, sums) = &mut rows[i];
            for &(j, y) in row.iter().filter(|&&(j, _)| j <= i) {
                sums[j - *from] += x * y;
            }
        }
    }
    rows
}

/// A sparse matrix M, with the Cholesky factor of M^T M + shift. The shift is as small as the factor allows. Values are
/// taken from M itself: M^T M hides what is below eps |M|^2.
pub struct Inverse<'a> {
    matrix: &'a SparseRows<f64>,
    columns: usize,
    factor: Factor,
    /// Singular values below are zero up to rounding.
    floor: f64,
}

impl<'a> Inverse<'a> {
    /// O(N^3) for N columns, less what stands before the first entries of rows.
    ///
    /// # Errors
    /// M^T M cannot be factored at any shift, or values are not numbers.
    pub fn new(matrix: &'a SparseRows<f64>, columns: usize) -> Result<Self, AuditError> {
        let (factor, largest) = Factor::new(gram(matrix, columns))?;
        Ok(Self {
            matrix,
            columns,
            factor,
            floor: 1e-15 * largest.sqrt(),
        })
    }

    /// The `count` smallest singular values, rising, with orthonormal vectors, to a relative change of `settled`.
    ///
    /// # Errors
    /// No convergence.
    pub fn smallest(&self, count: usize, settled: f64) -> Result<(Vec<f64>, Columns), AuditError> {
        let size = (count + GUARD).min(self.columns);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut uniform = |_| (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        let mut vector = |_| (0..self.columns).map(&mut uniform).collect();
        let mut vectors: Columns = (0..size).map(&mut vector).collect();
        let mut values: Vec<f64> = vec![f64::INFINITY; size];
        for _ in 0..ITERATIONS {
            vectors.par_iter_mut().for_each(|x| self.factor.solve(x));
            orthonormal(&mut vectors);
            let image = |x: &Vec<f64>| {
                let times = |row: &Vec<(usize, f64)>| row.iter().map(|&(k, y)| y * x[k]).sum();
                self.matrix.iter().map(times).collect()
            };
            let (found, turned) = singular(vectors.iter().map(image).collect(), vectors)?;
            let mut changes = found.iter().zip(&values).take(count);
            let done = changes.all(|(x, old)| *x <= self.floor || (x - old).abs() <= settled * x);
            (values, vectors) = (found, turned);
            if done {
                break;
            }
        }
        values.truncate(count);
        Ok((values, vectors))
    }

    /// Orthonormal vectors with |M v|^2 at most `tolerance`.
    ///
    /// # Errors
    /// No convergence.
    pub fn null_space(&self, tolerance: f64) -> Result<Columns, AuditError> {
        let mut count = 8.min(self.columns);
        loop {
            // Only the side of the tolerance matters.
            let (values, mut vectors) = self.smallest(count, 1e-3)?;
            let small = values.iter().take_while(|&x| x * x <= tolerance).count();
            if small < count || count == self.columns {
                vectors.truncate(small);
                return Ok(vectors);
            }
            count = (2 * count).min(self.columns);
        }
    }
}

/// The Cholesky factor of a symmetric matrix with a shift, as small as the factor allows: of each row the entries from the
/// first that is not zero.
pub(crate) struct Factor(Vec<(usize, Vec<f64>)>);

impl Factor {
    /// The factor, and the largest entry of the diagonal. O(N^3) for N columns, less what stands before the first entries.
    ///
    /// # Errors
    /// There is none at any shift, or values are not numbers.
    pub(crate) fn new(matrix: Vec<(usize, Vec<f64>)>) -> Result<(Self, f64), AuditError> {
        let diagonal = matrix.iter().filter_map(|(_, row)| row.last());
        let largest = diagonal.fold(0.0, |most: f64, &x| if x <= most { most } else { x });
        if !largest.is_finite() {
            return Err(AuditError::NoConvergence);
        }
        let mut shifts = (-15..=-5).map(|k| largest * 10f64.powi(k));
        let factor = shifts.find_map(|shift| factored(matrix.clone(), shift));
        Ok((Self(factor.ok_or(AuditError::NoConvergence)?), largest))
    }

    /// Solves for a right-hand side, in its place.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        for (k, (from, row)) in self.0.iter().enumerate() {
            x[k] = (x[k] - dot(&row[..k - from], &x[*from..k])) / row[k - from];
        }
        for (k, (from, row)) in self.0.iter().enumerate().rev() {
            x[k] /= row[k - from];
            let (head, tail) = x.split_at_mut(k);
            add(&mut head[*from..], -tail[0], &row[..k - from]);
        }
    }
}

/// The Cholesky factor of a matrix with a shift; nothing if rounding leaves it not positive definite.
fn factored(mut rows: Vec<(usize, Vec<f64>)>, shift: f64) -> Option<Vec<(usize, Vec<f64>)>> {
    for k in 0..rows.len() {
        let (head, tail) = rows.split_at_mut(k + 1);
        let (first, pivot) = (head[k].0, &mut head[k].1);
        let last = k - first;
        pivot[last] = (pivot[last] + shift - dot(&pivot[..last], &pivot[..last])).sqrt();
        if pivot[last].is_nan() || pivot[last] <= 0.0 {
            return None;
        }
        tail.par_iter_mut()
            .with_min_len(64)
            .for_each(|(from, row)| {
                if *from <= k {
                    let both = first.max(*from);
                    let known = dot(&row[both - *from..k - *from], &pivot[both - first..last]);
                    row[k - *from] = (row[k - *from] - known) / pivot[last];
                }
            });
    }
    Some(rows)
}

/// Makes columns orthonormal, each with those before it, twice.
pub(crate) fn orthonormal(columns: &mut Columns) {
    for k in 0..columns.len() {
        let (head, tail) = columns.split_at_mut(k);
        for _ in 0..2 {
            for other in head.iter() {
                let factor = dot(other, &tail[0]);
                add(&mut tail[0], -factor, other);
            }
            let length = dot(&tail[0], &tail[0]).sqrt();
            tail[0].iter_mut().for_each(|x| *x /= length);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn unit(n: usize) -> Columns {
        let unit = |k| (0..n).map(|r| f64::from(u8::from(r == k))).collect();
        (0..n).map(unit).collect()
    }

    /// Singular values 1 and 5 of [[3, 2], [2, 3]]; a matrix of ones has rank 1, also if it is wide.
    #[test]
    fn by_hand() {
        let (values, _) = singular(vec![vec![3.0, 2.0], vec![2.0, 3.0]], unit(2)).unwrap();
        assert!((values[0] - 1.0).abs() < 1e-14 && (values[1] - 5.0).abs() < 1e-14);
        let (values, vectors) = singular(vec![vec![1.0; 2]; 3], unit(3)).unwrap();
        assert!((values[2] - 6f64.sqrt()).abs() < 1e-14 && values[1] < 1e-14);
        assert!(vectors[0].iter().sum::<f64>().abs() < 1e-14);
        let rank_one: SparseRows<f64> = vec![vec![(0, 1.0), (1, 2.0)]];
        assert!(factored(gram(&rank_one, 2), 0.0).is_none());
        assert!(Inverse::new(&vec![vec![(0, f64::NAN)]], 1).is_err());
    }

    proptest! {
        /// A V has orthogonal columns of the lengths that are said, V is orthogonal; inverse iteration finds the same, and
        /// solves A^T A + shift.
        #[test]
        fn decompositions(
            rows in proptest::collection::vec(proptest::collection::vec((any::<bool>(), -9.0f64..9.0), 8), 8..14),
        ) {
            let n = 8;
            let sparse: SparseRows<f64> = rows
                .iter()
                .map(|row| row.iter().enumerate().filter(|(_, x)| x.0).map(|(k, x)| (k, x.1)).collect())
                .collect();
            let column = |k| sparse.iter().map(|row| row.iter().filter(|x| x.0 == k).map(|x| x.1).sum()).collect();
            let matrix: Columns = (0..n).map(column).collect();
            let (values, vectors) = singular(matrix.clone(), unit(n)).unwrap();
            let near = |x: f64, y: f64| (x - y).abs() < 1e-10;
            let times = |v: &[f64]| {
                let mut image = vec![0.0; sparse.len()];
                (0..n).for_each(|k| add(&mut image, v[k], &matrix[k]));
                image
            };
            prop_assert!(values.is_sorted());
            for a in 0..n {
                for b in 0..n {
                    let one = f64::from(u8::from(a == b));
                    prop_assert!(near(dot(&vectors[a], &vectors[b]), one));
                    let expected = one * values[a] * values[b];
                    prop_assert!(near(dot(&times(&vectors[a]), &times(&vectors[b])), expected));
                }
            }
            prop_assume!(values[7] > 0.1);
            let inverse = Inverse::new(&sparse, n).unwrap();
            let (least, _) = inverse.smallest(1, 1e-10).unwrap();
            prop_assert!((least[0] - values[0]).abs() < 1e-6 * values[7], "{least:?} {values:?}");
            prop_assume!(values[0] > 0.1);
            let mut x: Vec<f64> = (0..n).map(|k| k as f64).collect();
            inverse.factor.solve(&mut x);
            let image = times(&x);
            for (k, column) in matrix.iter().enumerate() {
                prop_assert!((dot(column, &image) - k as f64).abs() < 1e-6);
            }
        }
    }
}
