//! The rank of a sparse matrix over each of the two fields.

use super::skew::SparseRows;
use crate::exact::Field;
use crate::exact::bareiss;
use crate::exact::dense::Matrix;
use crate::exact::integer::Integer;
use crate::exact::prime::PrimeField;
use crate::exact::rational::Rationals;
use crate::exact::sparse::Factorisation;

/// A field with an elimination of its own.
pub trait RankField: Field + 'static {
    /// The rank of a matrix with `cols` columns.
    fn rank(&self, rows: SparseRows<Self::Elem>, cols: usize) -> usize;
}

impl RankField for PrimeField {
    /// Sparse elimination with a dense end.
    fn rank(&self, rows: SparseRows<u64>, cols: usize) -> usize {
        Factorisation::new(self, rows, cols).rank()
    }
}

impl RankField for Rationals {
    /// Every row is multiplied to integers without a common divisor, then fraction-free
    /// elimination.
    fn rank(&self, rows: SparseRows<Self::Elem>, cols: usize) -> usize {
        let mut matrix = Matrix::from_fn(rows.len(), cols, |_, _| Integer::zero());
        for (i, row) in rows.iter().enumerate() {
            let denominator = row
                .iter()
                .fold(Integer::one(), |lcm, (_, x)| lcm.lcm(x.denominator()));
            let whole: Vec<Integer> = row
                .iter()
                .map(|(_, x)| x.numerator().mul(&denominator.div_exact(x.denominator())))
                .collect();
            let gcd = whole.iter().fold(Integer::zero(), |gcd, x| gcd.gcd(x));
            for ((col, _), x) in row.iter().zip(&whole) {
                matrix[(i, *col)] = x.div_exact(&gcd);
            }
        }
        bareiss::eliminate(matrix).pivots().rank()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Ring;
    use crate::exact::rational::Rational;

    #[test]
    fn fractions_and_residues() {
        // (1/2, 1/3) and (3/4, 1/2) are proportional, (1/2, 1/4) is not.
        let fraction = |a: i64, b: i64| Rational::new(a.into(), b.into()).unwrap();
        let row = |x, y| vec![(0, x), (1, y)];
        let first = row(fraction(1, 2), fraction(1, 3));
        let second = row(fraction(3, 4), fraction(1, 2));
        let third = row(fraction(1, 2), fraction(1, 4));
        assert_eq!(Rationals.rank(vec![first.clone(), second], 2), 1);
        assert_eq!(Rationals.rank(vec![first, third, vec![]], 2), 2);
        // det (1 3; 1 10) = 7.
        let f = PrimeField::new(7).unwrap();
        let row = |a, b| vec![(0, f.from_i64(a)), (1, f.from_i64(b))];
        assert_eq!(f.rank(vec![row(1, 3), row(1, 10)], 2), 1);
    }
}
