//! Dense elimination along the diagonal, in blocks of rows.

use super::{DENSE, DENSE_SMALL, add_products, for_all, settled, to_sums};
use crate::algebra::{Field, LANES, Ring, SMALL, SMALL_LANES};
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};
use std::ops::{Add, Mul};

/// Columns that are computed together.
pub(super) const TILE: usize = 64;

/// A square matrix as a product L U.
pub(crate) struct Dense<'f> {
    field: &'f Field,
    meter: &'f Meter,
    /// On the diagonal and right of it U, left of it L, which has ones on the diagonal.
    rows: Vec<Vec<u64>>,
    /// Of the pivots.
    inverses: Vec<u64>,
}

impl<'f> Dense<'f> {
    /// Sees that elimination along the diagonal of a square matrix meets no zero; `before` is how
    /// many pivots came before these.
    pub(crate) fn new(
        field: &'f Field,
        meter: &'f Meter,
        mut rows: Vec<Vec<u64>>,
        before: usize,
    ) -> Checked<Dense<'f>> {
        let height = if field.p < SMALL { SMALL_LANES } else { LANES };
        let mut inverses = Vec::with_capacity(rows.len());
        let mut rest_rows = &mut rows[..];
        for first in (0..rest_rows.len()).step_by(height) {
            let (block, rest) = rest_rows.split_at_mut(height.min(rest_rows.len()));
            let entries = block.len() * rest.len() * (rest.len() + block.len());
            meter.charge(weight(field) * entries as u64)?;
            for k in 0..block.len() {
                let (done, row) = block.split_at_mut(k);
                subtract_block(field, done, &inverses[first..], first, &mut row[..1]);
                let pivot = row[0][first + k];
                ensure!(pivot != 0, "pivot {} vanishes", before + first + k);
                inverses.push(field.inverse(pivot));
            }
            for_all(rest, |rows| {
                subtract_block(field, block, &inverses[first..], first, rows)
            });
            rest_rows = rest;
        }
        Ok(Dense {
            field,
            meter,
            rows,
            inverses,
        })
    }

    /// How many rows and columns there are.
    pub(crate) fn size(&self) -> usize {
        self.rows.len()
    }

    /// The combinations of the rows that are N rows, which are given by columns.
    pub(crate) fn solve<const N: usize>(&self, mut rows: Vec<[u64; N]>) -> Checked<Vec<[u64; N]>> {
        let (field, size) = (self.field, self.size());
        self.meter
            .charge(weight(field) * (N * size * size) as u64)?;
        // Row after row of U, and then of L backwards, is taken off.
        rows.iter_mut().for_each(|row| to_sums(field, row));
        for (k, (row, &inverse)) in self.rows.iter().zip(&self.inverses).enumerate() {
            rows[k] = rows[k].map(|sum| field.mul(settled(field, sum), inverse));
            let factors = rows[k].map(|multiple| field.neg(multiple));
            for (sums, &value) in rows[k + 1..].iter_mut().zip(&row[k + 1..]) {
                add_products(field, sums, &factors, value);
            }
        }
        rows.iter_mut().for_each(|row| to_sums(field, row));
        for (k, row) in self.rows.iter().enumerate().rev() {
            rows[k] = rows[k].map(|sum| settled(field, sum));
            let factors = rows[k].map(|multiple| field.neg(multiple));
            for (sums, &value) in rows[..k].iter_mut().zip(row) {
                add_products(field, sums, &factors, value);
            }
        }
        Ok(rows)
    }
}

fn weight(field: &Field) -> u64 {
    if field.p < SMALL { DENSE_SMALL } else { DENSE }
}

/// Subtracts multiples of rows of a block so that other rows would vanish at their pivots, the
/// columns from `first` on; computes what is right of these, and there the multiples themselves.
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
    for (row, factors) in rows.iter_mut().zip(&factors) {
        let multiples = factors.iter().map(|&factor| field.neg(factor));
        row[first..]
            .iter_mut()
            .zip(multiples)
            .for_each(|(entry, multiple)| *entry = multiple);
    }
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
pub(super) fn add_lanes<S: Copy + Default + Into<u128> + Add<Output = S> + Mul<Output = S>>(
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
