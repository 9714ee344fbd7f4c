//! Sparse elimination, with prescribed or found pivots.

mod spans;

use super::{SPARSE, add_products, settled, to_sums};
use crate::algebra::{Field, Ring};
use crate::limits::Meter;
use crate::rejection::Checked;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Independent rows of a matrix, in the order in which they came, as a product L U.
pub(crate) struct Echelon<'f> {
    pub(super) field: &'f Field,
    pub(super) meter: &'f Meter,
    rows: Vec<EchelonRow>,
    /// For each column the row of which it is the pivot, or `NONE`.
    place: Vec<usize>,
    scratch: Scratch,
    /// Whether L is kept, which only systems of equations need.
    keeps_multiples: bool,
    /// The product of the pivots: with prescribed pivots, the determinant of their minor.
    pub determinant: u64,
}

/// Numbers with where they stand.
type Entries = Vec<(usize, u64)>;

/// No row.
const NONE: usize = usize::MAX;

/// A row that is being reduced, with the columns where it has entries: no other is looked at.
#[derive(Default)]
struct Scratch {
    /// Sums of products.
    row: Vec<u64>,
    met: Vec<usize>,
    is_met: Vec<bool>,
    /// The rows of U whose pivots were met and that were not subtracted yet, the first one on top.
    due: BinaryHeap<Reverse<usize>>,
}

impl Scratch {
    /// Adds a product to an entry.
    fn add(&mut self, field: &Field, place: &[usize], column: usize, [a, b]: [u64; 2]) {
        if !self.is_met[column] {
            self.is_met[column] = true;
            self.met.push(column);
            if place[column] != NONE {
                self.due.push(Reverse(place[column]));
            }
        }
        let sum = std::array::from_mut(&mut self.row[column]);
        add_products(field, sum, &[a], b);
    }

    /// Forgets the row.
    fn clear(&mut self) {
        for column in self.met.drain(..) {
            self.row[column] = 0;
            self.is_met[column] = false;
        }
    }
}

struct EchelonRow {
    pivot: usize,
    /// The row of U by columns, with 1 at the pivot.
    reduced: Vec<(usize, u64)>,
    /// The row of L: multiples of the rows before, and the inverse of that of this one.
    multiples: Vec<(usize, u64)>,
    inverse: u64,
}

impl<'f> Echelon<'f> {
    pub(crate) fn new(field: &'f Field, width: usize, meter: &'f Meter) -> Self {
        Echelon {
            field,
            meter,
            rows: Vec::new(),
            place: vec![NONE; width],
            scratch: Scratch {
                row: vec![0; width],
                is_met: vec![false; width],
                ..Scratch::default()
            },
            keeps_multiples: false,
            determinant: field.one,
        }
    }

    /// So that systems can be solved with the rows to come.
    pub(crate) fn solvable(mut self) -> Self {
        self.keeps_multiples = true;
        self
    }

    /// How many columns there are.
    pub(crate) fn width(&self) -> usize {
        self.place.len()
    }

    /// What is left of a row once multiples of the rows of U are subtracted, so that it vanishes at
    /// their pivots: its entries by columns, increasing. And the multiples.
    fn reduced(
        &mut self,
        entries: impl IntoIterator<Item = (usize, u64)>,
    ) -> Checked<(Entries, Entries)> {
        let field = self.field;
        for (column, value) in entries {
            let product = [value, field.one];
            self.scratch.add(field, &self.place, column, product);
        }
        let multiples = self.reduce_scratch()?;
        self.scratch.met.sort_unstable();
        let met = self.scratch.met.iter();
        let row = met.map(|&column| (column, settled(field, self.scratch.row[column])));
        let row = row.filter(|&(_, entry)| entry != 0).collect();
        self.scratch.clear();
        Ok((row, multiples))
    }

    /// How many entries the last row of U has.
    pub(crate) fn last_length(&self) -> usize {
        self.rows.last().map_or(0, |row| row.reduced.len())
    }

    /// Adds a row unless it vanishes at the prescribed pivot (or altogether) once it is reduced by
    /// the rows before it.
    pub(crate) fn push(
        &mut self,
        entries: impl IntoIterator<Item = (usize, u64)>,
        pivot: Option<usize>,
    ) -> Checked<bool> {
        let field = self.field;
        let (row, multiples) = self.reduced(entries)?;
        let at = match pivot {
            Some(pivot) => row.iter().find(|&&(column, _)| column == pivot),
            None => row.first(),
        };
        let Some(&(pivot, at_pivot)) = at else {
            return Ok(false);
        };
        self.determinant = field.mul(self.determinant, at_pivot);
        let inverse = field.inverse(at_pivot);
        let reduced = row
            .iter()
            .map(|&(column, entry)| (column, field.mul(inverse, entry)));
        self.place[pivot] = self.rows.len();
        self.rows.push(EchelonRow {
            pivot,
            reduced: reduced.collect(),
            multiples: if self.keeps_multiples {
                multiples
            } else {
                Vec::new()
            },
            inverse,
        });
        Ok(true)
    }

    /// Subtracts multiples of the rows of U from the scratch row, so that it vanishes at the pivots;
    /// returns the multiples. A row of U vanishes at the pivots before its own, so that what is met
    /// on the way comes later.
    fn reduce_scratch(&mut self) -> Checked<Vec<(usize, u64)>> {
        let (mut multiples, mut entries) = (Vec::new(), 0);
        while let Some(Reverse(k)) = self.scratch.due.pop() {
            let EchelonRow { pivot, reduced, .. } = &self.rows[k];
            let multiple = settled(self.field, self.scratch.row[*pivot]);
            if multiple != 0 {
                multiples.push((k, multiple));
                let factor = self.field.neg(multiple);
                for &(column, value) in reduced {
                    let product = [factor, value];
                    self.scratch.add(self.field, &self.place, column, product);
                }
                entries += reduced.len();
            }
        }
        let steps = self.scratch.met.len() + entries;
        self.meter.charge(SPARSE * steps as u64)?;
        Ok(multiples)
    }

    /// Subtracts multiples of the rows of U so that N rows, which are given by columns, vanish at
    /// the pivots; returns the multiples.
    pub(crate) fn reduce<const N: usize>(
        &self,
        rows: &mut [[u64; N]],
    ) -> Checked<Vec<(usize, [u64; N])>> {
        let field = self.field;
        rows.iter_mut().for_each(|row| to_sums(field, row));
        let (mut multiples, mut entries) = (Vec::new(), 0);
        for (k, EchelonRow { pivot, reduced, .. }) in self.rows.iter().enumerate() {
            let multiple = rows[*pivot].map(|sum| settled(field, sum));
            if multiple != [0; N] {
                multiples.push((k, multiple));
                let factors = multiple.map(|multiple| field.neg(multiple));
                for &(column, value) in reduced {
                    add_products(field, &mut rows[column], &factors, value);
                }
                entries += reduced.len();
            }
        }
        rows.iter_mut()
            .for_each(|row| *row = row.map(|sum| settled(field, sum)));
        let passed = N * (rows.len() + self.rows.len());
        self.meter
            .charge(passed as u64 + SPARSE * (N * entries) as u64)?;
        Ok(multiples)
    }

    /// The combinations of the matrix's rows that are the given N rows at the pivots; of the given
    /// rows the differences are left.
    pub(crate) fn solve<const N: usize>(&self, rows: &mut [[u64; N]]) -> Checked<Vec<[u64; N]>> {
        let field = self.field;
        let (mut solution, mut entries) = (vec![[0; N]; self.rows.len()], 0);
        for (k, multiple) in self.reduce(rows)? {
            add_products(field, &mut solution[k], &multiple, field.one);
        }
        for (k, done) in self.rows.iter().enumerate().rev() {
            let multiple = solution[k].map(|sum| field.mul(settled(field, sum), done.inverse));
            solution[k] = multiple;
            let factors = multiple.map(|multiple| field.neg(multiple));
            for &(before, value) in &done.multiples {
                add_products(field, &mut solution[before], &factors, value);
            }
            entries += done.multiples.len();
        }
        self.meter.charge(SPARSE * (N * entries) as u64)?;
        Ok(solution)
    }
}
