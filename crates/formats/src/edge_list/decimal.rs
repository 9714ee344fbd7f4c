//! The least weight of a pair: a decimal number, as it is written, compared exactly.

use std::fmt;
use std::str::FromStr;

use crate::edge_list::fields::is_number;
use viewcert::linalg::rational::{Rational, parse};

/// A decimal number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decimal {
    value: Rational,
    /// As it was written.
    text: Box<str>,
}

/// No decimal number, or one with a very large exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a decimal number like 15 or 0.5")]
pub struct NoDecimal;

impl FromStr for Decimal {
    type Err = NoDecimal;

    fn from_str(text: &str) -> Result<Self, NoDecimal> {
        let text = Some(text).filter(|text| is_number(text.as_bytes()));
        let text = text.ok_or(NoDecimal)?;
        Ok(Self {
            value: parse(text).map_err(|_| NoDecimal)?,
            text: text.into(),
        })
    }
}

impl Decimal {
    /// Whether a weight is less; an error if it is no number.
    pub(crate) fn is_above(&self, weight: &str) -> Result<bool, NoDecimal> {
        let weight = weight.parse::<Self>()?.value;
        Ok(weight < self.value)
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        ];
        for (k, a) in rising.iter().enumerate() {
            for (l, b) in rising.iter().enumerate() {
                let least: Decimal = b.parse().unwrap();
                assert_eq!(least.is_above(a), Ok(k < l), "{a} {b}");
            }
        }
        for [a, b] in [
            ["1", "1.0"],
            ["10e-1", "+01."],
            ["-0", "0.00e7"],
            ["1500", "1.5e3"],
        ] {
            let least: Decimal = a.parse().unwrap();
            assert_eq!(least.is_above(b), Ok(false), "{a} {b}");
        }
        for bad in ["", "x", "1e", "nan", "1e9999999999999999999", "0x1", "1/2"] {
            assert!(bad.parse::<Decimal>().is_err(), "{bad}");
        }
    }
}
