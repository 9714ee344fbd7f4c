//! Arithmetic modulo a prime, and elimination: sparse with prescribed or found pivots, and dense along the diagonal.

use crate::rejection::{Checked, ensure};
use std::ops::{Add, Mul};
use std::sync::Mutex;

/// What the paper's Jacobian needs of its entries.
pub(crate) trait Ring {
    type E: Copy;
    fn add(&self, a: Self::E, b: Self::E) -> Self::E;
    fn sub(&self, a: Self::E, b: Self::E) -> Self::E;
    fn mul(&self, a: Self::E, b: Self::E) -> Self::E;
}

/// Integers so small that 128 bits are enough (`cameras::integer` says why).
pub(crate) struct Integers;

impl Ring for Integers {
    type E = i128;
    fn add(&self, a: i128, b: i128) -> i128 {
        a + b
    }
    fn sub(&self, a: i128, b: i128) -> i128 {
        a - b
    }
    fn mul(&self, a: i128, b: i128) -> i128 {
        a * b
    }
}

/// The field of p elements, 5 <= p < 2^62. Elements are below p, in Montgomery form: x is stored as x 2^64 mod p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub p: u64,
    /// -1 / p modulo 2^64.
    negative_inverse: u64,
    pub one: u64,
}

/// How many products are summed before one reduction: in 128 bits, or in 64 if p is below `SMALL`.
const LANES: usize = 12;
const SMALL_LANES: usize = 64;
const SMALL: u64 = 1 << 29;

/// Columns and rows that are computed together.
const TILE: usize = 64;
const GROUP: usize = 16;

impl Ring for Field {
    type E = u64;
    fn add(&self, a: u64, b: u64) -> u64 {
        self.below(a + b)
    }
    fn sub(&self, a: u64, b: u64) -> u64 {
        let difference = a.wrapping_sub(b);
        difference.min(difference.wrapping_add(self.p))
    }
    fn mul(&self, a: u64, b: u64) -> u64 {
        self.below(self.reduce(u128::from(a) * u128::from(b)))
    }
}

impl Field {
    pub fn new(p: u64) -> Checked<Field> {
        ensure!(
            (5..1 << 62).contains(&p) && is_prime(p),
            "{p} is not a prime with 5 <= p < 2^62"
        );
        Ok(Field::odd(p))
    }

    /// The ring modulo an odd number below 2^62; a field if it is prime.
    fn odd(p: u64) -> Field {
        // Newton's iteration doubles the correct bits: 3, 6, 12, 24, 48, 96.
        let inverse = (0..5).fold(p, |x, _| {
            x.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(x)))
        });
        Field {
            p,
            negative_inverse: inverse.wrapping_neg(),
            one: ((1 << 64) % u128::from(p)) as u64,
        }
    }

    /// The element with this residue (any integer is fine).
    pub fn element(&self, residue: u64) -> u64 {
        ((u128::from(residue) << 64) % u128::from(self.p)) as u64
    }

    pub fn signed(&self, value: i128) -> u64 {
        self.element(value.rem_euclid(i128::from(self.p)) as u64)
    }

    pub fn neg(&self, a: u64) -> u64 {
        self.sub(0, a)
    }

    /// Subtracts p once if that is possible, without a branch.
    fn below(&self, a: u64) -> u64 {
        a.min(a.wrapping_sub(self.p))
    }

    /// t / 2^64 modulo p, below t / 2^64 + p. Needs t + 2^64 p < 2^128: t <= 12 p^2 < 2^128 - 2^126 is small enough.
    fn reduce(&self, t: u128) -> u64 {
        let factor = (t as u64).wrapping_mul(self.negative_inverse);
        ((t + u128::from(factor) * u128::from(self.p)) >> 64) as u64
    }

    /// a + a sum of at most `LANES` products (or `SMALL_LANES`, if p < 2^29): one reduction, to below p + 12 p^2 / 2^64 < 4 p
    /// (or to p at most).
    fn add_products(&self, a: u64, products: u128) -> u64 {
        let sum = self.reduce(products);
        self.add(a, self.below(sum.min(sum.wrapping_sub(2 * self.p))))
    }

    fn pow(&self, base: u64, exponent: u64) -> u64 {
        (0..64).rev().fold(self.one, |power, bit| {
            let square = self.mul(power, power);
            if exponent >> bit & 1 == 1 {
                self.mul(square, base)
            } else {
                square
            }
        })
    }

    /// The inverse; 0 for 0.
    pub fn inverse(&self, a: u64) -> u64 {
        self.pow(a, self.p - 2)
    }
}

/// Whether p < 2^62 is prime: Miller-Rabin with the first twelve primes as bases decides (Sorenson and Webster, 2017).
pub(crate) fn is_prime(p: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if p < 2 || BASES.iter().any(|&base| p.is_multiple_of(base)) {
        return BASES.contains(&p);
    }
    let ring = Field::odd(p);
    let (twos, minus_one) = ((p - 1).trailing_zeros(), ring.neg(ring.one));
    BASES.iter().all(|&base| {
        let odd_power = ring.pow(ring.element(base), (p - 1) >> twos);
        let mut powers =
            std::iter::successors(Some(odd_power), |&power| Some(ring.mul(power, power)));
        odd_power == ring.one
            || powers
                .by_ref()
                .take(twos as usize)
                .any(|power| power == minus_one)
    })
}

/// Independent rows of a matrix, in the order in which they came, as a product L U.
pub(crate) struct Echelon<'f> {
    field: &'f Field,
    width: usize,
    rows: Vec<EchelonRow>,
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
    pub fn new(field: &'f Field, width: usize) -> Self {
        Echelon {
            field,
            width,
            rows: Vec::new(),
        }
    }

    /// Adds a row unless it vanishes at the prescribed pivot (or altogether) once it is reduced by the rows before it.
    pub fn push(
        &mut self,
        entries: impl IntoIterator<Item = (usize, u64)>,
        pivot: Option<usize>,
    ) -> bool {
        let (field, mut row) = (self.field, vec![0; self.width]);
        entries
            .into_iter()
            .for_each(|(column, value)| row[column] = field.add(row[column], value));
        let multiples = self.reduce(&mut row);
        let pivot = pivot.or_else(|| row.iter().position(|&entry| entry != 0));
        let Some(pivot) = pivot.filter(|&pivot| row[pivot] != 0) else {
            return false;
        };
        let inverse = field.inverse(row[pivot]);
        let columns = (0..self.width).filter(|&column| row[column] != 0);
        let reduced = columns
            .map(|column| (column, field.mul(inverse, row[column])))
            .collect();
        self.rows.push(EchelonRow {
            pivot,
            reduced,
            multiples,
            inverse,
        });
        true
    }

    /// Subtracts multiples of the rows of U so that a row vanishes at the pivots; returns the multiples.
    fn reduce(&self, row: &mut [u64]) -> Vec<(usize, u64)> {
        let mut multiples = Vec::new();
        for (k, EchelonRow { pivot, reduced, .. }) in self.rows.iter().enumerate() {
            let multiple = row[*pivot];
            if multiple != 0 {
                multiples.push((k, multiple));
                subtract(self.field, row, multiple, reduced);
            }
        }
        multiples
    }

    /// The combination of the matrix's rows that is the given row at the pivots; of the given row the difference is left.
    pub fn solve(&self, row: &mut [u64]) -> Vec<u64> {
        let mut solution = vec![0; self.rows.len()];
        self.reduce(row)
            .into_iter()
            .for_each(|(k, multiple)| solution[k] = multiple);
        for (
            k,
            EchelonRow {
                multiples, inverse, ..
            },
        ) in self.rows.iter().enumerate().rev()
        {
            let multiple = self.field.mul(solution[k], *inverse);
            solution[k] = multiple;
            subtract(self.field, &mut solution, multiple, multiples);
        }
        solution
    }
}

fn subtract(field: &Field, row: &mut [u64], multiple: u64, entries: &[(usize, u64)]) {
    let factor = field.neg(multiple);
    entries
        .iter()
        .for_each(|&(at, value)| row[at] = field.add(row[at], field.mul(factor, value)));
}

/// Works on all items, some at a time, with more threads if there are so many that it is worth their start.
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

/// Sees that elimination along the diagonal of a square matrix meets no zero. Rows are subtracted in blocks.
pub(crate) fn check_diagonal(field: &Field, mut rows: &mut [Vec<u64>]) -> Checked<()> {
    let height = if field.p < SMALL { SMALL_LANES } else { LANES };
    for first in (0..rows.len()).step_by(height) {
        let (block, rest) = rows.split_at_mut(height.min(rows.len()));
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

/// Subtracts multiples of rows of a block so that other rows would vanish at their pivots, the columns from `first` on; computes
/// what is right of these.
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
