//! Dense matrices of doubles: all singular values, and the least eigenvalue.
//!
//! Singular values come from rotations of the columns until these are orthogonal (Hestenes 1958), the least eigenvalue
//! from a tridiagonal form and bisection (Golub and Van Loan, *Matrix Computations*, sections 8.3, 8.4, 8.6).

use rayon::prelude::*;
use viewcert_audit::AuditError;
pub use viewcert_audit::linear::Columns;
use viewcert_audit::linear::{add, dot};

/// Sweeps over all pairs of columns, at most: ten are many.
const SWEEPS: usize = 60;

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// The vector v of the reflection I - v v^T that takes a vector to (alpha, 0, ...), and alpha.
fn reflection(x: &[f64]) -> (Vec<f64>, f64) {
    let length = norm(x);
    let alpha = if x[0] > 0.0 { -length } else { length };
    let mut v = x.to_vec();
    v[0] -= alpha;
    let size = (length * (length + x[0].abs())).sqrt();
    if size > 0.0 {
        v.iter_mut().for_each(|y| *y /= size);
    }
    (v, alpha)
}

/// The triangle of a QR decomposition, whose columns have the same singular values and right singular vectors; the
/// matrix itself if it has no more rows than columns.
fn triangle(mut matrix: Columns) -> Columns {
    let n = matrix.len();
    if matrix.first().is_none_or(|column| column.len() <= n) {
        return matrix;
    }
    for k in 0..n {
        let (head, tail) = matrix.split_at_mut(k + 1);
        let (v, alpha) = reflection(&head[k][k..]);
        head[k][k] = alpha;
        head[k].truncate(n);
        head[k][k + 1..].fill(0.0);
        tail.par_iter_mut().with_min_len(16).for_each(|column| {
            let factor = dot(&v, &column[k..]);
            add(&mut column[k..], -factor, &v);
        });
    }
    matrix
}

/// Rotates two columns until they are orthogonal, and those of `vectors` alike; whether they were not yet. Columns no
/// longer than `noise` are what rounding leaves of zero.
fn rotate(
    matrix: &mut Columns,
    vectors: &mut Columns,
    (p, q): (usize, usize),
    (rounding, noise): (f64, f64),
) -> bool {
    let turn = |columns: &mut Columns, cos: f64, sin: f64| {
        let (head, tail) = columns.split_at_mut(q);
        for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
            (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
        }
    };
    let (a, b) = (dot(&matrix[p], &matrix[p]), dot(&matrix[q], &matrix[q]));
    let c = dot(&matrix[p], &matrix[q]);
    if c.abs() <= rounding * (a * b).sqrt() || a.min(b) <= noise * noise {
        return false;
    }
    let zeta = (b - a) / (2.0 * c);
    let tan = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
    let cos = 1.0 / tan.hypot(1.0);
    turn(matrix, cos, cos * tan);
    if !vectors.is_empty() {
        turn(vectors, cos, cos * tan);
    }
    true
}

/// The singular values, one a column, falling; with `vectors` the right singular vectors, in the same order.
///
/// # Errors
/// No convergence, or an entry that is not a number.
pub fn singular(matrix: Columns, with_vectors: bool) -> Result<(Vec<f64>, Columns), AuditError> {
    if !matrix.iter().flatten().all(|x| x.is_finite()) {
        return Err(AuditError::NoConvergence);
    }
    let (n, mut matrix) = (matrix.len(), triangle(matrix));
    let mut vectors = match with_vectors {
        true => identity(n),
        false => Vec::new(),
    };
    let rows = matrix.iter().map(Vec::len).max().unwrap_or(0);
    let rounding = 4.0 * f64::EPSILON * (rows as f64).sqrt();
    let noise = rounding * matrix.iter().map(|column| norm(column)).fold(0.0, f64::max);
    let mut sweeps = 0;
    while (0..n).rev().fold(false, |moved, q| {
        (0..q).fold(moved, |moved, p| {
            rotate(&mut matrix, &mut vectors, (p, q), (rounding, noise)) | moved
        })
    }) {
        sweeps += 1;
        if sweeps == SWEEPS {
            return Err(AuditError::NoConvergence);
        }
    }
    let values: Vec<f64> = matrix.iter().map(|column| norm(column)).collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    let mut take = |k: usize| std::mem::take(&mut vectors[k]);
    let sorted = match with_vectors {
        true => order.iter().map(|&k| take(k)).collect(),
        false => Vec::new(),
    };
    Ok((order.iter().map(|&k| values[k]).collect(), sorted))
}

/// The identity matrix.
fn identity(n: usize) -> Columns {
    let unit = |k| (0..n).map(|r| f64::from(u8::from(r == k))).collect();
    (0..n).map(unit).collect()
}

/// The smallest eigenvalue of a symmetric matrix.
///
/// # Errors
/// An entry that is not a number.
pub fn least_eigenvalue(mut matrix: Columns) -> Result<f64, AuditError> {
    if !matrix.iter().flatten().all(|x| x.is_finite()) {
        return Err(AuditError::NoConvergence);
    }
    let n = matrix.len();
    let mut beside = Vec::with_capacity(n);
    for k in 0..n.saturating_sub(1) {
        let (v, alpha) = reflection(&matrix[k][k + 1..]);
        beside.push(alpha);
        let mut w: Vec<f64> = matrix[k + 1..]
            .iter()
            .map(|column| dot(&v, &column[k + 1..]))
            .collect();
        let half = dot(&v, &w) / 2.0;
        add(&mut w, -half, &v);
        let rest = matrix[k + 1..].par_iter_mut().with_min_len(16);
        rest.enumerate().for_each(|(c, column)| {
            add(&mut column[k + 1..], -w[c], &v);
            add(&mut column[k + 1..], -v[c], &w);
        });
    }
    // How many eigenvalues of the tridiagonal matrix are below x, by the signs of its pivots.
    let below = |x: f64| {
        let mut pivot = 1.0;
        let signs = (0..n).filter(|&k| {
            let left: f64 = if k == 0 { 0.0 } else { beside[k - 1] };
            pivot = matrix[k][k] - x - left * left / pivot;
            if pivot == 0.0 {
                pivot = f64::MIN_POSITIVE;
            }
            pivot < 0.0
        });
        signs.count()
    };
    let around = |k: usize| beside.get(k).map_or(0.0, |x: &f64| x.abs());
    let radius = (0..n).map(|k| matrix[k][k].abs() + around(k) + around(k.wrapping_sub(1)));
    let mut most = radius.fold(f64::MIN_POSITIVE, f64::max);
    let mut least = -most;
    loop {
        let middle = least + (most - least) / 2.0;
        if middle <= least || middle >= most {
            return Ok(middle);
        }
        match below(middle) {
            0 => least = middle,
            _ => most = middle,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Singular values 5 and 1 of [[3, 2], [2, 3]]; a matrix of ones has rank 1, also if it is wide.
    #[test]
    fn by_hand() {
        let (values, _) = singular(vec![vec![3.0, 2.0], vec![2.0, 3.0]], false).unwrap();
        assert!((values[0] - 5.0).abs() < 1e-14 && (values[1] - 1.0).abs() < 1e-14);
        let (values, vectors) = singular(vec![vec![1.0; 2]; 3], true).unwrap();
        assert!((values[0] - 6f64.sqrt()).abs() < 1e-14 && values[1] < 1e-14);
        assert!(vectors[2].iter().sum::<f64>().abs() < 1e-14);
        // Columns in one dimension are never orthogonal.
        let (values, _) = singular(vec![vec![-5.25], vec![0.7], vec![0.3]], true).unwrap();
        assert!(values[0] > 5.25 && values[1] < 1e-14);
        let least = least_eigenvalue(vec![vec![0.0, 1.0], vec![1.0, 0.0]]).unwrap();
        assert!((least + 1.0).abs() < 1e-15);
        assert!(singular(vec![vec![f64::NAN]], false).is_err());
        assert!(least_eigenvalue(vec![vec![f64::INFINITY]]).is_err());
    }

    proptest! {
        /// A V has orthogonal columns of the lengths that are said, V is orthogonal; the least eigenvalue of A^T A
        /// is the least square.
        #[test]
        fn decompositions(
            matrix in (1usize..14, 1usize..14).prop_flat_map(|(rows, columns)| {
                proptest::collection::vec(proptest::collection::vec(-9.0f64..9.0, rows), columns)
            }),
        ) {
            let (n, rows) = (matrix.len(), matrix[0].len());
            let (values, vectors) = singular(matrix.clone(), true).unwrap();
            let near = |x: f64, y: f64| (x - y).abs() < 1e-10;
            let times = |v: &[f64]| {
                let mut image = vec![0.0; rows];
                (0..n).for_each(|k| add(&mut image, v[k], &matrix[k]));
                image
            };
            prop_assert!(values.is_sorted_by(|a, b| a >= b));
            for a in 0..n {
                for b in 0..n {
                    let one = f64::from(u8::from(a == b));
                    prop_assert!(near(dot(&vectors[a], &vectors[b]), one));
                    let expected = one * values[a] * values[b];
                    prop_assert!(near(dot(&times(&vectors[a]), &times(&vectors[b])), expected));
                }
            }
            let gram: Columns = matrix.iter().map(|a| matrix.iter().map(|b| dot(a, b)).collect()).collect();
            prop_assert!(near(least_eigenvalue(gram).unwrap(), values[n - 1].powi(2)));
        }
    }
}
