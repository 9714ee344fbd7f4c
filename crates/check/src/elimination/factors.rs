//! The rows of a minor as a product L U: sparse at first, dense once what is left has filled up.

use super::{Dense, Echelon, for_all};
use crate::algebra::Ring;
use crate::pivots::Pivots;
use crate::rejection::{Checked, ensure};

/// The dense end begins where so many rows of U in a row fill that share of the columns to come.
const FULL_ROWS: usize = 16;
const FULL_SHARE: usize = 8;
/// It has at most so many rows: 2 GiB.
const MOST_ROWS: usize = 1 << 14;

/// Rows that are reduced together.
pub(crate) const TOGETHER: usize = 8;

/// The pivot rows of a matrix.
pub(crate) struct Factors<'f> {
    head: Echelon<'f>,
    /// The rows of the dense end as they are in the matrix, and the columns of their pivots.
    rows: Vec<Vec<(usize, u64)>>,
    columns: Vec<usize>,
    /// What is left of these rows at these columns once the head's are subtracted.
    pub(super) tail: Dense<'f>,
}

/// A row of the dense end, and what is left of it.
struct Remainder<'a> {
    row: &'a [(usize, u64)],
    left: Checked<Vec<u64>>,
}

impl<'f> Factors<'f> {
    /// Eliminates along pivots, none of which may vanish, in a matrix that is given by its rows.
    pub(crate) fn new<E: IntoIterator<Item = (usize, u64)>>(
        mut head: Echelon<'f>,
        pivots: &Pivots,
        row: impl Fn(usize) -> E,
    ) -> Checked<Factors<'f>> {
        let (count, mut full_rows, mut first) = (pivots.rows.len(), 0, 0);
        while first < count && full_rows < FULL_ROWS {
            let pivot = Some(pivots.cols[first]);
            let is_left = head.push(row(pivots.rows[first]), pivot)?;
            ensure!(is_left, "pivot {first} vanishes");
            first += 1;
            let rest = count - first;
            let is_full = rest <= MOST_ROWS && FULL_SHARE * head.last_length() > rest;
            full_rows = if is_full { full_rows + 1 } else { 0 };
        }
        let rows = pivots.rows[first..].iter();
        let rows: Vec<Vec<_>> = rows
            .map(|&number| row(number).into_iter().collect())
            .collect();
        let columns = pivots.cols[first..].to_vec();
        let left = remainders(&head, &rows, &columns)?;
        let tail = Dense::new(head.field, head.meter, left, first)?;
        Ok(Factors {
            head,
            rows,
            columns,
            tail,
        })
    }

    /// The combinations of the pivot rows that are N rows, which are given by columns, at the pivot
    /// columns; of these rows the differences are left.
    pub(crate) fn solve<const N: usize>(&self, rows: &mut [[u64; N]]) -> Checked<Vec<[u64; N]>> {
        let field = self.head.field;
        let mut tail = Vec::new();
        if !self.rows.is_empty() {
            let mut reduced = rows.to_vec();
            self.head.reduce(&mut reduced)?;
            tail = self.columns.iter().map(|&column| reduced[column]).collect();
            tail = self.tail.solve(tail)?;
        }
        // What is left then is for the head alone to take off.
        for (multiple, row) in tail.iter().zip(&self.rows) {
            for &(column, value) in row {
                let entries = rows[column].iter_mut().zip(multiple);
                entries.for_each(|(entry, &multiple)| {
                    *entry = field.sub(*entry, field.mul(multiple, value));
                });
            }
        }
        let mut solution = self.head.solve(rows)?;
        solution.append(&mut tail);
        Ok(solution)
    }
}

/// What is left of rows at some columns once they are reduced by those of a head.
fn remainders(
    head: &Echelon,
    rows: &[Vec<(usize, u64)>],
    columns: &[usize],
) -> Checked<Vec<Vec<u64>>> {
    let (field, width) = (head.field, head.width());
    let remainder = |row| Remainder {
        row,
        left: Ok(Vec::new()),
    };
    let mut all: Vec<_> = rows.iter().map(|row| remainder(row)).collect();
    for_all(&mut all, |some| {
        for together in some.chunks_mut(TOGETHER) {
            let mut lanes = vec![[0; TOGETHER]; width];
            for (lane, Remainder { row, .. }) in together.iter().enumerate() {
                for &(column, value) in *row {
                    lanes[column][lane] = field.add(lanes[column][lane], value);
                }
            }
            match head.reduce(&mut lanes) {
                Ok(_) => {
                    for (lane, remainder) in together.iter_mut().enumerate() {
                        let left = columns.iter().map(|&column| lanes[column][lane]);
                        remainder.left = Ok(left.collect());
                    }
                }
                Err(failure) => together[0].left = Err(failure),
            }
        }
    });
    all.into_iter().map(|remainder| remainder.left).collect()
}
