//! Arithmetic modulo a prime.

use crate::rejection::{Checked, ensure};

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

/// The field of p elements, 5 <= p < 2^62. Elements are below p, in Montgomery form: x is stored as
/// x 2^64 mod p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub p: u64,
    /// -1 / p modulo 2^64.
    negative_inverse: u64,
    pub one: u64,
}

/// How many products are summed before one reduction: in 128 bits, or in 64 if p is below `SMALL`.
pub(crate) const LANES: usize = 12;
pub(crate) const SMALL_LANES: usize = 64;
pub(crate) const SMALL: u64 = 1 << 29;

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
    pub(crate) fn new(p: u64) -> Checked<Field> {
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
    pub(crate) fn element(&self, residue: u64) -> u64 {
        ((u128::from(residue) << 64) % u128::from(self.p)) as u64
    }

    pub(crate) fn signed(&self, value: i128) -> u64 {
        self.element(value.rem_euclid(i128::from(self.p)) as u64)
    }

    pub(crate) fn neg(&self, a: u64) -> u64 {
        self.sub(0, a)
    }

    /// Subtracts p once if that is possible, without a branch.
    fn below(&self, a: u64) -> u64 {
        a.min(a.wrapping_sub(self.p))
    }

    /// t / 2^64 modulo p, below t / 2^64 + p. Needs t + 2^64 p < 2^128: t <= 12 p^2 < 2^128 - 2^126
    /// is small enough.
    fn reduce(&self, t: u128) -> u64 {
        let factor = (t as u64).wrapping_mul(self.negative_inverse);
        ((t + u128::from(factor) * u128::from(self.p)) >> 64) as u64
    }

    /// a + a sum of at most `LANES` products (or `SMALL_LANES`, if p < 2^29): one reduction, to
    /// below p + 12 p^2 / 2^64 < 4 p (or to p at most).
    pub(crate) fn add_products(&self, a: u64, products: u128) -> u64 {
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

    /// The element with the value of a decimal integer (section 1: *big*).
    pub(crate) fn decimal(&self, text: &str) -> u64 {
        let digits = text.strip_prefix('-').unwrap_or(text).as_bytes();
        let value = digits.chunks(18).fold(0, |value, digits| {
            let part = |part: u64, digit: &u8| 10 * part + u64::from(digit - b'0');
            let (shift, part) = (10u64.pow(digits.len() as u32), digits.iter().fold(0, part));
            self.add(self.mul(value, self.element(shift)), self.element(part))
        });
        if digits.len() < text.len() {
            self.neg(value)
        } else {
            value
        }
    }

    /// The inverse; 0 for 0.
    pub(crate) fn inverse(&self, a: u64) -> u64 {
        self.pow(a, self.p - 2)
    }
}

/// Whether p < 2^62 is prime: Miller-Rabin with the first twelve primes as bases decides (Sorenson
/// and Webster, 2017).
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

#[cfg(test)]
mod tests;
