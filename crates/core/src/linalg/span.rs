//! Subspaces modulo a prime, grown vector by vector.

use crate::linalg::prime::PrimeField;
use crate::linalg::{Field, Ring};

/// A subspace of F_p^k, by a basis in echelon form.
#[derive(Clone, Debug, Default)]
pub struct Span {
    /// Each vector is one at its leader, where the vectors after it are zero.
    basis: Vec<(usize, Vec<u64>)>,
}

impl Span {
    /// The dimension.
    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// A basis.
    pub(crate) fn into_basis(self) -> Vec<Vec<u64>> {
        self.basis.into_iter().map(|(_, vector)| vector).collect()
    }

    fn reduce(&self, field: &PrimeField, vector: &[u64]) -> Vec<u64> {
        let mut rest = vector.to_vec();
        for (leader, b) in &self.basis {
            let factor = field.neg(&rest[*leader]);
            if factor != 0 {
                field.axpy(&mut rest, factor, b);
            }
        }
        rest
    }

    /// Whether a vector lies in the subspace. O(dimension * length).
    pub fn contains(&self, field: &PrimeField, vector: &[u64]) -> bool {
        self.reduce(field, vector).iter().all(|&x| x == 0)
    }

    /// Adds a vector; returns whether the dimension has grown. O(dimension * length).
    pub fn insert(&mut self, field: &PrimeField, vector: &[u64]) -> bool {
        let mut rest = self.reduce(field, vector);
        let Some(leader) = rest.iter().position(|&x| x != 0) else {
            return false;
        };
        if let Some(inverse) = field.inv(&rest[leader]) {
            for x in &mut rest {
                *x = field.mul(x, &inverse);
            }
        }
        self.basis.push((leader, rest));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        let f = PrimeField::new(7).unwrap();
        let v = |values: [i64; 3]| values.map(|x| f.from_i64(x));
        let mut span = Span::default();
        assert!(span.contains(&f, &v([0, 0, 0])));
        assert!(span.insert(&f, &v([2, 1, 0])));
        assert!(span.insert(&f, &v([1, 1, 1])));
        // Twice the second less the first is (0, 1, 2).
        assert!(!span.insert(&f, &v([0, 1, 2])));
        assert!(!span.contains(&f, &v([0, 0, 1])));
        assert_eq!(span.dimension(), 2);
    }
}
