//! Textbook elimination over any field: the reference for every faster method.

use crate::linalg::Field;
use crate::linalg::matrix::Matrix;

/// Rows and columns of a minor that is not zero; their number is the rank.
///
/// `rows[k]` and `cols[k]` belong to the k-th pivot and refer to the matrix as it was
/// given. For every k the minor on the first k rows and columns is not zero either.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Pivots {
    /// Rows, in pivot order.
    pub rows: Vec<usize>,
    /// Columns, in pivot order.
    pub cols: Vec<usize>,
}

impl Pivots {
    /// The number of pivots.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// The other columns of a matrix with `cols` columns, ascending.
    pub fn free_cols(&self, cols: usize) -> Vec<usize> {
        complement(&self.cols, cols)
    }

    /// The other rows of a matrix with `rows` rows, ascending.
    pub fn free_rows(&self, rows: usize) -> Vec<usize> {
        complement(&self.rows, rows)
    }
}

fn complement(members: &[usize], size: usize) -> Vec<usize> {
    let mut free = vec![true; size];
    for &member in members {
        free[member] = false;
    }
    (0..size).filter(|&k| free[k]).collect()
}

/// The pivots of a matrix: column by column the first row with a non-zero entry.
/// Columns come out ascending, and are those independent of the columns to their left.
/// O(rows * cols * rank) field operations.
pub fn eliminate<F: Field>(field: &F, matrix: &Matrix<F::Elem>) -> Pivots {
    reduce(field, matrix.clone()).1
}

/// A basis of the right kernel, one vector for each column that is not a pivot, in
/// ascending order; the vector is one at its own column and zero at the others.
pub fn kernel<F: Field>(field: &F, matrix: &Matrix<F::Elem>) -> Vec<Vec<F::Elem>> {
    let (reduced, pivots) = reduce(field, matrix.clone());
    let vector = |free: usize| {
        let mut vector = vec![field.zero(); matrix.cols()];
        vector[free] = field.one();
        for (k, &col) in pivots.cols.iter().enumerate() {
            vector[col] = field.neg(&reduced[(k, free)]);
        }
        vector
    };
    pivots
        .free_cols(matrix.cols())
        .into_iter()
        .map(vector)
        .collect()
}

/// The reduced row echelon form and the pivots.
fn reduce<F: Field>(field: &F, mut m: Matrix<F::Elem>) -> (Matrix<F::Elem>, Pivots) {
    let mut order: Vec<usize> = (0..m.rows()).collect();
    let mut pivots = Pivots::default();
    for col in 0..m.cols() {
        let rank = pivots.rank();
        let Some((row, inverse)) =
            (rank..m.rows()).find_map(|row| field.inv(&m[(row, col)]).map(|inv| (row, inv)))
        else {
            continue;
        };
        m.swap_rows(rank, row);
        order.swap(rank, row);
        for entry in m.row_mut(rank) {
            *entry = field.mul(entry, &inverse);
        }
        let pivot_row = m.row(rank).to_vec();
        for row in (0..m.rows()).filter(|&row| row != rank) {
            let factor = m[(row, col)].clone();
            if !field.is_zero(&factor) {
                for (entry, pivot) in m.row_mut(row).iter_mut().zip(&pivot_row).skip(col) {
                    *entry = field.sub(entry, &field.mul(&factor, pivot));
                }
            }
        }
        pivots.rows.push(order[rank]);
        pivots.cols.push(col);
    }
    (m, pivots)
}

#[cfg(test)]
mod tests {
    use super::super::Ring;
    use super::super::prime::PrimeField;
    use super::super::rational::Rationals;
    use super::*;

    #[test]
    fn by_hand() {
        // Row 1 is twice row 0; x = (-2, 1, 0) and (1, 0, -1) span the kernel.
        let rows = [[1, 2, 1], [2, 4, 2], [0, 0, 0]];
        let m = Matrix::from_fn(3, 3, |i, j| Rationals.from_i64(rows[i][j]));
        let pivots = eliminate(&Rationals, &m);
        assert_eq!(
            pivots,
            Pivots {
                rows: vec![0],
                cols: vec![0]
            }
        );
        let basis = kernel(&Rationals, &m);
        let expected = [[-2, 1, 0], [-1, 0, 1]].map(|v| v.map(|x| Rationals.from_i64(x)).to_vec());
        assert_eq!(basis, expected);
    }

    #[test]
    fn rank_depends_on_the_field() {
        // det = 1*10 - 3*1 = 7.
        let rows = [[1, 3], [1, 10]];
        let f = PrimeField::new(7).unwrap();
        let modular = Matrix::from_fn(2, 2, |i, j| f.from_i64(rows[i][j]));
        let rational = Matrix::from_fn(2, 2, |i, j| Rationals.from_i64(rows[i][j]));
        assert_eq!(eliminate(&f, &modular).rank(), 1);
        assert_eq!(eliminate(&Rationals, &rational).rank(), 2);
    }
}
