//! Residues modulo a prime 5 <= p < 2^62, in Montgomery form: the residue x is stored as x 2^64 mod p.

use crate::rejection::{Checked, ensure};

/// How many products are summed before one reduction: 8 p^2 < 2^127.
pub(crate) const LANES: usize = 8;

/// The field of p elements. Elements are below p, in Montgomery form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    p: u64,
    /// -1 / p modulo 2^64.
    negative_inverse: u64,
    one: u64,
    /// 2^128 mod p, which brings residues into Montgomery form.
    square: u64,
}

impl Field {
    /// Rejects what is not a prime in range.
    pub fn new(p: u64) -> Checked<Field> {
        ensure!((5..1 << 62).contains(&p) && is_prime(p), "{p} is not a prime with 5 <= p < 2^62");
        Ok(Field::odd(p))
    }

    /// The ring modulo an odd number; a field if it is prime.
    fn odd(p: u64) -> Field {
        // Newton's iteration doubles the correct bits: 5, 10, 20, 40, 80.
        let mut inverse = p.wrapping_mul(3) ^ 2;
        for _ in 0..4 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
        }
        let one = ((1u128 << 64) % u128::from(p)) as u64;
        let square = (u128::from(one) * u128::from(one) % u128::from(p)) as u64;
        Field { p, negative_inverse: inverse.wrapping_neg(), one, square }
    }

    pub fn prime(&self) -> u64 {
        self.p
    }

    /// The element with this residue (any integer is fine).
    pub fn element(&self, residue: u64) -> u64 {
        self.mul(residue % self.p, self.square)
    }

    pub fn signed(&self, value: i128) -> u64 {
        self.element(value.rem_euclid(i128::from(self.p)) as u64)
    }

    /// The element of a decimal integer.
    pub fn decimal(&self, (negative, digits): (bool, &str)) -> u64 {
        let mut value = 0;
        for chunk in digits.as_bytes().chunks(18) {
            let (number, scale) =
                chunk.iter().fold((0, 1), |(n, s), &digit| (n * 10 + u64::from(digit.wrapping_sub(b'0')), s * 10));
            value = self.add(self.mul(value, self.element(scale)), self.element(number));
        }
        if negative { self.neg(value) } else { value }
    }

    pub fn one(&self) -> u64 {
        self.one
    }

    pub fn add(&self, a: u64, b: u64) -> u64 {
        self.below(a + b)
    }

    pub fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    pub fn neg(&self, a: u64) -> u64 {
        self.sub(0, a)
    }

    pub fn mul(&self, a: u64, b: u64) -> u64 {
        self.below(self.reduce(u128::from(a) * u128::from(b)))
    }

    /// Subtracts p once if that is possible.
    fn below(&self, a: u64) -> u64 {
        if a >= self.p { a - self.p } else { a }
    }

    /// t / 2^64 modulo p, below t / 2^64 + p. Needs t + 2^64 p < 2^128, which holds for t <= 8 p^2.
    fn reduce(&self, t: u128) -> u64 {
        let factor = (t as u64).wrapping_mul(self.negative_inverse);
        ((t + u128::from(factor) * u128::from(self.p)) >> 64) as u64
    }

    /// a + sum of x[k] y[k] over the lanes: one reduction, below p + 8 p^2 / 2^64 < 3 p.
    pub fn add_products(&self, a: u64, x: &[u64; LANES], y: [u64; LANES]) -> u64 {
        let mut sum = 0u128;
        for lane in 0..LANES {
            sum += u128::from(x[lane]) * u128::from(y[lane]);
        }
        self.add(a, self.below(self.below(self.reduce(sum))))
    }

    pub fn pow(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut result, mut base) = (self.one, base);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(result, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        result
    }

    /// The inverse; 0 for 0.
    pub fn inverse(&self, a: u64) -> u64 {
        self.pow(a, self.p - 2)
    }
}

/// Whether p is prime, for every p: Miller-Rabin with the first twelve primes as bases decides below 3.3 * 10^24
/// (Sorenson and Webster, 2017). Here p < 2^62.
pub(crate) fn is_prime(p: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if !(2..1 << 62).contains(&p) {
        return false;
    }
    if let Some(&factor) = BASES.iter().find(|&&base| p.is_multiple_of(base)) {
        return p == factor;
    }
    let ring = Field::odd(p);
    let (twos, minus_one) = ((p - 1).trailing_zeros(), ring.neg(ring.one));
    BASES.iter().all(|&base| {
        let mut power = ring.pow(ring.element(base), (p - 1) >> twos);
        let mut passes = power == ring.one || power == minus_one;
        for _ in 1..twos {
            power = ring.mul(power, power);
            passes |= power == minus_one;
        }
        passes
    })
}

/// The `count` largest primes below 2^62; all are above 2^61.
pub(crate) fn largest_primes(count: usize) -> Vec<Field> {
    let odd = (0u64..).map(|k| (1 << 62) - 1 - 2 * k);
    odd.filter(|&p| is_prime(p)).take(count).map(Field::odd).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moduli at the limits: the smallest, a 32-bit and a 61-bit one, and the largest prime below 2^62.
    const PRIMES: [u64; 5] = [5, 7, 4_294_967_291, (1 << 61) - 1, (1 << 62) - 57];

    #[test]
    fn arithmetic_agrees_with_long_division() {
        for p in PRIMES {
            let field = Field::new(p).unwrap();
            let samples = [0, 1, 2, 3, 4, p / 2, p - 2, p - 1, 0x1234_5678_9abc_def0 % p];
            for a in samples.map(|a| a % p) {
                for b in samples.map(|b| b % p) {
                    let wide = |x: u128| field.element((x % u128::from(p)) as u64);
                    let (x, y) = (field.element(a), field.element(b));
                    assert_eq!(field.mul(x, y), wide(u128::from(a) * u128::from(b)));
                    assert_eq!(field.add(x, y), wide(u128::from(a) + u128::from(b)));
                    assert_eq!(field.sub(x, y), wide(u128::from(a) + u128::from(p - b)));
                    let sum = field.add_products(x, &[y; LANES], [x; LANES]);
                    assert_eq!(sum, wide(u128::from(a) + 8 * (u128::from(a) * u128::from(b) % u128::from(p))));
                }
                let x = field.element(a);
                assert_eq!(field.mul(x, field.inverse(x)), if a == 0 { 0 } else { field.one() });
            }
            // The largest stored values, whatever they stand for.
            let top = field.add_products(p - 1, &[p - 1; LANES], [p - 1; LANES]);
            assert!(top < p);
        }
    }

    #[test]
    fn primes_are_told_from_composites() {
        let below_100: Vec<u64> = (0..100).filter(|&p| is_prime(p)).collect();
        assert_eq!(below_100.len(), 25);
        assert!(PRIMES.iter().all(|&p| is_prime(p)));
        // Strong pseudoprimes to the bases 2, 3, 5, 7 and to the first nine primes; a square of a prime; 2^62 - 1.
        for composite in [3_215_031_751, 3_825_123_056_546_413_051, 2_147_483_647 * 2_147_483_647, (1 << 62) - 1] {
            assert!(!is_prime(composite), "{composite}");
            assert!(Field::new(composite).is_err());
        }
        for p in [0, 1, 2, 3, 4, 1 << 62, (1 << 63) + 29] {
            assert!(Field::new(p).is_err(), "{p}");
        }
        assert_eq!(largest_primes(1)[0].prime(), (1 << 62) - 57);
    }

    #[test]
    fn decimals_of_any_length() {
        let field = Field::new(1_000_003).unwrap();
        let text = "123456789012345678901234567890123456789";
        let plain = text.bytes().fold(0, |v, digit| (v * 10 + u64::from(digit - b'0')) % 1_000_003);
        assert_eq!(field.decimal((false, text)), field.element(plain));
        assert_eq!(field.decimal((true, text)), field.element(1_000_003 - plain));
        assert_eq!(field.signed(-1), field.element(1_000_002));
    }
}
