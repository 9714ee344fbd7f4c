//! Small dense linear algebra modulo a prime: independent rows, and what is orthogonal to them.

use crate::algebra::{Field, Ring};
use crate::limits::Meter;
use crate::rejection::Checked;

/// What one entry of a row counts as.
pub(super) const ENTRY: u64 = 4;

/// Independent rows: each is one at its pivot, and zero at the pivots of those before it.
#[derive(Clone)]
pub(super) struct Space<'a> {
    field: &'a Field,
    meter: &'a Meter,
    width: usize,
    rows: Vec<(usize, Vec<u64>)>,
}

impl<'a> Space<'a> {
    pub fn new(field: &'a Field, width: usize, meter: &'a Meter) -> Space<'a> {
        Space {
            field,
            meter,
            width,
            rows: Vec::new(),
        }
    }

    /// The space that rows span.
    pub fn of(
        field: &'a Field,
        width: usize,
        meter: &'a Meter,
        rows: impl IntoIterator<Item = Vec<u64>>,
    ) -> Checked<Space<'a>> {
        let mut space = Space::new(field, width, meter);
        for row in rows {
            space.insert(row)?;
        }
        Ok(space)
    }

    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Subtracts rows so that a vector vanishes at all pivots.
    pub fn reduce(&self, vector: &mut [u64]) -> Checked<()> {
        let mut used = 1;
        for (pivot, row) in &self.rows {
            let factor = vector[*pivot];
            if factor != 0 {
                used += 1;
                for (entry, &other) in vector.iter_mut().zip(row) {
                    *entry = self.field.sub(*entry, self.field.mul(factor, other));
                }
            }
        }
        self.meter
            .charge((ENTRY * self.width as u64) * used + self.rows.len() as u64)
    }

    /// Adds a vector; returns whether it was independent of the others.
    pub fn insert(&mut self, mut vector: Vec<u64>) -> Checked<bool> {
        self.reduce(&mut vector)?;
        let Some(pivot) = vector.iter().position(|&entry| entry != 0) else {
            return Ok(false);
        };
        let inverse = self.field.inverse(vector[pivot]);
        for entry in &mut vector {
            *entry = self.field.mul(*entry, inverse);
        }
        self.rows.push((pivot, vector));
        Ok(true)
    }

    /// Whether a vector is orthogonal to all rows.
    pub fn annihilate(&self, vector: &[u64]) -> Checked<bool> {
        let entries = self.width * self.rows.len();
        self.meter.charge(ENTRY * entries as u64)?;
        let mut rows = self.rows.iter();
        Ok(rows.all(|(_, row)| dot(self.field, row, vector) == 0))
    }

    /// The places without pivot, in increasing order.
    pub fn free(&self) -> Vec<usize> {
        let mut is_pivot = vec![false; self.width];
        self.rows
            .iter()
            .for_each(|&(pivot, _)| is_pivot[pivot] = true);
        (0..self.width).filter(|&at| !is_pivot[at]).collect()
    }

    /// A basis of the vectors that are orthogonal to all rows.
    pub fn kernel(&self) -> Checked<Vec<Vec<u64>>> {
        let mut basis = Vec::new();
        for free in self.free() {
            self.meter
                .charge(ENTRY * (self.width * (self.rows.len() + 1)) as u64)?;
            let mut vector = vec![0; self.width];
            vector[free] = self.field.one;
            // Later rows vanish at the pivots of earlier ones, so their entries come first.
            for (pivot, row) in self.rows.iter().rev() {
                vector[*pivot] = self.field.neg(dot(self.field, row, &vector));
            }
            basis.push(vector);
        }
        Ok(basis)
    }
}

/// The vectors w with w M = 0, for a matrix M given by its rows.
pub(super) fn left_kernel(
    field: &Field,
    meter: &Meter,
    rows: &[Vec<u64>],
    width: usize,
) -> Checked<Vec<Vec<u64>>> {
    let columns = (0..width).map(|column| rows.iter().map(|row| row[column]).collect());
    Space::of(field, rows.len(), meter, columns)?.kernel()
}

pub(super) fn dot(field: &Field, x: &[u64], y: &[u64]) -> u64 {
    let terms = x.iter().zip(y).filter(|&(&x, &y)| x != 0 && y != 0);
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
        let vector = |values: &[u64]| -> Vec<u64> {
            values.iter().map(|&value| field.element(value)).collect()
        };
        let rows = [[0, 2, 1, 0], [1, 1, 1, 1], [2, 6, 4, 2]].map(|row| vector(&row));
        let space = Space::of(&field, 4, &meter, rows.clone()).unwrap();
        assert_eq!(space.rank(), 2);
        assert_eq!(space.free(), [2, 3]);
        // 2 y + z = 0 and x + y + z + t = 0: y = 3 z, x = 3 z - t.
        let kernel = [[3, 3, 1, 0], [6, 0, 0, 1]].map(|row| vector(&row));
        assert_eq!(space.kernel().unwrap(), kernel);
        // Twice the first and twice the second are the third.
        let left = left_kernel(&field, &meter, &rows, 4).unwrap();
        assert_eq!(left, [vector(&[5, 5, 1])]);
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
