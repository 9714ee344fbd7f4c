//! Elimination modulo a prime: sparse with prescribed or found pivots, and dense along the
//! diagonal. Every loop that may take long counts its operations before the limits, row by row.

use crate::algebra::{Field, LANES, Ring, SMALL, SMALL_LANES};
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::{Add, Mul};
use std::sync::Mutex;

/// What one entry of a row that is subtracted counts as: in a sparse row; in a dense one modulo a
/// prime of up to 62 bits; and, by definition, in a dense one modulo a prime below 2^29.
pub(crate) const SPARSE: u64 = 8;
const DENSE: u64 = 4;
const DENSE_SMALL: u64 = 1;

/// Columns and rows that are computed together.
const TILE: usize = 64;
const GROUP: usize = 16;

/// Independent rows of a matrix, in the order in which they came, as a product L U.
pub(crate) struct Echelon<'f> {
    field: &'f Field,
    meter: &'f Meter,
    rows: Vec<EchelonRow>,
    /// For each column the row of which it is the pivot, or `NONE`.
    place: Vec<usize>,
    scratch: Scratch,
    /// Whether L is kept, which only systems of equations need.
    keeps_multiples: bool,
    /// The product of the pivots: with prescribed pivots, the determinant of their minor.
    pub determinant: u64,
}

/// No row.
const NONE: usize = usize::MAX;

/// A row that is being reduced, with the columns where it has entries: no other is looked at.
#[derive(Default)]
struct Scratch {
    /// Sums of products of two elements. If p < `SMALL` a sum is an element once it is reduced, by
    /// `entry`; otherwise it is kept as one.
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
        let sum = &mut self.row[column];
        if field.p < SMALL {
            // The product is below 2^58, and the sum before it below 2^63.
            *sum += a * b;
            if *sum >> 63 != 0 {
                *sum %= field.p;
            }
        } else {
            *sum = field.add(*sum, field.mul(a, b));
        }
    }

    /// The entry that a sum of products stands for.
    fn entry(&self, field: &Field, column: usize) -> u64 {
        match field.p < SMALL {
            true => field.add_products(0, u128::from(self.row[column])),
            false => self.row[column],
        }
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
    pub fn new(field: &'f Field, width: usize, meter: &'f Meter) -> Self {
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
    pub fn solvable(mut self) -> Self {
        self.keeps_multiples = true;
        self
    }

    /// Adds a row unless it vanishes at the prescribed pivot (or altogether) once it is reduced by
    /// the rows before it.
    pub fn push(
        &mut self,
        entries: impl IntoIterator<Item = (usize, u64)>,
        pivot: Option<usize>,
    ) -> Checked<bool> {
        let field = self.field;
        for (column, value) in entries {
            self.scratch
                .add(field, &self.place, column, [value, field.one]);
        }
        let multiples = self.reduce_scratch()?;
        self.scratch.met.sort_unstable();
        let met = self.scratch.met.iter();
        let row = met.map(|&column| (column, self.scratch.entry(field, column)));
        let row: Vec<(usize, u64)> = row.filter(|&(_, entry)| entry != 0).collect();
        self.scratch.clear();
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
            let multiple = self.scratch.entry(self.field, *pivot);
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

    /// Subtracts multiples of the rows of U so that a row vanishes at the pivots; returns the
    /// multiples.
    fn reduce(&self, row: &mut [u64]) -> Checked<Vec<(usize, u64)>> {
        let (mut multiples, mut entries) = (Vec::new(), 0);
        for (k, EchelonRow { pivot, reduced, .. }) in self.rows.iter().enumerate() {
            let multiple = row[*pivot];
            if multiple != 0 {
                multiples.push((k, multiple));
                subtract(self.field, row, multiple, reduced);
                entries += reduced.len();
            }
        }
        let passed = row.len() + self.rows.len();
        self.meter.charge(passed as u64 + SPARSE * entries as u64)?;
        Ok(multiples)
    }

    /// The combination of the matrix's rows that is the given row at the pivots; of the given row
    /// the difference is left.
    pub fn solve(&self, row: &mut [u64]) -> Checked<Vec<u64>> {
        let (mut solution, mut entries) = (vec![0; self.rows.len()], 0);
        for (k, multiple) in self.reduce(row)? {
            solution[k] = multiple;
        }
        for (k, done) in self.rows.iter().enumerate().rev() {
            let multiple = self.field.mul(solution[k], done.inverse);
            solution[k] = multiple;
            subtract(self.field, &mut solution, multiple, &done.multiples);
            entries += done.multiples.len();
        }
        self.meter.charge(SPARSE * entries as u64)?;
        Ok(solution)
    }
}

fn subtract(field: &Field, row: &mut [u64], multiple: u64, entries: &[(usize, u64)]) {
    let factor = field.neg(multiple);
    let entries = entries.iter();
    entries.for_each(|&(at, value)| row[at] = field.add(row[at], field.mul(factor, value)));
}

/// Works on all items, some at a time, with more threads if there are so many that it is worth
/// their start.
pub(crate) fn for_all<T: Send>(items: &mut [T], work: impl Fn(&mut [T]) + Sync) {
    let all =
        || std::thread::available_parallelism().map_or(1, |most| most.get().min(items.len() / 32));
    let threads = if items.len() < 64 { 1 } else { all() };
    let groups = Mutex::new(items.chunks_mut(GROUP));
    let next = || groups.lock().ok().and_then(|mut groups| groups.next());
    let run = || std::iter::from_fn(next).for_each(&work);
    std::thread::scope(|scope| {
        (1..threads).for_each(|_| drop(scope.spawn(run)));
        run();
    });
}

/// Sees that elimination along the diagonal of a square matrix meets no zero. Rows are subtracted
/// in blocks.
pub(crate) fn check_diagonal(
    field: &Field,
    meter: &Meter,
    mut rows: &mut [Vec<u64>],
) -> Checked<()> {
    let (height, weight) = match field.p < SMALL {
        true => (SMALL_LANES, DENSE_SMALL),
        false => (LANES, DENSE),
    };
    for first in (0..rows.len()).step_by(height) {
        let (block, rest) = rows.split_at_mut(height.min(rows.len()));
        let entries = block.len() * rest.len() * (rest.len() + block.len());
        meter.charge(weight * entries as u64)?;
        let mut inverses = Vec::new();
        for k in 0..block.len() {
            let (done, row) = block.split_at_mut(k);
            subtract_block(field, done, &inverses, first, &mut row[..1]);
            ensure!(row[0][first + k] != 0, "pivot {} vanishes", first + k);
            inverses.push(field.inverse(row[0][first + k]));
        }
        for_all(rest, |rows| {
            subtract_block(field, block, &inverses, first, rows)
        });
        rows = rest;
    }
    Ok(())
}

/// Subtracts multiples of rows of a block so that other rows would vanish at their pivots, the
/// columns from `first` on; computes what is right of these.
fn subtract_block(
    field: &Field,
    block: &[Vec<u64>],
    inverses: &[u64],
    first: usize,
    rows: &mut [Vec<u64>],
) {
    let factors = |row: &Vec<u64>| {
        let mut factors: Vec<u64> = Vec::with_capacity(block.len());
        for (k, &inverse) in inverses.iter().enumerate() {
            let terms = factors
                .iter()
                .zip(block)
                .map(|(&f, lane)| u128::from(f) * u128::from(lane[first + k]));
            let entry = field.add_products(row[first + k], terms.sum());
            factors.push(field.neg(field.mul(entry, inverse)));
        }
        factors
    };
    let factors: Vec<_> = rows.iter().map(factors).collect();
    let width = rows[0].len();
    // A tile of the block stays in the fastest cache for all rows.
    for from in (first + block.len()..width).step_by(TILE) {
        let tile: Vec<_> = block
            .iter()
            .map(|lane| &lane[from..width.min(from + TILE)])
            .collect();
        for (row, factors) in rows.iter_mut().zip(&factors) {
            let entries = &mut row[from..width.min(from + TILE)];
            // Words are what vector units multiply, if the compiler knows that 32 bits are enough.
            if field.p < SMALL {
                add_lanes::<u64>(field, entries, factors, &tile, |residue| {
                    residue & 0xffff_ffff
                });
            } else {
                add_lanes::<u128>(field, entries, factors, &tile, u128::from);
            }
        }
    }
}

/// Adds multiples of lanes to at most `TILE` entries; products are summed in `S`.
fn add_lanes<S: Copy + Default + Into<u128> + Add<Output = S> + Mul<Output = S>>(
    field: &Field,
    entries: &mut [u64],
    factors: &[u64],
    lanes: &[&[u64]],
    widen: impl Fn(u64) -> S,
) {
    let mut sums = [S::default(); TILE];
    for (factors, lanes) in factors.chunks(4).zip(lanes.chunks(4)) {
        // Lanes that are missing have factor zero: the first one does instead.
        let [s, t, u, v] = [0, 1, 2, 3].map(|k| widen(*factors.get(k).unwrap_or(&0)));
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| *lanes.get(k).unwrap_or(&lanes[0]));
        for ((((sum, &a), &b), &c), &d) in sums.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *sum = *sum + (s * widen(a) + t * widen(b)) + (u * widen(c) + v * widen(d));
        }
    }
    entries
        .iter_mut()
        .zip(sums)
        .for_each(|(entry, sum)| *entry = field.add_products(*entry, sum.into()));
}

#[cfg(test)]
mod tests;
