//! Integers of 256 bits, as sums of many products need them.
//!
//! In: integers below 2^113 in absolute value. Out: their products and sums, exact below 2^255.

use std::ops::{Add, Neg, Sub};
use viewcert::linalg::integer::Integer;

/// Bits of a limb of a factor; two balanced limbs and the sums of 2^12 of their products fit into 128 bits.
const LIMB: u32 = 57;
/// Factors are below this in absolute value.
pub(super) const MOST: i128 = 1 << 113;

/// hi 2^128 + lo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Wide {
    hi: i128,
    lo: u128,
}

impl From<i128> for Wide {
    fn from(x: i128) -> Self {
        Self {
            hi: x >> 127,
            lo: x as u128,
        }
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (lo, carry) = self.lo.overflowing_add(other.lo);
        Self {
            hi: self.hi + other.hi + i128::from(carry),
            lo,
        }
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            hi: !self.hi,
            lo: !self.lo,
        } + Self { hi: 0, lo: 1 }
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Wide {
    pub(super) fn is_negative(self) -> bool {
        self.hi < 0
    }

    pub(super) fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// x 2^bits, for at most 127 bits.
    fn shifted(x: i128, bits: u32) -> Self {
        Self {
            hi: x >> (128 - bits),
            lo: (x as u128) << bits,
        }
    }

    /// The product of two factors.
    pub(super) fn product(a: i128, b: i128) -> Self {
        let mut sum = Products::default();
        sum.add(Limbs::new(a), Limbs::new(b));
        sum.total()
    }

    /// Up to rounding.
    pub(super) fn to_f64(self) -> f64 {
        let size = self.abs();
        let value = size.hi as f64 * 2f64.powi(128) + size.lo as f64;
        if self.is_negative() { -value } else { value }
    }

    /// A double that is an integer below 2^250, or is cut off to one.
    pub(super) fn from_f64(x: f64) -> Option<Self> {
        if x.is_nan() || x.abs() >= 2f64.powi(250) {
            return None;
        }
        let hi = (x.abs() / 2f64.powi(128)).floor();
        let lo = x.abs() - hi * 2f64.powi(128);
        let size = Self {
            hi: hi as i128,
            lo: lo as u128,
        };
        Some(if x < 0.0 { -size } else { size })
    }

    pub(super) fn to_integer(self) -> Integer {
        let half = Integer::from(1i128 << 64);
        let lo = Integer::from((self.lo >> 64) as u64).mul(&half);
        let lo = lo.add(&Integer::from(self.lo as u64));
        Integer::from(self.hi).mul(&half).mul(&half).add(&lo)
    }

    /// Half of it, cut off.
    pub(super) fn half(self) -> Self {
        Self {
            hi: self.hi >> 1,
            lo: self.lo >> 1 | ((self.hi as u128) << 127),
        }
    }

    pub(super) fn is_below(self, other: Self) -> bool {
        (self - other).is_negative()
    }
}

/// A factor as high 2^57 + low, |low| <= 2^56.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Limbs {
    high: i64,
    low: i64,
}

impl Limbs {
    pub(super) fn new(x: i128) -> Self {
        debug_assert!(x.abs() < MOST);
        let high = (x + (1 << (LIMB - 1))) >> LIMB;
        Self {
            high: high as i64,
            low: (x - (high << LIMB)) as i64,
        }
    }
}

impl Neg for Limbs {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

/// A sum of products, by limbs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Products {
    high: i128,
    middle: i128,
    low: i128,
}

impl Products {
    #[inline]
    fn add(&mut self, a: Limbs, b: Limbs) {
        let times = |x: i64, y: i64| i128::from(x) * i128::from(y);
        self.high += times(a.high, b.high);
        self.middle += times(a.high, b.low) + times(a.low, b.high);
        self.low += times(a.low, b.low);
    }

    fn total(self) -> Wide {
        Wide::shifted(self.high, 2 * LIMB) + Wide::shifted(self.middle, LIMB) + self.low.into()
    }
}

/// The sum of the products of two lists of factors of one length.
pub(super) fn dot(a: &[Limbs], b: &[Limbs]) -> Wide {
    let mut all = Wide::default();
    for (a, b) in a.chunks(1 << 11).zip(b.chunks(1 << 11)) {
        let mut sum = Products::default();
        for (&a, &b) in a.iter().zip(b) {
            sum.add(a, b);
        }
        all = all + sum.total();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn factor() -> impl Strategy<Value = i128> {
        (0u32..113, any::<i128>()).prop_map(|(bits, x)| x % (1i128 << bits).max(2))
    }

    proptest! {
        #[test]
        fn sums_of_products(list in proptest::collection::vec((factor(), factor()), 1..40)) {
            let limbs: (Vec<_>, Vec<_>) =
                list.iter().map(|&(a, b)| (Limbs::new(a), Limbs::new(b))).unzip();
            let expected = list.iter().fold(Integer::zero(), |sum, &(a, b)| {
                sum.add(&Integer::from(a).mul(&Integer::from(b)))
            });
            let found = dot(&limbs.0, &limbs.1);
            prop_assert_eq!(found.to_integer(), expected.clone());
            prop_assert_eq!((-found).to_integer(), expected.neg());
            prop_assert_eq!((found - Wide::from(list[0].0)).to_integer(),
                expected.sub(&Integer::from(list[0].0)));
            let float: f64 = expected.to_string().parse().unwrap();
            prop_assert!((found.to_f64() - float).abs() <= 1e-15 * float.abs());
            for &(a, _) in &list {
                prop_assert_eq!(Wide::from(a).to_integer(), Integer::from(a));
            }
        }
    }

    #[test]
    fn doubles_and_halves() {
        for x in [0.0, 1.0, -3.0, 2f64.powi(200) * 1.25, -(2f64.powi(128))] {
            assert_eq!(Wide::from_f64(x).unwrap().to_f64(), x);
        }
        assert_eq!(Wide::from_f64(f64::NAN), None);
        let x = Wide::product(MOST - 1, MOST - 3);
        let half = x.half().to_integer();
        assert_eq!(half.add(&half).add(&Integer::one()), x.to_integer());
    }
}
