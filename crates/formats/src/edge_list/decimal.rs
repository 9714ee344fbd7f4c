//! Decimal numbers as they are written, compared exactly.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use crate::edge_list::fields::is_number;

/// A decimal number of any length; `1`, `1.0` and `10e-1` are equal.
#[derive(Clone, Debug)]
pub struct Decimal {
    negative: bool,
    /// Its digits without zeros at either end; none for zero.
    digits: Box<[u8]>,
    /// The power of ten in front of 0.d1d2d3...; 0 for zero.
    exponent: i64,
    /// As it was written.
    text: Box<str>,
}

/// No number, or one with an exponent beyond 10^15.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a decimal number like 15 or 0.5")]
pub struct NoDecimal;

impl FromStr for Decimal {
    type Err = NoDecimal;

    fn from_str(text: &str) -> Result<Self, NoDecimal> {
        const MOST: i64 = 1_000_000_000_000_000;
        if !is_number(text.as_bytes()) {
            return Err(NoDecimal);
        }
        let (mantissa, power) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let power: i64 = power.parse().map_err(|_| NoDecimal)?;
        if power.abs() > MOST {
            return Err(NoDecimal);
        }
        let unsigned = mantissa.trim_start_matches(['+', '-']);
        let (whole, fraction) = unsigned.split_once('.').unwrap_or((unsigned, ""));
        let all = [whole.as_bytes(), fraction.as_bytes()].concat();
        let zeros = all.iter().take_while(|&&digit| digit == b'0').count();
        let end = all
            .iter()
            .rposition(|&digit| digit != b'0')
            .map_or(zeros, |last| last + 1);
        let is_zero = end == zeros;
        Ok(Self {
            negative: !is_zero && mantissa.starts_with('-'),
            digits: all[zeros..end].into(),
            exponent: if is_zero {
                0
            } else {
                power + whole.len() as i64 - zeros as i64
            },
            text: text.into(),
        })
    }
}

impl Decimal {
    /// Whether it is 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.digits.is_empty()
    }

    fn signed(&self) -> i8 {
        match (self.is_zero(), self.negative) {
            (true, _) => 0,
            (_, true) => -1,
            _ => 1,
        }
    }
}

impl Ord for Decimal {
    fn cmp(&self, other: &Self) -> Ordering {
        // Digits without zeros in front, so that the larger power is the larger number.
        let size =
            |one: &Self, two: &Self| (one.exponent, &one.digits).cmp(&(two.exponent, &two.digits));
        self.signed().cmp(&other.signed()).then_with(|| {
            if self.negative {
                size(other, self)
            } else {
                size(self, other)
            }
        })
    }
}

impl PartialOrd for Decimal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Decimal {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Decimal {}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> Decimal {
        text.parse().unwrap()
    }

    #[test]
    fn order() {
        let rising = [
            "-1e3",
            "-20",
            "-2.5",
            "-2.49",
            "-.1",
            "-1e-9",
            "0",
            "1e-300",
            "0.1",
            "0.10000000000000000001",
            "1",
            "1.5",
            "9.99",
            "10",
            "15",
            "100",
            "12345678901234567890123",
            "1e999999",
        ];
        for (k, a) in rising.iter().enumerate() {
            for (l, b) in rising.iter().enumerate() {
                assert_eq!(decimal(a).cmp(&decimal(b)), k.cmp(&l), "{a} {b}");
            }
        }
        for equal in [
            ["1", "1.0"],
            ["10e-1", "+01."],
            ["-0", "0.00e7"],
            ["1500", "1.5e3"],
            [".05", "5e-2"],
        ] {
            assert_eq!(decimal(equal[0]), decimal(equal[1]), "{equal:?}");
        }
        for bad in ["", "x", "1e", "nan", "1e9999999999999999999", "0x1"] {
            assert!(bad.parse::<Decimal>().is_err(), "{bad}");
        }
    }
}
