//! Matrices whose rank is known by construction, for the tests of every elimination.

use crate::linalg::Ring;
use crate::linalg::matrix::Matrix;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A matrix of the given rank: a staircase with ones on its corners, moved by unimodular
/// row operations and then scrambled by permutations of rows and columns.
/// Entries stay small: what is added are multiples by -1, 0 or 1 of a few other rows;
/// the staircase's own entries lie in `-size..=size`.
///
/// # Panics
/// If the rank is larger than the number of rows or columns.
pub(in crate::linalg) fn known_rank<R: Ring>(
    ring: &R,
    rows: usize,
    cols: usize,
    rank: usize,
    seed: u64,
    size: u64,
) -> Matrix<R::Elem> {
    assert!(rank <= rows && rank <= cols);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut below = |bound: u64| rng.next_u64() % bound;
    let mut m = Matrix::from_fn(rows, cols, |i, j| {
        let value = if i >= rank || j < i {
            0
        } else if i == j {
            1
        } else {
            below(2 * size + 1) as i64 - size as i64
        };
        ring.from_i64(value)
    });
    for i in 0..if rank > 0 { rows } else { 0 } {
        for _ in 0..3 {
            // Rows of the staircase are added to later rows, and to one another.
            let k = below(rank as u64) as usize;
            if k != i {
                let source = m.row(k).to_vec();
                let sign = below(3);
                for (x, y) in m.row_mut(i).iter_mut().zip(&source) {
                    match sign {
                        0 => *x = ring.add(x, y),
                        1 => *x = ring.sub(x, y),
                        _ => {}
                    }
                }
            }
        }
    }
    let mut permutation = |n: usize| {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, below(k as u64 + 1) as usize);
        }
        order
    };
    let (row_order, col_order) = (permutation(rows), permutation(cols));
    m.submatrix(&row_order, &col_order)
}

/// `matrix * vector`
pub(in crate::linalg) fn multiply<R: Ring>(
    ring: &R,
    matrix: &Matrix<R::Elem>,
    vector: &[R::Elem],
) -> Vec<R::Elem> {
    let dot = |row: &[R::Elem]| {
        let terms = row.iter().zip(vector).map(|(a, x)| ring.mul(a, x));
        terms.fold(ring.zero(), |sum, term| ring.add(&sum, &term))
    };
    (0..matrix.rows()).map(|i| dot(matrix.row(i))).collect()
}
