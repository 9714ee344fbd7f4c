//! Elimination modulo a prime along pivots that somebody else has found: nothing is searched, each pivot is only seen
//! not to vanish.
//!
//! Rows come in the order of the pivots and are reduced by all rows before them (a left-looking L U factorisation, L with
//! unit diagonal). Rows are stored sparsely until they fill up; from then on densely, and eight of them are
//! subtracted at a time with one reduction. Panels of rows are reduced by the finished ones in parallel.

use crate::modular::{Field, LANES};
use crate::rejection::{Checked, ensure};
use std::thread;

/// Rows that one thread reduces together, so that finished rows are fetched from memory once for all of them.
const PANEL: usize = 16;
/// A matrix that fills up to more entries than this (some 8 GB) is not verified.
const MAX_ENTRIES: usize = 1 << 29;

/// A row whose entries left of the pivot are multipliers (L) and right of it the reduced row (U), zeros left out.
struct SparseRow {
    columns: Vec<u32>,
    values: Vec<u64>,
    /// The number of entries left of the pivot.
    left: usize,
}

/// The factors of an invertible square matrix; row k and column k are the k-th pivot's.
pub(crate) struct Factors<'f> {
    field: &'f Field,
    /// Inverses of the pivots.
    inverses: Vec<u64>,
    sparse: Vec<SparseRow>,
    /// Of rows from `sparse_until` on: the columns from `sparse_until` on, in full.
    dense: Vec<Vec<u64>>,
    sparse_until: usize,
}

/// Factors the matrix of `size` rows that `write_row(k, row)` writes into rows of zeros. Rejects a pivot that vanishes.
pub(crate) fn factor<'f>(
    field: &'f Field,
    size: usize,
    write_row: impl Fn(usize, &mut [u64]) + Sync,
) -> Checked<Factors<'f>> {
    let mut factors =
        Factors { field, inverses: Vec::new(), sparse: Vec::new(), dense: Vec::new(), sparse_until: size };
    let workers = workers(size);
    let mut panel = vec![vec![0; size]; (PANEL * workers).min(size)];
    let (mut entries, mut filled) = (0, 0);
    for start in (0..size).step_by(panel.len().max(1)) {
        let end = size.min(start + panel.len());
        // Once a quarter of what rows have right of their pivot is not zero, dense rows are the faster ones.
        if factors.sparse_until == size && filled * 4 > (end - start) * (size - start) {
            factors.sparse_until = start;
            entries += (size - start) * (size - start);
        }
        let rows = &mut panel[..end - start];
        in_parallel(rows, workers, |offset, part| {
            for (k, row) in part.iter_mut().enumerate() {
                row.fill(0);
                write_row(start + offset + k, row);
            }
            factors.reduce(0..start, part);
        });
        filled = 0;
        for (k, row) in (start..end).zip(rows) {
            factors.reduce(start..k, std::slice::from_mut(row));
            ensure!(row[k] != 0, "pivot {k} vanishes");
            filled += factors.store(k, row);
        }
        entries += filled;
        ensure!(entries <= MAX_ENTRIES, "the elimination fills up beyond {MAX_ENTRIES} entries");
    }
    Ok(factors)
}

impl Factors<'_> {
    /// Stores the reduced row k; returns the number of entries right of the pivot that are not zero.
    fn store(&mut self, k: usize, row: &[u64]) -> usize {
        self.inverses.push(self.field.inverse(row[k]));
        let mut sparse = SparseRow { columns: Vec::new(), values: Vec::new(), left: 0 };
        let until = if k < self.sparse_until { row.len() } else { self.sparse_until };
        for (column, &value) in row[..until].iter().enumerate().filter(|&(column, &value)| value != 0 && column != k) {
            sparse.left += usize::from(column < k);
            sparse.columns.push(column as u32);
            sparse.values.push(value);
        }
        if k >= self.sparse_until {
            self.dense.push(row[self.sparse_until..].to_vec());
        }
        let filled = sparse.columns.len() - sparse.left;
        self.sparse.push(sparse);
        filled
    }

    /// Reduces rows by the finished rows of a range; the entries of a row there become its multipliers.
    fn reduce(&self, range: std::ops::Range<usize>, rows: &mut [Vec<u64>]) {
        let field = self.field;
        let start = self.sparse_until.clamp(range.start, range.end);
        for k in range.start..start {
            let SparseRow { columns, values, left } = &self.sparse[k];
            for row in rows.iter_mut().filter(|row| row[k] != 0) {
                row[k] = field.mul(row[k], self.inverses[k]);
                let factor = field.neg(row[k]);
                for (&column, &value) in columns[*left..].iter().zip(&values[*left..]) {
                    let entry = &mut row[column as usize];
                    *entry = field.add(*entry, field.mul(factor, value));
                }
            }
        }
        let base = self.sparse_until;
        for first in (start..range.end).step_by(LANES) {
            let last = range.end.min(first + LANES);
            for row in rows.iter_mut() {
                let mut factors = [0; LANES];
                for k in first..last {
                    row[k] = field.mul(row[k], self.inverses[k]);
                    factors[k - first] = field.neg(row[k]);
                    let lane = &self.dense[k - base][k + 1 - base..last - base];
                    add_multiple(field, &mut row[k + 1..last], factors[k - first], lane);
                }
                if factors != [0; LANES] {
                    let lanes = self.dense[first - base..last - base].iter().map(|lane| &lane[last - base..]);
                    add_lanes(field, &mut row[last..], &factors, lanes);
                }
            }
        }
    }

    /// Solves x A = b for each of the right-hand sides b in place.
    pub fn solve(&self, rows: &mut [Vec<u64>]) {
        let workers = workers(self.inverses.len());
        in_parallel(rows, workers, |_, part| {
            for panel in part.chunks_mut(PANEL) {
                self.reduce(0..self.inverses.len(), panel);
                self.reduce_back(panel);
            }
        });
    }

    /// Solves x L = y in place.
    fn reduce_back(&self, rows: &mut [Vec<u64>]) {
        let (field, base, size) = (self.field, self.sparse_until, self.inverses.len());
        for first in (base..size).step_by(LANES).rev() {
            let last = size.min(first + LANES);
            for row in rows.iter_mut() {
                let mut factors = [0; LANES];
                for k in (first..last).rev() {
                    factors[k - first] = field.neg(row[k]);
                    let lane = &self.dense[k - base][first - base..k - base];
                    add_multiple(field, &mut row[first..k], factors[k - first], lane);
                }
                let lanes = self.dense[first - base..last - base].iter().map(|lane| &lane[..first - base]);
                add_lanes(field, &mut row[base..first], &factors, lanes);
            }
        }
        for k in (0..size).rev() {
            let SparseRow { columns, values, left } = &self.sparse[k];
            for row in rows.iter_mut().filter(|row| row[k] != 0) {
                let factor = field.neg(row[k]);
                for (&column, &value) in columns[..*left].iter().zip(values) {
                    let entry = &mut row[column as usize];
                    *entry = field.add(*entry, field.mul(factor, value));
                }
            }
        }
    }

    /// The product of the pivots: the determinant of the matrix as it was given.
    pub fn determinant(&self) -> u64 {
        let product = self.inverses.iter().fold(self.field.one(), |product, &inverse| self.field.mul(product, inverse));
        self.field.inverse(product)
    }
}

/// row += factor lane.
fn add_multiple(field: &Field, row: &mut [u64], factor: u64, lane: &[u64]) {
    row.iter_mut().zip(lane).for_each(|(entry, &value)| *entry = field.add(*entry, field.mul(factor, value)));
}

/// row += sum of factors[k] lanes[k], all of one length.
fn add_lanes<'l>(field: &Field, row: &mut [u64], factors: &[u64; LANES], lanes: impl Iterator<Item = &'l [u64]>) {
    let mut all: [&[u64]; LANES] = [&[]; LANES];
    let mut count = 0;
    for lane in lanes {
        all[count] = &lane[..row.len()];
        count += 1;
    }
    // Missing lanes have factor zero: any other one does instead.
    for missing in count..LANES {
        all[missing] = all[0];
    }
    let [a, b, c, d, e, f, g, h] = all.map(|lane| &lane[..row.len()]);
    for (k, entry) in row.iter_mut().enumerate() {
        *entry = field.add_products(*entry, factors, [a[k], b[k], c[k], d[k], e[k], f[k], g[k], h[k]]);
    }
}

/// Threads are not worth their start for small matrices.
fn workers(size: usize) -> usize {
    if size < 256 { 1 } else { thread::available_parallelism().map_or(1, |count| count.get().min(8)) }
}

/// Splits the rows evenly among threads; the work is told the index of its first row.
fn in_parallel(rows: &mut [Vec<u64>], workers: usize, work: impl Fn(usize, &mut [Vec<u64>]) + Sync) {
    let share = rows.len().div_ceil(workers).max(1);
    if share >= rows.len() {
        return work(0, rows);
    }
    thread::scope(|scope| {
        for (k, part) in rows.chunks_mut(share).enumerate() {
            let work = &work;
            scope.spawn(move || work(k * share, part));
        }
    });
}

/// The rank of a matrix of sparse rows, by plain dense elimination: the first entry of a row that is left is its pivot.
pub(crate) fn rank(field: &Field, width: usize, rows: impl Iterator<Item = Vec<(usize, u64)>>) -> Checked<usize> {
    let mut reduced: Vec<(usize, u64, Vec<u64>)> = Vec::new();
    for entries in rows {
        let mut row = vec![0; width];
        for (column, value) in entries {
            row[column] = field.add(row[column], value);
        }
        for (pivot, inverse, other) in &reduced {
            if row[*pivot] != 0 {
                let factor = field.neg(field.mul(row[*pivot], *inverse));
                add_multiple(field, &mut row, factor, other);
            }
        }
        if let Some(pivot) = row.iter().position(|&entry| entry != 0) {
            reduced.push((pivot, field.inverse(row[pivot]), row));
            ensure!(reduced.len() * width <= MAX_ENTRIES, "the elimination fills up beyond {MAX_ENTRIES} entries");
        }
    }
    Ok(reduced.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chacha::Stream;

    /// A random matrix with a given share (of 100) of entries that are not zero, and a diagonal without zeros.
    fn random(field: &Field, size: usize, share: u64) -> Vec<Vec<u64>> {
        let mut stream = Stream::new(&[size as u8; 32]);
        let entry = |k, j, stream: &mut Stream| {
            if k == j || stream.below(100) < share { field.element(1 + stream.below(field.prime() - 1)) } else { 0 }
        };
        (0..size).map(|k| (0..size).map(|j| entry(k, j, &mut stream)).collect()).collect()
    }

    #[test]
    fn solutions_solve_the_system_at_every_density() {
        for p in [1_000_003, (1 << 61) - 1, (1 << 62) - 57] {
            let field = Field::new(p).unwrap();
            for (size, share) in [(1, 100), (7, 100), (8, 50), (17, 100), (40, 2), (300, 1), (301, 100), (520, 0)] {
                let matrix = random(&field, size, share);
                let factors = factor(&field, size, |k, row| row.copy_from_slice(&matrix[k])).unwrap();
                let right = random(&field, size, 30)[..size.min(40)].to_vec();
                let mut solutions = right.clone();
                factors.solve(&mut solutions);
                for (x, b) in solutions.iter().zip(&right) {
                    for (column, wanted) in b.iter().enumerate() {
                        let sum = (0..size).fold(0, |sum, k| field.add(sum, field.mul(x[k], matrix[k][column])));
                        assert_eq!(sum, *wanted, "size {size}, share {share}, column {column}");
                    }
                }
                let rows = matrix.iter().map(|row| row.iter().copied().enumerate().collect());
                assert_eq!(rank(&field, size, rows).unwrap(), size);
            }
        }
    }

    /// A Vandermonde matrix, whose leading minors and determinant are products of differences.
    #[test]
    fn determinant_of_vandermonde() {
        let field = Field::new((1 << 61) - 1).unwrap();
        let node = |k: usize| (3 * k * k + k + 2) as u64;
        let factors = factor(&field, 20, |k, row| {
            row.iter_mut().enumerate().for_each(|(j, entry)| *entry = field.pow(field.element(node(k)), j as u64));
        });
        let pairs = (0..20).flat_map(|k| (0..k).map(move |j| node(k) - node(j)));
        let product = pairs.fold(field.one(), |product, factor| field.mul(product, field.element(factor)));
        assert_eq!(factors.unwrap().determinant(), product);
    }

    #[test]
    fn a_vanishing_pivot_is_named() {
        let field = Field::new(7).unwrap();
        // Rows 0 and 1 agree in columns 0 and 1, so that the second pivot vanishes although the matrix is invertible.
        let matrix = [[1, 1, 0], [1, 1, 1], [0, 1, 1]].map(|row| row.map(|entry| field.element(entry)));
        let outcome = factor(&field, 3, |k, row| row.copy_from_slice(&matrix[k]));
        assert_eq!(outcome.map(|_| ()).unwrap_err().reason(), "pivot 1 vanishes");
    }

    #[test]
    fn rank_of_products() {
        let field = Field::new((1 << 61) - 1).unwrap();
        // 12 x 9 as a product through 4 dimensions.
        let (left, right) = (random(&field, 12, 60), random(&field, 9, 60));
        let row = |k: usize| {
            let sum = |j: usize| (0..4).fold(0, |sum, t| field.add(sum, field.mul(left[k][t], right[t][j])));
            (0..9).map(|j| (j, sum(j))).collect()
        };
        assert_eq!(rank(&field, 9, (0..12).map(row)).unwrap(), 4);
    }
}
