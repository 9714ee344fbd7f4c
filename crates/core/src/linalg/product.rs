//! The matrix product modulo a prime that all dense elimination comes down to.

use crate::linalg::prime::{PrimeField, SMALL_PRODUCTS, low};
use crate::watch::Work;
use rayon::prelude::*;

/// Columns of a tile, in groups of four: with 64 rows 16 KiB, which stay in the first-level cache.
const TILE: usize = 8;

/// Columns of a tile modulo a prime below 2^29.
const WIDE: usize = 128;

/// Below this many products a matrix product is not worth sharing among threads.
const PARALLEL_PRODUCTS: usize = 1 << 19;

/// So many products are done without asking whether they are still wanted: some 50 ms at most.
const UNASKED_PRODUCTS: usize = 1 << 26;

/// The left factor of a matrix product: rows of `depth` entries, `stride` apart.
pub(super) struct Product<'a> {
    pub factors: &'a [u64],
    pub stride: usize,
    pub depth: usize,
}

impl Product<'_> {
    /// Adds the product with the packed right factor to the columns from `start` on of
    /// the rows in `target`, which have `cols` columns. `packed` holds `depth` entries
    /// for each group of four columns; columns beyond its last group stay as they are.
    ///
    /// About so many units of the work are done. If it is stopped the target is left half done, and
    /// the next call of [`Work::done`] says so.
    pub(super) fn add_to(
        &self,
        field: &PrimeField,
        target: &mut [u64],
        cols: usize,
        start: usize,
        packed: &[[u64; 4]],
        (work, units): (&Work, u64),
    ) {
        if target.is_empty() || packed.is_empty() {
            return;
        }
        let rows = target.len() / cols;
        let a_row = units / rows as u64;
        let chunk = |(target, factors): (&mut [u64], &[u64])| {
            if work.is_stopped() {
                return;
            }
            let share = a_row * (target.len() / cols) as u64;
            let left = Product { factors, ..*self };
            let chunk = Chunk {
                field,
                left,
                target,
                cols,
                start,
                packed,
            };
            chunk.dispatch();
            // If this fails, so does the caller's next one.
            let _ = work.done(share);
        };
        let threads = rayon::current_num_threads();
        let products = packed.len() * 4;
        let most = (UNASKED_PRODUCTS / products).max(1);
        if threads > 1 && rows * products >= PARALLEL_PRODUCTS {
            // A few chunks a thread even out what else the machine is doing.
            let height = rows.div_ceil(4 * threads).clamp(1, most);
            target
                .par_chunks_mut(height * cols)
                .zip(self.factors.par_chunks(height * self.stride))
                .for_each(chunk);
        } else {
            target
                .chunks_mut(most * cols)
                .zip(self.factors.chunks(most * self.stride))
                .for_each(chunk);
        }
    }
}

/// Some rows of the product, to be compiled for every vector unit that there may be and chosen
/// when it runs.
struct Chunk<'a> {
    field: &'a PrimeField,
    left: Product<'a>,
    target: &'a mut [u64],
    cols: usize,
    start: usize,
    packed: &'a [[u64; 4]],
}

#[cfg(feature = "simd")]
impl pulp::WithSimd for Chunk<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.run();
    }
}

impl Chunk<'_> {
    #[cfg(feature = "simd")]
    fn dispatch(self) {
        pulp::Arch::new().dispatch(self);
    }

    #[cfg(not(feature = "simd"))]
    fn dispatch(self) {
        self.run();
    }

    #[inline(always)]
    fn run(self) {
        if self.field.is_small() {
            self.add_small();
        } else {
            self.add();
        }
    }

    #[inline(always)]
    fn add(self) {
        let depth = self.left.depth;
        for (tile, packed) in self.packed.chunks(TILE * depth).enumerate() {
            let begin = self.start + tile * TILE * 4;
            let range = begin..self.cols.min(begin + TILE * 4);
            let rows = self.target.chunks_exact_mut(self.cols);
            for (row, factors) in rows.zip(self.left.factors.chunks(self.left.stride)) {
                let groups = row[range.clone()].chunks_mut(4);
                for (entries, packed) in groups.zip(packed.chunks_exact(depth)) {
                    let mut four = [0; 4];
                    four[..entries.len()].copy_from_slice(entries);
                    let sums = self.field.dot4(four, &factors[..depth], packed);
                    entries.copy_from_slice(&sums[..entries.len()]);
                }
            }
        }
    }

    /// The same for a modulus below 2^29: whole rows of a tile at a time, four of them at once,
    /// which is what compilers turn into vector instructions. Sums of [`SMALL_PRODUCTS`] fit into a
    /// word.
    #[inline(always)]
    fn add_small(self) {
        let depth = self.left.depth;
        assert!(depth <= SMALL_PRODUCTS, "a sum of {depth} products");
        let mut tile = vec![[0; WIDE]; depth.next_multiple_of(4)];
        for (k, packed) in self.packed.chunks(WIDE / 4 * depth).enumerate() {
            for (group, entries) in packed.chunks_exact(depth).enumerate() {
                for (row, four) in tile.iter_mut().zip(entries) {
                    row[4 * group..][..4].copy_from_slice(four);
                }
            }
            let begin = self.start + k * WIDE;
            let range = begin..self.cols.min(begin + 4 * packed.len() / depth);
            let rows = self.target.chunks_exact_mut(self.cols);
            for (row, factors) in rows.zip(self.left.factors.chunks(self.left.stride)) {
                let mut own = [0; SMALL_PRODUCTS];
                own[..depth].copy_from_slice(&factors[..depth]);
                let mut sums = [0u64; WIDE];
                for (f, rows) in own.chunks_exact(4).zip(tile.chunks_exact(4)) {
                    for (k, sum) in sums.iter_mut().enumerate() {
                        let products = (0..4).map(|i| low(f[i]) * low(rows[i][k]));
                        *sum = products.fold(*sum, u64::wrapping_add);
                    }
                }
                for (entry, sum) in row[range.clone()].iter_mut().zip(sums) {
                    *entry = self.field.plus(*entry, self.field.redc_word(sum));
                }
            }
        }
    }
}
