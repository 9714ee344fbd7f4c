//! The rank of a large integer matrix, exactly, by way of a prime.
//!
//! Elimination modulo p finds a minor that is not zero: the rank over Q is at least r, a
//! proof by itself ([`RankAtLeast`]). That it is no more is proved by as many independent
//! kernel vectors over Z as are missing, each verified by multiplication ([`RankExact`]).
//! The vectors come from p-adic lifting (Dixon, Numer. Math. 40, 1982) and rational
//! reconstruction, at a fraction of the cost of fraction-free elimination.

use crate::linalg::bareiss::primitive;
use crate::linalg::dense_lu::{Echelon, eliminate_mod};
use crate::linalg::integer::{Euclid, Integer, One, Signed, Zero};
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::{DEFAULT_PRIME, PrimeField, is_prime};
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Task};
use rayon::prelude::*;

/// The entries of an integer row that are not zero: `(column, value)`, columns ascending.
pub type IntegerRow = Vec<(usize, Integer)>;

/// The rank over Q is at least the number of pivots: their minor is not zero modulo a
/// prime, hence not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankAtLeast {
    prime: u64,
    pivots: Pivots,
}

impl RankAtLeast {
    /// The prime.
    pub fn prime(&self) -> u64 {
        self.prime
    }

    /// Rows and columns of a minor that is not zero modulo the prime.
    pub fn pivots(&self) -> &Pivots {
        &self.pivots
    }

    /// The bound.
    pub fn bound(&self) -> usize {
        self.pivots.rank()
    }
}

/// The rank over Q is the number of pivots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RankExact {
    lower: RankAtLeast,
    kernel: Vec<Vec<Integer>>,
}

impl RankExact {
    /// The pivots, with the prime that found them.
    pub fn lower(&self) -> &RankAtLeast {
        &self.lower
    }

    /// The evidence that there are no more: a basis of the right kernel, one vector for each
    /// column that is not a pivot, ascending, without a common divisor, positive there and
    /// zero at the others.
    pub fn kernel(&self) -> &[Vec<Integer>] {
        &self.kernel
    }

    /// The rank over Q.
    pub fn rank(&self) -> usize {
        self.lower.bound()
    }
}

/// A lower bound for the rank over Q by elimination modulo the field's prime.
/// O(rows * cols * rank) operations modulo the prime.
///
/// # Errors
/// If the task was stopped.
///
/// # Panics
/// If an entry lies beyond the last column.
fn rank_at_least(
    field: &PrimeField,
    rows: &[IntegerRow],
    cols: usize,
    task: &Task,
) -> Result<RankAtLeast, Stopped> {
    let mut m = Matrix::new(rows.len(), cols, vec![0; rows.len() * cols]);
    for (i, row) in rows.iter().enumerate() {
        for (col, value) in row {
            m[(i, *col)] = field.from_integer(value);
        }
    }
    Ok(RankAtLeast {
        prime: field.modulus(),
        pivots: eliminate_mod(field, m, task)?.pivots(),
    })
}

/// The exact rank over Q of the matrix with the given rows and `cols` columns.
///
/// The prime is 2^61 - 1, and if that divides every minor of largest size the next lower
/// ones in turn.
/// Elimination modulo p, and for each vector one p-adic digit for every 30 bits of the
/// solution at the price of a multiplication of the matrix with a vector.
///
/// # Errors
/// If the task was stopped.
///
/// # Panics
/// If an entry lies beyond the last column.
pub fn rank_exact(rows: &[IntegerRow], cols: usize, task: &Task) -> Result<RankExact, Stopped> {
    let primes = (5..=DEFAULT_PRIME).rev().filter(|&p| is_prime(p));
    for prime in primes {
        let field = PrimeField::new(prime)
            .unwrap_or_else(|_| unreachable!("a prime from 5 to 2^61 - 1 is a modulus"));
        let lower = rank_at_least(&field, rows, cols, task)?;
        if let Some(kernel) = kernel(&field, rows, cols, lower.pivots(), task)? {
            return Ok(RankExact { lower, kernel });
        }
    }
    unreachable!("a non-zero minor has fewer divisors than there are primes below 2^61")
}

/// One verified kernel vector for each column that is not in `pivot_cols`, given a minor
/// that is not zero modulo p; `None` if one of them does not exist.
fn kernel(
    field: &PrimeField,
    rows: &[IntegerRow],
    cols: usize,
    pivots: &Pivots,
    task: &Task,
) -> Result<Option<Vec<Vec<Integer>>>, Stopped> {
    let (pivot_rows, pivot_cols) = (&pivots.rows, &pivots.cols);
    let rank = pivot_rows.len();
    let mut place = vec![None; cols];
    for (k, &col) in pivot_cols.iter().enumerate() {
        place[col] = Some(k);
    }
    let minor: Vec<IntegerRow> = pivot_rows
        .iter()
        .map(|&row| {
            let entries = rows[row].iter();
            entries
                .filter_map(|(col, value)| Some((place[*col]?, value.clone())))
                .collect()
        })
        .collect();
    let mut residues = Matrix::new(rank, rank, vec![0; rank * rank]);
    for (k, row) in minor.iter().enumerate() {
        for (col, value) in row {
            residues[(k, *col)] = field.from_integer(value);
        }
    }
    let system = System {
        field,
        factors: eliminate_mod(field, residues, task)?,
        rows: minor,
    };
    let free: Vec<usize> = (0..cols).filter(|&col| place[col].is_none()).collect();
    let work = task.begin(free.len() as u64);
    free.into_par_iter()
        .map(|free| {
            let entry = |&row: &usize| {
                let found = rows[row].binary_search_by_key(&free, |&(col, _)| col);
                found.map_or(Integer::zero(), |at| -&rows[row][at].1)
            };
            let right: Vec<Integer> = pivot_rows.iter().map(entry).collect();
            let accept = |(numerators, denominator): (&[Integer], &Integer)| {
                let mut vector = vec![Integer::zero(); cols];
                for (&col, x) in pivot_cols.iter().zip(numerators) {
                    vector[col] = x.clone();
                }
                vector[free] = denominator.clone();
                in_kernel(rows, &vector).then(|| {
                    primitive(&mut vector, free);
                    vector
                })
            };
            let vector = system.solve(right, accept, task)?;
            work.done(1)?;
            Ok(vector)
        })
        .collect()
}

/// Whether the matrix times the vector is zero, over the integers.
fn in_kernel(rows: &[IntegerRow], vector: &[Integer]) -> bool {
    rows.iter().all(|row| {
        let mut sum = Integer::zero();
        for (col, value) in row {
            sum += value * &vector[*col];
        }
        sum.is_zero()
    })
}

/// A square integer system that is regular modulo p.
struct System<'a> {
    field: &'a PrimeField,
    factors: Echelon,
    rows: Vec<IntegerRow>,
}

impl System<'_> {
    /// Lifts the solution of `rows * x = right` until `accept` takes a rational
    /// candidate, numerators over one denominator; `None` if it takes not even the true
    /// solution.
    fn solve<T>(
        &self,
        right: Vec<Integer>,
        accept: impl Fn((&[Integer], &Integer)) -> Option<T>,
        task: &Task,
    ) -> Result<Option<T>, Stopped> {
        let p = Integer::from(self.field.modulus());
        // Cramer's rule: numerators and denominator are minors, bounded by Hadamard with
        // row norms at most the sum of the entries. Reconstruction is certain once the
        // modulus exceeds twice the square of the bound.
        let bits_of = |row: &IntegerRow, b: &Integer| {
            row.iter()
                .fold(b.abs(), |sum, (_, value)| sum + value.abs())
                .bits()
        };
        let hadamard: u64 = self
            .rows
            .iter()
            .zip(&right)
            .map(|(row, b)| bits_of(row, b))
            .sum();
        let enough = 2 * hadamard + 2;

        let mut residual = right;
        let mut solution = vec![Integer::zero(); residual.len()];
        let mut modulus = Integer::one();
        let mut next_try = 1;
        for digits in 1u64.. {
            task.check()?;
            let right: Vec<u64> = residual
                .iter()
                .map(|r| self.field.from_integer(r))
                .collect();
            let digit: Vec<Integer> = self
                .factors
                .solve(&right)
                .unwrap_or_else(|| unreachable!("the system is regular modulo p"))
                .into_iter()
                .map(|x| Integer::from(self.field.to_u64(x)))
                .collect();
            for (x, digit) in solution.iter_mut().zip(&digit) {
                *x += digit * &modulus;
            }
            for (r, row) in residual.iter_mut().zip(&self.rows) {
                for (col, value) in row {
                    *r -= value * &digit[*col];
                }
                *r /= &p;
            }
            modulus *= &p;
            let last = modulus.bits() > enough;
            if digits >= next_try || last {
                // Ever rarer attempts cost less than the lifting they may save.
                next_try = digits + digits.div_ceil(4);
                let candidate = reconstruct(&solution, &modulus);
                if let Some((numerators, denominator)) = &candidate
                    && let Some(accepted) = accept((numerators, denominator))
                {
                    return Ok(Some(accepted));
                }
            }
            if last {
                return Ok(None);
            }
        }
        unreachable!("the modulus grows beyond every bound")
    }
}

/// Rational numbers with a common denominator that have the given residues, all
/// numerators and the denominator at most sqrt(modulus / 2) in absolute value; `None` if
/// there are none (Wang, Guy and Davenport, SIGSAM Bulletin 16, 1982).
pub fn reconstruct(residues: &[Integer], modulus: &Integer) -> Option<(Vec<Integer>, Integer)> {
    let half = modulus.bits().saturating_sub(2) / 2;
    // A residue times the denominator found so far is most often a small integer.
    let mut denominator = Integer::one();
    for residue in residues {
        let (_, scaled) = (residue * &denominator).div_rem_euclid(modulus);
        if symmetric(&scaled, modulus).bits() <= half {
            continue;
        }
        // Half of the extended Euclidean algorithm: r = t * scaled modulo the modulus.
        let (mut r0, mut r1) = (modulus.clone(), scaled);
        let (mut t0, mut t1) = (Integer::zero(), Integer::one());
        while r1.bits() > half {
            let (q, r) = r0.div_rem_euclid(&r1);
            let t = &t0 - q * &t1;
            (r0, r1) = (r1, r);
            (t0, t1) = (t1, t);
        }
        denominator *= t1.abs();
        if denominator.bits() > half {
            return None;
        }
    }
    let numerators = residues.iter().map(|residue| {
        let (_, scaled) = (residue * &denominator).div_rem_euclid(modulus);
        let numerator = symmetric(&scaled, modulus);
        (numerator.bits() <= half).then_some(numerator)
    });
    Some((numerators.collect::<Option<_>>()?, denominator))
}

/// The residue of least absolute value.
fn symmetric(residue: &Integer, modulus: &Integer) -> Integer {
    let negative = residue - modulus;
    if negative.magnitude() < residue.magnitude() {
        negative
    } else {
        residue.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::super::bareiss;
    use super::super::integer::Integers;
    use super::super::tests::samples::known_rank;
    use super::*;
    use crate::watch::unwatched;
    use proptest::prelude::*;

    fn sparse(m: &Matrix<Integer>) -> Vec<IntegerRow> {
        let row = |i: usize| {
            m.row(i)
                .iter()
                .cloned()
                .enumerate()
                .filter(|(_, x)| !x.is_zero())
        };
        (0..m.rows()).map(|i| row(i).collect()).collect()
    }

    /// The kernel vectors are unique, so fraction-free elimination must find the same for
    /// the same pivot columns.
    fn verify(m: &Matrix<Integer>, rank: usize) {
        let exact = unwatched(|task| rank_exact(&sparse(m), m.cols(), task));
        assert_eq!(exact.rank(), rank);
        assert_eq!(exact.rank(), exact.lower().bound());
        let pivots = exact.lower().pivots();
        let minor = m.submatrix(&pivots.rows, &pivots.cols);
        assert_eq!(
            unwatched(|task| bareiss::eliminate(minor, task))
                .pivots()
                .rank(),
            rank
        );
        assert_eq!(exact.kernel().len(), m.cols() - rank);
        let order: Vec<usize> = pivots
            .cols
            .iter()
            .copied()
            .chain(pivots.free_cols(m.cols()))
            .collect();
        compare(
            &m.submatrix(&(0..m.rows()).collect::<Vec<_>>(), &order),
            &order,
            exact.kernel(),
        );
    }

    /// With the pivot columns moved to the front, elimination takes them as pivots too.
    fn compare(reordered: &Matrix<Integer>, order: &[usize], vectors: &[Vec<Integer>]) {
        let expected = unwatched(|task| bareiss::eliminate(reordered.clone(), task)).kernel();
        assert_eq!(expected.len(), vectors.len());
        for (expected, vector) in expected.iter().zip(vectors) {
            let moved: Vec<Integer> = order.iter().map(|&col| vector[col].clone()).collect();
            assert_eq!(expected, &moved);
        }
    }

    #[test]
    fn an_unlucky_prime_is_left() {
        // The determinant is 2^61 - 1: modulo that prime the rank is one too small.
        let p = Integer::from(DEFAULT_PRIME);
        let n = |x: i64| Integer::from(x);
        let m = Matrix::new(2, 2, vec![n(1), n(1), n(1), &p + 1]);
        let field = PrimeField::mersenne61();
        let bound = unwatched(|task| rank_at_least(&field, &sparse(&m), 2, task)).bound();
        assert_eq!(bound, 1);
        let exact = unwatched(|task| rank_exact(&sparse(&m), 2, task));
        assert_eq!((exact.rank(), exact.kernel().len()), (2, 0));
        assert!(exact.lower().prime() < DEFAULT_PRIME);

        // The same with a third column and row that depend on the others.
        let entries = [n(1), n(1), n(2), n(1), &p + 1, &p + 2, n(2), n(2), n(4)];
        verify(&Matrix::new(3, 3, entries.to_vec()), 2);
    }

    #[test]
    fn long_entries() {
        let big: Integer = "123456789012345678901234567890123456789".parse().unwrap();
        let m = known_rank(&Integers, 9, 8, 6, 11, 5);
        let scaled = Matrix::from_fn(9, 8, |i, j| &m[(i, j)] * (1 + 3 * j as i64) * &big);
        verify(&scaled, 6);
    }

    #[test]
    fn empty() {
        for (rows, cols) in [(0, 0), (0, 3), (3, 0), (2, 3), (3, 2)] {
            verify(&Matrix::from_fn(rows, cols, |_, _| Integer::zero()), 0);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn known_ranks(rank in 0..14usize, rows in 0..6usize, cols in 0..6usize, seed: u64) {
            let m = known_rank(&Integers, rank + rows, rank + cols, rank, seed, 1000);
            verify(&m, rank);
        }
    }
}
