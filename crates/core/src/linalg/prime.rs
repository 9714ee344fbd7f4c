//! Residues modulo a prime below 2^62, in Montgomery form.
//!
//! The bound 2^62 is what makes the inner loops fast: a sum of many products fits
//! into 128 bits, so that one reduction serves a whole dot product instead of one
//! product.

use crate::linalg::integer::{Integer, Signed, ToPrimitive};
use crate::linalg::{Field, Ring};
use std::fmt;

/// The default modulus, the Mersenne prime 2^61 - 1.
pub const DEFAULT_PRIME: u64 = (1 << 61) - 1;

/// The largest prime below 2^29. Sums of 64 products fit into a word, and a processor multiplies
/// several such residues with one instruction: elimination modulo this prime is several
/// times as fast as modulo [`DEFAULT_PRIME`].
pub const SMALL_PRIME: u64 = (1 << 29) - 3;

/// From here on products of residues do not fit into a word 64 times.
const SMALL: u64 = 1 << 29;

/// How many products of residues below [`SMALL`] are summed in a word.
pub(super) const SMALL_PRODUCTS: usize = 64;

/// The field of residues modulo a prime p, 5 <= p < 2^62.
///
/// An element x is kept as x * 2^64 mod p (Montgomery form, always below p), so an
/// element is zero, and two elements are equal, exactly when their words are.
/// [`from_u64`](Self::from_u64) and [`to_u64`](Self::to_u64) convert.
///
/// ```
/// use viewcert::linalg::prime::PrimeField;
/// use viewcert::linalg::{Field, Ring};
///
/// let f = PrimeField::new(7).unwrap();
/// let third = f.inv(&f.from_u64(3)).unwrap();
/// assert_eq!(f.to_u64(third), 5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrimeField {
    p: u64,
    /// -1/p modulo 2^64.
    neg_inv: u64,
    /// 2^64 modulo p.
    one: u64,
    /// 2^128 modulo p.
    r2: u64,
    /// How many products may be added to an accumulator whose high word is below p.
    lazy: usize,
}

/// Why a number cannot be the modulus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModulusError {
    /// Below 5.
    TooSmall(u64),
    /// 2^62 or more.
    TooLarge(u64),
    /// Not a prime.
    Composite(u64),
}

impl fmt::Display for ModulusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooSmall(inner) => write!(
                f,
                "{inner} is too small a modulus: take a prime from 5 up (2 and 3 are excluded: \
         the equations S + S^T = 0 lose rank in so small a characteristic)"
            ),
            Self::TooLarge(inner) => write!(
                f,
                "{inner} is too large a modulus: take a prime below 2^62 = 4611686018427387904"
            ),
            Self::Composite(inner) => write!(
                f,
                "{inner} is not a prime: residues form a field only modulo a prime"
            ),
        }
    }
}

impl std::error::Error for ModulusError {}

/// Whether `n` is a prime. Miller-Rabin with the first twelve primes as bases, which
/// is exact for every 64-bit number (Sorenson and Webster, Math. Comp. 86, 2017).
pub(crate) fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    for q in BASES {
        if n.is_multiple_of(q) {
            return n == q;
        }
    }
    let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(n)) as u64;
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;
    BASES.iter().all(|&base| {
        let (mut x, mut square, mut e) = (1, base, odd);
        while e > 0 {
            if e & 1 == 1 {
                x = times(x, square);
            }
            square = times(square, square);
            e >>= 1;
        }
        if x == 1 {
            return true;
        }
        for _ in 1..twos {
            if x == n - 1 {
                return true;
            }
            x = times(x, x);
        }
        x == n - 1
    })
}

impl PrimeField {
    /// The field modulo `p`.
    ///
    /// # Errors
    /// `p` below 5, not below 2^62, or composite.
    pub fn new(p: u64) -> Result<Self, ModulusError> {
        if p >= 1 << 62 {
            return Err(ModulusError::TooLarge(p));
        }
        if p < 5 {
            return Err(ModulusError::TooSmall(p));
        }
        if !is_prime(p) {
            return Err(ModulusError::Composite(p));
        }
        Ok(Self::with_constants(p))
    }

    /// The field modulo [`DEFAULT_PRIME`]. Free: that this is a prime is not tested again.
    pub fn mersenne61() -> Self {
        const FIELD: PrimeField = PrimeField::with_constants(DEFAULT_PRIME);
        FIELD
    }

    /// The constants of the arithmetic modulo a prime 5 <= p < 2^62.
    const fn with_constants(p: u64) -> Self {
        // Newton's iteration doubles the correct low bits: 3, 6, 12, 24, 48, 96.
        let mut inverse = p;
        let mut step = 0;
        while step < 5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
            step += 1;
        }
        let one = ((1u128 << 64) % p as u128) as u64;
        let r2 = (one as u128 * one as u128 % p as u128) as u64;
        // p 2^64 + lazy p^2 must not pass 2^128: 2^126 + 12 * 2^124 or 2^125 + 56 * 2^122.
        let lazy = if p < 1 << 61 { 56 } else { 12 };
        Self {
            p,
            neg_inv: inverse.wrapping_neg(),
            one,
            r2,
            lazy,
        }
    }

    /// The modulus p.
    pub fn modulus(&self) -> u64 {
        self.p
    }

    /// Whether the modulus is below 2^29, so that 64 products of residues fit into a word.
    pub(super) fn is_small(&self) -> bool {
        self.p < SMALL
    }

    /// The residue class of `value`.
    pub fn from_u64(&self, value: u64) -> u64 {
        self.redc(u128::from(value % self.p) * u128::from(self.r2))
    }

    /// The residue class of an integer of any size.
    pub fn from_integer(&self, value: &Integer) -> u64 {
        let residue = self.from_u64((value.magnitude() % self.p).to_u64().unwrap_or_default());
        match value.is_negative() {
            true => self.negate(residue),
            false => residue,
        }
    }

    /// The least residue, 0 <= r < p, of an element.
    pub fn to_u64(&self, element: u64) -> u64 {
        self.redc(u128::from(element))
    }

    /// `base` to the power `exponent`; zero to the zero is one.
    pub fn pow(&self, base: u64, mut exponent: u64) -> u64 {
        let (mut power, mut square) = (self.one, base);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = self.times(power, square);
            }
            square = self.times(square, square);
            exponent >>= 1;
        }
        power
    }

    /// Inverts every element in place with a single field inversion (Montgomery's
    /// trick): 3 multiplications an element. Zeros stay zero.
    pub(crate) fn invert_all(&self, elements: &mut [u64]) {
        let mut prefixes = Vec::with_capacity(elements.len());
        let mut product = self.one;
        for &x in elements.iter() {
            prefixes.push(product);
            if x != 0 {
                product = self.times(product, x);
            }
        }
        let Some(mut inverse) = self.inverse(product) else {
            unreachable!("a product of non-zero residues modulo a prime is not zero")
        };
        for (x, prefix) in elements.iter_mut().zip(prefixes).rev() {
            if *x != 0 {
                let rest = self.times(inverse, *x);
                *x = self.times(inverse, prefix);
                inverse = rest;
            }
        }
    }

    /// T / 2^64 modulo p, for T < p 2^64 (Montgomery, Math. Comp. 44, 1985).
    #[inline(always)]
    fn redc(&self, t: u128) -> u64 {
        let m = (t as u64).wrapping_mul(self.neg_inv);
        // t + m p < 2 p 2^64 < 2^127.
        let r = ((t + u128::from(m) * u128::from(self.p)) >> 64) as u64;
        r.min(r.wrapping_sub(self.p))
    }

    /// `redc` of one word for p < 2^29, in two halves (T / 2^32 modulo p each) that multiply 32
    /// bits by 32: for the vector unit.
    #[inline(always)]
    pub(super) fn redc_word(&self, t: u64) -> u64 {
        let half = |t: u64| {
            let m = low(low(t) * low(self.neg_inv));
            // The low words add up to 2^32, or both are zero.
            (t >> 32) + ((m * self.p) >> 32) + u64::from(low(t) != 0)
        };
        // The first is below 2^32 + p, the second at most p + 1.
        let r = half(half(t));
        r.min(r.wrapping_sub(self.p))
    }

    /// Brings the high word of an accumulator below p without changing its class.
    /// The high word is below 8p when p < 2^61 and below 4p otherwise.
    #[inline(always)]
    fn fold(&self, acc: u128) -> u128 {
        let mut high = (acc >> 64) as u64;
        // A difference that wraps is the larger of the two, since 4p <= 2^64.
        for multiple in [4 * self.p, 2 * self.p, self.p] {
            high = high.min(high.wrapping_sub(multiple));
        }
        u128::from(high) << 64 | acc & u128::from(u64::MAX)
    }

    /// `a b`, of words that stand for residues.
    #[inline(always)]
    pub fn times(&self, a: u64, b: u64) -> u64 {
        self.redc(u128::from(a) * u128::from(b))
    }

    /// `a + b`, likewise.
    #[inline(always)]
    pub fn plus(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        sum.min(sum.wrapping_sub(self.p))
    }

    #[inline(always)]
    pub(crate) fn minus(&self, a: u64, b: u64) -> u64 {
        let difference = a.wrapping_sub(b);
        difference.min(difference.wrapping_add(self.p))
    }

    /// `-a`, likewise.
    #[inline(always)]
    pub fn negate(&self, a: u64) -> u64 {
        self.minus(0, a)
    }

    /// The inverse by the extended Euclidean algorithm; `None` for zero.
    pub fn inverse(&self, a: u64) -> Option<u64> {
        if a == 0 {
            return None;
        }
        // Invariant: s a = r modulo p, |s| < p < 2^62.
        let (mut r0, mut r1) = (self.p, a);
        let (mut s0, mut s1) = (0i64, 1i64);
        while r1 > 1 {
            let q = r0 / r1;
            (r0, r1) = (r1, r0 - q * r1);
            (s0, s1) = (s1, s0 - (q as i64) * s1);
        }
        let inverse = if s1 < 0 {
            (s1 + self.p as i64) as u64
        } else {
            s1 as u64
        };
        // The word a stands for a / R, so its inverse is R / a: the word R^2 / a.
        Some(self.times(self.times(inverse, self.r2), self.r2))
    }

    /// `c + sum_k a[k] b[k]`, reduced once for many products. The shorter slice counts.
    #[inline]
    pub fn dot(&self, c: u64, a: &[u64], b: &[u64]) -> u64 {
        if self.is_small() {
            let chunks = a.chunks(SMALL_PRODUCTS).zip(b.chunks(SMALL_PRODUCTS));
            return chunks.fold(c, |sum, (a, b)| {
                let products = a.iter().zip(b).map(|(&a, &b)| low(a) * low(b));
                let acc = products.fold(0u64, u64::wrapping_add);
                self.plus(sum, self.redc_word(acc))
            });
        }
        let mut acc = u128::from(c) << 64;
        for (a, b) in a.chunks(self.lazy).zip(b.chunks(self.lazy)) {
            for (&a, &b) in a.iter().zip(b) {
                acc = acc.wrapping_add(u128::from(a) * u128::from(b));
            }
            acc = self.fold(acc);
        }
        self.redc(acc)
    }

    /// Four dot products that share the left factor: `c[l] + sum_k a[k] b[k][l]`.
    ///
    /// Four independent accumulators fill the multiplier's pipeline and the machine's
    /// registers; all dense kernels come down to this one.
    #[inline(always)]
    pub fn dot4(&self, c: [u64; 4], a: &[u64], b: &[[u64; 4]]) -> [u64; 4] {
        let mut acc = c.map(|c| u128::from(c) << 64);
        for (a, b) in a.chunks(self.lazy).zip(b.chunks(self.lazy)) {
            for (&a, b) in a.iter().zip(b) {
                let a = u128::from(a);
                acc[0] = acc[0].wrapping_add(a * u128::from(b[0]));
                acc[1] = acc[1].wrapping_add(a * u128::from(b[1]));
                acc[2] = acc[2].wrapping_add(a * u128::from(b[2]));
                acc[3] = acc[3].wrapping_add(a * u128::from(b[3]));
            }
            acc = acc.map(|acc| self.fold(acc));
        }
        acc.map(|acc| self.redc(acc))
    }

    /// `y[k] += a x[k]` for every k. The shorter slice counts.
    #[inline]
    pub fn axpy(&self, y: &mut [u64], a: u64, x: &[u64]) {
        for (y, &x) in y.iter_mut().zip(x) {
            *y = self.plus(*y, self.times(a, x));
        }
    }
}

/// A residue below 2^32 as it is. Told so, the compiler uses the multiplier of the vector unit.
#[inline(always)]
pub(super) fn low(residue: u64) -> u64 {
    residue & u64::from(u32::MAX)
}

impl Ring for PrimeField {
    type Elem = u64;

    fn zero(&self) -> u64 {
        0
    }
    fn one(&self) -> u64 {
        self.one
    }
    fn from_i64(&self, value: i64) -> u64 {
        self.from_u64(value.rem_euclid(self.p as i64) as u64)
    }
    fn add(&self, a: &u64, b: &u64) -> u64 {
        self.plus(*a, *b)
    }
    fn sub(&self, a: &u64, b: &u64) -> u64 {
        self.minus(*a, *b)
    }
    fn mul(&self, a: &u64, b: &u64) -> u64 {
        self.times(*a, *b)
    }
    fn neg(&self, a: &u64) -> u64 {
        self.negate(*a)
    }
    fn is_zero(&self, a: &u64) -> bool {
        *a == 0
    }
}

impl Field for PrimeField {
    fn inv(&self, a: &u64) -> Option<u64> {
        self.inverse(*a)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::laws;
    use super::*;
    use proptest::prelude::*;

    /// The largest prime below 2^62.
    const LARGEST: u64 = 4_611_686_018_427_387_847;
    /// Limits of the arithmetic: the smallest moduli, both sides of 2^29, both sides of the change
    /// of accumulator length at 2^61, and the largest modulus.
    const MODULI: [u64; 8] = [
        5,
        7,
        SMALL_PRIME,
        SMALL + 11,
        (1 << 31) - 1,
        DEFAULT_PRIME,
        (1 << 61) + 15,
        LARGEST,
    ];

    #[test]
    fn moduli_are_checked() {
        for n in [0, 1, 2, 3, 4] {
            assert_eq!(PrimeField::new(n), Err(ModulusError::TooSmall(n)));
        }
        // 3215031751 is a strong pseudoprime to bases 2, 3, 5 and 7;
        // 3825123056546413051 to the first nine primes.
        for n in [9, 25, 3_215_031_751, 3_825_123_056_546_413_051, LARGEST - 2] {
            assert_eq!(PrimeField::new(n), Err(ModulusError::Composite(n)));
        }
        for n in [1 << 62, (1 << 62) + 135, u64::MAX] {
            assert_eq!(PrimeField::new(n), Err(ModulusError::TooLarge(n)));
        }
        for p in MODULI {
            assert_eq!(PrimeField::new(p).unwrap().modulus(), p);
        }
        assert_eq!(PrimeField::new(DEFAULT_PRIME), Ok(PrimeField::mersenne61()));
    }

    #[test]
    fn primality_agrees_with_trial_division() {
        for n in 0..5000u64 {
            let by_division = n > 1 && (2..n).take_while(|d| d * d <= n).all(|d| n % d != 0);
            assert_eq!(is_prime(n), by_division, "{n}");
        }
    }

    #[test]
    fn every_residue_of_a_small_field() {
        for p in [5u64, 7, 31] {
            let f = PrimeField::new(p).unwrap();
            for a in 0..p {
                let x = f.from_u64(a);
                assert_eq!(f.to_u64(x), a);
                assert_eq!(f.from_i64(a as i64 - p as i64), x);
                assert_eq!(f.inv(&x).map(|y| f.to_u64(y) * a % p), (a > 0).then_some(1));
                for b in 0..p {
                    let y = f.from_u64(b);
                    assert_eq!(f.to_u64(f.mul(&x, &y)), a * b % p);
                    assert_eq!(f.to_u64(f.add(&x, &y)), (a + b) % p);
                    assert_eq!(f.to_u64(f.sub(&x, &y)), (a + p - b) % p);
                }
            }
        }
    }

    #[test]
    fn accumulators_do_not_overflow() {
        // All words at p - 1, the largest there are, at every length around the folds.
        for p in MODULI {
            let f = PrimeField::new(p).unwrap();
            let top = p - 1;
            let square = f.times(top, top);
            let mut expected = top;
            for length in 0..130 {
                let a = vec![top; length];
                assert_eq!(f.dot(top, &a, &a), expected, "p {p} length {length}");
                let b = vec![[top; 4]; length];
                assert_eq!(f.dot4([top; 4], &a, &b), [expected; 4]);
                expected = f.plus(expected, square);
            }
        }
    }

    #[test]
    fn fermat() {
        for p in MODULI {
            let f = PrimeField::new(p).unwrap();
            for a in [1, 2, 3, p / 2, p - 1] {
                let x = f.from_u64(a);
                assert_eq!(f.pow(x, p - 1), f.one());
                assert_eq!(f.inv(&x), Some(f.pow(x, p - 2)));
            }
        }
    }

    proptest! {
        #[test]
        fn words_are_reduced(t: u64, p in prop::sample::select(vec![5, 7, 65537, SMALL_PRIME])) {
            let f = PrimeField::new(p).unwrap();
            for t in [t, 0, u64::MAX, t << 32, t >> 32] {
                prop_assert_eq!(f.redc_word(t), f.redc(u128::from(t) % (u128::from(p) << 64)));
            }
        }

        #[test]
        fn laws(which in 0..MODULI.len(), a: u64, b: u64, c: u64, k: i64, l: i64) {
            let f = PrimeField::new(MODULI[which]).unwrap();
            let [a, b, c] = [a, b, c].map(|x| f.from_u64(x));
            laws::ring(&f, &a, &b, &c);
            laws::integers(&f, k >> 32, l >> 32);
            laws::field(&f, &a);
        }

        #[test]
        fn products_agree_with_division(which in 0..MODULI.len(), a: u64, b: u64) {
            let p = MODULI[which];
            let f = PrimeField::new(p).unwrap();
            let product = u128::from(a) * u128::from(b) % u128::from(p);
            prop_assert_eq!(u128::from(f.to_u64(f.mul(&f.from_u64(a), &f.from_u64(b)))), product);
        }

        #[test]
        fn batch_inversion(which in 0..MODULI.len(), values: Vec<u64>) {
            let f = PrimeField::new(MODULI[which]).unwrap();
            let values: Vec<u64> = values.iter().map(|&v| f.from_u64(v)).collect();
            let mut inverses = values.clone();
            f.invert_all(&mut inverses);
            for (v, i) in values.iter().zip(inverses) {
                prop_assert_eq!(f.inv(v).unwrap_or(0), i);
            }
        }
    }
}
