//! Numbers of solutions. They are products, and may be large.

use num_bigint::BigUint;
use num_traits::One;
use serde::{Serialize, Serializer};
use std::cmp::Ordering;
use std::fmt;
use std::iter::Product;

/// A number of solutions, exactly.
///
/// It is compared with a `u64` as it is. As JSON it is an integer below 2^53, and from there on a
/// string of its decimal digits, so that no reader rounds it (docs/certificate.md, section 1).
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Number(BigUint);

/// Readers of JSON may take numbers for doubles.
const EXACT: u64 = 1 << 53;

impl Number {
    /// One solution.
    pub fn one() -> Self {
        Self(BigUint::one())
    }
}

impl From<usize> for Number {
    fn from(value: usize) -> Self {
        Self(BigUint::from(value))
    }
}

/// The number itself, if it is small.
impl TryFrom<&Number> for u64 {
    type Error = num_bigint::TryFromBigIntError<()>;

    fn try_from(number: &Number) -> Result<u64, Self::Error> {
        u64::try_from(&number.0)
    }
}

impl Product for Number {
    fn product<I: Iterator<Item = Self>>(factors: I) -> Self {
        Self(factors.map(|factor| factor.0).product())
    }
}

impl PartialEq<u64> for Number {
    fn eq(&self, other: &u64) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd<u64> for Number {
    fn partial_cmp(&self, other: &u64) -> Option<Ordering> {
        self.0.partial_cmp(&BigUint::from(*other))
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match u64::try_from(self) {
            Ok(small) if small < EXACT => serializer.serialize_u64(small),
            _ => serializer.collect_str(&self.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_json() {
        let text = |number: Number| serde_json::to_string(&number).unwrap();
        assert_eq!(text(Number::from(EXACT as usize - 1)), "9007199254740991");
        assert_eq!(text(Number::from(EXACT as usize)), "\"9007199254740992\"");
        let power = std::iter::repeat_n(Number::from(2), 101).product::<Number>();
        assert_eq!(text(power), "\"2535301200456458802993406410752\"");
    }

    #[test]
    fn compared_with_integers() {
        let two = Number::from(2);
        assert!(two > 1 && two == 2 && two < 3 && two != Number::one());
        assert!(std::iter::empty::<Number>().product::<Number>() == 1);
    }
}
