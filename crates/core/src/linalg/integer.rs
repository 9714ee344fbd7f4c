//! Integers of any size, by num-bigint, with the traits of its operations.

use crate::linalg::Ring;
pub use num_bigint::BigInt as Integer;
pub use num_integer::Integer as Division;
pub use num_traits::{Euclid, One, Signed, ToPrimitive, Zero};

/// The greatest common divisor of all, never negative; 0 of none. Stops at one: the greatest
/// common divisor of one and a long number takes long.
pub fn content<'a>(all: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let mut gcd = Integer::zero();
    for x in all {
        gcd = gcd.gcd(x);
        if gcd.is_one() {
            break;
        }
    }
    gcd
}

/// Reads an optional minus sign and decimal digits, nothing else.
pub fn decimal(text: &str) -> Option<Integer> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_decimal = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    is_decimal.then(|| text.parse().ok()).flatten()
}

/// A type of exact numbers as a ring, which is a value.
macro_rules! exact {
    ($(#[$doc:meta])* $ring:ident of $number:ty) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $ring;

        impl Ring for $ring {
            type Elem = $number;

            fn zero(&self) -> $number {
                <$number>::zero()
            }
            fn one(&self) -> $number {
                <$number>::one()
            }
            fn from_i64(&self, value: i64) -> $number {
                Integer::from(value).into()
            }
            fn add(&self, a: &$number, b: &$number) -> $number {
                a + b
            }
            fn sub(&self, a: &$number, b: &$number) -> $number {
                a - b
            }
            fn mul(&self, a: &$number, b: &$number) -> $number {
                a * b
            }
            fn neg(&self, a: &$number) -> $number {
                -a
            }
            fn is_zero(&self, a: &$number) -> bool {
                a.is_zero()
            }
        }
    };
}
pub(super) use exact;

exact! {
    /// The ring of integers.
    Integers of Integer
}

#[cfg(test)]
mod tests {
    use super::super::tests::laws;
    use super::*;
    use proptest::prelude::*;

    fn integer(parts: (i128, i128)) -> Integer {
        Integer::from(parts.0) * Integer::from(parts.1)
    }

    #[test]
    fn decimals() {
        let text = "-123456789012345678901234567890123456789012345678901234567890";
        assert_eq!(decimal(text).unwrap().to_string(), text);
        assert_eq!(decimal("-0").unwrap().to_string(), "0");
        for text in ["", "-", "+1", "1 ", "0x1", "1_000", "--1", "٣"] {
            assert_eq!(decimal(text), None, "{text}");
        }
    }

    #[test]
    fn contents() {
        let content =
            |all: &[i64]| super::content(&all.iter().map(|&x| x.into()).collect::<Vec<_>>());
        assert_eq!(content(&[12, -18, 30]), Integer::from(6i64));
        assert_eq!(content(&[-4]), Integer::from(4i64));
        assert_eq!(content(&[0, 3, 5, 0]), Integer::from(1i64));
        assert_eq!(content(&[0, 0]), Integer::from(0i64));
        assert_eq!(content(&[]), Integer::from(0i64));
    }

    proptest! {
        #[test]
        fn laws(a: (i128, i128), b: (i128, i128), c: (i128, i128), k: i32, l: i32) {
            laws::ring(&Integers, &integer(a), &integer(b), &integer(c));
            laws::integers(&Integers, k.into(), l.into());
        }

        #[test]
        fn decimal_round_trip(a: (i128, i128)) {
            let a = integer(a);
            prop_assert_eq!(decimal(&a.to_string()), Some(a));
        }
    }
}
