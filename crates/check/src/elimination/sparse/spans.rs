//! What rows span, and what is orthogonal to them: for the number of solutions (section 12).

use super::{Echelon, EchelonRow, Entries, NONE};
use crate::algebra::{Field, Ring};
use crate::elimination::SPARSE;
use crate::limits::Meter;
use crate::rejection::Checked;

impl<'f> Echelon<'f> {
    /// The rows of a matrix, eliminated in their order.
    pub(crate) fn of<R: IntoIterator<Item = (usize, u64)>>(
        field: &'f Field,
        width: usize,
        meter: &'f Meter,
        rows: impl IntoIterator<Item = R>,
    ) -> Checked<Self> {
        let mut echelon = Echelon::new(field, width, meter);
        for row in rows {
            echelon.push(row, None)?;
        }
        Ok(echelon)
    }

    /// How many rows are independent.
    pub(crate) fn rank(&self) -> usize {
        self.rows.len()
    }

    /// The columns without pivot, in increasing order.
    pub(crate) fn free(&self) -> Vec<usize> {
        let columns = 0..self.width();
        columns.filter(|&at| self.place[at] == NONE).collect()
    }

    /// The vector that is orthogonal to all rows, one at a column without pivot and zero at the
    /// others of them. All of these are a basis.
    pub(crate) fn orthogonal(&self, free: usize) -> Checked<Vec<u64>> {
        let entries: usize = self.rows.iter().map(|row| row.reduced.len()).sum();
        self.meter
            .charge(SPARSE * entries as u64 + self.width() as u64)?;
        let mut vector = vec![0; self.width()];
        vector[free] = self.field.one;
        // Rows vanish at the pivots of those before them, so that the last ones come first.
        for row in self.rows.iter().rev() {
            vector[row.pivot] = self.field.neg(self.product(row, &vector));
        }
        Ok(vector)
    }

    /// Whether a vector is orthogonal to all rows.
    pub(crate) fn annihilates(&self, vector: &[u64]) -> Checked<bool> {
        let entries: usize = self.rows.iter().map(|row| row.reduced.len()).sum();
        self.meter.charge(SPARSE * entries as u64)?;
        let mut rows = self.rows.iter();
        Ok(rows.all(|row| self.product(row, vector) == 0))
    }

    fn product(&self, row: &EchelonRow, vector: &[u64]) -> u64 {
        let terms = row.reduced.iter();
        terms.fold(0, |sum, &(column, entry)| {
            self.field.add(sum, self.field.mul(entry, vector[column]))
        })
    }

    /// What is left of a row once multiples of the rows of U are subtracted, so that it vanishes at
    /// their pivots: its entries by columns, increasing.
    pub(crate) fn residue(
        &mut self,
        entries: impl IntoIterator<Item = (usize, u64)>,
    ) -> Checked<Entries> {
        Ok(self.reduced(entries)?.0)
    }
}
