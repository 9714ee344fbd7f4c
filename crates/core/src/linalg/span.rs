//! Subspaces modulo a prime, grown vector by vector.

use crate::linalg::prime::PrimeField;

/// A subspace of F_p^k, by a basis in echelon form; it remembers which vectors it holds.
#[derive(Clone, Debug, Default)]
pub struct Span {
    /// Each vector is one at its pivot, where the vectors after it are zero.
    basis: Vec<Vec<u64>>,
    pivots: Vec<usize>,
}

impl Span {
    pub(crate) fn dimension(&self) -> usize {
        self.basis.len()
    }

    pub(crate) fn into_basis(self) -> Vec<Vec<u64>> {
        self.basis
    }

    /// The columns of the pivots, in the order in which their vectors came.
    pub fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// Subtracts vectors of the basis until a vector is zero at all pivots. O(dimension * length).
    pub(crate) fn reduce(&self, field: &PrimeField, vector: &mut [u64]) {
        for (b, &pivot) in self.basis.iter().zip(&self.pivots) {
            let factor = vector[pivot];
            if factor != 0 {
                field.axpy(&mut vector[pivot..], field.negate(factor), &b[pivot..]);
            }
        }
    }

    /// Whether a vector lies in the subspace. O(dimension * length).
    pub(crate) fn contains(&self, field: &PrimeField, vector: &[u64]) -> bool {
        let mut rest = vector.to_vec();
        self.reduce(field, &mut rest);
        rest.iter().all(|&x| x == 0)
    }

    /// Adds a vector; returns whether the dimension has grown. O(dimension * length).
    pub fn insert(&mut self, field: &PrimeField, mut vector: Vec<u64>) -> bool {
        self.take(field, &mut vector)
    }

    /// The same, with a vector that is empty afterwards if the dimension has grown, and of no use
    /// if not.
    pub(crate) fn take(&mut self, field: &PrimeField, vector: &mut Vec<u64>) -> bool {
        self.reduce(field, vector);
        let Some(pivot) = vector.iter().position(|&x| x != 0) else {
            return false;
        };
        let Some(inverse) = field.inverse(vector[pivot]) else {
            return false;
        };
        for x in &mut vector[pivot..] {
            *x = field.times(*x, inverse);
        }
        self.basis.push(std::mem::take(vector));
        self.pivots.push(pivot);
        true
    }

    /// A basis of the vectors x with `b . x = 0` for all vectors b of the subspace, `columns` long,
    /// one vector for each column without pivot, in ascending order: one there, zero at the others.
    /// O(dimension^2) a vector.
    pub(crate) fn kernel(&self, field: &PrimeField, columns: usize) -> Vec<Vec<u64>> {
        let one = field.from_u64(1);
        let free = (0..columns).filter(|column| !self.pivots.contains(column));
        free.map(|column| {
            let mut vector = vec![0; columns];
            vector[column] = one;
            // A vector of the basis is zero before its pivot and at the pivots of those before it,
            // so from the last one on everything that it meets is known.
            for (b, &pivot) in self.basis.iter().zip(&self.pivots).rev() {
                vector[pivot] = field.negate(field.dot(0, b, &vector));
            }
            vector
        })
        .collect()
    }
}

/// The vectors w with `sum w_k rows[k] = 0`, as a basis. `columns` is the length of the rows.
/// O(rows^2 * (rows + columns)).
pub(crate) fn left_kernel(field: &PrimeField, rows: &[Vec<u64>], columns: usize) -> Vec<Vec<u64>> {
    let mut transposed = Span::default();
    for column in 0..columns {
        transposed.insert(field, rows.iter().map(|row| row[column]).collect());
    }
    transposed.kernel(field, rows.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residues(field: &PrimeField, values: &[i64]) -> Vec<u64> {
        use crate::linalg::Ring;
        values.iter().map(|&x| field.from_i64(x)).collect()
    }

    #[test]
    fn by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: &[i64]| residues(&f, values);
        let mut span = Span::default();
        assert!(span.contains(&f, &v(&[0, 0, 0])));
        assert!(span.insert(&f, v(&[2, 1, 0])));
        assert!(span.insert(&f, v(&[1, 1, 1])));
        // Twice the second less the first is (0, 1, 2).
        assert!(!span.insert(&f, v(&[0, 1, 2])));
        assert!(!span.contains(&f, &v(&[0, 0, 1])));
        assert_eq!(span.dimension(), 2);
    }

    #[test]
    fn kernel_by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: &[i64]| residues(&f, values);
        let mut span = Span::default();
        assert!(span.insert(&f, v(&[0, 2, 1, 0])));
        assert!(span.insert(&f, v(&[1, 1, 1, 1])));
        assert!(!span.insert(&f, v(&[2, 6, 4, 2])));
        assert_eq!(span.pivots(), [1, 0]);
        // 2 y + z = 0 and x + y + z + t = 0: y = 3 z, x = 3 z - t.
        let kernel = span.kernel(&f, 4);
        assert_eq!(kernel, [v(&[3, 3, 1, 0]), v(&[6, 0, 0, 1])]);
    }

    #[test]
    fn left_kernel_by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: &[i64]| residues(&f, values);
        // Twice the first less the third is the second.
        let rows = [v(&[1, 2]), v(&[2, 3]), v(&[0, 1])];
        assert_eq!(left_kernel(&f, &rows, 2), [v(&[5, 1, 1])]);
    }
}
