//! Rational numbers, over whichever integers are in use.

use crate::linalg::integer::Integer;
use crate::linalg::{Field, Ring};
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// A rational number in lowest terms with a positive denominator.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational {
    numerator: Integer,
    denominator: Integer,
}

impl Rational {
    /// `numerator / denominator` in lowest terms; `None` if the denominator is zero.
    pub fn new(numerator: Integer, denominator: Integer) -> Option<Self> {
        let gcd = match denominator.sign() {
            Ordering::Equal => return None,
            Ordering::Greater => numerator.gcd(&denominator),
            Ordering::Less => numerator.gcd(&denominator).neg(),
        };
        let [numerator, denominator] = [numerator, denominator].map(|n| n.div_exact(&gcd));
        Some(Self {
            numerator,
            denominator,
        })
    }

    /// The numerator, coprime to the denominator.
    pub fn numerator(&self) -> &Integer {
        &self.numerator
    }

    /// The denominator, always positive.
    pub fn denominator(&self) -> &Integer {
        &self.denominator
    }

    /// `mantissa * base^exponent`, base 2 or 10.
    pub fn scaled(mantissa: Integer, base: u64, exponent: i64) -> Self {
        let power = power(Integer::from(base), exponent.unsigned_abs());
        match exponent {
            0.. => mantissa.mul(&power).into(),
            _ => Self::reduced(mantissa, power),
        }
    }

    fn reduced(numerator: Integer, denominator: Integer) -> Self {
        Self::new(numerator, denominator)
            .unwrap_or_else(|| unreachable!("a product of denominators is not zero"))
    }
}

fn power(base: Integer, exponent: u64) -> Integer {
    let mut power = Integer::one();
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        power = power.mul(&power);
        if exponent >> bit & 1 == 1 {
            power = power.mul(&base);
        }
    }
    power
}

/// The largest exponent of ten that is read: those of doubles are below it.
const MOST_EXPONENT: i64 = 400;

/// A text that is no rational number: neither decimal nor a fraction of two integers, or with an exponent
/// beyond 400.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParseRationalError;

impl fmt::Display for ParseRationalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no decimal number with an exponent up to {MOST_EXPONENT}, and no fraction"
        )
    }
}

impl std::error::Error for ParseRationalError {}

impl FromStr for Rational {
    type Err = ParseRationalError;

    /// A decimal number of any length, with an exponent or without, or a fraction of two integers.
    ///
    /// ```
    /// use viewcert::linalg::rational::Rational;
    ///
    /// let half: Rational = "0.5".parse()?;
    /// assert_eq!(half, "50e-2".parse()?);
    /// assert_eq!(half, "1/2".parse()?);
    /// assert!("nan".parse::<Rational>().is_err() && "1/0".parse::<Rational>().is_err());
    /// # Ok::<(), viewcert::linalg::rational::ParseRationalError>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, ParseRationalError> {
        let integer = |text: &str| {
            let text = text
                .strip_prefix('+')
                .filter(|rest| !rest.starts_with('-'))
                .unwrap_or(text);
            Integer::from_decimal(text).map_err(|_| ParseRationalError)
        };
        if let Some((above, below)) = text.split_once('/') {
            let below = Some(below).filter(|below| !below.starts_with(['-', '+']));
            let below = integer(below.ok_or(ParseRationalError)?)?;
            return Self::new(integer(above)?, below).ok_or(ParseRationalError);
        }
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let exponent: i64 = exponent.parse().map_err(|_| ParseRationalError)?;
        if exponent.abs() > MOST_EXPONENT {
            return Err(ParseRationalError);
        }
        let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        if !part.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(ParseRationalError);
        }
        let digits = integer(&format!("{whole}{part}"))?;
        Ok(Self::scaled(digits, 10, exponent - part.len() as i64))
    }
}

impl From<Integer> for Rational {
    fn from(numerator: Integer) -> Self {
        Self {
            numerator,
            denominator: Integer::one(),
        }
    }
}

/// `n` or `n/d`.
impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.denominator == Integer::one() {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The field of rational numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rationals;

impl Ring for Rationals {
    type Elem = Rational;

    fn zero(&self) -> Rational {
        Integer::zero().into()
    }
    fn one(&self) -> Rational {
        Integer::one().into()
    }
    fn from_i64(&self, value: i64) -> Rational {
        Integer::from(value).into()
    }
    fn add(&self, a: &Rational, b: &Rational) -> Rational {
        let left = a.numerator.mul(&b.denominator);
        let right = b.numerator.mul(&a.denominator);
        Rational::reduced(left.add(&right), a.denominator.mul(&b.denominator))
    }
    fn sub(&self, a: &Rational, b: &Rational) -> Rational {
        self.add(a, &self.neg(b))
    }
    fn mul(&self, a: &Rational, b: &Rational) -> Rational {
        Rational::reduced(
            a.numerator.mul(&b.numerator),
            a.denominator.mul(&b.denominator),
        )
    }
    fn neg(&self, a: &Rational) -> Rational {
        Rational {
            numerator: a.numerator.neg(),
            denominator: a.denominator.clone(),
        }
    }
    fn is_zero(&self, a: &Rational) -> bool {
        a.numerator.is_zero()
    }
}

impl Field for Rationals {
    fn inv(&self, a: &Rational) -> Option<Rational> {
        Rational::new(a.denominator.clone(), a.numerator.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::laws;
    use super::*;
    use proptest::prelude::*;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator.into(), denominator.into()).unwrap()
    }

    #[test]
    fn lowest_terms() {
        assert_eq!(rational(6, -4).to_string(), "-3/2");
        assert_eq!(rational(0, -4).to_string(), "0");
        assert_eq!(rational(-8, -4).to_string(), "2");
        assert_eq!(Rational::new(Integer::one(), Integer::zero()), None);
        assert_eq!(
            Rationals.add(&rational(1, 6), &rational(1, 3)),
            rational(1, 2)
        );
    }

    proptest! {
        #[test]
        fn laws(a: i64, b: i64, c: i64, d in 1..i64::MAX, e in 1..i64::MAX, k: i32, l: i32) {
            let (a, b, c) = (rational(a, d), rational(b, e), rational(c, d / 7 + 1));
            laws::ring(&Rationals, &a, &b, &c);
            laws::integers(&Rationals, k.into(), l.into());
            laws::field(&Rationals, &a);
        }
    }
}
