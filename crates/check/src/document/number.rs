//! Numbers of solutions, which are products and may be large (section 1 of the specification,
//! *number*).

use crate::json::{INT_LIMIT, Value};
use serde::de::{Deserializer, Error, Unexpected, Visitor};
use std::cmp::Ordering;
use std::fmt;

/// A natural number, exactly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// To the base 10^9, the least digit first; the last one is not zero.
    digits: Vec<u32>,
}

const BASE: u64 = 1_000_000_000;

impl Number {
    /// The product with another number.
    pub(crate) fn times(&self, other: &Number) -> Number {
        let mut digits = vec![0u32; self.digits.len() + other.digits.len()];
        for (k, &x) in self.digits.iter().enumerate() {
            let mut carry = 0;
            for (l, place) in digits[k..].iter_mut().enumerate() {
                let y = other.digits.get(l).copied().unwrap_or_default();
                let sum = u64::from(*place) + u64::from(x) * u64::from(y) + carry;
                (*place, carry) = ((sum % BASE) as u32, sum / BASE);
            }
        }
        Number::of(digits)
    }

    /// How many operations a product with it takes, for each digit of the other number.
    pub(crate) fn len(&self) -> usize {
        self.digits.len()
    }

    fn of(mut digits: Vec<u32>) -> Number {
        while digits.last() == Some(&0) {
            digits.pop();
        }
        Number { digits }
    }

    /// The number that a text says in decimal digits alone.
    fn from_decimal(text: &str) -> Option<Number> {
        let is_plain = text.bytes().all(|byte| byte.is_ascii_digit()) && !text.starts_with('0');
        let groups = text.as_bytes().rchunks(9).map(|group| {
            let digit = |number, byte: &u8| 10 * number + u32::from(byte - b'0');
            group.iter().fold(0, digit)
        });
        is_plain.then(|| Number::of(groups.collect()))
    }
}

impl From<u64> for Number {
    fn from(mut value: u64) -> Number {
        let mut digits = Vec::new();
        while value > 0 {
            digits.push((value % BASE) as u32);
            value /= BASE;
        }
        Number { digits }
    }
}

impl PartialEq<u64> for Number {
    fn eq(&self, other: &u64) -> bool {
        self.cmp(&Number::from(*other)) == Ordering::Equal
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Number) -> Ordering {
        let longer = self.digits.len().cmp(&other.digits.len());
        longer.then_with(|| self.digits.iter().rev().cmp(other.digits.iter().rev()))
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Number) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut digits = self.digits.iter().rev();
        write!(f, "{}", digits.next().copied().unwrap_or_default())?;
        digits.try_for_each(|digit| write!(f, "{digit:09}"))
    }
}

/// An int, or from 2^53 on a string.
struct IntOrBig;

impl Visitor<'_> for IntOrBig {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an integer below 2^53, or a string of one that is not")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Number, E> {
        let wrong = || E::invalid_value(Unexpected::Unsigned(value), &self);
        let number = (value < INT_LIMIT).then(|| Number::from(value));
        number.ok_or_else(wrong)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
        let limit = Number::from(INT_LIMIT);
        let large = |number: &Number| *number >= limit;
        let number = Number::from_decimal(text).filter(large);
        number.ok_or_else(|| E::invalid_value(Unexpected::Str(text), &self))
    }
}

impl Value for Number {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(IntOrBig)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::json::Strict;

    #[test]
    fn products() {
        let two = Number::from(2);
        let mut power = Number::from(1);
        for _ in 0..101 {
            power = power.times(&two);
        }
        assert_eq!(power.to_string(), "2535301200456458802993406410752");
        let squares = [1_000_000_000, 999_999_999_999, 12_345_678_901];
        for (root, square) in squares.into_iter().zip([
            "1000000000000000000",
            "999999999998000000000001",
            "152415787526596567801",
        ]) {
            let root = Number::from(root);
            assert_eq!(root.times(&root).to_string(), square);
        }
        assert_eq!(two.times(&Number::from(0)), Number::from(0));
        assert_eq!(Number::from(0).to_string(), "0");
    }

    #[test]
    fn order() {
        let texts = [
            "9007199254740992",
            "10000000000000000",
            "10000000010000000000",
        ];
        let numbers = texts.map(|text| Number::from_decimal(text).unwrap());
        let five = Number::from(5);
        assert!(numbers.is_sorted() && five < numbers[0]);
        assert!(
            numbers
                .iter()
                .zip(texts)
                .all(|(number, text)| number.to_string() == text)
        );
    }

    #[test]
    fn one_way_to_write_it() {
        let read = |text: &str| serde_json::from_str(text).map(|Strict::<Number>(number)| number);
        let good = [
            ("0", Number::from(0)),
            ("9007199254740991", Number::from(INT_LIMIT - 1)),
            ("\"9007199254740992\"", Number::from(INT_LIMIT)),
        ];
        for (text, expected) in good {
            assert_eq!(read(text).unwrap(), expected);
        }
        for text in [
            "9007199254740992",
            "-1",
            "1.0",
            "1e3",
            "\"2\"",
            "\"9007199254740991\"",
            "\"09007199254740992\"",
            "\"+9007199254740992\"",
            "\"\"",
            "null",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
