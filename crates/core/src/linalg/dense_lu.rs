//! Dense elimination modulo a prime, in blocks.
//!
//! The matrix is factorised in panels of 64 columns. A panel is eliminated column
//! by column, each entry by one dot product with everything already known (Crout); the
//! columns to its right then receive all of the panel's pivots at once, as a matrix
//! product in cache-sized tiles. Either way sums are reduced once, not term by term.

use crate::linalg::Ring;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::product::Product;
use crate::linalg::textbook::Pivots;
#[cfg(test)]
use crate::watch::unwatched;
use crate::watch::{Stopped, Task, Work};
use rayon::prelude::*;

/// Columns of a panel: enough products to hide the reduction of their sum, few enough for a
/// tile of the product to stay in the first-level cache.
const PANEL: usize = 64;

/// A matrix modulo p with its elimination: for the rows in a suitable order, the matrix
/// is L U with L unit lower trapezoidal and U in row echelon form.
#[derive(Clone, Debug)]
pub struct Echelon {
    field: PrimeField,
    /// Original rows in factorised order: first those of the pivots.
    order: Vec<usize>,
    pivot_cols: Vec<usize>,
    /// U, and in the pivot columns below the pivots the entries of -L.
    factors: Matrix<u64>,
}

/// Eliminates a matrix modulo p. Rank-deficient matrices, and panels, are welcome; the
/// pivot columns are those independent of the columns to their left.
///
/// O(rows * cols * rank) multiply-accumulates; the products with large panels are
/// shared among the threads of the current rayon pool. The result does not depend on
/// the number of threads.
///
/// # Errors
/// If the task was stopped.
pub fn eliminate_mod(
    field: &PrimeField,
    mut m: Matrix<u64>,
    task: &Task,
) -> Result<Echelon, Stopped> {
    let (rows, cols) = (m.rows(), m.cols());
    let work = task.begin(elimination_products(rows, cols));
    let mut order: Vec<usize> = (0..rows).collect();
    let mut pivot_cols = Vec::with_capacity(rows.min(cols));
    let mut panel = Panel {
        values: Vec::new(),
        width: PANEL.min(cols),
        upper: Vec::new(),
    };
    let mut packed = Vec::new();
    let mut start = 0;
    while start < cols && pivot_cols.len() < rows {
        let base = pivot_cols.len();
        let end = cols.min(start + PANEL);
        panel.eliminate(field, &mut m, &mut order, &mut pivot_cols, start..end);
        let found = pivot_cols.len() - base;
        let units = panel_products(rows, cols, start);
        if found > 0 && end < cols {
            let (head, tail) = m.data_mut().split_at_mut((base + found) * cols);
            packed.clear();
            pack_solved(
                field,
                &mut head[base * cols..],
                cols,
                end,
                &panel,
                found,
                &mut packed,
            );
            let lower = &panel.values[found * panel.width..];
            let product = Product {
                depth: found,
                factors: lower,
                stride: panel.width,
            };
            product.add_to(field, tail, cols, end, &packed, (&work, units));
            work.done(0)?;
        } else {
            work.done(units)?;
        }
        start = end;
    }
    Ok(Echelon {
        field: *field,
        order,
        pivot_cols,
        factors: m,
    })
}

/// The multiply-accumulates for the panel from column `start` on, if every column before it has a
/// pivot.
fn panel_products(rows: usize, cols: usize, start: usize) -> u64 {
    let (height, width) = (rows.saturating_sub(start), cols - start);
    height as u64 * width as u64 * PANEL as u64
}

/// The multiply-accumulates of an elimination, if every column has a pivot.
pub(crate) fn elimination_products(rows: usize, cols: usize) -> u64 {
    let panels = (0..cols).step_by(PANEL);
    panels.map(|start| panel_products(rows, cols, start)).sum()
}

/// Working space of one panel, reused by the next.
struct Panel {
    /// The rows from the first that is not a pivot of an earlier panel on, each with
    /// the negated multipliers of this panel's pivots in front; what has not been
    /// eliminated yet stands at its column's own place, which is never further left.
    values: Vec<u64>,
    width: usize,
    /// The pivot rows' entries in the column at hand.
    upper: Vec<u64>,
}

impl Panel {
    fn eliminate(
        &mut self,
        field: &PrimeField,
        m: &mut Matrix<u64>,
        order: &mut [usize],
        pivot_cols: &mut Vec<usize>,
        range: std::ops::Range<usize>,
    ) {
        let base = pivot_cols.len();
        let height = m.rows() - base;
        let width = self.width;
        self.values.clear();
        for row in base..m.rows() {
            self.values.extend_from_slice(&m.row(row)[range.clone()]);
            self.values.resize((row - base + 1) * width, 0);
        }
        for (local, col) in range.clone().enumerate() {
            let found = pivot_cols.len() - base;
            self.upper.clear();
            for k in 0..found {
                let row = &self.values[k * width..(k + 1) * width];
                let value = field.dot(row[local], &row[..k], &self.upper);
                self.upper.push(value);
                m[(base + k, col)] = value;
            }
            let mut pivot = None;
            for (k, row) in self.values.chunks_exact_mut(width).enumerate().skip(found) {
                row[local] = field.dot(row[local], &row[..found], &self.upper);
                if pivot.is_none() && row[local] != 0 {
                    pivot = Some(k);
                }
            }
            let Some(pivot) = pivot else {
                for row in base + found..m.rows() {
                    m[(row, col)] = 0;
                }
                continue;
            };
            m.swap_rows(base + found, base + pivot);
            order.swap(base + found, base + pivot);
            if pivot != found {
                let (head, tail) = self.values.split_at_mut(pivot * width);
                head[found * width..][..width].swap_with_slice(&mut tail[..width]);
            }
            let value = self.values[found * width + local];
            m[(base + found, col)] = value;
            let inverse = field
                .inverse(value)
                .unwrap_or_else(|| unreachable!("a pivot is not zero"));
            let negated = field.negate(inverse);
            for k in found + 1..height {
                let row = &mut self.values[k * width..(k + 1) * width];
                row[found] = field.times(row[local], negated);
            }
            pivot_cols.push(col);
        }
        let found = pivot_cols.len() - base;
        for k in 0..height {
            let multipliers = &self.values[k * width..][..found.min(k)];
            let row = m.row_mut(base + k);
            for (&value, &col) in multipliers.iter().zip(&pivot_cols[base..]) {
                row[col] = value;
            }
        }
    }
}

/// Finishes the `found` pivot rows in the columns from `start` on, and packs them by
/// groups of four columns: entry `k` of group `g` holds the columns `start + 4 g ..` of
/// pivot row `k`, zeros beyond the last column.
fn pack_solved(
    field: &PrimeField,
    pivot_rows: &mut [u64],
    cols: usize,
    start: usize,
    panel: &Panel,
    found: usize,
    packed: &mut Vec<[u64; 4]>,
) {
    for group in (start..cols).step_by(4) {
        let lanes = 4.min(cols - group);
        let first = packed.len();
        for k in 0..found {
            let entries = &mut pivot_rows[k * cols + group..][..lanes];
            let mut four = [0; 4];
            four[..lanes].copy_from_slice(entries);
            let multipliers = &panel.values[k * panel.width..][..k];
            let solved = field.dot4(four, multipliers, &packed[first..]);
            entries.copy_from_slice(&solved[..lanes]);
            packed.push(solved);
        }
    }
}

impl Echelon {
    /// The rank modulo p.
    pub fn rank(&self) -> usize {
        self.pivot_cols.len()
    }

    /// Rows and columns of a minor that is not zero.
    pub fn pivots(&self) -> Pivots {
        Pivots {
            rows: self.order[..self.rank()].to_vec(),
            cols: self.pivot_cols.clone(),
        }
    }

    /// The rows that are not pivots, in factorised order.
    pub fn free_rows(&self) -> &[usize] {
        &self.order[self.rank()..]
    }

    /// A basis of the left kernel, one row for each row in [`free_rows`](Self::free_rows):
    /// one at that row, zero at the other free rows.
    /// O(rank^2) multiply-accumulates a vector.
    #[cfg(test)]
    pub(crate) fn left_kernel(&self) -> Matrix<u64> {
        let rank = self.rank();
        let free: Vec<usize> = (rank..self.order.len()).collect();
        let weights = self.left_weights(&free);
        let mut kernel = Matrix::new(
            free.len(),
            self.order.len(),
            vec![0; free.len() * self.order.len()],
        );
        for i in 0..free.len() {
            let row = kernel.row_mut(i);
            row[self.order[rank + i]] = self.field.one();
            for (&original, &weight) in self.order.iter().zip(weights.row(i)) {
                row[original] = weight;
            }
        }
        kernel
    }

    /// For each of the given positions in factorised order, none of a pivot: the weights
    /// of the pivot rows, in pivot order, that make their sum with that row zero.
    #[cfg(test)]
    pub(crate) fn left_weights(&self, positions: &[usize]) -> Matrix<u64> {
        let mut weights = Matrix::from_fn(positions.len(), self.rank(), |i, k| {
            self.factors[(positions[i], self.pivot_cols[k])]
        });
        // Unknown k meets column k of -L below the diagonal: w_k = r_k + sum w_l (-L)_lk.
        let entry = |k: usize, l: usize| self.factors[(k, self.pivot_cols[l])];
        unwatched(|task| self.solve_backwards(&mut weights, entry, &task.begin(0)));
        weights
    }

    /// The original rows in factorised order, pivots first.
    pub(crate) fn order(&self) -> &[usize] {
        &self.order
    }

    /// A basis of the right kernel, one row for each column that is not a pivot,
    /// ascending: one at that column, zero at the other free columns.
    /// O(rank * columns) multiply-accumulates a vector.
    pub fn right_kernel(&self) -> Matrix<u64> {
        let cols = self.factors.cols();
        let free = self.pivots().free_cols(cols);
        let inverses = self.inverses();
        let mut kernel = Matrix::new(free.len(), cols, vec![0; free.len() * cols]);
        let vectors = kernel.data_mut().par_chunks_mut(cols.max(1));
        vectors.zip(&free).for_each(|(x, &col)| {
            x[col] = self.field.one();
            self.solve_upper(&inverses, x, |_| 0);
        });
        kernel
    }

    /// For each of the given linear combinations of the free rows: the weights of the pivot rows,
    /// in pivot order, that make their sum with it zero:
    /// `coefficients` has a row for each combination and a column for each free row, in
    /// factorised order. So many units of `work` are done as
    /// [`combination_products`](Self::combination_products) says.
    pub(crate) fn combined_left_weights(
        &self,
        coefficients: &Matrix<u64>,
        work: &Work,
    ) -> Result<Matrix<u64>, Stopped> {
        let rank = self.rank();
        let columns: Vec<Vec<u64>> = self
            .pivot_cols
            .iter()
            .map(|&col| {
                (rank..self.order.len())
                    .map(|i| self.factors[(i, col)])
                    .collect()
            })
            .collect();
        let count = coefficients.rows();
        let mut weights = Matrix::new(count, rank, vec![0; count * rank]);
        for i in 0..count {
            for (weight, column) in weights.row_mut(i).iter_mut().zip(&columns) {
                *weight = self.field.dot(0, coefficients.row(i), column);
            }
            work.done((rank * coefficients.cols()) as u64)?;
        }
        let entry = |k: usize, l: usize| self.factors[(k, self.pivot_cols[l])];
        self.solve_backwards(&mut weights, entry, work)?;
        Ok(weights)
    }

    /// The multiply-accumulates for so many combinations of the free rows, about.
    pub(crate) fn combination_products(&self, count: usize) -> u64 {
        let rank = self.rank();
        let free = self.order.len() - rank;
        let blocks = (0..rank).step_by(PANEL);
        let backwards: u64 = blocks.map(|start| (start * PANEL) as u64).sum();
        count as u64 * ((rank * free) as u64 + backwards)
    }

    /// A solution x of A x = b, zero at the columns that are not pivots; `None` if there
    /// is no solution. O(rows * rank) multiply-accumulates.
    ///
    /// # Panics
    /// If `b` does not have one entry a row.
    pub fn solve(&self, b: &[u64]) -> Option<Vec<u64>> {
        assert_eq!(b.len(), self.order.len(), "one entry a row");
        let rank = self.rank();
        let mut reduced: Vec<u64> = Vec::with_capacity(rank);
        let mut multipliers = Vec::with_capacity(rank);
        for (i, &row) in self.order.iter().enumerate() {
            let known = i.min(rank);
            multipliers.clear();
            multipliers.extend(
                self.pivot_cols[..known]
                    .iter()
                    .map(|&col| self.factors[(i, col)]),
            );
            let value = self.field.dot(b[row], &multipliers, &reduced);
            if i < rank {
                reduced.push(value);
            } else if value != 0 {
                return None;
            }
        }
        let mut x = vec![0; self.factors.cols()];
        self.solve_upper(&self.inverses(), &mut x, |k| reduced[k]);
        Some(x)
    }

    /// The inverses of the pivots.
    fn inverses(&self) -> Vec<u64> {
        let pivots = self.pivot_cols.iter().enumerate();
        let mut inverses: Vec<u64> = pivots.map(|(k, &col)| self.factors[(k, col)]).collect();
        self.field.invert_all(&mut inverses);
        inverses
    }

    /// Fills in the pivots' entries of an x with U x = `right`, last pivot first.
    fn solve_upper(&self, inverses: &[u64], x: &mut [u64], right: impl Fn(usize) -> u64) {
        for (k, &pivot) in self.pivot_cols.iter().enumerate().rev() {
            let (row, behind) = (self.factors.row(k), pivot + 1);
            let sum = self.field.dot(0, &row[behind..], &x[behind..]);
            x[pivot] = self
                .field
                .times(self.field.minus(right(k), sum), inverses[k]);
        }
    }

    /// From the last unknown down: x_l = r_l + sum_(k > l) x_k entry(k, l),
    /// for every row r at once, in blocks.
    fn solve_backwards(
        &self,
        rows: &mut Matrix<u64>,
        entry: impl Fn(usize, usize) -> u64,
        work: &Work,
    ) -> Result<(), Stopped> {
        let rank = self.rank();
        if rows.rows() == 0 || rank == 0 {
            return Ok(());
        }
        let mut packed = Vec::new();
        let mut block = Vec::new();
        let starts: Vec<usize> = (0..rank).step_by(PANEL).collect();
        for &start in starts.iter().rev() {
            let end = rank.min(start + PANEL);
            let depth = end - start;
            let triangle: Vec<Vec<u64>> = (start..end)
                .map(|l| (l + 1..end).map(|k| entry(k, l)).collect())
                .collect();
            block.clear();
            for i in 0..rows.rows() {
                let row = rows.row_mut(i);
                for l in (start..end).rev() {
                    let sum = self
                        .field
                        .dot(row[l], &triangle[l - start], &row[l + 1..end]);
                    row[l] = sum;
                }
                block.extend_from_slice(&row[start..end]);
            }
            packed.clear();
            for group in (0..start).step_by(4) {
                packed.extend((start..end).map(|k| {
                    std::array::from_fn(|lane| {
                        if group + lane < start {
                            entry(k, group + lane)
                        } else {
                            0
                        }
                    })
                }));
            }
            let cols = rows.cols();
            let product = Product {
                factors: &block,
                stride: depth,
                depth,
            };
            // The padding of the last group adds zeros to columns that are solved.
            let units = (rows.rows() * start * PANEL) as u64;
            product.add_to(
                &self.field,
                rows.data_mut(),
                cols,
                0,
                &packed,
                (work, units),
            );
            work.done(0)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::prime::{DEFAULT_PRIME, SMALL_PRIME};
    use super::super::tests::samples::{known_rank, multiply};
    use super::super::textbook;
    use super::*;
    use proptest::prelude::*;

    const MODULI: [u64; 6] = [
        5,
        7,
        SMALL_PRIME,
        (1 << 31) - 1,
        DEFAULT_PRIME,
        4_611_686_018_427_387_847,
    ];

    /// Everything an elimination claims, verified by multiplication and by the textbook.
    fn verify(field: &PrimeField, m: &Matrix<u64>, rank: usize) {
        let done = unwatched(|task| eliminate_mod(field, m.clone(), task));
        let pivots = done.pivots();
        assert_eq!(done.rank(), rank);
        assert_eq!(pivots.cols, textbook::eliminate(field, m).cols);
        let minor = m.submatrix(&pivots.rows, &pivots.cols);
        assert_eq!(textbook::eliminate(field, &minor).rank(), rank);

        let right = done.right_kernel();
        assert_eq!(right.rows(), m.cols() - rank);
        for (s, free) in pivots.free_cols(m.cols()).into_iter().enumerate() {
            assert!(multiply(field, m, right.row(s)).iter().all(|&x| x == 0));
            for (t, other) in pivots.free_cols(m.cols()).into_iter().enumerate() {
                assert_eq!(right[(s, other)] == field.one(), s == t);
            }
            assert_eq!(right[(s, free)], field.one());
        }
        let left = done.left_kernel();
        let transposed = m.transposed();
        assert_eq!(left.rows(), m.rows() - rank);
        for (i, &free) in done.free_rows().iter().enumerate() {
            assert!(
                multiply(field, &transposed, left.row(i))
                    .iter()
                    .all(|&x| x == 0)
            );
            for &other in done.free_rows() {
                assert_eq!(
                    left[(i, other)],
                    if other == free { field.one() } else { 0 }
                );
            }
        }

        let x: Vec<u64> = (0..m.cols() as u64)
            .map(|k| field.from_u64(k * k + 1))
            .collect();
        let mut b = multiply(field, m, &x);
        let solution = done.solve(&b).expect("solvable by construction");
        assert_eq!(multiply(field, m, &solution), b);
        if let Some(&row) = done.free_rows().first() {
            b[row] = field.add(&b[row], &field.one());
            assert_eq!(done.solve(&b), None);
        }
    }

    #[test]
    fn sizes_around_panels_and_tiles() {
        // Full and deficient rank, wide and tall, one panel and several, with a rank
        // that does and does not end at a panel's border.
        let cases = [
            (1, 1, 1),
            (1, 1, 0),
            (30, 30, 30),
            (64, 64, 64),
            (65, 65, 64),
            (66, 63, 63),
            (130, 140, 128),
            (140, 131, 129),
            (200, 70, 20),
            (70, 200, 20),
            (150, 97, 97),
        ];
        for p in [7, SMALL_PRIME, DEFAULT_PRIME, 4_611_686_018_427_387_847] {
            let field = PrimeField::new(p).unwrap();
            for (seed, (rows, cols, rank)) in cases.into_iter().enumerate() {
                let size = i64::MAX as u64 / 4;
                let m = known_rank(&field, rows, cols, rank, seed as u64, size);
                verify(&field, &m, rank);
            }
        }
    }

    #[test]
    fn empty() {
        let field = PrimeField::mersenne61();
        verify(&field, &Matrix::new(0, 3, vec![]), 0);
        verify(&field, &Matrix::new(3, 0, vec![]), 0);
        verify(&field, &Matrix::new(2, 3, vec![0; 6]), 0);
    }

    #[test]
    fn threads_do_not_change_the_result() {
        for p in [SMALL_PRIME, DEFAULT_PRIME] {
            let field = PrimeField::new(p).unwrap();
            one_thread_and_three(&field);
        }
    }

    fn one_thread_and_three(field: &PrimeField) {
        let m = known_rank(field, 300, 280, 270, 1, 1 << 60);
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| unwatched(|task| eliminate_mod(field, m.clone(), task)))
        };
        let (one, three) = (run(1), run(3));
        assert_eq!(one.rank(), 270);
        assert_eq!(one.factors, three.factors);
        assert_eq!(one.order, three.order);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn known_ranks(
            which in 0..MODULI.len(), rank in 0..40usize,
            more_rows in 0..40usize, more_cols in 0..40usize, seed: u64,
        ) {
            let field = PrimeField::new(MODULI[which]).unwrap();
            let m = known_rank(&field, rank + more_rows, rank + more_cols, rank, seed, 1 << 40);
            verify(&field, &m, rank);
        }
    }
}
