//! Integers of any size, by num-bigint.

use crate::linalg::Ring;
use num_bigint::{BigInt, Sign};
use num_integer::Integer as _;
use num_traits::{Euclid, ToPrimitive};
use std::cmp::Ordering;
use std::fmt;

/// An integer of any size.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Integer(BigInt);

/// A text that is not a decimal integer: an optional minus sign and digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParseIntegerError;

impl fmt::Display for ParseIntegerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not a decimal integer: write an optional minus sign followed by digits")
    }
}

impl std::error::Error for ParseIntegerError {}

impl Integer {
    /// 0
    pub fn zero() -> Self {
        Self::from(0i64)
    }

    /// 1
    pub fn one() -> Self {
        Self::from(1i64)
    }

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// The comparison with 0: `Less` for a negative number.
    pub fn sign(&self) -> Ordering {
        match self.0.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    /// |self|
    pub fn abs(&self) -> Self {
        if self.sign() == Ordering::Less {
            self.neg()
        } else {
            self.clone()
        }
    }

    /// Compares absolute values.
    pub fn cmp_abs(&self, other: &Self) -> Ordering {
        self.0.magnitude().cmp(other.0.magnitude())
    }

    /// `self + other`
    pub fn add(&self, other: &Self) -> Self {
        Self(&self.0 + &other.0)
    }

    /// `self - other`
    pub fn sub(&self, other: &Self) -> Self {
        Self(&self.0 - &other.0)
    }

    /// `self * other`
    pub fn mul(&self, other: &Self) -> Self {
        Self(&self.0 * &other.0)
    }

    /// `-self`
    pub fn neg(&self) -> Self {
        Self(-&self.0)
    }

    /// `self *= other`
    pub fn mul_assign(&mut self, other: &Self) {
        self.0 *= &other.0;
    }

    /// `self += other`
    pub fn add_assign(&mut self, other: &Self) {
        self.0 += &other.0;
    }

    /// `self -= other`
    pub fn sub_assign(&mut self, other: &Self) {
        self.0 -= &other.0;
    }

    /// `self / divisor`, where the division is known to leave no remainder; with a
    /// remainder the result has no meaning.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn div_exact(&self, divisor: &Self) -> Self {
        Self(&self.0 / &divisor.0)
    }

    /// Quotient and remainder with `self = q * divisor + r`, `0 <= r < |divisor|`.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn div_rem_euclid(&self, divisor: &Self) -> (Self, Self) {
        let (q, r) = self.0.div_rem_euclid(&divisor.0);
        (Self(q), Self(r))
    }

    /// The greatest common divisor, never negative; `gcd(0, 0) = 0`.
    pub fn gcd(&self, other: &Self) -> Self {
        Self(self.0.gcd(&other.0))
    }

    /// The greatest common divisor of all, never negative; 0 of none. Stops at one: the greatest
    /// common divisor of one and a long number takes long.
    pub fn content<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut gcd = Self::zero();
        for x in all {
            gcd = gcd.gcd(x);
            if gcd == Self::one() {
                break;
            }
        }
        gcd
    }

    /// The least common multiple, never negative; 0 if either is 0.
    pub fn lcm(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        self.div_exact(&self.gcd(other)).mul(other).abs()
    }

    /// The number of bits of the absolute value; 0 for 0.
    pub fn bits(&self) -> u64 {
        self.0.bits()
    }

    /// The largest integer whose square is at most this one.
    ///
    /// # Panics
    /// If this is negative.
    pub fn square_root(&self) -> Self {
        Self(self.0.sqrt())
    }

    /// The residue `0 <= r < modulus`.
    ///
    /// # Panics
    /// If `modulus` is zero.
    pub fn rem_u64(&self, modulus: u64) -> u64 {
        let rest = (self.0.magnitude() % modulus).to_u64();
        let rest = rest.unwrap_or_else(|| unreachable!("a residue is below its modulus"));
        if rest > 0 && self.0.sign() == Sign::Minus {
            modulus - rest
        } else {
            rest
        }
    }

    /// The same number, if it is one of 128 bits.
    pub fn to_i128(&self) -> Option<i128> {
        self.0.to_i128()
    }

    /// Reads an optional minus sign and decimal digits, nothing else.
    ///
    /// # Errors
    /// Any other text, the empty one included.
    pub fn from_decimal(text: &str) -> Result<Self, ParseIntegerError> {
        let digits = text.strip_prefix('-').unwrap_or(text);
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return Err(ParseIntegerError);
        }
        text.parse().map(Self).map_err(|_| ParseIntegerError)
    }
}

impl From<i64> for Integer {
    fn from(value: i64) -> Self {
        Self(value.into())
    }
}

impl From<u64> for Integer {
    fn from(value: u64) -> Self {
        Self(value.into())
    }
}

impl From<i128> for Integer {
    fn from(value: i128) -> Self {
        Self(value.into())
    }
}

/// Decimal digits, with a minus sign for negative numbers.
impl fmt::Display for Integer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for Integer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The ring of integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Integers;

impl Ring for Integers {
    type Elem = Integer;

    fn zero(&self) -> Integer {
        Integer::zero()
    }
    fn one(&self) -> Integer {
        Integer::one()
    }
    fn from_i64(&self, value: i64) -> Integer {
        value.into()
    }
    fn add(&self, a: &Integer, b: &Integer) -> Integer {
        a.add(b)
    }
    fn sub(&self, a: &Integer, b: &Integer) -> Integer {
        a.sub(b)
    }
    fn mul(&self, a: &Integer, b: &Integer) -> Integer {
        a.mul(b)
    }
    fn neg(&self, a: &Integer) -> Integer {
        a.neg()
    }
    fn is_zero(&self, a: &Integer) -> bool {
        a.is_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::laws;
    use super::*;
    use proptest::prelude::*;

    fn integer(parts: (i128, i128)) -> Integer {
        Integer::from(parts.0).mul(&Integer::from(parts.1))
    }

    #[test]
    fn decimal() {
        let text = "-123456789012345678901234567890123456789012345678901234567890";
        assert_eq!(Integer::from_decimal(text).unwrap().to_string(), text);
        assert_eq!(Integer::from_decimal("-0").unwrap().to_string(), "0");
        for text in ["", "-", "+1", "1 ", "0x1", "1_000", "--1", "٣"] {
            assert_eq!(
                Integer::from_decimal(text),
                Err(ParseIntegerError),
                "{text}"
            );
        }
    }

    #[test]
    fn contents() {
        let content = |all: &[i64]| {
            Integer::content(&all.iter().map(|&x| Integer::from(x)).collect::<Vec<_>>())
        };
        assert_eq!(content(&[12, -18, 30]), Integer::from(6i64));
        assert_eq!(content(&[-4]), Integer::from(4i64));
        assert_eq!(content(&[0, 3, 5, 0]), Integer::from(1i64));
        assert_eq!(content(&[0, 0]), Integer::from(0i64));
        assert_eq!(content(&[]), Integer::from(0i64));
    }

    #[test]
    fn small_values() {
        let n = |v: i64| Integer::from(v);
        assert_eq!(n(-12).gcd(&n(18)), n(6));
        assert_eq!(n(0).gcd(&n(0)), n(0));
        assert_eq!(n(-4).lcm(&n(6)), n(12));
        assert_eq!(n(0).lcm(&n(6)), n(0));
        assert_eq!(n(-7).rem_u64(5), 3);
        assert_eq!(n(-7).div_rem_euclid(&n(5)), (n(-2), n(3)));
        assert_eq!(n(-7).div_rem_euclid(&n(-5)), (n(2), n(3)));
        assert_eq!(
            [n(0), n(1), n(-1), n(255), n(-256)].map(|v| v.bits()),
            [0, 1, 1, 8, 9]
        );
        assert_eq!(n(-3).cmp_abs(&n(2)), Ordering::Greater);
        assert_eq!(n(-3).cmp(&n(2)), Ordering::Less);
        assert_eq!(Integer::from(u64::MAX).to_string(), "18446744073709551615");
    }

    proptest! {
        #[test]
        fn laws(a: (i128, i128), b: (i128, i128), c: (i128, i128), k: i32, l: i32) {
            laws::ring(&Integers, &integer(a), &integer(b), &integer(c));
            laws::integers(&Integers, k.into(), l.into());
        }

        #[test]
        fn division_undoes_multiplication(a: (i128, i128), b: (i128, i128), m in 1..u64::MAX) {
            let (a, b) = (integer(a), integer(b));
            prop_assume!(!b.is_zero());
            prop_assert_eq!(a.mul(&b).div_exact(&b), a.clone());
            let (q, r) = a.div_rem_euclid(&b);
            prop_assert_eq!(q.mul(&b).add(&r), a.clone());
            prop_assert!(r.sign() != Ordering::Less && r.cmp_abs(&b) == Ordering::Less);
            let (_, r) = a.div_rem_euclid(&Integer::from(m));
            prop_assert_eq!(Integer::from(a.rem_u64(m)), r);
            let mut sum = a.clone();
            sum.add_assign(&b);
            prop_assert_eq!(&sum, &a.add(&b));
            sum.sub_assign(&b);
            prop_assert_eq!(&sum, &a);
            sum.mul_assign(&b);
            prop_assert_eq!(&sum, &a.mul(&b));
        }

        #[test]
        fn decimal_round_trip(a: (i128, i128)) {
            let a = integer(a);
            prop_assert_eq!(Integer::from_decimal(&a.to_string()), Ok(a));
        }

        #[test]
        fn gcd_divides(a: i64, b: i64, c: i64) {
            let (a, b, c) = (Integer::from(a), Integer::from(b), Integer::from(c));
            // gcd(ac, bc) = |c| gcd(a, b).
            prop_assert_eq!(a.mul(&c).gcd(&b.mul(&c)), a.gcd(&b).mul(&c.abs()));
        }
    }
}
