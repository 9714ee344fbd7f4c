//! Matrices whose entries are rational up to square roots, rounded to integers.
//!
//! In: entries e / sqrt(d), with integers e and d. Out: integers that differ from 2^beta times them by 1 + 2^-50 at
//! most each, so that no singular value differs by much more than the root of their number.

use super::inertia::Symmetric;
use super::wide::Wide;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use viewcert::linalg::integer::Integer;

/// Bits of the largest entries.
pub(super) const BITS: u64 = 100;
/// Bits of a square root.
const ROOT_BITS: u64 = 160;

/// A sparse matrix of integers.
#[derive(Clone, Debug)]
pub(super) struct Rounded {
    pub(super) columns: usize,
    pub(super) rows: Vec<Vec<(u32, i128)>>,
    /// It is 2^beta times the matrix that is meant, up to rounding.
    pub(super) beta: i64,
    /// Vectors that this matrix takes to zero, nearly: what does not count as a motion.
    pub(super) trivial: Vec<Vec<f64>>,
}

/// 2^k.
pub(super) fn power(k: u64) -> Integer {
    let word = Integer::from(1i128 << 64);
    let rest = Integer::from(1u64 << (k % 64));
    (0..k / 64).fold(rest, |product, _| product.mul(&word))
}

/// x / 2^k rounded down.
fn shifted_down(x: &Integer, k: u64) -> Integer {
    x.div_rem_euclid(&power(k)).0
}

/// The largest integer whose square is at most x >= 0.
pub(super) fn square_root(x: &Integer) -> Integer {
    let mut root = power(x.bits().div_ceil(2));
    loop {
        if root.is_zero() {
            return root;
        }
        let next = root.add(&x.div_rem_euclid(&root).0);
        let next = next.div_rem_euclid(&Integer::from(2u64)).0;
        if next.sub(&root).sign() != Ordering::Less {
            return root;
        }
        root = next;
    }
}

/// 2^beta sqrt(a / b), by which integers are multiplied.
pub(super) struct Factor {
    /// At least [`ROOT_BITS`] bits.
    root: Integer,
    /// The factor is root / 2^down.
    down: u64,
}

impl Factor {
    /// For positive a and b.
    pub(super) fn new(a: &Integer, b: &Integer, beta: i64) -> Self {
        let enough = 2 * ROOT_BITS + b.bits() + 2;
        let up = enough.saturating_sub(a.bits());
        let up = up.max(2 * u64::try_from(beta).unwrap_or(0));
        let up = up + up % 2;
        let root = square_root(&a.mul(&power(up)).div_rem_euclid(b).0);
        let down = i64::try_from(up / 2).unwrap_or(i64::MAX) - beta;
        Self {
            root,
            down: u64::try_from(down).unwrap_or(0),
        }
    }

    /// The product with an integer, off by less than 1 + 2^-50 as long as it is below 2^([`BITS`] + 8).
    pub(super) fn times(&self, e: &Integer) -> i128 {
        let product = e.mul(&self.root);
        let text = shifted_down(&product, self.down).to_string();
        text.parse()
            .unwrap_or_else(|_| unreachable!("{text} is larger than the entries of a matrix"))
    }
}

impl Rounded {
    /// By how much, in units of 2^-beta, a singular value may differ from that of the matrix that is meant.
    pub(super) fn error(&self) -> Integer {
        let entries: usize = self.rows.iter().map(Vec::len).sum();
        square_root(&Integer::from(entries as u64)).add(&Integer::one())
    }

    /// M^T M.
    pub(super) fn gram(&self) -> Symmetric {
        let mut rows: Vec<BTreeMap<u32, Wide>> = vec![BTreeMap::new(); self.columns];
        for row in &self.rows {
            for &(i, x) in row {
                for &(j, y) in row.iter().filter(|&&(j, _)| j <= i) {
                    let sum = rows[i as usize].entry(j).or_default();
                    *sum = *sum + Wide::product(x, y);
                }
            }
        }
        Symmetric {
            rows: rows
                .into_iter()
                .map(|row| row.into_iter().collect())
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots() {
        for x in [0u64, 1, 2, 3, 4, 15, 16, 17, 1 << 40] {
            assert_eq!(square_root(&Integer::from(x)), Integer::from(x.isqrt()));
        }
        let large = power(201);
        let root = square_root(&large);
        let next = root.add(&Integer::one());
        assert_eq!(large.sub(&root.mul(&root)).sign(), Ordering::Greater);
        assert_eq!(large.sub(&next.mul(&next)).sign(), Ordering::Less);
    }

    /// 7 / sqrt(3), and 1e40 / sqrt(1e80 + 1), which is 1 up to rounding.
    #[test]
    fn factors() {
        let (one, three) = (Integer::one(), Integer::from(3u64));
        let factor = Factor::new(&one, &three, 50);
        let expected = 7.0 / 3f64.sqrt() * 2f64.powi(50);
        assert!((factor.times(&Integer::from(7i64)) as f64 - expected).abs() < 2.0);
        assert!((factor.times(&Integer::from(-7i64)) as f64 + expected).abs() < 2.0);
        let large = Integer::from_decimal(&format!("1{}", "0".repeat(40))).unwrap();
        let square = large.mul(&large).add(&one);
        let unit = Factor::new(&one, &square, 84).times(&large);
        assert!(((1i128 << 84) - unit).abs() <= 1, "{unit}");
    }
}
