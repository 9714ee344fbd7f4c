//! Vectors between cameras that are given as numbers: what they say about the nodes of a group.
//!
//! In: pairs of nodes with exact coordinates. Out: integers, with the vectors around every cycle
//! seen to agree (docs/theory.md, Theorem 13.21).

use crate::linalg::integer::{Division, Integer, One, Signed, ToPrimitive, Zero};
use crate::linalg::rational::{Rational, parse};
use std::fmt;

/// Numerators and denominators have at most so many digits.
pub(super) const MAX_DIGITS: u32 = 30;

/// A vector in some unit.
pub(super) type Vector = [i128; 3];

/// Why a text is no coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateError {
    /// It is no number.
    NoNumber,
    /// Numerator or denominator has more than 30 digits.
    TooLong,
}

impl fmt::Display for CoordinateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNumber => write!(f, "no decimal number and no fraction"),
            Self::TooLong => write!(f, "a number with more than {MAX_DIGITS} digits"),
        }
    }
}

impl std::error::Error for CoordinateError {}

/// A coordinate of a displacement or position: a decimal number, with an exponent or without, or a fraction of
/// two integers.
///
/// # Errors
/// What is no number, or too long a one.
///
/// ```
/// use viewcert::graph::coordinate;
///
/// let half = coordinate("0.5")?;
/// assert_eq!(half, coordinate("50e-2")?);
/// assert_eq!(half, coordinate("1/2")?);
/// # Ok::<(), viewcert::graph::CoordinateError>(())
/// ```
pub fn coordinate(text: &str) -> Result<Rational, CoordinateError> {
    let found = parse(text).or_else(|_| large_exponent(text))?;
    let are_short = is_short(found.numer()) && is_short(found.denom());
    are_short.then_some(found).ok_or(CoordinateError::TooLong)
}

/// A number with an exponent beyond those that are read: zero, or too long.
fn large_exponent(text: &str) -> Result<Rational, CoordinateError> {
    let (mantissa, exponent) = text
        .split_once(['e', 'E'])
        .ok_or(CoordinateError::NoNumber)?;
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let is_exponent = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let mantissa = parse(&format!("{mantissa}e0"));
    match mantissa.ok().filter(|_| is_exponent) {
        None => Err(CoordinateError::NoNumber),
        Some(zero) if zero.numer().is_zero() => Ok(zero),
        Some(_) => Err(CoordinateError::TooLong),
    }
}

/// Whether a number has few enough digits.
fn is_short(number: &Integer) -> bool {
    number.abs() < Integer::from(10i128.pow(MAX_DIGITS))
}

/// The greatest common divisor, not negative.
pub(crate) fn gcd(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// What given vectors cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// The item with this number contradicts those before it.
    Contradiction(usize),
    /// In one unit they have more than 30 digits.
    TooLong,
}

/// All vectors as integers, in one unit.
pub(super) fn integers(vectors: &[[Rational; 3]]) -> Result<Vec<Vector>, Fault> {
    let mut unit = Integer::one();
    for coordinate in vectors.iter().flatten() {
        unit = unit.lcm(coordinate.denom());
        if unit.bits() >= u64::from(i128::BITS) {
            return Err(Fault::TooLong);
        }
    }
    let integer = |coordinate: &Rational| {
        let factor = &unit / coordinate.denom();
        let product = Some(coordinate.numer() * factor).filter(is_short);
        product.and_then(|n| n.to_i128()).ok_or(Fault::TooLong)
    };
    let vector = |[x, y, z]: &[Rational; 3]| Ok([integer(x)?, integer(y)?, integer(z)?]);
    vectors.iter().map(vector).collect()
}

/// Brings vectors to the unit in which their coordinates have no common divisor.
pub(super) fn reduce(vectors: &mut [Vec<Vector>]) -> Result<(), Fault> {
    let all = vectors.iter().flatten().flatten();
    let unit = all.fold(0, |unit, &n| gcd(unit, n)).max(1);
    for n in vectors.iter_mut().flatten().flatten() {
        *n /= unit;
        if n.unsigned_abs() >= 10u128.pow(MAX_DIGITS) {
            return Err(Fault::TooLong);
        }
    }
    Ok(())
}

pub(super) fn minus(a: Vector, b: Vector) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].checked_sub(b[k]));
    Some([x?, y?, z?])
}

fn plus(a: Vector, b: Vector) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].checked_add(b[k]));
    Some([x?, y?, z?])
}

/// Nodes that hang together, each with its vector from the node that stands for them.
pub(crate) struct Hanging {
    parent: Vec<u32>,
    /// From the parent.
    vector: Vec<Vector>,
}

impl Hanging {
    pub(crate) fn new(nodes: u32) -> Self {
        Self {
            parent: (0..nodes).collect(),
            vector: vec![[0; 3]; nodes as usize],
        }
    }

    /// The node that stands for a node, and the vector from it.
    pub(super) fn find(&mut self, node: u32) -> Result<(u32, Vector), Fault> {
        let mut path = Vec::new();
        let mut root = node;
        while self.parent[root as usize] != root {
            path.push(root as usize);
            root = self.parent[root as usize];
        }
        let mut from_root = [0; 3];
        for v in path.into_iter().rev() {
            from_root = plus(from_root, self.vector[v]).ok_or(Fault::TooLong)?;
            (self.parent[v], self.vector[v]) = (root, from_root);
        }
        Ok((root, from_root))
    }

    /// Takes in that the vector from u to v is this one, as the item with this number says.
    pub(super) fn join(
        &mut self,
        item: usize,
        (u, v): (u32, u32),
        vector: Vector,
    ) -> Result<(), Fault> {
        let ((of_u, to_u), (of_v, to_v)) = (self.find(u)?, self.find(v)?);
        let between = minus(to_v, to_u).and_then(|known| minus(vector, known));
        let between = between.ok_or(Fault::TooLong)?;
        if of_u != of_v {
            (self.parent[of_v as usize], self.vector[of_v as usize]) = (of_u, between);
        } else if between != [0; 3] {
            return Err(Fault::Contradiction(item));
        }
        Ok(())
    }

    /// Takes in that the vector between two nodes is this one; returns whether that agrees with what
    /// was taken in before.
    pub(crate) fn agrees(&mut self, pair: (u32, u32), vector: Vector) -> bool {
        self.join(0, pair, vector).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(i128, i128), CoordinateError> {
        let found = coordinate(text)?;
        let both = [found.numer(), found.denom()];
        let [numerator, denominator] = both.map(|n| n.to_i128().unwrap());
        Ok((numerator, denominator))
    }

    #[test]
    fn decimals_and_fractions_are_exact() {
        for (text, expected) in [
            ("0", (0, 1)),
            ("-0.000", (0, 1)),
            ("0e400", (0, 1)),
            ("-0.0e99999999999999999999", (0, 1)),
            ("12", (12, 1)),
            ("-1.25", (-5, 4)),
            ("+.5", (1, 2)),
            ("5.", (5, 1)),
            ("3e-2", (3, 100)),
            ("1200E1", (12_000, 1)),
            ("-6/4", (-3, 2)),
            (
                "0.1000000000000000055511151231",
                (1_000_000_000_000_000_055_511_151_231, 10i128.pow(28)),
            ),
        ] {
            assert_eq!(read(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_or_too_long_is_refused() {
        for text in [
            "", "-", ".", "e5", "1e", "1e+", "x", "1/0", "1/-2", "1/2/3", "--1", "1,5", "nan",
            "0x1", "1 2", "1.2/3", "0/0",
        ] {
            assert_eq!(read(text), Err(CoordinateError::NoNumber), "{text}");
        }
        for text in [
            "1e30",
            "1e-31",
            "1e99999999999999999999999999999999999999999",
            "1234567890123456789012345678901",
        ] {
            assert_eq!(read(text), Err(CoordinateError::TooLong), "{text}");
        }
    }
}
