//! The inertia of a symmetric matrix, by integers (docs/theory.md, Theorem 16.6).
//!
//! In: a symmetric matrix H of integers. Out: how many eigenvalues are negative, up to a shift rho: the sum
//! of what every division of an elimination left over.

use super::wide::{Limbs, MOST, Wide, dot};
use rayon::prelude::*;
use viewcert::watch::{Stopped, Task};

/// Rows that one thread takes at least.
const ROWS: usize = 16;

/// The lower triangle of a symmetric matrix: for every row its entries that are not zero, by rising columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Symmetric {
    pub(super) rows: Vec<Vec<(u32, Wide)>>,
}

/// What an elimination of H finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Inertia {
    /// H + E has so many negative eigenvalues, and no zero.
    pub(super) negative: usize,
    /// A bound on the norm of E.
    pub(super) rho: Wide,
}

/// A row of C, from its first entry that is not zero.
struct Row<'a> {
    first: usize,
    factors: Vec<Limbs>,
    /// Those of H that are still to come.
    left: &'a [(u32, Wide)],
    /// The sum of its remainders.
    remainders: Wide,
    /// The last remainder, of the column at hand.
    last: Wide,
}

impl Row<'_> {
    /// The entry of H in a column, less C S C^T as far as it is known.
    fn reduced(&mut self, column: usize, other: usize, signed: &[Limbs]) -> Wide {
        let mut entry = Wide::default();
        if let Some(((at, x), rest)) = self.left.split_first()
            && *at as usize == column
        {
            (entry, self.left) = (*x, rest);
        }
        let from = self.first.max(other);
        if from >= column {
            return entry;
        }
        let own = &self.factors[from - self.first..column - self.first];
        entry - dot(own, &signed[from - other..column - other])
    }
}

/// Eliminates H - shift I: C S C^T with a lower triangle C of integers, S of signs, and what is left over. Nothing
/// if numbers grow too much. O(N^3) products of integers, less what stands before the first entries of rows.
///
/// # Errors
/// Work that was stopped.
pub(super) fn inertia(
    h: &Symmetric,
    shift: Wide,
    task: &Task<'_>,
) -> Result<Option<Inertia>, Stopped> {
    let mut rows: Vec<Row> = h
        .rows
        .iter()
        .enumerate()
        .map(|(i, entries)| {
            let first = entries.first().map_or(i, |&(column, _)| column as usize);
            Row {
                first,
                factors: Vec::with_capacity(i + 1 - first),
                left: entries,
                remainders: Wide::default(),
                last: Wide::default(),
            }
        })
        .collect();
    let mut negative = 0;
    let mut signs: Vec<bool> = Vec::with_capacity(rows.len());
    let work = task.begin(rows.len() as u64);
    for column in 0..rows.len() {
        work.done(1)?;
        let (head, tail) = rows.split_at_mut(column + 1);
        let pivot = &mut head[column];
        let first = pivot.first;
        let known = pivot.factors.iter().zip(&signs[first..]);
        let mut signed: Vec<Limbs> = known
            .map(|(&x, &is_minus)| if is_minus { -x } else { x })
            .collect();
        let left = pivot.reduced(column, first, &signed) - shift;
        let Some(root) = root(left.abs()) else {
            return Ok(None);
        };
        let is_minus = left.is_negative();
        let square = Wide::product(root, root);
        let remainder = left - if is_minus { -square } else { square };
        pivot.remainders = pivot.remainders + remainder.abs();
        pivot.factors.push(Limbs::new(root));
        negative += usize::from(is_minus);
        signs.push(is_minus);
        let divisor = if is_minus { -root } else { root };
        signed.push(Limbs::new(divisor));

        let fits = tail.par_iter_mut().with_min_len(ROWS).all(|row| {
            row.last = Wide::default();
            if row.first > column {
                return true;
            }
            let left = row.reduced(column, first, &signed);
            let Some((quotient, remainder)) = divided(left, divisor) else {
                return false;
            };
            row.factors.push(Limbs::new(quotient));
            row.last = remainder.abs();
            row.remainders = row.remainders + row.last;
            true
        });
        if !fits {
            return Ok(None);
        }
        let below = tail.iter().fold(Wide::default(), |sum, row| sum + row.last);
        head[column].remainders = head[column].remainders + below;
    }
    let sums = rows.iter().map(|row| row.remainders);
    let rho = sums.reduce(|a, b| if a.is_below(b) { b } else { a });
    Ok(rho.map(|rho| Inertia { negative, rho }))
}

/// An integer near a square root, 1 at least: what it misses is a remainder.
fn root(square: Wide) -> Option<i128> {
    let start = square.to_f64().sqrt();
    if start >= MOST as f64 / 2.0 {
        return None;
    }
    let mut root = (start as i128).max(1);
    for _ in 0..3 {
        let missing = square - Wide::product(root, root);
        root = (root + (missing.to_f64() / (2.0 * root as f64)) as i128).max(1);
        if root >= MOST {
            return None;
        }
    }
    Some(root)
}

/// An integer near a quotient, and what is left over, whatever it is.
fn divided(value: Wide, divisor: i128) -> Option<(i128, Wide)> {
    let (mut quotient, mut rest) = (0i128, value);
    for _ in 0..4 {
        let step = rest.to_f64() / divisor as f64;
        if step.abs() < 0.75 {
            break;
        }
        if step.abs() >= MOST as f64 / 2.0 {
            return None;
        }
        let step = step.round() as i128;
        quotient += step;
        rest = rest - Wide::product(step, divisor);
    }
    (quotient.abs() < MOST).then_some((quotient, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use viewcert::watch::unwatched;

    /// The lower triangle of a dense matrix times 2^80.
    fn symmetric(h: &[Vec<i64>]) -> Symmetric {
        let row = |(i, row): (usize, &Vec<i64>)| {
            let entries = row[..=i].iter().zip(0u32..);
            let entries = entries.filter(|(x, j)| **x != 0 || *j as usize == i);
            entries
                .map(|(&x, j)| (j, Wide::product(i128::from(x) << 80, 1 << 80)))
                .collect()
        };
        Symmetric {
            rows: h.iter().enumerate().map(row).collect(),
        }
    }

    proptest! {
        /// B^T B has no negative eigenvalue, and minus a shift above its trace all are; remainders are small.
        #[test]
        fn squares(b in proptest::collection::vec(proptest::collection::vec(-9i64..10, 5), 1..9)) {
            let n = 5;
            let h: Vec<Vec<i64>> = (0..n)
                .map(|i| (0..n).map(|j| b.iter().map(|row| row[i] * row[j]).sum()).collect())
                .collect();
            let trace: i64 = (0..n).map(|i| h[i][i]).sum();
            let at = |shift: f64| {
                let shift = Wide::from_f64(shift * 2f64.powi(160)).unwrap();
                unwatched(|task| inertia(&symmetric(&h), shift, task)).unwrap()
            };
            prop_assert_eq!(at(-1e-6).negative, 0);
            let all = at(trace as f64 + 1.0);
            prop_assert_eq!(all.negative, n);
            prop_assert!(all.rho.to_f64() < 2f64.powi(160) * 1e-20);
        }
    }

    /// Eigenvalues -1, 1, 3 by hand: [[0, 1], [1, 0]] and 3.
    #[test]
    fn signs() {
        let h = symmetric(&[vec![0, 1, 0], vec![1, 0, 0], vec![0, 0, 3]]);
        for (shift, expected) in [(-2.0, 0), (-0.5, 1), (0.5, 1), (2.0, 2), (4.0, 3)] {
            let shift = Wide::from_f64(shift * 2f64.powi(160)).unwrap();
            let found = unwatched(|task| inertia(&h, shift, task)).unwrap();
            assert_eq!(found.negative, expected);
        }
    }

    /// A pivot of zero leaves no wrong answer: numbers grow too much, or the remainder is large.
    #[test]
    fn a_pivot_of_zero() {
        let h = symmetric(&[vec![0, 1], vec![1, 0]]);
        let found = unwatched(|task| inertia(&h, Wide::default(), task));
        assert!(found.is_none_or(|found| found.rho.to_f64() >= 2f64.powi(159)));
    }
}
