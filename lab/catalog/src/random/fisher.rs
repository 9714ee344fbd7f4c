//! Fisher's exact test.

use super::ratio;
use num_bigint::BigUint;
use num_traits::One;

/// The probability, if both counts `[successes, trials]` have the same probability of
/// success behind them, and given their sum, of a split that is at most as likely as
/// this one (two-sided; Fisher 1922). Exact up to the final division. O(trials).
///
/// # Panics
/// If there are more successes than trials.
///
/// # Example
/// ```
/// // Fisher's lady: all four of four cups against none of four; 2 of 70 ways.
/// let p = viewcert_lab_catalog::random::fisher([4, 4], [0, 4]);
/// assert!((p - 2.0 / 70.0).abs() < 1e-12);
/// ```
pub fn fisher(one: [u64; 2], two: [u64; 2]) -> f64 {
    let ([a, m], [b, n]) = (one, two);
    assert!(a <= m && b <= n, "more successes than trials");
    let sum = a + b;
    let (least, most) = (sum.saturating_sub(n), sum.min(m));
    // The weight of x successes in the first: binom(m, x) binom(n, sum - x).
    let mut weight = choose(m, least) * choose(n, sum - least);
    let mut weights = vec![weight.clone()];
    for x in least..most {
        weight = weight * ((m - x) * (sum - x)) / ((x + 1) * (n + x + 1 - sum));
        weights.push(weight.clone());
    }
    let own = weights[(a - least) as usize].clone();
    let total: BigUint = weights.iter().sum();
    let extreme: BigUint = weights.into_iter().filter(|weight| *weight <= own).sum();
    ratio(&extreme, &total)
}

fn choose(n: u64, k: u64) -> BigUint {
    (0..k.min(n - k)).fold(BigUint::one(), |product, i| product * (n - i) / (i + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 1 of 2 against 2 of 2: binom(2, x) binom(2, 3 - x) is 2, 2 for x = 1, 2.
    #[test]
    fn small_tables() {
        assert!((fisher([1, 2], [2, 2]) - 1.0).abs() < 1e-12);
        // x = 0..3 of binom(3, x) binom(3, 3 - x): 1, 9, 9, 1 of 20.
        assert!((fisher([3, 3], [0, 3]) - 0.1).abs() < 1e-12);
        assert!((fisher([2, 3], [1, 3]) - 1.0).abs() < 1e-12);
        assert!((fisher([0, 1000], [0, 1000]) - 1.0).abs() < 1e-12);
    }

    /// Against the normal approximation: 300 and 240 of 1000 differ by 3.02 deviations.
    #[test]
    fn large_tables() {
        let p = fisher([300, 1000], [240, 1000]);
        assert!((0.0020..0.0035).contains(&p), "{p}");
    }
}
