//! Rows in echelon form modulo a prime, grown row by row; it remembers which rows it holds.

use crate::linalg::prime::PrimeField;

/// Independent rows in echelon form.
#[derive(Clone, Debug, Default)]
pub(super) struct Echelon {
    /// Each row is one at its pivot, where the rows after it are zero.
    rows: Vec<Vec<u64>>,
    pivots: Vec<usize>,
}

impl Echelon {
    pub(super) fn rank(&self) -> usize {
        self.rows.len()
    }

    /// The columns of the pivots, in the order of their rows.
    pub(super) fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// Subtracts rows from a vector until it is zero at all pivots. O(rank * length).
    pub(super) fn reduce(&self, field: &PrimeField, vector: &mut [u64]) {
        for (row, &pivot) in self.rows.iter().zip(&self.pivots) {
            let factor = vector[pivot];
            if factor != 0 {
                field.axpy(&mut vector[pivot..], field.negate(factor), &row[pivot..]);
            }
        }
    }

    /// Adds a row; returns whether it was independent. O(rank * length).
    pub(super) fn insert(&mut self, field: &PrimeField, mut row: Vec<u64>) -> bool {
        self.take(field, &mut row)
    }

    /// The same, with a row that is empty afterwards if it was independent, and of no use if not.
    pub(super) fn take(&mut self, field: &PrimeField, row: &mut Vec<u64>) -> bool {
        self.reduce(field, row);
        let Some(pivot) = row.iter().position(|&x| x != 0) else {
            return false;
        };
        let Some(inverse) = field.inverse(row[pivot]) else {
            return false;
        };
        for x in &mut row[pivot..] {
            *x = field.times(*x, inverse);
        }
        self.rows.push(std::mem::take(row));
        self.pivots.push(pivot);
        true
    }

    /// A basis of the vectors x with `row . x = 0` for all rows, `columns` long, one vector for
    /// each column without pivot, in ascending order: one there, zero at the others.
    /// O(rank^2) a vector.
    pub(super) fn kernel(&self, field: &PrimeField, columns: usize) -> Vec<Vec<u64>> {
        let one = field.from_u64(1);
        let free = (0..columns).filter(|column| !self.pivots.contains(column));
        free.map(|column| {
            let mut vector = vec![0; columns];
            vector[column] = one;
            // A row is zero before its pivot and at the pivots of the rows before it, so
            // from the last row on everything that it meets is known.
            for (row, &pivot) in self.rows.iter().zip(&self.pivots).rev() {
                vector[pivot] = field.negate(field.dot(0, row, &vector));
            }
            vector
        })
        .collect()
    }
}

/// The vectors w with `sum w_k rows[k] = 0`, as a basis. `columns` is the length of the rows.
/// O(rows^2 * (rows + columns)).
pub(super) fn left_kernel(field: &PrimeField, rows: &[Vec<u64>], columns: usize) -> Vec<Vec<u64>> {
    let mut transposed = Echelon::default();
    for column in 0..columns {
        transposed.insert(field, rows.iter().map(|row| row[column]).collect());
    }
    transposed.kernel(field, rows.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: &[u64]| values.iter().map(|&x| f.from_u64(x)).collect::<Vec<_>>();
        let mut echelon = Echelon::default();
        assert!(echelon.insert(&f, v(&[0, 2, 1, 0])));
        assert!(echelon.insert(&f, v(&[1, 1, 1, 1])));
        assert!(!echelon.insert(&f, v(&[2, 6, 4, 2])));
        assert_eq!((echelon.rank(), echelon.pivots()), (2, &[1, 0][..]));
        // 2 y + z = 0 and x + y + z + t = 0: y = 3 z, x = 3 z - t.
        let kernel = echelon.kernel(&f, 4);
        assert_eq!(kernel, [v(&[3, 3, 1, 0]), v(&[6, 0, 0, 1])]);
    }

    #[test]
    fn left_kernel_by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: &[u64]| values.iter().map(|&x| f.from_u64(x)).collect::<Vec<_>>();
        // Twice the first less the third is the second.
        let rows = [v(&[1, 2]), v(&[2, 3]), v(&[0, 1])];
        assert_eq!(left_kernel(&f, &rows, 2), [v(&[5, 1, 1])]);
    }
}
