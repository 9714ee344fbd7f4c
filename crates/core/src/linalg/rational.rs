//! Rational numbers, by num-rational: in lowest terms with a positive denominator.

use crate::linalg::integer::{Integer, One, Zero, decimal, exact};
use crate::linalg::{Field, Ring};
use num_rational::Ratio;
use std::fmt;

/// A rational number.
pub type Rational = Ratio<Integer>;

/// `numerator / denominator` in lowest terms; `None` if the denominator is zero.
pub fn quotient(numerator: Integer, denominator: Integer) -> Option<Rational> {
    (!denominator.is_zero()).then(|| Rational::new(numerator, denominator))
}

/// `mantissa * base^exponent`, base 2 or 10.
pub fn scaled(mantissa: Integer, base: u32, exponent: i64) -> Rational {
    let power = num_traits::pow(Integer::from(base), exponent.unsigned_abs() as usize);
    match exponent {
        0.. => (mantissa * power).into(),
        _ => Rational::new(mantissa, power),
    }
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

/// A decimal number of any length, with an exponent or without, or a fraction of two integers.
///
/// # Errors
/// Any other text.
///
/// ```
/// use viewcert::linalg::rational::parse;
///
/// let half = parse("0.5")?;
/// assert_eq!(half, parse("50e-2")?);
/// assert_eq!(half, parse("1/2")?);
/// assert!(parse("nan").is_err() && parse("1/0").is_err());
/// # Ok::<(), viewcert::linalg::rational::ParseRationalError>(())
/// ```
pub fn parse(text: &str) -> Result<Rational, ParseRationalError> {
    let integer = |text: &str| {
        let text = text
            .strip_prefix('+')
            .filter(|rest| !rest.starts_with('-'))
            .unwrap_or(text);
        decimal(text).ok_or(ParseRationalError)
    };
    if let Some((above, below)) = text.split_once('/') {
        let below = Some(below).filter(|below| !below.starts_with(['-', '+']));
        let below = integer(below.ok_or(ParseRationalError)?)?;
        return quotient(integer(above)?, below).ok_or(ParseRationalError);
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
    Ok(scaled(digits, 10, exponent - part.len() as i64))
}

exact! {
    /// The field of rational numbers.
    Rationals of Rational
}

impl Field for Rationals {
    fn inv(&self, a: &Rational) -> Option<Rational> {
        (!a.is_zero()).then(|| a.recip())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::laws;
    use super::*;
    use proptest::prelude::*;

    fn rational(numerator: i64, denominator: i64) -> Rational {
        quotient(numerator.into(), denominator.into()).unwrap()
    }

    #[test]
    fn lowest_terms() {
        assert_eq!(rational(6, -4).to_string(), "-3/2");
        assert_eq!(rational(0, -4).to_string(), "0");
        assert_eq!(rational(-8, -4).to_string(), "2");
        assert_eq!(quotient(Integer::one(), Integer::zero()), None);
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
