//! Small matrices modulo a prime: determinants, and left kernels of sparse ones.

use crate::algebra::{Field, Ring};
use crate::elimination::Echelon;
use crate::limits::Meter;
use crate::rejection::Checked;
use std::collections::BTreeMap;

/// What one entry of a row counts as.
pub(super) const ENTRY: u64 = 4;

/// A row by its entries, each with its column.
pub(super) type Sparse = Vec<(usize, u64)>;

/// The columns of a matrix, eliminated: what is orthogonal to them are the w with w M = 0, of which
/// there are as many independent ones as places without pivot.
pub(super) fn columns<'a>(
    field: &'a Field,
    meter: &'a Meter,
    rows: &[Sparse],
) -> Checked<Echelon<'a>> {
    let mut columns: BTreeMap<usize, Sparse> = BTreeMap::new();
    for (number, row) in rows.iter().enumerate() {
        for &(column, entry) in row {
            columns.entry(column).or_default().push((number, entry));
        }
    }
    Echelon::of(field, rows.len(), meter, columns.into_values())
}

pub(super) fn dot(field: &Field, x: &[u64], y: &[u64]) -> u64 {
    let terms = x.iter().zip(y);
    terms.fold(0, |sum, (&x, &y)| field.add(sum, field.mul(x, y)))
}

/// The determinant of a square matrix.
pub(super) fn determinant(field: &Field, mut rows: Vec<Vec<u64>>) -> u64 {
    let (mut product, mut divisor) = (field.one, field.one);
    for k in 0..rows.len() {
        let Some(at) = (k..rows.len()).find(|&row| rows[row][k] != 0) else {
            return 0;
        };
        if at != k {
            rows.swap(at, k);
            product = field.neg(product);
        }
        let (done, rest) = rows.split_at_mut(k + 1);
        let row = &done[k];
        product = field.mul(product, row[k]);
        // Without divisions, each row below becomes the pivot times as large.
        for other in rest {
            let factor = other[k];
            if factor != 0 {
                divisor = field.mul(divisor, row[k]);
                for (entry, &above) in other.iter_mut().zip(row).skip(k) {
                    *entry = field.sub(field.mul(*entry, row[k]), field.mul(factor, above));
                }
            }
        }
    }
    field.mul(product, field.inverse(divisor))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::Limits;

    #[test]
    fn by_hand() {
        let (field, meter) = (Field::new(7).unwrap(), Meter::new(&Limits::default()));
        let sparse = |values: &[u64]| -> Sparse {
            let values = values.iter().map(|&value| field.element(value));
            values.enumerate().collect()
        };
        let rows = [[0, 2, 1, 0], [1, 1, 1, 1], [2, 6, 4, 2]].map(|row| sparse(&row));
        let mut space = Echelon::of(&field, 4, &meter, rows.clone()).unwrap();
        assert_eq!((space.rank(), space.free()), (2, vec![2, 3]));
        // 2 y + z = 0 and x + y + z + t = 0: y = 3 z, x = 3 z - t.
        let elements = |values: [u64; 4]| values.map(|value| field.element(value)).to_vec();
        let kernel = [elements([3, 3, 1, 0]), elements([6, 0, 0, 1])];
        assert_eq!([2, 3].map(|free| space.orthogonal(free).unwrap()), kernel);
        assert!(space.annihilates(&kernel[0]).unwrap());
        assert!(!space.annihilates(&elements([3, 3, 2, 0])).unwrap());
        // (1, 1, 1, 3) less the second row is (0, 0, 0, 2).
        let rest = space.residue(sparse(&[1, 1, 1, 3])).unwrap();
        assert_eq!(rest, [(3, field.element(2))]);
        // Twice the first and twice the second are the third.
        let left = columns(&field, &meter, &rows).unwrap();
        assert_eq!(left.free(), [2]);
        let relation = [5, 5, 1].map(|value| field.element(value));
        assert_eq!(left.orthogonal(2).unwrap(), relation);
    }

    #[test]
    fn determinants_by_hand() {
        let field = Field::new(101).unwrap();
        let of = |rows: [[u64; 3]; 3]| {
            let rows = rows.map(|row| row.map(|entry| field.element(entry)).to_vec());
            determinant(&field, rows.to_vec())
        };
        // 2 (3 * 7 - 5 * 1) - 1 (0 * 7 - 5 * 4) + 0 = 52; with two rows exchanged - 52.
        assert_eq!(of([[2, 1, 0], [0, 3, 5], [4, 1, 7]]), field.element(52));
        assert_eq!(of([[0, 3, 5], [2, 1, 0], [4, 1, 7]]), field.element(49));
        assert_eq!(of([[1, 2, 3], [2, 4, 6], [0, 1, 1]]), 0);
    }
}
