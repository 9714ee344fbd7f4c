//! Fraction-free elimination of integer matrices (Bareiss, Math. Comp. 22, 1968).
//!
//! Every intermediate entry is a minor of the matrix, so that each division is exact
//! and no entry is longer than Hadamard's bound.

use crate::linalg::integer::{Integer, One, Signed, Zero, content};
use crate::linalg::matrix::Matrix;
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Task};

/// An integer matrix, eliminated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FractionFree {
    pivots: Pivots,
    determinant: Integer,
    cols: usize,
    /// Row k from the pivot of row k on, entry `(k, j)` being the minor with rows
    /// `rows[0..=k]` and columns `cols[0..k], j`.
    upper: Vec<Vec<Integer>>,
}

/// Eliminates column by column. Of the entries that may be the pivot of a column the
/// smallest in absolute value is taken, the topmost row among equals: short pivots keep
/// the minors short, and the choice depends on nothing but the matrix.
///
/// O(rows * cols * rank) multiplications and exact divisions of integers of up to
/// `rank` times the length of an entry.
///
/// # Errors
/// If the task was stopped.
pub fn eliminate(mut m: Matrix<Integer>, task: &Task) -> Result<FractionFree, Stopped> {
    let cols = m.cols();
    let work = task.begin(cols as u64);
    let mut rest: Vec<usize> = (0..m.rows()).collect();
    let mut pivots = Pivots::default();
    let mut upper = Vec::new();
    let mut previous = Integer::one();
    for col in 0..cols {
        work.done(1)?;
        let candidates = rest
            .iter()
            .enumerate()
            .filter(|&(_, &row)| !m[(row, col)].is_zero());
        let smallest = candidates
            .min_by(|&(_, &a), &(_, &b)| m[(a, col)].magnitude().cmp(m[(b, col)].magnitude()));
        let Some((position, _)) = smallest else {
            continue;
        };
        // `remove` keeps the others in order, so that `min_by` finds the topmost.
        let pivot_row = rest.remove(position);
        let top = m.row(pivot_row).to_vec();
        let pivot = &top[col];
        for &row in &rest {
            task.check()?;
            let row = m.row_mut(row);
            let factor = row[col].clone();
            row[col] = Integer::zero();
            for (entry, above) in row.iter_mut().zip(&top).skip(col + 1) {
                if entry.is_zero() && (factor.is_zero() || above.is_zero()) {
                    continue;
                }
                *entry *= pivot;
                if !factor.is_zero() && !above.is_zero() {
                    *entry -= &factor * above;
                }
                *entry /= &previous;
            }
        }
        pivots.rows.push(pivot_row);
        pivots.cols.push(col);
        previous = pivot.clone();
        upper.push(top);
    }
    Ok(FractionFree {
        pivots,
        determinant: previous,
        cols,
        upper,
    })
}

impl FractionFree {
    /// The pivots; their number is the rank over Q.
    pub fn pivots(&self) -> &Pivots {
        &self.pivots
    }

    /// The determinant of the submatrix whose entry `(k, l)` is the entry of the matrix
    /// in row `pivots.rows[k]` and column `pivots.cols[l]`: rows and columns stand in
    /// the order in which the pivots list them. Never zero; 1 for rank 0.
    pub fn determinant(&self) -> &Integer {
        &self.determinant
    }

    /// A basis of the right kernel over Q, one vector for each column that is not a
    /// pivot, ascending: integers without a common divisor, positive at that column and
    /// zero at the other free columns. O(rank^2) multiplications a vector.
    pub fn kernel(&self) -> Vec<Vec<Integer>> {
        let free = self.pivots.free_cols(self.cols);
        free.into_iter()
            .map(|col| self.kernel_vector(col))
            .collect()
    }

    fn kernel_vector(&self, free: usize) -> Vec<Integer> {
        let mut vector = vec![Integer::zero(); self.cols];
        // By Cramer's rule the solution times the determinant is an integer vector.
        vector[free] = self.determinant.clone();
        for (row, &col) in self.upper.iter().zip(&self.pivots.cols).rev() {
            let mut sum = Integer::zero();
            for (entry, x) in row.iter().zip(&vector).skip(col + 1) {
                if !entry.is_zero() && !x.is_zero() {
                    sum -= entry * x;
                }
            }
            vector[col] = sum / &row[col];
        }
        primitive(&mut vector, free);
        vector
    }
}

/// Divides a vector by the greatest common divisor of its entries, with the sign that
/// makes the entry at `leader`, which is not zero, positive.
pub(crate) fn primitive(vector: &mut [Integer], leader: usize) {
    let mut gcd = content(vector.iter());
    if vector[leader].is_negative() {
        gcd = -gcd;
    }
    for x in vector {
        *x /= &gcd;
    }
}

#[cfg(test)]
mod tests {
    use super::super::prime::PrimeField;
    use super::super::rational::{Rational, Rationals};
    use super::super::tests::samples::{known_rank, multiply};
    use super::super::{Ring, integer::Integers, textbook};
    use super::*;
    use crate::watch::unwatched;
    use proptest::prelude::*;

    fn whole(m: Matrix<Integer>) -> FractionFree {
        unwatched(|task| eliminate(m, task))
    }

    fn integers(rows: &[&[i64]]) -> Matrix<Integer> {
        Matrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j].into())
    }

    #[test]
    fn by_hand() {
        // The smallest entry of column 0 is the 1 in row 1; column 1 repeats column 0.
        // Rows 1, 0 and columns 0, 2 in this order: 1 * 5 - 4 * 2 = -3.
        let done = whole(integers(&[&[2, 2, 5], &[1, 1, 4], &[3, 3, 9]]));
        assert_eq!(
            done.pivots(),
            &Pivots {
                rows: vec![1, 0],
                cols: vec![0, 2]
            }
        );
        assert_eq!(done.determinant(), &Integer::from(-3i64));
        assert_eq!(done.kernel(), [[-1i64, 1, 0].map(Integer::from).to_vec()]);
    }

    #[test]
    fn extremes() {
        let zero = whole(integers(&[&[0, 0]]));
        assert_eq!(
            (zero.pivots().rank(), zero.determinant()),
            (0, &Integer::one())
        );
        assert_eq!(zero.kernel().len(), 2);
        assert_eq!(whole(Matrix::new(0, 3, vec![])).kernel().len(), 3);
        assert!(whole(Matrix::new(3, 0, vec![])).kernel().is_empty());
        // A Hilbert-like matrix: entry (i, j) = 60 / (i + j + 1); determinant of the
        // 3 x 3 Hilbert matrix is 1 / 2160.
        let hilbert = Matrix::from_fn(3, 3, |i, j| Integer::from(60 / (i + j + 1) as i64));
        let done = whole(hilbert);
        assert_eq!(done.determinant().abs(), Integer::from(100i64));
    }

    proptest! {
        #[test]
        fn rank_determinant_and_kernel(
            rank in 0..5usize, more_rows in 0..4usize, more_cols in 0..4usize, seed: u64,
        ) {
            let (rows, cols) = (rank + more_rows, rank + more_cols);
            let m = known_rank(&Integers, rows, cols, rank, seed, 9);
            let done = whole(m.clone());
            prop_assert_eq!(done.pivots().rank(), rank);

            let rational = m.map(|x| Rational::from(x.clone()));
            let textbook = textbook::eliminate(&Rationals, &rational);
            prop_assert_eq!(&textbook.cols, &done.pivots().cols);

            // The determinant modulo a prime, by expansion along permutations.
            let f = PrimeField::mersenne61();
            let minor = m.submatrix(&done.pivots().rows, &done.pivots().cols);
            let minor = minor.map(|x| f.from_integer(x));
            let expected = expand(&f, &minor, &(0..rank).collect::<Vec<_>>());
            prop_assert_eq!(f.from_integer(done.determinant()), expected);

            let kernel = done.kernel();
            prop_assert_eq!(kernel.len(), cols - rank);
            for (v, free) in kernel.iter().zip(done.pivots().free_cols(cols)) {
                prop_assert!(multiply(&Integers, &m, v).iter().all(Integer::is_zero));
                prop_assert!(content(v).is_one());
                prop_assert!(v[free].is_positive());
            }
        }
    }

    /// Laplace expansion along the first row.
    fn expand(f: &PrimeField, m: &Matrix<u64>, cols: &[usize]) -> u64 {
        let row = m.rows() - cols.len();
        let mut sum = if cols.is_empty() { f.one() } else { 0 };
        for (k, &col) in cols.iter().enumerate() {
            let others: Vec<usize> = cols.iter().copied().filter(|&c| c != col).collect();
            let term = f.mul(&m[(row, col)], &expand(f, m, &others));
            sum = if k % 2 == 0 {
                f.add(&sum, &term)
            } else {
                f.sub(&sum, &term)
            };
        }
        sum
    }
}
