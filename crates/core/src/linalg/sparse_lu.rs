//! Sparse elimination modulo a prime, with a dense end.
//!
//! Pivots are chosen by Markowitz' rule (Management Science 3, 1957) among the columns
//! with the fewest entries, so that little fills in. What remains when filling in can no
//! longer be avoided is eliminated as a dense matrix. The factors are kept: they give
//! kernel vectors and solutions for many right-hand sides at once.

#[cfg(test)]
use crate::linalg::Ring;
use crate::linalg::dense_lu::{Echelon, eliminate_mod};
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook::Pivots;
#[cfg(test)]
use crate::watch::unwatched;
use crate::watch::{Reservation, Stopped, Task, matrix_bytes};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The entries of a row that are not zero: `(column, value)`, columns ascending.
pub type SparseRow = Vec<(usize, u64)>;

/// Columns looked at for every pivot.
const SEARCHED: usize = 4;

/// What one entry of a sparse row operation costs, in multiply-accumulates of the dense
/// elimination: merging, and keeping the columns' lists.
const SPARSE_COST: usize = 24;

/// Right-hand sides that share one pass over the sparse factors.
const LANES: usize = 8;

/// What one entry of the sparse factors costs for one vector, in multiply-accumulates of dense
/// ones.
const SPARSE_WEIGHT: u64 = 4;

/// Progress is told after so many sparse pivots.
const ASKED_PIVOTS: usize = 64;

/// So many entries of sparse rows are added up without asking whether they are still wanted, and
/// how much memory they take.
const UNASKED_ENTRIES: usize = 1 << 16;

/// Bytes for an entry of a sparse row: itself, and its place in the list of its column.
const ENTRY_BYTES: usize = size_of::<(usize, u64)>() + size_of::<usize>();

/// An eliminated sparse matrix modulo p.
///
/// ```
/// use viewcert::linalg::{Ring, prime::PrimeField, sparse_lu::Factorisation};
/// use viewcert::watch::unwatched;
///
/// // Edges of a triangle: rows e_0 - e_1, e_1 - e_2, e_0 - e_2.
/// let f = PrimeField::mersenne61();
/// let (one, minus) = (f.one(), f.from_i64(-1));
/// let rows = vec![vec![(0, one), (1, minus)], vec![(1, one), (2, minus)], vec![(0, one), (2, minus)]];
/// let done = unwatched(|task| Factorisation::new(&f, rows, 3, task));
/// assert_eq!(done.rank(), 2);
/// assert_eq!(done.free_cols().len(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct Factorisation {
    field: PrimeField,
    rows: usize,
    cols: usize,
    /// Pivots of the sparse part.
    sparse: Pivots,
    /// The pivot rows of the sparse part as they were when chosen, without the pivot.
    upper: Vec<SparseRow>,
    inverses: Vec<u64>,
    /// For every row, the sparse pivots whose rows were added to it, and how often.
    lower: Vec<SparseRow>,
    /// Rows and columns of the dense part.
    dense_rows: Vec<usize>,
    dense_cols: Vec<usize>,
    dense: Echelon,
    free_rows: Vec<usize>,
    free_cols: Vec<usize>,
    /// For the sparse factors, and for the dense ones.
    _memory: [Reservation; 2],
}

/// Why a matrix was not factorised.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfinished {
    /// The part that has to be eliminated as a dense matrix has these many rows and columns: too
    /// many.
    TooLarge(usize, usize),
    /// The work was stopped.
    Stopped(Stopped),
}

impl From<Stopped> for Unfinished {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

/// The part of the matrix that has not been eliminated, with its columns' rows.
struct Active {
    field: PrimeField,
    rows: Vec<SparseRow>,
    /// The rows with an entry in each column.
    members: Vec<Vec<usize>>,
    /// Columns with at least one entry, by their number of entries.
    by_count: BTreeSet<(usize, usize)>,
    nonempty: usize,
    /// The memory of the row that was replaced last, for the next one.
    spare: SparseRow,
    /// The entries of all rows, pivot rows and multipliers included.
    entries: usize,
    /// The entries that have been added up since somebody asked.
    unasked: usize,
    memory: Reservation,
}

impl Active {
    fn new(field: &PrimeField, rows: Vec<SparseRow>, cols: usize) -> Self {
        let mut counts = vec![0; cols];
        for &(col, _) in rows.iter().flatten() {
            counts[col] += 1;
        }
        // With room to fill in.
        let mut members: Vec<Vec<usize>> = counts
            .into_iter()
            .map(|count: usize| Vec::with_capacity(2 * count))
            .collect();
        for (r, row) in rows.iter().enumerate() {
            for &(col, _) in row {
                members[col].push(r);
            }
        }
        let columns = members
            .iter()
            .enumerate()
            .filter(|(_, rows)| !rows.is_empty());
        let by_count = columns.map(|(col, rows)| (rows.len(), col)).collect();
        let nonempty = rows.iter().filter(|row| !row.is_empty()).count();
        let rows_entries = rows.iter().map(Vec::len).sum();
        Self {
            field: *field,
            rows,
            members,
            by_count,
            nonempty,
            entries: rows_entries,
            unasked: 0,
            memory: Reservation::default(),
            spare: Vec::new(),
        }
    }

    /// Asks whether to go on, and for the memory of what has filled in, if it is time to.
    fn ask(&mut self, task: &Task) -> Result<(), Stopped> {
        if self.unasked < UNASKED_ENTRIES {
            return Ok(());
        }
        self.unasked = 0;
        self.account(task)?;
        task.check()
    }

    fn account(&mut self, task: &Task) -> Result<(), Stopped> {
        let bytes = (self.entries * ENTRY_BYTES) as u64;
        let entries = self.entries;
        let what = format_args!("a sparse matrix that has filled in to {entries} entries");
        self.memory.resize(bytes, task, what)
    }

    /// The pivot with the least fill, `(fill, row, column)`; `None` when nothing is left.
    fn choose(&self) -> Option<(usize, usize, usize)> {
        let candidate = |&(count, col): &(usize, usize)| {
            let shortest = self.members[col]
                .iter()
                .map(|&row| (self.rows[row].len(), row))
                .min();
            shortest.map(|(length, row)| ((length - 1) * (count - 1), row, col))
        };
        self.by_count
            .iter()
            .take(SEARCHED)
            .filter_map(candidate)
            .min()
    }

    /// Whether to go on with a dense matrix rather than with a pivot of this fill.
    fn is_dense(&self, fill: usize) -> bool {
        fill * SPARSE_COST > self.nonempty * self.by_count.len()
    }

    /// Takes a row off a column's list. (The order of a list does not matter.)
    fn remove(&mut self, col: usize, row: usize) {
        let members = &mut self.members[col];
        if let Some(at) = members.iter().position(|&member| member == row) {
            members.swap_remove(at);
        }
    }

    /// Eliminates a column with a row, the pivot of the given step, and notes in `lower`
    /// how often the pivot row was added to which rows; returns the row without the
    /// pivot, and the inverse of the pivot.
    fn eliminate(
        &mut self,
        row: usize,
        col: usize,
        step: usize,
        lower: &mut [SparseRow],
        task: &Task,
    ) -> Result<(SparseRow, u64), Stopped> {
        let mut pivot_row = std::mem::take(&mut self.rows[row]);
        self.nonempty -= 1;
        // Only columns of the pivot row change: they are counted again at the end.
        for &(c, _) in &pivot_row {
            self.by_count.remove(&(self.members[c].len(), c));
            self.remove(c, row);
        }
        let place = pivot_row
            .binary_search_by_key(&col, |&(c, _)| c)
            .unwrap_or_else(|_| unreachable!("a pivot is an entry of its row"));
        let (_, pivot) = pivot_row.remove(place);
        let inverse = self
            .field
            .inverse(pivot)
            .unwrap_or_else(|| unreachable!("a pivot is not zero"));
        for target in std::mem::take(&mut self.members[col]) {
            let factor = self.add_multiple(target, col, &pivot_row, inverse);
            lower[target].push((step, factor));
            self.ask(task)?;
        }
        for &(c, _) in &pivot_row {
            let count = self.members[c].len();
            if count > 0 {
                self.by_count.insert((count, c));
            }
        }
        Ok((pivot_row, inverse))
    }

    /// Clears column `col` of a row with the multiple of the pivot row that does it.
    fn add_multiple(
        &mut self,
        target: usize,
        col: usize,
        pivot_row: &SparseRow,
        inverse: u64,
    ) -> u64 {
        let f = self.field;
        let old = std::mem::take(&mut self.rows[target]);
        let place = old
            .binary_search_by_key(&col, |&(c, _)| c)
            .unwrap_or_else(|_| unreachable!("a column's list holds rows with an entry there"));
        let factor = f.negate(f.times(old[place].1, inverse));
        let mut sum = std::mem::take(&mut self.spare);
        sum.clear();
        sum.reserve(old.len() + pivot_row.len());
        let mut added = pivot_row.iter().peekable();
        for &(c, value) in &old {
            while let Some(&&(new, x)) = added.peek().filter(|&&&(new, _)| new < c) {
                sum.push((new, f.times(factor, x)));
                self.members[new].push(target);
                added.next();
            }
            if let Some(&(_, x)) = added.next_if(|&&(same, _)| same == c) {
                let value = f.plus(value, f.times(factor, x));
                if value == 0 {
                    self.remove(c, target);
                } else {
                    sum.push((c, value));
                }
            } else if c != col {
                sum.push((c, value));
            }
        }
        for &(new, x) in added {
            sum.push((new, f.times(factor, x)));
            self.members[new].push(target);
        }
        if sum.is_empty() {
            self.nonempty -= 1;
        }
        self.unasked += old.len() + pivot_row.len();
        // One more for the multiplier.
        self.entries = self.entries + sum.len() + 1 - old.len();
        self.rows[target] = sum;
        self.spare = old;
        factor
    }
}

impl Factorisation {
    /// Eliminates the matrix with the given rows and `cols` columns. The cost depends on
    /// the fill; it is at most that of the dense elimination, up to a constant, and the
    /// memory is at most that of the dense matrix of what remains.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If a row is not ascending, or has a column beyond the last or a zero.
    pub fn new(
        field: &PrimeField,
        rows: Vec<SparseRow>,
        cols: usize,
        task: &Task,
    ) -> Result<Self, Stopped> {
        Self::within(field, rows, cols, usize::MAX, task).map_err(|unfinished| match unfinished {
            Unfinished::Stopped(stopped) => stopped,
            Unfinished::TooLarge(..) => unreachable!("no part of a matrix has more entries"),
        })
    }

    /// The same, if the part that is eliminated as a dense matrix has at most `limit` entries.
    /// The work is counted in columns first, then in the products of the dense elimination.
    ///
    /// # Errors
    /// If the task was stopped, or that part is larger. It has not been stored then.
    ///
    /// # Panics
    /// As [`Factorisation::new`].
    pub(crate) fn within(
        field: &PrimeField,
        rows: Vec<SparseRow>,
        cols: usize,
        limit: usize,
        task: &Task,
    ) -> Result<Self, Unfinished> {
        for row in &rows {
            assert!(
                row.is_sorted_by(|a, b| a.0 < b.0),
                "columns of a sparse row ascend"
            );
            assert!(
                row.iter().all(|&(c, x)| c < cols && x != 0),
                "entries of a sparse row"
            );
        }
        let count = rows.len();
        // Columns are no measure of the time that is left.
        let work = task.followed_by(None).begin(cols as u64);
        let mut active = Active::new(field, rows, cols);
        active.memory = task.reserve(0, format_args!("nothing"))?;
        active.account(task)?;
        let mut sparse = Pivots::default();
        let (mut upper, mut inverses) = (Vec::new(), Vec::new());
        let mut lower = vec![Vec::new(); count];
        while let Some((fill, row, col)) = active.choose() {
            if active.is_dense(fill) {
                break;
            }
            let step = sparse.rank();
            let (pivot_row, inverse) = active.eliminate(row, col, step, &mut lower, task)?;
            if step.is_multiple_of(ASKED_PIVOTS) {
                work.done(if step == 0 { 0 } else { ASKED_PIVOTS as u64 })?;
            }
            upper.push(pivot_row);
            inverses.push(inverse);
            sparse.rows.push(row);
            sparse.cols.push(col);
        }

        let dense_rows: Vec<usize> = (0..count).filter(|&r| !active.rows[r].is_empty()).collect();
        let dense_cols: Vec<usize> = (0..cols)
            .filter(|&col| !active.members[col].is_empty())
            .collect();
        let mut place = vec![0; cols];
        for (k, &col) in dense_cols.iter().enumerate() {
            place[col] = k;
        }
        let width = dense_cols.len();
        if dense_rows.len().saturating_mul(width) > limit {
            return Err(Unfinished::TooLarge(dense_rows.len(), width));
        }
        drop(work);
        active.account(task)?;
        let height = dense_rows.len();
        let dense_memory = task.reserve(
            matrix_bytes(height, width),
            format_args!("the dense rest of a sparse matrix, {height} x {width},"),
        )?;
        let mut rest = Matrix::new(dense_rows.len(), width, vec![0; dense_rows.len() * width]);
        for (k, &row) in dense_rows.iter().enumerate() {
            for &(col, value) in &active.rows[row] {
                rest[(k, place[col])] = value;
            }
        }
        // What is left of the sparse matrix is in the dense one now.
        active.rows = Vec::new();
        active.members = Vec::new();
        let kept = upper.iter().chain(&lower).map(Vec::len).sum();
        active.entries = kept;
        active.account(task)?;
        let dense = eliminate_mod(field, rest, task)?;
        let mut done = Self {
            field: *field,
            rows: count,
            cols,
            sparse,
            upper,
            inverses,
            lower,
            dense_rows,
            dense_cols,
            dense,
            free_rows: Vec::new(),
            free_cols: Vec::new(),
            _memory: [active.memory, dense_memory],
        };
        let pivots = done.pivots();
        done.free_rows = pivots.free_rows(count);
        done.free_cols = pivots.free_cols(cols);
        Ok(done)
    }

    /// The rank modulo p.
    pub fn rank(&self) -> usize {
        self.sparse.rank() + self.dense.rank()
    }

    /// Rows and columns of a minor that is not zero: first those of the sparse part.
    pub fn pivots(&self) -> Pivots {
        let mut pivots = self.sparse.clone();
        let dense = self.dense.pivots();
        pivots
            .rows
            .extend(dense.rows.iter().map(|&row| self.dense_rows[row]));
        pivots
            .cols
            .extend(dense.cols.iter().map(|&col| self.dense_cols[col]));
        pivots
    }

    /// The rows that are not pivots, ascending.
    pub fn free_rows(&self) -> &[usize] {
        &self.free_rows
    }

    /// The columns that are not pivots, ascending.
    pub fn free_cols(&self) -> &[usize] {
        &self.free_cols
    }

    /// Rows and columns of the part that was eliminated as a dense matrix.
    pub fn dense_size(&self) -> (usize, usize) {
        (self.dense_rows.len(), self.dense_cols.len())
    }

    /// A basis of the vectors w with w A = 0, one row of the result for each free row: one
    /// at that row and zero at the other free rows.
    #[cfg(test)]
    pub(crate) fn left_kernel(&self) -> Matrix<u64> {
        let free = self.free_rows.len();
        let unit = |i, k| if i == k { self.field.one() } else { 0 };
        let unit = Matrix::from_fn(free, free, unit);
        unwatched(|task| self.left_combinations(&unit, task))
    }

    /// Vectors w with w A = 0, one row of the result for each row of `coefficients`: its
    /// entries, in the order of [`free_rows`](Self::free_rows), are those of w at the free
    /// rows. Takes O(r^2) multiply-accumulates a vector, r the rank of the dense part, and one
    /// pass over the sparse factors for every 8 vectors; shared among threads.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If `coefficients` does not have a column for each free row.
    pub(crate) fn left_combinations(
        &self,
        coefficients: &Matrix<u64>,
        task: &Task,
    ) -> Result<Matrix<u64>, Stopped> {
        assert_eq!(
            coefficients.cols(),
            self.free_rows.len(),
            "one coefficient a free row"
        );
        let place = |row: usize| {
            let free = self.free_rows.binary_search(&row);
            free.unwrap_or_else(|_| unreachable!("a row that is not a pivot is free"))
        };
        let dense_free: Vec<usize> = self.dense.order()[self.dense.rank()..]
            .iter()
            .map(|&row| place(self.dense_rows[row]))
            .collect();
        let count = coefficients.rows();
        let (rank, free) = (self.dense.rank(), dense_free.len());
        // The vectors, their part in the dense rows, and that part of the dense factors.
        let bytes = matrix_bytes(count, self.rows)
            + matrix_bytes(count, free + rank)
            + matrix_bytes(free, rank);
        let _memory = task.reserve(bytes, format_args!("{count} vectors of a left kernel"))?;
        let additions = self.lower.iter().map(|row| row.len() as u64).sum::<u64>();
        let work = task.begin(
            self.dense.combination_products(count) + additions * count as u64 * SPARSE_WEIGHT,
        );
        let in_dense = Matrix::from_fn(count, free, |i, k| coefficients[(i, dense_free[k])]);
        let weights = self.dense.combined_left_weights(&in_dense, &work)?;

        let mut kernel = Matrix::new(count, self.rows, vec![0; count * self.rows]);
        let chunk = LANES * self.rows.max(1);
        kernel
            .data_mut()
            .par_chunks_mut(chunk)
            .enumerate()
            .try_for_each(|(block, out)| {
                let lanes = |value: &dyn Fn(usize) -> u64| {
                    let mut weight = [0; LANES];
                    for (weight, i) in weight.iter_mut().zip(block * LANES..count) {
                        *weight = value(i);
                    }
                    weight
                };
                let mut sums = vec![[0; LANES]; self.sparse.rank()];
                let spread = |sums: &mut [[u64; LANES]], row: usize, weight: &[u64; LANES]| {
                    for &(k, factor) in &self.lower[row] {
                        self.add_lanes(&mut sums[k], factor, weight);
                    }
                };
                for (at, &row) in self.free_rows.iter().enumerate() {
                    let weight = lanes(&|i| coefficients[(i, at)]);
                    spread(&mut sums, row, &weight);
                    self.store(out, self.rows, row, &weight);
                }
                for (k, &row) in self.dense.order()[..self.dense.rank()].iter().enumerate() {
                    let weight = lanes(&|i| weights[(i, k)]);
                    spread(&mut sums, self.dense_rows[row], &weight);
                    self.store(out, self.rows, self.dense_rows[row], &weight);
                }
                for (k, &row) in self.sparse.rows.iter().enumerate().rev() {
                    let weight = sums[k];
                    spread(&mut sums, row, &weight);
                    self.store(out, self.rows, row, &weight);
                }
                let vectors = LANES.min(count - block * LANES) as u64;
                work.done(additions * vectors * SPARSE_WEIGHT)
            })?;
        Ok(kernel)
    }

    /// A vector of the kernel: `random` says what it is at the free columns. `rows` are those of the
    /// matrix.
    ///
    /// # Panics
    /// If they are of another one.
    pub fn kernel_vector(&self, rows: &[SparseRow], mut random: impl FnMut() -> u64) -> Vec<u64> {
        let f = &self.field;
        let mut x = vec![0; self.cols];
        for &column in &self.free_cols {
            x[column] = random();
        }
        let side = |row: &SparseRow| {
            let terms = row.iter().map(|&(column, value)| f.times(value, x[column]));
            f.negate(terms.fold(0, |sum, term| f.plus(sum, term)))
        };
        let sides: Vec<u64> = rows.iter().map(side).collect();
        let pivots = self.solve(&sides).expect("a combination of columns");
        x.iter().zip(&pivots).map(|(a, b)| f.plus(*a, *b)).collect()
    }

    /// A solution x of A x = b, zero at the free columns; `None` if there is none.
    ///
    /// # Panics
    /// If `b` does not have one entry a row.
    pub fn solve(&self, b: &[u64]) -> Option<Vec<u64>> {
        assert_eq!(b.len(), self.rows, "one entry a row");
        let mut reduced = Vec::with_capacity(self.sparse.rank());
        let reduce = |row: usize, reduced: &[u64]| {
            let terms = self.lower[row]
                .iter()
                .map(|&(k, factor)| self.field.times(factor, reduced[k]));
            terms.fold(b[row], |sum, term| self.field.plus(sum, term))
        };
        for &row in &self.sparse.rows {
            let value = reduce(row, &reduced);
            reduced.push(value);
        }
        let rest: Vec<u64> = self
            .dense_rows
            .iter()
            .map(|&row| reduce(row, &reduced))
            .collect();
        let empty = self
            .free_rows
            .iter()
            .filter(|row| self.dense_rows.binary_search(row).is_err());
        if empty.into_iter().any(|&row| reduce(row, &reduced) != 0) {
            return None;
        }
        let dense = self.dense.solve(&rest)?;
        let mut x = vec![0; self.cols];
        for (&col, value) in self.dense_cols.iter().zip(dense) {
            x[col] = value;
        }
        for (k, &col) in self.sparse.cols.iter().enumerate().rev() {
            let terms = self.upper[k].iter();
            let terms = terms.map(|&(other, value)| self.field.times(value, x[other]));
            let rest = terms.fold(reduced[k], |rest, term| self.field.minus(rest, term));
            x[col] = self.field.times(rest, self.inverses[k]);
        }
        Some(x)
    }

    #[inline]
    fn add_lanes(&self, sum: &mut [u64; LANES], factor: u64, x: &[u64; LANES]) {
        for (sum, &x) in sum.iter_mut().zip(x) {
            *sum = self.field.plus(*sum, self.field.times(factor, x));
        }
    }

    /// Writes one entry of every vector that is there.
    fn store(&self, out: &mut [u64], length: usize, at: usize, lanes: &[u64; LANES]) {
        for (vector, &value) in out.chunks_exact_mut(length).zip(lanes) {
            vector[at] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::samples::{known_rank, multiply};
    use super::super::{prime::DEFAULT_PRIME, textbook};
    use super::*;
    use crate::watch::{Limits, Reason, Step, Watch};
    use proptest::prelude::*;
    use rand::{Rng, SeedableRng};

    fn sparse(m: &Matrix<u64>) -> Vec<SparseRow> {
        let row = |i: usize| {
            m.row(i)
                .iter()
                .copied()
                .enumerate()
                .filter(|&(_, x)| x != 0)
                .collect()
        };
        (0..m.rows()).map(row).collect()
    }

    fn verify(field: &PrimeField, m: &Matrix<u64>) -> Factorisation {
        let rank = textbook::eliminate(field, m).rank();
        let done = unwatched(|task| Factorisation::new(field, sparse(m), m.cols(), task));
        assert_eq!(done.rank(), rank);
        let pivots = done.pivots();
        let minor = m.submatrix(&pivots.rows, &pivots.cols);
        assert_eq!(textbook::eliminate(field, &minor).rank(), rank);

        let left = done.left_kernel();
        let transposed = m.transposed();
        assert_eq!(left.rows(), m.rows() - rank);
        for i in 0..left.rows() {
            assert!(
                multiply(field, &transposed, left.row(i))
                    .iter()
                    .all(|&x| x == 0)
            );
            for (k, &row) in done.free_rows().iter().enumerate() {
                assert_eq!(left[(i, row)], if i == k { field.one() } else { 0 });
            }
        }
        let vector = done.kernel_vector(&sparse(m), || field.from_u64(3));
        assert!(multiply(field, m, &vector).iter().all(|&x| x == 0));
        let free = done.free_cols();
        assert!(free.iter().all(|&col| vector[col] == field.from_u64(3)));
        let x: Vec<u64> = (0..m.cols() as u64)
            .map(|k| field.from_u64(k * k + 1))
            .collect();
        let mut b = multiply(field, m, &x);
        assert_eq!(multiply(field, m, &done.solve(&b).unwrap()), b);
        for &row in done.free_rows() {
            b[row] = field.add(&b[row], &field.one());
            assert_eq!(done.solve(&b), None);
            b[row] = field.sub(&b[row], &field.one());
        }
        done
    }

    /// Entries at random places; small values, so that entries cancel.
    fn scattered(
        field: &PrimeField,
        rows: usize,
        cols: usize,
        a_row: usize,
        seed: u64,
    ) -> Matrix<u64> {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let mut m = Matrix::new(rows, cols, vec![0; rows * cols]);
        for i in 0..rows {
            for _ in 0..a_row {
                let col = (rng.next_u64() % cols as u64) as usize;
                m[(i, col)] = field.from_i64((rng.next_u64() % 5) as i64 - 2);
            }
        }
        m
    }

    #[test]
    fn both_parts_are_used() {
        let field = PrimeField::mersenne61();
        let done = verify(&field, &scattered(&field, 260, 200, 4, 3));
        assert!(
            done.sparse.rank() > 100 && done.dense.rank() > 10,
            "{:?}",
            done.dense_size()
        );
    }

    #[test]
    fn the_dense_part_is_limited() {
        let field = PrimeField::mersenne61();
        let m = scattered(&field, 260, 200, 4, 3);
        let new = |task: &Task| Factorisation::new(&field, sparse(&m), 200, task);
        let (rows, cols) = unwatched(new).dense_size();
        let within = |limit| {
            unwatched(|task| Ok(Factorisation::within(&field, sparse(&m), 200, limit, task)))
        };
        assert!(within(rows * cols).is_ok());
        let refused = within(rows * cols - 1).unwrap_err();
        assert!(matches!(refused, Unfinished::TooLarge(r, c) if (r, c) == (rows, cols)));
    }

    #[test]
    fn a_forest_never_becomes_dense() {
        // Incidence matrix of a path: no fill at all.
        let field = PrimeField::mersenne61();
        let m = Matrix::from_fn(40, 41, |i, j| {
            field.from_i64(if j == i {
                1
            } else if j == i + 1 {
                -1
            } else {
                0
            })
        });
        let done = verify(&field, &m);
        assert_eq!(done.rank(), 40);
        assert_eq!(done.dense_size(), (0, 0));
    }

    #[test]
    fn empty() {
        let field = PrimeField::mersenne61();
        for (rows, cols) in [(0, 0), (0, 3), (3, 0), (2, 3)] {
            verify(&field, &Matrix::new(rows, cols, vec![0; rows * cols]));
        }
    }

    /// Some memory is enough for the sparse part and not for the dense one, less is not even
    /// enough for that; and an interrupt is noticed.
    #[test]
    fn memory_is_asked_for_and_interrupts_are_noticed() {
        let field = PrimeField::mersenne61();
        let mut random = rand_chacha::ChaCha20Rng::seed_from_u64(1);
        let rows: Vec<SparseRow> = (0..400)
            .map(|_| {
                let mut cols: Vec<usize> =
                    (0..6).map(|_| random.next_u64() as usize % 400).collect();
                cols.sort_unstable();
                cols.dedup();
                cols.into_iter()
                    .map(|col| (col, 1 + random.next_u64() % 1000))
                    .collect()
            })
            .collect();
        let within = |memory| {
            let watch = Watch::new(Limits {
                deadline: None,
                memory: Some(memory),
            });
            let task = watch.task(Step::Flows, 0);
            let done = Factorisation::within(&field, rows.clone(), 400, usize::MAX, &task);
            let account = |_| task.reserve(memory, format_args!("all")).is_ok();
            match done {
                Ok(done) => {
                    assert!(!account(()), "the factors are on the account");
                    drop(done);
                    assert!(account(()), "and then no more");
                    None
                }
                Err(Unfinished::Stopped(stopped)) => {
                    assert!(account(()), "nothing is left on the account");
                    match stopped.reason {
                        Reason::TooLarge { what, .. } => Some(what),
                        other => panic!("{other:?}"),
                    }
                }
                Err(other) => panic!("{other:?}"),
            }
        };
        assert_eq!(within(1 << 30), None);
        assert!(within(60_000).is_some_and(|what| what.contains("sparse matrix")));
        let new = |task: &Task| Factorisation::new(&field, rows.clone(), 400, task);
        let (height, width) = unwatched(new).dense_size();
        assert!(height > 100 && width > 100, "{height} x {width}");
        // Just above what the sparse part takes.
        let mut limits = (0..200).map(|k| 60_000 + k * matrix_bytes(height, width) / 10);
        let refused = limits.find_map(|limit| within(limit).filter(|what| what.contains("rest")));
        assert!(refused.is_some_and(|what| what.contains("the dense rest")));

        let watch = Watch::new(Limits::default());
        watch.interrupt();
        let task = watch.task(Step::Flows, 0);
        let done = Factorisation::within(&field, rows.clone(), 400, usize::MAX, &task);
        assert!(matches!(done, Err(Unfinished::Stopped(_))));
        let done = unwatched(new);
        let one = Matrix::from_fn(1, done.free_rows().len(), |_, _| field.one());
        assert!(done.left_combinations(&one, &task).is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn scattered_matrices(
            rows in 1..60usize, cols in 1..60usize, a_row in 1..6usize, seed: u64, small: bool,
        ) {
            let p = if small { 5 } else { DEFAULT_PRIME };
            let field = PrimeField::new(p).unwrap();
            verify(&field, &scattered(&field, rows, cols, a_row, seed));
        }

        #[test]
        fn known_ranks(rank in 0..20usize, rows in 0..20usize, cols in 0..20usize, seed: u64) {
            let field = PrimeField::new(7).unwrap();
            let m = known_rank(&field, rank + rows, rank + cols, rank, seed, 1);
            prop_assert_eq!(verify(&field, &m).rank(), rank);
        }
    }
}
